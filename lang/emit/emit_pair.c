/* Sums that take each pair once: x[i]'' = Σ over j != i of a term whose costly part is equal for (i, j) and (j, i).
 *
 * Cell i takes the terms of all j > i and adds, for each, the term with the indices exchanged to the sum of cell j. The
 * partial sums of all cells wait in memory: sum c of cell j has partial p at own[(c rows + p) cells + j]; rows is 8, or
 * 1 where a sum has at most 16 terms; `own` and every row begin a cache line. When cell i is reached, all smaller cells
 * have added theirs, in their order, and its own loop adds the others, in theirs: so every partial sum takes its terms
 * in the order that defines the bits.
 *
 * A node is `even` if exchanging i and j leaves its bits as they are, and `odd` if that changes only the sign, or
 * leaves both zero: x[j] - x[i]. The exchanged term shares even nodes, and computes all others again.
 *
 * Invariant: no node that could differ in a bit, even in the sign of a zero, is called even.
 */
#include "lang/emit/emit_parts.h"

#include <stdio.h>
#include <string.h>

enum { EVEN = 1, ODD = 2 };
enum {
    DEP_PAIR = 1 << 0 | 1 << 1, /* the levels of i and of j */
    DEPTH_MAX = 6,              /* of two compared expressions; deeper ones count as different */
    NODES_MAX = 1000            /* nodes of a program */
};

static const graph_node *at(const writer *w, node n) { return &w->plan.g->nodes[n]; }

/* Effects of exchanging the indices -------------------------------------------------------------------------------- */

static int exchanged_level(int level) { return level == 0 ? 1 : level == 1 ? 0 : level; }

static reference exchanged_reference(const reference *r)
{
    reference other = *r;
    for (int d = 0; d < r->dims; d++) other.at[d].level = (int8_t)exchanged_level(r->at[d].level);
    return other;
}

/* Returns whether m is n with the indices exchanged. */
static bool is_exchanged(const writer *w, node n, node m, int depth)
{
    const graph_node *a = at(w, n), *b = at(w, m);
    if (!(a->deps & DEP_PAIR)) return n == m;
    if (a->op != b->op || depth == 0) return false;
    if (a->op == OP_INDEX) return exchanged_level(a->level) == b->level;
    if (a->op == OP_LOAD) {
        const reference other = exchanged_reference(&w->plan.g->references[a->a]);
        return graph_same_reference(&other, &w->plan.g->references[b->a]);
    }
    if (a->op == OP_SUM || a->op == OP_TOTAL) return false;
    const node mine[3] = {a->a, a->b, a->c}, other[3] = {b->a, b->b, b->c};
    for (int k = 0; k < operation_at(a->op)->arity; k++)
        if (!is_exchanged(w, mine[k], other[k], depth - 1)) return false;
    return true;
}

static uint8_t parity_of(const writer *w, const uint8_t *parity, const graph_node *n)
{
    const int arity = operation_at(n->op)->arity;
    if (!(n->deps & DEP_PAIR)) return EVEN;
    if (n->op == OP_SUM || n->op == OP_TOTAL || arity == 0) return 0;
    const uint8_t a = parity[n->a], b = arity > 1 ? parity[n->b] : EVEN, c = arity > 2 ? parity[n->c] : EVEN;
    if (a & b & c & EVEN) return EVEN;
    const bool square = arity > 1 && a == ODD && n->a == n->b,
               product = square || (arity > 1 && is_exchanged(w, n->a, n->b, DEPTH_MAX));
    switch (n->op) {
    case OP_MUL: return product ? EVEN : (a | b) == (EVEN | ODD) ? ODD : 0;
    case OP_DIV: return a == ODD && b == EVEN ? ODD : 0;
    case OP_FMA:
    case OP_FMS:
    case OP_FNMA: return product && c == EVEN ? EVEN : 0;
    case OP_ADD: return product && !square ? EVEN : 0;
    case OP_SUB: return product && !square ? ODD : 0;
    case OP_NEG: return a;
    case OP_ABS: return a == ODD ? EVEN : 0;
    default: return 0;
    }
}

