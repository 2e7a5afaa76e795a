/* The digits that the program writes are those of the C library, for all kinds of numbers, and cost much less. */
#include "cli/digits.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

static uint64_t state = 1;

static uint64_t next(void)
{
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return state;
}

static double uniform(void) { return (double)(next() >> 11) * 0x1p-53; }

static double of_bits(uint64_t bits)
{
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static void same(double value)
{
    char fast[DIGITS_ROOM], plain[DIGITS_ROOM];
    size_t length = digits_print(value, fast), wanted = digits_plain(value, plain);
    assert_string_equal(fast, plain);
    assert_int_equal(length, wanted);
    assert_int_equal(length, strlen(fast));
    if (!isnan(value))
        assert_true(strtod(fast, NULL) == value);
}

static void around(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    for (uint64_t d = 0; d < 9; d++) {
        same(of_bits(bits + d - 4));
        same(-of_bits(bits + d - 4));
    }
}

/* Every binary and decimal power with its neighbours: each entry of the tables, each change of length, both sides of every boundary. */
static void test_powers(void **context)
{
    (void)context;
    for (int e = -1074; e < 1024; e++)
        around(ldexp(1, e));
    for (int p = -323; p <= 308; p++) {
        char text[16];
        snprintf(text, sizeof text, "1e%d", p);
        around(strtod(text, NULL));
        for (int k = 2; k < 10; k++) {
            text[0] = (char)('0' + k);
            if (strtod(text, NULL) < INFINITY)
                around(strtod(text, NULL));
        }
    }
}

static void test_random_bits(void **context)
{
    (void)context;
    for (int i = 0; i < 400000; i++)
        same(of_bits(next()));
    for (int i = 0; i < 20000; i++)
        same(of_bits(next() >> (12 + next() % 52)));            /* below the normal numbers */
}

/* What people write and computations leave. */
static void test_usual(void **context)
{
    (void)context;
    static const double some[] = {0.0, -0.0, 0.1, 0.2, 0.3, 0.1 + 0.2, 1.0 / 3, 0.0001, 0.00001, 123456.789, 999999999999999.0, 1e15, 1e16, 1e17, 1e22,
                                  1e23, 9007199254740993.0, 0.5, 2.5, 4503599627370496.5, 1125899906842624.125, 562949953421312.0625,
                                  99999999999999.995, 9.9999999999999995e22, 0x1p-1074, 0x1.fffffffffffffp1023, INFINITY, -INFINITY, NAN};
    for (size_t i = 0; i < sizeof some / sizeof *some; i++)
        same(some[i]);
    for (int i = 0; i < 200000; i++) {
        same(uniform());
        same(2e3 * uniform() - 1e3);
        same(floor(1e4 * uniform()) / 100);                      /* few digits */
        same(floor(uniform() * 1e6) / 64);                       /* ties */
        same(floor(uniform() * 0x1p53) / 0x1p20);
        same(floor(0x1p60 * uniform()));
    }
}

static void test_integers(void **context)
{
    (void)context;
    char out[DIGITS_ROOM], wanted[DIGITS_ROOM];
    uint64_t n = 0;
    for (int i = 0; i < 100000; i++, n = next() >> next() % 64) {
        size_t length = digits_integer(n, out);
        snprintf(wanted, sizeof wanted, "%llu", (unsigned long long)n);
        assert_string_equal(out, wanted);
        assert_int_equal(length, strlen(wanted));
    }
}

static double seconds(size_t (*print)(double, char *), int count)
{
    struct timespec a, b;
    char out[DIGITS_ROOM];
    size_t length = 0;
    state = 1;
    clock_gettime(CLOCK_MONOTONIC, &a);
    for (int i = 0; i < count; i++)
        length += print(uniform() * 1e-3, out);
    clock_gettime(CLOCK_MONOTONIC, &b);
    assert_true(length > 0);
    return (double)(b.tv_sec - a.tv_sec) + 1e-9 * (double)(b.tv_nsec - a.tv_nsec);
}

/* If the short way were always unsure of itself, everything would still be right, and as slow as before. */
static void test_fast(void **context)
{
    (void)context;
    double plain = INFINITY, fast = INFINITY;
    for (int i = 0; i < 5; i++) {
        plain = fmin(plain, seconds(digits_plain, 20000));
        fast = fmin(fast, seconds(digits_print, 20000));
    }
    print_message("%.0f ns a number, the C library %.0f\n", fast / 20000 * 1e9, plain / 20000 * 1e9);
    assert_true(3 * fast < plain);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_powers), cmocka_unit_test(test_random_bits), cmocka_unit_test(test_usual),
        cmocka_unit_test(test_integers), cmocka_unit_test(test_fast),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
