/* Results as JSON.
 *
 * Invariant: scripts read these keys, so a key keeps its name and meaning; new numbers get new keys.
 */
#include "tell/tell.h"

#include <string.h>

/* Writes the list of the parts of a text between separators, without empty ones. */
static void parts(json *j, const char *key, const char *text, char separator)
{
    const char separators[] = {separator, 0};
    json_open(j, key, '[');
    for (const char *s = text ? text : ""; *s;) {
        const size_t length = strcspn(s, separators);
        if (length) json_part(j, NULL, s, length);
        s += length + (s[length] == separator);
    }
    json_close(j, ']');
}

/* Methods --------------------------------------------------------------------------------------------------------- */

const char *tell_forces(motus_forces f)
{
    return f == MOTUS_FORCES_X ? "x" : f == MOTUS_FORCES_XT ? "x, t" : "x, x', t";
}

static void method(json *j, const motus_method *m)
{
    json_open(j, NULL, '{');
    json_string(j, "name", m->name);
    parts(j, "aliases", m->aliases, ' ');
    json_string(j, "title", m->title);
    json_string(j, "family", m->family);
    json_integer(j, "order", m->order);
    json_integer(j, "dense_order", m->dense_order);
    json_integer(j, "stages", m->stages);
    json_integer(j, "evaluations", m->evaluations);
    json_string(j, "forces", tell_forces(m->forces));
    json_bool(j, "symplectic", m->symplectic);
    json_bool(j, "reversible", m->reversible);
    json_bool(j, "adaptive", m->adaptive);
    json_number(j, "stability_limit", m->stability_limit); /* null: none */
    json_bool(j, "by_rates", motus_method_by_rates(m->name));
    json_string(j, "cite", m->cite);
    json_string(j, "formula", m->formula);
    json_string(j, "use", m->use);
    json_close(j, '}');
}

void tell_methods(json *j, const motus_method *only)
{
    json_open(j, "methods", '[');
    for (size_t k = 0; k < motus_method_count(); k++)
        if (!only || motus_method_at(k) == only) method(j, motus_method_at(k));
    json_close(j, ']');
}

/* Models ---------------------------------------------------------------------------------------------------------- */

const char *tell_reason(const char *message, const char *method)
{
    static const char words[] = " does not admit this model: ";
    const size_t length = strlen(method);
    const bool said = strncmp(message, method, length) == 0 && strncmp(message + length, words, sizeof words - 1) == 0;
    return said ? message + length + sizeof words - 1 : message;
}

void tell_variables(json *j, const motus_system *system)
{
    motus_variable v = motus_default_variable();
    json_open(j, "variables", '[');
    for (size_t k = 0; motus_variable_at(system, k, &v) == MOTUS_OK; k++) {
        json_open(j, NULL, '{');
        json_string(j, "name", v.name);
        json_integer(j, "order", v.order);
        json_integer(j, "components", v.components);
        json_open(j, "ranges", '[');
        for (int d = 0; d < v.dimensions; d++) {
            json_open(j, NULL, '[');
            json_integer(j, NULL, v.first[d]);
            json_integer(j, NULL, v.last[d]);
            json_close(j, ']');
        }
        json_close(j, ']');
        json_integer(j, "count", (int64_t)v.count);
        json_close(j, '}');
    }
    json_close(j, ']');
}

const char *tell_geometry(motus_geometry geometry)
{
    return geometry == MOTUS_GEOMETRY_SYMPLECTIC ? "symplectic" : geometry == MOTUS_GEOMETRY_VOLUME ? "volume" : "";
}

void tell_analysis(json *j, const motus_system *system)
{
    motus_analysis a = motus_default_analysis();
    motus_analysis_of(system, &a);
    json_bool(j, "velocity_dependent", a.velocity_dependent);
    json_bool(j, "linear_in_velocity", a.linear_in_velocity);
    json_bool(j, "time_dependent", a.time_dependent);
    json_bool(j, "affine", a.affine);
    json_bool(j, "constant", a.constant);
    json_bool(j, "gyroscopic", a.gyroscopic);
    json_bool(j, "gradient", a.gradient);
    json_bool(j, "sampled_gyroscopic", a.sampled_gyroscopic);
    json_bool(j, "sampled_gradient", a.sampled_gradient);
    json_bool(j, "energy", a.energy);
    json_bool(j, "smooth", a.smooth);
    json_bool(j, "exact_recognised", a.exact_recognised);
}

