/* What `motus run` prints of a finished run.
 *
 * Invariant: values are read from the run by column, so that they are those of the CSV. All are read before the first
 * is printed, so that a failure prints nothing.
 */
#include "cli/run/summary.h"

#include "cli/model/settle.h"
#include "cli/run/figure.h"
#include "cli/words/complain.h"
#include "cli/words/text.h"
#include "tell/bar.h"
#include "tell/tell.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SHOWN = 12 }; /* numbers of one name in a table */

/* Reads the values of columns [first, first + count), or their errors: NaN if they are not known. */
static motus_status numbers_of(const summary *s, bool errors, size_t first, size_t count, double **out,
                               motus_error *err)
{
    size_t *columns = malloc((count + 1) * sizeof *columns);
    *out = malloc((count + 1) * sizeof **out);
    motus_status status = columns && *out ? MOTUS_OK : complain_memory(err);
    for (size_t k = 0; !status && k < count; k++) columns[k] = first + k;
    if (!status && count > 0)
        status = errors ? motus_run_errors(s->run, columns, count, NULL, *out, err)
                        : motus_run_values(s->run, columns, count, *out, err);
    for (size_t k = 0; !status && errors && s->estimate.reason[0] && k < count; k++) (*out)[k] = NAN;
    free(columns);
    if (status) {
        free(*out);
        *out = NULL;
    }
    return status;
}

/* ---- tables ---- */

/* Returns why a value is undecided; a whole number may count events. */
static const char *undecided_cell(const summary *s, double value)
{
    if (floor(value) == value && motus_explain_events(s->model->system)[0])
        return "undecided: an event may have happened or not, or it jumps, within the error of the state";
    return "undecided: it jumps, or is infinite, within the error of the state";
}

/* Adds the value of a column at the end, with its error. */
static motus_status final_cell(const summary *s, table *t, size_t column, double value, motus_error *err)
{
    double error = NAN;
    motus_error why = motus_default_error();
    if (!isfinite(value) && motus_run_undefined(s->run, column, &why) == MOTUS_DIVERGED) {
        char text[2 * MOTUS_TEXT_MAX + 16];
        snprintf(text, sizeof text, "undefined: %s%s%s", why.message, why.hint[0] ? "; " : "", why.hint);
        table_cell(t, text);
        return MOTUS_OK;
    }
    motus_status status = s->errors ? motus_run_errors(s->run, &column, 1, NULL, &error, err) : MOTUS_OK;
    const bool undecided = isinf(error) && isnan(s->estimate.significant_until) && !motus_run_accumulates(s->run)[0];
    const motus_run_statistics done = motus_run_now(s->run);
    if (s->errors && undecided)
        table_cell(t, undecided_cell(s, value));
    else if (s->errors && !(error == 0 && done.events_unseen)) /* an event that was missed may have changed the value */
        table_bar(t, value, s->estimate.reason[0] ? NAN : error);
    else
        table_exact(t, value);
    return status;
}

/* Adds the errors of a family: their root mean square, the largest one, and where it is. */
static motus_status worst_cell(const summary *s, table *t, size_t first, size_t count, motus_error *err)
{
    double *errors = NULL;
    char text[MOTUS_NAME_MAX + 192] = "", bar[DECIMAL_MAX], rms[DECIMAL_MAX];
    motus_status status = s->errors ? numbers_of(s, true, first, count, &errors, err) : MOTUS_OK;
    size_t worst = 0;
    double squares = 0;
    for (size_t k = 0; errors && k < count; k++) {
        squares += errors[k] * errors[k];
        if (errors[k] > errors[worst]) worst = k;
    }
    motus_column c = motus_default_column();
    if (errors && isfinite(errors[worst]) && motus_column_at(s->model->system, first + worst, &c) == MOTUS_OK) {
        snprintf(text, sizeof text, "all: rms ± %s, most ± %s in %s", bar_error(sqrt(squares / (double)count), rms),
                 bar_error(errors[worst], bar), c.name);
    }
    free(errors);
    if (!status) table_cell(t, text);
    return status;
}

