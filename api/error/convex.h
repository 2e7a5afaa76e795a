/* How far the origin is from the convex hull of points. */
#ifndef API_ERROR_CONVEX_H
#define API_ERROR_CONVEX_H

#include <stddef.h>

/* Of two points of n numbers, each of which counts by its weight. */
double convex_product(const double *a, const double *b, const double *weight, size_t n);
/* `count` points of n numbers each, one behind the other. The distance, which is not told more exactly than `enough`;
 * nearest: the point of the hull, and `share` what it has of each of the points. */
double convex_distance(const double *points, size_t count, size_t n, const double *weight, double enough, double *share,
                       double *nearest);

#endif
