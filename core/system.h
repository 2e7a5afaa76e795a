/* A problem: the equations that a stepper integrates. The stepper and the language share this and core/rules.h alone.
 *
 * x holds nx numbers: positions, boundary cells of families included. v holds nv >= nx numbers: the velocity of every
 * position, then the first-order variables s' = f, which are velocities without a position. a has nv numbers. A
 * boundary cell is fixed or driven: its a is 0 and `refresh` (where there is one) writes its x and v for time t.
 */
#ifndef CORE_SYSTEM_H
#define CORE_SYSTEM_H

#include "base/decimal.h"
#include "base/error.h"
#include "base/memory.h"

#include <stdbool.h>

typedef struct traits {
    bool velocity; /* a depends on a velocity or a first-order variable */
    bool time;
    bool linear_v;    /* a is at most affine in v */
    bool constant_jv; /* da/dv depends on parameters alone */
    bool gyroscopic;  /* velocity && linear_v && da/dv antisymmetric, without first-order variables */
    bool affine;      /* a is affine in (x, v) */
    bool constant;    /* a depends on parameters alone */
    bool gradient;
    bool smooth;
    bool has_exact;
    bool series;      /* a is a formula, so its Taylor series are known */
    bool first_order; /* there are first-order variables: nv > nx */
    /* velocity holds, but only first-order variables read v, and nothing reads them: they are integrals */
    bool quadrature;
} traits;

/* How far an exact motion may be from the initial state, and its acceleration from the force, in units of the size of
 * the motion and of the bound on the rounding of its formula: 512 roundings, because parameters carry the rounding of
 * their own formulas. */
#define EXACT_ROUNDING 0x1p-44

enum { SERIES_ORDER_MOST = 47 }; /* highest order of a Taylor series: the length of the table step/reciprocals.h */

typedef struct problem {
    void *ctx;
    size_t nx, nv;
    size_t modes; /* the last numbers of x, which events alone change; their velocities are 0 */
    /* Error control measures all numbers of one variable by one size. Variable g has the numbers from variables[g] to
     * before variables[g + 1], of v and, below nx, of x; variables[variable_count] = nv. NULL: one variable. */
    const size_t *variables;
    int variable_count;
    traits traits;
    /* Evaluates a = a(x, v, t), and may refresh driven boundary cells of x and v. Nonzero: the user's callback
     * failed. */
    int (*accel)(void *ctx, double t, double *x, double *v, double *a);
    /* Evaluates da = (da/dx) dx + (da/dv) dv at (t, x, v); dx or dv may be NULL (zero). NULL: unknown, and difference
     * quotients take its place. */
    int (*jvp)(void *ctx, double t, double *x, double *v, const double *dx, const double *dv, double *da);
    /* Makes jvp ready for calls with dv alone (in_v) or dx alone. False: there was no memory for that, or for the last
     * call of `pattern`. NULL: jvp is always ready. */
    bool (*prepare)(void *ctx, bool in_v);
    /* Calls emit(arg, row, column) for every entry of da/dv (in_v) or da/dx that may be nonzero, perhaps more than
     * once. NULL: all entries may be. */
    void (*pattern)(void *ctx, bool in_v, void (*emit)(void *arg, size_t row, size_t column), void *arg);
    /* Returns how many numbers must be kept while Taylor series of `length` coefficients are computed; 0: no memory. */
    size_t (*series_numbers)(void *ctx, int length);
    /* Computes coefficient n of the acceleration's Taylor series at (t, x, v), from the series of x and v, `length`
     * numbers each. NULL: no formula is known. */
    void (*series)(void *ctx, int length, int n, double t, double *x, double *v, double *a, double *kept);
    void (*refresh)(void *ctx, double t, double *x, double *v); /* NULL: no driven boundary */
    int (*exact)(void *ctx, double t, double *x, double *v);    /* NULL: unknown */
    /* Writes to x and v how far rounding may carry the exact motion at time t off, in units of EXACT_ROUNDING. False:
     * no memory. NULL: not known. */
    bool (*exact_rounding)(void *ctx, double t, double *x, double *v);
    /* Writes the name of x[k] (in_v: of v[k]) for messages: "r[3].y", "x'". */
    void (*name)(void *ctx, bool in_v, size_t k, char *out, size_t size);
    /* What the user's callback returned when it last failed; 0: it read the velocity, although its definition says that
     * it does not. NULL: there is no callback. */
    const int *returned;
} problem;

#endif
