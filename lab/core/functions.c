/* The C library's functions that the library calls, by the library's own: the module has one of each. */
#include "lang/base/operation.h"

#include <math.h>

double exp(double x) { return operation_value(OP_EXP, x, 0, 0); }
double log(double x) { return operation_value(OP_LOG, x, 0, 0); }
