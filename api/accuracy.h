/* `accuracy`: trial runs find the tolerance, or the step, with which the bars of a run keep to it. */
#ifndef API_ACCURACY_H
#define API_ACCURACY_H

#include "api/run.h"
#include "api/search.h"

typedef struct accuracy {
    double wanted, reached; /* NaN: nothing is wanted; and the largest bar of the best trial, in the same unit */
    bool absolute;
    int trials;
    motus_run *best; /* the trial run with that bar, at its end */
    char why[256];   /* the accuracy cannot be reached */
} accuracy;

/* Completes a definition that names its method: with the tolerance, or the step, of the best trial. `steps` is about
 * how many the run takes, 0: not known. */
motus_status accuracy_find(motus_system *, motus_run_def *, double steps, accuracy *, motus_error *);
void accuracy_end(accuracy *);

#endif
