/* Integrates a run to its end and calls observers.
 *
 * Invariant: before the run stands at step n, all samples at times up to that step have been taken, so the run never
 * goes back. Observing does not change the motion; without observers the run is one call.
 */
#include "cli/walk.h"

#include "base/error.h"
#include "cli/complain.h"
#include "cli/stop.h"

#include <math.h>
#include <stdlib.h>

enum { CHUNK = 64 };

typedef struct walker {
    motus_run *run;
    double start, until, step; /* step with its sign */
    double *values;            /* room for CHUNK rows of the observer with the most columns */
    bool adapts;               /* steps have no times that are known before */
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

static motus_status observe(walker *w, const walk_observer *o, motus_error *err)
{
    if (o->count > 0) {
        motus_status status = o->errors
                                  ? motus_run_errors(w->run, o->columns, o->count, w->values, w->values + o->count, err)
                                  : motus_run_values(w->run, o->columns, o->count, w->values, err);
        if (status) return status;
    }
    return o->take(o->context, w->values, err);
}

/* One time, of which the values and the errors lie side by side. */
static motus_status sample_errors(walker *w, const walk_observer *o, double t, motus_error *err)
{
    motus_status status =
        motus_run_sample_errors(w->run, &t, 1, o->columns, o->count, w->values, w->values + o->count, err);
    return status ? status : o->take(o->context, w->values, err);
}

/* Takes the samples at times start + k period, from *k on, up to `limit`; the end is observed when it is reached. */
static motus_status sample(walker *w, const walk_observer *o, int64_t *k, double limit, motus_error *err)
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
        motus_status status = MOTUS_OK;
        for (size_t i = 0; o->errors && !status && i < n; i++) status = sample_errors(w, o, times[i], err);
        if (!o->errors) status = motus_run_sample(w->run, times, n, o->columns, o->count, w->values, err);
        for (size_t i = 0; !o->errors && !status && i < n; i++)
            status = o->take(o->context, w->values + i * o->count, err);
        if (!status && stop_requested()) status = fail(err, MOTUS_CANCELLED, "cancelled");
        if (status || n < CHUNK) return status;
    }
}

/* The next step at which an observer is due; INT64_MAX: none before the end. */
static int64_t next_stop(const walker *w, const walk_observer *observers, size_t count)
{
    int64_t next = INT64_MAX;
    const int64_t now = motus_run_steps(w->run);
    for (size_t i = 0; i < count; i++) {
        const walk_observer *o = &observers[i];
        const int64_t stop = o->stride > 0 ? now + (o->stride - now % o->stride) : INT64_MAX;
        next = stop < next ? stop : next;
    }
    return next;
}

static motus_status observe_due(walker *w, const walk_observer *observers, size_t count, motus_error *err)
{
    for (size_t i = 0; i < count; i++) {
        const walk_observer *o = &observers[i];
        bool due = motus_run_done(w->run) || (o->stride > 0 && motus_run_steps(w->run) % o->stride == 0);
        motus_status status = due ? observe(w, o, err) : MOTUS_OK;
        if (status) return status;
    }
    return MOTUS_OK;
}

static motus_status sample_all(walker *w, const walk_observer *observers, size_t count, int64_t *k, double limit,
                               motus_error *err)
{
    motus_status status = MOTUS_OK;
    for (size_t i = 0; !status && i < count; i++)
        if (observers[i].period > 0) status = sample(w, &observers[i], &k[i], limit, err);
    return status;
}

/* A run that misses its accuracy is at its end all the same; the command says so after it has shown the numbers. */
static motus_status step(motus_run *run, int64_t n, motus_error *err)
{
    const motus_status status = motus_run_step(run, n, err);
    return status == MOTUS_ACCURACY ? MOTUS_OK : status;
}

static motus_status go(walker *w, const walk_observer *observers, size_t count, int64_t *k, motus_error *err)
{
    motus_status status = observe_due(w, observers, count, err);
    while (!status && !motus_run_done(w->run)) {
        int64_t next = next_stop(w, observers, count);
        const double limit = w->adapts ? NAN : motus_run_time_of(w->run, next);
        bool periods = false;
        for (size_t i = 0; i < count; i++) periods |= observers[i].period > 0;
        /* where steps adapt, the times within a step are sampled after it */
        if (periods && isnan(limit))
            next = motus_run_steps(w->run) + 1;
        else
            status = sample_all(w, observers, count, k, limit, err);
        if (!status && motus_run_steps(w->run) < next) status = step(w->run, next - motus_run_steps(w->run), err);
        if (!status && isnan(limit)) status = sample_all(w, observers, count, k, motus_run_time(w->run), err);
        if (!status) status = observe_due(w, observers, count, err);
        if (!status && stop_requested()) status = fail(err, MOTUS_CANCELLED, "cancelled");
    }
    return status;
}

motus_status walk(motus_run *run, double start, double until, const walk_observer *observers, size_t count,
                  motus_error *err)
{
    double size = motus_run_step_size(run);
    const bool adapts = isnan(size);
    if (adapts) size = 1e-6 * fabs(until - start); /* steps adapt: of it only the sign, and a slack, are used */
    walker w = {.run = run, .start = start, .until = until, .step = until < start ? -size : size, .adapts = adapts};
    size_t widest = 1;
    for (size_t i = 0; i < count; i++) {
        size_t rows = observers[i].errors ? 2 : observers[i].period > 0 ? CHUNK : 1;
        if (observers[i].count > SIZE_MAX / sizeof(double) / rows) return complain_memory(err);
        widest = observers[i].count * rows > widest ? observers[i].count * rows : widest;
    }
    w.values = malloc(widest * sizeof *w.values);
    int64_t *k = calloc(count + 1, sizeof *k);
    motus_status status = MOTUS_OK;
    if (!w.values || !k) status = complain_memory(err);
    for (size_t i = 0; !status && i < count; i++) {
        if (!(observers[i].period > 0)) continue;
        /* a restarted run continues the grid of times from where it is */
        double gone = fabs(motus_run_time(run) - start) / observers[i].period;
        k[i] = motus_run_steps(run) == 0 ? 0 : (int64_t)ceil(gone * (1 - 1e-12));
    }
    if (!status) status = go(&w, observers, count, k, err);
    free(w.values);
    free(k);
    return status;
}
