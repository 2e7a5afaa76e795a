/* Runs. See run.h. */
#include "api/bars.h"
#include "api/locate.h"
#include "api/located.h"
#include "api/run_events.h"
#include "core/rows.h"

#include "api/choice.h"
#include "api/control.h"
#include "api/diagnosis.h"
#include "api/goal.h"
#include "api/later.h"
#include "api/suggest.h"

#include "machine/cache.h"

#include <math.h>
#include <string.h>

#define STEPS_MAX 1e15 /* from the start to `until`: eleven days at a nanosecond a step */

/* ---- creation ---- */

motus_status run_timing(const motus_system *s, const chosen *chosen, double step, double until, double start,
                        timing *out, motus_error *err)
{
    motus_settings set = motus_default_settings();
    motus_settings_of(s, &set);
    const bool adaptive = row_adaptive(chosen);
    double h = adaptive ? 1 : isnan(step) ? set.step : step; /* adaptive: its sign is the direction */
    *out = (timing){.until = isnan(until) ? set.until : until, .t0 = isnan(start) ? s->start : start};
    if (isnan(h)) {
        fail(err, MOTUS_ARGUMENT, "no step is given");
        hint(err, "give `step = 0.01` of the definition; motus_suggest finds one");
        return MOTUS_ARGUMENT;
    }
    if (!isfinite(h) || !(h > 0)) return fail(err, MOTUS_ARGUMENT, "the step is a positive number, not %g", h);
    if (isnan(out->until)) {
        fail(err, MOTUS_ARGUMENT, "no end is given");
        hint(err, "give `until = 10` of the definition; motus_suggest finds one");
        return MOTUS_ARGUMENT;
    }
    if (!isfinite(out->until) || !isfinite(out->t0))
        return fail(err, MOTUS_ARGUMENT, "start and end are finite numbers, not %g and %g", out->t0, out->until);
    if (adaptive) {
        out->h = copysign(fmax(1, fabs(out->t0)), out->until - out->t0);
        out->whole = INT64_MAX;
        return MOTUS_OK;
    }
    double q = fabs(out->until - out->t0) / h;
    if (q > STEPS_MAX) {
        fail(err, MOTUS_LIMIT, "from %g to %g in steps of %g are %.3g steps; at most %.0e are taken", out->t0,
             out->until, h, q, STEPS_MAX);
        hint(err, "take a larger step or an earlier end");
        return MOTUS_LIMIT;
    }
    char t[DECIMAL_MAX];
    out->h = out->until < out->t0 ? -h : h;
    if (q > 0 && out->t0 + out->h == out->t0)
        return fail(err, MOTUS_ARGUMENT, "the step %g is lost beside the time %s", h, decimal(out->t0, t));
    const stepper_way way = stepper_way_of(out->t0, out->h, out->until);
    out->whole = way.whole;
    out->last = way.last;
    out->total = way.whole + (way.last != 0);
    if (out->whole > 0 && out->last != 0 && row_uniform(chosen)) {
        fail(err, MOTUS_METHOD, "%s takes equal steps only, and the last one would be %g", chosen->name,
             fabs(out->last));
        hint(err, "choose a step that divides %g, or method verlet", fabs(out->until - out->t0));
        return MOTUS_METHOD;
    }
    return MOTUS_OK;
}

void run_leg(motus_run *r, const timing *t)
{
    r->timing = *t;
    r->legs++;
    if (r->later.waits) later_hurry(r);
}

/* ---- the text of the compiled machine ---- */

const char *motus_compiled_text(motus_system *s, const char *method, motus_error *err)
{
    motus_run_def def = motus_default_run();
    def.method = method;
    return motus_run_text(s, &def, err);
}

const char *motus_run_text(motus_system *s, const motus_run_def *given, motus_error *err)
{
    chosen c;
    const motus_method *card;
    motus_run_def def;
    size_t length;
    if (!motus_error_sound(err) || motus_struct_read(MOTUS_DEF_RUN, given, &def, err) != MOTUS_OK) return NULL;
    if (!s || !s->model) {
        fail(err, MOTUS_ARGUMENT, "only a model from a text is compiled");
        return NULL;
    }
    const control_wish wish = control_wish_of_run(&def);
    if (choice_method(s, def.method, &c, &card, err) != MOTUS_OK || control_choose(s, &wish, &c, err) != MOTUS_OK)
        return NULL;
    if (!s->compiled && compiled_create(s->model, &s->problem, &s->compiled, err) != MOTUS_OK) return NULL;
    const char *text = compiled_text(s->compiled, &c, &length);
    if (!text) fail(err, MOTUS_MEMORY, "no memory for the text");
    return text;
}

int motus_cache_clear(void) { return cache_clear(); }

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

