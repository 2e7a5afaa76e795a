/* The course of one trajectory or of several: an observation at the start, then steps and observations in turn, then an
 * observation at the end.
 *
 * Invariant: a trajectory is observed at the same states in the same order, whether it is computed by itself, in a
 * block or in lanes.
 */
#ifndef CORE_COURSE_H
#define CORE_COURSE_H

#include "core/stepper.h"

typedef struct course {
    void *ctx;
    double until;
    int64_t every; /* steps from one observation to the next; 0: the end alone is observed */
    bool observes; /* `advance` makes the observations between start and end itself */
    /* Advances, as stepper_advance does. */
    motus_status (*advance)(void *ctx, stepper_limit, stepper_stop *why, motus_error *);
    motus_status (*observe)(void *ctx, motus_error *);
} course;

motus_status course_run(const course *, motus_error *);

#endif
