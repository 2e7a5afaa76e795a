/* Decimal numbers as text: the reader and the writer for library, program and page.
 *
 * Both are exact, and use a decimal point in every locale.
 */
#ifndef BASE_DECIMAL_H
#define BASE_DECIMAL_H

#include <stddef.h>
#include <stdint.h>

enum { DECIMAL_MAX = 32 }; /* room for any number and a 0 */

/* Writes the shortest of 15, 16 or 17 digits that reads back as the double; "nan", "inf", "-inf" for what has no
 * digits. Returns out. */
char *decimal(double, char out[DECIMAL_MAX]);
/* Writes what decimal() writes, and returns the length. */
size_t decimal_write(double, char out[DECIMAL_MAX]);
/* Writes the number of the fewest digits that is no farther than `off` from `wanted`, and returns it. */
double decimal_near(double wanted, double off, char out[DECIMAL_MAX]);
/* Writes a time for a message: with at least 6 digits, and as many as tell times apart that differ by 1e-5 of `span`,
 * the length of the motion, but at most 12, which rounding leaves intact; all digits where `span` is 0 or not finite.
 * Returns out. */
char *decimal_time(double t, double span, char out[DECIMAL_MAX]);
size_t decimal_write_whole(uint64_t, char out[DECIMAL_MAX]);
/* Writes what decimal_write() writes, by the C library alone, which is slower. It defines these characters. */
size_t decimal_write_plain(double, char out[DECIMAL_MAX]);

/* Reads the nearest double to the number digits[.digits][e[+-]digits] at s, of which `length` bytes may be read (of a
 * text that ends with 0 any length will do). One side of the point may be empty; a sign is not part of the number. A
 * number that is too large becomes infinite. Returns the bytes of the number; 0: there is none. */
size_t decimal_read(const char *s, size_t length, double *);
/* Reads as decimal_read() does, and finds the double on the other side of the number as written, so that it lies
 * between the two; where the number is a double, that double. rest: the number as written less the double, to 53 bits;
 * 0 beyond the range. */
size_t decimal_read_between(const char *s, size_t length, double *, double *other, double *rest);
/* Reads a whole number of digits alone. Returns its bytes; 0: there is none, or it is too large. */
size_t decimal_read_whole(const char *s, size_t length, uint64_t *);
/* Returns the nearest double to digits * 10^power; digits: a whole number of at most 15 digits. */
double decimal_scaled(double digits, int power);

#endif
