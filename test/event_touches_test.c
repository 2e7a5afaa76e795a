/* Double roots and what is near them: E8 of the reference values, whose motions are polynomials, so that a row of their
 * degree errs by rounding alone; and double roots where other events happen, as
 * roots of a condition, and beside other roots. All times are closed forms. */
#include "given.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#define PI 3.14159265358979323846
#define GRAZING "y'' = -2\ny(0) = 0\ny'(0) = 2\nuntil 2\n"
#define FLAT "x'' = 12 t^2\nx(-1) = 1\nx'(-1) = -4\nuntil 1\n"
#define COSINE "x'' = -x\nx(0) = 1\nx'(0) = 0\n"
#define EVEN "x'' = 0\nx(0) = 0\nx'(0) = 1\n"

static motus_run *told(const char *text, const char *method, double step, double tolerance, double until,
                       motus_bars bars, motus_system **s)
{
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    *s = given_text(text);
    def.method = method;
    if (isnan(tolerance)) def.step = step;
    def.tolerance = tolerance;
    if (!isnan(until)) def.until = until;
    def.error = bars;
    must(motus_run_create(*s, &def, &r, &err), &err, method);
    must(motus_run_finish(r, &err), &err, text);
    return r;
}

static motus_run *finished(const char *text, const char *method, double step, double tolerance, double until,
                           motus_system **s)
{
    return told(text, method, step, tolerance, until, MOTUS_BARS_NONE, s);
}

static motus_event_row event_at(motus_run *r, int64_t k)
{
    motus_event_row e = motus_default_event_row();
    assert_int_equal(motus_run_event(r, k, &e), MOTUS_OK);
    return e;
}

/* One event, touched, at t; else it is said. */
static bool touches_once(const char *text, const char *method, double step, double tolerance, double t, double margin)
{
    motus_system *s;
    motus_run *r = finished(text, method, step, tolerance, NAN, &s);
    const int64_t count = motus_run_events(r);
    bool right = count == 1 && event_at(r, 0).touched && fabs(event_at(r, 0).time - t) <= margin;
    if (!right) printf("%s, step %g, tolerance %g: %lld events\n", method, step, tolerance, (long long)count);
    motus_run_destroy(r);
    motus_system_destroy(s);
    return right;
}

/* y = 2 t - t^2 is a polynomial of degree 2, x = t^4 one of degree 4: rows of that order err by rounding alone. What
 * that leaves of y or x, 1e-15 at most in 200 steps, moves their extremum by at most its root, or its fourth root. */
static void polynomials(void **state)
{
    (void)state;
    static const char *const adaptive[] = {"dop853",  "taylor",  "dopri5", "dep12",
                                           "radau15", "verner9", "gragg",  "gragg-stormer"},
                             *const fixed[] = {"gauss8", "rk4", "gauss4", "yoshida6", "verlet"};
    static const double steps[] = {0.3, 0.25, 0.125, 0.1, 1.0 / 64, 0.01},
                        tolerances[] = {1e-6, 1e-9, 1e-12, 1e-13, 1e-14, 1e-15};
    int wrong = 0;
    for (int flat = 0; flat < 2; flat++)
        for (size_t j = 0; j < 6; j++) {
            const char *text = flat ? FLAT "when x = 0: record\n" : GRAZING "when y = 1: record\n";
            const double t = flat ? 0 : 1, margin = flat ? 1e-3 : 1e-7;
            for (size_t k = 0; k < sizeof adaptive / sizeof *adaptive; k++)
                wrong += !touches_once(text, adaptive[k], NAN, tolerances[j], t, margin);
            for (size_t k = 0; k + flat < sizeof fixed / sizeof *fixed; k++) /* flat: all but verlet */
                wrong += !touches_once(text, fixed[k], steps[j], NAN, t, margin);
        }
    assert_int_equal(wrong, 0);
}

