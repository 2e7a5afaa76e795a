/* Remarks that explain the numbers of a comparison. */
#ifndef STUDY_REMARKS_H
#define STUDY_REMARKS_H

#include "solution.h"

/* What remarks need of a row besides its published numbers. */
typedef struct remarks_fact {
    const motus_method *card;
    motus_geometry geometry; /* of the method on this system */
    double last_step;
    double miss;            /* under constant acceleration: numerical minus exact final position, along `axis` */
    double expected;        /* the `miss` of explicit and symplectic Euler: ½ a Σ h² along `axis` */
    const double *roundoff; /* of each invariant: the largest deviation that rounding may explain */
} remarks_fact;

typedef struct remarks_view {
    const study *s;
    const solution *reference;
    motus_analysis analysis;
    const motus_compare_row *rows;
    const remarks_fact *facts;
    size_t count;
    size_t axis;         /* the position along which a constant acceleration is largest */
    double acceleration; /* along `axis`; NaN: it is not constant */
    double rate;         /* the fastest rate of the linearised motion; NaN: unknown */
} remarks_view;

/* Writes one sentence a line. Each states only what these numbers and the methods' rows confirm. */
void remarks_write(const remarks_view *, char *out, size_t size);

#endif
