/* Ensembles with an accuracy: no accuracy is claimed that does not hold, a trajectory has the bits of a run with the
 * tolerance that was found for it, whatever it is computed with and beside, and what cannot be reached is said. */
#include "test/ensemble_given.h"

#include <stdbool.h>

enum { COUNT = 33, RECORDS = 4 };
#define PENDULUM "F = 1\nx'' = -0.1 x' - sin(x) + F cos(2 t/3)\nx(0) = 1.1\nx'(0) = 0\n"
#define UNTIL 25

static const motus_record records[RECORDS] = {
    {MOTUS_REDUCE_FINAL, 1}, {MOTUS_REDUCE_FINAL, 2}, {MOTUS_REDUCE_TOLERANCE, 0}, {MOTUS_REDUCE_ACCURACY, 0}};
static const char *const vary = "F";

typedef struct task {
    const char *method, *machine;
    double accuracy;
    int absolute, lanes, threads;
} task;

static motus_ensemble_def definition(const task *t)
{
    motus_ensemble_def def = motus_default_ensemble();
    def.vary = &vary;
    def.vary_count = 1;
    def.records = records;
    def.record_count = RECORDS;
    def.method = t->method;
    def.accuracy = t->accuracy;
    def.absolute = t->absolute;
    def.until = UNTIL;
    def.machine = t->machine;
    def.lanes = t->lanes;
    def.threads = t->threads;
    return def;
}

static void fill(double values[COUNT])
{
    for (int i = 0; i < COUNT; i++) values[i] = 0.5 + (double)(i * 7 % COUNT) / COUNT;
}

static outcome compute(motus_system *s, const task *t)
{
    double values[COUNT];
    const double *const list[] = {values};
    const motus_ensemble_def def = definition(t);
    fill(values);
    motus_ensemble *e = given_ensemble(s, &def, t->method);
    assert_true(motus_ensemble_now(e).accuracy == t->accuracy);
    if (t->lanes && motus_ensemble_now(e).lanes != t->lanes) fail_msg("%s: %s", t->method, motus_ensemble_now(e).note);
    outcome o = go(e, COUNT, RECORDS, list, t->method);
    motus_ensemble_destroy(e);
    return o;
}

static motus_run *run_of(motus_system *s, const char *method, double F, double tolerance, int absolute)
{
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    motus_error err = motus_default_error();
    must(motus_system_set(s, vary, &F, 1, &err), &err, vary);
    def.method = method;
    def.tolerance = tolerance;
    def.absolute = absolute;
    def.until = UNTIL;
    def.machine = "interpreter";
    must(motus_run_create(s, &def, &r, &err), &err, method);
    finish(r);
    return r;
}

/* The largest position and velocity on the way. */
typedef struct sizes {
    double x, v;
} sizes;

static int widen(void *context, motus_run *r)
{
    sizes *s = context;
    double x, v;
    if (motus_run_state(r, &x, &v, NULL) != MOTUS_OK) return 1;
    s->x = fmax(s->x, fabs(x)), s->v = fmax(s->v, fabs(v));
    return 0;
}

static motus_run *truth_of(motus_system *s, double F, sizes *size)
{
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    motus_error err = motus_default_error();
    *size = (sizes){1.1, 0};
    must(motus_system_set(s, vary, &F, 1, &err), &err, vary);
    def.method = "verner9", def.error = MOTUS_BARS_CHEAP, def.tolerance = 1e-14, def.longest_step = 0.1,
    def.until = UNTIL;
    def.machine = "interpreter", def.observer = widen, def.context = size;
    must(motus_run_create(s, &def, &r, &err), &err, "truth");
    finish(r);
    return r;
}

/* Whether tolerances differ tells that trajectories were searched for, each by itself. */
static void keeps(const task *t, const outcome *o, int *different)
{
    double values[COUNT];
    motus_system *s = given_text(PENDULUM);
    fill(values);
    for (int i = 0; i < COUNT; i++) {
        const double tolerance = o->at[2][i], reached = o->at[3][i];
        sizes size;
        *different += tolerance != o->at[2][0];
        if (!(reached <= t->accuracy))
            fail_msg("%s, F = %g: %g is claimed as %g", t->method, values[i], reached, t->accuracy);
        motus_run *r = run_of(s, t->method ? t->method : "dop853", values[i], tolerance, t->absolute);
        const double x = value(s, r, "x"), v = value(s, r, "x'");
        motus_run_destroy(r);
        if (!same_number(x, o->at[0][i]) || !same_number(v, o->at[1][i]))
            fail_msg("%s, F = %g: %a, and a run with the tolerance %g has %a", t->method, values[i], o->at[0][i],
                     tolerance, x);
        if (i % 4) continue;
        r = truth_of(s, values[i], &size);
        double best[2], bars[2];
        static const size_t columns[2] = {1, 2};
        motus_error err = motus_default_error();
        must(motus_run_errors(r, columns, 2, best, bars, &err), &err, "truth");
        const double of_x = t->absolute ? 1 : size.x, of_v = t->absolute ? 1 : size.v;
        if (!(fabs(x - best[0]) <= t->accuracy * of_x + bars[0] && fabs(v - best[1]) <= t->accuracy * of_v + bars[1]))
            fail_msg("%s, F = %g: off by %g and %g, and claimed to be below %g", t->method, values[i], x - best[0],
                     v - best[1], t->accuracy);
        motus_run_destroy(r);
    }
    motus_system_destroy(s);
}

