/* Legs of a run, its observer and its statistics; dense output within the last step. */
#include "test/given.h"

#include <math.h>

static const char oscillator[] = "x'' = -x\nx(0) = 1\nx'(0) = 0.5\n";

static motus_system *system_of(const char *text)
{
    motus_text_def def = motus_default_text();
    motus_error err = motus_default_error();
    motus_system *s = NULL;
    def.text = text;
    if (motus_system_from_text(&def, &s, &err)) fail_msg("%s", err.message);
    return s;
}

typedef struct witness {
    int seen, enough;
    double last;
    char first[1000]; /* the restart state after the first step */
} witness;

static int watching(void *context, motus_run *r)
{
    witness *w = context;
    motus_error err = motus_default_error();
    double x;
    assert_int_equal(motus_run_state(r, &x, NULL, &err), MOTUS_OK);
    assert_int_equal(motus_run_step(r, 1, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_run_set_state(r, NAN, &x, NULL, &err), MOTUS_ARGUMENT);
    const char *saved;
    size_t length;
    const motus_trace_entry *const *entries;
    if (!w->seen) snprintf(w->first, sizeof w->first, "%s", motus_run_save(r, &saved, &length, &err) ? "" : saved);
    assert_int_equal(motus_run_restore(r, w->first, strlen(w->first), &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_run_trace(r, &entries, &length, &err), MOTUS_ARGUMENT);
    assert_true(motus_run_time(r) > w->last);
    w->last = motus_run_time(r);
    return ++w->seen == w->enough;
}

static motus_run *run_of(motus_system *s, const char *method, double step, double until, witness *w)
{
    motus_run_def def = motus_default_run();
    motus_error err = motus_default_error();
    motus_run *r = NULL;
    def.method = method, def.step = step, def.until = until;
    if (w) def.observer = watching, def.context = w;
    if (motus_run_create(s, &def, &r, &err)) fail_msg("%s", err.message);
    return r;
}

/* A leg from (t, x, v) is the run that starts there; the counters continue. */
static void legs(void **state)
{
    (void)state;
    static const char *const methods[] = {"verlet", "velocity-verlet", "beeman",  "verlet-literal",
                                          "rk4",    "gauss4",          "newmark", "kahan-li8"};
    motus_system *s = system_of(oscillator);
    motus_error err = motus_default_error();
    for (size_t k = 0; k < sizeof methods / sizeof *methods; k++) {
        const int literal = !strcmp(methods[k], "verlet-literal");
        const double until = literal ? 2 : 2.03, x = 0.25, v = -1;
        motus_run *r = run_of(s, methods[k], 0.125, until, NULL);
        assert_int_equal(motus_run_step(r, 5, &err), MOTUS_OK);
        assert_int_equal(motus_run_set_state(r, 1, &x, &v, &err), MOTUS_OK);
        assert_true(motus_run_time(r) == 1 && motus_run_steps(r) == 0 && !motus_run_done(r));
        assert_int_equal(motus_run_finish(r, &err), MOTUS_OK);
        motus_run_def def = motus_default_run();
        motus_run *alone = NULL;
        def.method = methods[k], def.step = 0.125, def.until = until, def.start = 1, def.x = &x, def.v = &v;
        assert_int_equal(motus_run_create(s, &def, &alone, &err), MOTUS_OK);
        assert_int_equal(motus_run_finish(alone, &err), MOTUS_OK);
        double a[2], b[2];
        motus_run_state(r, &a[0], &a[1], &err);
        motus_run_state(alone, &b[0], &b[1], &err);
        assert_memory_equal(a, b, sizeof a);
        const motus_run_statistics all = motus_run_now(r);
        assert_true(all.legs == 2 && all.steps == 5 + (literal ? 8 : 9) && all.refused == 0 && all.first_step == 0.125);
        assert_true(literal ? all.last_step == 0.125 : fabs(all.last_step - 0.03) < 1e-12);
        assert_true(all.evaluations == motus_run_now(r).evaluations &&
                    all.evaluations > motus_run_now(alone).evaluations);
        motus_run_destroy(alone);
        motus_run_destroy(r);
    }
    motus_system_destroy(s);
}

static int never(void *context, double fraction)
{
    (void)context, (void)fraction;
    return 1;
}

/* Without steps there is no progress to tell, and nothing to cancel. */
static void no_steps_are_not_cancelled(void **state)
{
    (void)state;
    motus_system *s = system_of(oscillator);
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    const double x = 0.25;
    def.step = 0.125, def.until = 2, def.progress = never;
    assert_int_equal(motus_run_create(s, &def, &r, &err), MOTUS_OK);
    assert_int_equal(motus_run_set_state(r, 1, &x, NULL, &err), MOTUS_OK);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* What cannot be a start leaves the run where it was. */
static void refused(void **state)
{
    (void)state;
    motus_system *s = system_of(oscillator);
    motus_error err = motus_default_error();
    motus_run *r = run_of(s, "verlet-literal", 0.125, 2, NULL);
    assert_int_equal(motus_run_step(r, 5, &err), MOTUS_OK);
    double before, after, bad = NAN;
    motus_run_state(r, &before, NULL, &err);
    assert_int_equal(motus_run_set_state(r, NAN, &bad, NULL, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_run_set_state(r, 0.3, NULL, NULL, &err), MOTUS_METHOD);
    assert_int_equal(motus_run_set_state(r, INFINITY, NULL, NULL, &err), MOTUS_ARGUMENT);
    motus_run_state(r, &after, NULL, &err);
    assert_true(before == after && motus_run_steps(r) == 5 && motus_run_time(r) == 0.625);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

static void observers(void **state)
{
    (void)state;
    motus_system *s = system_of(oscillator);
    motus_error err = motus_default_error();
    witness all = {0}, some = {.enough = 3};
    motus_run *r = run_of(s, "verlet", 0.125, 2.03, &all), *q = run_of(s, "verlet", 0.125, 2.03, &some),
              *plain = run_of(s, "verlet", 0.125, 2.03, NULL);
    assert_int_equal(motus_run_finish(r, &err), MOTUS_OK);
    assert_int_equal(all.seen, 17);
    assert_int_equal(motus_run_finish(q, &err), MOTUS_CANCELLED);
    assert_true(some.seen == 3 && motus_run_steps(q) == 3);
    assert_int_equal(motus_run_finish(q, &err), MOTUS_OK);
    assert_int_equal(motus_run_finish(plain, &err), MOTUS_OK);
    double a, b, c;
    motus_run_state(r, &a, NULL, &err), motus_run_state(q, &b, NULL, &err), motus_run_state(plain, &c, NULL, &err);
    assert_true(a == c && b == c);
    motus_run_destroy(r), motus_run_destroy(q), motus_run_destroy(plain);
    motus_system_destroy(s);
}

/* A run gives states within its last step, full or shorter, and continues to the same bits; earlier times are
 * refused. */
static void back(void **state)
{
    (void)state;
    static const char *const methods[] = {"verlet", "velocity-verlet", "beeman", "verlet-literal",
                                          "rk4",    "gauss4",          "newmark"};
    motus_system *s = system_of(oscillator);
    motus_error err = motus_default_error();
    size_t column, count;
    assert_int_equal(motus_column_find(s, "x", &column, &count, &err), MOTUS_OK);
    for (size_t k = 0; k < sizeof methods / sizeof *methods; k++) {
        const double until = strcmp(methods[k], "verlet-literal") ? 2.03 : 2;
        motus_run *r = run_of(s, methods[k], 0.125, until, NULL), *forward = run_of(s, methods[k], 0.125, until, NULL);
        double t = 0.55, seen, expected, a[2], b[2];
        assert_int_equal(motus_run_step(r, 5, &err), MOTUS_OK);
        assert_int_equal(motus_run_sample(r, &t, 1, &column, 1, &seen, &err), MOTUS_OK);
        assert_int_equal(motus_run_sample(forward, &t, 1, &column, 1, &expected, &err), MOTUS_OK);
        assert_true(seen == expected && motus_run_time(r) == 0.625);
        t = 0.49;
        assert_int_equal(motus_run_sample(r, &t, 1, &column, 1, &seen, &err), MOTUS_ARGUMENT);
        assert_int_equal(motus_run_finish(r, &err), MOTUS_OK);
        t = until - 0.01;
        assert_int_equal(motus_run_sample(r, &t, 1, &column, 1, &seen, &err), MOTUS_OK);
        assert_int_equal(motus_run_sample(forward, &t, 1, &column, 1, &expected, &err), MOTUS_OK);
        assert_int_equal(motus_run_finish(forward, &err), MOTUS_OK);
        assert_true(seen == expected && motus_run_done(r));
        motus_run_state(r, &a[0], &a[1], &err), motus_run_state(forward, &b[0], &b[1], &err);
        assert_memory_equal(a, b, sizeof a);
        assert_true(motus_run_now(r).evaluations == motus_run_now(forward).evaluations);
        motus_run_destroy(r), motus_run_destroy(forward);
    }
    motus_system_destroy(s);
}

/* Dense output of every method, whether it has to evaluate the force within the step or not: sampling changes neither
 * the run's bits nor its counts, and a time gives the same bits whether the run comes from before it or is beyond. */
static void sampling_changes_nothing(void **state)
{
    (void)state;
    static const char *const texts[] = {"x'' = -x - x^2 + 0.1 sin(t)\nx(0) = 0.5\nx'(0) = 0.5\n",
                                        "x'' = -x - x^2\nx(0) = 0.5\nx'(0) = 0.5\ns' = x\ns(0) = 1\n",
                                        "x'' = -x - 0.1 x'^3 + s\nx(0) = 0.5\nx'(0) = 0.5\ns' = x x' - s\ns(0) = 1\n",
                                        "x'' = y'\ny'' = -x' - x\nx(0) = 0.5\nx'(0) = 0.5\ny(0) = 0\ny'(0) = 0\n"};
    motus_error err = motus_default_error();
    size_t tried = 0;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        motus_system *s = system_of(texts[i]);
        const size_t count = motus_positions(s) + motus_velocities(s);
        const size_t columns[4] = {1, 2, 3, 4};
        assert_true(count <= 4);
        for (size_t k = 0; k < motus_method_count(); k++) {
            const char *name = motus_method_at(k)->name;
            if (motus_method_admits(s, name, NULL)) continue;
            motus_run *plain = given_run(s, name, 0.125, 2), *sampled = given_run(s, name, 0.125, 2),
                      *back = given_run(s, name, 0.125, 2);
            double a[8], b[8], c[8];
            double times[2] = {0.55};
            finish(plain);
            must(motus_run_sample(sampled, times, 1, columns, count, a, &err), &err, name);
            const double reached = motus_run_time(sampled);
            times[1] = (times[0] + reached) / 2;
            must(motus_run_sample(sampled, times, 2, columns, count, a, &err), &err, name);
            while (motus_run_time(back) < reached) must(motus_run_step(back, 1, &err), &err, name);
            must(motus_run_sample(back, times, 2, columns, count, b, &err), &err, name);
            assert_memory_equal(a, b, 2 * count * sizeof *a);
            finish(sampled);
            finish(back);
            motus_run_state(plain, a, a + motus_positions(s), &err);
            motus_run_state(sampled, b, b + motus_positions(s), &err);
            motus_run_state(back, c, c + motus_positions(s), &err);
            assert_memory_equal(a, b, count * sizeof *a);
            assert_memory_equal(a, c, count * sizeof *a);
            assert_int_equal(motus_run_now(plain).evaluations, motus_run_now(sampled).evaluations);
            assert_int_equal(motus_run_now(plain).evaluations, motus_run_now(back).evaluations);
            motus_run_destroy(plain), motus_run_destroy(sampled), motus_run_destroy(back);
            tried++;
        }
        motus_system_destroy(s);
    }
    assert_true(tried > motus_method_count());
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(legs),      cmocka_unit_test(refused), cmocka_unit_test(no_steps_are_not_cancelled),
        cmocka_unit_test(observers), cmocka_unit_test(back),    cmocka_unit_test(sampling_changes_nothing)};
    return cmocka_run_group_tests_name("leg", tests, NULL, NULL);
}
