/* Whether an invariant drifts: see trend.c for what counts as a trend. */
#ifndef STUDY_TREND_H
#define STUDY_TREND_H

#include <stddef.h>

typedef struct trend_result {
    double trend; /* slope of the line through the drift, times the length of the run */
    int trending;
} trend_result;
/* roundoff: the largest trend that rounding alone may explain. */
trend_result trend_find(const double *t, const double *drift, size_t count, double roundoff);

#endif
