/* What a model is, and what methods there are, for the page. */
#include "lab/core/core.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void describe_columns(json *j, const motus_system *s)
{
    static const char *const kinds[] = {
        [MOTUS_COLUMN_TIME] = "time", [MOTUS_COLUMN_POSITION] = "position", [MOTUS_COLUMN_VELOCITY] = "velocity", [MOTUS_COLUMN_COMPANION] = "companion",
        [MOTUS_COLUMN_QUANTITY] = "quantity", [MOTUS_COLUMN_INVARIANT] = "invariant", [MOTUS_COLUMN_EXACT] = "exact",
    };
    json_open(j, "columns", '[');
    for (size_t k = 0; k < motus_column_count(s); k++) {
        motus_column c = motus_default_column();
        if (motus_column_at(s, k, &c) != MOTUS_OK)
            continue;
        json_open(j, NULL, '{');
        json_string(j, "name", c.name);
        json_string(j, "kind", kinds[c.kind]);
        json_number(j, "variable", (double)c.variable);
        json_number(j, "component", c.component);
        json_bool(j, "isVelocity", c.is_velocity);
        json_close(j, '}');
    }
    json_close(j, ']');
    json_open(j, "variables", '[');
    for (size_t k = 0; k < motus_variable_count(s); k++) {
        motus_variable v = motus_default_variable();
        if (motus_variable_at(s, k, &v) != MOTUS_OK)
            continue;
        json_open(j, NULL, '{');
        json_string(j, "name", v.name);
        json_number(j, "order", v.order);
        json_number(j, "components", v.components);
        json_number(j, "dimensions", v.dimensions);
        json_number(j, "count", (double)v.count);
        json_close(j, '}');
    }
    json_close(j, ']');
}

/* More numbers than this are no sliders. */
enum { NUMBERS_MAX = 64 };

static void describe_parameters(json *j, const motus_system *s)
{
    double values[NUMBERS_MAX];
    json_open(j, "parameters", '[');
    for (size_t k = 0; k < motus_parameter_count(s); k++) {
        motus_parameter p = motus_default_parameter();
        if (motus_parameter_at(s, k, &p) != MOTUS_OK || p.count > NUMBERS_MAX || motus_parameter_values(s, k, values) != MOTUS_OK)
            continue;
        json_open(j, NULL, '{');
        json_string(j, "name", p.name);
        json_number(j, "components", p.components);
        json_bool(j, "list", p.list);
        json_part(j, "text", p.text, p.length);
        json_string(j, "decides", p.decides);
        json_bool(j, "initial", false);
        json_numbers(j, "values", values, p.count);
        json_close(j, '}');
    }
    for (size_t k = 0; k < motus_initial_count(s); k++) {
        motus_initial i = motus_default_initial();
        motus_variable v = motus_default_variable();
        if (motus_initial_at(s, k, &i) != MOTUS_OK || i.count > NUMBERS_MAX || motus_variable_at(s, i.variable, &v) != MOTUS_OK ||
            motus_initial_values(s, k, values) != MOTUS_OK)
            continue;
        json_open(j, NULL, '{');
        json_string(j, "name", i.name);
        json_number(j, "components", v.components);
        json_bool(j, "list", v.dimensions > 0);
        json_string(j, "text", "");
        json_string(j, "decides", NULL);
        json_bool(j, "initial", true);
        json_numbers(j, "values", values, i.count);
        json_close(j, '}');
    }
    json_close(j, ']');
}

static void describe_analysis(json *j, const motus_system *s)
{
    motus_analysis a = motus_default_analysis();
    motus_analysis_of(s, &a);
    json_open(j, "analysis", '{');
    json_bool(j, "velocityDependent", a.velocity_dependent);
    json_bool(j, "linearInVelocity", a.linear_in_velocity);
    json_bool(j, "timeDependent", a.time_dependent);
    json_bool(j, "affine", a.affine);
    json_bool(j, "constant", a.constant);
    json_bool(j, "gyroscopic", a.gyroscopic);
    json_bool(j, "gradient", a.gradient);
    json_bool(j, "smooth", a.smooth);
    json_bool(j, "exactRecognised", a.exact_recognised);
    json_close(j, '}');
}

