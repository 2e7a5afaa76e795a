/* Parameters and the start, each computed when it is first needed. A parameter that is needed while it is being
 * computed depends on itself, which is an error. */
#include "lang/lower/resolve.h"

#include "lang/lower/lower.h"
#include "lang/model/evaluate.h"
#include "lang/model/undefined.h"
#include "lang/model/vary_record.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static bool failed(const model *m) { return source_failed(&m->source); }

/* nodes: those of the values, or NULL */
static bool finite_values(model *m, const model_definition *d, const node *nodes, const double *v, size_t count)
{
    undefined_term u;
    for (size_t k = 0; k < count; k++)
        if (!isfinite(v[k])) {
            if (nodes && undefined_of(m, &(output){.value = nodes[k]}, NULL, NAN, NULL, NULL, &u) && u.outside[0]) {
                source_complain(&m->source, MOTUS_ARGUMENT, &d->statement->value->at, "%s has no value: %s", d->name,
                                u.outside);
                undefined_hint(&u, NAN, true, m->source.error);
                return false;
            }
            source_complain(&m->source, MOTUS_ARGUMENT, &d->statement->value->at, "%s is not a finite number", d->name);
            source_hint(&m->source, "look for a division by zero, or a root or logarithm of a negative number");
            return false;
        }
    return true;
}

/* Evaluates numbers into the pool from `first` on; they must be finite. */
static bool evaluate_numbers(model *m, const model_definition *d, const node *nodes, int n, size_t first)
{
    double *out = take(&m->arena->allocator, (size_t)n, sizeof *out); /* since the pool may move meanwhile */
    if (!out) return m->arena->failed = true, false;
    const bool ok = evaluate_nodes(m, nodes, n, out) && finite_values(m, d, nodes, out, (size_t)n);
    if (ok) memcpy(m->pool + first, out, (size_t)n * sizeof *out);
    give(&m->arena->allocator, out);
    return ok;
}

static bool resolve_plain(model *m, model_definition *d)
{
    lowering l;
    lower_start(&l, m, PLACE_CONSTANT, "a parameter");
    value v = lower_numbers(&l, d->statement->value);
    int n = v.count ? v.count : 1;
    if (failed(m)) return false;
    d->components = v.count;
    d->slot = m->scalar_used;
    if (m->scalar_used + (uint32_t)n > m->scalar_slots) {
        source_complain(&m->source, MOTUS_LIMIT, &d->statement->at, "the parameters have too many components");
        return false;
    }
    if (!evaluate_numbers(m, d, v.item, n, d->slot)) return false;
    for (int k = 0; k < n; k++) m->slot_owner[d->slot + (uint32_t)k] = (uint32_t)(d - m->definitions) + 1;
    for (int k = 0; k < n; k++)
        if (!vary_record_scalar(m, v.item[k], d->slot + (uint32_t)k)) return false;
    for (int k = 0; k < n; k++) evaluate_held(m, v.item[k], d->slot + (uint32_t)k);
    m->scalar_used += (uint32_t)n;
    return true;
}

static void own_arrays(model *m, model_definition *d, uint16_t first, int parts)
{
    d->array = first;
    for (int k = 0; k < parts; k++) m->array_owner[first + k] = 2 * (uint32_t)(d - m->definitions) + 1;
}

/* Resolves K = [[2, -1], [-1, 2]], with the places [row, column] from 1 on. */
static bool resolve_matrix(model *m, model_definition *d)
{
    lowering l;
    lower_start(&l, m, PLACE_CONSTANT, "a parameter");
    value v = lower_matrix(&l, d->statement->value);
    if (failed(m)) return false;
    const int n = v.rows * v.count;
    if (!model_take_extent(m, d)) return false;
    d->list = true;
    d->dims = 2;
    d->components = 0;
    d->first[0] = d->first[1] = 1;
    d->last[0] = v.rows;
    d->last[1] = v.count;
    size_t base;
    uint16_t at;
    if (!model_take_numbers(m, (size_t)n, &base) || !model_take_arrays(m, 1, &at)) return false;
    own_arrays(m, d, at, 1);
    graph_shape(m->arena, &m->arrays[at], SPACE_POOL, base, 2, d->first, d->last);
    if (!evaluate_numbers(m, d, v.item, n, base)) return false;
    for (int k = 0; k < n; k++) {
        output place = {.to = {.dims = 2}};
        place.to.at[0] = (subscript){.level = -1, .slot = -1, .modulus = -1, .literal = 1 + k / v.count};
        place.to.at[1] = (subscript){.level = -1, .slot = -1, .modulus = -1, .literal = 1 + k % v.count};
        if (!vary_record(m, &place, v.item + k, 1, base, 2, d->first, d->last, (size_t)n, NULL, 0, &d->log_array))
            return false;
        evaluate_held_cells(m, &place, v.item + k, 1, at);
    }
    return true;
}

