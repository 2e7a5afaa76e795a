/* What computes the trajectories of an ensemble: lanes, blocks of a callback, or workers. See ensemble.h.
 *
 * While a compiler is at work, workers begin in the interpreter. When its object is there, they leave the trajectories
 * that they have not finished; lanes or compiled workers compute all from the first of these on.
 *
 * Invariant: the bits do not depend on when that happens: a trajectory has equal bits on all machines, and none changes
 * its machine on the way.
 */
#include "api/request/choice.h"
#include "api/ensemble/ensemble.h"

#include <stdio.h>
#include <string.h>

const char *ensemble_machine(const motus_ensemble *e)
{
    return e->lanes && e->awaits != AWAITS_LANES ? "compiled" : e->machine.name;
}

/* Chooses workers with the interpreter. */
static void choose_portable(motus_ensemble *e)
{
    e->machine = e->system->machine;
    if (e->system->allocator.allocate) e->threads = 1; /* only one thread at a time may call the hooks */
}

void ensemble_machine_refused(motus_ensemble *e)
{
    ensemble_lanes_end(e);
    e->compiled_from = -1;
    choose_portable(e);
    snprintf(e->note, sizeof e->note, "whether the method admits a trajectory is examined one trajectory at a time");
}

/* Chooses workers or blocks, compiled where that is wanted and possible. */
static motus_status choose_single(motus_ensemble *e, const char *wanted, bool later, motus_error *err)
{
    motus_system *s = e->system;
    choose_portable(e);
    if (!s->model && s->callback.block && !e->rules)
        e->block = e->until == SIZE_MAX ? ensemble_block_size(s, &e->chosen) : 0;
    if (!s->model || !wanted || !strcmp(wanted, "interpreter")) return MOTUS_OK;
    const char *why = "";
    compiled_state state = COMPILED_FAILED;
    e->chosen.varies = e->vary_count > 0;
    motus_status status =
        later ? choice_begin(s, &e->chosen, &state, &e->machine, &why, err)
              : choice_compile(s, &e->chosen, !strcmp(wanted, "compiled"), false, &e->machine, &why, err);
    if (status != MOTUS_OK) return status;
    if (later && state == COMPILED_WAIT) e->awaits = AWAITS_MACHINE;
    if (later ? state == COMPILED_FAILED : why != NULL) snprintf(e->note, sizeof e->note, "%s", why);
    return MOTUS_OK;
}

/* Chooses lanes where they can compute the ensemble, else workers; and no compiler for few steps. */
static motus_status choose(motus_ensemble *e, const motus_ensemble_def *d, motus_error *err)
{
    motus_system *s = e->system;
    bool automatic, compiled;
    motus_status status = choice_machine(d->machine, &automatic, &compiled, err);
    if (status != MOTUS_OK) return status;
    const bool few = s->model && d->expected && automatic && !ensemble_steps_differ(e) &&
                     choice_worth(s, &e->chosen, e->card, (double)d->expected * (double)e->timing.total) < 1;
    compiled = compiled && s->model && !few;
    const bool later = automatic && !d->fast; /* with `fast` the bits depend on the machine */
    if (e->rules && !compiled) snprintf(e->note, sizeof e->note, "events are followed one trajectory at a time");
    if (compiled) status = ensemble_lanes_make(e, d, later, err);
    if (status != MOTUS_OK) return status;
    e->lane_threads = e->threads;
    if (!e->lanes) return choose_single(e, few ? "interpreter" : d->machine, later && compiled, err);
    if (!lanes_awaited(e->lanes) && !lanes_awaited(e->half_lanes)) return MOTUS_OK;
    choose_portable(e);
    e->awaits = AWAITS_LANES;
    return MOTUS_OK;
}

/* Notes that all trajectories from this one on are computed by what is compiled now, if anything is. */
static void note_compiled(motus_ensemble *e, size_t trajectory)
{
    e->compiled_from = !e->awaits && !strcmp(ensemble_machine(e), "compiled") ? (int64_t)trajectory : -1;
}

motus_status ensemble_machine_choose(motus_ensemble *e, const motus_ensemble_def *d, motus_error *err)
{
    const motus_status status = choose(e, d, err);
    if (status == MOTUS_OK) note_compiled(e, 0);
    return status;
}

motus_status ensemble_machine_witnessed(motus_ensemble *e, motus_error *err)
{
    ensemble_lanes_end(e);
    e->awaits = AWAITS_NOTHING;
    ensemble_workers_destroy(e);
    e->note[0] = 0;
    const motus_status status = choose_single(e, NULL, true, err);
    note_compiled(e, e->computed);
    if (!e->note[0])
        snprintf(e->note, sizeof e->note,
                 "the force does within steps what they do not show: one trajectory at a time");
    return status;
}

/* ---- what is awaited ---- */

/* Takes the lanes that were awaited; if there are none after all, a machine for workers. */
static motus_status take_lanes(motus_ensemble *e, motus_error *err)
{
    motus_status status = MOTUS_OK;
    if (lanes_awaited(e->lanes)) status = lanes_ready(e->lanes, e->note, sizeof e->note, err);
    if (status == MOTUS_OK && lanes_awaited(e->half_lanes))
        status = lanes_ready(e->half_lanes, e->note, sizeof e->note, err);
    e->awaits = AWAITS_NOTHING;
    if (status != MOTUS_OK) ensemble_lanes_end(e);
    if (status != MOTUS_OK && status != MOTUS_TOOL) return status;
    ensemble_workers_destroy(e);
    if (status == MOTUS_TOOL) return choose_single(e, NULL, true, err);
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

motus_status ensemble_machine_take(motus_ensemble *e, size_t first, motus_error *err)
{
    motus_status status = MOTUS_OK;
    e->exactly = 0;
    if (e->awaits == AWAITS_LANES)
        status = take_lanes(e, err);
    else
        take_machine(e);
    if (status == MOTUS_OK) note_compiled(e, e->computed + first);
    return status;
}

void ensemble_machine_end(motus_ensemble *e)
{
    if (e->awaits == AWAITS_MACHINE && !e->found.name && !e->missing) choice_leave(e->system, &e->chosen);
    e->awaits = AWAITS_NOTHING;
}

void ensemble_later_at(motus_ensemble *e, size_t count)
{
    e->exactly = 1 + count;
    e->compiled_from = -1;
    if (e->awaits) return;
    e->awaits = e->lanes ? AWAITS_LANES : AWAITS_MACHINE; /* though it is already there */
    e->found = e->machine;
    e->machine = e->system->machine;
}
