/* What core/stepper_body.c compiles to, once per instruction set, and the workspace it works on: step/work.h with real = double. */
#ifndef CORE_STEPPER_BODY_H
#define CORE_STEPPER_BODY_H

#include "core/rows.h"
#include "core/solver.h"

#include <float.h>
#include <math.h>

#include "core/scalar.h"
#include "step/work.h"

/* work.user points to it. tracing: of core/trace.h, while a step is traced. */
typedef struct stepper_host { const problem *problem; solver *solver; const struct tracing *tracing; } stepper_host;

typedef struct stepper_body {
    const char *name;
    int (*run)(work *, whole steps);                         /* advance_run */
    int (*sync)(work *, real *x, real *v, real *a);          /* advance_sync */
    int (*check)(work *);                                    /* advance_check */
    /* What a compiled body calls back for. */
    int (*factor)(work *, int s, const clock *ax, const clock *av, clock t, real *x, real *v);
    void (*back)(work *, real *r);
    void (*apply)(work *, clock c, const real *y, real *out);
    const real *(*diagonal)(const work *);                   /* solver_diagonal */
} stepper_body;

/* The fastest one here. */
const stepper_body *stepper_best_body(void);
extern const stepper_body stepper_body_base;
#if defined __x86_64__
extern const stepper_body stepper_body_avx2, stepper_body_avx512;
#endif

/* A workspace without memory: sizes, traits, and what follows from the row, its arguments and the step. */
work stepper_plan(const problem *, const chosen *, double t0, double h);
size_t stepper_arrays(work plan);       /* how many arrays it needs */

/* Another body for a stepper, before its first step: how a test sees that all of them give the same bits. */
struct stepper;
void stepper_use_body(struct stepper *, const stepper_body *);

#endif
