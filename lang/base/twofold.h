/* Numbers of twice the bits of a double, with a bound on their error: the exact values of constants, beside the values
 * that doubles give them.
 */
#ifndef LANG_BASE_TWOFOLD_H
#define LANG_BASE_TWOFOLD_H

#include "lang/base/operation.h"

/* The number is high + low; the true one is no further from it than `error`. An infinite error: nothing is known. */
typedef struct twofold {
    double high, low, error;
} twofold;

#define TWOFOLD_KNOWN 0x1p-90 /* a sum this small beside its terms is 0: decimals have fewer digits */

static inline twofold twofold_of(double x) { return (twofold){x, 0, 0}; }
static inline double twofold_unit(double x) /* a bound on the distance from x to the next double */
{
    const double size = x < 0 ? -x : x;
    return size * 0x1p-52 + 0x1p-1074;
}
/* Returns the value of an operation; where an error leaves something open, as the side of a jump, the error of the
 * value covers it. */
twofold twofold_value(operation, twofold a, twofold b, twofold c);

#endif
