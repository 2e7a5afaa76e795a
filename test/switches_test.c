/* Runs that end steps where the force changes its formula (MOTUS_SWITCHES_LOCATE): the motion, the times, the order of
 * the method, and which derivative jumps. The exact motions are pieces of parabolas and of circles. */
#include "test/given.h"

typedef struct outcome {
    motus_status status;
    double t, x, v;
    motus_run_statistics did;
    char message[MOTUS_TEXT_MAX];
} outcome;

static outcome run_of(const char *text, const char *method, double step, motus_switches switches)
{
    motus_system *s = given_text(text);
    motus_run_def def = motus_default_run();
    motus_error err = motus_default_error();
    motus_run *r = NULL;
    outcome out = {.t = 0};
    def.method = method;
    def.step = step;
    def.switches = switches;
    must(motus_run_create(s, &def, &r, &err), &err, text);
    out.status = motus_run_finish(r, &err);
    snprintf(out.message, sizeof out.message, "%s", out.status ? err.message : "");
    double x[8], v[8];
    must(motus_run_state(r, x, v, &err), &err, text);
    out.t = motus_run_time(r);
    out.x = x[0];
    out.v = v[0];
    out.did = motus_run_now(r);
    motus_run_destroy(r);
    motus_system_destroy(s);
    return out;
}

static outcome located(const char *text, const char *method, double step)
{
    outcome out = run_of(text, method, step, MOTUS_SWITCHES_LOCATE);
    if (out.status) fail_msg("%s: %s", text, out.message);
    return out;
}

#define NEAR(value, expected, within) near(value, expected, within, #value)

/* x'' = -sign(x) from rest at 1: parabolas of duration 2 √2 between the zeros. Every method of order 2 is exact on a
 * parabola, so only the rounding of the times is left. */
static double bouncing(double t)
{
    const double half = 2 * sqrt(2), into = fmod(t + sqrt(2), 2 * half);
    const double up = into < half ? into : into - half, y = up * (half - up) / 2;
    return into < half ? y : -y;
}

static void parabolas(void **state)
{
    (void)state;
    static const char *const methods[] = {"verlet", "velocity-verlet", "midpoint", "rk4",
                                          "gauss4", "kahan-li8",       "newmark"};
    static const char *const models[] = {"x'' = -sign(x)\nx(0) = 1\nx'(0) = 0\nuntil 20\n",
                                         "x'' = if(x > 0, -1, 1)\nx(0) = 1\nx'(0) = 0\nuntil 20\n",
                                         "x'' = 1 - 2 floor((sign(x) + 3)/2 - 0.5)\nx(0) = 1\nx'(0) = 0\nuntil 20\n"};
    for (size_t m = 0; m < sizeof models / sizeof *models; m++)
        for (size_t k = 0; k < sizeof methods / sizeof *methods; k++) {
            const outcome o = located(models[m], methods[k], 0.3);
            NEAR(o.x, bouncing(20), 1e-13);
            NEAR(o.t, 20, 0);
            assert_int_equal(o.did.switches, m == 2 ? o.did.switches : 7);
            assert_int_equal(o.did.steps, 67);
            const outcome resolved = run_of(models[m], methods[k], 0.3, MOTUS_SWITCHES_RESOLVE);
            NEAR(resolved.x, bouncing(20), 1e-13);
            assert_int_equal(resolved.did.jump, 0);
            NEAR(resolved.did.jump_time, sqrt(2), 4e-16);
        }
}

/* A kick shorter than any step, whose times are read off the text. */
static void a_short_kick(void **state)
{
    (void)state;
    const char *text = "x'' = -x + if(t > 5.003, if(t < 5.0031, 1000, 0), 0)\nx(0) = 1\nx'(0) = 0\nuntil 10\n";
    /* x = cos t + ∫ sin(10 - s) 1000 ds over the kick */
    const double expected = cos(10) + 1000 * (cos(10 - 5.0031) - cos(10 - 5.003));
    for (double step = 0.5; step > 0.02; step /= 2) {
        const outcome o = located(text, "kahan-li8", step);
        NEAR(o.x, expected, step > 0.1 ? 1e-6 : 2e-12);
        assert_int_equal(o.did.switches, 2);
    }
    assert_true(fabs(run_of(text, "kahan-li8", 0.05, MOTUS_SWITCHES_STEP).x - expected) > 0.01);
}

