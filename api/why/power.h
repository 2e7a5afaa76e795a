/* The power of the time with which a number grows towards an instant, from samples before it. */
#ifndef API_WHY_POWER_H
#define API_WHY_POWER_H

#include <stdbool.h>
#include <stddef.h>

/* A number that goes as (at - t)^-exponent. */
typedef struct power {
    double at, at_error, exponent, exponent_error;
} power;

/* Fits a power to samples y > 0 at increasing times t, which are rounded by `rounding`. False: the samples do not
 * follow one power over two decades of the distance. */
bool power_fit(const double *t, const double *y, size_t count, double rounding, power *out);

#endif
