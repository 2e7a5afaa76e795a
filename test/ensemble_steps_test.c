/* What an ensemble records of its steps is what a run with the same numbers says of its own: in lanes and one
 * trajectory at a time, with any number of lanes and threads, where steps adapt and where ends differ. */
#include "test/ensemble_given.h"

#include <stdbool.h>

#define PENDULUM "g = 0.1\nF = 1\nx'' = -g x' - sin(x) + F cos(2 t/3)\nx(0) = 1\nx'(0) = 0\nuntil 6\n"
#define CUBIC "F = 1\nx'' = -x - x^3 + F\nx(0) = 1\nx'(0) = 0\nuntil 6\n"
/* smooth on both sides of 0, so that a Taylor series, too, refuses candidates */
#define KINKED "F = 1\nx'' = -x - 3 max(x, 0) - 0.1 F x'\nx(0) = 1\nx'(0) = 0\nuntil 6\n"
#define TOLERANCE 1e-7

enum { COUNT = 21, MIDDLE = 13 }; /* MIDDLE: its end is in the middle of the ends */
enum { LONGEST, FINAL, STEPS, REFUSED, SHORTEST, MOST, EVALUATIONS, RECORDS };
static const motus_record records[RECORDS] = {
    [LONGEST] = {MOTUS_REDUCE_LONGEST_STEP, 0},
    [FINAL] = {MOTUS_REDUCE_FINAL, 1},
    [STEPS] = {MOTUS_REDUCE_STEPS, 0},
    [REFUSED] = {MOTUS_REDUCE_REFUSED, 0},
    [SHORTEST] = {MOTUS_REDUCE_SHORTEST_STEP, 0},
    [MOST] = {MOTUS_REDUCE_MAX, 1},
    [EVALUATIONS] = {MOTUS_REDUCE_EVALUATIONS, 0},
};

typedef struct task {
    const char *text, *method;
    double step;     /* NaN: steps adapt */
    bool ends;       /* every trajectory has its own */
    int64_t most;    /* steps of a trajectory; 0: any number */
    size_t recorded; /* of the records, the last one where the evaluations do not follow from the steps */
    double force[COUNT], until[COUNT];
} task;

static void fill(task *t)
{
    for (size_t i = 0; i < COUNT; i++) {
        t->force[i] = 0.5 + 0.05 * (double)(i * 5 % COUNT);
        t->until[i] = 0.3 * (double)(i * 4 % COUNT); /* one ends where it starts */
    }
}

static outcome by_ensemble(const task *t, const char *machine, int lanes, int threads)
{
    static const char *const names[] = {"F", "until"};
    const double *const values[] = {t->force, t->until};
    motus_system *s = given_text(t->text);
    motus_ensemble_def def = motus_default_ensemble();
    def.vary = names;
    def.vary_count = t->ends ? 2 : 1;
    def.records = records;
    def.record_count = t->recorded;
    def.method = t->method;
    def.step = t->step;
    def.tolerance = isnan(t->step) ? TOLERANCE : NAN;
    def.most_steps = t->most;
    def.machine = machine;
    def.lanes = lanes;
    def.threads = threads;
    motus_ensemble *e = given_ensemble(s, &def, t->method);
    if (lanes > 1 && motus_ensemble_now(e).lanes != lanes) fail_msg("%s: %s", t->method, motus_ensemble_now(e).note);
    outcome o = go(e, COUNT, t->recorded, values, t->method);
    motus_ensemble_destroy(e);
    motus_system_destroy(s);
    return o;
}

/* Of a trajectory that its run does not end either. */
static void as_stopped(const task *t, const outcome *o, size_t i, motus_run *r)
{
    motus_error err = motus_default_error();
    assert_int_equal(motus_run_finish(r, &err), MOTUS_STEPS);
    assert_int_equal(motus_run_steps(r), t->most);
    assert_true(err.time == motus_run_time(r) && o->stopped[i] == err.time);
    for (size_t k = 0; k < t->recorded; k++) assert_true(isnan(o->at[k][i]));
}

static void as_runs(const task *t, const outcome *o)
{
    motus_system *s = given_text(t->text);
    for (size_t i = 0; i < COUNT; i++) {
        motus_run_def def = motus_default_run();
        motus_run *r = NULL;
        motus_error err = motus_default_error();
        must(motus_system_set(s, "F", &t->force[i], 1, &err), &err, "F");
        def.method = t->method;
        def.step = t->step;
        def.tolerance = isnan(t->step) ? TOLERANCE : NAN;
        def.until = t->ends ? t->until[i] : NAN;
        def.most_steps = t->most;
        def.machine = "interpreter";
        must(motus_run_create(s, &def, &r, &err), &err, t->method);
        if (t->most && !isnan(o->stopped[i])) {
            as_stopped(t, o, i, r);
            motus_run_destroy(r);
            continue;
        }
        finish(r);
        const motus_run_statistics told = motus_run_now(r);
        const double expected[RECORDS] = {
            [LONGEST] = told.longest_step,           [FINAL] = value(s, r, "x"),      [STEPS] = (double)told.steps,
            [REFUSED] = (double)told.refused,        [SHORTEST] = told.shortest_step, [MOST] = o->at[MOST][i],
            [EVALUATIONS] = (double)told.evaluations};
        for (size_t k = 0; k < t->recorded; k++)
            if (!same_number(expected[k], o->at[k][i]))
                fail_msg("%s, trajectory %zu, record %zu: %.17g; a run says %.17g", t->method, i, k, o->at[k][i],
                         expected[k]);
        motus_run_destroy(r);
    }
    motus_system_destroy(s);
}