/* An argument that leaves its side and comes back within one step: near the turning point of x = cos t. */
static void there_and_back(void **state)
{
    (void)state;
    const char *text = "x'' = -x - if(x > 0.9999, 1, 0)\nx(0) = 0\nx'(0) = 1\nuntil 3\n";
    const outcome o = located(text, "kahan-li8", 0.25), fine = located(text, "kahan-li8", 0.01);
    assert_int_equal(o.did.switches, 2);
    NEAR(o.x, fine.x, 1e-9);
    assert_int_equal(
        located("x'' = -x - if(x > 1.0001, 1, 0)\nx(0) = 0\nx'(0) = 1\nuntil 3\n", "rk4", 0.01).did.switches, 0);
}

/* The order of the method remains: the error falls by 2^order. */
static void orders(void **state)
{
    (void)state;
    static const struct {
        const char *method;
        int order;
        double step;
    } rows[] = {{"velocity-verlet", 2, 0.02}, {"verlet", 2, 0.02}, {"rk3", 3, 0.04},     {"rk4", 4, 0.1},
                {"forest-ruth", 4, 0.1},      {"gauss4", 4, 0.1},  {"kahan-li6", 6, 0.4}};
    static const char *const models[] = {"x'' = -x + if(x > 0.3, 0.3 x^2, 0)\nx(0) = 0.2\nx'(0) = 0.5\nuntil 3\n",
                                         "x'' = -x |x| - x^3\nx(0) = 1\nx'(0) = 0\nuntil 4\n",
                                         "x'' = -x + sin(3 t) max(x, 0.1)\nx(0) = 1\nx'(0) = 0\nuntil 4\n",
                                         "x'' = -2 x + mod(t + x, 0.7)\nx(0) = 1\nx'(0) = 0\nuntil 4\n"};
    for (size_t m = 0; m < sizeof models / sizeof *models; m++) {
        const double truth = located(models[m], "kahan-li8", 0.01).x;
        for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
            const double coarse = located(models[m], rows[k].method, rows[k].step).x - truth,
                         fine = located(models[m], rows[k].method, rows[k].step / 8).x - truth;
            const double order = log2(fabs(coarse / fine)) / 3;
            if (!(order > rows[k].order - 0.45))
                fail_msg("%s on %s: order %.2f, errors %.2g and %.2g", rows[k].method, models[m], order, coarse, fine);
        }
    }
}

static void which_derivative_jumps(void **state)
{
    (void)state;
    static const struct {
        const char *force;
        int jump;
    } rows[] = {{"-x - sign(x)", 0},      {"-x - |x|", 1},        {"-x - |x| x", 2},    {"-x - 0.1 |x| x^2", 3},
                {"-x - max(0, x)", 1},    {"-x - x |x|^3", 4},    {"-x - cbrt(x)", 1},  {"-x - sign(x) |x|^1.5", 2},
                {"-x + 1e-9 sign(x)", 0}, {"-x + floor(2 x)", 0}, {"-x |x^2 + 1|", -1}, {"-x + if(t < 20, 0, 1)", -1},
                {"-x + max(0, t - 1)", 1}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        char text[256];
        snprintf(text, sizeof text, "x'' = %s\nx(0) = 1\nx'(0) = 0.1\nuntil 4\n", rows[k].force);
        const outcome o = run_of(text, "rk4", 0.05, MOTUS_SWITCHES_RESOLVE);
        if (o.status) fail_msg("%s: %s", text, o.message);
        if (o.did.jump != rows[k].jump) fail_msg("%s: %d, not %d", rows[k].force, (int)o.did.jump, rows[k].jump);
        assert_true(isnan(o.did.jump_time) == (rows[k].jump < 0));
        assert_int_equal(run_of(text, "rk4", 0.05, MOTUS_SWITCHES_STEP).did.switches, -1);
    }
    assert_int_equal(located("x'' = -x\nx(0) = 1\nx'(0) = 0\nuntil 4\n", "rk4", 0.1).did.switches, 0);
}

/* With which power of the time the force departs from a smooth one, and where: also where no argument changes its
 * side, so that steps end at a touch of the place in which a formula has no derivative. The motion comes from 1 to 0
 * with a velocity of about 1. */
