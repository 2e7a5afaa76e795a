/* Integrates a run to its end and calls observers.
 *
 * Invariant: before the run stands at step n, all samples at times up to that step have been taken, so the run never
 * goes back. Observers do not change the motion; without them the run is one call.
 */
#include "cli/run/walk.h"

#include "cli/files/stop.h"
#include "cli/words/complain.h"

#include <math.h>
#include <stdlib.h>

enum { CHUNK = 64, LAST = 3 /* steps before the end that a keeper remembers */ };

/* What an observer has had. */
typedef struct progress {
    int64_t samples; /* the number of samples of its period */
    int64_t jumps;   /* the number of jumps, of those that the run keeps */
    double *sides;   /* the values before and after the latest jump */
    double at;       /* the time of the latest jump; NaN: there was none */
} progress;

typedef struct walker {
    motus_run *run;
    double start, until, step; /* step with its sign */
    double *values;            /* memory for CHUNK rows of the observer with the most columns */
    bool adapts;               /* the steps are adaptive: their times are not known before */
    const walk_observer *observer;
    progress *done; /* of each observer */
    size_t count;
    walk_keeper keeper;
    double kept, looked; /* seconds of the clock: when the run was last saved, and when the clock was last read */
    int64_t kept_steps;  /* the steps of the run when it was last saved */
    int64_t last;        /* the first of the last steps; INT64_MAX: the keeper does not remember them */
    int64_t piece;       /* the steps between two readings of the clock */
    bool held;           /* signals are held back until the run is saved */
    int64_t observed;    /* the steps of the run when observe_due() was last called */
} walker;

int64_t walk_steps_of(double period, double step)
{
    double n = nearbyint(period / fabs(step));
    return n >= 1 && n < 9e15 && fabs(period / fabs(step) - n) <= 1e-9 * n ? (int64_t)n : 0;
}

int64_t walk_steps_of_run(const motus_run *run, double period)
{
    return isnan(motus_run_time_of(run, 0)) ? 0 : walk_steps_of(period, motus_run_now(run).step);
}

/* Holds back signals while a run that is saved has taken a step that observers have not had. */
static void hold(const walker *w, bool on) { stop_hold(on || w->held); }

/* Compares numbers; NaN equals NaN. */
static bool same(const double *a, const double *b, size_t count)
{
    for (size_t k = 0; k < count; k++)
        if (a[k] != b[k] && !(isnan(a[k]) && isnan(b[k]))) return false;
    return true;
}

/* Gives the observer the jumps up to time t that it has not had. */
static motus_status jumps(walker *w, size_t i, double t, motus_error *err)
{
    const walk_observer *o = &w->observer[i];
    progress *p = &w->done[i];
    const size_t row = o->errors ? 2 * o->count : o->count;
    motus_status status = MOTUS_OK;
    for (; !status && o->jump && p->jumps < motus_run_jumps(w->run); p->jumps++) {
        double at = NAN;
        int moves = 0;
        status = motus_run_jump(w->run, p->jumps, 0, NULL, 0, &at, &moves, NULL, err);
        if (status || (w->step < 0 ? at < t : at > t)) return status;
        for (int after = 0; !status && after < 2; after++)
            status =
                motus_run_jump(w->run, p->jumps, after, o->columns, o->count, &at, NULL, p->sides + after * row, err);
        if (status) return status;
        /* an event that changes no state, and none of these columns, is not a jump */
        if (!moves && same(p->sides, p->sides + row, o->count)) continue;
        p->at = at;
        if (w->keeper.keep) *w->keeper.time = at;
        status = o->jump(o->context, p->sides, p->sides + row, err);
    }
    return status;
}

