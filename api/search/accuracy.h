/* `accuracy`: trial runs find the tolerance, or the step, with which the bars of a run keep to it. */
#ifndef API_SEARCH_ACCURACY_H
#define API_SEARCH_ACCURACY_H

#include "api/motion/run.h"
#include "api/search/search.h"
#include "api/search/steep.h"

typedef struct accuracy {
    /* NaN: nothing is wanted; and the largest bar of the best trial, in the same unit. INFINITY: no trial came to its
     * end with digits. */
    double wanted, reached;
    bool absolute;
    int trials;
    motus_run *best;      /* the trial run with that bar */
    bool missed, by_step; /* no trial kept to the accuracy; the trials differed in their step, not in their tolerance */
    bool failed;          /* none came to its end, and the last one failed for no reason of the motion */
    double size;          /* of the best: its step or tolerance, */
    double time;          /*   and the time to which it went */
    double rounding;      /* of `reached`, the part of the model's decimals; NaN: it is less than what is wanted */
    steep steep;          /* what the motion passes, where the accuracy was missed or the trials failed */
} accuracy;

/* Completes a definition that names its method: with the tolerance, or the step, of the best trial, and without
 * located switches where these have another force than the typed one. The hint is what is known of the run, and what
 * has become known. */
motus_status accuracy_find(motus_system *, motus_run_def *, run_hint *, accuracy *, motus_error *);
/* Whether another method may reach what this one, which has come to such an end, did not: it failed for no reason of
 * the motion, or the motion passes an infinite slope. */
bool accuracy_wants_another(const accuracy *, const motus_error *);
void accuracy_end(accuracy *);
/* The largest error of a run that is at its end, with the size of the best trial, where the trial has none. */
double accuracy_reached(const accuracy *, const motus_run *);
/* Says of such a run, whose accuracy was missed, what it has reached. MOTUS_ACCURACY. */
motus_status accuracy_refuse(const accuracy *, const motus_run *, motus_error *);

#endif
