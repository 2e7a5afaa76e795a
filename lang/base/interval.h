/* Interval arithmetic: bounds on the values of an operation whose operands are anywhere in intervals. The bounds are
 * not rounded outward, and they are wider than the values where one number is in both operands.
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
/* The interval of one operation; same: both operands are the same number. What is not defined everywhere in the
 * operands is anything. */
interval interval_value(operation, interval a, interval b, interval c, bool same);

#endif
