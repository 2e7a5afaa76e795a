/* See kept.h. */
#include "lang/model/kept.h"

#include "lang/model/symbols.h"

#include <string.h>

kept_kind kept_call(const model *m, const tree *t)
{
    static const char *const words[] = {[KEPT_COUNT] = "count", [KEPT_TIME] = "time", [KEPT_AT] = "at"};
    if (m->rule_count == 0 || t->kind != TREE_APPLY || t->item[0]->primes || t->item[0]->index_count) return KEPT_NOT;
    for (int kind = KEPT_COUNT; kind <= KEPT_AT; kind++) {
        if (strcmp(words[kind], t->item[0]->name)) continue;
        const symbol s = symbols_find(m, words[kind]);
        return s.state || s.definition || s.function ? KEPT_NOT : (kept_kind)kind;
    }
    return KEPT_NOT;
}

const model_rule *kept_rule(const model *m, const tree *t)
{
    const tree *name = t->item[1];
    if (name->kind != TREE_NAME || name->primes || name->index_count || name->bracketed) return NULL;
    for (uint32_t i = 0; i < m->rule_count; i++)
        if (!strcmp(m->rules[i].name, name->name)) return &m->rules[i];
    return NULL;
}

const tree *kept_which(const model *m, const tree *t)
{
    const kept_kind kind = kept_call(m, t);
    return kind == KEPT_TIME && t->count == 3 ? t->item[2] : kind == KEPT_AT && t->count == 4 ? t->item[2] : NULL;
}

bool kept_is_last(const tree *which)
{
    return which->kind == TREE_NAME && !which->primes && !which->index_count && !strcmp(which->name, "last");
}

const tree *kept_expression(const model *m, const tree *t)
{
    return kept_call(m, t) == KEPT_AT && t->count > 2 ? t->item[t->count - 1] : NULL;
}

bool kept_complete(const model *m, const tree *t)
{
    switch (kept_call(m, t)) {
    case KEPT_COUNT: return t->count == 2;
    case KEPT_TIME: return t->count == 2 || t->count == 3;
    case KEPT_AT: return t->count == 3 || t->count == 4;
    default: return false;
    }
}
