/* Columns of a run in memory.
 *
 * Invariant: the arrays have their full length from the start, so that pointers into them are valid as long as the
 * record. Jumps never take the room of samples: after JUMPS of them, no more are recorded.
 */
#include "cli/run/figure.h"

#include <math.h>
#include <stdlib.h>

enum { JUMPS = 20000, JUMP_ROWS = 3 };

record record_for(int64_t steps, double way, int64_t samples)
{
    record r = {0};
    if (samples <= 1) {
        r.room = 1;
        return r;
    }
    if (steps == 0 && way != 0) {
        r.period = fabs(way) / (double)samples;
        r.room = (size_t)samples + 2;
        return r;
    }
    r.stride = steps / samples + 1;
    r.room = (size_t)(steps / r.stride) + 2;
    return r;
}

record record_between(double step, double way, int64_t within)
{
    const double period = fabs(step) / (double)within;
    return (record){.period = period, .room = (size_t)(fabs(way) / period) + 3};
}

record record_at_steps(int64_t steps, double way, int64_t samples)
{
    if (steps > 0) return record_for(steps, way, samples);
    return (record){.stride = 1, .room = (size_t)samples, .every = 1};
}

record record_with_jumps(record r)
{
    r.jumps = JUMPS;
    r.room += (size_t)JUMPS * JUMP_ROWS;
    return r;
}

static bool add_errors(record *r)
{
    double **errors = realloc(r->errors, (r->count + 1) * sizeof *errors);
    if (!errors) return false;
    r->errors = errors;
    errors[r->count] = r->room < SIZE_MAX / sizeof **errors ? malloc(r->room * sizeof **errors) : NULL;
    return errors[r->count] != NULL;
}

double *record_add(record *r, size_t column)
{
    size_t *columns = realloc(r->columns, (r->count + 1) * sizeof *columns);
    if (!columns) return NULL;
    r->columns = columns;
    double **values = realloc(r->values, (r->count + 1) * sizeof *values);
    if (!values) return NULL;
    r->values = values;
    double *array = r->room < SIZE_MAX / sizeof *array ? malloc(r->room * sizeof *array) : NULL;
    if (!array) return NULL;
    if (r->with_errors && !add_errors(r)) {
        free(array);
        return NULL;
    }
    columns[r->count] = column;
    values[r->count++] = array;
    return array;
}

/* Keeps every other row of a record that is full. */
static void halve(record *r)
{
    for (size_t k = 0; k < r->count; k++)
        for (size_t i = 0; 2 * i < r->rows; i++) r->values[k][i] = r->values[k][2 * i];
    r->rows = (r->rows + 1) / 2;
    r->every *= 2;
}

static motus_status take(void *context, const double *values, motus_error *err)
{
    (void)err;
    record *r = context;
    if (r->every > 0 && r->seen++ % r->every != 0) return MOTUS_OK;
    if (r->every > 0 && r->rows == r->room) {
        halve(r);
        if ((r->seen - 1) % r->every != 0) return MOTUS_OK;
    }
    if (r->rows + (size_t)r->jumps * JUMP_ROWS >= r->room) r->rows--;
    for (size_t k = 0; k < r->count; k++) r->values[k][r->rows] = values[k];
    for (size_t k = 0; r->with_errors && k < r->count; k++) r->errors[k][r->rows] = values[r->count + k];
    r->rows++;
    return MOTUS_OK;
}

/* Records both sides of a jump, with a row of NaN between them, which breaks the curves. */
static motus_status jump(void *context, const double *before, const double *after, motus_error *err)
{
    record *r = context;
    if (r->jumps == 0) return MOTUS_OK;
    r->jumps--;
    motus_status status = take(r, before, err);
    for (size_t k = 0; k < r->count; k++) r->values[k][r->rows] = NAN;
    r->rows++;
    return status ? status : take(r, after, err);
}

walk_observer record_observer(record *r)
{
    return (walk_observer){.stride = r->stride,
                           .period = r->period,
                           .columns = r->columns,
                           .count = r->count,
                           .errors = r->with_errors,
                           .take = take,
                           .jump = r->jumps > 0 ? jump : NULL,
                           .context = r};
}

void record_free(record *r)
{
    for (size_t k = 0; k < r->count; k++) free(r->values[k]);
    for (size_t k = 0; r->errors && k < r->count; k++) free(r->errors[k]);
    free(r->errors);
    free(r->columns);
    free(r->values);
    *r = (record){0};
}