static size_t exact_column(const summary *s, size_t variable, bool velocity, size_t offset)
{
    motus_variable v = motus_default_variable();
    figure_place p;
    if (!motus_has_exact(s->model->system) || motus_variable_at(s->model->system, variable, &v) != MOTUS_OK ||
        !figure_find(s->model, &v, "exact ", velocity ? "'" : "", &p))
        return 0;
    return p.first + offset;
}

/* Adds rows for columns [first, first + count), at most SHOWN of them. */
static motus_status rows(const summary *s, table *t, size_t first, size_t count, size_t variable, bool velocity,
                         bool state, motus_error *err)
{
    bool exact = state && motus_has_exact(s->model->system);
    for (size_t k = 0; k < count && k < SHOWN; k++) {
        motus_column c = motus_default_column();
        double value[2] = {NAN, NAN};
        size_t columns[2] = {first + k, exact ? exact_column(s, variable, velocity, k) : 0};
        motus_status status = motus_column_at(s->model->system, columns[0], &c);
        if (status) return fail(err, status, "column %zu has no name", columns[0]);
        status = motus_run_values(s->run, columns, columns[1] ? 2 : 1, value, err);
        if (status) return status;
        table_cell(t, c.name);
        status = final_cell(s, t, columns[0], value[0], err);
        if (status) return status;
        if (!exact) continue;
        if (columns[1])
            table_exact(t, value[1]);
        else
            table_cell(t, "-");
        table_number(t, columns[1] ? fabs(value[0] - value[1]) : NAN, -2);
    }
    if (count > SHOWN) {
        char more[64];
        snprintf(more, sizeof more, "… and %zu more", count - SHOWN);
        table_cell(t, more);
        motus_status status = worst_cell(s, t, first, count, err);
        if (status) return status;
        for (int i = 0; i < (exact ? 2 : 0); i++) table_cell(t, "");
    }
    return MOTUS_OK;
}

static table *state_table(const summary *s, motus_error *err, motus_status *status)
{
    bool exact = motus_has_exact(s->model->system);
    table *t = table_create(exact ? "lllr" : "ll");
    table_cell(t, "state");
    table_cell(t, "value");
    if (exact) {
        table_cell(t, "exact");
        table_cell(t, "error");
    }
    motus_variable v = motus_default_variable();
    for (size_t k = 0; !*status && motus_variable_at(s->model->system, k, &v) == MOTUS_OK; k++) {
        figure_place p;
        if (figure_find(s->model, &v, "", "", &p)) *status = rows(s, t, p.first, v.count, k, false, true, err);
        if (!*status && v.order == 2 && figure_find(s->model, &v, "", "'", &p))
            *status = rows(s, t, p.first, v.count, k, true, true, err);
    }
    return t;
}

static table *quantity_table(const summary *s, motus_error *err, motus_status *status)
{
    size_t count = motus_quantity_count(s->model->system), column = load_quantity_column(s->model);
    if (count == 0) return NULL;
    table *t = table_create("ll");
    table_cell(t, "quantity");
    table_cell(t, "value");
    for (size_t k = 0; !*status && k < count; k++) {
        size_t numbers = 0;
        motus_quantity_name(s->model->system, k, &numbers);
        *status = rows(s, t, column, numbers, 0, false, false, err);
        column += numbers;
    }
    return t;
}

static table *invariant_table(const summary *s, motus_error *err, motus_status *status)
{
    if (s->deviation->count == 0) return NULL;
    table *t = table_create("lllr");
    table_cell(t, "invariant");
    table_cell(t, "at the start");
    table_cell(t, "at the end");
    table_cell(t, "largest drift");
    for (size_t k = 0; k < s->deviation->count && k < SHOWN; k++) {
        motus_column c = motus_default_column();
        bool known = motus_column_at(s->model->system, s->deviation->columns[k], &c) == MOTUS_OK;
        table_cell(t, known ? c.name : "");
        table_exact(t, s->deviation->initial[k]);
        if (!*status) *status = final_cell(s, t, s->deviation->columns[k], s->deviation->final[k], err);
        table_number(t, s->deviation->most[k], -2);
    }
    return t;
}

