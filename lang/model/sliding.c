/* See sliding.h.
 *
 * Where sign(s) drives s to 0 from both sides, s stays 0, and the sign takes the value p in [-1, 1] with which the rate
 * of s is 0 [Filippov88]. The rate is the derivative of s along the motion, with the equations in place of the
 * accelerations; where it is r0 + r1 p, p = -r0/r1.
 *
 * The accelerations with that p keep s at 0 but for rounding. Where s contains the velocity of a variable times a
 * factor that does not change, as x' - V, the variable gets the acceleration with which the rate is exactly 0: a body
 * that sticks rests, bit by bit, and rounding shortens no step.
 */
#include "lang/model/sliding.h"

#include "lang/base/operation.h"
#include "lang/graph/graph_walk.h"
#include "lang/graph/ratio.h"

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
    node without;      /* an acceleration that becomes 0 instead */
    const bool *taken; /* accelerations that are found only if there is no other, or NULL */
    size_t found;      /* the number of the acceleration that was found */
    size_t free;       /* how many of those not taken were found */
    bool failed;       /* an acceleration has another index or another range */
} inserting;

/* Returns the equation of an acceleration, over its indices. */
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
            if (!in->taken || !in->taken[k]) in->found = k, in->free++;
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

static const node NO_NODE = UINT32_MAX;

static bool compares(operation op) { return op == OP_LT || op == OP_LE || op == OP_GT || op == OP_GE; }

/* Returns the value in [0, 1] at which a comparison is held, from a value in [-1, 1] that is 1 where its argument is
 * positive. */
static node part_of(graph *g, operation op, node value)
{
    const double half = op == OP_GT || op == OP_GE ? 0.5 : -0.5;
    return graph_op(g, OP_ADD, graph_const(g, 0.5), graph_op(g, OP_MUL, graph_const(g, half), value, 0), 0);
}

/* Returns `a` where the part is 1, `b` where it is 0, and between them a mix. */
static node blend(graph *g, node part, node a, node b)
{
    return graph_op(g, OP_ADD, b, graph_op(g, OP_MUL, part, graph_op(g, OP_SUB, a, b, 0), 0), 0);
}

/* What replaces a load, and a choice by a load, outside sums. A sum goes to `leaf` as a whole. */
typedef struct replacement {
    graph_substitute leaf;
    node (*choice)(graph *, node load, node a, node b, void *ctx);
    /* is called where a load is an operand of anything but a choice by it; or NULL */
    void (*otherwise)(const graph_node *, node load, void *ctx);
    void *ctx;
} replacement;

static node with_sides(graph *g, node root, int level, const replacement *how)
{
    graph_walk w;
    if (!(graph_deps(g, root) & DEP_MODE)) return root;
    if (!graph_order(g, &root, 1, DEP_MODE, false, &w)) return 0;
    node *as = graph_walk_room(g, &w, sizeof *as);
    for (uint32_t k = 0; as && k < w.count; k++) {
        const graph_node n = *graph_at(g, w.nodes[k]);
        as[k] = w.nodes[k];
        if (n.op == OP_LOAD) as[k] = how->leaf(g, w.nodes[k], level, how->ctx);
        if (n.op == OP_SUM) as[k] = graph_replace(g, w.nodes[k], DEP_MODE, level, how->leaf, how->ctx);
    }
    if (as) graph_order_again(g, &w);
    for (uint32_t k = 0; as && k < w.count && !g->arena->failed && !g->too_large; k++) {
        const graph_node n = *graph_at(g, w.nodes[k]);
        node operand[3], was[3];
        bool same;
        const int arity = graph_operands(&n, was);
        if (n.op == OP_SUM || !graph_operands_as(g, &w, &n, as, operand, &same)) continue;
        for (int j = n.op == OP_SELECT; j < arity && how->otherwise; j++)
            if (graph_at(g, was[j])->op == OP_LOAD) how->otherwise(&n, was[j], how->ctx);
        node choice = 0;
        if (n.op == OP_SELECT && graph_at(g, was[0])->op == OP_LOAD)
            choice = how->choice(g, was[0], operand[1], operand[2], how->ctx);
        as[k] = choice ? choice : same ? w.nodes[k] : graph_op(g, (operation)n.op, operand[0], operand[1], operand[2]);
    }
    return graph_walk_end(g, &w, as);
}

