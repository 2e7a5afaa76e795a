/* Numbers from text, correctly rounded and independent of the locale. */
#ifndef LANG_TEXT_NUMBER_H
#define LANG_TEXT_NUMBER_H

#include <stdbool.h>
#include <stddef.h>

/* digits[.digits][e[+-]digits] to the nearest double; false if it overflows. The text need not end with 0. */
bool number_read(const char *text, size_t length, double *value);

#endif
