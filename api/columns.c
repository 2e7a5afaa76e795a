/* Columns: one numbering of all that can be looked at, and the names of it. */
#include "api/system.h"

#include "base/near.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static size_t parts_of(int components) { return components ? (size_t)components : 1; }

size_t system_place(const model_state *s, size_t cell, int component)
{
    size_t offset = s->cells.offset ? s->cells.offset[cell] : cell;
    return s->base + (size_t)component * s->hull + offset;
}

static const model_definition *definition(const motus_system *s, const column_group *g) { return &s->model->definitions[g->item]; }

static bool of_state(motus_column_kind kind)
{
    return kind == MOTUS_POSITION || kind == MOTUS_VELOCITY || kind == MOTUS_COMPANION || kind == MOTUS_EXACT;
}

static void add(motus_system *s, motus_column_kind kind, bool prime, uint32_t item, size_t count)
{
    s->groups[s->group_count++] = (column_group){kind, prime, item, s->column_count, count};
    s->column_count += count;
}

static void add_states(motus_system *s, motus_column_kind kind, bool exact, bool prime)
{
    int order = kind == MOTUS_COMPANION ? 1 : 2;
    for (uint32_t i = 0; i < s->state_count; i++)
        if (s->states[i].order == order)
            add(s, exact ? MOTUS_EXACT : kind, prime, i, s->states[i].cells.count * parts_of(s->states[i].components));
}

bool system_number_columns(motus_system *s)
{
    uint32_t definitions = s->model ? s->model->definition_count : 1;
    s->groups = arena_room(&s->arena, (2 + 6 * (size_t)s->state_count + definitions) * sizeof *s->groups);
    if (!s->groups)
        return false;
    add(s, MOTUS_TIME, false, 0, 1);
    add_states(s, MOTUS_POSITION, false, false);
    s->positions = s->column_count - 1;
    add_states(s, MOTUS_VELOCITY, false, true);
    add_states(s, MOTUS_COMPANION, false, false);
    s->velocities = s->column_count - 1 - s->positions;
    size_t largest = 1;
    for (int pass = 0; pass < 2 && s->model; pass++)
        for (uint32_t i = 0; i < definitions; i++) {
            const model_definition *d = &s->model->definitions[i];
            if (d->kind != (pass ? DEFINED_INVARIANT : DEFINED_QUANTITY))
                continue;
            add(s, pass ? MOTUS_INVARIANT : MOTUS_QUANTITY, false, i, d->numbers);
            if (d->numbers > largest)
                largest = d->numbers;
        }
    if (!s->model && s->callback.invariant)
        add(s, MOTUS_INVARIANT, false, 0, 1);
    if (s->problem.traits.has_exact) {
        add_states(s, MOTUS_POSITION, true, false);
        add_states(s, MOTUS_VELOCITY, true, true);
        add_states(s, MOTUS_COMPANION, true, false);
        s->exact_x = arena_room(&s->arena, (s->problem.nx + 1) * sizeof(double));
        s->exact_v = arena_room(&s->arena, (s->problem.nv + 1) * sizeof(double));
    }
    s->look = arena_room(&s->arena, largest * sizeof(double));
    return !s->arena.failed;
}

static const column_group *group_of(const motus_system *s, size_t k)
{
    size_t low = 0, high = s->group_count;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        if (s->groups[middle].first <= k)
            low = middle;
        else
            high = middle;
    }
    return &s->groups[low];
}

/* ---- values ---- */

/* Moves every number that is seen outside, in the outside order; outer_x, outer_v may be NULL. */
static void each_number(const motus_system *s, double *x, double *v, double *outer_x, double *outer_v, void (*move)(double *inner, double *outer))
{
    for (int order = 2; order >= 1; order--)
        for (uint32_t i = 0; i < s->state_count; i++) {
            const model_state *st = &s->states[i];
            if (st->order != order)
                continue;
            for (size_t c = 0; c < st->cells.count; c++)
                for (size_t k = 0; k < parts_of(st->components); k++) {
                    size_t at = system_place(st, c, (int)k);
                    if (order == 2 && outer_x)
                        move(&x[at], outer_x++);
                    if (outer_v)
                        move(&v[at], outer_v++);
                }
        }
}

static void outward(double *inner, double *outer) { *outer = *inner; }
static void inward(double *inner, double *outer) { *inner = *outer; }

