/* What a model is, and what methods there are, for the page. */
#include "lab/core/core.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void describe_columns(json *j, const motus_system *s)
{
    static const char *const kinds[] = {
        [MOTUS_COLUMN_TIME] = "time",         [MOTUS_COLUMN_POSITION] = "position",
        [MOTUS_COLUMN_VELOCITY] = "velocity", [MOTUS_COLUMN_FIRST_ORDER] = "first-order",
        [MOTUS_COLUMN_QUANTITY] = "quantity", [MOTUS_COLUMN_INVARIANT] = "invariant",
        [MOTUS_COLUMN_EXACT] = "exact",
    };
    json_open(j, "columns", '[');
    for (size_t k = 0; k < motus_column_count(s); k++) {
        motus_column c = motus_default_column();
        if (motus_column_at(s, k, &c) != MOTUS_OK) continue;
        json_open(j, NULL, '{');
        json_string(j, "name", c.name);
        json_string(j, "kind", kinds[c.kind]);
        json_integer(j, "variable", (int64_t)c.variable);
        json_close(j, '}');
    }
    json_close(j, ']');
}

/* More numbers than this are no sliders. */
enum { NUMBERS_MAX = 64 };

typedef struct adjustable {
    const char *name, *text;
    size_t length, count;
    int components, list;
    bool initial;
} adjustable;

static void describe_adjustable(json *j, const adjustable *a, const double *values)
{
    json_open(j, NULL, '{');
    json_string(j, "name", a->name);
    json_integer(j, "components", a->components);
    json_bool(j, "list", a->list);
    json_part(j, "text", a->text, a->length);
    json_bool(j, "initial", a->initial);
    json_numbers(j, "values", values, a->count);
    json_close(j, '}');
}

static void describe_parameters(json *j, const motus_system *s)
{
    double values[NUMBERS_MAX];
    motus_parameter p = motus_default_parameter();
    motus_initial i = motus_default_initial();
    motus_variable v = motus_default_variable();
    json_open(j, "parameters", '[');
    for (size_t k = 0; motus_parameter_at(s, k, &p) == MOTUS_OK; k++)
        if (p.count <= NUMBERS_MAX && motus_parameter_values(s, k, values) == MOTUS_OK) {
            const adjustable a = {p.name, p.text, p.length, p.count, p.components, p.list, false};
            describe_adjustable(j, &a, values);
        }
    for (size_t k = 0; motus_initial_at(s, k, &i) == MOTUS_OK; k++)
        if (i.count <= NUMBERS_MAX && motus_variable_at(s, i.variable, &v) == MOTUS_OK &&
            motus_initial_values(s, k, values) == MOTUS_OK) {
            const adjustable a = {i.name, "", 0, i.count, v.components, v.dimensions > 0, true};
            describe_adjustable(j, &a, values);
        }
    json_close(j, ']');
}

/* What a model calls its method, by the method's own name; what has arguments, as it is written. */
static const char *method_of(const motus_settings *settings)
{
    const motus_method *found;
    if (settings->method_said != MOTUS_SAID_MODEL) return "";
    return strchr(settings->method, '(') || motus_method_find(settings->method, &found, NULL) != MOTUS_OK
               ? settings->method
               : found->name;
}

static void describe_statements(json *j, motus_system *s)
{
    static const char *const kinds[] = {
        [MOTUS_STATEMENT_MOTION] = "motion",       [MOTUS_STATEMENT_FIRST_ORDER] = "first-order",
        [MOTUS_STATEMENT_PARAMETER] = "parameter", [MOTUS_STATEMENT_QUANTITY] = "quantity",
        [MOTUS_STATEMENT_START] = "start",         [MOTUS_STATEMENT_BOUNDARY] = "boundary",
        [MOTUS_STATEMENT_EXACT] = "exact",         [MOTUS_STATEMENT_INVARIANT] = "invariant",
        [MOTUS_STATEMENT_SETTING] = "setting",     [MOTUS_STATEMENT_FUNCTION] = "function",
        [MOTUS_STATEMENT_EVENT] = "event",
    };
    json_open(j, "statements", '[');
    for (size_t k = 0; k < motus_statement_count(s); k++) {
        motus_statement t = motus_default_statement();
        const char *mathml = motus_statement_mathml(s, k);
        if (motus_statement_at(s, k, &t) != MOTUS_OK || !mathml) continue;
        json_open(j, NULL, '{');
        json_string(j, "kind", kinds[t.kind]);
        json_integer(j, "line", t.line);
        json_string(j, "mathml", mathml);
        json_close(j, '}');
    }
    json_close(j, ']');
}

static void suggest(json *j, const char *line, const char *why)
{
    json_open(j, NULL, '{');
    json_string(j, "line", line);
    json_string(j, "why", why);
    json_close(j, '}');
}

