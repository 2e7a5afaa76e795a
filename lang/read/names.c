/* Checks that every name of the text is defined, before anything is computed, so that a typing error is not reported as
 * a missing initial value. Complains about the first unknown name of a statement.
 *
 * Chains of operators lean left and may be long, so a loop follows the left side; the rest recurses, as deep as the
 * parser allows.
 */
#include "lang/read/read_steps.h"

#include "base/near.h"
#include "lang/model/kept.h"
#include "lang/model/symbols.h"
#include "lang/text/foreign.h"

#include <string.h>

/* A name that is known only in a part of the statement: an index or an argument. */
typedef struct scope {
    const char *name;
    const struct scope *up;
} scope;

enum { LOCAL_MAX = MODEL_ARGUMENTS_MAX + MAX_LEVELS };

typedef struct finding {
    model *model;
    const tree *first;            /* the first tree with a wrong name so far, or NULL */
    const char *local[LOCAL_MAX]; /* the names in scope there */
    uint32_t local_count;
} finding;

static bool in_scope(const scope *s, const char *name)
{
    for (; s; s = s->up)
        if (!strcmp(s->name, name)) return true;
    return false;
}

static bool known(const finding *f, const scope *s, const char *name)
{
    symbol found = symbols_find(f->model, name);
    return found.state || found.definition || in_scope(s, name) || !strcmp(name, f->model->time) || !strcmp(name, "pi");
}

/* Returns whether a bracket fits its name: x(0) of a state, V(a, b) of a function with as many arguments. */
static bool applies(const finding *f, const tree *t, const scope *s)
{
    const tree *name = t->item[0];
    symbol found = symbols_find(f->model, name->name);
    if (in_scope(s, name->name)) return false;
    if (kept_call(f->model, t)) return kept_complete(f->model, t) && kept_rule(f->model, t);
    if (found.state) return t->count == 2;
    return found.function && t->count == found.function->statement->applied->count && !name->primes &&
           !name->index_count;
}

static void note(finding *f, const tree *t, const scope *s)
{
    if (f->first && f->first->at.from <= t->at.from) return;
    f->first = t;
    f->local_count = 0;
    for (; s && f->local_count < LOCAL_MAX; s = s->up) f->local[f->local_count++] = s->name;
}

static void find(finding *f, const tree *t, const scope *s);

/* Checks the indices of a sum, each known after its own bounds, then what is summed. */
static void find_in_sum(finding *f, const tree *t, uint32_t k, const scope *s)
{
    if (k == t->loop_count) {
        for (uint32_t i = 0; i < t->count; i++) find(f, t->item[i], s);
        return;
    }
    find(f, t->loops[k].first, s);
    find(f, t->loops[k].last, s);
    find_in_sum(f, t, k + 1, &(scope){t->loops[k].name, s});
}

/* Checks a call for what an event keeps, without the name of the event. */
static void find_in_kept(finding *f, const tree *t, const scope *s)
{
    const tree *which = kept_which(f->model, t), *of = kept_expression(f->model, t);
    if (which && !kept_is_last(which)) find(f, which, s);
    if (of) find(f, of, s);
}

static void find(finding *f, const tree *t, const scope *s)
{
    for (;; t = t->item[0]) {
        if (t->kind == TREE_SUM) {
            find_in_sum(f, t, 0, s);
            return;
        }
        if (t->kind == TREE_NAME && !known(f, s, t->name)) note(f, t, s);
        if (t->kind == TREE_APPLY && !applies(f, t, s)) note(f, t, s);
        if (t->kind == TREE_APPLY && kept_call(f->model, t)) {
            find_in_kept(f, t, s);
            return;
        }
        if (t->count == 0) return;
        for (uint32_t i = 1; i < t->count; i++) find(f, t->item[i], s);
        if (t->kind == TREE_APPLY) {
            for (uint32_t i = 0; i < t->item[0]->index_count; i++) find(f, t->item[0]->item[i], s);
            return;
        }
    }
}

/* Complaints ------------------------------------------------------------------------------------------------------- */

