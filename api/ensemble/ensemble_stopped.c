/* Trajectories that stop before their end: why, and those that lanes or blocks leave to a worker. See ensemble.h.
 *
 * Invariant: a trajectory that stops is followed by a stepper that is judged as that of a run with its values. So it
 * ends at the same step with the same cause, however the others were computed.
 */
#include "api/why/diagnosis.h"
#include "api/ensemble/ensemble.h"

motus_status ensemble_stopped_begin(motus_ensemble *e, size_t count, places *p, motus_error *err)
{
    give(&e->allocator, e->causes);
    give(&e->allocator, e->ends);
    e->causes = e->tells_causes ? take(&e->allocator, count + 1, sizeof *e->causes) : NULL;
    e->causes_count = e->causes ? count : 0;
    p->ends = e->ends = take(&e->allocator, count + 1, sizeof *e->ends);
    if (!e->ends || (e->tells_causes && !e->causes)) return fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    return MOTUS_OK;
}

void ensemble_stopped_finish(motus_ensemble *e)
{
    give(&e->allocator, e->ends);
    e->ends = NULL;
}

void ensemble_stopped_end(motus_ensemble *e)
{
    ensemble_stopped_finish(e);
    give(&e->allocator, e->causes);
}

void ensemble_stopped_judged(worker *w) { stepper_judged(w->stepper, diagnosis_crawls, &w->diagnosed); }

void ensemble_stopped_take(worker *w, size_t k, bool began)
{
    const motus_ensemble *e = w->e;
    if (!e->causes) return;
    if (began) diagnosis_add(&w->diagnosed, w->stepper, &w->why);
    e->causes[k] = began ? (unsigned char)w->why.cause : MOTUS_CAUSE_NONE;
}

void ensemble_stopped_move(motus_ensemble *to, size_t k, const motus_ensemble *from, size_t i)
{
    if (to->causes && from->causes) to->causes[k] = from->causes[i];
}

/* ---- once more, by workers ---- */

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

static bool is_left(const motus_ensemble *e, const places *p, size_t k)
{
    return p->ends[k] == LANES_MAY_CRAWL || (e->causes && p->ends[k] == LANES_STOPPED);
}

motus_status ensemble_stopped_again(motus_ensemble *e, const places *p, size_t first, motus_error *err)
{
    size_t count = 0;
    for (size_t k = first; k < e->count; k++) count += is_left(e, p, k);
    if (!count) return MOTUS_OK;
    size_t *number = take(&e->allocator, count, sizeof *number), n = 0;
    if (!number) return fail(err, MOTUS_MEMORY, "no memory for the ensemble");
    for (size_t k = first; k < e->count; k++)
        if (is_left(e, p, k)) number[n++] = k;
    left_list list = {p, number, e->count - count};
    if (!e->machine.problem) e->machine = e->system->machine;
    const motus_status status = ensemble_each_singly(e, list.first, count, one_left, &list, err);
    give(&e->allocator, number);
    return status;
}

motus_cause motus_ensemble_stopped_by(const motus_ensemble *e, size_t trajectory)
{
    return e && trajectory < e->causes_count ? (motus_cause)e->causes[trajectory] : MOTUS_CAUSE_NONE;
}