void tell_switches(json *j, motus_system *system)
{
    static const char *const sliding[] = {NULL, "passes", "held", "ends"};
    motus_switch s = motus_default_switch();
    json_open(j, "switches", '[');
    for (size_t k = 0; motus_switch_at(system, k, &s) == MOTUS_OK; k++) {
        json_open(j, NULL, '{');
        json_string(j, "operation", s.operation);
        json_string(j, "surface", s.surface);
        json_integer(j, "count", (int64_t)s.count);
        json_bool(j, "located", s.located);
        json_string(j, "not_located", *s.not_located ? s.not_located : NULL);
        json_string(j, "sliding", sliding[s.sliding]);
        json_close(j, '}');
    }
    json_close(j, ']');
}

void tell_admissions(json *j, const motus_system *system)
{
    json_open(j, "methods", '[');
    for (size_t k = 0; k < motus_method_count(); k++) {
        motus_error why = motus_default_error();
        const char *name = motus_method_at(k)->name;
        motus_geometry geometry = MOTUS_GEOMETRY_NONE;
        const bool admitted = motus_method_geometry(system, name, &geometry, &why) == MOTUS_OK;
        json_open(j, NULL, '{');
        json_string(j, "name", name);
        json_bool(j, "admitted", admitted);
        json_bool(j, "adaptive", motus_method_at(k)->adaptive);
        json_string(j, "preserves", tell_geometry(geometry));
        json_string(j, "reason", admitted ? "" : tell_reason(why.message, name));
        json_string(j, "hint", admitted ? "" : why.hint);
        json_close(j, '}');
    }
    json_close(j, ']');
}

/* Studies --------------------------------------------------------------------------------------------------------- */

static void drift(json *j, const motus_drift *d)
{
    json_open(j, d->name, '{');
    json_number(j, "initial", d->initial);
    json_number(j, "final", d->final);
    json_number(j, "max_drift", d->max_drift);
    json_number(j, "trend", d->trend);
    json_bool(j, "trending", d->trending);
    json_close(j, '}');
}

static void compare_row(json *j, const motus_compare_row *r)
{
    json_open(j, NULL, '{');
    json_string(j, "method", r->method);
    json_integer(j, "order", r->order);
    json_string(j, "status", motus_status_word(r->status));
    json_number(j, "step", r->step);
    json_integer(j, "steps", r->steps);
    json_integer(j, "evaluations", r->evaluations);
    json_number(j, "seconds", r->seconds);
    json_number(j, "error_max", r->error_max_x);
    json_number(j, "error_final", r->error_final_x);
    json_number(j, "error_max_v", r->error_max_v);
    json_number(j, "error_final_v", r->error_final_v);
    json_number(j, "error_max_s", r->error_max_s);
    json_number(j, "error_final_s", r->error_final_s);
    json_open(j, "invariants", '{');
    for (size_t k = 0; k < r->invariant_count; k++) drift(j, r->invariants[k]);
    json_close(j, '}');
    json_number(j, "reversal", r->reversal);
    json_string(j, "note", r->note ? r->note : "");
    json_close(j, '}');
}

void tell_comparison(json *j, const motus_comparison *c)
{
    json_string(j, "reference", c->reference);
    json_number(j, "reference_error", c->reference_error);
    json_open(j, "rows", '[');
    for (size_t k = 0; k < c->row_count; k++) compare_row(j, c->rows[k]);
    json_close(j, ']');
    parts(j, "remarks", c->remarks, '\n');
}

static void converge_row(json *j, const motus_converge_row *r)
{
    json_open(j, NULL, '{');
    json_string(j, "method", r->method);
    json_integer(j, "declared", r->declared);
    json_number(j, "observed", r->observed);
    json_number(j, "standard_error", r->standard_error);
    json_bool(j, "exact_here", r->exact_here);
    json_bool(j, "passed", r->passed);
    json_bool(j, "adaptive", r->adaptive);
    json_bool(j, "uncertain", r->uncertain);
    if (r->adaptive) {
        json_number(j, "power", r->power);
        json_number(j, "power_error", r->power_error);
        json_number(j, "power_due", r->power_due);
        json_number(j, "between", r->between);
        json_number(j, "between_error", r->between_error);
        json_integer(j, "between_due", r->between_due);
    }
    json_string(j, "status", motus_status_word(r->status));
    json_string(j, "certificate", r->certificate ? r->certificate : "");
    json_open(j, "points", '[');
    for (size_t i = 0; i < r->point_count; i++) {
        json_open(j, NULL, '{');
        json_number(j, "step", r->points[i]->step);
        json_number(j, "error", r->points[i]->error);
        json_integer(j, "evaluations", r->points[i]->evaluations);
        json_bool(j, "used", r->points[i]->used);
        if (r->adaptive) json_number(j, "tolerance", r->points[i]->tolerance);
        if (r->adaptive) json_number(j, "error_between", r->points[i]->error_between);
        json_close(j, '}');
    }
    json_close(j, ']');
    json_close(j, '}');
}

