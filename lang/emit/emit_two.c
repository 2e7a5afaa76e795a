/* Divisions, roots, and products of their results, two at a time: a processor takes as long for two in a vector as for
 * one, and can begin the next division or root only some cycles later, so a force with several waits for them. Every
 * operation has the bits that it has alone.
 *
 * Values are put in the order of their depth, which is the number of divisions and roots on the way to them. Those of
 * one depth do not need one another, and all that they need stands before them.
 */
#include "lang/emit/emit_parts.h"

#include <stdio.h>
#include <string.h>

/* In a longer program the values between would not stay in registers. */
enum { VALUES_MAX = 300, DEPTH_MAX = 60, KINDS = 3 };

struct emit_twos {
    uint8_t *place;    /* by node: KINDS times its depth, and its kind */
    node *before;      /* by node: the first value of the vector of which it is the second */
    uint8_t *together; /* by node: it is the first, or the second, of a vector that was written */
};

static node node_at(const writer *w, uint32_t k)
{
    return w->plan.items.at[w->plan.order[w->plan.regions.at[AT_RUN].items + k]].n;
}

/* The order of the values of one depth: divisions, roots, all others. */
static uint8_t kind_of(const writer *w, node k)
{
    const graph_node *n = &w->plan.g->nodes[k];
    /* a division by a number may be a product */
    const bool divides = n->op == OP_DIV && plan_home(&w->plan, w->plan.g->nodes[n->b].deps, AT_RUN) == AT_RUN;
    return divides ? 0 : n->op == OP_SQRT ? 1 : 2;
}

static uint8_t place_of(const writer *w, const uint8_t *place, node k)
{
    const graph_node *n = &w->plan.g->nodes[k];
    const int arity = operation_at(n->op)->arity;
    const node operand[] = {n->a, n->b, n->c};
    int depth = 0;
    for (int i = 0; i < arity; i++)
        if (place[operand[i]] / KINDS > depth) depth = place[operand[i]] / KINDS;
    const uint8_t kind = kind_of(w, k);
    return (uint8_t)(KINDS * (depth + (kind < 2 && depth < DEPTH_MAX)) + kind);
}

void emit_two_order(writer *w)
{
    const plan_region *r = &w->plan.regions.at[AT_RUN];
    arena *a = w->e->text.arena;
    const uint32_t all = w->plan.g->count;
    emit_twos *twos = arena_room(a, sizeof *twos);
    uint32_t *const order = w->plan.order + r->items, *const was = arena_room(a, (r->item_count + 1) * sizeof *was);
    if (!twos || !was || r->first_child != NONE || r->item_count > VALUES_MAX) return;
    *twos =
        (emit_twos){arena_room(a, all + 1), arena_room(a, (all + 1) * sizeof *twos->before), arena_room(a, all + 1)};
    if (!twos->place || !twos->before || !twos->together) return;
    memset(twos->place, 0, all + 1);
    memset(twos->together, 0, all + 1);
    memcpy(was, order, r->item_count * sizeof *was);
    for (uint32_t k = 0; k < r->item_count; k++) {
        const node n = w->plan.items.at[was[k]].n;
        twos->place[n] = place_of(w, twos->place, n);
    }
    uint32_t to = 0;
    for (int place = 0; place < KINDS * (DEPTH_MAX + 1); place++)
        for (uint32_t k = 0; k < r->item_count; k++)
            if (twos->place[w->plan.items.at[was[k]].n] == place) order[to++] = was[k];
    w->twos = twos;
}

/* Tells whether two values are the numbers of one vector. */
static bool in_one(const emit_twos *t, node a, node b)
{
    return t->together[a] == 1 && t->together[b] == 2 && t->before[b] == a;
}

/* Tells whether two values can be one operation. */
static bool alike(const writer *w, node one, node other)
{
    const emit_twos *t = w->twos;
    const graph_node *a = &w->plan.g->nodes[one], *b = &w->plan.g->nodes[other];
    if (a->op != b->op || t->together[other] || t->place[one] != t->place[other]) return false;
    if (kind_of(w, one) < 2) return t->place[one] < KINDS * DEPTH_MAX; /* there one may need the other */
    return a->op == OP_MUL && in_one(t, a->a, b->a) && in_one(t, a->b, b->b);
}

bool emit_two(writer *w, uint32_t at)
{
    emit_twos *t = w->twos;
    const node one = node_at(w, at);
    const uint32_t count = w->plan.regions.at[AT_RUN].item_count;
    uint32_t to = at + 1;
    if (t->together[one]) return true; /* it is written */
    while (to < count && !alike(w, one, node_at(w, to))) to++;
    if (to == count) return false;
    const node other = node_at(w, to);
    const graph_node *a = &w->plan.g->nodes[one], *b = &w->plan.g->nodes[other];
    const plan_item *first = &w->plan.items.at[plan_find(&w->plan, one, AT_RUN)],
                    *second = &w->plan.items.at[plan_find(&w->plan, other, AT_RUN)];
    const unsigned r = (unsigned)(first - w->plan.items.at), s = (unsigned)(second - w->plan.items.at);
    char o[4][48];
    emit_operand(w, a->a, one, o[0]), emit_operand(w, b->a, other, o[1]);
    if (a->op == OP_SQRT)
        emit_line(w, "const two r%u_two = two_roots(%s, %s);", r, o[0], o[1]);
    else {
        emit_operand(w, a->b, one, o[2]), emit_operand(w, b->b, other, o[3]);
        emit_line(w, "const two r%u_two = (two){%s, %s} %s (two){%s, %s};", r, o[0], o[1], a->op == OP_DIV ? "/" : "*",
                  o[2], o[3]);
    }
    emit_line(w, "const double r%u = r%u_two[0], r%u = r%u_two[1];", r, r, s, r);
    w->e->uses_two = true;
    t->together[one] = 1, t->together[other] = 2, t->before[other] = one;
    emit_outputs(w, first->outputs);
    emit_outputs(w, second->outputs);
    return true;
}
