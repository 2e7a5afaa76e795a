/* Events that last far shorter than a step, which the points of its dense output leap: x = sin t, so all times are
 * closed forms. */
#include "given.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#define SWING "x'' = -x\nx(0) = 0\nx'(0) = 1\nn = 0\nuntil 20\n"

typedef struct way {
    const char *method;
    double step, tolerance, margin;
} way;
static const way ways[] = {{"dop853", NAN, 1e-9, 1e-7}, {"taylor", NAN, 1e-10, 1e-8}, {"radau15", NAN, 1e-10, 1e-8},
                           {"gauss8", 0.25, NAN, 1e-7}, {"rk4", 0.05, NAN, 1e-4},     {"dep12", NAN, 1e-10, 1e-7}};
enum { WAYS = sizeof ways / sizeof *ways };

static motus_run *finished(const char *text, const way *w, motus_system **s)
{
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    *s = given_text(text);
    def.method = w->method;
    if (!isnan(w->step)) def.step = w->step;
    def.tolerance = w->tolerance;
    def.error = MOTUS_BARS_NONE;
    must(motus_run_create(*s, &def, &r, &err), &err, w->method);
    must(motus_run_finish(r, &err), &err, text);
    return r;
}

static int64_t unseen(const motus_run *r)
{
    const motus_run_statistics done = motus_run_now(r);
    return done.events_unseen;
}

/* Whether the condition becomes true when x comes to c - d upwards and to c + d downwards, or once at the time `at`. */
static bool is_found(const char *when, const way *w, double c, double d, double at)
{
    char text[512];
    motus_system *s;
    int64_t seen = 0, right = 0;
    snprintf(text, sizeof text, SWING "when %s: n = n + 1, record\n", when);
    motus_run *r = finished(text, w, &s);
    const int64_t count = motus_run_events(r);
    for (int turn = 0; turn < 4; turn++)
        for (int half = 0; half < 2; half++) {
            const double t =
                isnan(at) ? 6.28318530717958648 * turn + (half ? 3.14159265358979324 - asin(c + d) : asin(c - d)) : at;
            motus_event_row e = motus_default_event_row();
            if (t > 20 || (!isnan(at) && turn + half)) continue;
            right += seen < count && motus_run_event(r, seen, &e) == MOTUS_OK && fabs(e.time - t) <= w->margin;
            seen++;
        }
    const bool found = right == seen && count == seen && unseen(r) == 0;
    if (!found)
        printf("%s, %s: %lld of %lld events, %lld steps unseen\n", when, w->method, (long long)right, (long long)seen,
               (long long)unseen(r));
    motus_run_destroy(r);
    motus_system_destroy(s);
    return found;
}

static void peaks(void **state)
{
    (void)state;
    int wrong = 0;
    for (size_t k = 0; k < WAYS; k++) {
        wrong += !is_found("exp(-(300 (x - 0.5))^2) > 0.5", &ways[k], 0.5, sqrt(log(2)) / 300, NAN);
        wrong += !is_found("exp(-((x - 0.7)/1e-4)^2) > 0.9", &ways[k], 0.7, sqrt(-log(0.9)) * 1e-4, NAN);
        wrong += !is_found("1/|x - 0.5| > 300", &ways[k], 0.5, 1.0 / 300, NAN);
        wrong += !is_found("exp(-((t - 7.3)/1e-4)^2) > 0.5", &ways[k], 0, 0, 7.3 - sqrt(log(2)) * 1e-4);
    }
    assert_int_equal(wrong, 0);
}

