/* An ensemble that begins in the interpreter while a compiler works has the interpreter's bits, before whichever
 * trajectory it goes over, to lanes or to compiled workers; and what becomes of the compiler. */
#include "api/ensemble/ensemble.h"
#include "test/ensemble_given.h"
#include "test/later.h"

#define PENDULUM \
    "g = 0.1\nF = 1\nx'' = -g x' - sin(x) + F cos(2 t/3)\nx(0) = 1\nx'(0) = 0\nuntil 6\nenergy = x'^2/2 - cos(x)\n"
#define BLOWS_UP "g = 0.1\nF = 1\nx'' = g x' + F x^3\nx(0) = 1\nx'(0) = 0\nuntil 6\nenergy = x'^2/2\n"
#define CHAIN                                                                                                      \
    "N = 5\ng = 1\nF = 1\nx[i]'' = g (x[i-1] - 2 x[i] + x[i+1]) - F x[i]^3   for i = 1..N\nx[0] = 0\nx[N+1] = 0\n" \
    "x[i](0) = 1/i   for i = 1..N\nx[i]'(0) = 0   for i = 1..N\nenergy = x[1]^2\nuntil 4\n"

enum { COUNT = 9, RECORDS = 4 };

typedef struct task {
    const char *text, *method;
    double step;
    bool ends, errors;
    int threads, lanes;
} task;

static double forces[COUNT], frictions[COUNT], untils[COUNT];
static const double *const values[] = {forces, frictions, untils};

typedef struct told {
    double numbers[RECORDS][COUNT], errors[RECORDS][COUNT], stopped[COUNT];
} told;

static motus_ensemble *create(motus_system *s, const task *t, const char *machine, const motus_record *records,
                              size_t count)
{
    static const char *const names[] = {"F", "g", "until"};
    motus_ensemble_def def = motus_default_ensemble();
    def.vary = names, def.vary_count = t->ends ? 3 : 2;
    def.records = records, def.record_count = count;
    def.method = t->method, def.machine = machine;
    if (isnan(t->step))
        def.tolerance = 1e-7;
    else
        def.step = t->step;
    def.threads = t->threads, def.lanes = t->lanes, def.error = t->errors ? MOTUS_BARS_CHEAP : MOTUS_BARS_NONE;
    return given_ensemble(s, &def, t->method);
}

/* before: trajectories that the interpreter computes first; -1: it computes all. */
static told go_over(const task *t, int before)
{
    static told o;
    motus_error err = motus_default_error();
    motus_system *s = given_text(t->text);
    const motus_record records[RECORDS] = {{MOTUS_REDUCE_FINAL, 1},
                                           {MOTUS_REDUCE_MAX, 2},
                                           {MOTUS_REDUCE_MEAN, column(s, "energy")},
                                           {MOTUS_REDUCE_STEPS, 0}};
    motus_ensemble *e = create(s, t, before < 0 ? "interpreter" : "auto", records, RECORDS);
    double *numbers[RECORDS], *errors[RECORDS];
    for (int r = 0; r < RECORDS; r++) numbers[r] = o.numbers[r], errors[r] = o.errors[r];
    if (before >= 0) ensemble_later_at(e, (size_t)before);
    if (before >= 0) assert_string_equal(motus_ensemble_now(e).machine, "interpreter");
    memset(&o, 0, sizeof o);
    must(t->errors ? motus_ensemble_run_errors(e, COUNT, values, numbers, errors, o.stopped, &err)
                   : motus_ensemble_run(e, COUNT, values, numbers, o.stopped, &err),
         &err, t->method);
    if (motus_ensemble_now(e).compiled_from != (before < COUNT ? before : -1))
        fail_msg("%s: compiled from %d, not %d", t->method, (int)motus_ensemble_now(e).compiled_from, before);
    assert_string_equal(motus_ensemble_now(e).machine, before < 0 || before >= COUNT ? "interpreter" : "compiled");
    motus_ensemble_destroy(e);
    motus_system_destroy(s);
    return o;
}

