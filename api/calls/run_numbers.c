/* The public calls for the errors of a run's numbers, and for its table of events. */
#include "api/error/event_bars.h"
#include "api/motion/run_events.h"

#include <math.h>

static motus_status sound(const motus_run *r, motus_error *err)
{
    if (r->bars) return MOTUS_OK;
    fail(err, MOTUS_ARGUMENT, "the run tells no errors");
    hint(err, "give `error = MOTUS_BARS_CHEAP` of the definition");
    return MOTUS_ARGUMENT;
}

motus_status motus_run_errors(motus_run *r, const size_t *columns, size_t count, double *values, double *errors,
                              motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!r || (count && (!columns || !errors)))
        return fail(err, MOTUS_ARGUMENT, "motus_run_errors needs a run, columns and a place for the errors");
    modes m = modes_enter();
    motus_status status = sound(r, err);
    if (status == MOTUS_OK) status = bars_land(r, err);
    if (status == MOTUS_OK) status = run_sync(r, false, err);
    if (status == MOTUS_OK)
        status = errors_tell(r, stepper_time(r->stepper), r->x, r->v, columns, count, values, errors, err);
    modes_leave(m);
    return status;
}

motus_status motus_run_sample_errors(motus_run *r, const double *times, size_t n, const size_t *columns, size_t count,
                                     double *values, double *errors, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!r || (n && !times) || (count && (!columns || !errors)))
        return fail(err, MOTUS_ARGUMENT, "motus_run_sample_errors needs a run, times, columns and a place for errors");
    modes m = modes_enter();
    motus_status status = sound(r, err);
    for (size_t i = 0; i < n && status == MOTUS_OK; i++) {
        double *x, *v;
        status = run_between(r, times[i], &x, &v, err);
        if (status == MOTUS_OK) status = x == r->x ? bars_land(r, err) : bars_land_between(r, times[i], x, v, err);
        if (status == MOTUS_OK)
            status = errors_tell(r, times[i], x, v, columns, count, values ? values + i * count : NULL,
                                 errors + i * count, err);
    }
    modes_leave(m);
    return status;
}

motus_status motus_run_estimate(motus_run *r, motus_estimate *out, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!r || !out) return fail(err, MOTUS_ARGUMENT, "motus_run_estimate needs a run and a place for the estimate");
    motus_status status = motus_struct_check(MOTUS_DEF_ESTIMATE, out, err);
    if (status == MOTUS_OK) status = sound(r, err);
    if (status != MOTUS_OK) return status;
    modes m = modes_enter();
    status = bars_land(r, err);
    const bars *b = r->bars;
    motus_estimate ours = motus_default_estimate();
    ours.kinked = b->differences.shape.kinked;
    ours.distance = b->differences.distance;
    ours.growth = differences_ratio(&b->differences);
    ours.significant_until = b->differences.until;
    ours.rate = differences_rate(&b->differences);
    ours.seconds = b->seconds;
    ours.reason = b->why;
    ours.looked = witness_looked(r);
    const int64_t run = stepper_evaluations(r->stepper);
    const int64_t beside = (b->half.stepper ? stepper_evaluations(b->half.stepper) : 0) +
                           (b->twin.stepper ? stepper_evaluations(b->twin.stepper) : 0);
    if (run > 0) ours.work = (double)beside / (double)run;
    if (status == MOTUS_OK) motus_struct_write(MOTUS_DEF_ESTIMATE, &ours, out);
    modes_leave(m);
    return status;
}

/* ---- the table ---- */

int64_t motus_run_events(const motus_run *r) { return r && r->events ? (int64_t)events_rows(r->events) : 0; }

motus_status motus_run_event(motus_run *r, int64_t k, motus_event_row *out)
{
    if (!r || !out || k < 0 || k >= motus_run_events(r) ||
        motus_struct_check(MOTUS_DEF_EVENT_ROW, out, NULL) != MOTUS_OK)
        return MOTUS_ARGUMENT;
    const modes m = modes_enter();
    const event row = events_row(r->events, (size_t)k, false, NULL, NULL);
    run_events_row(r->rules, &row, event_bars_time(r, (size_t)k), out);
    modes_leave(m);
    return MOTUS_OK;
}

