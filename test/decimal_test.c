/* Decimals: the digits written are those of the C library, the numbers read are its doubles. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* The writer itself, which counts here how often it lets the C library print. */
static int printed;
#define snprintf(...) (printed++, (snprintf)(__VA_ARGS__))
#include "base/decimal_write.c"
#undef snprintf

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
    char fast[DECIMAL_MAX], plain[DECIMAL_MAX];
    size_t length = decimal_write(value, fast), wanted = decimal_write_plain(value, plain);
    assert_string_equal(fast, plain);
    assert_int_equal(length, wanted);
    assert_int_equal(length, strlen(fast));
    if (!isnan(value)) assert_true(strtod(fast, NULL) == value);
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

/* Every binary and decimal power with its neighbours: each entry of the tables, each change of length, both sides of
 * every boundary. */
static void test_powers(void **context)
{
    (void)context;
    for (int e = -1074; e < 1024; e++) around(ldexp(1, e));
    for (int p = -323; p <= 308; p++) {
        char text[16];
        snprintf(text, sizeof text, "1e%d", p);
        around(strtod(text, NULL));
        for (int k = 2; k < 10; k++) {
            text[0] = (char)('0' + k);
            if (strtod(text, NULL) < INFINITY) around(strtod(text, NULL));
        }
    }
}

static void test_random_bits(void **context)
{
    (void)context;
    for (int i = 0; i < 400000; i++) same(of_bits(next()));
    for (int i = 0; i < 20000; i++) same(of_bits(next() >> (12 + next() % 52))); /* below the normal numbers */
}

/* Typical numbers, typed and computed. */
static void test_usual(void **context)
{
    (void)context;
    static const double some[] = {0.0,
                                  -0.0,
                                  0.1,
                                  0.2,
                                  0.3,
                                  0.1 + 0.2,
                                  1.0 / 3,
                                  0.0001,
                                  0.00001,
                                  123456.789,
                                  999999999999999.0,
                                  1e15,
                                  1e16,
                                  1e17,
                                  1e22,
                                  1e23,
                                  9007199254740993.0,
                                  0.5,
                                  2.5,
                                  4503599627370496.5,
                                  1125899906842624.125,
                                  562949953421312.0625,
                                  99999999999999.995,
                                  9.9999999999999995e22,
                                  0x1p-1074,
                                  0x1.fffffffffffffp1023,
                                  INFINITY,
                                  -INFINITY,
                                  NAN};
    for (size_t i = 0; i < sizeof some / sizeof *some; i++) same(some[i]);
    for (int i = 0; i < 200000; i++) {
        same(uniform());
        same(2e3 * uniform() - 1e3);
        same(floor(1e4 * uniform()) / 100); /* few digits */
        same(floor(uniform() * 1e6) / 64);  /* ties */
        same(floor(uniform() * 0x1p53) / 0x1p20);
        same(floor(0x1p60 * uniform()));
    }
}

static void test_integers(void **context)
{
    (void)context;
    char out[DECIMAL_MAX], wanted[DECIMAL_MAX];
    uint64_t n = 0;
    for (int i = 0; i < 100000; i++, n = next() >> next() % 64) {
        size_t length = decimal_write_whole(n, out);
        snprintf(wanted, sizeof wanted, "%llu", (unsigned long long)n);
        assert_string_equal(out, wanted);
        assert_int_equal(length, strlen(wanted));
    }
}

/* decimal_read() gives the double of the C library (this program keeps the locale "C"), and reads all of the text. */
static void read_as(const char *text, size_t length)
{
    double value, wanted = strtod(text, NULL);
    assert_int_equal(decimal_read(text, SIZE_MAX, &value), length);
    if (memcmp(&value, &wanted, sizeof value)) fail_msg("%.60s reads as %a, not %a", text, value, wanted);
}

