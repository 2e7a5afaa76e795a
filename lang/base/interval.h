/* Interval arithmetic: bounds on the values of an operation whose operands are anywhere in intervals. The bounds are
 * not rounded outward, and they are too wide where both operands contain one number.
 */
#ifndef LANG_BASE_INTERVAL_H
#define LANG_BASE_INTERVAL_H

#include "lang/base/operation.h"

#include <stdbool.h>

typedef struct interval {
    double low, high;
} interval;

interval interval_hull(interval, interval);
interval interval_magnitude(interval);
/* Returns bounds on one operation; same: both operands are the same number. An operation that is undefined for some of
 * the operands has no bounds. */
interval interval_value(operation, interval a, interval b, interval c, bool same);

#endif
