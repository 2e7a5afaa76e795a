/* How many operations a program takes: what choices between methods count, since a clock would choose otherwise on
 * every machine.
 */
#ifndef LANG_GRAPH_WEIGH_H
#define LANG_GRAPH_WEIGH_H

#include "lang/graph/graph.h"

typedef struct weight {
    double values;   /* of one evaluation, in units of a multiplication or an addition */
    double products; /* recurrences of its Taylor series that sum n terms for coefficient n: those of products of two */
    double sums;     /*   series, and of functions; and those that do not */
} weight;

/* Of one evaluation, with these bounds of loops; what parameters alone decide is not counted. False: no memory. */
bool weigh(arena *, const program *, const int64_t *ints, weight *);

#endif
