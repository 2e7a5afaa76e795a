/* Directions u/|u| of vectors that move. A force along one jumps where all components of u are 0, as dry friction in a
 * plane does where the motion stops. */
#include "lang/graph/ratio.h"

enum { DEEP = 32, MOVES = DEP_TIME | (DEP_STATE & ~DEP_MODE) };

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

/* Finds the components of a vector whose length is n: two or three that move, and not with the time alone. Returns how
 * many, or 0. */
static int length_of(const graph *g, node n, node *of)
{
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
        if (!(graph_deps(g, of[k]) & MOVES)) return 0;
    return count >= 2 ? count : 0;
}

/* Finds the vector whose length is a factor of a divisor, beside factors that do not move. */
static int length_in(const graph *g, node n, int depth, graph_directed *d)
{
    const graph_node *m = graph_at(g, n);
    if (m->op != OP_MUL || depth == DEEP) return d->length = n, length_of(g, n, d->component);
    const bool first = graph_deps(g, m->a) & MOVES, second = graph_deps(g, m->b) & MOVES;
    return first == second ? 0 : length_in(g, first ? m->a : m->b, depth + 1, d);
}

/* Returns whether n is a sum of components with factors. */
static bool along(const graph *g, node n, const graph_directed *d, int depth)
{
    const graph_node *m = graph_at(g, n);
    for (int k = 0; k < d->count; k++)
        if (ratio_of(g, d->component[k], n).number != 0) return true;
    if (depth == DEEP || !(m->deps & DEP_V)) return false;
    switch ((operation)m->op) {
    case OP_NEG:
    case OP_DIV: return along(g, m->a, d, depth + 1);
    case OP_MUL: return along(g, m->a, d, depth + 1) || along(g, m->b, d, depth + 1);
    case OP_ADD:
    case OP_SUB: return along(g, m->a, d, depth + 1) && along(g, m->b, d, depth + 1);
    default: return false;
    }
}

int graph_direction(const graph *g, node n, graph_directed *d)
{
    const graph_node *m = graph_at(g, n);
    d->factor = UINT32_MAX;
    if (m->op == OP_DIV && (d->count = length_in(g, m->b, 0, d)) && along(g, m->a, d, 0)) {
        d->divisor = m->b, d->above = m->a;
        return d->count;
    }
    for (int k = 0; m->op == OP_MUL && k < 2; k++) {
        const node quotient = k ? m->a : m->b, other = k ? m->b : m->a;
        const graph_node *q = graph_at(g, quotient);
        if (q->op != OP_DIV || !(d->count = length_in(g, q->b, 0, d))) continue;
        if (!along(g, other, d, 0) || along(g, q->a, d, 0)) continue;
        d->divisor = q->b, d->above = other, d->factor = q->a;
        return d->count;
    }
    return 0;
}

bool graph_is_along(const graph *g, node n, const graph_directed *d) { return along(g, n, d, 0); }

node graph_along(graph *g, node n, const graph_directed *d, const node *with)
{
    const graph_node m = *graph_at(g, n);
    for (int k = 0; k < d->count; k++) {
        const ratio r = ratio_of(g, d->component[k], n);
        if (r.number != 0) return ratio_times(g, &r, with[k]);
    }
    if (m.op == OP_ADD || m.op == OP_SUB) {
        const node a = graph_along(g, m.a, d, with), b = graph_along(g, m.b, d, with);
        return graph_op(g, (operation)m.op, a, b, 0);
    }
    const bool second = m.op == OP_MUL && !along(g, m.a, d, 0);
    const node inner = graph_along(g, second ? m.b : m.a, d, with);
    return second ? graph_op(g, OP_MUL, m.a, inner, 0)
                  : graph_op(g, (operation)m.op, inner, m.op == OP_NEG ? 0 : m.b, 0);
}

node graph_over(graph *g, node n, node divisor, node length)
{
    const graph_node m = *graph_at(g, divisor);
    if (divisor == length) return n;
    const bool first = graph_deps(g, m.a) & MOVES;
    return graph_op(g, OP_DIV, graph_over(g, n, first ? m.a : m.b, length), first ? m.b : m.a, 0);
}
