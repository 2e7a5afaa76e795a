/* `accuracy` and "auto": no accuracy is claimed that does not hold, what cannot be reached is said, and a run that was
 * found for an accuracy has the bits of one that was asked for by its method and its tolerance.
 */
#include "api/motion/later.h"
#include "test/given.h"
#include "test/given_cache.h"
#include "test/share.h"

#include <stdbool.h>

/* Motions known to 22 digits, by three programs that agree. */
typedef struct known {
    const char *name, *text, *numbers[4];
    double until, truth[4];
} known;
static const known motions[] = {
    {"driven",
     "x'' = -x + x^3 + 0.1 cos(t); x(0) = 0; x'(0) = 0",
     {"x", "x'"},
     100,
     {0.04778309565760846604, -0.1828561957230886}},
    {"damped",
     "x'' = -x' - x^3; x(0) = 10; x'(0) = 0",
     {"x", "x'"},
     3,
     {-3.489418164528281725538, 5.481332827158467425440}},
    {"drag",
     "g = (0, -9.81)\nr'' = g - 0.01 |r'| r'\nr(0) = (0, 0)\nr'(0) = (30, 40)",
     {"r.x", "r.y", "r'.x", "r'.y"},
     4,
     {71.19950096636553408419, 34.15358119821233069882, 12.08304460308637064419, -12.13748519972333888675}},
    {"kepler",
     "r'' = -r/|r|^3\nr(0) = (0.4, 0)\nr'(0) = (0, 2)",
     {"r.x", "r.y", "r'.x", "r'.y"},
     50,
     {0.2205459568745545251826, -0.4572644452615640347445, 1.125884581167679341599, 1.293032144434267600433}},
    {"henon-heiles",
     "x'' = -x - 2 x y; y'' = -y - x^2 + y^2; x(0) = 0; y(0) = 0.1; x'(0) = 0.39; y'(0) = 0.05",
     {"x", "y"},
     1000,
     {0.221676877566996888, -0.309586211851651083}}};
enum { MOTIONS = sizeof motions / sizeof *motions };

static motus_status made(motus_system *s, const motus_run_def *def, motus_run **r, motus_error *err)
{
    motus_status status = motus_run_create(s, def, r, err);
    return status == MOTUS_OK ? motus_run_finish(*r, err) : status;
}

static motus_run_def wanted(const char *method, double accuracy, double until)
{
    motus_run_def def = motus_default_run();
    def.method = method;
    def.accuracy = accuracy;
    def.until = until;
    def.machine = "interpreter";
    def.error = MOTUS_BARS_CHEAP;
    return def;
}

/* ---- claims ---- */

/* The largest position, and the largest velocity, up to now. */
typedef struct sizes {
    double x, v;
} sizes;

static int widen(void *context, motus_run *r)
{
    sizes *s = context;
    double x[2] = {0, 0}, v[2] = {0, 0};
    if (motus_run_state(r, x, v, NULL) != MOTUS_OK) return 1;
    for (int k = 0; k < 2; k++) s->x = fmax(s->x, fabs(x[k])), s->v = fmax(s->v, fabs(v[k]));
    return 0;
}

/* Of the motion itself, whoever computes it. */
static sizes sizes_of(motus_system *s, const known *m)
{
    sizes found = {0, 0};
    motus_run *r = NULL;
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    def.method = "dop853", def.tolerance = 1e-9, def.longest_step = 0.05, def.until = m->until;
    def.machine = "interpreter", def.observer = widen, def.context = &found;
    must(made(s, &def, &r, &err), &err, m->name);
    motus_run_destroy(r);
    return found;
}

/* Whether every number is as near to the truth as was promised; a ten thousandth is left to `sizes`. */
static bool keeps(const known *m, motus_system *s, motus_run *r, const sizes *size, double promise)
{
    for (int k = 0; k < 4 && m->numbers[k]; k++) {
        const double of = strchr(m->numbers[k], '\'') ? size->v : size->x;
        if (!(fabs(value(s, r, m->numbers[k]) - m->truth[k]) <= 1.0001 * promise * of)) return false;
    }
    return true;
}

