/* An ensemble that begins in the interpreter while a compiler works. See ensemble.h.
 *
 * Workers compute trajectories one by one. When the object is there they leave those that they have not finished, and
 * all from the first of these on are computed by lanes, or by compiled workers.
 *
 * Invariant: the bits do not depend on when that happens, because a trajectory has the same on every machine, and none
 * changes its machine on the way.
 */
#include "api/request/choice.h"
#include "api/ensemble/ensemble.h"

#include <stdio.h>
#include <string.h>

bool ensemble_look(motus_ensemble *e)
{
    if (e->awaits == AWAITS_LANES) {
        const bool there = lanes_look(e->lanes);
        return (!e->half_lanes || lanes_look(e->half_lanes)) && there;
    }
    if (e->awaits == AWAITS_NOTHING || e->found.name || e->missing) return true;
    compiled_state state;
    motus_error ignored = motus_default_error();
    const char *why = NULL;
    const motus_status status = choice_look(e->system, &e->chosen, &state, &e->found, &why, &ignored);
    if (status == MOTUS_OK && state == COMPILED_WAIT) return false;
    if (status != MOTUS_OK || state == COMPILED_FAILED) {
        e->missing = why ? why : "there is no memory for the compiled model";
        e->found.name = NULL;
    }
    return true;
}

/* The lanes that were awaited; where there are none after all, a machine for workers. */
static motus_status take_lanes(motus_ensemble *e, motus_error *err)
{
    motus_status status = MOTUS_OK;
    if (lanes_awaited(e->lanes)) status = lanes_ready(e->lanes, e->note, sizeof e->note, err);
    if (status == MOTUS_OK && lanes_awaited(e->half_lanes))
        status = lanes_ready(e->half_lanes, e->note, sizeof e->note, err);
    e->awaits = AWAITS_NOTHING;
    if (status != MOTUS_OK) ensemble_end_lanes(e);
    if (status != MOTUS_OK && status != MOTUS_TOOL) return status;
    ensemble_workers_destroy(e);
    if (status == MOTUS_TOOL) return ensemble_choose_single(e, NULL, true, err);
    e->threads = e->lane_threads;
    return MOTUS_OK;
}

static void take_machine(motus_ensemble *e)
{
    e->awaits = AWAITS_NOTHING;
    if (e->found.name) {
        ensemble_workers_destroy(e); /* they are made anew, on the other machine */
        e->machine = e->found;
    } else {
        snprintf(e->note, sizeof e->note, "%s", e->missing);
    }
}

/* What was awaited is there, or will never be. */
static motus_status go_over(motus_ensemble *e, size_t first, motus_error *err)
{
    motus_status status = MOTUS_OK;
    e->exactly = 0;
    if (e->awaits == AWAITS_LANES)
        status = take_lanes(e, err);
    else
        take_machine(e);
    if (status == MOTUS_OK && !e->awaits && !strcmp(motus_ensemble_machine(e), "compiled"))
        e->compiled_from = (int64_t)(e->computed + first);
    return status;
}

motus_status ensemble_meanwhile(motus_ensemble *e, const places *p, size_t *first, motus_error *err)
{
    motus_status status = MOTUS_OK;
    while (status == MOTUS_OK && e->awaits && *first < e->count) {
        if (e->exactly ? *first + 1 < e->exactly : !ensemble_look(e)) {
            status = ensemble_singly(e, p, *first, err);
            const size_t left = atomic_load(&e->left);
            *first = left < e->count ? left : e->count;
        }
        while (e->exactly && *first < e->count && !ensemble_look(e)) compiled_nap();
        if (status == MOTUS_OK && *first < e->count && ensemble_look(e)) status = go_over(e, *first, err);
    }
    return status;
}

void ensemble_later_end(motus_ensemble *e)
{
    if (e->awaits == AWAITS_MACHINE && !e->found.name && !e->missing) choice_leave(e->system, &e->chosen);
    e->awaits = AWAITS_NOTHING;
}

void ensemble_later_at(motus_ensemble *e, size_t count)
{
    e->exactly = 1 + count;
    e->compiled_from = -1;
    if (e->awaits) return;
    e->awaits = e->lanes ? AWAITS_LANES : AWAITS_MACHINE; /* it is there already */
    e->found = e->machine;
    e->machine = e->system->machine;
}
