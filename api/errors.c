/* The calls for bars of error: motus_run_errors, motus_run_sample_errors, motus_run_estimate. */
#include "api/bars.h"
#include "api/event_bars.h"

#include <math.h>

static motus_status sound(const motus_run *r, motus_error *err)
{
    if (r->bars) return MOTUS_OK;
    fail(err, MOTUS_ARGUMENT, "the run tells no errors");
    hint(err, "give `error = MOTUS_BARS_CHEAP` of the definition");
    return MOTUS_ARGUMENT;
}

motus_status errors_of(motus_run *r, double t, double *x, double *v, size_t number, double *error, motus_error *err)
{
    *error = bars_of(r->bars, t, number) + (isfinite(*error) ? *error : 0);
    return r->events ? event_bars_state(r, t, x, v, number, error, err) : MOTUS_OK;
}

typedef struct at {
    motus_run *run;
    double t, *x, *v;
} at;

/* Of a column of the state; 0 where run and companion have agreed. */
static double state_bar(void *ctx, size_t column)
{
    const at *a = ctx;
    const bars *b = a->run->bars;
    double error = NAN;
    if (column >= b->count || b->columns[column] != column) return NAN;
    if (b->started && !b->why[0] && differences_agree(&b->differences, column)) return 0;
    error = 0;
    return errors_of(a->run, a->t, a->x, a->v, column, &error, NULL) == MOTUS_OK ? error : NAN;
}

motus_status errors_leaps(motus_run *r, double t, double *x, double *v, bool sharp, const size_t *columns, size_t count,
                          double *errors, motus_error *err)
{
    at a = {r, t, x, v};
    return system_leaps(r->system, t, x, v, state_bar, &a, sharp, columns, count, errors, err);
}

/* The values are the run's own, also where there are no bars. */
static motus_status tell(motus_run *r, double t, double *x, double *v, const size_t *columns, size_t count,
                         double *values, double *errors, motus_error *err)
{
    motus_status status = MOTUS_OK;
    for (size_t k = 0; k < count; k++)
        if (columns[k] >= r->system->column_count)
            return fail(err, MOTUS_ARGUMENT, "there is no column %zu", columns[k]);
    if (values) status = system_values(r->system, t, x, v, columns, count, values, err);
    if (status == MOTUS_OK) status = system_rounding(r->system, t, x, v, columns, count, errors, err);
    for (size_t k = 0; status == MOTUS_OK && k < count; k++)
        status = errors_of(r, t, x, v, columns[k], errors + k, err);
    return status == MOTUS_OK ? errors_leaps(r, t, x, v, true, columns, count, errors, err) : status;
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
    if (status == MOTUS_OK) status = tell(r, stepper_time(r->stepper), r->x, r->v, columns, count, values, errors, err);
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
            status =
                tell(r, times[i], x, v, columns, count, values ? values + i * count : NULL, errors + i * count, err);
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
