/* The figure of a comparison.
 *
 * Invariant: a method has one colour, one kind of dashes and one marker in all panels. A panel of a motion draws the
 * cell of a variable that moves furthest, and below it lie the errors at the steps, from the reference that the tables
 * have; the last panel draws the change of the first invariant. Errors and changes have a logarithmic axis, since those
 * of one method are often a millionth of another's.
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
    CELLS = 1000, /* of a variable, among which one is looked for */
    SCOUTED = 64, /* states in which it is looked for */
    WIDTH = VARIABLES * DIMENSIONS
};

#define TIE (1 + 1e-9) /* what is no larger than rounding makes it is no difference */

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
    size_t furthest[VARIABLES]; /* the cell of each variable that moves furthest */
    size_t slot_count, drift;   /* drift: the panel; SIZE_MAX: there is none */
    record fine[CHOOSE_MOST], steps[CHOOSE_MOST];
    record exact; /* the exact motion, smooth in any case, along the first run */
    double *errors[CHOOSE_MOST][VARIABLES], *changes[CHOOSE_MOST];
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

static motus_status start_run(const overlay *v, const motus_compare_row *row, stop_progress *progress, motus_run **run,
                              motus_error *err)
{
    motus_run_def def = motus_default_run();
    def.method = row->method;
    def.machine = "auto";
    def.step = row->step;
    def.until = v->model->set.until;
    def.progress = stop_progress_hook;
    def.context = progress;
    return motus_run_create(v->model->system, &def, run, err);
}

/* Returns the cell that moves furthest from its start, by a finished record of all cells in their order; `column`: the
 * first of them in the record. */
static size_t furthest(const record *r, size_t column, const figure_place *p)
{
    size_t best = 0;
    double most = 0;
    for (size_t cell = 0; cell < p->cells; cell++)
        for (size_t row = 1; row < r->rows; row++) {
            double way = 0;
            for (size_t k = 0; k < p->components; k++) {
                const double *x = r->values[column + cell * p->components + k];
                way = hypot(way, x[row] - x[0]);
            }
            if (way > most * TIE) best = cell, most = way; /* of cells that move as far, the first */
        }
    return best;
}

/* Finds the cells to draw, by one run of a method. Variables of one cell need none, and of very many the first will do.
 */
static motus_status find_furthest(overlay *v, const motus_compare_row *row, stop_progress *progress, motus_error *err)
{
    motus_variable variable = motus_default_variable();
    figure_place places[VARIABLES] = {{0}};
    motus_run *run = NULL;
    motus_status status = start_run(v, row, progress, &run, err);
    if (status) return status;
    const double start = motus_run_time(run), until = v->model->set.until;
    record scout = record_for(motus_run_now(run).steps_total, until - start, SCOUTED);
    for (size_t i = 0; i < VARIABLES && motus_variable_at(v->model->system, i, &variable) == MOTUS_OK; i++) {
        figure_place p;
        if (!figure_find(v->model, &variable, "", "", &p) || p.cells < 2 || p.cells > CELLS) continue;
        places[i] = p;
        for (size_t cell = 0; cell < p.cells; cell++)
            for (size_t k = 0; k < p.components && !status; k++)
                if (!record_add(&scout, p.first + cell * p.cell_step + k * p.component_step))
                    status = complain_memory(err);
    }
    if (!status && scout.count > 0) {
        const walk_observer observer = record_observer(&scout);
        status = walk(run, start, until, &observer, 1, NULL, err);
    }
    for (size_t i = 0, column = 0; !status && i < VARIABLES; column += places[i].cells * places[i].components, i++)
        v->furthest[i] = furthest(&scout, column, &places[i]);
    motus_run_destroy(run);
    record_free(&scout);
    return status;
}

/* Writes the name of the cell that a slot draws: "x", "r[3]". */
static void name_cell(const overlay *v, const slot *s, const char *variable, size_t cells, char out[PLOT_LABEL])
{
    motus_column c = motus_default_column();
    const bool one = cells < 2 || motus_column_at(v->model->system, s->columns[0], &c) != MOTUS_OK;
    snprintf(out, PLOT_LABEL, "%.100s", one ? variable : c.name);
    char *component = strrchr(out, '.');
    if (!one && s->count > 1 && component) *component = 0;
}

