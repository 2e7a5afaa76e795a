/* How far the origin is from the convex hull of points. */
#ifndef API_ERROR_CONVEX_H
#define API_ERROR_CONVEX_H

#include <stddef.h>

/* Returns the product of two points of n numbers, where each number counts by its weight. */
double convex_product(const double *a, const double *b, const double *weight, size_t n);
/* Returns the distance; if it is below `enough`, it need not be exact. points: `count` points of n numbers, one after
 * the other. nearest: gets the nearest point of the hull, and `share` the weight of each point in it. */
double convex_distance(const double *points, size_t count, size_t n, const double *weight, double enough, double *share,
                       double *nearest);

#endif
