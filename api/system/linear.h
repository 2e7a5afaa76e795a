/* The equations linearised at a state: products of the Jacobian matrix with vectors, for api/system/rate.h.
 *
 * Numbers are in units of sizes, one of positions and one of velocities and first-order variables. Modes do not move,
 * so the matrix has zeros in their places.
 */
#ifndef API_SYSTEM_LINEAR_H
#define API_SYSTEM_LINEAR_H

#include "api/system/rate.h"
#include "core/system.h"

typedef struct linear {
    const problem *problem;
    double t;
    double *x, *v; /* the state, and room to move away from it */
    double *moved_x, *moved_v;
    double *a, *other, *dx, *dv;
    double size_x, size_v;
    bool failed, no_memory; /* failed: a callback */
} linear;

/* Of a product with the Jacobian matrix, relative to it: more where that is of difference quotients. */
double linear_rounding(const problem *);

/* How many numbers of room it takes; shares them out. */
size_t linear_room(const problem *);
void linear_place(linear *, const problem *, double *room);
/* The positions that move: all but the modes. */
size_t linear_positions(const problem *);
/* a at (x, v), or at (moved_x, moved_v), and time t. False: it is not finite, or a callback failed. */
bool linear_evaluate(linear *, double t, bool moved, double *a);
/* (x', v') along u = (x, v), in units of the sizes; of rate_map. */
bool linear_product(void *ctx, const double *u, double *out);

/* The rates of the motion at the state. `fastest`: the largest size of an eigenvalue, NaN: it cannot be computed; re[k]
 * + i im[k]: those that take part in the motion, or at rest in any: as rate_motion tells them. */
typedef struct linear_rates {
    double fastest;
    int count;
    double re[RATE_MOTION_MAX], im[RATE_MOTION_MAX];
} linear_rates;
/* The sizes are set, and size_v becomes that which the fastest rate gives. basis: room for (RATE_MOTION_MAX + 1) n
 * numbers, n of x and v together. */
void linear_rates_of(linear *, double *basis, linear_rates *out);

#endif
