/* Legs: the start of a stepper, and the checks of a start. See stepper.h. */
#include "core/stepper_parts.h"

#include <string.h>

static motus_status check_start(stepper *s, double t0, double h, const double *x, const double *v, motus_error *err)
{
    char name[MOTUS_NAME_MAX];
    if (!isfinite(t0) || !isfinite(h) || h == 0 || t0 + h == t0) {
        char t[DECIMAL_MAX];
        fail(err, MOTUS_ARGUMENT, "the step %g from t = %s must be finite, and large enough to change t", h,
             decimal(t0, t));
        hint(err, "take a larger step");
        return MOTUS_ARGUMENT;
    }
    for (size_t k = 0; k < s->problem.nx; k++)
        if (!isfinite(x[k]))
            return fail(err, MOTUS_ARGUMENT, "the initial value of %s is not a finite number",
                        stepper_name(s, false, k, name));
    for (size_t k = 0; k < s->problem.nv; k++)
        if (!isfinite(v[k]))
            return fail(err, MOTUS_ARGUMENT, "the initial value of %s is not a finite number",
                        stepper_name(s, true, k, name));
    return MOTUS_OK;
}

/* Writes the rounding of the exact motion at t0, in units of EXACT_ROUNDING; for a callback, whose formula is unknown,
 * the size of the motion in its first steps. False: no memory. */
static bool exact_size(const problem *p, double t0, double h, const double *start, double *size, size_t nx)
{
    enum { STEPS = 8 };
    const size_t all = nx + p->nv;
    if (p->exact_rounding) return p->exact_rounding(p->ctx, t0, size, size + nx);
    double of[3] = {0, 0, 0}; /* positions, velocities, first-order variables */
    for (int n = 0; n <= STEPS; n++) {
        memcpy(size, start, all * sizeof *size);
        if (n && p->exact(p->ctx, t0 + n * h, size, size + nx)) break;
        for (size_t k = 0; k < all; k++) {
            double *most = &of[k < nx ? 0 : k < 2 * nx ? 1 : 2];
            if (isfinite(size[k])) *most = fmax(*most, fabs(size[k]));
        }
    }
    for (size_t k = 0; k < all; k++) size[k] = of[k < nx ? 0 : k < 2 * nx ? 1 : 2];
    return true;
}

static motus_status refuse_start(const stepper *s, double t0, size_t k, bool in_v, double exact, double start,
                                 motus_error *err)
{
    char name[MOTUS_NAME_MAX], is[DECIMAL_MAX], due[DECIMAL_MAX], t[DECIMAL_MAX];
    fail(err, MOTUS_METHOD,
         "exact does not admit this start: the exact motion has another state at t = %s: %s is %s, not %s",
         decimal(t0, t), stepper_name(s, in_v, k, name), decimal(exact, is), decimal(start, due));
    hint(err, "start on the exact motion, or choose another method");
    return MOTUS_METHOD;
}

/* Checks that a run by "exact" starts on the exact motion, which is the only one that it can follow. */
static motus_status check_exact(stepper *s, double t0, double h, const double *x, const double *v, motus_error *err)
{
    const problem *p = &s->problem;
    if (!row_formula(&s->method) || p->traits.constant) return MOTUS_OK;
    if (!p->exact) return fail(err, MOTUS_METHOD, "exact does not admit this model: its exact motion is not known");
    const size_t nx = p->nx, all = p->nx + p->nv;
    double *there = take(&s->allocator, 3 * all, sizeof *there);
    if (!there) return fail(err, MOTUS_MEMORY, "out of memory");
    double *size = there + all, *start = size + all;
    memcpy(start, x, nx * sizeof *x);
    memcpy(start + nx, v, p->nv * sizeof *v);
    memcpy(there, start, all * sizeof *there);
    const int bad = p->exact(p->ctx, t0, there, there + nx);
    motus_status status = bad ? stepper_report(s, STEP_CALLBACK, t0, err) : MOTUS_OK;
    if (!bad && !exact_size(p, t0, h, start, size, nx)) status = fail(err, MOTUS_MEMORY, "out of memory");
    for (size_t k = 0; k < all && !status; k++)
        if (!(fabs(there[k] - start[k]) <= EXACT_ROUNDING * size[k]))
            status = refuse_start(s, t0, k < nx ? k : k - nx, k >= nx, there[k], start[k], err);
    give(&s->allocator, there);
    return status;
}

/* Begins a leg. cleared: how many numbers of the arrays are set to 0, since no step writes entries without an equation,
 * where a failed step may have left something. goes_on: the lengths of a density are kept, which belong to the motion.
 * */
