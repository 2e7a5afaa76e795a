/* See least.h. */
#include "machine/least.h"

#include "lang/graph/graph_place.h"

#include <math.h>

/* How far a leaf may be from its value at the centre. */
static node half_width(graph *g, node leaf, void *of)
{
    const model *m = of;
    graph_shift shift = {(uint16_t)(3 * m->block_size), (uint16_t)(3 * m->block_size)};
    return graph_seed_direction(g, leaf, &shift);
}

/* A tenth of a percent more than computed, for what rounding leaves of it. */
node least_radius(model *m, node value)
{
    graph *g = m->graph;
    if (graph_deps(g, value) & (DEP_TIME | DEP_A)) return graph_const(g, INFINITY);
    return graph_op(g, OP_MUL, graph_radius(g, value, half_width, m), graph_const(g, 1.001), 0);
}

node least_size(model *m, node value)
{
    graph *g = m->graph;
    if (graph_deps(g, value) & (DEP_TIME | DEP_A)) return graph_const(g, -1);
    return graph_op(g, OP_SUB, graph_op(g, OP_ABS, value, 0, 0), least_radius(m, value), 0);
}

node least_rate(model *m, node value, node rate)
{
    return graph_jump(m->graph, value) ? graph_const(m->graph, -1) : least_size(m, rate);
}
