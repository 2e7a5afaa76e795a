/* POSIX threads. See parallel.h. After a call a thread first spins, because the next call often follows at once, and
 * then sleeps.
 *
 * Invariant: a call ends when its items are done, and waits only for threads that took an item. A thread that the
 * operating system has suspended therefore delays a call only while it holds an item; a barrier, such as OpenMP's,
 * would wait for it at every call. (OpenMP's threads also spin for milliseconds: on a computer with other load, sums
 * over a thousand pairs took ten times as long with two threads as with one.)
 */
#include "machine/parallel.h"

#include "base/platform.h"
#include "core/system.h"

#include <fenv.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <string.h>

enum { SPINS = 1 << 11 }; /* of some tens of nanoseconds, before a thread sleeps */

struct parallel_pool {
    pthread_mutex_t lock; /* guards all members below that are not atomic */
    pthread_cond_t work, end;
    atomic_uint call;   /* the number of the present call */
    atomic_size_t next; /* the next item */
    atomic_int busy;    /* threads besides the caller's that may hold an item */
    atomic_flag taken;  /* a call uses the pool */
    bool open;          /* threads may still join the present call */
    bool closing;       /* the threads shall end */
    int joined, most;   /* threads of the present call, and how many it may have */
    size_t items;
    void (*body)(void *ctx, size_t item, int thread);
    void *ctx;
    fenv_t modes;
    motus_allocator allocator;
    int count; /* of `threads`, which do not include the caller's */
    pthread_t threads[];
};

static void pause_a_moment(void)
{
#if defined __x86_64__
    __builtin_ia32_pause();
#elif defined __aarch64__
    __asm__ volatile("yield");
#endif
}

static void take_items(parallel_pool *p, int thread)
{
    for (size_t k; (k = atomic_fetch_add(&p->next, 1)) < p->items;) p->body(p->ctx, k, thread);
}

static void *run_thread(void *ctx)
{
    parallel_pool *p = ctx;
    unsigned seen = 0;
    for (;;) {
        for (int k = 0; k < SPINS && atomic_load_explicit(&p->call, memory_order_relaxed) == seen; k++)
            pause_a_moment();
        pthread_mutex_lock(&p->lock);
        while (atomic_load(&p->call) == seen && !p->closing) pthread_cond_wait(&p->work, &p->lock);
        const bool closing = p->closing;
        int thread = 0;
        seen = atomic_load(&p->call);
        if (!closing && p->open && p->joined < p->most) {
            thread = p->joined++;
            atomic_fetch_add(&p->busy, 1);
        }
        pthread_mutex_unlock(&p->lock);
        if (closing) return NULL;
        if (!thread) continue;
        fesetenv(&p->modes);
        take_items(p, thread);
        pthread_mutex_lock(&p->lock);
        if (atomic_fetch_sub(&p->busy, 1) == 1) pthread_cond_signal(&p->end);
        pthread_mutex_unlock(&p->lock);
    }
}

/* Starts the threads of a pool whose bytes are all 0. They block all signals, so that handlers run in the user's own
 * threads. */
static void open_pool(parallel_pool *p, int threads)
{
    sigset_t all, before;
    atomic_flag_clear(&p->taken);
    pthread_mutex_init(&p->lock, NULL);
    pthread_cond_init(&p->work, NULL);
    pthread_cond_init(&p->end, NULL);
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    while (p->count < threads && !pthread_create(&p->threads[p->count], NULL, run_thread, p)) p->count++;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
}

parallel_pool *parallel_pool_create(int threads, const motus_allocator *allocator)
{
    if (threads < 2) return NULL;
    parallel_pool *p = take(allocator, 1, sizeof *p + (size_t)(threads - 1) * sizeof *p->threads);
    if (!p) return NULL;
    if (allocator) p->allocator = *allocator;
    open_pool(p, threads - 1);
    return p;
}

static void close_pool(parallel_pool *p)
{
    pthread_mutex_lock(&p->lock);
    p->closing = true;
    pthread_cond_broadcast(&p->work);
    pthread_mutex_unlock(&p->lock);
    for (int k = 0; k < p->count; k++) pthread_join(p->threads[k], NULL);
    pthread_cond_destroy(&p->work);
    pthread_cond_destroy(&p->end);
    pthread_mutex_destroy(&p->lock);
}

void parallel_pool_destroy(parallel_pool *p)
{
    if (!p) return;
    close_pool(p);
    const motus_allocator allocator = p->allocator;
    give(&allocator, p);
}

void parallel_pool_for(parallel_pool *p, int threads, size_t items, void (*body)(void *ctx, size_t item, int thread),
                       void *ctx)
{
    if (!p || threads < 2 || items < 2 || atomic_flag_test_and_set(&p->taken)) {
        for (size_t k = 0; k < items; k++) body(ctx, k, 0);
        return;
    }
    pthread_mutex_lock(&p->lock);
    p->items = items;
    p->body = body;
    p->ctx = ctx;
    p->joined = 1;
    p->most = (size_t)threads < items ? threads : (int)items;
    p->open = true;
    fegetenv(&p->modes);
    atomic_store(&p->next, 0);
    atomic_fetch_add(&p->call, 1);
    pthread_cond_broadcast(&p->work);
    pthread_mutex_unlock(&p->lock);
    take_items(p, 0);
    for (int k = 0; k < SPINS && atomic_load_explicit(&p->busy, memory_order_relaxed); k++) pause_a_moment();
    pthread_mutex_lock(&p->lock);
    p->open = false;
    while (atomic_load(&p->busy)) pthread_cond_wait(&p->end, &p->lock);
    pthread_mutex_unlock(&p->lock);
    atomic_flag_clear(&p->taken);
}

void parallel_for(int threads, size_t items, void (*body)(void *ctx, size_t item, int thread), void *ctx)
{
    union {
        parallel_pool pool;
        char bytes[sizeof(parallel_pool) + MOTUS_THREADS_MAX * sizeof(pthread_t)];
    } here;
    const int most = items < (size_t)threads ? (int)items : threads;
    if (most < 2) {
        parallel_pool_for(NULL, 1, items, body, ctx);
        return;
    }
    memset(&here.pool, 0, sizeof here.pool);
    open_pool(&here.pool, most - 1);
    parallel_pool_for(&here.pool, most, items, body, ctx);
    close_pool(&here.pool);
}

int parallel_processors(void)
{
    const long count = platform_processors();
    return count < MOTUS_THREADS_MAX ? (int)count : MOTUS_THREADS_MAX;
}
