/* The ratio of two numbers, by their terms. */
#ifndef LANG_GRAPH_RATIO_H
#define LANG_GRAPH_RATIO_H

#include "lang/graph/graph.h"

enum { RATIO_FACTORS = 8 };
/* A number times powers of nodes that do not move, in the order of the nodes. */
typedef struct ratio {
    double number; /* 0: there is no ratio, or none was found */
    int count;
    node of[RATIO_FACTORS];
    int power[RATIO_FACTORS];
} ratio;

/* Returns w over u. */
ratio ratio_of(const graph *, node u, node w);
bool ratio_same(const ratio *, const ratio *);
/* Return n times a ratio, and n times its sign, which is NaN where a factor is 0. */
node ratio_times(graph *, const ratio *, node n);
node ratio_way_times(graph *, const ratio *, node n);

#endif
