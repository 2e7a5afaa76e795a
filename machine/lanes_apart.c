/* Lanes whose trajectories have own clocks: steps adapt, or ends differ. See lanes_parts.h.
 *
 * There are three blocks. WAITING holds trajectories at their first step, RUNNING trajectories at any step after it,
 * and ENDING trajectories after their last whole step. A trajectory of RUNNING that has taken its last whole step moves
 * to ENDING, and the next one of WAITING takes its lane. So whole blocks take the first steps, which have formulas of
 * their own, and the shorter last steps.
 *
 * If errors are wanted, a block of companions goes beside each block: the companion of a trajectory has its lane there,
 * and moves with it. After every candidate of the trajectories the companions of those that accepted it take the two
 * halves of the step.
 *
 * Invariant: a trajectory moves with all its numbers, so its bits depend neither on its lane nor on its neighbours.
 */
#include "machine/lanes_parts.h"

#include "core/stepper.h"

#include <math.h>
#include <string.h>

enum { RUNNING, WAITING, ENDING, BLOCKS };

typedef struct trajectory {     /* of one lane */
    int64_t whole;              /* whole steps to its end; unknown where steps adapt */
    double last;                /* size of the shorter step after them; 0: none */
    int64_t observations;       /* observations so far */
    int64_t observed;           /* the number of steps at the last observation */
    int64_t paced;              /* where steps adapt: the steps when it was last asked whether it may crawl */
    double paced_t;             /* the time at `paced` */
    bool crawls;                /* it may crawl */
    lanes_companion *companion; /* of the trajectory in this lane; NULL: errors are not computed */
} trajectory;

typedef struct apart_block {
    lanes_block block, half;  /* half: of the companions */
    trajectory *trajectories; /* of its lanes */
    size_t number[BLOCK_MAX]; /* the array to which block.number points */
} apart_block;

typedef struct apart {
    lanes_item *item;
    const lanes *l;
    apart_block blocks[BLOCKS];
    size_t lanes;   /* how many lanes a block has */
    size_t next;    /* trajectories of the item that have begun */
    size_t waiting; /* the first lane of WAITING that may be occupied */
    size_t ending;  /* how many lanes of ENDING are occupied */
    bool adaptive;
} apart;

size_t lanes_apart_blocks(void) { return BLOCKS; }
size_t lanes_apart_size(const lanes *l) { return BLOCKS * lines(l, sizeof(trajectory) / sizeof(double)); }

/* ---- one lane ---- */

static double *clock_of(const apart_block *b, size_t lane, int k) { return lanes_clock(&b->block, lane, k); }
static int64_t steps_of(const apart_block *b, size_t lane) { return lanes_steps(&b->block, lane); }
static bool occupied(const apart_block *b, size_t lane) { return lanes_occupied(&b->block, lane); }
static bool stopped(const apart_block *b, size_t lane) { return !isnan(b->block.stopped[lane]); }

static bool at_end(const apart *s, const apart_block *b, size_t lane)
{
    if (s->adaptive) return *clock_of(b, lane, LANES_T) == *clock_of(b, lane, LANES_UNTIL);
    return steps_of(b, lane) == b->trajectories[lane].whole;
}

/* Copies a lane of a block, except the time at which it stopped. */
static void copy_lane(const lanes_block *from, size_t lane, const lanes_block *to, size_t at)
{
    const lanes *l = from->l;
    const lanes_job *source = &from->job, *target = &to->job;
    lanes_copy(l, target->host.own, at, source->host.own, lane, source->own_size);
    lanes_copy(l, target->host.bound, at, source->host.bound, lane, source->bound_size);
    lanes_copy(l, target->carry, at, source->carry, lane, l->carried);
    lanes_copy(l, target->kept, at, source->kept, lane, l->def.source_count * REDUCE_KEPT);
    lanes_copy(l, target->clocks, at, source->clocks, lane, LANES_CLOCKS);
    lanes_block_forget(to, at);
}

