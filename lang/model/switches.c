/* Finds the switches of a model, and writes its equations with a side in place of each. See switches.h. */
#include "lang/model/switches.h"

#include "lang/base/operation.h"
#include "lang/graph/graph_place.h"
#include "lang/graph/graph_walk.h"
#include "lang/graph/ratio.h"
#include "lang/model/table.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOVING = DEP_TIME | (DEP_STATE & ~DEP_MODE), CELLS_TRIED = 1 << 20 };

/* The loops around an expression: levels 0 … count-1. */
typedef struct nest {
    range at[MAX_LEVELS];
    int count;
} nest;

typedef struct kind {
    node n; /* the operation, in the model's graph */
    nest around;
    node side;
    uint32_t before; /* 1 + the number of another kind of this operation; 0: none */
    uint32_t first;  /* the kind of the first component of a direction; else this kind */
    uint8_t parts;   /* how many components the direction has; 0: it is none */
    node sliding;
} kind;

typedef struct builder {
    model *m;
    switches *s;
    kind *kinds, *touches;
    uint32_t room, touch_room;
    uint32_t *last, *last_touch; /* by node of the model: 1 + the number of the last kind of this operation; 0: none */
    bool directions;             /* directions are switches, too */
} builder;

static bool broken(const builder *b) { return b->m->arena->failed || b->m->graph->too_large; }

/* The values of the loops' indices --------------------------------------------------------------------------------- */

typedef struct spread {
    int64_t index[MAX_LEVELS], first[MAX_LEVELS], last[MAX_LEVELS];
    int64_t tried;
} spread;

/* Finds the smallest and the largest value of every index; inner bounds may depend on outer indices. False: there are
 * too many to try. */
static bool spread_over(const model *m, const nest *n, int level, spread *out)
{
    if (level == n->count) return ++out->tried <= CELLS_TRIED;
    const int64_t first = graph_subscript(&n->at[level].first, out->index, m->ints),
                  last = graph_subscript(&n->at[level].last, out->index, m->ints);
    if (first > last) return true;
    if (first < out->first[level]) out->first[level] = first;
    if (last > out->last[level]) out->last[level] = last;
    for (int64_t k = first; k <= last; k++) {
        out->index[level] = k;
        if (!spread_over(m, n, level + 1, out)) return false;
    }
    return true;
}

/* Makes the place of the values of a new kind; with it there may be at most `most` cells. Returns why it is impossible,
 * or NULL. */
static const char *place(builder *b, const nest *around, unsigned deps, size_t *count, size_t most, reference *value)
{
    spread over;
    over.tried = 0;
    for (int k = 0; k < MAX_LEVELS; k++) over.first[k] = INT64_MAX, over.last[k] = INT64_MIN;
    if (around->count > MAX_DIMS || !spread_over(b->m, around, 0, &over))
        return "there are too many of them in nested loops";
    int dims = 0;
    int64_t first[MAX_DIMS], last[MAX_DIMS];
    double cells = 1;
    *value = (reference){0};
    for (int level = 0; level < around->count; level++) {
        if (!(deps & 1u << level)) continue;
        const bool empty = over.first[level] > over.last[level];
        first[dims] = empty ? 1 : over.first[level];
        last[dims] = empty ? 1 : over.last[level];
        cells *= (double)(last[dims] - first[dims] + 1);
        value->at[dims++] = (subscript){(int8_t)level, -1, -1, 0};
    }
    if ((double)*count + cells > (double)most) return "there are too many of them";
    value->dims = (uint8_t)dims;
    if (model_take_arrays(b->m, 1, &value->array))
        *count += graph_shape(b->m->arena, &b->m->arrays[value->array], SPACE_OUT, *count, dims, first, last);
    return NULL;
}

size_t switches_kind(const switches *s, size_t k)
{
    size_t kind = 0;
    while (kind + 1 < s->kinds && s->first[kind + 1] <= k) kind++;
    return kind;
}

size_t switches_cells(const switches *s, size_t kind)
{
    return (kind + 1 < s->kinds ? s->first[kind + 1] : s->count) - s->first[kind];
}

