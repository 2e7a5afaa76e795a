/* The catalogue: finds a row by its name, and tells which problems a row admits. The rows are in methods.c.
 *
 * Invariant: every refusal gives the reason and names the nearest method that admits the problem, of the same order
 * where there is one.
 */
#include "base/near.h"
#include "core/rows.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

size_t row_count(void) { return methods_count; }

const motus_method *row_card(size_t k) { return k < methods_count ? &methods_table[k].card : NULL; }

bool row_has(const row *r, family_fact fact)
{
#define FACTS_OF(NAME, name, shared, facts) [NAME] = facts,
    static const unsigned char of[] = {FAMILIES(FACTS_OF)};
    return (of[r->family] & fact) != 0;
}

bool row_uniform(const chosen *method) { return method->row->uniform; }
bool row_adaptive(const chosen *method) { return method->row->adaptive; }

bool row_formula(const chosen *method) { return row_has(method->row, FORMULA); }
bool row_rates(const chosen *method)
{
    const row *r = method->row;
    const bool trapezoidal = method->argument[0] == 0.25 && method->argument[1] == 0.5;
    return row_has(r, RATES) && !r->tableau.aa && (!r->newmark || trapezoidal);
}
bool row_gyroscopic(const chosen *method) { return method->row->gyroscopic; }
bool row_watched(const chosen *method) { return method->row->adaptive && row_has(method->row, SWINGS); }
bool row_bounded_by_ends(const chosen *method)
{
    const row *r = method->row;
    return !r->adaptive && row_has(r, FROM_ENDS) && r->tableau.dense.terms == 0;
}
bool row_orders(const chosen *method) { return method->row->orders; }
bool row_reversible_steps(const chosen *method) { return method->row->density; }

double row_weights(const chosen *method)
{
    const row *r = method->row;
    double squares = 0;
    for (int i = 0; r->family == RUNGE_KUTTA && i < r->tableau.stages; i++)
        squares += r->tableau.b[i] * r->tableau.b[i];
    return sqrt(squares);
}

/* Names --------------------------------------------------------------------------------------------------------- */

static char lower(char c) { return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c; }

/* Tells whether two names are equal in any letter case, with '_' for '-'. */
static bool same(const char *a, size_t length, const char *b, size_t b_length)
{
    if (length != b_length) return false;
    for (size_t i = 0; i < length; i++) {
        char c = lower(a[i]) == '_' ? '-' : lower(a[i]);
        if (c != lower(b[i])) return false;
    }
    return true;
}

static bool also_called(const motus_method *card, const char *name, size_t length)
{
    for (const char *word = card->aliases; *word;) {
        size_t n = strcspn(word, " ");
        if (same(name, length, word, n)) return true;
        word += n + (word[n] == ' ');
    }
    return false;
}

/* Looks at names before aliases, because a study looks up names alone and often. */
static const row *find(const char *name, size_t length)
{
    for (size_t k = 0; k < methods_count; k++)
        if (same(name, length, methods_table[k].card.name, strlen(methods_table[k].card.name)))
            return &methods_table[k];
    for (size_t k = 0; k < methods_count; k++)
        if (also_called(&methods_table[k].card, name, length)) return &methods_table[k];
    return NULL;
}

static void suggest(motus_error *err, const char *name, size_t length)
{
    char given[MOTUS_NAME_MAX + 1], other[MOTUS_NAME_MAX + 1];
    const char *nearest = NULL;
    int best = 2 * ((int)length / 3 + 2);
    snprintf(given, sizeof given, "%.*s", (int)length, name);
    for (size_t k = 0; k < methods_count && length <= MOTUS_NAME_MAX; k++) {
        const motus_method *card = &methods_table[k].card;
        int d = near_distance(given, card->name, best);
        for (const char *word = card->aliases; *word;) {
            size_t n = strcspn(word, " ");
            snprintf(other, sizeof other, "%.*s", (int)n, word);
            int e = near_distance(given, other, best);
            if (e < d) d = e;
            word += n + (word[n] == ' ');
        }
        if (d < best) {
            best = d;
            nearest = card->name;
        }
    }
    if (nearest)
        hint(err, "did you mean %s? `motus methods` lists them all", nearest);
    else
        hint(err, "`motus methods` lists them all");
    error_repair(err, given, "%s", nearest ? nearest : "");
}

/* Arguments ------------------------------------------------------------------------------------------------------- */

static const char *blanks(const char *s)
{
    while (*s == ' ' || *s == '\t') s++;
    return s;
}

/* Reads a number or a quotient of two. */
static const char *read_argument(const char *s, double *value)
{
    s = blanks(s);
    const bool negative = *s == '-';
    s += negative;
    size_t length = decimal_read(s, SIZE_MAX, value);
    if (!length) return NULL;
    if (negative) *value = 0 - *value;
    s = blanks(s + length);
    if (*s == '/') {
        double below = 1;
        s = blanks(s + 1);
        length = decimal_read(s, SIZE_MAX, &below);
        if (!length || below == 0) return NULL;
        *value /= below;
        s = blanks(s + length);
    }
    return isfinite(*value) ? s : NULL;
}

