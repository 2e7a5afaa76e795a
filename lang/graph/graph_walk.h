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

/* graph.c: a node with these members, which refer to no reference and no range; a constant of which that is known. */
node graph_share(graph *, graph_node);
node graph_typed_const(graph *, double value, const graph_typed *);
static inline bool graph_is_const(const graph *g, node n, double value)
{
    return g->nodes[n].op == OP_CONST && g->nodes[n].value == value;
}

/* graph_typed.c: what is known of the node *n of an operation from what decimals say of its operands; not `of->known`:
 * nothing. A constant becomes that which it is to be, another node is to be so much larger. */
double graph_typed_op(graph *, node *n, operation, const node operand[3], graph_typed *of);

/* graph_op.c: the derivative of a root, whose kink at 0 has no slope here, as it is where a force is a gradient; false:
 * the row of operations.def says it. */
bool graph_op_slope(graph *, const graph_node *, node self, node da, node db, node *out);

#endif
