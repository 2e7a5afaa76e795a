/* One trajectory at a time, by any method and machine. See ensemble.h.
 *
 * Invariant: a trajectory has the bits of a run with its values, unless a witness objects, and is observed at the steps
 * at which lanes observe.
 */
#include "api/error/bars.h"
#include "api/why/diagnosis.h"
#include "api/ensemble/ensemble.h"
#include "api/motion/run_events.h"
#include "api/system/system.h"

#include "core/course.h"
#include "machine/reduction.h"

#include <math.h>
#include <string.h>

motus_status ensemble_single_observe(trajectory *s, motus_error *err)
{
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

/* ---- a trajectory ---- */

motus_status ensemble_single_numbers(trajectory *s, motus_error *err)
{
    const worker *w = s->w;
    const bool given = !w->system->model || !w->e->vary_count;
    return given || (vary_apply(w->vary, s->values) && system_rebind(w->system))
               ? MOTUS_OK
               : fail(err, MOTUS_MEMORY, "no memory for a trajectory");
}

/* Sets the values of trajectory k, and computes its initial state. */
static motus_status start(trajectory *s, const double *const *values, size_t k, motus_error *err)
{
    motus_ensemble *e = s->w->e;
    motus_system *y = s->w->system;
    for (size_t i = 0; i < e->vary_count; i++) s->values[i] = values[i][k];
    if (y->model && e->vary_count) {
        const motus_status set = ensemble_single_numbers(s, err);
        if (set != MOTUS_OK) return set;
        /* Whether the velocity term does no work depends on the parameters. */
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

static motus_status observe(void *ctx, motus_error *err) { return ensemble_single_observe(ctx, err); }

static motus_status advance(void *ctx, stepper_limit limit, stepper_stop *why, motus_error *err)
{
    const trajectory *s = ctx;
    motus_run *r = s->w->run;
    if (s->w->events && limit.steps > 0 && !s->errors) {
        *why = STOP_STEPS;
        return run_events_steps(s->w->events, s->w->stepper, &s->w->pace, limit.steps, limit.until, why, err);
    }
    if (!s->errors) return pace_advance(&s->w->pace, s->w->stepper, limit, why, err);
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
        double own = NAN; /* stays NaN without memory */
        const size_t *column = &run->bars->columns[number];
        if (system_rounding(run->system, t, run->x, run->v, column, 1, &own, NULL) != MOTUS_OK) return NAN;
        errors_of(run, t, run->x, run->v, number, &own, NULL);
        /* Lanes know nothing of poles, and errors must not depend on who tells them. */
        if (errors_leaps(run, t, run->x, run->v, false, column, 1, &own, NULL) != MOTUS_OK) return NAN;
        bar = own;
    }
    return bar;
}

static motus_status begin_events(worker *w, double until, bool errors, motus_error *err)
{
    const rules *rules;
    motus_status status = system_rules(w->system, &rules, err);
    if (status != MOTUS_OK || !rules) return status;
    if (!w->events) status = events_create(rules, &w->machine, &w->e->chosen, &w->e->allocator, &w->events, err);
    if (status != MOTUS_OK) return status;
    events_forget(w->events);
    events_doubted(w->events, errors);
    return events_begin(w->events, w->stepper, until, err);
}

motus_status ensemble_single_begin(trajectory *s, const places *p, size_t k, bool *began, motus_error *err)
{
    worker *w = s->w;
    const motus_ensemble *e = w->e;
    timing *t = &w->timing;
    if (w->events) events_forget(w->events); /* a trajectory that cannot begin has no events */
    if (!s->errors) ensemble_errors_blind(w);
    motus_status status = start(s, p->values, k, err);
    if (status == MOTUS_OK) status = ensemble_timing(e, p, k, t, err);
    if (status != MOTUS_OK) return status;
    if (w->stepper) s->began = tally_begin(w->stepper);
    status = w->stepper
                 ? stepper_start(w->stepper, t->t0, t->h, s->x, s->v, err)
                 : stepper_create(&w->machine, &e->chosen, t->t0, t->h, s->x, s->v, &e->allocator, &w->stepper, err);
    *began = status == MOTUS_OK;
    if (status == MOTUS_OK) stepper_judged(w->stepper, diagnosis_crawls, &w->diagnosed);
    if (status == MOTUS_OK) status = begin_events(w, t->until, s->errors, err);
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

motus_status ensemble_single_results(trajectory *s, const places *p, size_t k, bool stopped, bool began)
{
    worker *w = s->w;
    const motus_ensemble *e = w->e;
    motus_error why = motus_default_error();
    const motus_status told = ensemble_outcome_take(w, k, stopped, began, s->errors, &why);
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
    const bool stopped = ensemble_stopped(status, &w->why);
    if (stopped || status == MOTUS_OK) {
        status = ensemble_single_results(&s, p, k, stopped, began);
        if (ensemble_done(w, 1) != MOTUS_OK) status = MOTUS_CANCELLED;
    }
    ensemble_number_calls(w->system, 0, 0);
    ensemble_single_close(&s);
    return status;
}
