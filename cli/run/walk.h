/* Integrates a run to its end and calls observers, each at its own steps or times. */
#ifndef CLI_RUN_WALK_H
#define CLI_RUN_WALK_H

#include "motus.h"

#include <stdbool.h>

/* Called at steps 0, stride, 2 stride, … and at the end; or, with `period` > 0, at times start + k period (between
 * steps by dense output) and at the end. With `errors` the values are followed by as many errors.
 *
 * `jump`, where it is not NULL, is called with both sides of every event that changes the state, with a row in the
 * table or without, in their order in time between the other calls; a state that it has had is not given to `take` too.
 * The errors are NaN: they are not known there. */
typedef struct walk_observer {
    int64_t stride;
    double period;
    const size_t *columns;
    size_t count;
    bool errors;
    motus_status (*take)(void *context, const double *values, motus_error *);
    motus_status (*jump)(void *context, const double *before, const double *after, motus_error *);
    void *context;
    int64_t had; /* of `period`, where the walk goes on: how many samples it has had */
} walk_observer;

/* Who keeps the run as it is between two steps, when every observer has had what was due: every `steps` steps, or else
 * every `seconds`; both 0: never. */
typedef struct walk_keeper {
    int64_t steps;
    double seconds;
    motus_status (*keep)(void *context, motus_error *);
    void *context;
    /* NULL, or called at the last steps before the end too, where steps have one size and nothing lies ahead: a run to
     * a later end stands there as well. */
    motus_status (*remember)(void *context, motus_error *);
    int64_t *samples; /* where the walk leaves how many of a period the first observer has had; also at the end */
    double *time;     /* where it leaves the time of what an observer is given */
    /* The run was kept where it is, and goes on; `due`: what is due there, the observers have not had. */
    bool goes_on, due;
} walk_keeper;

/* start: the time of step 0, until: the end. Steps in as few calls as the observers allow. keeper: NULL, there is
 * none. */
motus_status walk(motus_run *, double start, double until, const walk_observer *, size_t count, const walk_keeper *,
                  motus_error *);

/* The number of steps in a period if it is an integer; else, and if steps adapt, 0. */
int64_t walk_steps_of(double period, double step);
int64_t walk_steps_of_run(const motus_run *, double period);

#endif
