/* How far invariants moved along a run.
 *
 * Invariant: `initial` is the value at the model's start, also of a run that was taken up again; a value that is no
 * number makes the largest drift no number.
 */
#include "cli/drift.h"

#include "cli/complain.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LOOKS = 1000, FEWEST_LOOKS = 16 };
static const double numbers_looked_at = 1e7;

int64_t drift_stride(const load *m, int64_t steps)
{
    double looks = numbers_looked_at / ((double)m->positions + (double)m->velocities + 1);
    looks = fmax(FEWEST_LOOKS, fmin(LOOKS, looks));
    int64_t stride = (int64_t)((double)steps / looks);
    return stride < 1 ? 1 : stride;
}

motus_status drift_begin(drift *d, const load *m, motus_run *run, motus_error *err)
{
    *d = (drift){.count = m->invariants};
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
    drift *d = context;
    for (size_t k = 0; k < d->count; k++) {
        double moved = fabs(values[k] - d->initial[k]);
        if (!(moved <= d->most[k]) && !isnan(d->most[k])) d->most[k] = moved;
        d->final[k] = values[k];
    }
    return MOTUS_OK;
}

walk_watcher drift_watcher(drift *d, int64_t stride)
{
    return (walk_watcher){.stride = stride, .columns = d->columns, .count = d->count, .take = take, .context = d};
}

void drift_free(drift *d)
{
    free(d->columns);
    free(d->initial);
    free(d->final);
    free(d->most);
    *d = (drift){0};
}
