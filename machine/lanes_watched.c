/* Lanes of trajectories with events: they take the steps in which bounds exclude every event. See lanes_parts.h.
 *
 * There is one block. A trajectory comes to a lane with the state at which its next step begins. After every step that
 * it tries, accepted or refused, the object computes the box of each lane's step and a lower bound on the size of every
 * function there, as step/watch.h does for one trajectory. If a bound is not positive, the follower is asked whether
 * the step has no event all the same. If it cannot tell, the lane takes the step back; the follower takes it again with
 * its events, and gives the trajectory back at the next step for which bounds may prove that nothing happens.
 *
 * Invariant: all that decides the next step moves with a trajectory, so its bits depend neither on its lane nor on its
 * neighbours, nor on which of its steps lanes take.
 */
#include "machine/lanes_parts.h"

#include "core/stepper.h"

#include <string.h>

typedef struct watched {
    lanes_item *item;
    const lanes *l;
    const lanes_follower *by;
    lanes_block block;
    size_t number[BLOCK_MAX]; /* the array to which block.number points */
    int64_t since[BLOCK_MAX]; /* for each lane: the steps of the leg when its trajectory came */
    int64_t stop[BLOCK_MAX];  /* for each lane: with fixed steps, the steps of the leg after which it goes */
    double *room;             /* working space of lanes_watched_size numbers */
    size_t next;              /* trajectories of the item that have begun */
    bool begun;               /* some have begun since lanes last got the numbers of their trajectories */
} watched;

/* Counts the room for the numbers of a state and the largest sizes, or for both ends of a step and bounds on its
 * accelerations. */
size_t lanes_watched_size(const lanes *l)
{
    const size_t state = l->carried + STEPPER_CLOCKS + l->def.model->nx + l->def.model->nv, step = 5 * l->def.model->nv;
    return ((state > step ? state : step) + 7) / 8 * 8;
}

static double *clock_of(const watched *s, size_t lane, int k) { return lanes_clock(&s->block, lane, k); }

static double until_of(const watched *s, size_t lane)
{
    const lanes_item *item = s->item;
    return item->call->until ? item->call->until[s->number[lane]] : s->l->def.until;
}

/* The clocks of a lane in the order of stepper_save. */
static const int carried[STEPPER_CLOCKS] = {LANES_T,    LANES_LOST,     LANES_NEXT,    LANES_BEFORE,
                                            LANES_RISE, LANES_SHORTEST, LANES_LONGEST, LANES_SPAN};

/* Returns how many clocks lead from a step to the next; with fixed steps none. */
static size_t carried_clocks(const lanes *l) { return l->plan.carried ? STEPPER_CLOCKS : 0; }

/* Tells whether the call is over, which a follower asks that takes many steps without lanes. */
static bool all_over(void *asked)
{
    lanes_item *item = asked;
    if (item->reports) lanes_item_report(item, 0);
    return lanes_item_over(item);
}

/* Returns number k of the clock of a lane, now or before its latest step. */
static double clock_at(const watched *s, size_t lane, bool before, int k)
{
    const lanes_job *j = &s->block.job;
    return (before ? j->before_clocks : j->clocks)[lane_at(s->l, LANES_CLOCKS, (size_t)k, lane)];
}

/* Writes the state of a lane, now or before its latest step. */
static lanes_state state_of(const watched *s, size_t lane, bool before)
{
    const lanes *l = s->l;
    const lanes_job *j = &s->block.job;
    lanes_row(l, s->room, before ? j->before : j->carry, l->carried, 0, l->carried, lane);
    for (size_t k = 0; k < carried_clocks(l); k++) s->room[l->carried + k] = clock_at(s, lane, before, carried[k]);
    return (lanes_state){.t0 = *clock_of(s, lane, LANES_T0),
                         .h = *clock_of(s, lane, LANES_H),
                         .at = {.steps = (int64_t)clock_at(s, lane, before, LANES_N),
                                .refused = (int64_t)clock_at(s, lane, before, LANES_REFUSED)},
                         .carry = s->room,
                         .over = all_over,
                         .asked = s->item};
}

static void put(watched *s, size_t lane, const lanes_state *from)
{
    const lanes *l = s->l;
    const lanes_job *j = &s->block.job;
    const size_t sizes = l->def.model->nx + l->def.model->nv;
    for (size_t k = 0; k < l->carried; k++) j->carry[lane_at(l, l->carried, k, lane)] = from->carry[k];
    for (size_t k = 0; k < carried_clocks(l); k++) *clock_of(s, lane, carried[k]) = from->carry[l->carried + k];
    for (size_t k = 0; k < sizes; k++) j->largest[lane_at(l, sizes, k, lane)] = 0;
    *clock_of(s, lane, LANES_T0) = from->t0;
    *clock_of(s, lane, LANES_H) = from->h;
    *clock_of(s, lane, LANES_N) = (double)from->at.steps;
    *clock_of(s, lane, LANES_REFUSED) = (double)from->at.refused;
    *clock_of(s, lane, LANES_UNTIL) = until_of(s, lane);
    *clock_of(s, lane, LANES_EVENT) = from->tick;
    s->since[lane] = from->at.steps;
    s->stop[lane] = from->stop;
    lanes_block_forget(&s->block, lane);
}

/* Returns the largest sizes of a lane's numbers since its trajectory came. */
static const double *largest_of(const watched *s, size_t lane)
{
    const lanes *l = s->l;
    const size_t sizes = l->def.model->nx + l->def.model->nv;
    double *to = s->room + l->carried + STEPPER_CLOCKS;
    lanes_row(l, to, s->block.job.largest, sizes, 0, sizes, lane);
    return to;
}