/* Writes "step 0.01", or "tolerance 1e-9, steps 0.02 to 0.3". */
static void how_steps(const summary *s, char *out, size_t size)
{
    char a[DECIMAL_MAX], b[DECIMAL_MAX], c[DECIMAL_MAX];
    const motus_run_statistics done = motus_run_now(s->run);
    if (isnan(done.tolerance)) {
        decimal(done.step, a);
        snprintf(out, size, "step %s", a);
        return;
    }
    decimal(done.tolerance, a);
    text_brief(done.shortest_step, 3, b);
    text_brief(done.longest_step, 3, c);
    const int length = snprintf(out, size, "tolerance %s%s", a, done.absolute ? " absolute" : "");
    if (!isnan(done.longest_step)) snprintf(out + length, size - (size_t)length, ", steps %s to %s", b, c);
}

static void head(const summary *s, FILE *out, bool colours)
{
    char from[DECIMAL_MAX], to[DECIMAL_MAX], last[DECIMAL_MAX], spent[DECIMAL_MAX], how[3 * DECIMAL_MAX];
    char line[4 * DECIMAL_MAX + 512], iterations[64];
    const motus_run_statistics done = motus_run_now(s->run);
    how_steps(s, how, sizeof how);
    decimal(s->start, from);
    decimal(motus_run_time(s->run), to);
    text_brief(done.shorter_last, 6, last);
    text_seconds(s->seconds, spent);
    fprintf(out, "%s%s%s", colours ? "\033[1m" : "", s->model->title, colours ? "\033[0m" : "");
    const bool later = done.compiled_from > 0;
    snprintf(line, sizeof line, ": %s, %s, %s", done.method, how, later ? "interpreter, then compiled" : done.machine);
    if (later) snprintf(line + strlen(line), 64, " from step %lld", (long long)done.compiled_from + 1);
    text_flow(out, line, text_width(s->model->title), 4, text_columns(out));
    putc('\n', out);
    const bool ended = motus_run_ended(s->run, NULL, NULL, NULL)[0]; /* if so, `until` has shortened no step */
    const bool shorter = done.shorter_last != 0 && !ended;
    line[0] = iterations[0] = 0;
    if (done.refused > 0) snprintf(line, sizeof line, " and %lld refused", (long long)done.refused);
    if (done.iterations > 0) snprintf(iterations, sizeof iterations, ", %lld iterations", (long long)done.iterations);
    text_say(out, "%s = %s to %s in %lld steps%s%s%s%s, %lld evaluations%s, %s%s", s->model->time, from, to,
             (long long)motus_run_steps(s->run), shorter ? " (the last one " : "", shorter ? last : "",
             shorter ? ")" : "", line, (long long)done.evaluations, iterations, spent,
             done.trials ? ", trial runs included" : "");
    if (!isnan(s->went_on) && s->went_on != s->start)
        text_say(out, "goes on from the state at %s = %s in %s", s->model->time, decimal(s->went_on, from), s->from);
    event_table_end(s, out);
}

/* Prints how many rows the file has, and when they were taken. */
static void print_file(const summary *s, FILE *out)
{
    const options *o = s->options;
    char period[DECIMAL_MAX], when[DECIMAL_MAX + 64], jumps[64] = "";
    if (!o->output || strcmp(o->output, "-") == 0) return;
    if (s->period > 0)
        snprintf(when, sizeof when, "one every %s", decimal(s->period, period));
    else if (s->stride > 1)
        snprintf(when, sizeof when, "one every %" PRId64 " steps", s->stride);
    else
        snprintf(when, sizeof when, "one at every step%s",
                 s->smooth ? ", and between them what a smooth curve needs" : "");
    if (s->jumps > 0)
        snprintf(jumps, sizeof jumps, ", and both sides of %" PRId64 " jump%s", s->jumps, s->jumps == 1 ? "" : "s");
    putc('\n', out);
    text_say(out, "%s has %" PRId64 " row%s, %s%s", o->output, s->rows, s->rows == 1 ? "" : "s", when, jumps);
}

