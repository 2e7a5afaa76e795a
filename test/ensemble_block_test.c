/* Ensembles of a C callback: by blocks, one trajectory at a time, on several threads; the bits are those of a run.
 * And models whose trajectories are computed one at a time, on several threads.
 */
#include "test/ensemble_given.h"

#include <stdatomic.h>
#include <stdbool.h>

/* Two positions and a first-order variable; trajectory i has its own stiffness if `stiffness` is given. */
typedef struct world {
    const double *stiffness;
    atomic_int calls, widest;
    int fail_at, answer; /* the trajectory whose acceleration fails, and what it returns then; -1: none */
} world;

static void pull(double k, double t, double x0, double x1, double s, double v0, double *a0, double *a1, double *ds)
{
    *a0 = -k * x0 + x0 * x0 * x0 + 0.1 * s;
    *a1 = x0 - x1 + 0.25 * t;
    *ds = x1 * x0 - 0.5 * v0;
}

static int blockwise(void *context, size_t first, size_t count, double t, const double *x, const double *v, double *a)
{
    world *w = context;
    atomic_fetch_add(&w->calls, 1);
    if ((int)count > atomic_load(&w->widest)) atomic_store(&w->widest, (int)count);
    for (size_t j = 0; j < count; j++) {
        pull(w->stiffness ? w->stiffness[first + j] : 1, t, x[j], x[count + j], v[2 * count + j], v[j], &a[j],
             &a[count + j], &a[2 * count + j]);
        if ((int)(first + j) == w->fail_at) return w->answer;
    }
    return 0;
}

static int alone(void *context, double t, const double *x, const double *v, double *a)
{
    world *w = context;
    pull(w->stiffness ? w->stiffness[0] : 1, t, x[0], x[1], v[2], v[0], &a[0], &a[1], &a[2]);
    return 0;
}

static int energy(void *context, double t, const double *x, const double *v, double *value)
{
    (void)context;
    *value = v[0] * v[0] + x[0] * x[0] + t * v[2];
    return 0;
}

enum { IN_BLOCKS = 1, ALONE = 2 };

static motus_system *given_callback(world *w, int how)
{
    static const double x[2] = {0.5, -0.25}, v[3] = {0, 0.1, 1};
    motus_callback_def def = motus_default_callback();
    motus_error err = motus_default_error();
    motus_system *s = NULL;
    def.positions = 2;
    def.first_order = 1;
    def.x = x;
    def.v = v;
    def.start = 0.5;
    def.acceleration = how & ALONE ? alone : NULL;
    def.block = how & IN_BLOCKS ? blockwise : NULL;
    def.invariant = energy;
    def.context = w;
    must(motus_system_from_callback(&def, &s, &err), &err, "callback");
    return s;
}

static const char *const names[] = {"x[1](0.5)", "x[2]'(0.5)", "s(0.5)"};
enum { NAMES = 3, COUNT = 600, COLUMNS = 7 };

static void spread(double values[NAMES][COUNT], const double *list[NAMES])
{
    for (int k = 0; k < NAMES; k++) {
        list[k] = values[k];
        for (int i = 0; i < COUNT; i++) values[k][i] = 0.001 * ((i * (7 + k) + 3 * k) % 601) - 0.3;
    }
}

static motus_ensemble_def define(const motus_record *records, size_t count, const char *method, double until,
                                 int threads)
{
    motus_ensemble_def def = motus_default_ensemble();
    def.vary = names;
    def.vary_count = NAMES;
    def.records = records;
    def.record_count = count;
    def.method = method;
    given_ensemble_step(&def, 0.01);
    def.until = until;
    def.every = 4;
    def.threads = threads;
    return def;
}

static size_t record_all(motus_record out[2 * COLUMNS])
{
    for (size_t k = 0; k < COLUMNS; k++) {
        out[2 * k] = (motus_record){MOTUS_REDUCE_FINAL, k};
        out[2 * k + 1] = (motus_record){(motus_reduction)(MOTUS_REDUCE_MIN + k % 5), k};
    }
    return 2 * COLUMNS;
}

