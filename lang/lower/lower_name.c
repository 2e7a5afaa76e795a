/* Names [4, 10]: states, parameters, lists and initial values become loads; quantities become their expressions. */
#include "lang/lower/lower_parts.h"

#include "lang/lower/hull.h"
#include "lang/lower/lower_ghost.h"
#include "lang/lower/resolve.h"
#include "lang/lower/start.h"
#include "lang/model/evaluate.h"
#include "lang/model/symbols.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Loads each component; their arrays are numbered from `first` on. */
static value load(lowering *l, uint16_t first, int components, const reference *at)
{
    value v = vector(l, components);
    for (int k = 0; k < (components ? components : 1); k++) {
        reference r = *at;
        r.array = (uint16_t)(first + k);
        v.item[k] = graph_load(l->model->graph, &r);
    }
    return v;
}

static bool subscripts(lowering *l, const tree *t, int dims, reference *r, int64_t low[], int64_t high[])
{
    r->dims = (uint8_t)dims;
    for (int d = 0; d < dims; d++)
        if (!lower_subscript(l, t->item[d], &r->at[d], &low[d], &high[d])) return false;
    return true;
}

/* Complains if a state is read at an index without an equation or a boundary line, or its highest derivative at one
 * without an equation. */
static bool covered(lowering *l, const model_state *s, const tree *t, const int64_t low[], const int64_t high[])
{
    bool derivative = t->primes == s->order;
    int64_t at[MAX_DIMS];
    bool outside = false, empty = false;
    for (int d = 0; d < s->dims; d++) {
        at[d] = low[d];
        empty |= low[d] > high[d];
        if (low[d] < s->first[d] || high[d] > s->last[d]) {
            outside = true;
            at[d] = low[d] < s->first[d] ? low[d] : high[d];
        }
    }
    if (empty) return true;
    while (!outside) {
        const size_t offset = model_cell(s->dims, s->first, s->last, at);
        if (!s->owner[offset] || (derivative && s->owner[offset] != 1)) break;
        if (!model_next_cell(s->dims, low, high, at)) return true;
    }
    char index[80] = "";
    size_t n = 0;
    for (int d = 0; d < s->dims && n < sizeof index; d++)
        n += (size_t)snprintf(index + n, sizeof index - n, "%s%lld", d ? "," : "", (long long)at[d]);
    if (derivative && !outside) {
        source_complain(&l->model->source, MOTUS_NAME, &t->at, "%s[%s]%s is used here, but has no equation", s->name,
                        index, s->order == 2 ? "''" : "'");
        HINT(l, "a boundary line gives its position, not its acceleration");
        return false;
    }
    source_complain(&l->model->source, MOTUS_NAME, &t->at,
                    "%s[%s] is used here, but has neither an equation nor a boundary line", s->name, index);
    HINT(l, "add a boundary line: %s[%s] = 0; or wrap the index: mod(i, N) + 1", s->name, index);
    return false;
}

value lower_component(lowering *l, value v, const tree *number, const tree *whole)
{
    if (failed(l)) return v;
    char shape[40], text[80];
    if (v.count == 0 || v.boolean) {
        COMPLAIN(l, &whole->at, "%s is %s and has no components",
                 quote(l, whole->item ? &whole->item[0]->at : &whole->at, text), shape_name(&v, shape));
        return v;
    }
    node n = lower_scalar(l, number, "the number of a component");
    double k;
    if (failed(l) || !evaluate_number(l->model, n, &number->at, NULL, &k)) return v;
    if (k != floor(k) || k < 1 || k > v.count) {
        COMPLAIN(l, &number->at, "this vector has the components 1 to %d, not %g", v.count, k);
        return v;
    }
    return scalar(l, v.item[(int)k - 1]);
}

static void place_error(lowering *l, const tree *t, const char *is)
{
    COMPLAIN(l, &t->at, "%s cannot depend on %s: %s is %s", l->what, is, t->name, is);
    if (!strcmp(l->what, "until")) HINT(l, "to end the run where something happens write: when %s < 0: stop", t->name);
    if (l->place == PLACE_CONSTANT && l->what && !strcmp(l->what, "an initial value"))
        HINT(l, "an initial value may use parameters and other initial values, such as %s(0)", t->name);
}

