/* Tiles: the memory layout of a model of neighbours. See tiles.h. */
#include "machine/tiles.h"

enum { LINE = 8 }; /* numbers in a cache line: windows of a chain begin and end at multiples of it */

static whole up_to(whole k, whole unit) { return (k + unit - 1) / unit * unit; }

/* Writes the ranges of fixed cells; `to` NULL: counts them. */
static size_t list_fixed(const model *m, size_t *to)
{
    size_t count = 0, end = SIZE_MAX;
    for (int order = 2; order >= 1; order--)
        for (uint32_t i = 0; i < m->state_count; i++) {
            const model_state *s = &m->states[i];
            const size_t components = s->components ? (size_t)s->components : 1;
            for (size_t k = 0; s->order == order && s->owner && k < components * s->hull; k++) {
                if (s->owner[k % s->hull] == 1) continue;
                const size_t place = s->base + k;
                if (place != end && to) to[2 * count] = place;
                count += place != end;
                end = place + 1;
                if (to) to[2 * count - 1] = end;
            }
        }
    return count;
}

const tiling *tiles_create(const model *m, const locality *l)
{
    size_t parts = 0;
    for (uint32_t i = 0; i < m->state_count; i++)
        parts += m->states[i].components ? (size_t)m->states[i].components : 1;
    tiling *t = arena_room(m->arena, sizeof *t);
    tiling_part *part = arena_room(m->arena, (parts + 1) * sizeof *part);
    const size_t count = list_fixed(m, NULL);
    size_t *fixed = arena_room(m->arena, (2 * count + 1) * sizeof *fixed);
    if (!t || !part || !fixed) return NULL;
    list_fixed(m, fixed);
    *t = (tiling){
        .part = part, .fixed = fixed, .fixed_count = count, .first = INT64_MAX, .last = INT64_MIN, .reach = l->reach};
    for (int order = 2; order >= 1; order--)
        for (uint32_t i = 0; i < m->state_count; i++) {
            const model_state *s = &m->states[i];
            if (s->order != order) continue;
            const size_t cells = (size_t)(s->last[0] - s->first[0] + 1);
            for (size_t c = 0; c < (s->components ? (size_t)s->components : 1); c++) {
                part[t->parts] = (tiling_part){
                    .base = s->base + c * s->hull, .stride = s->hull / cells, .cells = cells, .first = s->first[0]};
                t->numbers += part[t->parts].stride;
                t->parts++;
            }
            if (order == 2) t->positions = t->parts;
            t->first = s->first[0] < t->first ? s->first[0] : t->first;
            t->last = s->last[0] > t->last ? s->last[0] : t->last;
        }
    const bool chain = t->numbers == (size_t)t->parts;
    t->around = chain ? up_to(t->reach, LINE / 2) : t->reach;
    t->pass = chain ? up_to(t->reach, LINE) : t->reach;
    return t;
}
