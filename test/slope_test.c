/* The rule that finds a slope among errors, and the detector of trends, on synthetic errors: so wrongly declared orders
 * are tested too.
 */
#include "motus.h"
#include "study/fit.h"
#include "study/trend.h"
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

/* Synthetic errors ----------------------------------------------------------------------------------------------- */

#define POINTS 40

/* A fixed scatter in [-1, 1]: the same on every machine. */
static double scatter(size_t k) { return 2 * fmod(0.6180339887498949 * (double)(k + 1) + 0.137, 1) - 1; }

typedef struct recipe {
    double coefficient, order; /* coefficient h^order */
    double next, next_order;   /* + next h^next_order */
    double floor, growth;      /* + floor × scatter × steps^growth */
    double unstable;           /* NaN above this step */
} recipe;

/* steps 8, 16, 32, … (or with ratio √2) of a motion of length 8; at most `count` points. */
static size_t make(motus_point *p, size_t count, double ratio, recipe r)
{
    for (size_t i = 0; i < count; i++) {
        double h = pow(ratio, -(double)i), n = 8 / h;
        double e = r.coefficient * pow(h, r.order) + r.next * pow(h, r.next_order);
        e += r.floor * (0.6 + 0.4 * fabs(scatter(i))) * pow(n, r.growth);
        p[i] = (motus_point){.step = h, .error = h > r.unstable ? NAN : fabs(e), .used = 7};
    }
    return count;
}

static const recipe quiet = {.coefficient = 0.01, .order = 2, .unstable = INFINITY};

static void slope_of_clean_errors(void **state)
{
    (void)state;
    for (int p = 1; p <= 8; p++) {
        motus_point points[POINTS];
        recipe r = quiet;
        r.order = p;
        size_t n = make(points, 10, 1.4142135623730951, r);
        fit_order_result f = fit_order(points, n, 8, DBL_EPSILON, 0);
        assert_int_equal(f.verdict, FIT_SLOPE);
        assert_true(fabs(f.observed - p) < 1e-9);
        assert_true(f.standard_error < 1e-9);
        assert_true(fit_passes(f.observed, f.standard_error, p));
        for (size_t i = 0; i < n; i++) assert_true(points[i].used == 0 || points[i].used == 1);
    }
}

static void plateau_is_left_out(void **state)
{
    (void)state;
    for (int p = 4; p <= 8; p += 2)
        for (int growth = 0; growth <= 2; growth++) {
            motus_point points[POINTS];
            recipe r = {.coefficient = 0.05,
                        .order = p,
                        .floor = growth == 2 ? 1e-16 : 1e-14,
                        .growth = 0.5 * growth,
                        .unstable = INFINITY};
            size_t n = make(points, 34, 1.4142135623730951, r);
            fit_order_result f = fit_order(points, n, 8, DBL_EPSILON, 0);
            assert_int_equal(f.verdict, FIT_SLOPE);
            assert_true(f.settled);
            assert_true(fabs(f.observed - p) < 0.1);
            /* a fit over all points would be far off */
            double x[POINTS], y[POINTS];
            for (size_t i = 0; i < n; i++) {
                x[i] = log(points[i].step);
                y[i] = log(points[i].error);
            }
            assert_true(fit_line(x, y, n).slope < p - 0.5);
            assert_false(points[n - 1].used);
        }
}

static void coarse_points_are_left_out(void **state)
{
    (void)state;
    motus_point points[POINTS];
    /* unstable, then superconvergent (the h^4 term hides the h^2 one), then order 2 */
    recipe r = {.coefficient = 1e-5, .order = 2, .next = 0.05, .next_order = 5, .unstable = 0.3};
    size_t n = make(points, 14, 2, r);
    fit_order_result f = fit_order(points, n, 8, DBL_EPSILON, 0);
    assert_int_equal(f.verdict, FIT_SLOPE);
    assert_true(fabs(f.observed - 2) < 0.05);
    assert_false(fit_passes(f.observed, f.standard_error, 5));
    for (size_t i = 0; i < 4; i++) assert_false(points[i].used);
}

