/* Lanes: blocks of trajectories on their way through time. See lanes.h.
 *
 * Invariant: the results of a trajectory depend neither on the block it is in nor on who computes that. Blocks are
 * taken through time in chunks of steps, so that what depends on time alone is computed once for all of them; a block
 * in which a number stopped being finite is taken through its chunk again, step by step, to see when.
 */
#include "machine/lanes_parts.h"

#include "core/course.h"
#include "machine/parallel.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

enum { CHUNK = 512, ITEM_BYTES = 256 << 10 }; /* an item's blocks fit the second cache */
#define LITTLE_WORK 1e6                       /* operations: some 0.1 ms in lanes */

/* ---- a block ---- */

typedef struct crowd { /* all trajectories of a call */
    lanes *l;
    size_t count, blocks, most, items; /* most: blocks in one item of the work */
    const double *const *values;
    double *const *results, *stopped;
    double *memory; /* of every thread: blocks, scratch, table */
    size_t block_size, scratch_size, scaled_size, thread_size;
    atomic_size_t done;             /* items */
    atomic_bool cancelled, refused; /* refused: the row does not admit the parameters of some lane */
} crowd;

typedef struct batch { /* blocks that go through time together, in one thread */
    lanes *l;
    crowd *crowd;
    bool told;                   /* progress is reported from here */
    size_t first, count, blocks; /* trajectories; lanes too many in the last block repeat the last one */
    const double *const *values;
    double *const *results, *stopped;
    /* of blocks; of whichever block is at work; of time; of the step */
    double *memory, *scratch, *table, *scaled;
    size_t block_size;
    work plan;                       /* of the present leg; n: steps taken */
    int64_t first_row, steps, every; /* the present chunk */
    int64_t looks;                   /* recorded so far */
    bool looking;                    /* on the way, not at the end alone */
    bool ends;                       /* the look to come is the last */
} batch;

/* Element k of lane i of a block, where a group has so many elements. */
static size_t at(const lanes *l, size_t elements, size_t k, size_t i)
{
    const size_t width = (size_t)l->width;
    return (i / width * elements + k) * width + i % width;
}

static size_t trajectory(const batch *b, size_t block, size_t lane)
{
    size_t k = block * (size_t)b->l->block + lane;
    return b->first + (k < b->count ? k : b->count - 1);
}

/* A block's memory: its own parameters, what follows from them, the state, what is kept, when a lane stopped. */
static double *stopped_of(const batch *b, size_t block)
{
    return b->memory + (block + 1) * b->block_size - lines(b->l, 1);
}

static lanes_job job_of(const batch *b, size_t block)
{
    const lanes *l = b->l;
    const model *m = l->def.model;
    const size_t n = (size_t)l->block;
    double *p = b->memory + block * b->block_size, *look = b->scratch + l->work_size;
    lanes_job j = {.plan = &b->plan,
                   .table = b->table,
                   .first = b->first_row,
                   .places = l->places,
                   .value_count = (int64_t)l->def.place_count,
                   .from_x = l->from_x,
                   .from_v = l->from_v,
                   .x0 = m->x0,
                   .v0 = m->v0,
                   .record_count = (int64_t)l->def.source_count,
                   .out_size = l->outs,
                   .first_look = b->looks == 0,
                   .ends = b->ends,
                   .until = l->def.until};
    j.own_size = l->own_size ? m->pool_count : 0;
    j.bound_size = l->e.fixed_lanes;
    j.host = (compiled_host){.pool = m->pool, .u = l->u, .q = l->q, .own = p, .bound = p + l->own_size};
    j.carry = p + l->own_size + l->bound_size;
    j.kept = j.carry + l->carry_size;
    j.room = b->scratch;
    j.lost = look + l->look_size;
    j.solving = (char *)(j.lost + lines(l, 1));
    j.x = look;
    j.v = look + m->nx * n;
    j.a = l->wants_a ? look + (m->nx + m->nv) * n : NULL;
    j.out = look + (m->nx + 2 * m->nv) * n;
    return j;
}

static double *spare_of(const batch *b) { return b->scratch + b->l->work_size + b->l->look_size + b->l->solve_size; }

