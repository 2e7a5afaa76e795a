/* The picture of a sweep without a section: what is recorded, against what varies. One number that varies gives a
 * curve, two give a curve for each value of one of them, or a map where both have many values; random numbers give
 * points.
 *
 * Invariant: a bounded number of trajectories is kept, evenly spread over the sweep.
 */
#include "cli/draw/plot.h"
#include "cli/run/figure.h"
#include "cli/sweep/sweep.h"
#include "cli/words/complain.h"
#include "cli/words/text.h"
#include "cli/words/words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    MOST = 400000, /* trajectories that are kept */
    CURVES = 8,    /* of the values of a second number; if it has more, the picture is a map */
    PANELS = 6,
    DOTS = 150 /* trajectories that are seen as dots */
};

/* Returns the record of a name, as it stands in the head of a file; records.count: there is none. */
static size_t find_record(const sweep *s, const char *name)
{
    size_t k = 0;
    for (char own[SWEEP_NAME]; k < s->records.count; k++) {
        sweep_record_name(&s->model, &s->records.items[k], own);
        if (strcmp(own, name) == 0) break;
    }
    return k;
}

/* Chooses what --plot-of names: first the number on the horizontal axis, then records. */
static motus_status choose_named(sweep_curves *c, const char *text, motus_error *err)
{
    const sweep *const s = c->sweep;
    options_list names;
    motus_status status = words_part(text, "--plot-of", &names, err);
    if (status) return status;
    if (names.count < 2 || names.count > PANELS + 1) {
        status =
            fail(err, MOTUS_ARGUMENT, "--plot-of %s: two numbers are needed, and %d are the most", text, PANELS + 1);
        hint(err, "--plot-of \"%s,max(x)\" draws max(x) against %s", s->grid.axes[0].name, s->grid.axes[0].name);
    }
    for (size_t k = 0; !status && k < names.count; k++) {
        const size_t axis = grid_find(&s->grid, names.items[k]), record = find_record(s, names.items[k]);
        if (k == 0 && axis < s->grid.count) {
            c->axis = axis;
        } else if (k > 0 && record < s->records.count) {
            c->shown[c->count++] = record;
        } else {
            status = fail(err, MOTUS_ARGUMENT, "--plot-of %s: %s is not %s", text, names.items[k],
                          k == 0 ? "varied" : "recorded");
            if (k == 0)
                hint(err, "first comes what --vary names, as %s", s->grid.axes[0].name);
            else
                hint(err, "add --record \"%s\"", names.items[k]);
        }
    }
    words_free(&names);
    return status;
}

/* Chooses all that --record names, or of the final state the numbers without their velocities. */
static void choose_all(sweep_curves *c)
{
    const sweep *const s = c->sweep;
    for (size_t k = 0; k < s->records.count && c->count < PANELS; k++) {
        motus_column column = motus_default_column();
        const bool known = motus_column_at(s->model.system, s->records.items[k].column, &column) == MOTUS_OK;
        if (!s->options->record && known && column.kind == MOTUS_COLUMN_VELOCITY) continue;
        c->shown[c->count++] = k;
    }
}

motus_status sweep_curves_plan(sweep_curves *c, const sweep *s, motus_error *err)
{
    *c = (sweep_curves){.sweep = s};
    const motus_status status = s->options->plot_of ? choose_named(c, s->options->plot_of, err) : MOTUS_OK;
    if (!status && !s->options->plot_of) choose_all(c);
    if (!status && c->count == 0)
        return complain(err, MOTUS_ARGUMENT, "add --record \"max(x)\"", "--plot: the sweep records no number to draw");
    /* the second number is another one that varies, unless several vary together */
    c->second = s->grid.count == 2 && !s->grid.zip ? 1 - c->axis : s->grid.count;
    for (size_t k = 0; k < s->grid.count; k++) c->random = c->random || s->grid.axes[k].kind > AXIS_LIST;
    c->width = 2 + 2 * c->count;
    return status;
}

