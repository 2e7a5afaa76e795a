/* The floating-point modes that a caller may have changed: rounding to nearest with subnormals while the library
 * computes, the caller's own after it. */
#ifndef BASE_MODES_H
#define BASE_MODES_H

typedef struct modes {
    int rounding;
    unsigned long control;
} modes;
modes modes_enter(void);
void modes_leave(modes);

#endif
