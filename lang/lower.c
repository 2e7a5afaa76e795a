/* From trees to nodes. See lower.h. Long chains of operators lean left and are walked in a loop; everything else recurses as deep as
 * the parser allowed. */
#include "lang/lower.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define COMPLAIN(l, at, ...) (source_complain(&(l)->model->source, MOTUS_SHAPE, (at), __VA_ARGS__))
#define HINT(l, ...) (source_hint(&(l)->model->source, __VA_ARGS__))

static bool failed(const lowering *l) { return source_failed(&l->model->source) || l->model->graph->too_large; }

static const char *quote(const lowering *l, span at, char out[80]) { return source_excerpt(&l->model->source, at, out, 80); }

void lower_start(lowering *l, model *m, lower_place place, const char *what)
{
    *l = (lowering){.model = m, .place = place, .what = what, .terms = 1};
}

static value scalar(lowering *l, node n)
{
    value v = {.item = arena_take(l->model->arena, sizeof(node))};
    v.item[0] = n;
    return v;
}

static value condition(lowering *l, node n)
{
    value v = scalar(l, n);
    v.boolean = true;
    return v;
}

static value vector(lowering *l, int count)
{
    value v = {.count = count};
    size_t bytes = sizeof(node) * (size_t)(count ? count : 1);
    v.item = bytes <= ARENA_SPARE ? arena_take(l->model->arena, bytes) : arena_grow(l->model->arena, NULL, 0, bytes);
    if (!v.item) {
        v.item = arena_take(l->model->arena, ARENA_SPARE);
        v.count = 0;
    }
    return v;
}

static value wrong(lowering *l) { return scalar(l, 0); }

static node binary(lowering *l, operation op, node a, node b) { return graph_op(l->model->graph, op, a, b, 0); }

static const char *shape_name(value v, char out[40])
{
    if (v.boolean)
        return "a condition";
    if (v.count == 0)
        return "a number";
    snprintf(out, 40, "a vector of length %d", v.count);
    return out;
}

static bool want_number(lowering *l, value v, const tree *t)
{
    if (!v.boolean || failed(l))
        return !failed(l);
    COMPLAIN(l, t->at, "a condition stands here where a number is due");
    HINT(l, "write if(condition, 1, 0)");
    return false;
}

node lower_scalar(lowering *l, const tree *t, const char *what)
{
    value v = lower_expression(l, t);
    char shape[40];
    if (!failed(l) && (v.count > 0 || v.boolean))
        COMPLAIN(l, t->at, "%s is a number, but this is %s", what, shape_name(v, shape));
    return failed(l) ? 0 : v.item[0];
}

/* ---- names of indices, and subscripts [11] ---- */

static const index_name *find_index(const lowering *l, const char *name)
{
    for (int i = l->name_count - 1; i >= 0; i--)
        if (!strcmp(l->names[i].name, name))
            return &l->names[i];
    return NULL;
}

typedef struct affine {              /* an index expression taken apart */
    const index_name *name;
    int64_t literal;
    node constant;
    bool wrapped;                    /* mod(inner, modulus), `literal` then stands outside */
    subscript inner;
    int64_t modulus;
} affine;

static void not_affine(lowering *l, const tree *t)
{
    COMPLAIN(l, t->at, "an index is i + c or mod(i + c, N) + 1 with a constant c");
}

static void take_apart(lowering *l, const tree *t, int sign, affine *a);

static void take_mod(lowering *l, const tree *t, int sign, affine *a)
{
    if (sign < 0 || a->name || a->wrapped) {
        not_affine(l, t);
        return;
    }
    int64_t low, high;
    if (!lower_subscript(l, t->item[0], &a->inner, &low, &high))
        return;
    node n = lower_scalar(l, t->item[1], "the second argument of mod");
    int slot = failed(l) ? -1 : resolve_int(l->model, n, t->item[1]->at, &a->modulus);
    if (slot < 0)
        return;
    if (a->modulus < 1) {
        COMPLAIN(l, t->item[1]->at, "an index wraps around at least 1 place, not %lld", (long long)a->modulus);
        return;
    }
    /* mod(mod(b, N) + 1 + c, N) is mod(b + 1 + c, N): only equal moduli can be joined. */
    if (a->inner.modulus >= 0) {
        if (a->inner.modulus != slot) {
            not_affine(l, t);
            return;
        }
        a->inner.literal += 1;
    }
    a->inner.modulus = (int16_t)slot;
    a->wrapped = true;
}

static void take_constant(lowering *l, const tree *t, int sign, affine *a)
{
    node n = lower_scalar(l, t, "an index");
    if (failed(l))
        return;
    unsigned deps = graph_deps(l->model->graph, n);
    if (deps & (DEP_LEVELS | DEP_TIME | DEP_STATE | DEP_D)) {
        if (deps & DEP_LEVELS)
            not_affine(l, t);
        else
            COMPLAIN(l, t->at, "an index cannot depend on a state or on time");
        return;
    }
    const graph_node *g = graph_at(l->model->graph, n);
    if (g->op == OP_CONST) {
        if (fabs(g->value) > 1e9) {
            source_complain(&l->model->source, MOTUS_LIMIT, t->at, "an index is at most 1e9, and this is %g", g->value);
            return;
        }
        if (g->value != floor(g->value)) {
            COMPLAIN(l, t->at, "an index is a whole number, not %g", g->value);
            return;
        }
        a->literal += sign * (int64_t)g->value;
        return;
    }
    graph *gr = l->model->graph;
    if (a->constant)
        a->constant = graph_op(gr, sign < 0 ? OP_SUB : OP_ADD, a->constant, n, 0);
    else
        a->constant = sign < 0 ? graph_op(gr, OP_NEG, n, 0, 0) : n;
}

