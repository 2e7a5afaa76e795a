/* Runs of one method from coarse to fine, each with its error: how much work the method needs for an accuracy. */
#ifndef STUDY_LADDER_H
#define STUDY_LADDER_H

#include "truth.h"

enum { LADDER_MOST = 160 };

typedef struct ladder_point {
    double setting; /* the tolerance of an adaptive method, else the number of steps */
    double error;   /* in the unit of the accuracies; INFINITY: the run failed, or left the motion */
    int64_t steps, evaluations;
} ladder_point;

typedef struct ladder {
    study *s;
    truth *t;
    const char *method;
    const motus_method *card;
    bool absolute;
    double *y;                        /* a state */
    double most;                      /* evaluations of one run */
    int repeats;                      /* so often is a run timed, where it is not long */
    ladder_point points[LADDER_MOST]; /* from coarse to fine */
    size_t count;
    bool ended; /* nothing finer is worth a run, because of `why`: a sentence without capital and stop */
    char why[MOTUS_TEXT_MAX];
    motus_status failed; /* of the last run that failed */
    char failure[MOTUS_TEXT_MAX];
} ladder;

/* Finds the point that meets an accuracy, reference error included, with nearly the fewest evaluations: its error is
 * above 2/3 of the accuracy, or it has few steps. NULL: there is none, and `why` says the reason. */
motus_status ladder_reach(ladder *, double accuracy, const ladder_point **);
/* The time of a point's run, the smallest of several. */
motus_status ladder_time(ladder *, const ladder_point *, double *seconds);
bool ladder_failed(const ladder *);                       /* no run came to its end near the motion */
double ladder_step(const ladder *, const ladder_point *); /* of a method with steps of one size */

#endif
