/* One trajectory at a time, by any method and machine. See ensemble.h.
 *
 * Invariant: a trajectory has the bits of a run with its values, unless a witness objects, and is observed at the same
 * steps as in lanes. Afterwards the system has its own numbers again.
 */
#include "api/error/bars.h"
#include "api/ensemble/ensemble_single.h"
#include "api/error/event_bars.h"
#include "api/motion/run_events.h"
#include "api/system/symmetry.h"

#include "core/course.h"
#include "machine/reduction.h"

#include <math.h>
#include <string.h>

static motus_status observe(void *ctx, motus_error *err)
{
    trajectory *s = ctx;
    const motus_ensemble *e = s->w->e;
    const double t = stepper_time(s->w->stepper);
    motus_status status = s->errors ? bars_observe(s->w->run, err) : MOTUS_OK;
    if (status == MOTUS_OK) status = stepper_sync(s->w->stepper, s->x, s->v, NULL, err);
    if (status == MOTUS_OK && s->w->events) events_keep(s->w->events, t, s->x);
    if (status == MOTUS_OK)
        status = system_values(s->w->system, t, s->x, s->v, s->columns, e->record_count, s->now, err);
    for (size_t r = 0; r < e->record_count && status == MOTUS_OK; r++)
        if (ensemble_tallies(&e->records[r]))
            continue;
        else if (s->observations == 0)
            reduce_first(s->kept + r * REDUCE_KEPT, s->now[r], t);
        else
            reduce_next(s->kept + r * REDUCE_KEPT, (int)e->records[r].how, s->now[r], t);
    s->observations++;
    return status;
}

/* ---- the model's own numbers, which the values of trajectories replace ---- */

static size_t numbers_kept(const motus_ensemble *e)
{
    const model *m = e->system->model;
    return m && e->vary_count ? m->pool_count + m->nx + m->nv : 0;
}

static void keep_numbers(const motus_ensemble *e, double *room)
{
    const model *m = e->system->model;
    memcpy(room, m->pool, m->pool_count * sizeof *room);
    memcpy(room + m->pool_count, m->x0, m->nx * sizeof *room);
    memcpy(room + m->pool_count + m->nx, m->v0, m->nv * sizeof *room);
}

/* Cannot fail, because binding for a second time takes no memory. */
static void put_back(motus_ensemble *e, const double *room)
{
    model *m = e->system->model;
    memcpy(m->pool, room, m->pool_count * sizeof *room);
    system_rebind(e->system);
    memcpy(m->x0, room + m->pool_count, m->nx * sizeof *room);
    memcpy(m->v0, room + m->pool_count + m->nx, m->nv * sizeof *room);
    e->system->judged_gyroscopic = false;
}

/* ---- a trajectory ---- */

motus_status ensemble_single_numbers(trajectory *s, motus_error *err)
{
    const worker *w = s->w;
    const bool given = !w->system->model || !w->e->vary_count;
    return given || (vary_apply(w->vary, s->values) && system_rebind(w->system))
               ? MOTUS_OK
               : fail(err, MOTUS_MEMORY, "no memory for a trajectory");
}

/* Sets the values of trajectory k and computes its initial state. */
static motus_status start(trajectory *s, const double *const *values, size_t k, motus_error *err)
{
    motus_ensemble *e = s->w->e;
    motus_system *y = s->w->system;
    for (size_t i = 0; i < e->vary_count; i++) s->values[i] = values[i][k];
    if (y->model && e->vary_count) {
        const motus_status set = ensemble_single_numbers(s, err);
        if (set != MOTUS_OK) return set;
        /* whether the velocity term does no work is judged for these parameters */
        if (e->chosen.row->gyroscopic) {
            y->judged_gyroscopic = false;
            if (!symmetry_gyroscopic(y)) return fail(err, MOTUS_MEMORY, "no memory to examine the velocity term");
            motus_status status = row_admits(&e->chosen, &y->problem.traits, err);
            if (status != MOTUS_OK) return status;
        }
    }
    if (y->problem.nx) memcpy(s->x, y->x0, y->problem.nx * sizeof(double));
    memcpy(s->v, y->v0, y->problem.nv * sizeof(double));
    for (size_t i = 0; i < e->vary_count && !y->model; i++)
        *(e->places[i] < y->problem.nx ? &s->x[e->places[i]] : &s->v[e->places[i] - y->problem.nx]) = s->values[i];
    for (size_t i = 0; i < y->problem.nv; i++)
        if (!isfinite(s->v[i]) || (i < y->problem.nx && !isfinite(s->x[i]))) {
            err->time = e->timing.t0;
            return MOTUS_DIVERGED;
        }
    return MOTUS_OK;
}

