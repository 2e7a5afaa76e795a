/* The work of large models, counted and not timed: it grows no faster than they do. */
#include "api/system/system.h"
#include "lang/model/model.h"

#include "test/given.h"

/* Steps to read a chain of functions, each of which calls the one before three times, with two arguments. */
static uint32_t lowered(int functions, const char *pattern)
{
    char *text = NULL;
    size_t length;
    FILE *out = open_memstream(&text, &length);
    assert_non_null(out);
    fputs("f0(u) = sin(u)\n", out);
    for (int i = 1; i <= functions; i++) {
        fprintf(out, "f%d(u) = ", i);
        for (const char *p = pattern; *p; p++) *p == '#' ? fprintf(out, "f%d", i - 1) : fputc(*p, out);
        fputc('\n', out);
    }
    fprintf(out, "x'' = -f%d(x)\nx(0) = 1\nx'(0) = 0\nuntil 1\n", functions);
    assert_int_equal(fclose(out), 0);
    motus_system *s = given_text(text);
    const uint32_t steps = s->model->lowered;
    motus_system_destroy(s);
    free(text);
    return steps;
}

static void chains_of_functions(void **state)
{
    (void)state;
    /* n functions have at most n^2/2 calls that differ, and a call has about a dozen trees */
    static const char *const patterns[] = {"#(u) + #(u/2) + #(u)", "#(u) + #(-u) + #(u)", "max(#(0.5), #(u)) + #(2)"};
    for (size_t k = 0; k < sizeof patterns / sizeof *patterns; k++) {
        const uint32_t few = lowered(21, patterns[k]), many = lowered(42, patterns[k]);
        if (many > 4.4 * few || many > 16 * 42 * 42) fail_msg("%s: %u and %u steps", patterns[k], few, many);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(chains_of_functions)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
