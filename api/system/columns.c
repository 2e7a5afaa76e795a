/* Columns: the one numbering of all numbers that can be observed, their values, and the description of each. */
#include "api/system/columns.h"

#include "api/system/vector.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

size_t system_place(const model_state *s, size_t cell, int component)
{
    size_t offset = s->cells.offset ? s->cells.offset[cell] : cell;
    return s->base + (size_t)component * s->hull + offset;
}

#define TWICE 2.0 /* a spread that is larger than an error by this factor comes from a jump */

static const model_definition *definition(const motus_system *s, const column_range *g)
{
    return &s->definitions[g->item];
}

static bool of_state(motus_column_kind kind)
{
    return kind == MOTUS_COLUMN_POSITION || kind == MOTUS_COLUMN_VELOCITY || kind == MOTUS_COLUMN_FIRST_ORDER ||
           kind == MOTUS_COLUMN_EXACT;
}

static void add(motus_system *s, motus_column_kind kind, bool prime, uint32_t item, size_t count)
{
    s->ranges[s->range_count++] = (column_range){kind, prime, item, s->column_count, count};
    s->column_count += count;
}

static void add_states(motus_system *s, motus_column_kind kind, bool exact, bool prime)
{
    int order = kind == MOTUS_COLUMN_FIRST_ORDER ? 1 : 2;
    for (uint32_t i = 0; i < s->state_count; i++)
        if (s->states[i].order == order)
            add(s, exact ? MOTUS_COLUMN_EXACT : kind, prime, i,
                s->states[i].cells.count * columns_parts(s->states[i].components));
}

bool system_number_columns(motus_system *s)
{
    size_t named = 0; /* parameters are no columns, and every line may have one */
    for (uint32_t i = 0; i < s->definition_count; i++)
        named += s->definitions[i].kind != DEFINED_PARAMETER || s->definitions[i].mode;
    for (uint32_t i = 0; i < s->state_count; i++)
        named += (s->states[i].order == 2 ? 2 : 1) * (s->problem.traits.has_exact ? 2 : 1);
    s->ranges = arena_room(&s->arena, (1 + named) * sizeof *s->ranges);
    if (!s->ranges) return false;
    add(s, MOTUS_COLUMN_TIME, false, 0, 1);
    add_states(s, MOTUS_COLUMN_POSITION, false, false);
    s->positions = s->column_count - 1;
    add_states(s, MOTUS_COLUMN_VELOCITY, false, true);
    add_states(s, MOTUS_COLUMN_FIRST_ORDER, false, false);
    s->velocities = s->column_count - 1 - s->positions;
    size_t largest = 1;
    for (int pass = 0; pass < 2; pass++) {
        s->named[pass] = s->range_count;
        for (uint32_t i = 0; i < s->definition_count; i++) {
            const model_definition *d = &s->definitions[i];
            const bool quantity = d->kind == DEFINED_QUANTITY || d->mode;
            if (pass ? d->kind != DEFINED_INVARIANT : !quantity) continue;
            add(s, pass ? MOTUS_COLUMN_INVARIANT : MOTUS_COLUMN_QUANTITY, false, i, d->numbers);
            const size_t room = s->model ? d->numbers : d->slot + d->numbers;
            largest = room > largest ? room : largest;
        }
        s->named_count[pass] = s->range_count - s->named[pass];
    }
    if (s->problem.traits.has_exact) {
        add_states(s, MOTUS_COLUMN_POSITION, true, false);
        add_states(s, MOTUS_COLUMN_VELOCITY, true, true);
        add_states(s, MOTUS_COLUMN_FIRST_ORDER, true, false);
        s->exact_x = arena_room(&s->arena, (s->problem.nx + 1) * sizeof(double));
        s->exact_v = arena_room(&s->arena, (s->problem.nv + 1) * sizeof(double));
    }
    s->observed = arena_room(&s->arena, largest * sizeof(double));
    return !s->arena.failed;
}

