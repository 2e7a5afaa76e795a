/* The figure of a comparison.
 *
 * Invariant: a method has one colour, one kind of dashes and one marker in all panels. A panel of a motion draws the
 * first cell of a variable, and below it lie the errors at the steps, from the reference that the tables have; the last
 * panel draws the change of the first invariant.
 */
#include "cli/study/studies.h"

#include "cli/run/figure.h"
#include "cli/words/complain.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    VARIABLES = 2,
    SMOOTH = 1500,
    FINE_SAMPLES = 20000,
    SAMPLES = 1500,
    DIMENSIONS = 3,
    WIDTH = VARIABLES * DIMENSIONS
};

/* A variable: its columns, and where its panels are; a panel SIZE_MAX: there is none. */
typedef struct slot {
    size_t columns[DIMENSIONS], exact[2], count; /* exact: x and y of the curve; exact[1] 0: there is none */
    size_t motion, errors;
} slot;

typedef struct overlay {
    const studies *study;
    const load *model;
    plot_figure plot;
    slot slots[VARIABLES];
    size_t slot_count, drift; /* drift: the panel; SIZE_MAX: there is none */
    record fine[CHOOSE_MOST], steps[CHOOSE_MOST];
    record exact; /* the exact motion, smooth in any case, along the first run */
    double *errors[CHOOSE_MOST][VARIABLES];
    size_t runs;
    motus_reference *reference; /* NULL: there is none */
    double *at, *right;         /* the reference in the slots' columns at the times of the latest run */
    size_t rows;
} overlay;

static plot_panel *add_panel(overlay *v, const char *title, size_t x, const char *y, size_t *place)
{
    char label[PLOT_LABEL];
    figure_label(v->model, x, label);
    *place = v->plot.count;
    return plot_panel_add(&v->plot, title, label, y);
}

static bool add_variable(overlay *v, const motus_variable *var)
{
    figure_place p, e;
    char y[PLOT_LABEL], title[PLOT_LABEL];
    if (!figure_find(v->model, var, "", "", &p)) return true;
    const bool exact = figure_find(v->model, var, "exact ", "", &e), plane = var->order == 2 && p.components > 1;
    slot s = {.count = p.components < DIMENSIONS ? p.components : DIMENSIONS, .errors = SIZE_MAX};
    for (size_t k = 0; k < s.count; k++) s.columns[k] = p.first + k * p.component_step;
    if (exact) {
        s.exact[0] = plane ? e.first : 0;
        s.exact[1] = plane ? e.first + e.component_step : e.first;
    }
    figure_label(v->model, s.columns[plane], y);
    plot_panel *panel = add_panel(v, "motion", plane ? s.columns[0] : 0, y, &s.motion);
    if (!panel) return false;
    panel->equal = plane;
    if (v->reference) {
        snprintf(title, sizeof title, "error of %s at the steps, from %.100s", var->name,
                 motus_reference_name(v->reference));
        panel = add_panel(v, title, 0, "error", &s.errors);
        if (!panel) return false;
        panel->log_y = true;
    }
    v->slots[v->slot_count++] = s;
    return true;
}

static bool add_panels(overlay *v)
{
    motus_system *system = v->model->system;
    motus_variable variable = motus_default_variable();
    v->plot.one_key = true;
    v->drift = SIZE_MAX;
    for (size_t k = 0; k < VARIABLES && motus_variable_at(system, k, &variable) == MOTUS_OK; k++)
        if (!add_variable(v, &variable)) return false;
    if (motus_invariant_count(system) == 0) return true;
    char title[PLOT_LABEL];
    snprintf(title, sizeof title, "change of %s since the start", motus_invariant_name(system, 0, NULL));
    return add_panel(v, title, 0, "change", &v->drift) != NULL;
}

static plot_curve *add_curve(overlay *v, size_t panel, const char *label, const double *x, const double *y,
                             bool timelike)
{
    plot_curve *c = x && y ? plot_curve_add(&v->plot.panels[panel], label, x, y, 0, 1) : NULL;
    if (c) c->timelike = timelike;
    return c;
}