static void large_errors_are_left_out(void **state)
{
    (void)state;
    motus_point points[POINTS];
    recipe r = {.coefficient = 100, .order = 2, .unstable = INFINITY};
    size_t n = make(points, 28, 1.4142135623730951, r);
    fit_order_result f = fit_order(points, n, 8, DBL_EPSILON, 0);
    assert_int_equal(f.verdict, FIT_SLOPE);
    /* Errors as large as the motion, and the octave next to them, do not count, whatever their slope. */
    for (size_t i = 0; i + 1 < n; i++)
        if (points[i].error >= 0.1) assert_false(points[i].used || points[i + 1].used);
    assert_true(points[n - 1].used);
}

static void a_lower_order_is_detected(void **state)
{
    (void)state;
    for (int p = 2; p <= 8; p++) {
        motus_point points[POINTS];
        recipe r = {.coefficient = 0.01, .order = p - 1, .floor = 1e-15, .unstable = INFINITY};
        size_t n = make(points, 16, 1.4142135623730951, r);
        fit_order_result f = fit_order(points, n, 8, DBL_EPSILON, 0);
        assert_int_equal(f.verdict, FIT_SLOPE);
        assert_false(fit_passes(f.observed, f.standard_error, p));
    }
}

static void the_reference_error_is_a_floor(void **state)
{
    (void)state;
    motus_point points[POINTS];
    recipe r = {.coefficient = 0.05, .order = 4, .unstable = INFINITY};
    size_t n = make(points, 20, 1.4142135623730951, r);
    /* A reference error of 1e-7 excludes the points below 3e-6, though they lie on a line. */
    fit_order_result f = fit_order(points, n, 8, DBL_EPSILON, 1e-7);
    assert_int_equal(f.verdict, FIT_SLOPE);
    for (size_t i = 0; i < n; i++) assert_true(!points[i].used || points[i].error >= 3e-6);
    f = fit_order(points, n, 8, DBL_EPSILON, 1e-3);
    assert_int_equal(f.verdict, FIT_FEW);
    assert_true(isnan(f.observed));
}

static void noise_is_no_slope(void **state)
{
    (void)state;
    motus_point points[POINTS];
    for (size_t i = 0; i < 12; i++)
        points[i] = (motus_point){.step = pow(2, -(double)i), .error = 1e-3 * exp(4 * scatter(i))};
    fit_order_result f = fit_order(points, 12, 8, DBL_EPSILON, 0);
    assert_true(f.verdict != FIT_EXACT);
    assert_false(f.verdict == FIT_SLOPE && fit_passes(f.observed, f.standard_error, 6));
}

static void exact_methods_have_no_slope(void **state)
{
    (void)state;
    motus_point points[POINTS];
    recipe r = {.floor = 1e-16, .growth = 0.5, .unstable = INFINITY};
    size_t n = make(points, 12, 2, r);
    assert_int_equal(fit_order(points, n, 8, DBL_EPSILON, 0).verdict, FIT_EXACT);
    points[0].error = 1e-9; /* a single error at a coarse step that rounding does not explain */
    assert_int_not_equal(fit_order(points, n, 8, DBL_EPSILON, 0).verdict, FIT_EXACT);
    for (size_t i = 0; i < n; i++) points[i].error = NAN;
    assert_int_equal(fit_order(points, n, 8, DBL_EPSILON, 0).verdict, FIT_FEW);
    assert_int_equal(fit_order(points, 0, 8, DBL_EPSILON, 0).verdict, FIT_FEW);
}

static void margins_of_the_certificate(void **state)
{
    (void)state;
    assert_true(fit_passes(1.86, 0, 2));
    assert_false(fit_passes(1.84, 0.5, 2));
    assert_true(fit_passes(5.0, 0, 4));
    assert_true(fit_passes(7.7, 0.16, 8));
    assert_false(fit_passes(7.7, 0.10, 8));
    assert_false(fit_passes(NAN, 0, 2));
}

