/* The Taylor method: its order, its series at the points between steps, its steps where series vanish or end, and the
 * same bits on both machines. The recurrences themselves: series_test.c.
 */
#include "api/system/system.h"
#include "core/rows.h"
#include "core/stepper.h"

#include "test/given.h"
#include "test/given_cache.h"

#include <dirent.h>

/* Every function of the language, families, sums of more than 16 terms with conditions, choices, a driven boundary,
 * first-order variables, x/|r|^3 in its spellings. */
static const char *const texts[] = {
    "x'' = sin(x) + cos(2 x) - tan(x/4) + asin(x/5) - acos(x/6) + atan(x) + atan2(x, 2 + x') - 4 x\nx(0) = 0.5\nx'(0) "
    "= "
    "0.1",
    "x'' = sinh(x/2) - cosh(x/3)/4 + tanh(x) - exp(-x) + log(9 + x) - sqrt(8 + x) - cbrt(x - 4) - 2 x\nx(0) = "
    "0.5\nx'(0) "
    "= 0",
    "x'' = hypot(x, 2) - erf(x) - (5 + x)^1.3 - 2^x + (9 + x')^(x/5) - 3 x\nx(0) = 0.5\nx'(0) = 0.1",
    "x'' = abs(x - 9) - min(x, 7) + max(x', -8) - mod(x, 20) - if(x > -5, 2 x, 3) - sign(x + 8)\nx(0) = 0.5\nx'(0) = "
    "0.1",
    "r'' = -r/|r|^3 - 0.01 r/(dot(r, r) |r|) - 0.02 r dot(r, r)^-1.5 - 0.01 r/|r|\nr(0) = (1, 0, 0.2)\nr'(0) = "
    "(0, 1, 0)",
    "r'' = -r |r| - 0.1 r |r|^3 + 0.1 r/|r|^5\nr(0) = (1, 0.5)\nr'(0) = (0, 1)",
    "s' = -s + x^2\nx'' = -x - 0.1 x' - s/10 + cos(2 t/3)\nu' = t sin(t)\nx(0) = 1\nx'(0) = 0\ns(0) = 0\nu(0) = 1",
    "x[i]'' = x[i+1] - 2 x[i] + x[i-1] + 0.5 (x[i+1] - x[i])^3 - 0.5 (x[i] - x[i-1])^3 for i = 1..5\nx[0] = 0.1 "
    "sin(t)\n"
    "x[6] = 0\nx[i](0) = sin(i) for i = 1..5\nx[i]'(0) = 0 for i = 1..5",
    "x[i]'' = -x[i] - sum(j = 1..20, j != i: sin(x[i] - x[j])/(20 + j)) - sum(j = 1..i: x[j]/99) for i = 1..20\n"
    "x[i](0) = sin(i) for i = 1..20\nx[i]'(0) = 0 for i = 1..20",
    "x'' = 1.5 t^2 - 2\nx(0) = 1\nx'(0) = 0",
    /* lanes along an index: more values than fill a vector, and some left over; neighbours on a ring; two indices */
    "m[i] = 1/(i + 1) for i = 1..11\nr[i]'' = sum(j = 1..11, j != i: m[j] (r[j] - r[i])/|r[j] - r[i]|^3) - i r[i]'/99 "
    "for i = 1..11\nr[i](0) = (cos(i), sin(i), i/5) for i = 1..11\nr[i]'(0) = (0, i/20, 0.1) for i = 1..11",
    /* pairs that are taken once: even and odd parts, two cells, partial sums, none */
    "x[i]'' = sum(j = 1..2, j != i: (x[j] - x[i])/(1 + (x[j] - x[i])^2)) for i = 1..2\nx[i](0) = i for i = 1..2\n"
    "x[i]'(0) = 0 for i = 1..2",
    "N = 18\nx[i]'' = sum(j = 1..N, j != i: 0.1 exp(-(x[j] - x[i])^2)) + sum(j = 1..N, j != i: j ((x[j] - x[i]) "
    "exp(-(x[j] - x[i])^2))) - x[i] for i = 1..N\nx[i](0) = sin(i) for i = 1..N\nx[i]'(0) = 0 for i = 1..N",
    "x[i]'' = sum(j = 1..7, j != i: (x[j] - x[i])^2 (x[j] - x[i])) for i = 1..7\nx[i](0) = i/9 for i = 1..7\n"
    "x[i]'(0) = 0 for i = 1..7",
    "x[i]'' = sum(j = 1..9, j != i: (x[j] - x[i])/(1 + (x[j] - x[i])^2) + x[i]'/9) for i = 1..9\nx[i](0) = cos(i) for "
    "i = 1..9\nx[i]'(0) = 0 for i = 1..9",
    "x[i]'' = sum(j = 1..1, j != i: (x[j] - x[i])/(1 + (x[j] - x[i])^2)) - x[i] for i = 1..1\nx[i](0) = i for i = "
    "1..1\n"
    "x[i]'(0) = 0 for i = 1..1",
    "x[i]'' = sin(x[mod(i, 19) + 1] - x[i]) - x[i] exp(-t/9)/i for i = 1..19\nx[i](0) = cos(i) for i = 1..19\nx[i]'(0) "
    "= "
    "0 for i = 1..19",
    "x[i,j]'' = x[mod(i, 3) + 1,j] + x[i,mod(j, 9) + 1] - 2 x[i,j] - x[i,j]^3 for i = 1..3, j = 1..9\nx[i,j](0) = "
    "sin(i + "
    "2 j) for i = 1..3, j = 1..9\nx[i,j]'(0) = 0 for i = 1..3, j = 1..9",
};
enum { TEXTS = sizeof texts / sizeof *texts };

