/* Operations: constants are folded, and derivatives use identities of real numbers.
 *
 * Invariant: identities may change bits or the sign of a zero, or hide a NaN, so what a user has written is never
 * changed. Simple identities are for all derivatives, those inside methods included. Those of terms and powers are for
 * derivatives that a model writes, and that nothing else defines: they give 4 x^3 in place of (x + x) x^2 + x^2 (x +
 * x), and -k/x^2 in place of -(k/x)/x.
 */
#include "lang/graph/graph_walk.h"

#include <math.h>

enum { POWER_MAX = 64, CHAIN_MAX = 12 };

static bool constant(const graph *g, node n) { return g->nodes[n].op == OP_CONST; }

/* Makes an operation with simple identities alone. */
static node plain(graph *g, operation op, node a, node b)
{
    g->tidy = false;
    const node n = graph_op(g, op, a, b, 0);
    g->tidy = true;
    return n;
}

/* Returns the exponent of a chain of products, made by graph_power or of factors with one base; 1: it is no power. */
static int power_of(const graph *g, node n, int depth, node *base)
{
    int exponent = 1;
    for (; g->nodes[n].op == OP_MUL && g->nodes[n].a == g->nodes[n].b && exponent < POWER_MAX; n = g->nodes[n].a)
        exponent *= 2;
    const graph_node *m = &g->nodes[n];
    if (m->op == OP_MUL && depth < CHAIN_MAX) { /* an odd power: an even one times the base */
        const int even = power_of(g, m->a, depth + 1, base);
        if (even > 1 && *base == m->b) return exponent * (even + 1);
    }
    *base = n;
    return exponent;
}

/* A term factor * rest, where the factor is the number that a product or a quotient begins with. */
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

/* Returns factor times n; the number goes to the first factor: 5 (x y) becomes 5 x y. */
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

/* Returns whether two nodes are one product, as a b and b a are. */
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
    g->tidy = false; /* graph_power uses graph_op */
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

/* Joins u x times x^2 as u x^3, on whichever side the power stands. */
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

/* Orders a product: numbers come first, divisors last. */
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

/* Writes u x^m/x^n as u/x^(n-m) or u x^(m-n). */
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
    g->tidy = false; /* graph_power uses graph_op */
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

/* Makes an operation by like terms and powers. False: they leave it as it is. */
static bool tidied(graph *g, operation op, node a, node b, node *out)
{
    switch (op) {
    case OP_ADD: return like_terms(g, a, b, 1, out);
    case OP_SUB: return like_terms(g, a, b, -1, out);
    case OP_MUL: return tidy_product(g, a, b, out);
    case OP_DIV: return tidy_quotient(g, a, b, out);
    default: return false;
    }
}

bool graph_op_slope(graph *g, const graph_node *n, node self, node da, node db, node *out)
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

/* Makes an operation by a simple identity. False: none applies. */
static bool simplified(graph *g, operation op, node a, node b, node c, node *out)
{
    const graph_node *na = &g->nodes[a], *nb = &g->nodes[b];
    switch (op) {
    case OP_NEG:
        if (na->op == OP_NEG) return *out = na->a, true;
        if (na->op == OP_SUB) return *out = graph_op(g, OP_SUB, na->b, na->a, 0), true;
        return false;
    case OP_ADD:
        if (graph_is_const(g, a, 0)) return *out = b, true;
        if (graph_is_const(g, b, 0)) return *out = a, true;
        if (nb->op == OP_NEG) return *out = graph_op(g, OP_SUB, a, nb->a, 0), true;
        if (na->op == OP_NEG) return *out = graph_op(g, OP_SUB, b, na->a, 0), true;
        return false;
    case OP_SUB:
        if (a == b) return *out = 0, true;
        if (graph_is_const(g, b, 0)) return *out = a, true;
        if (graph_is_const(g, a, 0)) return *out = graph_op(g, OP_NEG, b, 0, 0), true;
        if (nb->op == OP_NEG) return *out = graph_op(g, OP_ADD, a, nb->a, 0), true;
        return false;
    case OP_MUL:
        if (graph_is_const(g, a, 0) || graph_is_const(g, b, 0)) return *out = 0, true;
        if (graph_is_const(g, a, 1)) return *out = b, true;
        if (graph_is_const(g, b, 1)) return *out = a, true;
        if (graph_is_const(g, a, -1)) return *out = graph_op(g, OP_NEG, b, 0, 0), true;
        if (graph_is_const(g, b, -1)) return *out = graph_op(g, OP_NEG, a, 0, 0), true;
        if (na->op == OP_NEG) {
            node u = na->a;
            return *out = graph_op(g, OP_NEG, graph_op(g, OP_MUL, u, b, 0), 0, 0), true;
        }
        if (nb->op == OP_NEG) {
            node u = nb->a;
            return *out = graph_op(g, OP_NEG, graph_op(g, OP_MUL, a, u, 0), 0, 0), true;
        }
        if (nb->op == OP_CONST) return *out = graph_op(g, OP_MUL, b, a, 0), true;
        if (na->op == OP_CONST && nb->op == OP_MUL && g->nodes[nb->a].op == OP_CONST) {
            node rest = nb->b, factor = graph_op(g, OP_MUL, a, nb->a, 0);
            return *out = graph_op(g, OP_MUL, factor, rest, 0), true;
        }
        return false;
    case OP_DIV:
        if (graph_is_const(g, a, 0)) return *out = 0, true;
        if (graph_is_const(g, b, 1)) return *out = a, true;
        if (a == b) return *out = graph_const(g, 1), true;
        if (na->op == OP_NEG) {
            node u = na->a;
            return *out = graph_op(g, OP_NEG, graph_op(g, OP_DIV, u, b, 0), 0, 0), true;
        }
        return false;
    case OP_SELECT:
        if (b == c) return *out = b, true;
        if (na->op == OP_CONST) return *out = na->value != 0 ? b : c, true;
        return false;
    default: return false;
    }
}

