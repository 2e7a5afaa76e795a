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

typedef struct apart {
    lanes_item *item;
    lanes *l;
    seat *seats[BLOCKS];
    size_t block;   /* lanes in one */
    size_t next;    /* trajectories of the item that have begun */
    size_t waiting; /* the first lane of WAITING that may have a trajectory */
    size_t ending;  /* lanes of ENDING that have one */
    bool adaptive;
} apart;

size_t lanes_apart_blocks(void) { return BLOCKS; }
size_t lanes_apart_size(const lanes *l) { return BLOCKS * lines(l, sizeof(seat) / sizeof(double)); }

/* ---- one lane ---- */

static double *clock_of(const apart *s, const lanes_job *j, size_t lane, int k)
{
    return &j->clocks[lane_at(s->l, LANES_CLOCKS, (size_t)k, lane)];
}

static int64_t steps_of(const apart *s, const lanes_job *j, size_t lane)
{
    return (int64_t)*clock_of(s, j, lane, LANES_N);
}

static bool occupied(const apart *s, int block, size_t lane) { return s->seats[block][lane].who != NOBODY; }

static bool stopped(const apart *s, int block, size_t lane)
{
    return !isnan(lanes_block_stopped(s->item, (size_t)block)[lane]);
}

static bool at_end(const apart *s, const lanes_job *j, int block, size_t lane)
{
    if (s->adaptive) return *clock_of(s, j, lane, LANES_T) == *clock_of(s, j, lane, LANES_UNTIL);
    return steps_of(s, j, lane) == s->seats[block][lane].whole;
}

/* The lane counts as stopped, so that nobody looks at the numbers that it goes on to make. */
static void leave(const apart *s, int block, size_t lane)
{
    const lanes_job j = lanes_block_job(s->item, (size_t)block);
    s->seats[block][lane].who = NOBODY;
    *clock_of(s, &j, lane, LANES_UNTIL) = *clock_of(s, &j, lane, LANES_STOP) = NAN;
    lanes_block_stopped(s->item, (size_t)block)[lane] = 0;
}

static void copy(const apart *s, double *to, size_t at, const double *from, size_t lane, size_t elements)
{
    for (size_t k = 0; k < elements; k++) to[lane_at(s->l, elements, k, at)] = from[lane_at(s->l, elements, k, lane)];
}

static void move(apart *s, int from, size_t lane, int to, size_t at)
{
    const lanes_job a = lanes_block_job(s->item, (size_t)from), b = lanes_block_job(s->item, (size_t)to);
    copy(s, b.host.own, at, a.host.own, lane, a.own_size);
    copy(s, b.host.bound, at, a.host.bound, lane, a.bound_size);
    copy(s, b.carry, at, a.carry, lane, s->l->carried);
    copy(s, b.kept, at, a.kept, lane, s->l->def.source_count * REDUCE_KEPT);
    copy(s, b.clocks, at, a.clocks, lane, LANES_CLOCKS);
    lanes_block_stopped(s->item, (size_t)to)[at] = lanes_block_stopped(s->item, (size_t)from)[lane];
    s->seats[to][at] = s->seats[from][lane];
    leave(s, from, lane);
}

static void finish(apart *s, int block, size_t lane)
{
    const seat *p = &s->seats[block][lane];
    lanes_block_result(s->item, (size_t)block, lane, p->who, p->observations);
    atomic_fetch_add(&s->item->call->done, 1);
    leave(s, block, lane);
}

/* ---- observations ---- */

typedef bool due_now(const apart *, const lanes_job *, int block, size_t lane);

static bool at_start(const apart *s, const lanes_job *j, int block, size_t lane)
{
    return s->l->on_the_way || at_end(s, j, block, lane);
}

/* The observation at the end is not among those on the way. */
static bool on_the_way(const apart *s, const lanes_job *j, int block, size_t lane)
{
    const seat *p = &s->seats[block][lane];
    const int64_t n = steps_of(s, j, lane);
    return s->l->on_the_way && n % s->l->def.every == 0 && n != p->observed &&
           !(p->last == 0 && at_end(s, j, block, lane));
}

static bool arrived(const apart *s, const lanes_job *j, int block, size_t lane)
{
    return (void)j, s->seats[block][lane].last == 0;
}

static bool anyone(const apart *s, const lanes_job *j, int block, size_t lane)
{
    return (void)s, (void)j, (void)block, (void)lane, true;
}

