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
    double *y;                        /* for a state */
    double most;                      /* most evaluations of one run */
    int repeats;                      /* how often a short run is timed */
    ladder_point points[LADDER_MOST]; /* from coarse to fine */
    size_t count;
    bool ended; /* no finer point is worth a run, because of `why`: a sentence without capital and stop */
    char why[MOTUS_TEXT_MAX];
    motus_status failed; /* of the last run that failed */
    char failure[MOTUS_TEXT_MAX];
} ladder;

/* Finds the point that meets an accuracy, reference error included, with nearly the fewest evaluations: its error is
 * above 2/3 of the accuracy, or it has few steps. NULL: there is none, and `why` gives the reason. */
motus_status ladder_reach(ladder *, double accuracy, const ladder_point **);
/* Measures the time of a point's run: the shortest of several. */
motus_status ladder_time(ladder *, const ladder_point *, double *seconds);
bool ladder_failed(const ladder *);                       /* no run came to its end near the motion */
double ladder_step(const ladder *, const ladder_point *); /* of a method with fixed steps */

#endif
