/* Tables: interp and spline beside their own formulas, in forces and in quantities, forward and backward, interpreted
 * and compiled; what lies outside; entries of lists whose number moves.
 *
 * The truth of a linear oscillator between two points of a table is a formula, evaluated in long double.
 */
#include "test/given.h"
#include "test/given_cache.h"

#include <stdbool.h>

#define POINTS 4001
static double record[POINTS];

/* A record of noise that swings: every entry is a decimal of five digits. */
static void make_record(void)
{
    uint32_t seed = 7;
    for (int k = 0; k < POINTS; k++) {
        seed = seed * 1664525u + 1013904223u;
        record[k] = round(1e5 * sin(0.013 * k) * ((double)(seed >> 8) / (1 << 24) - 0.5)) / 1e5;
    }
}

/* Writes a list of the record's first entries. */
static size_t write_record(char *to, size_t size, int count)
{
    size_t n = (size_t)snprintf(to, size, "A = [");
    for (int k = 0; k < count; k++) n += (size_t)snprintf(to + n, size - n, "%s%.5f", k ? ", " : "", record[k]);
    return n + (size_t)snprintf(to + n, size - n, "]\n");
}

/* Leads x'' = -2 zeta w x' - w^2 x - a(t) over one interval, a from a0 to a1. */
static void exact_piece(long double zeta, long double w, long double h, long double a0, long double a1, long double *x,
                        long double *v)
{
    const long double slope = (a1 - a0) / h, w2 = w * w;
    const long double p1 = -slope / w2, p0 = (-a0 - 2 * zeta * w * p1) / w2; /* p0 + p1 t is one solution */
    const long double damped = w * sqrtl(1 - zeta * zeta), decay = zeta * w;
    const long double c = *x - p0, d = (*v - p1 + decay * c) / damped;
    const long double e = expl(-decay * h), co = cosl(damped * h), si = sinl(damped * h);
    *x = e * (c * co + d * si) + p0 + p1 * h;
    *v = e * ((d * damped - decay * c) * co - (c * damped + decay * d) * si) + p1;
}

static motus_run *run_to(motus_system *s, const char *method, const char *machine, double tolerance, double until)
{
    motus_run_def def = motus_default_run();
    motus_error err = motus_default_error();
    motus_run *r = NULL;
    def.method = method;
    def.machine = machine;
    def.tolerance = tolerance;
    def.until = until;
    must(motus_run_create(s, &def, &r, &err), &err, method);
    must(motus_run_finish(r, &err), &err, method);
    return r;
}

static void state_of(motus_run *r, double *x, double *v)
{
    motus_error err = motus_default_error();
    must(motus_run_state(r, x, v, &err), &err, "state");
}

static void a_force_of_measured_numbers(void **state)
{
    (void)state;
    static char text[16 * POINTS];
    make_record();
    const size_t n = write_record(text, sizeof text, POINTS);
    snprintf(text + n, sizeof text - n,
             "w = 4\nzeta = 0.02\nx'' = -2 zeta w x' - w^2 x - interp(t, 0, 0.02, A)\nx(0) = 0.1; x'(0) = 0\n");
    motus_system *s = given_text(text);
    const int ends[] = {1, 37, 1000, POINTS - 1};
    for (size_t k = 0; k < sizeof ends / sizeof *ends; k++) {
        long double x = 0.1L, v = 0, most = 0.1L;
        for (int i = 0; i < ends[k]; i++) {
            /* the points are doubles near k/50 */
            const long double h = (long double)((i + 1) * 0.02) - (long double)(i * 0.02);
            exact_piece(0.02L, 4, h, record[i], record[i + 1], &x, &v);
            most = fmaxl(most, fabsl(x));
        }
        const char *const methods[] = {"dop853", "taylor"};
        for (int m = 0; m < 2; m++) {
            double got[2], other[2];
            motus_run *r = run_to(s, methods[m], "interpreter", 1e-14, ends[k] * 0.02);
            motus_run *c = run_to(s, methods[m], "compiled", 1e-14, ends[k] * 0.02);
            state_of(r, got, got + 1);
            state_of(c, other, other + 1);
            if (!(fabsl(got[0] - x) <= 1e-12L * most))
                fail_msg("%s, %d points: %.17g is not %.17Lg", methods[m], ends[k], got[0], x);
            assert_memory_equal(got, other, sizeof got);
            motus_run_destroy(r);
            motus_run_destroy(c);
        }
    }
    motus_system_destroy(s);
}

/* The points are ends of steps, which nothing searches: each step costs the evaluations of its stages and no more, and
 * no time is shifted from its point. */
