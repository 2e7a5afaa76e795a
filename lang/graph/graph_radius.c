/* A node for how far a value may be from its value at a point, at all points of a box around it: interval arithmetic by
 * centre and radius [Rump99].
 *
 * An operation multiplies the radii of its operands by a bound on its slope over the whole box.
 *
 * Invariant: a radius is at least 2^-50 of the value at the centre, so it covers the rounding of the value. Where there
 * is no bound, as for a branch, it is infinite or NaN.
 */
#include "lang/graph/graph_walk.h"

#include <math.h>

static node add(graph *g, node a, node b) { return graph_op(g, OP_ADD, a, b, 0); }
static node subtract(graph *g, node a, node b) { return graph_op(g, OP_SUB, a, b, 0); }
static node multiply(graph *g, node a, node b) { return graph_op(g, OP_MUL, a, b, 0); }
static node divide(graph *g, node a, node b) { return graph_op(g, OP_DIV, a, b, 0); }
static node size_of(graph *g, node n) { return graph_op(g, OP_ABS, n, 0, 0); }

/* Returns 2^-`bits` of a value: more than any operation loses by rounding. */
static node rounding(graph *g, node value, int bits)
{
    return multiply(g, graph_const(g, ldexp(1, -bits)), size_of(g, value));
}

/* Returns `value` where `positive` is positive, else infinity. */
static node bounded(graph *g, node positive, node value)
{
    return graph_op(g, OP_SELECT, graph_op(g, OP_GT, positive, 0, 0), value, graph_const(g, INFINITY));
}

/* |Δ(a/b)| = |Δa - (a/b) Δb| / |b + Δb| */
static node of_quotient(graph *g, node self, node b, const node r[3])
{
    const node least = subtract(g, size_of(g, b), r[1]);
    return bounded(g, least, divide(g, add(g, r[0], multiply(g, size_of(g, self), r[1])), least));
}

/* Returns the radius of a function whose slope is at most 1. */
static node of_gentle(graph *g, node self, node r) { return add(g, r, rounding(g, self, 48)); }

static node of_operation(graph *g, node self, const node r[3])
{
    const graph_node n = g->nodes[self];
    node of[3];
    graph_operands(&n, of);
    switch ((operation)n.op) {
    case OP_NEG:
    case OP_ABS: return r[0];
    case OP_ADD:
    case OP_SUB: return add(g, r[0], r[1]);
    case OP_MUL:
        return add(g, multiply(g, size_of(g, of[0]), r[1]), multiply(g, r[0], add(g, size_of(g, of[1]), r[1])));
    case OP_DIV: return of_quotient(g, self, of[1], r);
    case OP_MIN:
    case OP_MAX: return graph_op(g, OP_MAX, r[0], r[1], 0);
    case OP_HYPOT: return of_gentle(g, self, add(g, r[0], r[1]));
    case OP_SIN:
    case OP_COS:
    case OP_ATAN:
    case OP_TANH: return of_gentle(g, self, r[0]);
    case OP_SQRT: return of_gentle(g, self, divide(g, r[0], self)); /* |√(a+Δ) - √a| <= |Δ|/√a */
    case OP_EXP: { /* eᵃ (e^r - 1), of which rounding loses a part of e^r */
        const node grown = graph_op(g, OP_EXP, r[0], 0, 0);
        return multiply(g, self, add(g, subtract(g, grown, graph_const(g, 1)), rounding(g, grown, 48)));
    }
    case OP_LOG: {
        const node least = subtract(g, of[0], r[0]);
        return of_gentle(g, self, bounded(g, least, divide(g, r[0], least)));
    }
    case OP_ENTRY: /* one entry, while only an event or a switch moves to another */
        return graph_deps(g, n.a) & (DEP_TIME | (DEP_STATE & ~DEP_MODE) | DEP_LEVELS) ? graph_const(g, INFINITY)
                                                                                      : rounding(g, self, 49);
    case OP_SUM: { /* the roundings of N terms add up */
        const node term = add(g, r[0], rounding(g, n.a, 30));
        return n.b ? graph_const(g, INFINITY) : graph_sum(g, n.level, &g->ranges[n.c], 0, term);
    }
    default: return graph_const(g, INFINITY);
    }
}

node graph_radius(graph *g, node root, graph_seed leaf, void *ctx)
{
    graph_walk w;
    if (!graph_order(g, &root, 1, 0, true, &w)) return 0;
    node *r = graph_walk_room(g, &w, sizeof *r);
    for (uint32_t k = 0; r && k < w.count && !g->arena->failed && !g->too_large; k++) {
        const graph_node n = g->nodes[w.nodes[k]];
        node operand[3], of[3] = {0, 0, 0};
        const int arity = graph_operands(&n, operand);
        for (int j = 0; j < arity; j++) of[j] = r[g->place[operand[j]]];
        if (arity)
            r[k] = of_operation(g, w.nodes[k], of);
        else if (n.op == OP_TABLE)
            r[k] = 0;
        else
            r[k] = add(g, rounding(g, w.nodes[k], 49),
                       n.op == OP_CONST || n.op == OP_INDEX ? 0 : leaf(g, w.nodes[k], ctx));
    }
    return graph_walk_end(g, &w, r);
}
