/* The order of an adaptive method: its errors at falling tolerances, at the ends of steps and between. */
#ifndef STUDY_PACED_H
#define STUDY_PACED_H

#include "fit.h"
#include "solution.h"

typedef struct paced {
    study *s;
    const solution *reference;
    /* of the reference; errors are taken at the first end of a step at or after each of its times */
    const study_grid *grid;
    double *room;    /* for 2 states */
    size_t *columns; /* of the numbers of a state */
} paced;

/* Returns the tolerance of point i; 0: there is no such point. */
double paced_tolerance(const motus_method *, size_t i);
/* Measures one point by a run. If the run fails, the errors are NaN, and *failed is its status. */
motus_status paced_measure(paced *, const char *method, motus_point *, int64_t *steps, motus_error *,
                           motus_status *failed);
/* Round-off in units of the motion's size: floor: of the errors, as fit_order finds it; number: of one number. */
typedef struct paced_noise {
    double floor, number, duration;
} paced_noise;
/* Judges the points of a row and writes its certificate. exact: all errors are round-off. */
void paced_certify(const motus_method *, const paced_noise *, bool exact, motus_point *points, motus_converge_row *,
                   char *text, size_t size);

#endif
