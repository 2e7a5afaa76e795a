/* Properties of the equations, by the public calls: a step of explicit Euler of size 1 from (x, v) ends at the velocity
 * v + a.
 *
 * Invariant: a probe never changes the system; what it cannot compute is NaN or false, not an error.
 */
#include "probe.h"
#include "api/system/rate.h"
#include <math.h>

#define RATE_OFFSET 1e-5 /* of the size of the motion: rounding and curvature both stay below 1e-4 */
#define PATTERNS 4
#define PATTERN_OFFSET 0x1p-20

bool probe_acceleration(study *s, double t, const double *y, double *a)
{
    motus_run *run = NULL;
    motus_error ignored = motus_default_error();
    motus_status status = study_run(s, STUDY_SIMPLEST, 1, t, t + 1, y, &run, &ignored);
    if (status == MOTUS_OK) status = motus_run_step(run, 1, &ignored);
    if (status == MOTUS_OK) status = motus_run_state(run, NULL, a, &ignored);
    motus_run_destroy(run);
    study_note(s, status);
    bool ok = status == MOTUS_OK;
    for (size_t k = 0; k < s->nv && ok; k++) {
        a[k] -= y[s->nx + k];
        ok = isfinite(a[k]);
    }
    return ok;
}

typedef struct linearised {
    study *s;
    double t;
    const double *y;
    double *moved, *plus, *minus;
} linearised;

/* Computes out = J u, both in units of scale. False: it cannot be computed. */
static bool product(void *ctx, const double *u, double *out)
{
    const linearised *j = ctx;
    study *s = j->s;
    for (size_t k = 0; k < s->numbers; k++) j->moved[k] = j->y[k] + RATE_OFFSET * s->scale[k] * u[k];
    if (!probe_acceleration(s, j->t, j->moved, j->plus)) return false;
    for (size_t k = 0; k < s->numbers; k++) j->moved[k] = j->y[k] - RATE_OFFSET * s->scale[k] * u[k];
    if (!probe_acceleration(s, j->t, j->moved, j->minus)) return false;
    for (size_t k = 0; k < s->nx; k++) out[k] = u[s->nx + k] * s->scale[s->nx + k] / s->scale[k];
    for (size_t k = 0; k < s->nv; k++)
        out[s->nx + k] = (j->plus[k] - j->minus[k]) / (2 * RATE_OFFSET) / s->scale[s->nx + k];
    return true;
}

double probe_speed(study *s, double t, const double *y)
{
    double *a = take(s->allocator, s->nv, sizeof(double)), most = NAN;
    if (!a) study_note(s, MOTUS_MEMORY);
    if (a && probe_acceleration(s, t, y, a)) {
        most = 0;
        for (size_t k = 0; k < s->nx; k++) most = fmax(most, fabs(y[s->nx + k]) / s->scale[k]);
        for (size_t k = 0; k < s->nv; k++) most = fmax(most, fabs(a[k]) / s->scale[s->nx + k]);
    }
    give(s->allocator, a);
    return most;
}

double probe_rate(study *s, double t, const double *y)
{
    size_t n = s->numbers;
    double *room = take(s->allocator, 5 * n, sizeof(double));
    if (!room) {
        study_note(s, MOTUS_MEMORY);
        return NAN;
    }
    linearised j = {.s = s, .t = t, .y = y, .moved = room, .plus = room + n, .minus = room + 2 * n};
    const double rate = rate_fastest(&(rate_map){n, product, &j}, room + 3 * n, room + 4 * n);
    give(s->allocator, room);
    return rate;
}

motus_status probe_columns(study *s, double t, const double *y, const size_t *columns, size_t column_count,
                           double *scale)
{
    double *room = take(s->allocator, s->numbers + 2 * column_count, sizeof(double));
    if (!room) return fail(s->err, MOTUS_MEMORY, "out of memory for a state of %zu numbers", s->numbers);
    double *moved = room, *before = moved + s->numbers, *after = before + column_count;
    for (int pattern = -1; pattern < PATTERNS; pattern++) {
        /* Signs differ from pattern to pattern, so that opposite contributions do not always cancel. */
        for (size_t k = 0; k < s->numbers; k++) {
            double sign = pattern < 0 ? 0 : rate_scatter((size_t)(pattern + 1) * (k + 1)) > 0 ? 1 : -1;
            moved[k] = y[k] * (1 + sign * PATTERN_OFFSET);
        }
        motus_run *run = NULL;
        motus_error ignored = motus_default_error();
        double *out = pattern < 0 ? before : after;
        motus_status status = study_run(s, STUDY_SIMPLEST, 1, t, t + 1, moved, &run, &ignored);
        if (status == MOTUS_OK) status = motus_run_values(run, columns, column_count, out, &ignored);
        motus_run_destroy(run);
        study_note(s, status);
        if (status != MOTUS_OK) break;
        for (size_t c = 0; c < column_count && pattern >= 0; c++) {
            double change = fabs(after[c] - before[c]) / PATTERN_OFFSET;
            if (isfinite(change)) scale[c] = fmax(scale[c], change);
        }
    }
    give(s->allocator, room);
    return MOTUS_OK;
}
