/* Runs. See run.h. */
#include "api/run.h"

#include "api/choice.h"

#include "run/cache.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#define STEPS_MAX 1e15               /* between the start and `until`; a nanosecond each would be eleven days */

/* ---- creation ---- */

motus_status run_timing(const motus_system *s, const chosen *chosen, double step, double until, double start, timing *r, motus_error *err)
{
    motus_settings set = motus_default_settings();
    motus_settings_of(s, &set);
    double h = isnan(step) ? set.step : step;
    *r = (timing){.until = isnan(until) ? set.until : until, .t0 = isnan(start) ? s->start : start};
    if (isnan(h)) {
        fail(err, MOTUS_ARGUMENT, "no step is given");
        hint(err, "write `step 0.01` in the model, or --step 0.01");
        return MOTUS_ARGUMENT;
    }
    if (!isfinite(h) || !(h > 0))
        return fail(err, MOTUS_ARGUMENT, "the step is a positive number, not %g", h);
    if (isnan(r->until)) {
        fail(err, MOTUS_ARGUMENT, "no end is given");
        hint(err, "write `until 10` in the model, or --until 10");
        return MOTUS_ARGUMENT;
    }
    if (!isfinite(r->until) || !isfinite(r->t0))
        return fail(err, MOTUS_ARGUMENT, "start and end are finite numbers, not %g and %g", r->t0, r->until);
    double q = fabs(r->until - r->t0) / h;
    if (q > STEPS_MAX) {
        fail(err, MOTUS_LIMIT, "from %g to %g in steps of %g are %.3g steps; at most %.0e are taken", r->t0, r->until, h, q, STEPS_MAX);
        hint(err, "take a larger step or an earlier end");
        return MOTUS_LIMIT;
    }
    r->h = r->until < r->t0 ? -h : h;
    if (q > 0 && r->t0 + r->h == r->t0)
        return fail(err, MOTUS_ARGUMENT, "the step %g is lost beside the time %g", h, r->t0);
    /* h and the quotient are rounded: a few ulps of q decide between a whole step and a sliver. */
    double n = nearbyint(q);
    if (fabs(q - n) <= 8 * 0x1p-52 * (q + 1)) {
        r->whole = r->total = (int64_t)n;
    } else {
        r->whole = (int64_t)floor(q);
        r->total = r->whole + 1;
        r->last = r->until - (r->t0 + (double)r->whole * r->h);
    }
    if (r->last != 0 && row_uniform(chosen)) {
        fail(err, MOTUS_METHOD, "%s takes equal steps only, and the last one would be %g", chosen->name, fabs(r->last));
        hint(err, "choose a step that divides %g, or method verlet", fabs(r->until - r->t0));
        return MOTUS_METHOD;
    }
    return MOTUS_OK;
}

static motus_status plan(motus_run *r, const motus_run_def *def, motus_error *err)
{
    timing t;
    motus_status status = run_timing(r->system, &r->chosen, def->step, def->until, def->start, &t, err);
    r->t0 = t.t0;
    r->h = t.h;
    r->until = t.until;
    r->whole = t.whole;
    r->total = t.total;
    r->last = t.last;
    return status;
}

/* ---- which machine ---- */

static motus_status choose_machine(motus_run *r, const char *wanted, motus_error *err)
{
    motus_system *s = r->system;
    bool automatic, compiled;
    r->machine = s->machine;
    r->problem = &s->problem;
    r->note = "";
    motus_status status = choice_machine(wanted, &automatic, &compiled, err);
    if (status != MOTUS_OK || !s->model || !compiled)
        return status;
    const double worth = choice_worth(s, r->card, (double)r->total);
    if (automatic && worth < CHOICE_LOOK)
        return MOTUS_OK;
    const bool kept = automatic && worth < 1;
    const char *why;
    status = choice_compile(s, &r->chosen, !automatic, kept, &why, err);
    if (status == MOTUS_OK && !why) {
        r->machine = &machine_compiled;
        r->problem = &s->compiled_problem;
    } else if (status == MOTUS_OK && !kept) {
        r->note = why;
    }
    return status;
}

