/* The figure of one run.
 *
 * Invariant: what is kept of a run is bounded, whatever its length and the size of its families. If there are many
 * cells, an even selection is drawn, and `left_out` is set.
 */
#include "cli/run/figure.h"

#include "cli/words/complain.h"
#include "cli/words/text.h"
#include "cli/words/words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    FINE_SAMPLES = 200000,
    COARSE_SAMPLES = 400,
    BAR_SAMPLES = 500,
    MOST_CURVES = 8, /* in a panel; there are as many styles */
    BUNDLE = 6,      /* a family up to this size is drawn as curves, and a larger one as a heat map */
    HEAT_CELLS = 300,
    FIELD_SIDE = 200
};

bool figure_find(const load *m, const motus_variable *v, const char *prefix, const char *suffix, figure_place *p)
{
    char name[MOTUS_NAME_MAX + 16];
    snprintf(name, sizeof name, "%s%s%s", prefix, v->name, suffix);
    size_t first, count;
    if (motus_column_find(m->system, name, &first, &count, NULL) != MOTUS_OK || count != v->count || count == 0)
        return false;
    size_t components = v->components > 0 ? (size_t)v->components : 1, cells = count / components;
    motus_column second = motus_default_column();
    /* the second column shows whether the numbers lie cell by cell or component by component */
    bool by_cell = components == 1 || cells == 1 ||
                   (motus_column_at(m->system, first + 1, &second) == MOTUS_OK && second.component == 1);
    *p = (figure_place){first, cells, components, by_cell ? components : 1, by_cell ? 1 : cells};
    return true;
}

static size_t column_at(const figure_place *p, size_t cell, size_t component)
{
    return p->first + cell * p->cell_step + component * p->component_step;
}

static void column_name(const figure *f, size_t column, char *out, size_t size)
{
    motus_column c = motus_default_column();
    snprintf(out, size, "%s", motus_column_at(f->model->system, column, &c) == MOTUS_OK ? c.name : "");
}

/* Returns cell number k of `shown` cells that are spread evenly over `cells`. */
static size_t spread(size_t k, size_t shown, size_t cells)
{
    return shown >= cells ? k : shown < 2 ? 0 : (size_t)((double)k * (double)(cells - 1) / (double)(shown - 1) + 0.5);
}

static plot_panel *add_panel(figure *f, const char *title, const char *x, const char *y)
{
    return plot_panel_add(&f->plot, title, x, y);
}

static bool room_for_panel(figure *f)
{
    if (f->plot.count < FIGURE_PANELS) return true;
    f->left_out = true;
    return false;
}

static bool add_band(figure *f, plot_curve *c, size_t column)
{
    c->at = f->bars_t;
    c->middle = record_add(&f->bars, column);
    if (c->middle) c->error = f->bars.errors[f->bars.count - 1];
    return c->middle != NULL;
}

static bool add_against_t(figure *f, plot_panel *p, size_t column, plot_role role, bool change)
{
    char label[PLOT_LABEL];
    column_name(f, column, label, sizeof label);
    double *y = record_add(&f->fine, column);
    plot_curve *c = y ? plot_curve_add(p, label, f->t, y, 0, 1) : NULL;
    if (!c) return false;
    c->role = role;
    c->timelike = true;
    c->change = change;
    return role == PLOT_EXACT || change || !f->bars.with_errors || add_band(f, c, column);
}

/* Adds curves of the numbers of a variable against t, at most MOST_CURVES. */
static bool add_numbers(figure *f, plot_panel *p, const figure_place *place, const figure_place *exact)
{
    size_t numbers = place->cells * place->components, shown = numbers < MOST_CURVES ? numbers : MOST_CURVES;
    f->left_out = f->left_out || shown < numbers;
    for (size_t k = 0; k < shown; k++) {
        size_t n = spread(k, shown, numbers);
        if (!add_against_t(f, p, place->first + n, PLOT_LINE, false) ||
            (exact && !add_against_t(f, p, exact->first + n, PLOT_EXACT, false)))
            return false;
    }
    return true;
}

