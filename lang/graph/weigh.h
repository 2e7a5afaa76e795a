/* The number of operations of a program, by which methods are chosen: a clock would choose otherwise on every machine.
 */
#ifndef LANG_GRAPH_WEIGH_H
#define LANG_GRAPH_WEIGH_H

#include "lang/graph/graph.h"

typedef struct weight {
    double values;   /* operations of one evaluation, in units of an addition */
    double products; /* recurrences of its Taylor series that sum n terms for coefficient n */
    double sums;     /* recurrences of its Taylor series that do not */
} weight;

/* Weighs one evaluation, with these bounds of loops and without what depends on parameters alone. False: no memory. */
bool weigh(arena *, const program *, const int64_t *ints, weight *);

#endif
