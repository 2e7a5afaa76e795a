/* Functions of one's own [16]: a call is the function's expression with the arguments in place of their names.
 *
 * A body uses its arguments, which hide all other names, and the names of the model, but no index of its caller.
 * Functions do not call themselves (classify.c), so the expansion ends.
 */
#include "lang/lower/lower_parts.h"

#include <string.h>

argument *lower_find_argument(const lowering *l, const char *name)
{
    for (uint32_t i = 0; i < l->argument_count; i++)
        if (!strcmp(l->arguments[i].name, name)) return &l->arguments[i];
    return NULL;
}

value lower_argument(lowering *l, argument *a)
{
    value *known = &a->known[a->tree ? l->levels : 0];
    if (known->item || failed(l)) return known->item ? *known : wrong(l);
    lowering inner = *a->caller;
    inner.levels = l->levels;
    inner.terms = l->terms;
    for (int k = a->caller->levels; k < l->levels; k++) {
        inner.low[k] = l->low[k];
        inner.high[k] = l->high[k];
    }
    value v = lower_expression(&inner, a->tree);
    if (!failed(l)) *known = v;
    return v;
}

/* The last call of a function. The same call again gives the same nodes, so f(q) + f(q) within f(q) + f(q) … takes no
 * time that doubles with every function. */
enum { NODES_KEPT = 16 };
typedef struct expansion {
    lower_place place;
    int levels;
    double terms;
    int64_t low[MAX_LEVELS], high[MAX_LEVELS]; /* of the indices around it, by which subscripts are checked */
    uint32_t count;
    node nodes[NODES_KEPT]; /* of the arguments */
    value is;
} expansion;

/* What the call depends on; false: more than is kept. */
static bool describe(const lowering *l, const argument *arguments, uint32_t count, expansion *out)
{
    *out = (expansion){.place = l->place, .levels = l->levels, .terms = l->terms};
    for (int k = 0; k < l->levels; k++) {
        out->low[k] = l->low[k];
        out->high[k] = l->high[k];
    }
    for (uint32_t i = 0; i < count; i++) {
        const value v = arguments[i].known[l->levels];
        const int parts = v.count ? v.count : 1;
        if (v.boolean || out->count + (uint32_t)parts + 1 > NODES_KEPT) return false;
        out->nodes[out->count++] = (node)v.count;
        for (int k = 0; k < parts; k++) out->nodes[out->count++] = v.item[k];
    }
    return true;
}

static bool same_call(const expansion *a, const expansion *b)
{
    return a->place == b->place && a->levels == b->levels && a->terms == b->terms && a->count == b->count &&
           !memcmp(a->low, b->low, sizeof a->low) && !memcmp(a->high, b->high, sizeof a->high) &&
           !memcmp(a->nodes, b->nodes, a->count * sizeof *a->nodes);
}

static void keep(lowering *l, model_function *f, const expansion *call, value is)
{
    if (!f->last) f->last = arena_room(l->model->arena, sizeof *f->last);
    if (!f->last) return;
    *f->last = *call;
    f->last->is = is;
}

value lower_function(lowering *l, const tree *call, model_function *f)
{
    const statement *s = f->statement;
    argument arguments[MODEL_ARGUMENTS_MAX];
    lowering inner = *l;
    if (++inner.chain > MODEL_CHAIN_MAX) {
        source_complain(&l->model->source, MOTUS_LIMIT, &call->at, "functions use one another more than %d deep",
                        MODEL_CHAIN_MAX);
        return wrong(l);
    }
    inner.name_count = 0;
    inner.arguments = arguments;
    inner.argument_count = s->applied->count - 1;
    for (uint32_t i = 0; i < inner.argument_count; i++) {
        arguments[i] = (argument){.name = s->applied->item[i + 1]->name, .tree = call->item[i + 1], .caller = l};
        lower_argument(l, &arguments[i]); /* what is wrong with it is wrong whether the function uses it or not */
    }
    if (failed(l)) return wrong(l);
    expansion now;
    const bool kept = describe(l, arguments, inner.argument_count, &now);
    if (kept && f->last && same_call(f->last, &now)) return f->last->is;
    value v = lower_expression(&inner, s->value);
    if (kept && !failed(l)) keep(l, f, &now, v);
    if (source_failed(&l->model->source)) {
        char text[80];
        source_hint(&l->model->source, "it is called as %s", quote(l, &call->at, text));
    }
    return v;
}