model_shape switches_shape(const model *m, const switches *s, size_t kind)
{
    const array *of = &m->arrays[s->argument[kind].to.array];
    model_shape shape = {.dims = of->dims};
    for (int d = 0; d < shape.dims; d++) shape.first[d] = of->over->first[d], shape.last[d] = of->over->last[d];
    return shape;
}

/* Finds the mode with the sides of the next kind. False: it has another shape. */
static bool mode_of(builder *b, reference *side)
{
    const model *m = b->m;
    const model_state *s = &m->states[m->side_first + b->s->kinds];
    const array *of = &m->arrays[side->array];
    bool fits = b->s->kinds < m->side_count && s->dims == of->dims;
    for (int d = 0; fits && d < s->dims; d++)
        fits = s->first[d] == of->over->first[d] && s->last[d] == of->over->last[d];
    if (fits) side->array = (uint16_t)(m->block[BLOCK_X] + s->array);
    if (!fits) b->s->refused = "they change when the model is read again";
    return fits;
}

/* Returns the place of the sides of a kind: a mode, or in the pool. */
static reference place_sides(builder *b, const reference *value)
{
    reference side = *value;
    if (b->m->side_count) return mode_of(b, &side) ? side : *value;
    if (!model_take_arrays(b->m, 1, &side.array)) return side;
    array *to = &b->m->arrays[side.array];
    *to = b->m->arrays[value->array];
    to->space = SPACE_POOL;
    to->base += b->s->slot;
    return side;
}

/* Operations ------------------------------------------------------------------------------------------------------- */

bool switches_is(const graph *g, const graph_node *n)
{
    unsigned deps = 0;
    node operand[3];
    for (int k = graph_operands(n, operand); k-- > 0;) deps |= g->nodes[operand[k]].deps;
    switch ((operation)n->op) {
    case OP_ABS:
    case OP_SIGN:
    case OP_MIN:
    case OP_MAX:
    case OP_FLOOR:
    case OP_FIND:
    case OP_MOD:
    case OP_CBRT:
    case OP_LT:
    case OP_LE:
    case OP_GT:
    case OP_GE: return (deps & MOVING) != 0;
    default: return false;
    }
}

/* Returns whether an operation compares two operands: its argument is their difference, its side 1 or 0. */
static bool compares(operation op)
{
    switch (op) {
    case OP_MIN:
    case OP_MAX:
    case OP_LT:
    case OP_LE:
    case OP_GT:
    case OP_GE: return true;
    default: return false;
    }
}

static int larger_of(int a, int b) { return a > b ? a : b; }

/* Returns the degree in the time while all sides are held: 0, 1, or 2 for more, and where a switch does not change at
 * known times. `of`: the degrees of the operands. */
static int held_degree(const graph *g, const graph_node *n, const int of[3])
{
    const int all = larger_of(of[0], larger_of(of[1], of[2]));
    if (all > 1) return 2;
    switch ((operation)n->op) {
    case OP_TIME: return 1;
    case OP_MOD: return g->nodes[n->b].deps & DEP_TIME ? 2 : of[0];
    case OP_ABS: return of[0];
    case OP_SELECT: return of[0] ? 2 : larger_of(of[1], of[2]);
    case OP_CBRT: return of[0] ? 2 : 0;
    default: break;
    }
    if (operation_is((operation)n->op, IS_FLAT)) return 0;
    switch ((degree_rule)operation_at((operation)n->op)->degree) {
    case DEGREE_LEAF: return 0;
    case DEGREE_SUM: return of[1] ? 2 : of[0];
    case DEGREE_LINEAR: return all;
    case DEGREE_PRODUCT: return of[0] + of[1];
    case DEGREE_QUOTIENT: return of[1] ? 2 : of[0];
    case DEGREE_FUSED: return larger_of(of[0] + of[1], of[2]);
    default: return n->op == OP_MIN || n->op == OP_MAX || !all ? all : 2;
    }
}