/* What a model calls its method, by the method's own name; what there is not, and what has arguments, as it is written. */
static const char *method_of(const motus_settings *settings)
{
    const motus_method *found;
    if (!settings->method)
        return "";
    return strchr(settings->method, '(') || motus_method_find(settings->method, &found, NULL) != MOTUS_OK ? settings->method : found->name;
}

/* The model that is open, as the page wants it (protocol.ts, Description). NULL: no memory. */
LAB_CALL(lab_describe) const char *lab_describe(lab *l)
{
    json *j = &l->json;
    motus_system *s = l->system;
    json_clear(j);
    json_open(j, NULL, '{');
    json_open(j, "statements", '[');
    static const char *const kinds[] = {
        [MOTUS_STATEMENT_MOTION] = "motion", [MOTUS_STATEMENT_COMPANION] = "companion", [MOTUS_STATEMENT_PARAMETER] = "parameter",
        [MOTUS_STATEMENT_QUANTITY] = "quantity", [MOTUS_STATEMENT_START] = "start", [MOTUS_STATEMENT_BOUNDARY] = "boundary",
        [MOTUS_STATEMENT_EXACT] = "exact", [MOTUS_STATEMENT_INVARIANT] = "invariant", [MOTUS_STATEMENT_SETTING] = "setting",
    };
    for (size_t k = 0; k < motus_statement_count(s); k++) {
        motus_statement t = motus_default_statement();
        const char *mathml = motus_statement_mathml(s, k);
        if (motus_statement_at(s, k, &t) != MOTUS_OK || !mathml)
            continue;
        json_open(j, NULL, '{');
        json_string(j, "kind", kinds[t.kind]);
        json_number(j, "line", t.line);
        json_string(j, "mathml", mathml);
        json_close(j, '}');
    }
    json_close(j, ']');
    json_string(j, "explain", motus_explain(s));
    describe_analysis(j, s);
    describe_columns(j, s);
    describe_parameters(j, s);
    motus_settings settings = motus_default_settings();
    motus_settings_of(s, &settings);
    json_open(j, "settings", '{');
    json_string(j, "method", method_of(&settings));
    json_number(j, "step", settings.step);
    json_number(j, "until", settings.until);
    json_number(j, "start", settings.from);
    json_close(j, '}');
    json_bool(j, "hasExact", motus_has_exact(s));
    json_open(j, "admissions", '[');
    for (size_t k = 0; k < motus_method_count(); k++) {
        motus_error why = motus_default_error();
        const char *name = motus_method_at(k)->name;
        const bool admitted = motus_method_admits(s, name, &why) == MOTUS_OK;
        json_open(j, NULL, '{');
        json_string(j, "method", name);
        json_bool(j, "admitted", admitted);
        json_string(j, "reason", admitted ? "" : why.message);
        json_string(j, "hint", admitted ? "" : why.hint);
        json_close(j, '}');
    }
    json_close(j, ']');
    json_close(j, '}');
    return json_text(j);
}

/* The catalogue of methods (protocol.ts, Method). */
LAB_CALL(lab_catalogue) const char *lab_catalogue(lab *l)
{
    json *j = &l->json;
    json_clear(j);
    json_open(j, NULL, '[');
    for (size_t k = 0; k < motus_method_count(); k++) {
        const motus_method *m = motus_method_at(k);
        json_open(j, NULL, '{');
        json_string(j, "name", m->name);
        json_string(j, "aliases", m->aliases);
        json_string(j, "title", m->title);
        json_string(j, "family", m->family);
        json_number(j, "order", m->order);
        json_number(j, "stages", m->stages);
        json_number(j, "evaluations", m->evaluations);
        json_bool(j, "symplectic", m->symplectic);
        json_bool(j, "reversible", m->reversible);
        json_number(j, "stabilityLimit", m->stability_limit);
        json_string(j, "cite", m->cite);
        json_string(j, "formula", m->formula);
        json_string(j, "use", m->use);
        json_close(j, '}');
    }
    json_close(j, ']');
    return json_text(j);
}
