/* A constant expression of the language, "2 pi/3", as a number. */
#ifndef CLI_CONSTANT_H
#define CLI_CONSTANT_H

#include "motus.h"

/* The error's message begins with `where`; its hint says what is wrong with the expression. */
motus_status constant_read(const char *expression, const char *where, double *, motus_error *);

#endif
