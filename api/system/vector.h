/* Sizes and distances of states, by their largest number; a number that is NaN makes them NaN. Random numbers. */
#ifndef API_SYSTEM_VECTOR_H
#define API_SYSTEM_VECTOR_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

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

static inline double vector_random(uint64_t *state) /* splitmix64 [Steele14], to [-1, 1) */
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (double)((z ^ z >> 31) >> 11) * 0x1p-52 - 1;
}

#endif
