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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(motions),
        cmocka_unit_test(frees_what_friction_holds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