static value lower_state(lowering *l, const tree *t, model_state *s)
{
    if (l->place == PLACE_CONSTANT || l->place == PLACE_EXACT || l->place == PLACE_BOUNDARY) {
        place_error(l, t, "a state");
        return wrong(l);
    }
    if (t->primes > s->order) {
        COMPLAIN(l, &t->at, "%s has an equation of first order: %s'' is not known", s->name, s->name);
        return wrong(l);
    }
    if (!start_state(l->model, s)) return wrong(l);
    reference r = {0};
    int64_t low[MAX_DIMS], high[MAX_DIMS];
    bool select = s->dims == 0 && t->index_count == 1 && s->components > 0;
    if (!select && (int)t->index_count != s->dims) {
        if (s->dims == 0)
            COMPLAIN(l, &t->at, "%s is one %s, not a family with an index", s->name,
                     s->components ? "vector" : "number");
        else
            COMPLAIN(l, &t->at, "%s is a family and needs %d ind%s", s->name, s->dims, s->dims == 1 ? "ex" : "ices");
        if (s->dims == 1) HINT(l, "write %s[i]; a sum over all: sum(i = 1..N: …)", s->name);
        return wrong(l);
    }
    if (select && t->primes) {
        COMPLAIN(l, &t->at, "primes stand before the number of a component");
        HINT(l, "write %s%s[…]", s->name, t->primes == 1 ? "'" : "''");
        return wrong(l);
    }
    if (!select && (!subscripts(l, t, s->dims, &r, low, high) || (s->dims > 0 && !covered(l, s, t, low, high))))
        return wrong(l);
    if (t->primes == s->order && l->place != PLACE_QUANTITY) return lower_rate(l, t, s, &r, low, high);
    value ghost;
    if (!select && s->ghosts && lower_ghost(l, t, s, &r, low, high, &ghost)) return ghost;
    /* a first-order variable and its rate are in V and A; a position, its velocity and acceleration in X, V and A */
    int block = t->primes + (s->order == 1 ? BLOCK_V : BLOCK_X);
    value v = load(l, (uint16_t)(l->model->block[block] + s->array), s->components, &r);
    return select ? lower_component(l, v, t->item[0], t) : v;
}

/* Returns the first array of a list, or of its mode. */
static uint16_t numbers_of(const lowering *l, const model_definition *d, bool start)
{
    return d->mode && !start ? (uint16_t)(l->model->block[BLOCK_X] + l->model->states[d->mode - 1].array) : d->array;
}

/* Loads all entries of a matrix. */
static value whole_matrix(lowering *l, const model_definition *d, uint16_t array)
{
    const int rows = (int)d->last[0], columns = (int)d->last[1];
    value v = vector(l, rows * columns);
    for (int k = 0; k < rows * columns && !failed(l); k++) {
        reference r = {.array = array, .dims = 2};
        r.at[0] = (subscript){.level = -1, .slot = -1, .modulus = -1, .literal = 1 + k / columns};
        r.at[1] = (subscript){.level = -1, .slot = -1, .modulus = -1, .literal = 1 + k % columns};
        v.item[k] = graph_load(l->model->graph, &r);
    }
    v.count = columns;
    v.rows = rows;
    return v;
}

static value lower_list(lowering *l, const tree *t, model_definition *d, bool start)
{
    const uint16_t first = numbers_of(l, d, start);
    if (!t->index_count && d->dims == 2 && d->statement->value->kind == TREE_LIST) return whole_matrix(l, d, first);
    if ((int)t->index_count != d->dims) {
        COMPLAIN(l, &t->at, "%s is a list and needs %d ind%s", d->name, d->dims, d->dims == 1 ? "ex" : "ices");
        HINT(l, "write %s[1] or %s[i]", d->name, d->name);
        return wrong(l);
    }
    if (d->dims == 1 && lower_moves(l, t->item[0])) return lower_entry(l, t, d);
    reference r = {0};
    int64_t low[MAX_DIMS], high[MAX_DIMS];
    if (!subscripts(l, t, d->dims, &r, low, high)) return wrong(l);
    for (int k = 0; k < d->dims; k++)
        if (low[k] <= high[k] && (low[k] < d->first[k] || high[k] > d->last[k])) {
            source_complain(&l->model->source, MOTUS_NAME, &t->item[k]->at,
                            "%s[%lld] is used here, but %s has the places %lld to %lld", d->name,
                            (long long)(low[k] < d->first[k] ? low[k] : high[k]), d->name, (long long)d->first[k],
                            (long long)d->last[k]);
            return wrong(l);
        }
    return load(l, first, d->components, &r);
}

/* Returns whether a mode stands for its start here, as a parameter; complains if only its present value could be
 * meant. */
static bool mode_starts(lowering *l, const tree *t, const model_definition *d)
{
    if (!d->mode || (l->place != PLACE_CONSTANT && l->place != PLACE_EXACT)) return false;
    if (l->place == PLACE_CONSTANT && l->what &&
        (!strcmp(l->what, "an initial value") || !strcmp(l->what, "a parameter")))
        return true;
    COMPLAIN(l, &t->at, "%s cannot depend on %s: events assign it", l->what ? l->what : "this", d->name);
    return false;
}