static void test_reading(void **context)
{
    (void)context;
    char text[1400];
    for (int i = 0; i < 100000; i++) {
        int digits = (int)(next() % 25), whole = (int)(next() % 25), n = 0;
        for (int k = 0; k < whole; k++) text[n++] = (char)('0' + next() % 10);
        if (digits > 0) text[n++] = '.';
        for (int k = 0; k < digits; k++) text[n++] = (char)('0' + (next() % 3 ? next() % 10 : 0));
        if (whole + digits == 0) text[n++] = '7';
        if (next() % 2) {
            const char *sign = next() % 2 ? "" : next() % 2 ? "+" : "-";
            n += snprintf(text + n, 16, "%c%s%d", next() % 2 ? 'e' : 'E', sign, (int)(next() % 340));
        }
        snprintf(text + n, 8, "%s", (const char *[]){"", "e", "e+", " ", ".", "x"}[next() % (digits ? 6 : 4)]);
        read_as(text, (size_t)n);
    }
    /* half way between two doubles, and with a further digit far behind: rounds up, down, and to even */
    for (int i = 0; i < 2000; i++) {
        uint64_t bits = next() % 0x7FE0000000000000u;
        double low = of_bits(bits), high = of_bits(bits + 1);
        if (low < 1e-290 || low > 1e290) continue;
        int n = snprintf(text, sizeof text, "%.0Lf", ((long double)low + (long double)high) / 2);
        if (low < 0x1p60) {
            n = snprintf(text, sizeof text, "%.1100Lf", ((long double)low + (long double)high) / 2);
            while (text[n - 1] == '0') n--;
        }
        for (int k = 0; k < (low < 0x1p60 ? 3 : 1); k++) {
            static const char *const behind[] = {"", "0000000000000000000000001", "0"};
            snprintf(text + n, sizeof text - (size_t)n, "%s", behind[k]);
            read_as(text, strlen(text));
        }
    }
}

/* What rounding has left out: with the double it is the number. */
static void test_rest(void **context)
{
    (void)context;
    static const struct {
        const char *text;
        double rest;
    } known[] = {{"0.1", -5.5511151231257827e-18},
                 {"0.3", 1.1102230246251565e-17},
                 {"1000000.85", 2.3283064365386963e-11},
                 {"0.25", 0},
                 {"1e400", 0},
                 {"1e-400", 0},
                 {"1e23", 8388608},
                 {"12345678901234567890", 722}};
    for (size_t k = 0; k < sizeof known / sizeof *known; k++) {
        double value, other, rest;
        decimal_read_between(known[k].text, SIZE_MAX, &value, &other, &rest);
        assert_true(fabs(rest - known[k].rest) <= 1e-15 * fabs(known[k].rest));
    }
    for (int i = 0; i < 10000; i++) {
        char text[48];
        double value, other, rest;
        snprintf(text, sizeof text, "%.*fe%d", (int)(next() % 17), 1e6 * uniform(), (int)(next() % 400) - 200);
        decimal_read_between(text, SIZE_MAX, &value, &other, &rest);
        assert_true(value == 0 || other == value ? rest == 0 : (rest > 0) == (other > value));
        assert_true(fabsl(strtold(text, NULL) - value - rest) <= 0x1p-63L * fabsl(value));
    }
}