/* Adds the curves of a run, before it begins; the first run draws the exact motion too. */
static bool add_curves(overlay *v, size_t run, const char *method)
{
    record *fine = &v->fine[run], *steps = &v->steps[run];
    const double *t = record_add(fine, 0), *at = record_add(steps, 0);
    const double *exact = run == 0 ? record_add(&v->exact, 0) : NULL;
    for (size_t i = 0; i < v->slot_count; i++) {
        slot *s = &v->slots[i];
        const bool plane = v->plot.panels[s->motion].equal;
        const double *x = plane ? record_add(fine, s->columns[0]) : t, *y = record_add(fine, s->columns[plane]);
        if (!add_curve(v, s->motion, method, x, y, !plane)) return false;
        if (run == 0 && s->exact[1]) {
            x = plane ? record_add(&v->exact, s->exact[0]) : exact;
            plot_curve *c = add_curve(v, s->motion, "exact", x, record_add(&v->exact, s->exact[1]), !plane);
            if (!c) return false;
            c->role = PLOT_EXACT;
        }
        for (size_t k = 0; v->reference && k < s->count; k++)
            if (!record_add(steps, s->columns[k])) return false;
        if (!v->reference) continue;
        v->errors[run][i] = malloc(steps->room * sizeof **v->errors[run]);
        if (!add_curve(v, s->errors, method, at, v->errors[run][i], true)) return false;
    }
    if (v->drift == SIZE_MAX) return t && at;
    plot_curve *c = add_curve(v, v->drift, method, at, record_add(steps, load_invariant_column(v->model)), true);
    if (c) c->change = true;
    return c != NULL;
}

/* Finds the reference at a time in the slots' columns, in their order. */
static motus_status reference_at(const overlay *v, double time, double *x, double *derivatives, double *out,
                                 motus_error *err)
{
    const size_t nx = v->model->positions;
    const motus_status status = motus_reference_at(v->reference, &time, 1, x, derivatives, err);
    for (size_t i = 0, n = 0; !status && i < v->slot_count; i++)
        for (size_t k = 0; k < v->slots[i].count; k++) {
            const size_t column = v->slots[i].columns[k] - 1; /* after the time */
            out[n++] = column < nx ? x[column] : derivatives[column - nx];
        }
    return status;
}

/* Finds the reference at the steps of a run, unless it was found for a run with the same steps. Times that it does not
 * reach have NaN. */
static motus_status find_reference(overlay *v, const record *r, motus_error *err)
{
    if (v->rows == r->rows && memcmp(v->at, r->values[0], r->rows * sizeof *v->at) == 0) return MOTUS_OK;
    double *x = malloc((v->model->positions + 1) * sizeof *x), *d = malloc((v->model->velocities + 1) * sizeof *d);
    free(v->at);
    free(v->right);
    v->rows = 0;
    v->at = malloc((r->rows + 1) * sizeof *v->at);
    v->right = malloc((r->rows + 1) * WIDTH * sizeof *v->right);
    motus_status status = x && d && v->at && v->right ? MOTUS_OK : complain_memory(err);
    bool reached = true;
    for (size_t row = 0; !status && row < r->rows; row++) {
        motus_error own = motus_default_error();
        double *right = v->right + WIDTH * row;
        const motus_status found = reached ? reference_at(v, r->values[0][row], x, d, right, &own) : MOTUS_DIVERGED;
        if (found == MOTUS_MEMORY || found == MOTUS_CANCELLED) *err = own, status = found;
        reached = !found;
        for (size_t k = 0; !reached && k < WIDTH; k++) right[k] = NAN;
    }
    if (!status) {
        memcpy(v->at, r->values[0], r->rows * sizeof *v->at);
        v->rows = r->rows;
    }
    free(x);
    free(d);
    return status;
}

/* Fills in the distance of a finished run from the reference at its steps. Errors of 0, which a logarithmic axis does
 * not have, are gaps. */