const char *motus_run_note(const motus_run *r) { return r ? r->note : ""; }

const char *motus_compiled_text(motus_system *s, const char *method, motus_error *err)
{
    chosen c;
    const motus_method *card;
    size_t length;
    if (!motus_error_sound(err))
        return NULL;
    if (!s || !s->model) {
        fail(err, MOTUS_ARGUMENT, "only a model from a text is compiled");
        return NULL;
    }
    if (choice_method(s, method, &c, &card, err) != MOTUS_OK)
        return NULL;
    if (!s->compiled && compiled_create(s->model, &s->problem, &s->compiled, &s->compiled_problem, err) != MOTUS_OK)
        return NULL;
    const char *text = compiled_text(s->compiled, &c, &length);
    if (!text)
        fail(err, MOTUS_MEMORY, "no memory for the text");
    return text;
}

int motus_cache_clear(void) { return cache_clear(); }

/* The initial state, inside order. */
static motus_status begin(motus_run *r, const motus_run_def *def, motus_error *err)
{
    const motus_system *s = r->system;
    const problem *p = &s->problem;
    if (p->nx)
        memcpy(r->x, s->x0, p->nx * sizeof(double));
    memcpy(r->v, s->v0, p->nv * sizeof(double));
    system_inside(s, def->x, def->v, r->x, r->v);
    if (p->refresh && r->t0 != s->start)
        p->refresh(p->ctx, r->t0, r->x, r->v);
    for (size_t k = 0; k < p->nv; k++)
        if (!isfinite(r->v[k]) || (k < p->nx && !isfinite(r->x[k])))
            return fail(err, MOTUS_ARGUMENT, "the initial state is not finite");
    return r->machine->open(r->problem, &r->chosen, r->t0, r->h, r->x, r->v, &r->allocator, &r->engine, err);
}

motus_status motus_run_create(motus_system *s, const motus_run_def *given, motus_run **out, motus_error *err)
{
    if (!motus_error_sound(err))
        return MOTUS_ARGUMENT;
    if (!out)
        return fail(err, MOTUS_ARGUMENT, "motus_run_create needs a place for the run");
    *out = NULL;
    if (!s)
        return fail(err, MOTUS_ARGUMENT, "motus_run_create needs a system");
    motus_run_def def;
    motus_status status = motus_struct_read(MOTUS_DEF_RUN, given, &def, err);
    if (status != MOTUS_OK)
        return status;
    size_t nx = s->problem.nx + 1, nv = s->problem.nv + 1;
    size_t head = (sizeof(motus_run) + 63) / 64 * 64;
    motus_run *r = take(&s->allocator, 1, head + (3 * nx + 5 * nv) * sizeof(double));
    if (!r)
        return fail(err, MOTUS_MEMORY, "no memory for the run");
    r->system = s;
    motus_system_hold(s, true);
    r->allocator = s->allocator;
    double *room = (double *)((char *)r + head);
    r->x = room;
    r->v = r->x + nx;
    r->a = r->v + nv;
    r->before_x = r->a + nv;
    r->before_v = r->before_x + nx;
    r->before_a = r->before_v + nv;
    r->mid_x = r->before_a + nv;
    r->mid_v = r->mid_x + nx;
    r->progress = def.progress;
    r->piece = 1;
    r->context = def.context;
    modes m = modes_enter();
    status = choice_method(s, def.method, &r->chosen, &r->card, err);
    if (status == MOTUS_OK)
        status = plan(r, &def, err);
    if (status == MOTUS_OK && (def.threads < 0 || def.threads > MOTUS_THREADS_MAX))
        status = fail(err, MOTUS_ARGUMENT, "a run takes 1 to %d threads, not %d", MOTUS_THREADS_MAX, def.threads);
    r->chosen.threads = def.threads;
    if (status == MOTUS_OK)
        status = choose_machine(r, def.machine, err);
    if (status == MOTUS_OK)
        status = begin(r, &def, err);
    modes_leave(m);
    if (status != MOTUS_OK) {
        motus_run_destroy(r);
        return status;
    }
    *out = r;
    return MOTUS_OK;
}