/* How the equations depend on the part at which a comparison is held, in place of its side. */
typedef struct parts {
    node side;
    int level;
    bool failed; /* something does not depend on it linearly */
} parts;

static node as_it_is(graph *g, node n, int level, void *ctx)
{
    parts *p = ctx;
    (void)g;
    p->failed |= n == p->side && level > p->level; /* it is in a sum */
    return n;
}

static node by_part(graph *g, node load, node a, node b, void *ctx)
{
    const parts *p = ctx;
    return load == p->side ? blend(g, load, a, b) : 0;
}

static void not_by_part(const graph_node *n, node load, void *ctx)
{
    parts *p = ctx;
    const operation op = (operation)n->op;
    const bool linear = op == OP_ADD || op == OP_SUB || op == OP_MUL || op == OP_NEG || op == OP_DIV || op == OP_SELECT;
    p->failed |= load == p->side && !linear;
}

typedef struct held_sides {
    const switches *s;
    const node *value; /* by kind: what holds it; NO_NODE: nothing does */
} held_sides;

/* Returns the kind whose side a load is, if it can be held; else the number of kinds. */
static size_t kind_at(const held_sides *h, node leaf)
{
    size_t k = 0;
    while (k < h->s->kinds && (h->s->side[k] != leaf || h->value[k] == NO_NODE)) k++;
    return k;
}

/* Returns the value at which a kind is held, in place of its side. */
static node value_at(graph *g, const held_sides *h, size_t k)
{
    const operation op = (operation)h->s->op[h->s->first[k]];
    return compares(op) ? part_of(g, op, h->value[k]) : h->value[k];
}

static node is_held(graph *g, node side) { return graph_op(g, OP_GT, side, graph_const(g, 1.5), 0); }

/* Returns what a side that is not held stands for. */
static node side_itself(const switches *s, size_t k, node side) { return s->parts[k] ? s->sliding[k] : side; }

/* Returns a side or, where it is SWITCHES_HELD, the value that holds it. */
static node side_or_value(graph *g, node leaf, int level, void *ctx)
{
    const held_sides *h = ctx;
    const size_t k = kind_at(h, leaf);
    (void)level;
    if (k == h->s->kinds) return leaf;
    return graph_op(g, OP_SELECT, is_held(g, leaf), value_at(g, h, k), side_itself(h->s, k, leaf));
}

/* Returns a direction that is never held in place of its side. */
static node side_that_slides(graph *g, node leaf, int level, void *ctx)
{
    const held_sides *h = ctx;
    (void)g, (void)level;
    for (size_t k = 0; k < h->s->kinds; k++)
        if (h->s->parts[k] && h->value[k] == NO_NODE && h->s->side[k] == leaf) return h->s->sliding[k];
    return leaf;
}

/* Returns a choice by a side or, where that is held, a mix of both. */
static node side_or_parts(graph *g, node side, node a, node b, void *ctx)
{
    const held_sides *h = ctx;
    const size_t k = kind_at(h, side);
    if (k == h->s->kinds) return 0;
    return graph_op(g, OP_SELECT, is_held(g, side), blend(g, value_at(g, h, k), a, b),
                    graph_op(g, OP_SELECT, side, a, b));
}

/* Puts the values that hold kinds from `first` to before `last` in place of their sides, in loops of equal depth. The
 * values of several switches solve linear equations, which are eliminated one by one. */
