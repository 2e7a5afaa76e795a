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

/* The numbers of the state that a section leaves free. */
typedef struct plane {
    size_t moving[2];               /* the first such position, and its velocity */
    size_t free[2];                 /* first-order variables */
    size_t count, numbers;          /* how many of `free` there are, and how many numbers the state has */
    size_t first[2];                /* the first number of the state, and its velocity */
    char name[MOTUS_NAME_MAX + 64]; /* that of the first number */
} plane;

/* Looks at a component of the first cell of a variable; `velocity` is its column, or 0. */
static void look(const load *m, const char *section, size_t column, size_t velocity, plane *p)
{
    motus_column c = motus_default_column(), v = motus_default_column();
    if (motus_column_at(m->system, column, &c) || (velocity && motus_column_at(m->system, velocity, &v))) return;
    if (p->numbers++ == 0) {
        p->first[0] = column, p->first[1] = velocity;
        snprintf(p->name, sizeof p->name, "%s", c.name);
    }
    if (names(section, c.name, NULL) || (velocity && names(section, v.name, NULL))) return;
    if (velocity && !p->moving[0]) p->moving[0] = column, p->moving[1] = velocity;
    if (!velocity && p->count < 2) p->free[p->count++] = column;
}

static plane free_numbers(const load *m, const char *section)
{
    enum { CELLS = 64 }; /* of a family; a section names few of them */
    plane p = {0};
    for (size_t k = 0; k < motus_variable_count(m->system); k++) {
        motus_variable v = motus_default_variable();
        figure_place at, its = {0};
        if (motus_variable_at(m->system, k, &v) != MOTUS_OK || !figure_find(m, &v, "", "", &at)) continue;
        const bool moves = v.order == 2 && figure_find(m, &v, "", "'", &its);
        for (size_t i = 0; i < at.cells && i < CELLS; i++)
            for (size_t c = 0; c < at.components; c++) {
                const size_t velocity = its.first + i * its.cell_step + c * its.component_step;
                look(m, section, at.first + i * at.cell_step + c * at.component_step, moves ? velocity : 0, &p);
            }
    }
    return p;
}

motus_status section_plane(const load *m, const options *o, size_t columns[2], motus_error *err)
{
    if (o->plot_of) return figure_plane(m, o->plot_of, columns, err);
    const plane p = free_numbers(m, o->section);
    const size_t *const chosen = p.moving[0] ? p.moving : p.count == 2 ? p.free : p.first;
    columns[0] = chosen[0];
    columns[1] = chosen[1];
    if (p.numbers == 0)
        return complain(err, MOTUS_ARGUMENT, "choose two columns: --plot-of \"y,y'\"",
                        "--section %s: the model has no state in whose plane to draw it", o->section);
    /* where the first number is all that there is to draw, what the section fixes of it is no axis */
    const bool of_x = names(o->section, p.name, &(bool){false}), of_v = names(o->section, p.name, &(bool){true});
    if (chosen == p.first && of_x != of_v) {
        columns[1] = of_x && p.first[1] ? p.first[1] : p.first[0];
        columns[0] = 0;
    } else if (columns[1] == 0) { /* a first-order variable alone */
        columns[1] = p.count ? p.free[0] : columns[0];
        columns[0] = 0;
    }
    return MOTUS_OK;
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
    char title[PLOT_LABEL], axis[2][PLOT_LABEL];
    size_t count = 0;
    double *points = malloc((2 * (size_t)motus_run_events(run) + 1) * sizeof *points);
    motus_status status = points ? collect(o, run, columns, points, &count, err) : complain_memory(err);
    for (int a = 0; a < 2; a++) figure_label(m, columns[a], axis[a]);
    if (!status) {
        snprintf(plot.title, sizeof plot.title, "%.60s: %.40s", m->title, motus_run_now(run).method);
        snprintf(title, sizeof title, "where %.100s: %zu points", o->section, count);
        plot_panel *p = plot_panel_add(&plot, title, axis[0], axis[1]);
        plot_curve *c = p ? plot_curve_add(p, title, points, points + 1, count, 2) : NULL;
        if (c) c->role = PLOT_POINTS;
        if (p) p->equal = figure_agree(m, columns[0], columns[1]);
        status = c ? plot_draw(&plot, o->plot, file, err) : complain_memory(err);
    }
    plot_free(&plot);
    free(points);
    return status;
}