static void line_by_hand(void **state)
{
    (void)state;
    /* y = 1, 3, 2 at x = 0, 1, 2: slope 1/2, residuals -1/2, 1, -1/2, standard error sqrt(1.5 / 1 / 2) */
    fit_result f = fit_line((double[]){0, 1, 2}, (double[]){1, 3, 2}, 3);
    assert_true(fabs(f.slope - 0.5) < 1e-15 && fabs(f.intercept - 1.5) < 1e-15);
    assert_true(fabs(f.slope_error - sqrt(0.75)) < 1e-15);
    /* no cancellation far from the origin */
    f = fit_line((double[]){1e9, 1e9 + 1, 1e9 + 2}, (double[]){1, 3, 5}, 3);
    assert_true(fabs(f.slope - 2) < 1e-12);
    assert_true(isnan(fit_line((double[]){1, 1}, (double[]){0, 1}, 2).slope));
}

/* Trends --------------------------------------------------------------------------------------------------------- */

#define LOOKS 1000

typedef double shape(double u);

static double swing(double u) { return sin(2 * 3.14159265358979 * 37.3 * u); }
static double one_turn(double u) { return sin(2 * 3.14159265358979 * u); }
static double turn_and_a_half(double u) { return 1 - cos(3 * 3.14159265358979 * u); }
static double spikes(double u) { return pow(sin(3.14159265358979 * 12.2 * u), 20); }
static double stairs_and_spikes(double u) { return 0.05 * floor(12 * u) + pow(sin(3.14159265358979 * 12.2 * u), 20); }
static double beats(double u) { return swing(u) * sin(3.14159265358979 * 3.1 * u); }
static double straight(double u) { return u; }
static double swing_and_drift(double u) { return swing(u) + 0.5 * u; }
static double grows(double u) { return exp(20 * u); }
static double grows_swinging(double u) { return exp(6 * u) * (1 + 0.3 * swing(u)); }
static double stairs(double u) { return -floor(9.5 * u); }

static trend_result trend_of(shape *f, double size, double noise, double roundoff)
{
    static double t[LOOKS], d[LOOKS];
    for (size_t i = 0; i < LOOKS; i++) {
        t[i] = 5 + 100 * (double)i / (LOOKS - 1);
        d[i] = size * f((double)i / (LOOKS - 1)) + noise * scatter(i);
    }
    return trend_find(t, d, LOOKS, roundoff);
}

static void oscillations_are_no_trend(void **state)
{
    (void)state;
    shape *bounded[] = {swing, one_turn, turn_and_a_half, spikes, beats};
    for (size_t k = 0; k < sizeof bounded / sizeof *bounded; k++)
        for (double noise = 0; noise < 0.3; noise += 0.1) assert_false(trend_of(bounded[k], 1, noise, 1e-12).trending);
}

static void drifts_are_trends(void **state)
{
    (void)state;
    shape *running[] = {straight, swing_and_drift, grows, grows_swinging, stairs, stairs_and_spikes};
    for (size_t k = 0; k < sizeof running / sizeof *running; k++) {
        assert_true(trend_of(running[k], 1, 0, 1e-12).trending);
        assert_true(trend_of(running[k], -1, 0, 1e-12).trending);
    }
    trend_result r = trend_of(straight, 3, 0, 0);
    assert_true(fabs(r.trend - 3) < 1e-12);
}

static void rounding_is_no_trend(void **state)
{
    (void)state;
    assert_true(trend_of(straight, 1e-12, 0, 1e-13).trending);
    assert_false(trend_of(straight, 1e-13, 0, 1e-12).trending);
    assert_true(isnan(trend_find((double[]){1}, (double[]){1}, 1, 0).trend));
    /* too few samples */
    assert_false(trend_find((double[]){0, 1, 2}, (double[]){0, 1, 2}, 3, 0).trending);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slope_of_clean_errors),      cmocka_unit_test(plateau_is_left_out),
        cmocka_unit_test(coarse_points_are_left_out), cmocka_unit_test(large_errors_are_left_out),
        cmocka_unit_test(a_lower_order_is_detected),  cmocka_unit_test(the_reference_error_is_a_floor),
        cmocka_unit_test(noise_is_no_slope),          cmocka_unit_test(exact_methods_have_no_slope),
        cmocka_unit_test(margins_of_the_certificate), cmocka_unit_test(line_by_hand),
        cmocka_unit_test(oscillations_are_no_trend),  cmocka_unit_test(drifts_are_trends),
        cmocka_unit_test(rounding_is_no_trend),
    };
    return cmocka_run_group_tests_name("slope", tests, NULL, NULL);
}
