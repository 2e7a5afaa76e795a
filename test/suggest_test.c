/* The step and the end of a model that gives none. Rates are compared with the eigenvalues that the equation has on
 * paper; the numbers must be round, few enough, and the same wherever they are asked for. */
#include "given.h"

#include <stdbool.h>

static motus_settings suggestion(motus_system *s, double step, double until)
{
    motus_settings set = motus_default_settings();
    motus_error err = motus_default_error();
    motus_settings_of(s, &set);
    if (!isnan(step)) set.step = step;
    if (!isnan(until)) set.until = until;
    must(motus_suggest(s, &set, &err), &err, "motus_suggest");
    return set;
}

/* 1, 2 or 5 times a power of ten: its shortest digits are one digit and zeros. */
static bool is_round(double value)
{
    char text[32];
    snprintf(text, sizeof text, "%.14e", fabs(value));
    return strchr("125", text[0]) && strspn(text + 2, "0") == 14;
}

static const struct {
    const char *text;
    double rate, period, step, until; /* NaN: not compared */
} known[] = {
    {"x'' = -x; x(0) = 1; x'(0) = 0", 1, 6.2832, 0.05, 50},
    {"x'' = -100 x; x(0) = 0; x'(0) = 1", 10, 0.62832, 0.005, 5},
    {"x'' = -x; x(0) = 0; x'(0) = 0", 1, 6.2832, 0.05, 50},             /* at rest: the rates of what might move */
    {"x'' = -9.81; x(0) = 10; x'(0) = 0", 0, 2.0193, 0.02, 2},          /* 2 sqrt(x/a) */
    {"r'' = (0, -10); r(0) = (0, 0); r'(0) = (10, 20)", 0, 4, 0.05, 5}, /* 2 v/a */
    {"x'' = 0; x(0) = 1; x'(0) = 2", 0, 5, 0.05, 5},                    /* 10 x/v */
    {"x'' = 0; x(0) = 0; x'(0) = 0", 0, 10, 0.1, 10},
    {"s' = -2 s; s(0) = 1", 2, 0.5, 0.02, 5},
    {"s' = 3; s(0) = 1", 0, 3.3333, 0.05, 5},
    {"x'' = sin(5 t); x(0) = 0; x'(0) = 0", 5, 1.2566, 0.01, 10},
    {"x'' = cos(5 t); x(0) = 0; x'(0) = 0", 5, 1.2566, 0.01, 10},
    {"x'' = -x + 0.01 sin(100 t); x(0) = 0; x'(0) = 0", 100, 6.2832, 0.0005, 50},
    {"x'' = -x + sin(0.1 t); x(0) = 0; x'(0) = 1", 1, 62.832, 0.05, 500},
    /* λ = -1000 and -0.001: a million steps do not reach ten times 1/0.001 */
    {"x'' = -1000 x' - x; x(0) = 1; x'(0) = 0", 1000, 1000, 0.00005, 50},
    {"x'' = -1000 x' - 1000 x; x(0) = 1; x'(0) = 0", 1000, 1, 0.00005, 10},
    /* λ² = 2 mu/r³ and λ² = -mu/r³ */
    {"r'' = -r/|r|^3; r(0) = (0.4, 0); r'(0) = (0, 2)", 5.5902, 1.5895, 0.01, 20},
    {"r'' = -3.986e14 r/|r|^3; r(0) = (7e6, 0); r'(0) = (0, 7546)", NAN, 5828.5, 50, 50000},
    {"x'' = if(t > 2.5, 1, 0); x(0) = 0; x'(0) = 0", NAN, NAN, 0.2, 200}, /* within the run */
    /* The start tells nothing of the motion: an inflection of the potential, a flight, a place far away. */
    {"x'' = -9.81 sin(x); x(0) = pi/2; x'(0) = 0", 3.1321, NAN, 0.02, NAN},
    {"x'' = -9.81 sin(x); x(1e6) = pi/2; x'(1e6) = 0; until 1000100", 3.1321, NAN, 0.02, 1000100},
    {"x'' = -9.81 sin(x); x(0) = pi/2; x'(0) = 0; until -10", 3.1321, NAN, 0.02, -10},
    {"x'' = if(x < 0, -1e4 x, 0) - 9.81; x(0) = 1; x'(0) = 0", 100, NAN, 0.0005, 0.5},
    {"r'' = -r/|r|^3; r(0) = (1.9, 0); r'(0) = (0, 0.22942)", NAN, 16.456, 0.001, 200}, /* e = 0.9 */
    {"x'' = -(1 + 0.5 cos(20 t)) x; x(0) = 0; x'(0) = 1", 20, 5.1302, 0.002, 50},
    {"k = 1; x'' = -k x; x(0) = 1; x'(0) = 0; when x = 0 falling: k = 100; when x = 0 rising: k = 1", 10, 6.2832, 0.005,
     50},
    /* what runs into a singularity becomes faster without end */
    {"s' = s^2; s(0) = 1", 2, 0.5, 0.02, 5},
    {"x'' = exp(x); x(0) = 0; x'(0) = 0", 1, 1, 0.05, 10},
    {"r'' = -r/|r|^3; r(0) = (1, 0); r'(0) = (0, 0)", 1.4142, 0.70711, 0.05, 5},
};