static motus_status find_errors(overlay *v, size_t run, motus_error *err)
{
    const record *r = &v->steps[run];
    const motus_status status = find_reference(v, r, err);
    for (size_t row = 0; !status && row < r->rows; row++)
        for (size_t i = 0, n = 0; i < v->slot_count; i++) {
            double error = 0;
            for (size_t k = 0; k < v->slots[i].count; k++, n++)
                error = hypot(error, r->values[1 + n][row] - v->right[WIDTH * row + n]);
            v->errors[run][i][row] = error > 0 ? error : NAN;
        }
    return status;
}

/* Runs one method again. */
static motus_status run_method(overlay *v, const motus_compare_row *row, stop_progress *progress, motus_error *err)
{
    const double until = v->model->set.until;
    motus_run_def def = motus_default_run();
    def.method = row->method;
    def.machine = "auto";
    def.step = row->step;
    def.until = until;
    def.progress = stop_progress_hook;
    def.context = progress;
    motus_run *run = NULL;
    motus_status status = motus_run_create(v->model->system, &def, &run, err);
    if (status) return status;
    const int64_t steps = motus_run_now(run).steps_total;
    const double way = until - motus_run_time(run);
    const size_t k = v->runs++;
    const record all = record_for(steps, way, FINE_SAMPLES);
    const record between =
        steps > 0 && steps < SMOOTH ? record_between(motus_run_now(run).step, way, SMOOTH / steps + 1) : all;
    v->fine[k] = figure_smooth(row->method) ? between : all;
    if (k == 0) v->exact = between;
    v->steps[k] = record_for(steps, way, SAMPLES);
    if (!add_curves(v, k, row->method)) status = complain_memory(err);
    const walk_observer observers[] = {record_observer(&v->fine[k]), record_observer(&v->steps[k]),
                                       record_observer(&v->exact)};
    if (!status) status = walk(run, motus_run_time(run), until, observers, k == 0 ? 3 : 2, NULL, err);
    if (!status && v->reference) status = find_errors(v, k, err);
    for (size_t i = 0; i < v->plot.count; i++)
        for (size_t c = 0; c < v->plot.panels[i].curve_count; c++) {
            plot_curve *own = &v->plot.panels[i].curves[c];
            const bool smooth = !v->plot.panels[i].log_y && i != v->drift;
            if (own->count > 0) continue;
            own->count = own->role == PLOT_EXACT ? v->exact.rows : smooth ? v->fine[k].rows : v->steps[k].rows;
        }
    motus_run_destroy(run);
    return status;
}

motus_status overlay_draw(const studies *s, const motus_comparison *c, const choose_row *shown, file_out *file,
                          stop_progress *progress, motus_error *err)
{
    overlay v = {.study = s, .model = &s->model};
    motus_study_def def = s->def;
    motus_status status = MOTUS_OK;
    def.progress = stop_progress_hook;
    def.context = progress;
    snprintf(v.plot.title, sizeof v.plot.title, "%s by %s", s->model.title,
             c->row_count == 1 ? "one method" : "several methods");
    if (c->reference && !isnan(c->reference_error))
        status = motus_reference_create(s->model.system, &def, &v.reference, err);
    if (!status && !add_panels(&v)) status = complain_memory(err);
    for (size_t k = 0; !status && k < c->row_count; k++) {
        if (c->rows[k]->status || !shown[k].shown || v.runs == CHOOSE_MOST) continue;
        status = run_method(&v, c->rows[k], progress, err);
    }
    if (!status && v.runs == 0)
        status = fail(err, c->row_count ? c->rows[0]->status : MOTUS_METHOD,
                      "there is nothing to draw: every method failed before the end");
    if (!status) status = plot_draw(&v.plot, s->options->plot, file, err);
    if (!status) choose_note(v.runs, c->row_count, s);
    plot_free(&v.plot);
    motus_reference_destroy(v.reference);
    record_free(&v.exact);
    free(v.at);
    free(v.right);
    for (size_t k = 0; k < v.runs; k++) {
        record_free(&v.fine[k]);
        record_free(&v.steps[k]);
        for (size_t i = 0; i < VARIABLES; i++) free(v.errors[k][i]);
    }
    return status;
}
