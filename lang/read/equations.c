/* Lowers equations, boundary lines, quantities, invariants and exact motions to outputs over the graph. */
#include "lang/read/read_steps.h"

#include "lang/lower/hull.h"
#include "lang/lower/lower.h"
#include "lang/model/evaluate.h"
#include "lang/model/symbols.h"

#include <stdio.h>
#include <string.h>

typedef struct outputs {
    output **item;
    size_t *count, room;
} outputs;

static bool add(model *m, outputs *o, const output *one)
{
    if (*o->count == o->room) {
        size_t room = o->room ? 2 * o->room : 16;
        output *more = arena_replace(m->arena, *o->item, o->room * sizeof *more, room * sizeof *more);
        if (!more) return false;
        *o->item = more;
        o->room = room;
    }
    (*o->item)[(*o->count)++] = *one;
    return true;
}

static bool same_shape(model *m, const statement *s, const model_state *state, value v, const char *what)
{
    if (!v.boolean && v.count == state->components) return true;
    char is[48] = "a condition", due[48] = "a number";
    if (!v.boolean) snprintf(is, sizeof is, v.count ? "a vector of length %d" : "a number", v.count);
    if (state->components) snprintf(due, sizeof due, "a vector of length %d", state->components);
    source_complain(&m->source, MOTUS_SHAPE, s->value->at, "%s is %s, but %s is %s by its initial value", what, is,
                    state->name, due);
    if (v.count) source_hint(&m->source, "write %s(%g) = (…) for a vector", state->name, m->start);
    return false;
}

static bool equation(model *m, const statement *s, outputs *into)
{
    const model_state *state = symbols_find(m, s->name).state;
    lowering l;
    output o = {0};
    lower_start(&l, m, PLACE_EQUATION, "an equation");
    if (!lower_target(&l, s, &o)) return false;
    value v = lower_expression(&l, s->value);
    if (m->graph->too_large)
        source_complain(&m->source, MOTUS_LIMIT, s->at,
                        "the model's expressions are too large: more than %d operations", GRAPH_NODES_MAX);
    if (source_failed(&m->source) || !same_shape(m, s, state, v, "the right side")) return false;
    for (int k = 0; k < (v.count ? v.count : 1); k++) {
        o.value = v.item[k];
        if (graph_deps(m->graph, o.value) & DEP_A) {
            source_complain(&m->source, MOTUS_SHAPE, s->value->at,
                            "an equation cannot use a quantity that contains an acceleration");
            source_hint(&m->source, "solve the equations for the highest derivatives");
            return false;
        }
        o.to.array = (uint16_t)(m->block[BLOCK_A] + state->array + k);
        if (!add(m, into, &o)) return false;
    }
    return true;
}

/* A motion that is given as a function of time: its value goes into x (of a first-order variable into v), its
 * derivative into v. */
static bool given_motion(model *m, const statement *s, lower_place place, const char *what, outputs *into, bool *timed)
{
    const model_state *state = symbols_find(m, s->name).state;
    lowering l;
    output o = {0};
    lower_start(&l, m, place, what);
    if ((int)s->index_count != state->dims) { return hull_indices_wrong(m, state, s->at); }
    if (!lower_target(&l, s, &o)) return false;
    value v = lower_expression(&l, s->value);
    if (source_failed(&m->source) || !same_shape(m, s, state, v, what)) return false;
    for (int k = 0; k < (v.count ? v.count : 1); k++) {
        *timed |= (graph_deps(m->graph, v.item[k]) & DEP_TIME) != 0;
        o.value = v.item[k];
        o.to.array = (uint16_t)(m->block[state->order == 2 ? BLOCK_X : BLOCK_V] + state->array + k);
        if (!add(m, into, &o)) return false;
        if (state->order == 1) continue;
        o.value = graph_derivative(m->graph, v.item[k], graph_seed_time, NULL);
        o.to.array = (uint16_t)(m->block[BLOCK_V] + state->array + k);
        if (!add(m, into, &o)) return false;
    }
    return true;
}

