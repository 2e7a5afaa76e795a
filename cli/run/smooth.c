/* Rows between long steps.
 *
 * Invariant: no number of the state is farther from the straight line between two rows than FINE of its range up to
 * there, as far as LOOKS looks into the step see and MOST rows in it suffice. The rows follow from the state alone, not
 * from the columns that are written.
 */
#include "cli/run/smooth.h"

#include "cli/words/complain.h"

#include <math.h>
#include <stdlib.h>

enum { LOOKS = 8, MOST = 64 };
#define FINE 1e-3   /* a thousandth: what one sees in a picture */
#define OFFSET 0.01 /* of a number's size: a range that is smaller says little, as in the first steps */

/* Widens the ranges by the values in row k. */
static void widen(smooth *s, size_t k)
{
    for (size_t i = 0; i < s->count; i++) {
        const double x = s->values[k * s->count + i];
        s->low[i] = fmin(s->low[i], x);
        s->high[i] = fmax(s->high[i], x);
    }
}

static motus_status find(void *context, motus_run *run, double from, int64_t *parts, motus_error *err)
{
    smooth *s = context;
    const double to = motus_run_time(run);
    double times[LOOKS], most = 0, *first = s->values, *last = first + LOOKS * s->count;
    for (size_t k = 1; k < LOOKS; k++) times[k - 1] = from + (to - from) * ((double)k / LOOKS);
    motus_status status = motus_run_sample(run, times, LOOKS - 1, s->columns, s->count, first + s->count, err);
    if (!status) status = motus_run_values(run, s->columns, s->count, last, err);
    if (status) return status;
    for (size_t k = 1; k <= LOOKS; k++) widen(s, k);
    for (size_t i = 0; i < s->count; i++) {
        const double size = fmax(s->high[i] - s->low[i], OFFSET * fmax(fabs(s->low[i]), fabs(s->high[i])));
        for (size_t k = 1; k < LOOKS && size > 0; k++) {
            const double line = first[i] + (last[i] - first[i]) * ((double)k / LOOKS);
            most = fmax(most, fabs(first[k * s->count + i] - line) / size);
        }
        first[i] = last[i]; /* of the next step */
    }
    *parts = (int64_t)fmin(ceil(sqrt(most / FINE)), MOST); /* a parabola is farther by the square of the length */
    return MOTUS_OK;
}

motus_status smooth_begin(smooth *s, const load *m, motus_run *run, motus_error *err)
{
    const size_t count = m->positions + m->velocities;
    *s = (smooth){.parts = {find, s}, .count = count};
    s->columns = malloc((count + 1) * sizeof *s->columns);
    s->low = malloc((count + 1) * sizeof *s->low);
    s->high = malloc((count + 1) * sizeof *s->high);
    s->values = malloc((LOOKS + 1) * (count + 1) * sizeof *s->values);
    if (!s->columns || !s->low || !s->high || !s->values) return complain_memory(err);
    for (size_t i = 0; i < count; i++) s->columns[i] = 1 + i, s->low[i] = INFINITY, s->high[i] = -INFINITY;
    const motus_status status = motus_run_values(run, s->columns, count, s->values, err);
    if (!status) widen(s, 0);
    return status;
}

void smooth_free(smooth *s)
{
    free(s->columns);
    free(s->low);
    free(s->high);
    free(s->values);
    *s = (smooth){0};
}
