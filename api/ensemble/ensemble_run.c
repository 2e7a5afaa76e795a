/* One call of an ensemble: all its trajectories, with the tolerance of the ensemble. See ensemble.h.
 *
 * Invariant: a trajectory that stops is computed by a stepper that is judged as a run's. So it ends at the step and
 * with the cause of a run with its values, however other trajectories were computed.
 */
#include "api/ensemble/ensemble.h"

/* ---- the values ---- */

motus_status ensemble_run_values(motus_ensemble *e, const double *const *values, places *p, motus_error *err)
{
    if (!e || (e->given && !values)) return fail(err, MOTUS_ARGUMENT, "an ensemble and values are needed");
    size_t places = 0;
    for (size_t k = 0; k < e->given; k++) {
        if (!values[k]) return fail(err, MOTUS_ARGUMENT, "the values of what varies, number %zu, are NULL", k);
        *(k == e->until ? &p->until : &e->values[places++]) = values[k];
    }
    p->values = e->values;
    return MOTUS_OK;
}

motus_status ensemble_run_ends(const motus_ensemble *e, const places *p, size_t count, motus_error *err)
{
    for (size_t k = 0; p->until && k < count; k++) {
        timing t;
        motus_error why = motus_default_error();
        const motus_status status = ensemble_timing(e, p, k, &t, &why);
        if (status == MOTUS_OK) continue;
        fail(err, status, "until, value %zu of %zu: %s", k + 1, count, why.message);
        if (why.hint[0]) hint(err, "%s", why.hint);
        return status;
    }
    return MOTUS_OK;
}

/* ---- by workers ---- */

static motus_status singly(motus_ensemble *e, const places *p, size_t first, motus_error *err)
{
    return ensemble_each(e, first, e->count - first, ensemble_one, (void *)p, err);
}

/* Computes trajectories by workers while what is faster is awaited; *first: the first one left to that. */
static motus_status meanwhile(motus_ensemble *e, const places *p, size_t *first, motus_error *err)
{
    motus_status status = MOTUS_OK;
    while (status == MOTUS_OK && e->awaits && *first < e->count) {
        if (e->exactly ? *first + 1 < e->exactly : !ensemble_look(e)) {
            status = singly(e, p, *first, err);
            const size_t left = atomic_load(&e->left);
            *first = left < e->count ? left : e->count;
        }
        while (e->exactly && *first < e->count && !ensemble_look(e)) compiled_nap();
        if (status == MOTUS_OK && *first < e->count && ensemble_look(e)) status = ensemble_machine_take(e, *first, err);
    }
    return status;
}

typedef struct left_list {
    const places *places;
    const size_t *number;
    size_t first;
} left_list;

static motus_status one_left(worker *w, size_t item, void *ctx)
{
    const left_list *list = ctx;
    return ensemble_one(w, list->number[item - list->first], (void *)list->places);
}

static bool is_left(const motus_ensemble *e, size_t k)
{
    return e->outcomes[k].left == LANES_MAY_CRAWL || (e->tells_causes && e->outcomes[k].left == LANES_STOPPED);
}

/* Computes trajectories by workers that lanes or blocks have left without a final or explained end. */
static motus_status again(motus_ensemble *e, const places *p, size_t first, motus_error *err)
{
    size_t count = 0;
    for (size_t k = first; k < e->count; k++) count += is_left(e, k);
    if (!count) return MOTUS_OK;
    size_t *number = take(&e->allocator, count, sizeof *number), n = 0;
    if (!number) return fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    for (size_t k = first; k < e->count; k++)
        if (is_left(e, k)) number[n++] = k;
    left_list list = {p, number, e->count - count};
    if (!e->machine.problem) e->machine = e->system->machine;
    const motus_status status = ensemble_each(e, list.first, count, one_left, &list, err);
    give(&e->allocator, number);
    return status;
}

/* ---- a call ---- */

static motus_status compute(motus_ensemble *e, const places *p, motus_error *err)
{
    size_t first = 0;
    motus_status status = ensemble_witness_first(e, p, err);
    if (status == MOTUS_OK && p->errors && e->looks && e->lanes) status = ensemble_machine_witnessed(e, err);
    if (status != MOTUS_OK) return status;
    status = e->awaits ? meanwhile(e, p, &first, err) : MOTUS_OK;
    if (status != MOTUS_OK || first == e->count) return status;
    if (e->lanes && !e->awaits) {
        status = ensemble_lanes_run(e, p, first, err);
        if (status == MOTUS_OK) return again(e, p, first, err);
        if (status != MOTUS_METHOD) return status;
        ensemble_machine_refused(e);
    }
    if (!e->block || p->errors) return singly(e, p, first, err);
    status = ensemble_blocks(e, p, err);
    return status == MOTUS_OK ? again(e, p, 0, err) : status;
}

motus_status ensemble_run_all(motus_ensemble *e, size_t count, const double *const *values, places p, motus_error *err)
{
    motus_status status = ensemble_run_values(e, values, &p, err);
    if (status == MOTUS_OK && !p.results) return fail(err, MOTUS_ARGUMENT, "motus_ensemble_run needs room for results");
    for (size_t r = 0; status == MOTUS_OK && r < e->record_count; r++)
        if (!p.results[r] || (p.errors && !p.errors[r]))
            status = fail(err, MOTUS_ARGUMENT, "the room for record %zu is NULL", r);
    if (status != MOTUS_OK || !count) return status;
    modes m = modes_enter();
    double began = pace_now();
    for (size_t r = 0; r < e->record_count; r++)
        p.observes |= e->records[r].how != MOTUS_REDUCE_FINAL && !ensemble_tallies(&e->records[r]);
    e->count = count;
    status = ensemble_run_ends(e, &p, count, err);
    e->fraction = 0;
    if (status == MOTUS_OK) status = ensemble_outcome_begin(e, count, err);
    if (status == MOTUS_OK) status = compute(e, &p, err);
    e->computed += count;
    e->seconds += pace_now() - began;
    modes_leave(m);
    return status;
}
