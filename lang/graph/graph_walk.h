/* An order of evaluation of the nodes below some roots, for everything that reads a graph. */
#ifndef LANG_GRAPH_GRAPH_WALK_H
#define LANG_GRAPH_GRAPH_WALK_H

#include "lang/graph/graph.h"

/* Returns how many operands a node has, 0 … 3; those of a SUM are its body and, if it has one, its condition. */
int graph_operands(const graph_node *, node out[3]);

/* Lists the nodes that the roots reach, operands first; g->place[n] is then the position of n. The walk goes through
 * nodes that depend on something in `deps` (0: through all), and into the bodies of sums only if `into_sums`. A new
 * walk overwrites `place`. Free `nodes` with give. False: no memory, and the arena is marked failed. */
typedef struct graph_walk {
    node *nodes;
    uint32_t count, capacity;
} graph_walk;
bool graph_order(graph *, const node *roots, size_t count, unsigned deps, bool into_sums, graph_walk *);
/* Restores `place` for a walk after another one. */
void graph_order_again(graph *, const graph_walk *);
/* Takes room for an image of every node of a walk. NULL: no memory, and the arena is marked failed. */
void *graph_walk_room(graph *, const graph_walk *, size_t size);
/* Gives back a walk and the images of its nodes; returns the last image, or 0 after a failure. */
node graph_walk_end(graph *, const graph_walk *, node *image);
static inline bool graph_reached(const graph *g, const graph_walk *w, node n)
{
    return g->place[n] < w->count && w->nodes[g->place[n]] == n;
}

/* Returns how many operands a node of a walk has, with `as` in place of those that were reached; *same: none
 * differs. */
static inline int graph_operands_as(const graph *g, const graph_walk *w, const graph_node *n, const node *as,
                                    node operand[3], bool *same)
{
    const int arity = graph_operands(n, operand);
    *same = true;
    for (int j = 0; j < arity; j++) {
        const node was = operand[j];
        if (graph_reached(g, w, was)) operand[j] = as[g->place[was]];
        *same &= operand[j] == was;
    }
    return arity;
}

/* graph.c: copies a CONST, TIME, PARAM, INDEX or LOAD to another graph; false: the node is none. */
bool graph_copy_leaf(const graph *from, const graph_node *, graph *to, node *out);

/* graph_derivative.c: returns the derivative of an operation, from those of its operands, by its row of
 * operations.def. */
node graph_derivative_rule(graph *, const graph_node *, node self, const node slope[3]);

/* graph.c: graph_share returns the node with these members, which is neither a LOAD nor a SUM; graph_typed_const
 * returns a constant with what is known of it. */
node graph_share(graph *, graph_node);
node graph_typed_const(graph *, double value, const graph_typed *);
static inline bool graph_is_const(const graph *g, node n, double value)
{
    return g->nodes[n].op == OP_CONST && g->nodes[n].value == value;
}

/* graph_typed.c: finds what is known of the node *n of an operation, from what is known of its operands; not
 * `of->known`: nothing. If *n is a constant, it becomes the shadow's constant; else the result is to be added to *n. */
double graph_typed_op(graph *, node *n, operation, const node operand[3], graph_typed *of);

/* graph_op.c: makes the derivative of a root with no slope at the kink at 0, for a force that is a gradient. False: the
 * operation is no root. */
bool graph_op_slope(graph *, const graph_node *, node self, node da, node db, node *out);

#endif