static void rates(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof known / sizeof *known; k++) {
        motus_system *s = given_text(known[k].text);
        const motus_settings set = suggestion(s, NAN, NAN);
        if (!(isnan(known[k].rate) || fabs(set.rate - known[k].rate) <= 0.02 * known[k].rate) ||
            !(isnan(known[k].period) || fabs(set.period - known[k].period) <= 0.02 * known[k].period) ||
            set.step != known[k].step || !(isnan(known[k].until) || set.until == known[k].until))
            fail_msg("%s: rate %g, period %g, step %.17g, until %.17g", known[k].text, set.rate, set.period, set.step,
                     set.until);
        assert_true(is_round(set.step) && (is_round(set.until) || set.until == known[k].until));
        if (!(set.until / set.step <= 1e6 * (1 + 1e-9) || set.until > 1e6))
            fail_msg("%s: too many steps", known[k].text);
        assert_string_equal(set.method, "verlet");
        motus_system_destroy(s);
    }
}

#define CHAIN                                                            \
    "N = 32\nx[i]'' = x[i+1] - 2 x[i] + x[i-1] for i = 1..N\nx[0] = 0\n" \
    "x[N+1] = 0\nx[i]'(0) = 0 for i = 1..N\n"

/* A chain that moves in its slowest mode, ω = 2 sin(π/66), takes steps for its fastest, 2 sin(32 π/66). */
static void slow_and_fast(void **state)
{
    (void)state;
    const double pi = 3.14159265358979324, slow = 2 * sin(pi / 66), fast = 2 * sin(32 * pi / 66);
    motus_system *s = given_text(CHAIN "x[i](0) = sin(pi i/(N+1)) for i = 1..N\n");
    const motus_settings set = suggestion(s, NAN, NAN);
    assert_true(set.rate > 0.9 * fast && set.rate <= 1.000001 * fast);
    assert_true(fabs(set.period - 2 * pi / slow) < 1e-6 * set.period);
    assert_true(set.step == 0.02 && set.until == 500);
    motus_system_destroy(s);
}