/* Lowers the entries of a list; the caller gives the nodes back. NULL: there was a complaint, or no memory. */
static node *lower_entries(model *m, const tree *list, int *components)
{
    node *nodes = NULL;
    lowering l;
    lower_start(&l, m, PLACE_CONSTANT, "a parameter");
    for (uint32_t i = 0; i < list->count; i++) {
        const value v = lower_numbers(&l, list->item[i]);
        const size_t parts = v.count ? (size_t)v.count : 1;
        if (i == 0) *components = v.count;
        if (!failed(m) && v.count != *components)
            source_complain(&m->source, MOTUS_SHAPE, &list->item[i]->at,
                            "the entries of a list are all numbers, or all vectors of one length");
        if (i == 0 && !failed(m) && !(nodes = take(&m->arena->allocator, list->count, parts * sizeof *nodes)))
            m->arena->failed = true;
        if (failed(m) || !nodes) {
            give(&m->arena->allocator, nodes);
            return NULL;
        }
        for (size_t k = 0; k < parts; k++) nodes[i * parts + k] = v.item[k];
    }
    return nodes;
}

/* Evaluates the entries of a list into the pool, component by component. */
static bool place_entries(model *m, model_definition *d, const node *nodes, int n, int parts)
{
    size_t base;
    uint16_t at;
    if (!model_take_numbers(m, (size_t)n * (size_t)parts, &base) || !model_take_arrays(m, parts, &at)) return false;
    own_arrays(m, d, at, parts);
    node *column = take(&m->arena->allocator, (size_t)n, sizeof *column);
    if (!column) m->arena->failed = true;
    bool ok = column != NULL;
    for (int k = 0; ok && k < parts; k++) {
        graph_shape(m->arena, &m->arrays[at + k], SPACE_POOL, base + (size_t)k * (size_t)n, 1, d->first, d->last);
        for (int i = 0; i < n; i++) column[i] = nodes[(size_t)i * (size_t)parts + (size_t)k];
        ok = evaluate_numbers(m, d, column, n, base + (size_t)k * (size_t)n);
    }
    give(&m->arena->allocator, column);
    for (int i = 0; ok && i < n; i++) {
        const output place = {.to = {.dims = 1, .at = {{.level = -1, .slot = -1, .modulus = -1, .literal = i + 1}}}};
        ok = vary_record(m, &place, nodes + (size_t)i * (size_t)parts, parts, base, 1, d->first, d->last, (size_t)n,
                         NULL, 0, &d->log_array);
        if (ok) evaluate_held_cells(m, &place, nodes + (size_t)i * (size_t)parts, parts, at);
    }
    return ok;
}

/* Resolves m = [1, 2, 3] or [(1, 0), (0, 1)], with the places 1 … n. */
static bool resolve_list(model *m, model_definition *d)
{
    const tree *list = d->statement->value;
    if (list->count > 0 && list->item[0]->kind == TREE_LIST) return resolve_matrix(m, d);
    const int n = (int)list->count;
    node *nodes = lower_entries(m, list, &d->components);
    if (!nodes || !model_take_extent(m, d)) {
        give(&m->arena->allocator, nodes);
        return false;
    }
    d->list = true;
    d->dims = 1;
    d->first[0] = 1;
    d->last[0] = n;
    const bool ok = place_entries(m, d, nodes, n, d->components ? d->components : 1);
    give(&m->arena->allocator, nodes);
    return ok;
}

/* The ranks of the lines of a family. Of lines about one place, the one with fewer indices holds; a line of --set holds
 * before all. */
enum { RANK_CELL = MAX_DIMS + 1, RANK_SET };
#define EACH_LINE(m, d, one) \
    for (const statement *one = (d)->statement; one; one = one->next ? &(m)->statements.item[one->next - 1] : NULL)

static int rank_of(const statement *line, const output *o)
{
    return o->loops ? 1 + o->to.dims - o->loops : line->at.text > 0 ? RANK_SET : RANK_CELL;
}

static bool open_line(model *m, const model_definition *d, const statement *line, lowering *l, output *o)
{
    *o = (output){0};
    lower_start(l, m, d->kind == DEFINED_PARAMETER ? PLACE_CONSTANT : PLACE_QUANTITY, "a parameter");
    return lower_target(l, line, o);
}