bool switches_timed(graph *g, const graph_node *n)
{
    const operation op = (operation)n->op;
    const node roots[2] = {n->a, compares(op) || op == OP_MOD ? n->b : n->a};
    graph_walk w;
    if (!switches_is(g, n) || op == OP_CBRT || n->deps & (DEP_STATE | DEP_D)) return false;
    if (op == OP_MOD && g->nodes[n->b].deps & DEP_TIME) return false;
    if (!graph_order(g, roots, 2, DEP_TIME, true, &w)) return false;
    int *degree = graph_walk_room(g, &w, sizeof *degree), most = 0;
    for (uint32_t k = 0; degree && k < w.count; k++) {
        const graph_node *one = &g->nodes[w.nodes[k]];
        node operand[3];
        int of[3] = {0, 0, 0};
        for (int j = graph_operands(one, operand); j-- > 0;)
            of[j] = graph_reached(g, &w, operand[j]) ? degree[g->place[operand[j]]] : 0;
        degree[k] = held_degree(g, one, of);
        most = larger_of(most, degree[k]);
    }
    give(&g->arena->allocator, degree);
    give(&g->arena->allocator, w.nodes);
    return degree && most < 2;
}

size_t switches_sought(const model *m, const switches *s)
{
    size_t count = 0;
    for (size_t k = 0; k < s->kinds; k++)
        if (!switches_timed(m->graph, graph_at(m->graph, s->original[k]))) count += switches_cells(s, k);
    return count;
}

node switches_argument(graph *g, operation op, node a, node b)
{
    if (compares(op)) return graph_op(g, OP_SUB, a, b, 0);
    if (op == OP_FIND) return table_position(g, a, graph_op(g, OP_FIND, a, b, 0), b);
    return op == OP_MOD ? graph_op(g, OP_DIV, a, b, 0) : a;
}

static node with_side(graph *g, operation op, node a, node b, node side)
{
    switch (op) {
    case OP_ABS: return graph_op(g, OP_MUL, side, a, 0);
    case OP_MIN:
    case OP_MAX: return graph_op(g, OP_SELECT, side, a, b);
    case OP_MOD: return graph_op(g, OP_SUB, a, graph_op(g, OP_MUL, b, side, 0), 0);
    case OP_CBRT: return graph_op(g, OP_CBRT, a, 0, 0);
    default: return side;
    }
}

static bool same_nest(const nest *p, const nest *q, unsigned deps)
{
    for (int k = 0; k < MAX_LEVELS; k++)
        if (deps & 1u << k && (k >= p->count || k >= q->count || !graph_same_range(&p->at[k], &q->at[k]))) return false;
    return true;
}

static output output_to(const reference *value, unsigned levels, const nest *around)
{
    output o = {.to = *value, .loops = 0};
    while (levels >> o.loops) o.loops++;
    for (int k = 0; k < o.loops; k++) o.loop[k] = around->at[k];
    return o;
}

static void hold_argument(builder *b, uint32_t k, node held)
{
    switches *s = b->s;
    s->held[k].value = held;
    s->rate[k].value = graph_derivative(b->m->graph, held, model_seed_motion, b->m);
}

/* Adds a kind of switch. UINT32_MAX: it is refused, or no memory. */
static uint32_t add_kind(builder *b, node n, unsigned levels, node argument, node held, const nest *around)
{
    graph *g = b->m->graph;
    switches *s = b->s;
    reference value;
    s->refused = place(b, around, levels, &s->count, SWITCHES_MAX, &value);
    if (s->refused) s->refused_at = n;
    if (s->refused || broken(b)) return UINT32_MAX;
    const reference side = place_sides(b, &value);
    if (s->refused) return UINT32_MAX;
    if (s->kinds == b->room) {
        const uint32_t room = b->room ? 2 * b->room : 16;
        arena *m = b->m->arena;
        b->kinds = arena_replace(m, b->kinds, b->room * sizeof *b->kinds, room * sizeof *b->kinds);
        s->argument = arena_replace(m, s->argument, b->room * sizeof *s->argument, room * sizeof *s->argument);
        s->held = arena_replace(m, s->held, b->room * sizeof *s->held, room * sizeof *s->held);
        s->rate = arena_replace(m, s->rate, b->room * sizeof *s->rate, room * sizeof *s->rate);
        s->original = arena_replace(m, s->original, b->room * sizeof *s->original, room * sizeof *s->original);
        s->side = arena_replace(m, s->side, b->room * sizeof *s->side, room * sizeof *s->side);
        s->within = arena_replace(m, s->within, b->room * sizeof *s->within, room * sizeof *s->within);
        s->first = arena_replace(m, s->first, b->room * sizeof *s->first, room * sizeof *s->first);
        if (broken(b)) return UINT32_MAX;
        b->room = room;
    }
    const output o = output_to(&value, levels, around);
    const uint32_t k = (uint32_t)s->kinds++;
    b->kinds[k] = (kind){.n = n, .around = *around, .side = graph_load(g, &side), .first = k};
    s->original[k] = n;
    s->side[k] = b->kinds[k].side;
    s->first[k] = b->m->arrays[value.array].base;
    s->argument[k] = s->held[k] = s->rate[k] = o;
    s->argument[k].value = argument;
    hold_argument(b, k, held);
    return k;
}