static void begin_block(const batch *b, size_t block)
{
    const lanes *l = b->l;
    const model *m = l->def.model;
    lanes_job j = job_of(b, block);
    double *values = spare_of(b), *stopped = stopped_of(b, block);
    const size_t width = (size_t)l->width, count = l->def.place_count;
    for (size_t g = 0; g < (size_t)l->groups; g++) {
        for (size_t k = 0; k < count; k++)
            for (size_t i = 0; i < width; i++)
                values[(g * count + k) * width + i] = b->values[k][trajectory(b, block, g * width + i)];
        for (size_t k = 0; l->own_size && k < m->pool_count; k++)
            for (size_t i = 0; i < width; i++) j.host.own[(g * m->pool_count + k) * width + i] = m->pool[k];
    }
    for (size_t i = 0; i < (size_t)l->block; i++) stopped[i] = NAN;
    j.values = values;
    l->begin(&j);
    l->set(&j);
}

static bool all_finite(const double *numbers, size_t count)
{
    int bad = 0;
    for (size_t k = 0; k < count; k++) bad |= !(numbers[k] - numbers[k] == 0);
    return !bad;
}

static bool lane_finite(const lanes *l, const double *numbers, size_t elements, size_t lane)
{
    double none = 0;
    for (size_t k = 0; k < elements; k++) none += numbers[at(l, elements, k, lane)] - numbers[at(l, elements, k, lane)];
    return none == 0;
}

/* Lanes of an array of `elements` that are not finite stop at t, if they have not stopped before. */
static void stop_lanes(const lanes *l, const double *numbers, size_t elements, double t, double *stopped)
{
    if (all_finite(numbers, elements * (size_t)l->block)) return;
    for (size_t i = 0; i < (size_t)l->block; i++)
        if (isnan(stopped[i]) && !lane_finite(l, numbers, elements, i)) stopped[i] = t;
}

/* The state as one sees it may be infinite a step before the main line is. */
static void stop_looked(const lanes *l, const lanes_job *j, double *stopped)
{
    stop_lanes(l, j->x, l->def.model->nx, time_now(j->plan), stopped);
    stop_lanes(l, j->v, l->def.model->nv, time_now(j->plan), stopped);
}

/* The chunk once more, step by step: when did which lane stop being finite? */
static void trace(const batch *b, lanes_job j, double *before, double *stopped)
{
    const lanes *l = b->l;
    work plan = b->plan;
    j.plan = &plan;
    j.carry = before;
    j.record_count = 0;
    stop_lanes(l, before, l->carried, time_now(&plan), stopped);
    for (int64_t n = 0; n < b->steps; n++) {
        if (b->looking && plan.n % l->def.every == 0) {
            l->look(&j);
            stop_looked(l, &j, stopped);
        }
        if (plan.n == 0)
            l->first(&j);
        else
            l->run(&j, 1, 0);
        if (plan.solves) /* an equation that could not be solved stops its lane before the step */
            stop_lanes(l, j.lost, 1, time_now(&plan), stopped);
        plan.n++;
        stop_lanes(l, before, l->carried, time_now(&plan), stopped);
    }
}

/* Whether a lane is no longer finite that has not stopped before: those that have are so for good, and cost their
 * neighbours no time. */
static bool lost_another(const lanes *l, const double *numbers, size_t elements, const double *stopped)
{
    if (all_finite(numbers, elements * (size_t)l->block)) return false;
    bool any = false;
    for (size_t i = 0; i < (size_t)l->block; i++) any |= isnan(stopped[i]) && !lane_finite(l, numbers, elements, i);
    return any;
}

static void run_block(const batch *b, size_t block)
{
    const lanes *l = b->l;
    lanes_job j = job_of(b, block);
    double *before = spare_of(b), *stopped = stopped_of(b, block);
    memcpy(before, j.carry, l->carry_size * sizeof(double));
    if (b->plan.n == 0)
        l->first(&j);
    else
        l->run(&j, b->steps, b->every);
    for (size_t i = 0; b->plan.solves && b->plan.n == 0 && i < (size_t)l->block; i++)
        if (isinf(j.lost[i])) atomic_store(&b->crowd->refused, true);
    if (lost_another(l, j.carry, l->carried, stopped)) trace(b, j, before, stopped);
}

static void look_at_block(const batch *b, size_t block)
{
    lanes_job j = job_of(b, block);
    b->l->look(&j);
    stop_looked(b->l, &j, stopped_of(b, block));
}

/* The shorter last step is a leg of its own, from the state at the end of the whole ones. */
static void turn_block(const batch *b, size_t block)
{
    lanes_job j = job_of(b, block);
    j.record_count = 0;
    b->l->look(&j);
    b->l->set(&j);
}

