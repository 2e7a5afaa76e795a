/* The texts of step/ with real = double, for a problem: what they ask of their includer, and after it the texts themselves.
 *
 * Included by the files that become a stepper_body, and by nothing else; such a file may define a TRACE of its own first. Invariant: nothing
 * here decides an operation on the state, so all bodies give the same bits.
 */
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

#define STEPPER_BODY(name) {name, advance_run, advance_sync, advance_check, solve_factor, solve_back, solve_apply, solve_diagonal}
