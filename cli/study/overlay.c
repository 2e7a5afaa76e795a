/* The figure of a comparison.
 *
 * Invariant: a method has one colour, one kind of dashes and one marker in all panels. A panel draws the first cell of
 * a variable; the last panel draws the change of the first invariant.
 */
#include "cli/study/studies.h"

#include "cli/run/figure.h"
#include "cli/words/complain.h"

enum { METHODS = 8, PANELS = 5, SAMPLES = 50000 };

typedef struct slot {
    size_t panel, columns[2]; /* x and y of the curve */
    bool timelike, change;
    size_t exact[2]; /* x and y of the exact curve; exact[1] 0: there is none */
} slot;

typedef struct overlay {
    const load *model;
    plot_figure plot;
    slot slots[PANELS];
    size_t slot_count;
    record records[METHODS];
    size_t record_count;
} overlay;

static bool add_slot(overlay *v, const char *title, const char *x, const char *y, slot s)
{
    if (v->slot_count == PANELS) return true;
    s.panel = v->plot.count;
    plot_panel *p = plot_panel_add(&v->plot, title, x, y);
    if (!p) return false;
    p->spatial = !s.timelike;
    v->slots[v->slot_count++] = s;
    return true;
}

static bool add_variable(overlay *v, const motus_variable *var)
{
    figure_place p, exact_place;
    motus_column name[2] = {motus_default_column(), motus_default_column()};
    if (!figure_find(v->model, var, "", "", &p)) return true;
    bool exact = figure_find(v->model, var, "exact ", "", &exact_place), plane = var->order == 2 && p.components > 1;
    size_t first = p.first, second = plane ? p.first + p.component_step : 0;
    if (motus_column_at(v->model->system, first, &name[0]) || motus_column_at(v->model->system, second, &name[1]))
        return true;
    slot s = plane ? (slot){.columns = {first, second}} : (slot){.columns = {0, first}, .timelike = true};
    if (exact) {
        s.exact[0] = plane ? exact_place.first : 0;
        s.exact[1] = plane ? exact_place.first + exact_place.component_step : exact_place.first;
    }
    return plane ? add_slot(v, "motion", name[0].name, name[1].name, s)
                 : add_slot(v, "motion", v->model->time, name[0].name, s);
}

static bool add_panels(overlay *v)
{
    motus_system *system = v->model->system;
    motus_variable variable = motus_default_variable();
    for (size_t k = 0; k < PANELS - 1 && motus_variable_at(system, k, &variable) == MOTUS_OK; k++)
        if (!add_variable(v, &variable)) return false;
    if (motus_invariant_count(system) == 0) return true;
    char title[PLOT_LABEL];
    size_t numbers;
    snprintf(title, sizeof title, "drift of %s", motus_invariant_name(system, 0, &numbers));
    return add_slot(v, title, v->model->time, "change since the start",
                    (slot){.columns = {0, load_invariant_column(v->model)}, .timelike = true, .change = true});
}

static bool add_curve(overlay *v, record *r, const slot *s, const size_t columns[2], const char *label, plot_role role)
{
    double *x = record_add(r, columns[0]), *y = x ? record_add(r, columns[1]) : NULL;
    plot_curve *c = y ? plot_curve_add(&v->plot.panels[s->panel], label, x, y, 0, 1) : NULL;
    if (!c) return false;
    c->role = role;
    c->timelike = s->timelike;
    c->change = s->change;
    return true;
}

/* Runs one method again and records its curves for every panel. The run of the first method also records the exact
 * curves. */
static motus_status run_method(overlay *v, const motus_compare_row *row, stop_progress *progress, motus_error *err)
{
    motus_run_def def = motus_default_run();
    def.method = row->method;
    def.machine = "auto";
    def.step = row->step;
    def.until = v->model->set.until;
    def.progress = stop_progress_hook;
    def.context = progress;
    motus_run *run = NULL;
    motus_status status = motus_run_create(v->model->system, &def, &run, err);
    if (status) return status;
    bool first = v->record_count == 0;
    record *r = &v->records[v->record_count++];
    *r = record_for(motus_run_now(run).steps_total, v->model->set.until - motus_run_time(run), SAMPLES);
    bool room = true;
    for (size_t i = 0; room && i < v->slot_count; i++) {
        const slot *s = &v->slots[i];
        room = add_curve(v, r, s, s->columns, row->method, PLOT_LINE);
        if (room && first && s->exact[1]) room = add_curve(v, r, s, s->exact, "exact", PLOT_EXACT);
    }
    walk_observer w = record_observer(r);
    status = room ? walk(run, motus_run_time(run), v->model->set.until, &w, 1, NULL, err) : complain_memory(err);
    for (size_t i = 0; i < v->slot_count; i++) {
        plot_panel *p = &v->plot.panels[v->slots[i].panel];
        for (size_t k = 0; k < p->curve_count; k++)
            if (p->curves[k].count == 0) p->curves[k].count = r->rows;
    }
    motus_run_destroy(run);
    return status;
}

motus_status overlay_draw(const load *m, const motus_comparison *c, const options *o, file_out *file,
                          stop_progress *progress, motus_error *err)
{
    overlay v = {.model = m};
    snprintf(v.plot.title, sizeof v.plot.title, "%s by %s", m->title,
             c->row_count == 1 ? "one method" : "several methods");
    motus_status status = add_panels(&v) ? MOTUS_OK : complain_memory(err);
    size_t left = 0;
    for (size_t k = 0; !status && k < c->row_count; k++) {
        if (c->rows[k]->status) continue;
        if (v.record_count == METHODS)
            left++;
        else
            status = run_method(&v, c->rows[k], progress, err);
    }
    if (!status && v.record_count == 0)
        status = fail(err, c->row_count ? c->rows[0]->status : MOTUS_METHOD,
                      "there is nothing to draw: every method failed before the end");
    if (!status) status = plot_draw(&v.plot, o->plot, file, err);
    if (!status && left && !o->quiet)
        complain_note("the figure shows the first %d methods; --methods chooses others", (int)METHODS);
    plot_free(&v.plot);
    for (size_t k = 0; k < v.record_count; k++) record_free(&v.records[k]);
    return status;
}