static bool add_variable(overlay *v, const motus_variable *var, size_t cell)
{
    figure_place p, e;
    char y[PLOT_LABEL], title[PLOT_LABEL], name[PLOT_LABEL];
    if (!figure_find(v->model, var, "", "", &p)) return true;
    const bool exact = figure_find(v->model, var, "exact ", "", &e), plane = var->order == 2 && p.components > 1;
    slot s = {.count = p.components < DIMENSIONS ? p.components : DIMENSIONS, .errors = SIZE_MAX};
    for (size_t k = 0; k < s.count; k++) s.columns[k] = p.first + cell * p.cell_step + k * p.component_step;
    if (exact) {
        const size_t first = e.first + cell * e.cell_step;
        s.exact[0] = plane ? first : 0;
        s.exact[1] = plane ? first + e.component_step : first;
    }
    figure_label(v->model, s.columns[plane], y);
    plot_panel *panel = add_panel(v, "motion", plane ? s.columns[0] : 0, y, &s.motion);
    if (!panel) return false;
    panel->equal = plane;
    if (v->reference) {
        name_cell(v, &s, var->name, p.cells, name);
        snprintf(title, sizeof title, "error of %.60s at the steps, from %.80s", name,
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
        if (!add_variable(v, &variable, v->furthest[k])) return false;
    if (motus_invariant_count(system) == 0) return true;
    char title[PLOT_LABEL];
    snprintf(title, sizeof title, "change of %s since the start", motus_invariant_name(system, 0, NULL));
    plot_panel *panel = add_panel(v, title, 0, "size of the change", &v->drift);
    if (panel) panel->log_y = true;
    return panel != NULL;
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
    v->changes[run] = malloc(steps->room * sizeof **v->changes);
    return record_add(steps, load_invariant_column(v->model)) &&
           add_curve(v, v->drift, method, at, v->changes[run], true);
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

/* Returns what a logarithmic axis shows of a size: 0, which it does not have, is a gap. */
static double shown_size(double size) { return size > 0 ? size : NAN; }

/* Fills in how far the invariant of a finished run is from its first value. */
static void find_changes(overlay *v, size_t run)
{
    const record *r = &v->steps[run];
    const double *invariant = r->values[r->count - 1]; /* the last column that add_curves() added */
    for (size_t row = 0; row < r->rows; row++) v->changes[run][row] = shown_size(fabs(invariant[row] - invariant[0]));
}

/* Fills in the distance of a finished run from the reference at its steps. */
static motus_status find_errors(overlay *v, size_t run, motus_error *err)
{
    const record *r = &v->steps[run];
    const motus_status status = find_reference(v, r, err);
    for (size_t row = 0; !status && row < r->rows; row++)
        for (size_t i = 0, n = 0; i < v->slot_count; i++) {
            double error = 0;
            for (size_t k = 0; k < v->slots[i].count; k++, n++)
                error = hypot(error, r->values[1 + n][row] - v->right[WIDTH * row + n]);
            v->errors[run][i][row] = shown_size(error);
        }
    return status;
}

/* Runs one method again. */
static motus_status run_method(overlay *v, const motus_compare_row *row, stop_progress *progress, motus_error *err)
{
    const double until = v->model->set.until;
    motus_run *run = NULL;
    motus_status status = start_run(v, row, progress, &run, err);
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
    if (!status && v->drift != SIZE_MAX) find_changes(v, k);
    for (size_t i = 0; i < v->plot.count; i++)
        for (size_t c = 0; c < v->plot.panels[i].curve_count; c++) {
            plot_curve *own = &v->plot.panels[i].curves[c];
            const bool smooth = !v->plot.panels[i].log_y;
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
    for (size_t k = 0; !status && k < c->row_count; k++) {
        if (c->rows[k]->status || !shown[k].shown || v.runs == CHOOSE_MOST) continue;
        if (v.runs == 0) status = find_furthest(&v, c->rows[k], progress, err);
        if (!status && v.runs == 0 && !add_panels(&v)) status = complain_memory(err);
        if (!status) status = run_method(&v, c->rows[k], progress, err);
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
        free(v.changes[k]);
    }
    return status;
}
