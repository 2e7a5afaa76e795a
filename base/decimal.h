/* Decimal numbers as text: the one reader and the one writer of library, program and page.
 *
 * Both are exact, and have a decimal point whatever the locale.
 */
#ifndef BASE_DECIMAL_H
#define BASE_DECIMAL_H

#include <stddef.h>
#include <stdint.h>

enum { DECIMAL_MAX = 32 }; /* room for any number and a 0 */

/* The shortest of 15, 16 or 17 digits that reads back as the same double; "nan", "inf", "-inf" for what has no
 * digits. Returns out. */
char *decimal(double, char out[DECIMAL_MAX]);
/* The same; returns the length. */
size_t decimal_write(double, char out[DECIMAL_MAX]);
size_t decimal_write_whole(uint64_t, char out[DECIMAL_MAX]);
/* The same characters by the C library alone, which is slower: what decimal_write() does is said here. */
size_t decimal_write_plain(double, char out[DECIMAL_MAX]);

/* The nearest double to the number digits[.digits][e[+-]digits] at s, of which `length` bytes may be read (a text
 * that ends with 0: any length will do); one side of the point may be empty, and a sign is none of it. Infinite
 * where it is too large. Returns how many bytes the number takes; 0: there is none. */
size_t decimal_read(const char *s, size_t length, double *);
/* The same of digits alone; 0 as well where the number is too large. */
size_t decimal_read_whole(const char *s, size_t length, uint64_t *);

#endif
