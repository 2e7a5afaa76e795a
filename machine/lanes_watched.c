/* Lanes of trajectories with events: they take the steps in which bounds exclude every event. See lanes_parts.h.
 *
 * There is one block. A trajectory comes to a lane with the state at which its next step begins. After every step that
 * it tries, accepted or refused, the object computes the box of each lane's step and a lower bound on the size of every
 * function there, as step/watch.h does for one trajectory. If a bound is not positive, the follower is asked whether
 * the step has no event all the same. If it cannot tell, the lane takes the step back; the follower takes it again with
 * its events, and gives the trajectory back at the next step of which bounds may tell.
 *
 * Invariant: all that decides the next step moves with a trajectory, so its bits depend neither on its lane nor on its
 * neighbours, nor on which of its steps lanes take.
 */
#include "machine/lanes_parts.h"

#include "core/stepper.h"

#include <math.h>
#include <string.h>

#define NO_TRAJECTORY SIZE_MAX
enum { REPORT = 64 }; /* calls of the object between two reports */

typedef struct watched {
    lanes_item *item;
    const lanes *l;
    const lanes_follower *by;
    lanes_block block;
    size_t number[BLOCK_MAX]; /* of each lane, NO_TRAJECTORY: it is free */
    int64_t since[BLOCK_MAX]; /* of each lane, the steps of the leg when its trajectory came, */
    int64_t stop[BLOCK_MAX];  /*   and after which it goes, where steps have one size */
    double *room;             /* working space of lanes_watched_size numbers */
    size_t next;              /* trajectories of the item that have begun */
} watched;

/* Room for the numbers of a state and the largest sizes, or for both ends of a step and its accelerations' bounds. */
size_t lanes_watched_size(const lanes *l)
{
    const size_t state = l->carried + STEPPER_CLOCKS + l->def.model->nx + l->def.model->nv, step = 5 * l->def.model->nv;
    return ((state > step ? state : step) + 7) / 8 * 8;
}

static double *clock_of(const watched *s, size_t lane, int k)
{
    return &s->block.job.clocks[lane_at(s->l, LANES_CLOCKS, (size_t)k, lane)];
}

static double until_of(const watched *s, size_t lane)
{
    const lanes_item *item = s->item;
    return item->call->until ? item->call->until[s->number[lane]] : s->l->def.until;
}

static void free_lane(watched *s, size_t lane)
{
    s->number[lane] = NO_TRAJECTORY;
    *clock_of(s, lane, LANES_UNTIL) = *clock_of(s, lane, LANES_STOP) = NAN;
}

/* The clocks of a lane in the order of stepper_save. */
static const int carried[STEPPER_CLOCKS] = {LANES_T,    LANES_LOST,     LANES_NEXT,    LANES_BEFORE,
                                            LANES_RISE, LANES_SHORTEST, LANES_LONGEST, LANES_SPAN};

/* How many of them lead from a step to the next: where steps have one size, none. */
static size_t carried_clocks(const lanes *l) { return l->plan.carried ? STEPPER_CLOCKS : 0; }

/* A follower that takes many steps without lanes asks whether the call is over. */
static bool all_over(void *asked)
{
    lanes_item *item = asked;
    if (item->reports) lanes_item_report(item, 0);
    return lanes_item_over(item);
}

/* The state of a lane, or that before its latest step. */
static lanes_state state_of(const watched *s, size_t lane, bool before)
{
    const lanes *l = s->l;
    const lanes_job *j = &s->block.job;
    const double *carry = before ? j->before : j->carry, *clocks = before ? j->before_clocks : j->clocks;
    double *to = s->room;
#define CLOCK_AT(k) clocks[lane_at(l, LANES_CLOCKS, (size_t)(k), lane)]
    for (size_t k = 0; k < l->carried; k++) to[k] = carry[lane_at(l, l->carried, k, lane)];
    for (size_t k = 0; k < carried_clocks(l); k++) to[l->carried + k] = CLOCK_AT(carried[k]);
    return (lanes_state){.t0 = *clock_of(s, lane, LANES_T0),
                         .h = *clock_of(s, lane, LANES_H),
                         .at = {.steps = (int64_t)CLOCK_AT(LANES_N), .refused = (int64_t)CLOCK_AT(LANES_REFUSED)},
                         .carry = to,
                         .over = all_over,
                         .asked = s->item};
#undef CLOCK_AT
}

