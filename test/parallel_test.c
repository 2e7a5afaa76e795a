/* Pieces of work: every piece is done once, in the caller's floating-point modes, and no two threads have the same
 * number at once; with new threads, with a pool of threads that spin or sleep, and without threads. */
#include "machine/parallel.h"

#include <fenv.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <time.h>

#include <cmocka.h>

enum { ITEMS_MAX = 1000, THREADS = 8 };

typedef struct count {
    atomic_int done[ITEMS_MAX], at_work[THREADS], wrong;
    int threads, modes;
    parallel_pool *pool; /* also used within a piece of work */
    atomic_int inside;
} count;

static void inner(void *ctx, size_t item, int thread)
{
    count *c = ctx;
    (void)item;
    atomic_fetch_add(&c->inside, 1);
    if (thread != 0) atomic_store(&c->wrong, 1);
}

static void piece(void *ctx, size_t item, int thread)
{
    count *c = ctx;
    if (thread < 0 || thread >= c->threads || fegetround() != c->modes || atomic_fetch_add(&c->at_work[thread], 1))
        atomic_store(&c->wrong, 1);
    for (volatile int k = 0; k < 300; k++)
        ;
    if (c->pool && item % 100 == 3) parallel_pool_for(c->pool, c->threads, 5, inner, c);
    atomic_fetch_add(&c->done[item], 1);
    atomic_fetch_sub(&c->at_work[thread], 1);
}

static void clear(count *c, int threads) { *c = (count){.threads = threads, .modes = fegetround()}; }

static void judge(count *c, size_t items)
{
    for (size_t k = 0; k < items; k++) assert_int_equal(atomic_load(&c->done[k]), 1);
    assert_int_equal(atomic_load(&c->wrong), 0);
}

static const size_t sizes[] = {0, 1, 2, 7, ITEMS_MAX};
enum { SIZES = sizeof sizes / sizeof *sizes };
static count all;

static void every_piece_once(void **state)
{
    (void)state;
    for (int threads = 1; threads <= THREADS; threads++)
        for (size_t i = 0; i < SIZES; i++) {
            clear(&all, threads);
            parallel_for(threads, sizes[i], piece, &all);
            judge(&all, sizes[i]);
        }
}

static void a_pool_is_used_again(void **state)
{
    (void)state;
    parallel_pool *pool = parallel_pool_create(4, NULL);
    assert_non_null(pool);
    for (int round = 0; round < 300; round++) {
        if (round % 100 == 99) /* until they sleep */
            nanosleep(&(struct timespec){.tv_nsec = 20000000}, NULL);
        clear(&all, 1 + round % 4);
        parallel_pool_for(pool, 1 + round % 4, sizes[round % SIZES], piece, &all);
        judge(&all, sizes[round % SIZES]);
    }
    parallel_pool_destroy(pool);
}

static void a_pool_that_serves_another_call(void **state)
{
    (void)state;
    parallel_pool *pool = parallel_pool_create(3, NULL);
    clear(&all, 3);
    all.pool = pool;
    parallel_pool_for(pool, 3, ITEMS_MAX, piece, &all);
    judge(&all, ITEMS_MAX);
    assert_int_equal(atomic_load(&all.inside), 50);
    parallel_pool_destroy(pool);
}

static void the_callers_modes(void **state)
{
    (void)state;
    parallel_pool *pool = parallel_pool_create(4, NULL);
    const int before = fegetround();
    for (int round = 0; round < 20; round++) {
        fesetround(round % 2 ? FE_UPWARD : FE_DOWNWARD);
        clear(&all, 4);
        parallel_pool_for(pool, 4, ITEMS_MAX, piece, &all);
        fesetround(before);
        judge(&all, ITEMS_MAX);
    }
    parallel_pool_destroy(pool);
}

static void *refuse(void *context, size_t bytes) { return (void)context, (void)bytes, NULL; }
static void release(void *context, void *block) { (void)context, (void)block; }

static void without_a_pool(void **state)
{
    (void)state;
    const motus_allocator none = {.allocate = refuse, .release = release};
    assert_null(parallel_pool_create(4, &none));
    assert_null(parallel_pool_create(1, NULL));
    clear(&all, 1);
    parallel_pool_for(NULL, 4, ITEMS_MAX, piece, &all);
    judge(&all, ITEMS_MAX);
    parallel_pool_destroy(NULL);
    assert_true(parallel_processors() >= 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_piece_once), cmocka_unit_test(a_pool_is_used_again),
                                       cmocka_unit_test(a_pool_that_serves_another_call),
                                       cmocka_unit_test(the_callers_modes), cmocka_unit_test(without_a_pool)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