/* Ends the trajectory of a lane. */
static void over(watched *s, size_t lane)
{
    atomic_fetch_add(&s->item->call->done, 1);
    lanes_schedule_free(&s->block, lane);
}

/* Goes on with a trajectory that the follower has given back, or ends one that is over. */
static void go_on(watched *s, size_t lane, bool goes_on, const lanes_state *state)
{
    if (goes_on)
        put(s, lane, state);
    else
        over(s, lane);
}

/* ---- the start ---- */

/* Puts the item's next trajectory into a free lane. */
static bool fill(void *ctx, size_t lane)
{
    watched *s = ctx;
    const lanes_item *item = s->item;
    lanes_state state = {.carry = s->room, .over = all_over, .asked = s->item};
    if (s->next == item->count) return false;
    s->number[lane] = item->first + s->next++;
    go_on(s, lane, s->by->begin(s->by->ctx, item->thread, lane, s->number[lane], &state), &state);
    s->begun |= lanes_occupied(&s->block, lane);
    return true;
}

/* ---- steps ---- */

/* Writes positions and velocities at an end of the latest step of a lane, and returns the time there. *lost: what the
 * rounding of the time has left out. */
static double end_of(const watched *s, size_t lane, bool end, double *x, double *v, double *lost)
{
    const lanes *l = s->l;
    const lanes_job *j = &s->block.job;
    const size_t nx = l->def.model->nx, nv = l->def.model->nv, each = nx + 2 * nv;
    const bool carried = l->plan.carried;
    const double *numbers = !carried ? j->shown : end ? j->carry : j->before;
    const size_t elements = carried ? l->carried : 2 * each, first = carried || !end ? 0 : each;
    lanes_row(l, x, numbers, elements, first, nx, lane);
    lanes_row(l, v, numbers, elements, first + (carried ? nv : nx), nv, lane);
    *lost = carried ? clock_at(s, lane, !end, LANES_LOST) : 0;
    const work leg = {.t0 = clock_at(s, lane, !end, LANES_T0), .h = clock_at(s, lane, !end, LANES_H)};
    return carried ? clock_at(s, lane, !end, LANES_T) : TIME_FIXED(&leg, clock_at(s, lane, !end, LANES_N), 0);
}

/* Tells whether the follower knows that the latest step of a lane has no event, although a bound is not positive. */
static bool idle(const watched *s, size_t lane)
{
    const lanes *l = s->l;
    const size_t nx = l->def.model->nx, nv = l->def.model->nv;
    double *from_x = s->room, *from_v = from_x + nx, *to_x = from_v + nv, *to_v = to_x + nx, *most = to_v + nv;
    watch was = {0};
    was.t = end_of(s, lane, false, from_x, from_v, &was.lost);
    was.to_t = end_of(s, lane, true, to_x, to_v, &was.to_lost);
    lanes_row(l, most, s->block.job.bounds, nv, 0, nv, lane);
    const double span = l->plan.carried ? watch_span(&was) : *clock_of(s, lane, LANES_H);
    return s->by->idle(s->by->ctx, s->item->thread, lane,
                       &(stepper_shown){span, was.t, was.to_t, from_x, from_v, to_x, to_v, most});
}

/* Gives a lane to the follower after its latest step: if the step may have an event, if it led to the end or to the
 * number of steps in LANES_STOP, and if the trajectory cannot go on. */
static void look(void *ctx, size_t lane)
{
    watched *s = ctx;
    const lanes_job *j = &s->block.job;
    if (j->lost[lane] != 0 || !lanes_block_finite(s->l, j->carry, s->l->carried, lane)) {
        s->l->def.left(s->l->def.context, s->number[lane], LANES_MAY_CRAWL);
        over(s, lane);
        return;
    }
    const bool ends = s->l->plan.carried && *clock_of(s, lane, LANES_T) == *clock_of(s, lane, LANES_UNTIL),
               back = j->met[lane] != 0 && !idle(s, lane);
    if (!back && !ends && *clock_of(s, lane, LANES_N) != *clock_of(s, lane, LANES_STOP)) return;
    lanes_state state = state_of(s, lane, back);
    state.end = ends && !back;
    go_on(s, lane,
          s->by->look(s->by->ctx, s->item->thread, lane, state.at.steps - s->since[lane], largest_of(s, lane), &state),
          &state);
}

/* Gives lanes the numbers of their trajectories. */
static void number_lanes(const watched *s)
{
    size_t numbers[BLOCK_MAX];
    for (size_t i = 0; i < (size_t)s->l->block; i++)
        numbers[i] = lanes_occupied(&s->block, i) ? s->number[i] : s->item->first;
    lanes_block_number(&s->block, s->item, numbers);
}

static void run(void *ctx)
{
    watched *s = ctx;
    if (s->begun) number_lanes(s);
    s->begun = false;
    for (size_t i = 0; i < (size_t)s->l->block; i++)
        if (lanes_occupied(&s->block, i))
            *clock_of(s, i, LANES_STOP) = (double)(s->l->plan.carried ? lanes_schedule_pace(&s->block, i) : s->stop[i]);
    s->l->run(&s->block.job, CHUNK, 0);
}

void lanes_watched(lanes_item *item)
{
    lanes *l = item->l;
    watched s = {.item = item, .l = l, .by = l->def.follower, .room = item->table};
    memset(item->memory, 0, item->call->block_size * sizeof(double));
    s.block = lanes_block_of(item, 0), s.block.number = s.number;
    for (size_t i = 0; i < (size_t)l->block; i++) lanes_schedule_free(&s.block, i);
    lanes_schedule_run(&(lanes_schedule){item, &s.block, &s, fill, run, look});
}
