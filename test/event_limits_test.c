/* Events at the limit of what rounding tells: bounces that accumulate at any height, passages that an action slows
 * down, functions that an action lets go of 0, events in the first steps of methods of fixed step. Against closed
 * forms. */
#include "given.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static motus_run *finished(motus_system *s, const char *method)
{
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    def.method = method;
    def.error = MOTUS_BARS_CHEAP;
    must(motus_run_create(s, &def, &r, &err), &err, "run");
    must(motus_run_finish(r, &err), &err, "finish");
    return r;
}

static motus_event_row row_of(motus_run *r, int64_t k)
{
    motus_event_row row = motus_default_event_row();
    assert_int_equal(motus_run_event(r, k, &row), MOTUS_OK);
    return row;
}

static const char *const methods[] = {NULL, "taylor", "dop853", "radau15", "rk4", "verlet"};
enum { METHODS = sizeof methods / sizeof *methods };

/* A ball from 1 above a floor, thrown up by 1, that keeps a part e of its speed. */
static void floors(void **state)
{
    (void)state;
    static const double heights[] = {0, -1, 0.1, 1, 2, 100, -3.7};
    const long double g = 9.8L, up = 1, hit = sqrtl(up * up + 2 * g);
    for (size_t i = 0; i < sizeof heights / sizeof *heights; i++)
        for (size_t k = 0; k < METHODS; k++) {
            const char *const e = i % 2 ? "0.5" : "0.7";
            const long double part = i % 2 ? 0.5L : 0.7L, limit = (up + hit) / g + 2 * hit / g * part / (1 - part);
            char text[256];
            double time, error;
            int accumulated;
            snprintf(text, sizeof text,
                     "e = %s\ny'' = -9.8\ny(0) = %.17g\ny'(0) = 1\nstep 0.01\nuntil 5\n"
                     "when y = %.17g falling as hit: y' = -e y', record",
                     e, heights[i] + 1, heights[i]);
            motus_system *s = given_text(text);
            motus_run *r = finished(s, methods[k]);
            assert_string_equal(motus_run_ended(r, &accumulated, &time, &error), "hit");
            if (!accumulated || !(fabsl(time - limit) <= error) || !(error <= 1e-9))
                fail_msg("a floor at %g by %s: %.17g ± %g, not %.17Lg", heights[i], motus_run_now(r).method, time,
                         error, limit);
            motus_run_destroy(r);
            motus_system_destroy(s);
        }
}

/* A body passes 0 at t = 1 and is slowed down there to a part of its speed, or driven on: it passes once. */
static void passages(void **state)
{
    (void)state;
    static const double parts[] = {0.9, 0.3, 1e-3, 1, 2.5};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        for (size_t k = 0; k < METHODS; k++) {
            char text[256];
            snprintf(text, sizeof text,
                     "x'' = 0\nx(0) = 1\nx'(0) = -1\nstep 0.03\nuntil 2\n"
                     "when x = 0 falling as passes: x' = %.17g x', record\nwhen x = 0 rising as back: record",
                     parts[i]);
            motus_system *s = given_text(text);
            motus_run *r = finished(s, methods[k]);
            assert_int_equal(motus_run_events(r), 1);
            assert_true(fabs(row_of(r, 0).time - 1) <= 0x1p-49); /* 33 steps, each rounded */
            double end;
            motus_error err = motus_default_error();
            const size_t x = 1;
            must(motus_run_values(r, &x, 1, &end, &err), &err, "x");
            if (!(fabs(end + parts[i]) <= 0x1p-48 * (1 + parts[i]))) fail_msg("x = %.17g after %g", end, parts[i]);
            motus_run_destroy(r);
            motus_system_destroy(s);
        }
}

/* A rocket stands until its thrust, which grows, is its weight: its speed is 0 until then, and rises from 0 with the
 * slope 0. It never falls, wherever rounding puts the thrust at that instant. */
static void lifts_off(void **state)
{
    (void)state;
    static const char *const thrusts[] = {"F = 15000 (t - 8)", "F = 15000 q\nq' = 1\nq(0) = -8", "F = 1e-3 t^3 m"};
    static const char *const apogees[] = {"when y' = 0 falling as apogee: record", "when y' < 0 as apogee: record",
                                          "when y' = 0 rising as off: record"};
    for (size_t i = 0; i < sizeof thrusts / sizeof *thrusts; i++)
        for (size_t j = 0; j < sizeof apogees / sizeof *apogees; j++)
            for (int m = 16; m <= 24; m++)
                for (size_t k = 0; k < 3; k++) {
                    char text[512];
                    snprintf(text, sizeof text,
                             "g = 9.81\nm = %d\n%s\nonpad = 1\ny'' = if(onpad, 0, F/m - g)\ny(0) = 0\ny'(0) = 0\n"
                             "until 30\nwhen F = m g rising as liftoff: onpad = 0, record\n%s",
                             m, thrusts[i], apogees[j]);
                    motus_system *s = given_text(text);
                    motus_run *r = finished(s, methods[k]);
                    if (motus_run_events(r) != (j == 2 ? 2 : 1))
                        fail_msg("%s by %s: %d events", text, motus_run_now(r).method, (int)motus_run_events(r));
                    motus_run_destroy(r);
                    motus_system_destroy(s);
                }
}

/* x = cos(t + 0.2): events in the first step, and in what is left of it after an action, which a companion of
 * the same steps would meet with the same error. */
