/* The order of a method that chooses its steps: its errors at falling tolerances, at the ends of steps and between. */
#ifndef STUDY_PACED_H
#define STUDY_PACED_H

#include "fit.h"
#include "solution.h"

typedef struct paced {
    study *s;
    const solution *reference;
    const study_grid *grid; /* of the reference: errors are taken at the first ends of steps at or after its times */
    double *room;           /* 2 states */
    size_t *columns;        /* of the numbers of a state */
} paced;

/* The tolerance of point i; 0: there is none so small. */
double paced_tolerance(const motus_method *, size_t i);
/* One run. A failure leaves errors NaN, and goes to *failed. */
motus_status paced_measure(paced *, const char *method, motus_point *, int64_t *steps, motus_error *,
                           motus_status *failed);
/* Round-off, in units of the motion's size: of the errors, as fit_order tells it, and of one number. */
typedef struct paced_noise {
    double floor, number, duration;
} paced_noise;
/* Judges the points of a row and writes its certificate. exact: all errors are round-off. */
void paced_certify(const motus_method *, const paced_noise *, bool exact, motus_point *points, motus_converge_row *,
                   char *text, size_t size);

#endif
