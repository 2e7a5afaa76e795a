/* Lanes: the division of a call into items of many blocks, which threads compute. See lanes_parts.h.
 *
 * Invariant: the results of a trajectory do not depend on the thread that computes it.
 */
#include "machine/lanes_parts.h"

#include "machine/parallel.h"

enum { ITEM_BYTES = 256 << 10 }; /* the blocks of an item fit the second-level cache */
enum { REFILLS = 16 };  /* own clocks: blocks of trajectories that pass through the one running block of an item */
#define LITTLE_WORK 1e6 /* operations: some 0.1 ms in lanes */

/* Gives an item its part of the memory of a thread. */
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

/* Measures what a thread has for each block, and what it has once. */
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
                       double *const *errors, double *stopped, motus_error *err)
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
                    .stopped = stopped};
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