static motus_status advance(void *ctx, stepper_limit limit, stepper_stop *why, motus_error *err)
{
    const trajectory *s = ctx;
    motus_run *r = s->w->run;
    if (s->w->events && limit.steps > 0 && !s->errors) {
        *why = STOP_STEPS;
        return run_events_steps(s->w->events, s->w->stepper, &s->w->pace, limit.steps, limit.until, why, err);
    }
    if (!s->errors) return ensemble_advance(s->w, limit, why, err);
    r->synchronised = false;
    const motus_status status = run_step(r, limit.steps, err);
    *why = status != MOTUS_OK ? STOP_FAILED : r->arrived ? STOP_UNTIL : STOP_STEPS;
    return status;
}

static double result(const trajectory *s, size_t r)
{
    const motus_record *record = &s->w->e->records[r];
    if (ensemble_tallies(record)) {
        tally taken = tally_of(s->w->stepper, s->began);
        if (s->w->events) taken.steps = events_steps(s->w->events);
        if (s->errors)
            taken.accuracy = bars_worst(s->w->run->bars, s->w->e->chosen.absolute > 0, run_starts_late(&s->w->timing));
        return tally_number(&taken, ensemble_tally(record));
    }
    return reduce_last(s->kept + r * REDUCE_KEPT, (int)record->how, (double)s->observations);
}

static double error(const trajectory *s, size_t r)
{
    const motus_ensemble *e = s->w->e;
    if (ensemble_tallies(&e->records[r])) return 0;
    const size_t number = e->compared_record[r];
    motus_run *const run = s->w->run;
    const double t = stepper_time(s->w->stepper);
    double bar = bars_of(run->bars, t, number);
    const bool last = e->records[r].how == MOTUS_REDUCE_FINAL;
    if (last && run_sync(run, false, NULL) == MOTUS_OK) {
        double own = NAN; /* without memory for it the error is not known */
        const size_t *column = &run->bars->columns[number];
        if (system_rounding(run->system, t, run->x, run->v, column, 1, &own, NULL) != MOTUS_OK) return NAN;
        errors_of(run, t, run->x, run->v, number, &own, NULL);
        /* lanes know nothing of poles, and errors do not depend on who tells them */
        if (errors_leaps(run, t, run->x, run->v, false, column, 1, &own, NULL) != MOTUS_OK) return NAN;
        bar = own;
    }
    return bar;
}

static motus_status begin_events(worker *w, double until, motus_error *err)
{
    const rules *rules;
    motus_status status = system_rules(w->system, &rules, err);
    if (status != MOTUS_OK || !rules) return status;
    if (!w->events) status = events_create(rules, &w->machine, &w->e->chosen, &w->e->allocator, &w->events, err);
    if (status != MOTUS_OK) return status;
    events_forget(w->events);
    return events_begin(w->events, w->stepper, until, err);
}

void ensemble_number_calls(motus_system *s, size_t k, size_t count)
{
    if (s->model || !s->callback.block) return;
    s->calling.first = k;
    s->calling.count = count;
}

motus_status ensemble_single_begin(trajectory *s, const places *p, size_t k, bool *began, motus_error *err)
{
    worker *w = s->w;
    const motus_ensemble *e = w->e;
    timing *t = &w->timing;
    if (w->events) events_forget(w->events); /* it may not begin, and has no events then */
    if (!s->errors) ensemble_errors_blind(w);
    motus_status status = start(s, p->values, k, err);
    if (status == MOTUS_OK) status = ensemble_timing(e, p, k, t, err);
    if (status != MOTUS_OK) return status;
    if (w->stepper) s->began = tally_begin(w->stepper);
    status = w->stepper
                 ? stepper_start(w->stepper, t->t0, t->h, s->x, s->v, err)
                 : stepper_create(&w->machine, &e->chosen, t->t0, t->h, s->x, s->v, &e->allocator, &w->stepper, err);
    *began = status == MOTUS_OK;
    if (status == MOTUS_OK) ensemble_stopped_judged(w);
    if (status == MOTUS_OK) status = begin_events(w, t->until, err);
    if (status == MOTUS_OK && s->errors) status = ensemble_errors_begin(w, s->values, k, err);
    return status;
}

