/* Lanes: one block of trajectories, and the division of a call into items of many blocks. See lanes_parts.h.
 *
 * Invariant: the results of a trajectory depend neither on its block nor on the thread that computes it. A block in
 * which a number is no longer finite takes its last steps again, one by one, to find the time.
 */
#include "machine/lanes_parts.h"

#include "machine/parallel.h"

#include <math.h>
#include <string.h>

enum { ITEM_BYTES = 256 << 10 }; /* the blocks of an item fit the second-level cache */
enum { REFILLS = 16 };  /* own clocks: blocks of trajectories that pass through the one running block of an item */
#define LITTLE_WORK 1e6 /* operations: some 0.1 ms in lanes */

/* ---- memory ---- */

/* Own parameters, numbers that depend on them, carry, records, clocks, times at which lanes stopped. */
size_t lanes_block_size(const lanes *l)
{
    return l->own_size + l->bound_size + l->carry_size + l->kept_size + l->clock_size + l->known_size + l->watch_size +
           lines(l, 1);
}

static size_t saved_size(const lanes *l)
{
    const size_t values = lines(l, l->def.place_count), saved = l->carry_size + l->clock_size;
    return saved > values ? saved : values;
}

/* Workspaces, the observed state, linear systems, the saved carry, two numbers a lane. */
size_t lanes_scratch_size(const lanes *l)
{
    return l->work_size + l->observed_size + l->solve_size + saved_size(l) + 2 * lines(l, 1);
}

void lanes_block_place(lanes_block *k, const lanes_item *b, size_t block)
{
    const lanes *l = b->l;
    lanes_job *j = &k->job;
    double *p = b->memory + block * b->call->block_size;
    j->host.own = p;
    j->host.bound = p + l->own_size;
    j->carry = p + l->own_size + l->bound_size;
    j->kept = j->carry + l->carry_size;
    j->clocks = l->clock_size ? j->kept + l->kept_size : NULL;
    if (b->call->keeps && l->known_size) {
        j->known = j->clocks + l->clock_size;
        j->fresh = (bool *)(void *)(j->known + lines(l, l->def.model->nv));
    }
    k->stopped = p + b->call->block_size - lines(l, 1);
    if (!l->watch_size) return;
    j->before = k->saved, j->before_clocks = k->saved + l->carry_size;
    j->bounds = k->stopped - l->watch_size;
    j->largest = j->bounds + lines(l, l->def.model->nv);
    j->shown = j->largest + lines(l, l->def.model->nx + l->def.model->nv);
    j->met = k->stopped - lines(l, 1);
}

lanes_block lanes_block_of(const lanes_item *b, size_t block)
{
    lanes *l = b->l;
    const model *m = l->def.model;
    const size_t n = (size_t)l->block;
    double *observed = b->scratch + l->work_size, *saved = observed + l->observed_size + l->solve_size;
    lanes_job j = {.nx = m->nx,
                   .nv = m->nv,
                   .stride = m->nv,
                   .t0 = b->t0,
                   .h = b->h,
                   .n = b->n,
                   .table = b->table,
                   .first_row = b->first_row,
                   .places = l->places,
                   .value_count = (int64_t)l->def.place_count,
                   .from_x = l->from_x,
                   .from_v = l->from_v,
                   .x0 = m->x0,
                   .v0 = m->v0,
                   .record_count = (int64_t)l->def.source_count,
                   .out_size = l->outs,
                   .first_observation = b->observations == 0,
                   .ends = b->ends,
                   .until = l->def.until};
    j.relative = l->plan.relative, j.absolute = l->plan.absolute;
    j.least = l->plan.least, j.most = l->plan.most;
    j.variables = l->plan.variables, j.variable = l->plan.variable;
    j.own_size = l->own_size ? m->pool_count : 0;
    j.bound_size = l->e.fixed_lanes;
    j.host = (compiled_host){.pool = m->pool, .u = l->u, .q = l->q};
    j.room = b->scratch;
    j.x = observed;
    j.v = observed + m->nx * n;
    j.a = l->needs_a ? observed + (m->nx + m->nv) * n : NULL;
    j.out = observed + (m->nx + 2 * m->nv) * n;
    j.solving = (char *)(observed + l->observed_size);
    j.lost = saved + saved_size(l);
    j.where = j.lost + lines(l, 1);
    lanes_block made = {.l = l, .job = j, .saved = saved};
    lanes_block_place(&made, b, block);
    return made;
}