static void blocks_are_trajectories(void **state)
{
    (void)state;
    static double values[NAMES][COUNT];
    const double *list[NAMES];
    motus_record records[2 * COLUMNS];
    const size_t count = record_all(records);
    spread(values, list);
    world w = {.fail_at = -1}, v = {.fail_at = -1};
    motus_system *s = given_callback(&w, IN_BLOCKS), *one = given_callback(&v, ALONE);
    assert_int_equal(motus_column_count(s), COLUMNS);
    int methods = 0;
    for (size_t k = 0; k < motus_method_count(); k++) {
        const char *method = motus_method_at(k)->name;
        if (motus_method_admits(s, method, NULL) != MOTUS_OK) continue;
        methods++;
        for (int f = 0; f < 2; f++) {
            /* the second ends with a shorter step */
            const double until = f && strcmp(method, "verlet-literal") ? 0.744 : 0.25;
            motus_ensemble_def def = define(records, count, method, until, 1 + 2 * f);
            motus_ensemble *blocks = given_ensemble(s, &def, method);
            def.threads = 0;
            motus_ensemble *singles = given_ensemble(one, &def, method);
            assert_int_equal(motus_ensemble_now(singles).threads, 1);
            assert_string_equal(motus_ensemble_now(blocks).machine, "callback");
            const size_t some = f ? 37 : COUNT;
            outcome a = go(blocks, some, count, list, method), b = go(singles, some, count, list, method);
            same_outcome(&a, &b, method);
            double x[2] = {values[0][7], -0.25}, y[3] = {0, values[1][7], values[2][7]};
            motus_run_def run = motus_default_run();
            motus_error err = motus_default_error();
            motus_run *r = NULL;
            run.method = method;
            given_step(&run, 0.01);
            run.until = until;
            run.x = x;
            run.v = y;
            must(motus_run_create(s, &run, &r, &err), &err, method); /* of a system that has only `block` */
            finish(r);
            assert_true(same_number(value(s, r, "x[2]"), a.at[4][7]) && same_number(value(s, r, "s"), a.at[10][7]));
            motus_run_destroy(r);
            forget(&a);
            forget(&b);
            motus_ensemble_destroy(blocks);
            motus_ensemble_destroy(singles);
        }
    }
    assert_true(methods > 8);
    assert_true(w.widest > 16);
    motus_system_destroy(s);
    motus_system_destroy(one);
}

/* Numbers that differ between trajectories, found by the trajectory's index in any block. */
static void trajectories_have_their_own_numbers(void **state)
{
    (void)state;
    static double values[NAMES][COUNT], stiffness[COUNT];
    const double *list[NAMES];
    const motus_record records[] = {{MOTUS_REDUCE_FINAL, 1}, {MOTUS_REDUCE_MEAN, 6}};
    spread(values, list);
    for (int i = 0; i < COUNT; i++) stiffness[i] = 1 + 0.01 * i;
    static const char *const methods[] = {"rk4", "gauss4"};
    for (int k = 0; k < 2; k++) {
        const size_t some = k ? 20 : COUNT;
        world w = {.stiffness = stiffness, .fail_at = -1};
        motus_system *s = given_callback(&w, IN_BLOCKS | ALONE);
        motus_ensemble_def def = define(records, 2, methods[k], 1, 4);
        motus_ensemble *e = given_ensemble(s, &def, "own numbers");
        outcome o = go(e, some, 2, list, "own numbers");
        for (size_t i = 0; i < some; i += 19) {
            world mine = {.stiffness = stiffness + i, .fail_at = -1};
            motus_system *one = given_callback(&mine, ALONE);
            motus_ensemble *f = given_ensemble(one, &def, "own numbers");
            const double *from[NAMES] = {&values[0][i], &values[1][i], &values[2][i]};
            outcome p = go(f, 1, 2, from, "own numbers");
            assert_true(same_number(o.at[0][i], p.at[0][0]) && same_number(o.at[1][i], p.at[1][0]));
            forget(&p);
            motus_ensemble_destroy(f);
            motus_system_destroy(one);
        }
        forget(&o);
        motus_ensemble_destroy(e);
        motus_system_destroy(s);
    }
}