static void given_numbers_stay(void **state)
{
    (void)state;
    motus_system *s = given_text("x'' = -x; x(3) = 1; x'(3) = 0");
    assert_true(suggestion(s, NAN, NAN).until == 53); /* from the start on */
    motus_settings set = suggestion(s, 0.25, NAN);
    assert_true(set.step == 0.25 && set.until == 53);
    set = suggestion(s, NAN, 4);
    assert_true(set.step == 0.01 && set.until == 4); /* at least 100 steps */
    set = suggestion(s, NAN, -1e6);                  /* a million; at 2 verlet would be at its stability limit */
    assert_true(set.step == 1 && set.until == -1e6);
    set = suggestion(s, 1e-6, NAN);
    assert_true(set.step == 1e-6 && fabs(set.until - 4) < 1e-9);
    set = suggestion(s, 0.5, 4);
    assert_true(set.step == 0.5 && set.until == 4 && set.rate == 0);
    motus_system_destroy(s);
    s = given_text("x'' = -x; x(0) = 1; x'(0) = 0; method verlet-literal; until 20 pi"); /* equal steps */
    motus_run *r = given_run(s, NULL, NAN, NAN);
    assert_true(motus_run_now(r).shorter_last == 0 && motus_run_now(r).step < 0.0785);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* However far the end is, no step grows where the motion does not: of the fastest rate of oscillations and of what
 * decays, by every method. */
static void stable_steps(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double re, im;
    } motions[] = {{"x'' = -4 x; x(0) = 1; x'(0) = 0", 0, 2},
                   {"x'' = -x' - 4 x; x(0) = 1; x'(0) = 0", -0.5, 1.9364916731037084},
                   {"x'' = -100 x' - x; x(0) = 1; x'(0) = 0", -99.98999899979995, 0},
                   {"x'' = -4 sin(x); x(0) = pi/2; x'(0) = 0", 0, 2}};
    motus_error err = motus_default_error();
    size_t judged = 0;
    for (size_t m = 0; m < sizeof motions / sizeof *motions; m++) {
        motus_system *s = given_text(motions[m].text);
        const motus_method *card;
        for (size_t k = 0; (card = motus_method_at(k)) != NULL; k++) {
            if (card->adaptive || motus_method_admits(s, card->name, NULL) != MOTUS_OK) continue;
            motus_settings set = motus_default_settings();
            set.method = card->name;
            set.until = 1e9;
            must(motus_suggest(s, &set, &err), &err, "motus_suggest");
            const double longer[] = {set.step * motions[m].re, set.step * motions[m].im};
            double radius;
            if (card->stability_limit == 0 && motions[m].re == 0) continue; /* every step grows */
            must(motus_stability(card->name, 1, &longer[0], &longer[1], &radius, &err), &err, "motus_stability");
            if (!(radius <= 1 + 1e-9))
                fail_msg("%s, %s: step %g grows by %g", motions[m].text, card->name, set.step, radius);
            judged++;
        }
        motus_system_destroy(s);
    }
    assert_true(judged > 60);
}

/* The step suits the fastest of the trajectories, and only them; the end is the system's own. */
static void varied(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    motus_system *s = given_text("k = 1e6; x'' = -k x; x(0) = 1; x'(0) = 0");
    const char *names[] = {"k", "until", "x(0)"}, *numbers[] = {"k", "x(0)"};
    const double k[] = {1, 100, 4}, ends[] = {1, 2, 3}, x[] = {1, 2, INFINITY};
    const double *values[] = {k, ends, x}, *both[] = {k, x};
    motus_ensemble_def def = motus_default_ensemble();
    motus_settings set = motus_default_settings();
    def.vary = numbers, def.vary_count = 2;
    def.until = 50;
    must(motus_ensemble_settings(s, &def, 3, both, &set, &err), &err, "motus_ensemble_settings");
    assert_true(set.step == 0.005 && set.until == 50 && fabs(set.rate - 10) < 1e-9);
    assert_true(set.step_said == MOTUS_SAID_SUGGESTED && set.until_said == MOTUS_SAID_CALLER);
    def.until = NAN;
    must(motus_ensemble_settings(s, &def, 1, both, &set, &err), &err, "motus_ensemble_settings");
    assert_true(set.step == 0.05 && set.until == 0.05); /* at least one step */
    motus_parameter p = motus_default_parameter();
    double own;
    must(motus_parameter_at(s, 0, &p), NULL, "parameter");
    must(motus_parameter_values(s, 0, &own), NULL, "parameter");
    assert_true(own == 1e6); /* the system is as it was */
    def.vary = names, def.vary_count = 3;
    must(motus_ensemble_settings(s, &def, 3, values, &set, &err), &err, "where the ends vary");
    assert_true(set.step > 0 && isnan(set.until) && set.until_said == MOTUS_SAID_NOBODY);
    assert_int_equal(motus_ensemble_settings(s, &def, 1, NULL, &set, &err), MOTUS_ARGUMENT);
    def.vary = (const char *[]){"q"}, def.vary_count = 1;
    assert_int_equal(motus_ensemble_settings(s, &def, 1, values, &set, &err), MOTUS_NAME);
    def.vary_count = 0;
    must(motus_ensemble_settings(s, &def, 0, NULL, &set, &err), &err, "nothing varies");
    assert_true(set.rate > 999);
    motus_system_destroy(s);
    s = given_text("x'' = -9.81 sin(x); x(0) = 0; x'(0) = 0");
    const double starts[] = {1.5707963267948966, 3.14159}, *places[] = {starts};
    def.vary = (const char *[]){"x(0)"}, def.vary_count = 1;
    def.until = 1000;
    must(motus_ensemble_settings(s, &def, 2, places, &set, &err), &err, "motus_ensemble_settings");
    assert_true(set.step == 0.02);
    motus_system_destroy(s);
}

