/* A node for what rounding adds to a value: the running error analysis of Wilkinson.
 *
 * Every operation is within one rounding of its exact result, a function within two, and passes on the errors of its
 * operands by its slopes (graph_derivative.c): E = |R| + sum |dR/dk| Ek.
 *
 * Invariant: an error of 0 is passed on as 0, also where the slope is infinite. Jumps, which have no slope, pass on
 * nothing.
 */
#include "lang/graph/graph_walk.h"

#include <math.h>

static node size_of(graph *g, node n) { return graph_op(g, OP_ABS, n, 0, 0); }

/* Returns the error of a constant: unless it is a whole number, it was rounded when it was read. */
static node of_constant(graph *g, double c) { return floor(c) == c ? 0 : graph_const(g, fabs(c)); }

static node passed_on(graph *g, const graph_node *n, node self, int operand, node error)
{
    node slope[3] = {0, 0, 0};
    slope[operand] = graph_const(g, 1);
    const node s = graph_derivative_rule(g, n, self, slope);
    if (!s) return 0;
    const node product = graph_op(g, OP_MUL, size_of(g, s), error, 0);
    const bool bounded = n->op == OP_NEG || n->op == OP_ADD || n->op == OP_SUB || n->op == OP_MUL || n->op == OP_SUM;
    return bounded ? product : graph_op(g, OP_SELECT, graph_op(g, OP_NE, error, 0, 0), product, 0);
}

/* Returns the error of one operation, from those of its operands. */
static node of_operation(graph *g, node self, const node error[3])
{
    const graph_node n = g->nodes[self];
    node operand[3];
    const int arity = graph_operands(&n, operand);
    if (operation_is((operation)n.op, IS_FLAT)) return 0;
    if (n.op == OP_SUM) {
        const node body = error[0] ? graph_sum(g, n.level, &g->ranges[n.c], n.b, error[0]) : 0;
        return graph_op(g, OP_ADD, body, size_of(g, self), 0);
    }
    if (n.op == OP_NEG || n.op == OP_ABS) return error[0];
    if (n.op == OP_SELECT) return graph_op(g, OP_SELECT, operand[0], error[1], error[2]);
    node sum = size_of(g, self);
    for (int k = 0; k < arity; k++)
        if (error[k]) sum = graph_op(g, OP_ADD, sum, passed_on(g, &n, self, k, error[k]), 0);
    return sum;
}

node graph_rounding(graph *g, node root, graph_seed leaf, void *ctx)
{
    graph_walk w;
    if (!graph_order(g, &root, 1, 0, true, &w)) return 0;
    node *e = graph_walk_room(g, &w, sizeof *e);
    const bool before = g->simplify;
    g->simplify = true;
    for (uint32_t k = 0; e && k < w.count && !g->arena->failed && !g->too_large; k++) {
        const graph_node n = g->nodes[w.nodes[k]];
        node operand[3], error[3] = {0, 0, 0};
        const int arity = graph_operands(&n, operand);
        for (int j = 0; j < arity; j++) error[j] = e[g->place[operand[j]]];
        e[k] = arity              ? of_operation(g, w.nodes[k], error)
               : n.op == OP_CONST ? of_constant(g, n.value)
               : n.op == OP_INDEX ? 0
                                  : leaf(g, w.nodes[k], ctx);
    }
    g->simplify = before;
    return graph_walk_end(g, &w, e);
}
