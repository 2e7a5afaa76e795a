/* Tables [19]: interp(u, T, A), spline(u, T, A), both on a uniform grid, and entries of lists whose number moves. */
#include "lang/lower/resolve.h"
#include "lang/lower/lower_parts.h"

#include "lang/graph/graph_walk.h"
#include "lang/model/evaluate.h"
#include "lang/model/symbols.h"
#include "lang/model/table.h"
#include "lang/model/vary_record.h"

#include <string.h>

/* A list of the pool: its first array, one a component. */
typedef struct numbers {
    uint16_t array;
    int components;
    int64_t first;
    size_t count;
} numbers;

static const char *kept_text(lowering *l, uint32_t text, uint32_t from, uint32_t to)
{
    char out[80];
    source_excerpt(&l->model->source, &(span){text, from, to}, out, sizeof out);
    const size_t size = strlen(out) + 1;
    char *kept = arena_room(l->model->arena, size);
    return kept ? memcpy(kept, out, size) : "";
}

static numbers numbers_of(const model *m, uint16_t array, int components)
{
    const extent *over = m->arrays[array].over;
    return (numbers){array, components, over->first[0], (size_t)(over->last[0] - over->first[0] + 1)};
}

/* Finds the numbers that an expression of the text has been given already. */
static bool known_numbers(const model *m, const tree *of, numbers *out)
{
    for (const model_unnamed *k = m->unnamed; k; k = k->next)
        if (k->of == of) return *out = numbers_of(m, k->array, k->components), true;
    return false;
}

/* Makes the arrays of a list that has no name. False: no memory. */
static bool new_numbers(lowering *l, const tree *of, size_t count, int components, numbers *out)
{
    model *m = l->model;
    const int parts = components ? components : 1;
    const int64_t first = 1, last = (int64_t)count;
    model_unnamed *k = arena_room(m->arena, sizeof *k);
    size_t base;
    uint16_t array;
    if (!k || !model_take_numbers(m, count * (size_t)parts, &base) || !model_take_arrays(m, parts, &array))
        return false;
    for (int c = 0; c < parts; c++)
        graph_shape(m->arena, &m->arrays[array + c], SPACE_POOL, base + (size_t)c * count, 1, &first, &last);
    if (m->arena->failed) return false;
    *k = (model_unnamed){of, m->unnamed, array, components};
    m->unnamed = k;
    *out = numbers_of(m, array, components);
    return true;
}

/* Computes components of a line into the arrays of a list. */
static bool put_numbers(lowering *l, const numbers *to, const output *target, const node *values)
{
    model *m = l->model;
    const int parts = to->components ? to->components : 1;
    const int64_t first = 1, last = (int64_t)to->count;
    const size_t base = m->arrays[to->array].base;
    uint16_t array = 0;
    return evaluate_into_pool(m, target, values, parts, base, &first, &last, to->count) &&
           vary_record(m, target, values, parts, base, 1, &first, &last, to->count, NULL, 0, &array);
}

/* Lowers a list that stands in the call. */
static bool literal_list(lowering *l, const tree *t, numbers *out)
{
    lowering inner;
    lower_start(&inner, l->model, PLACE_CONSTANT, "an entry of a list");
    for (uint32_t i = 0; i < t->count; i++) {
        const value v = lower_expression(&inner, t->item[i]);
        if (failed(l)) return false;
        if (i == 0 && !new_numbers(l, t, t->count, v.count, out)) return false;
        if (v.boolean || v.rows || v.count != out->components) {
            COMPLAIN(l, &t->item[i]->at, "the entries of a list are all numbers, or all vectors of one length");
            return false;
        }
        const output target = {.to = {.dims = 1, .at = {{-1, -1, -1, (int32_t)i + 1}}}};
        if (!put_numbers(l, out, &target, v.item)) return false;
    }
    return true;
}