/* Where ends differ as well, a block has one trajectory, and still its own index. */
static void trajectories_have_their_own_ends(void **state)
{
    (void)state;
    enum { SOME = 24 };
    static const char *const vary[] = {"until", "x[1](0.5)"}, *const methods[] = {"rk4", "verlet", "gauss4"};
    double stiffness[SOME], until[SOME], x[SOME];
    const double *list[] = {until, x};
    const motus_record records[] = {{MOTUS_REDUCE_FINAL, 1}, {MOTUS_REDUCE_MEAN, 6}};
    for (int i = 0; i < SOME; i++) {
        stiffness[i] = 1 + 0.1 * i;
        until[i] = 0.5 + 0.037 * (i * 7 % SOME - 5);
        x[i] = 0.3 - 0.01 * i;
    }
    for (size_t k = 0; k < sizeof methods / sizeof *methods; k++) {
        world w = {.stiffness = stiffness, .fail_at = 20, .answer = 1};
        motus_system *s = given_callback(&w, IN_BLOCKS | ALONE);
        motus_ensemble_def def = define(records, 2, methods[k], NAN, 3);
        def.vary = vary;
        def.vary_count = 2;
        motus_ensemble *e = given_ensemble(s, &def, methods[k]);
        outcome o = go(e, SOME, 2, list, methods[k]);
        for (int i = 0; i < SOME; i++) {
            world mine = {.stiffness = stiffness + i, .fail_at = -1};
            motus_system *one = given_callback(&mine, ALONE);
            motus_ensemble *f = given_ensemble(one, &def, methods[k]);
            const double *from[] = {&until[i], &x[i]};
            outcome p = go(f, 1, 2, from, methods[k]);
            assert_true(isnan(o.stopped[i]) == (i != 20));
            assert_true(i == 20 || (same_number(o.at[0][i], p.at[0][0]) && same_number(o.at[1][i], p.at[1][0])));
            forget(&p);
            motus_ensemble_destroy(f);
            motus_system_destroy(one);
        }
        forget(&o);
        motus_ensemble_destroy(e);
        motus_system_destroy(s);
    }
}

static void failures_end_their_own_trajectory(void **state)
{
    (void)state;
    static double values[NAMES][COUNT];
    const double *list[NAMES];
    motus_record records[2 * COLUMNS];
    const size_t count = record_all(records);
    spread(values, list);
    values[0][3] = 1e6;
    values[0][255] = 40;
    values[2][256] = INFINITY;
    values[0][COUNT - 1] = NAN;
    world w = {.fail_at = -1}, v = {.fail_at = -1};
    motus_system *s = given_callback(&w, IN_BLOCKS), *one = given_callback(&v, ALONE);
    motus_ensemble_def def = define(records, count, "rk4", 1.503, 2);
    motus_ensemble *blocks = given_ensemble(s, &def, "lost"), *singles = given_ensemble(one, &def, "lost");
    outcome a = go(blocks, COUNT, count, list, "lost"), b = go(singles, COUNT, count, list, "lost");
    same_outcome(&a, &b, "lost");
    for (size_t i = 0; i < COUNT; i++)
        assert_int_equal(isnan(a.stopped[i]), i != 3 && i != 255 && i != 256 && i != COUNT - 1);
    assert_true(a.stopped[256] == 0.5 && a.stopped[COUNT - 1] == 0.5 && a.stopped[255] > 0.5);
    motus_error err = motus_default_error();
    w.fail_at = 300;
    w.answer = -2;
    assert_int_equal(motus_ensemble_run(blocks, COUNT, list, a.at, NULL, &err), MOTUS_CALLBACK);
    assert_true(strstr(err.message, "callback") && err.time == 0.5 && err.returned == -2);
    /* A failed evaluation ends only its own trajectory. */
    w.answer = 1;
    outcome d = go(blocks, COUNT, count, list, "one cannot be evaluated");
    for (size_t i = 0; i < COUNT; i++) {
        assert_int_equal(isnan(d.stopped[i]), i != 3 && i != 255 && i != 256 && i != 300 && i != COUNT - 1);
        for (size_t r = 0; r < count; r++)
            assert_true(i == 300 ? isnan(d.at[r][i]) : same_number(d.at[r][i], b.at[r][i]));
    }
    assert_true(d.stopped[300] == 0.5);
    forget(&d);
    w.fail_at = -1;
    outcome c = go(blocks, COUNT, count, list, "again");
    same_outcome(&c, &b, "after a failure");
    forget(&a);
    forget(&b);
    forget(&c);
    motus_ensemble_destroy(blocks);
    motus_ensemble_destroy(singles);
    motus_system_destroy(s);
    motus_system_destroy(one);
}