/* Adds the path of a cell, in the plane or in space. */
static bool add_path(figure *f, plot_panel *p, const figure_place *place, size_t cell, size_t axes, plot_role role,
                     const char *label)
{
    double *at[3] = {NULL, NULL, NULL};
    for (size_t a = 0; a < axes; a++) {
        at[a] = record_add(&f->fine, column_at(place, cell, a));
        if (!at[a]) return false;
    }
    plot_curve *c = plot_curve_add(p, label, at[0], at[1], 0, 1);
    if (!c) return false;
    c->z = at[2];
    c->role = role;
    return true;
}

static bool add_paths(figure *f, plot_panel *p, const motus_variable *v, const figure_place *place,
                      const figure_place *exact)
{
    size_t shown = place->cells < MOST_CURVES ? place->cells : MOST_CURVES, axes = place->components;
    f->left_out = f->left_out || shown < place->cells;
    for (size_t k = 0; k < shown; k++) {
        size_t cell = spread(k, shown, place->cells);
        char label[PLOT_LABEL], exact_label[PLOT_LABEL + 8];
        if (v->dimensions == 0) {
            snprintf(label, sizeof label, "%s", v->name);
        } else {
            column_name(f, column_at(place, cell, 0), label, sizeof label);
            char *dot = strrchr(label, '.');
            if (dot) *dot = 0;
        }
        snprintf(exact_label, sizeof exact_label, "exact %s", label);
        if (!add_path(f, p, place, cell, axes, PLOT_LINE, label) ||
            (exact && !add_path(f, p, exact, cell, axes, PLOT_EXACT, exact_label)))
            return false;
    }
    return true;
}

/* Adds a heat map of a family: cells upwards, time to the right. */
static bool add_heat(figure *f, const motus_variable *v, const figure_place *place)
{
    char title[PLOT_LABEL];
    size_t shown = place->cells < HEAT_CELLS ? place->cells : HEAT_CELLS;
    snprintf(title, sizeof title, "%s, every cell against time", v->name);
    size_t panel = f->plot.count;
    if (!add_panel(f, title, f->model->time, v->dimensions == 1 ? "index" : "cell")) return false;
    double span = place->cells > 1 && shown > 1 ? (double)(place->cells - 1) / (double)(shown - 1) : 1;
    f->heats[f->heat_count++] = (figure_heat){.panel = panel,
                                              .first = f->coarse.count,
                                              .rows = shown,
                                              .cell_first = v->dimensions == 1 ? (double)v->first[0] : 1,
                                              .cell_step = span};
    for (size_t k = 0; k < shown; k++)
        if (!record_add(&f->coarse, column_at(place, spread(k, shown, place->cells), 0))) return false;
    return true;
}

/* Adds a heat map of a field u[i, j] at the end of the run. */
static bool add_field(figure *f, const motus_variable *v, const figure_place *place)
{
    char title[PLOT_LABEL];
    size_t side[2], shown[2];
    for (int d = 0; d < 2; d++) {
        side[d] = (size_t)(v->last[d] - v->first[d]) + 1;
        shown[d] = side[d] < FIELD_SIDE ? side[d] : FIELD_SIDE;
    }
    snprintf(title, sizeof title, "%s at the end", v->name);
    size_t panel = f->plot.count;
    if (!add_panel(f, title, "second index", "first index")) return false;
    f->heats[f->heat_count++] =
        (figure_heat){.panel = panel, .first = f->last.count, .rows = shown[0], .columns = shown[1], .field = true};
    for (size_t i = 0; i < shown[0]; i++)
        for (size_t j = 0; j < shown[1]; j++) {
            size_t cell = spread(i, shown[0], side[0]) * side[1] + spread(j, shown[1], side[1]);
            if (!record_add(&f->last, column_at(place, cell, 0))) return false;
        }
    plot_panel *p = &f->plot.panels[panel];
    p->x_first = (double)v->first[1];
    p->x_step = shown[1] > 1 ? (double)(side[1] - 1) / (double)(shown[1] - 1) : 1;
    f->heats[f->heat_count - 1].cell_first = (double)v->first[0];
    f->heats[f->heat_count - 1].cell_step = shown[0] > 1 ? (double)(side[0] - 1) / (double)(shown[0] - 1) : 1;
    return true;
}

