/* Lanes whose trajectories have a clock each: steps that adapt, ends that differ. See lanes_parts.h.
 *
 * Three blocks do it. In WAITING lie trajectories that are about to begin, all at their first step; in RUNNING every
 * lane is somewhere on its way; in ENDING trajectories have arrived at their last whole step. A lane of RUNNING that
 * arrives moves to ENDING, and the next one of WAITING takes its place; so first steps, which have formulas of their
 * own, and the shorter last ones are taken by whole blocks too.
 *
 * Invariant: a lane moves with everything that its trajectory is, so its bits do not depend on where it runs, nor
 * beside which others.
 */
#include "machine/lanes_parts.h"

#include "core/stepper.h"

#include <math.h>
#include <string.h>

enum { RUNNING, WAITING, ENDING, BLOCKS };

typedef struct seat {     /* of one lane */
    size_t who;           /* the trajectory, or NOBODY */
    int64_t whole;        /* steps to its end; adaptive: unknown */
    double last;          /* size of the shorter step after them, 0: none */
    int64_t observations; /* so far, */
    int64_t observed;     /*   and the number of steps at the last one */
} seat;
#define NOBODY SIZE_MAX

typedef struct room { /* a block and its seats */
    lanes_block block;
    seat *seats;
} room;

typedef struct apart {
    lanes_item *item;
    const lanes *l;
    room rooms[BLOCKS];
    size_t lanes;   /* in a block */
    size_t next;    /* trajectories of the item that have begun */
    size_t waiting; /* the first lane of WAITING that may have a trajectory */
    size_t ending;  /* lanes of ENDING that have one */
    bool adaptive;
} apart;

size_t lanes_apart_blocks(void) { return BLOCKS; }
size_t lanes_apart_size(const lanes *l) { return BLOCKS * lines(l, sizeof(seat) / sizeof(double)); }

/* ---- one lane ---- */

static double *clock_of(const room *r, size_t lane, int k)
{
    return &r->block.job.clocks[lane_at(r->block.l, LANES_CLOCKS, (size_t)k, lane)];
}
static int64_t steps_of(const room *r, size_t lane) { return (int64_t)*clock_of(r, lane, LANES_N); }
static bool occupied(const room *r, size_t lane) { return r->seats[lane].who != NOBODY; }
static bool stopped(const room *r, size_t lane) { return !isnan(r->block.stopped[lane]); }

static bool at_end(const apart *s, const room *r, size_t lane)
{
    if (s->adaptive) return *clock_of(r, lane, LANES_T) == *clock_of(r, lane, LANES_UNTIL);
    return steps_of(r, lane) == r->seats[lane].whole;
}

/* The lane counts as stopped, since the numbers that it goes on to make are no trajectory's. */
static void leave(const room *r, size_t lane)
{
    r->seats[lane].who = NOBODY;
    *clock_of(r, lane, LANES_UNTIL) = *clock_of(r, lane, LANES_STOP) = NAN;
    r->block.stopped[lane] = 0;
}

static void copy(const lanes *l, double *to, size_t at, const double *from, size_t lane, size_t elements)
{
    for (size_t k = 0; k < elements; k++) to[lane_at(l, elements, k, at)] = from[lane_at(l, elements, k, lane)];
}

static void move(const room *from, size_t lane, const room *to, size_t at)
{
    const lanes *l = from->block.l;
    const lanes_job *a = &from->block.job, *b = &to->block.job;
    copy(l, b->host.own, at, a->host.own, lane, a->own_size);
    copy(l, b->host.bound, at, a->host.bound, lane, a->bound_size);
    copy(l, b->carry, at, a->carry, lane, l->carried);
    copy(l, b->kept, at, a->kept, lane, l->def.source_count * REDUCE_KEPT);
    copy(l, b->clocks, at, a->clocks, lane, LANES_CLOCKS);
    to->block.stopped[at] = from->block.stopped[lane];
    to->seats[at] = from->seats[lane];
    leave(from, lane);
}

static void finish(apart *s, const room *r, size_t lane)
{
    const seat *p = &r->seats[lane];
    lanes_block_result(&r->block, s->item->call, lane, p->who, p->observations);
    atomic_fetch_add(&s->item->call->done, 1);
    leave(r, lane);
}

/* ---- observations ---- */

typedef bool due_now(const apart *, const room *, size_t lane);

/* The observation at the end is not among those on the way. */
static bool on_the_way(const apart *s, const room *r, size_t lane)
{
    const seat *p = &r->seats[lane];
    const int64_t n = steps_of(r, lane);
    return n % s->l->def.every == 0 && n != p->observed && !(p->last == 0 && at_end(s, r, lane));
}

