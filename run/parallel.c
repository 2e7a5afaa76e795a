/* See parallel.h. */
#include "run/parallel.h"

void parallel_for(int threads, size_t items, void (*body)(void *ctx, size_t item, int thread), void *ctx)
{
    (void)threads;
    for (size_t k = 0; k < items; k++)
        body(ctx, k, 0);
}

int parallel_processors(void) { return 1; }
