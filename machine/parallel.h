/* Independent pieces of work, done by several threads: the only way in which the library uses more than one core.
 *
 * Invariant: each piece is done once, by one thread, in the caller's floating-point modes. Which thread does it, and
 * when, is not determined, so a body that writes only to memory of its piece or of its thread gives the same bits with
 * any number of threads.
 */
#ifndef MACHINE_PARALLEL_H
#define MACHINE_PARALLEL_H

#include "motus.h"

#include <stddef.h>

/* Calls body(ctx, item, thread) for item = 0 … items - 1, and returns when all calls have returned. A free thread takes
 * the next item. `thread` is 0 … threads - 1, and 0 is the caller's own; calls with the same `thread` never overlap.
 * Where fewer threads can be created, those do all the work. */
void parallel_for(int threads, size_t items, void (*body)(void *ctx, size_t item, int thread), void *ctx);

/* A pool of threads that wait from one call to the next, because creating threads costs more than a short call. The
 * caller counts as one of `threads`. NULL: fewer than two threads, or no memory. */
typedef struct parallel_pool parallel_pool;
parallel_pool *parallel_pool_create(int threads, const motus_allocator *);
void parallel_pool_destroy(parallel_pool *);
/* Does what parallel_for does, with the caller and the pool's threads. Where the pool is NULL, or serves another call,
 * the caller does all items. */
void parallel_pool_for(parallel_pool *, int threads, size_t items, void (*body)(void *ctx, size_t item, int thread),
                       void *ctx);

/* Returns how many processors this process may use, up to MOTUS_THREADS_MAX; 1 where that is not known. */
int parallel_processors(void);

#endif