static void move(const apart_block *from, size_t lane, const apart_block *to, size_t at)
{
    lanes_companion *other = to->trajectories[at].companion;
    copy_lane(&from->block, lane, &to->block, at);
    if (other) copy_lane(&from->half, lane, &to->half, at);
    to->block.stopped[at] = from->block.stopped[lane];
    to->trajectories[at] = from->trajectories[lane];
    from->trajectories[lane].companion = other;
    to->block.number[at] = from->block.number[lane];
    lanes_schedule_free(&from->block, lane);
}

static void finish(apart *s, const apart_block *b, size_t lane)
{
    const trajectory *p = &b->trajectories[lane];
    const size_t number = b->block.number[lane];
    const int64_t steps = s->adaptive ? steps_of(b, lane) : p->whole + (p->last != 0);
    lanes_block_results(&b->block, s->item->call, lane, lane + 1, number, p->observations, steps);
    if (p->crawls) s->l->def.left(s->l->def.context, number, LANES_MAY_CRAWL);
    if (p->companion) lanes_block_errors(s->item->call, p->companion, stopped(b, lane), number);
    atomic_fetch_add(&s->item->call->done, 1);
    lanes_schedule_free(&b->block, lane);
}

/* ---- observations ---- */

typedef bool due_now(const apart *, const apart_block *, size_t lane);

/* Excludes the observation at the end. */
static bool on_the_way(const apart *s, const apart_block *b, size_t lane)
{
    const trajectory *p = &b->trajectories[lane];
    const int64_t n = steps_of(b, lane);
    return n % s->l->def.every == 0 && n != p->observed && !(p->last == 0 && at_end(s, b, lane));
}

static bool without_last(const apart *s, const apart_block *b, size_t lane)
{
    return (void)s, b->trajectories[lane].last == 0;
}
static bool every_lane(const apart *s, const apart_block *b, size_t lane) { return (void)s, (void)b, (void)lane, true; }

/* Observes the lanes for which `due` holds. Of these either all or none are at the first step of a leg, and either all
 * or none have been observed before. */
static void observe(apart *s, const apart_block *b, due_now *due, bool ends)
{
    lanes_block block = b->block;
    bool any = false;
    block.job.ends = ends;
    for (size_t i = 0; i < s->lanes; i++) {
        const bool here = occupied(b, i) && !stopped(b, i) && due(s, b, i);
        block.job.where[i] = here;
        if (!here) continue;
        any = true;
        block.job.begins = steps_of(b, i) == 0;
        block.job.first_observation = b->trajectories[i].observations == 0;
        b->trajectories[i].observations++;
        b->trajectories[i].observed = steps_of(b, i);
    }
    if (any) lanes_block_observe(&block);
}

/* ---- the end ---- */

static void finish_where(apart *s, const apart_block *b, due_now *done)
{
    for (size_t i = 0; i < s->lanes; i++)
        if (occupied(b, i) && (stopped(b, i) || done(s, b, i))) finish(s, b, i);
}

/* Takes one step of all lanes by the formula of the first step of a leg. */
static void first_step(const apart_block *b)
{
    lanes_block_save(&b->block);
    b->block.l->first(&b->block.job);
    if (lanes_block_diverged(&b->block)) lanes_block_trace(&b->block, true, 1, 0, 0);
}

/* Takes the trajectories of ENDING to their ends, by a shorter last step, which is a leg of its own, if there is one.
 * */
static void end_all(apart *s)
{
    const apart_block *b = &s->blocks[ENDING];
    bool any = false;
    observe(s, b, without_last, true);
    finish_where(s, b, without_last);
    for (size_t i = 0; i < s->lanes; i++) any |= occupied(b, i);
    s->ending = 0;
    if (!any) return;
    lanes_job j = b->block.job;
    j.record_count = 0;
    s->l->observe(&j);
    s->l->set(&j);
    for (size_t i = 0; i < s->lanes; i++) {
        if (!occupied(b, i)) continue;
        *clock_of(b, i, LANES_T0) = lanes_block_time(&b->block, i);
        *clock_of(b, i, LANES_H) = b->trajectories[i].last;
        *clock_of(b, i, LANES_N) = 0;
    }
    first_step(b);
    observe(s, b, every_lane, true);
    finish_where(s, b, every_lane);
}