/* Up to n steps more, without calling the observer; n = 0 finds out whether the run is at its end. */
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
    if (status != MOTUS_OK && status != MOTUS_CANCELLED) diagnosis_add(r->system, r->home, r->stepper, err);
    if (isnan(r->first_step) && motus_run_steps(r) > 0) r->first_step = fabs(stepper_last_step(r->stepper));
    if (status != MOTUS_CANCELLED) return status;
    char t[DECIMAL_MAX];
    return fail(err, status, "cancelled at t = %s", run_time_text(r, stepper_time(r->stepper), t));
}

/* The same, until it halts, and on the way it goes over to the compiled machine. */
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

motus_status run_refuse_move(motus_error *err)
{
    fail(err, MOTUS_ARGUMENT, "an observer cannot step, restore or set its run");
    hint(err, "return a value other than 0, and change the run after the call that stepped it");
    return MOTUS_ARGUMENT;
}

motus_status run_refuse(const motus_run *r, const char *what, motus_error *err)
{
    return r->locate ? fail(err, MOTUS_UNAVAILABLE, "a run that locates switches cannot be %s", what) : MOTUS_OK;
}

motus_status run_refuse_beyond(const motus_run *r, double t, motus_error *err)
{
    char a[DECIMAL_MAX], b[DECIMAL_MAX];
    return fail(err, MOTUS_STATE, "the restart state is at t = %s, beyond the end of this run, %s", decimal(t, a),
                decimal(r->timing.until, b));
}

/* The same, with companions for bars of error: in pieces from one landing to the next. */
static motus_status advance_beside(motus_run *r, int64_t n, motus_error *err)
{
    motus_status status = MOTUS_OK;
    while (n > 0 && status == MOTUS_OK && !r->arrived) {
        int64_t room;
        status = bars_room(r, &room, err);
        const int64_t piece = n < room ? n : room, before = motus_run_steps(r);
        if (status != MOTUS_OK) return status;
        status = advance(r, piece, err);
        if (status != MOTUS_OK && status != MOTUS_CANCELLED) bars_give_up(r, "the run failed");
        n -= r->halted ? motus_run_steps(r) - before : piece;
    }
    return status;
}

static motus_status go_on(motus_run *r, int64_t n, motus_error *err)
{
    motus_status (*const forward)(motus_run *, int64_t, motus_error *) = r->bars && n > 0 ? advance_beside : advance;
    if (r->observing) return run_refuse_move(err);
    if (n > 0 && goal_arrive(r, n)) return MOTUS_OK;
    if (n == 0 || (!r->observer && !isnan(r->first_step))) return forward(r, n, err);
    /* One step at a time where an observer is called; and the first step by itself, because its size is recorded. */
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
    return go_on(r, 0, err);
}

/* The initial state, inside order. */
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
    if (status == MOTUS_OK) stepper_judged(r->stepper, diagnosis_crawls, r->system);
    if (status == MOTUS_OK && r->locate) status = locate_begin(r, err);
    if (status == MOTUS_OK) status = run_events_begin(r, err);
    if (status == MOTUS_OK && r->bars) status = witness_create(r, &r->bars->differences, false, &r->bars->witness, err);
    return status == MOTUS_OK ? go_on(r, 0, err) : status;
}

motus_run *run_new(motus_system *s)
{
    const size_t nx = s->problem.nx + 1, nv = s->problem.nv + 1, head = (sizeof(motus_run) + 63) / 64 * 64;
    motus_run *r = take(&s->allocator, 1, head + 2 * (nx + nv) * sizeof(double) + nv * sizeof(double));
    if (!r) return NULL;
    r->system = s;
    motus_system_hold(s, true);
    r->allocator = s->allocator;
    r->x = (double *)((char *)r + head);
    r->v = r->x + nx;
    r->a = r->v + nv;
    r->mid_x = r->a + nv;
    r->mid_v = r->mid_x + nx;
    r->first_step = NAN;
    r->compiled_from = -1;
    return r;
}