/* Returns how a function of other languages is written here, or NULL. */
static const char *written_here(const char *name)
{
    static const char *const others[][2] = {{"round", "floor(x + 1/2)"},
                                            {"rint", "floor(x + 1/2)"},
                                            {"ceil", "-floor(-x)"},
                                            {"trunc", "sign(x) floor(|x|)"},
                                            {"der", "x', and the equation x' = …"},
                                            {"ddt", "x', and the equation x' = …"},
                                            {"grad", "diff(U(r), r), where U(r) = … is a function"},
                                            {"integral", "s for an integral, with s' = …, a first-order variable"},
                                            {"integrate", "s for an integral, with s' = …, a first-order variable"},
                                            {"ifelse", "if(condition, a, b)"},
                                            {"where", "if(condition, a, b)"},
                                            {"piecewise", "if(condition, a, b)"},
                                            {"Piecewise", "if(condition, a, b)"},
                                            {"clip", "min(max(x, a), b)"},
                                            {"clamp", "min(max(x, a), b)"},
                                            {"rem", "mod(a, b)"},
                                            {"fmod", "mod(a, b)"},
                                            {"heaviside", "if(x > 0, 1, 0)"},
                                            {"Heaviside", "if(x > 0, 1, 0)"},
                                            {"ln", "log(x)"},
                                            {"log10", "log(x)/log(10)"},
                                            {"log2", "log(x)/log(2)"},
                                            {"pow", "x^y"},
                                            {"sgn", "sign(x)"},
                                            {"fabs", "abs(x)"},
                                            {"norm", "|r|"},
                                            {"interp1", "interp(t, T, A)"},
                                            {"lookup", "interp(t, T, A)"},
                                            {"table", "interp(t, T, A)"},
                                            {"delta", "an event for a push: when t = 1: x' = x' + 2"},
                                            {"dirac", "an event for a push: when t = 1: x' = x' + 2"},
                                            {"arcsin", "asin(x)"},
                                            {"arccos", "acos(x)"},
                                            {"arctan", "atan(x)"},
                                            {"sec", "1/cos(x)"},
                                            {"csc", "1/sin(x)"},
                                            {"cot", "cos(x)/sin(x)"},
                                            {"asinh", "log(x + sqrt(x^2 + 1))"},
                                            {"acosh", "log(x + sqrt(x^2 - 1))"},
                                            {"atanh", "log((1 + x)/(1 - x))/2"}};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (!strcmp(others[i][0], name)) return others[i][1];
    return NULL;
}

/* Returns "V(q)", as a function is defined. */
static const char *as_defined(const finding *f, const model_function *of, char out[80])
{
    return source_excerpt(&f->model->source, &of->statement->applied->at, out, 80);
}

static bool complain_name(finding *f, const tree *t)
{
    source *s = &f->model->source;
    const model_function *function = symbols_find(f->model, t->name).function;
    char text[80];
    if (function) {
        source_complain(s, MOTUS_SYNTAX, &t->at,
                        "%s is a function and needs its arguments in a bracket directly behind it", t->name);
        source_hint(s, "it is defined as %s", as_defined(f, function, text));
        return false;
    }
    source_complain(s, MOTUS_NAME, &t->at, "%s is not defined", t->name);
    if (!strcmp(t->name, "t")) source_hint(s, "the time is named %s in this model", f->model->time);
    for (uint32_t i = 0; i < f->model->rule_count; i++)
        if (!strcmp(f->model->rules[i].name, t->name)) {
            source_hint(s, "it is an event: count(%s), time(%s, last), at(%s, last, x)", t->name, t->name, t->name);
            return false;
        }
    if (foreign_name(s, &t->at)) return false;
    if (strlen(t->name) == 2 && t->name[0] == 'd')
        source_hint(s, "derivatives are written with primes: %s'", t->name + 1);
    if (!strcmp(t->name, "e")) source_hint(s, "for the exponential write exp(…)");
    if (!strcmp(t->name, "ln")) source_hint(s, "the natural logarithm is log(…)");
    symbols_suggest(f->model, t->name, f->local, f->local_count);
    return false;
}

/* Hints at f(x), where f is defined but is no function, so the blank of a product is missing. */
static void hint_product(source *s, const tree *t, const char *name)
{
    char b[80];
    const tree *bracket = t->item[1];
    source_excerpt(s, &bracket->at, b, sizeof b);
    if (t->divisor)
        source_hint(s, "write %s (%s), with a blank, to multiply the quotient; (%s (%s)) to divide by the product",
                    name, b, name, b);
    else if (bracket->bracketed)
        source_hint(s, "write %s*%s or %s %s", name, b, name, b);
    else
        source_hint(s, "write %s*(%s) or %s (%s)", name, b, name, b);
}

/* Complains about V(a, b) with the wrong number of arguments, V'(q), V[i](q), or x(0, 1) of a state. */
static bool complain_arguments(finding *f, const tree *t, symbol found)
{
    source *s = &f->model->source;
    const tree *name = t->item[0];
    char text[80];
    if (found.state) {
        source_complain(s, MOTUS_SHAPE, &t->at, "%s is a state, not a function", name->name);
        source_hint(s, "write %s for its value now, %s(0) for its initial value", name->name, name->name);
        return false;
    }
    const uint32_t wanted = found.function->statement->applied->count - 1;
    if (name->primes) {
        source_complain(s, MOTUS_SYNTAX, &t->at, "a function takes no primes");
        source_hint(s, "its derivative is diff(%s(q), q)", name->name);
    } else if (name->index_count) {
        source_complain(s, MOTUS_SHAPE, &t->at, "%s is a function and takes no index", name->name);
        source_hint(s, "it is defined as %s", as_defined(f, found.function, text));
    } else {
        source_complain(s, MOTUS_SYNTAX, &t->at, "%s takes %u argument%s, not %u", name->name, wanted,
                        wanted == 1 ? "" : "s", t->count - 1);
        source_hint(s, "it is defined as %s", as_defined(f, found.function, text));
    }
    return false;
}

