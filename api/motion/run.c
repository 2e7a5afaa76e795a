/* Runs: how they are made, go on, and tell their states at and between steps. See run.h. */
#include "api/motion/later.h"
#include "api/motion/locate.h"
#include "api/system/columns.h"
#include "api/system/system.h"
#include "api/motion/run_events.h"
#include "core/rows.h"

#include <math.h>
#include <string.h>

void run_leg(motus_run *r, const timing *t)
{
    r->timing = *t;
    r->legs++;
    if (r->later.waits) later_hurry(r);
}

/* ---- going on ---- */

static int tell(void *ctx, double now)
{
    motus_run *r = ctx;
    if (now - r->told < 0.01) return 0;
    r->told = now;
    return r->progress(r->context, r->timing.until != r->timing.t0
                                       ? (stepper_time(r->stepper) - r->timing.t0) / (r->timing.until - r->timing.t0)
                                       : 1);
}

static motus_status advance_located(motus_run *r, int64_t n, stepper_stop *why, motus_error *err)
{
    enum { LOOK = 64 }; /* steps between two looks at the clock */
    motus_status status = MOTUS_OK;
    *why = r->arrived ? STOP_UNTIL : STOP_STEPS;
    for (int64_t i = 0; i < n && status == MOTUS_OK && *why == STOP_STEPS; i++) {
        if (i % LOOK == 0 && r->pace.tell && r->pace.tell(r->pace.ctx, pace_now())) return MOTUS_CANCELLED;
        status = locate_step(r, why, err);
    }
    if (status != MOTUS_OK) *why = STOP_FAILED;
    return status;
}

/* Takes up to n steps more, and calls no observer. n = 0 finds out whether the run is at its end. */
static motus_status advance_on(motus_run *r, int64_t n, motus_error *err)
{
    stepper_stop why = STOP_STEPS;
    r->synchronised = r->synchronised && n == 0;
    const stepper_limit limit = {n, r->timing.until};
    const motus_status status = n > 0 && r->events   ? run_events_advance(r, n, &why, err)
                                : n > 0 && r->locate ? advance_located(r, n, &why, err)
                                : n > 0              ? pace_advance(&r->pace, r->stepper, limit, &why, err)
                                                     : stepper_advance(r->stepper, limit, &why, err);
    r->arrived = why == STOP_UNTIL || why == STOP_EVENT || (n == 0 && run_events_ended(r));
    r->halted = why == STOP_HALT;
    if (status != MOTUS_OK && status != MOTUS_CANCELLED) diagnosis_add(&r->diagnosed, r->stepper, err);
    if (status != MOTUS_OK) column_names_error(r->system, err);
    if (isnan(r->first_step) && run_steps(r) > 0) r->first_step = fabs(stepper_last_step(r->stepper));
    if (status != MOTUS_CANCELLED) return status;
    char t[DECIMAL_MAX];
    return fail(err, status, "cancelled at t = %s", run_time_text(r, stepper_time(r->stepper), t));
}

/* Takes up to n steps unless the run halts, and goes over to the compiled machine on the way. */
static motus_status advance(motus_run *r, int64_t n, motus_error *err)
{
    motus_status status = MOTUS_OK;
    r->halted = false;
    for (int64_t room; n > 0 && status == MOTUS_OK && !r->arrived && (room = later_room(r)) < n;) {
        if (room > 0) status = advance_on(r, room, err), n -= room;
        if (r->halted) return status;
        if (status == MOTUS_OK && !r->arrived) status = later_look(r, err);
    }
    return status == MOTUS_OK && (n == 0 || !r->arrived) ? advance_on(r, n, err) : status;
}

static motus_status observe(motus_run *r, motus_error *err)
{
    r->observing = true;
    const int enough = r->observer(r->context, r);
    r->observing = false;
    char t[DECIMAL_MAX];
    return enough ? fail(err, MOTUS_CANCELLED, "stopped by the observer at t = %s",
                         run_time_text(r, stepper_time(r->stepper), t))
                  : MOTUS_OK;
}

