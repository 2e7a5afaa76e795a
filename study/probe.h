/* Properties of the equations, measured by runs of one step: the acceleration, the fastest rate of the linearised
 * motion, and by how much rounding of the state changes an invariant. */
#ifndef STUDY_PROBE_H
#define STUDY_PROBE_H

#include "study.h"

/* Computes a (nv numbers) at (t, y). False: it cannot be computed. */
bool probe_acceleration(study *, double t, const double *y, double *a);
/* Returns the largest |eigenvalue| of the Jacobian of (x', v') at (t, y), by power iteration, in the study's scale: ω
 * of the fastest oscillation, or the fastest decay or growth. 0: negligible; NaN: it cannot be computed. */
double probe_rate(study *, double t, const double *y);
/* Returns how fast the state changes at (t, y), in units of its size per time: at most ω/2 for an oscillation. NaN: it
 * cannot be computed. */
double probe_speed(study *, double t, const double *y);
/* Raises scale[c] to at least the change of column c when every number of the state at (t, y) changes by its own
 * size: rounding the state changes column c by about DBL_EPSILON scale[c]. */
motus_status probe_columns(study *, double t, const double *y, const size_t *columns, size_t column_count,
                           double *scale);

#endif