static bool full_grid(const motus_variable *v, size_t cells)
{
    return v->dimensions == 2 &&
           (double)(v->last[0] - v->first[0] + 1) * (double)(v->last[1] - v->first[1] + 1) == (double)cells;
}

/* The panels that several variables of one kind share; SIZE_MAX: there is none yet. */
typedef struct shared {
    size_t scalars, plane;
} shared;

static bool add_variable(figure *f, const motus_variable *v, shared *s)
{
    figure_place place, exact_place;
    if (!figure_find(f->model, v, "", "", &place)) return true;
    const figure_place *exact = figure_find(f->model, v, "exact ", "", &exact_place) ? &exact_place : NULL;
    bool path = v->order == 2 && (v->components == 2 || v->components == 3);
    if (path && v->components == 2) {
        if (s->plane == SIZE_MAX) {
            if (!room_for_panel(f)) return true;
            char x[PLOT_LABEL], y[PLOT_LABEL];
            snprintf(x, sizeof x, "%s.x", v->name);
            snprintf(y, sizeof y, "%s.y", v->name);
            s->plane = f->plot.count;
            if (!add_panel(f, "motion", x, y)) return false;
        }
        f->plot.panels[s->plane].spatial = true;
        return add_paths(f, &f->plot.panels[s->plane], v, &place, exact);
    }
    if (v->dimensions == 0 && v->components == 0 && v->order == 2) {
        bool first = s->scalars == SIZE_MAX;
        if (first && !room_for_panel(f)) return true;
        if (first) {
            s->scalars = f->plot.count;
            if (!add_panel(f, "motion", f->model->time, v->name)) return false;
        }
        plot_panel *p = &f->plot.panels[s->scalars];
        if (!first) p->y_label[0] = 0;
        if (p->curve_count >= (size_t)2 * MOST_CURVES) {
            f->left_out = true;
            return true;
        }
        return add_numbers(f, p, &place, exact);
    }
    if (!room_for_panel(f)) return true;
    if (path) {
        plot_panel *p = add_panel(f, "motion", "x", "y");
        if (!p) return false;
        p->spatial = true;
        snprintf(p->z_label, sizeof p->z_label, "z");
        return add_paths(f, p, v, &place, exact);
    }
    if (v->components == 0 && place.cells > BUNDLE)
        return full_grid(v, place.cells) ? add_field(f, v, &place) : add_heat(f, v, &place);
    plot_panel *p = add_panel(f, v->order == 2 ? "motion" : v->name, f->model->time, v->name);
    return p && add_numbers(f, p, &place, exact);
}

static bool add_named(figure *f, const char *name, size_t first, size_t numbers, bool change)
{
    if (!room_for_panel(f)) return true;
    char title[PLOT_LABEL];
    snprintf(title, sizeof title, "%s%s", change ? "drift of " : "", name);
    plot_panel *p = add_panel(f, title, f->model->time, change ? "change since the start" : name);
    size_t shown = numbers < MOST_CURVES ? numbers : MOST_CURVES;
    f->left_out = f->left_out || shown < numbers;
    for (size_t k = 0; p && k < shown; k++)
        if (!add_against_t(f, p, first + spread(k, shown, numbers), PLOT_LINE, change)) return false;
    return p != NULL;
}

static bool add_all_named(figure *f, load_naming *name, size_t column, bool change)
{
    const char *one;
    size_t numbers;
    for (size_t k = 0; (one = name(f->model->system, k, &numbers)) != NULL; k++, column += numbers)
        if (!add_named(f, one, column, numbers, change)) return false;
    return true;
}

