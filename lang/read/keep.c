/* What events keep (lang/model/kept.h), after all calls are known: each number becomes a mode, after all others, and
 * an assignment of its event. */
#include "lang/read/read_steps.h"

#include <stdio.h>
#include <string.h>

static int parts_of(const model_keep *k) { return k->components ? k->components : 1; }

/* Returns the mode that counts the events of a rule; a rule that keeps anything has one. */
static const model_keep *counter_of(const model *m, uint32_t rule)
{
    const model_keep *k = m->keeps;
    while (k->rule != rule || k->which != KEEP_COUNT) k = k->next;
    return k;
}

static node load(graph *g, const model_keep *k, int component)
{
    return graph_load(g, &(reference){.array = (uint16_t)(k->array + component)});
}

static bool assign(model *m, const model_keep *k)
{
    graph *g = m->graph;
    const node count = load(g, counter_of(m, k->rule), 0);
    for (int i = 0; i < parts_of(k); i++) {
        model_assignment a = {.at = k->at, .kept = true, .to = {.array = (uint16_t)(k->array + i)}};
        const node its = graph_op(g, OP_EQ, count, graph_const(g, (double)(k->which - 1)), 0);
        a.value.value = k->which == KEEP_COUNT  ? graph_op(g, OP_ADD, count, graph_const(g, 1), 0)
                        : k->which == KEEP_LAST ? k->is[i]
                                                : graph_op(g, OP_SELECT, its, k->is[i], load(g, k, i));
        if (!when_add(m, &m->rules[k->rule], &a)) return false;
    }
    return true;
}

/* Returns "count(bounce)", "at(bounce, last, x')". */
static const char *name_of(model *m, const model_keep *k)
{
    char call[80], name[MOTUS_NAME_MAX + 16];
    if (k->which == KEEP_COUNT)
        snprintf(name, sizeof name, "count(%s)", m->rules[k->rule].name);
    else
        snprintf(name, sizeof name, "%s", source_excerpt(&m->source, &k->at, call, sizeof call));
    return arena_text(m->arena, name, strlen(name));
}

/* Makes a mode whose start is 0. */
static bool make_state(model *m, const model_keep *k, uint32_t number, size_t base)
{
    model_state *s = &m->states[number];
    *s = (model_state){.name = name_of(m, k),
                       .at = k->at,
                       .order = 2,
                       .components = k->components,
                       .hull = 1,
                       .cells = {.count = 1},
                       .base = base,
                       .array = (uint16_t)(k->array - m->block[BLOCK_X]),
                       .shaped = true,
                       .start_done = true};
    for (int of = 0; of < 2; of++) {
        size_t zeros;
        if (!model_take_numbers(m, (size_t)parts_of(k), &zeros) ||
            !model_take_arrays(m, parts_of(k), &s->start_array[of]))
            return false;
        for (int i = 0; i < parts_of(k); i++)
            graph_shape(m->arena, &m->arrays[s->start_array[of] + i], SPACE_POOL, zeros + (size_t)i, 0, NULL, NULL);
    }
    for (int i = 0; i < parts_of(k); i++) {
        m->arrays[k->array + i].base = base + (size_t)i;
        m->array_owner[k->array + i] = 2 * number + 2;
    }
    return !m->arena->failed;
}

/* Moves first-order variables after all positions, modes included. */
static void move_first_order(model *m, size_t by)
{
    for (uint32_t i = 0; i < m->state_count; i++) {
        model_state *s = &m->states[i];
        if (s->order == 2) continue;
        s->base += by;
        for (int b = 0; b < 5; b++)
            for (int k = 0; k < (s->components ? s->components : 1); k++)
                m->arrays[m->block[b] + s->array + k].base += by;
    }
}

static bool make_states(model *m)
{
    size_t numbers = 0;
    const uint32_t before = m->state_count + m->mode_count;
    model_state *states = arena_room(m->arena, (before + m->keep_count) * sizeof *states);
    if (!states) return false;
    memcpy(states, m->states, before * sizeof *states);
    m->states = states;
    for (const model_keep *k = m->keeps; k; k = k->next) {
        if (!make_state(m, k, m->state_count + m->mode_count, m->nx + numbers)) return false;
        numbers += (size_t)parts_of(k);
        m->mode_count++;
    }
    if (m->nv + numbers > MODEL_NUMBERS_MAX) {
        source_complain(&m->source, MOTUS_LIMIT, &m->keeps->at, "the states have more than the %d numbers that fit",
                        MODEL_NUMBERS_MAX);
        return false;
    }
    move_first_order(m, numbers);
    m->nx += numbers;
    m->nv += numbers;
    m->modes += numbers;
    return layout_finish(m);
}

bool keep_all(model *m)
{
    if (!m->keeps) return true;
    for (const model_keep *k = m->keeps; k; k = k->next)
        if (!assign(m, k)) return false;
    return !m->graph->too_large && make_states(m);
}
