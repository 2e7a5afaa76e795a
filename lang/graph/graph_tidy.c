/* Derivatives as one writes them: 4 x^3 and not (x + x) x^2 + x^2 (x + x), -k/x^2 and not -(k/x)/x.
 *
 * Invariant: the identities are those of real numbers, and they change bits. They apply to derivatives that the model
 * asks for, which nothing else defines; never to what the user has written, nor to the derivatives inside methods.
 */
#include "lang/graph/graph_walk.h"

#include <math.h>

enum { POWER_MAX = 64, CHAIN_MAX = 12 };

static bool constant(const graph *g, node n) { return g->nodes[n].op == OP_CONST; }

/* An operation as it is, but for the identities of graph.c. */
static node plain(graph *g, operation op, node a, node b)
{
    g->tidy = false;
    const node n = graph_op(g, op, a, b, 0);
    g->tidy = true;
    return n;
}

/* The power that a chain of products is: as graph_power makes it, or by factors of the same base. */
static int power_of(const graph *g, node n, int depth, node *base)
{
    int exponent = 1;
    for (; g->nodes[n].op == OP_MUL && g->nodes[n].a == g->nodes[n].b && exponent < POWER_MAX; n = g->nodes[n].a)
        exponent *= 2;
    const graph_node *m = &g->nodes[n];
    if (m->op == OP_MUL && depth < CHAIN_MAX) { /* an odd power: its even half by the base */
        const int even = power_of(g, m->a, depth + 1, base);
        if (even > 1 && *base == m->b) return exponent * (even + 1);
    }
    *base = n;
    return exponent;
}

/* factor * rest; the number that a product or a quotient begins with */
typedef struct term {
    double factor;
    node rest;
} term;

static term term_of(graph *g, node n, int depth)
{
    const graph_node m = g->nodes[n];
    if (depth == CHAIN_MAX) return (term){1, n};
    if (m.op == OP_NEG) {
        const term t = term_of(g, m.a, depth + 1);
        return (term){-t.factor, t.rest};
    }
    if (m.op == OP_MUL && constant(g, m.a)) return (term){g->nodes[m.a].value, m.b};
    if (m.op != OP_MUL && m.op != OP_DIV) return (term){1, n};
    const term t = term_of(g, m.a, depth + 1);
    return t.factor == 1 ? (term){1, n} : (term){t.factor, plain(g, (operation)m.op, t.rest, m.b)};
}

/* 5 (x y) is written 5 x y: the number goes to the first factor. */
static node times(graph *g, double factor, node n, int depth)
{
    node base;
    const graph_node m = g->nodes[n];
    if (factor == 1) return n;
    if (factor == -1) return plain(g, OP_NEG, n, 0);
    if (depth < CHAIN_MAX && (m.op == OP_DIV || (m.op == OP_MUL && power_of(g, n, 0, &base) == 1)))
        return plain(g, (operation)m.op, times(g, factor, m.a, depth + 1), m.b);
    return plain(g, OP_MUL, graph_const(g, factor), n);
}

/* a b and b a */
static bool same_product(const graph *g, node a, node b)
{
    const graph_node *m = &g->nodes[a], *n = &g->nodes[b];
    return a == b || (m->op == OP_MUL && n->op == OP_MUL && m->a == n->b && m->b == n->a);
}

static bool like_terms(graph *g, node a, node b, double sign, node *out)
{
    if (constant(g, a) || constant(g, b)) return false;
    const term x = term_of(g, a, 0), y = term_of(g, b, 0);
    if (!same_product(g, x.rest, y.rest)) return false;
    const double factor = x.factor + sign * y.factor;
    *out = factor == 0 ? 0 : times(g, factor, x.rest, 0);
    return true;
}

static bool join_powers(graph *g, node a, node b, node *out)
{
    node base, other;
    const int exponent = power_of(g, a, 0, &base), more = power_of(g, b, 0, &other);
    if (base != other || constant(g, base) || exponent + more > POWER_MAX) return false;
    g->tidy = false; /* graph_power multiplies, too */
    *out = graph_power(g, base, exponent + more);
    g->tidy = true;
    return true;
}

static bool same_base(const graph *g, node a, node b)
{
    node x, y;
    (void)power_of(g, a, 0, &x), (void)power_of(g, b, 0, &y);
    return x == y && !constant(g, x);
}