static node with_value(const model *m, const held_sides *h, size_t first, size_t last, int loops, node n)
{
    node *only = take(&m->arena->allocator, h->s->kinds, sizeof *only);
    if (!only) return m->arena->failed = true, n;
    for (size_t k = 0; k < h->s->kinds; k++)
        only[k] = h->s->as[k] >= first && h->s->as[k] < last && h->s->rate[k].loops == loops ? h->value[k] : NO_NODE;
    held_sides some = {h->s, only};
    const node result = with_sides(m->graph, n, loops, &(replacement){side_or_value, side_or_parts, NULL, &some});
    give(&m->arena->allocator, only);
    return result;
}

/* Surfaces --------------------------------------------------------------------------------------------------------- */

/* Returns 1 or -1 if two arguments are 0 at equal places; 0: they are not, or it is not seen. */
static int same_surface(graph *g, node u, node w)
{
    const ratio r = ratio_of(g, u, w);
    return r.count ? 0 : (r.number > 0) - (r.number < 0);
}

static bool links(operation op) { return op == OP_SIGN || compares(op); }

/* Links every kind to the first kind of its surface. */
static bool find_surfaces(model *m, switches *s)
{
    s->as = arena_room(m->arena, s->kinds * sizeof *s->as);
    s->turned = arena_room(m->arena, s->kinds * sizeof *s->turned);
    if (!s->as || !s->turned) return false;
    for (size_t k = 0; k < s->kinds; k++) {
        const operation op = (operation)s->op[s->first[k]];
        s->as[k] = (uint32_t)k, s->turned[k] = 1;
        for (size_t j = 0; j < k && links(op) && s->as[k] == k; j++) {
            const bool may = s->as[j] == j && links((operation)s->op[s->first[j]]) &&
                             same_loops(&s->argument[j], &s->argument[k]) &&
                             switches_cells(s, j) == switches_cells(s, k);
            const int turned = may ? same_surface(m->graph, s->argument[j].value, s->argument[k].value) : 0;
            if (turned) s->as[k] = (uint32_t)j, s->turned[k] = (int8_t)turned;
        }
    }
    return true;
}

/* Returns the value in [-1, 1] that is 1 where the argument of a kind is positive, from the value of its surface. */
static node turned_value(graph *g, const switches *s, size_t kind, node value)
{
    return s->turned[kind] < 0 ? graph_op(g, OP_NEG, value, 0, 0) : value;
}

typedef struct placing {
    node side, as;
} placing;

static node placed_at(graph *g, node leaf, int level, void *ctx)
{
    const placing *p = ctx;
    (void)g, (void)level;
    return leaf == p->side ? p->as : leaf;
}

/* Returns an equation in which all kinds of one surface follow the side of `kind`. 0: that is impossible. */
static node by_surface(graph *g, const switches *s, size_t kind, int loops, node n)
{
    const operation op = (operation)s->op[s->first[kind]];
    const double half = op == OP_GT || op == OP_GE ? 2 : -2;
    node value = s->side[kind];
    if (compares(op))
        value = graph_op(g, OP_MUL, graph_const(g, half), graph_op(g, OP_SUB, value, graph_const(g, 0.5), 0), 0);
    for (size_t j = kind + 1; j < s->kinds && n; j++) {
        if (s->as[j] != kind) continue;
        const operation other = (operation)s->op[s->first[j]];
        placing p = {s->side[j], turned_value(g, s, j, value)};
        parts by = {s->side[j], loops, false};
        if (compares(other)) {
            p.as = part_of(g, other, p.as);
            n = with_sides(g, n, loops, &(replacement){as_it_is, by_part, not_by_part, &by});
        }
        n = by.failed ? 0 : graph_replace(g, n, DEP_MODE, loops, placed_at, &p);
    }
    return n;
}

/* Finds whether a motion may slide along a kind, and the value that holds its argument at 0; NO_NODE: there is none.
 * grip: how much the rate of the argument grows with the value. */