void tell_convergence(json *j, const motus_convergence *c)
{
    json_string(j, "reference", c->reference);
    json_number(j, "reference_error", c->reference_error);
    json_bool(j, "passed", c->passed);
    json_open(j, "rows", '[');
    for (size_t k = 0; k < c->row_count; k++) converge_row(j, c->rows[k]);
    json_close(j, ']');
}

static void rank_point(json *j, const motus_rank_point *p, bool adaptive)
{
    json_open(j, NULL, '{');
    json_number(j, "accuracy", p->accuracy);
    json_number(j, adaptive ? "tolerance" : "step", p->setting);
    json_number(j, "error", p->error); /* null: the accuracy was not reached */
    json_integer(j, "steps", p->steps);
    json_integer(j, "evaluations", p->evaluations);
    json_number(j, "seconds", p->seconds);
    json_close(j, '}');
}

static void cheapest(json *j, const motus_ranking *r, const char *key, size_t row)
{
    json_string(j, key, row < r->row_count ? r->rows[row]->method : NULL);
}

void tell_ranking(json *j, const motus_ranking *r)
{
    json_string(j, "reference", r->reference);
    json_number(j, "reference_error", r->reference_error);
    json_bool(j, "absolute", r->absolute);
    json_string(j, "machine", r->machine);
    json_numbers(j, "accuracies", r->accuracies, r->judged);
    json_numbers(j, "refused", r->accuracies + r->judged, r->accuracy_count - r->judged);
    json_open(j, "rows", '[');
    for (size_t k = 0; k < r->row_count; k++) {
        const motus_rank_row *row = r->rows[k];
        json_open(j, NULL, '{');
        json_string(j, "method", row->method);
        json_integer(j, "order", row->order);
        json_bool(j, "adaptive", row->adaptive);
        json_string(j, "status", motus_status_word(row->status));
        json_string(j, "note", row->note);
        json_open(j, "points", '[');
        for (size_t i = 0; i < r->judged; i++) rank_point(j, row->points[i], row->adaptive);
        json_close(j, ']');
        json_close(j, '}');
    }
    json_close(j, ']');
    json_open(j, "cheapest", '[');
    for (size_t i = 0; i < r->judged; i++) {
        json_open(j, NULL, '{');
        json_number(j, "accuracy", r->accuracies[i]);
        cheapest(j, r, "evaluations", r->fewest[i]);
        cheapest(j, r, "time", r->fastest[i]);
        json_close(j, '}');
    }
    json_close(j, ']');
    parts(j, "remarks", r->remarks, '\n');
}

/* Error bars ------------------------------------------------------------------------------------------------------ */

void tell_estimate(json *j, const motus_estimate *e)
{
    json_number(j, "significant_until", e->significant_until); /* null: digits are significant up to the end */
    json_number(j, "error_rate", e->rate);
    json_number(j, "error_growth", e->growth);
    json_number(j, "error_work", e->work);
    json_bool(j, "kinked", e->kinked);
    json_string(j, "error_reason", e->reason);
}

/* Events ---------------------------------------------------------------------------------------------------------- */

void tell_event(json *j, const motus_event_row *e)
{
    json_string(j, "name", e->instance);
    json_number(j, "time", e->time);
    json_number(j, "error", e->error); /* null: not known */
    json_integer(j, "count", e->count);
    json_bool(j, "touched", e->touched);
}

void tell_ended(json *j, motus_run *run)
{
    int accumulated = 0;
    double time, error;
    const char *const name = motus_run_ended(run, &accumulated, &time, &error);
    json_string(j, "ended", name[0] ? name : NULL);
    if (!accumulated) {
        json_string(j, "accumulated", NULL);
        return;
    }
    json_open(j, "accumulated", '{');
    json_number(j, "time", time);
    json_number(j, "error", error);
    json_close(j, '}');
}

/* Errors ---------------------------------------------------------------------------------------------------------- */

void tell_diagnosis(json *j, const motus_error *err)
{
    if (!err || err->cause == MOTUS_CAUSE_NONE) {
        json_string(j, "diagnosis", NULL);
        return;
    }
    json_open(j, "diagnosis", '{');
    json_string(j, "cause", motus_cause_word(err->cause));
    json_string(j, "variable", err->variable);
    json_number(j, "time", err->time);
    json_number(j, "singular", err->singular); /* null: the force is not singular, or the time is not known */
    json_number(j, "singular_error", err->singular_error);
    json_number(j, "exponent", err->exponent);
    json_number(j, "exponent_error", err->exponent_error);
    json_string(j, "try", err->attempt);
    json_bool(j, "verified", err->verified);
    json_close(j, '}');
}

void tell_error(json *j, const motus_error *err, const char *message)
{
    json_string(j, "kind", motus_status_word(err->status));
    json_string(j, "message", message);
    json_integer(j, "line", err->line);
    json_integer(j, "column", err->column);
}
