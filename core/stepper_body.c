/* The texts of step/ for a callback, with real = double. This file is compiled once per instruction set, each time with its own
 * -DISA=…, always with -O3 -ffp-contract=off (never -ffast-math):
 *
 *     -DISA=base                                    everywhere
 *     -DISA=avx2    -mavx2 -mfma                    x86-64
 *     -DISA=avx512  -mavx512f -mavx512vl -mavx512dq -mavx2 -mfma -mprefer-vector-width=512        x86-64
 *
 * Invariant: all of them give the same bits, because every operation is written out, fma included; they differ in speed alone.
 * core/stepper.c chooses.
 */
#include "core/stepper_body.h"

#ifndef ISA
#error "compile with -DISA=base, avx2 or avx512"
#endif

static inline int accel(work *w, clock t, real *x, real *v, real *a)
{
    const problem *p = ((const stepper_host *)w->user)->problem;
    w->evaluations++;
    return p->accel(p->ctx, t, x, v, a) ? STEP_CALLBACK : STEP_OK;
}

static inline int solve_factor(work *w, int s, const clock *ax, const clock *av, clock t, real *x, real *v)
{
    (void)s;                              /* the solver was made for this number of stages */
    switch (solver_factor(((stepper_host *)w->user)->solver, ax, av, t, x, v, &w->evaluations)) {
    case 0: return STEP_OK;
    case 1: return STEP_CALLBACK;
    default: w->in_v = true; w->which = 0; return STEP_SOLVE;
    }
}

static inline void solve_back(work *w, real *r) { solver_back(((stepper_host *)w->user)->solver, r); }
static inline void solve_apply(work *w, clock c, const real *y, real *out) { solver_apply(((stepper_host *)w->user)->solver, c, y, out); }

static const real *solve_diagonal(const work *w) { return solver_diagonal(((stepper_host *)w->user)->solver); }

static inline int exact_at(work *w, clock t, real *x, real *v)
{
    const problem *p = ((const stepper_host *)w->user)->problem;
    return p->exact(p->ctx, t, x, v) ? STEP_CALLBACK : STEP_OK;
}

static inline void refresh_at(work *w, clock t, real *x, real *v)
{
    const problem *p = ((const stepper_host *)w->user)->problem;
    if (p->refresh) p->refresh(p->ctx, t, x, v);
}

#include "step/newton.h"
#include "step/splitting.h"
#include "step/runge_kutta.h"
#include "step/two_step.h"
#include "step/implicit.h"
#include "step/advance.h"
#include "step/loop.h"
#include "step/look.h"

#define PASTE(a, b) a##b
#define NAMED(isa) PASTE(stepper_body_, isa)
#define TEXT(isa) #isa
#define TEXT_OF(isa) TEXT(isa)

const stepper_body NAMED(ISA) = {TEXT_OF(ISA), advance_run, advance_sync, advance_check, solve_factor, solve_back, solve_apply, solve_diagonal};