static void no_false_claim(void **state)
{
    (void)state;
    static const char *const methods[] = {NULL, "dopri5", "dop853", "dep6", "dep12", "taylor", "rk4", "gauss8"};
    static const double accuracies[] = {1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13};
    int met = 0, missed = 0, tries = 0, turn = 0;
    for (int i = 0; i < MOTIONS; i++) {
        const known *m = &motions[i];
        motus_system *s = given_text(m->text);
        const sizes size = sizes_of(s, m);
        for (size_t k = 0; k < sizeof methods / sizeof *methods; k++)
            for (size_t a = 0; a < sizeof accuracies / sizeof *accuracies; a++) {
                motus_error err = motus_default_error();
                const bool chosen = !methods[k] || given_adaptive(methods[k]) || !strcmp(methods[k], "taylor");
                if (methods[k] && motus_method_admits(s, methods[k], NULL) != MOTUS_OK) continue;
                if (!chosen && accuracies[a] < 1e-9) continue; /* steps of one size: millions of them */
                if (!share_takes(&turn)) continue;
                motus_run_def def = wanted(methods[k], accuracies[a], m->until);
                motus_run *r = NULL;
                const motus_status status = made(s, &def, &r, &err);
                if (status != MOTUS_ACCURACY) must(status, &err, m->name);
                const motus_run_statistics d = motus_run_now(r);
                const bool claimed = status == MOTUS_OK;
                assert_true(motus_run_done(r) && d.accuracy == accuracies[a] && d.trials >= 1);
                assert_true(claimed == (d.reached <= d.accuracy));
                if (!keeps(m, s, r, &size, claimed ? d.accuracy : d.reached))
                    fail_msg("%s by %s to %g: %s, but the truth is farther away", m->name, motus_run_now(r).method,
                             accuracies[a], claimed ? "claimed" : "not reached");
                met += claimed, missed += !claimed, tries += d.trials;
                /* the method that chooses itself gets there */
                if (!methods[k] && accuracies[a] >= 1e-11 && !claimed)
                    fail_msg("%s: auto misses %g: %s", m->name, accuracies[a], err.message);
                motus_run_destroy(r);
            }
        motus_system_destroy(s);
    }
    print_message("%d accuracies met, %d honestly missed, none falsely claimed; %.2f trials each\n", met, missed,
                  (double)tries / (met + missed));
}

/* Steps that follow the time scale of the motion are at most half of it. Above the tolerance that belongs to these the
 * steps are the same; the run reports that one, and a search begins with it. */
static void tolerances_beyond_the_longest_steps(void **state)
{
    (void)state;
    static const char *const methods[] = {"verlet-reversible",    "blanes-moan4-reversible", "blanes-moan6-reversible",
                                          "kahan-li8-reversible", "gauss8-reversible",       "gauss12-reversible"};
    motus_system *s = given_model("kepler.motus", NULL, 0);
    for (size_t k = 0; k < sizeof methods / sizeof *methods; k++) {
        motus_error err = motus_default_error();
        motus_run *runs[3];
        double told = 0.5;
        for (int i = 0; i < 3; i++) { /* far above, with what is told then, and just below */
            motus_run_def def = motus_default_run();
            def.method = methods[k], def.tolerance = i < 2 ? told : told / 2, def.machine = "interpreter";
            must(motus_run_create(s, &def, &runs[i], &err), &err, methods[k]);
            finish(runs[i]);
            if (i == 0) told = motus_run_now(runs[0]).tolerance;
        }
        assert_true(told < 0.5 && motus_run_now(runs[1]).tolerance == told &&
                    motus_run_now(runs[2]).tolerance == told / 2);
        same_state(s, runs[0], runs[1], "the longest steps");
        assert_true(motus_run_steps(runs[2]) > motus_run_steps(runs[1]));
        for (int i = 0; i < 3; i++) motus_run_destroy(runs[i]);
        if (k == 0) continue; /* of order 2: half a million steps */
        motus_run_def def = wanted(methods[k], 1e-5, NAN);
        motus_run *r = NULL;
        must(made(s, &def, &r, &err), &err, methods[k]);
        assert_true(motus_run_now(r).reached <= 1e-5 && motus_run_now(r).tolerance <= told);
        motus_run_destroy(r);
    }
    motus_system_destroy(s);
}

