/* A straight line through measured points. */
#ifndef TEST_FIT_H
#define TEST_FIT_H

#include <math.h>

/* Its slope by least squares, and twice the standard error of that. */
static inline double line_slope(const double *x, const double *y, int n, double *twice)
{
    double mx = 0, my = 0, xx = 0, xy = 0, rest = 0;
    for (int k = 0; k < n; k++) mx += x[k] / n, my += y[k] / n;
    for (int k = 0; k < n; k++) xx += (x[k] - mx) * (x[k] - mx), xy += (x[k] - mx) * (y[k] - my);
    for (int k = 0; k < n; k++) rest += pow(y[k] - my - xy / xx * (x[k] - mx), 2);
    *twice = 2 * sqrt(rest / (n - 2) / xx);
    return xy / xx;
}

#endif