/* Finds or adds a kind of switch. UINT32_MAX: it is refused, or no memory. */
static uint32_t kind_of(builder *b, node n, node a, node c, const nest *around)
{
    graph *g = b->m->graph;
    const graph_node original = g->nodes[n];
    const unsigned levels = original.deps & DEP_LEVELS;
    for (uint32_t k = b->last[n]; k; k = b->kinds[k - 1].before)
        if (same_nest(&b->kinds[k - 1].around, around, levels)) return k - 1;
    const uint32_t k = add_kind(b, n, levels, switches_argument(g, original.op, original.a, original.b),
                                switches_argument(g, original.op, a, c), around);
    if (k == UINT32_MAX) return k;
    if (original.op == OP_FIND) hold_argument(b, k, table_position(g, a, b->s->side[k], c));
    b->s->within[k] = a;
    b->kinds[k].before = b->last[n];
    b->last[n] = k + 1;
    return k;
}

/* Directions ------------------------------------------------------------------------------------------------------- */

static node product(graph *g, node a, node b) { return graph_op(g, OP_MUL, a, b, 0); }
static node difference(graph *g, node a, node b) { return graph_op(g, OP_SUB, a, b, 0); }

/* Finds u/|u| by components while u is less than a right angle away from a unit vector d: with q = d u, |u| is q sqrt(1
 * + |d x u|^2/q^2), which is smooth where the motion stops without a turn, and negative beyond. Equations that hold
 * other vectors may have u/|u| in place of some components of d, which then is no unit vector: hence the factor |d|. */
static void find_sliding(builder *b, uint32_t first, const graph_directed *d)
{
    graph *g = b->m->graph;
    node q = graph_const(g, 1e-300), across[GRAPH_COMPONENTS]; /* so that at u = 0 the quotients are 0, not 0/0 */
    const int count = d->count, areas = count == 2 ? 1 : 3;
    node *const side = b->s->side + first;
    for (int k = 0; k < count; k++) q = graph_op(g, OP_ADD, q, product(g, side[k], d->component[k]), 0);
    for (int k = 0; k < areas; k++) {
        const int i = (k + 1) % count, j = areas == 1 ? 0 : (k + 2) % count;
        across[k] = difference(g, product(g, side[j], d->component[i]), product(g, side[i], d->component[j]));
    }
    node length = graph_const(g, 1);
    for (int k = 0; k < areas; k++) length = graph_op(g, OP_HYPOT, length, graph_op(g, OP_DIV, across[k], q, 0), 0);
    length = product(g, q, length);
    node unit = side[0];
    for (int k = 1; k < count; k++) unit = graph_op(g, OP_HYPOT, unit, side[k], 0);
    for (int k = 0; k < count; k++)
        b->kinds[first + (uint32_t)k].sliding = product(g, unit, graph_op(g, OP_DIV, d->component[k], length, 0));
}

/* Returns whether a vector has the components of the direction whose kinds begin with `first`, in any order, times one
 * factor that does not move: its direction is that one or, with a negative factor, the opposite one. The order goes to
 * `at`. */
