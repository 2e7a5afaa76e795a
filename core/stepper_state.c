/* The state of a stepper: time and counters, the carried numbers, observation, reports of failures. See stepper.h. */
#include "core/stepper_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

double stepper_time(const stepper *s) { return s->arrived ? s->until : time_now(&s->work); }
double stepper_lost(const stepper *s)
{
    if (s->arrived) return 0;
    return s->work.carried ? s->work.lost : stepper_lost_at(s, s->work.n);
}

double stepper_lost_at(const stepper *s, int64_t step)
{
    const work *w = &s->work;
    const double n = (double)step, t = TIME_FIXED(w, n, 0), product = n * w->h, rest = fma(n, w->h, -product);
    const double big = fabs(w->t0) > fabs(product) ? w->t0 : product, small = big == product ? w->t0 : product;
    return ((big - t) + small) + rest;
}
double stepper_time_of(const stepper *s, int64_t n)
{
    work leg = s->work;
    leg.t0 = s->main_t0;
    leg.h = s->leg_h;
    return leg.carried ? NAN : TIME_FIXED(&leg, (double)n, 0);
}

const problem *stepper_problem(const stepper *s) { return &s->problem; }
const chosen *stepper_method(const stepper *s) { return &s->method; }
double stepper_limit_of(const stepper *s) { return s->until; }
double stepper_step(const stepper *s) { return s->leg_h; }
double stepper_next(const stepper *s) { return s->work.carried ? s->work.next : s->leg_h; }
double stepper_last_step(const stepper *s) { return s->work.h; }
void stepper_sizes(const stepper *s, double *shortest, double *longest)
{
    const work *w = &s->work;
    const bool fixed = !w->carried, any = fixed ? stepper_steps(s) > 0 : w->longest > 0;
    *shortest = any ? (fixed ? fabs(s->leg_h) : w->shortest) : NAN;
    *longest = any ? (fixed ? fabs(s->leg_h) : w->longest) : NAN;
}
int64_t stepper_refused(const stepper *s) { return s->work.refused; }
int64_t stepper_steps(const stepper *s) { return s->shortened ? s->at.steps + 1 : s->work.n; }
int64_t stepper_evaluations(const stepper *s) { return s->work.evaluations; }
int64_t stepper_iterations(const stepper *s) { return s->work.iterations; }

/* Carry ----------------------------------------------------------------------------------------------------------- */

static size_t clocks(const work *w) { return w->carried ? STEPPER_CLOCKS : 0; }

size_t stepper_carry(const stepper *s)
{
    double *list[CARRY_MAX];
    return (size_t)s->body->carry(&s->work, list) * s->work.nv + clocks(&s->work);
}

stepper_count stepper_get(const stepper *s, double *carry)
{
    double *list[CARRY_MAX];
    const work *w = &s->work;
    const int count = s->body->carry(w, list);
    for (int i = 0; i < count; i++) memcpy(carry + (size_t)i * w->nv, list[i], w->nv * sizeof *carry);
    const double time[STEPPER_CLOCKS] = {w->t, w->lost, w->next, w->before, w->rise, w->shortest, w->longest, w->span};
    memcpy(carry + (size_t)count * w->nv, time, clocks(w) * sizeof *time);
    return (stepper_count){w->n, w->evaluations, w->iterations, w->refused};
}

void stepper_put(stepper *s, stepper_count at, const double *carry)
{
    double *list[CARRY_MAX];
    work *w = &s->work;
    if (s->shortened) { /* the shorter last step had a start and a size of its own */
        w->t0 = s->main_t0;
        work_scale(w, s->leg_h);
        if (s->library.solver) solver_forget(s->library.solver);
        s->shortened = false;
    }
    w->n = at.steps; /* set first, because the list of carried numbers depends on it */
    w->evaluations = at.evaluations;
    w->iterations = at.iterations;
    w->refused = at.refused;
    w->fresh = w->stalled = false;
    w->moved = 0;
    w->expanded = 0;
    const int count = s->body->carry(w, list);
    for (int i = 0; i < count; i++) memcpy(list[i], carry + (size_t)i * w->nv, w->nv * sizeof *carry);
    if (!w->carried) return;
    const double *time = carry + (size_t)count * w->nv;
    w->t = time[0];
    w->lost = time[1];
    w->next = time[2], w->before = time[3], w->rise = time[4];
    w->shortest = time[5], w->longest = time[6];
    w->span = time[7];
}

stepper_count stepper_save(const stepper *s, double *carry)
{
    if (!s->shortened) return stepper_get(s, carry);
    memcpy(carry, s->snapshot, stepper_carry(s) * sizeof *carry);
    return s->at;
}