/* Removes the trajectory of a lane of RUNNING where it stopped or took its last whole step. */
static void look(void *ctx, size_t lane)
{
    apart *s = ctx;
    const apart_block *b = &s->blocks[RUNNING];
    if (stopped(b, lane)) {
        finish(s, b, lane);
    } else if (at_end(s, b, lane)) {
        if (s->ending == s->lanes) end_all(s);
        move(b, lane, &s->blocks[ENDING], s->ending++);
    }
}

/* ---- the start ---- */

/* Gives a lane of WAITING to trajectory k: its clock and its steps. */
static void set_lane(apart *s, size_t lane, size_t k)
{
    const apart_block *b = &s->blocks[WAITING];
    const lanes_def *d = &s->l->def;
    const double until = s->item->call->until ? s->item->call->until[k] : d->until;
    double h = until < d->t0 ? -fabs(d->h) : fabs(d->h);
    stepper_way way = s->adaptive ? (stepper_way){INT64_MAX, 0} : stepper_way_of(d->t0, h, until);
    if (way.whole == 0 && way.last != 0) { /* the shorter step is the only step */
        h = way.last;
        way = (stepper_way){1, 0};
    }
    const double own[LANES_CLOCKS] = {
        [LANES_T0] = d->t0,          [LANES_H] = h,         [LANES_T] = d->t0,
        [LANES_RISE] = CONTROL_RISE, [LANES_UNTIL] = until, [LANES_STOP] = NAN,
    };
    for (int i = 0; i < LANES_CLOCKS; i++) *clock_of(b, lane, i) = own[i];
    lanes_companion *companion = b->trajectories[lane].companion;
    b->block.number[lane] = k;
    b->trajectories[lane] =
        (trajectory){.whole = way.whole, .last = way.last, .paced_t = d->t0, .companion = companion};
    if (!companion) return;
    for (int i = 0; i < LANES_CLOCKS; i++) *lanes_clock(&b->half, lane, i) = own[i];
    lanes_companion_begin(companion, d->t0, until);
}

/* ---- the companions ---- */

static bool alive(const apart_block *b, size_t lane)
{
    const lanes_companion *c = b->trajectories[lane].companion;
    return occupied(b, lane) && !stopped(b, lane) && !c->failed && isnan(c->differences.until);
}

/* Sends the companion of a lane to t in two steps; where steps choose their order, with that of the step that led
 * there.
 */
static void send(const apart_block *b, size_t lane, double from, double t)
{
    const lanes_block *half = &b->half;
    const double h = (t - from) / 2, span = *lanes_clock(half, lane, LANES_SPAN),
                 line = row_orders(half->l->def.chosen) ? *clock_of(b, lane, LANES_SPAN) : 0;
    const double own[LANES_CLOCKS] = {
        [LANES_T0] = from, [LANES_H] = h,      [LANES_T] = from,    [LANES_RISE] = CONTROL_RISE, [LANES_NEXT] = h,
        [LANES_UNTIL] = t, [LANES_STOP] = NAN, [LANES_SPAN] = span, [LANES_BEFORE] = line};
    for (int i = 0; i < LANES_CLOCKS; i++) *lanes_clock(half, lane, i) = own[i];
}

/* Takes steps until every lane that is sent has made `most` candidates. A lane that cannot go on ends a call of the
 * object, so the others go on in a second call. */
