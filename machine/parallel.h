/* Work in independent pieces, by several threads: the one way in which this library uses more than one core.
 *
 * Invariant: a piece is done once, by one thread, in the caller's floating-point modes; which thread does it, and
 * when, is left to chance. So whoever writes only to what belongs to a piece, or to a thread, gets the same bits from
 * any number of threads.
 */
#ifndef MACHINE_PARALLEL_H
#define MACHINE_PARALLEL_H

#include "motus.h"

#include <stddef.h>

/* body(ctx, item, thread) for item = 0 … items - 1; the next free thread takes the next item. `thread` is 0 … threads
 * - 1, and 0 is the caller's own: two pieces that see the same number are never at work at once. Comes back when all
 * is done. Threads that cannot be had are done without. */
void parallel_for(int threads, size_t items, void (*body)(void *ctx, size_t item, int thread), void *ctx);

/* Threads that wait for the next work, for those who have much of it in small portions. NULL: none can be had. */
typedef struct parallel_crew parallel_crew;
parallel_crew *parallel_hire(int threads, const motus_allocator *);
void parallel_dismiss(parallel_crew *);
/* As parallel_for, by the caller and his crew (NULL: the caller alone). Who calls while others have the crew does his
 * work alone. */
void parallel_by(parallel_crew *, int threads, size_t items, void (*body)(void *ctx, size_t item, int thread),
                 void *ctx);

/* Processors that may be used, up to MOTUS_THREADS_MAX; 1 where that is not known. */
int parallel_processors(void);

#endif
