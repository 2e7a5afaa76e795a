/* Lays the states out in x and v, and makes the five blocks of arrays over them (model.h). */
#include "lang/read/read_steps.h"

/* Makes the list of variables in the order of x and v, and the start. */
bool layout_finish(model *m)
{
    const uint32_t states = m->state_count + m->mode_count;
    uint32_t count = 0;
    m->variables = arena_room(m->arena, (states + 1) * sizeof *m->variables);
    if (!m->variables) return false;
    for (int order = 2; order >= 1; order--)
        for (uint32_t i = 0; i < states; i++)
            if (m->states[i].order == order) m->variables[count++] = m->states[i].base;
    m->variables[count] = m->nv;
    m->x0 = arena_room(m->arena, (m->nx + 1) * sizeof *m->x0);
    m->v0 = arena_room(m->arena, (m->nv + 1) * sizeof *m->v0);
    if (!m->x0 || !m->v0) return false;
    model_start_state(m);
    return true;
}

bool layout_all(model *m)
{
    size_t total = 0;
    uint32_t parts = 0;
    const uint32_t states = m->state_count + m->mode_count;
    for (int order = 2; order >= 1; order--) {
        for (uint32_t i = 0; i < states; i++) {
            model_state *s = &m->states[i];
            if (s->order != order) continue;
            s->base = total;
            s->array = (uint16_t)parts;
            total += model_numbers(s);
            parts += (uint32_t)(s->components ? s->components : 1);
            if (total > MODEL_NUMBERS_MAX) {
                source_complain(&m->source, MOTUS_LIMIT, &s->at, "the states have more than the %d numbers that fit",
                                MODEL_NUMBERS_MAX);
                return false;
            }
            if (parts > UINT16_MAX / 8) {
                source_complain(&m->source, MOTUS_LIMIT, &s->at, "more than %d variables and components",
                                UINT16_MAX / 8);
                source_hint(&m->source, "a family, x[i]'' = … for i = 1..N, is one variable however large N is");
                return false;
            }
        }
        if (order == 2) m->nx = total;
        if (order == 2 && m->mode_count) m->modes = total - m->states[m->state_count].base;
    }
    m->nv = total;
    m->block_size = (uint16_t)parts;
    static const space spaces[5] = {SPACE_X, SPACE_V, SPACE_A, SPACE_DX, SPACE_DV};
    for (int b = 0; b < 5; b++) {
        if (!model_take_arrays(m, (int)parts, &m->block[b])) return false;
        for (uint32_t i = 0; i < states; i++) {
            const model_state *s = &m->states[i];
            for (int k = 0; k < (s->components ? s->components : 1); k++) {
                graph_shape(m->arena, &m->arrays[m->block[b] + s->array + k], spaces[b], s->base + (size_t)k * s->hull,
                            s->dims, s->first, s->last);
                m->arrays[m->block[b] + s->array + k].mode = b == BLOCK_X && i >= m->state_count;
                m->array_owner[m->block[b] + s->array + k] = 2 * i + 2;
            }
        }
    }
    return layout_finish(m);
}
