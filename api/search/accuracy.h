/* The search for an accuracy: trials find the tolerance, or the step, with which the bars of a run keep to it. */
#ifndef API_SEARCH_ACCURACY_H
#define API_SEARCH_ACCURACY_H

#include "api/motion/run.h"
#include "api/search/search.h"
#include "api/search/steep.h"

typedef struct accuracy {
    /* The accuracy, NaN: none; and the largest bar of the best trial, in the same unit, INFINITY: no trial came to its
     * end with digits. */
    double wanted, reached;
    bool absolute;
    int trials;
    motus_run *best; /* the best trial */
    /* missed: no trial kept to the accuracy; by_step: trials differed in their step, not their tolerance */
    bool missed, by_step;
    bool failed;     /* no trial came to its end, and the last one failed for no reason of the motion */
    double size;     /* the step or tolerance of the best trial */
    double time;     /* the time to which the best trial went */
    double rounding; /* the part of `reached` that the model's decimals make; NaN: less than `wanted` */
    steep steep;     /* what the motion passes, where the accuracy was missed or trials failed */
} accuracy;

/* Completes a definition that names its method by the tolerance or step of the best trial; without located switches,
 * where these would have another force than the typed one. The hint is what is known of the run, and gets what the
 * trials tell. */
motus_status accuracy_find(motus_system *, motus_run_def *, run_hint *, accuracy *, motus_error *);
/* Returns whether another method may reach what this one did not: it failed for no reason of the motion, or the motion
 * passes an infinite slope. */
bool accuracy_wants_another(const accuracy *, const motus_error *);
void accuracy_end(accuracy *);
/* Returns the largest error of a run at its end, by the run's own bars where the best trial has none. */
double accuracy_reached(const accuracy *, const motus_run *);
/* Reports what a run has reached that missed its accuracy. MOTUS_ACCURACY. */
motus_status accuracy_refuse(const accuracy *, const motus_run *, motus_error *);

#endif