/* Who says what: the definition before the model, the model before a default, and what is missing is suggested. */
static void said(void **state)
{
    (void)state;
    enum { NOBODY = MOTUS_SAID_NOBODY, CALLER, MODEL, ASIDE, DEFAULT, SUGGESTED };
    static const struct {
        const char *text, *method; /* of the model; of the definition */
        double step, tolerance, accuracy;
        const char *settled;
        int who[5]; /* method, step, tolerance, accuracy, until */
    } rows[] = {
        {"", NULL, NAN, NAN, NAN, "auto", {DEFAULT, NOBODY, NOBODY, DEFAULT, SUGGESTED}},
        {"step 0.1; until 5", NULL, NAN, NAN, NAN, "verlet", {DEFAULT, MODEL, NOBODY, NOBODY, MODEL}},
        {"step 0.1", "rk4", NAN, NAN, NAN, "rk4", {CALLER, ASIDE, NOBODY, NOBODY, SUGGESTED}},
        {"step 0.1", "dop853", NAN, NAN, NAN, "dop853", {CALLER, ASIDE, DEFAULT, NOBODY, SUGGESTED}},
        {"until 5", "verlet", NAN, NAN, NAN, "verlet", {CALLER, SUGGESTED, NOBODY, NOBODY, MODEL}},
        {"until 5", NULL, 0.1, NAN, NAN, "verlet", {DEFAULT, CALLER, NOBODY, NOBODY, MODEL}},
        {"method verlet; accuracy 1e-6; until 5", NULL, NAN, NAN, NAN, "verlet", {MODEL, NOBODY, NOBODY, MODEL, MODEL}},
        {"method dopri5; tolerance 1e-6", NULL, NAN, NAN, 1e-3, "auto", {DEFAULT, NOBODY, ASIDE, CALLER, SUGGESTED}},
        {"accuracy 1e-6", NULL, NAN, 1e-5, NAN, "auto", {DEFAULT, NOBODY, CALLER, ASIDE, SUGGESTED}},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[200];
        motus_error err = motus_default_error();
        motus_run_def def = motus_default_run();
        motus_settings set = motus_default_settings();
        snprintf(text, sizeof text, "x'' = -x; x(0) = 1; x'(0) = 0; %s", rows[i].text);
        motus_system *s = given_text(text);
        def.method = rows[i].method;
        def.step = rows[i].step;
        def.tolerance = rows[i].tolerance;
        def.accuracy = rows[i].accuracy;
        must(motus_run_settings(s, &def, &set, &err), &err, text);
        const int who[] = {(int)set.method_said, (int)set.step_said, (int)set.tolerance_said, (int)set.accuracy_said,
                           (int)set.until_said};
        if (strcmp(set.method, rows[i].settled) != 0) fail_msg("row %zu: method %s", i, set.method);
        for (int k = 0; k < 5; k++)
            if (who[k] != rows[i].who[k]) fail_msg("row %zu, setting %d: %d says it", i, k, who[k]);
        /* the run itself has what the record tells */
        motus_run *run = NULL;
        must(motus_run_create(s, &def, &run, &err), &err, text);
        if (!set.automatic) assert_string_equal(motus_run_now(run).method, set.method);
        if (!isnan(set.step)) assert_true(motus_run_now(run).step == set.step);
        must(motus_run_finish(run, &err), &err, text);
        assert_true(motus_run_time(run) == set.until);
        motus_run_destroy(run);
        motus_system_destroy(s);
    }
}

/* Explicit Euler takes x'' = -w^2 x to (1 + w^2 h^2)^(1/2) of its size in a step, and rk4 leaps a pendulum by steps of
 * 2. Steps within the limit of stability do not grow, nor do those of a motion that grows itself. */
