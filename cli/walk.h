/* A run walked to its end while others look at it, each at its own pace. */
#ifndef CLI_WALK_H
#define CLI_WALK_H

#include "motus.h"

/* One who looks: at steps 0, stride, 2 stride, … and at the end; or, with `period` > 0, at times start + k period
 * (values between steps) and at the end. */
typedef struct walk_watcher {
    int64_t stride;
    double period;
    const size_t *columns;
    size_t count;
    motus_status (*take)(void *context, const double *values, motus_error *);
    void *context;
} walk_watcher;

/* start: the time of step 0, until: of the last. Steps in as few calls as the watchers allow. */
motus_status walk(motus_run *, double start, double until, const walk_watcher *, size_t count, motus_error *);

/* A period that is a whole number of steps, as that number; else 0, as where steps adapt. */
int64_t walk_steps_of(double period, double step);
int64_t walk_steps_of_run(const motus_run *, double period);

#endif