static void take_apart(lowering *l, const tree *t, int sign, affine *a)
{
    while (!failed(l)) {
        if (t->kind == TREE_ADD || t->kind == TREE_SUBTRACT) {
            take_apart(l, t->item[1], t->kind == TREE_ADD ? sign : -sign, a);
            t = t->item[0];
            continue;
        }
        if (t->kind == TREE_NEGATE) {
            sign = -sign;
            t = t->item[0];
            continue;
        }
        const index_name *name = t->kind == TREE_NAME && t->index_count == 0 && t->primes == 0 ? find_index(l, t->name) : NULL;
        if (name) {
            if (sign < 0 || a->name || a->wrapped)
                not_affine(l, t);
            a->name = name;
        } else if (t->kind == TREE_CALL && t->operation == OP_MOD) {
            take_mod(l, t, sign, a);
        } else {
            take_constant(l, t, sign, a);
        }
        return;
    }
}

bool lower_subscript(lowering *l, const tree *t, subscript *out, int64_t *first, int64_t *last)
{
    affine a = {0};
    *out = (subscript){.level = -1, .slot = -1, .modulus = -1};
    *first = *last = 0;
    take_apart(l, t, 1, &a);
    if (failed(l))
        return false;
    if (a.wrapped) {
        if (a.literal != 1 || a.constant) {
            COMPLAIN(l, t->at, "indices count from 1: a wrapped index is mod(…, N) + 1");
            return false;
        }
        *out = a.inner;
        *first = 1;
        *last = a.modulus;
        return true;
    }
    if (a.name) {
        *out = a.name->at;
        *first = a.name->first;
        *last = a.name->last;
        if (out->modulus >= 0 && (a.literal || a.constant)) {
            not_affine(l, t);
            return false;
        }
        if (a.name->constant)
            a.constant = a.constant ? binary(l, OP_ADD, a.name->constant, a.constant) : a.name->constant;
    }
    int64_t shift = a.literal;
    if (a.constant) {
        int64_t value;
        int slot = resolve_int(l->model, a.constant, t->at, &value);
        if (slot < 0)
            return false;
        out->slot = (int16_t)slot;
        shift += value;
        if (a.name && a.name->constant) {            /* first and last count it already */
            int64_t before;
            if (resolve_int(l->model, a.name->constant, t->at, &before) < 0)
                return false;
            shift -= before;
        }
    }
    if (llabs(a.literal) > 1000000000 || llabs(out->literal + a.literal) > 1000000000) {
        source_complain(&l->model->source, MOTUS_LIMIT, t->at, "an index is at most 1e9");
        return false;
    }
    out->literal += (int32_t)a.literal;
    *first += shift;
    *last += shift;
    return !failed(l);
}

static bool add_index(lowering *l, const loop *loop, int level, int64_t first, int64_t last)
{
    if (find_index(l, loop->name)) {
        COMPLAIN(l, loop->at, "the index %s is used twice", loop->name);
        HINT(l, "take another letter for the inner one");
        return false;
    }
    symbol s = symbols_find(l->model, loop->name);
    if (s.state || s.definition) {
        source_complain(&l->model->source, MOTUS_NAME, loop->at, "%s is defined already and cannot be an index besides", loop->name);
        HINT(l, "take another letter for the index");
        return false;
    }
    index_name *n = &l->names[l->name_count++];
    *n = (index_name){.name = loop->name, .at = {.level = (int8_t)level, .slot = -1, .modulus = -1}, .first = first, .last = last,
                      .number = graph_index(l->model->graph, level)};
    l->low[level] = first;
    l->high[level] = last;
    return true;
}

/* The range of a loop: [*low, *high] holds every value it can take, whatever outer indices do. */
static bool lower_range(lowering *l, const loop *loop, range *out, int64_t *low, int64_t *high)
{
    int64_t first_high, last_low;
    if (!lower_subscript(l, loop->first, &out->first, low, &first_high) || !lower_subscript(l, loop->last, &out->last, &last_low, high))
        return false;
    if (out->first.modulus >= 0 || out->last.modulus >= 0) {
        COMPLAIN(l, loop->at, "the bounds of an index are not wrapped");
        return false;
    }
    return true;
}

bool lower_target(lowering *l, const statement *s, output *out)
{
    out->to.dims = (uint8_t)s->index_count;
    out->loops = 0;
    bool used[MAX_DIMS] = {false};
    for (uint32_t d = 0; d < s->index_count; d++) {
        const tree *t = s->index[d];
        int which = -1;
        for (uint32_t k = 0; k < s->loop_count && t->kind == TREE_NAME && !t->primes && !t->index_count; k++)
            if (!strcmp(s->loops[k].name, t->name))
                which = (int)k;
        if (which >= 0 && used[which]) {
            COMPLAIN(l, t->at, "the index %s stands twice on the left side", t->name);
            return false;
        }
        if (which < 0) {
            int64_t first, last;
            if (t->kind == TREE_NAME && !symbols_find(l->model, t->name).definition && !symbols_find(l->model, t->name).state) {
                source_complain(&l->model->source, MOTUS_NAME, t->at, "where does %s range?", t->name);
                HINT(l, "add: for %s = 1..N", t->name);
                return false;
            }
            for (uint32_t k = 0; k < s->loop_count; k++)
                if (t->kind != TREE_NUMBER && t->count > 0 && t->item[0]->kind == TREE_NAME && t->item[0]->name &&
                    !strcmp(t->item[0]->name, s->loops[k].name)) {
                    COMPLAIN(l, t->at, "on the left side stands the index alone");
                    HINT(l, "write %s[%s] … and shift the bounds", s->name, s->loops[k].name);
                    return false;
                }
            if (!lower_subscript(l, t, &out->to.at[d], &first, &last))
                return false;
            continue;
        }
        used[which] = true;
        range r;
        int64_t low, high;
        lowering plain;
        lower_start(&plain, l->model, PLACE_CONSTANT, "a bound");
        if (!lower_range(&plain, &s->loops[which], &r, &low, &high))
            return false;
        if (low > high) {
            source_complain(&l->model->source, MOTUS_ARGUMENT, s->loops[which].at, "the index %s runs over nothing: from %lld to %lld",
                            s->loops[which].name, (long long)low, (long long)high);
            return false;
        }
        if ((double)high - (double)low >= MODEL_NUMBERS_MAX) {
            source_complain(&l->model->source, MOTUS_LIMIT, s->loops[which].at, "%.0f places are more than the %d that fit",
                            (double)high - (double)low + 1, MODEL_NUMBERS_MAX);
            return false;
        }
        out->loop[out->loops] = r;
        out->to.at[d] = (subscript){.level = (int8_t)out->loops, .slot = -1, .modulus = -1};
        if (!add_index(l, &s->loops[which], out->loops, low, high))
            return false;
        l->terms *= (double)(high - low + 1);
        out->loops++;
    }
    l->levels = out->loops;
    for (uint32_t k = 0; k < s->loop_count; k++)
        if (!used[k]) {
            COMPLAIN(l, s->loops[k].at, "the index %s does not stand on the left side", s->loops[k].name);
            HINT(l, "write %s[%s] … or remove the for", s->name, s->loops[k].name);
            return false;
        }
    if (l->terms > MODEL_NUMBERS_MAX) {
        source_complain(&l->model->source, MOTUS_LIMIT, s->at, "%.0f places are more than the %d that fit", l->terms, MODEL_NUMBERS_MAX);
        return false;
    }
    return !failed(l);
}