static void make(const apart *s, const lanes_block *half, const bool *sent, int64_t most)
{
    for (int turn = 0; turn < 2; turn++) {
        int64_t left = 0;
        for (size_t i = 0; i < s->lanes; i++) {
            const double made = *lanes_clock(half, i, LANES_N) + *lanes_clock(half, i, LANES_REFUSED);
            const bool lost = turn && half->job.lost[i] != 0;
            if (lost) *lanes_clock(half, i, LANES_UNTIL) = *lanes_clock(half, i, LANES_NEXT) = NAN;
            if (sent[i] && !lost && most - (int64_t)made > left) left = most - (int64_t)made;
        }
        if (left > 0) half->l->run(&half->job, left, 0);
    }
}

/* Does what `make` does, and leaves all lanes that are not sent as they are. */
static void make_apart(const apart *s, const lanes_block *half, const bool *sent, int64_t most)
{
    bool rest = false;
    for (size_t i = 0; i < s->lanes; i++) rest |= !sent[i];
    if (rest) lanes_block_save(half);
    for (size_t i = 0; i < s->lanes; i++)
        if (!sent[i]) *lanes_clock(half, i, LANES_UNTIL) = *lanes_clock(half, i, LANES_NEXT) = NAN;
    make(s, half, sent, most);
    for (size_t i = 0; rest && i < s->lanes; i++)
        if (!sent[i]) lanes_block_put_back(half, i);
}

/* Takes the lanes that are sent to where they land, by two candidates, or by more where the equation of a candidate
 * could not be solved and a shorter one follows. A lane that cannot go on stays where it is. */
static void land(const apart *s, const lanes_block *half, const bool *sent)
{
    bool away[BLOCK_MAX], any = true;
    memcpy(away, sent, s->lanes * sizeof *away);
    for (int64_t most = 2; any; most++) {
        make_apart(s, half, away, most);
        any = false;
        for (size_t i = 0; i < s->lanes; i++) {
            const double until = *lanes_clock(half, i, LANES_UNTIL);
            const bool lost = half->job.lost[i] != 0 || isnan(until);
            away[i] = away[i] && !lost && *lanes_clock(half, i, LANES_T) != until;
            any |= away[i];
        }
    }
}

/* Compares the lanes of a block whose companions have landed, which are marked in `now`. */
static void compare(const apart *s, const apart_block *b, const bool *now)
{
    lanes_companion *list[BLOCK_MAX];
    bool observed[BLOCK_MAX];
    for (size_t i = 0; i < s->lanes; i++) {
        list[i] = now[i] ? b->trajectories[i].companion : NULL;
        observed[i] = now[i] && s->l->on_the_way && (at_end(s, b, i) || steps_of(b, i) % s->l->def.every == 0);
    }
    lanes_block_see(&b->block, false, 0);
    lanes_block_see(&b->half, false, 0);
    lanes_companion_compare(&b->block, &b->half, list, observed);
}

/* Lets the companions follow those trajectories of RUNNING that have taken more steps than `before`. */
static void follow(const apart *s, const double *before)
{
    const apart_block *b = &s->blocks[RUNNING];
    const lanes_block *half = &b->half;
    bool sent[BLOCK_MAX], any = false;
    for (size_t i = 0; i < s->lanes; i++) {
        sent[i] = alive(b, i) && *clock_of(b, i, LANES_N) > before[i];
        any |= sent[i];
        if (!sent[i]) continue;
        lanes_companion *c = b->trajectories[i].companion;
        const double t = *clock_of(b, i, LANES_T);
        send(b, i, c->landed, t);
        c->landed = t;
    }
    if (!any) return;
    land(s, half, sent);
    for (size_t i = 0; i < s->lanes; i++)
        if (sent[i] && *lanes_clock(half, i, LANES_T) != b->trajectories[i].companion->landed)
            b->trajectories[i].companion->failed = true;
    compare(s, b, sent);
}

static void compare_start(const apart *s, const apart_block *b)
{
    bool now[BLOCK_MAX];
    for (size_t i = 0; i < s->lanes; i++) now[i] = alive(b, i);
    compare(s, b, now);
}

