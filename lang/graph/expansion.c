/* See expansion.h.
 *
 * Invariant: joining powers changes the rounding of a value and nothing else. A base whose root is taken is not
 * negative, so its half powers multiply.
 */
#include "lang/graph/expansion.h"
#include "lang/graph/plan.h"
#include "lang/graph/graph_walk.h"

#include <math.h>
#include <stdlib.h>

/* The equations ---------------------------------------------------------------------------------------------------- */

typedef struct joining {
    graph *from, *to;
    graph_walk w;
    node *image; /* by place */
    node *base;  /* by place: the value is base^(halves/2), unless halves is 0 */
    int32_t *halves;
} joining;

static uint32_t at(const joining *j, node n) { return j->from->place[n]; }
static node image(const joining *j, node n) { return j->image[at(j, n)]; }

static node power(graph *g, node base, int halves)
{
    const node one = graph_const(g, 1);
    if (halves == 1) return graph_op(g, OP_SQRT, base, 0, 0);
    if (halves == -1) return graph_op(g, OP_DIV, one, graph_op(g, OP_SQRT, base, 0, 0), 0);
    if (halves < 0 && halves % 2) return graph_op(g, OP_POW, base, graph_const(g, halves / 2.0), 0);
    if (halves < 0) return graph_op(g, OP_DIV, one, graph_power(g, base, -halves / 2), 0);
    const node whole = halves > 1 ? graph_power(g, base, halves / 2) : one;
    return halves % 2 ? graph_op(g, OP_MUL, whole, graph_op(g, OP_SQRT, base, 0, 0), 0) : whole;
}

/* Returns how often an operand has the base as a factor, in halves; 0: it is no power of the base. */
static int halves_of(const joining *j, node n, node base)
{
    if (j->halves[at(j, n)] && j->base[at(j, n)] == base) return j->halves[at(j, n)];
    return image(j, n) == base ? 2 : 0;
}

enum { HALVES_MAX = 64 };
static node joined(joining *j, uint32_t k, node base, int halves)
{
    if (halves && abs(halves) <= HALVES_MAX) j->base[k] = base, j->halves[k] = halves;
    return power(j->to, base, halves);
}

/* Joins a product or a quotient of powers of one base, or a quotient by an odd power of a root. False: it is
 * neither. */
static bool join(joining *j, uint32_t k, const graph_node *n, node *out)
{
    const int sign = n->op == OP_MUL ? 1 : -1;
    for (int side = 0; side < 2; side++) {
        const node p = side ? n->b : n->a, q = side ? n->a : n->b;
        const int halves = j->halves[at(j, p)], other = halves ? halves_of(j, q, j->base[at(j, p)]) : 0;
        if (!other) continue;
        const int all = side ? other + sign * halves : halves + sign * other;
        *out = joined(j, k, j->base[at(j, p)], all);
        return true;
    }
    const int below = j->halves[at(j, n->b)];
    if (n->op != OP_DIV || below % 2 == 0 || below < 3) return false;
    const node base = j->base[at(j, n->b)], over = image(j, n->a);
    const graph_node *top = graph_at(j->to, over);
    if (top->op == OP_CONST && top->value == 1)
        *out = joined(j, k, base, -below);
    else
        *out = graph_op(j->to, OP_MUL, over, power(j->to, base, -below), 0);
    return true;
}

static bool moves(const graph *g, node n) { return (graph_at(g, n)->deps & (DEP_STATE | DEP_TIME)) != 0; }

/* Takes a constant factor out of the product p q, if there is one: *p becomes that factor, and *q the rest. So the
 * inner sum is that of two factors that move, and the multiple needs neither sum nor memory. */
static void set_apart(graph *g, node *p, node *q)
{
    if (!moves(g, *p) || !moves(g, *q)) return;
    for (int side = 0; side < 2; side++) {
        const node one = side ? *q : *p, other = side ? *p : *q;
        const graph_node *n = graph_at(g, one);
        if (n->op != OP_MUL) continue;
        const node a = n->a, b = n->b;
        if (moves(g, a) == moves(g, b)) continue;
        *p = moves(g, a) ? b : a;
        *q = graph_op(g, OP_MUL, moves(g, a) ? a : b, other, 0);
        return;
    }
}

