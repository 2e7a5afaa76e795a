/* Work against precision: motus_rank, on motions that are known. */
#include "test/given.h"

#include <float.h>

static const char spring[] = "x'' = -x\nx(0) = 1\nx'(0) = 0\nexact x = cos(t)\nuntil 20\n";
/* After ten periods and a half the planet is at the far end of its axis. */
static const char kepler[] = "r'' = -r/|r|^3\nr(0) = (1/2, 0)\nr'(0) = (0, sqrt(3))\nuntil 21 pi\n";

static motus_study_def study_of(const char *const *methods, size_t count, double coarsest, double finest)
{
    motus_study_def def = motus_default_study();
    def.methods = methods;
    def.method_count = count;
    def.coarsest = coarsest;
    def.finest = finest;
    return def;
}

static motus_ranking *rank(motus_system *s, const motus_study_def *def)
{
    motus_ranking *r = NULL;
    motus_error err = motus_default_error();
    must(motus_rank(s, def, &r, &err), &err, "motus_rank");
    return r;
}

/* The run that a point tells of. */
static motus_run *run_of(motus_system *s, const motus_rank_row *row, const motus_rank_point *p)
{
    motus_run_def def = motus_default_run();
    motus_error err = motus_default_error();
    motus_run *run = NULL;
    def.method = row->method;
    *(row->adaptive ? &def.tolerance : &def.step) = p->setting;
    must(motus_run_create(s, &def, &run, &err), &err, row->method);
    return run;
}

/* What a point says is what a run with its setting does; its error is found at some ends of steps, the last one
 * included. */
static void points_are_runs(void **state)
{
    (void)state;
    static const char *const methods[] = {"verlet", "rk4", "gauss6", "dopri5", "dep12", "taylor"};
    motus_system *s = given_text(spring);
    const motus_study_def def = study_of(methods, 6, 1e-3, 1e-7);
    motus_ranking *r = rank(s, &def);
    assert_int_equal(r->accuracy_count, 5);
    assert_int_equal(r->judged, 5);
    assert_int_equal(r->row_count, 6);
    assert_string_equal(r->reference, "exact");
    assert_true(r->reference_error > 0 && r->reference_error < 1e-13); /* the formula is rounded too */
    for (size_t k = 0; k < r->row_count; k++)
        for (size_t i = 0; i < r->judged; i++) {
            const motus_rank_point *p = r->rows[k]->points[i];
            motus_run *run = run_of(s, r->rows[k], p);
            motus_error err = motus_default_error();
            double x, v, most = 0, last = 0;
            assert_true(p->error <= p->accuracy && p->seconds > 0 && isfinite(p->seconds));
            while (!motus_run_done(run)) {
                must(motus_run_step(run, 1, &err), &err, "step");
                must(motus_run_state(run, &x, &v, &err), &err, "state");
                const double t = motus_run_time(run);
                last = fmax(fabs(x - cos(t)), fabs(v + sin(t)));
                most = fmax(most, last);
            }
            assert_int_equal(motus_run_steps(run), p->steps);
            assert_int_equal(motus_run_now(run).evaluations, p->evaluations);
            /* the largest numbers so far are 1, or a little less as long as the velocity has not come to 1 */
            assert_true(last <= p->error * 1.0001 + 1e-15);
            assert_true(p->error <= most * 1.7);
            motus_run_destroy(run);
        }
    motus_ranking_destroy(r);
    motus_system_destroy(s);
}

/* Errors are relative to the largest number so far: a push at t = 1, of which the error stays, and a fall beside it
 * that makes the motion ever larger. */
