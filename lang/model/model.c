/* The names of a model's numbers, and its nodes as text with these names. */
#include "lang/model/model.h"

#include "lang/model/table.h"

#include <stdio.h>

/* Writes ".y" or "[5]". */
static void name_component(int components, int k, char *out, size_t size)
{
    if (components <= 3)
        snprintf(out, size, ".%c", "xyz"[k]);
    else
        snprintf(out, size, "[%d]", k + 1);
}

/* Writes "r[3,4]'.y"; component -1: the name of the whole vector, without ".y". */
void model_state_name(const model_state *s, size_t cell, int component, bool prime, char *out, size_t size)
{
    size_t n = (size_t)snprintf(out, size, "%s", s->name);
    int64_t at[MAX_DIMS];
    for (int d = s->dims - 1; d >= 0; d--) {
        size_t extent = (size_t)(s->last[d] - s->first[d] + 1);
        at[d] = s->first[d] + (int64_t)(cell % extent);
        cell /= extent;
    }
    for (int d = 0; d < s->dims && n < size; d++)
        n += (size_t)snprintf(out + n, size - n, "%s%lld%s", d ? "," : "[", (long long)at[d],
                              d == s->dims - 1 ? "]" : "");
    if (prime && n < size) n += (size_t)snprintf(out + n, size - n, "'");
    if (s->components && component >= 0 && n < size) name_component(s->components, component, out + n, size - n);
}

void model_name(const model *m, bool in_v, size_t k, char *out, size_t size)
{
    snprintf(out, size, "?");
    for (uint32_t i = 0; i < m->state_count + m->mode_count; i++) {
        const model_state *s = &m->states[i];
        size_t n = model_numbers(s);
        if ((!in_v && s->order == 1) || k < s->base || k >= s->base + n) continue;
        model_state_name(s, (k - s->base) % s->hull, (int)((k - s->base) / s->hull), in_v && s->order == 2, out, size);
        return;
    }
}

node model_seed_motion(graph *g, node leaf, void *of)
{
    const model *m = of;
    if (graph_at(g, leaf)->op == OP_TIME) return graph_const(g, 1);
    graph_shift shift = {m->block_size, m->block_size};
    return graph_seed_direction(g, leaf, &shift);
}

/* Text of nodes
 * ----------------------------------------------------------------------------------------------------- */

static size_t name_index(const model *m, const subscript *s, char *out, size_t size)
{
    static const char letters[MAX_LEVELS + 1] = "ijklpqrs";
    size_t n = 0;
    if (s->modulus >= 0) n += (size_t)snprintf(out + n, size - n, "mod(");
    int64_t shift = s->literal + (s->slot >= 0 ? m->ints[s->slot] : 0);
    if (s->level >= 0) n += (size_t)snprintf(out + n, size - n, "%c", letters[s->level]);
    if (s->level < 0)
        n += (size_t)snprintf(out + n, size - n, "%lld", (long long)shift);
    else if (shift)
        n += (size_t)snprintf(out + n, size - n, "%+lld", (long long)shift);
    if (s->modulus >= 0) n += (size_t)snprintf(out + n, size - n, ", %lld)+1", (long long)m->ints[s->modulus]);
    return n;
}

static void name_parameter(const model *m, uint32_t slot, char *out, size_t size)
{
    const uint32_t owner = slot < m->scalar_slots ? m->slot_owner[slot] : 0;
    const model_definition *d = owner ? &m->definitions[owner - 1] : NULL;
    const size_t n = (size_t)snprintf(out, size, "%s", d ? d->name : "?");
    if (d && d->components && n < size) name_component(d->components, (int)(slot - d->slot), out + n, size - n);
}

const model_state *model_state_of(const model *m, uint16_t array)
{
    const uint32_t owner = m->array_owner[array];
    return owner && owner % 2 == 0 ? &m->states[owner / 2 - 1] : NULL;
}

void model_reference_name(const model *m, const reference *r, char *out, size_t size)
{
    const char *name = "?", *primes = "", *tail = "";
    int component = -1, components = 0;
    const uint32_t owner = m->array_owner[r->array];
    const model_state *s = model_state_of(m, r->array);
    if (s) {
        int parts = s->components ? s->components : 1;
        for (int b = 0; b < 3; b++) {
            int k = (int)r->array - (m->block[b] + s->array);
            if (k < 0 || k >= parts) continue;
            if (r->array >= m->block[b] + m->block_size && !m->arrays[r->array].mode) continue;
            name = s->name;
            component = k;
            components = s->components;
            int count = s->order == 2 ? b : b - 1;
            primes = count == 2 ? "''" : count == 1 ? "'" : "";
        }
        for (int d = 0; d < s->order; d++) {
            int k = (int)r->array - s->start_array[d];
            if (k < 0 || k >= parts) continue;
            name = s->name;
            component = k;
            components = s->components;
            primes = d ? "'" : "";
            tail = "(0)";
        }
    }
    if (owner && !s) {
        const model_definition *d = &m->definitions[(owner - 1) / 2];
        name = d->name;
        component = (int)r->array - d->array;
        components = d->components;
    }
    size_t n_ = (size_t)snprintf(out, size, "%s", name);
    for (int d = 0; d < r->dims && n_ + 40 < size; d++) {
        n_ += (size_t)snprintf(out + n_, size - n_, "%s", d ? "," : "[");
        n_ += name_index(m, &r->at[d], out + n_, size - n_);
        if (d == r->dims - 1) n_ += (size_t)snprintf(out + n_, size - n_, "]");
    }
    if (n_ < size) n_ += (size_t)snprintf(out + n_, size - n_, "%s%s", primes, tail);
    if (components && n_ < size) name_component(components, component, out + n_, size - n_);
}

static void name_table(const model *m, uint32_t array, char *out, size_t size)
{
    for (uint32_t k = 0; k < m->table_count; k++)
        if (m->tables[k]->array == array) snprintf(out, size, "%s", m->tables[k]->name);
}

static void name_leaf(void *model_, const graph_node *n, char *out, size_t size)
{
    const model *m = model_;
    out[0] = 0;
    if (n->op == OP_PARAM)
        name_parameter(m, n->a, out, size);
    else if (n->op == OP_INDEX && n->level == MAX_LEVELS)
        snprintf(out, size, "%lld", (long long)m->ints[n->a]);
    else if (n->op == OP_TABLE)
        name_table(m, n->a, out, size);
    else if (n->op == OP_TIME)
        snprintf(out, size, "%s", m->time);
    else if (n->op == OP_LOAD)
        model_reference_name(m, &m->graph->references[n->a], out, size);
}

void model_print(const model *m, node n, char *out, size_t size)
{
    graph_print(m->graph, n, name_leaf, (void *)m, out, size);
}

bool model_equation(const model *m, size_t k, char *out, size_t size)
{
    if (k >= m->accel_count) return false;
    const output *o = &m->accel[k];
    char left[MOTUS_NAME_MAX + 96];
    model_reference_name(m, &o->to, left, sizeof left);
    size_t n = (size_t)snprintf(out, size, "%s = ", left);
    if (n < size) model_print(m, o->value, out + n, size - n);
    return true;
}