static motus_status read_arguments(const char *name, const char *s, chosen *out, motus_error *err)
{
    out->argument[0] = 0.25; /* Newmark's beta and gamma: the trapezoidal rule */
    out->argument[1] = 0.5;
    if (*s == '(') {
        s = read_argument(s + 1, &out->argument[0]);
        if (s && *s == ',')
            s = read_argument(s + 1, &out->argument[1]);
        else
            s = NULL;
        if (!s || *s != ')' || *blanks(s + 1)) {
            fail(err, MOTUS_METHOD, "\"%s\": %s takes two numbers between 0 and 1, beta and gamma", name,
                 out->row->card.name);
            hint(err, "write %s(1/4, 1/2), or %s alone for the same", out->row->card.name, out->row->card.name);
            return MOTUS_METHOD;
        }
    }
    if (!(out->argument[0] >= 0 && out->argument[0] <= 1 && out->argument[1] >= 0 && out->argument[1] <= 1)) {
        fail(err, MOTUS_METHOD, "\"%s\": beta and gamma must be between 0 and 1", name);
        hint(err, "usual choices: (1/4, 1/2) stable at every step, (1/6, 1/2) linear acceleration, (0, 1/2) explicit");
        return MOTUS_METHOD;
    }
    if (out->argument[1] != 0.5) out->row = &methods_newmark_damped;
    char beta[DECIMAL_MAX], gamma[DECIMAL_MAX];
    snprintf(out->name, sizeof out->name, "%.12s(%.23s, %.23s)", out->row->card.name, decimal(out->argument[0], beta),
             decimal(out->argument[1], gamma));
    return MOTUS_OK;
}

motus_status row_choose(const char *name, chosen *out, const motus_method **card, motus_error *err)
{
    chosen result = {.relative = ROW_TOLERANCE, .most = INFINITY};
    if (!name) return fail(err, MOTUS_METHOD, "the name of the method is NULL");
    const char *start = blanks(name);
    size_t length = strcspn(start, "( \t");
    const char *rest = blanks(start + length);
    result.row = find(start, length);
    if (!result.row) {
        fail(err, MOTUS_METHOD, "there is no method called \"%.*s\"",
             (int)(length < MOTUS_NAME_MAX ? length : MOTUS_NAME_MAX), start);
        suggest(err, start, length);
        return MOTUS_METHOD;
    }
    if (*rest && !(*rest == '(' && result.row->arguments)) {
        fail(err, MOTUS_METHOD, "\"%s\": %s takes no arguments", name, result.row->card.name);
        hint(err, "write %s", result.row->card.name);
        return MOTUS_METHOD;
    }
    if (result.row->arguments) {
        motus_status status = read_arguments(name, rest, &result, err);
        if (status) return status;
    } else {
        snprintf(result.name, sizeof result.name, "%s", result.row->card.name);
    }
    if (out) *out = result;
    if (card) *card = &result.row->card;
    return MOTUS_OK;
}

/* Admission -------------------------------------------------------------------------------------------------------- */

static const char *reason(const row *row, const traits *traits)
{
    if (row_has(row, FORMULA))
        return traits->has_exact || traits->constant
                   ? ""
                   : "the model has no exact line, and its exact motion is not recognised";
    if (row->gyroscopic) {
        if (!traits->velocity)
            return "the acceleration does not depend on the velocity, so the Boris rotation has no v × B to rotate by";
        if (traits->first_order)
            return "the Boris rotation does not cover first-order variables, and the model has some";
        if (!traits->gyroscopic || !traits->linear_v)
            return "the velocity term is not of the form v × B: its matrix is not antisymmetric, so it does work";
        return "";
    }
    if (traits->quadrature && row_has(row, KICKS))
        return row->nystrom ? "a first-order variable depends on the velocity, and then this method loses its order"
                            : "";
    if (row->expands && !traits->series) return "the acceleration is a callback, and Taylor series need its formula";
    if (traits->velocity && row->card.forces != MOTUS_FORCES_XVT)
        return traits->first_order
                   ? "the right sides depend on a velocity or a first-order variable, and this method's kicks must not"
                   : "the acceleration depends on the velocity, and this method's kicks must not";
    if (traits->time && row->card.forces == MOTUS_FORCES_X) return "the acceleration depends on time";
    return "";
}

/* Returns how far `other` is from the row `wanted`: by order first, then by the properties that its card states. */
static int unlike(const motus_method *wanted, const motus_method *other)
{
    int order = wanted->order == 0 ? 2 : wanted->order; /* exact has no order: offer order 2 */
    return 8 * abs(order - other->order) + 4 * (wanted->symplectic > other->symplectic) +
           4 * (wanted->reversible > other->reversible) + 2 * (other->evaluations == 0);
}

static motus_geometry geometry(const row *row, const traits *t)
{
    if (row->card.symplectic && t->gradient && !t->velocity && !t->first_order) return MOTUS_GEOMETRY_SYMPLECTIC;
    if (row_has(row, KICKS) && !row->adaptive && (!t->velocity || t->quadrature || t->gyroscopic))
        return MOTUS_GEOMETRY_VOLUME;
    return MOTUS_GEOMETRY_NONE;
}

motus_geometry row_geometry(const chosen *method, const traits *t) { return geometry(method->row, t); }

motus_status row_admits(const chosen *method, const traits *traits, motus_error *err)
{
    const char *why = reason(method->row, traits);
    if (!*why) return MOTUS_OK;
    const row *nearest = NULL;
    for (size_t k = 0; k < methods_count; k++) {
        const row *other = &methods_table[k];
        if (row_has(other, FORMULA) || other->uniform || other->adaptive != method->row->adaptive ||
            *reason(other, traits))
            continue;
        if (!nearest || unlike(&method->row->card, &other->card) < unlike(&method->row->card, &nearest->card))
            nearest = other;
    }
    fail(err, MOTUS_METHOD, "%s does not admit this model: %s", method->name, why);
    if (nearest)
        hint(err, "%s fits: order %d%s%s", nearest->card.name, nearest->card.order,
             geometry(nearest, traits) == MOTUS_GEOMETRY_SYMPLECTIC ? ", symplectic" : "",
             nearest->card.reversible ? ", reversible" : "");
    return MOTUS_METHOD;
}
