/* See rounding.h. */
#include "machine/rounding.h"

/* Returns the bound of a leaf: half an ulp for the time and numbers of the state; 0 for the pool's. */
static node of_leaf(graph *g, node leaf, void *ctx)
{
    (void)ctx;
    const graph_node *n = graph_at(g, leaf);
    const bool moves =
        n->op == OP_TIME || (n->op == OP_LOAD && g->arrays[g->references[n->a].array].space != SPACE_POOL);
    return moves ? graph_op(g, OP_ABS, leaf, 0, 0) : 0;
}

output *rounding_outputs(model *m, const output *of, size_t count)
{
    output *to = arena_room(m->arena, (count + 1) * sizeof *to);
    for (size_t k = 0; to && k < count; k++) {
        to[k] = of[k];
        to[k].value = graph_rounding(m->graph, of[k].value, of_leaf, NULL);
    }
    return m->arena->failed ? NULL : to;
}

tape *rounding_tape(model *m, const output *of, size_t count)
{
    const output *to = rounding_outputs(m, of, count);
    return to ? tape_of(m->arena, m->graph, to, count) : NULL;
}
