/* motus_reference: its error on motions with a known solution, and that it is the reference solution of compare. */
#include "study/solution.h"
#include "test/given.h"

#include <float.h>
#include <time.h>

static const char spring[] = "x'' = -x\nx(0) = 1\nx'(0) = 0\nstep 0.1\nuntil 12.34\n";
static const char damped[] = "d = 0.2\nx'' = -x - 2 d x'\nx(0) = 1\nx'(0) = -d\nstep 0.05\nuntil 20\n";

static motus_reference *reference_of(motus_system *s, const motus_study_def *def)
{
    motus_error err = motus_default_error();
    motus_reference *r = NULL;
    must(motus_reference_create(s, def, &r, &err), &err, "motus_reference_create");
    return r;
}

static void at(motus_reference *r, const double *times, size_t count, double *x, double *v)
{
    motus_error err = motus_default_error();
    must(motus_reference_at(r, times, count, x, v, &err), &err, "motus_reference_at");
}

/* Evenly spread times, not in order, none a multiple of a step. */
static void scatter(double *t, size_t count, double from, double until)
{
    for (size_t k = 0; k < count; k++) t[k] = from + (until - from) * fmod(0.6180339887498949 * (double)(k + 1), 1);
}

enum { MANY = 300 };

static void exact_is_exact(void **state)
{
    (void)state;
    motus_system *s = given_text("x'' = -x\nx(0) = 1\nx'(0) = 0\nexact x = cos(t)\nstep 0.1\nuntil 12.34\n");
    motus_reference *r = reference_of(s, NULL);
    assert_string_equal(motus_reference_name(r), "exact");
    assert_true(motus_reference_error(r) == 0);
    double t[MANY], x[MANY], v[MANY];
    scatter(t, MANY, 0, 12.34);
    t[0] = 0, t[1] = 12.34, t[2] = 1e-17;
    at(r, t, MANY, x, v);
    for (size_t k = 0; k < MANY; k++)
        assert_true(fabs(x[k] - cos(t[k])) <= DBL_EPSILON && fabs(v[k] + sin(t[k])) <= DBL_EPSILON);
    motus_reference_destroy(r);
    motus_system_destroy(s);
}

/* The estimated error of the grid's points also bounds the error between them; each answer rounds the state once
 * more. */
static void expect_within_bound(const char *text, double from, double until, double (*exact)(double),
                                double (*speed)(double))
{
    motus_system *s = given_text(text);
    motus_study_def def = motus_default_study();
    def.until = until;
    motus_reference *r = reference_of(s, &def);
    const double error = motus_reference_error(r), bound = 2 * error + 16 * DBL_EPSILON;
    assert_true(error > 0 && error < 1e-12);
    assert_non_null(strstr(motus_reference_name(r), " at step "));
    double t[MANY], x[MANY], v[MANY], sorted_x[MANY];
    scatter(t, MANY, from, until);
    at(r, t, MANY, x, v);
    for (size_t k = 0; k < MANY; k++)
        if (!(fabs(x[k] - exact(t[k])) <= bound) || !(fabs(v[k] - speed(t[k])) <= bound))
            fail_msg("%s at %g: %.1e and %.1e off, bound %.1e", motus_reference_name(r), t[k], x[k] - exact(t[k]),
                     v[k] - speed(t[k]), bound);
    for (size_t k = 0; k < MANY; k++) t[k] = from + (until - from) * (double)k / (MANY - 1);
    at(r, t, MANY, sorted_x, NULL);
    for (size_t k = 0; k < MANY; k++) assert_true(fabs(sorted_x[k] - exact(t[k])) <= bound);
    at(r, t, 0, NULL, NULL);
    motus_reference_destroy(r);
    motus_system_destroy(s);
}

static double swing(double t) { return cos(t); }
static double swing_speed(double t) { return -sin(t); }
static double damped_swing(double t) { return exp(-0.2 * t) * cos(sqrt(0.96) * t); }
static double damped_speed(double t)
{
    return -0.2 * damped_swing(t) - sqrt(0.96) * exp(-0.2 * t) * sin(sqrt(0.96) * t);
}

static void the_estimated_error_is_a_bound(void **state)
{
    (void)state;
    expect_within_bound(spring, 0, 12.34, swing, swing_speed);
    expect_within_bound(damped, 0, 20, damped_swing, damped_speed);
    expect_within_bound(spring, 0, -5, swing, swing_speed); /* backward */
    /* no step is given: the library chooses one */
    expect_within_bound("x'' = -x\nx(0) = 1\nx'(0) = 0\nuntil 7\n", 0, 7, swing, swing_speed);
}