motus_status summary_print(const summary *s, motus_error *err)
{
    motus_status status = MOTUS_OK;
    /* if a CSV goes to standard output, the summary goes to standard error */
    const char *const files[] = {s->options->output, s->options->events};
    const bool data = (files[0] && strcmp(files[0], "-") == 0) || (files[1] && strcmp(files[1], "-") == 0);
    FILE *out = data ? stderr : stdout;
    bool colours = complain_colours(data ? 2 : 1), printed = true;
    enum { STATE, EVENTS, QUANTITIES, INVARIANTS, TABLES };
    table *tables[TABLES] = {NULL};
    tables[STATE] = state_table(s, err, &status);
    if (!status) tables[EVENTS] = event_table_make(s, err, &status);
    if (!status) tables[QUANTITIES] = quantity_table(s, err, &status);
    if (!status) tables[INVARIANTS] = invariant_table(s, err, &status);
    if (!status) {
        head(s, out, colours);
        for (int i = 0; i < TABLES; i++) {
            if (i != STATE && !tables[i]) continue;
            putc('\n', out);
            printed = table_print(tables[i], out, 2, colours) && printed;
            if (i == EVENTS) event_table_note(s, out);
        }
        event_table_unseen(s, out);
        event_table_held(s, out);
        if (s->errors) answer_print(s, out);
        answer_choice(s, out);
        print_file(s, out);
    }
    for (int i = 0; i < TABLES; i++) table_destroy(tables[i]);
    return status || printed ? status : complain_memory(err);
}

/* ---- JSON ---- */

/* Writes a cell: a number, or a list of components. */
static void cell_json(json *j, const char *key, const double *values, const figure_place *p, size_t cell, bool vector,
                      size_t *left)
{
    if (vector) json_open(j, key, '[');
    for (size_t c = 0; c<p->components && * left> 0; c++, --*left)
        json_number(j, vector ? NULL : key, values[cell * p->cell_step + c * p->component_step]);
    if (vector) json_close(j, ']');
}

/* Writes lists within lists, a level for each index. */
static void nest_json(json *j, const char *key, const double *values, const figure_place *p, const motus_variable *v,
                      int level, size_t *cell, size_t *left)
{
    if (level == v->dimensions) {
        cell_json(j, key, values, p, (*cell)++, v->components > 0, left);
        return;
    }
    json_open(j, key, '[');
    for (int64_t i = v->first[level]; i <= v->last[level] && *left > 0; i++)
        nest_json(j, NULL, values, p, v, level + 1, cell, left);
    json_close(j, ']');
}

static void variable_json(json *j, const char *key, const double *values, const figure_place *p,
                          const motus_variable *v, size_t *left)
{
    double grid = 1;
    for (int d = 0; d < v->dimensions; d++) grid *= (double)(v->last[d] - v->first[d] + 1);
    size_t cell = 0;
    /* a family that does not fill its ranges is a plain list of cells */
    if (v->dimensions == 0 || grid == (double)p->cells) {
        nest_json(j, key, values, p, v, 0, &cell, left);
        return;
    }
    json_open(j, key, '[');
    while (cell<p->cells && * left> 0) cell_json(j, NULL, values, p, cell++, v->components > 0, left);
    json_close(j, ']');
}

