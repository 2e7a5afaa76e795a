/* An order of evaluation of the nodes below some roots, for all that reads a graph. */
#ifndef LANG_GRAPH_GRAPH_WALK_H
#define LANG_GRAPH_GRAPH_WALK_H

#include "lang/graph/graph.h"

/* Operands of a node, 0 … 3 of them (a SUM: body and, if it has one, condition). */
int graph_operands(const graph_node *, node out[3]);

/* The nodes that the roots reach, operands first; g->place[n] is then the position of n. Only through nodes that
 * depend on something in `deps` (0: through all), and into the bodies of sums only if `into_sums`. One walk at a
 * time: a new walk overwrites `place`. Free `nodes` with give. False: no memory, and the arena is marked failed. */
typedef struct graph_walk {
    node *nodes;
    uint32_t count, capacity;
} graph_walk;
bool graph_order(graph *, const node *roots, size_t count, unsigned deps, bool into_sums, graph_walk *);
/* Restores `place` for this walk after another one. */
void graph_order_again(graph *, const graph_walk *);
static inline bool graph_reached(const graph *g, const graph_walk *w, node n)
{
    return g->place[n] < w->count && w->nodes[g->place[n]] == n;
}

/* graph_derivative.c: the derivative of an operation, from those of its operands, by its row of operations.def. */
node graph_derivative_rule(graph *, const graph_node *, node self, const node slope[3]);

/* graph_typed.c: whether a constant is known to be that; NULL: it is what it is read as. */
bool graph_same_typed(const graph *, node, const graph_typed *);
/* The node n of an operation, as it is to be where what decimals say of its operands is known. */
node graph_typed_op(graph *, node n, operation, const node operand[3]);
/* graph.c: as graph_op and graph_const, of what decimals say of a constant nothing or that. */
node graph_plain_op(graph *, operation, node a, node b, node c);
node graph_typed_const(graph *, double value, const graph_typed *);

/* graph_tidy.c: the node that this operation is by like terms and powers; false: it stays what it is. */
bool graph_tidied(graph *, operation, node a, node b, node *out);
/* The derivative of a root, whose kink at 0 has no slope here, as it is where a force is a gradient; false: the row of
 * operations.def says it. */
bool graph_tidy_slope(graph *, const graph_node *, node self, node da, node db, node *out);

#endif