void system_outside(const motus_system *s, const double *x, const double *v, double *out_x, double *out_v)
{
    each_number(s, (double *)x, (double *)v, out_x, out_v, outward);
}

void system_inside(const motus_system *s, const double *in_x, const double *in_v, double *x, double *v)
{
    each_number(s, x, v, (double *)in_x, (double *)in_v, inward);
}

const model_definition *system_definition(const motus_system *s, size_t column, size_t *number)
{
    const column_group *g = group_of(s, column);
    const size_t k = column - g->first, parts = parts_of(definition(s, g)->components);
    *number = k % parts * (g->count / parts) + k / parts;
    return definition(s, g);
}

size_t system_number(const motus_system *s, size_t outer, bool of_v)
{
    if (of_v)
        outer -= s->positions;
    size_t seen = 0;
    for (int order = 2; order >= (of_v ? 1 : 2); order--)
        for (uint32_t i = 0; i < s->state_count; i++) {
            const model_state *st = &s->states[i];
            size_t parts = parts_of(st->components), numbers = st->cells.count * parts;
            if (st->order != order)
                continue;
            if (outer < seen + numbers)
                return system_place(st, (outer - seen) / parts, (int)((outer - seen) % parts));
            seen += numbers;
        }
    return 0;
}

static motus_status evaluate(motus_system *s, const column_group *g, double t, double *x, double *v, motus_error *err)
{
    switch (g->kind) {
    case MOTUS_QUANTITY:
    case MOTUS_INVARIANT:
        if (!s->model) {
            if (s->callback.invariant(s->callback.context, t, x, v, s->look))
                return fail(err, MOTUS_CALLBACK, "the invariant callback reported a failure at t = %g", t);
            return MOTUS_OK;
        }
        if (!interpreter_look(s->interpreter, &s->model->definitions[g->item], t, x, v, s->look))
            return fail(err, MOTUS_MEMORY, "no memory to compute %s", s->model->definitions[g->item].name);
        return MOTUS_OK;
    case MOTUS_EXACT:
        if (s->problem.exact(s->problem.ctx, t, s->exact_x, s->exact_v))
            return fail(err, MOTUS_CALLBACK, "the exact callback reported a failure at t = %g", t);
        return MOTUS_OK;
    default:
        return MOTUS_OK;
    }
}

motus_status system_values(motus_system *s, double t, double *x, double *v, const size_t *columns, size_t count, double *out, motus_error *err)
{
    const column_group *done = NULL;
    if (s->problem.refresh)          /* the end of a run is `until`, not t0 + n h: for all columns alike */
        s->problem.refresh(s->problem.ctx, t, x, v);
    for (size_t i = 0; i < count; i++) {
        if (columns[i] >= s->column_count)
            return fail(err, MOTUS_ARGUMENT, "there is no column %zu; the system has %zu", columns[i], s->column_count);
        const column_group *g = group_of(s, columns[i]);
        size_t k = columns[i] - g->first;
        if (g->kind == MOTUS_TIME) {
            out[i] = t;
            continue;
        }
        /* All exact columns come from one evaluation. */
        if (g != done && !(done && done->kind == MOTUS_EXACT && g->kind == MOTUS_EXACT)) {
            motus_status status = evaluate(s, g, t, x, v, err);
            if (status != MOTUS_OK)
                return status;
            done = g;
        }
        if (of_state(g->kind)) {
            const model_state *st = &s->states[g->item];
            size_t parts = parts_of(st->components), at = system_place(st, k / parts, (int)(k % parts));
            const double *from_x = g->kind == MOTUS_EXACT ? s->exact_x : x, *from_v = g->kind == MOTUS_EXACT ? s->exact_v : v;
            out[i] = st->order == 2 && !g->prime ? from_x[at] : from_v[at];
        } else if (s->model) {
            size_t parts = parts_of(definition(s, g)->components), hull = g->count / parts;
            out[i] = s->look[k % parts * hull + k / parts];
        } else {
            out[i] = s->look[0];
        }
    }
    return MOTUS_OK;
}

/* ---- names ---- */

static model_state as_state(const model_definition *d)
{
    model_state s = {.name = d->name, .order = 2, .components = d->components, .dims = d->dims, .hull = d->numbers / parts_of(d->components)};
    memcpy(s.first, d->first, sizeof s.first);
    memcpy(s.last, d->last, sizeof s.last);
    return s;
}

