/* What a model claims of its motion, its exact lines and invariants, is checked: true claims are taken whatever their
 * rounding, false ones refused, and both by the text, by motus_system_set and at the start of an exact run. */
#include "test/given.h"

#include <stdbool.h>

#define START "x(0) = 1\nx'(0) = 0\n"

static motus_status read_text(const char *text, motus_error *err)
{
    motus_system *s = NULL;
    motus_text_def def = motus_default_text();
    def.text = text;
    const motus_status status = motus_system_from_text(&def, &s, err);
    motus_system_destroy(s);
    return status;
}

static void takes(const char *text)
{
    motus_error err = motus_default_error();
    must(read_text(text, &err), &err, text);
}

/* The message contains every part. */
static void refuses(const char *text, const char *first, const char *second, int line)
{
    motus_error err = motus_default_error();
    if (read_text(text, &err) != MOTUS_ARGUMENT) fail_msg("taken: %s", text);
    if (!strstr(err.message, first) || !strstr(err.message, second) || err.line != line || !err.hint[0])
        fail_msg("%s\n%d: %s", text, err.line, err.message);
}

/* Exact lines -------------------------------------------------------------------------------------------------- */

static void true_exact_lines(void **unused)
{
    (void)unused;
    static const char *const texts[] = {
        "x'' = -x\nx(0) = 0\nx'(0) = 1\nexact x = cos(t - pi/2)\n",        /* 6e-17 at the start */
        "x'' = -x\nx(0) = 0\nx'(0) = 1\nexact x = cos(t - 100001 pi/2)\n", /* 1e-11 */
        "x'' = -x\n" START "exact x = cos(t)\nuntil 100000\n",
        "x'' = x\nx(0) = 1\nx'(0) = 1\nexact x = exp(t)\nuntil 50\n",
        "x'' = -1e-30 x\n" START "exact x = cos(1e-15 t)\nuntil 1e16\n",
        "from 1\nx'' = 2 x^2 - x'/t\nx(1) = 1\nx'(1) = 1\n",
        /* energy lost by cancellation: x is the small difference of large terms */
        "x'' = 0.000001 cos(0.001 t)\nx(0) = 0\nx'(0) = 0\nexact x = 1 - cos(0.001 t)\nuntil 1\n",
        /* at rest, where the size of the motion is 0 */
        "x'' = t\nx(0) = 0\nx'(0) = 0\nexact x = t^3/6\nuntil 10\n",
        "from 1\nx'' = 0.7\nx(1) = 0\nx'(1) = 0\nexact x = 0.35 t^2 - 0.7 t + 0.35\nuntil 10\n",
        "x'' = 1/x^3\n" START "exact x = sqrt(1 + t^2)\nuntil 10\n",
        "x' = -x\nx(0) = 1\nexact x = exp(-t)\nuntil 10\n",
        /* a trap as in a laboratory: the slow frequency is the small difference of two large ones */
        "k = (0, 0, 1)\nwc = 1000\nwz = 1\nr'' = wz^2 (r - 3 dot(r, k) k)/2 + wc cross(r', k)\nr(0) = (1, 0, 0.5)\n"
        "r'(0) = (0, 0, 0)\nw1 = (wc + sqrt(wc^2 - 2 wz^2))/2\nw2 = (wc - sqrt(wc^2 - 2 wz^2))/2\ns = r(0) - dot(r(0), "
        "k) k\nA = (-cross(r'(0), k) - w2 s)/(w1 - w2)\nC = (cross(r'(0), k) + w1 s)/(w1 - w2)\nexact r = A cos(w1 t) "
        "+ "
        "cross(A, k) sin(w1 t) + C cos(w2 t) + cross(C, k) sin(w2 t) + dot(r(0), k) cos(wz t) k\nuntil 40\n",
        "N = 50\nx[i]'' = x[i+1] - 2 x[i] + x[i-1] for i = 1..N\nx[0] = 0\nx[N+1] = 0\nw = 2 sin(pi/(2 N + "
        "2))\nx[i](0) "
        "= sin(pi i/(N + 1)) for i = 1..N\nx[i]'(0) = 0 for i = 1..N\nexact x[i] = sin(pi i/(N + 1)) cos(w t) for i = "
        "1..N\nuntil 100\n",
        "x'' = 0\nx(0) = 0\nx'(0) = 1e-300\nexact x = 1e-300 t\nuntil 1\n",
    };
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) takes(texts[k]);
}