/* How far the time of a touch may be off is told: of a flat function far more than a rounding. */
static void bars_of_touches(void **state)
{
    (void)state;
    static const char *const adaptive[] = {"dop853", "taylor", "dopri5", "radau15", "verner9"}, *const fixed[] = {
                                                                                                    "gauss8", "rk4",
                                                                                                    "yoshida6"};
    static const double sizes[] = {0.3, 0.1, 1.0 / 64, 0.01}, tolerances[] = {1e-6, 1e-9, 1e-12, 1e-14};
    for (int flat = 0; flat < 2; flat++)
        for (size_t k = 0; k < 8; k++)
            for (size_t j = 0; j < 4; j++) {
                motus_system *s;
                const char *method = k < 5 ? adaptive[k] : fixed[k - 5];
                motus_run *r = told(flat ? FLAT "when x = 0: record\n" : GRAZING "when y = 1: record\n", method,
                                    sizes[j], k < 5 ? tolerances[j] : NAN, NAN, MOTUS_BARS_CHEAP, &s);
                assert_int_equal(motus_run_events(r), 1);
                if (motus_run_events_significant(r) != 1)
                    fail_msg("%s, number %zu, flat %d: no digit", method, j, flat);
                const motus_event_row e = event_at(r, 0);
                const double off = fabs(e.time - (flat ? 0 : 1));
                if (!(off <= e.error && e.error < (flat ? 1e-2 : 1e-6)))
                    fail_msg("%s, number %zu: off %g, bar %g", method, j, off, e.error);
                motus_run_destroy(r);
                motus_system_destroy(s);
            }
}

/* x = (t - T)^3 passes 0 at a flat root, which the rounding of x hides for a time that may be longer than a step: the
 * error of the time covers it, and also where a step ends about there the root is told as a crossing, once. */
static void bars_of_flat_roots(void **state)
{
    (void)state;
    static const struct {
        const char *method;
        double step, tolerance;
    } by[] = {{"dop853", NAN, 1e-12},   {"taylor", NAN, 1e-12}, {"rk4", 1.0 / 52, NAN},
              {"rk4", 1.0 / 2744, NAN}, {"rk4", 1.0 / 64, NAN}, {"gauss8", 0.05, NAN},
              {"pefrl", 0.01, NAN},     {"gauss8", 1e-3, NAN},  {"pefrl", 1.0 / 9705, NAN}};
    for (int k = 40; k < 160; k += 7)
        for (size_t j = 0; j < sizeof by / sizeof *by; j++) {
            char text[256];
            motus_system *s;
            const double T = k / 64.0; /* all numbers of the text are exact */
            snprintf(text, sizeof text, "x'' = 6 (t - %.17g)\nx(0) = %.17g\nx'(0) = %.17g\nwhen x = 0: record\n", T,
                     -T * T * T, 3 * T * T);
            motus_run *r = told(text, by[j].method, by[j].step, by[j].tolerance, T + 0.3, MOTUS_BARS_CHEAP, &s);
            assert_int_equal(motus_run_events(r), 1);
            const bool significant = motus_run_events_significant(r) == 1; /* the companion comes as far as the run */
            const motus_event_row e = event_at(r, 0);
            assert_false(e.touched);
            if (significant && !(fabs(e.time - T) <= e.error && e.error < 1e-2))
                fail_msg("%s, number %zu, T = %g: off %g, bar %g", by[j].method, j, T, e.time - T, e.error);
            motus_run_destroy(r);
            motus_system_destroy(s);
        }
}

static const struct {
    const char *method;
    double step, tolerance;
} ways[] = {{"dop853", NAN, 1e-12}, {"radau15", NAN, 1e-12}, {"taylor", NAN, 1e-12}, {"gauss8", 0.1, NAN},
            {"gauss8", 0.03, NAN},  {"rk4", 0.01, NAN},      {"rk4", 0.1, NAN}};