/* Gives the observer the values at time t, unless it has had them as a side of a jump. */
static motus_status give_row(walker *w, size_t i, double t, const double *values, motus_error *err)
{
    const walk_observer *o = &w->observer[i];
    const progress *p = &w->done[i];
    const size_t row = o->errors ? 2 * o->count : o->count;
    motus_status status = jumps(w, i, t, err);
    const bool had =
        !status && p->at == t && (same(values, p->sides, o->count) || same(values, p->sides + row, o->count));
    if (w->keeper.keep) *w->keeper.time = t;
    return status || had ? status : o->take(o->context, values, err);
}

static motus_status observe(walker *w, size_t i, motus_error *err)
{
    const walk_observer *o = &w->observer[i];
    motus_status status = MOTUS_OK;
    if (o->count > 0)
        status = o->errors ? motus_run_errors(w->run, o->columns, o->count, w->values, w->values + o->count, err)
                           : motus_run_values(w->run, o->columns, o->count, w->values, err);
    return status ? status : give_row(w, i, motus_run_time(w->run), w->values, err);
}

/* Returns whether an event has ended the run before time t. */
static bool beyond(const walker *w, double t)
{
    const double end = motus_run_time(w->run);
    return motus_run_ended(w->run, NULL, NULL, NULL)[0] && (w->step < 0 ? t < end : t > end);
}

/* Finds the values at *n times. Reduces *n if an event ends the run before the last of them. */
static motus_status sample_values(walker *w, const walk_observer *o, const double *times, size_t *n, motus_error *err)
{
    motus_error own = motus_default_error();
    const motus_status status = motus_run_sample(w->run, times, *n, o->columns, o->count, w->values, &own);
    const size_t all = *n;
    while (*n > 0 && beyond(w, times[*n - 1])) --*n;
    if (!status || (status == MOTUS_ARGUMENT && *n < all)) return MOTUS_OK; /* the rows before that were filled */
    if (err) *err = own;
    return status;
}

/* Gives the observer the values at one time, with their errors. */
static motus_status sample_errors(walker *w, size_t i, double t, motus_error *err)
{
    const walk_observer *o = &w->observer[i];
    motus_error own = motus_default_error();
    const motus_status status =
        motus_run_sample_errors(w->run, &t, 1, o->columns, o->count, w->values, w->values + o->count, &own);
    if (status == MOTUS_ARGUMENT && beyond(w, t)) return MOTUS_OK;
    if (status && err) *err = own;
    return status ? status : give_row(w, i, t, w->values, err);
}

/* Gives observer i the samples at times start + k period that it has not had, up to `limit`, but not the end, which
 * observe_due() gives. */
static motus_status sample(walker *w, size_t i, double limit, motus_error *err)
{
    const walk_observer *o = &w->observer[i];
    /* One time at once: the run moves to the times that it samples, and a run that is saved must not stop beyond a time
     * that an observer has not had. And at the instant of a jump, it depends on the times sampled before which side the
     * values are from. */
    const bool kept = w->keeper.keep != NULL;
    const size_t most = kept || o->jump ? 1 : CHUNK;
    int64_t *k = &w->done[i].samples;
    double sign = w->step < 0 ? -1 : 1, slack = 1e-9 * fabs(w->step);
    if (limit == w->until) limit -= sign * slack;
    for (;;) {
        double times[CHUNK];
        size_t n = 0;
        for (; n < most; n++, ++*k) {
            times[n] = w->start + sign * (double)*k * o->period;
            if (sign * (times[n] - limit) > 0) break;
        }
        if (n == 0) return MOTUS_OK;
        const size_t wanted = n;
        if (kept) hold(w, true);
        motus_status status = o->errors ? MOTUS_OK : sample_values(w, o, times, &n, err);
        for (size_t s = 0; o->errors && !status && s < n; s++) status = sample_errors(w, i, times[s], err);
        for (size_t s = 0; !o->errors && !status && s < n; s++)
            status = give_row(w, i, times[s], w->values + s * o->count, err);
        hold(w, false);
        if (!status && stop_requested() && !w->held) status = fail(err, MOTUS_CANCELLED, "cancelled");
        if (status || n < wanted || wanted < most) return status;
    }
}

