/* Room for a model's numbers and arrays, which move when they grow, so code that reads a model keeps no pointer into
 * them; and the depth of its expressions. */
#include "lang/model/model.h"
#include "lang/model/switches.h"

#include <string.h>

bool model_take_numbers(model *m, size_t count, size_t *first)
{
    if (m->pool_count + count > m->pool_capacity) {
        size_t room = m->pool_capacity + m->pool_capacity / 2 + count + 64;
        double *more = arena_grow(m->arena, m->pool, m->pool_capacity * sizeof *more, room * sizeof *more);
        if (!more) return false;
        memset(more + m->pool_capacity, 0, (room - m->pool_capacity) * sizeof *more);
        m->pool = more;
        m->pool_capacity = room;
    }
    *first = m->pool_count;
    m->pool_count += count;
    return true;
}

bool model_reserve_arrays(model *m, uint32_t room)
{
    array *more = arena_grow(m->arena, m->arrays, m->array_capacity * sizeof *more, room * sizeof *more);
    uint32_t *owner = arena_grow(m->arena, m->array_owner, m->array_capacity * sizeof *owner, room * sizeof *owner);
    if (!more || !owner) return false;
    m->array_owner = owner;
    m->arrays = more;
    m->array_capacity = room;
    return true;
}

bool model_take_arrays(model *m, int count, uint16_t *first)
{
    uint32_t need = m->array_count + (uint32_t)count;
    if (need > UINT16_MAX) {
        source_complain(&m->source, MOTUS_LIMIT, &(span){0, 0, 0}, "the model has more than %d arrays", UINT16_MAX);
        return false;
    }
    if (need > m->array_capacity && !model_reserve_arrays(m, need + 64 + m->array_capacity / 2)) return false;
    *first = (uint16_t)m->array_count;
    memset(&m->arrays[m->array_count], 0, (size_t)count * sizeof *m->arrays);
    memset(&m->array_owner[m->array_count], 0, (size_t)count * sizeof *m->array_owner);
    m->array_count = need;
    m->graph->arrays = m->arrays;
    return true;
}

bool model_take_extent(model *m, model_definition *d)
{
    if (d->first != m->no_extent) return true;
    int64_t *both = arena_room(m->arena, 2 * MAX_DIMS * sizeof *both);
    if (!both) return false;
    d->first = both;
    d->last = both + MAX_DIMS;
    return true;
}

bool model_deeper(model *m, const span *at)
{
    if (m->depth++ < MODEL_DEPTH_MAX) return true;
    source_complain(&m->source, MOTUS_LIMIT, at, "brackets and definitions are nested more than %d deep",
                    MODEL_DEPTH_MAX);
    source_hint(&m->source, "use fewer nested brackets or definitions");
    return false;
}

void model_start_sides(model *m)
{
    for (size_t k = 0; m->located && k < m->located->count; k++)
        if (m->located->op[k] == OP_FIND) m->x0[m->located->slot + k] = 1;
}

void model_start_state(model *m)
{
    for (uint32_t i = 0; i < m->state_count + m->mode_count; i++) {
        const model_state *s = &m->states[i];
        const size_t n = model_numbers(s);
        const double *first = m->pool + m->arrays[s->start_array[0]].base;
        if (s->order == 2) {
            memcpy(m->x0 + s->base, first, n * sizeof *first);
            memcpy(m->v0 + s->base, m->pool + m->arrays[s->start_array[1]].base, n * sizeof *first);
        } else {
            memcpy(m->v0 + s->base, first, n * sizeof *first);
        }
    }
    model_start_sides(m);
}