static void same(const told *a, const told *b, const task *t, int before)
{
    for (int k = 0; k < COUNT; k++) {
        bool alike = same_number(a->stopped[k], b->stopped[k]);
        for (int r = 0; r < RECORDS; r++)
            alike = alike && same_number(a->numbers[r][k], b->numbers[r][k]) &&
                    same_number(a->errors[r][k], b->errors[r][k]);
        if (!alike) fail_msg("%s: trajectory %d differs where %d were interpreted", t->method, k, before);
    }
}

static void before_every_trajectory(void **unused)
{
    (void)unused;
    static const task tasks[] = {
        {PENDULUM, "rk4", 0.05, false, false, 1, 4},     {PENDULUM, "verlet", 0.07, false, true, 2, 2},
        {PENDULUM, "kahan-li8", 0.1, true, false, 2, 4}, {PENDULUM, "dopri5", NAN, false, true, 1, 4},
        {BLOWS_UP, "rk4", 0.01, false, false, 2, 4},     {CHAIN, "gauss4", 0.1, true, true, 2, 0},
        {CHAIN, "gauss4", 0.1, false, false, 1, 0}};
    for (size_t i = 0; i < sizeof tasks / sizeof *tasks; i++) {
        const told expected = go_over(&tasks[i], -1);
        for (int before = 0; before <= COUNT; before++) {
            const told got = go_over(&tasks[i], before);
            same(&expected, &got, &tasks[i], before);
        }
    }
}

/* ---- compilers ---- */

/* Long trajectories, so that a compiler ends within one. */
enum { MANY = 40 };
static const task slow = {PENDULUM, "rk4", 1e-4, false, false, 2, 0};
static double many[3][MANY];
static const double *const all[] = {many[0], many[1], many[2]};
static const motus_record last = {MOTUS_REDUCE_FINAL, 1};

static outcome whole(motus_ensemble *e) { return go(e, MANY, 1, all, "slow"); }

static const outcome *known(void)
{
    static outcome o;
    if (o.count) return &o;
    motus_system *s = given_text(slow.text);
    motus_ensemble *e = create(s, &slow, "interpreter", &last, 1);
    o = whole(e);
    motus_ensemble_destroy(e);
    motus_system_destroy(s);
    return &o;
}

static void the_compiler_is_slow(void **unused)
{
    (void)unused;
    known();
    compile_by("sleep 0.1\nexec cc \"$@\"");
    motus_system *s = given_text(slow.text);
    for (int i = 0; i < 2; i++) { /* the second finds the object */
        motus_ensemble *e = create(s, &slow, "auto", &last, 1);
        assert_int_equal(motus_ensemble_now(e).compiled_from, i ? 0 : -1);
        while (motus_ensemble_now(e).compiled_from < 0) {
            outcome o = whole(e);
            same_outcome(&o, known(), "slow");
            forget(&o);
        }
        assert_true(motus_ensemble_now(e).lanes > 1);
        if (!i) assert_true(motus_ensemble_now(e).compiled_from > 0);
        outcome o = whole(e);
        same_outcome(&o, known(), "slow");
        forget(&o);
        motus_ensemble_destroy(e);
        nothing_is_left("slow");
    }
    motus_system_destroy(s);
}

static void ends_in_the_interpreter(const char *note)
{
    motus_system *s = given_text(slow.text);
    motus_ensemble *e = create(s, &slow, "auto", &last, 1);
    while (!*motus_ensemble_now(e).note) {
        outcome o = whole(e);
        same_outcome(&o, known(), note);
        forget(&o);
    }
    outcome o = whole(e);
    same_outcome(&o, known(), note);
    forget(&o);
    assert_string_equal(motus_ensemble_now(e).machine, "interpreter");
    assert_int_equal(motus_ensemble_now(e).compiled_from, -1);
    if (!strstr(motus_ensemble_now(e).note, note)) fail_msg("%s: the note is \"%s\"", note, motus_ensemble_now(e).note);
    motus_ensemble_destroy(e);
    motus_system_destroy(s);
    nothing_is_left(note);
}