static bool add_everything(figure *f)
{
    motus_system *system = f->model->system;
    shared s = {SIZE_MAX, SIZE_MAX};
    for (size_t k = 0; k < motus_variable_count(system); k++) {
        motus_variable v = motus_default_variable();
        if (motus_variable_at(system, k, &v) == MOTUS_OK && !add_variable(f, &v, &s)) return false;
    }
    return add_all_named(f, motus_quantity_name, load_quantity_column(f->model), false) &&
           add_all_named(f, motus_invariant_name, load_invariant_column(f->model), true);
}

motus_status figure_column(const load *m, const char *name, size_t *column, motus_error *err)
{
    size_t count;
    motus_status status = motus_column_find(m->system, name, column, &count, err);
    if (!status && count != 1) {
        motus_column c = motus_default_column();
        fail(err, MOTUS_SHAPE, "--plot-of: %s is %zu numbers", name, count);
        if (motus_column_at(m->system, *column, &c) == MOTUS_OK) hint(err, "choose one of them, as %s", c.name);
        return MOTUS_SHAPE;
    }
    return status;
}

motus_status figure_plane(const load *m, const char *text, size_t columns[2], motus_error *err)
{
    options_list names;
    motus_status status = words_part(text, "--plot-of", &names, err);
    if (status) return status;
    if (names.count != 2) {
        status = fail(err, MOTUS_ARGUMENT, "--plot-of %s: two columns are needed", text);
        hint(err, "--plot-of \"x,x'\" draws x' against x");
    }
    for (int a = 0; !status && a < 2; a++) status = figure_column(m, names.items[a], &columns[a], err);
    words_free(&names);
    return status;
}

/* Adds a curve of one column against another. */
static plot_curve *add_recorded(figure *f, plot_panel *p, const char *label, const size_t columns[2], plot_role role)
{
    double *x = record_add(&f->fine, columns[0]), *y = x ? record_add(&f->fine, columns[1]) : NULL;
    plot_curve *c = y ? plot_curve_add(p, label, x, y, 0, 1) : NULL;
    if (!c) return NULL;
    c->role = role;
    c->timelike = columns[0] == 0;
    return c;
}

/* Adds the plane of two columns. */
static motus_status add_plane(figure *f, const char *text, motus_error *err)
{
    size_t columns[2] = {0, 0}, exact[2], count[2];
    char names[2][PLOT_LABEL], title[PLOT_LABEL];
    motus_status status = figure_plane(f->model, text, columns, err);
    if (status) return status;
    for (int a = 0; a < 2; a++) column_name(f, columns[a], names[a], sizeof names[a]);
    snprintf(title, sizeof title, "%.60s against %.60s", names[1], names[0]);
    plot_panel *p = add_panel(f, title, names[0], names[1]);
    if (!p || !add_recorded(f, p, f->plot.title, columns, PLOT_LINE)) return complain_memory(err);
    bool both = true;
    for (int a = 0; both && a < 2; a++) {
        char name[PLOT_LABEL + 8];
        snprintf(name, sizeof name, columns[a] == 0 ? "%s" : "exact %s", names[a]);
        both = motus_column_find(f->model->system, name, &exact[a], &count[a], NULL) == MOTUS_OK && count[a] == 1;
    }
    return !both || add_recorded(f, p, "exact", exact, PLOT_EXACT) ? MOTUS_OK : complain_memory(err);
}

motus_status figure_begin(figure *f, const load *model, const options *o, motus_run *run, double until, bool errors,
                          motus_error *err)
{
    char step[DECIMAL_MAX];
    const motus_run_statistics now = motus_run_now(run);
    const int64_t steps = now.steps_total;
    const double way = until - motus_run_time(run);
    *f = (figure){.model = model};
    f->fine = record_with_jumps(record_for(steps, way, FINE_SAMPLES));
    f->coarse = record_for(steps, way, COARSE_SAMPLES);
    f->last = record_for(steps, way, 1);
    text_brief(now.step, 6, step);
    if (isnan(now.step))
        snprintf(f->plot.title, sizeof f->plot.title, "%.60s: %.40s", model->title, now.method);
    else
        snprintf(f->plot.title, sizeof f->plot.title, "%.60s: %.40s, step %s", model->title, now.method, step);
    f->t = record_add(&f->fine, 0);
    f->coarse_t = record_add(&f->coarse, 0);
    f->bars = record_for(steps, way, BAR_SAMPLES);
    f->bars.with_errors = errors;
    f->bars_t = errors ? record_add(&f->bars, 0) : NULL;
    if (!f->t || !f->coarse_t || (errors && !f->bars_t)) return complain_memory(err);
    if (o->plot_of) return add_plane(f, o->plot_of, err);
    return add_everything(f) ? MOTUS_OK : complain_memory(err);
}