/* Writes the numbers of all variables as members of the open object. Returns whether some are left out. */
static bool states_json(json *j, const summary *s, const double *values)
{
    size_t left = SUMMARY_STATE_MAX;
    motus_variable v = motus_default_variable();
    for (size_t k = 0; left > 0 && motus_variable_at(s->model->system, k, &v) == MOTUS_OK; k++)
        for (int prime = 0; prime < (v.order == 2 ? 2 : 1) && left > 0; prime++) {
            char name[MOTUS_NAME_MAX + 1];
            figure_place p;
            if (!figure_find(s->model, &v, "", prime ? "'" : "", &p)) continue;
            snprintf(name, sizeof name, "%s%s", v.name, prime ? "'" : "");
            variable_json(j, name, values + (p.first - 1), &p, &v, &left);
        }
    return s->model->positions + s->model->velocities > SUMMARY_STATE_MAX;
}

static void numbers_json(json *j, const char *key, const double *values, size_t count)
{
    if (count == 1)
        json_number(j, key, values[0]);
    else
        json_numbers(j, key, values, count);
}

static void invariants_json(json *j, const summary *s)
{
    json_open(j, "invariants", '{');
    size_t at = 0;
    for (size_t k = 0; k < motus_invariant_count(s->model->system); k++) {
        size_t numbers = 0;
        const char *name = motus_invariant_name(s->model->system, k, &numbers);
        double most = 0;
        for (size_t i = at; i < at + numbers; i++)
            if (!(s->deviation->most[i] <= most) && !isnan(most)) most = s->deviation->most[i];
        json_open(j, name, '{');
        numbers_json(j, "initial", s->deviation->initial + at, numbers);
        numbers_json(j, "final", s->deviation->final + at, numbers);
        json_number(j, "max_drift", most);
        json_close(j, '}');
        at += numbers;
    }
    json_close(j, '}');
}

/* Writes the numbers of all quantities, or of all invariants, as members of the open object. */
static void named_json(json *j, const summary *s, load_naming *name, const double *values)
{
    size_t numbers = 0;
    const char *one;
    for (size_t k = 0; (one = name(s->model->system, k, &numbers)) != NULL; k++, values += numbers)
        numbers_json(j, one, values, numbers);
}

/* Writes error{name: value}, with null if the error is not known or no digit is significant. */
static motus_status errors_json(json *j, const summary *s, motus_error *err)
{
    const size_t quantities = load_quantity_column(s->model), invariants = load_invariant_column(s->model);
    double *errors = NULL;
    motus_status status = numbers_of(s, true, 0, invariants + s->model->invariants, &errors, err);
    if (status) return status;
    json_open(j, "error", '{');
    states_json(j, s, errors + 1);
    named_json(j, s, motus_quantity_name, errors + quantities);
    named_json(j, s, motus_invariant_name, errors + invariants);
    json_close(j, '}');
    tell_estimate(j, &s->estimate);
    free(errors);
    return MOTUS_OK;
}

/* Writes the table of events, as far as its numbers fit. `values` are those of event_values(). */
static void events_json(json *j, const summary *s, const double *values, int64_t rows)
{
    const size_t numbers = load_invariant_column(s->model) - 1;
    json_open(j, "events", '[');
    for (int64_t k = 0; k < rows; k++, values += numbers) {
        motus_event_row row = motus_default_event_row();
        motus_run_event(s->run, k, &row);
        json_open(j, NULL, '{');
        tell_event(j, &row);
        json_open(j, "state", '{');
        states_json(j, s, values);
        named_json(j, s, motus_quantity_name, values + s->model->positions + s->model->velocities);
        json_close(j, '}');
        json_close(j, '}');
    }
    json_close(j, ']');
    if (rows < motus_run_events(s->run)) json_bool(j, "events_cut", true);
    json_integer(j, "events_significant", motus_run_events_significant(s->run));
    tell_ended(j, s->run);
    const motus_run_statistics done = motus_run_now(s->run);
    json_string(j, "events_note", done.cut[0] ? done.cut : NULL);
    json_integer(j, "events_unseen", done.events_unseen);
    json_number(j, "events_unseen_from", done.events_unseen_from);
    json_integer(j, "events_held", done.events_held);
    json_string(j, "events_held_of", done.events_held ? done.events_held_of : NULL);
}

