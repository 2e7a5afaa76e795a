/* Modes: parameters that events assign (model.h). A mode is a position after all others; its line gives its start, in
 * the numbers of the pool that it has as a parameter. */
#include "lang/read/read_steps.h"

#include "lang/model/symbols.h"

#include <string.h>

static model_definition *assigned(const model *m, const action *a)
{
    const tree *t = a->target;
    while (t && t->kind == TREE_COMPONENT) t = t->item[0];
    return t && t->kind == TREE_NAME ? symbols_find(m, t->name).definition : NULL;
}

const span *mode_assigned_at(const model *m, const model_definition *d)
{
    for (uint32_t i = 0; i < m->rule_count; i++)
        for (const action *a = m->rules[i].statement->when->actions; a; a = a->next)
            if (assigned(m, a) == d) return &a->target->at;
    return &d->statement->name_at;
}

bool mode_find_all(model *m)
{
    model_definition *d;
    uint32_t count = 0;
    for (uint32_t i = 0; i < m->rule_count; i++)
        for (const action *a = m->rules[i].statement->when->actions; a; a = a->next)
            if ((d = assigned(m, a)) && d->kind != DEFINED_INVARIANT && !d->mode) d->mode = m->state_count + ++count;
    if (!count) return true;
    model_state *all = arena_room(m->arena, (m->state_count + count) * sizeof *all);
    if (!all) return false;
    memcpy(all, m->states, m->state_count * sizeof *all);
    m->states = all;
    m->mode_count = count;
    for (uint32_t i = 0; i < m->definition_count; i++) {
        d = &m->definitions[i];
        if (d->mode) m->states[d->mode - 1] = (model_state){.name = d->name, .at = d->statement->name_at, .order = 2};
    }
    return true;
}

static void take_shape(model_state *s, int dims, const int64_t *first, const int64_t *last)
{
    s->dims = dims;
    s->hull = 1;
    for (int d = 0; d < dims; d++) {
        s->first[d] = s->eq_first[d] = first[d];
        s->last[d] = s->eq_last[d] = last[d];
        s->hull *= (size_t)(last[d] - first[d] + 1);
    }
    s->cells.count = s->hull;
}

bool mode_add_sides(model *m, const read_how *how)
{
    const uint32_t before = m->state_count + m->mode_count;
    if (!how->side_count) return true;
    model_state *all = arena_room(m->arena, (before + how->side_count) * sizeof *all);
    if (!all) return false;
    memcpy(all, m->states, before * sizeof *all);
    m->states = all;
    for (uint32_t k = 0; k < how->side_count; k++) {
        const model_shape *from = &how->sides[k];
        all[before + k] = (model_state){.name = "side", .order = 2};
        take_shape(&all[before + k], from->dims, from->first, from->last);
    }
    m->mode_count += how->side_count;
    m->side_first = before;
    m->side_count = how->side_count;
    return true;
}

/* Makes arrays over the numbers of a parameter, the start of its mode, and over zeros; d NULL: a side, which starts at
 * 0. */
static bool place_starts(model *m, model_state *s, const model_definition *d)
{
    const int parts = s->components ? s->components : 1;
    size_t zeros;
    s->shaped = s->start_done = true;
    if (!model_take_numbers(m, s->hull * (size_t)parts, &zeros) || !model_take_arrays(m, parts, &s->start_array[0]) ||
        !model_take_arrays(m, parts, &s->start_array[1]))
        return false;
    const size_t base = !d ? zeros : d->list ? m->arrays[d->array].base : d->slot;
    for (int k = 0; k < parts; k++) {
        const size_t at = (size_t)k * s->hull;
        for (int of = 0; of < 2; of++) {
            const uint16_t array = (uint16_t)(s->start_array[of] + k);
            graph_shape(m->arena, &m->arrays[array], SPACE_POOL, (of ? zeros : base) + at, s->dims, s->first, s->last);
            m->array_owner[array] = 2 * (uint32_t)(s - m->states) + 2;
        }
    }
    return true;
}

bool mode_shape_all(model *m)
{
    for (uint32_t i = 0; i < m->definition_count; i++) {
        const model_definition *d = &m->definitions[i];
        if (!d->mode) continue;
        model_state *s = &m->states[d->mode - 1];
        s->components = d->components;
        take_shape(s, d->dims, d->first, d->last);
        if (!place_starts(m, s, d)) return false;
    }
    for (uint32_t k = 0; k < m->side_count; k++)
        if (!place_starts(m, &m->states[m->side_first + k], NULL)) return false;
    return true;
}

/* Makes of every mode a quantity, for those who observe the motion. */
bool mode_observe_all(model *m)
{
    for (uint32_t i = 0; i < m->definition_count; i++) {
        model_definition *d = &m->definitions[i];
        if (!d->mode) continue;
        const model_state *s = &m->states[d->mode - 1];
        const int parts = d->components ? d->components : 1;
        uint16_t out;
        d->outputs = arena_take(m->arena, (size_t)parts * sizeof *d->outputs);
        if (!d->outputs || !model_take_arrays(m, parts, &out)) return false;
        d->output_count = (size_t)parts;
        d->numbers = s->hull * (size_t)parts;
        output o = {.loops = d->dims};
        o.to.dims = d->dims;
        for (int k = 0; k < d->dims; k++) {
            const subscript none = {.level = -1, .slot = -1, .modulus = -1};
            o.loop[k] = (range){none, none};
            o.loop[k].first.literal = (int32_t)d->first[k];
            o.loop[k].last.literal = (int32_t)d->last[k];
            o.to.at[k] = none;
            o.to.at[k].level = (int8_t)k;
        }
        for (int k = 0; k < parts; k++) {
            reference from = o.to;
            from.array = (uint16_t)(m->block[BLOCK_X] + s->array + k);
            graph_shape(m->arena, &m->arrays[out + k], SPACE_OUT, (size_t)k * s->hull, d->dims, d->first, d->last);
            o.to.array = (uint16_t)(out + k);
            o.value = graph_load(m->graph, &from);
            d->outputs[k] = o;
        }
    }
    return true;
}
