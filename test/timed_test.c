/* Switches that change at times which are known beforehand: steps end at these times, nothing searches, and the motion
 * is that of the formulas on both sides.
 *
 * x'' = f(t) with a force of straight pieces has a velocity and a position of parabolas and cubics, which the test adds
 * up piece by piece.
 */
#include "test/given.h"

#include <stdbool.h>

typedef struct force {
    const char *text;
    double (*at)(double t, double way); /* its value after t, along the way */
    double kinks[12];                   /* within (0, 6), rising */
    int count;
} force;

static double after(double t, double way) { return t + way * 1e-9; }
static double step(double t, double way) { return after(t, way) < 1.25 ? 2 : -1; }
static double fold(double t, double way) { return (void)way, fabs(t - 2.5); }
static double stairs(double t, double way) { return floor(after(t, way) / 0.75); }
static double square(double t, double way) { return fmod(floor(after(t, way)), 2); }
static double saw(double t, double way) { return t / 2 - floor(after(t, way) / 2); }
static double hat(double t, double way) { return (void)way, fmax(0, 1 - fabs(t - 2)); }
static double hats(double t, double way)
{
    static const double high[] = {1, -2, 0.5};
    double sum = 0;
    for (int i = 0; i < 3; i++) sum += high[i] * hat(t - 1 - i + 1, way);
    return sum;
}
static double clipped(double t, double way) { return (void)way, fmin(fmax(t, 1), 4.5); }
static double window(double t, double way)
{
    const double u = after(t, way);
    return u > 1 && u < 2.5 ? 3 : 0;
}
static double signs(double t, double way) { return (after(t, way) < 3) - (after(t, way) > 3); }

static const force forces[] = {
    {"if(t < 1.25, 2, -1)", step, {1.25}, 1},
    {"|t - 2.5|", fold, {2.5}, 1},
    {"floor(t/0.75)", stairs, {0.75, 1.5, 2.25, 3, 3.75, 4.5, 5.25}, 7},
    {"mod(floor(t), 2)", square, {1, 2, 3, 4, 5}, 5},
    {"mod(t/2, 1)", saw, {2, 4}, 2},
    {"max(0, 1 - |t - 2|)", hat, {1, 2, 3}, 3},
    {"sum(i = 1..3: H[i] max(0, 1 - |t - i - 1|))", hats, {1, 2, 3, 4, 5}, 5},
    {"min(max(t, 1), 4.5)", clipped, {1, 4.5}, 2},
    {"if(1 < t and t < 2.5, 3, 0)", window, {1, 2.5}, 2},
    {"sign(6 - 2 t)", signs, {3}, 1},
};

/* Leads v' = f, x' = v along straight pieces, from one end of (0, 6) to the other. */
static void lead(const force *f, double way, double *x, double *v)
{
    double t = way > 0 ? 0 : 6;
    for (int k = 0; k <= f->count; k++) {
        const double to = k == f->count ? 6 - (way > 0 ? 0 : 6) : f->kinks[way > 0 ? k : f->count - 1 - k];
        const double h = to - t, a = f->at(t, way), b = f->at(t + h / 2, way);
        const double slope = (b - a) / (h / 2), value = b - slope * (h / 2);
        *x += h * (*v + h * (value / 2 + slope * h / 6));
        *v += h * (value + slope * h / 2);
        t = to;
    }
}

static void motions(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof forces / sizeof *forces; k++)
        for (int way = 1; way >= -1; way -= 2) {
            const force *f = &forces[k];
            const int from = way > 0 ? 0 : 6;
            const char *const methods[] = {"dop853", "taylor", "dep8"};
            double x = f == forces ? 1 : 0.5, v = -0.25;
            char text[400];
            snprintf(text, sizeof text, "H = [1, -2, 0.5]\nx'' = %s\nx(%d) = %g; x'(%d) = %g\n", f->text, from, x, from,
                     v);
            lead(f, way, &x, &v);
            for (int m = 0; m < 3; m++) {
                motus_system *s = given_text(text);
                motus_run_def def = motus_default_run();
                motus_error err = motus_default_error();
                motus_run *r = NULL;
                double got[2];
                int seen = 0;
                def.method = methods[m];
                def.until = 6 - from;
                must(motus_run_create(s, &def, &r, &err), &err, text);
                while (!motus_run_done(r)) {
                    must(motus_run_step(r, 1, &err), &err, text);
                    if (seen == f->count) continue;
                    const double kink = f->kinks[way > 0 ? seen : f->count - 1 - seen];
                    if (fabs(motus_run_time(r) - kink) <= 1e-15 * 4) seen++;
                }
                must(motus_run_state(r, got, got + 1, &err), &err, text);
                const motus_run_statistics of = motus_run_now(r);
                if (!(fabs(got[0] - x) <= 1e-13 && fabs(got[1] - v) <= 1e-13))
                    fail_msg("%s by %s: %.17g, %.17g, not %.17g, %.17g", f->text, methods[m], got[0], got[1], x, v);
                if (seen != f->count) fail_msg("%s by %s: %d ends of steps", f->text, methods[m], seen);
                /* 12 stages of dop853 a candidate; a part begins with one more */
                if (m == 0 && of.evaluations > 12 * (of.steps + of.refused) + f->count + 1)
                    fail_msg("%s: %g evaluations in %g steps", f->text, (double)of.evaluations, (double)of.steps);
                motus_run_destroy(r);
                motus_system_destroy(s);
            }
        }
}