void lanes_block_save(const lanes_block *k)
{
    const lanes *l = k->l;
    memcpy(k->saved, k->job.carry, l->carry_size * sizeof(double));
    if (k->job.clocks) memcpy(k->saved + l->carry_size, k->job.clocks, l->clock_size * sizeof(double));
}

void lanes_block_forget(const lanes_block *k, size_t lane)
{
    if (k->job.fresh) k->job.fresh[lane / (size_t)k->l->width] = false;
}

void lanes_block_put_back(const lanes_block *k, size_t lane)
{
    const lanes *l = k->l;
    lanes_block_forget(k, lane);
    for (size_t n = 0; n < l->carried; n++)
        k->job.carry[lane_at(l, l->carried, n, lane)] = k->saved[lane_at(l, l->carried, n, lane)];
    for (size_t n = 0; k->job.clocks && n < LANES_CLOCKS; n++) {
        const size_t at = lane_at(l, LANES_CLOCKS, n, lane);
        k->job.clocks[at] = k->saved[l->carry_size + at];
    }
}

/* ---- the start ---- */

/* The values that vary, and the pool in every lane that has one of its own. */
static inline void begin_values(const lanes_block *block, const lanes_item *b, const size_t *trajectories, size_t width)
{
    const lanes *l = block->l;
    const model *m = l->def.model;
    const size_t count = l->def.place_count, numbers = l->own_size ? m->pool_count : 0;
    double *restrict values = block->saved, *restrict own = block->job.host.own;
    for (size_t g = 0; g < (size_t)l->groups; g++) {
        for (size_t k = 0; k < count; k++, values += width)
            for (size_t i = 0; i < width; i++) values[i] = b->call->values[k][trajectories[g * width + i]];
        for (size_t k = 0; k < l->reads; k++) {
            double *restrict to = own + (g * numbers + l->read[k]) * width;
            const double number = m->pool[l->read[k]];
            for (size_t i = 0; i < width; i++) to[i] = number;
        }
    }
}

void lanes_block_number(const lanes_block *block, const lanes_item *b, const size_t *trajectories)
{
    const lanes *l = block->l;
    lanes_job j = block->job;
    double *values = block->saved;
    switch (l->width) { /* with its number known, a lane takes an instruction or less */
    case 8: begin_values(block, b, trajectories, 8); break;
    case 4: begin_values(block, b, trajectories, 4); break;
    case 2: begin_values(block, b, trajectories, 2); break;
    default: begin_values(block, b, trajectories, (size_t)l->width);
    }
    j.values = values;
    l->begin(&j);
}

void lanes_block_begin(const lanes_block *block, const lanes_item *b, const size_t *trajectories)
{
    lanes_block_number(block, b, trajectories);
    for (size_t i = 0; i < (size_t)block->l->block; i++) block->stopped[i] = NAN;
    block->l->set(&block->job);
}

/* ---- lanes that are no longer finite ---- */

/* Whether a number of a block, in which every lane has so many elements, is NaN or as large as the limit. */
static bool some_far(const lanes *l, const double *numbers, size_t elements, double limit)
{
    return l->far(numbers, elements * (size_t)l->groups, limit);
}

static bool lane_finite(const lanes *l, const double *numbers, size_t elements, size_t lane)
{
    double none = 0;
    for (size_t k = 0; k < elements; k++)
        none += numbers[lane_at(l, elements, k, lane)] - numbers[lane_at(l, elements, k, lane)];
    return none == 0;
}

