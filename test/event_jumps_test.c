/* Events of functions that jump or have a kink. x moves evenly, or as a cosine, so all times are closed forms; each has
 * the rounding of a few units in the last place of what the method makes of the motion. */
#include "given.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#define EVEN "x'' = 0\nx(0) = 0.3\nx'(0) = 1\n"
#define COSINE "x'' = -x\nx(0) = 1\nx'(0) = 0\n"
#define CIRCLE COSINE "y'' = -y\ny(0) = 0\ny'(0) = 1\n"
#define PI 3.14159265358979323846

enum { TIMES = 6 };
static const struct {
    const char *motion, *occasion;
    double until;
    int count, touched;
    double t[TIMES];
} cases[] = {
    {EVEN, "mod(x, 1) = 0.5", 5, 5, 0, {0.2, 1.2, 2.2, 3.2, 4.2}},
    {EVEN, "mod(x, 1) = 0.5 falling", 5, 0, 0, {0}},
    {EVEN, "mod(x, 1) = 0", 5, 5, 1, {0.7, 1.7, 2.7, 3.7, 4.7}},
    {EVEN, "floor(x) >= 3", 5, 1, 0, {2.7}},
    {EVEN, "floor(x) > 3", 5, 1, 0, {3.7}},
    {EVEN, "sign(x - 2) > 0", 5, 1, 0, {1.7}},
    {EVEN, "if(x > 2, 1, -1) > 0", 5, 1, 0, {1.7}},
    {EVEN, "|x - 2| = 0", 5, 1, 1, {1.7}},
    {EVEN, "|x - 2| = 1e-9", 5, 2, 0, {1.7 - 1e-9, 1.7 + 1e-9}},
    {EVEN, "x + floor(x) = 2.5", 5, 1, 0, {1.2}},
    {EVEN, "floor(3 x) = x + 0.7", 5, 0, 0, {0}},
    {EVEN, "floor(x) (x - 2.5) = 0", 5, 1, 0, {2.2}},
    {EVEN, "tan(t) = 1", 5, 2, 0, {PI / 4, 5 * PI / 4}},
    {EVEN, "1/(x - 2) = 1", 5, 1, 0, {2.7}},
    {EVEN, "1/(x - 2) > 0", 5, 1, 0, {1.7}},
    {COSINE, "mod(t, 2) < 1", 9, 4, 0, {2, 4, 6, 8}},
    {COSINE, "mod(t, 1) > 0.5", 4, 4, 0, {0.5, 1.5, 2.5, 3.5}},
    {COSINE, "|x| = 0", 10, 3, 1, {PI / 2, 3 * PI / 2, 5 * PI / 2}},
    {COSINE, "max(x, 0) = 0", 10, 1, 0, {3 * PI / 2}},
    {COSINE, "max(x, 0) <= 0", 10, 2, 0, {PI / 2, 5 * PI / 2}},
    {COSINE, "max(x, 0) > 0", 10, 1, 0, {3 * PI / 2}},
    {COSINE, "sign(x) x^2 = 0", 10, 3, 0, {PI / 2, 3 * PI / 2, 5 * PI / 2}},
    {CIRCLE, "atan2(y, x) = 3", 10, 2, 0, {3, 3 + 2 * PI}},
    {EVEN, "max(x, t/(2 - x)) > -1", 5, 0, 0, {0}},
    {EVEN, "mod(x, 1) >= 1.5", 5, 0, 0, {0}},
};

static const struct {
    const char *method;
    double step, tolerance;
} ways[] = {{"dop853", NAN, 1e-13}, {"radau15", NAN, 1e-13}, {"taylor", NAN, 1e-13},
            {"gauss8", 0.1, NAN},   {"gauss8", 0.03, NAN},   {"gauss8", 0.125, NAN}};

static motus_status run_of(const char *text, size_t way, double until, motus_run **r, motus_system **s,
                           motus_error *err)
{
    motus_run_def def = motus_default_run();
    *s = given_text(text);
    def.method = ways[way].method;
    if (isnan(ways[way].tolerance)) def.step = ways[way].step;
    def.tolerance = ways[way].tolerance;
    def.until = until;
    def.error = MOTUS_BARS_NONE;
    *err = motus_default_error();
    must(motus_run_create(*s, &def, r, err), err, text);
    return motus_run_finish(*r, err);
}

static void times_of_functions_with_jumps(void **state)
{
    (void)state;
    int wrong = 0;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
        for (size_t way = 0; way < sizeof ways / sizeof *ways; way++) {
            char text[512];
            motus_error err;
            motus_run *r;
            motus_system *s;
            snprintf(text, sizeof text, "%swhen %s: record\n", cases[k].motion, cases[k].occasion);
            must(run_of(text, way, cases[k].until, &r, &s, &err), &err, text);
            bool right = motus_run_events(r) == cases[k].count;
            for (int j = 0; right && j < cases[k].count; j++) {
                motus_event_row e = motus_default_event_row();
                assert_int_equal(motus_run_event(r, j, &e), MOTUS_OK);
                /* the motion is within 1e-11 of the truth, at rates of 1 */
                right = fabs(e.time - cases[k].t[j]) <= 1e-11 && e.touched == cases[k].touched;
            }
            if (!right) {
                wrong++;
                printf("%s by %s %g:", cases[k].occasion, ways[way].method, ways[way].step);
                for (int64_t j = 0; j < motus_run_events(r) && j < 2 * TIMES; j++) {
                    motus_event_row e = motus_default_event_row();
                    motus_run_event(r, j, &e);
                    printf(" %.17g%s", e.time, e.touched ? " touched" : "");
                }
                printf("\n");
            }
            motus_run_destroy(r);
            motus_system_destroy(s);
        }
    assert_int_equal(wrong, 0);
}