/* Finds the range of the places of all lines. */
static bool family_extent(model *m, model_definition *d)
{
    if (!model_take_extent(m, d)) return false;
    EACH_LINE(m, d, line)
    {
        lowering l;
        output o;
        int64_t first[MAX_DIMS], last[MAX_DIMS];
        if (!open_line(m, d, line, &l, &o)) return false;
        if (line == d->statement && !line->next && (o.loops == 0 || o.loops != o.to.dims)) {
            source_complain(&m->source, MOTUS_SHAPE, &line->at, "%s[…] needs an index with a range", d->name);
            source_hint(&m->source, "write %s[i] = … for i = 1..N, or a list %s = [1, 2, 3]", d->name, d->name);
            return false;
        }
        lower_extent(m, &l, &o, first, last);
        d->dims = (uint8_t)o.to.dims;
        for (int k = 0; k < d->dims; k++) {
            if (line == d->statement || first[k] < d->first[k]) d->first[k] = first[k];
            if (line == d->statement || last[k] > d->last[k]) d->last[k] = last[k];
        }
    }
    return true;
}

static bool name_place(model *m, const model_definition *d, span where, size_t place, const char *what)
{
    char index[80] = "";
    int64_t at[MAX_DIMS];
    for (int k = d->dims - 1; k >= 0; k--) {
        const size_t length = (size_t)(d->last[k] - d->first[k] + 1);
        at[k] = d->first[k] + (int64_t)(place % length);
        place /= length;
    }
    for (int k = 0, n = 0; k < d->dims && n < (int)sizeof index; k++)
        n += snprintf(index + n, sizeof index - (size_t)n, "%s%lld", k ? "," : "", (long long)at[k]);
    source_complain(&m->source, MOTUS_NAME, &where, "%s[%s] %s", d->name, index, what);
    return false;
}

/* Marks the places of a line in the map, which has the highest rank of each. */
static bool mark_line(model *m, const model_definition *d, const statement *line, uint8_t *map)
{
    lowering l;
    output o;
    int64_t first[MAX_DIMS], last[MAX_DIMS], at[MAX_DIMS];
    if (!open_line(m, d, line, &l, &o)) return false;
    lower_extent(m, &l, &o, first, last);
    const uint8_t rank = (uint8_t)rank_of(line, &o);
    memcpy(at, first, sizeof at);
    do {
        const size_t place = model_cell(d->dims, d->first, d->last, at);
        if (map[place] == rank) return name_place(m, d, line->at, place, "is defined twice");
        if (map[place] < rank) map[place] = rank;
    } while (model_next_cell(d->dims, first, last, at));
    return true;
}

static bool family_map(model *m, const model_definition *d, size_t hull, uint8_t **map)
{
    *map = NULL;
    if (!d->statement->next) return true;
    *map = arena_take(m->arena, hull);
    if (m->arena->failed) return false;
    EACH_LINE(m, d, line) if (!mark_line(m, d, line, *map)) return false;
    for (size_t k = 0; k < hull; k++)
        if (!(*map)[k]) return name_place(m, d, d->statement->at, k, "has no line, but places around it do");
    return true;
}

/* Evaluates the lines of one rank into the places of a family. */
static bool family_lines(model *m, model_definition *d, int rank, const uint8_t *map, size_t hull)
{
    EACH_LINE(m, d, line)
    {
        lowering l;
        output o;
        int64_t first[MAX_DIMS], last[MAX_DIMS];
        if (!open_line(m, d, line, &l, &o)) return false;
        if (rank_of(line, &o) != rank) continue;
        lower_extent(m, &l, &o, first, last);
        if (rank == RANK_CELL && map[model_cell(d->dims, d->first, d->last, first)] == RANK_SET) continue;
        value v = lower_numbers(&l, line->value);
        if (failed(m)) return false;
        if (v.count != d->components) {
            source_complain(&m->source, MOTUS_SHAPE, &line->value->at,
                            "the lines of %s are all numbers, or all vectors of one length", d->name);
            return false;
        }
        const int parts = v.count ? v.count : 1;
        const size_t base = m->arrays[d->array].base;
        if (!evaluate_into_pool(m, &o, v.item, parts, base, d->first, d->last, hull) ||
            !vary_record(m, &o, v.item, parts, base, d->dims, d->first, d->last, hull, map, (uint8_t)rank,
                         &d->log_array))
            return false;
        evaluate_held_cells(m, &o, v.item, parts, d->array);
    }
    return true;
}