motus_status sweep_curves_take(sweep_curves *c, uint64_t first, size_t count, const sweep_rows *rows, motus_error *err)
{
    const sweep *const s = c->sweep;
    const uint64_t stride = s->rows / MOST + 1;
    for (size_t k = 0; k < count; k++) {
        if ((first + k) % stride != 0) continue;
        if (c->rows == c->room) {
            const size_t room = c->room + c->room / 2 + 256;
            double *numbers = realloc(c->numbers, room * c->width * sizeof *numbers);
            if (!numbers) return complain_memory(err);
            c->numbers = numbers;
            c->room = room;
        }
        double *at = c->numbers + c->width * c->rows++;
        at[0] = rows->values[c->axis][k];
        at[1] = c->second < s->grid.count ? rows->values[c->second][k] : 0;
        for (size_t i = 0; i < c->count; i++) {
            at[2 + i] = isnan(rows->stopped[k]) ? rows->results[c->shown[i]][k] : NAN;
            at[2 + c->count + i] =
                rows->errors && sweep_record_errs(&s->records.items[c->shown[i]]) ? rows->errors[c->shown[i]][k] : NAN;
        }
    }
    return MOTUS_OK;
}

/* ---- the figure ---- */

/* Orders rows by the second number, and then by the first. */
static int in_order(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return x[1] != y[1] ? (x[1] > y[1]) - (x[1] < y[1]) : (x[0] > y[0]) - (x[0] < y[0]);
}

/* Returns how many rows from `from` on have one value of the second number. */
static size_t run_of(const sweep_curves *c, size_t from)
{
    size_t n = from;
    while (n < c->rows && c->numbers[n * c->width + 1] == c->numbers[from * c->width + 1]) n++;
    return n - from;
}

/* Returns whether the rows, in their order, are a grid with equal distances along both axes. */
static bool is_grid(const sweep_curves *c, size_t columns)
{
    const size_t lines = columns ? c->rows / columns : 0;
    if (columns < 2 || lines < 2 || lines * columns != c->rows) return false;
    const double *n = c->numbers, *last = n + (c->rows - 1) * c->width;
    const double dx = (last[0] - n[0]) / (double)(columns - 1), dy = (last[1] - n[1]) / (double)(lines - 1);
    for (size_t k = 0; k < c->rows; k++)
        if (!(fabs(n[k * c->width] - n[0] - dx * (double)(k % columns)) < 1e-6 * fabs(dx)) ||
            !(fabs(n[k * c->width + 1] - n[1] - dy * (double)(k / columns)) < 1e-6 * fabs(dy)))
            return false;
    return true;
}

static bool add_map(const sweep_curves *c, plot_panel *p, size_t record, size_t columns)
{
    const double *n = c->numbers, *last = n + (c->rows - 1) * c->width;
    p->heat_columns = columns;
    p->heat_rows = c->rows / columns;
    p->x_first = n[0];
    p->x_step = (last[0] - n[0]) / (double)(columns - 1);
    p->y_first = n[1];
    p->y_step = (last[1] - n[1]) / (double)(p->heat_rows - 1);
    p->heat = malloc(c->rows * sizeof *p->heat);
    for (size_t k = 0; p->heat && k < c->rows; k++) p->heat[k] = n[k * c->width + 2 + record];
    return p->heat != NULL;
}

/* Adds the rows [from, from + count) as a curve, with the trajectories as dots and the errors as a band. */
static bool add_curve(sweep_curves *c, plot_panel *p, size_t record, const char *label, size_t from, size_t count)
{
    const double *n = c->numbers + from * c->width, *y = n + 2 + record;
    plot_curve *curve = plot_curve_add(p, label, n, y, count, c->width);
    if (!curve) return false;
    curve->timelike = true;
    if (c->random) curve->role = PLOT_POINTS;
    if (c->sweep->errors && !c->random) {
        curve->at = n;
        curve->middle = y;
        curve->error = y + c->count;
        curve->band_stride = c->width;
        while (curve->band_count < count && isfinite(curve->error[curve->band_count * c->width])) curve->band_count++;
    }
    if (c->random || c->rows > DOTS) return true;
    curve = plot_curve_add(p, "trajectories", n, y, count, c->width);
    if (curve) curve->role = PLOT_STEPS;
    return curve != NULL;
}