static void begin(stepper *s, double t0, double h, const double *x, const double *v, size_t cleared, bool goes_on)
{
    work *w = &s->work;
    const size_t kept = goes_on && w->row->density ? w->stride : 0, before = kept ? (size_t)(w->old - s->arrays) : 0;
    w->n = s->pace_n = 0;
    s->pace_t = t0;
    memset(s->arrays, 0, before * sizeof(double));
    memset(s->arrays + before + kept, 0, (cleared - before - kept) * sizeof(double));
    memcpy(w->x, x, w->nx * sizeof *x);
    memcpy(w->v, v, w->nv * sizeof *v);
    w->t0 = w->t = t0;
    w->lost = 0;
    w->next = copysign(s->method.first, h);
    w->before = w->shortest = w->longest = w->span = 0;
    w->rise = CONTROL_RISE;
    w->fresh = w->stalled = w->ends = false;
    w->moved = 0;
    w->expanded = 0;
    work_scale(w, h);
    if (s->library.solver) solver_forget(s->library.solver);
}

void stepper_begin(stepper *s, double t0, double h, const double *x, const double *v)
{
    begin(s, t0, h, x, v, s->array_count, false);
}

motus_status stepper_turn(stepper *s, double t, double h, motus_error *err)
{
    work *w = &s->work;
    const size_t nx = w->nx, nv = w->nv;
    if (w->carried && w->kept && t == w->t) { /* the next step starts from stages of the last one, which are kept */
        w->next = s->leg_h = h;
        w->before = 0, w->rise = CONTROL_RISE;
        s->arrived = s->left = s->right = false;
        return MOTUS_OK;
    }
    if (!stepper_ends(s)) return fail(err, MOTUS_MEMORY, "out of memory for another step size");
    double *x = s->ends + nx + 2 * nv, *v = x + nx, *error = s->ends;
    motus_status status = stepper_sync(s, x, v, NULL, err);
    if (status) return status;
    /* A velocity that waits for its closing kick gets its error word with it. */
    const bool words = w->row->compensated && w->n > 0, whole = words && !w->fsal;
    if (words) memcpy(error, w->ex, nx * sizeof *error);
    if (whole) memcpy(error + nx, w->ev, nv * sizeof *error);
    status = stepper_start(s, t, h, x, v, err);
    if (status) return status;
    if (w->carried) w->next = h;
    if (words) memcpy(w->ex, error, nx * sizeof *error);
    if (whole) memcpy(w->ev, error + nx, nv * sizeof *error);
    return MOTUS_OK;
}

void stepper_follow(stepper *s, const stepper *like)
{
    if (s->method.row->orders) s->work.before = like->work.span;
}

static motus_status start(stepper *s, double t0, double h, const double *x, const double *v, size_t cleared,
                          bool goes_on, motus_error *err)
{
    motus_status status = check_start(s, t0, h, x, v, err);
    if (!status) status = check_exact(s, t0, h, x, v, err);
    if (status) return status;
    s->leg_h = h;
    s->main_t0 = t0;
    s->at.steps = s->earlier_at.steps = -1;
    s->shortened = s->arrived = s->left = s->right = false;
    s->left_steps = -1;
    memcpy(s->origin, x, s->work.nx * sizeof *x);
    memcpy(s->origin + s->work.nx, v, s->work.nv * sizeof *v);
    s->origin_known = true;
    begin(s, t0, h, x, v, cleared, goes_on);
    return MOTUS_OK;
}

motus_status stepper_start(stepper *s, double t0, double h, const double *x, const double *v, motus_error *err)
{
    return start(s, t0, h, x, v, s->array_count, false, err);
}

static void lead(stepper *s, double lost, double h)
{
    if (s->work.carried) s->work.next = h, s->work.lost = lost;
}

motus_status stepper_jump(stepper *s, double t0, double lost, double h, const double *x, const double *v,
                          motus_error *err)
{
    const motus_status status = stepper_start(s, t0, h, x, v, err);
    if (!status) lead(s, lost, h);
    return status;
}

motus_status stepper_go_on(stepper *s, double t0, double lost, double h, const double *x, const double *v,
                           motus_error *err)
{
    const motus_status status = start(s, t0, h, x, v, s->array_count, true, err);
    if (!status) lead(s, lost, h);
    return status;
}

/* Tells whether the last step of s is marked and began at this state. */
static bool began_at(const stepper *s, double t, const double *x, const double *v)
{
    const size_t nx = s->work.nx, nv = s->work.nv;
    if (!s->left || s->left_steps != stepper_steps(s) - 1 || s->left_t != t) return false;
    return !memcmp(s->ends, x, nx * sizeof *x) && !memcmp(s->ends + nx, v, nv * sizeof *v);
}

motus_status stepper_branch(stepper *s, const stepper *along, double t0, double lost, double h, const double *x,
                            const double *v, motus_error *err)
{
    work *w = &s->work;
    const bool known = along && row_watched(&s->method) && began_at(along, t0, x, v);
    if (!known) return stepper_jump(s, t0, lost, h, x, v, err);
    /* the series come last in the arrays, and need not be cleared: a step reads only what is taken over or computed */
    const size_t cleared = w->expands ? (size_t)(w->xs - s->arrays) : s->array_count;
    const motus_status status = start(s, t0, h, x, v, cleared, false, err);
    if (status) return status;
    lead(s, lost, h);
    s->body->branch(w, &along->work, along->ends + w->nx + w->nv);
    return MOTUS_OK;
}