/* Begins the next trajectories in WAITING; with fixed steps, takes their first step. */
static void begin(apart *s)
{
    lanes_item *item = s->item;
    const apart_block *b = &s->blocks[WAITING];
    size_t numbers[BLOCK_MAX];
    const size_t left = item->count - s->next, count = left < s->lanes ? left : s->lanes;
    for (size_t i = 0; i < s->lanes; i++) {
        numbers[i] = item->first + s->next + (i < count ? i : count - 1);
        set_lane(s, i, numbers[i]);
    }
    lanes_block_begin(&b->block, item, numbers);
    if (item->half) lanes_block_begin(&b->half, item->half, numbers);
    for (size_t i = count; i < s->lanes; i++) lanes_schedule_free(&b->block, i);
    lanes_block_stop(&b->block);
    if (item->half) compare_start(s, b);
    s->next += count;
    s->waiting = 0;
    observe(s, b, at_end, true); /* where no step leads to the end */
    finish_where(s, b, at_end);
    if (s->l->on_the_way) observe(s, b, every_lane, false);
    if (s->adaptive) return;
    first_step(b);
    if (s->l->on_the_way) observe(s, b, on_the_way, false);
}

/* Moves the next trajectory of WAITING to a free lane of RUNNING, or lets the next ones begin in WAITING. */
static bool fill(void *ctx, size_t lane)
{
    apart *s = ctx;
    const apart_block *waiting = &s->blocks[WAITING];
    while (s->waiting < s->lanes && !occupied(waiting, s->waiting)) s->waiting++;
    if (s->waiting < s->lanes) {
        move(waiting, s->waiting, &s->blocks[RUNNING], lane);
        look(s, lane);
        return true;
    }
    if (s->next == s->item->count) return false;
    begin(s);
    return true;
}

/* ---- steps ---- */

/* Returns how many steps all lanes can take before one reaches its end or an observation. Where all lanes are observed
 * at equal steps, the object makes the observations, after every *every steps. */
static int64_t steps_to_take(const apart *s, const apart_block *b, int64_t *every)
{
    const int64_t period = s->l->def.every;
    int64_t steps = CHUNK, due = CHUNK, phase = -1;
    bool alike = true;
    *every = 0;
    for (size_t i = 0; i < s->lanes; i++) {
        if (!occupied(b, i)) continue;
        const int64_t taken = steps_of(b, i), left = b->trajectories[i].whole - taken;
        if (left < steps) steps = left;
        if (!s->l->on_the_way) continue;
        const int64_t here = taken % period;
        if (period - here < due) due = period - here;
        alike = alike && (phase < 0 || here == phase);
        phase = here;
    }
    if (!s->l->on_the_way || due > steps) return steps;
    const int64_t inner = (steps - 1) / period * period; /* the last observation may be at the end */
    if (!alike || phase != 0 || inner == 0) return due;
    *every = period;
    return inner;
}

static void run_fixed(apart *s)
{
    const apart_block *b = &s->blocks[RUNNING];
    int64_t every;
    const int64_t steps = steps_to_take(s, b, &every);
    for (size_t i = 0; s->l->on_the_way && i < s->lanes; i++)
        b->block.job.where[i] = occupied(b, i) && b->trajectories[i].observed == steps_of(b, i);
    lanes_block_save(&b->block);
    s->l->run(&b->block.job, steps, every);
    for (size_t i = 0; every && i < s->lanes; i++) {
        b->trajectories[i].observations += steps / every;
        b->trajectories[i].observed = steps_of(b, i);
    }
    if (!lanes_block_diverged(&b->block)) return;
    /* The object's observation after the last of its steps is examined here, with the next steps. */
    const int64_t examined = every ? every : CHUNK + 1;
    lanes_block_trace(&b->block, false, steps, 0, s->l->on_the_way ? examined : 0);
}