static void observe(apart *s, int block, due_now *due, bool ends)
{
    lanes_job j = lanes_block_job(s->item, (size_t)block);
    bool any = false;
    j.ends = ends;
    j.begins = due == at_start;
    for (size_t i = 0; i < s->block; i++) {
        const bool here = occupied(s, block, i) && !stopped(s, block, i) && due(s, &j, block, i);
        j.where[i] = here;
        if (!here) continue;
        any = true;
        /* the same for all that are observed together */
        j.first_observation = s->seats[block][i].observations == 0;
        s->seats[block][i].observations++;
        s->seats[block][i].observed = steps_of(s, &j, i);
    }
    if (any) lanes_block_observe(s->item, (size_t)block, &j);
}

/* ---- the end ---- */

static void finish_where(apart *s, int block, due_now *done)
{
    const lanes_job j = lanes_block_job(s->item, (size_t)block);
    for (size_t i = 0; i < s->block; i++)
        if (occupied(s, block, i) && (stopped(s, block, i) || done(s, &j, block, i))) finish(s, block, i);
}

/* One step of all lanes by the formula of the first step of a leg. */
static void first_step(apart *s, int block)
{
    const lanes_job j = lanes_block_job(s->item, (size_t)block);
    lanes_block_save(s->item, &j);
    s->l->first(&j);
    if (lanes_block_broke(s->item, (size_t)block)) lanes_block_trace(s->item, (size_t)block, true, 1, 0);
}

/* What is in ENDING comes to its end: by the shorter last step, a leg of its own, where there is one. */
static void end_all(apart *s)
{
    observe(s, ENDING, arrived, true);
    finish_where(s, ENDING, arrived);
    bool any = false;
    lanes_job j = lanes_block_job(s->item, ENDING);
    for (size_t i = 0; i < s->block; i++) any |= occupied(s, ENDING, i);
    s->ending = 0;
    if (!any) return;
    j.record_count = 0;
    s->l->observe(&j);
    s->l->set(&j);
    for (size_t i = 0; i < s->block; i++) {
        if (!occupied(s, ENDING, i)) continue;
        *clock_of(s, &j, i, LANES_T0) = lanes_block_time(s->l, &j, i);
        *clock_of(s, &j, i, LANES_H) = s->seats[ENDING][i].last;
        *clock_of(s, &j, i, LANES_N) = 0;
    }
    first_step(s, ENDING);
    observe(s, ENDING, anyone, true);
    finish_where(s, ENDING, anyone);
}

static void arrive(apart *s, int from, size_t lane)
{
    if (s->ending == s->block) end_all(s);
    move(s, from, lane, ENDING, s->ending++);
}

/* Trajectories that stopped or arrived leave their lanes; whether there were any. */
static bool settle(apart *s, int block)
{
    const lanes_job j = lanes_block_job(s->item, (size_t)block);
    bool any = false;
    for (size_t i = 0; i < s->block; i++) {
        if (!occupied(s, block, i)) continue;
        const bool broken = stopped(s, block, i);
        if (broken)
            finish(s, block, i);
        else if (at_end(s, &j, block, i))
            arrive(s, block, i);
        else
            continue;
        any = true;
    }
    return any;
}

/* ---- the start ---- */

/* The clock of lane `lane` of WAITING, which trajectory k will use. */
static void set_clock(apart *s, const lanes_job *j, size_t lane, size_t k, bool used)
{
    const lanes_def *d = &s->l->def;
    const double until = s->item->call->until ? s->item->call->until[k] : d->until;
    double h = until < d->t0 ? -fabs(d->h) : fabs(d->h);
    stepper_way way = s->adaptive ? (stepper_way){INT64_MAX, 0} : stepper_way_of(d->t0, h, until);
    if (way.whole == 0 && way.last != 0) { /* the shorter step is the only one */
        h = way.last;
        way = (stepper_way){1, 0};
    }
    const double own[LANES_CLOCKS] = {[LANES_T0] = d->t0, [LANES_H] = h,         [LANES_T] = d->t0,
                                      [LANES_NEXT] = h,   [LANES_UNTIL] = until, [LANES_STOP] = NAN};
    for (int i = 0; i < LANES_CLOCKS; i++) *clock_of(s, j, lane, i) = own[i];
    s->seats[WAITING][lane] = (seat){.who = used ? k : NOBODY, .whole = way.whole, .last = way.last};
}

/* The next trajectories begin, and take their first step where that has a formula of its own. */
static void begin(apart *s)
{
    lanes_item *b = s->item;
    size_t who[BLOCK_MAX];
    const size_t left = b->count - s->next, count = left < s->block ? left : s->block;
    const lanes_job j = lanes_block_job(b, WAITING);
    for (size_t i = 0; i < s->block; i++) {
        who[i] = b->first + s->next + (i < count ? i : count - 1);
        set_clock(s, &j, i, who[i], i < count);
    }
    lanes_block_begin(b, WAITING, who);
    for (size_t i = count; i < s->block; i++) leave(s, WAITING, i);
    lanes_block_stop(b, WAITING);
    s->next += count;
    s->waiting = 0;
    observe(s, WAITING, at_start, false);
    for (size_t i = 0; i < s->block; i++)
        if (occupied(s, WAITING, i) && (stopped(s, WAITING, i) || at_end(s, &j, WAITING, i))) finish(s, WAITING, i);
    if (s->adaptive) return;
    first_step(s, WAITING);
    observe(s, WAITING, on_the_way, false);
}

