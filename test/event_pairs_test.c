/* An event is told as it is alone, whatever else is asked of the same motion: where another event happens within the
 * same step, before it, after it, or between it and the next root of its function. What only records changes no step,
 * so the times are the same but for the rounding with which a simultaneous event may tell them. */
#include "given.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { MODELS = 400, TIMES = 256 };

static uint64_t seed;
static double random_between(double low, double high)
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(seed >> 40) * 0x1p-24;
}
static int one_of(int count) { return (int)random_between(0, count); }

static const struct {
    const char *method;
    double step, tolerance;
} ways[] = {{"taylor", NAN, 1e-8},  {"dop853", NAN, 1e-6}, {"dop853", NAN, 1e-10}, {"dopri5", NAN, 1e-5},
            {"radau15", NAN, 1e-9}, {"gragg", NAN, 1e-8},  {"rk4", 0.05, NAN},     {"gauss8", 0.2, NAN},
            {"verlet", 0.03, NAN},  {"dep12", NAN, 1e-8}};
enum { WAYS = sizeof ways / sizeof *ways };

/* An occasion of name `name`: a root of a smooth function, or a condition. */
static void occasion(char *out, size_t size, const char *name)
{
    static const char *const functions[] = {"sin(%.0f x + (%.6f))",     "cos(%.0f x) + (%.6f) / 4",
                                            "x' - %.0f * (%.6f) / 4",   "x x' + %.0f * (%.6f) / 4",
                                            "sin(%.0f t) + (%.6f) / 4", "t - %.0f - (%.6f)"};
    static const char *const ends[] = {" = 0", " = 0 rising", " = 0 falling", " > 0", " <= 0"};
    char function[80];
    const double k = 1 + one_of(4), c = random_between(-1, 1);
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
    snprintf(function, sizeof function, functions[one_of(6)], k, c);
#pragma GCC diagnostic pop
    snprintf(out, size, "when %s%s as %s: record\n", function, ends[one_of(5)], name);
}

static size_t times_of(const char *text, size_t way, const char *name, double *t)
{
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    motus_system *s = given_text(text);
    def.method = ways[way].method;
    if (isnan(ways[way].tolerance)) def.step = ways[way].step;
    def.tolerance = ways[way].tolerance;
    def.error = MOTUS_BARS_NONE;
    must(motus_run_create(s, &def, &r, &err), &err, text);
    must(motus_run_finish(r, &err), &err, text);
    size_t count = 0;
    for (int64_t i = 0; i < motus_run_events(r); i++) {
        motus_event_row e = motus_default_event_row();
        assert_int_equal(motus_run_event(r, i, &e), MOTUS_OK);
        if (strcmp(e.name, name) == 0 && count < TIMES) t[count++] = e.time;
    }
    motus_run_destroy(r);
    motus_system_destroy(s);
    return count;
}

static void as_alone(void **state)
{
    (void)state;
    int wrong = 0;
    seed = 1;
    for (int model = 0; model < MODELS; model++) {
        char motion[160], event[2][160], text[512];
        double alone[TIMES], beside[TIMES];
        const size_t way = (size_t)model % WAYS;
        snprintf(motion, sizeof motion, "x'' = %s\nx(0) = %.6f\nx'(0) = %.6f\nuntil 8\n",
                 model % 3 == 0   ? "0"
                 : model % 3 == 1 ? "-x/4"
                                  : "-x + x^2/8 + cos(t)/4",
                 random_between(-1, 1), random_between(0.5, 1.5));
        occasion(event[0], sizeof event[0], "a");
        occasion(event[1], sizeof event[1], "b");
        for (int k = 0; k < 2; k++) {
            const char *const name = k ? "b" : "a";
            snprintf(text, sizeof text, "%s%s", motion, event[k]);
            const size_t count = times_of(text, way, name, alone);
            snprintf(text, sizeof text, "%s%s%s", motion, event[0], event[1]);
            const size_t both = times_of(text, way, name, beside);
            double off = 0;
            for (size_t i = 0; i < count && i < both; i++) off = fmax(off, fabs(alone[i] - beside[i]));
            if (both == count && off <= 16 * 0x1p-50) continue;
            if (wrong++ < 5)
                printf("%s by %s: %s is told %zu times alone, %zu beside, off %g\n", text, ways[way].method, name,
                       count, both, off);
        }
    }
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(as_alone)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