static void test_reading_edges(void **context)
{
    (void)context;
    static const struct {
        const char *text;
        size_t length;
        double value;
    } edges[] = {
        {"0", 1, 0},
        {".5", 2, 0.5},
        {"5.", 2, 5},
        {"00012.50", 8, 12.5},
        {"1e400", 5, INFINITY},
        {"1e-400", 6, 0},
        {"0e999999999999999999", 20, 0},
        {"1e99999999999999999999999999", 28, INFINITY},
        {"1e-99999999999999999999999999", 29, 0},
        {"4.9e-324", 8, 0x1p-1074},
        {"2.4e-324", 8, 0},
        {"1.7976931348623159e308", 22, INFINITY},
        {"2.5e3.5", 5, 2500},
        {"1.2.3", 3, 1.2},
        {"0x10", 1, 0},
        {"1,5", 1, 1},
        {"", 0, 0},
        {".", 0, 0},
        {"-1", 0, 0},
        {"+1", 0, 0},
        {" 1", 0, 0},
        {"e5", 0, 0},
        {"inf", 0, 0},
        {"nan", 0, 0},
    };
    for (size_t i = 0; i < sizeof edges / sizeof *edges; i++) {
        double value = 0;
        assert_int_equal(decimal_read(edges[i].text, SIZE_MAX, &value), edges[i].length);
        assert_true(value == edges[i].value);
    }
    /* does not read beyond the given length */
    double value;
    assert_int_equal(decimal_read("12.5e3", 5, &value), 4);
    assert_true(value == 12.5);
    assert_int_equal(decimal_read("12", 1, &value), 1);
    assert_true(value == 1);
    /* leading and trailing zeros */
    char text[5000];
    memset(text, '0', sizeof text);
    memcpy(text + 3000, "125.", 4);
    text[4999] = 0;
    assert_int_equal(decimal_read(text, SIZE_MAX, &value), 4999);
    assert_true(value == 125);
    memset(text, '0', sizeof text);
    text[1] = '.';
    memcpy(text + 2 + 2003, "125", 3);
    memcpy(text + 4000, "e2004", 6);
    assert_int_equal(decimal_read(text, SIZE_MAX, &value), 4005);
    assert_true(value == 1.25);
    /* half way between two doubles, with one more digit a thousand places behind */
    memset(text, '0', sizeof text);
    memcpy(text, "9007199254740993.", 17);
    text[1200] = 0;
    assert_int_equal(decimal_read(text, SIZE_MAX, &value), 1200);
    assert_true(value == 9007199254740992.0);
    text[1199] = '1';
    assert_int_equal(decimal_read(text, SIZE_MAX, &value), 1200);
    assert_true(value == 9007199254740994.0);
}

static void test_whole(void **context)
{
    (void)context;
    uint64_t n;
    assert_int_equal(decimal_read_whole("18446744073709551615,", SIZE_MAX, &n), 20);
    assert_true(n == UINT64_MAX);
    assert_int_equal(decimal_read_whole("18446744073709551616", SIZE_MAX, &n), 0);
    assert_int_equal(decimal_read_whole("99999999999999999999", SIZE_MAX, &n), 0);
    assert_int_equal(decimal_read_whole("007.5", SIZE_MAX, &n), 3);
    assert_true(n == 7);
    assert_int_equal(decimal_read_whole("123", 2, &n), 2);
    assert_true(n == 12);
    assert_int_equal(decimal_read_whole("-1", SIZE_MAX, &n), 0);
    assert_int_equal(decimal_read_whole("", SIZE_MAX, &n), 0);
}

/* Checks that the fast path is taken: without it results would be right, but slow. The plain one prints. */
static void test_fast(void **context)
{
    (void)context;
    char out[DECIMAL_MAX];
    enum { NUMBERS = 20000 };
    state = 1;
    printed = 0;
    for (int i = 0; i < NUMBERS; i++) decimal_write(uniform() * 1e-3, out);
    print_message("%d of %d numbers were printed by the C library\n", printed, NUMBERS);
    assert_true(100 * printed < NUMBERS);
    printed = 0;
    decimal_write_plain(0.1, out);
    assert_true(printed > 0);
}

/* As many digits as tell times apart, and none that is rounding: 142674 steps of 0.1 end
 * at 14267.400000000001. */
static void test_times(void **context)
{
    (void)context;
    const double late = 142674 * 0.1;
    const struct {
        double t, span;
        const char *text;
    } cases[] = {{late, 20000, "14267.4"},
                 {late, late, "14267.4"},
                 {late, 1e-13, "14267.4"},
                 {late, 0.01, "14267.4"},
                 {1234567.25, 1, "1234567.25"},
                 {1.0 / 3, 1, "0.333333"},
                 {0, 0, "0"},
                 {0, 1, "0"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char out[DECIMAL_MAX];
        assert_string_equal(decimal_time(cases[k].t, cases[k].span, out), cases[k].text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_powers),        cmocka_unit_test(test_random_bits), cmocka_unit_test(test_usual),
        cmocka_unit_test(test_integers),      cmocka_unit_test(test_reading),     cmocka_unit_test(test_rest),
        cmocka_unit_test(test_reading_edges), cmocka_unit_test(test_whole),       cmocka_unit_test(test_fast),
        cmocka_unit_test(test_times),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
