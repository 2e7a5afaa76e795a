/* See convex.h. The algorithm of Mitchell, Demyanov and Malozemov [MDM74]: a point of the hull is a mean of the points.
 * In each turn, of the points with a share in the mean, the one farthest from the origin along the mean gives some of
 * its share to the point that is nearest along it. */
#include "api/error/convex.h"

#include <math.h>
#include <string.h>

enum { TURNS = 2000 };
#define NEARLY 1e-3 /* the distance is known to this part of it */

double convex_product(const double *a, const double *b, const double *weight, size_t n)
{
    double sum = 0;
    for (size_t k = 0; k < n; k++) sum += a[k] * weight[k] * (b[k] * weight[k]);
    return sum;
}

double convex_distance(const double *points, size_t count, size_t n, const double *weight, double enough, double *share,
                       double *nearest)
{
    double *const z = nearest;
    for (size_t i = 0; i < count; i++) share[i] = i == 0;
    memcpy(z, points, n * sizeof *z);
    for (int turn = 0; turn < TURNS; turn++) {
        const double size = convex_product(z, z, weight, n);
        if (!(size > enough * enough)) break;
        size_t to = 0, from = 0;
        double low = INFINITY, high = -INFINITY;
        for (size_t i = 0; i < count; i++) {
            const double along = convex_product(z, points + i * n, weight, n);
            if (along < low) low = along, to = i;
            if (share[i] > 0 && along > high) high = along, from = i;
        }
        if (size - low <= NEARLY * size || !(high > low)) break;
        const double *const p = points + to * n, *const q = points + from * n;
        double way = 0;
        for (size_t k = 0; k < n; k++) way += (p[k] - q[k]) * weight[k] * ((p[k] - q[k]) * weight[k]);
        const double part = fmin(share[from], (high - low) / way);
        for (size_t k = 0; k < n; k++) z[k] += part * (p[k] - q[k]);
        share[to] += part, share[from] -= part;
    }
    return sqrt(convex_product(z, z, weight, n));
}
