/* See parallel.h. POSIX threads, which wait for a moment awake, in case there is more, and then asleep.
 *
 * Invariant: a call ends when its items are done, and waits for nobody who had none of them. So threads that other
 * programs keep from the processors cost time only while they hold an item; a barrier, such as those of OpenMP, would
 * wait for them at every call. (OpenMP's threads also wait awake, for milliseconds: on a computer that is busy
 * otherwise, sums over a thousand pairs took ten times as long with two of them.)
 */
#include "machine/parallel.h"

#include "core/system.h"

#include <fenv.h>
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <stdatomic.h>
#include <string.h>
#include <unistd.h>

enum { AWAKE = 1 << 11 }; /* looks, some tens of nanoseconds apart, before a thread sleeps */

struct parallel_crew {
    pthread_mutex_t lock; /* of all that follows but the atomic numbers */
    pthread_cond_t work, end;
    atomic_uint call;   /* changes with every call */
    atomic_size_t next; /* item */
    atomic_int busy;    /* threads, besides the caller's, that may hold an item */
    atomic_flag taken;  /* a call is going on */
    bool open, over;    /* the present call takes more threads; there will be none any more */
    int joined, most;   /* threads of the present call, and how many there may be */
    size_t items;
    void (*body)(void *ctx, size_t item, int thread);
    void *ctx;
    fenv_t modes;
    motus_allocator allocator;
    int hired;
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

static void take_items(parallel_crew *c, int thread)
{
    for (size_t k; (k = atomic_fetch_add(&c->next, 1)) < c->items;) c->body(c->ctx, k, thread);
}

static void *live(void *ctx)
{
    parallel_crew *c = ctx;
    unsigned seen = 0;
    for (;;) {
        for (int k = 0; k < AWAKE && atomic_load_explicit(&c->call, memory_order_relaxed) == seen; k++)
            pause_a_moment();
        pthread_mutex_lock(&c->lock);
        while (atomic_load(&c->call) == seen && !c->over) pthread_cond_wait(&c->work, &c->lock);
        const bool over = c->over;
        int thread = 0;
        seen = atomic_load(&c->call);
        if (!over && c->open && c->joined < c->most) {
            thread = c->joined++;
            atomic_fetch_add(&c->busy, 1);
        }
        pthread_mutex_unlock(&c->lock);
        if (over) return NULL;
        if (!thread) continue;
        fesetenv(&c->modes);
        take_items(c, thread);
        pthread_mutex_lock(&c->lock);
        if (atomic_fetch_sub(&c->busy, 1) == 1) pthread_cond_signal(&c->end);
        pthread_mutex_unlock(&c->lock);
    }
}

/* `c` is all zeros. Signals stay with the threads that the user knows. */
static void hire(parallel_crew *c, int threads)
{
    sigset_t all, before;
    atomic_flag_clear(&c->taken);
    pthread_mutex_init(&c->lock, NULL);
    pthread_cond_init(&c->work, NULL);
    pthread_cond_init(&c->end, NULL);
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    while (c->hired < threads && !pthread_create(&c->threads[c->hired], NULL, live, c)) c->hired++;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
}

parallel_crew *parallel_hire(int threads, const motus_allocator *allocator)
{
    if (threads < 2) return NULL;
    parallel_crew *c = take(allocator, 1, sizeof *c + (size_t)(threads - 1) * sizeof *c->threads);
    if (!c) return NULL;
    if (allocator) c->allocator = *allocator;
    hire(c, threads - 1);
    return c;
}

static void dismiss(parallel_crew *c)
{
    pthread_mutex_lock(&c->lock);
    c->over = true;
    pthread_cond_broadcast(&c->work);
    pthread_mutex_unlock(&c->lock);
    for (int k = 0; k < c->hired; k++) pthread_join(c->threads[k], NULL);
    pthread_cond_destroy(&c->work);
    pthread_cond_destroy(&c->end);
    pthread_mutex_destroy(&c->lock);
}

void parallel_dismiss(parallel_crew *c)
{
    if (!c) return;
    dismiss(c);
    const motus_allocator allocator = c->allocator;
    give(&allocator, c);
}

void parallel_by(parallel_crew *c, int threads, size_t items, void (*body)(void *ctx, size_t item, int thread),
                 void *ctx)
{
    if (!c || threads < 2 || items < 2 || atomic_flag_test_and_set(&c->taken)) {
        for (size_t k = 0; k < items; k++) body(ctx, k, 0);
        return;
    }
    pthread_mutex_lock(&c->lock);
    c->items = items;
    c->body = body;
    c->ctx = ctx;
    c->joined = 1;
    c->most = (size_t)threads < items ? threads : (int)items;
    c->open = true;
    fegetenv(&c->modes);
    atomic_store(&c->next, 0);
    atomic_fetch_add(&c->call, 1);
    pthread_cond_broadcast(&c->work);
    pthread_mutex_unlock(&c->lock);
    take_items(c, 0);
    for (int k = 0; k < AWAKE && atomic_load_explicit(&c->busy, memory_order_relaxed); k++) pause_a_moment();
    pthread_mutex_lock(&c->lock);
    c->open = false;
    while (atomic_load(&c->busy)) pthread_cond_wait(&c->end, &c->lock);
    pthread_mutex_unlock(&c->lock);
    atomic_flag_clear(&c->taken);
}

void parallel_for(int threads, size_t items, void (*body)(void *ctx, size_t item, int thread), void *ctx)
{
    union {
        parallel_crew crew;
        char room[sizeof(parallel_crew) + MOTUS_THREADS_MAX * sizeof(pthread_t)];
    } here;
    const int most = items < (size_t)threads ? (int)items : threads;
    if (most < 2) {
        parallel_by(NULL, 1, items, body, ctx);
        return;
    }
    memset(&here.crew, 0, sizeof here.crew);
    hire(&here.crew, most - 1);
    parallel_by(&here.crew, most, items, body, ctx);
    dismiss(&here.crew);
}

int parallel_processors(void)
{
#ifdef __linux__
    cpu_set_t mine;
    long count = sched_getaffinity(0, sizeof mine, &mine) ? sysconf(_SC_NPROCESSORS_ONLN) : CPU_COUNT(&mine);
#else
    long count = sysconf(_SC_NPROCESSORS_ONLN);
#endif
    if (count > MOTUS_THREADS_MAX) count = MOTUS_THREADS_MAX;
    return count > 1 ? (int)count : 1;
}