static void powers_and_touches(void **state)
{
    (void)state;
    static const struct {
        const char *force;
        double power;
    } rows[] = {{"-x - sqrt(x^2)", 1},
                {"-x - hypot(x, 0)", 1},
                {"-x - hypot(x, 0 x)", 1},
                {"-x - (x^2)^0.5", 1},
                {"-2 x - 0.1 (x^2)^1.5", 3},
                {"-x - |x|^1.3", 1.3},
                {"-x - x |x|^1.3", 2.3},
                {"-x - 0.1 cbrt(x^2)", 2.0 / 3},
                {"-x + 0.001 cbrt((x - 0.3)^2)", 2.0 / 3},
                {"-x + cbrt((t - 2.3)^2)", 2.0 / 3},
                {"-x - cbrt(-(t - 2.3)^2)", 2.0 / 3},
                {"-x + 10000 max(t - 2.3, 0)^6.5", 6.5},
                {"-x + max(t - 2.3, 0)^6.5", 6.5},
                {"-x + max(x - 0.3, 0)^5.5", 5.5},
                {"-x + 0.1 max(0.3 - x, 0)^5", 5},
                {"-x + 0.1 ((x - 0.3)^2)^2.5", 5},
                {"-x + 0.1 |x - 0.3|^5", 5},
                {"-x + max(t - 2.3, 0)^9", NAN},
                {"-x + cbrt(x)^3", NAN},
                {"-x + if(x > 0, sin(x), x - x^3/6)", 5},
                {"-cbrt(x)", 1.0 / 3},
                {"-x - sqrt(|x|)", 0.5},
                {"-x - sqrt(1 - cos(x))", 1},
                {"-x + acos(cos(t))", 1},
                {"-x + asin(sin(t))", 1},
                {"-x + atan2(sin(t), cos(t))", 0},
                {"-x + sin(acos(cos(t)))", 1},
                {"-x + cos(acos(cos(t)))", NAN},
                {"-x - sqrt(x^2 + 1)", NAN},
                {"-x - sqrt(x^2 + 1e-4)", NAN},
                {"-2 x - 0.01 (x^2 + 1)^1.5", NAN},
                {"-x - hypot(x, 0.1)", NAN},
                {"-x - atan2(x, 2)", NAN},
                {"-x + asin(0.9 sin(t))", NAN},
                {"-2 x - 0.01 (x^2)^2 + 0.01 x (x^2)^3", NAN}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++)
        for (int m = 0; m < 2; m++) {
            char text[256];
            snprintf(text, sizeof text, "x'' = %s\nx(0) = 1\nx'(0) = -0.3\nuntil 3.5\n", rows[k].force);
            const outcome o = run_of(text, m ? "gauss8" : "kahan-li8", 0.05, MOTUS_SWITCHES_RESOLVE);
            if (o.status) fail_msg("%s: %s", rows[k].force, o.message);
            if (isnan(rows[k].power) ? !isnan(o.did.jump_power) : !(fabs(o.did.jump_power - rows[k].power) < 0.02))
                fail_msg("%s: %g at %g, not %g", rows[k].force, o.did.jump_power, o.did.jump_time, rows[k].power);
            assert_int_equal(o.did.jump, isnan(rows[k].power) ? -1 : (int)ceil(rows[k].power));
            if (strstr(rows[k].force, "cos(t)"))
                assert_true(isnan(o.did.jump_time) || fabs(o.did.jump_time - acos(-1)) < 1e-14);
        }
    /* x = cos(√2 t) up to x = 0, and from there a straight line */
    const double w = sqrt(2), quarter = acos(0) / w, expected = -w * (3 - quarter);
    const outcome o =
        run_of("x'' = -x - sqrt(x^2)\nx(0) = 1\nx'(0) = 0\nuntil 3\n", "kahan-li8", 0.05, MOTUS_SWITCHES_RESOLVE);
    NEAR(o.x, expected, 1e-14);
    NEAR(o.did.jump_time, quarter, 1e-14);
}

/* A family has a switch for each cell: balls on a line that push each other away when they touch. */
static void families(void **state)
{
    (void)state;
    const char *text =
        "x[i]'' = 100 (max(0, 1 - (x[i] - x[i-1])) - max(0, 1 - (x[i+1] - x[i]))) for i = 1..5\n"
        "x[0] = -100\nx[6] = 100\nx[i](0) = 1.5 i for i = 1..5\nx[1]'(0) = 1\nx[i]'(0) = 0 for i = 2..5\n"
        "until 10\n";
    const outcome o = located(text, "kahan-li8", 0.01), fine = located(text, "kahan-li8", 0.005);
    assert_true(o.did.switches >= 8);
    NEAR(o.x, fine.x, 1e-12);
    NEAR(o.v, fine.v, 1e-12);
    const char *sums = "x[i]'' = -sum(j = 1..3: if(x[i] > x[j], 1, 0)) for i = 1..3\nx[i](0) = i for i = 1..3\n"
                       "x[i]'(0) = -i for i = 1..3\nuntil 1.5\n";
    NEAR(located(sums, "rk4", 0.1).x, located(sums, "rk4", 0.01).x, 1e-13);
}

