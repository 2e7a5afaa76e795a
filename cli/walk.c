/* A run walked to its end while others look at it.
 *
 * Invariant: the run is never behind a look: before a stop at step n every look at a time up to that of step n has
 * happened, so the run only goes on. Looking does not touch the motion; with nobody looking there is one call.
 */
#include "cli/walk.h"

#include "cli/complain.h"
#include "cli/stop.h"

#include <math.h>
#include <stdlib.h>

enum { CHUNK = 64 };

typedef struct walker {
    motus_run *run;
    double start, until, step; /* step with its sign */
    double *values;            /* CHUNK rows of the widest watcher */
} walker;

int64_t walk_steps_of(double period, double step)
{
    double n = nearbyint(period / fabs(step));
    return n >= 1 && n < 9e15 && fabs(period / fabs(step) - n) <= 1e-9 * n ? (int64_t)n : 0;
}

int64_t walk_steps_of_run(const motus_run *run, double period)
{
    return isnan(motus_run_time_of(run, 0)) ? 0 : walk_steps_of(period, motus_run_step_size(run));
}

static motus_status look(walker *w, const walk_watcher *o, motus_error *err)
{
    if (o->count > 0) {
        motus_status status = motus_run_values(w->run, o->columns, o->count, w->values, err);
        if (status) return status;
    }
    return o->take(o->context, w->values, err);
}

/* Times start + k period, from *k on, up to `limit`; the end itself is looked at when it is reached. */
static motus_status sample(walker *w, const walk_watcher *o, int64_t *k, double limit, motus_error *err)
{
    double sign = w->step < 0 ? -1 : 1, slack = 1e-9 * fabs(w->step);
    if (limit == w->until) limit -= sign * slack;
    for (;;) {
        double times[CHUNK];
        size_t n = 0;
        for (; n < CHUNK; n++, ++*k) {
            times[n] = w->start + sign * (double)*k * o->period;
            if (sign * (times[n] - limit) > 0) break;
        }
        if (n == 0) return MOTUS_OK;
        motus_status status = motus_run_sample(w->run, times, n, o->columns, o->count, w->values, err);
        for (size_t i = 0; !status && i < n; i++) status = o->take(o->context, w->values + i * o->count, err);
        if (!status && stop_requested()) status = complain(err, MOTUS_CANCELLED, "cancelled");
        if (status || n < CHUNK) return status;
    }
}

/* The next step at which somebody wants the run to stand; INT64_MAX: nobody before the end. */
static int64_t next_stop(const walker *w, const walk_watcher *watchers, size_t count)
{
    int64_t next = INT64_MAX;
    const int64_t now = motus_run_steps(w->run);
    for (size_t i = 0; i < count; i++) {
        const walk_watcher *o = &watchers[i];
        const int64_t stop = o->stride > 0 ? now + (o->stride - now % o->stride) : INT64_MAX;
        next = stop < next ? stop : next;
    }
    return next;
}

static motus_status looks(walker *w, const walk_watcher *watchers, size_t count, motus_error *err)
{
    for (size_t i = 0; i < count; i++) {
        const walk_watcher *o = &watchers[i];
        bool due = motus_run_done(w->run) || (o->stride > 0 && motus_run_steps(w->run) % o->stride == 0);
        motus_status status = due ? look(w, o, err) : MOTUS_OK;
        if (status) return status;
    }
    return MOTUS_OK;
}

static motus_status samples(walker *w, const walk_watcher *watchers, size_t count, int64_t *k, double limit,
                            motus_error *err)
{
    motus_status status = MOTUS_OK;
    for (size_t i = 0; !status && i < count; i++)
        if (watchers[i].period > 0) status = sample(w, &watchers[i], &k[i], limit, err);
    return status;
}

static motus_status go(walker *w, const walk_watcher *watchers, size_t count, int64_t *k, motus_error *err)
{
    motus_status status = looks(w, watchers, count, err);
    while (!status && !motus_run_done(w->run)) {
        int64_t next = next_stop(w, watchers, count);
        const double limit = motus_run_time_of(w->run, next);
        bool periods = false;
        for (size_t i = 0; i < count; i++) periods |= watchers[i].period > 0;
        /* where steps adapt, the times that a step has passed are read after it */
        if (periods && isnan(limit))
            next = motus_run_steps(w->run) + 1;
        else
            status = samples(w, watchers, count, k, limit, err);
        if (!status && motus_run_steps(w->run) < next)
            status = motus_run_step(w->run, next - motus_run_steps(w->run), err);
        if (!status && isnan(limit)) status = samples(w, watchers, count, k, motus_run_time(w->run), err);
        if (!status) status = looks(w, watchers, count, err);
        if (!status && stop_requested()) status = complain(err, MOTUS_CANCELLED, "cancelled");
    }
    return status;
}

motus_status walk(motus_run *run, double start, double until, const walk_watcher *watchers, size_t count,
                  motus_error *err)
{
    double size = fabs(motus_run_step_size(run));
    walker w = {.run = run, .start = start, .until = until, .step = until < start ? -size : size};
    size_t widest = 1;
    for (size_t i = 0; i < count; i++) {
        size_t rows = watchers[i].period > 0 ? CHUNK : 1;
        if (watchers[i].count > SIZE_MAX / sizeof(double) / rows) return complain_memory(err);
        widest = watchers[i].count * rows > widest ? watchers[i].count * rows : widest;
    }
    w.values = malloc(widest * sizeof *w.values);
    int64_t *k = calloc(count + 1, sizeof *k);
    motus_status status = MOTUS_OK;
    if (!w.values || !k) status = complain_memory(err);
    for (size_t i = 0; !status && i < count; i++) {
        if (!(watchers[i].period > 0)) continue;
        /* a restarted run takes the grid up where it stands */
        double gone = fabs(motus_run_time(run) - start) / watchers[i].period;
        k[i] = motus_run_steps(run) == 0 ? 0 : (int64_t)ceil(gone * (1 - 1e-12));
    }
    if (!status) status = go(&w, watchers, count, k, err);
    free(w.values);
    free(k);
    return status;
}