double lanes_block_time(const lanes_block *b, size_t lane)
{
    const lanes_job *j = &b->job;
    work w = {.carried = b->l->plan.carried, .t0 = j->t0, .h = j->h, .n = j->n};
    if (j->clocks) {
        double own[LANES_CLOCKS];
        for (size_t k = 0; k < LANES_CLOCKS; k++) own[k] = j->clocks[lane_at(b->l, LANES_CLOCKS, k, lane)];
        w.t0 = own[LANES_T0], w.h = own[LANES_H], w.n = (int64_t)own[LANES_N];
        w.t = own[LANES_T], w.lost = own[LANES_LOST];
    }
    return time_now(&w);
}

void lanes_block_stop(const lanes_block *b)
{
    const lanes *l = b->l;
    if (!some_far(l, b->job.carry, l->carried, INFINITY)) return;
    for (size_t i = 0; i < (size_t)l->block; i++)
        if (isnan(b->stopped[i]) && !lane_finite(l, b->job.carry, l->carried, i))
            b->stopped[i] = lanes_block_time(b, i);
}

/* The observed state may stop being finite one step before the carry does. In lanes that are not observed now it holds
 * no valid numbers. */
void lanes_block_observe(const lanes_block *b)
{
    const lanes *l = b->l;
    const lanes_job *j = &b->job;
    const size_t nx = l->def.model->nx, nv = l->def.model->nv;
    l->observe(j);
    if (!some_far(l, j->x, nx, INFINITY) && !some_far(l, j->v, nv, INFINITY)) return;
    for (size_t i = 0; i < (size_t)l->block; i++)
        if (isnan(b->stopped[i]) && (!j->clocks || j->where[i] != 0) &&
            !(lane_finite(l, j->x, nx, i) && lane_finite(l, j->v, nv, i)))
            b->stopped[i] = lanes_block_time(b, i);
}

/* What is observed may overflow before what the steps carry does: Verlet's velocity is d/h. */
#define NEAR_OVERFLOW 1e200

bool lanes_block_diverged(const lanes_block *b)
{
    const lanes *l = b->l;
    const double *carry = b->job.carry;
    if (!some_far(l, carry, l->carried, NEAR_OVERFLOW)) return false;
    for (size_t i = 0; i < (size_t)l->block; i++)
        for (size_t k = 0; isnan(b->stopped[i]) && k < l->carried; k++)
            if (!(fabs(carry[lane_at(l, l->carried, k, i)]) < NEAR_OVERFLOW)) return true;
    return false;
}

void lanes_block_trace(const lanes_block *block, bool first, int64_t steps, int64_t n, int64_t every)
{
    const lanes *l = block->l;
    lanes_block b = *block;
    b.job.carry = b.saved;
    if (b.job.clocks) b.job.clocks = b.saved + l->carry_size;
    b.job.record_count = 0;
    b.job.ends = false;
    lanes_block_stop(&b);
    for (int64_t k = 0; k < steps; k++) {
        if (every && (n + k) % every == 0) lanes_block_observe(&b);
        double before[BLOCK_MAX];
        for (size_t i = 0; l->plan.solves && i < (size_t)l->block; i++) before[i] = lanes_block_time(&b, i);
        if (first)
            l->first(&b.job);
        else
            l->run(&b.job, 1, 0);
        /* an equation that could not be solved stops its lane before the step */
        for (size_t i = 0; l->plan.solves && i < (size_t)l->block; i++)
            if (isnan(b.stopped[i]) && isnan(b.job.lost[i])) b.stopped[i] = before[i];
        b.job.n++;
        lanes_block_stop(&b);
    }
}

/* ---- the end ---- */

/* Of a trajectory that has come to its end by so many steps. */
static tally tally_of_lane(const lanes_block *b, size_t lane, int64_t steps)
{
    const lanes *l = b->l;
    tally t = {.steps = steps, .accuracy = NAN, .shortest = NAN, .longest = NAN};
    t.tolerance = tally_tolerance(l->def.chosen);
    if (!l->plan.carried) {
        if (steps > 0) t.shortest = t.longest = fabs(l->def.h);
        return t;
    }
    double own[LANES_CLOCKS];
    for (size_t k = 0; k < LANES_CLOCKS; k++) own[k] = b->job.clocks[lane_at(l, LANES_CLOCKS, k, lane)];
    t.refused = (int64_t)own[LANES_REFUSED];
    if (own[LANES_LONGEST] > 0) t.shortest = own[LANES_SHORTEST], t.longest = own[LANES_LONGEST];
    tally_evaluations(&l->plan, &t);
    return t;
}