static void points_end_steps(void **state)
{
    (void)state;
    static const char text[] = "T = [0, 1, 2.5, 3, 7]\nA = [0, 1, -1, 2, 0]\nx'' = -x + interp(%s, T, A)\n"
                               "x(%s) = 1; x'(%s) = 0\n";
    static const struct {
        const char *argument, *from;
        double until, ends[3];
    } cases[] = {{"t", "0.5", 6, {1, 2.5, 3}},
                 {"t", "6", 0.5, {3, 2.5, 1}},
                 {"7 - t", "0.5", 6.5, {4, 4.5, 6}},
                 {"(t - 1)/2", "2", 8, {3, 6, 7}}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char model[400];
        snprintf(model, sizeof model, text, cases[k].argument, cases[k].from, cases[k].from);
        motus_system *s = given_text(model);
        motus_run_def def = motus_default_run();
        motus_error err = motus_default_error();
        motus_run *r = NULL;
        def.method = "dop853";
        def.until = cases[k].until;
        def.error = MOTUS_BARS_NONE;
        must(motus_run_create(s, &def, &r, &err), &err, model);
        size_t seen = 0;
        while (!motus_run_done(r)) {
            must(motus_run_step(r, 1, &err), &err, model);
            seen += seen < 3 && motus_run_time(r) == cases[k].ends[seen];
        }
        assert_int_equal(seen, 3);
        const motus_run_statistics of = motus_run_now(r);
        assert_int_equal(of.switches, 3);
        /* 12 stages a candidate; each part begins with one more, since its first stage is not the last one before */
        if (of.evaluations > 12 * (of.steps + of.refused) + 4)
            fail_msg("%g evaluations of %g steps", (double)of.evaluations, (double)of.steps);
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

/* Backward from where a run forward ended, back to the start. */
static void backward(void **state)
{
    (void)state;
    static const char text[] = "T = [0, 0.3, 1, 4]\nA = [1, -1, 2, 0]\nx'' = -x + %s(t, T, A)\nx(%s) = %.17g; x'(%s) = "
                               "%.17g\n";
    const char *const kinds[] = {"interp", "spline"};
    for (int k = 0; k < 2; k++) {
        char forward[400], back[400];
        double at[2], home[2];
        snprintf(forward, sizeof forward, text, kinds[k], "0", 0.5, "0", 0.25);
        motus_system *s = given_text(forward);
        motus_run *r = run_to(s, "dop853", "interpreter", 1e-13, 4);
        state_of(r, at, at + 1);
        motus_run_destroy(r);
        motus_system_destroy(s);
        snprintf(back, sizeof back, text, kinds[k], "4", at[0], "4", at[1]);
        s = given_text(back);
        r = run_to(s, "dop853", "interpreter", 1e-13, 0);
        state_of(r, home, home + 1);
        if (!(fabs(home[0] - 0.5) < 1e-11 && fabs(home[1] - 0.25) < 1e-11))
            fail_msg("%s: back at %.17g, %.17g", kinds[k], home[0], home[1]);
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

static const char lists[] = "T = [0, 1, 2.5, 4]\nA = [1, 3, -2, 2]\nB = [(1, 0), (0, 1), (2, 2), (3, 1)]\n";

/* Returns component k of a quantity of a model at the position x. */
static double value_at(const char *formula, size_t k, double x)
{
    char text[1000];
    snprintf(text, sizeof text, "%sx'' = 0\nx(0) = %.17g; x'(0) = 1\nq = %s\n", lists, x, formula);
    motus_system *s = given_text(text);
    motus_run_def def = motus_default_run();
    motus_error err = motus_default_error();
    motus_run *r = NULL;
    size_t first, count;
    double out;
    def.method = "rk4";
    def.step = 0.01;
    def.until = 1;
    must(motus_run_create(s, &def, &r, &err), &err, text);
    must(motus_column_find(s, "q", &first, &count, &err), &err, "q");
    first += k;
    must(motus_run_values(r, &first, 1, &out, &err), &err, text);
    motus_run_destroy(r);
    motus_system_destroy(s);
    return out;
}

static void is_near(const char *formula, size_t k, double x, double wanted)
{
    const double got = value_at(formula, k, x);
    if (!(fabs(got - wanted) <= 1e-15 * 8)) fail_msg("%s at %g: %.17g, not %.17g", formula, x, got, wanted);
}

/* The natural spline through the points of `lists`, by the equations of its second derivatives M1 and M2,
 *     2 (h0 + h1) M1 + h1 M2 = 6 (d1 - d0),   h1 M1 + 2 (h1 + h2) M2 = 6 (d2 - d1). */
static double spline_at(double u)
{
    static const double x[] = {0, 1, 2.5, 4}, y[] = {1, 3, -2, 2};
    double h[3], d[3], m[4] = {0};
    for (int k = 0; k < 3; k++) h[k] = x[k + 1] - x[k], d[k] = (y[k + 1] - y[k]) / h[k];
    const double a = 2 * (h[0] + h[1]), b = h[1], c = 2 * (h[1] + h[2]), p = 6 * (d[1] - d[0]), q = 6 * (d[2] - d[1]);
    m[1] = (p * c - b * q) / (a * c - b * b), m[2] = (a * q - b * p) / (a * c - b * b);
    int k = u < 1 ? 0 : u < 2.5 ? 1 : 2;
    const double l = x[k + 1] - u, r = u - x[k];
    return (m[k] * l * l * l + m[k + 1] * r * r * r) / (6 * h[k]) + (y[k] / h[k] - m[k] * h[k] / 6) * l +
           (y[k + 1] / h[k] - m[k + 1] * h[k] / 6) * r;
}

static void values(void **state)
{
    (void)state;
    is_near("interp(x, T, A)", 0, 0, 1), is_near("interp(x, T, A)", 0, 1, 3), is_near("interp(x, T, A)", 0, 4, 2);
    is_near("interp(x, T, A)", 0, 0.25, 1.5), is_near("interp(x, T, A)", 0, 1.75, 0.5);
    is_near("interp(x, 10, 2, A)", 0, 13, 0.5);
    is_near("interp(x, [0, 1, 3], [5, 6, 8])", 0, 2, 7);
    is_near("interp(x, T, B)", 1, 1.75, 1.5), is_near("spline(x, T, B)", 0, 2.5, 2);
    is_near("interp(x, T, A, hold)", 0, -7, 1), is_near("interp(x, T, A, hold)", 0, 4.5, 2);
    is_near("spline(x, T, A, hold)", 0, -1e9, 1);
    is_near("diff(interp(x, T, A), x)", 0, 0.5, 2), is_near("diff(interp(x, T, A, hold), x)", 0, 9, 0);
    is_near("A[floor(x)]", 0, 3.9, -2), is_near("B[floor(x) + 1]", 1, 1, 1), is_near("A[floor(x)^2]", 0, 2, 2);
    for (double u = 0; u < 4; u += 0.2) is_near("spline(x, T, A)", 0, u, spline_at(u));
}

/* What is set or varied changes the tables that are made of it. */
static void set(void **state)
{
    (void)state;
    static const char text[] = "k = 1\nT = [0, 1, k + 1]\nA = [1, 3, k]\nx'' = -x + spline(t, T, A)\nx(0) = 0; x'(0) = "
                               "0\n";
    const char *const three = "k = 3";
    const double value = 3;
    motus_error err = motus_default_error();
    motus_system *written = given_text_with(text, &three, 1, "three"), *changed = given_text(text);
    motus_run *before = run_to(changed, "dop853", "interpreter", 1e-10, 2);
    double one[2], other[2];
    state_of(before, other, other + 1);
    motus_run_destroy(before);
    must(motus_system_set(changed, "k", &value, 1, &err), &err, "set");
    motus_run *a = run_to(written, "dop853", "interpreter", 1e-10, 2),
              *b = run_to(changed, "dop853", "compiled", 1e-10, 2);
    state_of(a, one, one + 1);
    assert_true(one[0] != other[0]);
    state_of(b, other, other + 1);
    assert_memory_equal(one, other, sizeof one);
    motus_run_destroy(a);
    motus_run_destroy(b);
    motus_system_destroy(written);
    motus_system_destroy(changed);
}

/* A mass on a spring whose force is a table of its position: its turning points are those of equal energy, and between
 * the points of the table its motion is that of a constant slope. */
static void a_force_of_the_position(void **state)
{
    (void)state;
    motus_system *s = given_text("X = [-2, 0, 2]\nF = [6, 0, -2]\nx'' = interp(x, X, F)\nx(0) = 1; x'(0) = 0\n");
    const double right = acos(-1) / 2, left = acos(-1) / sqrt(3.0);
    const double times[] = {right, right + left / 2, right + left, 2 * right + left},
                 wanted[] = {0, -1 / sqrt(3.0), 0, 1};
    const char *const methods[] = {"dop853", "taylor"};
    for (int m = 0; m < 2; m++)
        for (int k = 0; k < 4; k++) {
            double at[2];
            motus_run *r = run_to(s, methods[m], NULL, 1e-13, times[k]);
            state_of(r, at, at + 1);
            if (!(fabs(at[0] - wanted[k]) < 1e-11)) fail_msg("%s: %.17g, not %.17g", methods[m], at[0], wanted[k]);
            motus_run_destroy(r);
        }
    motus_system_destroy(s);
}

/* A motion may begin at the end of a table, touch it and rest there. Both tables are straight lines, so that the
 * motions are known. */
static void ends_are_touched(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double until, wanted;
    } cases[] = {{"x'' = -interp(x, [-1, 0, 1], [-1, 0, 1])\nx(0) = 1; x'(0) = 0\n", 10, -0.83907152907645245},
                 {"x'' = -interp(x, [-1, 0, 1], [-1, 0, 1])\nx(0) = -1; x'(0) = 0\n", 10, 0.83907152907645245},
                 {"x'' = -x + interp(cos(t), [-1, 0, 1], [-1, 0, 1])\nx(0) = 0; x'(0) = 0\n", 10, -2.7201055544468490},
                 {"x'' = interp(min(t, 1), [0, 0.25, 1], [0, 1, 4])\nx(0) = 0; x'(0) = 0\n", 3, 38.0 / 3},
                 {"x'' = interp(max(t, 1), [1, 2, 3], [1, 2, 3])\nx(0) = 0; x'(0) = 0\n", 3, 35.0 / 6}};
    const char *const methods[] = {"dop853", "taylor", "rk4"};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
        for (int m = 0; m < 3; m++) {
            motus_system *s = given_text(cases[k].text);
            motus_run_def def = motus_default_run();
            motus_error err = motus_default_error();
            motus_run *r = NULL;
            double at[2];
            def.method = methods[m];
            if (m == 2)
                def.step = 0.001, def.switches = MOTUS_SWITCHES_LOCATE;
            else
                def.tolerance = 1e-13;
            def.until = cases[k].until;
            must(motus_run_create(s, &def, &r, &err), &err, cases[k].text);
            must(motus_run_finish(r, &err), &err, cases[k].text);
            state_of(r, at, at + 1);
            if (!(fabs(at[0] - cases[k].wanted) < 1e-10))
                fail_msg("%s by %s: %.17g, not %.17g", cases[k].text, methods[m], at[0], cases[k].wanted);
            motus_run_destroy(r);
            motus_system_destroy(s);
        }
}

/* A run may end, or begin, at an end of a table: the same point as decimals write it, although the doubles differ, and
 * those of the companion differ otherwise. The tables are straight, so the motion is (u - u0)^3/(6 rate^2). */
static void ends_are_reached(void **state)
{
    (void)state;
    static const struct {
        const char *lines;
        double from, until, rate;
    } cases[] = {{"interp(t, 0, 0.02, [0, 0.02, 0.04, 0.06])", 0, 0.06, 1},
                 {"spline(t, 0, 0.02, [0, 0.02, 0.04, 0.06])", 0, 0.06, 1},
                 {"interp(t, -0.6, 0.2, [-0.6, -0.4, -0.2, 0])", -0.6, 0, 1},
                 {"interp(t, 0.7, 0.1, [0.7, 0.8, 0.9])", 0.7, 0.9, 1},
                 {"interp(v t, [0, 50, 100], [0, 50, 100])\nv = 80/3.6", 0, 4.5, 80 / 3.6},
                 {"interp(v t, [7, 50, 100], [7, 50, 100])\nv = 80/3.6", 0.315, 4.5, 80 / 3.6},
                 {"spline(s, 0.1, 0.3, [0.1, 0.4, 0.7])\ns' = 1\ns(0.1) = 0.1", 0.1, 0.7, 1}};
    const char *const methods[] = {"dop853", "taylor", "rk4", "rk4", "verlet"},
                      *machines[] = {"interpreter", "compiled"};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
        for (int m = 0; m < 5; m++)
            for (int back = 0; back < (strstr(cases[k].lines, "s'") ? 1 : 2); back++) {
                const double from = back ? cases[k].until : cases[k].from,
                             until = back ? cases[k].from : cases[k].until;
                const double rate = cases[k].rate, u0 = rate * from, u = rate * until, d = until - from;
                char text[400];
                snprintf(text, sizeof text, "x'' = %s\nx(%.17g) = 0; x'(%.17g) = 0\n", cases[k].lines, from, from);
                motus_system *s = given_text(text);
                motus_error err = motus_default_error();
                const size_t column = 1;
                double got[2], error[2];
                const bool compiles = m < 2 && !back && k % 4 == 0;
                for (int on = 0; on < 1 + compiles; on++) {
                    motus_run_def def = motus_default_run();
                    motus_run *r = NULL;
                    def.method = methods[m];
                    def.machine = machines[on];
                    if (m > 1) def.step = (cases[k].until - cases[k].from) / 120;
                    if (m == 3) def.switches = MOTUS_SWITCHES_LOCATE;
                    def.until = until;
                    def.error = MOTUS_BARS_CHEAP;
                    must(motus_run_create(s, &def, &r, &err), &err, text);
                    must(motus_run_finish(r, &err), &err, text);
                    if (motus_run_errors(r, &column, 1, got + on, error + on, &err) || !isfinite(error[on]))
                        fail_msg("%s by %s: %s", text, methods[m], err.message);
                    motus_run_destroy(r);
                }
                assert_true(!compiles || (got[0] == got[1] && error[0] == error[1]));
                const double truth = u0 * d * d / 2 + (u - u0) * d * d / 6;
                if (m < 4 && fabs(*got - truth) > *error + 1e-15 * fabs(truth))
                    fail_msg("%s by %s: %.17g, not %.17g", text, methods[m], *got, truth);
                motus_system_destroy(s);
            }
}

/* A little farther is outside. */
static void ends_end(void **state)
{
    (void)state;
    const double ends[] = {-1e-13, 0.06 * (1 + 1e-14)};
    const char *const points[] = {"0, 0.02", "[0, 0.02, 0.04, 0.06]"};
    for (int k = 0; k < 4; k++) {
        char text[200];
        snprintf(text, sizeof text, "x'' = interp(t, %s, [0, 1, 0, 2])\nx(0.03) = 0; x'(0.03) = 0\n", points[k / 2]);
        motus_system *s = given_text(text);
        motus_run_def def = motus_default_run();
        motus_error err = motus_default_error();
        motus_run *r = NULL;
        def.until = ends[k % 2];
        motus_status status = motus_run_create(s, &def, &r, &err);
        if (!status) status = motus_run_finish(r, &err);
        assert_true(status != MOTUS_OK);
        if (!strstr(err.message, k % 2 ? "t goes beyond 0.06, the last" : "t goes before 0, the first"))
            fail_msg("%s: %s", text, err.message);
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

/* Steps of one size ask for the entry after the last one at the end of a run; the message names that time and what
 * helps. */
static void an_entry_after_the_last(void **state)
{
    (void)state;
    const char *const methods[] = {"rk4", "newmark", "verlet"};
    for (int m = 0; m < 3; m++)
        for (int beyond = m == 2; beyond < 2; beyond++) { /* verlet needs no force at the end */
            motus_system *s = given_text("A = [1, 2, 3, 4]\nx'' = -x + A[floor(t/0.5) + 1]\nx(0) = 0; x'(0) = 0\n");
            motus_run_def def = motus_default_run();
            motus_error err = motus_default_error();
            motus_run *r = NULL;
            def.method = methods[m];
            def.step = 0.1;
            def.until = beyond ? 2.5 : 2;
            must(motus_run_create(s, &def, &r, &err), &err, methods[m]);
            assert_true(motus_run_finish(r, &err) != MOTUS_OK);
            const char *const wanted = beyond ? "until = 2`" : "switches = locate";
            if (!strstr(err.message, "at t = 2 A has the entries 1 to 4, and 5 is asked for") ||
                !strstr(err.hint, wanted))
                fail_msg("%s: %s; %s", methods[m], err.message, err.hint);
            motus_run_destroy(r);
            motus_system_destroy(s);
        }
}

static void fails(const char *formula, const char *method, const char *words)
{
    char text[600];
    snprintf(text, sizeof text, "%sx'' = %s\nx(0) = 3.5; x'(0) = 1\n", lists, formula);
    motus_system *s = given_text(text);
    motus_run_def def = motus_default_run();
    motus_error err = motus_default_error();
    motus_run *r = NULL;
    def.method = method;
    def.until = 9;
    if (!strcmp(method, "rk4")) def.step = 0.01;
    motus_status status = motus_run_create(s, &def, &r, &err);
    if (!status) status = motus_run_finish(r, &err);
    assert_true(status != MOTUS_OK);
    if (!strstr(err.message, words)) fail_msg("%s by %s: %s", formula, method, err.message);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

static void outside(void **state)
{
    (void)state;
    const char *const methods[] = {"dop853", "taylor", "rk4"};
    for (int m = 0; m < 3; m++) {
        fails("interp(t, T, A)", methods[m], "at t = 4 t goes beyond 4, the last point of the table A");
        fails("spline(x, T, A) + 5", methods[m], "x goes beyond 4, the last point of the table A");
        fails("interp(x - 9, T, A)", methods[m], "at t = 0 x - 9 goes before 0, the first point of the table A");
        fails("interp(7, T, A)", methods[m], "at t = 0 the argument 7 is beyond 4, the last point of the table A");
        fails("A[floor(t) + 1]", methods[m], "A has the entries 1 to 4, and 5 is asked for");
    }
}

/* What observes the motion may leave a table: an event ends the run there, and a quantity says why it has no value. The
 * end that the message names is one. */
static void observers_outside(void **state)
{
    (void)state;
    static const struct {
        const char *lines, *says, *hint;
    } cases[] = {
        {"when interp(t, T, A) > 0.5 as up: record\n", "at t = 4 the occasion of up has no value: t goes beyond 4", ""},
        {"when spline(t, T, A) = 9 as up: x' = 0\n", "at t = 4 the occasion of up has no value: t goes beyond 4", ""},
        {"when interp(x - 5.3, T, A) = 9 as low: record\n", "x - 5.3 goes before 0, the first point of the table A",
         ""},
        {"when A[floor(x) - 2] > 9 as low: record\n", "A has the entries 1 to 4, and 0 is asked for", ""},
        {"when interp(y[i] - i, 0, 1, A) = 9 as low: record for i = 1..2\ny[i]'' = 0 for i = 1..2\ny[i](0) = 5 - i for "
         "i = 1..2\ny[i]'(0) = -i for i = 1..2\n",
         "the occasion of low[2] has no value: y[i] - i goes before 0, the first point of the table A", ""},
        {"q = interp(t, T, A)\n", "t goes beyond 4, the last point of the table A", "interp(…, hold)"},
        {"q = spline(x - 5.3, T, A)\n", "x - 5.3 goes before 0, the first point of the table A", "spline(…, hold)"},
        {"q = sqrt(x - 7)\n", "sqrt(x - 7) is not a number there", ""},
        {"q = time(up)\nwhen x = 70 as up: record\n", "the event that it tells of has not happened", ""}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char text[700];
        snprintf(text, sizeof text, "%sx'' = -0.1\nx(0) = 6; x'(0) = 0\n%s", lists, cases[k].lines);
        const bool quantity = cases[k].lines[0] == 'q';
        const char *const methods[] = {"dop853", "taylor", "rk4", "verlet"};
        for (int m = 0; m < 4; m++) {
            motus_system *s = given_text(text);
            motus_run_def def = motus_default_run();
            motus_error err = motus_default_error();
            motus_run *r = NULL;
            size_t column, count;
            def.method = methods[m];
            if (m > 1) def.step = 0.3;
            def.until = 9;
            must(motus_run_create(s, &def, &r, &err), &err, text);
            motus_status status = motus_run_finish(r, &err);
            if (quantity) {
                must(status, &err, text);
                must(motus_column_find(s, "q", &column, &count, &err), &err, text);
                status = motus_run_undefined(r, column, &err);
            }
            assert_int_equal(status, quantity ? MOTUS_DIVERGED : MOTUS_EVENTS);
            if (!strstr(err.message, cases[k].says) || !strstr(err.hint, cases[k].hint))
                fail_msg("%s by %s: %s; %s", cases[k].lines, methods[m], err.message, err.hint);
            motus_run_destroy(r);
            double until = 0;
            if (sscanf(err.hint, "end the run there, `until = %lf`", &until) == 1) {
                def.until = until;
                must(motus_run_create(s, &def, &r, &err), &err, text);
                must(motus_run_finish(r, &err), &err, text);
                motus_run_destroy(r);
            } else {
                assert_true(quantity);
            }
            motus_system_destroy(s);
        }
    }
}

static void refused(const char *line, const char *words)
{
    char text[600];
    snprintf(text, sizeof text, "%sM = [[1, 2], [3, 4]]\nk = 3\nx'' = %s\nx(0) = 0; x'(0) = 0\n", lists, line);
    motus_text_def def = motus_default_text();
    motus_error err = motus_default_error();
    motus_system *s = NULL;
    def.text = text;
    assert_true(motus_system_from_text(&def, &s, &err) != MOTUS_OK);
    assert_null(s);
    if (!strstr(err.message, words)) fail_msg("%s: %s", line, err.message);
}

static void bad_tables(void **state)
{
    (void)state;
    refused("interp(t, A)", "interp takes one argument and one table");
    refused("interp(t, 0, 1, 2, A)", "three or four things in all, not 5");
    refused("interp(t, k, A)", "interp takes a list here, and k is none");
    refused("interp(t, M, A)", "interp takes a list here, and M is none");
    refused("interp(t, x, A)", "interp takes a list here, and x is none");
    refused("interp(t, A, T)", "the points of a table rise, but in A number 2 is 3 and number 3 -2");
    refused("interp(t, B, A)", "the points of a table are numbers, not vectors");
    refused("interp(t, [0, 1], A)", "2 points, but 4 values");
    refused("interp(t, 0, -1, A)", "the points of a table rise, but from 0 on -1 leads to -1");
    refused("interp(t, 1e17, 1, A)", "the points of a table rise, but from 1e+17 on 1 leads to 1e+17");
    refused("interp(t, [0], [1])", "a table has two points or more");
    refused("interp(B, T, A)", "interp takes a number, and then the lists of a table");
    refused("interp(t, 0, 1, A[2])", "interp takes a list here, and A[2] is none");
    refused("if(x > 1, k2, 1)\nk2 = interp(7, T, A)", "k2 has no value: the argument 7 is beyond 4, the last point of");
    refused("f(2)\nf(c) = interp(t, 0, c, A)", "a point of a table is fixed and cannot depend on c");
    refused("1\ny[i]'' = interp(t, 0, 1, [1, i]) for i = 1..2\ny[i](0) = 0 for i = 1..2\ny[i]'(0) = 0 for i = 1..2",
            "an entry of a list is fixed and cannot depend on i");
    refused("A[t]", "an index is a whole number, and t is not always one");
    refused("A[x + 1]", "an index is a whole number, and x + 1 is not always one");
    refused("diff(interp(t, T, A), A[2])", "depends on A[2]");
}

/* A peak of a table between two steps, which neither they nor their companion see, leaves no error that is too
 * small. */
static void peaks_between_steps(void **state)
{
    (void)state;
    static const struct {
        const char *points, *values;
    } peaks[] = {{"[0, 1.021, 1.0211, 1.0212, 2]", "[0, 0, 1e4, 0, 0]"},
                 {"[0, 1, 1.000001, 1.000002, 2]", "[0, 0, 2e6, 0, 0]"}};
    const char *const methods[] = {"rk4", "gauss8"};
    for (size_t k = 0; k < 2; k++)
        for (int m = 0; m < 2; m++) {
            char text[300];
            snprintf(text, sizeof text, "T = %s\nA = %s\nx'' = interp(t, T, A)\nx(0) = 0; x'(0) = 0\n", peaks[k].points,
                     peaks[k].values);
            motus_system *s = given_text(text);
            motus_run_def def = motus_default_run();
            motus_error err = motus_default_error();
            motus_run *r = NULL;
            const size_t velocity = 2;
            double value, error;
            def.method = methods[m];
            def.step = 0.1;
            def.error = MOTUS_BARS_CHEAP;
            def.until = 2;
            must(motus_run_create(s, &def, &r, &err), &err, text);
            must(motus_run_finish(r, &err), &err, text);
            must(motus_run_errors(r, &velocity, 1, &value, &error, &err), &err, text);
            const double truth = k ? 2 : 1; /* the area of the peak */
            if (fabs(value - truth) > error) fail_msg("%s, peak %zu: %g, error %g", methods[m], k, value, error);
            motus_run_destroy(r);
            motus_system_destroy(s);
        }
}

/* A boundary line may be a table. */
/* Leads x'' = ±t^2 - c x' from rest. */
static void exact_creep(double c, double t, int way, double *x, double *v)
{
    double e = 0, term = c * c * c * t * t * t / 6; /* 1 - ct + (ct)^2/2 - exp(-ct), without cancellation */
    for (int n = 4; n < 40; n++) e += term, term *= -c * t / n;
    *v = way * 2 * e / (c * c * c);
    *x = way * (t * t * t / 3 - *v * way) / c;
}

/* A motion that rests on a point of tables leaves it slowly: what rounding leaves of the rows must not choose one. */
static void leaves_a_point(void **state)
{
    (void)state;
    static const char *const texts[] = {
        /* decimals whose row before the point is not exactly 0 there, by rounding from its first point */
        "V = [-0.7, 0, 0.2]\nF = [-7.05, 0, 0.33]\nx'' = (%d) t^2 - interp(x', V, F, hold)\n",
        "V = [-0.7, 0, 0.2]\nF = [-7.1, 0, 0.33]\nx'' = (%d) t^2 - interp(x', V, F) - spline(x', V, [0, 0, 0])\n",
        /* a force besides that only cancels the table */
        "V = [-0.7, 0.2, 0.9]\nF = [-7.26, 5.3, 6.455]\n"
        "x'' = 5.3 + (%d) t^2 - interp(0.2 + x', V, F, hold)\n",
        /* a spline through points of a line; the argument is a difference */
        "V = [-0.7, 0, 0.2, 0.9]\nF = [-1.155, 0, 0.33, 1.485]\n"
        "x'' = (%d) t^2 - spline(x' - w, V, F)\nw' = 0\nw(0) = 0\n"};
    static const double below[] = {7.05 / 0.7, 7.1 / 0.7, 12.56 / 0.9, 1.65};
    static const char *const how[] = {"taylor", "dop853", "dopri5"};
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++)
        for (int way = -1; way <= 1; way += 2)
            for (size_t m = 0; m < sizeof how / sizeof *how; m++) {
                char text[400];
                size_t n = (size_t)snprintf(text, sizeof text, texts[k], way);
                snprintf(text + n, sizeof text - n, "x(0) = 0; x'(0) = 0\n");
                motus_system *s = given_text(text);
                motus_run *r = run_to(s, how[m], "interpreter", 1e-9, 0.4);
                double x, v[2], right_x, right_v;
                exact_creep(way > 0 ? 1.65 : below[k], 0.4, way, &right_x, &right_v);
                state_of(r, &x, v);
                near(x, right_x, 1e-8 * fabs(right_x), text);
                near(v[0], right_v, 1e-8 * fabs(right_v), text);
                assert_string_equal(motus_run_now(r).not_located, "");
                motus_run_destroy(r);
                motus_system_destroy(s);
            }
}

static void boundaries(void **state)
{
    (void)state;
    motus_system *s =
        given_text("x[1]'' = x[0] - x[1]\nx[0] = interp(t, 0, 1, [0, 1, 3])\nx[1](0) = 0; x[1]'(0) = 0\n");
    motus_run *r = run_to(s, "dop853", NULL, 1e-12, 1.5);
    double x[2], v[2];
    state_of(r, x, v);
    /* x = t - sin t up to 1; then x = 2 t - 1 + c sin(t - 1) + d cos(t - 1) */
    const double d = 1 - sin(1.0) - 1, c = 1 - cos(1.0) - 2, wanted = 2 + c * sin(0.5) + d * cos(0.5);
    const double got = fabs(x[0] - wanted) < fabs(x[1] - wanted) ? x[0] : x[1];
    if (!(fabs(got - wanted) < 1e-12)) fail_msg("%.17g, %.17g, not %.17g", x[0], x[1], wanted);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* A boundary line may be a spline, whose velocity changes though no acceleration moves it: the motion is that of the
 * spline as a force, and the witness objects to nothing. */
static void curved_boundaries(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "x[1]'' = x[0] - x[1]\nx[0] = spline(t, 0, 1, [0, 1, -1, 0.5], hold)\nx[1](0) = 0; x[1]'(0) = 0\n",
        "x'' = spline(t, 0, 1, [0, 1, -1, 0.5], hold) - x\nx(0) = 0; x'(0) = 0\n"};
    double value[2], error[2];
    for (int k = 0; k < 2; k++) {
        motus_system *s = given_text(texts[k]);
        motus_run_def def = motus_default_run();
        motus_error err = motus_default_error();
        motus_run *r = NULL;
        const size_t position = 1;
        def.method = "dop853";
        def.until = 4;
        def.error = MOTUS_BARS_CHEAP;
        must(motus_run_create(s, &def, &r, &err), &err, texts[k]);
        must(motus_run_finish(r, &err), &err, texts[k]);
        must(motus_run_errors(r, &position, 1, &value[k], &error[k], &err), &err, texts[k]);
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
    assert_true(fabs(value[0] - value[1]) <= error[0] + error[1] && error[0] < 1e-8);
}

/* motus check says which order steps of one size keep: that which the table leaves, not that of the method. */
static void explained(void **state)
{
    (void)state;
    static const struct {
        const char *force, *says;
        bool others;
    } cases[] = {{"interp(t, T, A)", "order 2 is left", false},
                 {"spline(x, T, A)", "order 4 is left", false},
                 {"spline(t, T, A, hold)", "order 2 is left", false},
                 {"spline(t, T, A) + interp(t, T, A)", "order 2 is left", false},
                 {"spline(t, T, A) + |x|", "order 4 is left", true}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char text[400];
        snprintf(text, sizeof text, "%sx'' = %s\nx(0) = 1; x'(0) = 0\n", lists, cases[k].force);
        motus_system *s = given_text(text);
        const char *told = motus_explain(s);
        assert_non_null(strstr(told, cases[k].says));
        assert_int_equal(strstr(told, "the equations are not smooth") != NULL, cases[k].others);
        motus_system_destroy(s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values),
        cmocka_unit_test(a_force_of_measured_numbers),
        cmocka_unit_test(a_force_of_the_position),
        cmocka_unit_test(points_end_steps),
        cmocka_unit_test(backward),
        cmocka_unit_test(set),
        cmocka_unit_test(ends_are_touched),
        cmocka_unit_test(ends_are_reached),
        cmocka_unit_test(ends_end),
        cmocka_unit_test(outside),
        cmocka_unit_test(observers_outside),
        cmocka_unit_test(an_entry_after_the_last),
        cmocka_unit_test(bad_tables),
        cmocka_unit_test(peaks_between_steps),
        cmocka_unit_test(leaves_a_point),
        cmocka_unit_test(boundaries),
        cmocka_unit_test(curved_boundaries),
        cmocka_unit_test(explained),
    };
    open_shared_cache();
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    close_cache();
    return failed;
}