/* g is undefined for a while, and beyond that on the other side. -g has the same roots. */
static void undefined_for_a_while(void **state)
{
    (void)state;
    static const char text[] = EVEN "g = sqrt((x - 1)^2 - 0.01) (1 - x)\n"
                                    "when g = 0 falling as one: record\nwhen -g = 0 rising as other: record\n";
    for (size_t way = 0; way < sizeof ways / sizeof *ways; way++) {
        motus_error err;
        motus_run *r;
        motus_system *s;
        must(run_of(text, way, 3, &r, &s, &err), &err, text);
        const int64_t count = motus_run_events(r);
        assert_true(count == 0 || count == 2);
        motus_event_row one = motus_default_event_row(), other = motus_default_event_row();
        if (count) assert_true(!motus_run_event(r, 0, &one) && !motus_run_event(r, 1, &other));
        assert_true(count == 0 || (one.time == other.time && strcmp(one.name, other.name) != 0));
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

/* What changes faster than steps can be divided, or than the time is known, ends the run, and says what jumps. */
static void too_fast_to_follow(void **state)
{
    (void)state;
    static const struct {
        const char *occasion, *says;
    } fast[] = {{"mod(x, 1e-6) = 5e-7", "mod(x, "},
                {"sin(1e14 t) = 0.5", "changes so fast"},
                {"sin(1e16 t) = 0.5", "changes so fast"},
                {"sin(1e17 t) = 0.5", "changes so fast"}};
    for (size_t k = 0; k < sizeof fast / sizeof *fast; k++)
        for (size_t way = 0; way < sizeof ways / sizeof *ways; way++) {
            char text[512];
            motus_error err;
            motus_run *r;
            motus_system *s;
            snprintf(text, sizeof text, EVEN "when %s: record\n", fast[k].occasion);
            assert_int_equal(run_of(text, way, 5, &r, &s, &err), MOTUS_EVENTS);
            assert_int_equal(motus_run_events(r), 0);
            if (!strstr(err.message, fast[k].says)) fail_msg("%s: %s", fast[k].occasion, err.message);
            motus_run_destroy(r);
            motus_system_destroy(s);
        }
}

/* A function that is constant but where it jumps never passes 0. */
static void refused_since_they_never_happen(void **state)
{
    (void)state;
    static const char *const never[] = {"floor(x) = 3", "sign(x - 2) = 0", "if(x > 2, 2, 0) = 1"};
    for (size_t k = 0; k < sizeof never / sizeof *never; k++) {
        char text[256];
        motus_error err = motus_default_error();
        motus_text_def def = motus_default_text();
        motus_system *s = NULL;
        snprintf(text, sizeof text, EVEN "when %s: record\n", never[k]);
        def.text = text;
        assert_int_not_equal(motus_system_from_text(&def, &s, &err), MOTUS_OK);
        assert_non_null(strstr(err.message, "never happens"));
    }
}

/* Whatever else is asked of the same motion, in the same instants too, an event happens as often. */
static void beside_others(void **state)
{
    (void)state;
    enum { CASES = sizeof cases / sizeof *cases };
    int wrong = 0;
    for (size_t k = 0; k < CASES; k++)
        for (size_t l = 0; l < CASES; l++) {
            if (strcmp(cases[k].motion, cases[l].motion) != 0) continue;
            char text[512];
            motus_error err;
            motus_run *r;
            motus_system *s;
            const size_t way = (k + l) % (sizeof ways / sizeof *ways);
            snprintf(text, sizeof text, "%swhen %s as a: record\nwhen %s as b: record\n", cases[k].motion,
                     cases[k].occasion, cases[l].occasion);
            must(run_of(text, way, fmin(cases[k].until, cases[l].until), &r, &s, &err), &err, text);
            int count[2] = {0}, expected[2] = {0};
            for (int64_t j = 0; j < motus_run_events(r); j++) {
                motus_event_row e = motus_default_event_row();
                assert_int_equal(motus_run_event(r, j, &e), MOTUS_OK);
                count[*e.name == 'b']++;
            }
            for (int j = 0; j < TIMES; j++) {
                const double until = fmin(cases[k].until, cases[l].until);
                expected[0] += j < cases[k].count && cases[k].t[j] <= until;
                expected[1] += j < cases[l].count && cases[l].t[j] <= until;
            }
            if (count[0] != expected[0] || count[1] != expected[1]) {
                wrong++;
                printf("%s and %s by %s: %d and %d instead of %d and %d\n", cases[k].occasion, cases[l].occasion,
                       ways[way].method, count[0], count[1], expected[0], expected[1]);
            }
            motus_run_destroy(r);
            motus_system_destroy(s);
        }
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(times_of_functions_with_jumps), cmocka_unit_test(beside_others),
                                       cmocka_unit_test(undefined_for_a_while), cmocka_unit_test(too_fast_to_follow),
                                       cmocka_unit_test(refused_since_they_never_happen)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
