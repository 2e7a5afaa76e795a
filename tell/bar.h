/* A number with its error: 0.0477824 ± 1.5e-6. */
#ifndef TELL_BAR_H
#define TELL_BAR_H

#include "base/decimal.h"

enum { BAR_MAX = 2 * DECIMAL_MAX + 16 }; /* room for a value, ±, an error and a 0 */

/* Writes the value to the last decimal that its error leaves, and the error rounded up to one digit, or two where it
 * begins with 1 or 2, with what rounding the value takes. |value| below the error: "0 ± 2e-5". Error 0: "0 (exact)";
 * NaN, not known: all digits and "±?"; infinite: "—", since no digit is known to be significant. Returns out. */
char *bar_text(double value, double error, char out[BAR_MAX]);
/* Writes 0.0477824(15): the error in units of the last digit; or as bar_text() does where no digit stands after the
 * point, or none is significant. Returns out. */
char *bar_digits(double value, double error, char out[BAR_MAX]);
/* Writes the error alone, rounded up as by bar_text(): "1.5e-6". Returns out. */
char *bar_error(double error, char out[DECIMAL_MAX]);

#endif
