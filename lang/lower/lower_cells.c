/* Derivatives by a cell of a family: that of x[j] by x[i] is 1 where j is i, else 0.
 *
 * While a derivative is made, each such number is a leaf of its own, in which the derivative is linear. Then a sum over
 * j becomes the terms whose leaf is 1, if the sum is known to have these terms for every i: the force of a chain has
 * two terms, not N. Other leaves become conditions.
 */
#include "lang/lower/lower_diff.h"

enum { SHORTENED_MAX = 64 }; /* in cells, each of which takes a walk through every sum */

static bool never_equal(const subscript *a, const subscript *b)
{
    return a->level == b->level && a->slot == b->slot && a->modulus < 0 && b->modulus < 0 && a->literal != b->literal;
}

typedef enum within { WITHIN_NEVER, WITHIN_SOME, WITHIN_ALL } within;

/* Returns whether the values of a subscript lie in [first, last]. In a model that is divided where families read ghost
 * cells (lower_ghost.c), the index is divided here, too, so that SOME does not remain. */
static within values_within(lowering *l, const subscript *s, int64_t first, int64_t last)
{
    const model *m = l->model;
    if (s->level >= l->levels) return WITHIN_SOME; /* it is that of a sum inside the expression */
    const int64_t shift = s->literal + (s->slot >= 0 ? m->ints[s->slot] : 0);
    const int64_t low = shift + (s->level >= 0 ? l->low[s->level] : 0);
    const int64_t high = shift + (s->level >= 0 ? l->high[s->level] : 0);
    if (low >= first && high <= last) return WITHIN_ALL;
    if (!m->divided || s->modulus >= 0) return WITHIN_SOME;
    if (high < first || low > last) return WITHIN_NEVER;
    l->model->cut = (model_cut){true, s->level, (low < first ? first : last + 1) - shift};
    return WITHIN_SOME;
}

/* Returns whether one subscript is a number that the other never, always or sometimes has. */
static within constant_within(lowering *l, const subscript *a, const subscript *b)
{
    const subscript *number = a->level < 0 ? a : b, *other = a->level < 0 ? b : a;
    if (number->level >= 0 || number->modulus >= 0 || !l->model->divided) return WITHIN_SOME;
    const int64_t is = number->literal + (number->slot >= 0 ? l->model->ints[number->slot] : 0);
    return values_within(l, other, is, is);
}

/* Returns the derivative of a cell of an array by another one: 1 if all indices are equal, else 0. */
static node same_cell(lowering *l, const reference *a, const reference *b)
{
    graph *g = l->model->graph;
    node same = 0;
    bool any = false;
    for (int d = 0; d < a->dims; d++) {
        if (graph_same_subscript(&a->at[d], &b->at[d])) continue;
        if (never_equal(&a->at[d], &b->at[d])) return 0;
        const within constant = constant_within(l, &a->at[d], &b->at[d]);
        if (constant == WITHIN_NEVER) return 0;
        if (constant == WITHIN_ALL) continue;
        const node i = lower_subscript_number(l, &a->at[d]), j = lower_subscript_number(l, &b->at[d]);
        const node here = binary(l, OP_EQ, i, j);
        same = any ? binary(l, OP_AND, same, here) : here;
        any = true;
    }
    return any ? graph_op(g, OP_SELECT, same, graph_const(g, 1), graph_const(g, 0)) : graph_const(g, 1);
}

node lower_own_leaf(lowering *l)
{
    model *m = l->model;
    if (!m->leaf_array) {
        uint16_t at;
        if (!model_take_arrays(m, 1, &at)) return 0;
        m->arrays[at] = (array){.space = SPACE_DX, .dims = 1};
        m->leaf_array = at;
    }
    const reference r = {.array = m->leaf_array,
                         .dims = 1,
                         .at = {{.level = -1, .slot = -1, .modulus = -1, .literal = m->leaf_count++}}};
    return graph_load(m->graph, &r);
}

node lower_cell(differential *d, const reference *of)
{
    model *m = d->l->model;
    const reference by = m->graph->references[graph_at(m->graph, d->variable)->a];
    for (int k = 0; k < by.dims; k++)
        if (never_equal(&of->at[k], &by.at[k])) return 0;
    if (!d->cell_room) d->first_leaf = m->leaf_count;
    if (!arena_more(m->arena, &d->cells, d->cell_count, &d->cell_room, sizeof *d->cells)) return 0;
    d->cells[d->cell_count] = (cell){lower_own_leaf(d->l), *of};
    return d->cells[d->cell_count++].leaf;
}

/* Finds the only term that counts in a sum over j: that of x[j + c] by x[i] has j = i - c, which *at becomes.
 * WITHIN_SOME: it is not known that the sum has that term for every i, or for none. */
