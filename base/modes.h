/* The floating-point modes that a caller may have changed: while the library computes, rounding to nearest with
 * subnormals; afterwards the caller's own. */
#ifndef BASE_MODES_H
#define BASE_MODES_H

typedef struct modes {
    int rounding;
    unsigned long control;
} modes;
modes modes_enter(void);
void modes_leave(modes);

#endif