/* ---- places ---- */

/* Loads one component each of `count` arrays from number `first` on. */
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
        if (!lower_subscript(l, t->item[d], &r->at[d], &low[d], &high[d]))
            return false;
    return true;
}

/* Every index that a state is read at has an equation or a boundary line; its highest derivative, an equation. */
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
    if (empty)
        return true;
    bool ok = !outside;
    while (ok) {
        size_t offset = 0;
        for (int d = 0; d < s->dims; d++)
            offset = offset * (size_t)(s->last[d] - s->first[d] + 1) + (size_t)(at[d] - s->first[d]);
        if (!s->owner[offset] || (derivative && s->owner[offset] != 1)) {
            ok = false;
            break;
        }
        int d = s->dims - 1;
        while (d >= 0 && ++at[d] > high[d]) {
            at[d] = low[d];
            d--;
        }
        if (d < 0)
            return true;
    }
    char index[80] = "";
    size_t n = 0;
    for (int d = 0; d < s->dims && n < sizeof index; d++)
        n += (size_t)snprintf(index + n, sizeof index - n, "%s%lld", d ? "," : "", (long long)at[d]);
    if (derivative && !outside) {
        source_complain(&l->model->source, MOTUS_NAME, t->at, "%s[%s]%s is used here, but has no equation", s->name, index, s->order == 2 ? "''" : "'");
        HINT(l, "a boundary line says where it is, not how it is driven");
        return false;
    }
    source_complain(&l->model->source, MOTUS_NAME, t->at, "%s[%s] is used here, but has neither an equation nor a boundary line", s->name, index);
    HINT(l, "add a boundary line: %s[%s] = 0; or wrap the index: mod(i, N) + 1", s->name, index);
    return false;
}

static value component_of(lowering *l, value v, const tree *number, const tree *whole)
{
    if (failed(l))
        return v;
    char shape[40], text[80];
    if (v.count == 0 || v.boolean) {
        COMPLAIN(l, whole->at, "%s is %s and has no components", quote(l, whole->item ? whole->item[0]->at : whole->at, text), shape_name(v, shape));
        return v;
    }
    node n = lower_scalar(l, number, "the number of a component");
    double k;
    if (failed(l) || !resolve_number(l->model, n, number->at, &k))
        return v;
    if (k != floor(k) || k < 1 || k > v.count) {
        COMPLAIN(l, number->at, "this vector has the components 1 to %d, not %g", v.count, k);
        return v;
    }
    return scalar(l, v.item[(int)k - 1]);
}

static void place_error(lowering *l, const tree *t, const char *is)
{
    COMPLAIN(l, t->at, "%s cannot depend on %s: %s is %s", l->what, is, t->name, is);
    if (l->place == PLACE_CONSTANT && l->what && strstr(l->what, "initial"))
        HINT(l, "an initial value may use parameters and other initial values, such as %s(0)", t->name);
}

static value lower_state(lowering *l, const tree *t, model_state *s)
{
    char text[80];
    if (l->place == PLACE_CONSTANT || l->place == PLACE_EXACT || l->place == PLACE_BOUNDARY) {
        place_error(l, t, "a state");
        return wrong(l);
    }
    if (t->primes > s->order) {
        COMPLAIN(l, t->at, "%s has an equation of first order: %s'' is not known", s->name, s->name);
        return wrong(l);
    }
    if (t->primes == s->order && l->place != PLACE_QUANTITY) {
        COMPLAIN(l, t->at, "%s stands on the right side of an equation", quote(l, t->at, text));
        HINT(l, "solve the equations for the highest derivatives; %s may stand in quantities and invariants", text);
        return wrong(l);
    }
    if (!start_state(l->model, s))
        return wrong(l);
    reference r = {0};
    int64_t low[MAX_DIMS], high[MAX_DIMS];
    bool select = s->dims == 0 && t->index_count == 1 && s->components > 0;
    if (!select && (int)t->index_count != s->dims) {
        if (s->dims == 0)
            COMPLAIN(l, t->at, "%s is one %s, not a family with an index", s->name, s->components ? "vector" : "number");
        else
            COMPLAIN(l, t->at, "%s is a family and needs %d ind%s", s->name, s->dims, s->dims == 1 ? "ex" : "ices");
        if (s->dims == 1)
            HINT(l, "write %s[i]; a sum over all: sum(i = 1..N: …)", s->name);
        return wrong(l);
    }
    if (select && t->primes) {
        COMPLAIN(l, t->at, "primes stand before the number of a component");
        HINT(l, "write %s%s[…]", s->name, t->primes == 1 ? "'" : "''");
        return wrong(l);
    }
    if (!select && (!subscripts(l, t, s->dims, &r, low, high) || (s->dims > 0 && !covered(l, s, t, low, high))))
        return wrong(l);
    /* A companion's value lies in V and its derivative in A; a position in X, then V, then A. */
    int block = t->primes + (s->order == 1 ? BLOCK_V : BLOCK_X);
    value v = load(l, (uint16_t)(l->model->block[block] + s->array), s->components, &r);
    return select ? component_of(l, v, t->item[0], t) : v;
}