size_t motus_column_count(const motus_system *s) { return s ? s->column_count : 0; }

motus_status motus_column_at(const motus_system *s, size_t k, motus_column *c)
{
    if (!s || !c || k >= s->column_count)
        return MOTUS_ARGUMENT;
    const column_group *g = group_of(s, k);
    *c = (motus_column){.kind = g->kind, .variable = g->item, .is_velocity = g->prime};
    k -= g->first;
    char *name = c->name;
    size_t room = sizeof c->name;
    if (g->kind == MOTUS_TIME) {
        snprintf(name, room, "t");
        return MOTUS_OK;
    }
    if (g->kind == MOTUS_EXACT) {
        size_t n = (size_t)snprintf(name, room, "exact ");
        name += n;
        room -= n;
    }
    if (of_state(g->kind)) {
        const model_state *st = &s->states[g->item];
        size_t parts = parts_of(st->components), cell = k / parts;
        c->component = (int)(k % parts);
        model_state_name(st, st->cells.offset ? st->cells.offset[cell] : cell, c->component, g->prime, name, room);
        return MOTUS_OK;
    }
    if (!s->model) {
        snprintf(name, room, "invariant");
        return MOTUS_OK;
    }
    const model_definition *d = definition(s, g);
    model_state st = as_state(d);
    c->component = (int)(k % parts_of(d->components));
    size_t number = 0;               /* among the quantities, or the invariants */
    for (uint32_t i = 0; i < g->item; i++)
        number += s->model->definitions[i].kind == d->kind;
    c->variable = number;
    model_state_name(&st, k / parts_of(d->components), c->component, false, name, room);
    return MOTUS_OK;
}

typedef struct column_name {         /* a name taken apart: [exact] base [indices] primes component */
    bool exact;
    char base[MOTUS_NAME_MAX];
    int dims;
    int64_t index[MAX_DIMS];
    int primes;
    int component;                   /* 1-based, 0: none */
} column_name;

/* Indices end at INT32_MAX: a larger one is none, but that is not said here. */
static const char *read_index(const char *p, int64_t *value)
{
    const bool minus = *p == '-';
    uint64_t n;
    const size_t length = decimal_read_whole(p + minus, SIZE_MAX, &n);
    *value = n > INT32_MAX ? (int64_t)INT32_MAX + 1 : (int64_t)n;
    *value = minus ? -*value : *value;
    return length ? p + minus + length : NULL;
}

static bool take_name(const char *p, column_name *n)
{
    *n = (column_name){0};
    if (!strncmp(p, "exact ", 6)) {
        n->exact = true;
        p += 6;
    }
    size_t length = strcspn(p, "[.'");
    if (length == 0 || length >= sizeof n->base)
        return false;
    memcpy(n->base, p, length);
    p += length;
    if (*p == '[') {
        do {
            if (n->dims == MAX_DIMS || !(p = read_index(p + 1, &n->index[n->dims])))
                return false;
            n->dims++;
        } while (*p == ',');
        if (*p++ != ']')
            return false;
    }
    while (*p == '\'' && n->primes < 3) {
        n->primes++;
        p++;
    }
    if (*p == '.') {
        n->component = p[1] == 'x' ? 1 : p[1] == 'y' ? 2 : p[1] == 'z' ? 3 : -1;
        p += p[1] ? 2 : 1;
    } else if (*p == '[') {
        int64_t k;
        if (!(p = read_index(p + 1, &k)) || *p++ != ']' || k < 1 || k > INT32_MAX)
            return false;
        n->component = (int)k;
    }
    return *p == 0 && n->component >= 0;
}

/* The cell of a family with these indices; false if there is no equation there. */
static bool find_cell(const model_state *s, const int64_t *index, size_t *cell)
{
    size_t offset = 0;
    for (int d = 0; d < s->dims; d++) {
        if (index[d] < s->first[d] || index[d] > s->last[d])
            return false;
        offset = offset * (size_t)(s->last[d] - s->first[d] + 1) + (size_t)(index[d] - s->first[d]);
    }
    if (!s->cells.offset) {
        *cell = offset;
        return offset < s->cells.count;
    }
    size_t low = 0, high = s->cells.count;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        if (s->cells.offset[middle] <= offset)
            low = middle;
        else
            high = middle;
    }
    *cell = low;
    return s->cells.count > 0 && s->cells.offset[low] == offset;
}