/* Puts a trajectory into a lane at a state. */
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

/* The largest sizes of a lane's numbers since its trajectory came. */
static const double *largest_of(const watched *s, size_t lane)
{
    const lanes *l = s->l;
    const size_t sizes = l->def.model->nx + l->def.model->nv;
    double *to = s->room + l->carried + STEPPER_CLOCKS;
    for (size_t k = 0; k < sizes; k++) to[k] = s->block.job.largest[lane_at(l, sizes, k, lane)];
    return to;
}

/* The trajectory of a lane is done. */
static void over(watched *s, size_t lane)
{
    atomic_fetch_add(&s->item->call->done, 1);
    free_lane(s, lane);
}

/* The follower has given a trajectory back, or has done with it. */
static void go_on(watched *s, size_t lane, bool goes_on, const lanes_state *state)
{
    if (goes_on)
        put(s, lane, state);
    else
        over(s, lane);
}

/* ---- the start ---- */

/* Puts the next trajectories into free lanes. False: no lane has a trajectory. */
static bool refill(watched *s)
{
    lanes_item *item = s->item;
    bool any = false, more = false;
    for (size_t i = 0; i < (size_t)s->l->block; i++) {
        while (s->number[i] == NO_TRAJECTORY && s->next < item->count && !lanes_item_over(item)) {
            lanes_state state = {.carry = s->room, .over = all_over, .asked = item};
            s->number[i] = item->first + s->next++;
            go_on(s, i, s->by->begin(s->by->ctx, item->thread, i, s->number[i], &state), &state);
            more |= s->number[i] != NO_TRAJECTORY;
        }
        any |= s->number[i] != NO_TRAJECTORY;
    }
    if (!more) return any;
    size_t numbers[BLOCK_MAX];
    for (size_t i = 0; i < (size_t)s->l->block; i++)
        numbers[i] = s->number[i] == NO_TRAJECTORY ? item->first : s->number[i];
    lanes_block_number(&s->block, item, numbers);
    return any;
}

/* ---- steps ---- */

/* Number k of the positions, or of the velocities, at an end of the latest step of a lane. */
static double number_at(const watched *s, size_t lane, bool end, bool in_v, size_t k)
{
    const lanes *l = s->l;
    const lanes_job *j = &s->block.job;
    const size_t nx = l->def.model->nx, nv = l->def.model->nv, each = nx + 2 * nv;
    if (l->plan.carried) return (end ? j->carry : j->before)[lane_at(l, l->carried, (in_v ? nv : 0) + k, lane)];
    return j->shown[lane_at(l, 2 * each, (end ? each : 0) + (in_v ? nx : 0) + k, lane)];
}

/* The clock of a lane at an end of its latest step: its time, and what rounding has left out of it. */
static double time_at(const watched *s, size_t lane, bool end, double *lost)
{
    const double *clocks = end ? s->block.job.clocks : s->block.job.before_clocks;
#define CLOCK_AT(k) clocks[lane_at(s->l, LANES_CLOCKS, (k), lane)]
    const work leg = {.t0 = CLOCK_AT(LANES_T0), .h = CLOCK_AT(LANES_H)};
    *lost = s->l->plan.carried ? CLOCK_AT(LANES_LOST) : 0;
    return s->l->plan.carried ? CLOCK_AT(LANES_T) : TIME_FIXED(&leg, CLOCK_AT(LANES_N), 0);
#undef CLOCK_AT
}

