/* The ratio of two numbers that move, where the ratio does not. Each number is a sum of terms, and a term is a number
 * times powers of nodes that do not move, times one node that does. k (a - b) and b - a have the ratio -1/k, however a
 * and b move. */
#include "lang/graph/ratio.h"

#include <math.h>
#include <stdlib.h>

enum { TERMS_MOST = 32, TERMS_DEEP = 64, MOVES = DEP_TIME | DEP_STATE };
static const node NOTHING = UINT32_MAX; /* in place of the node that moves */

typedef struct terms {
    node of[TERMS_MOST];
    ratio by[TERMS_MOST];
    int count; /* TERMS_MOST + 1: there are more terms, or one has too many factors */
} terms;

static bool add_factor(ratio *to, node n, int power)
{
    int k = 0;
    while (k < to->count && to->of[k] < n) k++;
    if (k < to->count && to->of[k] == n) {
        to->power[k] += power;
        if (to->power[k]) return true;
        to->count--;
        for (; k < to->count; k++) to->of[k] = to->of[k + 1], to->power[k] = to->power[k + 1];
        return true;
    }
    if (to->count == RATIO_FACTORS) return false;
    for (int j = to->count++; j > k; j--) to->of[j] = to->of[j - 1], to->power[j] = to->power[j - 1];
    to->of[k] = n, to->power[k] = power;
    return true;
}

/* Multiplies a ratio by a power of n, which does not move. */
static bool add_factors(const graph *g, node n, int power, int depth, ratio *to)
{
    const graph_node *at = graph_at(g, n);
    const operation op = (operation)at->op;
    if (op == OP_CONST) {
        to->number = power > 0 ? to->number * at->value : to->number / at->value;
        return true;
    }
    if (depth == TERMS_DEEP || (op != OP_NEG && op != OP_MUL && op != OP_DIV)) return add_factor(to, n, power);
    if (op == OP_NEG) to->number = -to->number;
    return add_factors(g, at->a, power, depth + 1, to) &&
           (op == OP_NEG || add_factors(g, at->b, op == OP_DIV ? -power : power, depth + 1, to));
}

static bool same_factors(const ratio *a, const ratio *b)
{
    bool same = a->count == b->count;
    for (int k = 0; same && k < a->count; k++) same = a->of[k] == b->of[k] && a->power[k] == b->power[k];
    return same;
}

/* Returns whether two nodes are one, or products of two equal factors. */
static bool same_node(const graph *g, node p, node q)
{
    if (p == q || p == NOTHING || q == NOTHING) return p == q;
    const graph_node *a = graph_at(g, p), *b = graph_at(g, q);
    return a->op == OP_MUL && b->op == OP_MUL && a->a == b->b && a->b == b->a;
}

static void add_term(const graph *g, terms *to, node n, const ratio *by)
{
    int k = 0;
    while (k < to->count && k < TERMS_MOST && !(same_node(g, to->of[k], n) && same_factors(&to->by[k], by))) k++;
    if (k >= TERMS_MOST || to->count > TERMS_MOST) {
        to->count = TERMS_MOST + 1;
        return;
    }
    if (k == to->count) to->of[to->count] = n, to->by[to->count] = *by, to->by[to->count++].number = 0;
    to->by[k].number += by->number;
}

static void add_terms(const graph *g, node n, ratio by, int depth, terms *to)
{
    const graph_node at = *graph_at(g, n);
    const operation op = (operation)at.op;
    const bool product = op == OP_MUL || op == OP_DIV;
    const bool first = product && graph_deps(g, at.a) & MOVES, second = product && graph_deps(g, at.b) & MOVES;
    bool fits = true;
    if (depth < TERMS_DEEP && (op == OP_ADD || op == OP_SUB)) {
        add_terms(g, at.a, by, depth + 1, to);
        if (op == OP_SUB) by.number = -by.number;
        add_terms(g, at.b, by, depth + 1, to);
    } else if (depth < TERMS_DEEP && op == OP_NEG) {
        by.number = -by.number;
        add_terms(g, at.a, by, depth + 1, to);
    } else if (depth < TERMS_DEEP && first != second && (op == OP_MUL || first)) {
        fits = add_factors(g, first ? at.b : at.a, op == OP_DIV ? -1 : 1, depth, &by);
        if (fits) add_terms(g, first ? at.a : at.b, by, depth + 1, to);
    } else if (!(at.deps & MOVES)) {
        fits = add_factors(g, n, 1, depth, &by);
        if (fits) add_term(g, to, NOTHING, &by);
    } else {
        add_term(g, to, n, &by);
    }
    if (!fits) to->count = TERMS_MOST + 1;
}

static terms terms_of(const graph *g, node n)
{
    terms t = {.count = 0};
    int kept = 0;
    add_terms(g, n, (ratio){.number = 1}, 0, &t);
    if (t.count > TERMS_MOST) return (terms){.count = 0};
    for (int k = 0; k < t.count; k++)
        if (t.by[k].number != 0) t.of[kept] = t.of[k], t.by[kept++] = t.by[k];
    t.count = kept;
    return t;
}

static bool times(ratio *r, const ratio *by, int power)
{
    r->number = power > 0 ? r->number * by->number : r->number / by->number;
    bool fits = true;
    for (int k = 0; k < by->count && fits; k++) fits = add_factor(r, by->of[k], power * by->power[k]);
    return fits;
}

bool ratio_same(const ratio *a, const ratio *b)
{
    return fabs(a->number - b->number) <= 0x1p-50 * fabs(b->number) && same_factors(a, b);
}

/* Returns whether every term of a, times r, is a term of b. */
static bool leads_to(const graph *g, const terms *a, const ratio *r, const terms *b)
{
    for (int i = 0; i < a->count; i++) {
        ratio by = a->by[i];
        bool found = false;
        if (!times(&by, r, 1)) return false;
        for (int j = 0; j < b->count && !found; j++)
            found = same_node(g, b->of[j], a->of[i]) && ratio_same(&by, &b->by[j]);
        if (!found) return false;
    }
    return true;
}

ratio ratio_of(const graph *g, node u, node w)
{
    const terms a = terms_of(g, u), b = terms_of(g, w);
    for (int j = 0; j < b.count && a.count == b.count; j++) {
        ratio r = b.by[j];
        if (!same_node(g, b.of[j], a.of[0]) || !times(&r, &a.by[0], -1) || !isfinite(r.number)) continue;
        if (leads_to(g, &a, &r, &b)) return r;
    }
    return (ratio){.number = 0};
}

static node with_number(graph *g, double number, node n)
{
    if (number == 1) return n;
    return number == -1 ? graph_op(g, OP_NEG, n, 0, 0) : graph_op(g, OP_MUL, graph_const(g, number), n, 0);
}

node ratio_times(graph *g, const ratio *r, node n)
{
    for (int k = 0; k < r->count; k++)
        for (int times = abs(r->power[k]); times > 0; times--)
            n = graph_op(g, r->power[k] > 0 ? OP_MUL : OP_DIV, n, r->of[k], 0);
    return with_number(g, r->number, n);
}

node ratio_way_times(graph *g, const ratio *r, node n)
{
    for (int k = 0; k < r->count; k++) {
        const node way = graph_op(g, OP_DIV, r->of[k], graph_op(g, OP_ABS, r->of[k], 0, 0), 0);
        n = graph_op(g, OP_MUL, r->power[k] % 2 ? way : graph_op(g, OP_ABS, way, 0, 0), n, 0);
    }
    return with_number(g, r->number < 0 ? -1 : 1, n);
}