static value lower_list(lowering *l, const tree *t, model_definition *d)
{
    if ((int)t->index_count != d->dims) {
        COMPLAIN(l, t->at, "%s is a list and needs %d ind%s", d->name, d->dims, d->dims == 1 ? "ex" : "ices");
        HINT(l, "write %s[1] or %s[i]", d->name, d->name);
        return wrong(l);
    }
    reference r = {0};
    int64_t low[MAX_DIMS], high[MAX_DIMS];
    if (!subscripts(l, t, d->dims, &r, low, high))
        return wrong(l);
    for (int k = 0; k < d->dims; k++)
        if (low[k] <= high[k] && (low[k] < d->first[k] || high[k] > d->last[k])) {
            source_complain(&l->model->source, MOTUS_NAME, t->item[k]->at, "%s[%lld] is used here, but %s has the places %lld to %lld", d->name,
                            (long long)(low[k] < d->first[k] ? low[k] : high[k]), d->name, (long long)d->first[k], (long long)d->last[k]);
            return wrong(l);
        }
    return load(l, d->array, d->components, &r);
}

/* A quantity of a family is its expression with other indices put in. */
static value lower_quantity_family(lowering *l, const tree *t, model_definition *d)
{
    const statement *s = d->statement;
    if ((int)t->index_count != d->dims) {
        COMPLAIN(l, t->at, "%s is a family and needs %d ind%s", d->name, d->dims, d->dims == 1 ? "ex" : "ices");
        return wrong(l);
    }
    lowering inner = *l;
    inner.name_count = 0;
    inner.chain++;
    if (inner.chain > MAX_LEVELS * 4) {
        source_complain(&l->model->source, MOTUS_LIMIT, t->at, "families of quantities use one another too deeply");
        return wrong(l);
    }
    for (int k = 0; k < d->dims; k++) {
        index_name *n = &inner.names[inner.name_count];
        *n = (index_name){0};
        if (!lower_subscript(l, t->item[k], &n->at, &n->first, &n->last))
            return wrong(l);
        if (n->first <= n->last && (n->first < d->first[k] || n->last > d->last[k])) {
            source_complain(&l->model->source, MOTUS_NAME, t->item[k]->at, "%s[%lld] is used here, but %s is defined for %lld to %lld", d->name,
                            (long long)(n->first < d->first[k] ? n->first : n->last), d->name, (long long)d->first[k], (long long)d->last[k]);
            return wrong(l);
        }
        graph *g = l->model->graph;
        n->constant = n->at.slot >= 0 ? l->model->int_nodes[n->at.slot] : 0;
        n->number = n->at.level >= 0 ? graph_index(g, n->at.level) : graph_const(g, 0);
        if (n->at.literal)
            n->number = n->at.level >= 0 || n->constant ? binary(l, OP_ADD, n->number, graph_const(g, n->at.literal)) : graph_const(g, n->at.literal);
        if (n->constant)
            n->number = n->at.level >= 0 || n->at.literal ? binary(l, OP_ADD, n->number, n->constant) : n->constant;
        if (n->at.modulus >= 0)
            n->number = binary(l, OP_ADD, binary(l, OP_MOD, n->number, l->model->int_nodes[n->at.modulus]), graph_const(g, 1));
        const tree *name = s->index[k];
        if (name->kind == TREE_NAME) {
            n->name = name->name;
            inner.name_count++;
        }
    }
    value v = lower_expression(&inner, s->value);
    return v;
}

static value lower_definition(lowering *l, const tree *t, model_definition *d)
{
    if (t->primes) {
        source_complain(&l->model->source, MOTUS_NAME, t->at, "%s is a %s and has no primes", d->name,
                        d->kind == DEFINED_PARAMETER ? "parameter" : "quantity");
        HINT(l, "an equation %s%s = … would make it a state", d->name, t->primes == 2 ? "''" : "'");
        return wrong(l);
    }
    if (d->kind != DEFINED_PARAMETER && l->place == PLACE_CONSTANT) {
        COMPLAIN(l, t->at, "%s is constant, but %s depends on a state or on time", l->what, d->name);
        return wrong(l);
    }
    if (d->progress == 1) {
        source_complain(&l->model->source, MOTUS_NAME, t->at, "%s is defined by itself, in a circle", d->name);
        return wrong(l);
    }
    if (l->chain > MODEL_CHAIN_MAX) {
        source_complain(&l->model->source, MOTUS_LIMIT, t->at, "definitions use one another more than %d deep", MODEL_CHAIN_MAX);
        return wrong(l);
    }
    if (d->kind != DEFINED_PARAMETER && d->statement->loop_count > 0) {
        if (!resolve_definition(l->model, d))
            return wrong(l);
        return lower_quantity_family(l, t, d);
    }
    if (d->kind != DEFINED_PARAMETER) {              /* its expression, in its place: what it may depend on is decided by who uses it */
        lowering inner = *l;
        inner.name_count = 0;
        inner.chain++;
        if (!d->known)
            d->known = arena_take(l->model->arena, (PLACE_QUANTITY + 1) * (MAX_LEVELS + 1) * sizeof *d->known);
        value **known = &d->known[(int)l->place * (MAX_LEVELS + 1) + l->levels];
        if (failed(l))
            return wrong(l);
        if (*known)
            return t->index_count == 1 ? component_of(l, **known, t->item[0], t) : **known;
        if (d->dims) {
            COMPLAIN(l, d->statement->at, "a quantity with an index ranges over it");
            HINT(l, "add: for i = 1..N");
            return wrong(l);
        }
        d->progress = 1;
        value v = lower_expression(&inner, d->statement->value);
        d->progress = 0;
        value *keep = arena_take(l->model->arena, sizeof *keep);
        *keep = v;
        *known = keep;
        return t->index_count == 1 && !failed(l) ? component_of(l, v, t->item[0], t) : v;
    }
    if (!resolve_definition(l->model, d))
        return wrong(l);
    if (d->list)
        return lower_list(l, t, d);
    value v = vector(l, d->components);
    for (int k = 0; k < (d->components ? d->components : 1) && !failed(l); k++)
        v.item[k] = graph_param(l->model->graph, d->slot + (uint32_t)k);
    if (t->index_count > 1 || (t->index_count == 1 && d->components == 0)) {
        COMPLAIN(l, t->at, "%s is %s and takes no such index", d->name, d->components ? "a vector" : "one number");
        return wrong(l);
    }
    return t->index_count == 1 ? component_of(l, v, t->item[0], t) : v;
}

