/* Switches whose force may hold the motion where they jump: dry friction that sticks, relays. See sliding.h.
 *
 * Where sign(s) drives s to 0 from both sides, s stays 0, and the sign takes the value p in [-1, 1] with which the rate
 * of s is 0 (Filippov). The rate is the derivative of s along the motion with the equations in place of the
 * accelerations; where it is r0 + r1 p, p = -r0/r1.
 *
 * The accelerations with that p keep s at 0 but for rounding. Where s has the velocity of a variable with a factor that
 * does not change, x' - V, the variable's acceleration is the one with which the rate is 0 exactly: a body that sticks
 * then rests, bit by bit, and rounding shortens no step.
 */
#include "lang/model/sliding.h"

#include "lang/base/operation.h"

#include <string.h>

static bool same_loops(const output *a, const output *b)
{
    bool same = a->loops == b->loops;
    for (int k = 0; k < a->loops && same; k++) same = graph_same_range(&a->loop[k], &b->loop[k]);
    return same;
}

typedef struct inserting {
    const switches *s;
    size_t accel_count;
    const output *rate;
    int level;
    node without; /* this acceleration becomes 0 instead */
    size_t found; /* the number of an acceleration that there is */
    bool failed;  /* an acceleration is that of another index, or of another range */
} inserting;

/* The equation of an acceleration, over the same indices. */
static node equation_of(graph *g, node leaf, int level, void *ctx)
{
    inserting *in = ctx;
    const graph_node *n = graph_at(g, leaf);
    if (n->op != OP_LOAD) return leaf;
    const reference *r = &g->references[n->a];
    if (g->arrays[r->array].space != SPACE_A) return leaf;
    if (leaf == in->without) return graph_const(g, 0);
    for (size_t k = 0; k < in->accel_count && level == in->level; k++) {
        const output *o = &in->s->accel[k];
        if (graph_same_reference(&o->to, r) && same_loops(o, in->rate)) {
            in->found = k;
            return o->value;
        }
    }
    in->failed = true;
    return leaf;
}

static node one_at(graph *g, node leaf, void *side) { return leaf == *(const node *)side ? graph_const(g, 1) : 0; }

static node zero_at(graph *g, node leaf, int level, void *side)
{
    (void)level;
    return leaf == *(const node *)side ? graph_const(g, 0) : leaf;
}

static const node NO_NODE = UINT32_MAX; /* no node */

/* Whether a motion may slide along a kind, and the value that holds its argument at 0, NO_NODE: there is none; grip: how
 * much the rate of the argument grows with the value. */
static switches_sliding holding(const model *m, const switches *s, size_t kind, node *value, node *grip)
{
    graph *g = m->graph;
    const output *rate = &s->rate[kind];
    const operation op = (operation)s->op[s->first[kind]];
    inserting in = {.s = s, .accel_count = m->accel_count, .rate = rate, .level = rate->loops};
    const node full = graph_replace(g, rate->value, DEP_A, rate->loops, equation_of, &in);
    node side = s->side[kind];
    *value = NO_NODE;
    if (!switches_jumps(op)) return SLIDES_NEVER;
    if (in.failed) return SLIDES_REFUSED;
    const node rest = graph_replace(g, full, DEP_MODE, rate->loops, zero_at, &side);
    if (rest == full) return SLIDES_NEVER;
    const node slope = op == OP_SIGN ? graph_derivative(g, full, one_at, &side) : 0;
    if (!slope) return SLIDES_REFUSED;
    *grip = slope;
    *value = graph_op(g, OP_NEG, graph_op(g, OP_DIV, rest, slope, 0), 0, 0);
    return SLIDES_HELD;
}

