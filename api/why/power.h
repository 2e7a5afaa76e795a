/* The power of the time with which a number grows towards an instant, from samples before it. */
#ifndef API_WHY_POWER_H
#define API_WHY_POWER_H

#include <stdbool.h>
#include <stddef.h>

/* y goes as (at - t)^-exponent. */
typedef struct power {
    double at, at_error, exponent, exponent_error;
} power;

/* From samples at increasing times t, whose rounding is `rounding`; y > 0. False: they do not follow one power over two
 * decades of the distance. */
bool power_fit(const double *t, const double *y, size_t count, double rounding, power *out);

#endif