static bool same_direction(const builder *b, uint32_t first, const graph_directed *d, int *at, ratio *factor)
{
    bool taken[GRAPH_COMPONENTS] = {false};
    for (int i = 0; i < d->count; i++) {
        bool found = false;
        for (int j = 0; j < d->count && !found; j++) {
            const ratio r = ratio_of(b->m->graph, b->s->argument[first + (uint32_t)j].value, d->component[i]);
            found = !taken[j] && r.number != 0 && (i == 0 || ratio_same(&r, factor));
            if (found) at[i] = j, taken[j] = true, *factor = r;
        }
        if (!found) return false;
    }
    return true;
}

/* Finds or adds the sides of a direction, in the order of its components, turned if it is opposite. False: it is
 * refused, or no memory. */
static bool direction_of(builder *b, const graph_directed *d, const nest *around, node *sides)
{
    graph *g = b->m->graph;
    const unsigned levels = g->nodes[d->length].deps & DEP_LEVELS;
    for (uint32_t k = 0; k < b->s->kinds; k++) {
        int at[GRAPH_COMPONENTS];
        ratio factor;
        if (b->kinds[k].parts != d->count || b->kinds[k].first != k) continue;
        if ((g->nodes[g->nodes[b->kinds[k].n].b].deps & DEP_LEVELS) != levels) continue;
        if (!same_nest(&b->kinds[k].around, around, levels) || !same_direction(b, k, d, at, &factor)) continue;
        for (int i = 0; i < d->count; i++) {
            const node side = b->s->side[k + (uint32_t)at[i]];
            sides[i] = ratio_way_times(g, &factor, side);
        }
        return true;
    }
    const uint32_t first = (uint32_t)b->s->kinds;
    for (int i = 0; i < d->count; i++) {
        const node n = graph_op(g, OP_DIV, d->component[i], d->length, 0);
        const uint32_t k = add_kind(b, n, levels, d->component[i], d->component[i], around);
        if (k == UINT32_MAX) return false;
        b->kinds[k].first = first, b->kinds[k].parts = (uint8_t)d->count;
        sides[i] = b->s->side[k];
    }
    find_sliding(b, first, d);
    return true;
}

/* Returns a quotient along a direction, with the sides of the components in place of components over the length; `to`:
 * its operands, rewritten. UINT32_MAX: it is none. */
static node along_direction(builder *b, node n, const node to[3], const nest *around)
{
    graph *g = b->m->graph;
    graph_directed d;
    if (!b->directions || !graph_direction(g, n, &d)) return UINT32_MAX;
    for (int k = 0; k < d.count; k++)
        if (graph_kink(g, d.component[k])) return UINT32_MAX;
    const graph_node at = g->nodes[n];
    const bool second = at.op == OP_MUL && at.b == d.above;
    const graph_node quotient = g->nodes[to[second ? 0 : 1]];
    if (at.op == OP_MUL && (quotient.op != OP_DIV || quotient.b != d.divisor)) return UINT32_MAX;
    const node above = to[second ? 1 : 0]; /* if an inner direction of that length has been replaced, none is left */
    if (!graph_is_along(g, above, &d)) return UINT32_MAX;
    node sides[GRAPH_COMPONENTS];
    if (!direction_of(b, &d, around, sides)) return n;
    const node way = graph_along(g, above, &d, sides), by = graph_over(g, way, d.divisor, d.length);
    return d.factor == UINT32_MAX ? by : product(g, quotient.a, by);
}

/* Touches ---------------------------------------------------------------------------------------------------------- */

/* Returns a node that is 0 where an operation has no derivative, and positive elsewhere; 0: there is no such place. */
static node touch_argument(graph *g, const graph_node *n, node a, node b)
{
    const graph_node *e = &g->nodes[n->b];
    switch ((operation)n->op) {
    case OP_SQRT: return a;
    case OP_CBRT: return graph_op(g, OP_ABS, a, 0, 0); /* it also touches 0 from below */
    case OP_POW: return e->op == OP_CONST && e->value == floor(e->value) ? 0 : a;
    case OP_ASIN:
    case OP_ACOS: return graph_op(g, OP_SUB, graph_const(g, 1), graph_op(g, OP_MUL, a, a, 0), 0);
    case OP_HYPOT: return graph_op(g, OP_ADD, graph_op(g, OP_MUL, a, a, 0), graph_op(g, OP_MUL, b, b, 0), 0);
    case OP_ATAN2: return graph_op(g, OP_ADD, graph_op(g, OP_HYPOT, a, b, 0), b, 0);
    default: return 0;
    }
}

