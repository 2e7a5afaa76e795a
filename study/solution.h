/* The reference solution that errors are measured against: the exact motion, or a run with an estimated error. */
#ifndef STUDY_SOLUTION_H
#define STUDY_SOLUTION_H

#include "study.h"

#define SOLUTION_TEXT_MAX (MOTUS_TEXT_MAX + 16)

typedef struct solution {
    bool known, exact;
    bool located;                /* its runs end their steps where the force changes its formula */
    bool uneven;                 /* the force is not smooth, and steps cannot end where its formula changes */
    study_jump jump;             /* along the motion */
    char method[MOTUS_NAME_MAX]; /* of its run; "": nothing is known */
    int order;
    double step;                  /* of its run; 0 for the exact motion */
    double tolerance;             /* of its run in place of a step, if the method is adaptive; else 0 */
    double error;                 /* the estimated error, largest component; 0 for the exact motion */
    double scaled;                /* the estimated error in units of the motion's size */
    double *rows;                 /* (points + 1) × numbers: the start, then the grid's points */
    char text[SOLUTION_TEXT_MAX]; /* "exact", "kahan-li8 at step 0.05", or why nothing is known */
} solution;

/* Returns the times at which methods are compared with the solution: steps of size `step`, or (NaN) STUDY_SAMPLES equal
 * intervals. */
study_grid solution_grid(const study *, double step);
/* Finds the solution; if no method does, the status is OK and `known` is false. steps: of the methods under study, for
 * the bound on the work. enough: an error, in units of the motion's size, that need not be improved; 0: the best. Sets
 * the study's scale. Call solution_free in any case. */
motus_status solution_find(study *, const study_grid *, int64_t steps, double enough, solution *);
/* Computes the solution on another grid of its motion (grid->points rows), at steps no larger than solution->step. */
motus_status solution_on(study *, const solution *, const study_grid *, double *rows);
/* Takes a state of the solution, or one near it, from one time to another by the solution's method, at steps no larger
 * than its own. */
motus_status solution_go(study *, const solution *, double from, double t, double *y, motus_error *);
bool solution_same_time(double, double); /* up to rounding */
/* Return the time of a row of the table, and the last row that is not after t. */
double solution_time(const study_grid *, size_t row);
size_t solution_row(const study_grid *, double t);
/* Computes the solution at any time, from the nearest row of the table. */
motus_status solution_near(study *, const solution *, const study_grid *, double t, double *y, motus_error *err);
const char *solution_lacks(const solution *); /* why nothing is known */
/* Reports that nothing is known of the motion until that time. Returns MOTUS_DIVERGED. */
motus_status solution_missing(study *, const solution *, double until);
/* Returns the highest order that fixed steps can have on this motion, where the force is not smooth; it need not be a
 * whole number. 0: any. `why` becomes a sentence without capital and stop: "the force jumps at t = 2.5". */
double solution_allows(const study *, const solution *, char *why, size_t size);
void solution_free(study *, solution *);

#endif
