/* The interpreter of Taylor series: a program, expanded order by order.
 *
 * It runs the same recurrences over the same memory as a compiled model (lang/emit/emit_series.c), so the bits are the
 * same.
 */
#ifndef LANG_TAPE_TAPE_SERIES_H
#define LANG_TAPE_TAPE_SERIES_H

#include "lang/tape/tape.h"

typedef struct tape_series tape_series;

/* One pass: coefficients n of all values, from those before. x and v: the series of every position and velocity,
 * `length` numbers each; what the program writes there is coefficient n of it, and coefficient n of an acceleration to
 * a. memory: tape_series_numbers of it, kept from pass to pass. */
typedef struct series_pass {
    int n;
    double t; /* where the series begins */
    double *x, *v, *a, *memory;
} series_pass;

/* Of a program of expansion_program; NULL: the arena failed. */
tape_series *tape_series_create(arena *, const program *, int length);
/* Takes the run-time numbers; what they point to must outlive the use. */
void tape_series_bind(tape_series *, const binding *);
size_t tape_series_numbers(const tape_series *);
void tape_series_run(tape_series *, const series_pass *);

#endif