/* The numbers of one record. A group's lanes lie side by side. */
static void write_record(const lanes_block *b, size_t r, size_t from, size_t to, double *results, int64_t observations)
{
    const lanes *l = b->l;
    const size_t elements = l->def.source_count * REDUCE_KEPT, width = (size_t)l->width;
    const int how = l->def.sources[r].how;
    for (size_t i = from; i < to;) {
        const double *at = &b->job.kept[lane_at(l, elements, r * REDUCE_KEPT, i)];
        size_t count = width - (i & (width - 1));
        if (count > to - i) count = to - i;
        for (size_t k = 0; how == REDUCE_FINAL && k < count; k++) results[k] = at[k];
        for (size_t k = 0; how != REDUCE_FINAL && k < count; k++)
            results[k] = reduce_last((double[REDUCE_KEPT]){at[k], at[k + width]}, how, (double)observations);
        i += count;
        results += count;
    }
}

void lanes_block_results(const lanes_block *b, const lanes_call *c, size_t from, size_t to, size_t trajectory,
                         int64_t observations, int64_t steps)
{
    const lanes_def *d = &b->l->def;
    for (size_t r = 0; r < d->source_count; r++)
        write_record(b, r, from, to, c->results[d->sources[r].result] + trajectory, observations);
    for (size_t i = from; d->tally_count && i < to; i++) {
        const tally taken = tally_of_lane(b, i, steps);
        for (size_t k = 0; k < d->tally_count; k++)
            c->results[d->tallies[k].result][trajectory + i - from] = tally_number(&taken, d->tallies[k].which);
    }
    for (size_t i = from; i < to; i++) {
        if (isnan(b->stopped[i])) continue;
        for (size_t r = 0; r < d->source_count; r++) c->results[d->sources[r].result][trajectory + i - from] = NAN;
        for (size_t k = 0; k < d->tally_count; k++) c->results[d->tallies[k].result][trajectory + i - from] = NAN;
    }
    for (size_t i = from; i < to; i++)
        c->ends[trajectory + i - from] = isnan(b->stopped[i]) ? LANES_ARRIVED : LANES_STOPPED;
    if (c->stopped) memcpy(c->stopped + trajectory, b->stopped + from, (to - from) * sizeof *c->stopped);
}

void lanes_block_see(const lanes_block *b, bool ends, double t)
{
    lanes_job j = b->job;
    j.record_count = 0;
    j.ends = ends;
    j.until = t;
    b->l->observe(&j);
}

void lanes_item_report(lanes_item *b, double more)
{
    lanes_call *c = b->call;
    const lanes_def *d = &b->l->def;
    const double fraction = ((double)atomic_load(&c->done) + more) / (double)c->count;
    if (d->progress(d->context, fraction < 1 ? fraction : 1)) atomic_store(&c->cancelled, true);
}

bool lanes_item_over(const lanes_item *b) { return atomic_load(&b->call->cancelled) || atomic_load(&b->call->refused); }

/* ---- all trajectories ---- */

/* Gives an item its memory, which begins here. */
static void place_item(lanes_item *b, double *memory)
{
    b->memory = memory;
    b->scratch = memory + b->call->blocks * b->call->block_size;
    b->table = b->scratch + b->call->scratch_size;
}

/* Computes one item from start to end, in the memory of its thread. */
static void run_item(void *ctx, size_t item, int thread)
{
    lanes_call *c = ctx;
    lanes *l = c->l;
    lanes_item b = {.l = l, .call = c, .first = item * c->most, .thread = thread}, half;
    if (lanes_item_over(&b)) return;
    b.count = c->count - b.first < c->most ? c->count - b.first : c->most;
    double *memory = c->memory + (size_t)thread * c->thread_size;
    place_item(&b, memory);
    if (c->half) {
        half = (lanes_item){.l = l->half, .call = c->half, .first = b.first, .count = b.count};
        place_item(&half, b.table + c->table_size);
        b.half = &half;
        b.companions = lanes_companion_place(l, half.table + c->half->table_size, c->companions);
    }
    b.reports = thread == 0 && l->def.progress; /* only the caller's thread calls the caller's hook */
    if (l->def.follower) {
        lanes_watched(&b);
    } else if (l->def.own_clock) {
        lanes_apart(&b);
    } else {
        lanes_together(&b, (b.count + (size_t)l->block - 1) / (size_t)l->block);
        atomic_fetch_add(&c->done, b.count);
    }
    if (b.reports) lanes_item_report(&b, 0);
}