static void false_exact_lines(void **unused)
{
    (void)unused;
    refuses("x'' = -x\nx(0) = 1.000000001\nx'(0) = 0\nexact x = cos(t)\n", "x is 1 at the start, not 1.000000001",
            "differ by -1e-09", 4);
    refuses("x'' = -x\nx(0) = 1\nx'(0) = 1e-12\nexact x = cos(t)\n", "x' is -0 at the start, not 1e-12", "", 4);
    /* far off later on, which counts nothing at the start */
    refuses("x'' = x\nx(0) = 1.000000001\nx'(0) = 1\nexact x = exp(t)\nuntil 50\n", "not 1.000000001", "", 4);
    /* right at every 64th of the run */
    refuses("x'' = -x\n" START "exact x = cos(t) + 0.000000001 sin(64 pi t)^4\nuntil 1\n", "does not obey the equation",
            "the force gives", 4);
    refuses("k = 1.00000000001\nx'' = -k x\n" START "exact x = cos(t)\nuntil 10\n", "the force gives", "differ by", 5);
    refuses("r'' = -r\nr(0) = (1, 0)\nr'(0) = (0, 1)\nexact r = (cos(t), sin(t) (1 + 0.000001 t^2))\n", "r''.y",
            "differ", 4);
}

/* Pulses and switches between any times that one would sample, poles, and switches at which rounding decides. */
static void exact_lines_between(void **unused)
{
    (void)unused;
    static const char *const pulses[] = {
        "exp(-((t - 5.003)/0.001)^2)",
        "1000 exp(-((x - 0.3)/0.0001)^2)",
        "if(t > 5.003, if(t < 5.0031, 1000, 0), 0)",
        "if(x > 0.3, if(x < 0.30001, 1000, 0), 0)",
        "1000 max(0, 1 - |t - 5.003|/0.0001)",
        "1000 (floor(t + 0.0001) - floor(t))",
        "if(mod(t + 1, 3.003) < 0.0001, 1000, 0)",
    };
    for (size_t k = 0; k < sizeof pulses / sizeof *pulses; k++) {
        char text[256];
        snprintf(text, sizeof text, "x'' = -x + %s\n" START "exact x = cos(t)\nuntil 10\n", pulses[k]);
        refuses(text, "does not obey the equation", "the force gives", 4);
    }
    refuses("x'' = -x\n" START "exact x = cos(t) + 0.001 exp(-((t - 5.003)/0.001)^2)\nuntil 10\n", "does not obey", "",
            4);
    refuses("s' = s^2\ns(0) = 1\nexact s = 1/(1 - t)\nuntil 3\n", "has a pole at t = 1", "", 3);
    refuses("x'' = -x - 0.1 sign(x')\n" START "exact x = 0.1 + 0.9 cos(t)\nuntil 4\n", "does not obey", "", 4);
    takes("s' = s^2\ns(0) = 1\nexact s = 1/(1 - t)\nuntil 0.999\n");
    takes("x'' = -x - 0.1 sign(x')\n" START "exact x = 0.1 + 0.9 cos(t)\nuntil 3\n");
    takes("x'' = -sign(t - 1)\nx(0) = 0\nx'(0) = 0\nexact x = if(t < 1, t^2/2, t - 0.5 - (t - 1)^2/2)\nuntil 2\n");
    takes("x'' = -if(t >= 5, 1, 0)\nx(0) = 0\nx'(0) = 0\nexact x = -max(t - 5, 0)^2/2\nuntil 10\n");
    takes("r'' = -r/|r|^3\nr(0) = (1, 0)\nr'(0) = (0, 1)\nexact r = (cos(t), sin(t))\nuntil 100000\n");
}

