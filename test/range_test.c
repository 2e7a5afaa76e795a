/* Ranges: exact ends, values equal to typed ones, exact powers of ten. */
#include "cli/model/range.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

static double decade(int p)
{
    char text[16];
    snprintf(text, sizeof text, "1e%d", p);
    return strtod(text, NULL);
}

static void test_linear(void **context)
{
    (void)context;
    range r = range_linear(0, 1, 11);
    for (int k = 0; k <= 10; k++) assert_true(range_value(&r, (uint64_t)k) == k / 10.0);
    r = range_linear(0.1, -0.7, 1000001);
    assert_true(range_value(&r, 0) == 0.1 && range_value(&r, 1000000) == -0.7);
    for (uint64_t k = 1; k <= 1000000; k += 999) assert_true(range_value(&r, k) < range_value(&r, k - 1));
    /* equal to typed values: k thousandths from -0.3 on, 0 among them */
    r = range_linear(-0.3, 0.9, 1201);
    for (int k = 0; k <= 1200; k++) {
        char text[32];
        snprintf(text, sizeof text, "%de-3", k - 300);
        assert_true(range_value(&r, (uint64_t)k) == strtod(text, NULL));
    }
    r = range_linear(3, 3, 1);
    assert_true(range_value(&r, 0) == 3);
}

static void test_decades(void **context)
{
    (void)context;
    for (int first = -140; first <= 140; first += 7)
        for (int decades = 1; decades <= 40; decades += 3)
            for (uint64_t parts = 1; parts <= 100; parts += 33) {
                range up = range_log(decade(first), decade(first + decades), (uint64_t)decades * parts + 1);
                range down = range_log(-decade(first + decades), -decade(first), (uint64_t)decades * parts + 1);
                for (int k = 0; k <= decades; k++) {
                    if (first + k == 23) /* 10^23 lies half-way between two doubles */
                        continue;
                    assert_true(range_value(&up, (uint64_t)k * parts) == decade(first + k));
                    assert_true(range_value(&down, (uint64_t)(decades - k) * parts) == -decade(first + k));
                }
            }
}

/* v^n of the value v = 2^(k/n) is 2^k, to the n half units that v may be off. */
static void test_roots(void **context)
{
    (void)context;
    for (uint64_t n = 2; n < 200; n += 3) {
        range r = range_log(1, 2, n + 1);
        for (uint64_t k = 1; k < n; k++) {
            double v = range_value(&r, k);
            /* log2 of the C library is good to 1 place here */
            assert_true(fabs(log2(v) - (double)k / (double)n) < 4e-16);
        }
    }
    range wide = range_log(1e-150, 1e150, 10000001);
    for (uint64_t k = 1; k <= 10000000; k += 99999) assert_true(range_value(&wide, k) > range_value(&wide, k - 1));
    assert_true(range_value(&wide, 5000000) == 1);
    assert_true(range_value(&wide, 10000000) == 1e150);
    range flat = range_log(7, 7, 5), one = range_log(7, 7, 1);
    assert_true(range_value(&flat, 2) == 7 && range_value(&one, 0) == 7);
    range narrow = range_log(1, 1 + 0x1p-52, 3);
    assert_true(range_value(&narrow, 1) == 1 || range_value(&narrow, 1) == 1 + 0x1p-52);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_linear), cmocka_unit_test(test_decades),
                                       cmocka_unit_test(test_roots)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