double stepper_time_saved(const stepper *s, stepper_count at, const double *carry)
{
    return s->work.carried ? carry[stepper_carry(s) - STEPPER_CLOCKS] : stepper_time_of(s, at.steps);
}

motus_status stepper_load(stepper *s, stepper_count at, const double *carry, motus_error *err)
{
    if (at.steps < 0 || at.evaluations < 0 || at.iterations < 0)
        return fail(err, MOTUS_STATE, "the restart state has a negative counter");
    const size_t count = stepper_carry(s);
    for (size_t k = 0; k < count; k++)
        if (!isfinite(carry[k])) return fail(err, MOTUS_STATE, "number %zu of the restart state is not finite", k + 1);
    stepper_put(s, at, carry);
    s->pace_n = -1;
    s->shortened = s->arrived = s->left = s->right = false;
    s->left_steps = -1;
    s->at.steps = s->earlier_at.steps = -1;
    s->origin_known = false;
    return MOTUS_OK;
}

bool stepper_origin(const stepper *s, double *x, double *v)
{
    if (!s->origin_known) return false;
    memcpy(x, s->origin, s->work.nx * sizeof *x);
    memcpy(v, s->origin + s->work.nx, s->work.nv * sizeof *v);
    return true;
}

double stepper_leg(const stepper *s) { return s->main_t0; }

motus_status stepper_load_leg(stepper *s, double t0, double h, stepper_count at, const double *carry, motus_error *err)
{
    work *w = &s->work;
    const double t0_was = s->main_t0, h_was = s->leg_h;
    s->main_t0 = t0;
    s->leg_h = h;
    const motus_status status = stepper_load(s, at, carry, err);
    if (status) {
        s->main_t0 = t0_was;
        s->leg_h = h_was;
        return status;
    }
    w->t0 = t0;
    work_scale(w, h);
    if (s->library.solver) solver_forget(s->library.solver);
    return MOTUS_OK;
}

bool stepper_earlier(stepper *s, double *t, double *x, double *v)
{
    const bool older = s->earlier_at.steps >= 0;
    const stepper_count from = older ? s->earlier_at : s->at;
    if (s->shortened || from.steps < 0) return false;
    double *kept = take(&s->allocator, stepper_carry(s), sizeof *kept);
    if (!kept) return false;
    const bool stalled = s->work.stalled;
    const stepper_count now = stepper_get(s, kept);
    stepper_put(s, from, older ? s->earlier : s->snapshot);
    *t = time_now(&s->work);
    const motus_status status = stepper_sync(s, x, v, NULL, NULL);
    stepper_put(s, now, kept);
    s->work.stalled = stalled;
    give(&s->allocator, kept);
    return status == MOTUS_OK;
}

/* Failures -------------------------------------------------------------------------------------------------------- */

#define STEPS_TOLD 1e5 /* with a span of this many steps decimal_time has enough digits to tell two steps apart */

const char *stepper_name(const stepper *s, bool in_v, size_t k, char out[MOTUS_NAME_MAX])
{
    out[0] = 0;
    if (s->problem.name) s->problem.name(s->problem.ctx, in_v, k, out, MOTUS_NAME_MAX);
    if (!out[0]) snprintf(out, MOTUS_NAME_MAX, "%s[%zu]", in_v ? "v" : "x", k);
    return out;
}