static void note_touch(builder *b, node n, node x, node y, const nest *around)
{
    graph *g = b->m->graph;
    switches *s = b->s;
    const graph_node original = g->nodes[n];
    const unsigned levels = original.deps & DEP_LEVELS;
    for (uint32_t k = b->last_touch[n]; k; k = b->touches[k - 1].before)
        if (same_nest(&b->touches[k - 1].around, around, levels)) return;
    const node argument = touch_argument(g, &original, x, y);
    reference value;
    if (!(g->nodes[argument].deps & MOVING)) return;
    if (place(b, around, levels, &s->touches, TOUCHES_MAX, &value) || broken(b)) return;
    if (s->touch_kinds == b->touch_room) {
        const uint32_t room = b->touch_room ? 2 * b->touch_room : 16;
        arena *m = b->m->arena;
        b->touches = arena_replace(m, b->touches, b->touch_room * sizeof *b->touches, room * sizeof *b->touches);
        s->touch = arena_replace(m, s->touch, b->touch_room * sizeof *s->touch, room * sizeof *s->touch);
        s->touch_rate =
            arena_replace(m, s->touch_rate, b->touch_room * sizeof *s->touch_rate, room * sizeof *s->touch_rate);
        if (broken(b)) return;
        b->touch_room = room;
    }
    const size_t k = s->touch_kinds++;
    b->touches[k] = (kind){.n = n, .around = *around, .before = b->last_touch[n]};
    b->last_touch[n] = (uint32_t)k + 1;
    s->touch[k] = s->touch_rate[k] = output_to(&value, levels, around);
    s->touch[k].value = argument;
    s->touch_rate[k].value = graph_derivative(g, argument, model_seed_motion, b->m);
}

/* Equations -------------------------------------------------------------------------------------------------------- */

/* The places of a node's operands in a walk, since other walks overwrite them in the graph: 1 + the place; 0: none. */
typedef struct operands {
    uint32_t at[3];
} operands;

static operands *places_of(graph *g, const graph_walk *w)
{
    operands *all = take(&g->arena->allocator, w->count, sizeof *all);
    if (!all) g->arena->failed = true;
    for (uint32_t k = 0; all && k < w->count; k++) {
        node operand[3];
        for (int j = graph_operands(&g->nodes[w->nodes[k]], operand); j-- > 0;)
            all[k].at[j] = graph_reached(g, w, operand[j]) ? g->place[operand[j]] + 1 : 0;
    }
    return all;
}

static node rewrite(builder *b, node root, const nest *around);

static node rewrite_sum(builder *b, node sum, const nest *around)
{
    graph *g = b->m->graph;
    const graph_node n = g->nodes[sum];
    nest inner = *around;
    while (inner.count < n.level) inner.at[inner.count++] = (range){{-1, -1, -1, 0}, {-1, -1, -1, 0}};
    inner.at[n.level] = g->ranges[n.c];
    inner.count = n.level + 1;
    const node body = rewrite(b, n.a, &inner), condition = n.b ? rewrite(b, n.b, &inner) : 0;
    if (body == n.a && condition == n.b) return sum;
    return graph_sum(g, n.level, &inner.at[n.level], condition, body);
}

/* Returns whether the form of a node shows that way times its value is nowhere below `least`. */
static bool keeps_above(const graph *g, node of, int way, double least)
{
    const graph_node n = *graph_at(g, of);
    if (n.op == OP_CONST) return way * n.value >= least;
    if (n.op == OP_ABS) return way > 0 && least <= 0;
    if (n.op != OP_MIN && n.op != OP_MAX) return false;
    const bool a = keeps_above(g, n.a, way, least), b = keeps_above(g, n.b, way, least);
    return (n.op == OP_MAX) == (way > 0) ? a || b : a && b;
}

/* Returns `with` in place of an operand of a root, a power, a logarithm, asin or acos. If the form of the operand shows
 * that these are defined everywhere, as of max(u, 0), then they stay so where a step leads beyond the side: |with|
 * stands for what is nowhere negative, and the operand itself for what is clipped to [-1, 1]. */
