/* The functions that the texts of step/ need from their includer, for a problem, with real = double; then the texts.
 * Only files that define a stepper_body include it. They may define a TRACE first. */
static inline int accel(work *w, clock t, real *x, real *v, real *a)
{
    const problem *p = w->services->problem;
    w->evaluations++;
    return p->accel(p->ctx, t, x, v, a) ? STEP_CALLBACK : STEP_OK;
}

static inline int solve_factor(work *w, mask *where, int s, const clock *ax, const clock *av, clock t, real *x, real *v)
{
    (void)where, (void)s; /* the solver was made for this number of stages */
    switch (solver_factor(w->services->solver, ax, av, t, x, v, &w->evaluations)) {
    case 0: return STEP_OK;
    case 1: return STEP_CALLBACK;
    default:
        w->in_v = true;
        w->which = 0;
        return STEP_SOLVE;
    }
}

static inline void solve_back(work *w, real *r) { solver_back(w->services->solver, r); }
static inline void solve_apply(work *w, clock c, const real *y, real *out)
{
    solver_apply(w->services->solver, c, y, out);
}
static const real *solve_diagonal(const work *w) { return solver_diagonal(w->services->solver); }

static inline int exact_at(work *w, clock t, real *x, real *v)
{
    const problem *p = w->services->problem;
    return p->exact(p->ctx, t, x, v) ? STEP_CALLBACK : STEP_OK;
}

static inline void refresh_at(work *w, clock t, real *x, real *v)
{
    const problem *p = w->services->problem;
    if (p->refresh) p->refresh(p->ctx, t, x, v);
}

static inline void series_order(work *w, int n, clock t)
{
    const problem *p = w->services->problem;
    p->series(p->ctx, w->expands + 1, n, t, w->xs, w->vs, w->a, w->ks);
}

#include "core/texts.h"

#define STEPPER_BODY(name)                                                                                       \
    {                                                                                                            \
        name, work_plan, work_place, family_carry, advance_run, advance_sync, advance_check, advance_observe,    \
            family_between, family_extend, family_dense, family_swing, advance_branch, solve_factor, solve_back, \
            solve_apply, solve_diagonal, accel                                                                   \
    }