static void growth(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    motus_system *s = given_text("k = 1; x'' = -k x; x(0) = 1; x'(0) = 0");
    const char *names[] = {"k"};
    const double k[] = {1, 4}, *values[] = {k};
    motus_settings set = motus_default_settings();
    double powers;
    set.method = "explicit-euler", set.step = 0.1, set.until = 1000;
    must(motus_step_growth(s, 0, NULL, 1, NULL, &set, &powers, &err), &err, "motus_step_growth");
    assert_true(fabs(powers - 5000 * log10(1.01)) < 1e-6);
    must(motus_step_growth(s, 1, names, 2, values, &set, &powers, &err), &err, "motus_step_growth");
    assert_true(fabs(powers - 5000 * log10(1.04)) < 1e-6);
    set.method = "verlet", set.step = 0.99, set.until = 1e9;
    must(motus_step_growth(s, 1, names, 2, values, &set, &powers, &err), &err, "motus_step_growth");
    assert_true(powers == 0);
    set.method = "dop853";
    must(motus_step_growth(s, 0, NULL, 1, NULL, &set, &powers, &err), &err, "motus_step_growth");
    assert_true(powers == 0);
    set.step = NAN;
    assert_int_equal(motus_step_growth(s, 0, NULL, 1, NULL, &set, &powers, &err), MOTUS_ARGUMENT);
    motus_system_destroy(s);
    static const struct {
        const char *text;
        double step;
        int grows;
    } rows[] = {{"x'' = -9.81 sin(x); x(0) = pi/2; x'(0) = 0", 2, 1},
                {"x'' = -9.81 sin(x); x(0) = pi/2; x'(0) = 0", 0.2, 0},
                {"x'' = x; x(0) = 1; x'(0) = 0", 2, 0},
                {"y' = -50 y + 49; y(0) = 0", 0.1, 1},
                {"y' = -50 y + 49; y(0) = 0", 0.05, 0}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        set = motus_default_settings();
        set.method = "rk4", set.step = rows[i].step, set.until = 100;
        s = given_text(rows[i].text);
        must(motus_step_growth(s, 0, NULL, 1, NULL, &set, &powers, &err), &err, "motus_step_growth");
        if ((powers > 2) != rows[i].grows) fail_msg("%s by steps of %g: 10^%g", rows[i].text, rows[i].step, powers);
        motus_system_destroy(s);
    }
}

/* Runs, ensembles and studies have what motus_suggest says; a system that is set anew is measured anew. */
static void everywhere(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    motus_system *s = given_text("k = 1; x'' = -k x; x(0) = 1; x'(0) = 0");
    motus_run *r = given_run(s, "verlet", NAN, NAN);
    assert_true(motus_run_now(r).step == 0.05 && motus_run_now(r).steps_total == 1000);
    motus_run_destroy(r);
    const char *vary[] = {"k"};
    const double values[] = {1, 100}, *given[] = {values};
    double ends[2], *results[] = {ends};
    motus_record record = {.how = MOTUS_REDUCE_FINAL, .column = 0};
    motus_ensemble_def def = motus_default_ensemble();
    def.vary = vary, def.vary_count = 1, def.records = &record, def.record_count = 1, def.machine = "interpreter";
    motus_ensemble *e = NULL;
    must(motus_ensemble_create(s, &def, &e, &err), &err, "ensemble");
    must(motus_ensemble_run(e, 2, given, results, NULL, &err), &err, "ensemble");
    assert_true(motus_ensemble_now(e).steps == 1000 && ends[0] == 50 && ends[1] == 50);
    motus_ensemble_destroy(e);
    motus_study_def study = motus_default_study();
    const char *methods[] = {"verlet"};
    study.methods = methods, study.method_count = 1;
    motus_comparison *c = NULL;
    must(motus_compare(s, &study, &c, &err), &err, "compare");
    assert_true(c->rows[0]->step == 0.05 && c->rows[0]->steps == 1000);
    motus_comparison_destroy(c);
    const double k = 100;
    must(motus_system_set(s, "k", &k, 1, &err), &err, "set");
    assert_true(suggestion(s, NAN, NAN).until == 5);
    motus_system_destroy(s);
}