/* The acceleration of one variable with which the rate of a kind is 0: output *number. NO_NODE: there is none. */
static node resting(const model *m, const switches *s, size_t kind, size_t *number)
{
    enum { MOVES = DEP_TIME | DEP_STATE | DEP_LEVELS };
    graph *g = m->graph;
    const output *rate = &s->rate[kind];
    inserting in = {.s = s, .accel_count = m->accel_count, .rate = rate, .level = rate->loops};
    graph_replace(g, rate->value, DEP_A, rate->loops, equation_of, &in);
    node own = graph_load(g, &s->accel[in.found].to);
    const node factor = in.failed ? 0 : graph_derivative(g, rate->value, one_at, &own);
    if (!factor || graph_deps(g, factor) & MOVES) return NO_NODE;
    in.without = own;
    const node rest = graph_replace(g, rate->value, DEP_A, rate->loops, equation_of, &in);
    *number = in.found;
    return graph_op(g, OP_SUB, graph_const(g, 0), graph_op(g, OP_DIV, rest, factor, 0), 0);
}

typedef struct held_sides {
    const switches *s;
    const node *value; /* kinds: what holds each; NO_NODE: nothing does */
} held_sides;

/* The side, or where it is SWITCHES_HELD the value that holds. */
static node side_or_value(graph *g, node leaf, int level, void *ctx)
{
    const held_sides *h = ctx;
    (void)level;
    for (size_t k = 0; k < h->s->kinds; k++) {
        if (h->s->side[k] != leaf || h->value[k] == NO_NODE) continue;
        const node held = graph_op(g, OP_GT, leaf, graph_const(g, 1.5), 0);
        return graph_op(g, OP_SELECT, held, h->value[k], leaf);
    }
    return leaf;
}

bool sliding_prepare(model *m, switches *s)
{
    node *value = arena_room(m->arena, 2 * s->kinds * sizeof *value), *rests = value + s->kinds;
    size_t *resting_at = arena_room(m->arena, s->kinds * sizeof *resting_at);
    s->hold = arena_room(m->arena, 4 * s->kinds * sizeof *s->hold);
    s->slides = arena_room(m->arena, s->kinds * sizeof *s->slides);
    if (!value || !resting_at || !s->hold || !s->slides) return false;
    s->hold_rate = s->hold + s->kinds;
    s->grip = s->hold_rate + s->kinds, s->grip_rate = s->grip + s->kinds;
    s->hold_kinds = 0;
    for (size_t k = 0; k < s->kinds; k++) {
        node grip = 0;
        const size_t to = s->hold_kinds;
        s->slides[k] = (uint8_t)holding(m, s, k, &value[k], &grip);
        if (value[k] == NO_NODE) continue;
        s->hold[to] = s->hold_rate[to] = s->grip[to] = s->grip_rate[to] = s->rate[k];
        s->hold[to].value = value[k];
        s->hold_rate[to].value = graph_derivative(m->graph, value[k], model_seed_motion, m);
        s->grip[to].value = grip;
        s->grip_rate[to].value = graph_derivative(m->graph, grip, model_seed_motion, m);
        s->hold_kinds++;
    }
    if (s->hold_kinds == 0) return !m->arena->failed && !m->graph->too_large;
    held_sides h = {s, value};
    for (size_t k = 0; k < s->kinds; k++) {
        size_t at = 0;
        rests[k] = value[k] != NO_NODE ? resting(m, s, k, &at) : NO_NODE;
        resting_at[k] = at;
    }
    const struct {
        output *of;
        size_t count;
    } all[] = {{s->accel, m->accel_count}, {s->boundary, m->boundary_count}, {s->held, s->kinds}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++)
        for (size_t i = 0; i < all[k].count; i++) {
            output *o = &all[k].of[i];
            o->value = graph_replace(m->graph, o->value, DEP_MODE, o->loops, side_or_value, &h);
        }
    for (size_t k = 0; k < s->kinds; k++) {
        graph *g = m->graph;
        node *to = &s->accel[resting_at[k]].value;
        if (rests[k] == NO_NODE) continue;
        /* what the others are held by is in it, too */
        const output *o = &s->accel[resting_at[k]];
        const node is = graph_replace(g, rests[k], DEP_MODE, o->loops, side_or_value, &h);
        *to = graph_op(g, OP_SELECT, graph_op(g, OP_GT, s->side[k], graph_const(g, 1.5), 0), is, *to);
    }
    for (size_t k = 0; k < s->kinds; k++)
        s->rate[k].value = graph_derivative(m->graph, s->held[k].value, model_seed_motion, m);
    return !m->arena->failed && !m->graph->too_large;
}
