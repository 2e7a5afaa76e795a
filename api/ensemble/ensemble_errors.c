/* Errors of an ensemble's trajectories: what is compared, and a trajectory as a run with a companion. See ensemble.h.
 *
 * Invariant: errors change no bit of a trajectory, unless its witness objects to a step. The companion's system is the
 * shadow of the ensemble's, in which the same numbers vary; a value that a caller gives is a double, and equal in both.
 */
#include "api/error/bars.h"
#include "api/ensemble/ensemble.h"
#include "api/system/system.h"

#include <math.h>

/* ---- what is compared ---- */

static motus_status refuse_time(const motus_record *record, size_t r, motus_error *err)
{
    const bool most = record->how == MOTUS_REDUCE_TIME_OF_MAX;
    fail(err, MOTUS_ARGUMENT, "record %zu is the time of a %s, which has no error: it is one of the observed times", r,
         most ? "maximum" : "minimum");
    hint(err, "record the %s itself, or tell no errors", most ? "maximum" : "minimum");
    return MOTUS_ARGUMENT;
}

motus_status ensemble_errors_prepare(motus_ensemble *e, motus_error *err)
{
    const motus_system *s = e->system;
    const size_t state = 1 + s->positions + s->velocities, room = state + e->record_count;
    bool reduced = false;
    for (size_t r = 0; r < e->record_count; r++) {
        const motus_record *record = &e->records[r];
        if (record->how == MOTUS_REDUCE_TIME_OF_MIN || record->how == MOTUS_REDUCE_TIME_OF_MAX)
            return refuse_time(record, r, err);
        reduced = reduced || (record->how != MOTUS_REDUCE_FINAL && !ensemble_tallies(record));
    }
    e->compared_columns = take(&e->allocator, room, sizeof *e->compared_columns);
    e->compared_record = take(&e->allocator, e->record_count, sizeof *e->compared_record);
    e->how = reduced ? take(&e->allocator, room, sizeof *e->how) : NULL;
    if (!e->compared_columns || !e->compared_record || (reduced && !e->how))
        return fail(err, MOTUS_MEMORY, "no memory for bars of error");
    for (size_t k = 0; k < state; k++) e->compared_columns[k] = k;
    e->compared = state;
    for (size_t r = 0; r < e->record_count; r++) {
        const motus_record *record = &e->records[r];
        e->compared_record[r] = e->compared;
        if (ensemble_tallies(record)) continue;
        if (reduced) e->how[e->compared] = (int)record->how;
        e->compared_columns[e->compared++] = record->column;
    }
    return MOTUS_OK;
}

differences_shape ensemble_errors_shape(const motus_ensemble *e)
{
    return bars_shape(e->system, e->card, e->error, e->how, e->compared);
}

/* ---- in lanes ---- */

motus_status ensemble_errors_half(motus_ensemble *e, motus_error *err)
{
    const uint8_t *affected = e->vary ? vary_affected(e->vary) : NULL;
    motus_status status = shadow_create(e->system, affected, &e->half, err);
    e->half_chosen = companion_method(&e->chosen, e->system);
    if (status != MOTUS_OK) return status;
    const problem *const p = &e->system->problem;
    const size_t room = e->vary_count + p->nx + p->nv + bars_moved_room(e->system, 1);
    e->rounding_room = arena_room(&e->half->arena, room * sizeof *e->rounding_room);
    if (!e->rounding_room) return fail(err, MOTUS_MEMORY, "no memory for bars of error");
    return vary_create(e->half->model, e->places, e->vary_count, true, true, &e->half_vary, err);
}

/* Adds roundings to errors at the end. The companion's system will do: that its decimals are rounded otherwise hardly
 * changes how far a state moves. */
static void add_rounding(motus_ensemble *e, size_t trajectory, const double *state, double *const *errors)
{
    motus_system *const s = e->half;
    double *const x = e->rounding_room + e->vary_count, *const v = x + s->problem.nx, *const room = v + s->problem.nv;
    const double late = bars_end_rounding(state[0], e->system, s);
    for (size_t r = 0; r < e->record_count; r++) {
        const motus_record *record = &e->records[r];
        double bound, moved = 0, *const error = &errors[r][trajectory];
        if (record->how != MOTUS_REDUCE_FINAL || ensemble_tallies(record)) continue;
        system_inside(s, state + 1, state + 1 + s->positions, x, v);
        motus_status status = MOTUS_OK;
        if (late != 0) status = bars_moved(s, state[0], late, x, v, &record->column, 1, room, &moved, NULL);
        if (status == MOTUS_OK) status = system_rounding(s, state[0], x, v, &record->column, 1, &bound, NULL);
        *error = status == MOTUS_OK ? *error + moved + (isfinite(bound) ? bound : 0) : NAN;
    }
}

