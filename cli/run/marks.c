/* Events as marks on the curves of a figure.
 *
 * Invariant: events are marked if they are few enough to be seen apart. Those of the table have their names; of a run
 * without a table the jumps are marked.
 */
#include "cli/run/figure.h"
#include "cli/words/complain.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MARKS = 200, LINES = 32 };

/* Returns memory for numbers, which lives as long as the figure. */
static double *room_for(figure *f, size_t numbers)
{
    double **rooms = realloc(f->rooms, (f->room_count + 1) * sizeof *rooms);
    if (!rooms) return NULL;
    f->rooms = rooms;
    rooms[f->room_count] = malloc((numbers + 1) * sizeof **rooms);
    return rooms[f->room_count] ? rooms[f->room_count++] : NULL;
}

/* Returns the column that an array of the figure records. */
static size_t column_in(const record *r, const double *array)
{
    size_t k = 0;
    while (k < r->count && r->values[k] != array) k++;
    return k < r->count ? r->columns[k] : 0;
}

/* Adds the events of one name to a panel, as marks on each of its lines. `columns` has three for each line. */
static motus_status mark_kind(figure *f, plot_panel *p, motus_run *run, size_t kind, const char *name,
                              const size_t *columns, size_t lines, motus_error *err)
{
    const int64_t rows = motus_run_events(run);
    double *points = room_for(f, 3 * (size_t)rows * lines);
    size_t count = 0;
    motus_status status = points ? MOTUS_OK : complain_memory(err);
    for (int64_t k = 0; !status && k < rows; k++) {
        motus_event_row row = motus_default_event_row();
        status = motus_run_event(run, k, &row);
        if (status || strcmp(row.name, name) != 0) continue;
        for (size_t i = 0; !status && i < lines; i++)
            status = motus_run_event_values(run, k, 0, columns + 3 * i, 3, points + 3 * count++, err);
    }
    if (status) return status;
    const bool solid = p->curves[0].z;
    plot_curve *c = plot_curve_add(p, name, points, points + 1, count, 3);
    if (!c) return complain_memory(err);
    c->role = PLOT_MARKS;
    c->kind = kind;
    if (solid) c->z = points + 2;
    return MOTUS_OK;
}

/* Marks the events of the table, if they are few, on the curves of the state. */
static motus_status mark_events(figure *f, plot_panel *p, motus_run *run, motus_error *err)
{
    enum { KINDS = 12 };
    size_t columns[3 * LINES], lines = 0, kinds = 0;
    const char *names[KINDS];
    const int64_t rows = motus_run_events(run);
    for (size_t k = 0; k < p->curve_count && lines < LINES; k++) {
        const plot_curve *c = &p->curves[k];
        const double *const axes[] = {c->x, c->y, c->z ? c->z : c->y};
        if (c->role != PLOT_LINE) continue;
        for (size_t a = 0; a < 3; a++) columns[3 * lines + a] = column_in(&f->fine, axes[a]);
        lines++;
    }
    if (rows * (int64_t)lines > 2 * MARKS) return MOTUS_OK;
    for (int64_t k = 0; k < rows; k++) {
        motus_event_row row = motus_default_event_row();
        size_t i = 0;
        if (motus_run_event(run, k, &row) != MOTUS_OK) continue;
        while (i < kinds && strcmp(names[i], row.name) != 0) i++;
        if (i == kinds && kinds < KINDS) names[kinds++] = row.name;
    }
    motus_status status = MOTUS_OK;
    for (size_t i = 0; !status && i < kinds; i++) status = mark_kind(f, p, run, i, names[i], columns, lines, err);
    return status;
}

/* Marks the jumps on the curves of a run whose events have no rows. */
static motus_status mark_jumps(figure *f, plot_panel *p, motus_error *err)
{
    const size_t lines = p->curve_count;
    size_t jumps = 0;
    for (size_t i = 1; i < f->fine.rows; i++) jumps += isnan(f->t[i]);
    if (jumps == 0 || jumps > MARKS) return MOTUS_OK;
    double *points = room_for(f, 3 * jumps * lines);
    size_t count = 0;
    if (!points) return complain_memory(err);
    for (size_t k = 0; k < lines; k++) {
        const plot_curve *c = &p->curves[k];
        for (size_t i = 1; c->role == PLOT_LINE && i < c->count; i++)
            if (isnan(f->t[i])) { /* the row before has the side of the arrival */
                double *at = points + 3 * count++;
                at[0] = c->x[i - 1];
                at[1] = c->y[i - 1];
                at[2] = c->z ? c->z[i - 1] : 0;
            }
    }
    const bool solid = p->curves[0].z;
    plot_curve *c = plot_curve_add(p, "events", points, points + 1, count, 3);
    if (!c) return complain_memory(err);
    c->role = PLOT_MARKS;
    if (solid) c->z = points + 2;
    return MOTUS_OK;
}

motus_status marks_add(figure *f, motus_run *run, motus_error *err)
{
    const int64_t events = motus_run_events(run);
    motus_system *system = f->model->system;
    motus_switch one = motus_default_switch();
    /* a switch of the force ends a step too, and is no event */
    const bool acts = motus_explain_events(system)[0] && motus_switch_at(system, 0, &one) != MOTUS_OK;
    motus_status status = MOTUS_OK;
    for (size_t i = 0; !status && events <= MARKS && i < f->plot.count; i++) {
        plot_panel *p = &f->plot.panels[i];
        if (p->low || p->curve_count == 0) continue;
        if (events > 0)
            status = mark_events(f, p, run, err);
        else if (acts)
            status = mark_jumps(f, p, err);
    }
    return status;
}
