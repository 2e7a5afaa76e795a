/* Lowers equations, boundary lines, quantities, invariants and exact motions to outputs over the graph. */
#include "lang/read/read_steps.h"

#include "lang/lower/hull.h"
#include "lang/lower/lower_ghost.h"
#include "lang/model/evaluate.h"
#include "lang/model/symbols.h"

#include <math.h>

typedef struct outputs {
    output **item;
    size_t *count, room, least; /* least: the room at first */
} outputs;

static bool add(model *m, outputs *o, const output *one)
{
    if (*o->count == o->room) {
        size_t room = o->room ? 2 * o->room : o->least;
        output *more = arena_replace(m->arena, *o->item, o->room * sizeof *more, room * sizeof *more);
        if (!more) return false;
        *o->item = more;
        o->room = room;
    }
    (*o->item)[(*o->count)++] = *one;
    return true;
}

static bool divide(model *m, const statement *s, const model_state *state, const lowering *of, const output *o,
                   const model_cut *cut, outputs *into);

/* Lowers the part of an equation, or of a boundary line that depends on a state, that the ranges of its indices leave.
 * into NULL: only checks it. */
static bool part(model *m, const statement *s, const model_state *state, const lowering *of, output o, outputs *into)
{
    lowering l = *of;
    model_cut cut;
    value v = lower_numbers(&l, s->value);
    if (lower_cut(m, 0, o.loops, &cut)) return divide(m, s, state, of, &o, &cut, into);
    if (m->graph->too_large)
        source_complain(&m->source, MOTUS_LIMIT, &s->at,
                        "the model's expressions are too large: more than %d operations", GRAPH_NODES_MAX);
    if (source_failed(&m->source) || !lower_fits(m, s, state, v, into ? "the right side" : "a boundary line"))
        return false;
    for (int k = 0; into && k < (v.count ? v.count : 1); k++) {
        o.value = v.item[k];
        if (graph_at(m->graph, o.value)->op == OP_CONST && !isfinite(graph_at(m->graph, o.value)->value)) {
            source_complain(&m->source, MOTUS_ARGUMENT, &s->value->at, "the right side of this equation is %s, always",
                            isnan(graph_at(m->graph, o.value)->value) ? "not a number" : "infinite");
            source_hint(&m->source, "look for a division by 0, or a root or logarithm of a negative number");
            return false;
        }
        o.to.array = (uint16_t)(m->block[BLOCK_A] + state->array + k);
        if (!add(m, into, &o)) return false;
    }
    return true;
}

/* Lowers the parts before and after a cut, since some cells read cells whose boundary line depends on a state. */
static bool divide(model *m, const statement *s, const model_state *state, const lowering *of, const output *o,
                   const model_cut *cut, outputs *into)
{
    for (int after = 0; after < 2; after++) {
        lowering l = *of;
        output one = *o;
        lower_narrow(&l, &one, cut->level, after ? cut->at : of->low[cut->level],
                     after ? of->high[cut->level] : cut->at - 1);
        if (!part(m, s, state, &l, one, into)) return false;
    }
    return true;
}

static bool equation(model *m, const statement *s, outputs *into)
{
    const model_state *state = symbols_find(m, s->name).state;
    lowering l;
    output o = {0};
    lower_start(&l, m, PLACE_EQUATION, into ? "an equation" : "a boundary line");
    const lower_rates here = {s, NULL};
    l.rates = &here;
    return lower_target(&l, s, &o) && part(m, s, state, &l, o, into);
}

/* Lowers a motion that is given as a function of time: its value goes into x (of a first-order variable into v), its
 * derivative into v. */
