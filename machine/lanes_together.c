/* Lanes whose trajectories share one clock. All blocks of an item advance by the same chunk of steps before the next
 * chunk, so that the values that depend on time alone are tabulated once for all blocks. See lanes_parts.h.
 */
#include "machine/lanes_parts.h"

#include "core/course.h"

#include <math.h>
#include <string.h>

typedef struct together {
    lanes_item *item;
    size_t blocks;
    int64_t steps, every; /* the present chunk: its steps, and steps from one observation to the next; 0: none */
    struct {
        double t;
        bool ends, observed;
    } landing; /* of the companions: the time, whether it is the end, whether it is an observation */
} together;

static int64_t total_of(const lanes_def *d) { return d->whole + (d->last != 0); }

static void each_block(const together *s, void (*body)(const together *, const lanes_block *, size_t))
{
    lanes_block block = lanes_block_of(s->item, 0);
    for (size_t k = 0; k < s->blocks; k++) {
        lanes_block_place(&block, s->item, k);
        body(s, &block, k);
    }
}

/* Surplus lanes of the last block repeat the last trajectory. */
static void begin_block(const together *s, const lanes_block *block, size_t number)
{
    const lanes_item *b = s->item;
    size_t trajectories[BLOCK_MAX];
    for (size_t i = 0; i < (size_t)b->l->block; i++) {
        const size_t k = number * (size_t)b->l->block + i;
        trajectories[i] = b->first + (k < b->count ? k : b->count - 1);
    }
    lanes_block_begin(block, b, trajectories);
}

static void run_block(const together *s, const lanes_block *block, size_t number)
{
    (void)number;
    const lanes_item *b = s->item;
    const lanes *l = b->l;
    lanes_block_save(block);
    if (b->n == 0)
        l->first(&block->job);
    else
        l->run(&block->job, s->steps, s->every);
    for (size_t i = 0; l->plan.solves && b->n == 0 && i < (size_t)l->block; i++)
        if (isinf(block->job.lost[i])) atomic_store(&b->call->refused, true);
    if (lanes_block_diverged(block))
        lanes_block_trace(block, b->n == 0, s->steps, b->n, l->on_the_way ? l->def.every : 0);
}

static void observe_block(const together *s, const lanes_block *block, size_t number)
{
    (void)s, (void)number;
    lanes_block_observe(block);
}

/* Begins the leg of the shorter last step, from the state after the whole steps. */
static void begin_last_leg(const together *s, const lanes_block *block, size_t number)
{
    lanes_job job = block->job;
    (void)s, (void)number;
    job.record_count = 0;
    block->l->observe(&job);
    block->l->set(&job);
}

/* Begins a leg of the companions at their present state. Known rounding errors of the state are kept, as in
 * stepper_turn. */
static void turn_block(const together *s, const lanes_block *block, size_t number)
{
    (void)number;
    const lanes_item *b = s->item;
    const lanes *l = b->l;
    const bool words = l->plan.row->compensated && b->n > 0, whole = words && !l->plan.fsal;
    const size_t width = (size_t)l->width, array = l->def.model->nv * width, group = l->carried * width;
    lanes_block_save(block);
    lanes_block_see(block, false, 0);
    l->set(&block->job);
    for (size_t g = 0; words && g < (size_t)l->groups; g++) /* after x and v */
        memcpy(block->job.carry + g * group + 2 * array, block->saved + g * group + 2 * array,
               (whole ? 2 : 1) * array * sizeof(double));
}

static void compare_block(const together *s, const lanes_block *block, size_t number)
{
    const lanes_item *b = s->item;
    const lanes_block half = lanes_block_of(b->half, number);
    const size_t lanes = (size_t)b->l->block, first = number * lanes;
    lanes_block_see(block, s->landing.ends, s->landing.t);
    lanes_block_see(&half, true, s->landing.t);
    lanes_companion *list[BLOCK_MAX];
    bool observed[BLOCK_MAX];
    for (size_t i = 0; i < lanes; i++) {
        list[i] = first + i < b->count && isnan(block->stopped[i]) ? &b->companions[first + i] : NULL;
        observed[i] = s->landing.observed;
        if (list[i]) list[i]->landed = s->landing.t;
    }
    lanes_companion_compare(block, &half, list, observed);
}

static void end_block(const together *s, const lanes_block *block, size_t number)
{
    const lanes_item *b = s->item;
    const size_t all = (size_t)b->l->block, first = number * all, left = b->count - first;
    const size_t count = left < all ? left : all;
    lanes_block_results(block, b->call, 0, count, b->first + first, b->observations, total_of(&b->l->def));
    for (size_t i = 0; b->half && i < count; i++)
        lanes_block_errors(b->call, &b->companions[first + i], !isnan(block->stopped[i]), b->first + first + i);
}

/* ---- steps and observations ---- */

/* Tabulates the values that depend on time alone, from the present step on. */
static void fill_table(const together *s, int64_t steps)
{
    lanes_item *b = s->item;
    b->first_row = b->n;
    const lanes_block block = lanes_block_of(b, 0);
    b->l->table(&block.job, b->table, steps + 1);
}

/* Chooses the next chunk. The first step is a chunk of its own. The observation at the end belongs to no chunk. */
static void next_chunk(together *s)
{
    const lanes_item *b = s->item;
    const lanes_def *d = &b->l->def;
    const int64_t left = d->whole - b->n, every = d->every, due = every - b->n % every;
    s->steps = b->n == 0 ? 1 : left < CHUNK ? left : CHUNK;
    if (b->half && s->steps > b->due - b->n) s->steps = b->due - b->n;
    s->every = 0;
    if (!b->l->on_the_way || due > s->steps || b->n == 0) return;
    const bool end = d->last == 0 && due == left;
    if (due < every || end) {
        s->steps = due;
        s->every = end ? 0 : due;
        return;
    }
    s->steps -= s->steps % every;
    if (d->last == 0 && s->steps == left) s->steps -= every;
    s->every = every;
}