/* The largest error in compare is the largest distance from these answers, to the bit: the solution is the same. */
static void is_the_reference_of_compare(void **state)
{
    (void)state;
    /* the second from a start other than 0, so that times are rounded twice */
    static const char *const texts[] = {damped, "x'' = -x\nx(1.7) = 1\nx'(1.7) = 0\n"};
    for (int k = 0; k < 2; k++) {
        motus_system *s = given_text(texts[k]);
        const char *method = "rk4";
        motus_error err = motus_default_error();
        motus_study_def def = motus_default_study();
        def.methods = &method;
        def.method_count = 1;
        /* 160 and 123 steps, none of them shorter: compare's grid is every step */
        def.until = k ? 14.0 : 10;
        def.step = k ? 0.1 : 0.0625;
        motus_comparison *c = NULL;
        must(motus_compare(s, &def, &c, &err), &err, "motus_compare");
        motus_reference *r = reference_of(s, &def);
        assert_string_equal(motus_reference_name(r), c->reference);
        assert_true(motus_reference_error(r) == c->reference_error);
        motus_run_def run_def = motus_default_run();
        run_def.method = method;
        run_def.step = def.step;
        run_def.until = def.until;
        motus_run *run = NULL;
        must(motus_run_create(s, &run_def, &run, &err), &err, "motus_run_create");
        double worst = 0, last = NAN;
        while (!motus_run_done(run)) {
            double x, reference, t;
            must(motus_run_step(run, 1, &err), &err, "step");
            must(motus_run_state(run, &x, NULL, &err), &err, "state");
            t = motus_run_time(run);
            at(r, &t, 1, &reference, NULL);
            last = fabs(x - reference);
            worst = fmax(worst, last);
        }
        assert_true(worst == c->rows[0]->error_max_x && last == c->rows[0]->error_final_x && worst > 0);
        motus_run_destroy(run);
        motus_reference_destroy(r);
        motus_comparison_destroy(c);
        motus_system_destroy(s);
    }
}

/* At the points of the grid the answers are the kept rows, to the bit, though these times are rounded once more than
 * the grid's. */
static void kept_rows_are_returned_unchanged(void **state)
{
    (void)state;
    motus_system *s = given_text("x'' = -x\nx(1.7) = 1\nx'(1.7) = 0\nstep 0.1\nuntil 14\n");
    motus_reference *r = reference_of(s, NULL);
    motus_error err = motus_default_error();
    motus_study_def def = motus_default_study();
    motus_settings set;
    study inner;
    solution found;
    must(study_settings(s, &def, &set, &err), &err, "study_settings");
    must(study_open(&inner, s, &def, &set, 0.1, &err), &err, "study_open");
    const study_grid grid = solution_grid(&inner, 0.1);
    must(solution_find(&inner, &grid, inner.total, 0, &found), &err, "solution_find");
    assert_int_equal(grid.points, 123);
    for (size_t k = 0; k <= grid.points; k++) {
        double t = 1.7 + (double)k * 0.1, x, v;
        at(r, &t, 1, &x, &v);
        assert_true(x == found.rows[2 * k] && v == found.rows[2 * k + 1]);
    }
    solution_free(&inner, &found);
    study_close(&inner);
    motus_reference_destroy(r);
    motus_system_destroy(s);
}

/* With several variables and a first-order one, answers have the layout of motus_run_state. */
static void rows_are_states(void **state)
{
    (void)state;
    motus_system *s = given_text("r'' = -r\ns' = -s\nr(0) = (1, 0)\nr'(0) = (0, 2)\ns(0) = 3\nstep 0.1\nuntil 2\n");
    motus_reference *r = reference_of(s, NULL);
    const double t[] = {1.234, 0.5};
    double x[4], v[6];
    at(r, t, 2, x, v);
    for (int k = 0; k < 2; k++) {
        const double expected[] = {cos(t[k]), 2 * sin(t[k]), -sin(t[k]), 2 * cos(t[k]), 3 * exp(-t[k])};
        for (int i = 0; i < 5; i++) assert_true(fabs((i < 2 ? x[2 * k + i] : v[3 * k + i - 2]) - expected[i]) < 1e-13);
    }
    motus_reference_destroy(r);
    motus_system_destroy(s);
}

