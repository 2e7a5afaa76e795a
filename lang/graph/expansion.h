/* A program in Taylor series: its equations in the form that is expanded, and where the coefficients of each value lie.
 * lang/tape/ and lang/emit/ both follow it, so their recurrences read the same operands.
 *
 * Memory: every run of a region (plan.h) takes a frame of one size. Frames lie in the order in which the regions run,
 * which is one order for all coefficients. A frame has the numbers of each value that step/series.h says. Lanes along
 * the index of a loop over a family have a copy of the states that they read; there may be as many runs as fill whole
 * vectors.
 */
#ifndef LANG_GRAPH_EXPANSION_H
#define LANG_GRAPH_EXPANSION_H

#include "lang/graph/graph.h"

struct plan;
enum {
    EXPANSION_ALL = 1 << 20, /* also SERIES_ALL of step/series.h */
    EXPANSION_LANES = 8      /* the most lanes of a vector */
};

typedef struct expansion_value { /* of an item of the plan */
    uint32_t at;                 /* its place in the frame of its region */
    uint32_t twin;               /* NONE, or the item whose first helper is this value: sin has cos, and cos sin */
    int last;                    /* the last coefficient that may differ from 0, or EXPANSION_ALL */
    bool state;                  /* it is a position or velocity, with the series of the state */
    bool passing;                /* only the coefficient being computed is read, so one number is enough */
} expansion_value;

typedef struct expansion {
    int length;
    expansion_value *values; /* by item */
    uint32_t *frames;        /* by region */
} expansion;

/* Copies the outputs with the powers of one base joined: x/|r|^3 is x (r.r)^(-3/2), and a power that varies is an
 * exponential. NULL: the arena failed. */
program *expansion_program(arena *, graph *, const output *, size_t count);
/* Places `length` numbers a series; compact: one number for a series that passes. False: the arena failed. */
bool expansion_place(expansion *, arena *, const struct plan *, int length, bool compact);
/* Returns whether the recurrence of an item computes coefficient 0, too. */
bool expansion_begins(const expansion *, const struct plan *, uint32_t item);

#endif