/* What the check did not see is said. */
static void exact_lines_unseen(void **unused)
{
    (void)unused;
    static const char *const texts[] = {
        "r'' = -r/|r|^3\nr(0) = (1, 0)\nr'(0) = (0, 1)\nexact r = (cos(t), sin(t))\nuntil 10\n",
        "r'' = -r/|r|^3\nr(0) = (1, 0)\nr'(0) = (0, 1)\nexact r = (cos(t), sin(t))\nuntil 100000\n",
        "x'' = -x + sum(k = 1..3: if(t > 5.003 k, if(t < 5.0031 k, 1, 0), 0))\n" START "exact x = cos(t)\nuntil 10\n",
    };
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) {
        motus_system *s = given_text(texts[k]);
        assert_int_equal(strstr(motus_explain(s), "between them the force may change unseen") != NULL, k > 0);
        motus_system_destroy(s);
    }
}

/* The run by the exact motion has the same judgement. */
static void starts_of_exact_runs(void **unused)
{
    (void)unused;
    motus_error err = motus_default_error();
    motus_system *s = given_text("x'' = -x\nx(0) = 0\nx'(0) = 1\nexact x = cos(t - 100001 pi/2)\nstep 0.1\nuntil 1\n");
    motus_run_def def = motus_default_run();
    motus_run *r;
    def.method = "exact";
    must(motus_run_create(s, &def, &r, &err), &err, "rounding");
    motus_run_destroy(r);
    const double off = 1e-7;
    def.x = &off;
    assert_int_equal(motus_run_create(s, &def, &r, &err), MOTUS_METHOD);
    assert_non_null(strstr(err.message, "not 1e-07"));
    motus_system_destroy(s);
}

static int oscillator(void *context, double t, const double *x, const double *v, double *a)
{
    (void)context, (void)t, (void)v;
    a[0] = -x[0];
    return 0;
}

static int late_cosine(void *context, double t, double *x, double *v)
{
    (void)context;
    x[0] = cos(t - 1.5707963267948966);
    v[0] = -sin(t - 1.5707963267948966);
    return 0;
}