/* Lanes of RUNNING that are free take the next trajectories that wait; whether any lane has one. */
static bool refill(apart *s)
{
    bool any = false;
    for (size_t i = 0; i < s->block; i++) {
        while (!occupied(s, RUNNING, i)) {
            while (s->waiting < s->block && !occupied(s, WAITING, s->waiting)) s->waiting++;
            if (s->waiting < s->block)
                move(s, WAITING, s->waiting, RUNNING, i);
            else if (s->next < s->item->count)
                begin(s);
            else
                break;
        }
        any |= occupied(s, RUNNING, i);
    }
    return any;
}

/* ---- on the way ---- */

/* So many steps that no lane passes its end, nor a moment at which it is to be observed; where all lanes are observed
 * at the same steps, the object observes them on the way, after every *every of them. */
static int64_t steps_to_take(apart *s, const lanes_job *j, int64_t *every)
{
    const int64_t period = s->l->def.every;
    int64_t steps = CHUNK, due = CHUNK, phase = -1;
    bool alike = s->l->on_the_way;
    for (size_t i = 0; i < s->block; i++) {
        if (!occupied(s, RUNNING, i)) continue;
        const int64_t n = steps_of(s, j, i), left = s->seats[RUNNING][i].whole - n;
        if (left < steps) steps = left;
        if (period - n % period < due) due = period - n % period;
        alike = alike && (phase < 0 || n % period == phase);
        phase = n % period;
        s->item->n = n;
    }
    *every = 0;
    if (!s->l->on_the_way || due > steps) return steps;
    const int64_t inner = (steps - 1) / period * period; /* the last one may be the end */
    if (!alike || phase != 0 || inner == 0) return due;
    *every = period;
    return inner;
}

static void run_fixed(apart *s)
{
    const lanes_job j = lanes_block_job(s->item, RUNNING);
    int64_t every;
    const int64_t steps = steps_to_take(s, &j, &every);
    for (size_t i = 0; every && i < s->block; i++) j.where[i] = occupied(s, RUNNING, i);
    lanes_block_save(s->item, &j);
    s->l->run(&j, steps, every);
    for (size_t i = 0; every && i < s->block; i++) {
        s->seats[RUNNING][i].observations += steps / every;
        s->seats[RUNNING][i].observed = steps_of(s, &j, i);
    }
    if (lanes_block_broke(s->item, RUNNING)) lanes_block_trace(s->item, RUNNING, false, steps, every);
}

/* Candidates, until some lane is at its end, at an observation, or cannot go on. */
static void run_adaptive(apart *s)
{
    const lanes_job j = lanes_block_job(s->item, RUNNING);
    const int64_t every = s->l->def.every;
    for (size_t i = 0; s->l->on_the_way && i < s->block; i++)
        if (occupied(s, RUNNING, i))
            *clock_of(s, &j, i, LANES_STOP) = (double)((steps_of(s, &j, i) / every + 1) * every);
    s->l->run(&j, CHUNK, 0);
    double *ended = lanes_block_stopped(s->item, RUNNING);
    for (size_t i = 0; i < s->block; i++)
        if (occupied(s, RUNNING, i) && j.lost[i] != 0) ended[i] = lanes_block_time(s->l, &j, i);
}

void lanes_apart(lanes_item *b)
{
    lanes *l = b->l;
    apart s = {.item = b, .l = l, .block = (size_t)l->block, .adaptive = l->plan.carried};
    memset(b->memory, 0, BLOCKS * b->call->block_size * sizeof(double));
    for (int k = 0; k < BLOCKS; k++) {
        s.seats[k] = (seat *)(void *)(b->table + (size_t)k * lines(l, sizeof(seat) / sizeof(double)));
        for (size_t i = 0; i < s.block; i++) leave(&s, k, i);
    }
    s.waiting = s.block;
    for (;;) {
        bool any;
        do any = refill(&s);
        while (settle(&s, RUNNING));
        if (!any) break;
        if (s.adaptive)
            run_adaptive(&s);
        else
            run_fixed(&s);
        observe(&s, RUNNING, on_the_way, false);
        if (b->told && lanes_item_tell(b, 0)) return;
        if (atomic_load(&b->call->cancelled)) return;
    }
    end_all(&s);
}
