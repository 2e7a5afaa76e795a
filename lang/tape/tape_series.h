/* The interpreter of Taylor series: expands a program order by order.
 *
 * Its recurrences and its memory are those of a compiled model (lang/emit/emit_series.c), and so are its bits.
 */
#ifndef LANG_TAPE_TAPE_SERIES_H
#define LANG_TAPE_TAPE_SERIES_H

#include "lang/tape/tape.h"

typedef struct tape_series tape_series;

/* One pass computes coefficient n of all values from those before. x and v hold the series of every position and
 * velocity, `length` numbers each, and get coefficient n of what the program writes there; `a` gets coefficient n of an
 * acceleration. `memory` has tape_series_numbers of numbers, kept from pass to pass. */
typedef struct series_pass {
    int n;
    double t; /* the time at which the series begins */
    double *x, *v, *a, *memory;
} series_pass;

/* Makes the series of a program of expansion_program. NULL: the arena failed. */
tape_series *tape_series_create(arena *, const program *, int length);
/* Takes the numbers at run time, which must outlive the use. */
void tape_series_bind(tape_series *, const binding *);
size_t tape_series_numbers(const tape_series *);
void tape_series_run(tape_series *, const series_pass *);

#endif