/* At rest on a switch, where the equation gives 0, the motion stays. */
static void at_rest(void **state)
{
    (void)state;
    NEAR(located("x'' = -sign(x)\nx(0) = 0\nx'(0) = 0\nuntil 5\n", "rk4", 0.1).x, 0, 0);
    NEAR(located("x'' = 1 - |x|\nx(0) = 0\nx'(0) = 0\nuntil 0.5\n", "kahan-li8", 0.1).x, 1 - cos(0.5), 1e-12);
}

/* Friction that sticks: x = 1 - 0.6 - 0.6 at the second turning point is less than 0.3 in size, and there it stays, by
 * rows of every family and in sweeps. */
static void sticking(void **state)
{
    (void)state;
    static const char text[] = "x'' = -x - 0.3 sign(x')\nx(0) = 1\nx'(0) = 0\nuntil 20\n";
    static const struct {
        const char *method;
        double step, within;
    } rows[] = {{"verlet", 0.01, 1e-5}, {"rk4", 0.01, 1e-8},     {"gauss8", 0.1, 1e-13},
                {"newmark", 0.1, 1e-2}, {"suzuki4", 0.01, 1e-7}, {"radau15-fixed", 0.2, 1e-13}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        const outcome o = located(text, rows[k].method, rows[k].step);
        NEAR(o.x, -0.2, rows[k].within);
        assert_true(o.v == 0);
        NEAR(o.t, 20, 0);
    }
    motus_system *s = given_text(text);
    motus_error err = motus_default_error();
    motus_ensemble_def def = motus_default_ensemble();
    motus_ensemble *e = NULL;
    const char *const vary[] = {"x(0)"};
    const double start = 1, *const values[] = {&start};
    const motus_record records[] = {{.column = 1}, {.column = 2}}; /* x and x' behind t */
    double x = NAN, v = NAN, *const results[] = {&x, &v};
    def.vary = vary, def.vary_count = 1;
    def.records = records, def.record_count = 2;
    def.method = "gauss8", def.step = 0.1, def.switches = MOTUS_SWITCHES_LOCATE;
    must(motus_ensemble_create(s, &def, &e, &err), &err, "ensemble");
    must(motus_ensemble_run(e, 1, values, results, NULL, &err), &err, "ensemble");
    const outcome single = located(text, "gauss8", 0.1);
    assert_true(x == single.x && v == single.v);
    motus_ensemble_destroy(e);
    motus_system_destroy(s);
}

/* A root, a power or a logarithm of what is nowhere negative, and asin of what is clipped, are defined for steps that
 * lead beyond a switch, too; so friction holds the motion there as elsewhere. An infinite slope leaves order 3/2. */
static void beyond_a_domain(void **state)
{
    (void)state;
    static const char *const forces[] = {"-x - max(x, 0)^1.5", "-x - sqrt(max(0.3 - x, 0))", "-x - log(max(x, 0.1))",
                                         "-x - asin(max(min(x, 1), -1))", "-x - acos(min(max(-1, x), 1))"};
    for (size_t k = 0; k < sizeof forces / sizeof *forces; k++) {
        char text[256];
        snprintf(text, sizeof text, "x'' = %s\nx(0) = 1.5\nx'(0) = 0\nuntil 4\n", forces[k]);
        NEAR(located(text, "rk4", 0.01).x, located(text, "kahan-li8", 0.005).x, pow(0.01, 1.5) / 10);
    }
    const char *text = "x'' = -x - max(x, 0)^1.5 - 0.3 sign(x')\nx(0) = 1\nx'(0) = 0\nuntil 20\n";
    const outcome o = located(text, "rk4", 0.01);
    NEAR(o.x, located(text, "gauss8", 0.01).x, 1e-7);
    assert_true(o.v == 0);
}