motus_status motus_run_event_values(motus_run *r, int64_t k, int after, const size_t *columns, size_t count,
                                    double *out, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!r || k < 0 || k >= motus_run_events(r) || (count && (!columns || !out)))
        return fail(err, MOTUS_ARGUMENT,
                    "motus_run_event_values needs a run, the number of an event, columns and a "
                    "place for the values");
    const double *x, *v;
    const modes m = modes_enter();
    const event row = events_row(r->events, (size_t)k, after != 0, &x, &v);
    const motus_status status = system_values_of(r->system, row.t, x, v, r->mid_x, columns, count, out, err);
    modes_leave(m);
    return status;
}

void motus_run_keep_jumps(motus_run *r, int keep)
{
    if (r && r->events) events_keep_jumps(r->events, keep != 0);
}

int64_t motus_run_jumps(const motus_run *r) { return r && r->events ? (int64_t)events_jumps(r->events) : 0; }

motus_status motus_run_jump(motus_run *r, int64_t k, int after, const size_t *columns, size_t count, double *time,
                            int *moves, double *out, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!r || k < 0 || k >= motus_run_jumps(r) || !time || (count && (!columns || !out)))
        return fail(err, MOTUS_ARGUMENT,
                    "motus_run_jump needs a run, the number of an action that is kept, a place for its time, columns "
                    "and a place for the values");
    const double *sides[2];
    const modes m = modes_enter();
    const bool assigns = events_jump(r->events, (size_t)k, time, &sides[0], &sides[1]);
    const double *const side = sides[after != 0];
    if (moves) *moves = assigns;
    const double *const v = side + r->system->problem.nx;
    const motus_status status = system_values_of(r->system, *time, side, v, r->mid_x, columns, count, out, err);
    modes_leave(m);
    return status;
}

const char *motus_run_ended(motus_run *r, int *accumulated, double *time, double *error)
{
    size_t rule = 0;
    events_limit limit = {.t = NAN, .error = NAN};
    const events_end end = r && r->events ? events_ended(r->events, &rule) : EVENTS_END_NONE;
    const bool gathers = r && r->events && events_accumulated(r->events, &limit);
    if (accumulated) *accumulated = gathers;
    if (time) *time = limit.t;
    if (error) {
        const modes m = modes_enter();
        if (gathers && r->bars) bars_land(r, NULL);
        *error = gathers ? event_bars_limit(r, &limit) : NAN;
        modes_leave(m);
    }
    return end == EVENTS_END_NONE ? "" : r->rules->rule[rule].name;
}

const char *motus_run_accumulates(const motus_run *r)
{
    events_limit limit = {0};
    return r && r->events && events_accumulated(r->events, &limit) ? r->rules->rule[limit.rule].name : "";
}

int64_t motus_run_events_significant(motus_run *r)
{
    if (!r) return 0;
    const modes m = modes_enter();
    if (r->bars) bars_land(r, NULL);
    const size_t rows = event_bars_rows(r);
    modes_leave(m);
    return (int64_t)rows;
}

motus_status motus_run_event_errors(motus_run *r, int64_t k, int after, const size_t *columns, size_t count,
                                    double *values, double *out, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!r || k < 0 || k >= motus_run_events(r) || (count && (!columns || !out)))
        return fail(err, MOTUS_ARGUMENT,
                    "motus_run_event_errors needs a run, the number of an event, columns and a "
                    "place for the errors");
    const modes m = modes_enter();
    motus_status status = sound(r, err);
    if (status == MOTUS_OK) status = bars_land(r, err);
    if (status == MOTUS_OK) status = event_bars_values(r, (size_t)k, after != 0, columns, count, out, err);
    modes_leave(m);
    return status == MOTUS_OK && values ? motus_run_event_values(r, k, after, columns, count, values, err) : status;
}
