/* What the methods are judged by: the exact motion, or a reference run that knows its own error. */
#ifndef STUDY_TRUTH_H
#define STUDY_TRUTH_H

#include "study.h"

#define TRUTH_TEXT_MAX 192

typedef struct truth {
    bool known, exact;
    char method[MOTUS_NAME_MAX]; /* the method that makes it; "" if nothing is known */
    int order;
    double step;               /* of the reference run; 0 for the exact motion */
    double error;              /* its estimated error, largest component; 0 for the exact motion */
    double scaled;             /* the same in units of the motion's size */
    double *rows;              /* (points + 1) × numbers: the start, then the grid's points; owned */
    char text[TRUTH_TEXT_MAX]; /* "exact", "kahan-li8 at step 0.05" or why there is none */
} truth;

/* Where the motion is compared with the truth: at steps of size `step`, those of the trial run, or (NaN) at
 * STUDY_SAMPLES even intervals. */
study_grid truth_grid(const study *, double step);
/* A failure to find the truth is no error: then known is false. steps: how many steps the judged methods take (for
 * the bound on the work). enough: an error, in units of the motion's size, that need not be improved; 0 for the best.
 * Sets the study's scale. truth_free in any case. */
motus_status truth_find(study *, const study_grid *, int64_t steps, double enough, truth *);
/* The truth on another grid of the same motion, at steps no larger than the one that was found good: grid->points
 * rows. */
motus_status truth_on(study *, const truth *, const study_grid *, double *rows);
void truth_free(study *, truth *);

#endif