static const char *group_name(const motus_system *s, const column_group *g)
{
    if (g->kind == MOTUS_TIME)
        return "t";
    if (of_state(g->kind))
        return s->states[g->item].name;
    return s->model ? definition(s, g)->name : "invariant";
}

static motus_status no_column(const motus_system *s, const char *name, const char *base, motus_error *err)
{
    fail(err, MOTUS_NAME, "there is no column %s", name);
    const char *best = NULL;
    int least = 7;
    for (size_t i = 0; i < s->group_count; i++) {
        const char *other = group_name(s, &s->groups[i]);
        if (near_nearer(base, other, &least))
            best = other;
    }
    motus_column c;
    if (best && strcmp(best, base))
        hint(err, "did you mean %s?", best);
    else if (s->column_count > 1 && motus_column_at(s, 1, &c) == MOTUS_OK)
        hint(err, "the columns are t, %s … as a trajectory file names them", c.name);
    return MOTUS_NAME;
}

motus_status motus_column_find(const motus_system *s, const char *name, size_t *first, size_t *count, motus_error *err)
{
    column_name n;
    if (!s || !name || !first || !count)
        return fail(err, MOTUS_ARGUMENT, "motus_column_find needs a system, a name and two places for the answer");
    if (!take_name(name, &n))
        return fail(err, MOTUS_NAME, "%s is not the name of a column", name);
    for (size_t i = 0; i < s->group_count; i++) {
        const column_group *g = &s->groups[i];
        if (strcmp(group_name(s, g), n.base) || n.exact != (g->kind == MOTUS_EXACT) || n.primes != (g->prime ? 1 : 0))
            continue;
        *first = g->first;
        *count = g->count;
        if (g->kind == MOTUS_TIME || (!s->model && g->kind == MOTUS_INVARIANT))
            return n.dims || n.component ? no_column(s, name, n.base, err) : MOTUS_OK;
        model_state st = of_state(g->kind) ? s->states[g->item] : as_state(definition(s, g));
        if (!of_state(g->kind))
            st.cells.count = st.hull;
        size_t parts = parts_of(st.components), cell = 0;
        if (st.dims == 0 && n.dims == 1 && !n.component && !n.primes) {      /* w[2]: a component of a vector */
            n.component = n.index[0] > 0 && n.index[0] < INT32_MAX ? (int)n.index[0] : INT32_MAX;
            n.dims = 0;
        }
        if (n.dims && (n.dims != st.dims || !find_cell(&st, n.index, &cell)))
            return no_column(s, name, n.base, err);
        if (n.component > st.components || (n.component && st.dims && !n.dims))
            return no_column(s, name, n.base, err);
        if (n.dims) {
            *first += cell * parts;
            *count = parts;
        }
        if (n.component) {
            *first += (size_t)n.component - 1;
            *count = 1;
        }
        return MOTUS_OK;
    }
    return no_column(s, name, n.base, err);
}

static const char *definition_name(const motus_system *s, definition_kind kind, size_t k, size_t *numbers)
{
    for (uint32_t i = 0; s && s->model && i < s->model->definition_count; i++) {
        const model_definition *d = &s->model->definitions[i];
        if (d->kind != kind || k-- > 0)
            continue;
        if (numbers)
            *numbers = d->numbers;
        return d->name;
    }
    return NULL;
}

static size_t definition_count(const motus_system *s, definition_kind kind)
{
    size_t n = 0;
    for (uint32_t i = 0; s && s->model && i < s->model->definition_count; i++)
        n += s->model->definitions[i].kind == kind;
    return n;
}

size_t motus_quantity_count(const motus_system *s) { return definition_count(s, DEFINED_QUANTITY); }
const char *motus_quantity_name(const motus_system *s, size_t k, size_t *numbers) { return definition_name(s, DEFINED_QUANTITY, k, numbers); }

size_t motus_invariant_count(const motus_system *s)
{
    return s && !s->model ? s->callback.invariant != NULL : definition_count(s, DEFINED_INVARIANT);
}

const char *motus_invariant_name(const motus_system *s, size_t k, size_t *numbers)
{
    if (s && s->model)
        return definition_name(s, DEFINED_INVARIANT, k, numbers);
    if (numbers)
        *numbers = 1;
    return s && s->callback.invariant && k == 0 ? "invariant" : NULL;
}