void motus_run_destroy(motus_run *r)
{
    if (!r)
        return;
    motus_allocator a = r->allocator;
    motus_system_hold(r->system, false);
    if (r->engine)
        r->machine->close(r->engine);
    if (r->tail)
        r->machine->close(r->tail);
    give(&a, r->saved);
    give(&a, r->trace);
    give(&a, r);
}

/* ---- time ---- */

static int64_t done(const motus_run *r) { return r->machine->steps(r->engine); }

double run_time(const motus_run *r)
{
    int64_t n = done(r);
    if (r->tail || n == r->total)
        return r->until;
    return r->t0 + (double)n * r->h;         /* as the engine counts it */
}

int motus_run_done(const motus_run *r) { return r && (r->tail || done(r) == r->total); }
double motus_run_time(const motus_run *r) { return r ? run_time(r) : NAN; }
double motus_run_step_size(const motus_run *r) { return r ? fabs(r->h) : NAN; }
int64_t motus_run_steps(const motus_run *r) { return r ? done(r) + (r->tail != NULL) : 0; }
int64_t motus_run_steps_total(const motus_run *r) { return r ? r->total : 0; }
double motus_run_last_step(const motus_run *r) { return r ? fabs(r->last) : 0; }
int64_t motus_run_evaluations(const motus_run *r) { return r ? r->machine->evaluations(r->engine) + r->tail_evaluations : 0; }
int64_t motus_run_iterations(const motus_run *r) { return r ? r->machine->iterations(r->engine) + r->tail_iterations : 0; }
const char *motus_run_method(const motus_run *r) { return r ? r->chosen.name : ""; }
const char *motus_run_machine(const motus_run *r) { return r ? r->machine->name : ""; }

/* ---- looking ---- */

motus_status run_sync(motus_run *r, bool with_a, motus_error *err)
{
    const machine *m = r->machine;
    if (r->synchronised && (r->with_a || !with_a))
        return MOTUS_OK;
    motus_status status = m->sync(r->tail ? r->tail : r->engine, r->x, r->v, with_a ? r->a : NULL, err);
    r->synchronised = status == MOTUS_OK;
    r->with_a = with_a;
    return status;
}

motus_status motus_run_state(motus_run *r, double *x, double *v, motus_error *err)
{
    if (!motus_error_sound(err))
        return MOTUS_ARGUMENT;
    if (!r)
        return fail(err, MOTUS_ARGUMENT, "motus_run_state needs a run");
    modes m = modes_enter();
    motus_status status = run_sync(r, false, err);
    if (status == MOTUS_OK)
        system_outside(r->system, r->x, r->v, x, v);
    modes_leave(m);
    return status;
}

motus_status motus_run_values(motus_run *r, const size_t *columns, size_t count, double *out, motus_error *err)
{
    if (!motus_error_sound(err))
        return MOTUS_ARGUMENT;
    if (!r || (count && (!columns || !out)))
        return fail(err, MOTUS_ARGUMENT, "motus_run_values needs a run, columns and a place for the values");
    modes m = modes_enter();
    motus_status status = run_sync(r, false, err);
    if (status == MOTUS_OK)
        status = system_values(r->system, run_time(r), r->x, r->v, columns, count, out, err);
    modes_leave(m);
    return status;
}

/* ---- going on ---- */