/* A block that friction holds is let go at a known time: by then on the push is stronger than what holds it. */
static void frees_what_friction_holds(void **state)
{
    (void)state;
    motus_system *s = given_text("F = if(t < 2, 0.5, 3)\nx'' = F - sign(x')\nx(0) = 0; x'(0) = 0\n");
    motus_run_def def = motus_default_run();
    motus_error err = motus_default_error();
    motus_run *r = NULL;
    double x, v;
    def.method = "dop853";
    def.until = 3;
    must(motus_run_create(s, &def, &r, &err), &err, "run");
    must(motus_run_finish(r, &err), &err, "run");
    must(motus_run_state(r, &x, &v, &err), &err, "state");
    assert_true(fabs(x - 1) < 1e-14 && fabs(v - 2) < 1e-14);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* A pulse of the force, out of rest, that steps across switches leap: their error is not 0. Known times are one kind of
 * it; the others are found in the same way. */
static void leapt_pulses(void **state)
{
    (void)state;
    static const char *const pulses[] = {"if(5 < t and t < 5.01, 1, 0)", "if((t - 5.005)^2 < 25e-6, 1, 0)",
                                         "interp(t, [0, 5, 5.01, 10], [0, 1, 0, 0]) - interp(t, [0, 5, 10], [0, 1, 0])",
                                         "max(0, 200 - 200 |t - 5.005|/0.005)"};
    static const double areas[] = {0.01, 0.01, -2.495, 1};
    static const char *const methods[] = {"dop853", "dopri5"};
    for (int k = 0; k < 4; k++)
        for (int m = 0; m < 2; m++) {
            char text[300];
            snprintf(text, sizeof text, "x'' = %s\nx(0) = 0; x'(0) = 0\n", pulses[k]);
            motus_system *s = given_text(text);
            motus_run_def def = motus_default_run();
            motus_error err = motus_default_error();
            motus_run *r = NULL;
            const size_t velocity = 2;
            double value, error;
            def.method = methods[m];
            def.switches = MOTUS_SWITCHES_STEP;
            def.until = 10;
            def.error = MOTUS_BARS_CHEAP;
            must(motus_run_create(s, &def, &r, &err), &err, text);
            for (double last = 0; !motus_run_done(r); last = motus_run_time(r)) { /* steps can be sampled */
                must(motus_run_step(r, 1, &err), &err, text);
                const double middle = last + (motus_run_time(r) - last) / 2;
                must(motus_run_sample(r, &middle, 1, &velocity, 1, &value, &err), &err, text);
            }
            must(motus_run_errors(r, &velocity, 1, &value, &error, &err), &err, text);
            if (fabs(value - areas[k]) > error) fail_msg("%s by %s: %.17g, error %g", text, methods[m], value, error);
            motus_run_destroy(r);
            motus_system_destroy(s);
        }
}

/* A ramp up and down from t1 on, each half `wide` long, and the exact velocity after it. */
typedef struct narrow {
    const char *t1, *t2, *t3, *high, *start;
} narrow;

/* Runs of narrow ramps at a time whose rounding is a large part of them: out of rest no step is as good as a tolerance
 * of 1e-11 asks, since the times of stages are rounded; and rounded points of the table make the force steeper, which
 * shadows that round all of them alike do not show. The bar may be half of the error, as a sample of one rounding. */
static void narrow_ramps(void **state)
{
    (void)state;
    static const narrow ramps[] = {
        {"1", "1.0001", "1.0002", "1", "0"},
        {"3.3", "3.30001", "3.30002", "100", "0"},
        {"3.3", "3.30001", "3.30002", "1e5", "0"},
        {"3.3", "3.301", "3.302", "100", "-2"},
        {"10.37", "10.3700001", "10.3700002", "1", "0"},
        {"137.5", "137.5001", "137.5002", "1e5", "0"},
        {"1000", "1000.0000001", "1000.0000002", "1", "0"},
    };
    static const char *const methods[] = {"dop853", "taylor", "dep8", "dopri5"};
    for (size_t k = 0; k < sizeof ramps / sizeof *ramps; k++)
        for (int m = 0; m < 4; m++)
            for (int power = 9; power <= 13; power += 2) {
                const narrow *n = &ramps[k];
                char text[300], what[400];
                snprintf(text, sizeof text,
                         "x'' = interp(t, [0, %s, %s, %s, 9999], [0, 0, %s, 0, 0])\nx(0) = 0; x'(0) = %s\n", n->t1,
                         n->t2, n->t3, n->high, n->start);
                snprintf(what, sizeof what, "%s1e-%d by %s", text, power, methods[m]);
                const long double t1 = strtold(n->t1, NULL), t3 = strtold(n->t3, NULL);
                const long double exact = strtold(n->start, NULL) + strtold(n->high, NULL) * (t3 - t1) / 2;
                motus_system *s = given_text(text);
                motus_run_def def = motus_default_run();
                motus_error err = motus_default_error();
                motus_run *r = NULL;
                const size_t velocity = 2;
                double value, error;
                def.method = methods[m];
                def.until = 1.5 * (double)t1;
                def.tolerance = pow(10, -power);
                def.error = MOTUS_BARS_CHEAP;
                must(motus_run_create(s, &def, &r, &err), &err, what);
                must(motus_run_finish(r, &err), &err, what);
                must(motus_run_errors(r, &velocity, 1, &value, &error, &err), &err, what);
                const double off = fabs((double)(value - exact));
                if (!(off <= 2 * error + ROUNDING * fabs(value))) fail_msg("%s: off by %g, bar %g", what, off, error);
                const double roundings = 100 * strtod(n->high, NULL) * (double)t1 * 2 * ROUNDING;
                if (!(error <= roundings)) fail_msg("%s: bar %g", what, error);
                if (motus_run_now(r).steps > 100) fail_msg("%s: %g steps", what, (double)motus_run_now(r).steps);
                motus_run_destroy(r);
                motus_system_destroy(s);
            }
}

/* Where rounded times decide which steps are accepted, every machine takes the same. */
static void narrow_ramps_by_machines(void **state)
{
    (void)state;
    const char *const text = "x'' = interp(t, [0, 3.3, 3.30001, 9999], [0, 0, 1, 1])\nx(0) = 0; x'(0) = 0\n";
    const char *const machines[] = {"interpreter", "compiled"};
    double got[2][2];
    int64_t steps[2];
    for (int m = 0; m < 2; m++) {
        motus_system *s = given_text(text);
        motus_run_def def = motus_default_run();
        motus_error err = motus_default_error();
        motus_run *r = NULL;
        def.method = "dop853";
        def.machine = machines[m];
        def.until = 4;
        def.tolerance = 1e-13;
        def.switches = MOTUS_SWITCHES_STEP;
        must(motus_run_create(s, &def, &r, &err), &err, text);
        must(motus_run_finish(r, &err), &err, text);
        must(motus_run_state(r, &got[m][0], &got[m][1], &err), &err, text);
        steps[m] = motus_run_now(r).steps;
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
    assert_memory_equal(got[0], got[1], sizeof got[0]);
    assert_true(steps[0] == steps[1]);
}

/* From rest, 1 - cos(c t) is a stair of roundings, and what it drives has no size yet: every tolerance leads on. One
 * body is driven, and carries another along. */
static void out_of_rest(void **state)
{
    (void)state;
    const char *const text = "x'' = 3000 (0.03 (1 - cos(4 pi t)) - x)\ny'' = 70 (x - y)\n"
                             "x(0) = 0; x'(0) = 0; y(0) = 0; y'(0) = 0\n";
    static const char *const methods[] = {"bs32", "dopri5", "tsit5", "dop853", "verner9"};
    static const double tolerances[] = {1e-3, 1e-6, 1e-9};
    const double until = 0.25, c = 4 * acos(-1.0), w = sqrt(3000.0);
    const double right = 0.03 * (1 - cos(w * until) - w * w / (w * w - c * c) * (cos(c * until) - cos(w * until)));
    motus_system *s = given_text(text);
    for (size_t m = 0; m < sizeof methods / sizeof *methods; m++)
        for (size_t k = 0; k < sizeof tolerances / sizeof *tolerances - (m < 3); k++) {
            motus_run_def def = motus_default_run();
            motus_error err = motus_default_error();
            motus_run *r = NULL;
            double x[2], v[2];
            def.method = methods[m];
            def.machine = "interpreter";
            def.until = until;
            def.tolerance = tolerances[k];
            must(motus_run_create(s, &def, &r, &err), &err, methods[m]);
            must(motus_run_finish(r, &err), &err, methods[m]);
            must(motus_run_state(r, x, v, &err), &err, methods[m]);
            near(x[0], right, 100 * tolerances[k] * 0.06, methods[m]);
            motus_run_destroy(r);
        }
    motus_system_destroy(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(motions),      cmocka_unit_test(frees_what_friction_holds), cmocka_unit_test(leapt_pulses),
        cmocka_unit_test(narrow_ramps), cmocka_unit_test(narrow_ramps_by_machines),  cmocka_unit_test(out_of_rest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