static void the_compiler_fails(void **unused)
{
    (void)unused;
    compile_by("echo no licence\nexit 1");
    ends_in_the_interpreter("no licence");
    compile_by("kill -9 $$");
    ends_in_the_interpreter("it stopped without a message");
    setenv("CC", "/nosuch", 1);
    ends_in_the_interpreter("CC is \"/nosuch\"");
}

static int stop(void *context, double fraction)
{
    (void)context, (void)fraction;
    return 1;
}

/* The ensemble is given back, or cancelled, while its compiler works. */
static void the_compiler_hangs(void **unused)
{
    (void)unused;
    static const char *const names[] = {"F", "g"};
    for (int cancelled = 0; cancelled < 2; cancelled++) {
        compile_for_ever();
        motus_system *s = given_text(slow.text);
        motus_ensemble_def def = motus_default_ensemble();
        motus_error err = motus_default_error();
        def.vary = names, def.vary_count = 2, def.records = &last, def.record_count = 1;
        def.method = "rk4", def.step = 1e-4, def.progress = cancelled ? stop : NULL, def.machine = "auto";
        motus_ensemble *e = given_ensemble(s, &def, "hangs");
        const pid_t child = its_child();
        outcome o = room_for(MANY, 1);
        const motus_status status = motus_ensemble_run(e, MANY, all, o.at, o.stopped, &err);
        assert_int_equal(status, cancelled ? MOTUS_CANCELLED : MOTUS_OK);
        if (!cancelled) same_outcome(&o, known(), "hangs");
        forget(&o);
        assert_int_equal(kill(child, 0), 0);
        motus_ensemble_destroy(e);
        assert_true(dead(child));
        motus_system_destroy(s);
        nothing_is_left("hangs");
    }
}

/* Few trajectories start no compiler; the interpreter none; and where the bits depend on it, it is waited for. */
static void who_starts_a_compiler(void **unused)
{
    (void)unused;
    static const char *const names[] = {"F", "g"};
    static const struct {
        const char *machine;
        uint64_t expected;
        int fast, calls;
        const char *at_first;
    } cases[] = {{"auto", 5, 0, 0, "interpreter"},
                 {NULL, 0, 0, 0, "interpreter"},
                 {"interpreter", 0, 0, 0, "interpreter"},
                 {"auto", 0, 1, 1, "compiled"},
                 {"compiled", 5, 0, 1, "compiled"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        compile_and_count("sleep 0.05");
        motus_system *s = given_text(PENDULUM);
        motus_ensemble_def def = motus_default_ensemble();
        def.vary = names, def.vary_count = 2, def.records = &last, def.record_count = 1, def.method = "rk4";
        def.step = 0.01, def.machine = cases[i].machine, def.expected = cases[i].expected, def.fast = cases[i].fast;
        motus_ensemble *e = given_ensemble(s, &def, "who");
        assert_string_equal(motus_ensemble_now(e).machine, cases[i].at_first);
        outcome o = go(e, COUNT, 1, values, "who");
        forget(&o);
        assert_string_equal(motus_ensemble_now(e).machine, cases[i].at_first);
        assert_int_equal(calls(), cases[i].calls);
        motus_ensemble_destroy(e);
        motus_system_destroy(s);
        nothing_is_left("who");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(before_every_trajectory), cmocka_unit_test(the_compiler_is_slow),
        cmocka_unit_test(the_compiler_fails),      cmocka_unit_test(the_compiler_hangs),
        cmocka_unit_test(who_starts_a_compiler),
    };
    for (int k = 0; k < COUNT; k++)
        forces[k] = 0.5 + 0.05 * k, frictions[k] = 0.01 * (k + 1), untils[k] = 0.61 * (k * 4 % COUNT);
    for (int k = 0; k < MANY; k++) many[0][k] = 0.5 + 0.01 * k, many[1][k] = 0.01 * (k + 1);
    open_cache();
    if (!mkdtemp(tools)) return 1;
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    forget((outcome *)(uintptr_t)known());
    remove_tools();
    close_cache();
    return failed;
}