double run_now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* n whole steps; where somebody watches, in pieces of some ten milliseconds, however the caller cuts the way into calls. */
static motus_status advance(motus_run *r, int64_t n, motus_error *err)
{
    const machine *m = r->machine;
    r->synchronised = false;
    while (n > 0) {
        int64_t piece = !r->progress || n < r->piece ? n : r->piece;
        double began = r->progress ? run_now() : 0;
        motus_status status = m->advance(r->engine, piece, err);
        if (status != MOTUS_OK)
            return status;
        n -= piece;
        if (!r->progress)
            continue;
        double t = run_now(), took = t - began;
        if (took < 0.05 && piece == r->piece && piece < INT64_MAX / 4)
            r->piece *= 2;
        else if (took > 0.2 && r->piece > 1)
            r->piece /= 2;
        if (t - r->told < 0.01)
            continue;
        r->told = t;
        if (r->progress(r->context, r->total ? (double)done(r) / (double)r->total : 1))
            return fail(err, MOTUS_CANCELLED, "cancelled at t = %g", run_time(r));
    }
    return MOTUS_OK;
}

/* The shorter last step, by an engine of its own: two-step methods take it in their one-step form. `to`: NULL, or told of it. */
static motus_status finish(motus_run *r, const tracer *to, motus_error *err)
{
    const machine *m = r->machine;
    motus_status status = run_sync(r, false, err);
    if (status == MOTUS_OK)
        status = m->open(r->problem, &r->chosen, run_time(r), r->last, r->x, r->v, &r->allocator, &r->tail, err);
    if (status == MOTUS_OK)
        status = to ? m->trace(r->tail, to, err) : m->advance(r->tail, 1, err);
    if (status != MOTUS_OK) {
        if (r->tail)
            m->close(r->tail);
        r->tail = NULL;
        return status;
    }
    r->tail_evaluations = m->evaluations(r->tail);
    r->tail_iterations = m->iterations(r->tail);
    r->synchronised = false;
    return MOTUS_OK;
}

static motus_status step(motus_run *r, int64_t n, motus_error *err)
{
    int64_t left = r->whole - done(r);
    motus_status status = MOTUS_OK;
    if (n > 0 && left > 0)
        status = advance(r, n < left ? n : left, err);
    if (status == MOTUS_OK && n > left && r->last != 0 && !r->tail)
        status = finish(r, NULL, err);
    return status;
}

motus_status run_trace(motus_run *r, const tracer *to, motus_error *err)
{
    r->before = false;
    if (motus_run_done(r))
        return MOTUS_OK;
    if (done(r) == r->whole)
        return finish(r, to, err);
    r->synchronised = false;
    return r->machine->trace(r->engine, to, err);
}

motus_status motus_run_step(motus_run *r, int64_t n, motus_error *err)
{
    if (!motus_error_sound(err))
        return MOTUS_ARGUMENT;
    if (!r || n < 0)
        return fail(err, MOTUS_ARGUMENT, "motus_run_step needs a run and a number of steps that is not negative");
    modes m = modes_enter();
    r->before = false;
    motus_status status = step(r, n, err);
    modes_leave(m);
    return status;
}

motus_status motus_run_finish(motus_run *r, motus_error *err) { return motus_run_step(r, INT64_MAX, err); }

/* ---- between steps ---- */

/* The quintic polynomial through x, v, a at both ends, u in [0, 1] of a step k; the velocity is its derivative. */
static void quintic(double k, double u, double end[2][3], double *x, double *v)
{
    double d = end[1][0] - end[0][0], p = k * end[0][1], q = k * end[1][1], a = k * k * end[0][2], b = k * k * end[1][2];
    double c2 = a / 2, r0 = d - p - c2, r1 = q - p - a, r2 = b - a;
    double c3 = 10 * r0 - 4 * r1 + r2 / 2, c4 = -15 * r0 + 7 * r1 - r2, c5 = 6 * r0 - 3 * r1 + r2 / 2;
    *x = end[0][0] + u * (p + u * (c2 + u * (c3 + u * (c4 + u * c5))));
    *v = (p + u * (2 * c2 + u * (3 * c3 + u * (4 * c4 + u * 5 * c5)))) / k;
}

/* A companion has value and rate at both ends: the cubic. */
static double cubic(double k, double u, double s0, double a0, double s1, double a1)
{
    double d = s1 - s0, p = k * a0, q = k * a1;
    return s0 + u * (p + u * (3 * d - 2 * p - q + u * (p + q - 2 * d)));
}

