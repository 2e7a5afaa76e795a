/* Indices [11]: names of indices, subscripts i + c and mod(i + c, N) + 1, ranges, and left sides. */
#include "lang/lower/lower_parts.h"

#include "lang/model/evaluate.h"
#include "lang/model/symbols.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const index_name *lower_find_index(const lowering *l, const char *name)
{
    for (int i = l->name_count - 1; i >= 0; i--)
        if (!strcmp(l->names[i].name, name)) return &l->names[i];
    return NULL;
}

typedef struct affine { /* the parts of an index expression */
    const index_name *name;
    int64_t literal;
    node constant;
    bool wrapped; /* it is mod(inner, modulus) + literal */
    subscript inner;
    int64_t modulus;
} affine;

static void not_affine(lowering *l, const tree *t)
{
    COMPLAIN(l, &t->at, "an index is i + c or mod(i + c, N) + 1 with a constant c");
}

static void take_apart(lowering *l, const tree *t, int sign, affine *a);

static void take_mod(lowering *l, const tree *t, int sign, affine *a)
{
    if (sign < 0 || a->name || a->wrapped) {
        not_affine(l, t);
        return;
    }
    int64_t low, high;
    if (!lower_subscript(l, t->item[0], &a->inner, &low, &high)) return;
    node n = lower_scalar(l, t->item[1], "the second argument of mod");
    int slot = failed(l) ? -1 : evaluate_int(l->model, n, &t->item[1]->at, &a->modulus);
    if (slot < 0) return;
    if (a->modulus < 1) {
        COMPLAIN(l, &t->item[1]->at, "an index wraps around at least 1 place, not %lld", (long long)a->modulus);
        return;
    }
    /* only equal moduli can be joined: mod(mod(b, N) + 1 + c, N) is mod(b + 1 + c, N) */
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
    if (failed(l)) return;
    unsigned deps = graph_deps(l->model->graph, n);
    if (deps & (DEP_LEVELS | DEP_TIME | DEP_STATE | DEP_D)) {
        if (deps & DEP_LEVELS)
            not_affine(l, t);
        else if (deps & DEP_MODE)
            COMPLAIN(l, &t->at, "an index cannot depend on what events assign");
        else
            COMPLAIN(l, &t->at, "an index cannot depend on a state or on time");
        return;
    }
    const graph_node *g = graph_at(l->model->graph, n);
    if (g->op == OP_CONST) {
        if (fabs(g->value) > 1e9) {
            source_complain(&l->model->source, MOTUS_LIMIT, &t->at, "an index is at most 1e9, and this is %g",
                            g->value);
            return;
        }
        if (g->value != floor(g->value)) {
            COMPLAIN(l, &t->at, "an index is a whole number, not %g", g->value);
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
        const argument *hides = t->kind == TREE_NAME ? lower_find_argument(l, t->name) : NULL;
        if (hides && hides->tree && !t->index_count && !t->primes) { /* an argument may be an index */
            l = hides->caller;
            t = hides->tree;
            continue;
        }
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
        const index_name *name =
            t->kind == TREE_NAME && t->index_count == 0 && t->primes == 0 ? lower_find_index(l, t->name) : NULL;
        if (name) {
            if (sign < 0 || a->name || a->wrapped) not_affine(l, t);
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
    if (failed(l)) return false;
    if (a.wrapped) {
        if (a.literal != 1 || a.constant) {
            COMPLAIN(l, &t->at, "indices count from 1: a wrapped index is mod(…, N) + 1");
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
        int slot = evaluate_int(l->model, a.constant, &t->at, &value);
        if (slot < 0) return false;
        out->slot = (int16_t)slot;
        shift += value;
        if (a.name && a.name->constant) { /* `first` and `last` contain it already */
            int64_t before;
            if (evaluate_int(l->model, a.name->constant, &t->at, &before) < 0) return false;
            shift -= before;
        }
    }
    if (llabs(a.literal) > 1000000000 || llabs(out->literal + a.literal) > 1000000000) {
        source_complain(&l->model->source, MOTUS_LIMIT, &t->at, "an index is at most 1e9");
        return false;
    }
    out->literal += (int32_t)a.literal;
    *first += shift;
    *last += shift;
    return !failed(l);
}

node lower_subscript_number(lowering *l, const subscript *s)
{
    graph *g = l->model->graph;
    const node constant = s->slot >= 0 ? l->model->int_nodes[s->slot] : 0;
    node number = s->level >= 0 ? graph_index(g, s->level) : graph_const(g, 0);
    if (s->literal)
        number = s->level >= 0 || constant ? binary(l, OP_ADD, number, graph_const(g, s->literal))
                                           : graph_const(g, s->literal);
    if (constant) number = s->level >= 0 || s->literal ? binary(l, OP_ADD, number, constant) : constant;
    if (s->modulus < 0) return number;
    node one = graph_const(g, 1);
    return binary(l, OP_ADD, binary(l, OP_MOD, number, l->model->int_nodes[s->modulus]), one);
}

bool lower_add_index(lowering *l, const loop *loop, int level, int64_t first, int64_t last)
{
    if (lower_find_index(l, loop->name)) {
        COMPLAIN(l, &loop->at, "the index %s is used twice", loop->name);
        HINT(l, "take another letter for the inner one");
        return false;
    }
    if (lower_find_argument(l, loop->name)) {
        COMPLAIN(l, &loop->at, "%s is an argument of the function and cannot be an index", loop->name);
        HINT(l, "take another letter for the index");
        return false;
    }
    symbol s = symbols_find(l->model, loop->name);
    if (s.state || s.definition || s.function) {
        source_complain(&l->model->source, MOTUS_NAME, &loop->at, "%s is defined already and cannot be an index",
                        loop->name);
        HINT(l, "take another letter for the index");
        return false;
    }
    index_name *n = &l->names[l->name_count++];
    *n = (index_name){.name = loop->name,
                      .at = {.level = (int8_t)level, .slot = -1, .modulus = -1},
                      .first = first,
                      .last = last,
                      .number = graph_index(l->model->graph, level)};
    l->low[level] = first;
    l->high[level] = last;
    return true;
}

bool lower_enter_line(lowering *l, const tree *t, const statement *line, const reference *r, const int64_t low[],
                      const int64_t high[], const char *lines)
{
    l->name_count = 0;
    l->argument_count = 0;
    if (++l->chain > MODEL_CHAIN_MAX) {
        source_complain(&l->model->source, MOTUS_LIMIT, &t->at, "%s use one another more than %d deep", lines,
                        MODEL_CHAIN_MAX);
        return false;
    }
    for (int d = 0; d < r->dims; d++) {
        const tree *name = line->index[d];
        bool loops = false;
        for (uint32_t k = 0; k < line->loop_count && name->kind == TREE_NAME; k++)
            loops |= !strcmp(line->loops[k].name, name->name);
        if (!loops) continue;
        const node constant = r->at[d].slot >= 0 ? l->model->int_nodes[r->at[d].slot] : 0;
        l->names[l->name_count++] = (index_name){.name = name->name,
                                                 .at = r->at[d],
                                                 .constant = constant,
                                                 .number = lower_subscript_number(l, &r->at[d]),
                                                 .first = low[d],
                                                 .last = high[d]};
    }
    return true;
}

/* Reads the range of a loop; [*low, *high] contains every value of its index, for all values of outer indices. */
bool lower_range(lowering *l, const loop *loop, range *out, int64_t *low, int64_t *high)
{
    int64_t first_high, last_low;
    if (!lower_subscript(l, loop->first, &out->first, low, &first_high) ||
        !lower_subscript(l, loop->last, &out->last, &last_low, high))
        return false;
    if (out->first.modulus >= 0 || out->last.modulus >= 0) {
        COMPLAIN(l, &loop->at, "the bounds of an index cannot contain mod");
        return false;
    }
    return true;
}

/* Complains about a range that is empty, or too long for a family. */
static bool fitting_range(lowering *l, const loop *loop, int64_t low, int64_t high)
{
    source *s = &l->model->source;
    if (low > high)
        source_complain(s, MOTUS_ARGUMENT, &loop->at, "the index %s runs over nothing: from %lld to %lld", loop->name,
                        (long long)low, (long long)high);
    else if ((double)high - (double)low >= MODEL_NUMBERS_MAX)
        source_complain(s, MOTUS_LIMIT, &loop->at, "%.0f places are more than the %d that fit",
                        (double)high - (double)low + 1, MODEL_NUMBERS_MAX);
    return !failed(l);
}

static bool fitting_places(lowering *l, span at)
{
    if (l->terms > MODEL_NUMBERS_MAX)
        source_complain(&l->model->source, MOTUS_LIMIT, &at, "%.0f places are more than the %d that fit", l->terms,
                        MODEL_NUMBERS_MAX);
    return !failed(l);
}

bool lower_is_index(const lowering *l, const char *name) { return lower_find_index(l, name) != NULL; }

bool lower_loops(lowering *l, const loop *loops, uint32_t count, range *out)
{
    for (uint32_t k = 0; k < count; k++) {
        int64_t low, high;
        if (!lower_range(l, &loops[k], &out[k], &low, &high)) return false;
        if (!fitting_range(l, &loops[k], low, high) || !lower_add_index(l, &loops[k], l->levels, low, high))
            return false;
        l->levels++;
        l->terms *= (double)(high - low + 1);
        if (!fitting_places(l, loops[k].at)) return false;
    }
    return !failed(l);
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
            if (!strcmp(s->loops[k].name, t->name)) which = (int)k;
        if (which >= 0 && used[which]) {
            COMPLAIN(l, &t->at, "the index %s stands twice on the left side", t->name);
            return false;
        }
        if (which < 0) {
            int64_t first, last;
            for (uint32_t k = 0; k < s->loop_count; k++)
                if (t->kind != TREE_NUMBER && t->count > 0 && t->item[0]->kind == TREE_NAME && t->item[0]->name &&
                    !strcmp(t->item[0]->name, s->loops[k].name)) {
                    COMPLAIN(l, &t->at, "on the left side the index must stand alone");
                    HINT(l, "write %s[%s] … and shift the bounds", s->name, s->loops[k].name);
                    return false;
                }
            if (!lower_subscript(l, t, &out->to.at[d], &first, &last)) return false;
            continue;
        }
        used[which] = true;
        range r;
        int64_t low, high;
        lowering plain;
        lower_start(&plain, l->model, PLACE_CONSTANT, "a bound");
        if (!lower_range(&plain, &s->loops[which], &r, &low, &high)) return false;
        if (!fitting_range(l, &s->loops[which], low, high)) return false;
        out->loop[out->loops] = r;
        out->to.at[d] = (subscript){.level = (int8_t)out->loops, .slot = -1, .modulus = -1};
        if (!lower_add_index(l, &s->loops[which], out->loops, low, high)) return false;
        l->terms *= (double)(high - low + 1);
        out->loops++;
    }
    l->levels = out->loops;
    for (uint32_t k = 0; k < s->loop_count; k++)
        if (!used[k]) {
            COMPLAIN(l, &s->loops[k].at, "the index %s does not stand on the left side", s->loops[k].name);
            HINT(l, "write %s[%s] … or remove the for", s->name, s->loops[k].name);
            return false;
        }
    return fitting_places(l, s->at);
}

void lower_extent(const model *m, const lowering *l, const output *o, int64_t first[], int64_t last[])
{
    for (int d = 0; d < o->to.dims; d++) {
        const subscript *s = &o->to.at[d];
        if (s->level >= 0) {
            first[d] = l->low[s->level];
            last[d] = l->high[s->level];
        } else {
            first[d] = last[d] = s->literal + (s->slot >= 0 ? m->ints[s->slot] : 0);
        }
    }
}

bool lower_places(model *m, const statement *s, int64_t first[], int64_t last[])
{
    lowering l;
    output o = {0};
    lower_start(&l, m, PLACE_CONSTANT, "an index");
    if (!lower_target(&l, s, &o)) return false;
    lower_extent(m, &l, &o, first, last);
    return true;
}
