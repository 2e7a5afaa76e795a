/* A number as the shortest of 15, 16 or 17 digits that reads back as the same double. */
#ifndef CLI_DIGITS_H
#define CLI_DIGITS_H

#include <stddef.h>

enum { DIGITS_ROOM = 32 };                 /* room for any number */

/* Writes it with a 0 behind; its length. "nan", "inf", "-inf" for what has no digits. */
size_t digits_print(double, char out[DIGITS_ROOM]);
size_t digits_integer(unsigned long long, char out[DIGITS_ROOM]);
/* The same characters by the C library, twenty times slower. What they are is said here. */
size_t digits_plain(double, char out[DIGITS_ROOM]);

#endif