static value lower_name(lowering *l, const tree *t)
{
    const index_name *index = find_index(l, t->name);
    if (index) {
        if (t->primes || t->index_count)
            COMPLAIN(l, t->at, "%s is an index: it takes no primes and no index", t->name);
        return scalar(l, index->number);
    }
    if (!strcmp(t->name, "t") || !strcmp(t->name, "pi")) {
        if (t->primes || t->index_count)
            COMPLAIN(l, t->at, "%s takes no primes and no index", t->name);
        if (t->name[0] == 'p')
            return scalar(l, graph_const(l->model->graph, 3.14159265358979323846));
        if (l->place == PLACE_CONSTANT) {
            COMPLAIN(l, t->at, "%s is constant and cannot depend on the time t", l->what);
            return wrong(l);
        }
        return scalar(l, graph_time(l->model->graph));
    }
    symbol s = symbols_find(l->model, t->name);
    if (s.state)
        return lower_state(l, t, s.state);
    if (s.definition)
        return lower_definition(l, t, s.definition);
    source_complain(&l->model->source, MOTUS_NAME, t->at, "%s is not defined", t->name);
    const char *names[2 * MAX_LEVELS];
    for (int i = 0; i < l->name_count; i++)
        names[i] = l->names[i].name;
    size_t n = strlen(t->name);
    if (n == 2 && t->name[0] == 'd')
        HINT(l, "derivatives are written with primes: %s'", t->name + 1);
    if (!strcmp(t->name, "e"))
        HINT(l, "for the exponential write exp(…)");
    if (!strcmp(t->name, "ln"))
        HINT(l, "the natural logarithm is log(…)");
    symbols_suggest(l->model, t->name, names, (uint32_t)l->name_count);
    return wrong(l);
}

/* x(0), r'(0), x[i](0) [4] */
static value lower_initial(lowering *l, const tree *t)
{
    const tree *name = t->item[0], *bracket = t->item[1];
    symbol s = symbols_find(l->model, name->name);
    char a[80], b[80];
    if (!s.state) {
        span at = {t->at.text, t->at.from, t->at.to};
        if (!strcmp(name->name, "ln")) {
            source_complain(&l->model->source, MOTUS_NAME, at, "ln is not a function");
            HINT(l, "the natural logarithm is log(…)");
        } else if (s.definition || find_index(l, name->name) || !strcmp(name->name, "t") || !strcmp(name->name, "pi")) {
            source_complain(&l->model->source, MOTUS_SYNTAX, at, "%s is not a function", name->name);
            quote(l, bracket->at, b);
            if (bracket->bracketed)
                HINT(l, "write %s*%s or %s %s", name->name, b, name->name, b);
            else
                HINT(l, "write %s*(%s) or %s (%s)", name->name, b, name->name, b);
        } else {
            source_complain(&l->model->source, MOTUS_NAME, at, "%s is neither a function nor defined", name->name);
            if (bracket->kind == TREE_NAME && !strcmp(bracket->name, "t"))
                HINT(l, "define it by %s = …, which may use t, and write %s alone", name->name, name->name);
            static const char *const functions[] = {"sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "exp", "log",
                                                    "sqrt", "cbrt", "hypot", "abs", "min", "max", "floor", "mod", "sign", "erf", "dot", "cross",
                                                    "if", "sum"};
            symbols_suggest(l->model, name->name, functions, sizeof functions / sizeof *functions);
        }
        return wrong(l);
    }
    if (name->primes >= s.state->order) {
        COMPLAIN(l, t->at, "%s at the start follows from its equation; it is not an initial value", quote(l, name->at, a));
        return wrong(l);
    }
    lowering inner = *l;
    inner.place = PLACE_QUANTITY;
    node n = lower_scalar(&inner, bracket, "the start");
    if (failed(l))
        return wrong(l);
    if (graph_deps(l->model->graph, n) & (DEP_TIME | DEP_STATE | DEP_LEVELS)) {
        COMPLAIN(l, t->at, "%s is a state, not a function", name->name);
        HINT(l, "write %s for its value now, %s*(…) for a product; motion that depends on the past is not Newton's", name->name, name->name);
        return wrong(l);
    }
    double at;
    if (!resolve_start_time(l->model) || !resolve_number(l->model, n, bracket->at, &at))
        return wrong(l);
    if (at != l->model->start) {
        COMPLAIN(l, t->at, "%s is an initial value, and the start is %g", quote(l, t->at, a), l->model->start);
        HINT(l, "for a product write %s*(…)", name->name);
        return wrong(l);
    }
    reference r = {0};
    int64_t low[MAX_DIMS], high[MAX_DIMS];
    if ((int)name->index_count != s.state->dims) {
        resolve_indices_wrong(l->model, s.state, name->at);
        return wrong(l);
    }
    if (!resolve_hull(l->model, s.state) || !subscripts(l, name, s.state->dims, &r, low, high) ||
        (s.state->dims && !covered(l, s.state, name, low, high)) || !start_cells(l->model, s.state, name->primes, low, high))
        return wrong(l);
    return load(l, s.state->start_array[name->primes], s.state->components, &r);
}