/* Complains about count(bouncy), time(), at(bounce). */
static bool complain_kept(finding *f, const tree *t)
{
    source *s = &f->model->source;
    const tree *event = t->item[1];
    if (!kept_rule(f->model, t)) {
        rule_names_unknown(f->model, &event->at, event->kind == TREE_NAME && !event->index_count ? event->name : NULL);
        if (event->kind == TREE_NAME && event->index_count)
            source_hint(s, "the events of a family have one name and are counted together: %s(%s)", t->item[0]->name,
                        event->name);
        source_hint(s, "an event gets its name by `as`: when y = 0 as bounce: …");
        return false;
    }
    source_complain(s, MOTUS_SYNTAX, &t->at, "%s does not take %u argument%s", t->item[0]->name, t->count - 1,
                    t->count == 2 ? "" : "s");
    source_hint(s, "write %s",
                kept_call(f->model, t) == KEPT_COUNT  ? "count(NAME)"
                : kept_call(f->model, t) == KEPT_TIME ? "time(NAME), time(NAME, 3) or time(NAME, last)"
                                                      : "at(NAME, x), at(NAME, 3, x) or at(NAME, last, x)");
    return false;
}

static bool complain_call(finding *f, const tree *t)
{
    source *s = &f->model->source;
    const char *name = t->item[0]->name, *here = written_here(name);
    const symbol found = symbols_find(f->model, name);
    if (kept_call(f->model, t)) return complain_kept(f, t);
    bool local = false, defined = found.definition || !strcmp(name, f->model->time) || !strcmp(name, "pi");
    for (uint32_t i = 0; i < f->local_count; i++) local |= !strcmp(f->local[i], name);
    if (!local && (found.state || found.function)) return complain_arguments(f, t, found);
    if ((defined || local) && t->count == 2) {
        source_complain(s, MOTUS_SYNTAX, &t->at, "%s is not a function", name);
        hint_product(s, t, name);
        return false;
    }
    if (defined || local) {
        source_complain(s, MOTUS_SYNTAX, &t->at, "%s is not a function", name);
        return false;
    }
    source_complain(s, MOTUS_NAME, &t->at,
                    here ? "%s is not a function of the language" : "%s is neither a function nor defined", name);
    if (here) source_hint(s, "write %s", here);
    if (foreign_name(s, &t->item[0]->at)) return false;
    symbols_suggest_call(f->model, name);
    return false;
}

/* Statements ------------------------------------------------------------------------------------------------------- */

/* Complains about an index that stands alone on the left side and has no range. */
static bool check_left(model *m, const statement *s)
{
    for (uint32_t d = 0; d < s->index_count; d++) {
        const tree *t = s->index[d];
        if (t->kind != TREE_NAME || t->index_count || t->primes) continue;
        symbol found = symbols_find(m, t->name);
        bool runs = found.definition || found.state || !strcmp(t->name, m->time) || !strcmp(t->name, "pi");
        for (uint32_t k = 0; k < s->loop_count; k++) runs |= !strcmp(s->loops[k].name, t->name);
        if (runs) continue;
        source_complain(&m->source, MOTUS_NAME, &t->at, "the index %s has no range", t->name);
        source_hint(&m->source, "add: for %s = 1..N", t->name);
        return false;
    }
    return true;
}

/* Checks the parts of an event. */
static void find_in_when(finding *f, const when *w, const scope *all)
{
    if (w->left) find(f, w->left, all);
    if (w->right) find(f, w->right, all);
    for (const action *a = w->actions; a; a = a->next) {
        if (a->target) find(f, a->target, all);
        if (a->value) find(f, a->value, all);
    }
}

static bool check_statement(model *m, const statement *s)
{
    finding f = {.model = m};
    scope local[MAX_DIMS + MODEL_ARGUMENTS_MAX];
    const scope *all = NULL;
    if (!check_left(m, s)) return false;
    for (uint32_t k = 0; k < s->loop_count; k++) {
        find(&f, s->loops[k].first, s->kind == STATEMENT_WHEN ? all : NULL);
        find(&f, s->loops[k].last, s->kind == STATEMENT_WHEN ? all : NULL);
        local[k] = (scope){s->loops[k].name, all};
        all = &local[k];
    }
    for (uint32_t i = 1; s->kind == STATEMENT_FUNCTION && i < s->applied->count; i++) {
        local[i] = (scope){s->applied->item[i]->name, all};
        all = &local[i];
    }
    for (uint32_t d = 0; d < s->index_count; d++) find(&f, s->index[d], all);
    if (s->kind == STATEMENT_START) find(&f, s->applied->item[1], NULL);
    if (s->value) find(&f, s->value, all);
    if (s->kind == STATEMENT_WHEN) find_in_when(&f, s->when, all);
    if (!f.first) return true;
    return f.first->kind == TREE_NAME ? complain_name(&f, f.first) : complain_call(&f, f.first);
}

bool names_all(model *m)
{
    for (uint32_t i = 0; i < m->statements.count; i++)
        if (!check_statement(m, &m->statements.item[i])) return false;
    return true;
}
