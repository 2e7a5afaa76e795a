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
    FINE_SAMPLES = 60000,
    SMOOTH = 4000, /* samples of a run, at least, so that few steps do not look like a polygon */
    DOTS = 150,    /* steps that are seen as dots */
    STEPS = 8000,  /* steps of which the changes of invariants are drawn, at most: between steps they tell of the dense
                      output, not of the method */
    DOTTED = 3,    /* curves of a panel that have dots, at most */
    DRIFTS = 4,    /* invariants */
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

void figure_label(const load *m, size_t column, char out[PLOT_LABEL])
{
    motus_column c = motus_default_column();
    const bool found = motus_column_at(m->system, column, &c) == MOTUS_OK;
    units_label(m->text, found ? c.name : "", column == 0, out, PLOT_LABEL);
}

bool figure_agree(const load *m, size_t a, size_t b)
{
    motus_column c[2] = {motus_default_column(), motus_default_column()};
    char unit[2][UNIT_MAX];
    if (a == 0 || b == 0 || motus_column_at(m->system, a, &c[0]) || motus_column_at(m->system, b, &c[1])) return false;
    for (int k = 0; k < 2; k++) units_of(m->text, c[k].name, false, unit[k]);
    if (unit[0][0] || unit[1][0]) return strcmp(unit[0], unit[1]) == 0;
    if (c[0].kind != c[1].kind || c[0].is_velocity != c[1].is_velocity) return false;
    return c[0].kind == MOTUS_COLUMN_POSITION || c[0].kind == MOTUS_COLUMN_VELOCITY || c[0].variable == c[1].variable;
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

/* Returns the record of the exact motion, which is smooth where the method's is not. */
static record *exact_record(figure *f) { return f->smooth.count > 0 ? &f->smooth : &f->fine; }

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
    record *r = change ? &f->steps : role == PLOT_EXACT ? exact_record(f) : &f->fine;
    double *y = record_add(r, column);
    plot_curve *c = y ? plot_curve_add(p, label, r->values[0], y, 0, 1) : NULL;
    if (!c) return false;
    c->role = role;
    c->timelike = true;
    c->change = change;
    return role == PLOT_EXACT || change || !f->bars.with_errors || add_band(f, c, column);
}

/* Adds the steps of the method as dots on the line before; y 0: against t. */
static bool add_dots(figure *f, plot_panel *p, size_t axes, const size_t columns[3])
{
    if (!f->dotted) return true;
    const double *at[3] = {NULL, NULL, NULL};
    for (size_t a = 0; a < axes; a++) {
        at[a] = columns[a] == 0 ? f->steps_t : record_add(&f->steps, columns[a]);
        if (!at[a]) return false;
    }
    plot_curve *c = plot_curve_add(p, "steps", at[0], at[1], 0, 1);
    if (!c) return false;
    c->z = at[2];
    c->role = PLOT_STEPS;
    return true;
}