static void no_false_claim(void **state)
{
    (void)state;
    const task tasks[] = {{"dopri5", "compiled", 1e-6, .lanes = 8},    {"dopri5", "interpreter", 1e-9, .lanes = 0},
                          {"dop853", "compiled", 1e-9, .threads = 2},  {NULL, NULL, 1e-8, .lanes = 0},
                          {"taylor", "interpreter", 1e-9, .lanes = 0}, {"tsit5", "compiled", 1e-7, .absolute = 1}};
    int different = 0;
    for (size_t k = 0; k < sizeof tasks / sizeof *tasks; k++) {
        motus_system *s = given_text(PENDULUM);
        outcome o = compute(s, &tasks[k]);
        keeps(&tasks[k], &o, &different);
        forget(&o);
        motus_system_destroy(s);
    }
    if (different < COUNT) fail_msg("only %d trajectories have a tolerance of their own", different);
}

/* The same trajectories alone, in two calls, and beside others; by lanes and threads, and by the interpreter. */
static void depends_on_nothing_else(void **state)
{
    (void)state;
    double values[COUNT];
    const double *const all[] = {values};
    const task tasks[] = {{"dopri5", "interpreter", 1e-9, .threads = 1},
                          {"dopri5", "compiled", 1e-9, .lanes = 8, .threads = 2}};
    motus_system *s = given_text(PENDULUM);
    fill(values);
    outcome one = compute(s, &tasks[0]), two = compute(s, &tasks[1]);
    same_outcome(&one, &two, "in lanes and by the interpreter");
    const motus_ensemble_def def = definition(&tasks[1]);
    motus_ensemble *e = given_ensemble(s, &def, "in parts");
    for (size_t first = 0, part = 1; first < COUNT; first += part, part += 5) {
        const size_t count = first + part < COUNT ? part : COUNT - first;
        const double *const list[] = {all[0] + first};
        outcome o = go(e, count, RECORDS, list, "in parts");
        for (size_t i = 0; i < count; i++)
            for (size_t r = 0; r < RECORDS; r++)
                if (!same_number(o.at[r][i], one.at[r][first + i]))
                    fail_msg("trajectory %zu is another one among %zu", first + i, count);
        forget(&o);
    }
    motus_ensemble_destroy(e);
    forget(&one);
    forget(&two);
    motus_system_destroy(s);
}

/* All are computed, and each is the best that was tried. */
static void what_cannot_be_reached(void **state)
{
    (void)state;
    double values[COUNT];
    const double *const list[] = {values};
    const task t = {"dop853", "interpreter", 1e-15, .threads = 1},
               rough = {"dop853", "interpreter", 1e-8, .threads = 1};
    motus_system *s = given_text(PENDULUM);
    motus_error err = motus_default_error();
    const motus_ensemble_def def = definition(&t);
    motus_ensemble *e = given_ensemble(s, &def, "too much");
    outcome o = room_for(COUNT, RECORDS), bound = compute(s, &rough);
    fill(values);
    assert_int_equal(motus_ensemble_run(e, COUNT, list, o.at, o.stopped, &err), MOTUS_ACCURACY);
    if (!strstr(err.message, "the accuracy 1e-15 is not reached by 33 of 33 trajectories, the first of them 0"))
        fail_msg("%s", err.message);
    for (int i = 0; i < COUNT; i++)
        if (!(o.at[3][i] > 1e-15 && o.at[3][i] < 1e-8 && o.at[3][i] <= bound.at[3][i] && isnan(o.stopped[i])))
            fail_msg("trajectory %d has reached %g, with the accuracy 1e-8 %g", i, o.at[3][i], bound.at[3][i]);
    motus_ensemble_destroy(e);
    forget(&o);
    forget(&bound);
    motus_system_destroy(s);
}

static void refused(const char *text, const motus_ensemble_def *def, const char *why)
{
    motus_error err = motus_default_error();
    motus_ensemble *e = NULL;
    motus_system *s = given_text(text);
    assert_int_equal(motus_ensemble_create(s, def, &e, &err), MOTUS_ARGUMENT);
    if (!strstr(err.message, why)) fail_msg("%s", err.message);
    assert_null(e);
    motus_system_destroy(s);
}

