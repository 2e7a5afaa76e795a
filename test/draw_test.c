/* The random numbers: the published words, the distributions, independent streams. */
#include "cli/model/draw.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* The known answers published with Random123 for philox4x32, 10 rounds [Salmon11]. */
static void test_known_answers(void **context)
{
    (void)context;
    static const struct {
        uint32_t counter[4], key[2], words[4];
    } known[] = {
        {{0, 0, 0, 0}, {0, 0}, {0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}},
        {{0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff},
         {0xffffffff, 0xffffffff},
         {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}},
        {{0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344},
         {0xa4093822, 0x299f31d0},
         {0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}},
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        uint32_t words[4];
        draw_philox(known[i].counter, known[i].key, words);
        assert_memory_equal(words, known[i].words, sizeof words);
    }
}

/* The bits of a uniform number are fixed, since another release may resume a file of today. */
static void test_layout(void **context)
{
    (void)context;
    uint32_t counter[4] = {7, 1, 3, 0}, key[2] = {5, 2}, words[4];
    draw_philox(counter, key, words);
    uint64_t word = (uint64_t)words[1] << 32 | words[0];
    assert_true(draw_uniform((uint64_t)2 << 32 | 5, 3, (uint64_t)1 << 32 | 7) ==
                (double)(word >> 11) / 9007199254740992.0);
}

static int order(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

enum { N = 200000 };

/* Kolmogorov's distance times √N exceeds 1.95 with probability 2 exp(-2·1.95²) = 0.001; the seeds are fixed, so the
 * test is deterministic. */
static void judge(double (*draw)(uint64_t, uint32_t, uint64_t), double (*below)(double))
{
    static double values[N];
    for (uint64_t seed = 0; seed < 3; seed++) {
        double most = 0;
        for (int i = 0; i < N; i++) values[i] = draw(seed, 1, (uint64_t)i);
        qsort(values, N, sizeof *values, order);
        for (int i = 0; i < N; i++) {
            double p = below(values[i]);
            most = fmax(most, fmax(p - (double)i / N, (double)(i + 1) / N - p));
        }
        assert_true(most * sqrt(N) < 1.95);
    }
}

static double below_uniform(double x) { return x; }
static double below_normal(double x) { return 0.5 * erfc(-x / sqrt(2)); }

static void test_uniform(void **context)
{
    (void)context;
    judge(draw_uniform, below_uniform);
}

static void test_normal(void **context)
{
    (void)context;
    judge(draw_normal, below_normal);
}

static double correlation(double (*draw)(uint64_t, uint32_t, uint64_t), uint64_t seed, uint32_t stream, uint64_t ahead)
{
    double xy = 0, x = 0, y = 0, xx = 0, yy = 0;
    for (int i = 0; i < N; i++) {
        double a = draw(0, 0, (uint64_t)i), b = draw(seed, stream, (uint64_t)i + ahead);
        x += a / N;
        y += b / N;
        xy += a * b / N;
        xx += a * a / N;
        yy += b * b / N;
    }
    return (xy - x * y) / sqrt((xx - x * x) * (yy - y * y));
}

/* The correlation of independent numbers is within 4/√N. */
static void test_independent(void **context)
{
    (void)context;
    double (*const draws[])(uint64_t, uint32_t, uint64_t) = {draw_uniform, draw_normal};
    for (int i = 0; i < 2; i++) {
        assert_true(fabs(correlation(draws[i], 1, 0, 0)) < 4 / sqrt(N));
        assert_true(fabs(correlation(draws[i], (uint64_t)1 << 32, 0, 0)) < 4 / sqrt(N));
        assert_true(fabs(correlation(draws[i], 0, 1, 0)) < 4 / sqrt(N));
        assert_true(fabs(correlation(draws[i], 0, 0, 1)) < 4 / sqrt(N));
        assert_true(correlation(draws[i], 0, 0, 0) > 0.999);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_known_answers), cmocka_unit_test(test_layout),      cmocka_unit_test(test_uniform),
        cmocka_unit_test(test_normal),        cmocka_unit_test(test_independent),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