static void absolute_accuracy(void **state)
{
    (void)state;
    const known *m = &motions[2];
    motus_system *s = given_text(m->text);
    motus_run_def def = wanted(NULL, 1e-6, m->until);
    motus_run *r = NULL;
    motus_error err = motus_default_error();
    def.absolute = 1;
    must(made(s, &def, &r, &err), &err, "absolute");
    const sizes one = {1, 1};
    assert_true(motus_run_now(r).absolute == 1 && motus_run_now(r).reached <= 1e-6);
    assert_true(keeps(m, s, r, &one, 1e-6));
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* ---- the newcomer's lines ---- */

static void nothing_but_the_equation(void **state)
{
    (void)state;
    motus_system *s = given_text("x'' = -x + x^3 + 0.1 cos(t)\nx(0) = 0; x'(0) = 0\nuntil 100");
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    motus_error err = motus_default_error();
    def.machine = "interpreter", def.error = MOTUS_BARS_CHEAP;
    must(made(s, &def, &r, &err), &err, "three lines");
    const size_t x = column(s, "x");
    double at, bar;
    must(motus_run_errors(r, &x, 1, &at, &bar, &err), &err, "error");
    assert_true(fabs(at - motions[0].truth[0]) <= bar && bar <= 1e-9);
    assert_true(motus_run_now(r).accuracy == 1e-9 && !motus_run_now(r).absolute);
    assert_non_null(strstr(motus_run_now(r).choice, motus_run_now(r).method));
    motus_run_destroy(r);
    /* a step that is given makes it verlet, as ever */
    def.step = 0.01;
    must(made(s, &def, &r, &err), &err, "step");
    assert_string_equal(motus_run_now(r).method, "verlet");
    assert_true(isnan(motus_run_now(r).accuracy) && !*motus_run_now(r).choice);
    motus_run_destroy(r);
    /* so does a model with a method and a step, unless the caller wants an accuracy */
    motus_system *other = given_model("driven-oscillator.motus", NULL, 0);
    def.step = NAN;
    must(made(other, &def, &r, &err), &err, "model");
    assert_string_equal(motus_run_now(r).method, "verlet");
    motus_run_destroy(r);
    def.accuracy = 1e-8;
    must(made(other, &def, &r, &err), &err, "accuracy");
    assert_true(*motus_run_now(r).choice && motus_run_now(r).reached <= 1e-8);
    motus_run_destroy(r);
    motus_system_destroy(other);
    motus_system_destroy(s);
}

static void settings_of_a_model(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    def.machine = "interpreter";
    motus_system *s = given_text("x'' = -x; x(0) = 1; x'(0) = 0; until 10; method dopri5; accuracy 1e-5 absolute");
    motus_settings set = motus_default_settings();
    motus_settings_of(s, &set);
    assert_true(set.accuracy == 1e-5 && set.absolute && isnan(set.tolerance));
    must(made(s, &def, &r, &err), &err, "accuracy of a model");
    assert_true(!strcmp(motus_run_now(r).method, "dopri5") && motus_run_now(r).absolute &&
                motus_run_now(r).reached <= 1e-5);
    assert_true(fabs(value(s, r, "x") - cos(10)) <= 1e-5);
    motus_run_destroy(r);
    def.accuracy = 1e-9; /* another number, the model's method */
    must(made(s, &def, &r, &err), &err, "another accuracy");
    assert_true(!strcmp(motus_run_now(r).method, "dopri5") && !motus_run_now(r).absolute &&
                motus_run_now(r).accuracy == 1e-9);
    motus_run_destroy(r);
    motus_system_destroy(s);
    s = given_text("x'' = -x; x(0) = 1; x'(0) = 0; until 10; method auto; tolerance 1e-7");
    def.accuracy = NAN;
    must(made(s, &def, &r, &err), &err, "auto by a tolerance");
    assert_true(*motus_run_now(r).choice && motus_run_now(r).tolerance == 1e-7 && isnan(motus_run_now(r).accuracy));
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* ---- what auto chooses, and its bits ---- */

static void the_bits_of_its_method(void **state)
{
    (void)state;
    for (int i = 0; i < MOTIONS; i++)
        for (int observed = 0; observed < 2; observed++) {
            motus_system *s = given_text(motions[i].text);
            motus_error err = motus_default_error();
            motus_run *found = NULL, *named = NULL;
            sizes unused = {0, 0};
            motus_run_def def = wanted("auto", 1e-8, motions[i].until);
            if (observed) def.observer = widen, def.context = &unused; /* the trial's end is not taken over */
            must(made(s, &def, &found, &err), &err, motions[i].name);
            motus_run_def same = wanted(motus_run_now(found).method, NAN, motions[i].until);
            same.tolerance = motus_run_now(found).tolerance;
            must(made(s, &same, &named, &err), &err, motions[i].name);
            double a[2][8], e[2][8];
            size_t columns[8], n = 0;
            for (int k = 0; k < 4 && motions[i].numbers[k]; k++) columns[n++] = column(s, motions[i].numbers[k]);
            must(motus_run_errors(found, columns, n, a[0], e[0], &err), &err, "found");
            must(motus_run_errors(named, columns, n, a[1], e[1], &err), &err, "named");
            assert_memory_equal(a[0], a[1], n * sizeof **a);
            assert_memory_equal(e[0], e[1], n * sizeof **e);
            assert_true(motus_run_steps(found) == motus_run_steps(named));
            assert_true(motus_run_now(found).shortest_step == motus_run_now(named).shortest_step);
            motus_run_destroy(found);
            motus_run_destroy(named);
            motus_system_destroy(s);
        }
}

/* A run of unknown length that goes on compiled has the bits, the errors and the counts of the interpreter's, also at
 * times within the step at which it changes over. */
static void goes_on_compiled(void **state)
{
    (void)state;
    motus_system *s = given_text(motions[4].text);
    enum { TIMES = 2000, NUMBERS = 2 };
    static double times[TIMES], a[2][TIMES][NUMBERS], e[2][TIMES][NUMBERS];
    motus_run_statistics d[2];
    motus_error err = motus_default_error();
    const size_t columns[NUMBERS] = {column(s, "x"), column(s, "y'")};
    for (int k = 0; k < TIMES; k++) times[k] = 10 * (k + 1);
    for (int compiled = 0; compiled < 2; compiled++) {
        motus_run_def def = wanted("dop853", NAN, 10 * TIMES);
        motus_run *r = NULL;
        def.tolerance = 1e-13;
        def.machine = compiled ? "auto" : "interpreter";
        must(motus_run_create(s, &def, &r, &err), &err, "run");
        assert_string_equal(motus_run_now(r).machine, "interpreter");
        if (compiled) must(later_at(r, 300, 0, &err), &err, "later");
        must(motus_run_sample_errors(r, times, TIMES, columns, NUMBERS, a[compiled][0], e[compiled][0], &err), &err,
             "sample");
        must(motus_run_finish(r, &err), &err, "finish");
        d[compiled] = motus_run_now(r);
        if (compiled && !*motus_run_now(r).note) assert_string_equal(motus_run_now(r).machine, "compiled");
        motus_run_destroy(r);
    }
    assert_memory_equal(a[0], a[1], sizeof a[0]);
    assert_memory_equal(e[0], e[1], sizeof e[0]);
    assert_true(d[0].steps == d[1].steps && d[0].refused == d[1].refused && d[0].evaluations == d[1].evaluations);
    assert_true(d[0].shortest_step == d[1].shortest_step && d[0].longest_step == d[1].longest_step);
    motus_system_destroy(s);
}

static void suits_the_force(void **state)
{
    (void)state;
    static const struct {
        const char *text, *methods;
    } forces[] = {{"x'' = -x + x^3; x(0) = 0.5; x'(0) = 0", "dep6 dep12 dop853 taylor"},
                  {"x'' = -x - 0.1 x' |x'|; x(0) = 1; x'(0) = 0", "dop853 taylor"},
                  {"x'' = if(x > 0, -2 x, -x); x(0) = 1; x'(0) = 0", "dep6 dep12 dop853 taylor"},
                  {"x'' = -x - 0.1 x'; x(0) = 1; x'(0) = 0", "dop853 taylor"}};
    for (size_t i = 0; i < sizeof forces / sizeof *forces; i++) {
        char first[MOTUS_NAME_MAX] = "";
        for (int compiled = 0; compiled < 2; compiled++) {
            motus_system *s = given_text(forces[i].text);
            motus_error err = motus_default_error();
            motus_run_def def = wanted(NULL, 1e-6, 20);
            motus_run *r = NULL;
            def.machine = compiled ? "auto" : "interpreter";
            must(motus_run_create(s, &def, &r, &err), &err, forces[i].text);
            assert_non_null(strstr(forces[i].methods, motus_run_now(r).method));
            if (compiled) assert_string_equal(first, motus_run_now(r).method);
            snprintf(first, sizeof first, "%s", motus_run_now(r).method);
            motus_run_destroy(r);
            motus_system_destroy(s);
        }
    }
}

static int pull(void *ctx, double t, const double *x, const double *v, double *a)
{
    (void)ctx, (void)t, (void)v;
    a[0] = -x[0] + x[0] * x[0] * x[0] + 0.1 * cos(t);
    return 0;
}

static void callbacks(void **state)
{
    (void)state;
    const double zero = 0;
    motus_callback_def problem = motus_default_callback();
    problem.positions = 1, problem.x = &zero, problem.v = &zero;
    problem.acceleration = pull, problem.depends_on_velocity = 0;
    motus_system *s = NULL;
    motus_error err = motus_default_error();
    must(motus_system_from_callback(&problem, &s, &err), &err, "callback");
    motus_run_def def = wanted(NULL, NAN, 100);
    motus_run *r = NULL;
    must(made(s, &def, &r, &err), &err, "callback");
    assert_true(motus_run_now(r).accuracy == 1e-9 && strcmp(motus_run_now(r).method, "taylor") != 0);
    double x;
    must(motus_run_state(r, &x, NULL, &err), &err, "state");
    assert_true(fabs(x - motions[0].truth[0]) <= 1e-9);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* ---- what cannot be had ---- */

static void out_of_reach(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    motus_run *r = NULL;
    motus_system *s = given_text(motions[0].text);
    motus_run_def def = wanted(NULL, 1e-15, 100);
    assert_int_equal(made(s, &def, &r, &err), MOTUS_ACCURACY);
    assert_true(motus_run_done(r) && motus_run_now(r).reached > 1e-15 && motus_run_now(r).reached < 1e-12);
    assert_non_null(strstr(err.message, "the accuracy 1e-15 is not reached: the trials reached"));
    assert_int_equal(motus_run_step(r, 1, &err), MOTUS_ACCURACY); /* and whenever the run is at its end */
    assert_true(fabs(value(s, r, "x") - motions[0].truth[0]) < 1e-12);
    motus_run_destroy(r);
    motus_system_destroy(s);
    s = given_text("x'' = -0.3 x' + x - x^3 + 0.5 cos(1.2 t); x(0) = 0; x'(0) = 0"); /* chaos */
    def = wanted(NULL, 1e-6, 400);
    assert_int_equal(made(s, &def, &r, &err), MOTUS_ACCURACY);
    assert_non_null(strstr(err.message, "no digit of the answer is known to be significant after t = "));
    assert_true(motus_run_done(r) && isinf(motus_run_now(r).reached));
    motus_run_destroy(r);
    motus_system_destroy(s);
    s = given_text("x'' = 1/x^2; x(0) = 1; x'(0) = -3"); /* turns at 1/5.5, without harm */
    def = wanted(NULL, 1e-9, 2);
    must(made(s, &def, &r, &err), &err, "near a pole");
    motus_run_destroy(r);
    motus_system_destroy(s);
    s = given_text("x'' = -1/x^2; x(0) = 1; x'(0) = 0"); /* reaches the pole at 1.1107 */
    assert_int_equal(made(s, &def, &r, &err), MOTUS_DIVERGED);
    assert_true(fabs(err.time - 1.1107207345395916) < 1e-6);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

#define DUFFING(a, w, start) "x'' = -" a " x' + x - x^3 + " a " cos(" w " t); x(0) = " start "; x'(0) = 0"

/* Where a model's decimals are no doubles, what their rounding does to the end is that of the same model with the
 * doubles on their other sides; where they are doubles there is nothing to say. */
/* x'' = -cbrt(x) from rest at A has the period sqrt(6) A^(1/3) B(3/4, 1/2), since x'^2/2 + 3/4 x^(4/3) is constant. At
 * every passage of 0 the force has an infinite slope. Written with |x|, with a switch besides, Taylor series do not get
 * over it, so that auto takes another method. */
static void infinite_slopes(void **state)
{
    (void)state;
    static const char *const forces[] = {"-cbrt(x)", "-sign(x)*cbrt(abs(x))"};
    static const double amplitudes[] = {0.1, 1, 30}, accuracies[] = {NAN, 1e-6};
    const double beta = tgamma(0.75) * tgamma(0.5) / tgamma(1.25);
    for (int i = 0; i < 2 * 3 * 2; i++) {
        const double size = amplitudes[i / 2 % 3], period = sqrt(6) * cbrt(size) * beta;
        const double promise = i % 2 ? 1e-6 : 1e-9;
        char text[200];
        snprintf(text, sizeof text, "x'' = %s; x(0) = %g; x'(0) = 0", forces[i / 6], size);
        motus_system *s = given_text(text);
        motus_error err = motus_default_error();
        motus_run_def def = wanted(NULL, accuracies[i % 2], 2.5 * period);
        motus_run *r = NULL;
        must(made(s, &def, &r, &err), &err, text);
        assert_true(fabs(value(s, r, "x") + size) <= 1.01 * promise * size);
        assert_true(fabs(value(s, r, "x'")) <= 1.01 * promise * sqrt(1.5) * cbrt(size * size));
        if (i >= 6 && strcmp(motus_run_now(r).method, "taylor") != 0 &&
            !strstr(motus_run_now(r).choice, "needs the fewest"))
            assert_non_null(strstr(motus_run_now(r).choice, "keeps to the accuracy, and taylor"));
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

/* What is told of a method that is named, and of all where none has it. */
static void the_place_of_an_infinite_slope(void **state)
{
    (void)state;
    static const struct {
        const char *method, *force, *place;
        double accuracy;
    } rows[] = {{"taylor", "-sign(x - 0.5)*cbrt(abs(x - 0.5))", "where x - 0.5 is 0, first at t = 1.1", 1e-9},
                {NULL, "-cbrt(x)", "where x is 0, first at t = 1.46", 1e-15}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[200];
        snprintf(text, sizeof text, "x'' = %s; x(0) = 1; x'(0) = 0", rows[i].force);
        motus_system *s = given_text(text);
        motus_error err = motus_default_error();
        motus_run_def def = wanted(rows[i].method, rows[i].accuracy, 20);
        motus_run *r = NULL;
        assert_int_equal(made(s, &def, &r, &err), MOTUS_ACCURACY);
        if (!strstr(err.message, rows[i].place) || strstr(err.hint, "errors grow"))
            fail_msg("%s: %s; %s", text, err.message, err.hint);
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

static void the_part_of_decimals(void **state)
{
    (void)state;
    static const char words[] = "of that, up to ";
    motus_error err = motus_default_error();
    motus_run *r = NULL, *other = NULL;
    motus_system *s = given_text(DUFFING("0.3", "1.2", "0.1")),
                 *beside = given_text(DUFFING("0.30000000000000004", "1.2000000000000002", "0.09999999999999999"));
    motus_run_def def = wanted("taylor", 1e-14, 80);
    sizes size = {0, 0};
    assert_int_equal(made(s, &def, &r, &err), MOTUS_ACCURACY);
    const char *at = strstr(err.message, words);
    if (!at || !strstr(err.message, "comes from the rounding of the model's decimals")) fail_msg("%s", err.message);
    const double told = strtod(at + strlen(words), NULL);
    motus_run_def like = wanted("taylor", NAN, 80);
    like.tolerance = motus_run_now(r).tolerance, like.observer = widen, like.context = &size;
    must(made(beside, &like, &other, &err), &err, "beside");
    const double x = fabs(value(s, r, "x") - value(beside, other, "x")) / size.x,
                 v = fabs(value(s, r, "x'") - value(beside, other, "x'")) / size.v, most = fmax(x, v);
    if (!(fabs(told - most) <= 0.06 * most && told > 1e-14 && told <= motus_run_now(r).reached))
        fail_msg("%g is told, and it is %g of %g", told, most, motus_run_now(r).reached);
    motus_run_destroy(r);
    motus_run_destroy(other);
    motus_system_destroy(s);
    motus_system_destroy(beside);
    s = given_text(DUFFING("0.3125", "1.25", "0.125"));
    assert_int_equal(made(s, &def, &r, &err), MOTUS_ACCURACY);
    if (strstr(err.message, "decimals")) fail_msg("%s", err.message);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

static int stop(void *context, double fraction)
{
    double *last = context;
    assert_true(fraction >= *last && fraction < 1);
    *last = fraction;
    return 1;
}

/* Of a body that rests in balance the velocity is rounding alone: no digit of it can be asked for, and the place is
 * known all the same. */
static void at_rest(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double x;
    } models[] = {{"x'' = -3 x + 1; x(0) = 1/3; x'(0) = 0", 1.0 / 3},
                  {"x'' = -10 x + 9.81 - 0.1 x'; x(0) = 0.981; x'(0) = 0", 0.981},
                  {"x'' = -sin(x); x(0) = pi; x'(0) = 0", 3.14159265358979323846}};
    static const double accuracies[] = {1e-9, 1e-6};
    for (size_t i = 0; i < 3 * sizeof models / sizeof *models; i++) {
        motus_error err = motus_default_error();
        motus_system *s = given_text(models[i / 3].text);
        motus_run *r = NULL;
        motus_run_def def = wanted(NULL, i % 3 < 2 ? accuracies[i % 3] : NAN, 10);
        if (i % 3 == 2) def.method = "verlet", def.step = 0.01, def.error = MOTUS_BARS_CHEAP;
        must(made(s, &def, &r, &err), &err, models[i / 3].text);
        double numbers[2], bars[2];
        const size_t columns[] = {1, 2};
        must(motus_run_errors(r, columns, 2, numbers, bars, &err), &err, models[i / 3].text);
        for (int k = 0; k < 2; k++) assert_true(fabs(numbers[k] - (k ? 0 : models[i / 3].x)) <= bars[k]);
        assert_true(bars[0] < 1e-6 && bars[1] < 1e-6);
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

static void refused(void **state)
{
    (void)state;
    motus_system *s = given_text("x'' = -x; x(0) = 1; x'(0) = 0; until 10");
    static const struct {
        const char *method;
        double step, accuracy, tolerance;
        const char *message;
    } bad[] = {
        {NULL, NAN, 1e-6, 1e-6, "an accuracy and a tolerance are given"},
        {"verlet", 0.1, 1e-6, NAN, "a step and an accuracy are given"},
        {"dop853", 0.1, 1e-6, NAN, "a step and an accuracy are given"},
        {"auto", 0.1, NAN, NAN, "a step is given, and auto chooses methods that choose their steps"},
        {NULL, NAN, 0, NAN, "an accuracy is a positive number, not 0"},
        {NULL, NAN, -1, NAN, "an accuracy is a positive number, not -1"},
        {NULL, NAN, INFINITY, NAN, "an accuracy is a positive number, not inf"},
        {NULL, NAN, 1e-16, NAN, "the relative accuracy 1e-16 is below the rounding of the numbers"},
        {NULL, NAN, 1, NAN, "the relative accuracy 1 allows errors as large as the motion"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        motus_error err = motus_default_error();
        motus_run_def def = wanted(bad[i].method, bad[i].accuracy, NAN);
        motus_run *r = NULL;
        def.step = bad[i].step, def.tolerance = bad[i].tolerance;
        assert_int_equal(motus_run_create(s, &def, &r, &err), MOTUS_ARGUMENT);
        assert_string_equal(err.message, bad[i].message);
        assert_null(r);
    }
    motus_error err = motus_default_error();
    motus_run *r = NULL;
    motus_run_def def = wanted(NULL, 1e-6, 1e6);
    double last = 0;
    def.progress = stop, def.context = &last;
    assert_int_equal(motus_run_create(s, &def, &r, &err), MOTUS_CANCELLED);
    assert_null(r);
    def = wanted(NULL, 1e-6, 10);
    def.switches = MOTUS_SWITCHES_RESOLVE;
    assert_int_equal(motus_run_create(s, &def, &r, &err), MOTUS_UNAVAILABLE);
    motus_system_destroy(s);
    motus_text_def both = motus_default_text();
    both.text = "x'' = -x; x(0) = 1; x'(0) = 0; tolerance 1e-5; accuracy 1e-5";
    assert_int_equal(motus_system_from_text(&both, &s, &err), MOTUS_ARGUMENT);
    assert_string_equal(err.message, "both a tolerance and an accuracy are set");
}

/* Of a body that others hold in balance the force is rounding, which a tolerance relative to its own speed asks to be
 * followed: that is said soon, and what is said to try works. An accuracy does so by itself, and is then one of the
 * largest numbers. */
static void held_in_balance(void **state)
{
    (void)state;
    motus_system *s = given_text("N = 7\nc'' = sum(i = 1..N: 1e-6 (p[i] - c)/|p[i] - c|^3)\n"
                                 "p[i]'' = (c - p[i])/|p[i] - c|^3 for i = 1..N\nc(0) = (0, 0); c'(0) = (0, 0)\n"
                                 "p[i](0) = (1.01 cos(2 pi i/N), 1.01 sin(2 pi i/N)) for i = 1..N\n"
                                 "p[i]'(0) = (0, 0) for i = 1..N");
    motus_error err = motus_default_error();
    motus_run *r = NULL;
    motus_run_def def = wanted("dop853", NAN, 0.4);
    def.tolerance = 1e-10;
    assert_int_equal(made(s, &def, &r, &err), MOTUS_STEPS);
    assert_int_equal(err.cause, MOTUS_CAUSE_ROUNDING);
    assert_non_null(strstr(err.message, "the tolerance 1e-10 is below rounding"));
    assert_string_equal(err.attempt, "tolerance = 1e-10 absolute");
    motus_run_destroy(r);
    def.absolute = 1;
    must(made(s, &def, &r, &err), &err, "the attempt");
    assert_true(motus_run_steps(r) < 100);
    motus_run_destroy(r);
    def = wanted("dop853", 1e-9, 0.4);
    must(made(s, &def, &r, &err), &err, "an accuracy");
    const motus_run_statistics done = motus_run_now(r);
    assert_true(done.absolute && done.accuracy == 1e-9 && done.reached <= 1e-9);
    assert_true(motus_run_steps(r) < 100);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* Where the force may be undefined beyond a switch, "auto" locates if trials show that it can, and who asks for it gets
 * the same run; steps across give the same motion. Steps of one size that locate reach no accuracy. */
static void locates_by_trials(void **state)
{
    (void)state;
    static const char text[] = "x'' = -1 + 50 max(0, 0.1 - x)^1.5\nx(0) = 1; x'(0) = 0\n";
    static const motus_switches how[] = {MOTUS_SWITCHES_USUAL, MOTUS_SWITCHES_LOCATE, MOTUS_SWITCHES_STEP};
    motus_system *s = given_text(text);
    motus_error err = motus_default_error();
    double x[3], v[3], values[3], errors[3];
    for (size_t k = 0; k < 3; k++) {
        motus_run_def def = wanted("auto", 1e-7, 5);
        motus_run *r = NULL;
        const size_t column = 1;
        def.switches = how[k];
        must(made(s, &def, &r, &err), &err, text);
        const motus_run_statistics did = motus_run_now(r);
        assert_string_equal(did.not_located, "");
        assert_int_equal(did.switches > 0, k < 2);
        must(motus_run_state(r, x + k, v + k, &err), &err, text);
        must(motus_run_errors(r, &column, 1, values + k, errors + k, &err), &err, text);
        motus_run_destroy(r);
    }
    assert_true(x[0] == x[1] && v[0] == v[1]);
    if (fabs(x[0] - x[2]) > errors[0] + errors[2]) fail_msg("%.17g and %.17g", x[0], x[2]);
    motus_run_def def = wanted("rk4", 1e-7, 5);
    motus_run *r = NULL;
    def.switches = MOTUS_SWITCHES_LOCATE;
    assert_int_equal(motus_run_create(s, &def, &r, &err), MOTUS_UNAVAILABLE);
    assert_non_null(strstr(err.hint, "give a step"));
    motus_system_destroy(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(no_false_claim),
                                       cmocka_unit_test(absolute_accuracy),
                                       cmocka_unit_test(tolerances_beyond_the_longest_steps),
                                       cmocka_unit_test(nothing_but_the_equation),
                                       cmocka_unit_test(settings_of_a_model),
                                       cmocka_unit_test(the_bits_of_its_method),
                                       cmocka_unit_test(goes_on_compiled),
                                       cmocka_unit_test(suits_the_force),
                                       cmocka_unit_test(callbacks),
                                       cmocka_unit_test(out_of_reach),
                                       cmocka_unit_test(infinite_slopes),
                                       cmocka_unit_test(the_place_of_an_infinite_slope),
                                       cmocka_unit_test(the_part_of_decimals),
                                       cmocka_unit_test(held_in_balance),
                                       cmocka_unit_test(at_rest),
                                       cmocka_unit_test(locates_by_trials),
                                       cmocka_unit_test(refused)};
    open_cache(); /* the object of a later run is not there yet */
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    close_cache();
    return failed;
}
