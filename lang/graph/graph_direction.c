/* Directions of vectors that move, u/|u|: a force along one jumps where all components of u are 0, as dry friction in a
 * plane does where the motion stops. See graph.h. */
#include "lang/graph/graph.h"

#include <string.h>

enum { DEEP = 32 };

static bool add_square(const graph *g, node n, node *of, int *count)
{
    const graph_node *m = graph_at(g, n);
    if (m->op != OP_MUL || m->a != m->b || *count == GRAPH_COMPONENTS) return false;
    for (int k = 0; k < *count; k++)
        if (of[k] == m->a) return false;
    of[(*count)++] = m->a;
    return true;
}

static bool add_squares(const graph *g, node n, int depth, node *of, int *count)
{
    const graph_node *m = graph_at(g, n);
    if (m->op != OP_ADD || depth == DEEP) return add_square(g, n, of, count);
    return add_squares(g, m->a, depth + 1, of, count) && add_squares(g, m->b, depth + 1, of, count);
}

/* The components of a vector of which n is the length: two or three that move, and not with the time alone. */
static int length_of(const graph *g, node n, node *of)
{
    const unsigned moving = DEP_TIME | (DEP_STATE & ~DEP_MODE);
    const graph_node *m = graph_at(g, n);
    int count = 0;
    if (!(m->deps & DEP_V) || m->deps & (DEP_A | DEP_D)) return 0;
    if (m->op == OP_HYPOT) {
        of[count++] = m->a;
        if (m->b != m->a) of[count++] = m->b;
    } else if (m->op != OP_SQRT || !add_squares(g, m->a, 0, of, &count)) {
        return 0;
    }
    for (int k = 0; k < count; k++)
        if (!(graph_deps(g, of[k]) & moving)) return 0;
    return count >= 2 ? count : 0;
}

static bool is_one(const graph *g, node n)
{
    const graph_node *m = graph_at(g, n);
    return m->op == OP_CONST && m->value == 1;
}

/* n as a component: 1, or -1 where it is b - a of a - b; 0: it is none of it. */
static int as_component(const graph *g, node n, node component)
{
    const graph_node *m = graph_at(g, n), *c = graph_at(g, component);
    if (n == component) return 1;
    return m->op == OP_SUB && c->op == OP_SUB && m->a == c->b && m->b == c->a ? -1 : 0;
}

/* Whether n is a sum of components with factors. */
static bool along(const graph *g, node n, const node *of, int count, int depth)
{
    const graph_node *m = graph_at(g, n);
    for (int k = 0; k < count; k++)
        if (as_component(g, n, of[k])) return true;
    if (depth == DEEP || !(m->deps & DEP_V)) return false;
    switch ((operation)m->op) {
    case OP_NEG:
    case OP_DIV: return along(g, m->a, of, count, depth + 1);
    case OP_MUL: return along(g, m->a, of, count, depth + 1) || along(g, m->b, of, count, depth + 1);
    case OP_ADD:
    case OP_SUB: return along(g, m->a, of, count, depth + 1) && along(g, m->b, of, count, depth + 1);
    default: return false;
    }
}

int graph_direction(const graph *g, node n, graph_directed *out)
{
    const graph_node *m = graph_at(g, n);
    if (m->op == OP_DIV && (out->count = length_of(g, m->b, out->component)) &&
        along(g, m->a, out->component, out->count, 0)) {
        out->length = m->b, out->above = m->a, out->factor = UINT32_MAX;
        return out->count;
    }
    for (int k = 0; m->op == OP_MUL && k < 2; k++) {
        const node quotient = k ? m->a : m->b, other = k ? m->b : m->a;
        const graph_node *q = graph_at(g, quotient);
        if (q->op != OP_DIV || !(out->count = length_of(g, q->b, out->component))) continue;
        if (!along(g, other, out->component, out->count, 0) || along(g, q->a, out->component, out->count, 0)) continue;
        out->length = q->b, out->above = other, out->factor = is_one(g, q->a) ? UINT32_MAX : q->a;
        return out->count;
    }
    return 0;
}

node graph_along(graph *g, node n, const node *component, const node *with, int count)
{
    const graph_node m = *graph_at(g, n);
    for (int k = 0; k < count; k++) {
        const int way = as_component(g, n, component[k]);
        if (way) return way > 0 ? with[k] : graph_op(g, OP_NEG, with[k], 0, 0);
    }
    if (m.op == OP_ADD || m.op == OP_SUB) {
        const node a = graph_along(g, m.a, component, with, count), b = graph_along(g, m.b, component, with, count);
        return graph_op(g, (operation)m.op, a, b, 0);
    }
    const bool second = m.op == OP_MUL && !along(g, m.a, component, count, 0);
    const node inner = graph_along(g, second ? m.b : m.a, component, with, count);
    return second ? graph_op(g, OP_MUL, m.a, inner, 0)
                  : graph_op(g, (operation)m.op, inner, m.op == OP_NEG ? 0 : m.b, 0);
}
