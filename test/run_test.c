/* Runs: the same motion however it is divided into calls, observed, shortened or cancelled. */
#include "test/given.h"

/* Forces of every kind: of position, of time, of velocity (linear, gyroscopic, neither), with first-order variables
 * and driven boundary cells. */
static const char *const texts[] = {
    "x'' = -x + x^3 + 0.1 cos(t)\nx(0) = 0.3\nx'(0) = 0.1\n",
    "x'' = -x' - x^3\nx(0) = 2\nx'(0) = 0\n",
    "r'' = -r/|r|^3 + 0.1 cross(r', (0, 0, 1))\nr(0) = (1, 0, 0.1)\nr'(0) = (0, 1, 0)\n",
    "y'' = -9.81 - 0.1 y' |y'|\ny(0) = 1\ny'(0) = 3\ns' = y'^2 - s\ns(0) = 0.5\n",
    "x'' = -x^3 + 0.1 cos(t)\nx(0) = 0.3\nx'(0) = 0.1\ns' = x'^2 + t x\ns(0) = 0.5\n",
    ("x[i]'' = x[i+1] - 2 x[i] + x[i-1] + 0.5 (x[i+1] - x[i])^3 - 0.5 (x[i] - x[i-1])^3 for i = 1..5\nx[0] = 0.1 "
     "sin(t)\nx[6] = 0\n"
     "x[i](0) = sin(i) for i = 1..5\nx[i]'(0) = 0 for i = 1..5\n"),
    "r'' = (0.5, -9.81)\nr(0) = (0, 0)\nr'(0) = (1, 4.5)\nexact r = r(0) + r'(0) t + (0.5, -9.81) t^2/2\n",
};
enum { TEXTS = sizeof texts / sizeof *texts };

/* For every method that admits a text. */
static void each(void (*law)(motus_system *, const char *method))
{
    for (int i = 0; i < TEXTS; i++) {
        motus_system *s = given_text(texts[i]);
        int admitted = 0;
        for (size_t k = 0; k < motus_method_count(); k++)
            if (motus_method_admits(s, motus_method_at(k)->name, NULL) == MOTUS_OK) {
                law(s, motus_method_at(k)->name);
                admitted++;
            }
        assert_true(admitted > 10);
        motus_system_destroy(s);
    }
}

/* Stepping and observing ------------------------------------------------------------------------------------------- */

static int two_step_literal(const char *method) { return !strcmp(method, "verlet-literal"); }

static void stepwise(motus_system *s, const char *method)
{
    double until = two_step_literal(method) ? 0.5 : 0.4951; /* the second has a shorter last step */
    motus_run *at_once = given_run(s, method, 0.01, until), *by_steps = given_run(s, method, 0.01, until),
              *looking = given_run(s, method, 0.01, until);
    finish(at_once);
    for (int64_t n = 1; !motus_run_done(by_steps); n = n % 7 + 1) take_steps(by_steps, n);
    while (!motus_run_done(looking)) {
        free(whole_state(s, looking, NULL));
        value(s, looking, "t");
        double t = fmin(motus_run_time(looking) + 0.004, until), x;
        size_t k = 1;
        motus_error err = motus_default_error();
        must(motus_run_sample(looking, &t, 1, &k, 1, &x, &err), &err, "sample");
        free(whole_state(s, looking, NULL));
        take_steps(looking, 1);
    }
    same_state(s, at_once, by_steps, "at once and by steps");
    same_state(s, at_once, looking, "unseen and looked at");
    assert_int_equal(motus_run_steps(at_once), motus_run_steps(by_steps));
    assert_int_equal(motus_run_now(at_once).evaluations, motus_run_now(by_steps).evaluations);
    /* observations are not counted */
    assert_int_equal(motus_run_now(at_once).evaluations, motus_run_now(looking).evaluations);
    assert_int_equal(motus_run_now(at_once).iterations, motus_run_now(by_steps).iterations);
    assert_int_equal(given_adaptive(method) ? 0 : motus_run_steps(at_once), motus_run_now(at_once).steps_total);
    assert_true(motus_run_time(at_once) == until && motus_run_time(looking) == until);
    motus_run_destroy(at_once);
    motus_run_destroy(by_steps);
    motus_run_destroy(looking);
}

static void stepwise_is_at_once(void **state)
{
    (void)state;
    each(stepwise);
}