/* Models, one trajectory at a time, by an implicit method: each thread has its own clone of the system. */
static void threads_of_models(void **state)
{
    (void)state;
    static const char text[] =
        "k = 1\nb = 0.1 k\nx'' = -k sin(x) - b x'^3\nx(0) = b\nx'(0) = 0\nq = k x^2\nstep 0.05\nuntil 3\n";
    static const char *const vary[] = {"k", "x'(0)"};
    enum { SOME = 50 };
    double k[SOME], v[SOME];
    const double *values[] = {k, v};
    for (int i = 0; i < SOME; i++) {
        k[i] = 1 + 0.03 * ((i * 7) % SOME);
        v[i] = i == 31 ? INFINITY : 0.1 * ((i * 11) % SOME);
    }
    motus_system *s = given_text(text);
    const motus_record records[] = {
        {MOTUS_REDUCE_FINAL, 1}, {MOTUS_REDUCE_MAX, column(s, "q")}, {MOTUS_REDUCE_TIME_OF_MIN, 2}};
    static const char *const machines[] = {"interpreter", "compiled"};
    for (int m = 0; m < 2; m++) {
        outcome first = {0};
        for (int threads = 1; threads <= 5; threads += 2) {
            motus_ensemble_def def = define(records, 3, "gauss4", 3, threads);
            def.vary = vary;
            def.vary_count = 2;
            def.machine = machines[m];
            motus_ensemble *e = given_ensemble(s, &def, "threads");
            assert_int_equal(motus_ensemble_now(e).threads, threads);
            assert_string_equal(motus_ensemble_now(e).machine, machines[m]);
            for (int round = 0; round < 2; round++) {
                outcome o = go(e, round ? 1 : SOME, 3, values, "threads");
                if (threads == 1 && round == 0) {
                    first = o;
                    continue;
                }
                for (size_t r = 0; r < 3; r++)
                    for (size_t i = 0; i < o.count; i++)
                        assert_true(same_number(o.at[r][i], first.at[r][i]) &&
                                    same_number(o.stopped[i], first.stopped[i]));
                forget(&o);
            }
            motus_ensemble_destroy(e);
        }
        assert_true(first.stopped[31] == 0 && isnan(first.stopped[30]));
        forget(&first);
    }
    motus_system_destroy(s);
}

/* As `given_observe`, but it counts failures, since cmocka must not leave a test from another thread. */
static int watch_quietly(void *context, double fraction)
{
    given_progress *w = context;
    if (!(fraction >= w->last && fraction <= 1)) w->calls = 1 << 20;
    w->last = fraction;
    return ++w->calls == w->cancel_at;
}

