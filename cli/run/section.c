/* The points of --section in a plane. */
#include "cli/run/figure.h"

#include "cli/draw/plot.h"
#include "cli/words/complain.h"

#include <stdlib.h>
#include <string.h>

/* Returns whether a text has a name as a word of its own: with a prime if *primed, without if not; NULL: either. */
static bool names(const char *text, const char *name, const bool *primed)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
    const size_t length = strlen(name);
    for (const char *at = text; (at = strstr(at, name)) != NULL; at++) {
        const bool before = at > text && (strchr(letters, at[-1]) || (at[-1] & 0x80));
        const bool after = at[length] && (strchr(letters, at[length]) || (at[length] & 0x80));
        if (!before && !after && (!primed || *primed == (at[length] == '\''))) return true;
    }
    return false;
}

/* Returns the only number of the model, or, of two numbers, the one that the section does not name. NULL: there is no
 * such number. */
static const char *chosen(const load *m, const options *o)
{
    const char *left = NULL;
    const size_t count = motus_variable_count(m->system);
    size_t named = 0;
    for (size_t k = 0; k < count; k++) {
        motus_variable v = motus_default_variable();
        if (motus_variable_at(m->system, k, &v) != MOTUS_OK || v.count != 1 || v.order != 2) return NULL;
        if (count > 1 && names(o->section, v.name, NULL))
            named++;
        else
            left = v.name;
    }
    return count == 1 || (count == 2 && named == 1) ? left : NULL;
}

motus_status section_plane(const load *m, const options *o, size_t columns[2], motus_error *err)
{
    if (o->plot_of) return figure_plane(m, o->plot_of, columns, err);
    const char *const name = chosen(m, o);
    char text[2 * MOTUS_NAME_MAX + 8];
    if (!name)
        return complain(err, MOTUS_ARGUMENT, "choose two columns: --plot-of \"y,y'\"",
                        "--section %s: the model does not say in which plane to draw it", o->section);
    /* a number that the section fixes is not an axis */
    const bool of_x = names(o->section, name, &(bool){false}), of_v = names(o->section, name, &(bool){true});
    if (of_x != of_v)
        snprintf(text, sizeof text, "t,%s%s", name, of_x ? "'" : "");
    else
        snprintf(text, sizeof text, "%s,%s'", name, name);
    return figure_plane(m, text, columns, err);
}

/* Returns whether row k of the table is a point of the section. */
static bool of_section(motus_run *run, int64_t k)
{
    motus_event_row row = motus_default_event_row();
    return motus_run_event(run, k, &row) == MOTUS_OK && strcmp(row.name, LOAD_SECTION) == 0;
}

/* Collects the points in the plane, x and y side by side. */
static motus_status collect(const options *o, motus_run *run, const size_t columns[2], double *points, size_t *count,
                            motus_error *err)
{
    motus_status status = MOTUS_OK;
    int64_t seen = 0;
    for (int64_t k = 0; !status && k < motus_run_events(run); k++)
        if (of_section(run, k) && seen++ >= o->skip)
            status = motus_run_event_values(run, k, 0, columns, 2, points + 2 * (*count)++, err);
    if (status || *count > 0) return status;
    return complain(err, MOTUS_ARGUMENT, "give a later end, --until, or a smaller --skip",
                    "--section %s: there are %lld points, and none is left to draw", o->section, (long long)seen);
}

motus_status section_draw(const load *m, const options *o, motus_run *run, const size_t columns[2], file_out *file,
                          motus_error *err)
{
    plot_figure plot = {0};
    motus_column axis[2] = {motus_default_column(), motus_default_column()};
    char title[PLOT_LABEL];
    size_t count = 0;
    double *points = malloc((2 * (size_t)motus_run_events(run) + 1) * sizeof *points);
    motus_status status = points ? collect(o, run, columns, points, &count, err) : complain_memory(err);
    for (int a = 0; !status && a < 2; a++) status = motus_column_at(m->system, columns[a], &axis[a]);
    if (!status) {
        snprintf(plot.title, sizeof plot.title, "%.60s: %.40s", m->title, motus_run_now(run).method);
        snprintf(title, sizeof title, "where %.100s: %zu points", o->section, count);
        plot_panel *p = plot_panel_add(&plot, title, axis[0].name, axis[1].name);
        plot_curve *c = p ? plot_curve_add(p, title, points, points + 1, count, 2) : NULL;
        if (c) c->role = PLOT_POINTS;
        status = c ? plot_draw(&plot, o->plot, file, err) : complain_memory(err);
    }
    plot_free(&plot);
    free(points);
    return status;
}