static void wrong_requests(void **state)
{
    (void)state;
    motus_system *s = given_text(spring);
    motus_error e = motus_default_error();
    motus_reference *r = reference_of(s, NULL);
    const double wrong[] = {-0.01, 12.35, NAN, INFINITY};
    double x = 7, t = 1;
    for (int k = 0; k < 4; k++) assert_int_equal(motus_reference_at(r, &wrong[k], 1, &x, NULL, &e), MOTUS_ARGUMENT);
    assert_true(x == 7 && e.message[0] && e.hint[0]);
    assert_int_equal(motus_reference_at(NULL, &t, 1, &x, NULL, &e), MOTUS_ARGUMENT);
    assert_int_equal(motus_reference_at(r, NULL, 1, &x, NULL, NULL), MOTUS_ARGUMENT);
    assert_true(isnan(motus_reference_error(NULL)));
    assert_string_equal(motus_reference_name(NULL), "");
    motus_reference_destroy(NULL);
    motus_reference_destroy(r);
    r = (motus_reference *)s;
    assert_int_equal(motus_reference_create(NULL, NULL, &r, &e), MOTUS_ARGUMENT);
    assert_int_equal(motus_reference_create(s, NULL, NULL, &e), MOTUS_ARGUMENT);
    motus_study_def def = motus_default_study();
    def.until = INFINITY;
    assert_int_equal(motus_reference_create(s, &def, &r, &e), MOTUS_ARGUMENT);
    assert_null(r);
    def.until = NAN;
    def.size = 0;
    assert_int_equal(motus_reference_create(s, &def, &r, &e), MOTUS_ARGUMENT);
    motus_system_destroy(s);
    s = given_text("x'' = -x\nx(0) = 1\nx'(0) = 0\nstep 0.1\n"); /* no end: suggested, 50 */
    must(motus_reference_create(s, NULL, &r, &e), &e, "no end");
    const double end = 50, beyond = 50.1;
    assert_int_equal(motus_reference_at(r, &end, 1, NULL, NULL, &e), MOTUS_OK);
    assert_int_equal(motus_reference_at(r, &beyond, 1, NULL, NULL, &e), MOTUS_ARGUMENT);
    motus_reference_destroy(r);
    motus_system_destroy(s);
    s = given_text("x'' = 2 x^3\nx(0) = 1\nx'(0) = 1\nstep 0.1\nuntil 2\n"); /* 1/(1 - t) */
    assert_int_equal(motus_reference_create(s, NULL, &r, &e), MOTUS_DIVERGED);
    assert_null(r);
    assert_true(e.message[0] && e.hint[0]);
    motus_system_destroy(s);
}

/* A spring whose force fails, or takes a millisecond, as its control says. */
typedef struct control {
    int fail, slow;
} control;

static int controlled_spring(void *context, double t, const double *x, const double *v, double *a)
{
    const control *m = context;
    (void)t, (void)v;
    if (m->fail) return 1;
    if (m->slow) nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
    a[0] = -x[0];
    return 0;
}

static motus_system *controlled_system(control *m)
{
    static const double x[] = {1}, v[] = {0};
    motus_callback_def def = motus_default_callback();
    motus_error err = motus_default_error();
    motus_system *s = NULL;
    def.positions = 1;
    def.x = x;
    def.v = v;
    def.acceleration = controlled_spring;
    def.depends_on_velocity = def.depends_on_time = 0;
    def.context = m;
    must(motus_system_from_callback(&def, &s, &err), &err, "callback");
    return s;
}

/* After a failed answer, the next ones are right. */
static void a_failure_leaves_no_trace(void **state)
{
    (void)state;
    control m = {0};
    motus_system *s = controlled_system(&m);
    motus_study_def def = motus_default_study();
    def.until = 10;
    motus_reference *r = reference_of(s, &def);
    const double t[] = {5.01, 5.02, 5.03};
    double x;
    motus_error e = motus_default_error();
    at(r, t, 1, &x, NULL);
    m.fail = 1;
    assert_int_equal(motus_reference_at(r, t + 1, 1, &x, NULL, &e), MOTUS_CALLBACK);
    assert_true(e.message[0]);
    m.fail = 0;
    for (int k = 2; k >= 0; k--) {
        at(r, t + k, 1, &x, NULL);
        assert_true(fabs(x - cos(t[k])) < 1e-13);
    }
    motus_reference_destroy(r);
    motus_system_destroy(s);
}

/* motus_reference_create calls the progress hook; motus_reference_at never does, however long it takes. */
static void may_be_cancelled(void **state)
{
    (void)state;
    control m = {0};
    motus_system *s = controlled_system(&m);
    motus_error e = motus_default_error();
    motus_study_def def = motus_default_study();
    def.until = 10;
    def.step = 5;
    def.progress = given_observe;
    given_progress w = {.cancel_at = 1};
    def.context = &w;
    motus_reference *r = NULL;
    assert_int_equal(motus_reference_create(s, &def, &r, &e), MOTUS_CANCELLED);
    assert_null(r);
    assert_int_equal(w.calls, 1);
    w = (given_progress){0};
    r = reference_of(s, &def);
    const int before = w.calls;
    double t = 2, x;
    m.slow = 1;
    at(r, &t, 1, &x, NULL);
    assert_int_equal(w.calls, before);
    motus_reference_destroy(r);
    motus_system_destroy(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exact_is_exact),
        cmocka_unit_test(the_estimated_error_is_a_bound),
        cmocka_unit_test(is_the_reference_of_compare),
        cmocka_unit_test(kept_rows_are_returned_unchanged),
        cmocka_unit_test(rows_are_states),
        cmocka_unit_test(wrong_requests),
        cmocka_unit_test(a_failure_leaves_no_trace),
        cmocka_unit_test(may_be_cancelled),
    };
    return cmocka_run_group_tests_name("solution", tests, NULL, NULL);
}
