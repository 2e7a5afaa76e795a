/* The error of every number of a run, from its bars, from rounding and from events. See bars.h. */
#include "api/error/event_bars.h"

#include <math.h>

motus_status errors_of(motus_run *r, double t, double *x, double *v, size_t number, double *error, motus_error *err)
{
    *error = bars_of(r->bars, t, number) + (isfinite(*error) ? *error : 0);
    return r->events ? event_bars_state(r, t, x, v, number, error, err) : MOTUS_OK;
}

typedef struct at {
    motus_run *run;
    double t, *x, *v;
} at;

/* Returns the error of a column of the state; 0 where run and companion have agreed. */
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

motus_status errors_tell(motus_run *r, double t, double *x, double *v, const size_t *columns, size_t count,
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
