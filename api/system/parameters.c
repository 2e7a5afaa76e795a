/* The numbers that may be set: the parameters and the initial values of a model.
 *
 * Invariant: the calls here change nothing. Numbers are in the order of columns: cell by cell, component by component.
 */
#include "api/system/parameters.h"

#include "api/system/columns.h"
#include "base/near.h"
#include "lang/model/vary.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- parameters ---- */

static const model_definition *parameter(const motus_system *s, size_t k)
{
    for (uint32_t i = 0; s && s->model && i < s->model->definition_count; i++)
        if (s->model->definitions[i].kind == DEFINED_PARAMETER && k-- == 0) return &s->model->definitions[i];
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
    for (int i = 0; i < d->dims; i++) cells *= (size_t)(d->last[i] - d->first[i] + 1);
    return cells;
}

/* Returns the place in the pool of a parameter's first number; the others follow, component by component. */
static size_t place_of(const motus_system *s, const model_definition *d)
{
    return d->list ? s->model->arrays[d->array].base : d->slot;
}

motus_status motus_parameter_at(const motus_system *s, size_t k, motus_parameter *out)
{
    const model_definition *d = parameter(s, k);
    if (!d || !out || motus_struct_check(MOTUS_DEF_PARAMETER, out, NULL) != MOTUS_OK) return MOTUS_ARGUMENT;
    motus_parameter p = {.name = d->name,
                         .components = d->components,
                         .list = d->list,
                         .dimensions = d->dims,
                         .count = cells_of(d) * columns_parts(d->components)};
    memcpy(p.first, d->first, sizeof p.first);
    memcpy(p.last, d->last, sizeof p.last);
    const span at = d->statement->value_at;
    p.text = s->model->source.texts[at.text].bytes + at.from;
    p.length = at.to - at.from;
    if (!vary_decides(s->model, place_of(s, d), p.count, &s->allocator, &p.decides)) p.decides = "unknown";
    motus_struct_write(MOTUS_DEF_PARAMETER, &p, out);
    return MOTUS_OK;
}

motus_status motus_parameter_values(const motus_system *s, size_t k, double *out)
{
    const model_definition *d = parameter(s, k);
    if (!d || !out) return MOTUS_ARGUMENT;
    const double *pool = s->model->pool + place_of(s, d);
    const size_t cells = cells_of(d), parts = columns_parts(d->components);
    for (size_t c = 0; c < cells; c++)
        for (size_t i = 0; i < parts; i++) *out++ = pool[i * cells + c];
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
    for (uint32_t i = 0; s && i < s->state_count; i++) n += (size_t)s->states[i].order;
    return n;
}

motus_status motus_initial_at(const motus_system *s, size_t k, motus_initial *out)
{
    uint32_t variable;
    bool velocity;
    const model_state *st = initial(s, k, &variable, &velocity);
    if (!st || !out || motus_struct_check(MOTUS_DEF_INITIAL, out, NULL) != MOTUS_OK) return MOTUS_ARGUMENT;
    char at[DECIMAL_MAX];
    motus_initial i = {.variable = variable,
                       .is_velocity = velocity,
                       .supposed = velocity && st->supposed,
                       .count = st->cells.count * columns_parts(st->components)};
    snprintf(i.name, sizeof i.name, "%s%s(%s)", st->name, velocity ? "'" : "", decimal(s->start, at));
    motus_struct_write(MOTUS_DEF_INITIAL, &i, out);
    return MOTUS_OK;
}

motus_status motus_initial_values(const motus_system *s, size_t k, double *out)
{
    uint32_t variable;
    bool velocity;
    const model_state *st = initial(s, k, &variable, &velocity);
    if (!st || !out) return MOTUS_ARGUMENT;
    const double *from = st->order == 2 && !velocity ? s->x0 : s->v0;
    for (size_t c = 0; c < st->cells.count; c++)
        for (size_t i = 0; i < columns_parts(st->components); i++) *out++ = from[system_place(st, c, (int)i)];
    return MOTUS_OK;
}