static void samples_of(motus_system *s, const char *method)
{
    enum { N = 12 };
    if (given_adaptive(method)) return; /* its steps end elsewhere */
    motus_run *sampled = given_run(s, method, 0.01, 0.12), *stepped = given_run(s, method, 0.01, 0.12);
    size_t all = motus_column_count(s), columns[64];
    double *rows = malloc((N + 1) * all * sizeof *rows), *row = malloc(all * sizeof *row), times[N + 1];
    motus_error err = motus_default_error();
    assert_true(rows && row && all <= 64);
    for (size_t k = 0; k < all; k++) columns[k] = k;
    for (int n = 0; n <= N; n++) times[n] = n == N ? 0.12 : 0.01 * n;
    must(motus_run_sample(sampled, times, N + 1, columns, all, rows, &err), &err, "sample");
    for (int n = 0; n <= N; n++) {
        must(motus_run_values(stepped, columns, all, row, &err), &err, "values");
        for (size_t k = 0; k < all; k++)
            if (memcmp(&row[k], &rows[(size_t)n * all + k], sizeof *row))
                fail_msg("%s: column %zu after %d steps is %a, sampled %a", method, k, n, row[k],
                         rows[(size_t)n * all + k]);
        if (n < N) take_steps(stepped, 1);
    }
    free(rows);
    free(row);
    motus_run_destroy(sampled);
    motus_run_destroy(stepped);
}

static void samples_at_steps_are_the_state(void **state)
{
    (void)state;
    each(samples_of);
}

/* Between two exact states the only error is the polynomials': h^6 in the position, h^5 in its velocity, h^4 in a
 * first-order variable. A slope estimated from h and h/2 is off by O(h), half of which remains in the next one: twice
 * their difference bounds the rest. */
/* The exact motion is known between steps too: its states there are those of steps that end there. */
static void the_exact_motion_is_exact_between_steps(void **state)
{
    (void)state;
    static const char *const texts[] = {"x'' = -x\nx(0) = 1\nx'(0) = 0.5\nexact x = cos(t) + 0.5 sin(t)\n"
                                        "s' = x'\ns(0) = 2\nexact s = cos(t) + 0.5 sin(t) + 1\n",
                                        "x'' = -9.81\nx(0) = 1\nx'(0) = 0.5\n"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        motus_system *s = given_text(texts[i]);
        const size_t columns[3] = {1, 2, 3}, count = motus_positions(s) + motus_velocities(s);
        const double t = 0.625;
        double between[3], there[3];
        motus_run *r = given_run(s, "exact", 0.5, 4), *q = given_run(s, "exact", 0.125, t);
        motus_error err = motus_default_error();
        must(motus_run_sample(r, &t, 1, columns, count, between, &err), &err, "sample");
        assert_true(motus_run_time(r) == 1);
        finish(q);
        must(motus_run_values(q, columns, count, there, &err), &err, "values");
        assert_memory_equal(between, there, count * sizeof *there);
        motus_run_destroy(r);
        motus_run_destroy(q);
        motus_system_destroy(s);
    }
}