/* Adds the panel of one record. */
static bool add_panel(sweep_curves *c, plot_figure *f, size_t record)
{
    const sweep *const s = c->sweep;
    char name[SWEEP_NAME], title[PLOT_LABEL], x[PLOT_LABEL], y[PLOT_LABEL], second[PLOT_LABEL] = "";
    const bool two = c->second < s->grid.count;
    const size_t columns = two ? run_of(c, 0) : c->rows;
    sweep_record_name(&s->model, &s->records.items[c->shown[record]], name);
    units_label(s->model.text, s->grid.axes[c->axis].name, false, x, sizeof x);
    units_label(s->model.text, name, false, y, sizeof y);
    if (two) units_label(s->model.text, s->grid.axes[c->second].name, false, second, sizeof second);
    const bool map = two && c->rows / (columns ? columns : 1) > CURVES;
    snprintf(title, sizeof title, "%.70s against %.50s%s%.50s", name, s->grid.axes[c->axis].name, two ? " and " : "",
             two ? s->grid.axes[c->second].name : "");
    plot_panel *p = plot_panel_add(f, title, x, map ? second : y);
    if (!p) return false;
    const axis *const a = &s->grid.axes[c->axis];
    p->log_x = a->kind == AXIS_RANGE && a->range.logarithmic && c->rows > 0 && c->numbers[0] > 0;
    if (map && is_grid(c, columns)) {
        snprintf(p->shade_label, sizeof p->shade_label, "%.200s", y);
        return add_map(c, p, record, columns);
    }
    if (map || s->grid.count > 2 || (two && c->random)) { /* points, whose colour is the record */
        plot_curve *curve = plot_curve_add(p, name, c->numbers, c->numbers + (two ? 1 : 2 + record), c->rows, c->width);
        if (!curve) return false;
        curve->role = PLOT_POINTS;
        if (!two) return true;
        snprintf(p->y_label, sizeof p->y_label, "%s", second);
        snprintf(p->shade_label, sizeof p->shade_label, "%.200s", y);
        curve->shade = c->numbers + 2 + record;
        return true;
    }
    bool good = true;
    for (size_t from = 0, count; good && from < c->rows; from += count) {
        char label[PLOT_LABEL], value[DECIMAL_MAX];
        count = run_of(c, from);
        text_brief(c->numbers[from * c->width + 1], 6, value);
        if (two)
            snprintf(label, sizeof label, "%.60s = %s", s->grid.axes[c->second].name, value);
        else
            snprintf(label, sizeof label, "%.60s", name);
        good = add_curve(c, p, record, label, from, count);
    }
    return good;
}

motus_status sweep_curves_draw(sweep_curves *c, file_out *file, motus_error *err)
{
    const sweep *const s = c->sweep;
    plot_figure plot = {0};
    motus_status status = MOTUS_OK;
    qsort(c->numbers, c->rows, c->width * sizeof *c->numbers, in_order);
    snprintf(plot.title, sizeof plot.title, "%.60s: %.40s, %llu trajectories", s->model.title, s->method,
             (unsigned long long)s->rows);
    for (size_t k = 0; !status && k < c->count; k++)
        if (!add_panel(c, &plot, k)) status = complain_memory(err);
    if (!status) status = plot_draw(&plot, s->options->plot, file, err);
    plot_free(&plot);
    return status;
}

void sweep_curves_close(sweep_curves *c)
{
    free(c->numbers);
    c->numbers = NULL;
}