/* Stops the trajectories that may crawl. */
static void stop_crawling(const apart *s, const apart_block *b)
{
    const bool smooth = s->l->def.problem->traits.smooth;
    for (size_t i = 0; i < s->lanes; i++) {
        trajectory *p = &b->trajectories[i];
        const int64_t n = steps_of(b, i);
        if (!occupied(b, i) || n == p->paced || n % STEPPER_PACE) continue;
        const double t = *clock_of(b, i, LANES_T), gone = fabs(t - p->paced_t),
                     left = fabs(*clock_of(b, i, LANES_UNTIL) - t);
        p->crawls = stepper_may_crawl(n, gone, left, *clock_of(b, i, LANES_LONGEST), smooth);
        p->paced = n, p->paced_t = t;
        if (p->crawls) b->block.stopped[i] = t;
    }
}

/* Stops the trajectories that have taken the most steps that they may. */
static void stop_at_most(const apart *s, const apart_block *b)
{
    const int64_t most = s->l->def.chosen->count;
    for (size_t i = 0; most > 0 && i < s->lanes; i++)
        if (occupied(b, i) && !stopped(b, i) && !at_end(s, b, i) && steps_of(b, i) >= most)
            b->block.stopped[i] = lanes_block_time(&b->block, i);
}

/* Computes candidates until some lane is at its end, at an observation or at a pace, or fails. */
static void run_adaptive(apart *s)
{
    const apart_block *b = &s->blocks[RUNNING];
    const int64_t every = s->l->def.every;
    for (size_t i = 0; i < s->lanes; i++)
        if (occupied(b, i)) {
            const int64_t pace = lanes_schedule_pace(&b->block, i),
                          due = s->l->on_the_way ? (steps_of(b, i) / every + 1) * every : pace;
            *clock_of(b, i, LANES_STOP) = (double)(due < pace ? due : pace);
        }
    double before[BLOCK_MAX];
    const bool told = s->item->half != NULL;
    for (size_t i = 0; told && i < s->lanes; i++) before[i] = *clock_of(b, i, LANES_N);
    s->l->run(&b->block.job, told ? 1 : CHUNK, 0);
    for (size_t i = 0; i < s->lanes; i++)
        if (occupied(b, i) && b->block.job.lost[i] != 0) b->block.stopped[i] = lanes_block_time(&b->block, i);
    stop_crawling(s, b);
    stop_at_most(s, b);
    if (told) follow(s, before);
}

static void run(void *ctx)
{
    apart *s = ctx;
    if (s->adaptive)
        run_adaptive(s);
    else
        run_fixed(s);
    if (s->l->on_the_way) observe(s, &s->blocks[RUNNING], on_the_way, false);
}

void lanes_apart(lanes_item *item)
{
    lanes *l = item->l;
    apart s = {
        .item = item, .l = l, .lanes = (size_t)l->block, .waiting = (size_t)l->block, .adaptive = l->plan.carried};
    memset(item->memory, 0, BLOCKS * item->call->block_size * sizeof(double));
    if (item->half) memset(item->half->memory, 0, BLOCKS * item->half->call->block_size * sizeof(double));
    for (size_t k = 0; k < BLOCKS; k++) {
        apart_block *b = &s.blocks[k];
        void *trajectories = item->table + k * lines(l, sizeof(trajectory) / sizeof(double));
        b->block = lanes_block_of(item, k), b->block.number = b->number;
        if (item->half) b->half = lanes_block_of(item->half, k);
        b->trajectories = trajectories;
        b->block.job.first_observation = false;
        for (size_t i = 0; i < s.lanes; i++) {
            b->trajectories[i].companion = item->half ? &item->companions[k * s.lanes + i] : NULL;
            lanes_schedule_free(&b->block, i);
        }
    }
    lanes_schedule_run(&(lanes_schedule){item, &s.blocks[RUNNING].block, &s, fill, run, look});
    if (!lanes_item_over(item)) end_all(&s);
}
