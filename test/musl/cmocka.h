/* What the tests use of cmocka, for a C library for which nobody packages it: musl. It says each case in TAP. */
#ifndef CMOCKA_H
#define CMOCKA_H

#include <inttypes.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

struct CMUnitTest {
    const char *name;
    void (*test_func)(void **state);
    int (*setup_func)(void **state), (*teardown_func)(void **state);
    void *initial_state;
};
#define cmocka_unit_test(test) cmocka_unit_test_setup_teardown(test, NULL, NULL)
#define cmocka_unit_test_setup_teardown(test, setup, teardown) \
    {                                                          \
#test, test, setup, teardown, NULL                     \
    }

/* One for all files of a program, so that a case ends wherever it fails. */
__attribute__((weak)) jmp_buf cmocka_end;
enum { CMOCKA_FAILED = 1, CMOCKA_SKIPPED };

__attribute__((format(printf, 3, 4))) static inline void cmocka_leave(const char *file, int line, const char *why, ...)
{
    va_list more;
    va_start(more, why);
    printf("# %s:%d: ", file, line);
    vprintf(why, more);
    printf("\n");
    va_end(more);
    longjmp(cmocka_end, CMOCKA_FAILED);
}

static inline int _cmocka_run_group_tests(const char *name, const struct CMUnitTest *tests, size_t count,
                                          int (*setup)(void **state), int (*teardown)(void **state))
{
    static void *group;
    static size_t k, failed;
    failed = setup && setup(&group);
    printf("# %s\n1..%zu\n", name, count);
    for (k = 0; k < count; k++) {
        static void *state;
        state = tests[k].initial_state ? tests[k].initial_state : group;
        const int how = setjmp(cmocka_end);
        if (how == 0) {
            if (tests[k].setup_func && tests[k].setup_func(&state)) cmocka_leave(__FILE__, __LINE__, "its setup fails");
            tests[k].test_func(&state);
            if (tests[k].teardown_func && tests[k].teardown_func(&state))
                cmocka_leave(__FILE__, __LINE__, "its teardown fails");
        }
        failed += how == CMOCKA_FAILED;
        printf("%s %zu - %s%s\n", how == CMOCKA_FAILED ? "not ok" : "ok", k + 1, tests[k].name,
               how == CMOCKA_SKIPPED ? " # SKIP" : "");
        fflush(stdout);
    }
    if (teardown && teardown(&group)) failed++;
    return (int)failed;
}
/* A function, since a text may lie in the value of a call, which ends with the expression that has it. */
static inline void cmocka_same(const char *is, const char *due, const char *what, const char *file, int line)
{
    if (strcmp(is, due) != 0) cmocka_leave(file, line, "%s is \"%s\", not \"%s\"", what, is, due);
}
#define cmocka_run_group_tests_name(name, tests, setup, teardown) \
    _cmocka_run_group_tests(name, tests, sizeof(tests) / sizeof *(tests), setup, teardown)
#define cmocka_run_group_tests(tests, setup, teardown) cmocka_run_group_tests_name(#tests, tests, setup, teardown)
#define cmocka_set_test_filter(pattern) ((void)(pattern))

#define fail_msg(...) cmocka_leave(__FILE__, __LINE__, __VA_ARGS__)
#define _fail(file, line) cmocka_leave(file, line, "it fails")
#define fail() _fail(__FILE__, __LINE__)
#define skip() longjmp(cmocka_end, CMOCKA_SKIPPED)
#define print_message printf
#define print_error printf
#define cmocka_judge(good, text)           \
    do {                                   \
        if (!(good)) fail_msg("%s", text); \
    } while (0)
#define assert_true(c) cmocka_judge(c, #c)
#define assert_false(c) cmocka_judge(!(c), "not " #c)
#define assert_null(p) cmocka_judge((p) == NULL, #p " is NULL")
#define assert_non_null(p) cmocka_judge((p) != NULL, #p " is not NULL")
#define assert_ptr_equal(a, b) cmocka_judge((const void *)(a) == (const void *)(b), #a " is " #b)
#define assert_int_not_equal(a, b) cmocka_judge((uintmax_t)(a) != (uintmax_t)(b), #a " is not " #b)
#define assert_in_range(a, least, most)                                                       \
    cmocka_judge((uintmax_t)(a) >= (uintmax_t)(least) && (uintmax_t)(a) <= (uintmax_t)(most), \
                 #a " in " #least ".." #most)
#define assert_memory_equal(a, b, n) cmocka_judge(memcmp(a, b, n) == 0, #a " has the bytes of " #b)
#define assert_string_not_equal(a, b) cmocka_judge(strcmp(a, b) != 0, #a " is not " #b)
#define assert_int_equal(a, b)                                                                         \
    do {                                                                                               \
        const uintmax_t is = (uintmax_t)(a), due = (uintmax_t)(b);                                     \
        if (is != due) fail_msg("%s is %" PRIdMAX ", not %" PRIdMAX, #a, (intmax_t)is, (intmax_t)due); \
    } while (0)
#define assert_string_equal(a, b) cmocka_same(a, b, #a, __FILE__, __LINE__)

#endif