static void wrong(void **state)
{
    (void)state;
    const task t = {"dop853", "interpreter", 1e-6, .lanes = 0};
    motus_ensemble_def def = definition(&t);
    def.tolerance = 1e-7;
    refused(PENDULUM, &def, "an accuracy and a tolerance are given");
    def.tolerance = NAN, def.step = 0.1;
    refused(PENDULUM, &def, "a step and an accuracy are given");
    def.step = NAN, def.method = "verlet";
    refused(PENDULUM, &def, "the steps of verlet have one size");
    def.method = NULL;
    refused(PENDULUM "accuracy 1e-6; step 0.1\n", &def, "a step and an accuracy are given");
    static const double outside[] = {0, -1e-6, INFINITY, 1, 9e-16};
    for (size_t k = 0; k < sizeof outside / sizeof *outside; k++) {
        def.accuracy = outside[k];
        refused(PENDULUM, &def, k < 3 ? "an accuracy is a positive number" : "the relative accuracy");
    }
}

/* What the model says counts where the caller says nothing, and errors are told where they are asked for. */
static void whose(void **state)
{
    (void)state;
    double F = 1, error[RECORDS], result[RECORDS];
    double *errors[RECORDS], *results[RECORDS];
    const double *const list[] = {&F};
    for (int k = 0; k < RECORDS; k++) errors[k] = &error[k], results[k] = &result[k];
    const task t = {NULL, "interpreter", NAN, .lanes = 0};
    motus_ensemble_def def = definition(&t);
    motus_error err = motus_default_error();
    motus_system *s = given_text(PENDULUM "method tsit5; accuracy 1e-5 absolute\n");
    motus_ensemble *e = given_ensemble(s, &def, "the model's");
    const motus_ensemble_statistics now = motus_ensemble_now(e);
    assert_true(now.accuracy == 1e-5 && now.tolerance == 1e-6 && now.absolute);
    assert_string_equal(now.method, "tsit5");
    assert_int_equal(motus_ensemble_run_errors(e, 1, list, results, errors, NULL, &err), MOTUS_ARGUMENT);
    motus_ensemble_destroy(e);
    def.tolerance = 1e-4;
    e = given_ensemble(s, &def, "the caller's tolerance");
    assert_true(isnan(motus_ensemble_now(e).accuracy) && motus_ensemble_now(e).tolerance == 1e-4);
    motus_ensemble_destroy(e);
    def.tolerance = NAN, def.accuracy = 1e-7, def.error = MOTUS_BARS_CHEAP;
    e = given_ensemble(s, &def, "the caller's accuracy");
    must(motus_ensemble_run_errors(e, 1, list, results, errors, NULL, &err), &err, "errors");
    assert_true(error[0] > 0 && error[0] <= 1e-7 * 10 && result[3] <= 1e-7);
    motus_ensemble_destroy(e);
    motus_system_destroy(s);
}

/* A motion that rests at 0 until a force begins, at a time that decimals round: a run and each trajectory keep their
 * accuracy. */
static void rest_before_a_force_begins(void **state)
{
    (void)state;
    static const char *const methods[] = {"dop853", "dopri5", "tsit5", "verner7", "radau15"};
    motus_system *s = given_text("k = 0.2\nx'' = if(t > 0.149129, -k (t - 0.149129), 0)\nx(0) = 0; x'(0) = 0\n");
    for (size_t m = 0; m < sizeof methods / sizeof *methods; m++) {
        const char *const name = "k";
        const double values[] = {0.2, 0.3}, *const list[] = {values}, way = 2 - 0.149129;
        motus_ensemble_def def = motus_default_ensemble();
        def.vary = &name, def.vary_count = 1, def.records = records, def.record_count = RECORDS;
        def.method = methods[m], def.accuracy = 1e-6, def.until = 2, def.switches = MOTUS_SWITCHES_LOCATE;
        motus_ensemble *e = given_ensemble(s, &def, methods[m]);
        outcome o = go(e, 2, RECORDS, list, methods[m]);
        for (size_t i = 0; i < 2; i++) {
            assert_true(fabs(o.at[0][i] + values[i] * way * way * way / 6) < 1e-8);
            if (!(o.at[3][i] <= 1e-6)) fail_msg("%s: %g", methods[m], o.at[3][i]);
        }
        forget(&o);
        motus_ensemble_destroy(e);
    }
    motus_system_destroy(s);
}

int main(void)
{
    open_shared_cache();
    const struct CMUnitTest tests[] = {cmocka_unit_test(no_false_claim),
                                       cmocka_unit_test(depends_on_nothing_else),
                                       cmocka_unit_test(what_cannot_be_reached),
                                       cmocka_unit_test(wrong),
                                       cmocka_unit_test(whose),
                                       cmocka_unit_test(rest_before_a_force_begins)};
    const int failed = cmocka_run_group_tests_name("ensembles with an accuracy", tests, NULL, NULL);
    close_cache();
    return failed;
}