/* How many events of a kind are at the zeros of x = cos t, and how many are elsewhere. */
static void at_zeros(const char *lines, const char *name, bool touched, double until, int expected)
{
    for (size_t way = 0; way < sizeof ways / sizeof *ways; way++) {
        char text[512];
        motus_system *s;
        snprintf(text, sizeof text, "%s%s", COSINE, lines);
        motus_run *r = finished(text, ways[way].method, ways[way].step, ways[way].tolerance, until, &s);
        int right = 0, wrong = 0;
        for (int64_t k = 0; k < motus_run_events(r); k++) {
            const motus_event_row e = event_at(r, k);
            const double t = e.time / PI + 0.5, off = fabs(t - round(t));
            if (strcmp(e.name, name)) continue;
            right += off < 1e-3 && e.touched == touched; /* rk4 with the step 0.1 is late by 1e-5 t */
            wrong += !(off < 1e-3 && e.touched == touched);
        }
        if (right != expected || wrong)
            printf("%s by %s %g: %d and %d\n", lines, ways[way].method, ways[way].step, right, wrong);
        assert_int_equal(right, expected);
        assert_int_equal(wrong, 0);
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

static void powers(void **state)
{
    (void)state;
    at_zeros("when x^2 = 0 as e: record\n", "e", true, 40, 13);
    at_zeros("when x^4 = 0 as e: record\n", "e", true, 40, 13);
    at_zeros("z'' = -z\nz(0) = 0\nz'(0) = 1\nwhen z'^4 = 0 as e: record\n", "e", true, 40, 13);
    at_zeros("when x^3 = 0 as e: record\n", "e", false, 40, 13);
}

/* Another event ends the step where the function touches 0, be it before or behind in the text. */
static void where_another_event_ends_the_step(void **state)
{
    (void)state;
    at_zeros("c = 0\nwhen x = 0: c = c + 1\nwhen x^2 = 0 as e: record\nwhen c >= 1000: stop\n", "e", true, 20, 6);
    at_zeros("c = 0\nwhen x^2 = 0 as e: record\nwhen x = 0: c = c + 1\nwhen c >= 1000: stop\n", "e", true, 20, 6);
    at_zeros("p' = 0\np(0) = 0\nwhen x = 0: p = p + 1\nwhen x^2 = 0 as e: record\n", "e", true, 20, 6);
}

/* A condition that holds at a touch alone becomes true at each; so does one that does not hold there alone. */
static void conditions(void **state)
{
    (void)state;
    at_zeros("when x^2 <= 0 as e: record\n", "e", false, 20, 6);
    at_zeros("when not x^2 > 0 as e: record\nwhen x >= 0 and x <= 0: record\n", "e", false, 20, 6);
    at_zeros("when x >= 0 and x <= 0 as e: record\n", "e", false, 20, 6);
    at_zeros("when x < 0 or x > 0 as e: record\n", "e", false, 20, 6);
    at_zeros("when x != 0 as e: record\n", "e", false, 20, 6);
    at_zeros("when x^2 > 0 as e: record\n", "e", false, 20, 6);
    at_zeros("when x > 0 as e: record\n", "e", false, 20, 3);
}

/* A ball is off the floor again after every bounce, whichever line comes first. */
static void off_the_floor(void **state)
{
    (void)state;
    motus_system *s;
    motus_run *r = finished("y'' = -9.81\ny(0) = 1\ny'(0) = 0\nuntil 2\nwhen y > 0 as before: record\n"
                            "when y = 0 falling as bounce: y' = -0.8 y'\nwhen y > 0 as after: record\n",
                            "dop853", NAN, 1e-12, NAN, &s);
    assert_int_equal(motus_run_events(r), 6); /* at 0.4515, 1.1740, 1.7519 */
    for (int64_t k = 0; k < 6; k++) assert_string_equal(event_at(r, k).name, k % 2 ? "before" : "after");
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* Two roots that are 450 units in the last place apart, between which the function falls to -2.5e-27. */
static void two_roots_near_one_another(void **state)
{
    (void)state;
    for (size_t way = 0; way < sizeof ways / sizeof *ways; way++)
        for (int companions = 0; companions < 2; companions++) {
            char text[512];
            motus_system *s;
            snprintf(text, sizeof text, EVEN "when (x - 1) (x - 1 - 1e-13) = 0 as e: record\n%s",
                     companions ? "when x = 1: record\nwhen x = 1 + 1e-13: record\n" : "");
            motus_run *r = finished(text, ways[way].method, ways[way].step, ways[way].tolerance, 2, &s);
            int count = 0;
            for (int64_t k = 0; k < motus_run_events(r); k++) {
                const motus_event_row e = event_at(r, k);
                if (strcmp(e.name, "e")) continue;
                /* 100 steps leave some units in the last place of x */
                assert_true(!e.touched && fabs(e.time - (count ? 1 + 1e-13 : 1)) <= 2e-14);
                count++;
            }
            if (count != 2) printf("%s %g: %d\n", ways[way].method, ways[way].step, count);
            assert_int_equal(count, 2);
            motus_run_destroy(r);
            motus_system_destroy(s);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(polynomials),
                                       cmocka_unit_test(bars_of_touches),
                                       cmocka_unit_test(bars_of_flat_roots),
                                       cmocka_unit_test(powers),
                                       cmocka_unit_test(where_another_event_ends_the_step),
                                       cmocka_unit_test(conditions),
                                       cmocka_unit_test(off_the_floor),
                                       cmocka_unit_test(two_roots_near_one_another)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