static void the_size_is_that_so_far(void **state)
{
    (void)state;
    static const char *const methods[] = {"rk4", "tsit5"};
    motus_system *s = given_text("x'' = 1/(1/16 + (t - 1)^2)\nz'' = 1\nx(0) = 0; z(0) = 1\nx'(0) = 0; z'(0) = 0\n"
                                 "until 32\n");
    const motus_study_def def = study_of(methods, 2, 1e-4, 1e-6);
    motus_ranking *r = rank(s, &def);
    for (size_t k = 0; k < 2; k++)
        for (size_t i = 0; i < r->judged; i++) {
            const motus_rank_point *p = r->rows[k]->points[i];
            motus_run *run = run_of(s, r->rows[k], p);
            motus_error err = motus_default_error();
            double x[2], v[2], size[2] = {1, 0}, most = 0;
            while (!motus_run_done(run)) {
                must(motus_run_step(run, 1, &err), &err, "step");
                must(motus_run_state(run, x, v, &err), &err, "state");
                const double t = motus_run_time(run), u = 4 * (t - 1);
                const double place = u * atan(u) - log(1 + u * u) / 2 - (4 * atan(4) - log(17) / 2) + 4 * atan(4) * t,
                             speed = 4 * (atan(u) + atan(4));
                size[0] = fmax(size[0], fmax(fabs(place), 1 + t * t / 2));
                size[1] = fmax(size[1], fmax(fabs(speed), t));
                if (t < 1) continue;
                most = fmax(most, fmax(fabs(x[0] - place) / size[0], fabs(v[0] - speed) / size[1]));
            }
            assert_true(most <= 2 * p->error && p->error <= most * 1.0001 + 1e-14);
            motus_run_destroy(run);
        }
    motus_ranking_destroy(r);
    motus_system_destroy(s);
}

/* For a tenth of the error a method of order p takes 10^(1/p) times the work; and no method takes much more than it
 * needs: its error is more than 0.6 of the accuracy. */
static void work_follows_the_order(void **state)
{
    (void)state;
    static const char *const methods[] = {"explicit-euler", "rk4", "kahan-li6", "suzuki4"};
    motus_system *s = given_text(kepler);
    const motus_study_def def = study_of(methods, 4, 1e-5, 1e-7);
    motus_ranking *r = rank(s, &def);
    for (size_t k = 1; k < 4; k++) {
        const motus_rank_row *row = r->rows[k];
        const double ratio = (double)row->points[2]->evaluations / (double)row->points[0]->evaluations;
        const double exponent = log10(ratio) / log10(row->points[0]->error / row->points[2]->error);
        if (fabs(exponent * row->order - 1) > 0.15) fail_msg("%s: %g", row->method, exponent * row->order);
        for (size_t i = 0; i < 3; i++) assert_true(row->points[i]->error > 0.6 * row->points[i]->accuracy);
    }
    /* Euler's method would take too long, and its row says so */
    assert_non_null(strstr(r->rows[0]->note, "evaluations"));
    assert_int_equal(r->rows[0]->status, MOTUS_ACCURACY);
    assert_true(isnan(r->rows[0]->points[0]->error) && r->rows[0]->points[0]->steps == 0);
    motus_ranking_destroy(r);
    motus_system_destroy(s);
}

/* The place at the end is known without any reference: the errors that are told are true. */
static void errors_are_true(void **state)
{
    (void)state;
    static const char *const methods[] = {"blanes-moan6", "dep12", "verner9", "radau15", "gauss12"};
    motus_system *s = given_text(kepler);
    const motus_study_def def = study_of(methods, 5, 1e-6, 1e-11);
    motus_ranking *r = rank(s, &def);
    assert_int_equal(r->judged, 6);
    for (size_t k = 0; k < r->row_count; k++)
        for (size_t i = 0; i < r->judged; i++) {
            const motus_rank_point *p = r->rows[k]->points[i];
            if (isnan(p->error)) continue;
            motus_run *run = run_of(s, r->rows[k], p);
            motus_error err = motus_default_error();
            double x[2], v[2];
            must(motus_run_finish(run, &err), &err, "finish");
            must(motus_run_state(run, x, v, &err), &err, "state");
            const double far = fmax(fabs(x[0] + 1.5), fabs(x[1])) / 1.5,
                         fast = fmax(fabs(v[0]), fabs(v[1] + 1 / sqrt(3))) / sqrt(3);
            /* the end is rounded too: 21 pi, to 7e-15 */
            assert_true(fmax(far, fast) <= p->error + r->reference_error + 1e-14);
            assert_true(p->error + r->reference_error <= p->accuracy);
            motus_run_destroy(run);
        }
    motus_ranking_destroy(r);
    motus_system_destroy(s);
}

