/* Divides definitions into parameters and quantities, which depend on a state or on time; then checks that lines about
 * states have one. */
#include "lang/read/read_steps.h"

#include "base/near.h"
#include "lang/model/symbols.h"

#include <string.h>

static bool moves(model *m, const tree *t, int chain, bool *yes);

static bool definition_moves(model *m, model_definition *d, span at, int chain, bool *yes)
{
    if (d->kind == DEFINED_QUANTITY || d->kind == DEFINED_INVARIANT) {
        *yes = true;
        if (d->kind == DEFINED_QUANTITY || d->progress) return true;
    }
    if (d->kind == DEFINED_PARAMETER) return true;
    if (d->progress == 1) {
        source_complain(&m->source, MOTUS_NAME, at, "%s is defined by itself, in a circle", d->name);
        source_hint(&m->source, "follow the names on the right side until %s comes back, and cut there", d->name);
        return false;
    }
    if (chain > MODEL_CHAIN_MAX) {
        source_complain(&m->source, MOTUS_LIMIT, at, "definitions use one another more than %d deep", MODEL_CHAIN_MAX);
        return false;
    }
    d->progress = 1;
    bool own = false;
    if (!moves(m, d->statement->value, chain + 1, &own)) return false;
    d->progress = 0;
    if (d->kind == DEFINED_UNKNOWN)
        d->kind = own ? DEFINED_QUANTITY : DEFINED_PARAMETER;
    else
        d->progress = 2;
    *yes |= own || d->kind == DEFINED_INVARIANT;
    return true;
}

/* Chains of operators lean left and may be long, so a loop follows the left side. */
static bool moves_inside(model *m, const tree *t, int chain, bool *yes)
{
    for (;;) {
        if (t->kind == TREE_NAME) {
            symbol s = symbols_find(m, t->name);
            if (!strcmp(t->name, "t") || s.state)
                *yes = true;
            else if (s.definition && !definition_moves(m, s.definition, t->at, chain, yes))
                return false;
        }
        if (t->kind == TREE_START || t->count == 0) return true;
        for (uint32_t i = 1; i < t->count; i++)
            if (!moves(m, t->item[i], chain, yes)) return false;
        t = t->item[0];
    }
}

static bool moves(model *m, const tree *t, int chain, bool *yes)
{
    if (m->depth == MODEL_DEPTH_MAX) {
        source_complain(&m->source, MOTUS_LIMIT, t->at,
                        "brackets and definitions within one another are more than %d deep", MODEL_DEPTH_MAX);
        source_hint(&m->source, "use fewer brackets, or fewer definitions within definitions");
        return false;
    }
    m->depth++;
    bool ok = moves_inside(m, t, chain, yes);
    m->depth--;
    return ok;
}

static bool classify_definitions(model *m)
{
    bool yes = false;
    for (uint32_t i = 0; i < m->definition_count; i++)
        if (!definition_moves(m, &m->definitions[i], m->definitions[i].statement->name_at, 0, &yes)) return false;
    for (uint32_t i = 0; i < m->definition_count; i++) {
        model_definition *d = &m->definitions[i];
        d->progress = 0;
        yes = false;
        if (!d->statement->replaced) continue;
        if (!moves(m, d->statement->replaced, 0, &yes)) return false;
        if (yes) {
            source_complain(&m->source, MOTUS_ARGUMENT, d->statement->name_at,
                            "%s is a quantity and follows from the motion", d->name);
            source_hint(&m->source, "parameters and initial values can be set");
            return false;
        }
        if (d->kind != DEFINED_PARAMETER) {
            source_complain(&m->source, MOTUS_ARGUMENT, d->statement->value->at,
                            "%s is a parameter: what it is set to cannot depend on a state or on time", d->name);
            source_hint(&m->source, "write a force that depends on time in the model");
            return false;
        }
    }
    return true;
}

/* Complains about initial values and exact motions without an equation of motion, and about an initial value for the
 * rate of a first-order variable. */
static bool check_orphans(model *m)
{
    for (uint32_t i = 0; i < m->statements.count; i++) {
        const statement *s = &m->statements.item[i];
        symbol named = s->kind == STATEMENT_START || s->kind == STATEMENT_EXACT ||
                               (s->kind == STATEMENT_DEFINITION && s->index_count)
                           ? symbols_find(m, s->name)
                           : (symbol){0};
        const char *what = s->kind == STATEMENT_EXACT ? "an exact motion" : "an initial value";
        if ((s->kind == STATEMENT_START || s->kind == STATEMENT_EXACT) && !named.state) {
            if (s->kind == STATEMENT_START && s->start_at->kind == TREE_NAME && !strcmp(s->start_at->name, "t")) {
                source_complain(&m->source, MOTUS_SYNTAX, s->at, "a name is defined without its (t)");
                source_hint(&m->source, "write %s = …; it may use t", s->name);
                return false;
            }
            source_complain(&m->source, MOTUS_NAME, s->name_at, "%s has %s, but no equation of motion", s->name, what);
            if (s->kind == STATEMENT_START && named.definition)
                source_hint(&m->source, "%s is a %s", s->name,
                            named.definition->kind == DEFINED_PARAMETER ? "parameter" : "quantity");
            for (uint32_t k = 0; k < m->state_count; k++)
                if (near_likely(s->name, m->states[k].name))
                    source_hint(&m->source, "did you mean %s?", m->states[k].name);
            source_hint(&m->source, "write one: %s'' = …", s->name);
            return false;
        }
        if (s->kind == STATEMENT_START && s->primes >= named.state->order) {
            source_complain(&m->source, MOTUS_NAME, s->at,
                            "%s has an equation of first order, which gives its derivative at the start", s->name);
            return false;
        }
    }
    return true;
}

bool classify_all(model *m) { return classify_definitions(m) && check_orphans(m); }
