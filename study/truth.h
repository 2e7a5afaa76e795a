/* The error of a state as `accuracy` means it: of every number, relative to the largest number so far of its kind
 * (positions, velocities, first-order variables), or absolute. The reference against which it is measured has an error
 * that is known in these units. */
#ifndef STUDY_TRUTH_H
#define STUDY_TRUTH_H

#include "solution.h"

enum { TRUTH_TIMES = 32, TRUTH_KINDS = 3 };

typedef struct truth {
    solution found;
    study_grid grid;           /* TRUTH_TIMES equal intervals */
    double relative, absolute; /* the largest error of the reference itself, at these times */
    double *size;              /* of each row of the solution: the largest number so far of each kind */
    double *room;              /* for a state */
} truth;

typedef struct truth_distance {
    double relative, absolute; /* NaN where a number is not finite */
} truth_distance;

/* Finds the reference of the study's motion; if there is none, the status is OK and `found.known` is false. Call
 * truth_free in any case. */
motus_status truth_find(study *, truth *);
/* Measures how far y is from the motion at time t, which is not before the first row after the start. */
motus_status truth_measure(study *, truth *, double t, const double *y, truth_distance *, motus_error *);
void truth_free(study *, truth *);

#endif
