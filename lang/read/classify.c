/* Divides definitions into parameters and quantities, which depend on a state or on time; finds circles of definitions
 * and of functions; checks that lines about states belong to an equation. */
#include "lang/read/read_steps.h"

#include "base/near.h"
#include "lang/model/kept.h"
#include "lang/model/symbols.h"

#include <stdio.h>
#include <string.h>

/* The definition or function whose right side is being read, and the reader that needed it. */
typedef struct reader {
    const char *name;
    const tree *applied; /* the arguments of a function, which hide other names */
    const struct reader *up;
    int chain;
    bool start; /* it is the line of a mode, which gives its start, so other modes stand for their starts */
} reader;

static bool moves(model *m, const tree *t, const reader *by, bool *yes);

/* Writes a → b → a. */
static void name_circle(char *out, size_t size, const reader *by, const char *name)
{
    const reader *steps[8];
    size_t count = 0, n = (size_t)snprintf(out, size, "%s", name);
    for (; by && strcmp(by->name, name); by = by->up)
        if (count < sizeof steps / sizeof *steps) steps[count++] = by;
    while (count > 0 && n < size) n += (size_t)snprintf(out + n, size - n, " → %s", steps[--count]->name);
    if (n < size) snprintf(out + n, size - n, " → %s", name);
}

static bool within_chain(model *m, span at, const reader *by)
{
    if (!by || by->chain < MODEL_CHAIN_MAX) return true;
    source_complain(&m->source, MOTUS_LIMIT, &at, "definitions use one another more than %d deep", MODEL_CHAIN_MAX);
    return false;
}

/* Complains that an event assigns a quantity. It may assign a parameter, whose line gives the start. */
static bool no_start(model *m, const model_definition *d)
{
    source_complain(&m->source, MOTUS_SHAPE, mode_assigned_at(m, d),
                    "%s follows from the state or from time, and cannot be assigned", d->name);
    source_hint(&m->source,
                "an event assigns states and parameters; the line of a parameter gives its value at the start");
    return false;
}

static bool definition_moves(model *m, model_definition *d, span at, const reader *by, bool *yes)
{
    if (d->kind == DEFINED_QUANTITY || d->kind == DEFINED_INVARIANT) {
        *yes = true;
        if (d->kind == DEFINED_QUANTITY || d->progress) return true;
    }
    const bool start = by && by->start;
    if (d->kind == DEFINED_PARAMETER) {
        *yes |= d->mode && !start;
        return true;
    }
    if (d->progress == 1) {
        char circle[8 * MOTUS_NAME_MAX];
        name_circle(circle, sizeof circle, by, d->name);
        source_complain(&m->source, MOTUS_NAME, &at, "%s is defined by itself, in a circle", d->name);
        source_hint(&m->source, "cut the circle %s", circle);
        return false;
    }
    if (!within_chain(m, at, by)) return false;
    d->progress = 1;
    bool own = false;
    for (const statement *s = d->statement; s; s = s->next ? &m->statements.item[s->next - 1] : NULL)
        if (!moves(m, s->value, &(reader){d->name, NULL, by, by ? by->chain + 1 : 1, d->mode != 0}, &own)) return false;
    d->progress = 0;
    if (d->mode && own) return no_start(m, d);
    if (d->kind == DEFINED_UNKNOWN)
        d->kind = own ? DEFINED_QUANTITY : DEFINED_PARAMETER;
    else
        d->progress = 2;
    *yes |= own || d->kind == DEFINED_INVARIANT || (d->mode && !start);
    return true;
}

static bool function_moves(model *m, model_function *f, span at, const reader *by, bool *yes)
{
    if (f->progress == 1) {
        char circle[8 * MOTUS_NAME_MAX];
        name_circle(circle, sizeof circle, by, f->name);
        source_complain(&m->source, MOTUS_NAME, &at, "%s calls itself: %s", f->name, circle);
        source_hint(&m->source,
                    "every call is replaced by the expression of the function, so a function cannot call itself");
        return false;
    }
    if (f->progress == 0) {
        const statement *s = f->statement;
        if (!within_chain(m, at, by)) return false;
        f->progress = 1;
        if (!moves(m, s->value, &(reader){f->name, s->applied, by, by ? by->chain + 1 : 1, false}, &f->moves))
            return false;
        f->progress = 2;
    }
    *yes |= f->moves;
    return true;
}

static bool is_argument(const reader *by, const char *name)
{
    for (uint32_t i = 1; by && by->applied && i < by->applied->count; i++)
        if (!strcmp(by->applied->item[i]->name, name)) return true;
    return false;
}