/* u x times x^2 is u x^3, on whichever side the power stands. */
static bool join_factor(graph *g, node a, node b, node *out)
{
    const graph_node m = g->nodes[a], n = g->nodes[b];
    if (same_base(g, a, b)) return join_powers(g, a, b, out);
    if (m.op == OP_MUL && same_base(g, m.b, b))
        return *out = graph_op(g, OP_MUL, m.a, graph_op(g, OP_MUL, m.b, b, 0), 0), true;
    if (m.op == OP_MUL && same_base(g, m.a, b))
        return *out = graph_op(g, OP_MUL, graph_op(g, OP_MUL, m.a, b, 0), m.b, 0), true;
    if (n.op == OP_MUL && same_base(g, a, n.b))
        return *out = graph_op(g, OP_MUL, n.a, graph_op(g, OP_MUL, a, n.b, 0), 0), true;
    if (n.op == OP_MUL && same_base(g, a, n.a))
        return *out = graph_op(g, OP_MUL, graph_op(g, OP_MUL, a, n.a, 0), n.b, 0), true;
    return false;
}

/* Numbers come first, divisors last. */
static bool tidy_product(graph *g, node a, node b, node *out)
{
    const term x = term_of(g, a, 0), y = term_of(g, b, 0);
    const graph_node m = g->nodes[a], n = g->nodes[b];
    if (constant(g, a)) {
        if (m.value == 0 || (y.factor == 1 && n.op != OP_MUL && n.op != OP_DIV)) return false;
        return *out = times(g, m.value * y.factor, y.rest, 0), true;
    }
    if (constant(g, b)) return *out = graph_op(g, OP_MUL, b, a, 0), true;
    if (x.factor != 1 || y.factor != 1) {
        const node rest = graph_op(g, OP_MUL, x.rest, y.rest, 0);
        return *out = times(g, x.factor * y.factor, rest, 0), true;
    }
    if (m.op == OP_DIV) return *out = graph_op(g, OP_DIV, graph_op(g, OP_MUL, m.a, b, 0), m.b, 0), true;
    if (n.op == OP_DIV) return *out = graph_op(g, OP_DIV, graph_op(g, OP_MUL, a, n.a, 0), n.b, 0), true;
    return join_factor(g, a, b, out);
}

/* u x^m/x^n is u/x^(n-m) or u x^(m-n). */
static bool cancel_powers(graph *g, node a, node b, node *out)
{
    node base, other;
    const graph_node m = g->nodes[a];
    const int below = power_of(g, b, 0, &base), whole = power_of(g, a, 0, &other);
    const bool part = other != base && m.op == OP_MUL;
    const int above = part ? power_of(g, m.b, 0, &other) : whole;
    if (other != base || constant(g, base)) return false;
    const node rest = part ? m.a : graph_const(g, 1);
    const int left = above > below ? above - below : below - above;
    g->tidy = false; /* graph_power multiplies, too */
    const node power = graph_power(g, base, left);
    g->tidy = true;
    *out = above < below ? plain(g, OP_DIV, rest, power) : plain(g, OP_MUL, rest, power);
    return true;
}

static bool tidy_quotient(graph *g, node a, node b, node *out)
{
    const graph_node m = g->nodes[a];
    const term x = term_of(g, a, 0);
    if (constant(g, b)) {
        const double factor = x.factor / g->nodes[b].value;
        if (x.factor == 1 || constant(g, a) || !isfinite(factor)) return false;
        return *out = times(g, factor, x.rest, 0), true;
    }
    const term y = term_of(g, b, 0);
    if (y.factor != 1 && !constant(g, a) && isfinite(x.factor / y.factor)) {
        const node rest = graph_op(g, OP_DIV, x.rest, y.rest, 0);
        return *out = times(g, x.factor / y.factor, rest, 0), true;
    }
    if (m.op == OP_DIV) return *out = graph_op(g, OP_DIV, m.a, graph_op(g, OP_MUL, m.b, b, 0), 0), true;
    return cancel_powers(g, a, b, out);
}

bool graph_tidy_slope(graph *g, const graph_node *n, node self, node da, node db, node *out)
{
    node rate;
    switch ((operation)n->op) {
    case OP_SQRT: rate = graph_op(g, OP_DIV, da, graph_const(g, 2), 0); break;
    case OP_HYPOT: {
        const node first = graph_op(g, OP_MUL, n->a, da, 0), second = graph_op(g, OP_MUL, n->b, db, 0);
        rate = graph_op(g, OP_ADD, first, second, 0);
        break;
    }
    default: return false;
    }
    *out = graph_op(g, OP_DIV, rate, self, 0);
    return true;
}

bool graph_tidied(graph *g, operation op, node a, node b, node *out)
{
    switch (op) {
    case OP_ADD: return like_terms(g, a, b, 1, out);
    case OP_SUB: return like_terms(g, a, b, -1, out);
    case OP_MUL: return tidy_product(g, a, b, out);
    case OP_DIV: return tidy_quotient(g, a, b, out);
    default: return false;
    }
}