/* Whether the follower knows that the latest step of a lane has no event, though a bound is not positive. */
static bool idle(const watched *s, size_t lane)
{
    const lanes *l = s->l;
    const size_t nx = l->def.model->nx, nv = l->def.model->nv;
    double *from_x = s->room, *from_v = from_x + nx, *to_x = from_v + nv, *to_v = to_x + nx, *most = to_v + nv;
    for (size_t k = 0; k < nx; k++)
        from_x[k] = number_at(s, lane, false, false, k), to_x[k] = number_at(s, lane, true, false, k);
    for (size_t k = 0; k < nv; k++) {
        from_v[k] = number_at(s, lane, false, true, k), to_v[k] = number_at(s, lane, true, true, k);
        most[k] = s->block.job.bounds[lane_at(l, nv, k, lane)];
    }
    watch was = {0};
    was.t = time_at(s, lane, false, &was.lost);
    was.to_t = time_at(s, lane, true, &was.to_lost);
    const double span = l->plan.carried ? watch_span(&was) : *clock_of(s, lane, LANES_H);
    return s->by->idle(s->by->ctx, s->item->thread, lane,
                       &(stepper_shown){span, was.t, was.to_t, from_x, from_v, to_x, to_v, most});
}

static bool is_finite(const watched *s, size_t lane)
{
    double zero = 0;
    for (size_t k = 0; k < s->l->carried; k++) {
        const double number = s->block.job.carry[lane_at(s->l, s->l->carried, k, lane)];
        zero += number - number;
    }
    return zero == 0;
}

/* Gives a lane to the follower after its latest step: if the step may have an event, if it led to the end or to the
 * number of steps in LANES_STOP, and if the trajectory cannot go on. */
static void look_after(watched *s, size_t lane)
{
    const lanes_job *j = &s->block.job;
    const int thread = s->item->thread;
    const bool met = j->met[lane] != 0,
               ends = s->l->plan.carried && *clock_of(s, lane, LANES_T) == *clock_of(s, lane, LANES_UNTIL);
    if (j->lost[lane] != 0 || !is_finite(s, lane)) {
        s->by->leave(s->by->ctx, thread, lane);
        over(s, lane);
        return;
    }
    const bool back = met && !idle(s, lane);
    if (!back && !ends && *clock_of(s, lane, LANES_N) != *clock_of(s, lane, LANES_STOP)) return;
    lanes_state state = state_of(s, lane, back);
    const int64_t steps = state.at.steps - s->since[lane];
    const double *largest = largest_of(s, lane);
    if (!ends || back) {
        go_on(s, lane, s->by->look(s->by->ctx, thread, lane, steps, largest, &state), &state);
        return;
    }
    s->by->arrive(s->by->ctx, thread, lane, steps, largest, &state);
    over(s, lane);
}

/* The number of steps after which a lane is looked at, whatever happens. */
static int64_t stop_after(const watched *s, size_t lane)
{
    if (!s->l->plan.carried) return s->stop[lane];
    const int64_t n = (int64_t)*clock_of(s, lane, LANES_N), most = s->l->def.chosen->count,
                  pace = (n / STEPPER_PACE + 1) * STEPPER_PACE;
    return most > 0 && most < pace ? most : pace;
}

void lanes_watched(lanes_item *item)
{
    lanes *l = item->l;
    watched s = {.item = item, .l = l, .by = l->def.follower, .room = item->table};
    memset(item->memory, 0, item->call->block_size * sizeof(double));
    s.block = lanes_block_of(item, 0);
    for (size_t i = 0; i < (size_t)l->block; i++) free_lane(&s, i);
    for (int64_t calls = 0; refill(&s); calls++) {
        for (size_t i = 0; i < (size_t)l->block; i++)
            if (s.number[i] != NO_TRAJECTORY) *clock_of(&s, i, LANES_STOP) = (double)stop_after(&s, i);
        l->run(&s.block.job, CHUNK, 0);
        for (size_t i = 0; i < (size_t)l->block; i++)
            if (s.number[i] != NO_TRAJECTORY) look_after(&s, i);
        if (item->reports && calls % REPORT == 0) lanes_item_report(item, 0);
        if (lanes_item_over(item)) return;
    }
}