/* ---- operators ---- */

static bool equal_shapes(lowering *l, const tree *t, const tree *a, value va, const tree *b, value vb, const char *sign)
{
    char x[80], y[80], p[40], q[40];
    if (!want_number(l, va, a) || !want_number(l, vb, b))
        return false;
    if (va.count == vb.count)
        return true;
    COMPLAIN(l, t->at, "%s %s %s does not fit: %s and %s", quote(l, a->at, x), sign, quote(l, b->at, y), shape_name(va, p), shape_name(vb, q));
    if (!va.count || !vb.count)
        HINT(l, "nothing is made a vector silently: write a vector (…, …), or take the length |%s| or a component", va.count ? x : y);
    return false;
}

static value lower_sum_of_two(lowering *l, const tree *t, const tree *a, value va, const tree *b, value vb)
{
    bool add = t->kind == TREE_ADD;
    if (!equal_shapes(l, t, a, va, b, vb, add ? "+" : "-"))
        return wrong(l);
    value v = vector(l, va.count);
    for (int k = 0; k < (v.count ? v.count : 1); k++)
        v.item[k] = binary(l, add ? OP_ADD : OP_SUB, va.item[k], vb.item[k]);
    return v;
}

static value lower_product(lowering *l, const tree *t, const tree *a, value va, const tree *b, value vb)
{
    char x[80], y[80];
    if (!want_number(l, va, a) || !want_number(l, vb, b))
        return wrong(l);
    if (va.count && vb.count) {
        COMPLAIN(l, t->at, "two vectors have no plain product");
        HINT(l, "write dot(%s, %s), cross(%s, %s) or |v|^2", quote(l, a->at, x), quote(l, b->at, y), x, y);
        return wrong(l);
    }
    if (t->blank_product) {
        const tree *name = a->kind == TREE_MULTIPLY ? a->item[1] : a;
        symbol s = symbols_find(l->model, name->name);
        if (s.state && !find_index(l, name->name) && !(graph_deps(l->model->graph, vb.item[0]) & (DEP_TIME | DEP_STATE | DEP_LEVELS))) {
            quote(l, name->at, x);
            quote(l, b->at, y);
            source_complain(&l->model->source, MOTUS_SYNTAX, (span){t->at.text, name->at.from, b->at.to}, "%s %s: a product or an initial value?", x, y);
            HINT(l, "write %s*%s for the product, %s%s for the initial value", x, y, x, y);
            return wrong(l);
        }
    }
    value v = vector(l, va.count ? va.count : vb.count);
    for (int k = 0; k < (v.count ? v.count : 1); k++)
        v.item[k] = binary(l, OP_MUL, va.item[va.count ? k : 0], vb.item[vb.count ? k : 0]);
    return v;
}

static value lower_quotient(lowering *l, const tree *t, const tree *a, value va, const tree *b, value vb)
{
    char x[80];
    if (!want_number(l, va, a) || !want_number(l, vb, b))
        return wrong(l);
    if (vb.count) {
        COMPLAIN(l, t->at, "nothing can be divided by a vector");
        HINT(l, "divide by its length |%s|, or by a component", quote(l, b->at, x));
        return wrong(l);
    }
    if (!va.count)
        return scalar(l, binary(l, OP_DIV, va.item[0], vb.item[0]));
    node once = binary(l, OP_DIV, graph_const(l->model->graph, 1), vb.item[0]);     /* v/s is v*(1/s), the quotient once [15] */
    value v = vector(l, va.count);
    for (int k = 0; k < v.count; k++)
        v.item[k] = binary(l, OP_MUL, va.item[k], once);
    return v;
}

static node dot(lowering *l, value a, value b)
{
    value products = vector(l, a.count);
    for (int k = 0; k < products.count; k++)
        products.item[k] = binary(l, OP_MUL, a.item[k], b.item[k]);
    return graph_total(l->model->graph, products.item, (size_t)products.count);
}

/* A literal whole exponent with |n| <= 64 [15]; 0 otherwise. */
static bool literal_exponent(const tree *t, int *n)
{
    int sign = 1;
    if (t->kind == TREE_NEGATE) {
        sign = -1;
        t = t->item[0];
    }
    if (t->kind != TREE_NUMBER || t->number != floor(t->number) || t->number > 64)
        return false;
    *n = sign * (int)t->number;
    return true;
}

/* |v|^n by way of d = dot(v, v): d^(n/2), times sqrt(d) where n is odd [15] */
static node norm_power(lowering *l, value of, int n)
{
    graph *g = l->model->graph;
    node d = dot(l, of, of);
    int m = n < 0 ? -n : n;
    node p = m >= 2 ? graph_power(g, d, m / 2) : 0;
    if (m % 2) {
        node root = graph_op(g, OP_SQRT, d, 0, 0);
        p = m >= 2 ? binary(l, OP_MUL, p, root) : root;
    }
    if (m == 0)
        return graph_const(g, 1);
    return n < 0 ? binary(l, OP_DIV, graph_const(g, 1), p) : p;
}

static value lower_power(lowering *l, const tree *t)
{
    const tree *base = t->item[0], *exponent = t->item[1];
    char x[80];
    int n;
    bool literal = literal_exponent(exponent, &n);
    if (literal && base->kind == TREE_NORM) {
        value of = lower_expression(l, base->item[0]);
        if (failed(l))
            return wrong(l);
        if (of.count)
            return scalar(l, norm_power(l, of, n));
    }
    value b = lower_expression(l, base);
    if (!want_number(l, b, base))
        return wrong(l);
    if (b.count) {
        COMPLAIN(l, t->at, "a vector has no powers");
        HINT(l, "write |%s|^2, which is dot(%s, %s)", quote(l, base->at, x), x, x);
        return wrong(l);
    }
    if (literal)
        return scalar(l, graph_power(l->model->graph, b.item[0], n));
    node e = lower_scalar(l, exponent, "an exponent");
    return failed(l) ? wrong(l) : scalar(l, binary(l, OP_POW, b.item[0], e));
}