/* Takes up to n steps, in pieces from one question to the company to the next. */
static motus_status advance_beside(motus_run *r, int64_t n, motus_error *err)
{
    motus_status status = MOTUS_OK;
    while (n > 0 && status == MOTUS_OK && !r->arrived) {
        int64_t room;
        status = r->company->before(r, &room, err);
        const int64_t piece = n < room ? n : room, before = run_steps(r);
        if (status != MOTUS_OK) return status;
        status = advance(r, piece, err);
        if (status != MOTUS_OK && status != MOTUS_CANCELLED) r->company->failed(r);
        n -= r->halted ? run_steps(r) - before : piece;
    }
    return status;
}

motus_status run_step(motus_run *r, int64_t n, motus_error *err)
{
    motus_status (*const forward)(motus_run *, int64_t, motus_error *) = r->company && n > 0 ? advance_beside : advance;
    if (r->observing) return run_refuse_move(err);
    if (n == 0 || (!r->observer && !isnan(r->first_step))) return forward(r, n, err);
    /* An observer is called after every step; the first step is taken by itself, because its size is recorded. */
    motus_status status = MOTUS_OK;
    for (; n > 0 && status == MOTUS_OK && !r->arrived; n--) {
        status = forward(r, 1, err);
        if (status == MOTUS_OK && !r->observer) return forward(r, n - 1, err);
        if (status == MOTUS_OK) status = observe(r, err);
    }
    return status;
}

motus_status run_moved(motus_run *r, motus_error *err)
{
    r->synchronised = false;
    if (r->later.waits) later_hurry(r);
    return run_step(r, 0, err);
}

/* Begins at the initial state. */
static motus_status begin(motus_run *r, const motus_run_def *def, motus_error *err)
{
    const motus_system *s = r->system;
    const problem *p = &s->problem;
    if (p->nx) memcpy(r->x, s->x0, p->nx * sizeof(double));
    memcpy(r->v, s->v0, p->nv * sizeof(double));
    system_inside(s, def->x, def->v, r->x, r->v);
    if (p->refresh && r->timing.t0 != s->start) p->refresh(p->ctx, r->timing.t0, r->x, r->v);
    motus_status status =
        stepper_create(&r->machine, &r->chosen, r->timing.t0, r->timing.h, r->x, r->v, &r->allocator, &r->stepper, err);
    if (status == MOTUS_OK) stepper_judged(r->stepper, diagnosis_crawls, &r->diagnosed);
    if (status == MOTUS_OK && r->locate) status = locate_begin(r, err);
    if (status == MOTUS_OK) status = run_events_begin(r, err);
    if (status == MOTUS_OK && r->company) status = r->company->begin(r, err);
    if (status == MOTUS_OK) return run_step(r, 0, err);
    column_names_error(s, err);
    return status;
}

motus_run *run_new(motus_system *s)
{
    const size_t nx = s->problem.nx + 1, nv = s->problem.nv + 1, head = (sizeof(motus_run) + 63) / 64 * 64;
    motus_run *r = take(&s->allocator, 1, head + 2 * (nx + nv) * sizeof(double) + nv * sizeof(double));
    if (!r) return NULL;
    r->system = s;
    r->diagnosed = (diagnosed){s, NULL, run_leads};
    motus_system_hold(s, true);
    r->allocator = s->allocator;
    r->x = (double *)((char *)r + head);
    r->v = r->x + nx;
    r->a = r->v + nv;
    r->mid_x = r->a + nv;
    r->mid_v = r->mid_x + nx;
    r->note = r->not_located = r->cut = "";
    r->first_step = NAN;
    r->compiled_from = -1;
    return r;
}

motus_status run_create(motus_system *s, const motus_run_def *def, const run_hint *hint, motus_run **out,
                        motus_error *err)
{
    request q = request_of_run(s, def);
    *out = NULL;
    const motus_status status = request_choose(s, &q, err);
    return status == MOTUS_OK ? run_of(s, &q, def, hint, out, err) : status;
}