/* Gives the observers the jumps up to the present time. *all says whether the run knows no jump ahead; if it does, a
 * saved state would lack that jump. */
static motus_status give_jumps(walker *w, bool *all, motus_error *err)
{
    motus_status status = MOTUS_OK;
    for (size_t i = 0; !status && i < w->count; i++) status = jumps(w, i, motus_run_time(w->run), err);
    const int64_t known = motus_run_jumps(w->run);
    *all = true;
    for (size_t i = 0; i < w->count; i++) *all = *all && (!w->observer[i].jump || w->done[i].jumps == known);
    return status;
}

/* Saves the run if it is due. The clock is read about a hundred times between two saved states. */
static motus_status keep(walker *w, motus_error *err)
{
    const walk_keeper *k = &w->keeper;
    if (!k->keep || motus_run_done(w->run)) return MOTUS_OK;
    const double now = stop_clock();
    const int64_t steps = motus_run_steps(w->run);
    if (k->steps == 0 && now - w->looked < 0.005 * k->seconds && w->piece < INT64_MAX / 4) w->piece *= 2;
    if (k->steps == 0 && now - w->looked > 0.02 * k->seconds && w->piece > 1) w->piece /= 2;
    w->looked = now;
    const bool due = k->steps > 0 ? steps - w->kept_steps >= k->steps : now - w->kept >= k->seconds;
    bool all = false;
    motus_status status = due ? give_jumps(w, &all, err) : MOTUS_OK;
    if (status || !all) return status;
    *k->samples = w->done[0].samples;
    status = k->keep(k->context, err);
    w->kept = stop_clock();
    w->kept_steps = k->steps > 0 ? steps - steps % k->steps : steps;
    return status;
}

static motus_status remember(walker *w, motus_error *err)
{
    bool all = false;
    if (motus_run_steps(w->run) < w->last || motus_run_done(w->run)) return MOTUS_OK;
    const motus_status status = give_jumps(w, &all, err);
    if (status || !all) return status;
    *w->keeper.samples = w->done[0].samples;
    return w->keeper.remember(w->keeper.context, err);
}

/* Returns the next step at which an observer is due or the clock is read; INT64_MAX: none before the end. */
static int64_t next_stop(const walker *w)
{
    int64_t next = INT64_MAX;
    const int64_t now = motus_run_steps(w->run), last = w->last;
    if (w->keeper.keep) next = w->keeper.steps > 0 ? now + w->keeper.steps - now % w->keeper.steps : now + w->piece;
    if (last < INT64_MAX && next > (now < last ? last : now + 1)) next = now < last ? last : now + 1;
    for (size_t i = 0; i < w->count; i++) {
        const walk_observer *o = &w->observer[i];
        const int64_t stop = o->stride > 0 ? now + (o->stride - now % o->stride) : INT64_MAX;
        next = stop < next ? stop : next;
    }
    return next;
}

/* Gives the observers that divide steps the times within the latest step, which began at `from`. */
static motus_status divide_all(walker *w, double from, motus_error *err)
{
    motus_status status = MOTUS_OK;
    const double to = motus_run_time(w->run);
    for (size_t i = 0; !status && i < w->count; i++) {
        const walk_observer *o = &w->observer[i];
        int64_t parts = 0;
        if (o->parts && to != from) status = o->parts->find(o->parts->context, w->run, from, &parts, err);
        for (int64_t k = 1; !status && k < parts; k++) {
            const double t = from + (to - from) * ((double)k / (double)parts);
            size_t n = 1;
            if (o->errors)
                status = sample_errors(w, i, t, err);
            else if (!(status = sample_values(w, o, &t, &n, err)) && n > 0)
                status = give_row(w, i, t, w->values, err);
        }
    }
    return status;
}