static bool given_motion(model *m, const statement *s, lower_place place, const char *what, outputs *into, bool *timed)
{
    const model_state *state = symbols_find(m, s->name).state;
    lowering l;
    output o = {0};
    lower_start(&l, m, place, what);
    if ((int)s->index_count != state->dims) { return hull_indices_wrong(m, state, s->at); }
    if (!lower_target(&l, s, &o)) return false;
    value v = lower_numbers(&l, s->value);
    if (source_failed(&m->source) || !lower_fits(m, s, state, v, what)) return false;
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

/* Lowers the values of a quantity: an output for each component of each part. Their arrays follow when the shape is
 * known. */
static bool values(model *m, const model_definition *d, const lowering *of, output o, outputs *into, int *components)
{
    const statement *s = d->statement;
    lowering l = *of;
    model_cut cut;
    value v = lower_numbers(&l, s->value);
    if (lower_cut(m, 0, o.loops, &cut)) {
        for (int after = 0; after < 2; after++) {
            output one = o;
            l = *of;
            lower_narrow(&l, &one, cut.level, after ? cut.at : of->low[cut.level],
                         after ? of->high[cut.level] : cut.at - 1);
            if (!values(m, d, &l, one, into, components)) return false;
        }
        return true;
    }
    if (source_failed(&m->source)) return false;
    *components = v.count;
    for (int k = 0; k < (v.count ? v.count : 1); k++) {
        o.value = v.item[k];
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
        source_complain(&m->source, MOTUS_SHAPE, &s->at, "%s[…] needs an index with a range", d->name);
        return false;
    }
    outputs into = {&d->outputs, &d->output_count, 0, 1};
    d->progress = 1; /* if it is needed now, it depends on itself */
    if (!values(m, d, &l, o, &into, &d->components)) return false;
    d->progress = 2;
    const int parts = d->components ? d->components : 1;
    d->dims = (uint8_t)o.loops;
    if (o.loops && !model_take_extent(m, d)) return false;
    for (int k = 0; k < o.loops; k++) {
        d->first[k] = l.low[k];
        d->last[k] = l.high[k];
    }
    array shape;
    const size_t hull = graph_shape(m->arena, &shape, SPACE_OUT, 0, o.loops, d->first, d->last);
    d->numbers = hull * (size_t)parts;
    if (d->numbers > MODEL_NUMBERS_MAX) {
        source_complain(&m->source, MOTUS_LIMIT, &s->at, "%s would have %zu numbers; at most %d fit", d->name,
                        d->numbers, MODEL_NUMBERS_MAX);
        return false;
    }
    if (!model_take_arrays(m, parts, &d->array)) return false;
    for (int k = 0; k < parts; k++) {
        shape.base = hull * (size_t)k;
        m->arrays[d->array + k] = shape;
    }
    for (size_t k = 0; k < d->output_count; k++) d->outputs[k].to.array = (uint16_t)(d->array + k % (size_t)parts);
    return true;
}

/* Complains if some cells have an exact line and others have none. */
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
            source_complain(&m->source, MOTUS_NAME, &s->at, "the exact motion of %s is missing: other states have one",
                            s->name);
        else
            source_complain(&m->source, MOTUS_NAME, &line->at, "the exact motion of %s is given for %zu of %zu places",
                            s->name, cells, s->cells.count);
        return false;
    }
    return true;
}

bool equations_all(model *m)
{
    outputs accel = {&m->accel, &m->accel_count, 0, 16}, boundary = {&m->boundary, &m->boundary_count, 0, 16},
            exact = {&m->exact, &m->exact_count, 0, 16};
    bool timed = false;
    for (uint32_t i = 0; i < m->statements.count; i++) {
        const statement *s = &m->statements.item[i];
        bool ok = true;
        if (s->kind == STATEMENT_EQUATION)
            ok = equation(m, s, &accel);
        else if (s->kind == STATEMENT_DEFINITION && s->index_count > 0 && symbols_find(m, s->name).state)
            ok = lower_is_ghost(m, s) ? equation(m, s, NULL)
                                      : given_motion(m, s, PLACE_BOUNDARY, "a boundary line", &boundary, &m->driven);
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
    return true;
}

bool equations_start(model *m)
{
    double *base[SPACES] = {[SPACE_X] = m->x0, [SPACE_V] = m->v0};
    return m->boundary_count == 0 || evaluate_outputs(m, m->boundary, m->boundary_count, m->start, base);
}