/* Finds the list that an argument names. */
static bool list_of(lowering *l, const tree *call, const tree *t, numbers *out)
{
    model *m = l->model;
    char text[80];
    if (known_numbers(m, t, out)) return true;
    if (t->kind == TREE_LIST) return literal_list(l, t, out);
    const bool name = t->kind == TREE_NAME && !t->index_count && !t->primes;
    model_definition *d = name && !lower_find_argument(l, t->name) && !lower_find_index(l, t->name)
                              ? symbols_find(m, t->name).definition
                              : NULL;
    if (d && d->kind == DEFINED_PARAMETER && !resolve_definition(m, d)) return false;
    if (!d || d->kind != DEFINED_PARAMETER || !d->list || d->dims != 1) {
        COMPLAIN(l, &t->at, "%s takes a list here, and %s is none", call->name, quote(l, &t->at, text));
        if (t->kind == TREE_NAME && (d = symbols_find(m, t->name).definition) && d->list)
            HINT(l,
                 d->dims == 1 ? "write %s: a table takes the whole list"
                              : "%s has several indices: write each row as a list of its own",
                 d->name);
        HINT(l, "write it as a line of its own: T = [0, 0.5, 2]");
        return false;
    }
    if (d->mode) {
        COMPLAIN(l, &t->at, "events assign %s, and a table has fixed numbers", d->name);
        return false;
    }
    *out = numbers_of(m, d->array, d->components);
    return true;
}

/* Computes the points of a uniform grid of `count` points: t0, t0 + dt, … */
static bool grid_of(lowering *l, const tree *call, size_t count, numbers *out)
{
    graph *g = l->model->graph;
    if (known_numbers(l->model, call, out)) return true;
    lowering inner;
    lower_start(&inner, l->model, PLACE_CONSTANT, "a point of a table");
    const node from = lower_scalar(&inner, call->item[1], "the first point of a table");
    const node by = failed(l) ? 0 : lower_scalar(&inner, call->item[2], "the distance of two points");
    if (failed(l) || !new_numbers(l, call, count, 0, out)) return false;
    const node number = binary(l, OP_SUB, graph_index(g, 0), graph_const(g, 1));
    const node point = binary(l, OP_ADD, from, binary(l, OP_MUL, by, number));
    const subscript one = {-1, -1, -1, 1}, last = {-1, -1, -1, (int32_t)count};
    const output target = {
        .loops = 1, .loop = {{one, last}}, .to = {.dims = 1, .at = {{.level = 0, .slot = -1, .modulus = -1}}}};
    return put_numbers(l, out, &target, &point);
}

/* Checks that points are numbers, and rise. distance: that of a uniform grid, or NULL. */
static bool check_points(lowering *l, const tree *t, const tree *distance, const numbers *of)
{
    const double *x = l->model->pool + l->model->arrays[of->array].base;
    char text[80];
    if (of->count < 2) {
        COMPLAIN(l, &t->at, "a table has two points or more");
        return false;
    }
    for (size_t k = 1; k < of->count; k++) {
        if (x[k] > x[k - 1]) continue;
        if (distance) {
            COMPLAIN(l, &distance->at, "the points of a table rise, but from %.17g on %s leads to %.17g", x[k - 1],
                     quote(l, &distance->at, text), x[k]);
            return false;
        }
        const long long at = (long long)of->first + (long long)k;
        source_complain(&l->model->source, MOTUS_ARGUMENT, &t->at,
                        "the points of a table rise, but in %s number %lld is %.17g and number %lld %.17g",
                        quote(l, &t->at, text), at - 1, x[k - 1], at, x[k]);
        if (l->model->source.error) snprintf(l->model->source.error->variable, MOTUS_NAME_MAX, "%.40s[%lld]", text, at);
        return false;
    }
    return true;
}

/* Returns whether a tree is a list, or the name of one. */
static bool is_list(const lowering *l, const tree *t)
{
    const bool name = t->kind == TREE_NAME && !t->index_count && !lower_find_argument(l, t->name);
    const model_definition *const d = name ? symbols_find(l->model, t->name).definition : NULL;
    return t->kind == TREE_LIST || (d && d->statement->value->kind == TREE_LIST);
}

