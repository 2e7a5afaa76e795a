/* The value of a subscript, and the place of a reference in its space, for given loop variables. */
#ifndef LANG_GRAPH_GRAPH_PLACE_H
#define LANG_GRAPH_GRAPH_PLACE_H

#include "lang/graph/graph.h"

static inline int64_t graph_subscript(const subscript *s, const int64_t *index, const int64_t *ints)
{
    int64_t v = s->literal;
    if (s->level >= 0) v += index[s->level];
    if (s->slot >= 0) v += ints[s->slot];
    if (s->modulus >= 0) {
        int64_t m = ints[s->modulus] > 0 ? ints[s->modulus] : 1;
        v = 1 + (v % m + m) % m;
    }
    return v;
}

static inline size_t graph_element(const array *arrays, const reference *r, const int64_t *index, const int64_t *ints)
{
    const array *a = &arrays[r->array];
    int64_t at = (int64_t)a->base;
    for (int d = 0; d < r->dims; d++)
        at += (graph_subscript(&r->at[d], index, ints) - a->over->first[d]) * a->over->stride[d];
    return (size_t)at;
}

#endif