static void new_leg(lanes_item *b, double t0, double h)
{
    b->t0 = t0;
    b->h = h;
    b->n = 0;
}

/* Takes the first `steps` steps of a leg. */
static void leg(together *s, int64_t steps)
{
    lanes_item *b = s->item;
    s->every = 0;
    while (b->n < steps) {
        const int64_t left = steps - b->n;
        s->steps = b->n == 0 ? 1 : left < CHUNK ? left : CHUNK;
        fill_table(s, s->steps);
        each_block(s, run_block);
        b->n += s->steps;
    }
}

/* ---- the companions ---- */

/* Lets the companions land when the next landing is due, and at every observation. */
static void next_landing(lanes_item *b, int64_t landed)
{
    const lanes_def *d = &b->l->def;
    const int64_t due = differences_due(total_of(d), landed), next = (landed / d->every + 1) * d->every;
    b->landed_steps = landed;
    b->due = b->l->on_the_way && next < due ? next : due;
    if (b->due > total_of(d)) b->due = total_of(d);
}

/* Lands the companions at t, where the trajectories stand after `steps` steps in all, and compares them. */
static void land(together *s, int64_t steps, double t)
{
    lanes_item *b = s->item, *h = b->half;
    const int64_t count = differences_steps(steps - b->landed_steps);
    const bool ends = steps == total_of(&b->l->def);
    together half = {.item = h, .blocks = s->blocks};
    if (t != b->landed) {
        fill_table(&half, 0);
        each_block(&half, turn_block);
        new_leg(h, b->landed, (t - b->landed) / (double)count);
        leg(&half, count);
    }
    fill_table(&half, 0);
    fill_table(s, 0);
    s->landing.t = t;
    s->landing.ends = ends;
    s->landing.observed = b->l->on_the_way && (ends || steps % b->l->def.every == 0);
    each_block(s, compare_block);
    b->landed = t;
    next_landing(b, steps);
}

static void begin_companions(together *s)
{
    lanes_item *b = s->item;
    const lanes_def *d = &b->l->def;
    together half = {.item = b->half, .blocks = s->blocks};
    if (!b->half) return;
    new_leg(b->half, d->t0, d->h);
    each_block(&half, begin_block);
    for (size_t k = 0; k < b->count; k++) lanes_companion_begin(&b->companions[k], d->t0, d->until);
    b->landed = total_of(d) ? d->t0 : d->until; /* where no step leads from the start to the end, it is the end */
    land(s, 0, b->landed);
}

static motus_status observe(void *ctx, motus_error *err)
{
    together *s = ctx;
    (void)err;
    fill_table(s, 0);
    each_block(s, observe_block);
    s->item->observations++;
    return MOTUS_OK;
}

/* Observes the trajectories after whole steps. */
static double time_of(const lanes_item *b)
{
    const lanes_def *d = &b->l->def;
    const lanes_block block = lanes_block_of(b, 0);
    return b->n == d->whole && d->last == 0 ? d->until : lanes_block_time(&block, 0);
}

/* Takes the whole steps. The object makes the observations within a chunk, this function those between two chunks. */
static motus_status whole_steps(together *s)
{
    lanes_item *b = s->item;
    const lanes_def *d = &b->l->def;
    while (b->n < d->whole) {
        next_chunk(s);
        fill_table(s, s->steps);
        each_block(s, run_block);
        b->n += s->steps;
        b->observations += s->every ? s->steps / s->every : 0;
        if (b->n == 1 && b->l->on_the_way && d->every == 1 && (d->whole > 1 || d->last != 0)) observe(s, NULL);
        if (b->half && b->n == b->due) land(s, b->n, time_of(b));
        if (b->reports) lanes_item_report(b, (double)b->count * (double)b->n / (double)(d->whole + 1));
        if (lanes_item_over(b)) return MOTUS_CANCELLED;
    }
    return MOTUS_OK;
}

static void short_step(together *s)
{
    lanes_item *b = s->item;
    const lanes_block block = lanes_block_of(b, 0);
    fill_table(s, 0);
    each_block(s, begin_last_leg);
    new_leg(b, lanes_block_time(&block, 0), b->l->def.last);
    leg(s, 1);
    if (b->half) land(s, total_of(&b->l->def), b->l->def.until);
}

/* Takes all steps or none, since the observations before the end are made here and by the object. */
static motus_status advance(void *ctx, stepper_limit limit, stepper_stop *why, motus_error *err)
{
    together *s = ctx;
    lanes_item *b = s->item;
    const lanes_def *d = &b->l->def;
    (void)err;
    const motus_status status = limit.steps > 0 ? whole_steps(s) : MOTUS_OK;
    if (limit.steps > 0 && status == MOTUS_OK && d->last != 0) short_step(s);
    b->ends = limit.steps > 0 || (d->whole == 0 && d->last == 0);
    *why = b->ends ? STOP_UNTIL : STOP_STEPS;
    return status;
}

void lanes_together(lanes_item *b, size_t blocks)
{
    const lanes_def *d = &b->l->def;
    together s = {.item = b, .blocks = blocks};
    new_leg(b, d->t0, d->h);
    each_block(&s, begin_block);
    begin_companions(&s);
    const course course = {.ctx = &s,
                           .until = d->until,
                           .every = b->l->on_the_way ? d->every : 0,
                           .observes = true,
                           .advance = advance,
                           .observe = observe};
    if (course_run(&course, NULL) == MOTUS_OK) each_block(&s, end_block);
}