/* The cheapest are those with the smallest numbers, and evaluations are the same every time. */
static void the_cheapest(void **state)
{
    (void)state;
    static const char *const methods[] = {"verlet", "dop853", "rk4"};
    motus_system *s = given_text(spring);
    const motus_study_def def = study_of(methods, 3, 1e-2, 1e-6);
    motus_ranking *r = rank(s, &def), *again = rank(s, &def);
    for (size_t i = 0; i < r->judged; i++) {
        assert_true(r->fewest[i] < 3 && r->fastest[i] < 3);
        for (size_t k = 0; k < 3; k++) {
            assert_true(r->rows[k]->points[i]->evaluations >= r->rows[r->fewest[i]]->points[i]->evaluations);
            assert_true(r->rows[k]->points[i]->seconds >= r->rows[r->fastest[i]]->points[i]->seconds);
            assert_int_equal(r->rows[k]->points[i]->evaluations, again->rows[k]->points[i]->evaluations);
            assert_true(r->rows[k]->points[i]->setting == again->rows[k]->points[i]->setting);
        }
    }
    assert_string_equal(r->rows[r->fewest[r->judged - 1]]->method, "dop853");
    motus_ranking_destroy(r);
    motus_ranking_destroy(again);
    motus_system_destroy(s);
}

/* Where neighbouring motions separate, the reference knows few digits, and nothing finer is compared. */
static void nothing_is_told_from_noise(void **state)
{
    (void)state;
    static const char *const methods[] = {"dop853", "rk4"};
    static const char chaos[] = "x' = 10 (y - x)\ny' = x (28 - z) - y\nz' = x y - 8/3 z\n"
                                "x(0) = 1; y(0) = 1; z(0) = 1\nuntil 22\n";
    motus_system *s = given_text(chaos);
    motus_study_def def = study_of(methods, 2, 1e-2, 1e-12);
    motus_ranking *r = rank(s, &def);
    assert_true(r->judged >= 1 && r->judged < r->accuracy_count);
    assert_true(10 * r->reference_error <= r->accuracies[r->judged - 1]);
    assert_true(10 * r->reference_error > r->accuracies[r->judged]);
    assert_non_null(strstr(r->remarks, "left out"));
    assert_true(r->fewest[r->accuracy_count - 1] == 2 && isnan(r->rows[0]->points[r->accuracy_count - 1]->error));
    motus_ranking_destroy(r);
    def.coarsest = 1e-13;
    motus_error err = motus_default_error();
    assert_int_equal(motus_rank(s, &def, &r, &err), MOTUS_ACCURACY);
    assert_null(r);
    assert_true(strstr(err.message, "reference") && err.hint[0]);
    motus_system_destroy(s);
}

static void methods_that_cannot(void **state)
{
    (void)state;
    static const char *const methods[] = {"dep12", "rk4", "explicit-euler"};
    motus_system *s = given_text("x'' = -x - x'/10\nx(0) = 1\nx'(0) = 0\nuntil 20\n");
    const motus_study_def def = study_of(methods, 3, 1e-9, 1e-9);
    motus_ranking *r = rank(s, &def);
    assert_int_equal(r->accuracy_count, 1);
    assert_int_equal(r->rows[0]->status, MOTUS_METHOD);
    assert_non_null(strstr(r->rows[0]->note, "does not admit"));
    assert_int_equal(r->rows[1]->status, MOTUS_OK);
    assert_int_equal(r->rows[2]->status, MOTUS_ACCURACY);
    assert_int_equal(r->fewest[0], 1);
    motus_ranking_destroy(r);
    motus_system_destroy(s);
    /* of no motion that ends in a singularity is there a reference */
    s = given_text("x'' = 2 x^3\nx(0) = 1\nx'(0) = 1\nuntil 2\n");
    motus_error err = motus_default_error();
    assert_int_equal(motus_rank(s, &def, &r, &err), MOTUS_DIVERGED);
    motus_system_destroy(s);
}