/* By difference quotients, with their noise: two oscillators and a coordinate that nothing acts on. */
static int springs(void *context, double t, const double *x, const double *v, double *a)
{
    (void)t;
    (void)v;
    ++*(int *)context;
    a[0] = -x[0], a[1] = -25 * x[1], a[2] = 0;
    return x[0] > 1.5 ? 7 : 0;
}

static void callbacks(void **state)
{
    (void)state;
    int calls = 0;
    double x[] = {1, 1, 5}, v[] = {0, 0, 0.5};
    motus_error err = motus_default_error();
    motus_callback_def def = motus_default_callback();
    def.positions = 3, def.x = x, def.v = v, def.acceleration = springs, def.context = &calls;
    def.depends_on_velocity = def.depends_on_time = 0;
    motus_system *s = NULL;
    must(motus_system_from_callback(&def, &s, &err), &err, "callback");
    motus_run *r = NULL;
    assert_int_equal(motus_run_create(s, NULL, &r, &err), MOTUS_ARGUMENT); /* evaluates nothing */
    assert_int_equal(calls, 0);
    assert_non_null(strstr(err.hint, "motus_suggest"));
    const motus_settings set = suggestion(s, NAN, NAN);
    assert_true(calls > 0 && fabs(set.rate - 5) < 0.01 && fabs(set.period - 6.2832) < 0.01);
    assert_true(set.step == 0.01 && set.until == 50);
    motus_system_destroy(s);
    x[0] = 2;
    must(motus_system_from_callback(&def, &s, &err), &err, "callback");
    motus_settings failing = motus_default_settings();
    assert_int_equal(motus_suggest(s, &failing, &err), MOTUS_CALLBACK);
    assert_true(isnan(failing.step));
    motus_system_destroy(s);
}

static void wrong_requests(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    motus_settings set = motus_default_settings();
    motus_system *s = given_text("x'' = -x; x(0) = 1; x'(0) = 0");
    assert_int_equal(motus_suggest(NULL, &set, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_suggest(s, NULL, &err), MOTUS_ARGUMENT);
    set.step = -1;
    assert_int_equal(motus_suggest(s, &set, &err), MOTUS_ARGUMENT);
    set.step = NAN, set.until = INFINITY;
    assert_int_equal(motus_suggest(s, &set, &err), MOTUS_ARGUMENT);
    set.until = NAN, set.method = "verlt";
    assert_int_equal(motus_suggest(s, &set, &err), MOTUS_METHOD);
    set.size = 0;
    assert_int_equal(motus_suggest(s, &set, &err), MOTUS_ARGUMENT);
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    def.step = -1; /* what is wrong is said, although the end is missing too */
    assert_int_equal(motus_run_create(s, &def, &r, &err), MOTUS_ARGUMENT);
    assert_non_null(strstr(err.message, "positive"));
    motus_system_destroy(s);
}

/* A force that is not finite at the start, or has no scale, has numbers all the same: the run says what is wrong. */
static void no_scale(void **state)
{
    (void)state;
    const char *texts[] = {"x'' = 1/x; x(0) = 0; x'(0) = 0",         "x'' = -x^3; x(0) = 0; x'(0) = 1",
                           "x'' = exp(t); x(0) = 0; x'(0) = 0",      "x'' = sqrt(1 - t); x(0) = 0; x'(0) = 0",
                           "x'' = 1e300 x; x(0) = 1e300; x'(0) = 0", "x'' = t; x(0) = 0; x'(0) = 0"};
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) {
        motus_system *s = given_text(texts[k]);
        const motus_settings set = suggestion(s, NAN, NAN);
        if (!(set.step > 0 && isfinite(set.step) && set.until > 0 && set.until / set.step <= 1.0001e6))
            fail_msg("%s: step %g, until %g", texts[k], set.step, set.until);
        motus_system_destroy(s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rates),      cmocka_unit_test(slow_and_fast), cmocka_unit_test(given_numbers_stay),
        cmocka_unit_test(everywhere), cmocka_unit_test(callbacks),     cmocka_unit_test(wrong_requests),
        cmocka_unit_test(no_scale),   cmocka_unit_test(stable_steps),  cmocka_unit_test(varied),
        cmocka_unit_test(said),       cmocka_unit_test(growth),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
