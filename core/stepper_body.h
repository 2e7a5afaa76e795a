/* What core/stepper_body.c compiles to, once per instruction set, and the workspace it works on: step/work.h with real = double. */
#ifndef CORE_STEPPER_BODY_H
#define CORE_STEPPER_BODY_H

#include "core/rows.h"
#include "core/solver.h"

#include <float.h>
#include <math.h>

#define clock motus_clock             /* the C library has a function of that name */
#define real double
typedef double clock;
typedef int64_t whole;
#define FMA(a, b, c) fma((a), (b), (c))
#define ABS(x) fabs(x)
#define FINITE(x) ((x) - (x) == 0)    /* an infinity or a NaN minus itself is a NaN; unlike isfinite, this becomes vector code */
#define EPSILON DBL_EPSILON
#define SQRT_EPSILON 0x1p-26
#define EACH(k) for (size_t k = 0; k < w->nx; k++)
#define EACHV(k) for (size_t k = 0; k < w->nv; k++)
#define TRACE(w, i) ((void)(w), (void)(i))

#include "step/work.h"

typedef struct machine { const problem *problem; solver *solver; } machine;      /* work.user points to it */

typedef struct stepper_body {
    const char *name;
    int (*run)(work *, whole steps);                         /* advance_run */
    int (*sync)(work *, real *x, real *v, real *a);          /* advance_sync */
    int (*check)(work *);                                    /* advance_check */
} stepper_body;

extern const stepper_body stepper_body_base;
#if defined __x86_64__
extern const stepper_body stepper_body_avx2, stepper_body_avx512;
#endif

/* Another body for a stepper, before its first step: how a test sees that all of them give the same bits. */
struct stepper;
void stepper_use_body(struct stepper *, const stepper_body *);

#endif