/* Returns whether an operation is sqrt(u u). It is |u| to the last bit unless u u leaves the range of doubles, and as
 * |u| it has a kink that series and bars see. */
static bool of_square(const graph *g, operation op, node a, node b)
{
    const graph_node *const n = &g->nodes[a];
    return (op == OP_SQRT || (op == OP_POW && graph_is_const(g, b, 0.5))) && n->op == OP_MUL && n->a == n->b;
}

/* Makes an operation as graph_op does, without the exact values of constants. */
static node untyped_op(graph *g, operation op, node a, node b, node c)
{
    int arity = operation_at(op)->arity;
    node operand[3] = {a, arity > 1 ? b : 0, arity > 2 ? c : 0};
    unsigned deps = 0;
    bool constant = true;
    for (int k = 0; k < arity; k++) {
        deps |= g->nodes[operand[k]].deps;
        constant &= g->nodes[operand[k]].op == OP_CONST;
    }
    a = operand[0], b = operand[1], c = operand[2];
    if (constant) return graph_const(g, operation_value(op, g->nodes[a].value, g->nodes[b].value, g->nodes[c].value));
    if (of_square(g, op, a, b)) return graph_op(g, OP_ABS, g->nodes[a].a, 0, 0);
    node out;
    if (g->tidy && !g->arena->failed && !g->too_large && tidied(g, op, a, b, &out)) return out;
    if (g->simplify && !g->arena->failed && !g->too_large && simplified(g, op, a, b, c, &out)) return out;
    return graph_share(g, (graph_node){.op = (uint8_t)op, .deps = (uint16_t)deps, .a = a, .b = b, .c = c});
}

node graph_op(graph *g, operation op, node a, node b, node c)
{
    node n = untyped_op(g, op, a, b, c);
    graph_typed of;
    if (!g->typed) return n;
    const double by = graph_typed_op(g, &n, op, (const node[]){a, b, c}, &of);
    if (by != 0) n = untyped_op(g, OP_ADD, n, graph_const(g, by), 0);
    if (of.known && !g->arena->failed && !g->too_large) g->typed[n] = of;
    return n;
}

node graph_power(graph *g, node base, int exponent)
{
    if (exponent < 0) {
        node power = graph_power(g, base, -exponent); /* first, since C leaves the order of arguments open */
        return graph_op(g, OP_DIV, graph_const(g, 1), power, 0);
    }
    if (exponent == 0) return graph_const(g, 1);
    if (exponent == 1) return base;
    node half = graph_power(g, base, exponent % 2 ? exponent - 1 : exponent / 2);
    return graph_op(g, OP_MUL, half, exponent % 2 ? base : half, 0);
}

enum { IN_ORDER = 16, PARTIALS = 8 };

node graph_total(graph *g, const node *terms, size_t count)
{
    if (!count) return 0;
    if (count <= IN_ORDER) {
        node total = terms[0];
        for (size_t k = 1; k < count; k++) total = graph_op(g, OP_ADD, total, terms[k], 0);
        return total;
    }
    node p[PARTIALS];
    for (size_t k = 0; k < count; k++)
        p[k % PARTIALS] = k < PARTIALS ? terms[k] : graph_op(g, OP_ADD, p[k % PARTIALS], terms[k], 0);
    for (int width = 1; width < PARTIALS; width *= 2)
        for (int k = 0; k < PARTIALS; k += 2 * width) p[k] = graph_op(g, OP_ADD, p[k], p[k + width], 0);
    return p[0];
}