void figure_observers(figure *f, walk_observer out[FIGURE_OBSERVERS])
{
    out[0] = record_observer(&f->fine);
    out[1] = record_observer(&f->coarse);
    out[2] = record_observer(&f->last);
    out[3] = record_observer(&f->bars);
}

static bool fill_heat(figure *f, const figure_heat *h)
{
    plot_panel *p = &f->plot.panels[h->panel];
    const record *r = h->field ? &f->last : &f->coarse;
    p->heat_rows = h->rows;
    p->heat_columns = h->field ? h->columns : r->rows;
    p->y_first = h->cell_first;
    p->y_step = h->cell_step;
    if (!h->field) {
        p->x_first = f->coarse_t[0];
        p->x_step = r->rows > 1 ? (f->coarse_t[r->rows - 1] - f->coarse_t[0]) / (double)(r->rows - 1) : 1;
    }
    p->heat = malloc((p->heat_rows * p->heat_columns + 1) * sizeof *p->heat);
    if (!p->heat) return false;
    for (size_t i = 0; i < p->heat_rows; i++)
        for (size_t j = 0; j < p->heat_columns; j++)
            p->heat[i * p->heat_columns + j] =
                h->field ? r->values[h->first + i * h->columns + j][0] : r->values[h->first + i][j];
    return true;
}

/* Returns how many rows are not later than a time; NaN: all. */
static size_t rows_until(const figure *f, double time)
{
    const size_t rows = f->fine.rows;
    if (isnan(time) || rows == 0) return rows;
    const double way = f->t[rows - 1] < f->t[0] ? -1 : 1;
    size_t n = rows;
    while (n > 0 && !((f->t[n - 1] - time) * way <= 0)) n--;
    return n;
}

/* Adds to the title from when on no digit is known, in the words of the run's table. */
static void tell_unknown(figure *f, double known_until)
{
    char time[DECIMAL_MAX];
    const size_t rows = f->fine.rows;
    if (rows == 0 || rows_until(f, known_until) == rows) return;
    decimal_time(known_until, f->t[rows - 1] - f->t[0], time);
    const size_t length = strlen(f->plot.title);
    snprintf(f->plot.title + length, sizeof f->plot.title - length, "; no digit is known after %s = %s (dotted)",
             f->model->time, time);
    for (size_t i = 0; i < f->heat_count; i++)
        if (!f->heats[i].field) f->plot.panels[f->heats[i].panel].unknown_from = known_until;
}

motus_status figure_draw(figure *f, double known_until, const char *path, file_out *file, motus_error *err)
{
    tell_unknown(f, known_until);
    const size_t known = rows_until(f, known_until);
    for (size_t i = 0; i < f->plot.count; i++)
        for (size_t k = 0; k < f->plot.panels[i].curve_count; k++) {
            plot_curve *c = &f->plot.panels[i].curves[k];
            c->count = f->fine.rows;
            c->known = c->change ? c->count : known; /* the change of an invariant is known at all times */
            /* the band ends where no digit is significant any more, or no error is known */
            for (c->band_count = 0; c->at && c->band_count < f->bars.rows; c->band_count++)
                if (!isfinite(c->error[c->band_count])) break;
        }
    for (size_t i = 0; i < f->heat_count; i++)
        if (!fill_heat(f, &f->heats[i])) return complain_memory(err);
    return plot_draw(&f->plot, path, file, err);
}

void figure_free(figure *f)
{
    plot_free(&f->plot);
    record_free(&f->fine);
    record_free(&f->coarse);
    record_free(&f->last);
    record_free(&f->bars);
    *f = (figure){0};
}
