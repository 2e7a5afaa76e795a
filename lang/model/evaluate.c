/* See evaluate.h. The tape computes constants, so a parameter has the value that every machine would compute. */
#include "lang/model/evaluate.h"

#include "lang/graph/graph_place.h"
#include "lang/model/vary_record.h"
#include "lang/tape/tape.h"

#include <math.h>

bool evaluate_outputs(model *m, const output *outputs, size_t count, double t, double *const base[SPACES])
{
    if (source_failed(&m->source)) return false;
    arena once; /* so that the program does not stay as long as the model */
    arena_init(&once, &m->arena->allocator);
    program *p = program_create_in(&once, m->graph, outputs, count);
    tape *tp = source_failed(&m->source) || !p ? NULL : tape_create(&once, p);
    const binding b = {m->arrays, m->ints, m->pool};
    const bool bound = tp && !once.failed && tape_bind(tp, &b);
    if (bound) tape_run(tp, t, base);
    if (once.failed) m->arena->failed = true;
    arena_release(&once);
    return bound;
}

/* Takes room for outputs, which the caller gives back, and an array for each. */
static output *outputs_for(model *m, int count, uint16_t *first)
{
    if (!model_take_arrays(m, count, first)) return NULL;
    output *o = take(&m->arena->allocator, (size_t)count, sizeof *o);
    if (!o) m->arena->failed = true;
    return o;
}

bool evaluate_into_pool(model *m, const output *target, const node *values, int parts, size_t base,
                        const int64_t first[], const int64_t last[], size_t hull)
{
    uint32_t arrays = m->array_count;
    uint16_t at;
    output *o = outputs_for(m, parts, &at);
    if (!o) return false;
    for (int k = 0; k < parts; k++) {
        graph_shape(m->arena, &m->arrays[at + k], SPACE_OUT, base + (size_t)k * hull, target->to.dims, first, last);
        o[k] = *target;
        o[k].value = values[k];
        o[k].to.array = (uint16_t)(at + k);
    }
    double *spaces[SPACES] = {[SPACE_OUT] = m->pool};
    bool ok = evaluate_outputs(m, o, (size_t)parts, 0, spaces);
    m->array_count = arrays; /* only this call needs the arrays */
    give(&m->arena->allocator, o);
    return ok;
}

/* what decimals say of sums and families --------------------------------------------------------------------------- */

enum { SINGLES_MOST = 1 << 12 }; /* cells and terms of a model that get values of their own */

/* The values of loop variables, at the levels below `level`. */
typedef struct singling {
    model *model;
    int64_t index[MAX_LEVELS];
    int level;
    bool failed;
} singling;

static node single_at(graph *, node, int level, void *);

static node single(singling *s, node n)
{
    return graph_replace(s->model->graph, n, DEP_LEVELS | DEP_PARAM, s->level, single_at, s);
}

/* Counts one more cell or term. False: it is one too many, or the model has failed. */
static bool counted(singling *s)
{
    const graph *const g = s->model->graph;
    if (s->model->singles >= SINGLES_MOST || source_failed(&s->model->source) || g->too_large) s->failed = true;
    s->model->singles++;
    return !s->failed;
}

static node single_sum(singling *s, graph_node sum)
{
    graph *const g = s->model->graph;
    const range over = g->ranges[sum.c];
    const int64_t *const ints = s->model->ints;
    const int64_t last = graph_subscript(&over.last, s->index, ints);
    const int before = s->level;
    node total = 0;
    bool any = false;
    s->level = sum.level + 1;
    for (int64_t i = graph_subscript(&over.first, s->index, ints); i <= last && counted(s); i++) {
        s->index[sum.level] = i;
        const node condition = sum.b ? single(s, sum.b) : 0, term = single(s, sum.a);
        if (sum.b && graph_at(g, condition)->op != OP_CONST) s->failed = true;
        if (s->failed || (sum.b && graph_at(g, condition)->value == 0)) continue;
        total = any ? graph_op(g, OP_ADD, total, term, 0) : term;
        any = true;
    }
    s->level = before;
    return total;
}

/* Returns a reference to a cell, at the present values of the loops. */
static reference single_cell(const singling *s, reference r)
{
    for (int d = 0; d < r.dims; d++)
        r.at[d] = (subscript){.level = -1,
                              .slot = -1,
                              .modulus = -1,
                              .literal = (int32_t)graph_subscript(&r.at[d], s->index, s->model->ints)};
    return r;
}

static node single_at(graph *g, node n, int level, void *ctx)
{
    singling *const s = ctx;
    const graph_node of = *graph_at(g, n);
    (void)level;
    if (s->failed) return n;
    if (of.op == OP_INDEX) return of.level < s->level ? graph_const(g, (double)s->index[of.level]) : n;
    if (of.op == OP_SUM) return single_sum(s, of);
    const reference r = single_cell(s, g->references[of.a]);
    return graph_load(g, &r);
}

node evaluate_sum(model *m, node n)
{
    singling s = {.model = m};
    if (!m->source.nudged || source_failed(&m->source) || graph_deps(m->graph, n) & ~(unsigned)DEP_PARAM) return n;
    const node written = single_sum(&s, *graph_at(m->graph, n));
    return s.failed || source_failed(&m->source) ? n : graph_written_out(m->graph, n, written);
}