static within one_term(const differential *d, const graph_node *sum, const reference *of, subscript *at)
{
    const model *m = d->l->model;
    const graph *g = m->graph;
    const reference *by = &g->references[graph_at(g, d->variable)->a];
    const range *r = &g->ranges[sum->c];
    int e = -1;
    for (int k = 0; k < of->dims; k++) {
        if (of->at[k].level == (int8_t)sum->level && e < 0)
            e = k;
        else if (!graph_same_subscript(&of->at[k], &by->at[k]))
            return WITHIN_SOME;
    }
    if (e < 0 || r->first.level >= 0 || r->last.level >= 0) return WITHIN_SOME;
    const subscript *j = &of->at[e];
    *at = by->at[e];
    if (j->modulus >= 0 || at->modulus >= 0 || (j->slot >= 0 && j->slot != at->slot)) return WITHIN_SOME;
    if (j->slot >= 0) at->slot = -1;
    at->literal -= j->literal;
    const int64_t first = r->first.literal + (r->first.slot >= 0 ? m->ints[r->first.slot] : 0);
    const int64_t last = r->last.literal + (r->last.slot >= 0 ? m->ints[r->last.slot] : 0);
    return values_within(d->l, at, first, last);
}

/* Returns the cell whose leaf a node is, or NULL. */
static const cell *cell_of(const differential *d, node n)
{
    const graph *g = d->l->model->graph;
    const graph_node *m = graph_at(g, n);
    if (m->op != OP_LOAD || g->references[m->a].array != d->l->model->leaf_array) return NULL;
    const int32_t k = g->references[m->a].at[0].literal - d->first_leaf;
    return k >= 0 && k < (int32_t)d->cell_count ? &d->cells[k] : NULL;
}

typedef struct chosen_cell {
    const differential *d;
    node one; /* this leaf becomes 1, the others 0 */
} chosen_cell;

static node choose(graph *g, node n, int level, void *chosen_ctx)
{
    const chosen_cell *c = chosen_ctx;
    (void)level;
    return !cell_of(c->d, n) ? n : n == c->one ? graph_const(g, 1) : 0;
}

static node without(graph *g, node n, int level, void *leaf)
{
    (void)g, (void)level;
    return n == *(const node *)leaf ? 0 : n;
}

typedef struct moved_index {
    lowering *l;
    int level;
    subscript to;
    bool failed;
} moved_index;

/* Replaces an index by a place: another index plus a constant. */
static node moved(graph *g, node n, int level, void *moved_ctx)
{
    moved_index *to = moved_ctx;
    const graph_node *m = graph_at(g, n);
    (void)level;
    if (m->op == OP_SUM) to->failed = true;
    if (m->op == OP_INDEX) return m->level == to->level ? lower_subscript_number(to->l, &to->to) : n;
    if (m->op != OP_LOAD) return n;
    reference r = g->references[m->a];
    for (int k = 0; k < r.dims; k++) {
        if (r.at[k].level != to->level) continue;
        to->failed |= r.at[k].slot >= 0 && to->to.slot >= 0;
        r.at[k].level = to->to.level;
        r.at[k].literal += to->to.literal;
        if (to->to.slot >= 0) r.at[k].slot = to->to.slot;
    }
    return graph_load(g, &r);
}

/* Returns in *out the term of a sum for one cell. False: the sum must stay. */
static bool term_of_cell(differential *d, const graph_node *sum, node body, const cell *c, node *out)
{
    graph *g = d->l->model->graph;
    moved_index to = {.l = d->l, .level = sum->level};
    const unsigned deps = 1u << sum->level;
    const within term = one_term(d, sum, &c->of, &to.to);
    *out = 0;
    if (term != WITHIN_ALL) return term == WITHIN_NEVER;
    const node chosen = graph_replace(g, body, DEP_D, sum->level + 1, choose, &(chosen_cell){d, c->leaf});
    *out = graph_replace(g, chosen, deps, sum->level, moved, &to);
    if (sum->b) {
        const node condition = graph_replace(g, sum->b, deps, sum->level, moved, &to);
        *out = graph_op(g, OP_SELECT, condition, *out, 0);
    }
    return !to.failed;
}

/* Replaces the leaves: by terms of the sums around them, else by conditions. */
static node of_cells(graph *g, node n, int level, void *differential_ctx)
{
    differential *d = differential_ctx;
    const graph_node sum = *graph_at(g, n);
    (void)level;
    const reference by = g->references[graph_at(g, d->variable)->a];
    const cell *own = cell_of(d, n);
    if (own) return same_cell(d->l, &own->of, &by);
    if (sum.op != OP_SUM || d->cell_count > SHORTENED_MAX) return n;
    node body = sum.a, total = 0;
    for (uint32_t k = 0; k < d->cell_count && !failed(d->l); k++) {
        node term, leaf = d->cells[k].leaf;
        const node rest = graph_replace(g, body, DEP_D, sum.level + 1, without, &leaf);
        if (rest == body || !term_of_cell(d, &sum, body, &d->cells[k], &term)) continue;
        total = graph_op(g, OP_ADD, total, term, 0);
        body = rest;
    }
    if (body == sum.a) return n;
    const range r = g->ranges[sum.c];
    const node left = body ? graph_sum(g, sum.level, &r, sum.b, body) : 0;
    return graph_op(g, OP_ADD, graph_replace(g, left, DEP_D, sum.level, of_cells, d), total, 0);
}

node lower_cells(differential *d, node n)
{
    return graph_replace(d->l->model->graph, n, DEP_D, d->l->levels, of_cells, d);
}
