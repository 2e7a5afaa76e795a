/* Motions over forces that are narrower than steps, with truths that formulas give: no bar is wrong, and hardly any run
 * is refused.
 *
 * A flight over a bump V of the potential, v² = 1 - 2 V: behind it the body has its velocity again, and is late by the
 * integral of 1/v - 1, which the trapezoidal rule gives to all digits, since V vanishes with all derivatives. A pulse
 * that drives an oscillator: Duhamel's integral of a Gaussian has a closed form. Where the bump and the pulse are, and
 * how narrow, is drawn by lot.
 *
 * WITNESS=n tries n of each; they print what they find.
 */
#include "api/system/system.h"
#include "test/given.h"
#include "test/share.h"

static uint64_t seed = 1;
static double uniform(void) /* in [0, 1): splitmix64 */
{
    uint64_t z = seed += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}
static double between(double a, double b) { return round(1000 * (a + (b - a) * uniform())) / 1000; }

typedef struct tally {
    int all, told, within, wrong;
} tally;
static tally all, steady, located;

static int tries(void)
{
    const char *n = getenv("WITNESS");
#ifdef SANITIZED
    return n ? atoi(n) : 6;
#else
    return n ? atoi(n) : 48;
#endif
}

/* Runs the model and compares a number of its state with the truth. Wrong: by more than ten bars. */
static void judge_number(tally *to, const char *text, const char *method, double tolerance, double step, size_t column,
                         long double truth)
{
    motus_error err = motus_default_error();
    motus_system *const s = given_text(text);
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    double x = NAN, error = NAN;
    def.method = method;
    def.tolerance = tolerance;
    def.step = step;
    def.error = MOTUS_BARS_CHEAP;
    to->all++;
    const int fails = motus_run_create(s, &def, &r, &err) || motus_run_finish(r, &err);
    const int told = r && motus_run_done(r) && !motus_run_errors(r, &column, 1, &x, &error, &err) && isfinite(error);
    const double off = told ? (double)fabsl(x - truth) : 0;
    to->told += told;
    to->within += told && off <= error;
    to->wrong += told && off > 10 * error;
    if (!told || off > error)
        printf("%s %g: %s by %.2g, bar %.2g%s%s\n%s\n", method ? method : "auto", fmax(tolerance, step),
               told ? "off" : "not told", off, error, fails ? ": " : "", fails ? err.message : "", text);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* ... its first one. */
static void judge(tally *to, const char *text, const char *method, double tolerance, double step, long double truth)
{
    judge_number(to, text, method, tolerance, step, 1, truth);
}

static const struct {
    const char *method;
    double tolerance;
} ways[] = {{NULL, NAN}, {"taylor", 1e-7}, {"dop853", 1e-9}, {"dopri5", 1e-6}, {"radau15", 1e-9}, {"dep12", 1e-10}};
enum { WAYS = sizeof ways / sizeof *ways };

static bool holds(const char *name, const tally *t)
{
    printf("%s: %d runs, %d with a bar, %d within, %d wrong\n", name, t->all, t->told, t->within, t->wrong);
    return t->wrong == 0 && 100 * t->within >= 96 * t->told;
}

/* Nothing that is told is wrong by more than ten bars; few numbers lie beyond one bar (16 of 1200 did, at most five
 * times as far, all at errors of 1e-13), and 95 of 100 runs tell one. Steps of one size tell one where errors have left
 * a digit: 789 of 1000. */
static void bars_hold(void **state)
{
    (void)state;
    const bool chosen = holds("steps that are chosen", &all), given = holds("steps of one size", &steady);
    assert_true(chosen && given && holds("steps that end at switches", &located));
    assert_true(100 * all.told >= 95 * all.all);
}

/* How late a body of velocity 1 is behind a bump of the potential k/2 exp(-(x/w)²). */
static long double lateness(long double k, long double w)
{
    enum { POINTS = 4000 };
    const long double reach = 7.5L * w, h = 2 * reach / POINTS;
    long double sum = 0;
    for (int i = 0; i <= POINTS; i++) {
        const long double x = -reach + i * h, e = k * expl(-(x / w) * (x / w)), v = sqrtl(1 - e);
        sum += e / (v * (1 + v)); /* 1/v - 1 */
    }
    return h * sum;
}

/* A wall that is thinner than a step throws a body back, which then has its velocity again:
 * x = -a + w ln(2 w/v²) + 2 w ln cosh(v (t - s)/(2 w)). */
static void walls(void **state)
{
    (void)state;
    for (int i = 0; i < tries(); i++) {
        char text[300];
        const double a = between(0.5, 9), v = between(0.3, 2), w = exp2(round(-12 * uniform())) * 0.02;
        const long double from = -(long double)a + w * logl(w / (2 * (long double)v * v)),
                          until = (long double)(4 + a) / v, met = (3 - from) / v;
        snprintf(text, sizeof text, "x'' = exp(-(x + %.17g)/%.17g)\nx(0) = 3; x'(0) = -%.17g\nuntil %.17g", a, w, v,
                 2 * (double)until);
        judge(&all, text, ways[i % WAYS].method, ways[i % WAYS].tolerance, NAN,
              from + v * ((long double)(2 * (double)until) - met));
    }
}

/* Peaks in other words: what falls off behind a divisor or by a power. They act on first-order variables, too, one of
 * which rests until then, so that a series of it does not show the peak. The work done on a body is the integral of the
 * peak. */
static void peaks(void **state)
{
    (void)state;
    static const struct {
        const char *peak; /* in z */
        long double integral;
    } forms[] = {
        {"exp(-z^2)", 1.7724538509055160273L},
        {"1/cosh(z)^2", 2},
        {"2^(-z^2)", 2.1289340388624523600L},
        {"0.5^(z^2)", 2.1289340388624523600L},
        {"1/exp(z^2)", 1.7724538509055160273L},
        {"1/(2 + exp(z) + exp(-z))", 1},
        {"cosh(z)^(-4)", 4.0L / 3},
    };
    static const char *const methods[] = {NULL, "taylor", "dop853", "dopri5", "radau15", "verner9"};
    enum { FORMS = sizeof forms / sizeof *forms, METHODS = sizeof methods / sizeof *methods };
    for (int i = 0; i < tries(); i++) {
        char text[300];
        const double c = between(3, 17), w = exp2(round(-14 * uniform())) * 0.1, k = between(0.1, 1);
        const int form = i % FORMS, body = i % METHODS, number = (i + 1) % METHODS;
        const double starts = number == 1;
        const long double work = (long double)k * forms[form].integral;
        snprintf(text, sizeof text, "z = (x - %.17g)/%.17g\nv' = %.17g/%.17g*%s\nx' = v\nv(0) = 1; x(0) = 0\nuntil 25",
                 c, w, k, w, forms[form].peak);
        judge(&all, text, methods[body], body ? 1e-9 : NAN, NAN, sqrtl(1 + 2 * work));
        snprintf(text, sizeof text, "z = (x - %.17g)/%.17g\ns' = %.17g/%.17g*%s\nx' = 1\ns(0) = %g; x(0) = 0\nuntil 25",
                 c, w, k, w, forms[form].peak, starts);
        judge(&all, text, methods[number], number ? 1e-9 : NAN, NAN, starts + work);
    }
}

/* Many pulses, each much shorter than a step, drive a body that is free, on a spring, or beside one that rests: whoever
 * looks for one has to look for all of them. A pulse k exp(-((t - c)/w)²) acts as k w √π at c; on a spring it acts by a
 * part exp(-w²/4) of that. */
static void trains(void **state)
{
    (void)state;
    enum { MOST = 30 };
    for (int i = 0; i < tries() / 2; i++) {
        char text[90 * MOST + 200];
        const bool spring = i % 3 == 1;
        const int count = 1 + (int)((MOST - 1) * uniform());
        const double until = between(10, 150), w = exp2(-4 - round(12 * uniform()));
        const long double impulse = w * sqrtl(3.14159265358979323846L), part = expl(-(long double)w * w / 4);
        long double x = spring ? cosl(until) : 1;
        size_t n = (size_t)snprintf(text, sizeof text, "x(0) = 1; x'(0) = 0\nuntil %.17g\nx'' = %s", until,
                                    spring ? "-x" : "0");
        for (int k = 0; k < count; k++) {
            const double c = between(1, until - 1), strength = between(0.1, 5);
            n += (size_t)snprintf(text + n, sizeof text - n, " + %.17g exp(-((t - %.17g)/%.17g)^2)", strength, c, w);
            x += strength * impulse * (spring ? part * sinl((long double)until - c) : (long double)until - c);
        }
        if (i % 3 == 2) snprintf(text + n, sizeof text - n, "\ny'' = -y; y(0) = 0; y'(0) = 0");
        judge(&all, text, ways[i % WAYS].method, ways[i % WAYS].tolerance, NAN, x);
    }
}

/* What was seen ahead of a body that an event carries elsewhere is not ahead of it any more. */
static void carried(void **state)
{
    (void)state;
    for (int i = 0; i < tries() / 4; i++) {
        char text[600];
        const double far = between(10, 100), jump = far * between(0.3, 0.9), w = far * exp2(-10 - round(4 * uniform())),
                     k = between(0.1, 0.5), beyond = far * (1 + between(0.001, 0.5));
        const double until = (jump + beyond - far) / 3 + far / 10;
        snprintf(text, sizeof text,
                 "f(z) = %.17g/%.17g*exp(-(z/%.17g)^2)\nx'' = f(x - %.17g) + f(x + %.17g)\n"
                 "x(0) = 0; x'(0) = 3\nwhen x = %.17g: x = -%.17g\nuntil %.17g",
                 k, w, w, far, far, jump, beyond, until);
        judge_number(&all, text, ways[i % 3].method, ways[i % 3].tolerance, NAN, 2,
                     sqrtl(9 + 2 * (long double)k * 1.7724538509055160273L));
    }
}

/* A body that friction holds, until a pulse much shorter than the steps lets it go, has to be where it is by steps that
 * are shorter than the pulse. */
static void let_go(void **state)
{
    (void)state;
    for (int i = 0; i < tries() / 4; i++) {
        char text[300];
        const double mu = between(0.2, 1.5), c = between(3, 8), w = exp2(-4 - round(6 * uniform())),
                     k = 20 * mu * between(1, 3);
        snprintf(text, sizeof text,
                 "x'' = -%.17g sign(x') + %.17g exp(-((t - %.17g)/%.17g)^2)\nx(0) = 0; x'(0) = %d\nuntil 12", mu, k, c,
                 w, i & 1);
        motus_error err = motus_default_error();
        motus_system *const s = given_text(text);
        motus_run_def def = motus_default_run();
        double x[2] = {0}, error[2] = {0};
        const size_t column = 1;
        def.method = i % 4 < 2 ? "dop853" : "taylor";
        def.tolerance = 1e-9;
        def.error = MOTUS_BARS_CHEAP;
        for (int fine = 0; fine < 2; fine++) {
            motus_run *r = NULL;
            if (fine) def.longest_step = w / 2;
            must(motus_run_create(s, &def, &r, &err), &err, text);
            must(motus_run_finish(r, &err), &err, text);
            must(motus_run_errors(r, &column, 1, &x[fine], &error[fine], &err), &err, text);
            motus_run_destroy(r);
        }
        motus_system_destroy(s);
        const double off = fabs(x[0] - x[1]); /* of which the short steps lack a millionth at most */
        const bool held = isfinite(error[0]) && off > 10 * error[0] + 1e-6 * fabs(x[1]);
        if (held) printf("%s %g ± %g, by short steps %g\n%s\n", def.method, x[0], error[0], x[1], text);
        assert_true(!held && fabs(x[1]) > 1e-3);
    }
}

static const char *const steps[] = {"rk4",    "yoshida4",          "gauss4", "velocity-verlet", "midpoint",
                                    "verlet", "implicit-midpoint", "fine4",  "explicit-euler",  "beeman"};
enum { STEPS = sizeof steps / sizeof *steps };

/* By a method that chooses its steps, and by one that does not: these may leap the force, and no step is refused. */
static void judge_both(int i, const char *text, long double truth)
{
    judge(&all, text, ways[i % WAYS].method, ways[i % WAYS].tolerance, NAN, truth);
    judge(&steady, text, steps[i % STEPS], NAN, 0.01 * (1 << i / STEPS % 5), truth);
}

static void flights(void **state)
{
    (void)state;
    char text[512];
    for (int i = 0; i < tries(); i++) {
        const double k = between(-1, 0.8), c = between(4, 46), w = exp2(round(-10 * uniform())) * 1.5;
        snprintf(text, sizeof text,
                 "x'' = (%.17g) (x - %.17g)/%.17g^2 exp(-((x - %.17g)/%.17g)^2)\nx(0) = -20; x'(0) = 1\nuntil 90", k, c,
                 w, c, w);
        judge_both(i, text, 70 - lateness(k, w));
    }
}

static void pulses(void **state)
{
    (void)state;
    char text[512];
    const long double pi = 3.14159265358979323846264338327950288L;
    for (int i = 0; i < tries(); i++) {
        const double a = between(-2, 2), c = between(3, 17), w = exp2(round(-14 * uniform())) * 0.375;
        snprintf(text, sizeof text, "x'' = -x + (%.17g) exp(-((t - %.17g)/%.17g)^2)\nx(0) = 1; x'(0) = 0\nuntil 20", a,
                 c, w);
        const long double truth =
            cosl(20) + a * sqrtl(pi) * w * expl(-(long double)w * w / 4) * sinl(20 - (long double)c);
        judge_both(i, text, truth);
    }
}

/* What friction holds is no error of the steps, and looking at it ends: two blocks slip until t = 1, and then stick. */
/* The same beside dry friction, at whose switch steps end: the body turns at pi, and moves on to the other side. */
static void brakes(void **state)
{
    (void)state;
    char text[512];
    const long double pi = 3.14159265358979323846264338327950288L;
    for (int i = 0; i < tries(); i++) {
        const double a = exp2(round(-14 * uniform())), c = between(3.4, 5.6), mu = between(0.05, 0.2),
                     w = exp2(round(-8 * uniform())) / 32;
        snprintf(text, sizeof text,
                 "x'' = -x - %.17g sign(x') + (%.17g) exp(-((t - %.17g)/%.17g)^2)\nx(0) = 1.5; x'(0) = 0\nuntil 6", mu,
                 a, c, w);
        const long double truth = -mu + (3 * mu - 1.5L) * cosl(6 - pi) +
                                  a * sqrtl(pi) * w * expl(-(long double)w * w / 4) * sinl(6 - (long double)c);
        judge(&located, text, ways[i % WAYS].method, ways[i % WAYS].tolerance, NAN, truth);
    }
}

static void sticks(void **state)
{
    (void)state;
    for (int i = 0; i < WAYS; i++) {
        if (ways[i].method && !strcmp(ways[i].method, "dep12")) continue; /* of forces without velocities */
        judge(&all,
              "F = 0.5; mu = 1\nx1'' = F - mu sign(x1' - x2')\nx2'' = -mu/2 sign(x2' - x1')\n"
              "x1(0) = 0; x2(0) = 0; x1'(0) = 1; x2'(0) = 0\nuntil 4",
              ways[i].method, ways[i].tolerance, NAN, 3);
    }
}

/* The bits of a run, and in how many steps the witness has looked. */
static bool bits_of(motus_system *s, const char *model, const char *method, double tolerance, double step, double *x,
                    double *v)
{
    for (int with = 0; with < 2; with++) {
        motus_error err = motus_default_error();
        motus_run_def def = motus_default_run();
        motus_run *r = NULL;
        def.method = method;
        def.tolerance = tolerance;
        def.step = step;
        def.error = with ? MOTUS_BARS_CHEAP : MOTUS_BARS_NONE;
        if (motus_run_create(s, &def, &r, &err)) return false; /* it does not admit the model */
        motus_run_finish(r, &err);                             /* and may come to no end in such steps */
        must(motus_run_state(r, x + 32 * with, v + 32 * with, &err), &err, model);
        motus_run_destroy(r);
    }
    return true;
}

/* The witness refuses steps where a force is leapt, and moves no bit elsewhere. */
static void bits(void **state)
{
    (void)state;
    static const char *const models[] = {"kepler.motus",    "henon-heiles.motus",           "pendulum.motus",
                                         "ueda.motus",      "double-pendulum.motus",        "outer-solar-system.motus",
                                         "arenstorf.motus", "three-body-figure-eight.motus"};
    for (size_t m = 0; m < sizeof models / sizeof *models; m++) {
        motus_system *const s = given_model(models[m], NULL, 0);
        motus_settings set = motus_default_settings();
        motus_settings_of(s, &set);
        for (int i = 1; i < WAYS + STEPS; i++) {
            const bool chosen = i < WAYS;
            double x[64] = {0}, v[64] = {0};
            const double step = isnan(set.step) ? 0.01 : 4 * set.step;
            if (!bits_of(s, models[m], chosen ? ways[i].method : steps[i - WAYS], chosen ? ways[i].tolerance : NAN,
                         chosen ? NAN : step, x, v))
                continue;
            assert_memory_equal(x, x + 32, 32 * sizeof *x);
            assert_memory_equal(v, v + 32, 32 * sizeof *v);
        }
        motus_system_destroy(s);
    }
}

static int pull(void *ctx, double t, const double *x, const double *v, double *a)
{
    (void)ctx, (void)t, (void)v;
    a[0] = -x[0];
    return 0;
}

static double looked(motus_system *s, const char *method, double step, double until)
{
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_estimate estimate = motus_default_estimate();
    motus_run *r = NULL;
    def.method = method;
    def.step = step;
    def.until = until;
    def.error = MOTUS_BARS_CHEAP;
    must(motus_run_create(s, &def, &r, &err), &err, method);
    must(motus_run_finish(r, &err), &err, method);
    must(motus_run_estimate(r, &estimate, &err), &err, method);
    motus_run_destroy(r);
    motus_system_destroy(s);
    return estimate.looked;
}

/* It is said where nobody looked. */
static void share(void **state)
{
    (void)state;
    static const char pulse[] = "x'' = -x + exp(-((t - 7.3)/0.01)^2)\nx(0) = 1; x'(0) = 0";
    motus_error err = motus_default_error();
    motus_system *s = NULL;
    const double one = 1, zero = 0;
    motus_callback_def def = motus_default_callback();
    def.positions = 1, def.x = &one, def.v = &zero;
    def.acceleration = pull;
    must(motus_system_from_callback(&def, &s, &err), &err, "a callback");
    assert_true(isnan(looked(s, "rk4", 0.1, 10)));
    assert_true(looked(given_text("x'' = -x\nx(0) = 1; x'(0) = 0"), "rk4", 0.1, 10) == 1);
    assert_true(looked(given_text(pulse), "rk4", 0.1, 10) == 1);
    const double part = looked(given_text("x'' = -x - 0.1 tanh(x)\nx(0) = 3; x'(0) = 0"), "rk4", 0.02, 5000);
    assert_true(part > 0.01 && part < 0.9);
    assert_true(looked(given_text(pulse), "rk4", 0.01, 5000) == 1); /* where there is a peak there may be others */
}

/* A run whose sides, or values at what it holds, are those of another force than the typed one is no answer: it ends.
 * The sides of the one are put in place of those of the other. */
static void sides(void **state)
{
    (void)state;
    static const struct {
        const char *typed, *other;
    } forces[] = {
        {"x'' = -x - 0.2 sign(x - 7)\nx(0) = 1; x'(0) = 0.1\nuntil 9", "x'' = -x + 0.2 sign(x - 7)"},
        {"x'' = -x + abs(x - 7)\nx(0) = 1; x'(0) = 0.1\nuntil 9", "x'' = -x - abs(x - 7)"},
        {"x'' = if(x < 7, 1, 1.2)\nx(0) = -1; x'(0) = 0.1\nuntil 3", "x'' = if(x < 7, 1.2, 1)"},
        {"x'' = 1.3 - sign(x')\nx(0) = 1; x'(0) = 0\nuntil 3", "x'' = 0.3 - sign(x')"},
        {"x'' = 0.3 - sign(x')\nx(0) = 1; x'(0) = 0\nuntil 3", "x'' = 1.3 - sign(x')"},
        {"x'' = sin(t) - abs(x') x'\nx(0) = 0; x'(0) = 0\nuntil 2", "x'' = 0 sin(t) - abs(x') x'"},
    };
    for (size_t m = 0; m < sizeof forces / sizeof *forces; m++)
        for (int i = 1; i < WAYS; i++)
            for (int wrong = 0; wrong < 2; wrong++) {
                char text[256];
                motus_error err = motus_default_error();
                snprintf(text, sizeof text, "%s%s", forces[m].other, strchr(forces[m].typed, '\n'));
                motus_system *const s = given_text(forces[m].typed), *const other = given_text(text), *to;
                const char *why;
                must(located_of(s, MOTUS_SWITCHES_LOCATE, &to, &why, &err), &err, text);
                must(located_of(other, MOTUS_SWITCHES_LOCATE, &to, &why, &err), &err, text);
                motus_system *const own = s->located;
                if (wrong) s->located = other->located, other->located = own;
                motus_run_def def = motus_default_run();
                motus_run *r = NULL;
                def.method = ways[i].method;
                def.tolerance = ways[i].tolerance;
                def.error = MOTUS_BARS_CHEAP;
                motus_status status = motus_run_create(s, &def, &r, &err);
                if (status == MOTUS_OK) status = motus_run_finish(r, &err);
                motus_run_destroy(r);
                if (wrong) other->located = s->located, s->located = own;
                motus_system_destroy(s);
                motus_system_destroy(other);
                if (status == MOTUS_METHOD) break;
                if (wrong != (status == MOTUS_SOLVE) || (wrong && !strstr(err.message, "another force on x' than")))
                    fail_msg("%s by %s: %d %s", forces[m].typed, def.method, status, err.message);
            }
}

/* The machine decides no step: a run in which the witness refuses steps has the same bits on each. */
static void machines(void **state)
{
    (void)state;
    for (int i = 1; i < WAYS; i++) {
        double x[2], v[2];
        int64_t steps[2];
        for (int k = 0; k < 2; k++) {
            motus_error err = motus_default_error();
            motus_system *const s = given_text("x'' = -x + exp(-((t - 7.3)/0.01)^2) - 0.3 tanh((x - 0.2)/1e-3)\n"
                                               "x(0) = 1; x'(0) = 0\nuntil 40");
            motus_run_def def = motus_default_run();
            motus_run *r = NULL;
            def.method = ways[i].method;
            def.tolerance = ways[i].tolerance;
            def.error = MOTUS_BARS_CHEAP;
            def.machine = k ? "compiled" : "interpreter";
            must(motus_run_create(s, &def, &r, &err), &err, def.method);
            must(motus_run_finish(r, &err), &err, def.method);
            must(motus_run_state(r, &x[k], &v[k], &err), &err, def.method);
            steps[k] = motus_run_steps(r);
            motus_run_destroy(r);
            motus_system_destroy(s);
        }
        assert_memory_equal(&x[0], &x[1], sizeof *x);
        assert_memory_equal(&v[0], &v[1], sizeof *v);
        assert_int_equal(steps[0], steps[1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(flights), cmocka_unit_test(pulses), cmocka_unit_test(brakes),
                                       cmocka_unit_test(peaks),   cmocka_unit_test(walls),  cmocka_unit_test(trains),
                                       cmocka_unit_test(carried), cmocka_unit_test(let_go), cmocka_unit_test(bars_hold),
                                       cmocka_unit_test(sticks),  cmocka_unit_test(bits),   cmocka_unit_test(machines),
                                       cmocka_unit_test(sides),   cmocka_unit_test(share)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
