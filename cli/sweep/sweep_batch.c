/* Trajectories of a sweep that one call computes. See sweep.h. */
#include "cli/sweep/sweep.h"

#include "base/decimal.h"
#include "cli/files/stop.h"
#include "cli/words/complain.h"
#include "cli/words/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* The bounds of a batch: trajectories, memory, and the time of work that a kill may lose. */
enum { BATCH_MOST = 1 << 16, BATCH_BYTES = 1 << 25, BATCH_MS = 500 };

size_t sweep_batch_lanes(const sweep *s)
{
    const motus_ensemble_statistics now = motus_ensemble_now(s->ensemble);
    return (size_t)(now.lanes > 0 ? now.lanes : 1) * (size_t)(now.threads > 0 ? now.threads : 1);
}

/* Returns how many numbers of a trajectory are kept: values, results, errors, stopped. */
static size_t columns_of(const sweep *s) { return s->grid.count + sweep_kept(s) * (s->errors ? 2 : 1) + 1; }

motus_status sweep_batch_make(sweep_batch *b, const sweep *s, motus_error *err)
{
    const size_t records = sweep_kept(s), columns = columns_of(s);
    b->lanes = sweep_batch_lanes(s);
    b->most = BATCH_BYTES / sizeof(double) / columns;
    if (b->most > BATCH_MOST) b->most = BATCH_MOST;
    b->most = b->most > b->lanes ? b->most / b->lanes * b->lanes : b->lanes;
    const size_t count = s->shard.block < SHARD_BLOCK ? b->lanes : 4 * b->lanes; /* small blocks: costly trajectories */
    b->count = count < b->most ? count : b->most;
    b->values = calloc(columns + s->grid.count, sizeof *b->values);
    b->room = b->most < SIZE_MAX / sizeof(double) / columns ? malloc(columns * b->most * sizeof(double)) : NULL;
    if (!b->values || !b->room) return complain_memory(err);
    for (size_t k = 0; k < columns; k++) b->values[k] = b->room + k * b->most;
    b->results = b->values + s->grid.count;
    b->errors = s->errors ? b->results + records : NULL;
    b->stopped = b->room + (columns - 1) * b->most;
    b->shifted = b->values + columns;
    return MOTUS_OK;
}

void sweep_batch_free(sweep_batch *b)
{
    free(b->values);
    free(b->room);
    *b = (sweep_batch){0};
}

static void take_values(sweep_batch *b, const sweep *s, uint64_t row, size_t count)
{
    for (size_t i = 0; i < count;) {
        const uint64_t run = shard_run(&s->shard, row + i);
        const size_t some = run < count - i ? (size_t)run : count - i;
        for (size_t k = 0; k < s->grid.count; k++) b->shifted[k] = b->values[k] + i;
        grid_values(&s->grid, shard_trajectory(&s->shard, row + i), some, b->shifted);
        i += some;
    }
}

/* Writes "trajectory 17 (F = 0.85)". */
static void name_of(const sweep *s, uint64_t number, char *out, size_t size)
{
    size_t n = (size_t)snprintf(out, size, "trajectory %llu", (unsigned long long)number);
    double *room = malloc((s->grid.count + 1) * sizeof *room), **values = malloc((s->grid.count + 1) * sizeof *values);
    for (size_t k = 0; room && values && k < s->grid.count; k++) values[k] = room + k;
    if (room && values && s->grid.count) {
        grid_values(&s->grid, number, 1, values);
        for (size_t k = 0; k < s->grid.count && n < size; k++) {
            char text[DECIMAL_MAX];
            n += (size_t)snprintf(out + n, size - n, "%s%s = %s%s", k ? ", " : " (", s->grid.names[k],
                                  decimal(values[k][0], text), k + 1 == s->grid.count ? ")" : "");
        }
    }
    free(room);
    free(values);
}

/* Makes the error for the first of `count` trajectories, from row `first` on, that did not reach the accuracy. `judged`
 * has the SWEEP_JUDGED records. */
static motus_status refuse(const sweep *s, uint64_t first, size_t count, double *const *judged, const double *stopped,
                           motus_error *err)
{
    char who[256], wanted[DECIMAL_MAX], bar[DECIMAL_MAX], tolerance[DECIMAL_MAX];
    size_t i = 0;
    while (i + 1 < count && (!isnan(stopped[i]) || judged[SWEEP_REACHED][i] <= s->accuracy)) i++;
    const double reached = judged[SWEEP_REACHED][i];
    name_of(s, shard_trajectory(&s->shard, first + i), who, sizeof who);
    decimal(s->accuracy, wanted);
    decimal(judged[SWEEP_TOLERANCE][i], tolerance);
    text_brief(reached, 2, bar);
    if (isnan(reached))
        fail(err, MOTUS_ACCURACY, "no accuracy can be promised: %s has no companion", who);
    else if (isinf(reached))
        fail(err, MOTUS_ACCURACY,
             "the accuracy %s is not reached: no digit of %s is known to be significant at its end", wanted, who);
    else
        fail(err, MOTUS_ACCURACY, "the accuracy %s is not reached: %s has the error %s with the tolerance %s", wanted,
             who, bar, tolerance);
    hint(err, "allow a larger error, or leave this trajectory out");
    return MOTUS_ACCURACY;
}

motus_status sweep_batch_compute(sweep_batch *b, const sweep *s, uint64_t row, size_t count, double *computing,
                                 motus_error *err)
{
    const double *const *values = (const double *const *)b->values;
    take_values(b, s, row, count);
    const double began = stop_clock();
    motus_status status =
        b->errors ? motus_ensemble_run_errors(s->ensemble, count, values, b->results, b->errors, b->stopped, err)
                  : motus_ensemble_run(s->ensemble, count, values, b->results, b->stopped, err);
    if (computing) *computing += stop_clock() - began;
    if (status == MOTUS_ACCURACY) status = refuse(s, row, count, b->results + s->records.count, b->stopped, err);
    return status;
}

sweep_rows sweep_batch_rows(const sweep_batch *b) { return (sweep_rows){b->values, b->results, b->errors, b->stopped}; }

void sweep_batch_adapt(sweep_batch *b, const sweep *s, double seconds)
{
    const size_t lanes = sweep_batch_lanes(s);
    b->lanes = lanes < b->most ? lanes : b->most;
    double wanted = (double)b->count * fmin(8, BATCH_MS * 1e-3 / fmax(seconds, 1e-6));
    size_t blocks = (size_t)fmax(1, wanted / (double)b->lanes);
    b->count = blocks * b->lanes < b->most ? blocks * b->lanes : b->most;
}

size_t sweep_batch_bytes(const sweep_batch *b, const sweep *s) { return b->most * columns_of(s) * sizeof(double); }