static motus_run *run_from(motus_system *s, const char *machine, double start, const double *x, double until)
{
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    def.method = "taylor";
    def.start = start;
    def.until = until;
    def.tolerance = 1e-15;
    def.machine = machine;
    def.x = x;
    def.v = x ? x + motus_positions(s) : NULL;
    must(motus_run_create(s, &def, &r, &err), &err, machine);
    return r;
}

static motus_run *run_on(motus_system *s, const char *machine, double until)
{
    return run_from(s, machine, NAN, NULL, until);
}

static void both_machines(motus_system *s, double until, const char *what)
{
    motus_run *a = run_on(s, "interpreter", until), *b = run_on(s, "compiled", until);
    size_t count;
    finish(a);
    finish(b);
    double *x = whole_state(s, a, &count), *y = whole_state(s, b, NULL);
    if (memcmp(x, y, count * sizeof *x)) fail_msg("the machines differ: %s", what);
    assert_int_equal(motus_run_steps(a), motus_run_steps(b));
    assert_int_equal(motus_run_now(a).evaluations, motus_run_now(b).evaluations);
    free(x);
    free(y);
    motus_run_destroy(a);
    motus_run_destroy(b);
}

static void machines_agree(void **unused)
{
    (void)unused;
    char path[1024];
    given_path(path, sizeof path, "models", "");
    DIR *folder = opendir(path);
    assert_non_null(folder);
    int models = 0;
    for (struct dirent *e; (e = readdir(folder));) {
        if (!strstr(e->d_name, ".motus")) continue;
        motus_system *s = given_model(e->d_name, NULL, 0);
        both_machines(s, NAN, e->d_name);
        motus_system_destroy(s);
        models++;
    }
    closedir(folder);
    assert_true(models > 20);
    for (int k = 0; k < TEXTS; k++) {
        motus_system *s = given_text(texts[k]);
        both_machines(s, 3, texts[k]);
        motus_system_destroy(s);
    }
}

/* The state at the end, to be freed; its numbers and the steps that led there. */
static double *end_of(motus_system *s, double start, const double *x, double until, size_t *count, double *steps)
{
    motus_run *r = run_from(s, "interpreter", start, x, until);
    finish(r);
    double *y = whole_state(s, r, count);
    *steps += (double)motus_run_steps(r);
    motus_run_destroy(r);
    return y;
}