static bool without_last(const apart *s, const room *r, size_t lane) { return (void)s, r->seats[lane].last == 0; }
static bool anyone(const apart *s, const room *r, size_t lane) { return (void)s, (void)r, (void)lane, true; }

/* Lanes that are observed together are alike: all at the first step of a leg, or none; all observed before, or none. */
static void observe(apart *s, const room *r, due_now *due, bool ends)
{
    lanes_block block = r->block;
    bool any = false;
    block.job.ends = ends;
    for (size_t i = 0; i < s->lanes; i++) {
        const bool here = occupied(r, i) && !stopped(r, i) && due(s, r, i);
        block.job.where[i] = here;
        if (!here) continue;
        any = true;
        block.job.begins = steps_of(r, i) == 0;
        block.job.first_observation = r->seats[i].observations == 0;
        r->seats[i].observations++;
        r->seats[i].observed = steps_of(r, i);
    }
    if (any) lanes_block_observe(&block);
}

/* ---- the end ---- */

static void finish_where(apart *s, const room *r, due_now *done)
{
    for (size_t i = 0; i < s->lanes; i++)
        if (occupied(r, i) && (stopped(r, i) || done(s, r, i))) finish(s, r, i);
}

/* One step of all lanes by the formula of the first step of a leg. */
static void first_step(const room *r)
{
    lanes_block_save(&r->block);
    r->block.l->first(&r->block.job);
    if (lanes_block_broke(&r->block)) lanes_block_trace(&r->block, true, 1, 0, 0);
}

/* What is in ENDING comes to its end: by the shorter last step, a leg of its own, where there is one. */
static void end_all(apart *s)
{
    const room *r = &s->rooms[ENDING];
    bool any = false;
    observe(s, r, without_last, true);
    finish_where(s, r, without_last);
    for (size_t i = 0; i < s->lanes; i++) any |= occupied(r, i);
    s->ending = 0;
    if (!any) return;
    lanes_job j = r->block.job;
    j.record_count = 0;
    s->l->observe(&j);
    s->l->set(&j);
    for (size_t i = 0; i < s->lanes; i++) {
        if (!occupied(r, i)) continue;
        *clock_of(r, i, LANES_T0) = lanes_block_time(&r->block, i);
        *clock_of(r, i, LANES_H) = r->seats[i].last;
        *clock_of(r, i, LANES_N) = 0;
    }
    first_step(r);
    observe(s, r, anyone, true);
    finish_where(s, r, anyone);
}

/* Trajectories that stopped or arrived leave their lanes; whether there were any. */
static bool settle(apart *s)
{
    const room *r = &s->rooms[RUNNING];
    bool any = false;
    for (size_t i = 0; i < s->lanes; i++) {
        if (!occupied(r, i)) continue;
        if (stopped(r, i)) {
            finish(s, r, i);
        } else if (at_end(s, r, i)) {
            if (s->ending == s->lanes) end_all(s);
            move(r, i, &s->rooms[ENDING], s->ending++);
        } else {
            continue;
        }
        any = true;
    }
    return any;
}

/* ---- the start ---- */

/* Trajectory k is about to begin in a lane of WAITING. */
static void take_seat(apart *s, size_t lane, size_t k)
{
    const room *r = &s->rooms[WAITING];
    const lanes_def *d = &s->l->def;
    const double until = s->item->call->until ? s->item->call->until[k] : d->until;
    double h = until < d->t0 ? -fabs(d->h) : fabs(d->h);
    stepper_way way = s->adaptive ? (stepper_way){INT64_MAX, 0} : stepper_way_of(d->t0, h, until);
    if (way.whole == 0 && way.last != 0) { /* the shorter step is the only one */
        h = way.last;
        way = (stepper_way){1, 0};
    }
    const double own[LANES_CLOCKS] = {
        [LANES_T0] = d->t0, [LANES_H] = h,         [LANES_T] = d->t0,
        [LANES_NEXT] = h,   [LANES_UNTIL] = until, [LANES_STOP] = NAN,
    };
    for (int i = 0; i < LANES_CLOCKS; i++) *clock_of(r, lane, i) = own[i];
    r->seats[lane] = (seat){.who = k, .whole = way.whole, .last = way.last};
}

/* The next trajectories begin, and take their first step where that has a formula of its own. */
static void begin(apart *s)
{
    lanes_item *b = s->item;
    const room *r = &s->rooms[WAITING];
    size_t who[BLOCK_MAX];
    const size_t left = b->count - s->next, count = left < s->lanes ? left : s->lanes;
    for (size_t i = 0; i < s->lanes; i++) {
        who[i] = b->first + s->next + (i < count ? i : count - 1);
        take_seat(s, i, who[i]);
    }
    lanes_block_begin(&r->block, b, who);
    for (size_t i = count; i < s->lanes; i++) leave(r, i);
    lanes_block_stop(&r->block);
    s->next += count;
    s->waiting = 0;
    observe(s, r, at_end, true); /* no step leads to the end */
    finish_where(s, r, at_end);
    if (s->l->on_the_way) observe(s, r, anyone, false);
    if (s->adaptive) return;
    first_step(r);
    if (s->l->on_the_way) observe(s, r, on_the_way, false);
}

