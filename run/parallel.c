/* See parallel.h. Threads are OpenMP's; where the library is built without it, the caller does it all. */
#include "run/parallel.h"

#include <fenv.h>
#ifdef _OPENMP
#include <omp.h>
#endif

void parallel_for(int threads, size_t items, void (*body)(void *ctx, size_t item, int thread), void *ctx)
{
#ifdef _OPENMP
    if (threads > 1 && items > 1) {
        /* Threads that are kept from earlier work may have other modes than the caller. */
        fenv_t modes;
        fegetenv(&modes);
#pragma omp parallel num_threads(threads)
        {
            fenv_t own;
            fegetenv(&own);
            fesetenv(&modes);
#pragma omp for schedule(dynamic, 1)
            for (size_t k = 0; k < items; k++)
                body(ctx, k, omp_get_thread_num());
            fesetenv(&own);
        }
        return;
    }
#endif
    (void)threads;
    for (size_t k = 0; k < items; k++)
        body(ctx, k, 0);
}

int parallel_processors(void)
{
#ifdef _OPENMP
    return omp_get_num_procs();
#else
    return 1;
#endif
}
