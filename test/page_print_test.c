/* The page's snprintf, qsort and strstr (lab/core/) against the C library's: the same characters for every conversion
 * that the library asks for, the same order, the same place. */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#undef snprintf
#undef vsnprintf
#undef qsort
#undef strstr
#define snprintf page_snprintf
#define vsnprintf page_vsnprintf
#define qsort page_qsort
#define strstr page_strstr
int page_vsnprintf(char *, size_t, const char *, va_list);
int page_snprintf(char *, size_t, const char *, ...) __attribute__((format(printf, 3, 4)));
void page_qsort(void *, size_t, size_t, int (*)(const void *, const void *));
char *page_strstr(const char *, const char *);
#include "lab/core/print.c"
#include "lab/core/sort.c"
#undef snprintf
#undef vsnprintf
#undef qsort
#undef strstr

#define SAME(...)                                                               \
    do {                                                                        \
        char ours[800], theirs[800];                                            \
        const int length = page_snprintf(ours, sizeof ours, __VA_ARGS__);       \
        assert_int_equal(length, snprintf(theirs, sizeof theirs, __VA_ARGS__)); \
        assert_string_equal(ours, theirs);                                      \
    } while (0)

static uint64_t next(uint64_t *seed)
{
    *seed ^= *seed << 13;
    *seed ^= *seed >> 7;
    return *seed ^= *seed << 17;
}

static void numbers(double x)
{
    for (int digits = 0; digits <= 18; digits++) {
        SAME("%.*g", digits, x);
        SAME("%.*e", digits, x);
        SAME("%.*f", digits, x);
    }
    SAME("%g %+g %e %f", x, x, x, x);
}

static void test_numbers(void **state)
{
    (void)state;
    const double hard[] = {0,    -0.0, 0.5,       1.5,  2.5,    0.125,   9.5,      99.5,      999999.5, 99999.95, 48500,
                           1e15, 1e-4, 9.9999e-5, 1e-5, 5e-324, DBL_MAX, INFINITY, -INFINITY, NAN,      0x1p-1022};
    for (size_t k = 0; k < sizeof hard / sizeof *hard; k++) numbers(hard[k]);
    uint64_t seed = 88172645463325252;
    for (int k = 0; k < 20000; k++) {
        const uint64_t bits = next(&seed);
        double any;
        memcpy(&any, &bits, sizeof any);
        numbers(k % 2 ? any : (double)(int64_t)(bits % 2000 - 1000) * pow(10, k % 30 - 15));
    }
}

static void test_texts(void **state)
{
    (void)state;
    SAME("%d %d %+d %lld %+lld %u %zu %lu", 0, -2147483647 - 1, 7, (long long)INT64_MIN, 5LL, 4000000000U, (size_t)99,
         77UL);
    SAME("%x %04X %02X %016llx %013llx", 0xABCU, 0xE9U, 5U, (unsigned long long)UINT64_MAX, 0x1234567890ULL);
    SAME("%s|%.3s|%.*s|%c|%%|%5s|%*s", "abc", "abcdef", 2, "xyz", 'q', "ab", 6, "uv");
    char cut[5];
    assert_int_equal(page_snprintf(cut, sizeof cut, "%s", "abcdefgh"), 8);
    assert_string_equal(cut, "abcd");
    assert_int_equal(page_snprintf(NULL, 0, "%d", 123), 3);
}

static int ascending(const void *a, const void *b)
{
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

static void test_sort(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (size_t count = 0; count < 200; count++) {
        uint32_t ours[200], theirs[200];
        for (size_t k = 0; k < count; k++) ours[k] = theirs[k] = (uint32_t)(next(&seed) % (1 + count));
        page_qsort(ours, count, sizeof *ours, ascending);
        qsort(theirs, count, sizeof *theirs, ascending);
        assert_memory_equal(ours, theirs, count * sizeof *ours);
    }
}

static void test_find(void **state)
{
    (void)state;
    const char *text = "aabaabaac";
    const char *const parts[] = {"", "a", "aac", "aabaac", "c", "d", "aabaabaacc"};
    for (size_t k = 0; k < sizeof parts / sizeof *parts; k++)
        assert_ptr_equal(page_strstr(text, parts[k]), strstr(text, parts[k]));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_numbers), cmocka_unit_test(test_texts),
                                       cmocka_unit_test(test_sort), cmocka_unit_test(test_find)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