/* Lowers a quantity with indices: its expression, with the subscripts in place of its indices. */
static value lower_quantity_family(lowering *l, const tree *t, model_definition *d)
{
    const statement *s = d->statement;
    if ((int)t->index_count != d->dims) {
        COMPLAIN(l, &t->at, "%s is a family and needs %d ind%s", d->name, d->dims, d->dims == 1 ? "ex" : "ices");
        return wrong(l);
    }
    lowering inner = *l;
    inner.name_count = 0;
    inner.argument_count = 0;
    inner.chain++;
    if (inner.chain > MAX_LEVELS * 4) {
        source_complain(&l->model->source, MOTUS_LIMIT, &t->at, "families of quantities use one another too deeply");
        return wrong(l);
    }
    for (int k = 0; k < d->dims; k++) {
        index_name *n = &inner.names[inner.name_count];
        *n = (index_name){0};
        if (!lower_subscript(l, t->item[k], &n->at, &n->first, &n->last)) return wrong(l);
        if (n->first <= n->last && (n->first < d->first[k] || n->last > d->last[k])) {
            source_complain(&l->model->source, MOTUS_NAME, &t->item[k]->at,
                            "%s[%lld] is used here, but %s is defined for %lld to %lld", d->name,
                            (long long)(n->first < d->first[k] ? n->first : n->last), d->name, (long long)d->first[k],
                            (long long)d->last[k]);
            return wrong(l);
        }
        n->constant = n->at.slot >= 0 ? l->model->int_nodes[n->at.slot] : 0;
        n->number = lower_subscript_number(l, &n->at);
        const tree *name = s->index[k];
        if (name->kind == TREE_NAME) {
            n->name = name->name;
            inner.name_count++;
        }
    }
    return lower_expression(&inner, s->value);
}

static value lower_definition(lowering *l, const tree *t, model_definition *d)
{
    if (t->primes) {
        source_complain(&l->model->source, MOTUS_NAME, &t->at, "%s is a %s and has no primes", d->name,
                        d->kind == DEFINED_PARAMETER ? "parameter" : "quantity");
        if (d->kind != DEFINED_PARAMETER)
            HINT(l, "its slope is that of a function: %s(q) = …, and diff(%s(x), x); an equation %s' = … makes a state",
                 d->name, d->name, d->name);
        HINT(l, "an equation %s%s = … would make it a state", d->name, t->primes == 2 ? "''" : "'");
        return wrong(l);
    }
    if (d->kind != DEFINED_PARAMETER && l->place == PLACE_CONSTANT) {
        COMPLAIN(l, &t->at, "%s is constant, but %s depends on a state or on time", l->what, d->name);
        return wrong(l);
    }
    if (d->progress == 1) {
        source_complain(&l->model->source, MOTUS_NAME, &t->at, "%s is defined by itself, in a circle", d->name);
        return wrong(l);
    }
    if (l->chain > MODEL_CHAIN_MAX) {
        source_complain(&l->model->source, MOTUS_LIMIT, &t->at, "definitions use one another more than %d deep",
                        MODEL_CHAIN_MAX);
        return wrong(l);
    }
    if (d->kind != DEFINED_PARAMETER && d->statement->loop_count > 0) {
        if (!resolve_definition(l->model, d)) return wrong(l);
        return lower_quantity_family(l, t, d);
    }
    /* a quantity is lowered where it is used, because that place decides what it may depend on */
    if (d->kind != DEFINED_PARAMETER) {
        lowering inner = *l;
        inner.name_count = 0;
        inner.argument_count = 0;
        inner.chain++;
        if (!d->known)
            d->known = arena_take(l->model->arena, (PLACE_QUANTITY + 1) * (MAX_LEVELS + 1) * sizeof *d->known);
        value **known = &d->known[(int)l->place * (MAX_LEVELS + 1) + l->levels];
        if (failed(l)) return wrong(l);
        if (*known) return t->index_count == 1 ? lower_component(l, **known, t->item[0], t) : **known;
        if (d->dims) {
            COMPLAIN(l, &d->statement->at, "a quantity with an index ranges over it");
            HINT(l, "add: for i = 1..N");
            return wrong(l);
        }
        d->progress = 1;
        value v = lower_expression(&inner, d->statement->value);
        d->progress = 0;
        value *keep = arena_take(l->model->arena, sizeof *keep);
        *keep = v;
        *known = keep;
        return t->index_count == 1 && !failed(l) ? lower_component(l, v, t->item[0], t) : v;
    }
    if (!resolve_definition(l->model, d)) return wrong(l);
    const bool start = mode_starts(l, t, d);
    if (failed(l)) return wrong(l);
    if (d->list) return lower_list(l, t, d, start);
    value v;
    if (d->mode && !start) {
        v = load(l, numbers_of(l, d, false), d->components, &(reference){0});
    } else {
        v = vector(l, d->components);
        for (int k = 0; k < (d->components ? d->components : 1) && !failed(l); k++)
            v.item[k] = graph_param(l->model->graph, d->slot + (uint32_t)k);
    }
    if (t->index_count > 1 || (t->index_count == 1 && d->components == 0)) {
        COMPLAIN(l, &t->at, "%s is %s and takes no such index", d->name, d->components ? "a vector" : "one number");
        return wrong(l);
    }
    return t->index_count == 1 ? lower_component(l, v, t->item[0], t) : v;
}