/* Puts into a place of the pool what the shadow's constant `value` is; leaf: a node that loads the place, or 0. */
static void held(model *m, node value, size_t place, node leaf)
{
    const source *const s = &m->source;
    if (source_failed(s)) return;
    const bool varied = s->varied && place < s->varied_count && s->varied[place];
    m->pool[place] = graph_holds(m->graph, value, varied ? 0 : leaf, m->pool[place]);
}

void evaluate_held(model *m, node value, uint32_t slot)
{
    if (m->source.nudged) held(m, value, slot, graph_param(m->graph, slot));
}

/* Puts the components of all cells into their places; loops from `level` on are still to be run. */
static void held_cells(singling *s, const output *target, const node *values, int parts, uint16_t first)
{
    model *const m = s->model;
    graph *const g = m->graph;
    if (s->level < target->loops) {
        const range over = target->loop[s->level];
        const int64_t last = graph_subscript(&over.last, s->index, m->ints);
        for (int64_t i = graph_subscript(&over.first, s->index, m->ints); i <= last && counted(s); i++) {
            s->index[s->level++] = i;
            held_cells(s, target, values, parts, first);
            s->level--;
        }
        return;
    }
    const bool crowded = g->count > GRAPH_NODES_MAX / 2; /* with this many nodes, numbers get no leaves of their own */
    for (int k = 0; k < parts && !s->failed && !source_failed(&m->source); k++) {
        reference r = single_cell(s, target->to);
        r.array = (uint16_t)(first + k);
        const size_t place = graph_element(m->arrays, &r, s->index, m->ints);
        const node value = target->loops ? single(s, values[k]) : values[k];
        if (!s->failed) held(m, value, place, crowded ? 0 : graph_load(g, &r));
    }
}

void evaluate_held_cells(model *m, const output *target, const node *values, int parts, uint16_t first)
{
    singling s = {.model = m};
    if (m->source.nudged) held_cells(&s, target, values, parts, first);
}

bool evaluate_nodes(model *m, const node *nodes, int count, double *out)
{
    bool literal = true;
    for (int k = 0; k < count; k++) literal &= graph_at(m->graph, nodes[k])->op == OP_CONST;
    if (literal) {
        for (int k = 0; k < count; k++) out[k] = graph_at(m->graph, nodes[k])->value;
        return true;
    }
    uint32_t arrays = m->array_count;
    uint16_t first;
    output *o = outputs_for(m, count, &first);
    if (!o) return false;
    for (int k = 0; k < count; k++) {
        graph_shape(m->arena, &m->arrays[first + k], SPACE_OUT, (size_t)k, 0, NULL, NULL);
        o[k] = (output){.value = nodes[k], .to = {.array = (uint16_t)(first + k)}};
    }
    double *base[SPACES] = {[SPACE_OUT] = out};
    bool ok = evaluate_outputs(m, o, (size_t)count, 0, base);
    m->array_count = arrays; /* only this call needs the arrays */
    give(&m->arena->allocator, o);
    return ok;
}

static bool constant_node(model *m, node n, const span *at)
{
    if (graph_deps(m->graph, n) & (DEP_TIME | DEP_STATE | DEP_LEVELS | DEP_D)) {
        source_complain(&m->source, MOTUS_SHAPE, at,
                        "this must be constant: it cannot depend on a state, on time or on an index");
        return false;
    }
    return true;
}

bool evaluate_constant(model *m, node n, const span *at, double *value)
{
    return !source_failed(&m->source) && constant_node(m, n, at) && evaluate_nodes(m, &n, 1, value);
}

bool evaluate_number(model *m, node n, const span *at, const char *what, double *value)
{
    if (!evaluate_constant(m, n, at, value)) return false;
    vary_freeze(m, n, what);
    return !source_failed(&m->source);
}

int evaluate_int(model *m, node n, const span *at, int64_t *value)
{
    for (uint32_t i = 0; i < m->int_count; i++)
        if (m->int_nodes[i] == n) {
            *value = m->ints[i];
            return (int)i;
        }
    double v;
    if (!evaluate_number(m, n, at, NULL, &v)) return -1;
    if (fabs(v) > 1e9) {
        source_complain(&m->source, MOTUS_LIMIT, at, "a bound of an index is at most 1e9, and this is %g", v);
        return -1;
    }
    if (v != floor(v)) {
        source_complain(&m->source, MOTUS_SHAPE, at, "a whole number is expected here, not %g", v);
        return -1;
    }
    if (m->int_count == INT16_MAX) {
        source_complain(&m->source, MOTUS_LIMIT, at, "more than %d different bounds and shifts of indices", INT16_MAX);
        return -1;
    }
    if (m->int_count == m->int_capacity) {
        uint32_t room = m->int_capacity ? 2 * m->int_capacity : 32;
        int64_t *ints = arena_grow(m->arena, m->ints, m->int_capacity * sizeof *ints, room * sizeof *ints);
        node *nodes = arena_grow(m->arena, m->int_nodes, m->int_capacity * sizeof *nodes, room * sizeof *nodes);
        if (!ints || !nodes) return -1;
        m->ints = ints;
        m->int_nodes = nodes;
        m->int_capacity = room;
    }
    m->ints[m->int_count] = *value = (int64_t)v;
    m->int_nodes[m->int_count] = n;
    return (int)m->int_count++;
}
