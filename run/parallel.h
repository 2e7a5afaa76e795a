/* The same work on many items, by several threads. */
#ifndef RUN_PARALLEL_H
#define RUN_PARALLEL_H

#include <stddef.h>

/* body(ctx, item, thread) for every item, in any order, thread < threads. */
void parallel_for(int threads, size_t items, void (*body)(void *ctx, size_t item, int thread), void *ctx);
/* Processors that may be used. */
int parallel_processors(void);

#endif