static node form(joining *j, uint32_t k)
{
    const graph_node n = j->from->nodes[j->w.nodes[k]];
    graph *g = j->to;
    node operand[3] = {0, 0, 0}, out;
    if (graph_copy_leaf(j->from, &n, g, &out)) return out;
    switch (n.op) {
    case OP_SUM: return graph_sum(g, n.level, &j->from->ranges[n.c], n.b ? image(j, n.b) : 0, image(j, n.a));
    case OP_MUL:
    case OP_DIV:
        if (join(j, k, &n, &out)) return out;
        break;
    case OP_SQRT: j->base[k] = image(j, n.a), j->halves[k] = 1; break;
    case OP_POW: {
        const node base = image(j, n.a), exponent = image(j, n.b);
        const graph_node *c = graph_at(g, exponent);
        if (c->deps & (DEP_STATE | DEP_TIME))
            return graph_op(g, OP_EXP, graph_op(g, OP_MUL, exponent, graph_op(g, OP_LOG, base, 0, 0), 0), 0, 0);
        const double twice = c->op == OP_CONST ? 2 * c->value : 0;
        if (twice && fabs(twice) <= HALVES_MAX && twice == nearbyint(twice)) return joined(j, k, base, (int)twice);
        break;
    }
    default: break;
    }
    for (int i = graph_operands(&n, operand); i-- > 0;) operand[i] = image(j, operand[i]);
    if (n.op == OP_MUL || n.op == OP_FMA || n.op == OP_FMS || n.op == OP_FNMA) set_apart(g, &operand[0], &operand[1]);
    return graph_op(g, (operation)n.op, operand[0], operand[1], operand[2]);
}

static bool join_all(joining *j, const output *outputs, output *to, size_t count, node *roots)
{
    const motus_allocator *hooks = &j->from->arena->allocator;
    for (size_t r = 0; r < count; r++) roots[r] = outputs[r].value;
    if (!graph_order(j->from, roots, count, 0, true, &j->w)) return false;
    j->image = take(hooks, j->w.count, sizeof *j->image);
    j->base = take(hooks, j->w.count, sizeof *j->base);
    j->halves = take(hooks, j->w.count, sizeof *j->halves);
    const bool ok = j->image && j->base && j->halves;
    for (uint32_t k = 0; ok && k < j->w.count; k++) {
        j->halves[k] = 0;
        j->image[k] = form(j, k);
    }
    for (size_t r = 0; ok && r < count; r++) {
        to[r] = outputs[r];
        to[r].value = image(j, outputs[r].value);
    }
    give(hooks, j->halves);
    give(hooks, j->base);
    give(hooks, j->image);
    give(hooks, j->w.nodes);
    return ok;
}

program *expansion_program(arena *a, graph *g, const output *outputs, size_t count)
{
    arena once;
    arena_init(&once, &a->allocator);
    const motus_allocator *hooks = &a->allocator;
    joining j = {.from = g, .to = graph_create(&once)};
    output *to = take(hooks, count + !count, sizeof *to);
    node *roots = take(hooks, count + !count, sizeof *roots);
    program *p = NULL;
    if (to && roots && !once.failed) {
        j.to->arrays = g->arrays;
        if (join_all(&j, outputs, to, count, roots) && !once.failed && !j.to->too_large)
            p = program_create_in(a, j.to, to, count);
    }
    if (!p) a->failed = true;
    give(hooks, roots);
    give(hooks, to);
    arena_release(&once);
    return p;
}

/* Lengths ---------------------------------------------------------------------------------------------------------- */

static int larger(int a, int b) { return a > b ? a : b; }
static int both(int a, int b) { return a >= EXPANSION_ALL || b >= EXPANSION_ALL ? EXPANSION_ALL : a + b; }

static int last_of(const graph *g, const graph_node *n, const int *last)
{
    const int arity = operation_at(n->op)->arity;
    const int a = arity > 0 ? last[n->a] : 0, b = arity > 1 ? last[n->b] : 0, c = arity > 2 ? last[n->c] : 0;
    if (n->op == OP_LOAD) return g->arrays[g->references[n->a].array].space == SPACE_POOL ? 0 : EXPANSION_ALL;
    if (n->op == OP_SUM) return last[n->a];
    if (n->op == OP_TIME) return 1;
    if (n->op == OP_TOTAL || !(n->deps & (DEP_STATE | DEP_TIME))) return 0;
    switch (n->op) {
    case OP_NEG:
    case OP_ABS: return a;
    case OP_ADD:
    case OP_SUB:
    case OP_MIN:
    case OP_MAX:
    case OP_MOD: return larger(a, b);
    case OP_SELECT: return larger(b, c);
    case OP_MUL: return both(a, b);
    case OP_FMA:
    case OP_FMS:
    case OP_FNMA: return larger(both(a, b), c);
    case OP_DIV: return b ? EXPANSION_ALL : a;
    default: return operation_is(n->op, IS_FLAT) || !(a || b || c) ? 0 : EXPANSION_ALL;
    }
}

/* Places ----------------------------------------------------------------------------------------------------------- */

bool expansion_begins(const expansion *e, const plan *p, uint32_t item)
{
    return e->values[item].last > 0 && operation_at(p->g->nodes[p->items.at[item].n].op)->keeps > 0;
}