motus_status run_of(motus_system *own, const request *q, const motus_run_def *def, const run_hint *hint,
                    motus_run **out, motus_error *err)
{
    motus_system *s;
    const char *why = "";
    motus_status status = located_for(own, &q->chosen, def->switches, &s, &why, err);
    if (status != MOTUS_OK) return status;
    motus_run *r = run_new(s ? s : own);
    if (!r) return fail(err, MOTUS_MEMORY, "no memory for the run");
    s = r->system;
    if (s != own) motus_system_hold(r->home = own, true);
    r->diagnosed.home = r->home;
    r->chosen = q->chosen;
    r->card = q->card;
    r->progress = def->progress;
    r->context = def->context;
    r->observer = def->observer;
    r->pace = (pace){.seconds = 0.05, .tell = def->progress ? tell : NULL, .ctx = r};
    timing leg;
    status = run_timing(&r->chosen, q->set.step, q->set.until, q->set.from, &leg, err);
    if (status == MOTUS_OK) run_leg(r, &leg);
    if (status == MOTUS_OK && (def->threads < 0 || def->threads > MOTUS_THREADS_MAX))
        status = fail(err, MOTUS_ARGUMENT, "a run takes 1 to %d threads, not %d", MOTUS_THREADS_MAX, def->threads);
    r->chosen.threads = def->threads;
    if (status == MOTUS_OK) status = later_choose(r, def->machine, hint->steps, err);
    if (status == MOTUS_OK) status = locate_prepare(r, def->switches, err);
    r->not_located = hint->not_located ? hint->not_located : why;
    if (status == MOTUS_OK && hint->accompany) status = hint->accompany(r, def, err);
    if (r->locate) later_end(r), r->compiled_from = -1;
    if (status == MOTUS_OK) status = begin(r, def, err);
    if (status != MOTUS_OK) {
        run_destroy(r);
        return status;
    }
    *out = r;
    return MOTUS_OK;
}

void run_destroy(motus_run *r)
{
    if (!r) return;
    motus_allocator a = r->allocator;
    motus_system *const used[] = {r->system, r->home};
    later_end(r);
    stepper_destroy(r->stepper);
    locate_destroy(r);
    events_destroy(r->events);
    if (r->company) r->company->end(r);
    give(&a, r->saved);
    give(&a, r->trace);
    give(&a, r);
    motus_system_hold(used[0], false); /* last, and before its home, since that may own it */
    if (used[1]) motus_system_hold(used[1], false);
}

/* ---- observing ---- */

motus_status run_sync(motus_run *r, bool with_a, motus_error *err)
{
    if (r->synchronised && (r->with_a || !with_a)) return MOTUS_OK;
    if (r->locate && !locate_bind(r)) return fail(err, MOTUS_MEMORY, "no memory for the model's switches");
    motus_status status = stepper_sync(r->stepper, r->x, r->v, with_a ? r->a : NULL, err);
    if (status != MOTUS_OK) diagnosis_add(&r->diagnosed, r->stepper, err);
    if (status != MOTUS_OK) column_names_error(r->system, err);
    if (status == MOTUS_OK && r->events) events_keep(r->events, stepper_time(r->stepper), r->x);
    r->synchronised = status == MOTUS_OK;
    r->with_a = with_a;
    return status;
}

motus_status run_state(motus_run *r, double *x, double *v, motus_error *err)
{
    const motus_status status = run_sync(r, false, err);
    if (status == MOTUS_OK) system_outside(r->system, r->x, r->v, x, v);
    return status;
}

/* ---- legs ---- */

/* Writes the state that the leg begins with to mid_x and mid_v, in the inside order. */
static motus_status compose(motus_run *r, double t, const double *x, const double *v, motus_error *err)
{
    const problem *p = &r->system->problem;
    motus_status status = run_sync(r, false, err);
    if (status != MOTUS_OK) return status;
    memcpy(r->mid_x, r->x, p->nx * sizeof(double));
    memcpy(r->mid_v, r->v, p->nv * sizeof(double));
    system_inside(r->system, x, v, r->mid_x, r->mid_v);
    if (p->refresh) p->refresh(p->ctx, t, r->mid_x, r->mid_v);
    return MOTUS_OK;
}