static double distance(const double *x, const double *y, size_t count)
{
    double most = 0;
    for (size_t k = 0; k < count; k++) most = fmax(most, fabs(x[k] - y[k]));
    return most;
}

/* Forward, and back to a quarter of the way: with so high an order only rounding is left, a few operations a step,
 * which grows as the distance of neighbouring motions does. A series that is wrong departs in its first terms. */
static void a_run_returns_on_its_way(void **unused)
{
    (void)unused;
    const double moved = 0x1p-30;
    for (int k = 0; k < TEXTS; k++) {
        motus_system *s = given_text(texts[k]);
        size_t count;
        double steps = 0, size = 1;
        double *there = end_of(s, NAN, NULL, 0.25, &count, &steps), *end = end_of(s, NAN, NULL, 1, &count, &steps);
        double *back = end_of(s, 1, end, 0.25, &count, &steps), *near = malloc(count * sizeof *near);
        assert_non_null(near);
        for (size_t i = 0; i < count; i++) {
            size = fmax(size, fabs(end[i]));
            near[i] = end[i] + moved;
        }
        double *apart = end_of(s, 1, near, 0.25, &count, &steps);
        const double growth = fmax(1, distance(apart, back, count) / moved);
        const double bound = 8 * steps * size * growth * ROUNDING, off = distance(back, there, count);
        if (!(off <= bound)) fail_msg("returns to %g from where it was, %g is rounding: %s", off, bound, texts[k]);
        free(there), free(end), free(back), free(near), free(apart);
        motus_system_destroy(s);
    }
}

/* x'' = 6 x^2 from (1, 2) is 1/(1 - t)^2, and the integral of x is 1/(1 - t): the coefficients are n + 1, those of the
 * velocity (n + 1)(n + 2), those of the integral 1. A row of order p that takes the step that it is given has the sums
 * up to p, and to p - 1 of what is a velocity; so its local errors go with h^(p+1) and h^p. */
static void the_order_is_that_of_the_series(void **unused)
{
    (void)unused;
    motus_system *s = given_text("x'' = 6 x^2\nu' = x\nx(0) = 1\nx'(0) = 2\nu(0) = 1");
    motus_error err = motus_default_error();
    chosen whole;
    must(row_choose("taylor", &whole, NULL, &err), &err, "taylor");
    for (int order = 4; order <= SERIES_ORDER_MOST; order++) {
        row own = *whole.row;
        chosen shorter = whole;
        own.series = order;
        shorter.relative = INFINITY; /* no step is too long */
        shorter.row = &own;
        const double h = shorter.first = 0.25;
        double x[1], v[2], sum_x = 0, sum_v = 0, sum_u = 0;
        for (int n = order; n >= 0; n--) {
            sum_x = sum_x * h + (n + 1);
            if (n < order) sum_v = sum_v * h + (n + 1) * (n + 2), sum_u = sum_u * h + 1;
        }
        stepper *one;
        must(stepper_create(&s->machine, &shorter, 0, h, s->x0, s->v0, NULL, &one, &err), &err, "a step");
        must(stepper_advance(one, (stepper_limit){1, h}, NULL, &err), &err, "a step");
        must(stepper_sync(one, x, v, NULL, &err), &err, "a step");
        assert_true(stepper_time(one) == h && stepper_steps(one) == 1);
        /* some roundings of each coefficient; what order p lacks is more up to order 24: 25 h^24 */
        assert_true(fabs(x[0] - sum_x) <= 4 * order * ROUNDING * sum_x);
        assert_true(fabs(v[0] - sum_v) <= 4 * order * ROUNDING * sum_v);
        assert_true(fabs(v[1] - sum_u) <= 4 * order * ROUNDING * sum_u);
        stepper_destroy(one);
    }
    row longer = *whole.row;
    chosen too_long = whole;
    stepper *none = NULL;
    longer.series = SERIES_ORDER_MOST + 1, too_long.row = &longer;
    assert_int_equal(stepper_create(&s->machine, &too_long, 0, 0.25, s->x0, s->v0, NULL, &none, &err), MOTUS_LIMIT);
    assert_non_null(strstr(err.message, "order 48"));
    motus_system_destroy(s);
}