/* ---- by name ---- */

bool parameters_bracket(const char *name, char *bare, size_t size, double *start)
{
    const char *open = strrchr(name, '(');
    if (!open || (size_t)(open - name) >= size) return false;
    snprintf(bare, size, "%.*s", (int)(open - name), name);
    const bool minus = open[1] == '-';
    const char *digits = open + 1 + minus;
    const size_t n = decimal_read(digits, SIZE_MAX, start);
    if (!n || strcmp(digits + n, ")") || isinf(*start)) return false;
    if (minus) *start = -*start;
    return true;
}

static motus_status unknown(const motus_system *s, const char *name, motus_error *err)
{
    fail(err, MOTUS_NAME, "%s is neither a parameter nor an initial value of this system", name);
    char base[MOTUS_NAME_MAX], at[DECIMAL_MAX];
    snprintf(base, sizeof base, "%.*s", (int)strcspn(name, ".['("), name);
    for (uint32_t i = 0; i < s->definition_count; i++) {
        const model_definition *d = &s->definitions[i];
        if (!strcmp(d->name, base) && d->kind == DEFINED_PARAMETER)
            hint(err, "set all numbers of %s at once, by its name alone", base);
        else if (!strcmp(d->name, base))
            hint(err, "%s is a quantity: set the parameters that it depends on", base);
        else if (d->kind == DEFINED_PARAMETER && near_likely(base, d->name))
            hint(err, "did you mean %s?", d->name);
        else
            continue;
        return MOTUS_NAME;
    }
    for (uint32_t i = 0; i < s->state_count; i++)
        if (!strcmp(s->states[i].name, base))
            hint(err, "an initial value is named %s(%s), and all of its numbers are set at once", base,
                 decimal(s->start, at));
    return MOTUS_NAME;
}

static motus_status find_initial(const motus_system *s, const char *name, char *bare, double start,
                                 parameters_target *out, motus_error *err)
{
    const size_t length = strlen(bare);
    const bool velocity = length > 0 && bare[length - 1] == '\'';
    bare[length - velocity] = 0;
    for (uint32_t i = 0; start == s->start && i < s->state_count; i++) {
        const model_state *st = &s->states[i];
        if (strcmp(st->name, bare) || (velocity && st->order == 1)) continue;
        const size_t parts = columns_parts(st->components);
        *out = (parameters_target){.state = st, .velocity = velocity};
        out->count = st->cells.count * parts;
        out->span = st->hull * parts;
        if (s->model) out->first = s->model->arrays[st->start_array[velocity]].base;
        return MOTUS_OK;
    }
    return unknown(s, name, err);
}

motus_status parameters_find(const motus_system *s, const char *name, parameters_target *out, motus_error *err)
{
    char bare[2 * MOTUS_NAME_MAX];
    double start;
    if (parameters_bracket(name, bare, sizeof bare, &start)) return find_initial(s, name, bare, start, out, err);
    for (uint32_t i = 0; s->model && i < s->definition_count; i++) {
        const model_definition *d = &s->definitions[i];
        if (d->kind != DEFINED_PARAMETER || strcmp(d->name, name)) continue;
        *out = parameters_of(s, d);
        return MOTUS_OK;
    }
    return unknown(s, name, err);
}

parameters_target parameters_of(const motus_system *s, const model_definition *d)
{
    const size_t count = cells_of(d) * columns_parts(d->components);
    return (parameters_target){.definition = d, .count = count, .first = place_of(s, d), .span = count};
}

size_t parameters_place(const parameters_target *t, size_t k)
{
    const size_t parts = columns_parts(t->state ? t->state->components : t->definition->components), cell = k / parts,
                 part = k % parts;
    if (t->state) return t->first + (system_place(t->state, cell, (int)part) - t->state->base);
    return t->first + part * (t->count / parts) + cell;
}