static node defined_beyond(graph *g, operation op, node operand, node with)
{
    const bool roots = op == OP_SQRT || op == OP_POW || op == OP_LOG, arcs = op == OP_ASIN || op == OP_ACOS;
    if (with == operand) return with;
    if (arcs && keeps_above(g, operand, 1, -1) && keeps_above(g, operand, -1, -1)) return operand;
    return roots && keeps_above(g, operand, 1, 0) ? graph_op(g, OP_ABS, with, 0, 0) : with;
}

/* Returns a node with sides in place of switches. */
static node rewrite(builder *b, node root, const nest *around)
{
    graph *g = b->m->graph;
    graph_walk w;
    if (b->s->refused || !(graph_deps(g, root) & MOVING) || !graph_order(g, &root, 1, MOVING, false, &w)) return root;
    operands *operands_of = places_of(g, &w);
    node *map = graph_walk_room(g, &w, sizeof *map);
    for (uint32_t k = 0; k < w.count && !broken(b) && !b->s->refused; k++) {
        const graph_node n = g->nodes[w.nodes[k]];
        node to[3] = {0, 0, 0};
        const int arity = graph_operands(&n, to);
        map[k] = w.nodes[k];
        if (n.op == OP_SUM) {
            map[k] = rewrite_sum(b, w.nodes[k], around);
        } else if (arity) {
            bool changed = false;
            for (int j = 0; j < arity; j++) {
                const node was = to[j];
                if (operands_of[k].at[j]) to[j] = map[operands_of[k].at[j] - 1];
                changed |= to[j] != was;
            }
            const node directed = along_direction(b, w.nodes[k], to, around);
            if (directed < UINT32_MAX) {
                map[k] = directed;
            } else if (switches_is(g, &n)) {
                const uint32_t kind = kind_of(b, w.nodes[k], to[0], to[1], around);
                if (n.op == OP_CBRT) note_touch(b, w.nodes[k], to[0], to[1], around);
                if (kind < UINT32_MAX) map[k] = with_side(g, n.op, to[0], to[1], b->kinds[kind].side);
            } else {
                if (changed) map[k] = graph_op(g, n.op, defined_beyond(g, (operation)n.op, n.a, to[0]), to[1], to[2]);
                note_touch(b, w.nodes[k], to[0], to[1], around);
            }
        }
    }
    const node result = map && w.count ? map[w.count - 1] : root;
    give(&g->arena->allocator, map);
    give(&g->arena->allocator, operands_of);
    give(&g->arena->allocator, w.nodes);
    return result;
}

static output *rewrite_all(builder *b, const output *from, size_t count)
{
    output *to = arena_room(b->m->arena, (count + 1) * sizeof *to);
    for (size_t i = 0; to && i < count && !broken(b); i++) {
        nest around = {.count = from[i].loops};
        for (int k = 0; k < from[i].loops; k++) around.at[k] = from[i].loop[k];
        to[i] = from[i];
        to[i].value = rewrite(b, from[i].value, &around);
    }
    return to;
}

static output *choose_all(model *m, const output *from, size_t count)
{
    output *to = arena_room(m->arena, (count + 1) * sizeof *to);
    for (size_t i = 0; to && i < count; i++) to[i] = from[i], to[i].value = graph_choices(m->graph, from[i].value);
    return to;
}