/* Computes state and quantities on arrival at the first *rows events. */
static motus_status event_values(const summary *s, int64_t *rows, double **out, motus_error *err)
{
    const size_t numbers = load_invariant_column(s->model) - 1;
    const int64_t all = motus_run_events(s->run), most = (int64_t)(SUMMARY_STATE_MAX / (numbers + 1));
    *rows = all < most ? all : most;
    size_t *columns = malloc((numbers + 1) * sizeof *columns);
    *out = malloc(((size_t)*rows * numbers + 1) * sizeof **out);
    motus_status status = columns && *out ? MOTUS_OK : complain_memory(err);
    for (size_t i = 0; !status && i < numbers; i++) columns[i] = 1 + i;
    for (int64_t k = 0; !status && k < *rows; k++)
        status = motus_run_event_values(s->run, k, 0, columns, numbers, *out + (size_t)k * numbers, err);
    free(columns);
    return status;
}

/* Writes the step, or the tolerance and the steps that an adaptive method has taken. */
static void steps_json(json *j, const motus_run_statistics *done)
{
    if (!isnan(done->accuracy)) {
        json_number(j, "accuracy", done->accuracy);
        json_number(j, "reached", done->reached);
    }
    if (isnan(done->tolerance)) {
        json_number(j, "step", done->step);
        return;
    }
    json_number(j, "tolerance", done->tolerance);
    json_bool(j, "absolute", done->absolute);
    json_integer(j, "rejected", done->refused);
    json_number(j, "h_min", done->shortest_step);
    json_number(j, "h_max", done->longest_step);
}

motus_status summary_json(const summary *s, motus_error *err)
{
    const motus_run_statistics done = motus_run_now(s->run);
    double *state = NULL, *quantities = NULL, *events = NULL;
    int64_t rows = 0;
    motus_status status = numbers_of(s, false, 1, s->model->positions + s->model->velocities, &state, err);
    if (!status) status = numbers_of(s, false, load_quantity_column(s->model), s->model->quantities, &quantities, err);
    if (!status) status = event_values(s, &rows, &events, err);
    if (!status) {
        json j = text_json(stdout);
        json_string(&j, "model", s->options->operand);
        json_string(&j, "method", done.method);
        json_string(&j, "machine", done.machine);
        json_number(&j, "compiled_from", done.compiled_from < 0 ? NAN : (double)done.compiled_from);
        if (done.choice[0]) json_string(&j, "choice", done.choice);
        steps_json(&j, &done);
        settle_json(&j, s->model);
        json_integer(&j, "steps", motus_run_steps(s->run));
        json_integer(&j, "evaluations", done.evaluations);
        json_integer(&j, "iterations", done.iterations);
        json_number(&j, "time", motus_run_time(s->run));
        json_open(&j, "state", '{');
        const bool cut = states_json(&j, s, state);
        json_close(&j, '}');
        if (cut) json_bool(&j, "cut", true);
        json_open(&j, "quantities", '{');
        named_json(&j, s, motus_quantity_name, quantities);
        json_close(&j, '}');
        invariants_json(&j, s);
        events_json(&j, s, events, rows);
        json_number(&j, "seconds", s->seconds);
        json_number(&j, "singularity", s->singularity);
        json_number(&j, "switches", done.switches < 0 ? NAN : (double)done.switches); /* null: not located */
        tell_diagnosis(&j, s->singular->cause ? s->singular : s->missed);
        if (s->missed->status) complain_json(&j, "missed", s->missed);
        if (s->errors) status = errors_json(&j, s, err);
        json_end(&j);
        *s->options->answered = true;
    }
    free(state);
    free(quantities);
    free(events);
    return status;
}