/* Where pairs are worth it ----------------------------------------------------------------------------------------- */

static bool takes_long(unsigned op) { return op == OP_DIV || op == OP_SQRT || op == OP_POW || op > OP_POW; }

static bool same_bound(const subscript *a, const subscript *b)
{
    return a->level < 0 && b->level < 0 && a->slot == b->slot && a->literal == b->literal && a->modulus < 0 &&
           b->modulus < 0;
}

/* Returns whether all sums of a loop leave out a term by `j != i`: then a loop that takes one term at a time skips
 * it. */
bool emit_leaves_out(const writer *w, const plan_region *r, int level[2])
{
    const graph_node *nodes = w->plan.g->nodes;
    node condition = 0;
    EACH_SUM(k, r)
    {
        const node b = nodes[w->plan.items.at[k].n].b;
        if (!b || (condition && condition != b)) return false;
        condition = b;
    }
    const graph_node *c = &nodes[condition];
    if (!condition || c->op != OP_NE || nodes[c->a].op != OP_INDEX || nodes[c->b].op != OP_INDEX) return false;
    level[0] = nodes[c->a].level;
    level[1] = nodes[c->b].level;
    return level[0] != level[1];
}

/* Returns whether all sums of a loop leave out j = i, and only places like x[i] and x[j] in them depend on the
 * indices. */
static bool exchangeable(writer *w, const plan_region *r)
{
    int equal[2];
    if (!emit_leaves_out(w, r, equal) || equal[0] + equal[1] != 1) return false;
    for (node n = 0; n < w->plan.g->count; n++) {
        const graph_node *m = at(w, n);
        if (m->op != OP_LOAD || !(m->deps & DEP_PAIR)) continue;
        const reference *from = &w->plan.g->references[m->a];
        if (from->dims != 1 || from->at[0].modulus >= 0) return false;
    }
    return true;
}

/* Returns whether a family has the cells of the families so far whose pairs are taken once: they share the room for
 * partial sums. */
static bool same_cells(const emit *e, const range *r)
{
    return !e->pair_sums || (same_bound(&e->pair_range.first, &r->first) && same_bound(&e->pair_range.last, &r->last));
}

uint32_t emit_exchangeable(writer *w, uint32_t family)
{
    const plan_region *f = &w->plan.regions.at[family];
    uint32_t found = NONE;
    if (f->parent != AT_RUN || f->level != 0 || w->e->lanes || w->plan.g->count > NODES_MAX) return NONE;
    for (uint32_t k = f->first_child; k != NONE; k = w->plan.regions.at[k].next) {
        const plan_region *r = &w->plan.regions.at[k];
        if (found == NONE && r->sum && r->level == 1 && !r->holds_sums &&
            same_bound(&r->range.first, &f->range.first) && same_bound(&r->range.last, &f->range.last) &&
            exchangeable(w, r))
            found = k;
    }
    if (found == NONE) return NONE;
    w->parity = arena_room(w->e->text.arena, w->plan.g->count + 1);
    w->exchanged = arena_room(w->e->text.arena, w->plan.g->count + 1);
    if (!w->parity || !w->exchanged) return NONE;
    for (node n = 0; n < w->plan.g->count; n++) w->parity[n] = parity_of(w, w->parity, at(w, n));
    return found;
}

bool emit_is_odd(const writer *w, node n) { return w->parity[n] == ODD; }

uint32_t emit_pairs(writer *w, uint32_t family)
{
    const plan_region *f = &w->plan.regions.at[family];
    emit *e = w->e;
    const uint32_t found = w->part == RUNNING ? emit_exchangeable(w, family) : NONE;
    if (found == NONE || !same_cells(e, &f->range)) return NONE;
    bool worth = false;
    for (node n = 0; n < w->plan.g->count; n++) {
        const graph_node *m = at(w, n);
        worth |= w->parity[n] == EVEN && (m->deps & DEP_PAIR) == DEP_PAIR && takes_long(m->op);
    }
    if (!worth) return NONE;
    uint32_t sums = 0;
    EACH_SUM(k, &w->plan.regions.at[found]) sums++;
    if (sums > e->pair_sums) e->pair_sums = sums;
    e->pair_range = f->range;
    return found;
}

