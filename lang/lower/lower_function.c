/* Functions of the model [16]: a call is the function's expression with the arguments in place of their names.
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

/* The calls of a function that were lowered. A repeated call has the nodes of the first, so the time for nested
 * functions, as g(q) + g(q/2) + g(q), does not double with every function. The words of a call are everything that it
 * depends on: the place, the levels around it with the ranges that subscripts are checked by, and the nodes of its
 * arguments. */
typedef struct expansion {
    uint64_t *words;
    size_t count;
    uint64_t hash;
    value is;
} expansion;
struct expansions {
    expansion *slots;
    uint32_t used, room; /* room: a power of two, more than twice `used` */
};
enum { EXPANSIONS_MOST = 1 << 12 }; /* calls kept of one function; others are lowered again */

static size_t words_of(const lowering *l, const argument *arguments, uint32_t count)
{
    size_t words = 2 + 2 * (size_t)l->levels;
    for (uint32_t i = 0; i < count; i++) {
        const value *v = &arguments[i].known[l->levels];
        words += 1 + (size_t)(v->count ? v->count : 1) * (size_t)(v->rows ? v->rows : 1);
    }
    return words;
}

/* Fills in the words of a call, which the caller gives back. False: no memory. */
static bool describe(const lowering *l, const argument *arguments, uint32_t count, expansion *out)
{
    *out = (expansion){.count = words_of(l, arguments, count)};
    uint64_t *to = out->words = take(&l->model->arena->allocator, out->count, sizeof *to);
    if (!to) return false;
    *to++ = (uint64_t)l->place << 32 | (uint32_t)l->levels;
    memcpy(to++, &l->terms, sizeof *to);
    for (int k = 0; k < l->levels; k++) *to++ = (uint64_t)l->low[k], *to++ = (uint64_t)l->high[k];
    for (uint32_t i = 0; i < count; i++) {
        const value *v = &arguments[i].known[l->levels];
        const int parts = (v->count ? v->count : 1) * (v->rows ? v->rows : 1);
        *to++ = (uint64_t)v->count << 32 | (uint64_t)v->rows << 2 | (uint64_t)v->boolean << 1 | v->derived;
        for (int k = 0; k < parts; k++) *to++ = v->item[k];
    }
    for (const uint64_t *w = out->words; w < to; w++) {
        out->hash = (out->hash ^ *w) * 0x9e3779b97f4a7c15u;
        out->hash ^= out->hash >> 29;
    }
    return true;
}

/* Returns the place of a call in the table, or where it would be. */
static expansion *place_of(const struct expansions *t, const expansion *call)
{
    for (uint64_t k = call->hash;; k++) {
        expansion *e = &t->slots[k & (t->room - 1)];
        if (!e->words) return e;
        if (e->hash == call->hash && e->count == call->count &&
            !memcmp(e->words, call->words, e->count * sizeof *e->words))
            return e;
    }
}

static bool grow(arena *a, struct expansions *t)
{
    enum { FIRST = 8 };
    const struct expansions old = *t;
    if (old.room > 2 * old.used + 2) return true;
    expansion *slots = arena_room(a, (old.room ? 2 * old.room : FIRST) * sizeof *slots);
    if (!slots) return false;
    *t = (struct expansions){.slots = slots, .used = old.used, .room = old.room ? 2 * old.room : FIRST};
    for (uint32_t k = 0; k < old.room; k++)
        if (old.slots[k].words) *place_of(t, &old.slots[k]) = old.slots[k];
    arena_drop(a, old.slots, old.room * sizeof *slots);
    return true;
}

static void keep(const lowering *l, model_function *f, const expansion *call, value is)
{
    arena *a = l->model->arena;
    if (!f->calls) f->calls = arena_room(a, sizeof *f->calls);
    if (!f->calls || f->calls->used == EXPANSIONS_MOST || !grow(a, f->calls)) return;
    expansion *to = place_of(f->calls, call);
    uint64_t *words = arena_room(a, call->count * sizeof *words);
    if (!words) return;
    memcpy(words, call->words, call->count * sizeof *words);
    f->calls->used++;
    *to = *call;
    to->words = words;
    to->is = is;
}

static const expansion *kept_expansion(const model_function *f, const expansion *call)
{
    const expansion *e = f->calls && f->calls->room ? place_of(f->calls, call) : NULL;
    return e && e->words ? e : NULL;
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
        lower_argument(l, &arguments[i]); /* so that an argument is checked even if the function does not use it */
    }
    if (failed(l)) return wrong(l);
    expansion now;
    if (!describe(l, arguments, inner.argument_count, &now)) return l->model->arena->failed = true, wrong(l);
    const expansion *same = kept_expansion(f, &now);
    if (!same && inner.chain > 1 && ++l->model->calls > MODEL_CALLS_MAX)
        source_complain(&l->model->source, MOTUS_LIMIT, &call->at,
                        "functions use one another too often: more than %u calls by functions", MODEL_CALLS_MAX);
    value v = same ? same->is : lower_expression(&inner, s->value);
    if (!same && !failed(l)) keep(l, f, &now, v);
    give(&l->model->arena->allocator, now.words);
    if (source_failed(&l->model->source)) {
        char text[80];
        source_hint(&l->model->source, "it is called as %s", quote(l, &call->at, text));
    }
    return v;
}
