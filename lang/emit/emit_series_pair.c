/* Which series of a sum over pairs are taken once for both cells: those of values that an exchange of the indices
 * leaves as they are, or gives the opposite sign (emit_pair.c). Their loop is over all pairs i < j; coefficient n of
 * each value that terms use, a front, goes to a matrix, from which the loops of the cells take it with its sign.
 *
 * Memory: pairs are at most half of all terms, with what fills the vectors, so their frames and the matrix fit in the
 * room of the terms, whose frames are smaller by them.
 */
#include "lang/emit/emit_parts.h"
#include "lang/graph/graph_walk.h"

static const graph_node *at(const writer *w, node n) { return &w->plan.g->nodes[n]; }
static bool goes_on(const writer *w, uint32_t item) { return w->expansion.values[item].last == EXPANSION_ALL; }

static bool is_cell(const writer *w, uint32_t item)
{
    return w->expansion.values[item].state && w->expansion.values[item].passing;
}

/* Returns whether an operand of a value of the pair is a value of the pair, too, or a position or velocity of a cell,
 * or a number. */
static bool serves(writer *w, node n, uint32_t family)
{
    const uint32_t home = plan_home(&w->plan, at(w, n)->deps, w->sharing), item = plan_find(&w->plan, n, home);
    if (home == AT_BIND) return true;
    if (home == family && is_cell(w, item)) w->shared[item].role = CELL;
    return w->shared[item].role != ALONE;
}

static bool is_update(const writer *w, uint32_t item)
{
    return plan_updates(&w->plan, &w->plan.items.at[item]) != NONE;
}

/* Returns the operands of an item; those of an update are in the rule of its sum. */
static int operands_of(const writer *w, uint32_t item, node out[3])
{
    const uint32_t whole = is_update(w, item) ? plan_updates(&w->plan, &w->plan.items.at[item]) : NONE;
    if (whole == NONE) return graph_operands(at(w, w->plan.items.at[item].n), out);
    const graph_node *how = at(w, at(w, w->plan.items.at[whole].n)->a);
    out[0] = how->op == OP_ADD ? how->b : how->a; /* the rule of a sum is TOTAL + b, or a b + TOTAL */
    out[1] = how->b;
    return how->op == OP_ADD ? 1 : 2;
}

/* Returns whether the series of both factors of an update's product go on, so that it reads more of them than
 * coefficient n. */
static bool both_go_on(const writer *w, const node operand[2])
{
    for (int k = 0; k < 2; k++) {
        const uint32_t home = plan_home(&w->plan, at(w, operand[k])->deps, w->sharing);
        if (home == AT_BIND || !goes_on(w, plan_find(&w->plan, operand[k], home))) return false;
    }
    return true;
}

/* Finds the role of an item. False: its term needs more than fronts and numbers. */
static bool judge(writer *w, uint32_t item, uint32_t family)
{
    node operand[3] = {0, 0, 0};
    const plan_item *i = &w->plan.items.at[item];
    const bool update = is_update(w, item), alone = update || !goes_on(w, item);
    if (!alone && is_cell(w, item) && i->outputs == NONE) return w->shared[item].role = CELL, true;
    if (!alone && (!w->parity[i->n] || i->outputs != NONE)) return false;
    const int count = operands_of(w, item, operand);
    for (int k = 0; k < count; k++) {
        if (!alone) {
            if (!serves(w, operand[k], family)) return false;
            continue;
        }
        const uint32_t home = plan_home(&w->plan, at(w, operand[k])->deps, w->sharing),
                       from = home == AT_BIND ? NONE : plan_find(&w->plan, operand[k], home);
        if (from == NONE || home != w->sharing || !goes_on(w, from)) continue;
        if (!update || w->shared[from].role < PAIR || (count == 2 && both_go_on(w, operand))) return false;
        w->shared[from].role = FRONT;
    }
    if (!alone) w->shared[item].role = PAIR;
    return true;
}

/* Returns the size of a series in the frame, from where the next one begins. */
static uint32_t size_of(const writer *w, const plan_region *r, uint32_t k)
{
    const uint32_t item = w->plan.order[r->items + k];
    const uint32_t end = k + 1 < r->item_count ? w->expansion.values[w->plan.order[r->items + k + 1]].at
                                               : w->expansion.frames[w->plan.items.at[item].region];
    return end - w->expansion.values[item].at;
}

static void place(writer *w, uint32_t family)
{
    const plan_region *f = &w->plan.regions.at[family], *r = &w->plan.regions.at[w->sharing];
    w->pair_frame = w->own_frame = w->fronts = 0;
    for (uint32_t k = 0; k < f->item_count; k++) {
        const uint32_t item = w->plan.order[f->items + k];
        if (w->shared[item].role == CELL) w->shared[item].at = w->pair_frame++;
    }
    for (uint32_t k = 0; k < r->item_count; k++) {
        const uint32_t item = w->plan.order[r->items + k], size = size_of(w, r, k);
        shared_value *s = &w->shared[item];
        if (s->role == ALONE || s->role == FRONT) s->own = w->own_frame, w->own_frame += s->role == FRONT ? 1 : size;
        if (s->role != ALONE) s->at = w->pair_frame, w->pair_frame += size;
        if (s->role == FRONT) s->front = w->fronts++;
    }
}

bool emit_series_shares(writer *w, uint32_t family)
{
    w->sharing = emit_exchangeable(w, family);
    if (w->sharing == NONE) return false;
    const plan_region *r = &w->plan.regions.at[w->sharing];
    w->shared = arena_room(w->e->text.arena, (w->plan.items.count + 1) * sizeof *w->shared);
    if (!w->shared) return false;
    for (uint32_t k = 0; k < w->plan.items.count; k++) w->shared[k] = (shared_value){.role = ALONE};
    bool good = true;
    for (uint32_t k = 0; k < r->item_count && good; k++) good = judge(w, w->plan.order[r->items + k], family);
    if (good) place(w, family);
    if (good && w->fronts) return true;
    w->shared = NULL;
    return false;
}