/* The sizes of what a thread has for each block, and once. */
static void measure(lanes_call *c)
{
    const lanes *l = c->l;
    c->block_size = lanes_block_size(l);
    c->scratch_size = lanes_scratch_size(l);
    c->table_size = l->def.follower    ? lanes_watched_size(l)
                    : l->def.own_clock ? lanes_apart_size(l)
                                       : ((size_t)l->e.moments * l->e.terms * (CHUNK + 1 + 8 + 8) + 7) / 8 * 8;
}

/* Divides the trajectories into items: several for each thread, to balance the load, but none whose blocks exceed the
 * cache. */
static void divide_work(lanes_call *c, size_t threads)
{
    const lanes *l = c->l;
    const size_t block = (size_t)l->block, all = (c->count + block - 1) / block,
                 share = (all + 4 * threads - 1) / (4 * threads);
    lanes_call *half = c->half;
    measure(c);
    if (half) measure(half);
    const size_t size = c->block_size + (half ? half->block_size + lanes_companion_size(l, block) : 0);
    c->blocks = l->def.follower ? 1 : l->def.own_clock ? lanes_apart_blocks() : ITEM_BYTES / sizeof(double) / size;
    size_t most = l->def.own_clock ? REFILLS : c->blocks;
    if (most > share) most = share;
    if (most == 0) most = 1;
    if (!l->def.own_clock) c->blocks = most;
    c->most = most * block;
    c->items = (all + most - 1) / most;
    c->thread_size = c->blocks * c->block_size + c->scratch_size + c->table_size;
    if (!half) return;
    half->blocks = c->blocks;
    c->companions = c->blocks * block;
    c->thread_size += c->blocks * half->block_size + half->scratch_size + half->table_size;
    c->thread_size += lanes_companion_size(l, c->companions);
}

motus_status lanes_run(lanes *l, size_t count, const double *const *values, const double *until, double *const *results,
                       double *const *errors, double *stopped, unsigned char *ends, motus_error *err)
{
    const lanes_def *d = &l->def;
    /* Threads take longer to start than a little work takes. */
    const bool little = !d->own_clock && (double)count * (double)(d->whole + 10) * d->model->graph->count < LITTLE_WORK;
    size_t threads = little ? 1 : (size_t)d->threads;
    lanes_call c = {.l = l,
                    .count = count,
                    .values = values,
                    .until = until,
                    .results = results,
                    .errors = errors,
                    .stopped = stopped,
                    .ends = ends};
    lanes_call half = {.l = l->half, .count = count, .values = values, .until = until};
    if (errors) c.half = &half;
    c.keeps = half.keeps = errors != NULL || d->follower;
    divide_work(&c, threads);
    if (threads > c.items) threads = c.items;
    double *memory = take(d->allocator, threads * c.thread_size + ALIGNMENT / sizeof(double), sizeof(double));
    if (!memory)
        return fail(err, MOTUS_MEMORY, "no memory for %zu trajectories at once", threads * c.blocks * (size_t)l->block);
    c.memory = memory + (ALIGNMENT - (uintptr_t)memory % ALIGNMENT) % ALIGNMENT / sizeof(double);
    parallel_for((int)threads, c.items, run_item, &c);
    give(d->allocator, memory);
    if (atomic_load(&c.cancelled)) return fail(err, MOTUS_CANCELLED, "cancelled");
    return atomic_load(&c.refused) || atomic_load(&half.refused) ? MOTUS_METHOD : MOTUS_OK;
}