motus_status run_set_state(motus_run *r, double t, const double *x, const double *v, motus_error *err)
{
    timing leg;
    const int64_t steps = run_steps(r);
    const double step = row_adaptive(&r->chosen) ? NAN : fabs(r->timing.h);
    motus_status status = run_timing(&r->chosen, step, r->timing.until, t, &leg, err);
    if (status == MOTUS_OK) status = compose(r, t, x, v, err);
    if (status == MOTUS_OK) status = stepper_start(r->stepper, leg.t0, leg.h, r->mid_x, r->mid_v, err);
    if (status != MOTUS_OK) return status;
    r->before += steps;
    run_leg(r, &leg);
    if (r->company) r->company->leg(r);
    status = r->locate ? locate_begin(r, err) : MOTUS_OK;
    if (status == MOTUS_OK) status = run_events_begin(r, err);
    if (status != MOTUS_OK) return status;
    return run_moved(r, err);
}

/* ---- between steps ---- */

/* Takes steps to the time t, and marks the last one for dense output. */
static motus_status go_to(motus_run *r, double t, motus_error *err)
{
    const double way = r->timing.h < 0 ? -1 : 1;
    if (way * (t - stepper_time(r->stepper)) <= 0) return MOTUS_OK;
    const int64_t steps = r->events ? 0 : stepper_steps_before(r->stepper, t);
    motus_status status = steps > 0 ? run_step(r, steps, err) : MOTUS_OK;
    while (status == MOTUS_OK && way * (t - stepper_time(r->stepper)) > 0 && !r->arrived) {
        status = stepper_mark(r->stepper, err);
        if (status == MOTUS_OK) status = run_step(r, 1, err);
    }
    return status;
}

/* Moves a state between steps to t itself: dense output counts from the rounded times of the step's ends (a series from
 * the first alone), of which rounding has left out up to 6e-8 s after 1e9 s. */
static motus_status bring_to_time(const motus_run *r, double t, double *x, double *v, motus_error *err)
{
    const problem *p = &r->system->problem;
    const double *from_x, *from_v;
    double lost;
    const double from = stepper_marked(r->stepper, &lost, &from_x, &from_v), to = stepper_time(r->stepper);
    if (!r->chosen.row->expands) lost += (t - from) / (to - from) * (stepper_lost(r->stepper) - lost);
    if (!isfinite(lost) || lost == 0 || !run_starts_late(&r->timing) || row_formula(&r->chosen) ||
        (r->events && events_sampled_exactly(r->events, t)))
        return MOTUS_OK;
    double *const a = take(&r->allocator, p->nv + 1, sizeof *a);
    if (!a) return fail(err, MOTUS_MEMORY, "no memory for a state between steps");
    system_later(r->system, t, -lost, x, v, a);
    give(&r->allocator, a);
    return MOTUS_OK;
}

motus_status run_between(motus_run *r, double t, double **x, double **v, motus_error *err)
{
    const double way = r->timing.h < 0 ? -1 : 1;
    char a[DECIMAL_MAX], b[DECIMAL_MAX];
    if (!isfinite(t) || way * (t - r->timing.until) > 0)
        return fail(err, MOTUS_ARGUMENT, "the time %s lies beyond the end of the run, %s", decimal(t, a),
                    decimal(r->timing.until, b));
    motus_status status = go_to(r, t, err);
    const bool here = stepper_time(r->stepper) == t;
    *x = here ? r->x : r->mid_x;
    *v = here ? r->v : r->mid_v;
    if (status != MOTUS_OK) return status;
    if (here) return run_sync(r, false, err);
    if (run_events_ended(r) && way * (t - stepper_time(r->stepper)) > 0)
        return fail(err, MOTUS_ARGUMENT, "the time %s lies beyond the end of the run, which an event ended at %s",
                    decimal(t, a), decimal(stepper_time(r->stepper), b));
    status = r->events ? run_events_sample(r, t, *x, *v, err) : stepper_sample(r->stepper, t, *x, *v, err);
    return status == MOTUS_OK ? bring_to_time(r, t, *x, *v, err) : status;
}

/* ---- what a diagnosis tries ---- */

bool run_leads(motus_system *s, const motus_run_def *def, int64_t steps)
{
    enum { PIECE = 200 };
    motus_run *r = NULL;
    motus_status status = run_create(s, def, &(run_hint){0}, &r, NULL);
    while (status == MOTUS_OK && !r->arrived && run_steps(r) < steps) status = run_step(r, PIECE, NULL);
    const bool arrived = status == MOTUS_OK && r->arrived;
    run_destroy(r);
    return arrived;
}
