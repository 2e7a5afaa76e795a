/* Evaluation while a model is read. The tape computes constants, so a parameter has the value that every machine would
 * compute. */
#include "lang/model/evaluate.h"

#include "lang/model/vary_record.h"
#include "lang/tape/tape.h"

#include <math.h>

bool evaluate_outputs(model *m, const output *outputs, size_t count, double t, double *const base[SPACES])
{
    if (source_failed(&m->source)) return false;
    arena once; /* a program for every constant would stay as long as the model */
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

/* Room for outputs, to be given back, and an array for each. */
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
    m->array_count = arrays; /* only this call needs them */
    give(&m->arena->allocator, o);
    return ok;
}

/* leaf: what is read from the place; 0: nothing is. */
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

void evaluate_held_cell(model *m, const output *target, const node *values, int parts, uint16_t first)
{
    const bool crowded = m->graph->count > GRAPH_NODES_MAX / 2; /* so many numbers have no leaves of their own */
    if (!m->source.nudged || target->loops) return;
    for (int k = 0; k < parts; k++) {
        reference r = target->to;
        r.array = (uint16_t)(first + k);
        const array *const a = &m->arrays[r.array];
        int64_t place = (int64_t)a->base;
        for (int d = 0; d < r.dims; d++)
            place += (r.at[d].literal + (r.at[d].slot >= 0 ? m->ints[r.at[d].slot] : 0) - a->over->first[d]) *
                     a->over->stride[d];
        held(m, values[k], (size_t)place, crowded ? 0 : graph_load(m->graph, &r));
    }
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
    m->array_count = arrays; /* only this call needs them */
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
