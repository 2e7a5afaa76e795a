/* The calls for bars of error: what they promise besides the bars themselves, which bars_test.c judges. */
#include "api/system/system.h"
#include "test/given.h"

#include <stdbool.h>

static motus_run *barred(motus_system *s, const char *method, double step, double until, motus_bars kind)
{
    motus_run_def def = motus_default_run();
    motus_error err = motus_default_error();
    motus_run *r = NULL;
    def.method = method;
    def.step = step;
    def.until = until;
    def.machine = "interpreter";
    def.error = kind;
    must(motus_run_create(s, &def, &r, &err), &err, method ? method : "run");
    return r;
}

static double bar_of(const motus_system *s, motus_run *r, const char *name)
{
    const size_t k = column(s, name);
    double bar = NAN;
    motus_error err = motus_default_error();
    must(motus_run_errors(r, &k, 1, NULL, &bar, &err), &err, name);
    return bar;
}

static motus_estimate estimate_of(motus_run *r)
{
    motus_estimate e = motus_default_estimate();
    motus_error err = motus_default_error();
    must(motus_run_estimate(r, &e, &err), &err, "estimate");
    return e;
}

static void the_founding_number(void **state)
{
    (void)state;
    motus_system *s = given_model("driven-oscillator.motus", NULL, 0);
    motus_run *r = barred(s, NULL, NAN, NAN, MOTUS_BARS_CHEAP);
    finish(r);
    const double error = fabs(value(s, r, "x") - 0.04778309565760847), bar = bar_of(s, r, "x");
    assert_true(error <= bar && bar <= 4 * error);
    const motus_estimate e = estimate_of(r);
    assert_string_equal(e.reason, "");
    assert_true(isnan(e.significant_until) && !e.kinked);
    assert_true(e.work >= 2 && e.work < 2.02);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* By every method that the model admits, on a motion of vectors with a shorter last step. */
static void the_bits_are_the_same(void **state)
{
    (void)state;
    motus_system *s = given_text("r'' = -r/|r|^3 + 0.1 cross(r', (0, 0, 1))\nr(0) = (1, 0, 0.1)\nr'(0) = (0, 1, 0)\n"
                                 "L = cross(r, r')\n");
    for (size_t k = 0; k < motus_method_count(); k++) {
        const char *method = motus_method_at(k)->name;
        if (motus_method_admits(s, method, NULL) != MOTUS_OK) continue;
        const double step = 0.02;
        if (motus_method_at(k)->adaptive) continue;
        const double until = strcmp(method, "verlet-literal") ? 3.01 : 3;
        motus_run *with = barred(s, method, step, until, MOTUS_BARS_FULL), *without = given_run(s, method, step, until);
        const size_t column = 1;
        const double times[3] = {0.031, 0.04, 1.999};
        double got[3], bars[3], wanted[3];
        motus_error err = motus_default_error();
        must(motus_run_sample_errors(with, times, 3, &column, 1, got, bars, &err), &err, method);
        must(motus_run_sample(without, times, 3, &column, 1, wanted, &err), &err, method);
        for (int i = 0; i < 3; i++) assert_true(got[i] == wanted[i] && bars[i] > 0 && bars[i] < 1);
        finish(with);
        finish(without);
        assert_true(bar_of(s, with, "L.x") > 0);
        same_state(s, with, without, "with bars and without");
        assert_true(motus_run_now(with).evaluations == motus_run_now(without).evaluations);
        motus_run_destroy(with);
        motus_run_destroy(without);
    }
    motus_system_destroy(s);
}

/* The companion of steps that adapt takes each of them in two halves: its work is twice the run's, but for refused
 * steps, and evaluations that a step shares with the next. */
static void steps_that_adapt(void **state)
{
    (void)state;
    motus_system *s = given_model("kepler.motus", NULL, 0);
    static const char *const methods[] = {"dopri5", "dop853", "radau15", "gragg-stormer", "gragg"};
    for (int m = 0; m < 5; m++) {
        motus_run_def def = motus_default_run();
        motus_error err = motus_default_error();
        motus_run *r[2] = {NULL, NULL};
        def.method = methods[m];
        def.tolerance = 1e-8;
        def.machine = "interpreter";
        for (int i = 0; i < 2; i++) {
            def.error = i ? MOTUS_BARS_FULL : MOTUS_BARS_NONE;
            must(motus_run_create(s, &def, &r[i], &err), &err, methods[m]);
            finish(r[i]);
        }
        same_state(s, r[0], r[1], "with bars and without");
        assert_true(fabs(value(s, r[1], "r.x") + 1.6) <= bar_of(s, r[1], "r.x"));
        assert_true(fabs(value(s, r[1], "r'.y") + 0.5) <= bar_of(s, r[1], "r'.y"));
        assert_true(bar_of(s, r[1], "r.x") < 1e-4);
        assert_true(estimate_of(r[1]).work > 1.5 && estimate_of(r[1]).work < 4);
        motus_run_destroy(r[0]);
        motus_run_destroy(r[1]);
    }
    motus_system_destroy(s);
}

/* Both halves of a step are of its order, where a step chooses that: their work is twice that of the steps that were
 * not refused. At this tolerance that of the order by which the method is listed would be four times the run's. */
static void halves_of_the_same_order(void **state)
{
    (void)state;
    motus_system *s = given_model("kepler.motus", NULL, 0);
    motus_run_def def = motus_default_run();
    motus_error err = motus_default_error();
    motus_run *r = NULL;
    def.method = "gragg-stormer";
    def.tolerance = 1e-3;
    def.error = MOTUS_BARS_FULL;
    def.machine = "interpreter";
    must(motus_run_create(s, &def, &r, &err), &err, def.method);
    finish(r);
    assert_true(estimate_of(r).work > 1 && estimate_of(r).work <= 2);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* The compiled machine's bits are the interpreter's, so are its bars. */
static void bars_are_the_same_on_every_machine(void **state)
{
    (void)state;
    motus_system *s = given_text("x'' = -x + 0.3 x^3\nx(0) = 0.7\nx'(0) = 0\nstep 0.01\nuntil 20\n");
    motus_run_def def = motus_default_run();
    motus_error err = motus_default_error();
    motus_run *r[2] = {NULL, NULL};
    for (int i = 0; i < 2; i++) {
        def.machine = i ? "compiled" : "interpreter";
        def.error = MOTUS_BARS_FULL;
        const motus_status status = motus_run_create(s, &def, &r[i], &err);
        if (status == MOTUS_TOOL) break; /* there is no compiler */
        must(status, &err, def.machine);
        finish(r[i]);
    }
    if (r[1]) assert_true(bar_of(s, r[0], "x") == bar_of(s, r[1], "x"));
    motus_run_destroy(r[0]);
    motus_run_destroy(r[1]);
    motus_system_destroy(s);
}

static void numbers_that_are_exact(void **state)
{
    (void)state;
    motus_system *s = given_text("r'' = -r/|r|^3\nr(0) = (1, 0, 0)\nr'(0) = (0, 1, 0)\nstep 0.1\nuntil 10\n");
    motus_run *r = barred(s, "rk4", NAN, NAN, MOTUS_BARS_CHEAP);
    finish(r);
    assert_true(bar_of(s, r, "t") == 0 && bar_of(s, r, "r.z") == 0 && bar_of(s, r, "r'.z") == 0);
    assert_true(bar_of(s, r, "r.x") > 1e-7);
    motus_run_destroy(r);
    /* without an error of the method there is still that of rounding: never 0 */
    r = barred(s, "gauss8", 0.01, 0.01, MOTUS_BARS_CHEAP);
    finish(r);
    assert_true(bar_of(s, r, "r.x") >= 0x1p-52);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* 0.1 lies between the system's number and its shadow's; 0.5 is a double; numbers that were set are doubles too. */
static void decimals_lie_between(void **state)
{
    (void)state;
    const char *const set[] = {"b=0.7"};
    motus_system *s = given_text_with("a = 0.1\nb = 0.2\nc = 0.5\nd = 2 pi\ne = -0.3\nf = 3 b\n"
                                      "x'' = -a b c d e f x\nx(0) = 0.6\nx'(0) = 1e-3\nstep 0.1\nuntil 1\n",
                                      set, 1, "decimals");
    motus_system *shadow = NULL;
    motus_error err = motus_default_error();
    must(shadow_create(s, NULL, &shadow, &err), &err, "shadow");
    const struct {
        long double number;
        double tolerance;
    } wanted[] = {{0.1L, 0}, {0.7L, 0}, {0.5L, 0}, {6.283185307179586476925L, 0}, {-0.3L, 0}};
    for (size_t k = 0; k < 5; k++) {
        double ours, other;
        motus_parameter_values(s, k, &ours);
        motus_parameter_values(shadow, k, &other);
        const long double low = fminl(ours, other), high = fmaxl(ours, other);
        assert_true(low <= wanted[k].number && wanted[k].number <= high);
        assert_true((k == 2) == (ours == other));
        assert_true(nextafter(ours, other) == other);
    }
    double x[2], v[2];
    motus_initial_values(s, 0, &x[0]);
    motus_initial_values(shadow, 0, &x[1]);
    motus_initial_values(s, 1, &v[0]);
    motus_initial_values(shadow, 1, &v[1]);
    assert_true(x[0] == 0.6 && nextafter(x[0], 1) == x[1]); /* the double 0.6 is below six tenths */
    assert_true(v[0] == 1e-3 && nextafter(v[0], 0) == v[1]);
    motus_system_destroy(shadow);
    const double third = 1.0 / 3;
    must(motus_system_set(s, "a", &third, 1, &err), &err, "set");
    must(motus_system_set(s, "x(0)", &third, 1, &err), &err, "set");
    must(shadow_create(s, NULL, &shadow, &err), &err, "shadow");
    motus_parameter_values(shadow, 0, &x[0]);
    motus_initial_values(shadow, 0, &x[1]);
    motus_parameter_values(shadow, 1, &v[0]);
    motus_parameter_values(s, 1, &v[1]);
    assert_true(x[0] == third && x[1] == third && v[0] != v[1]);
    motus_system_destroy(shadow);
    motus_system_destroy(s);
}

/* 1/3 is rounded, and without that the phase of this motion has an error that run and companion share: of these 64
 * numbers 54 would be covered. 3/4 is a double, and 1 - m is left alone, since m moves. */
static void rounded_parameters_move(void **state)
{
    (void)state;
    motus_system *s = given_text("k = 1/3\nl = 3/4\nm = 0.1\nn = 1 - m\nw = sqrt(k)\nx'' = -k x + 0 (l + m + n + w)\n"
                                 "x(0) = 1\nx'(0) = 0\n"),
                 *shadow = NULL;
    motus_error err = motus_default_error();
    must(shadow_create(s, NULL, &shadow, &err), &err, "shadow");
    for (size_t k = 0; k < 5; k++) {
        double ours, other;
        motus_parameter_values(s, k, &ours);
        motus_parameter_values(shadow, k, &other);
        assert_true(k == 0 ? other == nextafter(ours, 1) : k == 1 ? other == ours : fabs(other - ours) <= 0x1p-53);
    }
    motus_system_destroy(shadow);
    static const char *const methods[] = {"gauss8", "kahan-li8"};
    const long double w = sqrtl(1 / 3.0L);
    int covered = 0;
    for (int m = 0; m < 2; m++)
        for (double step = 0.05; step < 0.5; step *= 2)
            for (double until = 500; until < 5000; until *= 2) {
                motus_run *r = barred(s, methods[m], step, until, MOTUS_BARS_CHEAP);
                finish(r);
                covered += fabsl(value(s, r, "x") - cosl(w * until)) <= bar_of(s, r, "x");
                covered += fabsl(value(s, r, "x'") + w * sinl(w * until)) <= bar_of(s, r, "x'");
                motus_run_destroy(r);
            }
    assert_true(covered >= 63);
    motus_system_destroy(s);
}

/* Where a decimal decides a size, its neighbour gives no system, or another one. */
static void a_decimal_that_decides_a_size(void **state)
{
    (void)state;
    motus_system *s = given_text("h = 0.1\nN = 1/h\nx[i]'' = -0.3 x[i] for i = 1..N\nx[i](0) = i for i = 1..N\n"
                                 "x[i]'(0) = 0 for i = 1..N\nstep 0.1\nuntil 1\n");
    motus_run *r = barred(s, "rk4", NAN, NAN, MOTUS_BARS_CHEAP);
    finish(r);
    assert_true(bar_of(s, r, "x[3]") > 0);
    assert_string_equal(estimate_of(r).reason, "");
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* The exponent of this motion is 0.05, its horizon with errors of 1e-9 some 400 to 500. */
static void chaos_ends_significance(void **state)
{
    (void)state;
    motus_system *s = given_model("henon-heiles.motus", NULL, 0);
    motus_run *r = barred(s, "pefrl", 0.05, 900, MOTUS_BARS_CHEAP);
    finish(r);
    const motus_estimate e = estimate_of(r);
    assert_true(e.significant_until > 200 && e.significant_until < 600);
    assert_true(e.rate > 0.025 && e.rate < 0.1);
    assert_true(isinf(bar_of(s, r, "x")) && isinf(bar_of(s, r, "energy")));
    assert_true(bar_of(s, r, "t") == 0);
    motus_run_destroy(r);
    /* the regular motion of the same equations keeps its digits */
    const char *const regular[] = {"x(0)=0", "y(0)=0.1", "x'(0)=0.39", "y'(0)=0.05"};
    motus_system *other = given_model("henon-heiles.motus", regular, 4);
    r = barred(other, "pefrl", 0.05, 900, MOTUS_BARS_CHEAP);
    finish(r);
    assert_true(isnan(estimate_of(r).significant_until) && isnan(estimate_of(r).rate));
    assert_true(bar_of(other, r, "x") < 1e-3);
    motus_run_destroy(r);
    motus_system_destroy(other);
    motus_system_destroy(s);
}

static void a_force_with_kinks_says_so(void **state)
{
    (void)state;
    motus_system *s = given_text("x'' = -x - 0.5 |x|\nx(0) = 1\nx'(0) = 0\nstep 0.01\nuntil 10\n");
    motus_run *r = barred(s, "rk4", NAN, NAN, MOTUS_BARS_CHEAP);
    finish(r);
    assert_true(estimate_of(r).kinked);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* ---- callbacks ---- */

typedef struct device {
    int calls, remembers;
} device;

static int pull(void *context, double t, const double *x, const double *v, double *a)
{
    device *d = context;
    (void)v;
    d->calls++;
    a[0] = -x[0] + x[0] * x[0] * x[0] + 0.1 * cos(t) + (d->remembers ? 1e-9 * d->calls : 0);
    return 0;
}

static motus_system *of_callback(device *d)
{
    static const double x = 0, v = 0;
    motus_callback_def def = motus_default_callback();
    motus_error err = motus_default_error();
    motus_system *s = NULL;
    def.positions = 1;
    def.x = &x;
    def.v = &v;
    def.acceleration = pull;
    def.depends_on_velocity = 0;
    def.context = d;
    must(motus_system_from_callback(&def, &s, &err), &err, "callback");
    return s;
}

static void callbacks_have_companions(void **state)
{
    (void)state;
    device d = {0}, forgetful = {.remembers = 1};
    motus_system *s = of_callback(&d);
    motus_run *r = barred(s, "rk4", 0.05, 100, MOTUS_BARS_CHEAP);
    finish(r);
    const double error = fabs(value(s, r, "x") - 0.04778309565760847), bar = bar_of(s, r, "x");
    assert_true(error <= bar && bar <= 10 * error);
    motus_run_destroy(r);
    motus_system_destroy(s);
    s = of_callback(&forgetful);
    r = barred(s, "rk4", 0.05, 100, MOTUS_BARS_CHEAP);
    finish(r);
    assert_true(isnan(bar_of(s, r, "x")));
    assert_non_null(strstr(estimate_of(r).reason, "gives another acceleration"));
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* ---- what a run may do ---- */

static void refusals(void **state)
{
    (void)state;
    motus_system *s = given_text("x'' = -x\nx(0) = 1\nx'(0) = 0\nstep 0.1\nuntil 1\n");
    motus_run *r = given_run(s, NULL, NAN, NAN);
    motus_error err = motus_default_error();
    motus_estimate e = motus_default_estimate();
    size_t k = 1;
    double bar;
    assert_int_equal(motus_run_errors(r, &k, 1, NULL, &bar, &err), MOTUS_ARGUMENT);
    assert_non_null(strstr(err.hint, "MOTUS_BARS_CHEAP"));
    assert_int_equal(motus_run_sample_errors(r, &bar, 0, &k, 1, NULL, &bar, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_run_estimate(r, &e, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_run_errors(NULL, &k, 1, NULL, &bar, &err), MOTUS_ARGUMENT);
    motus_run_destroy(r);
    r = barred(s, NULL, NAN, NAN, MOTUS_BARS_CHEAP);
    k = 99;
    assert_int_equal(motus_run_errors(r, &k, 1, NULL, &bar, &err), MOTUS_ARGUMENT);
    e.size = 3;
    assert_int_equal(motus_run_estimate(r, &e, &err), MOTUS_ARGUMENT);
    motus_run_destroy(r);
    motus_run_def def = motus_default_run();
    def.error = (motus_bars)7;
    assert_int_equal(motus_run_create(s, &def, &r, &err), MOTUS_ARGUMENT);
    assert_non_null(strstr(err.message, "no kind of bars"));
    motus_system_destroy(s);
}

static char *saved(motus_run *r, size_t *length)
{
    motus_error err = motus_default_error();
    const char *text;
    must(motus_run_save(r, &text, length, &err), &err, "save");
    char *kept = strdup(text);
    assert_non_null(kept);
    return kept;
}

static motus_run *restored(motus_system *s, const char *method, double step, double until, motus_bars kind,
                           const char *kept, size_t length)
{
    motus_error err = motus_default_error();
    motus_run *r = barred(s, method, step, until, kind);
    must(motus_run_restore(r, kept, length, &err), &err, method);
    return r;
}

/* The bars of a run that was restored are those of the run that was saved: in its middle, and at its end, which may be
 * after a shorter step that is not in the state. Later they cover the errors from the very start, which are many times
 * those since the state: the energy's has come about before it. */
static void a_restored_run_has_its_bars(void **state)
{
    (void)state;
    static const struct {
        const char *method;
        double step;
        motus_bars kind;
        bool twice; /* the twin goes on too */
    } all[] = {{"rk4", 0.125, MOTUS_BARS_CHEAP, true},   {"rk4", 0.07, MOTUS_BARS_CHEAP, true},
               {"euler", 0.001, MOTUS_BARS_CHEAP, true}, {"verlet", 0.125, MOTUS_BARS_FULL, true},
               {"verlet", 0.03, MOTUS_BARS_FULL, false}, {"dop853", NAN, MOTUS_BARS_CHEAP, true},
               {"dopri5", NAN, MOTUS_BARS_FULL, true},   {"taylor", NAN, MOTUS_BARS_CHEAP, true},
               {"gragg", NAN, MOTUS_BARS_CHEAP, true}};
    static const char *const text = "x'' = -1.1 x\nx(0) = 1\nx'(0) = 0\nz' = 0.1 z\nz(0) = 0\n";
    static const char *const names[] = {"x", "x'", "z"};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        motus_system *s = given_text(text), *other = given_text(text);
        motus_run *r = barred(s, all[k].method, all[k].step, 10, all[k].kind);
        size_t length;
        for (int end = 0; end < 2; end++) {
            double bars[3];
            if (end)
                finish(r);
            else
                take_steps(r, 7);
            char *kept = saved(r, &length);
            for (int i = 0; i < 3; i++) bars[i] = bar_of(s, r, names[i]);
            motus_run *again = restored(other, all[k].method, all[k].step, 10, all[k].kind, kept, length);
            if (end) finish(again);
            for (int i = 0; i < 3 && (all[k].twice || !end); i++)
                if (bar_of(other, again, names[i]) != bars[i])
                    fail_msg("%s, %s: ± %g, and restored ± %g", all[k].method, names[i], bars[i],
                             bar_of(other, again, names[i]));
            assert_true(bars[2] == 0);
            motus_run_destroy(again);
            motus_run *later = restored(other, all[k].method, all[k].step, 40, all[k].kind, kept, length),
                      *whole = barred(s, all[k].method, all[k].step, 40, all[k].kind);
            finish(later);
            finish(whole);
            const double x = cos(40 * sqrt(1.1)), bar = bar_of(other, later, "x"), like = bar_of(s, whole, "x");
            if (!(fabs(value(other, later, "x") - x) <= bar && bar <= 10 * like))
                fail_msg("%s: off by %g, ± %g, and ± %g of a run that was not interrupted", all[k].method,
                         value(other, later, "x") - x, bar, like);
            motus_run_destroy(later);
            motus_run_destroy(whole);
            free(kept);
        }
        motus_run_destroy(r);
        motus_system_destroy(s);
        motus_system_destroy(other);
    }
}

/* Where no digit is significant before, none is after. */
static void a_restored_run_stays_lost(void **state)
{
    (void)state;
    static const char *const text = "x'' = -sin(x) - 0.5 x' + 1.2 cos(2 t/3)\nx(0) = 1\nx'(0) = 0\n";
    motus_system *s = given_text(text);
    motus_run *r = barred(s, "dopri5", NAN, 1000, MOTUS_BARS_CHEAP);
    size_t length;
    finish(r);
    const double since = estimate_of(r).significant_until;
    assert_true(since < 1000 && isinf(bar_of(s, r, "x")));
    char *kept = saved(r, &length);
    motus_run *again = restored(s, "dopri5", NAN, 1010, MOTUS_BARS_CHEAP, kept, length);
    assert_true(isinf(bar_of(s, again, "x")) && estimate_of(again).significant_until == since);
    finish(again);
    assert_true(isinf(bar_of(s, again, "x")));
    motus_run_destroy(again);
    free(kept);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

static void a_state_without_errors_has_a_reason(void **state)
{
    (void)state;
    motus_system *s = given_text("x'' = -x\nx(0) = 1\nx'(0) = 0\nstep 0.1\nuntil 10\n");
    motus_run *r = barred(s, NULL, NAN, NAN, MOTUS_BARS_NONE);
    motus_error err = motus_default_error();
    size_t length;
    take_steps(r, 50);
    char *kept = saved(r, &length);
    motus_run_destroy(r);
    r = restored(s, NULL, NAN, NAN, MOTUS_BARS_CHEAP, kept, length);
    finish(r);
    assert_true(isnan(bar_of(s, r, "x")) && isfinite(value(s, r, "x")));
    assert_non_null(strstr(estimate_of(r).reason, "restored from a state without its error"));
    /* a new leg begins without an error */
    const double x = 1, v = 0;
    must(motus_run_set_state(r, 0, &x, &v, &err), &err, "leg");
    finish(r);
    assert_true(bar_of(s, r, "x") > 0 && bar_of(s, r, "x") < 0.1);
    assert_true(fabs(value(s, r, "x") - cos(10)) <= bar_of(s, r, "x"));
    free(kept);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

static int watch(void *context, motus_run *r)
{
    double *worst = context, bar;
    const size_t k = 1;
    motus_error err = motus_default_error();
    must(motus_run_errors(r, &k, 1, NULL, &bar, &err), &err, "in the observer");
    assert_int_equal(motus_run_sample_errors(r, &bar, 1, &k, 1, NULL, &bar, &err), MOTUS_ARGUMENT);
    *worst = fmax(*worst, bar);
    return 0;
}

/* In its observer, after every step; and across a traced step. */
static void while_it_runs(void **state)
{
    (void)state;
    motus_system *s = given_text("x'' = -x\nx(0) = 1\nx'(0) = 0\nstep 0.1\nuntil 10\n");
    motus_run_def def = motus_default_run();
    motus_error err = motus_default_error();
    motus_run *r = NULL;
    double worst = 0;
    def.error = MOTUS_BARS_CHEAP;
    def.observer = watch;
    def.context = &worst;
    must(motus_run_create(s, &def, &r, &err), &err, "run");
    const motus_trace_entry *const *entries;
    size_t count;
    assert_true(bar_of(s, r, "x") <= 0x1p-50);
    must(motus_run_trace(r, &entries, &count, &err), &err, "trace");
    finish(r);
    assert_true(worst > 1e-4 && worst < 0.1);
    assert_true(fabs(value(s, r, "x") - cos(10)) <= bar_of(s, r, "x"));
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* Backward, and from a state of the caller's. */
static void from_elsewhere(void **state)
{
    (void)state;
    motus_system *s = given_text("x'' = -x\nx(0) = 1\nx'(0) = 0\n");
    motus_run_def def = motus_default_run();
    motus_error err = motus_default_error();
    motus_run *r = NULL;
    const double x = cos(3), v = -sin(3);
    def.x = &x;
    def.v = &v;
    def.start = 3;
    def.until = -7;
    def.step = 0.03;
    def.error = MOTUS_BARS_FULL;
    must(motus_run_create(s, &def, &r, &err), &err, "backward");
    finish(r);
    const double error = fabs(value(s, r, "x") - cos(7)), bar = bar_of(s, r, "x");
    assert_true(error <= bar && bar <= 10 * error);
    assert_true(fabs(value(s, r, "x'") - sin(7)) <= bar_of(s, r, "x'"));
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* A run that may not finish its companion stays a sound run, whose number is right and has no bar. */
static void a_cancelled_companion(void **state)
{
    (void)state;
    motus_system *s = given_text("N = 300\nx[i]'' = sum(j = 1..N: sin(x[j] - x[i]))/N for i = 1..N\n"
                                 "x[i](0) = i for i = 1..N\nx[i]'(0) = 0 for i = 1..N\nstep 0.1\nuntil 20\n");
    motus_run_def def = motus_default_run();
    motus_error err = motus_default_error();
    motus_run *r = NULL, *plain = given_run(s, "rk4", NAN, NAN);
    given_progress watch = {.cancel_at = 3};
    def.method = "rk4";
    def.machine = "interpreter";
    def.progress = given_observe;
    def.context = &watch;
    def.error = MOTUS_BARS_CHEAP;
    must(motus_run_create(s, &def, &r, &err), &err, "run");
    assert_int_equal(motus_run_finish(r, &err), MOTUS_CANCELLED);
    finish(r);
    finish(plain);
    same_state(s, r, plain, "after a cancellation");
    motus_run_destroy(r);
    motus_run_destroy(plain);
    motus_system_destroy(s);
}

/* Where the run fails its last good state has no bar. */
static void a_run_that_fails(void **state)
{
    (void)state;
    motus_system *s = given_text("x'' = x^3\nx(0) = 1\nx'(0) = 1\nstep 0.01\nuntil 10\n");
    motus_run *r = barred(s, "rk4", NAN, NAN, MOTUS_BARS_CHEAP);
    motus_error err = motus_default_error();
    assert_int_equal(motus_run_finish(r, &err), MOTUS_DIVERGED);
    assert_false(isfinite(bar_of(s, r, "x")));
    const motus_estimate e = estimate_of(r);
    assert_true(e.reason[0] || !isnan(e.significant_until));
    motus_run_destroy(r);
    motus_system_destroy(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_founding_number),
        cmocka_unit_test(the_bits_are_the_same),
        cmocka_unit_test(steps_that_adapt),
        cmocka_unit_test(halves_of_the_same_order),
        cmocka_unit_test(bars_are_the_same_on_every_machine),
        cmocka_unit_test(numbers_that_are_exact),
        cmocka_unit_test(decimals_lie_between),
        cmocka_unit_test(rounded_parameters_move),
        cmocka_unit_test(a_decimal_that_decides_a_size),
        cmocka_unit_test(chaos_ends_significance),
        cmocka_unit_test(a_force_with_kinks_says_so),
        cmocka_unit_test(callbacks_have_companions),
        cmocka_unit_test(refusals),
        cmocka_unit_test(a_restored_run_has_its_bars),
        cmocka_unit_test(a_restored_run_stays_lost),
        cmocka_unit_test(a_state_without_errors_has_a_reason),
        cmocka_unit_test(while_it_runs),
        cmocka_unit_test(from_elsewhere),
        cmocka_unit_test(a_cancelled_companion),
        cmocka_unit_test(a_run_that_fails),
    };
    return cmocka_run_group_tests_name("the calls for bars of error", tests, NULL, NULL);
}