typedef struct known {
    const char *text;
    double until, x, size;
} known;

/* Motions in closed form, or with an integral that gives them; `size` is how large rounding is there, in units of the
 * rounding of one number, by the length of the way. */
static void known_motions(void **unused)
{
    (void)unused;
    const known motions[] = {
        {"x'' = -x\nx(0) = 1\nx'(0) = 0", 100, 0.86231887228768393, 100},
        /* orders 1 mod 4 alone: the lemniscate's sine of sl(t), with period 2 x 2.622057554292119 */
        {"x'' = -2 x^3\nx(0) = 0\nx'(0) = 1", 2.622057554292119 * 4.5, 1, 30},
        /* |v| v from rest, where the series of |v| has no radius */
        {"x'' = 1 - x' |x'|\nx(0) = 0\nx'(0) = 0", 2, 1.3250027473578644, 20},
        /* a jump: parabolas of the half period 2 sqrt 2 */
        {"x'' = -sign(x)\nx(0) = 1\nx'(0) = 0", 2.8284271247461903, -1, 20},
        /* a kink: a spring four times as stiff on one side, half a period of 2 and half one of 1 */
        {"x'' = -x - 3 max(x, 0)\nx(0) = 1\nx'(0) = 0", 4.71238898038469, 1, 20},
        /* the series end: one term, to the run's end */
        {"x'' = 6 t - 2\nx(0) = 1\nx'(0) = 0", 3, 19, 4},
        /* a force from rest that begins with t^4 */
        {"x'' = t^4\nx(0) = 0\nx'(0) = 0", 2, 64.0 / 30, 4},
        {"x'' = 6 x^2\nx(0) = 1\nx'(0) = 2", 0.9, 100, 4000},
    };
    for (size_t k = 0; k < sizeof motions / sizeof *motions; k++) {
        const known *m = &motions[k];
        motus_system *s = given_text(m->text);
        size_t count;
        double steps = 0, *y = end_of(s, NAN, NULL, m->until, &count, &steps);
        const double off = fabs(y[0] - m->x), bound = m->size * fmax(1, fabs(m->x)) * 2 * ROUNDING * 4;
        if (!(off <= bound)) fail_msg("x is %.17g, %.2g off: %s", y[0], off, m->text);
        free(y);
        motus_system_destroy(s);
    }
}

/* A taken step computes the orders 0 … 22 of the acceleration, a refused one a single one, and the size of the first
 * step takes one. */