static void end_block(const batch *b, size_t block)
{
    const lanes *l = b->l;
    const lanes_job j = job_of(b, block);
    const double *stopped = stopped_of(b, block);
    for (size_t i = 0; i < (size_t)l->block && block * (size_t)l->block + i < b->count; i++) {
        const size_t k = trajectory(b, block, i), all = l->def.source_count * REDUCE_KEPT;
        for (size_t r = 0; r < l->def.source_count; r++) {
            const double kept[REDUCE_KEPT] = {j.kept[at(l, all, r * REDUCE_KEPT, i)],
                                              j.kept[at(l, all, r * REDUCE_KEPT + 1, i)]};
            b->results[r][k] = isnan(stopped[i]) ? reduce_last(kept, l->def.sources[r].how, (double)b->looks) : NAN;
        }
        if (b->stopped) b->stopped[k] = stopped[i];
    }
}

/* ---- through time ---- */

/* What depends on time alone, from the present step on. */
static void fill_table(batch *b, int64_t steps)
{
    const lanes_job j = job_of(b, 0);
    b->first_row = b->plan.n;
    b->l->table(&j, b->table, steps + 1);
}

/* How far all have come, `part` of this batch's way counted; true: enough. */
static bool tell(batch *b, double part)
{
    crowd *c = b->crowd;
    const lanes_def *d = &b->l->def;
    const double fraction = ((double)atomic_load(&c->done) + part) / (double)c->items;
    if (d->progress(d->context, fraction < 1 ? fraction : 1)) atomic_store(&c->cancelled, true);
    return atomic_load(&c->cancelled);
}

static void each_block(const batch *b, void (*body)(const batch *, size_t))
{
    for (size_t k = 0; k < b->blocks; k++) body(b, k);
}

/* The next chunk: steps to take, and how often to look on the way. The first step is a chunk of its own; the look at
 * the end is not among them. */
static void next_chunk(batch *b)
{
    const lanes_def *d = &b->l->def;
    const int64_t left = d->whole - b->plan.n, every = d->every, due = every - b->plan.n % every;
    b->steps = b->plan.n == 0 ? 1 : left < CHUNK ? left : CHUNK;
    b->every = 0;
    if (!b->looking || due > b->steps || b->plan.n == 0) return;
    const bool end = d->last == 0 && due == left;
    if (due < every || end) {
        b->steps = due;
        b->every = end ? 0 : due;
        return;
    }
    b->steps -= b->steps % every;
    if (d->last == 0 && b->steps == left) b->steps -= every;
    b->every = every;
}

/* The present leg begins at t0, with steps of h. */
static void new_leg(batch *b, double t0, double h)
{
    b->plan = b->l->plan;
    b->plan.stride = b->plan.nv;
    b->plan.scaled = b->scaled;
    b->plan.t0 = t0;
    work_scale(&b->plan, h);
}

static motus_status observe(void *ctx, motus_error *err)
{
    batch *b = ctx;
    (void)err;
    fill_table(b, 0);
    each_block(b, look_at_block);
    b->looks++;
    return MOTUS_OK;
}

/* The first step is a chunk of its own; an observation that falls between two chunks is made here, one within them by
 * the object. */
static motus_status whole_steps(batch *b)
{
    const lanes_def *d = &b->l->def;
    while (b->plan.n < d->whole) {
        next_chunk(b);
        fill_table(b, b->steps);
        each_block(b, run_block);
        b->plan.n += b->steps;
        b->looks += b->every ? b->steps / b->every : 0;
        if (b->plan.n == 1 && b->looking && d->every == 1 && (d->whole > 1 || d->last != 0)) observe(b, NULL);
        if (b->told && tell(b, (double)b->plan.n / (double)(d->whole + 1))) return MOTUS_CANCELLED;
    }
    return MOTUS_OK;
}

/* The shorter last step, a leg of its own. */
static void short_step(batch *b)
{
    fill_table(b, 0);
    each_block(b, turn_block);
    new_leg(b, time_now(&b->plan), b->l->def.last);
    b->steps = 1;
    b->every = 0;
    fill_table(b, 1);
    each_block(b, run_block);
    b->plan.n = 1;
}