/* Steps without a switch have the bits of other runs, and runs of one system hold sides of their own. */
static void bits(void **state)
{
    (void)state;
    motus_system *s = given_text("x'' = -x |x| + if(t > 3, 1, 0)\nx(0) = 1\nx'(0) = 0\nuntil 4\nstep 0.1\n");
    motus_error err = motus_default_error();
    motus_run *r[3];
    double x[3], v[3];
    for (int k = 0; k < 3; k++) {
        motus_run_def def = motus_default_run();
        def.method = "rk4";
        def.switches = k < 2 ? MOTUS_SWITCHES_LOCATE : MOTUS_SWITCHES_STEP;
        must(motus_run_create(s, &def, &r[k], &err), &err, "run");
    }
    for (int n = 0; n < 12; n++) {
        for (int k = 0; k < 3; k++) {
            must(motus_run_step(r[k], 1, &err), &err, "step");
            must(motus_run_state(r[k], &x[k], &v[k], &err), &err, "state");
        }
        assert_true(x[0] == x[2] && v[0] == v[2] && x[1] == x[0]);
    }
    must(motus_run_finish(r[0], &err), &err, "finish"); /* binds other sides than r[1] stands on */
    must(motus_run_state(r[0], &x[0], &v[0], &err), &err, "state");
    must(motus_run_finish(r[1], &err), &err, "finish");
    must(motus_run_state(r[1], &x[1], &v[1], &err), &err, "state");
    assert_true(x[0] == x[1] && v[0] == v[1]);
    assert_int_equal(motus_run_steps(r[0]), 40);
    assert_true(motus_run_done(r[0]));
    assert_string_equal(motus_run_now(r[0]).machine, "interpreter");
    for (int k = 0; k < 3; k++) motus_run_destroy(r[k]);
    motus_system_destroy(s);
}

/* Times after steps are those of other runs, whatever lies between them; so are counts, also where a leg begins. */
static void times(void **state)
{
    (void)state;
    motus_system *s = given_text("x'' = -sign(x)\nx(0) = 1\nx'(0) = 0\nuntil 4.05\nstep 0.1\n");
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *r;
    def.method = "verlet";
    def.switches = MOTUS_SWITCHES_LOCATE;
    must(motus_run_create(s, &def, &r, &err), &err, "run");
    for (int n = 1; n <= 41; n++) {
        must(motus_run_step(r, 1, &err), &err, "step");
        assert_int_equal(motus_run_steps(r), n);
        NEAR(motus_run_time(r), n < 41 ? 0.1 * n : 4.05, 1e-15);
        NEAR(motus_run_time_of(r, n), motus_run_time(r), 0x1p-51); /* sums of other numbers */
    }
    assert_true(motus_run_done(r));
    double x = 1, v = 0;
    must(motus_run_set_state(r, 0, &x, &v, &err), &err, "leg");
    must(motus_run_finish(r, &err), &err, "finish");
    must(motus_run_state(r, &x, NULL, &err), &err, "state");
    NEAR(x, bouncing(4.05), 1e-14);
    size_t length;
    const motus_trace_entry *const *entries;
    assert_int_equal(motus_run_trace(r, &entries, &length, &err), MOTUS_UNAVAILABLE);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* A step longer than the run is one step: never the start. */
static void a_step_longer_than_the_run(void **state)
{
    (void)state;
    static const double steps[] = {10.5, 1e3, 1e17, 1e300};
    static const char *const methods[] = {"velocity-verlet", "verlet", "verlet-literal", "rk4", "newmark"};
    for (size_t k = 0; k < sizeof steps / sizeof *steps * 5; k++)
        for (int switches = 0; switches < 2; switches++) {
            const outcome o =
                run_of("x'' = -1\nx(0) = 1\nx'(0) = 0\nuntil 10\n", methods[k % 5], steps[k / 5], switches);
            NEAR(o.t, 10, 0);
            NEAR(o.x, -49, 1e-13);
            assert_int_equal(o.did.steps, 1);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parabolas),
        cmocka_unit_test(a_short_kick),
        cmocka_unit_test(there_and_back),
        cmocka_unit_test(orders),
        cmocka_unit_test(which_derivative_jumps),
        cmocka_unit_test(powers_and_touches),
        cmocka_unit_test(families),
        cmocka_unit_test(sticking),
        cmocka_unit_test(beyond_a_domain),
        cmocka_unit_test(at_rest),
        cmocka_unit_test(bits),
        cmocka_unit_test(times),
        cmocka_unit_test(a_step_longer_than_the_run),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
