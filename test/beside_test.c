/* A thread that computes beside a compiler rests nine tenths of the time where others want its processor, and only
 * there. The clock and the processor are those of this test. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <time.h>

#include <cmocka.h>

/* Seconds; `taken`: how often others had the processor. */
static double wall, computed;
static long taken;
static void test_clock(struct timespec *t)
{
    t->tv_sec = (time_t)wall;
    t->tv_nsec = (long)(1e9 * (wall - (double)t->tv_sec));
}
static bool test_thread(double *seconds, int64_t *displaced)
{
    *seconds = computed, *displaced = taken;
    return true;
}
#define clock_gettime(clock, t) test_clock(t)
#define platform_thread(seconds, displaced) test_thread(seconds, displaced)
#define nanosleep(t, left) (wall += 1e-9 * (double)(t)->tv_nsec)
#include "machine/beside.c"
#undef clock_gettime
#undef platform_thread
#undef nanosleep

/* Works for so long, while others take the processor away so often; returns for how long it then rests. */
static double works(beside *b, double seconds, long displaced)
{
    const double before = b->rested;
    wall += seconds;
    computed += seconds;
    taken += displaced;
    beside_rest(b);
    return b->rested - before;
}

static void a_crowded_thread_rests(void **state)
{
    (void)state;
    const double piece = 0.0011;
    beside b = {.looked = 0};
    wall = 100, computed = 7, taken = 3;
    for (int k = 0; k < 1000; k++) /* taken away a few times a second */
        if (works(&b, piece, k % 100 == 0) != 0) fail_msg("it rests at piece %d, although nobody computes", k);
    assert_false(b.crowded);
    for (int k = 0; k < 10; k++) works(&b, piece, 1);
    assert_true(b.crowded);
    const double rested = b.rested, until = wall;
    for (int k = 0; k < 20; k++) assert_true(fabs(works(&b, piece, 0) - 9 * piece) < 1e-5);
    assert_true(fabs(wall - until - 20 * piece - (b.rested - rested)) <
                1e-4);                         /* it was asleep for as long as it says */
    assert_true(works(&b, piece / 4, 0) == 0); /* it looks once a millisecond */
    assert_true(fabs(works(&b, 10, 0) - BESIDE_REST_MOST) < 1e-12);
    for (int k = 0; k < 1000; k++) works(&b, piece, 1);
    assert_true(b.rested >= BESIDE_REST_ALL && b.rested < BESIDE_REST_ALL + BESIDE_REST_MOST);
}
int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_crowded_thread_rests)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
