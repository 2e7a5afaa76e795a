/* The C library's functions that the library calls, by the library's own: the module has one of each. */
#include "lang/base/operation.h"

#include <math.h>

double exp(double x) { return operation_value(OP_EXP, x, 0, 0); }
double log(double x) { return operation_value(OP_LOG, x, 0, 0); }

/* Exact at the powers of 2. */
double log2(double x)
{
    int power = 0;
    const double part = isfinite(x) ? frexp(x, &power) : x;
    return power + log(part) / 0x1.62e42fefa39efp-1;
}
