/* Directions of numbers that move, sign(u) and u/|u|, written with as few surfaces as possible, since a motion may
 * slide on each. Factors that do not move stand outside, so sign(k u) is sign(k) sign(u): different texts of one
 * surface become equal nodes (lang/model/sliding.h). */
#include "lang/lower/lower_parts.h"

enum { MOVES = DEP_TIME | DEP_STATE, DEEP = 64 };

/* A number as a product of a factor that does not move and the rest. */
typedef struct split {
    node factor, rest;
} split;

static split split_of(graph *g, node n, int depth)
{
    const graph_node m = *graph_at(g, n);
    const split whole = {graph_const(g, 1), n};
    const node one = whole.factor;
    if (depth == DEEP || !(m.deps & MOVES)) return whole;
    if (m.op == OP_NEG) {
        const split a = split_of(g, m.a, depth + 1);
        return a.factor == one ? whole : (split){a.factor, graph_op(g, OP_NEG, a.rest, 0, 0)};
    }
    if (m.op == OP_MUL || m.op == OP_DIV) {
        const bool first = graph_deps(g, m.a) & MOVES, second = graph_deps(g, m.b) & MOVES;
        if (first == second || (m.op == OP_DIV && second)) return whole;
        const split a = split_of(g, first ? m.a : m.b, depth + 1);
        const node by = first ? m.b : m.a;
        const node factor = a.factor == one && m.op == OP_MUL ? by : graph_op(g, (operation)m.op, a.factor, by, 0);
        return (split){factor, a.rest};
    }
    if (m.op != OP_ADD && m.op != OP_SUB) return whole;
    const split a = split_of(g, m.a, depth + 1), b = split_of(g, m.b, depth + 1);
    if (a.factor != b.factor || a.factor == one) return whole;
    return (split){a.factor, graph_op(g, (operation)m.op, a.rest, b.rest, 0)};
}

node lower_sign(lowering *l, node u)
{
    graph *g = l->model->graph;
    const split s = split_of(g, u, 0);
    const node way = graph_op(g, OP_SIGN, s.rest, 0, 0);
    if (s.rest == u) return way;
    const graph_node f = *graph_at(g, s.factor);
    if (f.op == OP_CONST && f.value != 0) return f.value > 0 ? way : graph_op(g, OP_NEG, way, 0, 0);
    return graph_op(g, OP_MUL, graph_op(g, OP_SIGN, s.factor, 0, 0), way, 0);
}

/* Returns in *rest a product without one factor u. False: it has none. */
static bool without_factor(graph *g, node product, node u, int depth, node *rest)
{
    const graph_node n = *graph_at(g, product);
    node inner;
    if (product == u) return *rest = graph_const(g, 1), true;
    if (depth == DEEP || (n.op != OP_MUL && n.op != OP_NEG && n.op != OP_DIV)) return false;
    if (without_factor(g, n.a, u, depth + 1, &inner))
        return *rest = graph_op(g, (operation)n.op, inner, n.op == OP_NEG ? 0 : n.b, 0), true;
    if (n.op != OP_MUL || !without_factor(g, n.b, u, depth + 1, &inner)) return false;
    return *rest = graph_op(g, OP_MUL, n.a, inner, 0), true;
}

/* Returns the u of a factor |u| in a product, or UINT32_MAX. */
static node size_in(graph *g, node product, int depth)
{
    const graph_node n = *graph_at(g, product);
    if (n.op == OP_ABS) return n.a;
    if (depth == DEEP || (n.op != OP_MUL && n.op != OP_NEG && n.op != OP_DIV)) return UINT32_MAX;
    const node u = n.op == OP_MUL ? size_in(g, n.b, depth + 1) : UINT32_MAX;
    return u == UINT32_MAX ? size_in(g, n.a, depth + 1) : u;
}

/* A quotient a/b as above sign(u)/below. */
typedef struct direction {
    node u, above, below;
} direction;

/* Returns whether a/b has the form u/|k u|, or with `inverse` |k u|/u, of a number that moves and a factor that does
 * not. */
static bool find_direction(graph *g, node a, node b, bool inverse, direction *d)
{
    node again;
    const node of = size_in(g, inverse ? a : b, 0);
    if (of == UINT32_MAX || !(graph_deps(g, of) & MOVES)) return false;
    const split s = split_of(g, of, 0);
    const node size = graph_op(g, OP_ABS, of, 0, 0), factor = graph_op(g, OP_ABS, s.factor, 0, 0);
    const node forms[] = {of, s.rest};
    for (int k = 0; k < (s.rest == of ? 1 : 2); k++) {
        const node u = forms[k], divisor = inverse ? u : size;
        if (!without_factor(g, b, divisor, 0, &d->below) || without_factor(g, d->below, divisor, 0, &again) ||
            !without_factor(g, a, inverse ? size : u, 0, &d->above))
            continue;
        node *const with = inverse ? &d->above : &d->below;
        if (k > 0) *with = graph_op(g, OP_MUL, *with, factor, 0);
        d->u = u;
        return true;
    }
    return false;
}

/* Returns a/b, with sign(u) for u/|u| and |u|/u of a number that moves: it jumps at 0, and has no pole. */
node lower_ratio(lowering *l, node a, node b)
{
    graph *g = l->model->graph;
    direction d;
    if (failed(l) || (!find_direction(g, a, b, false, &d) && !find_direction(g, a, b, true, &d)))
        return binary(l, OP_DIV, a, b);
    const node way = lower_sign(l, d.u), one = graph_const(g, 1);
    const node top = d.above == one ? way : binary(l, OP_MUL, d.above, way);
    return d.below == one ? top : binary(l, OP_DIV, top, d.below);
}
