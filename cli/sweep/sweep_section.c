/* The points of --section of all trajectories of a sweep, in one plane. Each trajectory has its colour; if one axis is
 * a varied number, the picture is a bifurcation diagram.
 *
 * Invariant: the points are in the order of the trajectories, and those of a trajectory in the order of time.
 */
#include "cli/draw/plot.h"
#include "cli/files/target.h"
#include "cli/run/figure.h"
#include "cli/sweep/sweep.h"
#include "cli/words/complain.h"
#include "cli/words/words.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

enum { X, Y, SHADE, NUMBERS };

motus_status sweep_section_check(const options *o, motus_error *err)
{
    if (!o->plot) return MOTUS_OK;
    if (o->resume)
        return complain(err, MOTUS_ARGUMENT, "leave out one of them",
                        "--resume and --plot exclude each other: a picture has all trajectories of one command");
    const char *const others[] = {o->output, o->events};
    for (size_t k = 0; k < sizeof others / sizeof *others; k++)
        if (others[k] && file_same(others[k], o->plot))
            return fail(err, MOTUS_ARGUMENT, "%s is named for two outputs", o->plot);
    const motus_status status = target_check(o, o->plot, err);
    return status ? status : plot_check(o->plot, err);
}

/* Finds which names of --plot-of are varied numbers. If one is, the other name is a column. */
static motus_status varied_axis(sweep_section *p, const char *text, motus_error *err)
{
    options_list names;
    const sweep *const s = p->sweep;
    motus_status status = words_part(text, "--plot-of", &names, err);
    if (status) return status;
    for (size_t a = 0; names.count == 2 && a < 2; a++) {
        p->axis[a] = grid_find(&s->grid, names.items[a]);
        p->varied[a] = p->axis[a] < s->grid.count;
    }
    if (p->varied[0] && p->varied[1])
        status = fail(err, MOTUS_ARGUMENT, "--plot-of %s: both numbers are varied; one must be of the motion", text);
    if (!status && (p->varied[0] || p->varied[1]))
        status = figure_column(&s->model, names.items[p->varied[0]], &p->of[p->varied[0]], err);
    words_free(&names);
    return status;
}

motus_status sweep_section_plan(sweep_section *p, sweep *s, motus_error *err)
{
    const options *o = s->options;
    *p = (sweep_section){.sweep = s};
    if (!o->plot) return MOTUS_OK;
    if (!o->section) return sweep_curves_plan(&p->curves, s, err);
    motus_status status = o->plot_of ? varied_axis(p, o->plot_of, err) : MOTUS_OK;
    if (!status && !p->varied[0] && !p->varied[1]) status = section_plane(&s->model, o, p->of, err);
    if (status) return status;
    const size_t first = s->event_columns_count;
    size_t *columns = realloc(s->event_columns, (first + 2) * sizeof *columns);
    if (!columns) return complain_memory(err);
    s->event_columns = columns;
    for (size_t a = 0; a < 2; a++) {
        if (p->varied[a]) continue;
        p->place[a] = first + s->event_columns_more;
        columns[first + s->event_columns_more++] = p->of[a];
    }
    return MOTUS_OK;
}

motus_status sweep_section_open(sweep_section *p, motus_error *err)
{
    const sweep *s = p->sweep;
    if (!s->options->plot) return MOTUS_OK;
    p->values = malloc((s->event_columns_count + s->event_columns_more + 1) * sizeof *p->values);
    return p->values ? file_create(&p->file, s->options->plot, err) : complain_memory(err);
}

/* Adds a point, with numbers that are not set yet. Returns NULL if memory runs out. */
static double *point(sweep_section *p)
{
    if (p->count == p->room) {
        const size_t room = p->room + p->room / 2 + 1024;
        double *points =
            room < SIZE_MAX / NUMBERS / sizeof *points ? realloc(p->points, room * NUMBERS * sizeof *points) : NULL;
        if (!points) return NULL;
        p->points = points;
        p->room = room;
    }
    return p->points + NUMBERS * p->count++;
}

