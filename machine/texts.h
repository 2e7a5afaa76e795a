/* The texts of step/ and machine/text/, embedded in the library so that an installed motus can compile them. A text is
 * named as its file, "step/splitting.h"; the last row is NULL. */
#ifndef MACHINE_TEXTS_H
#define MACHINE_TEXTS_H

typedef struct embedded_text {
    const char *name, *text;
} embedded_text;
extern const embedded_text texts_table[];

#endif