static void samples_between_steps_hit_the_neighbours(void **state)
{
    (void)state;
    motus_system *s = given_text("x'' = -sin(x) + 0.1 cos(t)\nx(0) = 1\nx'(0) = 0\n");
    size_t k[2] = {column(s, "x"), column(s, "x'")};
    motus_error err = motus_default_error();
    /* Just before and after every step: no time in between is refused, and the motion is continuous. */
    static const double steps[] = {0.1, 0.07, 0.3, 0.011, 0.013, 1.0 / 3};
    motus_run *r, *q, *leap;
    for (size_t j = 0; j < sizeof steps / sizeof *steps; j++) {
        r = given_run(s, "rk4", steps[j], 301 * steps[j]);
        q = given_run(s, "rk4", steps[j], 301 * steps[j]);
        leap = given_run(s, "rk4", steps[j], 301 * steps[j]);
        for (int n = 1; n <= 300; n++) {
            double at = n * steps[j], times[3] = {nextafter(at, 0), at, nextafter(at, INFINITY)}, out[6];
            must(motus_run_sample(r, times, 3, k, 2, out, &err), &err, "sample");
            if (n % 3 == 0) { /* from three steps before */
                double before[2];
                must(motus_run_sample(leap, times, 1, k, 2, before, &err), &err, "sample");
                assert_memory_equal(before, out, sizeof before);
            }
            take_steps(q, 1);
            assert_true(out[2] == value(s, q, "x") && out[3] == value(s, q, "x'"));
            for (size_t i = 0; i < 3; i++) {
                near(out[2 * i], out[2], 2 * (at * 2 + 4) * ROUNDING, "x beside a step");
                near(out[2 * i + 1], out[3], 2 * (at * 2 + 4) * ROUNDING / steps[j], "x' beside a step");
            }
        }
        motus_run_destroy(r);
        motus_run_destroy(q);
        motus_run_destroy(leap);
    }
    r = given_run(s, "rk4", 0.1, 3);
    static const struct {
        double first, second;
    } wrong[] = {{0.1, 3.01}, {0.1, INFINITY}, {0.1, NAN}, {2.5, 0.1}, {0.5, -1}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        double times[2] = {wrong[i].first, wrong[i].second}, out[4];
        motus_run *p = given_run(s, "rk4", 0.1, 3);
        assert_int_equal(motus_run_sample(p, times, 2, k, 2, out, &err), MOTUS_ARGUMENT);
        motus_run_destroy(p);
    }
    double t = 1.55, out;
    size_t none = 99;
    assert_int_equal(motus_run_sample(r, &t, 1, &none, 1, &out, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_run_sample(r, NULL, 0, NULL, 0, NULL, &err), MOTUS_OK);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* Start and end ---------------------------------------------------------------------------------------------------- */

static void another_start(void **state)
{
    (void)state;
    motus_system *moved = given_text("x'' = -x + sin(t)\nx(0) = 1\nx'(0) = 2\n"),
                 *s = given_text("x'' = -x + sin(t)\nx(3) = 5\nx'(3) = 6\n");
    const double x = 5, v = 6;
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *a = NULL, *b = given_run(s, "verlet", 0.01, 4);
    def.method = "verlet";
    def.step = 0.01;
    def.start = 3;
    def.until = 4;
    def.x = &x;
    def.v = &v;
    must(motus_run_create(moved, &def, &a, &err), &err, "start");
    assert_true(motus_run_time(a) == 3 && motus_run_time(b) == 3);
    finish(a);
    finish(b);
    double *p = whole_state(moved, a, NULL), *q = whole_state(s, b, NULL);
    assert_memory_equal(p, q, 2 * sizeof *p);
    free(p);
    free(q);
    motus_run_destroy(a);
    def.x = NULL;
    must(motus_run_create(moved, &def, &a, &err), &err, "start");
    assert_true(value(moved, a, "x") == 1 && value(moved, a, "x'") == 6);
    motus_run_destroy(a);
    double bad = NAN;
    def.x = &bad;
    assert_int_equal(motus_run_create(moved, &def, &a, &err), MOTUS_ARGUMENT);
    assert_null(a);
    motus_run_destroy(b);
    motus_system_destroy(moved);
    motus_system_destroy(s);
}

/* Every number in the public order: x by variable, cell and component, then v. */
static void starts_are_in_the_order_of_the_columns(void **state)
{
    (void)state;
    motus_system *s =
        given_text("r[i]'' = -r[i] for i = 1..3\nr[i](0) = (1, 2) for i = 1..3\nr[i]'(0) = (0, 0) for i = 1..3\n"
                   "y'' = -y\ny(0) = 0\ny'(0) = 0\ns' = -s\ns(0) = 1\n");
    size_t nx = motus_positions(s), nv = motus_velocities(s);
    double x[7], v[8];
    assert_true(nx == 7 && nv == 8);
    for (size_t k = 0; k < nv; k++) {
        if (k < nx) x[k] = 10 + (double)k;
        v[k] = 20 + (double)k;
    }
    motus_run_def def = motus_default_run();
    motus_error err = motus_default_error();
    motus_run *r = NULL;
    def.step = 0.1;
    def.until = 1;
    def.x = x;
    def.v = v;
    must(motus_run_create(s, &def, &r, &err), &err, "start");
    for (size_t k = 0; k < nx + nv; k++) {
        motus_column c = motus_default_column();
        assert_int_equal(motus_column_at(s, 1 + k, &c), MOTUS_OK);
        assert_true(value(s, r, c.name) == (k < nx ? x[k] : v[k - nx]));
    }
    assert_true(value(s, r, "r[2].y") == 13 && value(s, r, "r[3]'.x") == 24 && value(s, r, "s") == 27);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* A reversible method returns; the sign of the step is that of the direction. The difference is rounding: a few units
 * per step. */
static void backward(void **state)
{
    (void)state;
    motus_system *s = given_text("x'' = -sin(x)\nx(0) = 1\nx'(0) = 0.5\n");
    static const char *const methods[] = {"velocity-verlet", "verlet", "kahan-li6", "gauss4", "leapfrog"};
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        motus_run *there = given_run(s, methods[i], 0.01, 1), *back = NULL;
        finish(there);
        double *y = whole_state(s, there, NULL);
        motus_run_def def = motus_default_run();
        motus_error err = motus_default_error();
        def.method = methods[i];
        def.step = 0.01;
        def.start = 1;
        def.until = 0;
        def.x = y;
        def.v = y + 1;
        must(motus_run_create(s, &def, &back, &err), &err, "back");
        assert_true(motus_run_now(back).step == 0.01);
        take_steps(back, 30);
        near(motus_run_time(back), 0.7, 4 * ROUNDING, "time on the way back");
        size_t k = column(s, "x");
        double t[2] = {0.695, 0.5}, out[2];
        must(motus_run_sample(back, t, 2, &k, 1, out, &err), &err, "sample");
        finish(back);
        assert_true(motus_run_time(back) == 0);
        /* steps there and back, operations on each number in the longest step */
        const double lost = ROUNDING * 200 * 18;
        near(value(s, back, "x"), 1, lost, methods[i]);
        near(value(s, back, "x'"), 0.5, lost, methods[i]);
        free(y);
        motus_run_destroy(there);
        motus_run_destroy(back);
    }
    motus_system_destroy(s);
}

/* The main line has full steps; the shorter step is a step of its own from there, in the method's one-step form. */
static void short_end(motus_system *s, const char *method)
{
    if (given_adaptive(method)) return; /* its steps are not known beforehand */
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *r = NULL, *whole = NULL, *last = NULL;
    def.method = method;
    def.step = 0.01;
    def.until = 0.1037;
    motus_status status = motus_run_create(s, &def, &r, &err);
    if (two_step_literal(method)) {
        assert_int_equal(status, MOTUS_METHOD);
        assert_true(strstr(err.message, "equal steps") && err.hint[0]);
        return;
    }
    must(status, &err, method);
    assert_int_equal(motus_run_now(r).steps_total, 11);
    near(motus_run_now(r).shorter_last, 0.0037, 4 * ROUNDING * 0.1, "the last step");
    take_steps(r, 10);
    assert_false(motus_run_done(r));
    whole = given_run(s, method, 0.01, 0.1);
    finish(whole);
    assert_true(motus_run_now(whole).shorter_last == 0);
    same_state(s, r, whole, "ten whole steps");
    finish(r);
    assert_true(motus_run_time(r) == 0.1037);
    assert_int_equal(motus_run_steps(r), 11);
    take_steps(r, 5); /* there is nothing after the end */
    assert_int_equal(motus_run_steps(r), 11);
    size_t nx = motus_positions(s);
    double *y = whole_state(s, whole, NULL);
    def.start = motus_run_time(whole);
    def.x = y;
    def.v = y + nx;
    def.step = 1;
    if (strcmp(method, "exact")) { /* the exact motion is not a map of states */
        must(motus_run_create(s, &def, &last, &err), &err, method);
        finish(last);
        same_state(s, r, last, "the short step");
        motus_run_destroy(last);
    }
    free(y);
    motus_run_destroy(r);
    motus_run_destroy(whole);
}

static void the_last_step_is_shortened(void **state)
{
    (void)state;
    each(short_end);
}

/* What is missing is suggested: suggest_test.c. */
static void steps_and_ends_that_are_refused(void **state)
{
    (void)state;
    motus_system *s = given_text("x'' = -x\nx(0) = 1\nx'(0) = 0\n");
    static const struct {
        double step, until, start;
        motus_status status;
    } cases[] = {{0, 1, NAN, MOTUS_ARGUMENT},
                 {-0.1, 1, NAN, MOTUS_ARGUMENT},
                 {INFINITY, 1, NAN, MOTUS_ARGUMENT},
                 {0.1, INFINITY, NAN, MOTUS_ARGUMENT},
                 {1e-20, 1, NAN, MOTUS_LIMIT},
                 {1e-3, 1e20, NAN, MOTUS_LIMIT},
                 {1e-3, 1e16 + 4, 1e16, MOTUS_ARGUMENT},
                 {0.1, 1, INFINITY, MOTUS_ARGUMENT},
                 {1e-300, 1e300, NAN, MOTUS_LIMIT},
                 {0.1, 0, NAN, MOTUS_OK},
                 {5, 1, NAN, MOTUS_OK},
                 {NAN, 1, NAN, MOTUS_OK},
                 {NAN, 1, 3, MOTUS_OK},
                 {1e-300, 1e-299, NAN, MOTUS_OK}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        motus_error err = motus_default_error();
        motus_run_def def = motus_default_run();
        motus_run *r = NULL;
        def.step = cases[i].step;
        def.until = cases[i].until;
        def.start = cases[i].start;
        motus_status status = motus_run_create(s, &def, &r, &err);
        if (status != cases[i].status) fail_msg("case %zu: %s, %s", i, motus_status_word(status), err.message);
        if (status == MOTUS_OK) {
            finish(r);
            assert_true(motus_run_time(r) == cases[i].until);
            assert_int_equal(motus_run_step(r, -1, &err), MOTUS_ARGUMENT);
        } else
            assert_null(r);
        motus_run_destroy(r);
    }
    motus_system_destroy(s);
}

/* A quotient of `until` and the step that is an integer up to rounding counts as one. */
static void slivers_are_no_steps(void **state)
{
    (void)state;
    motus_system *s = given_text("x'' = -x\nx(0) = 1\nx'(0) = 0\n");
    for (int n = 1; n <= 3000; n++) {
        motus_run *r = given_run(s, "leapfrog", 0.001, n * 0.001), *q = given_run(s, "leapfrog", 1.0 / n, 1);
        assert_true(motus_run_now(r).steps_total == n && motus_run_now(r).shorter_last == 0);
        assert_true(motus_run_now(q).steps_total == n && motus_run_now(q).shorter_last == 0);
        motus_run_destroy(r);
        motus_run_destroy(q);
    }
    motus_system_destroy(s);
}

/* What goes wrong -------------------------------------------------------------------------------------------------- */

static void divergence_names_time_and_variable(void **state)
{
    (void)state;
    motus_system *s = given_text("x'' = -x\nx(0) = 1\nx'(0) = 0\ny'' = y^3\ny(0) = 2\ny'(0) = 2\n");
    static const char *const methods[] = {"rk4",       "verlet",         "velocity-verlet",
                                          "kahan-li8", "explicit-euler", "verlet-literal"};
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        motus_run *r = given_run(s, methods[i], 0.01, 100);
        motus_error err = motus_default_error();
        assert_int_equal(motus_run_finish(r, &err), MOTUS_DIVERGED);
        assert_int_equal(err.status, MOTUS_DIVERGED);
        assert_true(err.time > 0.1 && err.time < 100);
        assert_true(!strcmp(err.variable, "y") || !strcmp(err.variable, "y'"));
        assert_true(strstr(err.message, "t = ") && err.hint[0]);
        /* The run stands at the last good step and repeats its error. */
        double x[2], v[2], t = motus_run_time(r);
        motus_error look = motus_default_error();
        motus_status seen = motus_run_state(r, x, v, &look);
        /* If the velocity needs the acceleration at the same place, that may be the first infinity; then observing
         * gives the error. */
        assert_true(seen == MOTUS_OK || (seen == MOTUS_DIVERGED && look.time == t));
        for (int k = 0; k < 2 && seen == MOTUS_OK; k++) assert_true(isfinite(x[k]) && isfinite(v[k]));
        assert_true(t <= err.time && t >= err.time - 0.0101);
        motus_error again = motus_default_error();
        assert_int_equal(motus_run_step(r, 1, &again), MOTUS_DIVERGED);
        assert_true(motus_run_time(r) == t && again.time == err.time);
        /* The same steps in a run that ends there. */
        motus_run *q = given_run(s, methods[i], 0.01, 100);
        take_steps(q, motus_run_steps(r));
        double w[2];
        assert_int_equal(motus_run_state(q, w, NULL, NULL), seen);
        assert_true(seen != MOTUS_OK || !memcmp(w, x, sizeof w));
        motus_run_destroy(r);
        motus_run_destroy(q);
    }
    motus_system_destroy(s);
    s = given_text("x'' = 1/(x - 1)\nx(0) = 1\nx'(0) = 0\n"); /* a division by zero at the start */
    motus_run *r = given_run(s, "verlet", 0.01, 1);
    motus_error err = motus_default_error();
    assert_int_equal(motus_run_finish(r, &err), MOTUS_DIVERGED);
    assert_true(motus_run_steps(r) == 0);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

static void an_implicit_equation_without_solution(void **state)
{
    (void)state;
    /* v' = exp(v): no v1 solves the midpoint rule once the step is too large. */
    motus_system *s = given_text("x'' = exp(x')\nx(0) = 0\nx'(0) = 1\n");
    motus_run *r = given_run(s, "implicit-midpoint", 2, 10);
    motus_error err = motus_default_error();
    motus_status status = motus_run_finish(r, &err);
    assert_int_equal(status, MOTUS_SOLVE);
    assert_true(err.time == 0 || err.time == 2);
    assert_true(err.variable[0] == 'x' && err.hint[0]);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

static motus_run *observed(motus_system *s, given_progress *w, double until)
{
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    def.method = "kahan-li8";
    def.step = 0.001;
    def.until = until;
    def.progress = given_observe;
    def.context = w;
    must(motus_run_create(s, &def, &r, &err), &err, "observed");
    return r;
}

static void progress_and_cancellation(void **state)
{
    (void)state;
    motus_system *s = given_text("x'' = -sin(x)\nx(0) = 1\nx'(0) = 0\n");
    motus_error err = motus_default_error();
    given_progress w = {0, 0, 0}, impatient = {0, 2, 0};
    const double until = 100; /* some 10^5 steps: a few tenths of a second */
    motus_run *seen = observed(s, &w, until), *unseen = given_run(s, "kahan-li8", 0.001, until),
              *cut = observed(s, &impatient, until);
    finish(seen);
    finish(unseen);
    assert_true(w.calls > 2);
    same_state(s, seen, unseen, "observed and unobserved");
    assert_int_equal(motus_run_finish(cut, &err), MOTUS_CANCELLED);
    assert_true(impatient.calls == 2 && !motus_run_done(cut) && motus_run_steps(cut) > 0);
    finish(cut); /* a cancelled run can continue */
    same_state(s, cut, unseen, "cancelled and gone on");
    motus_run_destroy(seen);
    motus_run_destroy(unseen);
    motus_run_destroy(cut);
    motus_system_destroy(s);
}

/* The message names the limit that is wrong, and its number. */
static void step_limits_that_are_refused(void **state)
{
    (void)state;
    motus_system *s = given_text(texts[0]);
    const double wrong[][2] = {{NAN, 0}, {-1, 0}, {INFINITY, 0}, {0, NAN}, {0, -1}};
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
        motus_run_def def = motus_default_run();
        motus_error err = motus_default_error();
        motus_run *r = NULL;
        char said[64];
        def.method = "dopri5", def.until = 1, def.shortest_step = wrong[k][0], def.longest_step = wrong[k][1];
        assert_int_equal(motus_run_create(s, &def, &r, &err), MOTUS_ARGUMENT);
        const int longest = wrong[k][0] == 0;
        snprintf(said, sizeof said, "the %s step is %g", longest ? "longest" : "shortest", wrong[k][longest]);
        if (!strstr(err.message, said)) fail_msg("\"%s\" does not say \"%s\"", err.message, said);
    }
    motus_system_destroy(s);
}

/* The hook is not called at every single step: it would cost more than the steps. */
static void progress_is_told_now_and_then(void **state)
{
    (void)state;
    motus_system *s = given_text(texts[0]);
    given_progress w = {0, 0, 0};
    motus_run *r = observed(s, &w, 10);
    while (!motus_run_done(r)) take_steps(r, 1);
    assert_true(w.calls < 1000); /* of 10000 steps */
    motus_run_destroy(r);
    motus_system_destroy(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stepwise_is_at_once),
        cmocka_unit_test(samples_at_steps_are_the_state),
        cmocka_unit_test(the_exact_motion_is_exact_between_steps),
        cmocka_unit_test(samples_between_steps_hit_the_neighbours),
        cmocka_unit_test(another_start),
        cmocka_unit_test(starts_are_in_the_order_of_the_columns),
        cmocka_unit_test(backward),
        cmocka_unit_test(the_last_step_is_shortened),
        cmocka_unit_test(steps_and_ends_that_are_refused),
        cmocka_unit_test(step_limits_that_are_refused),
        cmocka_unit_test(slivers_are_no_steps),
        cmocka_unit_test(divergence_names_time_and_variable),
        cmocka_unit_test(an_implicit_equation_without_solution),
        cmocka_unit_test(progress_and_cancellation),
        cmocka_unit_test(progress_is_told_now_and_then),
    };
    return cmocka_run_group_tests_name("runs", tests, NULL, NULL);
}
