/* See lone.h. The program of all outputs defines the bits, so its normal form is evaluated here, too. */
#include "lang/tape/lone.h"

#include "lang/graph/graph_place.h"
#include "lang/graph/graph_walk.h"

#include <math.h>

/* A node, and the places of its operands among the items of its output. */
typedef struct item {
    graph_node node;
    uint32_t operand[3];
} item;

struct lone {
    const program *program;
    item *items;
    size_t *first; /* by output: its first item; then the end */
    double *value; /* by item of an output */
};

static bool has_sums(const graph *g)
{
    bool any = false;
    for (uint32_t k = 0; k < g->count; k++) any |= g->nodes[k].op == OP_SUM;
    return any;
}

/* Appends the items of an output. False: no memory. */
static bool append(lone *l, arena *a, size_t k, size_t *room)
{
    graph *g = l->program->graph;
    graph_walk w;
    if (!graph_order(g, &l->program->outputs[k].value, 1, 0, true, &w)) return false;
    const size_t at = l->first[k];
    if (at + w.count > *room) {
        const size_t wider = 2 * (at + w.count);
        item *more = arena_replace(a, l->items, *room * sizeof *more, wider * sizeof *more);
        if (more) l->items = more, *room = wider;
    }
    for (uint32_t i = 0; at + w.count <= *room && i < w.count; i++) {
        node operand[3] = {0};
        item *to = &l->items[at + i];
        *to = (item){.node = g->nodes[w.nodes[i]]};
        for (int j = graph_operands(&to->node, operand); j-- > 0;) to->operand[j] = g->place[operand[j]];
    }
    l->first[k + 1] = at + w.count;
    give(&g->arena->allocator, w.nodes);
    return at + w.count <= *room;
}

bool lone_create(arena *a, graph *g, const output *outputs, size_t count, lone **out)
{
    const program *p = program_create_in(a, g, outputs, count);
    lone *l = arena_take(a, sizeof *l);
    size_t room = 0, most = 1;
    *out = NULL;
    if (!p || !l) return false;
    if (has_sums(p->graph)) return true;
    *l = (lone){.program = p, .first = arena_take(a, (count + 1) * sizeof *l->first)};
    if (!l->first) return false;
    for (size_t k = 0; k < count; k++) {
        if (!append(l, a, k, &room)) return false;
        if (l->first[k + 1] - l->first[k] > most) most = l->first[k + 1] - l->first[k];
    }
    l->value = arena_take(a, most * sizeof *l->value);
    *out = l;
    return l->value != NULL;
}

/* Returns whether an output has a cell at these indices. */
static bool has_cell(const output *o, const int64_t *index, const int64_t *ints)
{
    bool has = true;
    for (int d = 0; d < o->loops; d++)
        has &= index[d] >= graph_subscript(&o->loop[d].first, index, ints) &&
               index[d] <= graph_subscript(&o->loop[d].last, index, ints);
    return has;
}

double lone_run(lone *l, size_t k, const int64_t *index, const binding *b, double t, double *const base[SPACES])
{
    const item *items = l->items + l->first[k];
    const size_t count = l->first[k + 1] - l->first[k];
    const reference *references = l->program->graph->references;
    double *const value = l->value;
    if (!has_cell(&l->program->outputs[k], index, b->ints)) return NAN;
    for (size_t i = 0; i < count; i++) {
        const graph_node *n = &items[i].node;
        const uint32_t *of = items[i].operand;
        switch ((operation)n->op) {
        case OP_CONST: value[i] = n->value; break;
        case OP_TIME: value[i] = t; break;
        case OP_PARAM: value[i] = b->pool[n->a]; break;
        case OP_TABLE: value[i] = operation_table(b->pool + b->arrays[n->a].base); break;
        case OP_INDEX: value[i] = (double)index[n->level]; break;
        case OP_LOAD: {
            const space s = b->arrays[references[n->a].array].space;
            const double *from = s == SPACE_POOL ? b->pool : base[s];
            value[i] = from[graph_element(b->arrays, &references[n->a], index, b->ints)];
            break;
        }
        default: value[i] = operation_value((operation)n->op, value[of[0]], value[of[1]], value[of[2]]);
        }
    }
    return count ? value[count - 1] : NAN;
}