static void first_steps(void **state)
{
    (void)state;
    static const char *const ways[] = {"midpoint", "verlet", "rk4", "explicit-euler", "symplectic-euler", "heun"};
    for (size_t k = 0; k < sizeof ways / sizeof *ways; k++)
        for (double at = 0.01; at < 0.3; at += 0.04) {
            const double second = at + 0.03, a = at + 0.2; /* it goes on from where its speed was doubled */
            char text[400];
            snprintf(text, sizeof text,
                     "x'' = -x\nx(0) = cos(0.2)\nx'(0) = -sin(0.2)\nstep 1\nuntil 2\n"
                     "when x' = %.17g falling as first: x' = 2 x', record\nwhen x' = %.17g falling as second: record",
                     -sin(a), -(2 * sin(a) * cos(second - at) + cos(a) * sin(second - at)));
            motus_system *s = given_text(text);
            motus_run *r = finished(s, ways[k]);
            assert_true(motus_run_events(r) >= 2);
            const double truths[] = {at, second};
            for (int i = 0; i < 2; i++) {
                const motus_event_row row = row_of(r, i);
                if (!(fabs(row.time - truths[i]) <= row.error))
                    fail_msg("%s by %s: %.17g ± %g, not %.17g", row.name, ways[k], row.time, row.error, truths[i]);
            }
            motus_run_destroy(r);
            motus_system_destroy(s);
        }
}

/* Kicks each of which lets the next come sooner: by a constant factor, or by a power of their number. `limit` is their
 * sum; NAN: they do not accumulate, or the state there is finite and known, and the run goes on. */
static void growths(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        motus_status status;
        double limit, within;
    } rows[] = {
        /* between two walls: 1/2 + 1/2 + 1/4 + … */
        {"x'' = 0\nx(0) = 0.5\nx'(0) = 1\nwhen x = 0 falling as low: x' = -2 x', record\n"
         "when x = 1 rising as high: x' = -2 x', record",
         MOTUS_DIVERGED, 1.5, 1e-8},
        /* the same, of which one function with a kink between them tells */
        {"x'' = 0\nx(0) = 0.5\nx'(0) = 1\nwhen |x - 0.5| = 0.5 rising: x' = -2 x'", MOTUS_DIVERGED, 1.5, 1e-8},
        {"s' = v\nv' = 0\ns(0) = 0\nv(0) = 1\nwhen s = 1 as kick: s = 0, v = 1.02 v", MOTUS_DIVERGED, 51, 1e-6},
        {"v = 1\ns' = v\ns(0) = 0\nwhen s = 1 as kick: s = 0, v = 2 v\nwhen kick accumulates: stop", MOTUS_DIVERGED, 2,
         1e-8},
        /* 1 + 1/1.1^2 + 1/1.2^2 + …, 100 times the trigamma function of 10 */
        {"s' = v^2\nv' = 0\ns(0) = 0\nv(0) = 1\nwhen s = 1 as kick: s = 0, v = v + 0.1", MOTUS_DIVERGED,
         10.516633568168574, 1e-4},
        /* 1 + 1/4 + 1/9 + … */
        {"s' = 1\np' = 0\ns(0) = 0\np(0) = 1\nwhen s = p^2 as kick: s = 0, p = p/(1 + p)", MOTUS_EVENTS,
         1.6449340668482264, 1e-6},
        /* 1 + 1/1.01 + 1/1.02 + …; and a power only for a while */
        {"s' = v\nv' = 0\ns(0) = 0\nv(0) = 1\nwhen s = 1 as kick: s = 0, v = v + 0.01", MOTUS_OK, NAN, 0},
        {"s' = v^2\nv' = 0\ns(0) = 0\nv(0) = 1\nwhen s = 1 as kick: s = 0, v = min(v + 0.1, 50)", MOTUS_OK, NAN, 0},
        /* a ball comes to rest, and a number counts its bounces */
        {"x'' = -9.81\nn' = 0\nx(0) = 1\nx'(0) = 0\nn(0) = 1\nwhen x = 0 falling as hit: x' = -0.5 x', n = n + 1",
         MOTUS_OK, NAN, 0},
    };
    static const char *const ways[] = {"taylor", "rk4"};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        for (size_t k = 0; k < sizeof ways / sizeof *ways; k++) {
            motus_error err = motus_default_error();
            motus_run_def def = motus_default_run();
            motus_run *r = NULL;
            def.method = ways[k];
            def.error = MOTUS_BARS_NONE;
            if (k) def.step = 0.02;
            def.until = isnan(rows[i].limit) ? 11 : 100;
            motus_system *s = given_text(rows[i].text);
            must(motus_run_create(s, &def, &r, &err), &err, "run");
            const motus_status status = motus_run_finish(r, &err);
            if (status != rows[i].status) fail_msg("%s by %s: %s", rows[i].text, ways[k], err.message);
            const int singular = status == MOTUS_DIVERGED;
            if (singular && !(fabs(err.singular - rows[i].limit) <= err.singular_error))
                fail_msg("%s by %s: %.17g ± %g", rows[i].text, ways[k], err.singular, err.singular_error);
            if (singular && !(err.singular_error <= rows[i].within))
                fail_msg("%s by %s: ± %g", rows[i].text, ways[k], err.singular_error);
            double end = NAN;
            if (status) assert_int_equal(sscanf(err.attempt, "until = %lf", &end), 1);
            motus_run_destroy(r);
            def.until = end; /* the hint leads to its end */
            if (status) must(motus_run_create(s, &def, &r, &err), &err, "run");
            if (status) must(motus_run_finish(r, &err), &err, "finish");
            if (status) motus_run_destroy(r);
            motus_system_destroy(s);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(floors), cmocka_unit_test(passages),
                                       cmocka_unit_test(lifts_off), cmocka_unit_test(first_steps),
                                       cmocka_unit_test(growths)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
