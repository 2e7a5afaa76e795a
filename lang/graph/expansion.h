/* A program in Taylor series: its equations in the form that is expanded, and where each value's coefficients lie.
 * lang/tape/ and lang/emit/ both follow it, so their recurrences read the same operands.
 *
 * Memory: every run of a region (plan.h) takes a frame of the same size, one after the other in the order in which they
 * run, which is the same for every order of the series. Within it each value has the numbers that step/series.h says.
 * Lanes along the index of a loop over a family have a copy of the states that they read, and there may be as many runs
 * as fill whole vectors.
 */
#ifndef LANG_GRAPH_EXPANSION_H
#define LANG_GRAPH_EXPANSION_H

#include "lang/graph/graph.h"

struct plan;
enum {
    EXPANSION_ALL = 1 << 20, /* SERIES_ALL of step/series.h */
    EXPANSION_LANES = 8      /* the most lanes of a vector */
};

typedef struct expansion_value { /* of an item */
    uint32_t at;                 /* in its region's frame */
    uint32_t twin;               /* NONE, or the item whose first helper is this value: sin and cos together */
    int last;                    /* the last coefficient that may differ from 0, or EXPANSION_ALL */
    bool state;                  /* a position or velocity: its series is the state's */
    bool passing;                /* no coefficient is read but the one that is being computed: one number is enough */
} expansion_value;

typedef struct expansion {
    int length;
    expansion_value *values; /* by item */
    uint32_t *frames;        /* by region */
} expansion;

/* The outputs with the powers of one base joined: x/|r|^3 is x (r.r)^(-3/2), and a power that varies is an exponential.
 * NULL: the arena failed. */
program *expansion_program(arena *, graph *, const output *, size_t count);
/* `length` numbers a series, and where it is compact one for those that pass; false: the arena failed. */
bool expansion_place(expansion *, arena *, const struct plan *, int length, bool compact);
/* Whether the operation's recurrence computes coefficient 0 too. */
bool expansion_begins(const expansion *, const struct plan *, uint32_t item);

#endif