static bool resolve_family(model *m, model_definition *d)
{
    if (!family_extent(m, d)) return false;
    const statement *s = d->statement;
    if (d->kind != DEFINED_PARAMETER && s->next) {
        const statement *other = &m->statements.item[s->next - 1];
        source_complain(&m->source, MOTUS_NAME, &other->name_at, "%s is defined twice; the first time in line %d",
                        d->name, source_line(&m->source, &s->at));
        source_hint(&m->source,
                    "it depends on a state or on time: a quantity has one line; choose by if(i == 3, …, …)");
        return false;
    }
    if (d->kind != DEFINED_PARAMETER) return true; /* each use lowers its expression (lower_name.c) */
    lowering l;
    output o;
    if (!open_line(m, d, s, &l, &o)) return false;
    value v = lower_numbers(&l, s->value);
    if (failed(m)) return false;
    int parts = v.count ? v.count : 1;
    d->list = true;
    d->components = v.count;
    array probe;
    size_t hull = graph_shape(m->arena, &probe, SPACE_POOL, 0, d->dims, d->first, d->last), base;
    double numbers = parts;
    for (int k = 0; k < d->dims; k++) numbers *= (double)(d->last[k] - d->first[k] + 1);
    if (numbers > MODEL_LIST_MAX) {
        source_complain(&m->source, MOTUS_LIMIT, &s->at, "%.0f numbers are more than the %d that fit", numbers,
                        MODEL_LIST_MAX);
        return false;
    }
    uint16_t at;
    if (!model_take_numbers(m, hull * (size_t)parts, &base) || !model_take_arrays(m, parts, &at)) return false;
    own_arrays(m, d, at, parts);
    for (int k = 0; k < parts; k++)
        graph_shape(m->arena, &m->arrays[at + k], SPACE_POOL, base + (size_t)k * hull, d->dims, d->first, d->last);
    uint8_t *map;
    if (!family_map(m, d, hull, &map)) return false;
    if (!map && (!evaluate_into_pool(m, &o, v.item, parts, base, d->first, d->last, hull) ||
                 !vary_record(m, &o, v.item, parts, base, d->dims, d->first, d->last, hull, NULL, 0, &d->log_array)))
        return false;
    if (!map) evaluate_held_cells(m, &o, v.item, parts, d->array);
    for (int rank = 1; map && rank <= RANK_SET; rank++)
        if (!family_lines(m, d, rank, map, hull)) return false;
    return finite_values(m, d, NULL, m->pool + base, hull * (size_t)parts);
}

static bool circle(model *m, const model_definition *d)
{
    source_complain(&m->source, MOTUS_NAME, &d->statement->name_at, "%s is defined by itself, in a circle", d->name);
    return false;
}

bool resolve_definition(model *m, model_definition *d)
{
    if (d->progress == 2) return true;
    if (d->progress == 1) return circle(m, d);
    d->progress = 1;
    const statement *s = d->statement;
    bool ok;
    if (s->index_count > 0 || s->loop_count > 0)
        ok = resolve_family(m, d);
    else if (d->kind != DEFINED_PARAMETER)
        ok = true;
    else if (s->value->kind == TREE_LIST)
        ok = resolve_list(m, d);
    else
        ok = resolve_plain(m, d);
    d->progress = ok && !failed(m) ? 2 : 0;
    return ok && !failed(m);
}

/* The start -------------------------------------------------------------------------------------------------------- */

bool resolve_varying(model *m, const tree *t, const char *what, node *n, double *out)
{
    lowering l;
    lower_start(&l, m, PLACE_CONSTANT, what);
    *n = lower_scalar(&l, t, what);
    if (failed(m) || !evaluate_constant(m, *n, &t->at, out)) return false;
    if (!isfinite(*out)) {
        source_complain(&m->source, MOTUS_ARGUMENT, &t->at, "%s is not a finite number", what);
        return false;
    }
    return true;
}

bool resolve_constant(model *m, const tree *t, const char *what, double *out)
{
    node n;
    if (!resolve_varying(m, t, what, &n, out)) return false;
    vary_freeze(m, n, what);
    return !failed(m);
}

bool resolve_start_time(model *m)
{
    if (m->start_known) return true;
    bool any = false;
    span where = {0, 0, 0};
    for (uint32_t i = 0; i < m->statements.count; i++) {
        const statement *s = &m->statements.item[i];
        bool from = s->kind == STATEMENT_FROM;
        if (!from && s->kind != STATEMENT_START) continue;
        double at;
        const tree *t = from ? s->value : s->applied->item[1];
        m->start_known = true; /* so that an initial value in this expression is compared with NaN */
        if (!any) m->start = NAN;
        if (!resolve_constant(m, t, "the start", &at)) return false;
        if (any && at != m->start) {
            source_complain(&m->source, MOTUS_ARGUMENT, &t->at, "the start is %g here, but %g in line %d", at, m->start,
                            source_line(&m->source, &where));
            source_hint(&m->source, "all states start at the same time");
            return false;
        }
        if (!any) where = t->at;
        m->start = at;
        any = true;
    }
    if (!any) m->start = 0;
    m->start_known = true;
    return !failed(m);
}