/* r'(0) = (0, 0), or x[i]'(0) = 0 for i = 1..8. "": a family with gaps, or a text without end. */
static void rest_of(const motus_initial *i, const motus_variable *v, char *line, size_t size)
{
    static const char *const indices[] = {"", "[i]", "[i,j]", "[i,j,k]", "[i,j,k,l]"};
    const size_t parts = v->components ? (size_t)v->components : 1;
    size_t n = (size_t)snprintf(line, size, "%s%s%s = %s0", v->name, indices[v->dimensions], i->name + strlen(v->name),
                                v->components ? "(" : ""),
           cells = 1;
    for (size_t k = 1; k < parts && n < size; k++) n += (size_t)snprintf(line + n, size - n, ", 0");
    if (v->components && n < size) n += (size_t)snprintf(line + n, size - n, ")");
    for (int d = 0; d < v->dimensions && n < size; d++) {
        n += (size_t)snprintf(line + n, size - n, "%s %c = %lld..%lld", d ? "," : " for", 'i' + d,
                              (long long)v->first[d], (long long)v->last[d]);
        cells *= (size_t)(v->last[d] - v->first[d] + 1);
    }
    if (n >= size || cells * parts != v->count) line[0] = 0;
}

/* Lines that would make the text say what was supposed. */
static void describe_suggestions(json *j, const motus_system *s, const motus_settings *set)
{
    char line[256];
    motus_initial i = motus_default_initial();
    motus_variable v = motus_default_variable();
    json_open(j, "suggestions", '[');
    for (size_t k = 0; motus_initial_at(s, k, &i) == MOTUS_OK; k++) {
        if (!i.supposed || motus_variable_at(s, i.variable, &v) != MOTUS_OK) continue;
        rest_of(&i, &v, line, sizeof line);
        if (line[0]) suggest(j, line, "at rest, not given");
    }
    if (set->step_said == MOTUS_SAID_SUGGESTED) {
        snprintf(line, sizeof line, "step  %.15g", set->step);
        suggest(j, line, set->step_why);
    }
    if (set->until_said == MOTUS_SAID_SUGGESTED) {
        snprintf(line, sizeof line, "until %.15g", set->until);
        suggest(j, line, set->until_why);
    }
    json_close(j, ']');
}

/* The model that is open, as the page wants it (protocol.ts, Description). NULL: no memory. */
LAB_CALL(lab_describe) const char *lab_describe(lab *l)
{
    motus_system *s = l->system;
    motus_settings set = motus_default_settings();
    motus_settings_of(s, &set);
    const bool suggested = isnan(set.step) || isnan(set.until);
    if (suggested) motus_suggest(s, &set, NULL); /* after a failure they stay unknown */
    json j = lab_answer(l);
    tell_variables(&j, s);
    tell_analysis(&j, s);
    tell_admissions(&j, s);
    describe_statements(&j, s);
    describe_columns(&j, s);
    describe_parameters(&j, s);
    json_open(&j, "settings", '{');
    json_string(&j, "method", method_of(&set));
    json_number(&j, "step", set.step);
    json_number(&j, "tolerance", set.tolerance);
    json_number(&j, "accuracy", set.accuracy);
    json_bool(&j, "absolute", set.absolute);
    json_bool(&j, "automatic", set.automatic);
    json_number(&j, "until", set.until);
    json_number(&j, "start", set.from);
    json_bool(&j, "suggested", suggested);
    json_close(&j, '}');
    describe_suggestions(&j, s, &set);
    json_bool(&j, "has_exact", motus_has_exact(s));
    return lab_answered(l, &j);
}

/* The catalogue of methods (protocol.ts, Method). */
LAB_CALL(lab_catalogue) const char *lab_catalogue(lab *l)
{
    json j = lab_answer(l);
    tell_methods(&j, NULL);
    return lab_answered(l, &j);
}

/* The words of a text: three numbers each, its first byte, the one behind it, its kind. Returns how many words. */
LAB_CALL(lab_words) size_t lab_words(const char *text, size_t length, uint32_t *out, size_t room)
{
    motus_word *words = malloc((room + 1) * sizeof *words);
    const size_t count = words ? motus_text_words(text, length, words, room) : 0;
    for (size_t k = 0; k < count; k++) {
        out[3 * k] = (uint32_t)words[k].from;
        out[3 * k + 1] = (uint32_t)(words[k].from + words[k].length);
        out[3 * k + 2] = (uint32_t)words[k].kind;
    }
    free(words);
    return count;
}

/* The words of the language (protocol.ts, Vocabulary). */
LAB_CALL(lab_vocabulary) const char *lab_vocabulary(lab *l)
{
    static const struct {
        const char *key;
        motus_word_kind kind;
    } lists[] = {{"functions", MOTUS_WORD_FUNCTION},
                 {"settings", MOTUS_WORD_SETTING},
                 {"names", MOTUS_WORD_KNOWN},
                 {"operators", MOTUS_WORD_OPERATOR}};
    json j = lab_answer(l);
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        motus_word_kind kind;
        json_open(&j, lists[i].key, '[');
        for (size_t k = 0; motus_language_word(k, &kind); k++)
            if (kind == lists[i].kind) json_string(&j, NULL, motus_language_word(k, NULL));
        json_close(&j, ']');
    }
    return lab_answered(l, &j);
}