void ensemble_errors_rounding(void *ensemble, const double *const *values, size_t trajectory, const double *state,
                              double *const *errors)
{
    motus_ensemble *e = ensemble;
    while (atomic_flag_test_and_set_explicit(&e->rounding, memory_order_acquire)) continue;
    for (size_t k = 0; k < e->vary_count; k++) e->rounding_room[k] = values[k][trajectory];
    if (e->vary_count == 0 || (vary_apply(e->half_vary, e->rounding_room) && system_rebind(e->half)))
        add_rounding(e, trajectory, state, errors);
    else
        for (size_t r = 0; r < e->record_count; r++) errors[r][trajectory] = NAN;
    atomic_flag_clear_explicit(&e->rounding, memory_order_release);
}

/* ---- a worker ---- */

static int tell(void *ctx, double now)
{
    const motus_run *r = ctx;
    return ensemble_tell(r->context, now);
}

/* Makes the typed system, by which the witness judges. */
static motus_status take_home(worker *w, motus_error *err)
{
    const motus_ensemble *e = w->e;
    motus_status status = motus_system_clone(e->home, &w->home, err);
    if (status == MOTUS_OK && w->vary)
        status = vary_create(w->home->model, e->home_places, e->vary_count, true, true, &w->home_vary, err);
    if (status == MOTUS_OK) motus_system_hold(w->run->home = w->run->diagnosed.home = w->home, true);
    return status;
}

static motus_status make_run(worker *w, motus_error *err)
{
    const motus_ensemble *e = w->e;
    motus_run *r = w->run = run_new(w->system);
    if (!r) return fail(err, MOTUS_MEMORY, "no memory for bars of error");
    r->chosen = e->chosen;
    r->card = e->card;
    r->machine = w->machine;
    r->context = w;
    r->first_step = 0; /* nobody asks for it */
    r->pace = (pace){.seconds = w->pace.seconds, .tell = w->pace.tell ? tell : NULL, .ctx = r};
    motus_status status = e->home ? take_home(w, err) : MOTUS_OK;
    if (status == MOTUS_OK) status = bars_make(r, e->error, e->compared_columns, e->how, e->compared, err);
    if (status == MOTUS_OK) status = bars_ready(r, w->vary ? vary_affected(w->vary) : NULL, err);
    if (status != MOTUS_OK || !w->vary) return status;
    model *m = r->bars->half.system->model;
    return vary_create(m, e->places, e->vary_count, true, true, &w->half_vary, err);
}

motus_status ensemble_errors_worker(worker *w, motus_error *err)
{
    const motus_status status = w->run ? MOTUS_OK : make_run(w, err);
    if (status != MOTUS_OK) ensemble_worker_end_run(w);
    return status;
}

/* Gives the trajectory a witness, where trajectories have one. */
static motus_status look(worker *w, motus_error *err)
{
    motus_run *const r = w->run;
    if (!w->e->looks) return ensemble_errors_blind(w), MOTUS_OK;
    if (!r->bars->witness) return witness_create(r, &r->bars->differences, true, &r->bars->witness, err);
    witness_begin(r->bars->witness, r);
    return MOTUS_OK;
}

void ensemble_errors_blind(worker *w)
{
    if (!w->run || !w->run->bars->witness) return;
    if (w->stepper) stepper_inspected(w->stepper, NULL, NULL);
    if (w->events) events_witnessed(w->events, NULL, NULL);
    witness_destroy(w->run->bars->witness);
    w->run->bars->witness = NULL;
}

motus_status ensemble_errors_begin(worker *w, const double *values, size_t k, motus_error *err)
{
    motus_run *r = w->run;
    motus_system *half = r->bars->half.system;
    ensemble_number_calls(half, k, 1);
    if (w->half_vary && w->e->vary_count) {
        if (!vary_apply(w->half_vary, values) || !system_rebind(half))
            return fail(err, MOTUS_MEMORY, "no memory for a trajectory");
        if (w->home_vary && (!vary_apply(w->home_vary, values) || !system_rebind(w->home)))
            return fail(err, MOTUS_MEMORY, "no memory for a trajectory");
    }
    r->stepper = w->stepper;
    motus_status status = system_rules(w->system, &r->rules, err);
    if (status != MOTUS_OK) return status;
    r->events = w->events;
    r->synchronised = r->arrived = false;
    run_leg(r, &w->timing);
    bars_again(r, !half->model);
    bars_forget_events(r);
    return look(w, err);
}