static switches_sliding holding(const model *m, const switches *s, size_t kind, const held_sides *h, node *value,
                                node *grip)
{
    graph *g = m->graph;
    const output *rate = &s->rate[kind];
    const operation op = (operation)s->op[s->first[kind]];
    inserting in = {.s = s, .accel_count = m->accel_count, .rate = rate, .level = rate->loops};
    node full = graph_replace(g, rate->value, DEP_A, rate->loops, equation_of, &in), side = s->side[kind];
    *value = NO_NODE;
    if (!switches_jumps(op)) return SLIDES_NEVER;
    if (in.failed) return SLIDES_REFUSED;
    full = by_surface(g, s, kind, rate->loops, full);
    if (!full) return SLIDES_REFUSED;
    const node without = graph_replace(g, full, DEP_MODE, rate->loops, zero_at, &side);
    if (without == full) return SLIDES_NEVER;
    if (op != OP_SIGN && !compares(op) && !switches_directs(op)) return SLIDES_REFUSED;
    for (size_t k = 0; k < kind; k++)
        if (rate->loops == 0 || s->leader[k] == s->leader[kind]) full = with_value(m, h, k, k + 1, rate->loops, full);
    node force = full;
    if (compares(op)) {
        parts by = {side, rate->loops, false};
        force = with_sides(g, full, rate->loops, &(replacement){as_it_is, by_part, not_by_part, &by});
        if (by.failed) return SLIDES_REFUSED;
    }
    const node rest = graph_replace(g, force, DEP_MODE, rate->loops, zero_at, &side);
    const node slope = graph_derivative(g, force, one_at, &side);
    if (!slope) return SLIDES_REFUSED;
    /* where all kinds are signs, that is tested when the motion comes there */
    bool chooses = compares(op);
    for (size_t j = kind; j < s->kinds; j++) chooses |= s->as[j] == kind && compares((operation)s->op[s->first[j]]);
    if (chooses && graph_replace(g, slope, DEP_MODE, rate->loops, zero_at, &side) != slope) return SLIDES_REFUSED;
    const node part = graph_op(g, OP_NEG, graph_op(g, OP_DIV, rest, slope, 0), 0, 0);
    *value = part;
    *grip = slope;
    if (compares(op)) {
        const double two = op == OP_GT || op == OP_GE ? 2 : -2;
        *value = graph_op(g, OP_MUL, graph_const(g, two), graph_op(g, OP_SUB, part, graph_const(g, 0.5), 0), 0);
        *grip = graph_op(g, OP_DIV, slope, graph_const(g, two), 0);
    }
    return SLIDES_HELD;
}

/* Returns the acceleration of one variable, output *number, with which the rate of a kind is 0. NO_NODE: there is none.
 * literal: its factor must be a number, since a parameter may be 0. */
static node resting(const model *m, const switches *s, const output *rate, const bool *taken, bool literal,
                    size_t *number)
{
    enum { MOVES = DEP_TIME | DEP_STATE | DEP_LEVELS };
    graph *g = m->graph;
    inserting in = {.s = s, .accel_count = m->accel_count, .rate = rate, .level = rate->loops, .taken = taken};
    graph_replace(g, rate->value, DEP_A, rate->loops, equation_of, &in);
    node own = graph_load(g, &s->accel[in.found].to);
    const node factor = in.failed ? 0 : graph_derivative(g, rate->value, one_at, &own);
    *number = in.found;
    if (!factor || graph_deps(g, factor) & MOVES) return NO_NODE;
    if (literal && graph_at(g, factor)->op != OP_CONST) return NO_NODE;
    in.without = own;
    const node rest = graph_replace(g, rate->value, DEP_A, rate->loops, equation_of, &in);
    return graph_op(g, OP_SUB, graph_const(g, 0), graph_op(g, OP_DIV, rest, factor, 0), 0);
}

