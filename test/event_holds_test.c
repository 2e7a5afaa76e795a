/* Events of a function that a switch of the force holds at 0: dry friction, pushed to and fro, and a block on a belt.
 * What happens at the ends of a hold is told once, and conditions become true only where they do. All times are closed
 * forms, or roots of them. */
#include "given.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#define TAU 6.28318530717958647692

static const struct {
    const char *method;
    double step, tolerance, margin; /* margin: of times; that of rows of low order is some errors of their steps */
} ways[] = {{"dop853", NAN, 1e-9, 1e-8},    {"dop853", NAN, 1e-13, 1e-12}, {"taylor", NAN, 1e-12, 1e-11},
            {"radau15", NAN, 1e-12, 1e-11}, {"dopri5", NAN, 1e-8, 1e-6},   {"rk4", 0.01, NAN, 1e-7},
            {"rk4", 0.037, NAN, 1e-5},      {"gauss8", 0.1, NAN, 1e-11},   {"verlet", 0.01, NAN, 1e-3}};
enum { WAYS = sizeof ways / sizeof *ways };

static motus_run *finished(const char *text, size_t way, motus_system **s)
{
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    *s = given_text(text);
    def.method = ways[way].method;
    def.tolerance = ways[way].tolerance;
    if (isnan(ways[way].tolerance)) def.step = ways[way].step, def.switches = MOTUS_SWITCHES_LOCATE;
    must(motus_run_create(*s, &def, &r, &err), &err, def.method);
    must(motus_run_finish(r, &err), &err, def.method);
    return r;
}

/* The events of a name are those at these times, and no others. */
static void told(motus_run *r, const char *name, const double *times, size_t count, size_t way)
{
    size_t k = 0;
    for (int64_t i = 0; i < motus_run_events(r); i++) {
        motus_event_row e = motus_default_event_row();
        assert_int_equal(motus_run_event(r, i, &e), MOTUS_OK);
        if (strcmp(e.name, name)) continue;
        const double off = k < count ? fabs(e.time - times[k]) : INFINITY;
        if (!(off <= ways[way].margin))
            fail_msg("%s by %s: number %zu at %.17g, off %g", name, ways[way].method, k + 1, e.time, off);
        k++;
    }
    if (k != count) fail_msg("%s by %s: %zu instead of %zu", name, ways[way].method, k, count);
}

/* x'' = -sign(x') + P sin t: the block breaks loose where P sin t = 1 and P sin t = -1, half a period later the other
 * way; it comes to rest where the integral of the force is 0. */
static const double P = 1.2;

static double speed(double from, double start, double t) { return start - (t - from) - P * (cos(t) - cos(from)); }

static double rest_after(double from, double start, double low, double high)
{
    while (high - low > 1e-15 * high && low + (high - low) / 2 != low) {
        const double middle = low + (high - low) / 2;
        *(speed(from, start, middle) > 0 ? &low : &high) = middle;
    }
    return low;
}

static void friction(void **state)
{
    (void)state;
    enum { LOOSE = 7 }; /* until t = 20: 4 times up, 3 times down */
    double stick[LOOSE], loose[LOOSE], up[4], down[3];
    stick[0] = rest_after(0, 0.1, 0.01, 0.5);
    for (int k = 0; k < LOOSE; k++) loose[k] = asin(1 / P) + k * TAU / 2;
    const double slides = rest_after(loose[0], 0, loose[0] + 1, loose[0] + 3) - loose[0];
    for (int k = 1; k < LOOSE; k++) stick[k] = loose[k - 1] + slides;
    for (int k = 0; k < LOOSE; k++) (k % 2 ? down : up)[k / 2] = loose[k];
    double zero[2 * LOOSE];
    for (int k = 0; k < LOOSE; k++) zero[2 * k] = stick[k], zero[2 * k + 1] = loose[k];
    static const char *const orders[] = {
        "when x' < 0 as down: record\nwhen x' > 0 as up: record\nwhen x' <= 0 and x' >= 0 as rests: record\n"
        "when x' = 0 as zero: record\n",
        "when x' = 0 as zero: record\nwhen x' <= 0 and x' >= 0 as rests: record\nwhen x' > 0 as up: record\n"
        "when x' < 0 as down: record\n"};
    for (int order = 0; order < 2; order++)
        for (size_t way = 0; way < WAYS; way++) {
            char text[512];
            motus_system *s;
            snprintf(text, sizeof text, "x'' = -sign(x') + 1.2 sin(t)\nx(0) = 0\nx'(0) = 0.1\nuntil 20\n%s",
                     orders[order]);
            motus_run *r = finished(text, way, &s);
            told(r, "down", down, 3, way);
            told(r, "up", up, 4, way);
            told(r, "rests", stick, LOOSE, way);
            told(r, "zero", zero, 2 * LOOSE, way);
            motus_run_destroy(r);
            motus_system_destroy(s);
        }
}

/* A block on a belt of speed V, of x'' = -x + F sign(V - x'): it comes to the speed of the belt, rides up to x = F, and
 * from then on swings about F with the amplitude V: every period it has the speed of the belt for an instant. */