static void wrong_requests(void **state)
{
    (void)state;
    motus_system *s = given_text(spring);
    static const double bad[][2] = {{NAN, NAN},    {0, 1e-3},  {1e-3, 0},     {-1e-3, 1e-6},   {1, 1e-3},
                                    {1e-3, 1e-16}, {1e-3, -1}, {INFINITY, 1}, {1e-3, INFINITY}};
    motus_ranking *r = (motus_ranking *)s;
    motus_error err = motus_default_error();
    motus_study_def def = motus_default_study();
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        def.coarsest = bad[k][0];
        def.finest = bad[k][1];
        err = motus_default_error();
        assert_int_equal(motus_rank(s, &def, &r, &err), MOTUS_ARGUMENT);
        assert_null(r);
        assert_true(err.message[0] && err.hint[0]);
    }
    static const char *const one[] = {"dop853"};
    def = study_of(one, 1, 1e-3, 1e-5);
    def.step = 0.1;
    assert_int_equal(motus_rank(s, &def, &r, &err), MOTUS_ARGUMENT);
    def.step = NAN;
    def.evaluations = 10;
    assert_int_equal(motus_rank(s, &def, &r, &err), MOTUS_ARGUMENT);
    def.evaluations = 0;
    def.repeats = -1;
    assert_int_equal(motus_rank(s, &def, &r, &err), MOTUS_ARGUMENT);
    def.repeats = 0;
    def.machine = "abacus";
    assert_int_equal(motus_rank(s, &def, &r, &err), MOTUS_ARGUMENT);
    def.machine = NULL;
    def.absolute = 1;
    def.coarsest = 1e60;
    assert_int_equal(motus_rank(s, &def, &r, &err), MOTUS_ARGUMENT); /* too many */
    assert_int_equal(motus_rank(NULL, &def, &r, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_rank(s, &def, NULL, &err), MOTUS_ARGUMENT);
    /* in any order, and an end that no factor ten leads to; one of the two is enough */
    def = study_of(one, 1, 3e-5, 1e-3);
    r = rank(s, &def);
    assert_int_equal(r->accuracy_count, 3);
    assert_true(r->accuracies[0] == 1e-3 && r->accuracies[1] == 1e-4 && r->accuracies[2] == 3e-5);
    motus_ranking_destroy(r);
    def.coarsest = NAN;
    r = rank(s, &def);
    assert_true(r->accuracy_count == 1 && r->accuracies[0] == 1e-3);
    motus_ranking_destroy(r);
    motus_ranking_destroy(NULL);
    motus_system_destroy(s);
}

/* Absolute accuracies are in the units of the numbers: of a spring a thousand times as large, a thousand times as
 * large. */
static void absolute_accuracies(void **state)
{
    (void)state;
    static const char *const methods[] = {"rk4", "dop853"};
    motus_system *s = given_text("x'' = -x\nx(0) = 1024\nx'(0) = 0\nuntil 20\n"), *small = given_text(spring);
    motus_study_def def = study_of(methods, 2, 1.024e-3, 1.024e-3), less = study_of(methods, 2, 1e-6, 1e-6);
    def.absolute = less.absolute = 1;
    motus_ranking *r = rank(s, &def), *q = rank(small, &less);
    assert_int_equal(r->absolute, 1);
    for (size_t k = 0; k < 2; k++)
        assert_true(fabs(r->rows[k]->points[0]->error / (1024 * q->rows[k]->points[0]->error) - 1) < 0.3);
    motus_ranking_destroy(r);
    motus_ranking_destroy(q);
    motus_system_destroy(s);
    motus_system_destroy(small);
}

static void progress_and_cancelling(void **state)
{
    (void)state;
    motus_system *s = given_text(kepler);
    static const char *const methods[] = {"rk4", "dop853"};
    motus_study_def def = study_of(methods, 2, 1e-3, 1e-7);
    def.progress = given_observe;
    for (int stop = 0; stop <= 3; stop++) {
        given_progress p = {0, stop, 0};
        motus_ranking *r = NULL;
        motus_error err = motus_default_error();
        def.context = &p;
        const motus_status status = motus_rank(s, &def, &r, &err);
        assert_int_equal(status, stop ? MOTUS_CANCELLED : MOTUS_OK);
        assert_true(stop ? !r && p.calls == stop : p.calls >= 3 && p.last > 0.5);
        motus_ranking_destroy(r);
    }
    motus_system_destroy(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_are_runs),        cmocka_unit_test(the_size_is_that_so_far),
        cmocka_unit_test(work_follows_the_order), cmocka_unit_test(errors_are_true),
        cmocka_unit_test(the_cheapest),           cmocka_unit_test(nothing_is_told_from_noise),
        cmocka_unit_test(methods_that_cannot),    cmocka_unit_test(wrong_requests),
        cmocka_unit_test(absolute_accuracies),    cmocka_unit_test(progress_and_cancelling),
    };
    return cmocka_run_group_tests_name("rank", tests, NULL, NULL);
}
