/* The derivative of a node by the rules of calculus, one rule a row of operations.def.
 *
 * Invariant: where no operand varies, the derivative is node 0 and no node is made. A branch that is not taken and a
 * masked term are excluded by SELECT or a condition, never multiplied by zero.
 */
#include "lang/graph/graph_walk.h"
#include "lang/base/operation.h"

node graph_derivative_rule(graph *g, const graph_node *n, node self, const node slope[3])
{
    const node A = n->a, B = n->b, C = n->c, DA = slope[0], DB = slope[1], DC = slope[2], R = self, ZERO = 0;
    (void)A, (void)B, (void)C, (void)DA, (void)DB, (void)DC, (void)R;
#define CONST(value) graph_const(g, value)
#define ONE CONST(1)
#define NEG(x) graph_op(g, OP_NEG, x, 0, 0)
#define ADD(x, y) graph_op(g, OP_ADD, x, y, 0)
#define SUB(x, y) graph_op(g, OP_SUB, x, y, 0)
#define MUL(x, y) graph_op(g, OP_MUL, x, y, 0)
#define DIV(x, y) graph_op(g, OP_DIV, x, y, 0)
#define SELECT(c, x, y) graph_op(g, OP_SELECT, c, x, y)
#define NE(x, y) graph_op(g, OP_NE, x, y, 0)
#define OR(x, y) graph_op(g, OP_OR, x, y, 0)
#define GT(x, y) graph_op(g, OP_GT, x, y, 0)
#define LE(x, y) graph_op(g, OP_LE, x, y, 0)
#define GE(x, y) graph_op(g, OP_GE, x, y, 0)
#define POW(x, y) graph_op(g, OP_POW, x, y, 0)
#define SIN(x) graph_op(g, OP_SIN, x, 0, 0)
#define COS(x) graph_op(g, OP_COS, x, 0, 0)
#define SINH(x) graph_op(g, OP_SINH, x, 0, 0)
#define COSH(x) graph_op(g, OP_COSH, x, 0, 0)
#define EXP(x) graph_op(g, OP_EXP, x, 0, 0)
#define LOG(x) graph_op(g, OP_LOG, x, 0, 0)
#define SQRT(x) graph_op(g, OP_SQRT, x, 0, 0)
#define SIGN(x) graph_op(g, OP_SIGN, x, 0, 0)
#define FLOOR(x) graph_op(g, OP_FLOOR, x, 0, 0)
    switch ((operation)n->op) {
#define OP(id, arity, spelling, degree, nature, value, derivative, keeps, sums, recurrence) \
    case OP_##id:                                                                           \
        return derivative;
#include "lang/base/operations.def"
#undef OP
    case OPERATIONS: break;
    }
    return 0;
}

static node slope(graph *g, const node *d, const graph_walk *w, node n)
{
    return graph_reached(g, w, n) ? d[g->place[n]] : 0;
}

node graph_derivative(graph *g, node root, graph_seed seed, void *ctx)
{
    graph_walk w;
    const unsigned moving = DEP_TIME | DEP_STATE | DEP_D | DEP_PARAM | DEP_LEVELS;
    if (!graph_order(g, &root, 1, moving, true, &w)) return 0;
    node *d = graph_walk_room(g, &w, sizeof *d);
    /* Leaves first: a seed may walk the graph itself, which overwrites `place`; the rules need it. */
    for (uint32_t k = 0; d && k < w.count; k++) {
        uint8_t op = g->nodes[w.nodes[k]].op;
        if (op == OP_TIME || op == OP_LOAD || op == OP_PARAM || op == OP_TABLE) d[k] = seed(g, w.nodes[k], ctx);
    }
    bool before = g->simplify;
    g->simplify = true;
    graph_order_again(g, &w);
    for (uint32_t k = 0; d && k < w.count && !g->arena->failed && !g->too_large; k++) {
        const graph_node n = g->nodes[w.nodes[k]];
        node operand[3], dn[3] = {0, 0, 0};
        int arity = graph_operands(&n, operand);
        if (!arity) continue;
        for (int j = 0; j < arity; j++) dn[j] = slope(g, d, &w, operand[j]);
        if (n.op == OP_SUM)
            d[k] = dn[0] ? graph_sum(g, n.level, &g->ranges[n.c], n.b, dn[0]) : 0;
        else if (dn[0] || dn[1] || dn[2])
            if (!g->tidy || !graph_op_slope(g, &n, w.nodes[k], dn[0], dn[1], &d[k]))
                d[k] = graph_derivative_rule(g, &n, w.nodes[k], dn);
    }
    g->simplify = before;
    return graph_walk_end(g, &w, d);
}

/* Seeds ------------------------------------------------------------------------------------------------------------ */

node graph_seed_direction(graph *g, node leaf, void *graph_shift_ctx)
{
    const graph_shift *shift = graph_shift_ctx;
    const graph_node *n = &g->nodes[leaf];
    if (n->op != OP_LOAD) return 0;
    reference ref = g->references[n->a];
    space s = g->arrays[ref.array].space;
    if ((s != SPACE_X && s != SPACE_V) || g->arrays[ref.array].mode) return 0;
    ref.array = (uint16_t)(ref.array + (s == SPACE_X ? shift->x_to : shift->v_to));
    return graph_load(g, &ref);
}

node graph_seed_time(graph *g, node leaf, void *unused)
{
    (void)unused;
    return graph_at(g, leaf)->op == OP_TIME ? graph_const(g, 1) : 0;
}