static uint32_t numbers_of(const expansion *e, const plan *p, uint32_t item)
{
    const expansion_value *v = &e->values[item];
    const int keeps = operation_at(p->g->nodes[p->items.at[item].n].op)->keeps;
    const bool looped = p->regions.at[p->items.at[item].region].level >= 0;
    if (v->state && looped) return v->passing ? 1 : (uint32_t)e->length;
    if (v->passing && plan_updates(p, &p->items.at[item]) == NONE) return 1;
    if (v->state || v->twin != NONE || plan_updates(p, &p->items.at[item]) != NONE) return 0;
    if (expansion_begins(e, p, item)) return (uint32_t)(keeps * e->length);
    return (uint32_t)(v->last < e->length ? v->last + 1 : e->length);
}

static operation twin_of(operation op)
{
    switch (op) {
    case OP_SIN: return OP_COS;
    case OP_COS: return OP_SIN;
    case OP_SINH: return OP_COSH;
    case OP_COSH: return OP_SINH;
    default: return OPERATIONS;
    }
}

/* Returns whether a recurrence reads of operand i only the coefficient of the order that it computes. */
static bool passes(const graph_node *n, int i, const int *last)
{
    const node other = i ? n->a : n->b;
    switch (n->op) {
    case OP_NEG:
    case OP_ADD:
    case OP_SUB: return true;
    case OP_FMA:
    case OP_FMS:
    case OP_FNMA: return i == 2 || last[other] == 0;
    case OP_MUL: return last[other] == 0;
    default: return false;
    }
}

/* Marks the nodes of which a recurrence, their own included, reads earlier coefficients. */
static void find_kept(const graph *g, const int *last, uint8_t *kept)
{
    for (node k = 0; k < g->count; k++) {
        const graph_node *n = &g->nodes[k];
        node operand[3] = {0, 0, 0};
        if (operation_at(n->op)->keeps > 0) kept[k] = 1;
        for (int i = graph_operands(n, operand); i-- > 0;) {
            const bool term = n->op == OP_SUM && i == 0; /* the update of the total reads this operand */
            if (!term && !passes(n, i, last)) kept[operand[i]] = 1;
        }
    }
}

/* Returns the earlier item of the region whose first helper is this item's value; `seen`, by operand: the first item of
 * each kind. */
static uint32_t find_twin(const plan *p, uint32_t item, uint32_t *seen)
{
    const plan_item *i = &p->items.at[item];
    const graph_node *n = &p->g->nodes[i->n];
    const operation other = twin_of(n->op);
    if (other == OPERATIONS) return NONE;
    const bool hyperbolic = other == OP_SINH || other == OP_COSH;
    uint32_t *first = &seen[2 * n->a + hyperbolic];
    if (*first != NONE && p->items.at[*first].region == i->region && p->g->nodes[p->items.at[*first].n].op == other)
        return *first;
    *first = item;
    return NONE;
}

/* Leaves only the two lists in the arena. */
bool expansion_place(expansion *e, arena *a, const plan *p, int length, bool compact)
{
    const uint32_t items = p->items.count, nodes = p->g->count;
    e->length = length;
    e->values = arena_room(a, (items + 1) * sizeof *e->values);
    e->frames = arena_room(a, (p->regions.count + 1) * sizeof *e->frames);
    int *last = take(p->hooks, nodes + 1, sizeof *last);
    uint32_t *seen = take(p->hooks, 2 * (size_t)nodes + 1, sizeof *seen);
    uint8_t *kept = take(p->hooks, nodes + 1, sizeof *kept);
    const bool ok = e->values && e->frames && last && seen && kept;
    for (uint32_t n = 0; ok && n < nodes; n++) {
        last[n] = last_of(p->g, &p->g->nodes[n], last);
        if (last[n] > length - 3) last[n] = EXPANSION_ALL; /* coefficients 0 … length-3 are computed */
        seen[2 * n] = seen[2 * n + 1] = NONE;
    }
    for (node n = 0; ok && n < nodes; n++) kept[n] = !compact;
    if (ok && compact) find_kept(p->g, last, kept);
    for (uint32_t r = 0; ok && r < p->regions.count; r++) {
        const plan_region *region = &p->regions.at[r];
        e->frames[r] = 0;
        for (uint32_t k = 0; k < region->item_count; k++) {
            const uint32_t item = p->order[region->items + k];
            const graph_node *n = &p->g->nodes[p->items.at[item].n];
            const bool load = n->op == OP_LOAD && last[p->items.at[item].n] > 0;
            expansion_value *v = &e->values[item];
            *v = (expansion_value){.last = last[p->items.at[item].n], .state = load, .twin = NONE};
            if (v->last > 0) v->twin = find_twin(p, item, seen);
            v->passing = v->last == EXPANSION_ALL && v->twin == NONE && !kept[p->items.at[item].n];
            v->at = e->frames[r];
            e->frames[r] += numbers_of(e, p, item);
        }
    }
    if (!ok) a->failed = true;
    give(p->hooks, kept);
    give(p->hooks, seen);
    give(p->hooks, last);
    return ok;
}