/* Poles, kinks and branch points that come as near to the motion as these, without an argument that is 0. */
static void near_singular(void **state)
{
    (void)state;
    int wrong = 0;
    for (size_t k = 0; k < WAYS; k++) {
        wrong += !is_found("1/((x - 0.5)^2 + 1e-6) > 5e5", &ways[k], 0.5, 1e-3, NAN);
        wrong += !is_found("sqrt((x - 0.5)^2 + 1e-8) < 2e-4", &ways[k], 0.5, sqrt(3) * 1e-4, NAN);
        wrong += !is_found("log((x - 0.5)^2 + 1e-8) < log(4e-8)", &ways[k], 0.5, sqrt(3) * 1e-4, NAN);
        wrong += !is_found("tanh((x - 0.5)/1e-4)^2 < 0.25", &ways[k], 0.5, atanh(0.5) * 1e-4, NAN);
        wrong += !is_found("max(x - 0.5, 0.5 - x) < 1e-5", &ways[k], 0.5, 1e-5, NAN);
        wrong += !is_found("hypot(x - 0.5, 1e-4) < 2e-4", &ways[k], 0.5, sqrt(3) * 1e-4, NAN);
        wrong += !is_found("if(x > 0.4999, if(x < 0.5001, 1, 0), 0) > 0.5", &ways[k], 0.5, 1e-4, NAN);
        wrong += !is_found("cbrt((x - 0.5)^2) < 1e-3", &ways[k], 0.5, sqrt(1e-9), NAN);
        wrong += !is_found("atan2(x - 0.5, 1e-4)^2 < 1", &ways[k], 0.5, 1e-4 * tan(1), NAN);
        wrong += !is_found("(cos(x - 0.5)^64)^64 > 0.5", &ways[k], 0.5, acos(pow(0.5, 1.0 / 4096)), NAN);
    }
    assert_int_equal(wrong, 0);
}

/* Where such arguments stay away from all that, the points tell of every step: bounds on the function have its terms
 * cancel too slowly. */
static void regular(void **state)
{
    (void)state;
    static const char *const when[] = {"sqrt(x^2 + x'^2) = 1.01", "1/(2 + x) - x'/(3 + x') = 0.2",
                                       "exp(-x^2 - x'^2) = 0.35", "|x^2 + x'^2 + 1| = 2.02"};
    for (size_t k = 0; k < sizeof when / sizeof *when; k++)
        for (int i = 0; i < 2; i++) {
            char text[512];
            motus_system *s;
            snprintf(text, sizeof text, "x'' = -x + 0.1 cos(1.3 t)\nx(0) = 1\nx'(0) = 0\nuntil 200\nwhen %s: record\n",
                     when[k]);
            motus_run *r = finished(text, &ways[i], &s);
            if (unseen(r) != 0) fail_msg("%s, %s: %lld", when[k], ways[i].method, (long long)unseen(r));
            assert_true(motus_run_events(r) > 0);
            motus_run_destroy(r);
            motus_system_destroy(s);
        }
}

static void windows(void **state)
{
    (void)state;
    int wrong = 0;
    for (size_t k = 0; k < WAYS; k++)
        for (double d = 1e-4; d > 2e-9; d /= 3.3) {
            char when[96];
            snprintf(when, sizeof when, "|x - 0.5| < %.17g", d);
            wrong += !is_found(when, &ways[k], 0.5, d, NAN);
            snprintf(when, sizeof when, "x > %.17g and x < %.17g", 0.5 - d, 0.5 + d);
            wrong += !is_found(when, &ways[k], 0.5, d, NAN);
        }
    assert_int_equal(wrong, 0);
}

/* Of what no bound tells it is said that something may have been missed; what bounds tell of is not said to be. */
static void what_is_not_seen(void **state)
{
    (void)state;
    static const struct {
        const char *when;
        bool seen;
    } cases[] = {{"sin(1e6 x) - 2 sin(5e5 x) cos(5e5 x) + 1e-30 > 0.1", false},
                 {"x = 0.5", true},
                 {"x^2 + x'^2 > 1.1", true},
                 {"abs(x) = 1 + x'^2", true}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char text[512];
        motus_system *s;
        snprintf(text, sizeof text, SWING "when %s: record\n", cases[k].when);
        motus_run *r = finished(text, &ways[0], &s);
        if ((unseen(r) == 0) != cases[k].seen) fail_msg("%s: %lld", cases[k].when, (long long)unseen(r));
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(peaks), cmocka_unit_test(near_singular),
                                       cmocka_unit_test(regular), cmocka_unit_test(windows),
                                       cmocka_unit_test(what_is_not_seen)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
