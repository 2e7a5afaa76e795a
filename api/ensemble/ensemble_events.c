/* The tables of events of an ensemble's trajectories. See ensemble.h.
 *
 * Invariant: a table has the rows of a run with the values of its trajectory. It is made by the worker that computed
 * the trajectory, while its system has the trajectory's parameters; no two workers touch the same table.
 */
#include "api/ensemble/ensemble.h"
#include "api/error/event_bars.h"
#include "api/motion/run_events.h"

#include <math.h>
#include <string.h>

typedef struct told_event {
    event event;
    double error; /* of its time */
} told_event;

struct ensemble_table {
    told_event *row;
    double *values; /* of every row: the columns on arrival, and as the action left them */
    size_t count;
};

motus_status ensemble_events_prepare(motus_ensemble *e, const motus_ensemble_def *d, motus_error *err)
{
    if (!d->events) return MOTUS_OK;
    for (size_t k = 0; k < d->event_column_count; k++)
        if (d->event_columns[k] >= e->system->column_count)
            return fail(err, MOTUS_ARGUMENT, "event_columns has column %zu of %zu", d->event_columns[k],
                        e->system->column_count);
    e->event_columns = take(&e->allocator, d->event_column_count + 1, sizeof *e->event_columns);
    if (!e->event_columns) return fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    if (d->event_column_count)
        memcpy(e->event_columns, d->event_columns, d->event_column_count * sizeof *e->event_columns);
    e->event_columns_count = d->event_column_count;
    return MOTUS_OK;
}

static void empty(const motus_ensemble *e, ensemble_table *t)
{
    give(&e->allocator, t->row);
    give(&e->allocator, t->values);
    *t = (ensemble_table){0};
}

static void forget(motus_ensemble *e)
{
    for (size_t k = 0; k < e->tables_count; k++) empty(e, &e->tables[k]);
    give(&e->allocator, e->tables);
    e->tables = NULL;
    e->tables_count = 0;
}

motus_status ensemble_events_begin(motus_ensemble *e, size_t count, motus_error *err)
{
    if (!e->event_columns) return MOTUS_OK;
    forget(e);
    e->tables = take(&e->allocator, count, sizeof *e->tables);
    if (!e->tables) return fail(err, MOTUS_MEMORY, "no memory for the tables of events");
    e->tables_count = count;
    return MOTUS_OK;
}

/* The columns of row i, on arrival or after it. */
static motus_status values_of(const worker *w, size_t i, bool after, double *out, double *room, motus_error *err)
{
    const motus_ensemble *e = w->e;
    const double *x, *v;
    const event row = events_row(w->events, i, after, &x, &v);
    return system_values_of(w->system, row.t, x, v, room, e->event_columns, e->event_columns_count, out, err);
}

motus_status ensemble_events_take(worker *w, size_t k, bool errors, motus_error *err)
{
    const motus_ensemble *e = w->e;
    if (!e->tables || !w->events) return MOTUS_OK;
    ensemble_table *t = &e->tables[k];
    const problem *p = &w->system->problem;
    const size_t rows = events_rows(w->events), each = 2 * e->event_columns_count;
    empty(e, t);
    t->row = take(&e->allocator, rows + 1, sizeof *t->row);
    t->values = take(&e->allocator, rows * each + 1, sizeof *t->values);
    double *room = take(&e->allocator, p->nx + p->nv + 1, sizeof *room);
    motus_status status =
        t->row && t->values && room ? MOTUS_OK : fail(err, MOTUS_MEMORY, "no memory for the tables of events");
    if (errors && w->run->bars) bars_land(w->run, NULL); /* its companion comes as far as the trajectory */
    for (size_t i = 0; i < rows && status == MOTUS_OK; i++) {
        double *out = t->values + i * each;
        t->row[i].event = events_row(w->events, i, false, NULL, NULL);
        t->row[i].error = errors ? event_bars_time(w->run, i) : NAN;
        status = values_of(w, i, false, out, room, err);
        if (status == MOTUS_OK) status = values_of(w, i, true, out + each / 2, room, err);
        t->count = i + 1;
    }
    give(&e->allocator, room);
    return status;
}

void ensemble_events_move(motus_ensemble *to, size_t k, motus_ensemble *from, size_t i)
{
    if (!to->tables || !from->tables) return;
    empty(to, &to->tables[k]);
    to->tables[k] = from->tables[i];
    from->tables[i] = (ensemble_table){0};
}

void ensemble_events_end(motus_ensemble *e)
{
    forget(e);
    give(&e->allocator, e->event_columns);
}

int64_t motus_ensemble_events(const motus_ensemble *e, size_t trajectory)
{
    return e && trajectory < e->tables_count ? (int64_t)e->tables[trajectory].count : 0;
}

motus_status motus_ensemble_event(const motus_ensemble *e, size_t trajectory, int64_t k, motus_event_row *out,
                                  double *values, double *after)
{
    if (!out || k < 0 || k >= motus_ensemble_events(e, trajectory) ||
        motus_struct_check(MOTUS_DEF_EVENT_ROW, out, NULL) != MOTUS_OK)
        return MOTUS_ARGUMENT;
    const ensemble_table *t = &e->tables[trajectory];
    const told_event *row = &t->row[k];
    const size_t count = e->event_columns_count;
    const double *from = t->values + (size_t)k * 2 * count;
    run_events_row(e->rules, &row->event, row->error, out);
    if (values && count) memcpy(values, from, count * sizeof *values);
    if (after && count) memcpy(after, from + count, count * sizeof *after);
    return MOTUS_OK;
}