motus_status run_create(motus_system *s, const motus_run_def *complete, const run_hint *hint, motus_run **out,
                        motus_error *err)
{
    motus_run_def def = *complete;
    motus_status status;
    *out = NULL;
    chosen method;
    const motus_method *card;
    motus_system *own = s;
    const control_wish wish = control_wish_of_run(&def);
    status = choice_method(s, def.method, &method, &card, err);
    if (status == MOTUS_OK) status = control_choose(s, &wish, &method, err);
    if (status == MOTUS_OK) status = suggest_missing(s, &method, def.method, def.start, &def.step, &def.until, err);
    const char *why = "";
    if (status == MOTUS_OK) status = located_for(own, &method, def.switches, &s, &why, err);
    if (status != MOTUS_OK) return status;
    motus_run *r = run_new(s ? s : own);
    if (!r) return fail(err, MOTUS_MEMORY, "no memory for the run");
    s = r->system;
    if (s != own) motus_system_hold(r->home = own, true);
    r->chosen = method;
    r->card = card;
    r->progress = def.progress;
    r->context = def.context;
    r->observer = def.observer;
    r->pace = (pace){.seconds = 0.05, .tell = def.progress ? tell : NULL, .ctx = r};
    timing leg;
    status = run_timing(s, &r->chosen, def.step, def.until, def.start, &leg, err);
    if (status == MOTUS_OK) run_leg(r, &leg);
    if (status == MOTUS_OK && (def.threads < 0 || def.threads > MOTUS_THREADS_MAX))
        status = fail(err, MOTUS_ARGUMENT, "a run takes 1 to %d threads, not %d", MOTUS_THREADS_MAX, def.threads);
    r->chosen.threads = def.threads;
    if (status == MOTUS_OK) status = later_choose(r, def.machine, hint->steps, err);
    if (status == MOTUS_OK) status = locate_prepare(r, def.switches, err);
    r->not_located = hint && hint->not_located ? hint->not_located : why;
    if (status == MOTUS_OK) status = bars_prepare(r, &def, err);
    if (r->locate) later_end(r), r->compiled_from = -1;
    if (status == MOTUS_OK && r->bars) r->bars->kept = r->kept;
    if (status == MOTUS_OK) status = begin(r, &def, err);
    if (status != MOTUS_OK) {
        motus_run_destroy(r);
        return status;
    }
    *out = r;
    return MOTUS_OK;
}

motus_status motus_run_create(motus_system *s, const motus_run_def *given, motus_run **out, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!out) return fail(err, MOTUS_ARGUMENT, "motus_run_create needs a place for the run");
    *out = NULL;
    if (!s) return fail(err, MOTUS_ARGUMENT, "motus_run_create needs a system");
    motus_run_def def;
    run_hint hint = {0};
    struct goal *goal = NULL;
    motus_status status = motus_struct_read(MOTUS_DEF_RUN, given, &def, err);
    if (status != MOTUS_OK) return status;
    modes m = modes_enter();
    status = goal_reach(s, &def, &hint, &goal, err);
    if (status == MOTUS_OK) status = run_create(s, &def, &hint, out, err);
    if (*out)
        (*out)->goal = goal;
    else
        goal_destroy(s, goal);
    modes_leave(m);
    return status;
}

void motus_run_destroy(motus_run *r)
{
    if (!r) return;
    motus_allocator a = r->allocator;
    motus_system_hold(r->system, false);
    if (r->home) motus_system_hold(r->home, false);
    later_end(r);
    stepper_destroy(r->stepper);
    locate_destroy(r);
    events_destroy(r->events);
    bars_destroy(r);
    goal_destroy(r->system, r->goal);
    give(&a, r->saved);
    give(&a, r->trace);
    give(&a, r);
}

/* ---- time ---- */

int motus_run_done(const motus_run *r) { return r && r->arrived; }
double motus_run_time(const motus_run *r) { return r ? stepper_time(r->stepper) : NAN; }
double motus_run_time_of(const motus_run *r, int64_t step)
{
    if (!r || step < 0 || (row_adaptive(&r->chosen) && step < INT64_MAX)) return NAN;
    if (r->events && step < r->timing.total) return r->timing.t0 + (double)step * r->timing.h;
    return step >= r->timing.total ? r->timing.until
                                   : stepper_time_of(r->stepper, step - (r->locate ? locate_steps(r) : 0));
}

double motus_run_step_size(const motus_run *r) { return r && !row_adaptive(&r->chosen) ? fabs(r->timing.h) : NAN; }
int64_t motus_run_steps(const motus_run *r)
{
    if (r && r->events) return events_steps(r->events);
    return r ? stepper_steps(r->stepper) + (r->locate ? locate_steps(r) : 0) : 0;
}
int64_t motus_run_steps_total(const motus_run *r) { return r ? r->timing.total : 0; }
double motus_run_last_step(const motus_run *r) { return r ? fabs(r->timing.last) : 0; }
int64_t motus_run_evaluations(const motus_run *r) { return r ? stepper_evaluations(r->stepper) : 0; }
int64_t motus_run_iterations(const motus_run *r) { return r ? stepper_iterations(r->stepper) : 0; }
const char *motus_run_method(const motus_run *r) { return r ? r->chosen.name : ""; }
const char *motus_run_machine(const motus_run *r) { return r ? r->machine.name : ""; }

/* ---- observing ---- */

char *run_time_text(const motus_run *r, double t, char out[DECIMAL_MAX])
{
    return decimal_time(t, r->timing.until - r->timing.t0, out);
}

