/* What the trajectories of an ensemble came to, besides their numbers. See ensemble.h.
 *
 * Invariant: a trajectory is ended by what ends a run with its values, and its table has that run's rows. The worker
 * that computed it notes both, while its system has the trajectory's parameters; no two workers touch one outcome.
 */
#include "api/why/diagnosis.h"
#include "api/ensemble/ensemble.h"
#include "api/error/event_bars.h"

#include <math.h>

void ensemble_outcome_end(motus_ensemble *e)
{
    for (size_t k = 0; k < e->outcome_count; k++) give(&e->allocator, e->outcomes[k].table);
    give(&e->allocator, e->outcomes);
    e->outcomes = NULL;
    e->outcome_count = 0;
}

motus_status ensemble_outcome_begin(motus_ensemble *e, size_t count, motus_error *err)
{
    ensemble_outcome_end(e);
    e->outcomes = take(&e->allocator, count, sizeof *e->outcomes);
    if (!e->outcomes) return fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    e->outcome_count = count;
    return MOTUS_OK;
}

/* Computes the columns of row i, before or after its event. */
static motus_status values_of(const worker *w, size_t i, bool after, double *out, double *room, motus_error *err)
{
    const motus_ensemble *e = w->e;
    const double *x, *v;
    const event row = events_row(w->events, i, after, &x, &v);
    return system_values_of(w->system, row.t, x, v, room, e->event_columns, e->event_columns_count, out, err);
}

static motus_status fill_table(worker *w, ensemble_table *t, bool errors, double *room, motus_error *err)
{
    const size_t columns = w->e->event_columns_count;
    motus_status status = MOTUS_OK;
    t->values = (double *)(void *)(t->row + t->count);
    for (size_t i = 0; i < t->count && status == MOTUS_OK; i++) {
        double *out = t->values + i * 2 * columns;
        t->row[i].event = events_row(w->events, i, false, NULL, NULL);
        t->row[i].error = errors ? event_bars_time(w->run, i) : NAN;
        status = values_of(w, i, false, out, room, err);
        if (status == MOTUS_OK) status = values_of(w, i, true, out + columns, room, err);
    }
    return status;
}

static motus_status take_table(worker *w, ensemble_outcome *o, bool errors, motus_error *err)
{
    const motus_ensemble *e = w->e;
    const problem *p = &w->system->problem;
    const size_t rows = events_rows(w->events),
                 each = sizeof *o->table->row + 2 * e->event_columns_count * sizeof(double);
    if (errors && w->run->bars) bars_land(w->run, NULL); /* the companion comes as far as the trajectory */
    if (!rows) return MOTUS_OK;
    o->table = take(&e->allocator, 1, sizeof *o->table + rows * each);
    double *room = take(&e->allocator, p->nx + p->nv + 1, sizeof *room);
    motus_status status = o->table && room ? MOTUS_OK : fail(err, MOTUS_MEMORY, "no memory for the tables of events");
    if (status == MOTUS_OK) {
        o->table->count = rows;
        status = fill_table(w, o->table, errors, room, err);
    }
    give(&e->allocator, room);
    return status;
}

motus_status ensemble_outcome_take(worker *w, size_t k, bool stopped, bool began, bool errors, motus_error *err)
{
    const motus_ensemble *e = w->e;
    ensemble_outcome *o = &e->outcomes[k];
    size_t rule;
    give(&e->allocator, o->table);
    *o = (ensemble_outcome){0};
    if (stopped && began && e->tells_causes) {
        diagnosis_add(&w->diagnosed, w->stepper, &w->why);
        o->cause = (unsigned char)w->why.cause;
    }
    /* w->events would be those of another trajectory. */
    if (!began || !w->events) return MOTUS_OK;
    if (!stopped && events_ended(w->events, &rule) != EVENTS_END_NONE) o->ended = (uint32_t)rule + 1;
    return e->event_columns ? take_table(w, o, errors, err) : MOTUS_OK;
}

void ensemble_outcome_move(motus_ensemble *to, size_t k, motus_ensemble *from, size_t i)
{
    give(&to->allocator, to->outcomes[k].table);
    to->outcomes[k] = from->outcomes[i];
    from->outcomes[i].table = NULL;
}
