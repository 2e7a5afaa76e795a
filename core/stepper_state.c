/* The state of a stepper: time and counters, the carried numbers, observation, dense output. See stepper.h. */
#include "core/stepper_parts.h"

#include "step/swing.h"

#include <math.h>
#include <string.h>

double stepper_time(const stepper *s) { return s->arrived ? s->until : time_now(&s->work); }
double stepper_lost(const stepper *s)
{
    const work *w = &s->work;
    if (s->arrived) return 0;
    if (w->carried) return w->lost;
    const double n = (double)w->n, t = time_now(w), product = n * w->h, rest = fma(n, w->h, -product);
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
    w->n = at.steps; /* first: what is carried depends on it */
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

/* The mark of dense output goes along, because it may be for the next step. */
static void move_ends(stepper *from, stepper *to)
{
    to->ends = from->ends;
    from->ends = NULL;
    to->left = from->left;
    to->right = from->right;
    to->left_t = from->left_t;
    to->left_lost = from->left_lost;
    to->left_steps = from->left_steps;
}

motus_status stepper_move(stepper **s, const machine *m, motus_error *err)
{
    stepper *from = *s, *to = NULL;
    const size_t nx = from->work.nx, nv = from->work.nv;
    double *x = take(&from->allocator, nx + nv + stepper_carry(from), sizeof *x), *carry = x + nx + nv;
    if (!x) return fail(err, MOTUS_MEMORY, "out of memory for the state");
    motus_status status = stepper_sync(from, x, x + nx, NULL, err);
    if (!status)
        status = stepper_create(m, &from->method, from->main_t0, from->leg_h, x, x + nx, &from->allocator, &to, err);
    if (!status) status = stepper_load(to, stepper_save(from, carry), carry, err);
    give(&from->allocator, x);
    if (status) {
        stepper_destroy(to);
        return status;
    }
    move_ends(from, to);
    to->work.h = from->work.h;
    to->pace_n = from->pace_n, to->pace_t = from->pace_t;
    to->judge = from->judge, to->judge_ctx = from->judge_ctx;
    to->inspector = from->inspector, to->inspector_ctx = from->inspector_ctx, to->rest = from->rest;
    to->at = from->at, to->earlier_at = from->earlier_at;
    to->origin_known = stepper_origin(from, to->origin, to->origin + nx);
    memcpy(to->snapshot, from->snapshot, stepper_carry(from) * sizeof *to->snapshot);
    if (from->earlier) memcpy(to->earlier, from->earlier, stepper_carry(from) * sizeof *to->earlier);
    *s = to;
    stepper_destroy(from);
    return MOTUS_OK;
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

/* Dense output ---------------------------------------------------------------------------------------------------- */

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
    /* series have the acceleration among their terms, and nobody asks for it */
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

double stepper_marked(const stepper *s, double *lost, const double **x, const double **v)
{
    *lost = s->left_lost;
    *x = s->ends, *v = *x + s->work.nx;
    return s->left_t;
}

/* The room that the family's dense output needs besides the ends, with its constants. */
static motus_status make_room(stepper *s, motus_error *err)
{
    const work *w = &s->work;
    s->room = s->body->between(w, NULL);
    const size_t arrays = (size_t)s->room.arrays * w->stride;
    s->inside = take(&s->allocator, arrays + s->room.constants + 1, sizeof *s->inside);
    if (!s->inside) return fail(err, MOTUS_MEMORY, "out of memory for dense output");
    s->body->between(w, s->inside + arrays);
    return MOTUS_OK;
}

static dense_step last_step(const stepper *s)
{
    const size_t nx = s->work.nx, nv = s->work.nv, apart = nx + 2 * nv;
    const double *e = s->ends;
    return (dense_step){
        .end = {{s->left_t, e, e + nx, e + nx + nv}, {stepper_time(s), e + apart, e + apart + nx, e + apart + nx + nv}},
        .more = s->inside,
        .unit = s->inside + (size_t)s->room.arrays * s->work.stride};
}

/* Whether t lies between the mark and the present time. */
static bool marked(const stepper *s, double t)
{
    const double way = s->leg_h < 0 ? -1 : 1;
    return s->left && way * (t - s->left_t) >= 0 && way * (stepper_time(s) - t) >= 0;
}

/* The right end of the last step, once. */
static motus_status take_right_end(stepper *s, motus_error *err)
{
    if (s->right) return MOTUS_OK;
    s->extended = false;
    const motus_status status = keep_end(s, 1, err);
    s->right = !status;
    return status;
}

static bool swing_by_ends(stepper *s, double *most)
{
    const work *w = &s->work;
    if (take_right_end(s, NULL)) return false;
    const size_t nx = w->nx, nv = w->nv;
    const double *from = s->ends, *to = from + nx + 2 * nv;
    swing_of_ends(nx, nv, w->h, from, from + nx, from + nx + nv, to, to + nx, to + nx + nv, most);
    return true;
}

bool stepper_swing(stepper *s, double *most)
{
    const work *w = &s->work;
    if (!s->left || s->left_steps != stepper_steps(s) - 1) return false;
    if (row_bounded_by_ends(&s->method)) return swing_by_ends(s, most);
    for (size_t k = 0; k < w->nv; k++) most[k] = w->expands ? 0 : fabs(s->ends[w->nx + w->nv + k]);
    return s->body->swing(w, most);
}

int64_t stepper_steps_before(const stepper *s, double t)
{
    const work *w = &s->work;
    if (w->carried || s->arrived) return 0;
    const stepper_way way = stepper_way_of(w->t0, w->h, s->until);
    const double q = floor((t - w->t0) / w->h), sign = w->h < 0 ? -1 : 1;
    int64_t n = q >= (double)way.whole ? way.whole : (int64_t)q;
    if (sign * (stepper_time_of(s, n) - t) > 0) n--; /* the quotient was rounded up */
    return n > w->n ? n - w->n : 0;
}

motus_status stepper_sample(stepper *s, double t, double *x, double *v, motus_error *err)
{
    motus_status status =
        marked(s, t) || (s->left && s->left_steps == stepper_steps(s) - 1) ? MOTUS_OK : stepper_again(s, err);
    if (status) return status;
    if (!marked(s, t)) {
        char a[DECIMAL_MAX], b[DECIMAL_MAX];
        fail(err, MOTUS_ARGUMENT, "the time %s lies before the last step of the run, which is at %s", decimal(t, a),
             decimal(stepper_time(s), b));
        hint(err, "give times within the last step or after it");
        return MOTUS_ARGUMENT;
    }
    status = take_right_end(s, err);
    if (!status && !s->inside) status = make_room(s, err);
    if (status) return status;
    const dense_step step = last_step(s);
    const int bad = s->extended ? STEP_OK : s->body->extend(&s->work, &step);
    s->extended = !bad;
    if (bad || (s->body->dense(&s->work, &step, t, x, v))) return stepper_report(s, STEP_CALLBACK, t, err);
    if (s->problem.refresh) s->problem.refresh(s->problem.ctx, t, x, v);
    return MOTUS_OK;
}