static value lower_call(lowering *l, const tree *t)
{
    value v[3] = {{0}};
    uint32_t n = t->count;
    char shape[40], x[80];
    for (uint32_t i = 0; i < n && i < 3; i++) {
        v[i] = lower_expression(l, t->item[i]);
        if (failed(l))
            return wrong(l);
    }
    if (t->operation == CALL_IF) {
        if (!v[0].boolean) {
            COMPLAIN(l, t->item[0]->at, "a condition is due here");
            HINT(l, "write if(x > 0, …, …)");
            return wrong(l);
        }
        if (!equal_shapes(l, t, t->item[1], v[1], t->item[2], v[2], "or"))
            return wrong(l);
        value r = vector(l, v[1].count);
        for (int k = 0; k < (r.count ? r.count : 1); k++)
            r.item[k] = graph_op(l->model->graph, OP_SELECT, v[0].item[0], v[1].item[k], v[2].item[k]);
        return r;
    }
    if (t->operation == CALL_DOT || t->operation == CALL_CROSS) {
        bool cross = t->operation == CALL_CROSS;
        for (int i = 0; i < 2; i++)
            if (!want_number(l, v[i], t->item[i]))
                return wrong(l);
        if (v[0].count == 0 || v[0].count != v[1].count || (cross && v[0].count > 3)) {
            char other[40];
            COMPLAIN(l, t->at, "%s takes two vectors of %s, not %s and %s", t->name, cross ? "length 3 (or 2)" : "equal length",
                     shape_name(v[0], shape), shape_name(v[1], other));
            return wrong(l);
        }
        if (!cross)
            return scalar(l, dot(l, v[0], v[1]));
        const node *a = v[0].item, *b = v[1].item;
        if (v[0].count == 2)
            return scalar(l, binary(l, OP_SUB, binary(l, OP_MUL, a[0], b[1]), binary(l, OP_MUL, a[1], b[0])));
        value r = vector(l, 3);
        for (int k = 0; k < 3; k++) {
            int i = (k + 1) % 3, j = (k + 2) % 3;
            r.item[k] = binary(l, OP_SUB, binary(l, OP_MUL, a[i], b[j]), binary(l, OP_MUL, a[j], b[i]));
        }
        return r;
    }
    if (t->operation == OP_MIN || t->operation == OP_MAX) {
        node r = lower_scalar(l, t->item[0], "an argument");
        for (uint32_t i = 1; i < n && !failed(l); i++)
            r = binary(l, (operation)t->operation, r, lower_scalar(l, t->item[i], "an argument"));
        return scalar(l, r);
    }
    for (uint32_t i = 0; i < n; i++)
        if (v[i].count || v[i].boolean) {
            COMPLAIN(l, t->item[i]->at, "%s takes numbers, but this is %s", t->name, shape_name(v[i], shape));
            if (v[i].count)
                HINT(l, "its length is |%s|, a component %s.x", quote(l, t->item[i]->at, x), x);
            return wrong(l);
        }
    return scalar(l, graph_op(l->model->graph, (operation)t->operation, v[0].item[0], n > 1 ? v[1].item[0] : 0, 0));
}

/* sum(j = a..b, condition, …: body) [12]: each index is a loop; the conditions and the body stand in the innermost */
static value lower_sum(lowering *l, const tree *t)
{
    lowering inner = *l;
    range ranges[MAX_DIMS];
    graph *g = l->model->graph;
    if (l->levels + (int)t->loop_count > MAX_LEVELS) {
        source_complain(&l->model->source, MOTUS_LIMIT, t->at, "sums and families are nested more than %d deep", MAX_LEVELS);
        return wrong(l);
    }
    for (uint32_t k = 0; k < t->loop_count; k++) {
        int64_t low, high;
        if (!lower_range(&inner, &t->loops[k], &ranges[k], &low, &high) || !add_index(&inner, &t->loops[k], inner.levels, low, high))
            return wrong(l);
        inner.levels++;
        inner.terms *= high >= low ? (double)(high - low + 1) : 1;
    }
    if (inner.terms > MODEL_TERMS_MAX) {
        source_complain(&l->model->source, MOTUS_LIMIT, t->at, "%.3g terms are more than the %.0e that an evaluation may take", inner.terms,
                        MODEL_TERMS_MAX);
        return wrong(l);
    }
    if (l->place == PLACE_CONSTANT && (l->model->constant_terms += inner.terms) > MODEL_CONSTANT_TERMS_MAX) {
        source_complain(&l->model->source, MOTUS_LIMIT, t->at, "the sums in constants have more than %.0e terms together", MODEL_CONSTANT_TERMS_MAX);
        return wrong(l);
    }
    node mask = 0;
    bool masked = false, never = false;              /* a condition that is false whatever happens leaves nothing to sum */
    for (uint32_t i = 0; i + 1 < t->count; i++) {
        value c = lower_expression(&inner, t->item[i]);
        if (failed(l))
            return wrong(l);
        if (!c.boolean) {
            COMPLAIN(l, t->item[i]->at, "a condition is due here, such as j != i");
            return wrong(l);
        }
        mask = masked ? binary(l, OP_AND, mask, c.item[0]) : c.item[0];
        masked = true;
        never |= mask == 0;
    }
    value body = lower_expression(&inner, t->item[t->count - 1]);
    if (!want_number(l, body, t->item[t->count - 1]))
        return wrong(l);
    value v = vector(l, body.count);
    for (int k = 0; k < (v.count ? v.count : 1); k++) {
        node n = body.item[k];
        if (never) {
            v.item[k] = 0;
            continue;
        }
        for (int i = (int)t->loop_count - 1; i >= 0; i--)
            n = graph_sum(g, l->levels + i, &ranges[i], i == (int)t->loop_count - 1 ? mask : 0, n);
        v.item[k] = n;
    }
    return v;
}