motus_status stepper_report(const stepper *s, int bad, double t, motus_error *err)
{
    const work *w = &s->work;
    char time[DECIMAL_MAX], name[MOTUS_NAME_MAX], step[DECIMAL_MAX];
    decimal_time(t, bad == STEP_STALLED ? t : STEPS_TOLD * w->h, time);
    decimal(w->h, step);
    stepper_name(s, w->in_v, w->which, name);
    motus_status status = MOTUS_CALLBACK;
    if (bad == STEP_DIVERGED) {
        status = fail(err, MOTUS_DIVERGED, "the motion left the finite numbers at t = %s: %s is no longer finite", time,
                      name);
        hint(err, "with %s and step %s; try a smaller step, or look for a division by zero on the way", s->method.name,
             step);
    } else if (bad == STEP_SOLVE) {
        status = fail(err, MOTUS_SOLVE, "%s could not solve its implicit equation at t = %s: %s does not converge",
                      s->method.name, time, name);
        hint(err, "the step is %s; take a smaller one, for which the starting guess is nearer to the solution", step);
    } else if (bad == STEP_STALLED) {
        const bool limited = s->method.least > 0 && w->t + s->method.least != w->t;
        decimal(s->method.least, step);
        status = limited ? fail(err, MOTUS_DIVERGED, "at t = %s the tolerance needs a step shorter than %s", time, step)
                         : fail(err, MOTUS_DIVERGED, "the step that error control needs is too small to change t = %s",
                                time);
        hint(err, limited ? "allow shorter steps, or a larger error"
                          : "the motion may have a singularity there; otherwise allow a larger error");
    } else if (s->problem.returned && *s->problem.returned == 0) {
        fail(err, MOTUS_CALLBACK, "the callback reads the velocity, though its definition says that it does not");
        hint(err, "set depends_on_velocity to 1 in the definition, or do not read v");
    } else {
        const bool here = s->problem.returned && *s->problem.returned > 0;
        fail(err, MOTUS_CALLBACK,
             here ? "by its callback, the acceleration cannot be evaluated at t = %s"
                  : "the acceleration callback reported a failure at t = %s",
             time);
        if (here) hint(err, "the run is at its last good step; a smaller step may lead around the place");
    }
    if (!err) return status;
    err->time = t;
    err->returned = bad == STEP_CALLBACK && s->problem.returned ? *s->problem.returned : 0;
    if (bad != STEP_CALLBACK && bad != STEP_STALLED) snprintf(err->variable, sizeof err->variable, "%s", name);
    return status;
}

bool stepper_undefined(stepper *s, motus_error *err)
{
    work *w = &s->work;
    const size_t nx = w->nx, nv = w->nv;
    if (!stepper_ends(s)) return false;
    double *x = s->ends + nx + 2 * nv, *v = x + nx, *a = v + nv;
    s->right = false;
    if (s->body->sync(w, x, v, a)) return false;
    for (size_t k = 0; k < nv; k++) {
        if (isfinite(a[k])) continue;
        char time[DECIMAL_MAX], name[MOTUS_NAME_MAX];
        const double ended = err ? err->time : 0;
        stepper_name(s, true, k, name);
        fail(err, MOTUS_DIVERGED, "the motion is undefined at t = %s: %s has no finite rate of change there",
             decimal_time(time_now(w), time_now(w), time), name);
        hint(err, "begin elsewhere, or look for a division by zero in the equation");
        if (!err) return true;
        err->time = ended;
        snprintf(err->variable, sizeof err->variable, "%s", name);
        return true;
    }
    return false;
}

/* Observation ----------------------------------------------------------------------------------------------------- */

motus_status stepper_sync(stepper *s, double *x, double *v, double *a, motus_error *err)
{
    work *w = &s->work;
    const int bad = s->body->sync(w, x, v, a);
    if (bad) return stepper_report(s, bad, time_now(w), err);
    for (size_t k = 0; k < w->nx + w->nv; k++) {
        const bool in_v = k >= w->nx;
        const size_t at = in_v ? k - w->nx : k;
        if (isfinite(in_v ? v[at] : x[at])) continue;
        w->in_v = in_v;
        w->which = at;
        return stepper_report(s, STEP_DIVERGED, time_now(w), err);
    }
    return MOTUS_OK;
}

/* The ends of a step ---------------------------------------------------------------------------------------------- */

bool stepper_ends(stepper *s)
{
    if (!s->ends) s->ends = take(&s->allocator, 2 * (s->work.nx + 2 * s->work.nv), sizeof *s->ends);
    return s->ends != NULL;
}

static motus_status keep_end(stepper *s, int which, motus_error *err)
{
    if (!stepper_ends(s)) return fail(err, MOTUS_MEMORY, "out of memory for dense output");
    const size_t nx = s->work.nx, nv = s->work.nv;
    double *x = s->ends + (size_t)which * (nx + 2 * nv);
    /* series contain the acceleration, so it is not needed */
    return stepper_sync(s, x, x + nx, s->work.expands ? NULL : x + nx + nv, err);
}

motus_status stepper_mark(stepper *s, motus_error *err)
{
    const motus_status status = keep_end(s, 0, err);
    s->left = !status;
    s->right = false;
    s->left_t = stepper_time(s);
    s->left_lost = stepper_lost(s);
    s->left_steps = stepper_steps(s);
    return status;
}

motus_status stepper_right_end(stepper *s, motus_error *err)
{
    if (s->right) return MOTUS_OK;
    s->extended = false;
    const motus_status status = keep_end(s, 1, err);
    s->right = !status;
    return status;
}

double stepper_marked(const stepper *s, double *lost, const double **x, const double **v)
{
    *lost = s->left_lost;
    *x = s->ends, *v = *x + s->work.nx;
    return s->left_t;
}