bool switches_find(model *m, bool directions, switches *s)
{
    *s = (switches){.slot = m->pool_count};
    const output *const accel = choose_all(m, m->accel, m->accel_count), *const boundary = choose_all(
                                                                             m, m->boundary, m->boundary_count);
    if (!accel || !boundary) return false;
    const size_t nodes = m->graph->count;
    builder b = {
        .m = m, .s = s, .directions = directions, .last = take(&m->arena->allocator, nodes, 2 * sizeof *b.last)};
    if (!b.last) return m->arena->failed = true, false;
    b.last_touch = b.last + nodes;
    s->accel = rewrite_all(&b, accel, m->accel_count);
    s->boundary = rewrite_all(&b, boundary, m->boundary_count);
    s->op = arena_room(m->arena, s->count + 1);
    give(&m->arena->allocator, b.last);
    s->leader = arena_room(m->arena, (s->kinds + 1) * sizeof *s->leader);
    s->parts = arena_room(m->arena, s->kinds + 1);
    s->sliding = arena_room(m->arena, (s->kinds + 1) * sizeof *s->sliding);
    if (broken(&b) || !s->op || !s->leader || !s->parts || !s->sliding) return false;
    for (size_t k = 0; k < s->kinds; k++) {
        s->leader[k] = b.kinds[k].first, s->parts[k] = b.kinds[k].parts, s->sliding[k] = b.kinds[k].sliding;
        memset(s->op + s->first[k], m->graph->nodes[b.kinds[k].n].op, switches_cells(s, k));
    }
    return true;
}

void switches_surface(const model *m, node original, char *out, size_t size)
{
    const graph_node n = *graph_at(m->graph, original);
    const operation op = (operation)n.op;
    if (op == OP_FIND) {
        model_print(m, n.a, out, size);
        const size_t length = strlen(out);
        snprintf(out + length, size - length, " = a point of ");
        model_print(m, n.b, out + strlen(out), size - strlen(out));
        return;
    }
    const bool turned = compares(op) && m->graph->nodes[n.a].op == OP_CONST;
    model_print(m,
                op == OP_DIV || turned ? n.b
                : compares(op)         ? n.a
                                       : switches_argument(m->graph, op, n.a, n.b),
                out, size);
    const size_t used = strlen(out);
    snprintf(out + used, size - used, " = %s", switches_counts(op) ? "a whole number" : "0");
    if (compares(op) && used + 3 < size) model_print(m, turned ? n.a : n.b, out + used + 3, size - used - 3);
}

/* Sides ------------------------------------------------------------------------------------------------------------ */

bool switches_directs(operation op) { return op == OP_DIV; }

bool switches_counts(operation op) { return op == OP_FLOOR || op == OP_MOD || op == OP_FIND; }

/* Returns 1 where the argument is positive on a side, -1 where it is negative. */
static double direction(operation op, double side)
{
    switch (op) {
    case OP_MIN:
    case OP_LT:
    case OP_LE: return side != 0 ? -1 : 1;
    case OP_MAX:
    case OP_GT:
    case OP_GE: return side != 0 ? 1 : -1;
    default: return side;
    }
}

double switches_side(operation op, double u, double rate)
{
    if (switches_counts(op)) return floor(u) == u && rate < 0 ? u - 1 : floor(u);
    const double s = u > 0 ? 1 : u < 0 ? -1 : rate > 0 ? 1 : rate < 0 ? -1 : 0;
    switch (op) {
    case OP_LT: return s < 0;
    case OP_MIN:
    case OP_LE: return s <= 0;
    case OP_GT: return s > 0;
    case OP_MAX:
    case OP_GE: return s >= 0;
    default: return s;
    }
}

bool switches_jumps(operation op) { return op != OP_ABS && op != OP_MIN && op != OP_MAX && op != OP_CBRT; }

double switches_distance(operation op, double side, double u)
{
    const double way = direction(op, side);
    if (switches_counts(op)) return (u - side) * (side + 1 - u);
    return way != 0 ? way * u : -u * u;
}

double switches_distance_slope(operation op, double side, double u)
{
    if (switches_counts(op)) return 2 * (side - u) + 1;
    const double way = direction(op, side);
    return way != 0 ? way : -2 * u;
}

double switches_gap(operation op, double side, double u)
{
    if (switches_counts(op)) return fmin(u - side, side + 1 - u);
    const double way = direction(op, side);
    return way != 0 ? way * u : -fabs(u);
}

double switches_gap_rate(operation op, double side, double u, double rate)
{
    if (switches_counts(op)) return u - side < side + 1 - u ? rate : -rate;
    return direction(op, side) * rate;
}

double switches_beyond(operation op, double side, double u)
{
    if (switches_counts(op)) return u - side < side + 1 - u ? side - 1 : side + 1;
    if (compares(op)) return 1 - side;
    return side != 0 ? -side : u > 0 ? 1 : -1;
}