static void exact_callbacks(void **unused)
{
    (void)unused;
    static const struct {
        double x, v;
        motus_status status;
    } starts[] = {{0, 1, MOTUS_OK}, {1e-9, 1, MOTUS_METHOD}, {0, 1.000000001, MOTUS_METHOD}};
    for (size_t k = 0; k < sizeof starts / sizeof *starts; k++) {
        motus_callback_def def = motus_default_callback();
        motus_error err = motus_default_error();
        motus_run_def run = motus_default_run();
        motus_system *s;
        motus_run *r;
        def.positions = 1;
        def.x = &starts[k].x;
        def.v = &starts[k].v;
        def.acceleration = oscillator;
        def.depends_on_velocity = def.depends_on_time = 0;
        def.exact = late_cosine;
        must(motus_system_from_callback(&def, &s, &err), &err, "callback");
        run.method = "exact";
        run.step = 0.01;
        run.until = 1;
        assert_int_equal(motus_run_create(s, &run, &r, &err), starts[k].status);
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

/* Invariants --------------------------------------------------------------------------------------------------- */

static void true_invariants(void **unused)
{
    (void)unused;
    static const char *const texts[] = {
        "x'' = -x\n" START "invariant energy = x'^2/2 + x^2/2\n",
        /* of this motion, and of no other */
        "r'' = -r/|r|^3\nr(0) = (1, 0)\nr'(0) = (0, 1)\ninvariant radius = |r|\n",
        "x'' = -x\n" START "invariant zero = x - cos(t)\n",
        "x'' = -x\n" START "E = x'(0)^2/2 + x(0)^2/2\ninvariant phase = x/sqrt(2 E) - cos(t)\n",
        /* kinks */
        "x'' = -sign(x)\n" START "invariant energy = x'^2/2 + |x|\nuntil 20\n",
        "x'' = -if(x > 0, 1, -1)\nx(0) = 0\nx'(0) = 1\ninvariant energy = x'^2/2 + |x|\nuntil 20\n",
        "x'' = -x - 100 min(x, 0)\n" START "invariant energy = x'^2/2 + x^2/2 + 50 min(x, 0)^2\nuntil 20\n",
        /* driven boundaries: their velocity is in it, their acceleration in its rate */
        "x[1]'' = 0\nx[0] = sin(t)\nx[1](0) = 1\nx[1]'(0) = 2\ninvariant d = x[1]' + x[0]' - cos(t)\nuntil 3\n",
        "N = 5\nx[i]'' = x[i+1] - 2 x[i] + x[i-1] for i = 1..N\nx[0] = sin(t)\nx[N+1] = 0\nx[i](0) = 0 for i = "
        "1..N\nx[i]'(0) = 0 for i = 1..N\nw' = x[0]' (x[0] - x[1])\nw(0) = 0\ninvariant balance = sum(i = 1..N: "
        "x[i]'^2/2) + sum(i = 0..N: (x[i+1] - x[i])^2/2) - w\nuntil 20\n",
        /* vectors, families, first-order variables */
        "r'' = -r/|r|^3\nr(0) = (1, 0, 0.2)\nr'(0) = (0, 1, 0.3)\ninvariant L = cross(r, r')\ninvariant axis = "
        "cross(r', "
        "L) - r/|r|\n",
        "x[i]'' = -i x[i] for i = 1..9\nx[i](0) = i for i = 1..9\nx[i]'(0) = 1 for i = 1..9\ninvariant e[i] = x[i]'^2 "
        "+ "
        "i x[i]^2 for i = 1..9\n",
        "x'' = -x - x'\n" START "lost' = x'^2\nlost(0) = 0\ninvariant e = x'^2/2 + x^2/2 + lost\nuntil 20\n",
        "x' = y\ny' = -x\nx(0) = 1\ny(0) = 0\ninvariant e = x^2 + y^2\n",
        /* forces that cancel almost */
        "N = 9\nx[i]'' = 1e12 (x[mod(i, N)+1] - 2 x[i] + x[mod(i - 2, N)+1]) for i = 1..N\nx[i](0) = 1 for i = "
        "1..N\nx[i]'(0) = 0 for i = 1..N\ninvariant P = sum(i = 1..N: x[i]')\n",
        /* stiff, and singular at the start */
        "mu = 1000\nx'' = mu (1 - x^2) x' - x\nx(0) = 2\nx'(0) = 0\nfed' = mu (1 - x^2) x'^2\nfed(0) = 0\ninvariant b "
        "= "
        "x'^2/2 + x^2/2 - fed\nuntil 2000\n",
        "x'' = 1/(4 x^3)\nx(0) = 1\nx'(0) = 0\ninvariant e = x'^2 + 1/(4 x^2)\nuntil -5\n",
        "x'' = -x\n" START "invariant e = x'' + x\n",
        "x'' = -x\n" START "invariant one = 1\n",
        /* kinks and jumps along the whole run */
        "x'' = -floor(x)\nx(0) = 3.3\nx'(0) = 0\ninvariant e = x'^2/2 + floor(x) (x - floor(x)) + floor(x) (floor(x) "
        "- 1)/2\nuntil 100\n",
        "x'' = -x - 0.1 sign(x')\n" START "w' = 0.1 |x'|\nw(0) = 0\ninvariant e = x^2/2 + x'^2/2 + w\nuntil 30\n",
        /* of this motion alone two terms jump at once, which they do one by one along runs */
        "x'' = -x\n" START "invariant e = |x| - |cos(t)|\nuntil 100\n",
        "x'' = -x\n" START "invariant e = max(x, 0) - max(cos(t), 0)\nuntil -100\n",
        "x'' = -x\n" START "invariant e = sign(x) - sign(cos(t))\nuntil 100\n",
        "x'' = -x\n" START "invariant e = atan2(x', x) + t - 2 pi floor((t + pi)/(2 pi))\nuntil 100\n",
        /* an angle whose cut shows in nothing, and one that stays off it */
        "x'' = -x\n" START "invariant e = sin(atan2(x', x) + t)\nuntil 100\n",
        "x'' = -x\n" START "invariant e = atan2(x' sin(t) - x cos(t), x sin(t) + x' cos(t))\nuntil 100\n",
        "r'' = -r/|r|^3\nr(0) = (1, 0)\nr'(0) = (0, 1.1)\ninvariant w = atan2(-r'.x (r.x r'.y - r.y r'.x) - r.y/|r|, "
        "r'.y (r.x r'.y - r.y r'.x) - r.x/|r|)\nuntil 30\n",
    };
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) takes(texts[k]);
}

static void false_invariants(void **unused)
{
    (void)unused;
    /* with t = 0: x = 1, x' = 0.3, the rate is x' x^3/30 */
    refuses("x'' = -x - 0.1 x^3\nx(0) = 1\nx'(0) = 0.3\ninvariant energy = x'^2/2 + x^2/2 + 0.1 x^4/3\n",
            "energy is no invariant", "at the rate 0.01 at t = 0", 4);
    refuses("x'' = -x\n" START "invariant energy = x'^2 + x^2/2\n", "energy is no invariant", "at the rate", 4);
    refuses("x'' = -x - 0.001 x'\n" START "invariant energy = x'^2/2 + x^2/2\n", "no invariant", "rate -", 4);
    /* nine digits are right */
    refuses("x'' = -1.000000001 x\n" START "invariant energy = x'^2/2 + x^2/2\n", "no invariant", "at the rate", 4);
    refuses("x'' = -x\n" START "invariant zero = x - cos(1.001 t)\n", "zero is no invariant", "", 4);
    refuses("x'' = -sign(x)\n" START "invariant energy = x'^2/2 + 1.1 |x|\nuntil 20\n", "no invariant", "", 4);
    refuses("r'' = -r/|r|^3\nr(0) = (1, 0)\nr'(0) = (0, 1.1)\ninvariant v = (|r'|^2/2 - 1/|r|, |r|)\n",
            "v (number 2 of 2)", "", 4);
    refuses("N = 5\nx[i]'' = x[i+1] - 2 x[i] + x[i-1] for i = 1..N\nx[0] = sin(t)\nx[N+1] = 0\nx[i](0) = 0 for i = "
            "1..N\nx[i]'(0) = 0 for i = 1..N\ninvariant e = sum(i = 1..N: x[i]'^2/2) + sum(i = 0..N: (x[i+1] - "
            "x[i])^2/2)\nuntil 20\n",
            "e is no invariant", "", 7);
}

/* Late, for a short time, or by a jump of the invariant itself. */
static void late_changes(void **unused)
{
    (void)unused;
    static const char *const frictions[] = {"if(t > 9, x', 0)", "exp(-((x + 0.9)/0.001)^2) x'",
                                            "if(x < -0.9, if(x > -0.901, x', 0), 0)",
                                            "if(t > 5, if(t < 5.001, x', 0), 0)"};
    static const char *const jumps[] = {"floor(x - 0.5)", "sign(x)", "x'^2 + x^2 + if(t > 9, 1, 2)", "atan2(x', x) + t",
                                        "x^2 + x'^2 + atan2(x' + 2 x, x - 2 x') + t"};
    char text[256];
    for (size_t k = 0; k < sizeof frictions / sizeof *frictions; k++) {
        snprintf(text, sizeof text, "x'' = -x - %s\n" START "invariant e = x'^2/2 + x^2/2\nuntil 10\n", frictions[k]);
        refuses(text, "e is no invariant", "it changes at the rate", 4);
    }
    for (size_t k = 0; k < sizeof jumps / sizeof *jumps; k++) {
        snprintf(text, sizeof text, "x'' = -x\n" START "invariant e = %s\nuntil 10\n", jumps[k]);
        refuses(text, "e is no invariant", "it jumps from", 4);
    }
}

/* The time that is told is that of the jump, to the digits told: in the first steps too, just before the end, and where
 * the invariant soon jumps back. What happens beyond the end is no matter. */
static void times_of_jumps(void **unused)
{
    (void)unused;
    static const struct {
        const char *e, *when;
    } jumps[] = {{"atan2(x', x) + t", "at t = 3.14159"},
                 {"x^2 + x'^2 + floor(mod(t, 7.77)/7)", "from 1 to 2 at t = 7"},
                 {"mod(floor(t/7.77), 2)", "from 0 to 1 at t = 7.77"},
                 {"if(mod(t, 7.77) > 7.76, 1, 0)", "from 0 to 1 at t = 7.76"},
                 {"floor(mod(t, 7.77)/7.77 + 0.5)", "from 0 to 1 at t = 3.885"},
                 {"if(mod(t, 7.77) < 0.001, 1, 0)", "from 1 to 0 at t = 0.001"},
                 {"if(t > 9.9999, 1, 0)", "from 0 to 1 at t = 9.9999"},
                 {"x^2 + x'^2 + if(|x - 0.3| < 1e-3, 1, 0)", "from 1 to 2 at t = 1.26506"},
                 {"x^2 + x'^2 + if(|x - 0.3| < 1e-6, 1, 0)", "from 1 to 2 at t = 1.2661"},
                 {"x^2 + x'^2 + exp(-((x - 0.3)/1e-5)^2)", "it changes at the rate"},
                 {"x^2 + x'^2 + 2/cosh((x + 0.2)/1e-4)^2", "it changes at the rate"}};
    char text[256];
    for (size_t k = 0; k < sizeof jumps / sizeof *jumps; k++) {
        snprintf(text, sizeof text, "x'' = -x\n" START "invariant e = %s\nuntil 10\n", jumps[k].e);
        refuses(text, "e is no invariant", jumps[k].when, 4);
    }
    takes("x'' = -x\n" START "invariant e = x^2 + x'^2 + if(t > 10.0001, 1, 0)\nuntil 10\n");
    refuses("x'' = -400 sin(x)\n" START "invariant e = if(t > 9.99999, 1, 0)\nuntil 10\n", "e is no invariant",
            "it jumps from 0 to 1", 4); /* nearer to the end than the runs may be late */
    takes("x'' = -400 sin(x)\n" START "invariant e = if(t > 10.00001, 1, 0)\nuntil 10\n");
}

/* Numbers that are set are checked as those of the text. */
static void set_numbers(void **unused)
{
    (void)unused;
    motus_error err = motus_default_error();
    motus_system *s = given_text("k = 2\nf = 1\nx'' = -f k x\n" START "invariant energy = x'^2/2 + k x^2/2\nuntil 5\n");
    double k = 3, f = 1.5, before;
    must(motus_system_set(s, "k", &k, 1, &err), &err, "k");
    assert_int_equal(motus_system_set(s, "f", &f, 1, &err), MOTUS_ARGUMENT);
    assert_non_null(strstr(err.message, "energy is no invariant"));
    assert_int_equal(err.line, 6);
    must(motus_parameter_values(s, 1, &before), NULL, "f");
    assert_true(before == 1);
    must(motus_system_set(s, "k", &k, 1, &err), &err, "after a refusal");
    motus_system_destroy(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(true_exact_lines),     cmocka_unit_test(false_exact_lines),
        cmocka_unit_test(starts_of_exact_runs), cmocka_unit_test(exact_lines_between),
        cmocka_unit_test(exact_lines_unseen),   cmocka_unit_test(exact_callbacks),
        cmocka_unit_test(true_invariants),      cmocka_unit_test(false_invariants),
        cmocka_unit_test(times_of_jumps),       cmocka_unit_test(late_changes),
        cmocka_unit_test(set_numbers),
    };
    return cmocka_run_group_tests_name("verify", tests, NULL, NULL);
}
