/* Why the numbers of a comparison are as they are. */
#ifndef STUDY_REMARKS_H
#define STUDY_REMARKS_H

#include "truth.h"

/* What a row of the comparison shows besides its published numbers. */
typedef struct remarks_fact {
    const motus_method *card;
    double last_step;
    double miss; /* constant acceleration: numerical minus true final position, along `axis` */
    /* ½ a Σ h² along `axis`: what a position misses that lags by one acceleration per step */
    double expected;
    const double *roundoff; /* per invariant: the largest drift that rounding may explain */
} remarks_fact;

typedef struct remarks_view {
    const study *s;
    const truth *truth;
    motus_analysis analysis;
    const motus_compare_row *rows;
    const remarks_fact *facts;
    size_t count;
    size_t axis;         /* the position along which a constant acceleration is largest */
    double acceleration; /* there; NaN unless it is constant */
    double rate;         /* fastest rate of the linearised motion found along it; NaN unknown */
} remarks_view;

/* Why the numbers are as they are: one sentence a line, only what these numbers and the methods' rows bear out. */
void remarks_write(const remarks_view *, char *out, size_t size);

#endif
