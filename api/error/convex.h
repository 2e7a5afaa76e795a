/* How far the origin is from the convex hull of points. */
#ifndef API_ERROR_CONVEX_H
#define API_ERROR_CONVEX_H

#include <stddef.h>

/* Returns the product of two points of n numbers, where each number counts by its weight. */
double convex_product(const double *a, const double *b, const double *weight, size_t n);
/* Returns the distance, at most as exact as `enough`. points: `count` points of n numbers, one behind the other;
 * nearest: the nearest point of the hull, and `share` its share of each point. */
double convex_distance(const double *points, size_t count, size_t n, const double *weight, double enough, double *share,
                       double *nearest);

#endif