static void evaluations_are_orders(void **unused)
{
    (void)unused;
    motus_system *s = given_model("kepler.motus", NULL, 0);
    motus_run *r = run_on(s, "interpreter", 20);
    finish(r);
    const motus_run_statistics st = motus_run_now(r);
    assert_int_equal(st.evaluations, 25 * st.steps + st.refused + 1); /* order 26 */
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* The rule by the last eight coefficients is right by itself where a motion is smooth, also where three of four of them
 * vanish: the comparison at the end of the step has nothing to refuse. */
static void smooth_motions_refuse_no_step(void **unused)
{
    (void)unused;
    const char *const smooth[] = {"x'' = -2 x^3\nx(0) = 0\nx'(0) = 1", "x'' = -x - x^5\nx(0) = 0\nx'(0) = 1",
                                  "r'' = -r/|r|^3\nr(0) = (0.1, 0)\nr'(0) = (0, 4)",
                                  "x'' = (1 - x^2) x' - x\nx(0) = 2\nx'(0) = 0", "x'' = cos(t)\nx(0) = 0\nx'(0) = 0"};
    for (size_t k = 0; k < sizeof smooth / sizeof *smooth; k++) {
        motus_system *s = given_text(smooth[k]);
        motus_run_def def = motus_default_run();
        motus_error err = motus_default_error();
        motus_run *r = NULL;
        def.method = "taylor", def.machine = "interpreter", def.tolerance = 1e-15, def.until = 20;
        must(motus_run_create(s, &def, &r, &err), &err, smooth[k]);
        finish(r);
        const motus_run_statistics st = motus_run_now(r);
        if (st.refused) fail_msg("%d steps of %d refused: %s", (int)st.refused, (int)st.steps, smooth[k]);
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

/* Between steps stands the series: what a run that ends there has, but for rounding. */
static void samples_are_the_motion(void **unused)
{
    (void)unused;
    motus_system *s = given_text(texts[6]);
    for (int machine = 0; machine < 2; machine++) {
        motus_run *r = run_on(s, machine ? "compiled" : "interpreter", 2);
        for (int k = 1; k < 40; k++) {
            const double t = 2 * (k + 0.3) / 41;
            size_t count, columns[2] = {column(s, "x"), column(s, "s")};
            double steps = 0, out[2], *due = end_of(s, NAN, NULL, t, &count, &steps);
            motus_error err = motus_default_error();
            must(motus_run_sample(r, &t, 1, columns, 2, out, &err), &err, "sample");
            /* x, x', s, u: the series and the rounding of some steps */
            assert_true(fabs(out[0] - due[0]) <= 8 * (steps + 2) * 2 * ROUNDING);
            assert_true(fabs(out[1] - due[2]) <= 8 * (steps + 2) * 2 * ROUNDING);
            free(due);
        }
        motus_run_destroy(r);
    }
    motus_system_destroy(s);
}

/* Interrupted in the middle, and continued by another run on the other machine. */
static void restarts(void **unused)
{
    (void)unused;
    for (int k = 0; k < TEXTS; k++) {
        motus_system *s = given_text(texts[k]);
        motus_error err = motus_default_error();
        motus_run *whole = run_on(s, "interpreter", 4), *first = run_on(s, "compiled", 4),
                  *second = run_on(s, "interpreter", 4);
        const char *text;
        size_t length, count;
        finish(whole);
        take_steps(first, 3);
        must(motus_run_save(first, &text, &length, &err), &err, "save");
        must(motus_run_restore(second, text, length, &err), &err, "restore");
        finish(second);
        finish(first);
        double *x = whole_state(s, whole, &count), *y = whole_state(s, second, NULL), *z = whole_state(s, first, NULL);
        assert_memory_equal(x, y, count * sizeof *x);
        assert_memory_equal(x, z, count * sizeof *x);
        free(x), free(y), free(z);
        motus_run_destroy(whole);
        motus_run_destroy(first);
        motus_run_destroy(second);
        motus_system_destroy(s);
    }
}

static int falls(void *context, double t, const double *x, const double *v, double *a)
{
    (void)context, (void)t, (void)x, (void)v;
    a[0] = -1;
    return 0;
}

static void a_callback_is_refused(void **unused)
{
    (void)unused;
    motus_callback_def def = motus_default_callback();
    motus_run_def run = motus_default_run();
    motus_error err = motus_default_error();
    motus_system *s = NULL;
    motus_run *r = NULL;
    const double x[1] = {0};
    def.positions = 1;
    def.acceleration = falls;
    def.x = def.v = x;
    must(motus_system_from_callback(&def, &s, &err), &err, "callback");
    run.method = "taylor";
    run.step = run.until = 1;
    assert_int_equal(motus_run_create(s, &run, &r, &err), MOTUS_METHOD);
    assert_non_null(strstr(err.message, "Taylor series need its formula"));
    motus_system_destroy(s);
}

static int begin(void **unused) { return (void)unused, open_shared_cache(), 0; }
static int end(void **unused) { return (void)unused, close_cache(), 0; }

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(machines_agree),
        cmocka_unit_test(a_run_returns_on_its_way),
        cmocka_unit_test(known_motions),
        cmocka_unit_test(the_order_is_that_of_the_series),
        cmocka_unit_test(evaluations_are_orders),
        cmocka_unit_test(samples_are_the_motion),
        cmocka_unit_test(restarts),
        cmocka_unit_test(smooth_motions_refuse_no_step),
        cmocka_unit_test(a_callback_is_refused),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