static motus_status observe_due(walker *w, motus_error *err)
{
    motus_status status = MOTUS_OK;
    w->observed = motus_run_steps(w->run);
    for (size_t i = 0; !status && i < w->count; i++) {
        const walk_observer *o = &w->observer[i];
        const bool due = motus_run_done(w->run) || (o->stride > 0 && motus_run_steps(w->run) % o->stride == 0);
        if (due) status = observe(w, i, err);
    }
    return status;
}

static motus_status sample_all(walker *w, double limit, motus_error *err)
{
    motus_status status = MOTUS_OK;
    for (size_t i = 0; !status && i < w->count; i++)
        if (w->observer[i].period > 0) status = sample(w, i, limit, err);
    return status;
}

/* Takes n steps. MOTUS_ACCURACY is no failure here: the run is at its end, and the command reports it after the
 * numbers. */
static motus_status step(motus_run *run, int64_t n, motus_error *err)
{
    const motus_status status = motus_run_step(run, n, err);
    return status == MOTUS_ACCURACY ? MOTUS_OK : status;
}

/* Lets the run forget its jumps if every observer has had them. */
static void forget_jumps(walker *w)
{
    const int64_t kept = motus_run_jumps(w->run);
    bool had = kept > 0;
    for (size_t i = 0; i < w->count; i++) had &= !w->observer[i].jump || w->done[i].jumps == kept;
    if (!had) return;
    motus_run_keep_jumps(w->run, 1);
    for (size_t i = 0; i < w->count; i++) w->done[i].jumps = 0;
}

/* Takes the steps up to the next one at which an observer or the keeper is due, at most `most`. */
static motus_status advance(walker *w, int64_t most, bool periods, motus_error *err)
{
    motus_status status = MOTUS_OK;
    const int64_t now = motus_run_steps(w->run);
    int64_t next = next_stop(w);
    if (next - now > most) next = now + most;
    const double limit = w->adapts ? NAN : motus_run_time_of(w->run, next);
    /* with adaptive steps, the times within a step are sampled after it */
    const bool after = periods && isnan(limit);
    if (after)
        next = now + 1;
    else
        status = sample_all(w, limit, err);
    const bool held = w->held;
    w->held = held || (w->keeper.keep && after); /* until the observers have had the times in this step */
    hold(w, false);
    const double from = motus_run_time(w->run);
    if (!status && motus_run_steps(w->run) < next) status = step(w->run, next - motus_run_steps(w->run), err);
    if (!status && isnan(limit)) status = sample_all(w, motus_run_time(w->run), err);
    if (!status && w->adapts) status = divide_all(w, from, err);
    w->held = held;
    hold(w, false);
    if (!status) status = observe_due(w, err);
    forget_jumps(w);
    return status;
}

/* Continues a run that a signal has stopped to where it can be saved, and saves it. Returns whether that is its end. */
static bool keep_stopped(walker *w, bool periods)
{
    enum { MOST = 1000 };
    motus_error ignored = motus_default_error();
    bool all;
    w->held = true;
    hold(w, true);
    motus_status status = MOTUS_OK;
    /* the signal may have come with the last step, so that the run does not know yet that it is at its end; or
     * before an observer had a step or a time within a step */
    if (!motus_run_done(w->run) && motus_run_time(w->run) == w->until) status = step(w->run, 1, &ignored);
    if (!status) status = sample_all(w, motus_run_time(w->run), &ignored);
    if (!status && motus_run_steps(w->run) != w->observed) status = observe_due(w, &ignored);
    if (!status) status = give_jumps(w, &all, &ignored);
    for (int n = 0; n < MOST && !status && !all && !motus_run_done(w->run); n++) {
        status = advance(w, 1, periods, &ignored);
        if (!status) status = give_jumps(w, &all, &ignored);
    }
    *w->keeper.samples = w->done[0].samples;
    const bool done = !status && motus_run_done(w->run);
    if (!status && all && !done) (void)w->keeper.keep(w->keeper.context, &ignored);
    w->held = false;
    hold(w, false);
    return done;
}

