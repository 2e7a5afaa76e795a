/* Whether the deviation of an invariant has a trend. trend.c defines a trend. */
#ifndef STUDY_TREND_H
#define STUDY_TREND_H

#include <stddef.h>

typedef struct trend_result {
    double trend; /* the slope of the line through the deviation, times the length of the run */
    int trending;
} trend_result;
/* Finds the trend. roundoff: the largest trend that rounding alone may explain. */
trend_result trend_find(const double *t, const double *deviation, size_t count, double roundoff);

#endif