/* The term with the indices exchanged ------------------------------------------------------------------------------ */

static void write_leaf(writer *w, node n, node user)
{
    const graph_node *m = at(w, n);
    char place[PLACE_MAX];
    if (m->op == OP_INDEX) {
        const int level = exchanged_level(m->level);
        if (level == w->along)
            emit_line(w, "const reals o%u = index_count(j%d);", n, level);
        else
            emit_line(w,
                      emit_wide(w, user) ? "const reals o%u = MANY((double)j%d);" : "const double o%u = (double)j%d;",
                      n, level);
        return;
    }
    const reference from = exchanged_reference(&w->plan.g->references[m->a]);
    emit_address(w, &from, from.dims, place);
    if (w->along < 0)
        emit_line(w, "const double o%u = %s;", n, place);
    else if (from.at[0].level == w->along)
        emit_line(w, "const reals o%u = index_load(&%s);", n, place);
    else
        emit_line(w, "const reals o%u = MANY(%s);", n, place);
}

/* Returns the leaf that another leaf is with its indices exchanged, if it has been read, or 0. */
static node other_leaf(const writer *w, node n)
{
    for (node m = 0; m < w->plan.g->count; m++)
        if ((at(w, m)->op == OP_LOAD || at(w, m)->op == OP_INDEX) && is_exchanged(w, n, m, DEPTH_MAX) &&
            plan_find(&w->plan, m, plan_home(&w->plan, at(w, m)->deps, w->region)) != NONE)
            return m;
    return 0;
}

static void exchange(writer *w, node n, node user, char out[48])
{
    const graph_node *m = at(w, n);
    const int arity = operation_at(m->op)->arity;
    const node other = arity == 0 && m->deps & DEP_PAIR ? other_leaf(w, n) : 0;
    if (w->parity[n] == EVEN || other) {
        emit_operand(w, other ? other : n, user, out);
        return;
    }
    snprintf(out, 48, "o%u", n);
    if (w->exchanged[n]) return;
    w->exchanged[n] = 1;
    if (arity == 0) {
        write_leaf(w, n, user);
        return;
    }
    const node operand[3] = {m->a, m->b, m->c};
    char o[3][48] = {"", "", ""};
    for (int k = 0; k < arity; k++) exchange(w, operand[k], user, o[k]);
    emit_line(w, "const %s o%u = %s_%d(%s%s%s%s%s);", emit_type(w, user), n, emit_operation(w, user, m->op), m->op,
              o[0], arity > 1 ? ", " : "", o[1], arity > 2 ? ", " : "", o[2]);
}

void emit_pair_others(writer *w, uint32_t region)
{
    const plan_region *r = &w->plan.regions.at[region];
    memset(w->exchanged, 0, w->plan.g->count);
    EACH_SUM(k, r)
    {
        const node whole = w->plan.items.at[k].n;
        const graph_node *how = at(w, at(w, whole)->a);
        const char *operation = emit_operation(w, whole, how->op);
        const bool along = w->along >= 0, fused = how->op != OP_ADD;
        char p[48], q[48] = "", total[64], next[200];
        snprintf(total, sizeof total, along ? "index_load(&t%u[m1 + k * WIDTH])" : "t%u[m1]", k);
        exchange(w, fused ? how->a : how->b, whole, p);
        if (fused) exchange(w, how->b, whole, q);
        snprintf(next, sizeof next, fused ? "%s_%d(%s, %s, %s)" : "%s_%d(%s, %s%s)", operation, how->op,
                 fused ? p : total, fused ? q : p, fused ? total : "");
        emit_line(w, along ? "index_store(&t%u[m1 + k * WIDTH], %s);" : "t%u[m1] = %s;", k, next);
    }
}