/* All the way, or nothing: the object observes on its way. */
static motus_status advance(void *ctx, stepper_limit limit, stepper_stop *why, motus_error *err)
{
    batch *b = ctx;
    const lanes_def *d = &b->l->def;
    (void)err;
    const motus_status status = limit.steps > 0 ? whole_steps(b) : MOTUS_OK;
    if (limit.steps > 0 && status == MOTUS_OK && d->last != 0) short_step(b);
    b->ends = limit.steps > 0 || (d->whole == 0 && d->last == 0);
    *why = b->ends ? STOP_UNTIL : STOP_STEPS;
    return status;
}

static void through_time(batch *b)
{
    const lanes_def *d = &b->l->def;
    b->looking = false;
    for (size_t r = 0; r < d->source_count; r++) b->looking |= d->sources[r].how != REDUCE_FINAL;
    new_leg(b, d->t0, d->h);
    b->looks = 0;
    each_block(b, begin_block);
    const course course = {.ctx = b,
                           .until = d->until,
                           .every = b->looking ? d->every : 0,
                           .observes = true,
                           .advance = advance,
                           .observe = observe};
    if (course_run(&course, NULL) != MOTUS_OK) return;
    for (size_t k = 0; k < b->blocks; k++) end_block(b, k);
}

/* ---- all of them ---- */

/* One item of the work: some blocks, from the start to the end, by one thread, with memory of its own. */
static void run_item(void *ctx, size_t item, int thread)
{
    crowd *c = ctx;
    const lanes *l = c->l;
    const size_t first = item * c->most, block = (size_t)l->block;
    if (atomic_load(&c->cancelled) || atomic_load(&c->refused)) return;
    batch b = {.l = c->l,
               .crowd = c,
               .values = c->values,
               .results = c->results,
               .stopped = c->stopped,
               .block_size = c->block_size,
               .first = first * block};
    b.blocks = c->blocks - first < c->most ? c->blocks - first : c->most;
    b.count = c->count - b.first < b.blocks * block ? c->count - b.first : b.blocks * block;
    b.memory = c->memory + (size_t)thread * c->thread_size;
    b.scratch = b.memory + c->most * c->block_size;
    b.scaled = b.scratch + c->scratch_size;
    b.table = b.scaled + c->scaled_size;
    b.told = thread == 0 && l->def.progress; /* the caller's hook is called by the caller's thread */
    through_time(&b);
    atomic_fetch_add(&c->done, 1);
    if (b.told) tell(&b, 0);
}

motus_status lanes_run(lanes *l, size_t count, const double *const *values, double *const *results, double *stopped,
                       motus_error *err)
{
    const lanes_def *d = &l->def;
    const size_t spare = l->carry_size > lines(l, d->place_count) ? l->carry_size : lines(l, d->place_count);
    /* To wake threads takes longer than a little work. */
    const bool little = (double)count * (double)(d->whole + 10) * d->model->graph->count < LITTLE_WORK;
    const size_t threads = little ? 1 : (size_t)d->threads;
    crowd c = {.l = l,
               .count = count,
               .values = values,
               .results = results,
               .stopped = stopped,
               .blocks = (count + (size_t)l->block - 1) / (size_t)l->block};
    c.block_size = l->own_size + l->bound_size + l->carry_size + l->kept_size + lines(l, 1);
    c.scratch_size = l->work_size + l->look_size + l->solve_size + spare;
    c.most = ITEM_BYTES / sizeof(double) / c.block_size;
    if (c.most > (c.blocks + 4 * threads - 1) / (4 * threads)) c.most = (c.blocks + 4 * threads - 1) / (4 * threads);
    if (c.most == 0) c.most = 1;
    c.scaled_size = (work_constants(&l->plan) + 7) / 8 * 8;
    c.thread_size = c.most * c.block_size + c.scratch_size + c.scaled_size +
                    ((size_t)l->e.moments * l->e.terms * (CHUNK + 1 + 8 + 8) + 7) / 8 * 8;
    c.items = (c.blocks + c.most - 1) / c.most;
    double *memory = take(d->allocator, threads * c.thread_size + ALIGNMENT / sizeof(double), sizeof(double));
    if (!memory)
        return fail(err, MOTUS_MEMORY, "no memory for %zu trajectories at once", threads * c.most * (size_t)l->block);
    c.memory = memory + (ALIGNMENT - (uintptr_t)memory % ALIGNMENT) % ALIGNMENT / sizeof(double);
    parallel_for((int)threads, c.items, run_item, &c);
    give(d->allocator, memory);
    if (atomic_load(&c.refused)) return MOTUS_METHOD;
    return atomic_load(&c.cancelled) ? fail(err, MOTUS_CANCELLED, "cancelled") : MOTUS_OK;
}
