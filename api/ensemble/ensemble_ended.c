/* Which events ended the trajectories of an ensemble. See ensemble.h.
 *
 * Invariant: a trajectory is ended by what ends a run with its values; one that stopped is ended by nothing.
 */
#include "api/ensemble/ensemble.h"

motus_status ensemble_ended_begin(motus_ensemble *e, size_t count, motus_error *err)
{
    ensemble_ended_end(e);
    if (!e->rules) return MOTUS_OK;
    e->ended = take(&e->allocator, count, sizeof *e->ended);
    e->ended_count = e->ended ? count : 0;
    return e->ended ? MOTUS_OK : fail(err, MOTUS_MEMORY, "no memory for the ensemble");
}

void ensemble_ended_end(motus_ensemble *e)
{
    give(&e->allocator, e->ended);
    e->ended = NULL;
    e->ended_count = 0;
}

void ensemble_ended_take(worker *w, size_t k, bool stopped)
{
    size_t rule = 0;
    if (!w->e->ended) return;
    const bool none = stopped || !w->events || events_ended(w->events, &rule) == EVENTS_END_NONE;
    w->e->ended[k] = none ? 0 : rule + 1;
}

void ensemble_ended_move(motus_ensemble *to, size_t k, const motus_ensemble *from, size_t i)
{
    if (to->ended && from->ended) to->ended[k] = from->ended[i];
}

const char *motus_ensemble_ended(const motus_ensemble *e, size_t trajectory)
{
    const size_t rule = e && trajectory < e->ended_count ? e->ended[trajectory] : 0;
    return rule ? e->rules->rule[rule - 1].name : "";
}

const char *motus_ensemble_kind(const motus_ensemble *e, size_t k)
{
    /* a switch of the force is no event */
    for (size_t i = 0; e && e->rules && i < e->rules->count; i++)
        if (!e->rules->rule[i].internal && k-- == 0) return e->rules->rule[i].name;
    return NULL;
}
