/* What a tolerance says: the error of every step of Gauss-Radau and of extrapolation is what it allows. Steps of
 * Gauss-Radau grow with the power of the tolerance that its order gives; those of extrapolation do not, since they have
 * more orders the less is allowed. Orders, tableaux and Brouwer's law are among the laws of every row.
 */
#include "test/given.h"

/* Smooth motions whose steps are limited by the error: an eccentric orbit, coupled oscillations, time and a first-order
 * variable, a force of the velocity whose rate changes by a factor of hundreds. */
static const char *const texts[] = {
    "r'' = -r/|r|^3\nr(0) = (0.4, 0)\nr'(0) = (0, 2)",
    "x'' = -x - 2 x y\ny'' = -y - x^2 + y^2\nx(0) = 0.1\ny(0) = -0.2\nx'(0) = 0.25\ny'(0) = 0.1",
    "x'' = -sin(x) - 0.1 x' + cos(2 t/3)\nu' = x^2 - u\nx(0) = 1\nx'(0) = 0\nu(0) = 0.5",
    "x'' = 5 (1 - x^2) x' - x\nx(0) = 2\nx'(0) = 0",
};
enum { TEXTS = sizeof texts / sizeof *texts };
#define UNTIL 12
enum { STATE_MAX = 8 };

static motus_run *run_of(motus_system *s, const char *method, double tolerance, double start, const double *x,
                         double until)
{
    motus_run_def def = motus_default_run();
    motus_error err = motus_default_error();
    motus_run *r = NULL;
    def.method = method, def.machine = "interpreter", def.tolerance = tolerance, def.start = start, def.until = until;
    def.x = x, def.v = x ? x + motus_positions(s) : NULL;
    must(motus_run_create(s, &def, &r, &err), &err, method);
    return r;
}

/* By how much the state `is` at time t is off, of a step that began at `from`. */
static double miss(motus_system *s, double from, const double *before, double t, const double *is, size_t count)
{
    motus_run *exact = run_of(s, "taylor", 1e-15, from, before, t);
    finish(exact);
    double *due = whole_state(s, exact, NULL), off = 0;
    for (size_t k = 0; k < count; k++) off = fmax(off, fabs(is[k] - due[k]));
    free(due);
    motus_run_destroy(exact);
    return off;
}

/* The largest error of a step against Taylor series from its start, in units of what is allowed: the tolerance times
 * the largest number of the state at both ends, or the way that it goes. No size of a variable is larger. within: also
 * of states between its ends, which have the order of the step where that is chosen. */
static double worst_step(const char *method, const char *text, double tolerance, int within)
{
    motus_system *s = given_text(text);
    motus_run *r = run_of(s, method, tolerance, NAN, NULL, UNTIL);
    motus_error err = motus_default_error();
    double worst = 0;
    size_t columns[STATE_MAX]; /* x and v follow the time */
    for (size_t k = 0; k < STATE_MAX; k++) columns[k] = 1 + k;
    while (motus_run_time(r) < UNTIL) {
        size_t count;
        const double t = motus_run_time(r);
        double *before = whole_state(s, r, NULL);
        must(motus_run_step(r, 1, &err), &err, text);
        double *after = whole_state(s, r, &count);
        double off = miss(s, t, before, motus_run_time(r), after, count), size = 0;
        for (size_t k = 0; k < count; k++)
            size = fmax(size, fmax(fmax(fabs(before[k]), fabs(after[k])), fabs(after[k] - before[k])));
        for (int i = 1; within && i < 4; i++) {
            const double at = t + i / 4.0 * (motus_run_time(r) - t);
            double is[STATE_MAX];
            assert_true(count <= STATE_MAX);
            must(motus_run_sample(r, &at, 1, columns, count, is, &err), &err, text);
            off = fmax(off, miss(s, t, before, at, is, count));
        }
        worst = fmax(worst, off / (tolerance * size));
        free(before), free(after);
    }
    motus_run_destroy(r);
    motus_system_destroy(s);
    return worst;
}

static void steps_keep_the_tolerance(void **unused)
{
    (void)unused;
    static const char *const methods[] = {"radau15", "gragg-stormer", "gragg"};
    for (int m = 0; m < 3; m++)
        for (int k = 0; k < TEXTS; k++) {
            motus_system *s = given_text(texts[k]);
            const int admitted = motus_method_admits(s, methods[m], NULL) == MOTUS_OK;
            motus_system_destroy(s);
            for (double tolerance = 1e-4; admitted && tolerance > 1e-12; tolerance /= 1000) {
                const double worst = worst_step(methods[m], texts[k], tolerance, m > 0);
                if (!(worst <= 1))
                    fail_msg("%s: at %g a step is off by %g of that: %s", methods[m], tolerance, worst, texts[k]);
            }
        }
}