static void compare(task *t, bool lanes)
{
    fill(t);
    outcome plain = by_ensemble(t, "interpreter", 0, 1);
    as_runs(t, &plain);
    for (int k = 0; lanes && k < 3; k++) {
        outcome o = by_ensemble(t, "compiled", 4 << k, 1 + k % 2);
        same_outcome(&plain, &o, t->method);
        forget(&o);
    }
    forget(&plain);
}

static void adaptive_rows(void **state)
{
    static const char *const compiled[] = {"bs32", "dopri5", "dop853", "dep6", "fine4", "verner7", "taylor"};
    (void)state;
    int64_t rows = 0;
    motus_system *both[] = {given_text(PENDULUM), given_text(CUBIC)};
    for (size_t k = 0; k < motus_method_count(); k++) {
        const motus_method *card = motus_method_at(k);
        if (!card->adaptive) continue;
        bool lanes = false;
        for (size_t i = 0; i < sizeof compiled / sizeof *compiled; i++) lanes |= !strcmp(card->name, compiled[i]);
        for (int i = 0; i < 2; i++) {
            task t = {.text = i ? CUBIC : PENDULUM, .method = card->name, .step = NAN, .ends = i, .recorded = RECORDS};
            if (motus_method_admits(both[i], card->name, NULL) == MOTUS_OK) compare(&t, lanes), rows++;
        }
    }
    /* steps that end at switches, one trajectory at a time */
    static const char *const locating[] = {"taylor", "dop853", "radau15"};
    for (size_t k = 0; k < sizeof locating / sizeof *locating; k++) {
        task kinked = {.text = KINKED, .method = locating[k], .step = NAN, .ends = k == 1, .recorded = RECORDS};
        compare(&kinked, false);
        outcome plain = by_ensemble(&kinked, "interpreter", 0, 1), o = by_ensemble(&kinked, "compiled", 0, 2);
        same_outcome(&plain, &o, kinked.method);
        forget(&plain);
        forget(&o);
    }
    assert_true(rows > 20);
    motus_system_destroy(both[0]);
    motus_system_destroy(both[1]);
}

/* Some trajectories come to their ends, one of them by its last allowed step; the others stop after it. */
static void the_most_steps(void **state)
{
    static const char *const methods[] = {"dopri5", "radau15", "taylor"};
    (void)state;
    for (size_t m = 0; m < sizeof methods / sizeof *methods; m++)
        for (int ends = 0; ends < 2; ends++) {
            task t = {.text = PENDULUM, .method = methods[m], .step = NAN, .ends = ends, .recorded = EVALUATIONS};
            fill(&t);
            outcome free_of_it = by_ensemble(&t, "interpreter", 0, 1);
            t.most = (int64_t)free_of_it.at[STEPS][MIDDLE];
            outcome o = by_ensemble(&t, "interpreter", 0, 1);
            size_t stopped = 0;
            for (size_t i = 0; i < COUNT; i++) {
                const bool due = free_of_it.at[STEPS][i] > (double)t.most;
                stopped += due;
                assert_int_equal(!isnan(o.stopped[i]), due);
            }
            assert_true(!ends || (stopped > 0 && stopped < COUNT));
            forget(&o);
            forget(&free_of_it);
            compare(&t, true);
        }
}

/* The evaluations of rows of fixed step are counted one trajectory at a time. */
static void fixed_steps(void **state)
{
    (void)state;
    task t = {.text = PENDULUM, .method = "rk4", .step = 0.07, .recorded = EVALUATIONS};
    compare(&t, true);
    t.ends = true;
    compare(&t, true);
    t.recorded = RECORDS;
    compare(&t, false);
    t = (task){.text = CUBIC, .method = "verlet", .step = 0.05, .recorded = EVALUATIONS};
    compare(&t, true);
}

int main(void)
{
    open_shared_cache();
    const struct CMUnitTest tests[] = {cmocka_unit_test(adaptive_rows), cmocka_unit_test(the_most_steps),
                                       cmocka_unit_test(fixed_steps)};
    const int failed = cmocka_run_group_tests_name("steps of ensembles", tests, NULL, NULL);
    close_cache();
    return failed;
}