/* Returns the kind that finds the fewest accelerations not taken, of those that still wait, and lets it wait no more.
 * Of switches that are held together, one may leave an acceleration to others: x1'' is x2'' while x2' - x1' is held,
 * and x2'' is 0 while x2' is, so x2'' comes first. */
static size_t next_resting(const model *m, const switches *s, const bool *taken, node *waits)
{
    size_t best = s->kinds, least = SIZE_MAX;
    for (size_t k = 0; k < s->kinds; k++) {
        inserting in = {.s = s, .accel_count = m->accel_count, .rate = &s->rate[k], .taken = taken};
        if (waits[k] == NO_NODE) continue;
        in.level = s->rate[k].loops;
        graph_replace(m->graph, s->rate[k].value, DEP_A, s->rate[k].loops, equation_of, &in);
        if (in.free < least) best = k, least = in.free;
    }
    if (best < s->kinds) waits[best] = NO_NODE;
    return best;
}

/* Gives the value of kind k to the others of its surface. */
static void share_value(graph *g, const switches *s, size_t k, node *value)
{
    for (size_t j = k + 1; j < s->kinds; j++)
        if (s->as[j] == k && value[k] != NO_NODE) value[j] = turned_value(g, s, j, value[k]);
}

/* Makes the kinds of a surface on which nothing can slide switches of their own. */
static void part_surface(const switches *s, size_t k)
{
    for (size_t j = k + 1; j < s->kinds; j++)
        if (s->as[j] == k) s->as[j] = (uint32_t)j, s->turned[j] = 1;
}

/* Makes no component of a direction held if one of them cannot be. */
static void hold_all_or_none(const switches *s, size_t last, node *value)
{
    const size_t first = s->leader[last], end = first + s->parts[last];
    uint8_t slides = SLIDES_HELD;
    if (last + 1 < end) return;
    for (size_t k = first; k < end; k++)
        if (s->slides[k] != SLIDES_HELD) slides = s->slides[k];
    for (size_t k = first; k < end && slides != SLIDES_HELD; k++) s->slides[k] = slides, value[k] = NO_NODE;
}

