/* What may be set: the parameters and the initial values of a model, as a page needs them for its sliders.
 *
 * Invariant: asking changes nothing, and numbers come in the order of columns: cell by cell, component by component.
 */
#include "api/system.h"

#include "lang/vary.h"

#include <stdio.h>
#include <string.h>

static size_t parts_of(int components) { return components ? (size_t)components : 1; }

/* ---- parameters ---- */

static const model_definition *parameter(const motus_system *s, size_t k)
{
    for (uint32_t i = 0; s && s->model && i < s->model->definition_count; i++)
        if (s->model->definitions[i].kind == DEFINED_PARAMETER && k-- == 0)
            return &s->model->definitions[i];
    return NULL;
}

size_t motus_parameter_count(const motus_system *s)
{
    size_t n = 0;
    for (uint32_t i = 0; s && s->model && i < s->model->definition_count; i++)
        n += s->model->definitions[i].kind == DEFINED_PARAMETER;
    return n;
}

static size_t cells_of(const model_definition *d)
{
    size_t cells = 1;
    for (int i = 0; i < d->dims; i++)
        cells *= (size_t)(d->last[i] - d->first[i] + 1);
    return cells;
}

/* Its first number in the pool; the others follow, component after component. */
static size_t place_of(const motus_system *s, const model_definition *d) { return d->list ? s->model->arrays[d->array].base : d->slot; }

motus_status motus_parameter_at(const motus_system *s, size_t k, motus_parameter *out)
{
    const model_definition *d = parameter(s, k);
    if (!d || !out || motus_struct_check(MOTUS_DEF_PARAMETER, out, NULL) != MOTUS_OK)
        return MOTUS_ARGUMENT;
    motus_parameter p = {.name = d->name, .components = d->components, .list = d->list, .dimensions = d->dims,
                             .count = cells_of(d) * parts_of(d->components)};
    memcpy(p.first, d->first, sizeof p.first);
    memcpy(p.last, d->last, sizeof p.last);
    const span at = d->statement->value_at;
    p.text = s->model->source.texts[at.text].bytes + at.from;
    p.length = at.to - at.from;
    if (!vary_decides(s->model, place_of(s, d), p.count, &s->allocator, &p.decides))
        p.decides = "unknown";
    motus_struct_write(MOTUS_DEF_PARAMETER, &p, out);
    return MOTUS_OK;
}

motus_status motus_parameter_values(const motus_system *s, size_t k, double *out)
{
    const model_definition *d = parameter(s, k);
    if (!d || !out)
        return MOTUS_ARGUMENT;
    const double *pool = s->model->pool + place_of(s, d);
    const size_t cells = cells_of(d), parts = parts_of(d->components);
    for (size_t c = 0; c < cells; c++)
        for (size_t i = 0; i < parts; i++)
            *out++ = pool[i * cells + c];
    return MOTUS_OK;
}

/* ---- initial values ---- */

static const model_state *initial(const motus_system *s, size_t k, uint32_t *variable, bool *velocity)
{
    for (uint32_t i = 0; s && i < s->state_count; i++)
        for (int primes = 0; primes < s->states[i].order; primes++)
            if (k-- == 0) {
                *variable = i;
                *velocity = primes == 1;
                return &s->states[i];
            }
    return NULL;
}

size_t motus_initial_count(const motus_system *s)
{
    size_t n = 0;
    for (uint32_t i = 0; s && i < s->state_count; i++)
        n += (size_t)s->states[i].order;
    return n;
}

motus_status motus_initial_at(const motus_system *s, size_t k, motus_initial *out)
{
    uint32_t variable;
    bool velocity;
    const model_state *st = initial(s, k, &variable, &velocity);
    if (!st || !out || motus_struct_check(MOTUS_DEF_INITIAL, out, NULL) != MOTUS_OK)
        return MOTUS_ARGUMENT;
    char at[DECIMAL_MAX];
    motus_initial i = {.variable = variable, .is_velocity = velocity, .count = st->cells.count * parts_of(st->components)};
    snprintf(i.name, sizeof i.name, "%s%s(%s)", st->name, velocity ? "'" : "", decimal(s->start, at));
    motus_struct_write(MOTUS_DEF_INITIAL, &i, out);
    return MOTUS_OK;
}

motus_status motus_initial_values(const motus_system *s, size_t k, double *out)
{
    uint32_t variable;
    bool velocity;
    const model_state *st = initial(s, k, &variable, &velocity);
    if (!st || !out)
        return MOTUS_ARGUMENT;
    const double *from = st->order == 2 && !velocity ? s->x0 : s->v0;
    for (size_t c = 0; c < st->cells.count; c++)
        for (size_t i = 0; i < parts_of(st->components); i++)
            *out++ = from[system_place(st, c, (int)i)];
    return MOTUS_OK;
}
