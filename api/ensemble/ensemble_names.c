/* The names of what varies: F, g.x, x(0), x'(0), r.x(0), x[3](0). See ensemble.h. */
#include "api/ensemble/ensemble.h"
#include "api/system/parameters.h"

#include "base/near.h"

#include <stdio.h>
#include <string.h>

static motus_status unknown(const motus_system *s, const char *name, motus_error *err)
{
    fail(err, MOTUS_NAME, "%s is neither a parameter nor an initial value of this model", name);
    char base[MOTUS_NAME_MAX];
    snprintf(base, sizeof base, "%.*s", (int)strcspn(name, ".['("), name);
    for (uint32_t i = 0; s->model && i < s->model->definition_count; i++) {
        const model_definition *d = &s->model->definitions[i];
        if (!strcmp(d->name, base) && d->kind != DEFINED_PARAMETER) {
            hint(err, "%s is computed along the way: vary what it is computed from", base);
            return MOTUS_NAME;
        }
        if (strcmp(d->name, base) && d->kind == DEFINED_PARAMETER && near_likely(base, d->name)) {
            hint(err, "did you mean %s?", d->name);
            return MOTUS_NAME;
        }
    }
    for (uint32_t i = 0; i < s->state_count; i++)
        if (!strcmp(s->states[i].name, base) && !strchr(name, '(')) {
            char at[DECIMAL_MAX];
            hint(err, "an initial value is varied: %s(%s)", name, decimal(s->start, at));
            return MOTUS_NAME;
        }
    hint(err,
         "a parameter is varied by its name, F; an initial value as x(0), x'(0), r.x(0), x[3](0); the end as until");
    return MOTUS_NAME;
}

static motus_status initial_value(const motus_system *s, const char *name, const char *bare, size_t *place,
                                  motus_error *err)
{
    size_t first, count;
    motus_column c = motus_default_column();
    if (motus_column_find(s, bare, &first, &count, NULL) != MOTUS_OK || motus_column_at(s, first, &c) != MOTUS_OK ||
        (c.kind != MOTUS_COLUMN_POSITION && c.kind != MOTUS_COLUMN_VELOCITY && c.kind != MOTUS_COLUMN_FIRST_ORDER))
        return unknown(s, name, err);
    if (count > 1) {
        fail(err, MOTUS_SHAPE, "%s is %zu numbers, and one is varied at a time", name, count);
        char at[DECIMAL_MAX];
        hint(err, "name one of them: %s(%s)", c.name, decimal(s->start, at));
        return MOTUS_SHAPE;
    }
    const bool velocity = c.kind == MOTUS_COLUMN_VELOCITY;
    size_t at = first - 1, inner;
    inner = system_number(s, at, velocity || c.kind == MOTUS_COLUMN_FIRST_ORDER);
    if (!s->model) {
        *place = velocity || c.kind == MOTUS_COLUMN_FIRST_ORDER ? s->problem.nx + inner : inner;
        return MOTUS_OK;
    }
    for (uint32_t i = 0; i < s->state_count; i++) {
        const model_state *st = &s->states[i];
        const size_t numbers = st->hull * (size_t)(st->components ? st->components : 1);
        const bool of_v = velocity || c.kind == MOTUS_COLUMN_FIRST_ORDER;
        if (inner < st->base || inner >= st->base + numbers || (st->order == 1) != (c.kind == MOTUS_COLUMN_FIRST_ORDER))
            continue;
        *place = s->model->arrays[st->start_array[of_v && st->order == 2]].base + (inner - st->base);
        return MOTUS_OK;
    }
    return unknown(s, name, err);
}

/* Finds a parameter's number: "g", "g.x", "g[2]". */
static motus_status parameter(const motus_system *s, const char *name, size_t *place, motus_error *err)
{
    const size_t length = strcspn(name, ".[(");
    for (uint32_t i = 0; s->model && i < s->model->definition_count; i++) {
        const model_definition *d = &s->model->definitions[i];
        if (strlen(d->name) != length || strncmp(d->name, name, length) || d->kind != DEFINED_PARAMETER) continue;
        const char *rest = name + length;
        uint64_t written = 0;
        bool closed = true;
        if (*rest == '.' && rest[1] && !rest[2])
            written = rest[1] == 'x' ? 1 : rest[1] == 'y' ? 2 : rest[1] == 'z' ? 3 : 0;
        else if (*rest == '[')
            closed = !strcmp(rest + 1 + decimal_read_whole(rest + 1, SIZE_MAX, &written), "]");
        if (!closed || (*rest && (written < 1 || written > INT32_MAX))) return unknown(s, name, err);
        const int64_t k = (int64_t)written;
        if (d->list && d->dims == 1 && !d->components && k >= d->first[0] && k <= d->last[0]) {
            *place = s->model->arrays[d->array].base + (size_t)(k - d->first[0]);
            return MOTUS_OK;
        }
        if (d->list || (d->components ? k < 1 || k > d->components : k != 0)) {
            fail(err, MOTUS_SHAPE, "%s is not one number", name);
            hint(err,
                 d->list         ? "name one of them: %s[1]"
                 : d->components ? "name a component: %s.x"
                                 : "%s has no components",
                 d->name);
            return MOTUS_SHAPE;
        }
        *place = d->slot + (size_t)(k ? k - 1 : 0);
        return MOTUS_OK;
    }
    return unknown(s, name, err);
}

motus_status ensemble_place(const motus_system *s, const char *name, size_t *place, motus_error *err)
{
    char bare[2 * MOTUS_NAME_MAX];
    double start;
    if (!name) return fail(err, MOTUS_ARGUMENT, "what varies has no name");
    if (!parameters_bracket(name, bare, sizeof bare, &start)) return parameter(s, name, place, err);
    if (start != s->start) {
        char at[DECIMAL_MAX];
        return fail(err, MOTUS_NAME, "%s is not an initial value: the start is %s", name, decimal(s->start, at));
    }
    return initial_value(s, name, bare, place, err);
}
