/* The deviation of the invariants during a run.
 *
 * Invariant: `initial` is the value at the model's start, even in a restarted run. A NaN makes `most` NaN.
 */
#include "cli/run/deviation.h"

#include "cli/words/complain.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SAMPLES = 1000, FEWEST_SAMPLES = 16 };
static const double numbers_sampled = 1e7;

int64_t deviation_stride(const load *m, int64_t steps)
{
    double samples = numbers_sampled / ((double)m->positions + (double)m->velocities + 1);
    samples = fmax(FEWEST_SAMPLES, fmin(SAMPLES, samples));
    int64_t stride = (int64_t)((double)steps / samples);
    return stride < 1 ? 1 : stride;
}

motus_status deviation_begin(deviation *d, const load *m, motus_run *run, motus_error *err)
{
    *d = (deviation){.count = m->invariants};
    if (d->count == 0) return MOTUS_OK;
    d->columns = calloc(d->count, sizeof *d->columns);
    d->initial = calloc(d->count, sizeof *d->initial);
    d->final = calloc(d->count, sizeof *d->final);
    d->most = calloc(d->count, sizeof *d->most);
    if (!d->columns || !d->initial || !d->final || !d->most) return complain_memory(err);
    for (size_t k = 0; k < d->count; k++) d->columns[k] = load_invariant_column(m) + k;
    motus_status status = motus_run_values(run, d->columns, d->count, d->initial, err);
    if (!status) memcpy(d->final, d->initial, d->count * sizeof *d->final);
    return status;
}

static motus_status take(void *context, const double *values, motus_error *err)
{
    (void)err;
    deviation *d = context;
    for (size_t k = 0; k < d->count; k++) {
        double moved = fabs(values[k] - d->initial[k]);
        if (!(moved <= d->most[k]) && !isnan(d->most[k])) d->most[k] = moved;
        d->final[k] = values[k];
    }
    return MOTUS_OK;
}

motus_status deviation_here(deviation *d, motus_run *run, motus_error *err)
{
    if (d->count == 0) return MOTUS_OK;
    double *values = calloc(d->count, sizeof *values);
    motus_status status = values ? motus_run_values(run, d->columns, d->count, values, err) : complain_memory(err);
    if (!status) status = take(d, values, err);
    free(values);
    return status;
}

walk_observer deviation_observer(deviation *d, int64_t stride)
{
    return (walk_observer){.stride = stride, .columns = d->columns, .count = d->count, .take = take, .context = d};
}

void deviation_free(deviation *d)
{
    free(d->columns);
    free(d->initial);
    free(d->final);
    free(d->most);
    *d = (deviation){0};
}