bool ensemble_single_open(trajectory *s, worker *w)
{
    const motus_ensemble *e = w->e;
    const size_t nx = w->machine.problem->nx + 1, nv = w->machine.problem->nv + 1, records = e->record_count + 1;
    double *memory = take(&e->allocator, nx + nv + records * (REDUCE_KEPT + 2) + e->vary_count, sizeof(double));
    if (!memory) return false;
    *s = (trajectory){.w = w,
                      .x = memory,
                      .v = memory + nx,
                      .kept = memory + nx + nv,
                      .now = memory + nx + nv + records * REDUCE_KEPT};
    s->values = s->now + records;
    s->columns = (size_t *)(void *)(s->values + e->vary_count);
    _Static_assert(sizeof(size_t) <= sizeof(double), "columns lie where doubles would");
    for (size_t r = 0; r < e->record_count; r++) s->columns[r] = e->records[r].column;
    return true;
}

void ensemble_single_close(trajectory *s)
{
    if (s->x) give(&s->w->e->allocator, s->x);
    s->x = NULL;
}

motus_status ensemble_single_observe(trajectory *s, motus_error *err) { return observe(s, err); }

motus_status ensemble_single_results(trajectory *s, const places *p, size_t k, bool stopped, bool began)
{
    worker *w = s->w;
    const motus_ensemble *e = w->e;
    motus_error why = motus_default_error();
    if (stopped) ensemble_stopped_take(w, k, began);
    ensemble_ended_take(w, k, stopped);
    /* without a beginning the events are those of another trajectory */
    const motus_status told = began ? ensemble_events_take(w, k, s->errors, &why) : MOTUS_OK;
    for (size_t r = 0; r < e->record_count; r++) p->results[r][k] = stopped ? NAN : result(s, r);
    for (size_t r = 0; p->errors && r < e->record_count; r++) p->errors[r][k] = stopped ? NAN : error(s, r);
    if (p->stopped) p->stopped[k] = stopped ? w->why.time : NAN;
    if (told != MOTUS_OK) w->why = why;
    return told;
}

motus_status ensemble_one(worker *w, size_t k, void *ctx)
{
    const motus_ensemble *e = w->e;
    const places *p = ctx;
    trajectory s;
    if (!ensemble_single_open(&s, w)) return fail(&w->why, MOTUS_MEMORY, "no memory for a trajectory");
    s.errors = p->errors != NULL;
    w->trajectories = 1;
    w->why = motus_default_error();
    bool began = false;
    ensemble_number_calls(w->system, k, 1);
    motus_status status = s.errors ? ensemble_errors_worker(w, &w->why) : MOTUS_OK;
    if (status == MOTUS_OK) status = ensemble_single_begin(&s, p, k, &began, &w->why);
    const course course = {.ctx = &s,
                           .until = w->timing.until,
                           .every = p->observes ? e->every : 0,
                           .advance = advance,
                           .observe = observe};
    if (status == MOTUS_OK) status = course_run(&course, &w->why);
    const bool stopped = status == MOTUS_DIVERGED || status == MOTUS_SOLVE || status == MOTUS_STEPS ||
                         status == MOTUS_EVENTS || (status == MOTUS_CALLBACK && w->why.returned > 0);
    if (stopped || status == MOTUS_OK) {
        status = ensemble_single_results(&s, p, k, stopped, began);
        atomic_fetch_add(&w->e->done, 1);
        if (w->number == 0 && ensemble_report(w->e, (double)atomic_load(&e->done) / (double)e->count)) {
            atomic_store(&w->e->stop, true);
            status = MOTUS_CANCELLED;
        }
    }
    ensemble_number_calls(w->system, 0, 0);
    ensemble_single_close(&s);
    return status;
}

motus_status ensemble_each_singly(motus_ensemble *e, size_t first, size_t items,
                                  motus_status (*one)(worker *, size_t item, void *ctx), void *ctx, motus_error *err)
{
    const size_t kept = numbers_kept(e);
    double *own = kept ? take(&e->allocator, kept, sizeof *own) : NULL;
    if (kept && !own) return fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    if (kept) keep_numbers(e, own);
    motus_status status = ensemble_each(e, first, items, one, ctx, err);
    if (kept) put_back(e, own);
    give(&e->allocator, own);
    return status;
}

motus_status ensemble_singly(motus_ensemble *e, const places *p, size_t first, motus_error *err)
{
    return ensemble_each_singly(e, first, e->count - first, ensemble_one, (void *)p, err);
}