/* Returns the number that gives a trajectory its colour. */
static double shade_of(const sweep *s, uint64_t first, size_t k, double *const *values)
{
    return s->grid.count == 1 ? values[0][k] : (double)shard_trajectory(&s->shard, first + k);
}

motus_status sweep_section_take(sweep_section *p, uint64_t first, size_t count, const sweep_rows *of, motus_error *err)
{
    const sweep *s = p->sweep;
    double *const *values = of->values;
    if (s->options->plot && !s->options->section) return sweep_curves_take(&p->curves, first, count, of, err);
    for (size_t k = 0; s->options->plot && k < count; k++) {
        const int64_t rows = motus_ensemble_events(s->ensemble, k);
        int64_t seen = 0;
        for (int64_t i = 0; i < rows; i++) {
            motus_event_row row = motus_default_event_row();
            motus_ensemble_event(s->ensemble, k, i, &row, p->values, NULL);
            if (strcmp(row.name, LOAD_SECTION) != 0 || seen++ < s->options->skip) continue;
            double *at = point(p);
            if (!at) return complain_memory(err);
            for (size_t a = 0; a < 2; a++) at[a] = p->varied[a] ? values[p->axis[a]][k] : p->values[p->place[a]];
            at[SHADE] = shade_of(s, first, k, values);
        }
    }
    return MOTUS_OK;
}

/* Writes the name of an axis of the picture, with its unit. */
static void name_of(const sweep_section *p, size_t a, char out[PLOT_LABEL])
{
    const sweep *s = p->sweep;
    if (p->varied[a])
        units_label(s->model.text, s->grid.axes[p->axis[a]].name, false, out, PLOT_LABEL);
    else
        figure_label(&s->model, p->of[a], out);
}

static motus_status draw_points(sweep_section *p, motus_error *err)
{
    const sweep *s = p->sweep;
    plot_figure plot = {0};
    char title[PLOT_LABEL], name[2][PLOT_LABEL];
    if (p->count == 0)
        return complain(err, MOTUS_ARGUMENT, "give a later end, --until, or a smaller --skip",
                        "--section %s: there are no points left to draw", s->options->section);
    for (size_t a = 0; a < 2; a++) name_of(p, a, name[a]);
    const bool diagram = p->varied[0] || p->varied[1];
    snprintf(plot.title, sizeof plot.title, "%.60s: %.40s", s->model.title, s->method);
    snprintf(title, sizeof title, "where %.60s: %zu points of %" PRIu64 " trajectories", s->options->section, p->count,
             s->rows);
    plot_panel *panel = plot_panel_add(&plot, title, name[0], name[1]);
    plot_curve *c = panel ? plot_curve_add(panel, title, p->points, p->points + Y, p->count, NUMBERS) : NULL;
    if (c) c->role = PLOT_POINTS;
    if (c) panel->equal = !diagram && figure_agree(&s->model, p->of[0], p->of[1]);
    if (c && !diagram && s->rows > 1) {
        c->shade = p->points + SHADE;
        if (s->grid.count == 1)
            units_label(s->model.text, s->grid.axes[0].name, false, panel->shade_label, sizeof panel->shade_label);
        else
            snprintf(panel->shade_label, sizeof panel->shade_label, "trajectory");
    }
    const motus_status status = c ? plot_draw(&plot, s->options->plot, &p->file, err) : complain_memory(err);
    plot_free(&plot);
    return status;
}

motus_status sweep_section_draw(sweep_section *p, motus_error *err)
{
    const options *o = p->sweep->options;
    if (!o->plot) return MOTUS_OK;
    motus_status status = o->section ? draw_points(p, err) : sweep_curves_draw(&p->curves, &p->file, err);
    if (!status) status = file_finish(&p->file, err);
    return status ? status : file_keep(&p->file, err);
}

void sweep_section_close(sweep_section *p)
{
    file_drop(&p->file);
    sweep_curves_close(&p->curves);
    free(p->values);
    free(p->points);
    p->values = p->points = NULL;
}