motus_status run_sync(motus_run *r, bool with_a, motus_error *err)
{
    if (r->synchronised && (r->with_a || !with_a)) return MOTUS_OK;
    if (r->locate && !locate_bind(r)) return fail(err, MOTUS_MEMORY, "no memory for the model's switches");
    motus_status status = stepper_sync(r->stepper, r->x, r->v, with_a ? r->a : NULL, err);
    if (status != MOTUS_OK) diagnosis_add(r->system, r->home, r->stepper, err);
    if (status == MOTUS_OK && r->events) events_keep(r->events, stepper_time(r->stepper), r->x);
    r->synchronised = status == MOTUS_OK;
    r->with_a = with_a;
    return status;
}

motus_status motus_run_state(motus_run *r, double *x, double *v, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!r) return fail(err, MOTUS_ARGUMENT, "motus_run_state needs a run");
    modes m = modes_enter();
    motus_status status = run_sync(r, false, err);
    if (status == MOTUS_OK) system_outside(r->system, r->x, r->v, x, v);
    modes_leave(m);
    return status;
}

motus_status motus_run_values(motus_run *r, const size_t *columns, size_t count, double *out, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!r || (count && (!columns || !out)))
        return fail(err, MOTUS_ARGUMENT, "motus_run_values needs a run, columns and a place for the values");
    modes m = modes_enter();
    motus_status status = run_sync(r, false, err);
    if (status == MOTUS_OK)
        status = system_values(r->system, stepper_time(r->stepper), r->x, r->v, columns, count, out, err);
    modes_leave(m);
    return status;
}

/* ---- steps ---- */

motus_status motus_run_step(motus_run *r, int64_t n, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!r || n < 0)
        return fail(err, MOTUS_ARGUMENT, "motus_run_step needs a run and a number of steps that is not negative");
    modes m = modes_enter();
    motus_status status = go_on(r, n, err);
    if (status == MOTUS_OK) status = goal_judge(r, err);
    modes_leave(m);
    return status;
}

motus_status motus_run_finish(motus_run *r, motus_error *err) { return motus_run_step(r, INT64_MAX, err); }

/* ---- between steps ---- */

/* The step that leads there is marked for dense output. */
static motus_status go_to(motus_run *r, double t, motus_error *err)
{
    const double way = r->timing.h < 0 ? -1 : 1;
    if (way * (t - stepper_time(r->stepper)) <= 0) return MOTUS_OK;
    const int64_t steps = r->events ? 0 : stepper_steps_before(r->stepper, t);
    motus_status status = steps > 0 ? go_on(r, steps, err) : MOTUS_OK;
    while (status == MOTUS_OK && way * (t - stepper_time(r->stepper)) > 0 && !r->arrived) {
        status = stepper_mark(r->stepper, err);
        if (status == MOTUS_OK) status = go_on(r, 1, err);
    }
    return status;
}

bool run_starts_late(const timing *t)
{
    enum { FAR = 64 };
    return fabs(t->t0) > FAR * fabs(t->until - t->t0);
}

/* Dense output counts from the time at which the step begins, a series alone, others to that at which it ends; of both
 * rounding has left out up to 6e-8 s after 1e9 s, and the state is as much later. */
static motus_status bring_to_time(const motus_run *r, double t, double *x, double *v, motus_error *err)
{
    const problem *p = &r->system->problem;
    const double *from_x, *from_v;
    double lost;
    const double from = stepper_marked(r->stepper, &lost, &from_x, &from_v), to = stepper_time(r->stepper);
    if (!r->chosen.row->expands) lost += (t - from) / (to - from) * (stepper_lost(r->stepper) - lost);
    if (!isfinite(lost) || lost == 0 || !run_starts_late(&r->timing) || !strcmp(r->card->family, "exact") ||
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

static motus_status sample(motus_run *r, const double *times, size_t n, const size_t *columns, size_t count,
                           double *out, motus_error *err)
{
    motus_status status = MOTUS_OK;
    for (size_t i = 0; i < n && status == MOTUS_OK; i++, out += count) {
        double *x = NULL, *v = NULL;
        status = run_between(r, times[i], &x, &v, err);
        if (status == MOTUS_OK) status = system_values(r->system, times[i], x, v, columns, count, out, err);
    }
    return status;
}

motus_status motus_run_sample(motus_run *r, const double *times, size_t n, const size_t *columns, size_t count,
                              double *out, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!r || (n && !times) || (count && (!columns || !out)))
        return fail(err, MOTUS_ARGUMENT, "motus_run_sample needs a run, times, columns and a place for the values");
    motus_status status = r->locate ? run_refuse(r, "sampled between steps", err) : MOTUS_OK;
    if (status != MOTUS_OK) return status;
    modes m = modes_enter();
    status = sample(r, times, n, columns, count, out, err);
    modes_leave(m);
    return status;
}