static value lower_truth(lowering *l, const tree *t)
{
    value v = lower_expression(l, t);
    if (!failed(l) && !v.boolean) {
        COMPLAIN(l, t->at, "and, or, not join conditions, such as x > 0");
        return wrong(l);
    }
    return v;
}

static value lower_vector(lowering *l, const tree *t)
{
    if (t->count > MODEL_COMPONENTS_MAX) {
        source_complain(&l->model->source, MOTUS_LIMIT, t->at, "a vector has at most %d components", MODEL_COMPONENTS_MAX);
        return wrong(l);
    }
    value v = vector(l, (int)t->count);
    for (uint32_t i = 0; i < t->count && !failed(l); i++)
        v.item[i] = lower_scalar(l, t->item[i], "a component");
    return v;
}

/* One operator with the left operand done. */
static value lower_right(lowering *l, const tree *t, value left)
{
    const tree *a = t->item[0], *b = t->item[1];
    if (t->kind == TREE_AND || t->kind == TREE_OR) {
        if (!left.boolean)
            COMPLAIN(l, a->at, "and, or, not join conditions, such as x > 0");
        value right = lower_truth(l, b);
        return failed(l) ? wrong(l) : condition(l, binary(l, t->kind == TREE_AND ? OP_AND : OP_OR, left.item[0], right.item[0]));
    }
    value right = lower_expression(l, b);
    if (failed(l))
        return wrong(l);
    switch (t->kind) {
    case TREE_ADD: case TREE_SUBTRACT: return lower_sum_of_two(l, t, a, left, b, right);
    case TREE_MULTIPLY: return lower_product(l, t, a, left, b, right);
    default: return lower_quotient(l, t, a, left, b, right);
    }
}

static bool operator_kind(tree_kind kind)
{
    return kind == TREE_ADD || kind == TREE_SUBTRACT || kind == TREE_MULTIPLY || kind == TREE_DIVIDE || kind == TREE_AND || kind == TREE_OR;
}

/* a op b op c …: down the left side, then up again. */
static value lower_chain(lowering *l, const tree *t)
{
    size_t depth = 0;
    const tree *leaf = t;
    for (; operator_kind(leaf->kind); leaf = leaf->item[0])
        depth++;
    const tree **chain = arena_grow(l->model->arena, NULL, 0, depth * sizeof *chain);
    if (!chain)
        return wrong(l);
    size_t n = depth;
    for (const tree *c = t; n > 0; c = c->item[0])
        chain[--n] = c;
    value v = lower_expression(l, leaf);
    for (size_t i = 0; i < depth && !failed(l); i++)
        v = lower_right(l, chain[i], v);
    return v;
}

static value lower_any(lowering *l, const tree *t)
{
    if (failed(l)) {
        if (l->model->graph->too_large)
            source_complain(&l->model->source, MOTUS_LIMIT, t->at, "the model's expressions are too large");
        return wrong(l);
    }
    if (++l->model->lowered > MODEL_LOWERED_MAX) {
        source_complain(&l->model->source, MOTUS_LIMIT, t->at, "the quantities use one another too often: more than %u steps to read the model",
                        MODEL_LOWERED_MAX);
        return wrong(l);
    }
    graph *g = l->model->graph;
    value v;
    switch (t->kind) {
    case TREE_NUMBER: return scalar(l, graph_const(g, t->number));
    case TREE_NAME: return lower_name(l, t);
    case TREE_START: return lower_initial(l, t);
    case TREE_CALL: return lower_call(l, t);
    case TREE_NEGATE:
        v = lower_expression(l, t->item[0]);
        if (!want_number(l, v, t->item[0]))
            return wrong(l);
        value r = vector(l, v.count);
        for (int k = 0; k < (r.count ? r.count : 1); k++)
            r.item[k] = graph_op(g, OP_NEG, v.item[k], 0, 0);
        return r;
    case TREE_POWER: return lower_power(l, t);
    case TREE_COMPARE: {
        node a = lower_scalar(l, t->item[0], "a side of a comparison"), b = lower_scalar(l, t->item[1], "a side of a comparison");
        return failed(l) ? wrong(l) : condition(l, binary(l, (operation)t->operation, a, b));
    }
    case TREE_NOT:
        v = lower_truth(l, t->item[0]);
        return failed(l) ? wrong(l) : condition(l, graph_op(g, OP_NOT, v.item[0], 0, 0));
    case TREE_VECTOR: return lower_vector(l, t);
    case TREE_LIST:
        COMPLAIN(l, t->at, "a list stands alone behind the = of a parameter");
        HINT(l, "write m = [1, 2], then m[1]; a vector is written (1, 2)");
        return wrong(l);
    case TREE_COMPONENT: return component_of(l, lower_expression(l, t->item[0]), t->item[1], t);
    case TREE_NORM:
        v = lower_expression(l, t->item[0]);
        if (!want_number(l, v, t->item[0]))
            return wrong(l);
        return scalar(l, v.count ? graph_op(g, OP_SQRT, dot(l, v, v), 0, 0) : graph_op(g, OP_ABS, v.item[0], 0, 0));
    case TREE_SUM: return lower_sum(l, t);
    default: return lower_chain(l, t);
    }
}

value lower_expression(lowering *l, const tree *t)
{
    model *m = l->model;
    if (m->depth == MODEL_DEPTH_MAX) {
        source_complain(&m->source, MOTUS_LIMIT, t->at, "brackets and definitions within one another are more than %d deep", MODEL_DEPTH_MAX);
        source_hint(&m->source, "use fewer brackets, or fewer definitions within definitions");
        return wrong(l);
    }
    m->depth++;
    value v = lower_any(l, t);
    m->depth--;
    return v;
}
