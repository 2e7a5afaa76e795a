/* From monotone pieces of p, taken from tau = 0 to tau = 1, to the places where the sign of g changes or is uncertain.
 *
 * Invariant: between two ends of pieces p is monotone, up to what the noise hides; all places up to `tau` are in `out`,
 * except one that is still open at `tau`.
 */
#ifndef CORE_ROOTS_SCAN_H
#define CORE_ROOTS_SCAN_H

#include "core/roots.h"
#include "core/roots_cell.h"

typedef struct roots_scan {
    double noise, steep; /* |p - g| <= min(noise, steep tau) */
    double doubt;        /* |d(p - g)/dtau| <= doubt */
    double slack;
    roots_root *out;
    size_t most;
    roots_found *found;
    double tau, value; /* the end of the last piece */
    int side;          /* the last certain sign of g; 0: none yet */
    bool inside;       /* |p| <= noise at tau */

    /* of the place that is open: */
    double from, entry;  /* where it begins, and side * p at the end before it */
    double zero;         /* where p last changed its sign in it */
    int zeros;           /* how often p did so */
    double low, low_tau; /* the least side * p, and where */
    bool low_turns;      /* `low` is an extremum of p */

    /* of an extremum that may come: */
    int way;
    double top, top_tau;
} roots_scan;

double roots_scan_noise(const roots_scan *, double tau);
/* Begins at tau = 0. slope, value: dp/dtau and p there. False, of all three functions: `out` is full. */
bool roots_scan_start(roots_scan *, int before, double slope, double value);
/* Takes the piece from the last end, x0, to x1, where p is p1. least: a lower bound on |dp/dx| on the piece, or 0.
 * turns: x1 is an extremum. */
bool roots_scan_piece(roots_scan *, const roots_cell *, double x0, double x1, double p1, double least, bool turns);
/* Ends at tau = 1. slope: dp/dtau there. */
bool roots_scan_end(roots_scan *, double slope);

#endif