/* Adds curves of the numbers of a variable against t, at most MOST_CURVES. */
static bool add_numbers(figure *f, plot_panel *p, const figure_place *place, const figure_place *exact)
{
    size_t numbers = place->cells * place->components, shown = numbers < MOST_CURVES ? numbers : MOST_CURVES;
    f->left_out = f->left_out || shown < numbers;
    for (size_t k = 0; k < shown; k++) {
        size_t n = spread(k, shown, numbers);
        if (!add_against_t(f, p, place->first + n, PLOT_LINE, false) ||
            (p->curve_count <= 2 * DOTTED && shown <= DOTTED &&
             !add_dots(f, p, 2, (size_t[]){0, place->first + n, 0})) ||
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
        at[a] = record_add(role == PLOT_EXACT ? exact_record(f) : &f->fine, column_at(place, cell, a));
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
        const size_t columns[] = {column_at(place, cell, 0), column_at(place, cell, 1),
                                  column_at(place, cell, axes - 1)};
        if (!add_path(f, p, place, cell, axes, PLOT_LINE, label) ||
            (shown <= DOTTED && !add_dots(f, p, axes, columns)) ||
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
    char time[PLOT_LABEL];
    figure_label(f->model, 0, time);
    if (!add_panel(f, title, time, v->dimensions == 1 ? "index" : "cell")) return false;
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

/* Adds a panel of numbers against t. */
static plot_panel *add_time_panel(figure *f, const char *title, size_t column, const char *name)
{
    char x[PLOT_LABEL], y[PLOT_LABEL];
    figure_label(f->model, 0, x);
    units_label(f->model->text, name ? name : "", false, y, sizeof y);
    if (!name) figure_label(f->model, column, y);
    return add_panel(f, title, x, y);
}

/* Adds a panel of paths in the plane or in space. */
static plot_panel *add_path_panel(figure *f, const motus_variable *v)
{
    char label[3][PLOT_LABEL], name[MOTUS_NAME_MAX + 8];
    for (int a = 0; a < 3; a++) {
        snprintf(name, sizeof name, "%s.%c", v->name, "xyz"[a]);
        units_label(f->model->text, name, false, label[a], sizeof label[a]);
    }
    plot_panel *p = add_panel(f, "motion", label[0], label[1]);
    if (!p) return NULL;
    if (v->components == 3) snprintf(p->z_label, sizeof p->z_label, "%s", label[2]);
    p->equal = p->path = true;
    return p;
}

/* The label of an axis with the numbers of several variables: their unit, if they have one. */
static void share_label(const figure *f, plot_panel *p, const char *name)
{
    char unit[UNIT_MAX], whole[UNIT_MAX + 2];
    units_of(f->model->text, name, false, unit);
    snprintf(whole, sizeof whole, "(%s)", unit);
    const size_t length = strlen(p->y_label), own = strlen(whole);
    const bool same = unit[0] && length >= own && strcmp(p->y_label + length - own, whole) == 0;
    snprintf(p->y_label, sizeof p->y_label, "%s", same ? whole : "");
}

static bool add_variable(figure *f, const motus_variable *v, shared *s)
{
    figure_place place, exact_place;
    if (!figure_find(f->model, v, "", "", &place)) return true;
    const figure_place *exact = figure_find(f->model, v, "exact ", "", &exact_place) ? &exact_place : NULL;
    bool path = v->order == 2 && (v->components == 2 || v->components == 3);
    if (path && v->components == 2) {
        if (s->plane == SIZE_MAX) {
            if (!room_for_panel(f)) return true;
            s->plane = f->plot.count;
            if (!add_path_panel(f, v)) return false;
        }
        return add_paths(f, &f->plot.panels[s->plane], v, &place, exact);
    }
    if (v->dimensions == 0 && v->components == 0 && v->order == 2) {
        bool first = s->scalars == SIZE_MAX;
        if (first && !room_for_panel(f)) return true;
        if (first) {
            s->scalars = f->plot.count;
            if (!add_time_panel(f, "motion", place.first, NULL)) return false;
        }
        plot_panel *p = &f->plot.panels[s->scalars];
        if (!first) share_label(f, p, v->name);
        if (p->curve_count >= (size_t)2 * MOST_CURVES) {
            f->left_out = true;
            return true;
        }
        return add_numbers(f, p, &place, exact);
    }
    if (!room_for_panel(f)) return true;
    if (path) {
        plot_panel *p = add_path_panel(f, v);
        return p && add_paths(f, p, v, &place, exact);
    }
    if (v->components == 0 && place.cells > BUNDLE)
        return full_grid(v, place.cells) ? add_field(f, v, &place) : add_heat(f, v, &place);
    plot_panel *p = add_time_panel(f, v->order == 2 ? "motion" : v->name, 0, v->name);
    return p && add_numbers(f, p, &place, exact);
}

/* Adds low panels of the change of invariants since the start. */
static bool add_drifts(figure *f)
{
    const char *name;
    size_t numbers, column = load_invariant_column(f->model);
    for (size_t k = 0; (name = motus_invariant_name(f->model->system, k, &numbers)) != NULL; k++, column += numbers) {
        char title[PLOT_LABEL], x[PLOT_LABEL];
        const size_t shown = numbers < MOST_CURVES ? numbers : MOST_CURVES;
        f->left_out = f->left_out || shown < numbers || k >= DRIFTS;
        if (k >= DRIFTS || !room_for_panel(f)) return true;
        snprintf(title, sizeof title, "change of %s since the start", name);
        figure_label(f->model, 0, x);
        plot_panel *p = add_panel(f, title, x, "change");
        if (!p) return false;
        p->low = true;
        for (size_t i = 0; i < shown; i++)
            if (!add_against_t(f, p, column + spread(i, shown, numbers), PLOT_LINE, true)) return false;
    }
    return true;
}

/* Adds the state and the changes of the invariants. Quantities are drawn where --plot-of names them. */
static bool add_everything(figure *f)
{
    motus_system *system = f->model->system;
    shared s = {SIZE_MAX, SIZE_MAX};
    for (size_t k = 0; k < motus_variable_count(system); k++) {
        motus_variable v = motus_default_variable();
        if (motus_variable_at(system, k, &v) == MOTUS_OK && !add_variable(f, &v, &s)) return false;
    }
    f->shared = s.scalars;
    return add_drifts(f);
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
    record *r = role == PLOT_EXACT ? exact_record(f) : &f->fine;
    double *x = columns[0] == 0 ? r->values[0] : record_add(r, columns[0]), *y = x ? record_add(r, columns[1]) : NULL;
    plot_curve *c = y ? plot_curve_add(p, label, x, y, 0, 1) : NULL;
    if (!c) return NULL;
    c->role = role;
    c->timelike = columns[0] == 0;
    return c;
}

/* Finds the columns of the exact motion for two columns. */
static bool exact_of(const figure *f, const size_t columns[2], size_t exact[2])
{
    char names[2][PLOT_LABEL], name[PLOT_LABEL + 8];
    bool both = true;
    for (int a = 0; both && a < 2; a++) {
        size_t count;
        column_name(f, columns[a], names[a], sizeof names[a]);
        snprintf(name, sizeof name, columns[a] == 0 ? "%s" : "exact %s", names[a]);
        both = motus_column_find(f->model->system, name, &exact[a], &count, NULL) == MOTUS_OK && count == 1;
    }
    return both;
}

/* Adds the curve of column y against column x to the plane of --plot-of, with its steps, its band and the exact one. */
static bool add_to_plane(figure *f, plot_panel *p, const size_t columns[2], bool dots)
{
    char name[PLOT_LABEL], label[PLOT_LABEL + 8];
    size_t exact[2];
    column_name(f, columns[1], name, sizeof name);
    plot_curve *c = add_recorded(f, p, name, columns, PLOT_LINE);
    if (!c || (c->timelike && f->bars.with_errors && !add_band(f, c, columns[1]))) return false;
    if (dots && !add_dots(f, p, 2, (size_t[]){columns[0], columns[1], 0})) return false;
    snprintf(label, sizeof label, "exact %s", name);
    return !exact_of(f, columns, exact) || add_recorded(f, p, label, exact, PLOT_EXACT);
}

/* Adds the plane of --plot-of: one column, and others against it. */
static motus_status add_plane(figure *f, const char *text, motus_error *err)
{
    size_t columns[MOST_CURVES + 1] = {0};
    char label[2][PLOT_LABEL], title[PLOT_LABEL] = "";
    options_list names;
    motus_status status = words_part(text, "--plot-of", &names, err);
    if (status) return status;
    if (names.count < 2 || names.count > MOST_CURVES + 1) {
        status = fail(err, MOTUS_ARGUMENT, "--plot-of %s: two columns are needed, and %d are the most", text,
                      MOST_CURVES + 1);
        hint(err, "--plot-of \"x,x'\" draws x' against x");
    }
    for (size_t a = 0; !status && a < names.count; a++)
        status = figure_column(f->model, names.items[a], &columns[a], err);
    for (size_t a = 1; !status && a < names.count; a++) {
        const size_t length = strlen(title);
        snprintf(title + length, sizeof title - length, "%s%.60s", a > 1 ? ", " : "", names.items[a]);
    }
    if (!status) {
        const size_t length = strlen(title);
        snprintf(title + length, sizeof title - length, " against %.60s", names.items[0]);
        for (size_t a = 0; a < 2; a++) figure_label(f->model, columns[a], label[a]);
        plot_panel *p = add_panel(f, title, label[0], label[1]);
        if (p) p->path = columns[0] != 0;
        if (p) p->equal = true;
        for (size_t a = 1; p && a < names.count; a++) {
            p->equal = p->equal && figure_agree(f->model, columns[0], columns[a]);
            if (a > 1) share_label(f, p, names.items[a]);
            if (!add_to_plane(f, p, (size_t[]){columns[0], columns[a]}, names.count <= DOTTED + 1)) p = NULL;
        }
        if (!p) status = complain_memory(err);
    }
    words_free(&names);
    return status;
}

bool figure_smooth(const char *method)
{
    const motus_method *found = NULL;
    return motus_method_find(method, &found, NULL) == MOTUS_OK && found->dense_order > 1;
}

motus_status figure_begin(figure *f, const load *model, const options *o, motus_run *run, double until, bool errors,
                          motus_error *err)
{
    char step[DECIMAL_MAX];
    const motus_run_statistics now = motus_run_now(run);
    const int64_t steps = now.steps_total;
    const double way = until - motus_run_time(run);
    *f = (figure){.model = model, .shared = SIZE_MAX};
    const bool few = steps > 0 && steps < SMOOTH, smooth = figure_smooth(now.method);
    const record between = few ? record_between(now.step, way, SMOOTH / steps + 1) : record_for(steps, way, 1);
    f->fine = record_with_jumps(few && smooth ? between : record_for(steps, way, FINE_SAMPLES));
    f->smooth = between;
    if (few && !smooth && motus_has_exact(model->system) && !record_add(&f->smooth, 0)) return complain_memory(err);
    f->dotted = steps <= DOTS;
    f->steps = record_at_steps(steps, way, STEPS);
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
    f->steps_t = record_add(&f->steps, 0);
    if (!f->t || !f->coarse_t || !f->steps_t || (errors && !f->bars_t)) return complain_memory(err);
    if (o->plot_of) return add_plane(f, o->plot_of, err);
    return add_everything(f) ? MOTUS_OK : complain_memory(err);
}

void figure_observers(figure *f, walk_observer out[FIGURE_OBSERVERS])
{
    out[0] = record_observer(&f->fine);
    out[1] = record_observer(&f->coarse);
    out[2] = record_observer(&f->last);
    out[3] = record_observer(&f->bars);
    out[4] = record_observer(&f->steps);
    out[5] = record_observer(&f->smooth);
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

motus_status figure_draw(figure *f, motus_run *run, double known_until, const char *path, file_out *file,
                         motus_error *err)
{
    tell_unknown(f, known_until);
    const size_t known = rows_until(f, known_until);
    const bool many = f->steps.every > 1 || f->steps.rows > DOTS + 1;
    for (size_t i = 0; i < f->plot.count; i++)
        for (size_t k = 0; k < f->plot.panels[i].curve_count; k++) {
            plot_curve *c = &f->plot.panels[i].curves[k];
            if (c->role == PLOT_EXACT) {
                c->count = c->known = exact_record(f)->rows;
                continue;
            }
            c->count = c->role == PLOT_STEPS && many        ? 0
                       : c->role == PLOT_STEPS || c->change ? f->steps.rows
                                                            : f->fine.rows;
            c->known = c->change ? c->count : known; /* the change of an invariant is known at all times */
            /* the band ends where no digit is significant any more, or no error is known */
            for (c->band_count = 0; c->at && c->band_count < f->bars.rows; c->band_count++)
                if (!isfinite(c->error[c->band_count])) break;
        }
    if (!split_panels(f)) return complain_memory(err);
    const motus_status status = marks_add(f, run, err);
    if (status) return status;
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
    record_free(&f->steps);
    record_free(&f->smooth);
    for (size_t k = 0; k < f->room_count; k++) free(f->rooms[k]);
    free(f->rooms);
    *f = (figure){0};
}