static void between(motus_run *r, double t)
{
    const problem *p = &r->system->problem;
    double k = run_time(r) - r->before_t, u = (t - r->before_t) / k;
    for (size_t i = 0; i < p->nv; i++) {
        if (i >= p->nx) {
            r->mid_v[i] = cubic(k, u, r->before_v[i], r->before_a[i], r->v[i], r->a[i]);
            continue;
        }
        double end[2][3] = {{r->before_x[i], r->before_v[i], r->before_a[i]}, {r->x[i], r->v[i], r->a[i]}};
        quintic(k, u, end, &r->mid_x[i], &r->mid_v[i]);
    }
    if (p->refresh)
        p->refresh(p->ctx, t, r->mid_x, r->mid_v);
}

static motus_status keep_before(motus_run *r, motus_error *err)
{
    const problem *p = &r->system->problem;
    motus_status status = run_sync(r, true, err);
    if (status != MOTUS_OK)
        return status;
    r->before_t = run_time(r);
    memcpy(r->before_x, r->x, p->nx * sizeof(double));
    memcpy(r->before_v, r->v, p->nv * sizeof(double));
    memcpy(r->before_a, r->a, p->nv * sizeof(double));
    r->before = true;
    return MOTUS_OK;
}

static motus_status go_to(motus_run *r, double t, motus_error *err)
{
    double way = r->h < 0 ? -1 : 1, at = run_time(r);
    if (way * (t - at) <= 0)
        return MOTUS_OK;
    /* To the last step before t, then one more. */
    double q = floor((t - r->t0) / r->h);
    int64_t n = q >= (double)r->whole ? r->whole : (int64_t)q;
    if (way * (r->t0 + (double)n * r->h - t) > 0)
        n--;                         /* the quotient was rounded up */
    if (n > done(r)) {
        r->before = false;
        motus_status status = step(r, n - done(r), err);
        if (status != MOTUS_OK)
            return status;
    }
    while (way * (t - run_time(r)) > 0 && !motus_run_done(r)) {
        motus_status status = keep_before(r, err);
        if (status == MOTUS_OK)
            status = step(r, 1, err);
        if (status != MOTUS_OK)
            return status;
    }
    return MOTUS_OK;
}

static motus_status sample(motus_run *r, const double *times, size_t n, const size_t *columns, size_t count, double *out, motus_error *err)
{
    double way = r->h < 0 ? -1 : 1;
    for (size_t i = 0; i < n; i++, out += count) {
        double t = times[i];
        if (!isfinite(t) || way * (t - r->until) > 0)
            return fail(err, MOTUS_ARGUMENT, "the time %g lies beyond the end of the run, %g", t, r->until);
        motus_status status = go_to(r, t, err);
        if (status != MOTUS_OK)
            return status;
        if (way * (run_time(r) - t) > 0 && (!r->before || way * (t - r->before_t) < 0))
            return fail(err, MOTUS_ARGUMENT, "the time %g lies behind the run, which is at %g", t, run_time(r));
        bool here = run_time(r) == t;
        status = run_sync(r, !here, err);
        if (status != MOTUS_OK)
            return status;
        if (!here)
            between(r, t);
        status = system_values(r->system, t, here ? r->x : r->mid_x, here ? r->v : r->mid_v, columns, count, out, err);
        if (status != MOTUS_OK)
            return status;
    }
    return MOTUS_OK;
}

motus_status motus_run_sample(motus_run *r, const double *times, size_t n, const size_t *columns, size_t count, double *out, motus_error *err)
{
    if (!motus_error_sound(err))
        return MOTUS_ARGUMENT;
    if (!r || (n && !times) || (count && (!columns || !out)))
        return fail(err, MOTUS_ARGUMENT, "motus_run_sample needs a run, times, columns and a place for the values");
    modes m = modes_enter();
    motus_status status = sample(r, times, n, columns, count, out, err);
    modes_leave(m);
    return status;
}