value lower_table(lowering *l, const tree *t)
{
    model *m = l->model;
    graph *g = m->graph;
    const bool hold = t->primes != 0, uniform = t->count == 4;
    const tree *values = t->item[t->count - 1];
    numbers list, points;
    if (is_list(l, t->item[0]) || (uniform && is_list(l, t->item[1]))) {
        COMPLAIN(l, &t->at, "%s takes a number, and then the lists of a table", t->name);
        HINT(l,
             is_list(l, t->item[0]) ? "write %s(t, T, A)"
                                    : "write %s(t, T, A), or %s(t, T, A, hold) for the end values",
             t->name, t->name);
        return wrong(l);
    }
    const node u = lower_scalar(l, t->item[0], "the argument of a table");
    if (failed(l) || !list_of(l, t, values, &list)) return wrong(l);
    if (!(uniform ? grid_of(l, t, list.count, &points) : list_of(l, t, t->item[1], &points))) return wrong(l);
    if (points.components) COMPLAIN(l, &t->item[1]->at, "the points of a table are numbers, not vectors");
    if (!failed(l) && points.count != list.count)
        COMPLAIN(l, &t->at, "%zu points, but %zu values: a table has as many of both", points.count, list.count);
    if (failed(l) || !check_points(l, t->item[1], uniform ? t->item[2] : NULL, &points)) return wrong(l);

    const tree *last = t->item[uniform ? 2 : 1];
    const char *name = kept_text(l, t->at.text, t->item[1]->at.from, last->at.to);
    table rows = {.kind = TABLE_POINTS, .list = points.array, .points = points.array, .name = name};
    rows.hold = hold, rows.uniform = uniform;
    table of = rows;
    of.kind = t->operation == CALL_SPLINE ? TABLE_SPLINE : TABLE_LINEAR;
    of.name = kept_text(l, t->at.text, t->item[1]->at.from, t->at.to - 1);
    of.values = kept_text(l, t->at.text, values->at.from, values->at.to);
    const char *before = t->operation == CALL_SPLINE ? "spline(" : "interp(";
    if (!table_make(m, &rows, &rows.array)) return wrong(l);
    const node row = binary(l, OP_FIND, u, graph_table(g, rows.array));
    value v = vector(l, list.components);
    for (int k = 0; k < (v.count ? v.count : 1) && !failed(l); k++) {
        of.list = (uint16_t)(list.array + k);
        if (!table_make(m, &of, &of.array)) return wrong(l);
        v.item[k] = table_value(g, u, row, of.kind, graph_table(g, of.array));
        graph_name(g, v.item[k], u, before, of.name, v.count ? k + 1 : 0);
    }
    return v;
}

/* Moving indices --------------------------------------------------------------------------------------------------- */

bool lower_moves(const lowering *l, const tree *t)
{
    if (t->kind == TREE_NUMBER) return false;
    bool moves = false;
    if (t->kind == TREE_NAME) {
        const argument *a = lower_find_argument(l, t->name);
        if (a) return a->tree && lower_moves(a->caller, a->tree);
        if (lower_find_index(l, t->name)) return false;
        const symbol s = symbols_find(l->model, t->name);
        moves = s.state || !strcmp(t->name, "t");
        if (s.definition) moves |= s.definition->kind != DEFINED_PARAMETER || s.definition->mode;
    }
    if (t->kind == TREE_APPLY) {
        const symbol s = symbols_find(l->model, t->item[0]->name);
        moves = s.function ? s.function->moves : !s.state; /* what events keep moves; an initial value does not */
    }
    for (uint32_t k = t->kind == TREE_APPLY; k < t->count && !moves; k++) moves = lower_moves(l, t->item[k]);
    return moves;
}

value lower_entry(lowering *l, const tree *t, const model_definition *d)
{
    model *m = l->model;
    graph *g = m->graph;
    char text[80];
    node k = lower_scalar(l, t->item[0], "an index");
    if (failed(l)) return wrong(l);
    if (d->mode) {
        COMPLAIN(l, &t->at, "events assign %s, so its entries have numbers that do not move", d->name);
        return wrong(l);
    }
    if (!graph_flat(g, k)) {
        COMPLAIN(l, &t->item[0]->at, "an index is a whole number, and %s is not always one",
                 quote(l, &t->item[0]->at, text));
        HINT(l, "write %s[floor(%s)]", d->name, text);
        return wrong(l);
    }
    if (d->first[0] != 1) k = binary(l, OP_SUB, k, graph_const(g, (double)(d->first[0] - 1)));
    table of = {.kind = TABLE_LIST, .name = d->name};
    value v = vector(l, d->components);
    for (int c = 0; c < (v.count ? v.count : 1) && !failed(l); c++) {
        of.list = of.points = (uint16_t)(d->array + c);
        if (!table_make(m, &of, &of.array)) return wrong(l);
        v.item[c] = table_entry(g, k, of.kind, 0, graph_table(g, of.array));
    }
    return v;
}