/* Lets the force hold the switches that it can; the equations of the switches know that side, too. False: no memory. */
static bool prepare(model *m, switches *s)
{
    enum { TOGETHER = 8 }; /* equations of more held kinds grow large */
    node *value = arena_room(m->arena, 3 * s->kinds * sizeof *value), *rests = value + s->kinds;
    node *grips = rests + s->kinds;
    s->hold = arena_room(m->arena, 4 * s->kinds * sizeof *s->hold);
    s->slides = arena_room(m->arena, s->kinds * sizeof *s->slides);
    if (!value || !s->hold || !s->slides || !find_surfaces(m, s)) return false;
    s->hold_rate = s->hold + s->kinds;
    s->grip = s->hold_rate + s->kinds, s->grip_rate = s->grip + s->kinds;
    s->hold_kinds = 0;
    s->shared = false;
    held_sides h = {s, value};
    const replacement with_values = {side_or_value, side_or_parts, NULL, &h};
    size_t alone = 0; /* how many held kinds are no families */
    for (size_t k = 0; k < s->kinds; k++) value[k] = rests[k] = NO_NODE;
    for (size_t k = 0; k < s->kinds; k++) {
        const held_sides none = {s, rests};
        if (s->as[k] != k) {
            s->slides[k] = s->slides[s->as[k]];
            continue;
        }
        const bool eliminates = alone < TOGETHER || s->leader[k] != k;
        s->slides[k] = (uint8_t)holding(m, s, k, eliminates ? &h : &none, &value[k], &grips[k]);
        alone += value[k] != NO_NODE && s->rate[k].loops == 0;
        if (s->parts[k]) hold_all_or_none(s, k, value);
        if (s->slides[k] == SLIDES_NEVER) part_surface(s, k);
        share_value(m->graph, s, k, value);
    }
    for (size_t k = s->kinds; k-- > 0;) { /* the values of later kinds, in the value of each */
        const bool all = alone <= TOGETHER && s->rate[k].loops == 0;
        const size_t end = all ? s->kinds : s->leader[k] + s->parts[k];
        if (value[k] == NO_NODE || s->as[k] != k || k + 1 >= end) continue;
        value[k] = with_value(m, &h, k + 1, end, s->rate[k].loops, value[k]);
        grips[k] = with_value(m, &h, k + 1, end, s->rate[k].loops, grips[k]);
        share_value(m->graph, s, k, value);
    }
    s->together = alone <= TOGETHER;
    for (size_t k = 0; k < s->kinds; k++) s->shared |= s->as[k] != k;
    for (size_t k = 0; k < s->kinds; k++) {
        const size_t to = s->hold_kinds;
        if (value[k] == NO_NODE || s->as[k] != k) continue;
        value[k] = graph_replace(m->graph, value[k], DEP_MODE, s->rate[k].loops, side_that_slides, &h);
        grips[k] = graph_replace(m->graph, grips[k], DEP_MODE, s->rate[k].loops, side_that_slides, &h);
        s->hold[to] = s->hold_rate[to] = s->grip[to] = s->grip_rate[to] = s->rate[k];
        s->hold[to].value = value[k];
        s->hold_rate[to].value = graph_derivative(m->graph, value[k], model_seed_motion, m);
        s->grip[to].value = grips[k];
        s->grip_rate[to].value = graph_derivative(m->graph, grips[k], model_seed_motion, m);
        s->hold_kinds++;
    }
    const struct {
        output *of;
        size_t count;
    } all[] = {{s->accel, m->accel_count}, {s->boundary, m->boundary_count}, {s->held, s->kinds}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++)
        for (size_t i = 0; i < all[k].count; i++) {
            output *o = &all[k].of[i];
            if (s->hold_kinds) o->value = with_sides(m->graph, o->value, o->loops, &with_values);
            o->value = graph_replace(m->graph, o->value, DEP_MODE, o->loops, side_that_slides, &h);
        }
    if (s->hold_kinds == 0) return !m->arena->failed && !m->graph->too_large;
    bool *taken = arena_room(m->arena, 2 * (m->accel_count + 1) * sizeof *taken), *tried = taken + m->accel_count + 1;
    if (!taken) return false;
    node *const waits = rests; /* which is no longer needed */
    for (size_t k = 0; k < s->kinds; k++) waits[k] = s->as[k] == k ? value[k] : NO_NODE;
    for (size_t k; (k = next_resting(m, s, taken, waits)) < s->kinds;) {
        graph *g = m->graph;
        output rate = s->rate[k];
        size_t at = 0;
        /* it contains what holds the others, and what rests */
        rate.value = with_sides(g, rate.value, rate.loops, &with_values);
        memcpy(tried, taken, m->accel_count * sizeof *tried);
        node is = resting(m, s, &rate, tried, s->parts[k], &at);
        for (size_t n = 0; s->parts[k] && is == NO_NODE && n < m->accel_count && !tried[at]; n++) {
            tried[at] = true;
            is = resting(m, s, &rate, tried, true, &at);
        }
        if (is == NO_NODE || taken[at]) continue;
        taken[at] = true;
        s->accel[at].value = graph_op(g, OP_SELECT, is_held(g, s->side[k]), is, s->accel[at].value);
    }
    for (size_t k = 0; k < s->kinds; k++)
        s->rate[k].value = graph_derivative(m->graph, s->held[k].value, model_seed_motion, m);
    return !m->arena->failed && !m->graph->too_large;
}

void sliding_locate(model *m)
{
    switches *s = arena_room(m->arena, sizeof *s);
    if (!s || !switches_find(m, true, s) || s->refused || s->kinds != m->side_count || !prepare(m, s)) return;
    s->slot = m->states[m->side_first].base;
    m->accel = s->accel;
    m->boundary = s->boundary;
    m->located = s;
    model_start_sides(m);
}