/* Lanes of RUNNING that are free take the next trajectories that wait; whether any lane has one. */
static bool refill(apart *s)
{
    const room *running = &s->rooms[RUNNING], *waiting = &s->rooms[WAITING];
    bool any = false;
    for (size_t i = 0; i < s->lanes; i++) {
        while (!occupied(running, i)) {
            while (s->waiting < s->lanes && !occupied(waiting, s->waiting)) s->waiting++;
            if (s->waiting < s->lanes)
                move(waiting, s->waiting, running, i);
            else if (s->next < s->item->count)
                begin(s);
            else
                break;
        }
        any |= occupied(running, i);
    }
    return any;
}

/* ---- on the way ---- */

/* So many steps that no lane passes its end, nor a moment at which it is to be observed. Where all lanes are observed
 * at the same steps, the object observes them on the way, after every *every of them, beginning at step *n. */
static int64_t steps_to_take(const apart *s, const room *r, int64_t *n, int64_t *every)
{
    const int64_t period = s->l->def.every;
    int64_t steps = CHUNK, due = CHUNK, phase = -1;
    bool alike = true;
    *every = *n = 0;
    for (size_t i = 0; i < s->lanes; i++) {
        if (!occupied(r, i)) continue;
        const int64_t taken = steps_of(r, i), left = r->seats[i].whole - taken;
        if (left < steps) steps = left;
        if (!s->l->on_the_way) continue;
        const int64_t here = taken % period;
        if (period - here < due) due = period - here;
        alike = alike && (phase < 0 || here == phase);
        phase = here;
        *n = taken;
    }
    if (!s->l->on_the_way || due > steps) return steps;
    const int64_t inner = (steps - 1) / period * period; /* the last one may be the end */
    if (!alike || phase != 0 || inner == 0) return due;
    *every = period;
    return inner;
}

static void run_fixed(apart *s)
{
    const room *r = &s->rooms[RUNNING];
    int64_t n, every;
    const int64_t steps = steps_to_take(s, r, &n, &every);
    for (size_t i = 0; every && i < s->lanes; i++) r->block.job.where[i] = occupied(r, i);
    lanes_block_save(&r->block);
    s->l->run(&r->block.job, steps, every);
    for (size_t i = 0; every && i < s->lanes; i++) {
        r->seats[i].observations += steps / every;
        r->seats[i].observed = steps_of(r, i);
    }
    if (lanes_block_broke(&r->block)) lanes_block_trace(&r->block, false, steps, n, every);
}

/* Candidates, until some lane is at its end, at an observation, or cannot go on. */
static void run_adaptive(apart *s)
{
    const room *r = &s->rooms[RUNNING];
    const int64_t every = s->l->def.every;
    for (size_t i = 0; s->l->on_the_way && i < s->lanes; i++)
        if (occupied(r, i)) *clock_of(r, i, LANES_STOP) = (double)((steps_of(r, i) / every + 1) * every);
    s->l->run(&r->block.job, CHUNK, 0);
    for (size_t i = 0; i < s->lanes; i++)
        if (occupied(r, i) && r->block.job.lost[i] != 0) r->block.stopped[i] = lanes_block_time(&r->block, i);
}

void lanes_apart(lanes_item *b)
{
    lanes *l = b->l;
    apart s = {.item = b, .l = l, .lanes = (size_t)l->block, .waiting = (size_t)l->block, .adaptive = l->plan.carried};
    memset(b->memory, 0, BLOCKS * b->call->block_size * sizeof(double));
    for (size_t k = 0; k < BLOCKS; k++) {
        void *seats = b->table + k * lines(l, sizeof(seat) / sizeof(double));
        s.rooms[k] = (room){lanes_block_of(b, k), seats};
        s.rooms[k].block.job.first_observation = false;
        for (size_t i = 0; i < s.lanes; i++) leave(&s.rooms[k], i);
    }
    for (;;) {
        bool any;
        do any = refill(&s);
        while (settle(&s));
        if (!any) break;
        if (s.adaptive)
            run_adaptive(&s);
        else
            run_fixed(&s);
        if (l->on_the_way) observe(&s, &s.rooms[RUNNING], on_the_way, false);
        if (b->told) lanes_item_tell(b, 0);
        if (lanes_item_over(b)) return;
    }
    end_all(&s);
}