static void observed(void **state)
{
    (void)state;
    static double values[NAMES][COUNT];
    const double *list[NAMES];
    const motus_record records[] = {{MOTUS_REDUCE_FINAL, 1}};
    spread(values, list);
    for (int threads = 1; threads <= 3; threads++) {
        world w = {.fail_at = -1};
        motus_system *s = given_callback(&w, IN_BLOCKS);
        given_progress seen = {0, 3, 0};
        motus_ensemble_def def = define(records, 1, "rk4", 100, threads);
        def.step = 0.001;
        def.progress = watch_quietly;
        def.context = &seen;
        motus_ensemble *e = given_ensemble(s, &def, "observed");
        double result[COUNT], *at[] = {result};
        motus_error err = motus_default_error();
        assert_int_equal(motus_ensemble_run(e, COUNT, list, at, NULL, &err), MOTUS_CANCELLED);
        assert_int_equal(seen.calls, 3);
        motus_ensemble_destroy(e);
        motus_system_destroy(s);
    }
}

/* The driven oscillator by blocks and one by one. Counts the calls. */
static atomic_long calls;
static int driven(void *context, size_t first, size_t count, double t, const double *x, const double *v, double *a)
{
    const double *amplitude = (const double *)context + first, c = cos(t);
    (void)v;
    calls++;
    for (size_t j = 0; j < count; j++) a[j] = -x[j] + x[j] * x[j] * x[j] + amplitude[j] * c;
    return 0;
}

static int driven_alone(void *context, double t, const double *x, const double *v, double *a)
{
    return driven(context, 0, 1, t, x, v, a);
}

/* A block is one call of the caller's function, for a hundred trajectories and more. */
static void blocks_are_few_calls(void **state)
{
    (void)state;
    enum { COUNT_OF_ALL = 2048 };
    static double amplitude[COUNT_OF_ALL], x[2 * COUNT_OF_ALL], zero;
    static const char *const vary[] = {"x(0)"};
    const motus_record record = {MOTUS_REDUCE_FINAL, 1};
    const double *values[] = {x};
    double *at[] = {x + COUNT_OF_ALL};
    long of[2];
    for (int blocks = 0; blocks < 2; blocks++) {
        motus_callback_def def = motus_default_callback();
        motus_error err = motus_default_error();
        motus_system *s = NULL;
        def.positions = 1;
        def.x = def.v = &zero;
        def.acceleration = driven_alone;
        def.block = blocks ? driven : NULL;
        def.depends_on_velocity = 0;
        def.context = amplitude;
        must(motus_system_from_callback(&def, &s, &err), &err, "driven");
        motus_ensemble_def e_def = motus_default_ensemble();
        e_def.vary = vary;
        e_def.vary_count = 1;
        e_def.records = &record;
        e_def.record_count = 1;
        e_def.method = "velocity-verlet";
        e_def.step = 0.001;
        e_def.until = 0.1;
        motus_ensemble *e = given_ensemble(s, &e_def, "driven");
        calls = 0;
        must(motus_ensemble_run(e, COUNT_OF_ALL, values, at, NULL, &err), &err, "driven");
        of[blocks] = calls;
        motus_ensemble_destroy(e);
        motus_system_destroy(s);
    }
    print_message("%d trajectories, 100 steps: one by one %ld calls, in blocks %ld\n", COUNT_OF_ALL, of[0], of[1]);
    assert_true(of[0] >= 100 * COUNT_OF_ALL && 100 * of[1] < of[0]);
}

int main(void)
{
    open_shared_cache();
    const struct CMUnitTest tests[] = {cmocka_unit_test(blocks_are_trajectories),
                                       cmocka_unit_test(trajectories_have_their_own_numbers),
                                       cmocka_unit_test(trajectories_have_their_own_ends),
                                       cmocka_unit_test(failures_end_their_own_trajectory),
                                       cmocka_unit_test(threads_of_models),
                                       cmocka_unit_test(observed),
                                       cmocka_unit_test(blocks_are_few_calls)};
    int failed = cmocka_run_group_tests_name("blocks and threads", tests, NULL, NULL);
    close_cache();
    return failed;
}
