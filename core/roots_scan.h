/* From monotone pieces of p, told from tau = 0 to tau = 1, to the places where the sign of g changes or is uncertain.
 *
 * Invariant: between two ends of pieces p is monotone, up to what the noise hides; what happened up to `tau` is in
 * `out`, but for the place that is still open at `tau`.
 */
#ifndef CORE_ROOTS_SCAN_H
#define CORE_ROOTS_SCAN_H

#include "core/roots.h"
#include "core/roots_cell.h"

typedef struct roots_scan {
    double noise, steep; /* |p - g| <= min(noise, steep tau) */
    double doubt;        /* |d(p - g)/dtau| is at most this */
    double slack;
    roots_root *out;
    size_t most;
    roots_found *found;
    double tau, value; /* the end of the last piece */
    int side;          /* the last certain sign of g; 0: none yet */
    bool inside;       /* |p| <= noise at tau */

    /* the place that is open */
    double from, entry; /* where it begins, and side p at the end before it */
    double zero;        /* where p changed its sign, and how often it did */
    int zeros;
    double low, low_tau; /* least of side p, and where */
    bool low_turns;      /* it is an extremum of p */

    /* the extremum that may be to come */
    int way;
    double top, top_tau;
} roots_scan;

double roots_scan_noise(const roots_scan *, double tau);
/* slope, value: dp/dtau and p at 0. */
bool roots_scan_start(roots_scan *, int before, double slope, double value);
/* The piece from the last end, x0, to x1, where p is p1. least: a bound from below on |dp/dx| there, or 0. turns: x1 is
 * an extremum. All three say false where `out` is full. */
bool roots_scan_piece(roots_scan *, const roots_cell *, double x0, double x1, double p1, double least, bool turns);
/* slope: dp/dtau at 1. */
bool roots_scan_end(roots_scan *, double slope);

#endif