static bool name_moves(model *m, const tree *t, const reader *by, bool *yes)
{
    if (is_argument(by, t->name)) return true;
    symbol s = symbols_find(m, t->name);
    if (!strcmp(t->name, m->time) || s.state) *yes = true;
    return !s.definition || definition_moves(m, s.definition, t->at, by, yes);
}

/* Finds whether a tree depends on a state or on time. Chains of operators lean left and may be long, so a loop follows
 * the left side. */
static bool moves_inside(model *m, const tree *t, const reader *by, bool *yes)
{
    for (;;) {
        if (t->kind == TREE_NAME && !name_moves(m, t, by, yes)) return false;
        for (uint32_t k = 0; k < t->loop_count; k++)
            if (!moves(m, t->loops[k].first, by, yes) || !moves(m, t->loops[k].last, by, yes)) return false;
        model_function *f = t->kind == TREE_APPLY ? symbols_find(m, t->item[0]->name).function : NULL;
        if (f && !function_moves(m, f, t->at, by, yes)) return false;
        if (t->kind == TREE_APPLY && kept_call(m, t)) {
            const tree *of = kept_expression(m, t);
            return *yes = true, !of || moves(m, of, by, yes);
        }
        if (t->count == 0 || (t->kind == TREE_APPLY && !f)) return true; /* an initial value is constant */
        for (uint32_t i = 1; i < t->count; i++)
            if (!moves(m, t->item[i], by, yes)) return false;
        if (f) return true;
        t = t->item[0];
    }
}

static bool moves(model *m, const tree *t, const reader *by, bool *yes)
{
    if (!model_deeper(m, &t->at)) return false;
    bool ok = moves_inside(m, t, by, yes);
    m->depth--;
    return ok;
}

static bool classify_definitions(model *m)
{
    bool yes = false;
    for (uint32_t i = 0; i < m->definition_count; i++)
        if (!definition_moves(m, &m->definitions[i], m->definitions[i].statement->name_at, NULL, &yes)) return false;
    for (uint32_t i = 0; i < m->function_count; i++)
        if (!function_moves(m, &m->functions[i], m->functions[i].statement->name_at, NULL, &yes)) return false;
    for (uint32_t i = 0; i < m->definition_count; i++) {
        model_definition *d = &m->definitions[i];
        d->progress = 0;
        yes = false;
        if (!d->statement->replaced) continue;
        if (!moves(m, d->statement->replaced->value, &(reader){d->name, NULL, NULL, 1, d->mode != 0}, &yes))
            return false;
        if (yes) {
            source_complain(&m->source, MOTUS_ARGUMENT, &d->statement->name_at,
                            "%s is a quantity and follows from the motion", d->name);
            source_hint(&m->source, "parameters and initial values can be set");
            return false;
        }
        if (d->kind != DEFINED_PARAMETER) {
            source_complain(&m->source, MOTUS_ARGUMENT, &d->statement->value->at,
                            "%s is a parameter: what it is set to cannot depend on a state or on time", d->name);
            source_hint(&m->source, "write a force that depends on time in the model");
            return false;
        }
    }
    return true;
}

/* Returns whether a name may be the velocity of a state: v, vx, x_dot, xdot. */
static bool is_velocity(const char *name, const char *state)
{
    const size_t length = strlen(state);
    const bool dot = !strncmp(name, state, length) && (!strcmp(name + length, "_dot") || !strcmp(name + length, "dot"));
    return name[0] == 'v' || dot;
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
            source_complain(&m->source, MOTUS_NAME, &s->name_at, "%s has %s, but no equation of motion", s->name, what);
            if (s->kind == STATEMENT_START && named.definition)
                source_hint(&m->source, "%s is a %s", s->name,
                            named.definition->kind == DEFINED_PARAMETER ? "parameter" : "quantity");
            for (uint32_t k = 0; k < m->state_count; k++)
                if (near_likely(s->name, m->states[k].name)) {
                    source_hint(&m->source, "did you mean %s?", m->states[k].name);
                    source_repair(&m->source, s->name, "%s", m->states[k].name);
                }
            char at[80];
            for (uint32_t k = 0; s->kind == STATEMENT_START && k < m->state_count; k++)
                if (m->states[k].order == 2 && is_velocity(s->name, m->states[k].name))
                    source_hint(&m->source, "the velocity of %s at the start is %s'(%s) = …", m->states[k].name,
                                m->states[k].name, quote(m, &s->applied->item[1]->at, at));
            source_hint(&m->source, "write one: %s'' = …", s->name);
            return false;
        }
        if (s->kind == STATEMENT_START && s->primes >= named.state->order) {
            source_complain(&m->source, MOTUS_NAME, &s->at,
                            "%s has an equation of first order, which gives its derivative at the start", s->name);
            return false;
        }
    }
    return true;
}

bool classify_all(model *m) { return classify_definitions(m) && check_orphans(m); }