/* Where a force of the velocity changes fast, the iteration limits the step: no candidate may pass whose equation is
 * not solved. */
static void stiff_steps_are_solved(void **unused)
{
    (void)unused;
    const double worst = worst_step("radau15", "x'' = -300 (x' - cos(t)) - x\nx(0) = 0\nx'(0) = 1", 1e-9, 0);
    if (!(worst <= 1)) fail_msg("a step is off by %g of what is allowed", worst);
}

static double steps_to(const char *method, const char *text, double tolerance, double until)
{
    motus_system *s = given_text(text);
    motus_run *r = run_of(s, method, tolerance, NAN, NULL, until);
    finish(r);
    const double steps = (double)motus_run_steps(r);
    motus_run_destroy(r);
    motus_system_destroy(s);
    return steps;
}

/* Where the time scale stays as it is: the error of a step goes with its 16th power, so a tolerance 10^6 times as small
 * takes 10^(6/16) times as many steps, but for those until the first, a hundredth of the time scale, has grown, by 5 at
 * most, and the last one. */
static void steps_go_with_the_order(void **unused)
{
    (void)unused;
    const char *const even[] = {texts[1], "x'' = -sin(x)\nx(0) = 0.5\nx'(0) = 0"};
    for (int k = 0; k < 2; k++) {
        const double few = steps_to("radau15", even[k], 1e-6, 100), many = steps_to("radau15", even[k], 1e-12, 100),
                     start = log(100) / log(5) + 1;
        const double power = log(many / few) / log(1e6), apart = 2 * start / few / log(1e6);
        if (!(fabs(power - 1.0 / 16) < apart))
            fail_msg("%g and %g steps, the power %g ± %g of the tolerance: %s", few, many, power, apart, even[k]);
    }
}

/* Extrapolation takes more orders the less is allowed: of 18, the highest, or a lower one, steps of one order would be
 * at least 10^(9/19) times as many where a 10^9 times smaller error is allowed. */
static void orders_go_with_the_tolerance(void **unused)
{
    (void)unused;
    static const char *const methods[] = {"gragg-stormer", "gragg"};
    for (int m = 0; m < 2; m++) {
        const double few = steps_to(methods[m], texts[0], 1e-4, 60), many = steps_to(methods[m], texts[0], 1e-13, 60);
        if (!(many < few * pow(10, 9.0 / 19))) fail_msg("%s: %g and %g steps", methods[m], few, many);
    }
}

/* Every adaptive row refuses where it needs shorter steps than the shortest, and keeps to it where it needs none. */
static void no_step_is_shorter_than_the_least(void **unused)
{
    (void)unused;
    motus_system *s = given_text("x'' = -sin(x)\nx(0) = 1\nx'(0) = 0\n");
    for (size_t m = 0; m < motus_method_count(); m++) {
        const motus_method *card = motus_method_at(m);
        for (int k = 0; card->adaptive && k < 4; k++) {
            const int needed = k < 2;
            motus_run_def def = motus_default_run();
            motus_error err = motus_default_error();
            motus_run *r = NULL;
            def.method = card->name, def.until = 20, def.tolerance = 1e-9;
            def.machine = k % 2 ? "compiled" : "interpreter";
            def.shortest_step = needed ? 2 : 1e-5;
            if (motus_method_admits(s, card->name, NULL) != MOTUS_OK) continue;
            must(motus_run_create(s, &def, &r, &err), &err, card->name);
            const motus_status status = motus_run_finish(r, &err);
            if (status != (needed ? MOTUS_DIVERGED : MOTUS_OK)) fail_msg("%s: status %d", card->name, (int)status);
            if (needed && !strstr(err.message, "needs a step shorter than 2"))
                fail_msg("%s: %s", card->name, err.message);
            const motus_run_statistics done = motus_run_now(r);
            if (!needed && !(done.shortest_step >= def.shortest_step))
                fail_msg("%s: a step of %g", card->name, done.shortest_step);
            motus_run_destroy(r);
        }
    }
    motus_system_destroy(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steps_keep_the_tolerance),          cmocka_unit_test(stiff_steps_are_solved),
        cmocka_unit_test(steps_go_with_the_order),           cmocka_unit_test(orders_go_with_the_tolerance),
        cmocka_unit_test(no_step_is_shorter_than_the_least),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