static bool looked_at(model *m, model_definition *d)
{
    lowering l;
    output o = {0};
    const statement *s = d->statement;
    lower_start(&l, m, PLACE_QUANTITY, d->kind == DEFINED_INVARIANT ? "an invariant" : "a quantity");
    if (!lower_target(&l, s, &o)) return false;
    if (o.loops != o.to.dims) {
        source_complain(&m->source, MOTUS_SHAPE, s->at, "%s[…] needs an index that runs", d->name);
        return false;
    }
    d->progress = 1; /* needed now, it depends on itself */
    value v = lower_expression(&l, s->value);
    if (source_failed(&m->source)) return false;
    d->progress = 2;
    if (v.boolean) {
        source_complain(&m->source, MOTUS_SHAPE, s->value->at, "%s is a condition, not a number", d->name);
        source_hint(&m->source, "write if(condition, 1, 0)");
        return false;
    }
    int parts = v.count ? v.count : 1;
    d->components = v.count;
    d->dims = (uint8_t)o.loops;
    if (o.loops && !model_take_extent(m, d)) return false;
    size_t hull = 1;
    array shape = {.space = SPACE_OUT, .dims = o.loops};
    for (int k = o.loops - 1; k >= 0; k--) {
        shape.first[k] = d->first[k] = l.low[k];
        shape.last[k] = d->last[k] = l.high[k];
        shape.stride[k] = (int64_t)hull;
        hull *= (size_t)(l.high[k] - l.low[k] + 1);
    }
    d->numbers = hull * (size_t)parts;
    if (d->numbers > MODEL_NUMBERS_MAX) {
        source_complain(&m->source, MOTUS_LIMIT, s->at, "%s would have %zu numbers; at most %d fit", d->name,
                        d->numbers, MODEL_NUMBERS_MAX);
        return false;
    }
    d->outputs = arena_room(m->arena, (size_t)parts * sizeof *d->outputs);
    if (!d->outputs || !model_take_arrays(m, parts, &d->array)) return false;
    for (int k = 0; k < parts; k++) {
        shape.base = hull * (size_t)k;
        m->arrays[d->array + k] = shape;
        d->outputs[k] = o;
        d->outputs[k].value = v.item[k];
        d->outputs[k].to.array = (uint16_t)(d->array + k);
    }
    d->output_count = (size_t)parts;
    return true;
}

/* Complains where some cells have an exact line and others have none. */
static bool exact_complete(model *m)
{
    for (uint32_t i = 0; i < m->state_count; i++) {
        const model_state *s = &m->states[i];
        size_t cells = 0;
        const statement *line = NULL;
        for (uint32_t k = s->line; k; k = m->statements.item[k - 1].next)
            if (m->statements.item[k - 1].kind == STATEMENT_EXACT) line = &m->statements.item[k - 1];
        for (size_t k = 0; k < m->exact_count; k++) {
            const output *o = &m->exact[k];
            if (o->to.array != m->block[s->order == 2 ? BLOCK_X : BLOCK_V] + s->array) continue;
            size_t n = 1;
            for (int d = 0; d < o->loops; d++) {
                const range *r = &o->loop[d];
                n *= (size_t)(r->last.literal + (r->last.slot >= 0 ? m->ints[r->last.slot] : 0) - r->first.literal -
                              (r->first.slot >= 0 ? m->ints[r->first.slot] : 0) + 1);
            }
            cells += n;
        }
        if (cells == s->cells.count) continue;
        if (!line)
            source_complain(&m->source, MOTUS_NAME, s->at, "the exact motion of %s is missing: other states have one",
                            s->name);
        else
            source_complain(&m->source, MOTUS_NAME, line->at, "the exact motion of %s is given for %zu of %zu places",
                            s->name, cells, s->cells.count);
        return false;
    }
    return true;
}

bool equations_all(model *m)
{
    outputs accel = {&m->accel, &m->accel_count, 0}, boundary = {&m->boundary, &m->boundary_count, 0},
            exact = {&m->exact, &m->exact_count, 0};
    bool timed = false;
    for (uint32_t i = 0; i < m->statements.count; i++) {
        const statement *s = &m->statements.item[i];
        bool ok = true;
        if (s->kind == STATEMENT_EQUATION)
            ok = equation(m, s, &accel);
        else if (s->kind == STATEMENT_DEFINITION && s->index_count > 0 && symbols_find(m, s->name).state)
            ok = given_motion(m, s, PLACE_BOUNDARY, "a boundary line", &boundary, &m->driven);
        else if (s->kind == STATEMENT_EXACT)
            ok = given_motion(m, s, PLACE_EXACT, "an exact motion", &exact, &timed);
        if (!ok) return false;
    }
    for (uint32_t i = 0; i < m->definition_count; i++)
        if (m->definitions[i].kind != DEFINED_PARAMETER && !looked_at(m, &m->definitions[i])) return false;
    if (m->exact_count > 0) {
        m->exact_given = true;
        if (!exact_complete(m)) return false;
    }
    double *base[SPACES] = {[SPACE_X] = m->x0, [SPACE_V] = m->v0};
    return m->boundary_count == 0 || evaluate_outputs(m, m->boundary, m->boundary_count, m->start, base);
}