const column_range *columns_range(const motus_system *s, size_t k)
{
    size_t low = 0, high = s->range_count;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        if (s->ranges[middle].first <= k)
            low = middle;
        else
            high = middle;
    }
    return &s->ranges[low];
}

/* ---- values ---- */

/* Calls `move` for every number in the outside order; outer_x, outer_v may be NULL. */
static void each_number(const motus_system *s, double *x, double *v, double *outer_x, double *outer_v,
                        void (*move)(double *inner, double *outer))
{
    for (int order = 2; order >= 1; order--)
        for (uint32_t i = 0; i < s->state_count; i++) {
            const model_state *st = &s->states[i];
            if (st->order != order) continue;
            for (size_t c = 0; c < st->cells.count; c++)
                for (size_t k = 0; k < columns_parts(st->components); k++) {
                    size_t at = system_place(st, c, (int)k);
                    if (order == 2 && outer_x) move(&x[at], outer_x++);
                    if (outer_v) move(&v[at], outer_v++);
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

/* Returns the place of a column's number among those of its definition. */
static size_t observed_place(const motus_system *s, const column_range *g, size_t column)
{
    const size_t parts = columns_parts(definition(s, g)->components), hull = g->count / parts, k = column - g->first;
    return k % parts * hull + k / parts;
}

const model_definition *system_definition(const motus_system *s, size_t column, size_t *number)
{
    const column_range *g = columns_range(s, column);
    *number = observed_place(s, g, column);
    return definition(s, g);
}

size_t system_number(const motus_system *s, size_t outer, bool of_v)
{
    if (of_v) outer -= s->positions;
    size_t seen = 0;
    for (int order = 2; order >= (of_v ? 1 : 2); order--)
        for (uint32_t i = 0; i < s->state_count; i++) {
            const model_state *st = &s->states[i];
            size_t parts = columns_parts(st->components), numbers = st->cells.count * parts;
            if (st->order != order) continue;
            if (outer < seen + numbers) return system_place(st, (outer - seen) / parts, (int)((outer - seen) % parts));
            seen += numbers;
        }
    return 0;
}

/* Evaluates all quantities of a callback, or all its invariants. */
static motus_status ask(motus_system *s, motus_column_kind kind, double t, const double *x, const double *v,
                        motus_error *err)
{
    const motus_callback_def *def = &s->callback;
    const bool invariant = kind == MOTUS_COLUMN_INVARIANT;
    const int answer = (invariant ? def->invariant : def->quantity)(def->context, t, x, v, s->observed);
    if (!answer) return MOTUS_OK;
    return columns_callback_failed(invariant ? "invariant" : "quantity", t, answer, err);
}

motus_status columns_callback_failed(const char *which, double t, int answer, motus_error *err)
{
    char text[DECIMAL_MAX];
    fail(err, MOTUS_CALLBACK, "the %s callback reported a failure at t = %s", which, decimal_time(t, t, text));
    if (err) {
        err->time = t;
        err->returned = answer;
    }
    return MOTUS_CALLBACK;
}

static motus_status evaluate(motus_system *s, const column_range *g, double t, double *x, double *v, motus_error *err)
{
    const problem *p = &s->problem;
    switch (g->kind) {
    case MOTUS_COLUMN_QUANTITY:
    case MOTUS_COLUMN_INVARIANT:
        if (!s->model) return ask(s, g->kind, t, x, v, err);
        if (!interpreter_observe(s->interpreter, &s->definitions[g->item], t, x, v, s->observed))
            return fail(err, MOTUS_MEMORY, "no memory to compute %s", definition(s, g)->name);
        return MOTUS_OK;
    case MOTUS_COLUMN_EXACT:
        if (p->exact(p->ctx, t, s->exact_x, s->exact_v))
            return columns_callback_failed("exact", t, p->returned ? *p->returned : 0, err);
        return MOTUS_OK;
    default: return MOTUS_OK;
    }
}

/* Returns whether a range's columns are already evaluated: those of the state always are, all exact columns come from
 * one evaluation, and so do all quantities, or invariants, of a callback. */
static bool evaluated(const motus_system *s, const column_range *g, const column_range *done)
{
    return g == done || (of_state(g->kind) && g->kind != MOTUS_COLUMN_EXACT) ||
           (done && done->kind == g->kind && (g->kind == MOTUS_COLUMN_EXACT || (!s->model && !of_state(g->kind))));
}

motus_status system_values(motus_system *s, double t, double *x, double *v, const size_t *columns, size_t count,
                           double *out, motus_error *err)
{
    const column_range *done = NULL;
    if (s->problem.refresh) /* at t itself: at the end it is `until`, which may differ from t0 + n h by rounding */
        s->problem.refresh(s->problem.ctx, t, x, v);
    for (size_t i = 0; i < count; i++) {
        if (columns[i] >= s->column_count)
            return fail(err, MOTUS_ARGUMENT, "there is no column %zu; the system has %zu", columns[i], s->column_count);
        const column_range *g = columns_range(s, columns[i]);
        size_t k = columns[i] - g->first;
        if (g->kind == MOTUS_COLUMN_TIME) {
            out[i] = t;
            continue;
        }
        if (!evaluated(s, g, done)) {
            motus_status status = evaluate(s, g, t, x, v, err);
            if (status != MOTUS_OK) return status;
            done = g;
        }
        if (of_state(g->kind)) {
            const model_state *st = &s->states[g->item];
            size_t parts = columns_parts(st->components), at = system_place(st, k / parts, (int)(k % parts));
            const double *from_x = g->kind == MOTUS_COLUMN_EXACT ? s->exact_x : x,
                         *from_v = g->kind == MOTUS_COLUMN_EXACT ? s->exact_v : v;
            out[i] = st->order == 2 && !g->prime ? from_x[at] : from_v[at];
        } else if (s->model) {
            out[i] = s->observed[observed_place(s, g, columns[i])];
        } else {
            out[i] = s->observed[definition(s, g)->slot + k];
        }
    }
    return MOTUS_OK;
}

int system_later(const motus_system *s, double t, double late, double *x, double *v, double *a)
{
    const problem *const p = &s->problem;
    if (p->refresh) p->refresh(p->ctx, t, x, v);
    memset(a, 0, p->nv * sizeof *a);
    const int answer = p->accel(p->ctx, t, x, v, a);
    for (size_t k = 0; k < p->nx - p->modes; k++) x[k] += v[k] * late;
    for (size_t k = 0; k < p->nv && !answer; k++) v[k] += isfinite(a[k]) ? a[k] * late : 0;
    if (p->refresh) p->refresh(p->ctx, t, x, v);
    return answer;
}

motus_status system_rounding(motus_system *s, double t, double *x, double *v, const size_t *columns, size_t count,
                             double *bounds, motus_error *err)
{
    const column_range *done = NULL;
    for (size_t i = 0; i < count; i++) {
        const column_range *g = columns_range(s, columns[i]);
        bounds[i] = 0;
        if (!s->model || (g->kind != MOTUS_COLUMN_QUANTITY && g->kind != MOTUS_COLUMN_INVARIANT)) continue;
        if (g != done && !interpreter_rounding(s->interpreter, &s->definitions[g->item], t, x, v, s->observed))
            return fail(err, MOTUS_MEMORY, "no memory for the rounding of %s", definition(s, g)->name);
        done = g;
        bounds[i] = s->observed[observed_place(s, g, columns[i])];
    }
    return MOTUS_OK;
}

bool system_box(const motus_system *s, const double *x, const double *v, system_bar bar, void *ctx, interval *in_x,
                interval *in_v)
{
    for (size_t k = 0; k < s->problem.nx; k++) in_x[k] = (interval){x[k], x[k]};
    for (size_t k = 0; k < s->problem.nv; k++) in_v[k] = (interval){v[k], v[k]};
    for (size_t i = 0; i < s->range_count; i++) {
        const column_range *g = &s->ranges[i];
        if (!of_state(g->kind) || g->kind == MOTUS_COLUMN_EXACT) continue;
        const model_state *st = &s->states[g->item];
        const size_t parts = columns_parts(st->components);
        for (size_t k = 0; k < g->count; k++) {
            const size_t at = system_place(st, k / parts, (int)(k % parts));
            interval *to = st->order == 2 && !g->prime ? &in_x[at] : &in_v[at];
            const double off = bar(ctx, g->first + k);
            if (!isfinite(off)) return false;
            *to = (interval){to->low - off, to->high + off};
        }
    }
    return true;
}

/* Finds the hull of a quantity's values at states of a box: its corners, some at random, and the middles of its faces.
 * Bounds do not see that one condition holds where another does not, as in a table of pieces that join. */
static motus_status spread(motus_system *s, const column_range *g, double t, const interval *x, double *room,
                           interval *out, motus_error *err)
{
    enum { CORNERS = 32, FACES = 32 };
    const size_t nx = s->problem.nx, n = nx + s->problem.nv, faces = n < FACES ? n : FACES;
    uint64_t state = 1;
    motus_status status = MOTUS_OK;
    for (size_t i = 0; i < CORNERS + 2 * faces && status == MOTUS_OK; i++) {
        for (size_t k = 0; k < n; k++) {
            const bool face = i >= CORNERS, own = face && (i - CORNERS) / 2 == k;
            const double way = i < 2 ? (i ? 1 : -1) : !face ? (vector_random(&state) < 0 ? -1 : 1) : i % 2 ? 1 : -1;
            room[k] = x[k].low + (x[k].high - x[k].low) * (face && !own ? 0.5 : (1 + way) / 2);
        }
        status = evaluate(s, g, t, room, room + nx, err);
        for (size_t k = 0; k < g->count && status == MOTUS_OK; k++) {
            const size_t at = observed_place(s, g, g->first + k);
            const interval here = {s->observed[at], s->observed[at]}, none = {INFINITY, -INFINITY};
            if (i == 0) out[at] = none;
            if (!isnan(here.low)) out[at] = interval_hull(out[at], here);
        }
    }
    return status;
}

static bool is_formula(const motus_system *s, const column_range *g)
{
    return s->model && (g->kind == MOTUS_COLUMN_QUANTITY || g->kind == MOTUS_COLUMN_INVARIANT);
}

static bool jumps(motus_system *s, const column_range *g, bool *flat)
{
    return is_formula(s, g) && interpreter_leaps(s->interpreter, &s->definitions[g->item], flat);
}

bool system_jumps(motus_system *s, size_t column)
{
    bool flat;
    return jumps(s, columns_range(s, column), &flat);
}

/* Returns the error of a value that lies within bounds. error: the difference of run and companion. */
static double doubted(doubt open, bool flat, double value, interval bounds, double error)
{
    const double off = fmax(bounds.high - value, value - bounds.low);
    const double own = 4 * (nextafter(fabs(value), INFINITY) - fabs(value));
    if (flat && off <= own) return value == 0 ? 0 : own;
    if (flat) return off < fabs(value) ? off : INFINITY;
    if (open == DOUBT_POLE) return off <= own ? error : INFINITY;
    if (open == DOUBT_NONE || !(off > error)) return error;
    return open == DOUBT_STEEP || off < fabs(value) || off < TWICE * error ? off : INFINITY;
}

motus_status system_leaps(motus_system *s, double t, double *x, double *v, system_bar bar, void *ctx, bool sharp,
                          const size_t *columns, size_t count, double *errors, motus_error *err)
{
    const size_t nx = s->problem.nx, nv = s->problem.nv;
    const column_range *done = NULL;
    interval *box = NULL, *out = NULL;
    doubt open = DOUBT_NONE;
    motus_status status = MOTUS_OK;
    for (size_t i = 0; i < count && status == MOTUS_OK; i++) {
        const column_range *g = columns_range(s, columns[i]);
        bool flat = false;
        if (!jumps(s, g, &flat)) {
            if (!sharp || !is_formula(s, g) || !interpreter_sharp(s->interpreter, &s->definitions[g->item])) continue;
            flat = false;
        }
        model_definition *d = &s->definitions[g->item];
        if (g != done) {
            give(&s->allocator, box);
            box = take(&s->allocator, 2 * (nx + nv) + d->numbers + 1, sizeof *box);
            if (!box) return fail(err, MOTUS_MEMORY, "no memory for the errors of %s", d->name);
            out = box + 2 * (nx + nv);
            if (!system_box(s, x, v, bar, ctx, box, box + nx)) break;
            if (!interpreter_doubt(s->interpreter, d, t, box, box + nx, out, &open))
                status = fail(err, MOTUS_MEMORY, "no memory for the errors of %s", d->name);
            bool bounded = open == DOUBT_STEEP;
            for (size_t k = 0; k < d->numbers; k++) bounded = bounded && isfinite(out[k].high - out[k].low);
            double *const room = (double *)(void *)(box + nx + nv);
            if (status == MOTUS_OK && open != DOUBT_NONE && !bounded) status = spread(s, g, t, box, room, out, err);
            if (status == MOTUS_OK) status = evaluate(s, g, t, x, v, err);
        }
        done = g;
        if (status != MOTUS_OK) break;
        const size_t at = observed_place(s, g, columns[i]);
        errors[i] = doubted(open, flat, s->observed[at], out[at], errors[i]);
    }
    give(&s->allocator, box);
    return status;
}

motus_status system_values_of(motus_system *s, double t, const double *x, const double *v, double *room,
                              const size_t *columns, size_t count, double *out, motus_error *err)
{
    const problem *p = &s->problem;
    if (p->nx) memcpy(room, x, p->nx * sizeof *x);
    memcpy(room + p->nx, v, p->nv * sizeof *v);
    return system_values(s, t, room, room + p->nx, columns, count, out, err);
}

/* ---- what a column is ---- */

model_state columns_shape(const motus_system *s, const column_range *g)
{
    if (of_state(g->kind)) return s->states[g->item];
    const model_definition *d = definition(s, g);
    const size_t hull = d->numbers / columns_parts(d->components);
    model_state shape = {.name = d->name,
                         .order = 2,
                         .components = d->components,
                         .dims = d->dims,
                         .hull = hull,
                         .cells = {.count = hull}};
    memcpy(shape.first, d->first, sizeof shape.first);
    memcpy(shape.last, d->last, sizeof shape.last);
    return shape;
}

bool columns_find_cell(const model_state *s, const int64_t *index, size_t *cell)
{
    size_t offset = 0;
    for (int d = 0; d < s->dims; d++) {
        if (index[d] < s->first[d] || index[d] > s->last[d]) return false;
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

/* Finds the indices of a place in the hull. */
static void indices_of(const model_state *s, size_t offset, int64_t *index)
{
    for (int d = s->dims - 1; d >= 0; d--) {
        const size_t extent = (size_t)(s->last[d] - s->first[d] + 1);
        index[d] = s->first[d] + (int64_t)(offset % extent);
        offset /= extent;
    }
}

/* Returns the number, from 0, of the range's quantity or invariant; the ranges of a kind are neighbours. */
static size_t rank_of(const motus_system *s, const column_range *g)
{
    return (size_t)(g - s->ranges) - s->named[g->kind == MOTUS_COLUMN_INVARIANT];
}

static motus_column describe(const motus_system *s, size_t k)
{
    const column_range *g = columns_range(s, k);
    motus_column c = {.kind = g->kind, .variable = g->item, .is_velocity = g->prime};
    if (g->kind == MOTUS_COLUMN_TIME) {
        snprintf(c.name, sizeof c.name, "%s", columns_time(s));
        return c;
    }
    const model_state shape = columns_shape(s, g);
    const size_t parts = columns_parts(shape.components), cell = (k - g->first) / parts;
    const size_t offset = shape.cells.offset ? shape.cells.offset[cell] : cell;
    if (!of_state(g->kind)) c.variable = rank_of(s, g);
    c.component = (int)((k - g->first) % parts);
    c.dimensions = shape.dims;
    indices_of(&shape, offset, c.cell);
    const size_t n = g->kind == MOTUS_COLUMN_EXACT ? (size_t)snprintf(c.name, sizeof c.name, "exact ") : 0;
    model_state_name(&shape, offset, c.component, g->prime, c.name + n, sizeof c.name - n);
    return c;
}

size_t motus_column_count(const motus_system *s) { return s ? s->column_count : 0; }

motus_status motus_column_at(const motus_system *s, size_t k, motus_column *out)
{
    if (!s || !out || k >= s->column_count || motus_struct_check(MOTUS_DEF_COLUMN, out, NULL) != MOTUS_OK)
        return MOTUS_ARGUMENT;
    const motus_column c = describe(s, k);
    motus_struct_write(MOTUS_DEF_COLUMN, &c, out);
    return MOTUS_OK;
}

/* Finds the range of a column's description; NULL: none. */
static const column_range *range_of(const motus_system *s, const motus_column *c)
{
    size_t rank = 0;
    for (size_t i = 0; i < s->range_count; i++) {
        const column_range *g = &s->ranges[i];
        if (g->kind != c->kind) continue;
        const size_t variable = of_state(g->kind) ? g->item : rank++;
        if (variable == c->variable && (g->kind != MOTUS_COLUMN_EXACT || g->prime == (c->is_velocity != 0))) return g;
    }
    return NULL;
}

motus_status motus_column_of(const motus_system *s, const motus_column *given, size_t *k, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!s || !given || !k)
        return fail(err, MOTUS_ARGUMENT, "motus_column_of needs a system, a column and a place for its number");
    motus_column c;
    motus_status status = motus_struct_read(MOTUS_DEF_COLUMN, given, &c, err);
    if (status != MOTUS_OK) return status;
    const column_range *g = range_of(s, &c);
    if (!g) {
        fail(err, MOTUS_NAME, "there is no variable, quantity or invariant %zu of this kind", c.variable);
        hint(err, "they count from 0: see motus_variable_count, motus_quantity_count, motus_invariant_count");
        return MOTUS_NAME;
    }
    if (g->kind == MOTUS_COLUMN_TIME) {
        *k = g->first;
        return MOTUS_OK;
    }
    const model_state shape = columns_shape(s, g);
    const size_t parts = columns_parts(shape.components);
    size_t cell;
    if (c.component < 0 || (size_t)c.component >= parts)
        return fail(err, MOTUS_NAME, "%s has no component %d; they count from 0, and there are %d", shape.name,
                    c.component, shape.components);
    if (!columns_find_cell(&shape, c.cell, &cell)) {
        fail(err, MOTUS_NAME, "%s has no cell with this index", shape.name);
        if (shape.dims == 1)
            hint(err, "its indices are %lld to %lld", (long long)shape.first[0], (long long)shape.last[0]);
        return MOTUS_NAME;
    }
    *k = g->first + cell * parts + (size_t)c.component;
    return MOTUS_OK;
}

/* ---- quantities and invariants ---- */

static const char *definition_name(const motus_system *s, definition_kind kind, size_t k, size_t *numbers)
{
    const int which = kind == DEFINED_INVARIANT;
    if (!s || k >= s->named_count[which]) return NULL;
    const model_definition *d = definition(s, &s->ranges[s->named[which] + k]);
    if (numbers) *numbers = d->numbers;
    return d->name;
}

static size_t definition_count(const motus_system *s, definition_kind kind)
{
    return s ? s->named_count[kind == DEFINED_INVARIANT] : 0;
}

size_t motus_quantity_count(const motus_system *s) { return definition_count(s, DEFINED_QUANTITY); }
size_t motus_invariant_count(const motus_system *s) { return definition_count(s, DEFINED_INVARIANT); }

const char *motus_quantity_name(const motus_system *s, size_t k, size_t *numbers)
{
    return definition_name(s, DEFINED_QUANTITY, k, numbers);
}

const char *motus_invariant_name(const motus_system *s, size_t k, size_t *numbers)
{
    return definition_name(s, DEFINED_INVARIANT, k, numbers);
}