static motus_status go(walker *w, motus_error *err)
{
    motus_status status = w->keeper.goes_on && !w->keeper.due ? MOTUS_OK : observe_due(w, err);
    bool periods = false;
    for (size_t i = 0; i < w->count; i++) periods |= w->observer[i].period > 0;
    w->observed = motus_run_steps(w->run);
    if (!status && w->keeper.goes_on && !w->keeper.due) status = remember(w, err);
    while (!status && !motus_run_done(w->run)) {
        status = advance(w, INT64_MAX, periods, err);
        if (!status) status = remember(w, err);
        if (!status) status = keep(w, err);
        if (!status && stop_requested() && !motus_run_done(w->run)) status = fail(err, MOTUS_CANCELLED, "cancelled");
    }
    if (status == MOTUS_CANCELLED && w->keeper.keep && keep_stopped(w, periods)) status = MOTUS_OK;
    if (!status && w->keeper.keep) *w->keeper.samples = w->done[0].samples;
    return status;
}

/* Makes memory for the sides of jumps, and finds where the grids of times continue. */
static motus_status prepare(walker *w, motus_error *err)
{
    const bool first = motus_run_steps(w->run) == 0;
    motus_status status = MOTUS_OK;
    for (size_t i = 0; !status && i < w->count; i++) {
        const walk_observer *o = &w->observer[i];
        const size_t room = 2 * (o->errors ? 2 : 1) * o->count;
        w->done[i].at = NAN;
        w->done[i].sides = o->jump ? malloc((room + 1) * sizeof *w->done[i].sides) : NULL;
        if (o->jump && !w->done[i].sides) status = complain_memory(err);
        for (size_t k = 0; !status && o->jump && k < room; k++) w->done[i].sides[k] = NAN;
        /* a restarted run continues the grid of times from its present time */
        if (w->keeper.goes_on && i == 0)
            w->done[i].samples = o->had;
        else if (o->period > 0 && !first)
            w->done[i].samples = (int64_t)ceil(fabs(motus_run_time(w->run) - w->start) / o->period * (1 - 1e-12));
    }
    return status;
}

motus_status walk(motus_run *run, double start, double until, const walk_observer *observers, size_t count,
                  const walk_keeper *keeper, motus_error *err)
{
    const motus_run_statistics now = motus_run_now(run);
    double size = now.step;
    const bool adapts = isnan(size);
    if (adapts) size = 1e-6 * fabs(until - start); /* only its sign is used, and the slack that follows from it */
    walker w = {.run = run,
                .start = start,
                .until = until,
                .step = until < start ? -size : size,
                .adapts = adapts,
                .observer = observers,
                .count = count,
                .kept = stop_clock(),
                .looked = stop_clock(),
                .kept_steps = motus_run_steps(run),
                .last = INT64_MAX,
                .piece = 1};
    if (keeper) w.keeper = *keeper;
    if (w.keeper.remember && now.steps_total > 0) w.last = now.steps_total - LAST;
    size_t widest = 1;
    for (size_t i = 0; i < count; i++) {
        size_t rows = observers[i].errors ? 2 : observers[i].period > 0 ? CHUNK : 1;
        if (observers[i].count > SIZE_MAX / sizeof(double) / rows / 4) return complain_memory(err);
        widest = observers[i].count * rows > widest ? observers[i].count * rows : widest;
    }
    w.values = malloc(widest * sizeof *w.values);
    w.done = calloc(count + 1, sizeof *w.done);
    motus_status status = w.values && w.done ? prepare(&w, err) : complain_memory(err);
    bool jumps = false;
    for (size_t i = 0; i < count; i++) jumps |= observers[i].jump != NULL;
    if (jumps) motus_run_keep_jumps(run, 1);
    stop_keep(w.keeper.keep != NULL);
    if (!status) status = go(&w, err);
    stop_keep(false);
    if (jumps) motus_run_keep_jumps(run, 0);
    for (size_t i = 0; w.done && i < count; i++) free(w.done[i].sides);
    free(w.values);
    free(w.done);
    return status;
}
