/* The equations linearised at a state: products of the Jacobian matrix with vectors, for api/system/rate.h.
 *
 * Positions are in units of size_x; velocities and first-order variables in units of size_v. The matrix has zeros for
 * modes, since they do not move.
 */
#ifndef API_SYSTEM_LINEAR_H
#define API_SYSTEM_LINEAR_H

#include "api/system/rate.h"
#include "core/system.h"

typedef struct linear {
    const problem *problem;
    double t;
    double *x, *v; /* the state */
    double *moved_x, *moved_v;
    double *a, *other, *dx, *dv;
    double size_x, size_v;
    bool failed, no_memory; /* failed: a callback did */
} linear;

/* Returns the relative rounding of a product with the Jacobian matrix; it is larger for difference quotients. */
double linear_rounding(const problem *);

/* Returns how many numbers of room linear_place shares out. */
size_t linear_room(const problem *);
void linear_place(linear *, const problem *, double *room);
/* Counts the positions that move: all but the modes. */
size_t linear_positions(const problem *);
/* Computes a at time t and (x, v), or (moved_x, moved_v) if `moved`. False: a is not finite, or a callback failed. */
bool linear_evaluate(linear *, double t, bool moved, double *a);
/* Computes (x', v') along u = (x, v), in units of the sizes: the product of a rate_map. */
bool linear_product(void *ctx, const double *u, double *out);

/* The rates of the motion at a state. `fastest`: the largest |eigenvalue|, NaN: it cannot be computed. re[k] + i im[k]:
 * the eigenvalues that rate_motion finds along the motion, or, at rest, along a scattered direction. */
typedef struct linear_rates {
    double fastest;
    int count;
    double re[RATE_MOTION_MAX], im[RATE_MOTION_MAX];
} linear_rates;
/* Computes the rates. Set the sizes first; size_v becomes the one that the fastest rate gives. basis: room for
 * (RATE_MOTION_MAX + 1) n numbers, n of x and v together. */
void linear_rates_of(linear *, double *basis, linear_rates *out);

#endif
