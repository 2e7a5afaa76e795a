/* Integrates a run to its end and calls observers, each at its own steps or times. */
#ifndef CLI_RUN_WALK_H
#define CLI_RUN_WALK_H

#include "motus.h"

#include <stdbool.h>

/* Finds into how many equal parts the latest step of a run, which began at `from`, is to be divided; at most 1: it is
 * left whole. */
typedef struct walk_parts {
    motus_status (*find)(void *context, motus_run *, double from, int64_t *parts, motus_error *);
    void *context;
} walk_parts;

/* `take` is called at the steps 0, stride, 2 stride, … and at the end; or, with `period` > 0, at the times start + k
 * period (between steps by dense output) and at the end. With `errors`, as many errors follow the values.
 *
 * `jump`, if it is not NULL, is called with both sides of every event that changes the state, whether or not the
 * table of events has a row for it, in their order in time between the calls of `take`, which does not get these
 * states. The errors are NaN, since they are not known there. */
typedef struct walk_observer {
    int64_t stride;
    double period;
    walk_parts *parts; /* NULL, or, with stride 1, `take` is called at the ends of the parts of adaptive steps too */
    const size_t *columns;
    size_t count;
    bool errors;
    motus_status (*take)(void *context, const double *values, motus_error *);
    motus_status (*jump)(void *context, const double *before, const double *after, motus_error *);
    void *context;
    int64_t had; /* the samples of `period` before a walk that continues */
} walk_observer;

/* Saves the run between two steps, when every observer has had what was due: every `steps` steps, or else every
 * `seconds`; both 0: never. */
typedef struct walk_keeper {
    int64_t steps;
    double seconds;
    motus_status (*keep)(void *context, motus_error *);
    void *context;
    /* NULL, or called at the last fixed steps before the end, if no known event lies ahead: a run to a later end
     * passes these states too. */
    motus_status (*remember)(void *context, motus_error *);
    int64_t *samples; /* the walk stores here how many samples of its period the first observer has had */
    double *time;     /* the walk stores here the time of the values that it gives to an observer */
    bool goes_on;     /* the walk continues from a saved state */
    bool due;         /* the observers have not had the values at that state */
} walk_keeper;

/* Integrates from step 0, at the time `start`, to the time `until`, in as few calls as the observers allow. The keeper
 * may be NULL. */
motus_status walk(motus_run *, double start, double until, const walk_observer *, size_t count, const walk_keeper *,
                  motus_error *);

/* Return the number of steps in a period if it is an integer; else, and for adaptive steps, 0. */
int64_t walk_steps_of(double period, double step);
int64_t walk_steps_of_run(const motus_run *, double period);

#endif
