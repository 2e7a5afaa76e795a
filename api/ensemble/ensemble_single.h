/* A trajectory that a worker computes by itself; ensemble_single.c leads it to its end, ensemble_followed.c lets lanes
 * take steps of it.
 */
#ifndef API_ENSEMBLE_ENSEMBLE_SINGLE_H
#define API_ENSEMBLE_ENSEMBLE_SINGLE_H

#include "api/ensemble/ensemble.h"

typedef struct trajectory {
    worker *w;
    double *x, *v, *kept, *now, *values; /* now: of the records; values: what varies */
    size_t *columns;
    int64_t observations;
    bool errors;         /* are told */
    stepper_count began; /* the stepper's counters at the start */
} trajectory;

bool ensemble_single_open(trajectory *, worker *); /* false: no memory */
void ensemble_single_close(trajectory *);
/* Trajectory k begins in the worker's stepper and events. *began: the stepper stands at the start. */
motus_status ensemble_single_begin(trajectory *, const places *, size_t k, bool *began, motus_error *);
/* Gives the worker's system the numbers of the trajectory, which has begun. */
motus_status ensemble_single_numbers(trajectory *, motus_error *);
motus_status ensemble_single_observe(trajectory *, motus_error *);
/* Writes results and table of a trajectory that has been observed at its end, or stopped by w->why. */
motus_status ensemble_single_results(trajectory *, const places *, size_t k, bool stopped, bool began);

#endif
