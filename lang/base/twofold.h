/* Numbers of twice the bits of a double, with a bound on their error: what constants are, beside what doubles make of
 * them.
 */
#ifndef LANG_BASE_TWOFOLD_H
#define LANG_BASE_TWOFOLD_H

#include "lang/base/operation.h"

/* The number is high + low, and the true one no further from it than `error`; infinite: nothing is known. */
typedef struct twofold {
    double high, low, error;
} twofold;

#define TWOFOLD_KNOWN 0x1p-90 /* what is this small beside the terms of a sum is 0: decimals have fewer digits */

static inline twofold twofold_of(double x) { return (twofold){x, 0, 0}; }
static inline double twofold_unit(double x) /* the distance of x to the next double, as a bound */
{
    const double size = x < 0 ? -x : x;
    return size * 0x1p-52 + 0x1p-1074;
}
/* The value of an operation; what an error leaves open, as the side of a jump, is in the error of the value. */
twofold twofold_value(operation, twofold a, twofold b, twofold c);

#endif