static value lower_use(lowering *l, const tree *t, argument *a)
{
    if (t->primes) {
        COMPLAIN(l, &t->at, "%s is an argument and takes no primes", t->name);
        HINT(l, "pass the velocity as an argument of its own");
        return wrong(l);
    }
    if (t->index_count > 1) {
        COMPLAIN(l, &t->at, "%s is an argument and takes no such index", t->name);
        return wrong(l);
    }
    value v = lower_argument(l, a);
    return t->index_count == 1 && !failed(l) ? lower_component(l, v, t->item[0], t) : v;
}

/* Lowers a name. names.c has checked that every name is defined. */
value lower_name(lowering *l, const tree *t)
{
    argument *hides = lower_find_argument(l, t->name);
    if (hides) return lower_use(l, t, hides);
    const index_name *index = lower_find_index(l, t->name);
    if (index) {
        if (t->primes || t->index_count)
            COMPLAIN(l, &t->at, "%s is an index: it takes no primes and no index", t->name);
        return scalar(l, index->number);
    }
    const bool time = !strcmp(t->name, l->model->time);
    if (time || !strcmp(t->name, "pi")) {
        if (t->primes || t->index_count) COMPLAIN(l, &t->at, "%s takes no primes and no index", t->name);
        if (!time) return lower_pi(l);
        if (l->place == PLACE_CONSTANT) {
            COMPLAIN(l, &t->at, "%s is constant and cannot depend on the time %s", l->what, t->name);
            return wrong(l);
        }
        return scalar(l, graph_time(l->model->graph));
    }
    symbol s = symbols_find(l->model, t->name);
    if (s.state) return lower_state(l, t, s.state);
    if (s.definition) return lower_definition(l, t, s.definition);
    /* an index or an argument of the line in which this constant stands */
    if (!failed(l)) COMPLAIN(l, &t->at, "%s is fixed and cannot depend on %s", l->what, t->name);
    return wrong(l);
}

/* Lowers an initial value: x(0), r'(0), x[i](0) [4]. */
value lower_initial(lowering *l, const tree *t)
{
    const tree *name = t->item[0], *bracket = t->item[1];
    symbol s = symbols_find(l->model, name->name);
    char a[80];
    if (name->primes >= s.state->order) {
        COMPLAIN(l, &t->at, "%s at the start follows from its equation; it is not an initial value",
                 quote(l, &name->at, a));
        return wrong(l);
    }
    lowering inner = *l;
    inner.place = PLACE_QUANTITY;
    node n = lower_scalar(&inner, bracket, "the start");
    if (failed(l)) return wrong(l);
    if (graph_deps(l->model->graph, n) & (DEP_TIME | DEP_STATE | DEP_LEVELS)) {
        COMPLAIN(l, &t->at, "%s is a state, not a function", name->name);
        HINT(l, "write %s for its value now, %s*(…) for a product; the motion cannot depend on past values", name->name,
             name->name);
        return wrong(l);
    }
    double at;
    if (!resolve_start_time(l->model) || !evaluate_number(l->model, n, &bracket->at, "the start", &at)) return wrong(l);
    if (at != l->model->start) {
        COMPLAIN(l, &t->at, "%s is an initial value, and the start is %g", quote(l, &t->at, a), l->model->start);
        HINT(l, "for a product write %s*(…)", name->name);
        return wrong(l);
    }
    reference r = {0};
    int64_t low[MAX_DIMS], high[MAX_DIMS];
    if ((int)name->index_count != s.state->dims) {
        hull_indices_wrong(l->model, s.state, name->at);
        return wrong(l);
    }
    if (!hull_find(l->model, s.state) || !subscripts(l, name, s.state->dims, &r, low, high) ||
        (s.state->dims && !covered(l, s.state, name, low, high)) ||
        !start_cells(l->model, s.state, name->primes, low, high))
        return wrong(l);
    return load(l, s.state->start_array[name->primes], s.state->components, &r);
}
