/* Sizes and distances of states, by their largest number. A number that is NaN makes them NaN. */
#ifndef API_VECTOR_H
#define API_VECTOR_H

#include <math.h>
#include <stddef.h>

static inline double vector_largest(const double *y, size_t count)
{
    double most = 0;
    for (size_t k = 0; k < count; k++)
        if (!(fabs(y[k]) <= most)) most = fabs(y[k]); /* NaN stays */
    return most;
}

static inline double vector_apart(const double *y, const double *z, size_t count)
{
    double most = 0;
    for (size_t k = 0; k < count; k++)
        if (!(fabs(y[k] - z[k]) <= most)) most = fabs(y[k] - z[k]);
    return most;
}

#endif