static void belt(void **state)
{
    (void)state;
    const double V = 0.4, F = 0.5;
    const double stick = asin(V / F), leave = stick + (F - F * (1 - cos(stick))) / V;
    double at[6] = {stick, leave};
    for (int k = 2; k < 6; k++) at[k] = leave + (k - 1) * TAU;
    for (size_t way = 0; way + 1 < WAYS; way++) { /* verlet's own motion meets the belt again */
        motus_system *s;
        motus_run *r = finished("x'' = -x + 0.5 sign(0.4 - x')\nx(0) = 0\nx'(0) = 0\nuntil 30\n"
                                "when x' = 0.4 as e: record\nwhen x' >= 0.4 as with: record\n",
                                way, &s);
        const bool exact = ways[way].margin <= 1e-11; /* the others pass by: what they are off is more than the touch */
        told(r, "e", at, exact ? 6 : 2, way);
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

/* Friction in a plane brings a disc to a stop and holds it: every function that is 0 there, and was not before, is told
 * once, a length as a touch, a component as passing in the way that it went; what was 0 all the time is not. */
static void stops_in_plane(void **state)
{
    (void)state;
    static const double starts[][2] = {{1, 0.5}, {-1.3, 0.77}, {0.2, -2.1}, {-0.03, 0}, {1.7, 0}};
    for (size_t way = 0; way + 1 < WAYS; way++) /* verlet cannot solve its step across the stop */
        for (size_t k = 0; k < sizeof starts / sizeof *starts; k++) {
            const double x = starts[k][0], y = starts[k][1], stop[] = {hypot(x, y) / 2.943};
            char text[512];
            motus_system *s;
            if (!strcmp(ways[way].method, "taylor")) continue; /* it does not follow directions */
            snprintf(
                text, sizeof text,
                "r'' = -0.3*9.81 r'/|r'|\nr(0) = (0, 0)\nr'(0) = (%g, %g)\nuntil 2\n"
                "when |r'| = 0 as length: record\nwhen |r'|^2 = 0 as square: record\nwhen r'.x = 0 as part: record\n"
                "when r'.x = 0 rising as rises: record\nwhen r'.x = 0 falling as falls: record\n"
                "when r'.y = 0 as other: record\nwhen |r'| <= 0 as rests: record\n",
                x, y);
            motus_run *const r = finished(text, way, &s);
            told(r, "length", stop, 1, way);
            told(r, "square", stop, 1, way);
            told(r, "part", stop, 1, way);
            told(r, "rises", stop, x < 0, way);
            told(r, "falls", stop, x > 0, way);
            told(r, "other", stop, y != 0, way);
            told(r, "rests", stop, 1, way);
            motus_run_destroy(r);
            motus_system_destroy(s);
        }
}

/* The time at which friction stops a block has the error of a root also where a function with a kink is asked, |x'|. */
static void errors_of_halts(void **state)
{
    (void)state;
    static const struct {
        const char *force;
        double speed, stop;
    } blocks[] = {{"-3 sign(x')", -1.3, 1.3 / 3},
                  {"if(t > 1, 4, 0) - 3*sign(x')", 0.7, 0.7 / 3},
                  {"-x - 0.3 sign(x')", 0.1, NAN}};
    static const char *const methods[] = {"dop853", "dopri5", "taylor", "radau15"};
    for (size_t k = 0; k < sizeof blocks / sizeof *blocks; k++)
        for (size_t m = 0; m < sizeof methods / sizeof *methods; m++) {
            char text[256];
            motus_error err = motus_default_error();
            motus_run_def def = motus_default_run();
            motus_run *r = NULL;
            snprintf(
                text, sizeof text,
                "x'' = %s\nx(0) = 0\nx'(0) = %g\nuntil 0.9\nwhen |x'| = 0 as halt: record\nwhen x' = 0 as also: record",
                blocks[k].force, blocks[k].speed);
            motus_system *s = given_text(text);
            def.method = methods[m], def.tolerance = 1e-9, def.error = MOTUS_BARS_CHEAP;
            must(motus_run_create(s, &def, &r, &err), &err, text);
            must(motus_run_finish(r, &err), &err, text);
            assert_int_equal(motus_run_events(r), 2);
            /* x'' = -x - 0.3: x' = 0.1 cos(t) - 0.3 sin(t) */
            const double stop = isnan(blocks[k].stop) ? atan(1.0 / 3) : blocks[k].stop;
            for (int i = 0; i < 2; i++) {
                motus_event_row e = motus_default_event_row();
                assert_int_equal(motus_run_event(r, i, &e), MOTUS_OK);
                if (!(fabs(e.time - stop) <= e.error && e.error < 1e-6))
                    fail_msg("%s by %s: %s at %.17g, which is off by %.2g, ± %.2g", text, methods[m], e.name, e.time,
                             e.time - stop, e.error);
            }
            motus_run_destroy(r);
            motus_system_destroy(s);
        }
}

/* Of two conditions that hold on either side of 0 and at it, the one that an action leaves behind does not happen in
 * the instant in which the other one does. */
static void on_both_sides(void **state)
{
    (void)state;
    static const char *const forms[][2] = {{"x <= 0", "x >= 0"}, {"x < 0", "x >= 0"}, {"x <= 0", "not x < 0"}};
    const double hits[] = {TAU / 4, TAU * 5 / 4}, leaves[] = {TAU * 3 / 4, TAU * 7 / 4};
    for (size_t way = 0; way < WAYS; way++)
        for (size_t k = 0; k < sizeof forms / sizeof *forms; k++) {
            char text[200];
            motus_system *s;
            snprintf(text, sizeof text,
                     "x'' = -x\nx(0) = 1\nx'(0) = 0\nwhen %s as hit: x' = 2 x', record\n"
                     "when %s as leave: x' = x'/2, record\nuntil 12",
                     forms[k][0], forms[k][1]);
            motus_run *const r = finished(text, way, &s);
            told(r, "hit", hits, 2, way);
            told(r, "leave", leaves, 2, way);
            motus_run_destroy(r);
            motus_system_destroy(s);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(friction), cmocka_unit_test(belt),
                                       cmocka_unit_test(on_both_sides), cmocka_unit_test(stops_in_plane),
                                       cmocka_unit_test(errors_of_halts)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
