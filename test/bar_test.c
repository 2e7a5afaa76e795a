/* Numbers with their errors in print: what is printed covers what was meant, and is not much wider. */
#include "tell/bar.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void printed_as_the_manual_says(void **state)
{
    (void)state;
    static const struct {
        double value, error;
        const char *text;
    } rows[] = {
        {0.047782398071872206, 1.3912978819141664e-06, "0.0477824 ± 1.5e-6"},
        {0.04778309565760847, 2.6e-11, "0.047783095658 ± 2.7e-11"},
        {0.04778309565760847, 3.1e-11, "0.04778309566 ± 4e-11"},
        {-0.18285602867819947, 3.61081549632436e-07, "-0.1828560 ± 5e-7"},
        {1e-6, 1.85e-5, "0 ± 2.0e-5"},
        {0, 0, "0 (exact)"},
        {-0.0, 0, "0 (exact)"},
        {-0.0, NAN, "0 ±?"},
        {2.5, 0, "2.5"},
        {2.5, NAN, "2.5 ±?"},
        {2.5, INFINITY, "—"},
        {0.229, 0.0049, "0.229 ± 0.006"},
        {1234567.4, 30, "1234570 ± 40"},
        {6.02214076e23, 1e15, "6.022140760e23 ± 1.1e15"},
        {-1.5e-9, 2e-12, "-1.5000e-9 ± 2.1e-12"},
        {9.97, 9.6e-3, "9.970 ± 0.011"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[BAR_MAX];
        assert_string_equal(bar_text(rows[i].value, rows[i].error, text), rows[i].text);
    }
}

/* The same numbers with the error in units of the last digit. */
static void digits_in_brackets(void **state)
{
    (void)state;
    static const struct {
        double value, error;
        const char *text;
    } rows[] = {
        {4.063712768871578, 4.2e-13, "4.0637127688716(5)"},
        {-4.063712768871578, 1e-13, "-4.06371276887158(11)"},
        {1.2345e-8, 3e-12, "1.2345(4)e-8"},
        {250, 3, "250(4)"},
        {6.02214076e23, 1e15, "6.022140760e23 ± 1.1e15"},
        {1e-6, 1.85e-5, "0 ± 2.0e-5"},
        {2.5, NAN, "2.5 ±?"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[BAR_MAX];
        assert_string_equal(bar_digits(rows[i].value, rows[i].error, text), rows[i].text);
    }
}

/* Whatever lies within the error of the value lies within what is printed; and that is at most 10/7 of it: a little
 * more than 3.5 units, with half a one for rounding the value, become 5. Where 0 is printed the value is another
 * error. */
static void printing_covers(void **state)
{
    (void)state;
    unsigned long random = 1;
    for (int i = 0; i < 200000; i++) {
        double part[4];
        for (int k = 0; k < 4; k++) {
            random = (random * 6364136223846793005ul + 1442695040888963407ul) & 0xfffffffffffffffful;
            part[k] = (double)(random >> 33) * 0x1p-31;
        }
        const double size = pow(10, 40 * part[0] - 20), value = (2 * part[1] - 1) * size;
        const double error = size * pow(10, -15 * part[2]) * (1 + 9 * part[3]) / 10;
        char text[BAR_MAX], *rest;
        bar_text(value, error, text);
        const long double middle = strtold(text, &rest);
        assert_int_equal(strncmp(rest, " ± ", 4), 0);
        const long double printed = strtold(rest + 4, &rest), e = error, v = value;
        if (*rest || !(fabsl(v - middle) + e <= printed * (1 + 0x1p-40L)) ||
            !(printed <= (middle == 0 ? 2 : 1) * e * (10 / 7.0L + 1e-9L)))
            fail_msg("%.17g with an error of %.17g is printed as %s", value, error, text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(printed_as_the_manual_says),
                                       cmocka_unit_test(digits_in_brackets), cmocka_unit_test(printing_covers)};
    return cmocka_run_group_tests_name("errors in print", tests, NULL, NULL);
}
