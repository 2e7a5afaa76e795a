/* Runs with events that fail or are cancelled: what the error says, where it says it was, and how the run goes on. */
#include "given.h"

/* ---- callbacks that fail ---- */

typedef struct refusal {
    int functions, action, acceleration; /* what each returns from t = 1 on */
} refusal;

static int fall(void *ctx, double t, const double *x, const double *v, double *a)
{
    const refusal *r = ctx;
    (void)x, (void)v;
    a[0] = -1;
    return t >= 1 ? r->acceleration : 0;
}

static int height(void *ctx, double t, const double *x, const double *v, double *values)
{
    const refusal *r = ctx;
    (void)v;
    values[0] = x[0];
    return t >= 1 ? r->functions : 0;
}

static int bounce(void *ctx, size_t event, double t, double *x, double *v)
{
    const refusal *r = ctx;
    (void)event, (void)t, (void)x;
    v[0] = -v[0];
    return r->action;
}

/* It falls from 1, and is at 0 at t = sqrt(2). */
static motus_error failure_of(const refusal *of)
{
    const double x = 1, v = 0;
    const motus_event_def event = {.name = "bounce", .direction = -1, .assigns = 1};
    motus_callback_def def = motus_default_callback();
    motus_run_def run = motus_default_run();
    motus_error err = motus_default_error();
    motus_system *s = NULL;
    motus_run *r = NULL;
    def.positions = 1;
    def.x = &x, def.v = &v;
    def.acceleration = fall;
    def.context = (void *)of;
    def.events = &event;
    def.event_count = 1;
    def.event_functions = height;
    def.event_action = bounce;
    must(motus_system_from_callback(&def, &s, &err), &err, "system");
    run.method = "rk4";
    run.step = 0.25;
    run.until = 3;
    must(motus_run_create(s, &run, &r, &err), &err, "run");
    assert_int_equal(motus_run_finish(r, &err), MOTUS_CALLBACK);
    motus_run_destroy(r);
    motus_system_destroy(s);
    return err;
}

static void callbacks_that_fail(void **state)
{
    (void)state;
    const motus_error action = failure_of(&(refusal){.action = 9});
    assert_int_equal(action.returned, 9);
    assert_true(fabs(action.time - sqrt(2)) < 1e-12);
    assert_non_null(strstr(action.message, "event_action callback reported a failure"));
    const motus_error functions = failure_of(&(refusal){.functions = 7});
    assert_int_equal(functions.returned, 7);
    assert_true(functions.time >= 1 && functions.time <= 1.25);
    assert_non_null(strstr(functions.message, "event_functions callback reported a failure"));
    assert_int_equal(failure_of(&(refusal){.acceleration = -3}).returned, -3);
}

/* ---- many events in one step ---- */

static int cancel(void *ctx, double fraction)
{
    int *const left = ctx;
    (void)fraction;
    return *left > 0 && --*left == 0;
}

#define TICKS "x'' = 0\nx(0) = 0\nx'(0) = 1\nwhen every 1e-5 as tick: record\n"

/* The step leads from 0 to 2: 200000 ticks. A run that was cancelled among them stands at one of them, knows those
 * before it, and has all of them once when it goes on. */
static void cancelled_within_a_step(void **state)
{
    (void)state;
    static const char *const methods[] = {"rk4", "dop853"};
    for (size_t k = 0; k < 2; k++) {
        motus_error err = motus_default_error();
        motus_run_def def = motus_default_run();
        motus_system *s = given_text(TICKS);
        motus_run *r = NULL;
        motus_event_row row = motus_default_event_row();
        int left = 2;
        const char *text;
        size_t length;
        def.method = methods[k];
        if (given_adaptive(methods[k]))
            def.tolerance = 1e-9;
        else
            def.step = 2;
        def.until = 2;
        def.machine = "interpreter";
        def.progress = cancel;
        def.context = &left;
        must(motus_run_create(s, &def, &r, &err), &err, "run");
        while (motus_run_step(r, 1, &err) == MOTUS_OK) assert_false(motus_run_done(r));
        assert_int_equal(err.status, MOTUS_CANCELLED);
        const int64_t so_far = motus_run_events(r);
        const double t = motus_run_time(r);
        assert_true(so_far > 0 && so_far < 200000);
        assert_int_equal(motus_run_event(r, so_far - 1, &row), MOTUS_OK);
        assert_true(fabs(t - row.time) <= 1e-15);
        assert_true(fabs(value(s, r, "x") - t) <= 1e-12);
        must(motus_run_save(r, &text, &length, &err), &err, "save");
        must(motus_run_finish(r, &err), &err, "finish");
        assert_int_equal(motus_run_events(r), 200000);
        assert_int_equal(motus_run_event(r, 199999, &row), MOTUS_OK);
        assert_int_equal(row.count, 200000);
        assert_true(row.time == 2);
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

#define PAIRS                                                                                    \
    "u[i]'' = -u[i] for i = 1..64\nu[i](0) = sin(i) for i = 1..64\nu[i]'(0) = 0 for i = 1..64\n" \
    "when u[i] = u[j] as meet: record for i = 1..64, j = i+1..64\n"

/* All pairs meet in one instant. The caller is asked while their places are sought, and none is lost. */
static void cancelled_while_places_are_sought(void **state)
{
    (void)state;
    static const char *const methods[] = {"rk4", "dop853"};
    for (size_t k = 0; k < 2; k++) {
        motus_error err = motus_default_error();
        motus_run_def def = motus_default_run();
        motus_system *s = given_text(PAIRS);
        motus_run *r = NULL;
        int left = 3; /* the caller is asked 20 times a second, and the places take half a second at least */
        def.method = methods[k];
        if (k == 0) def.step = 2;
        def.until = 2;
        def.machine = "interpreter";
        def.progress = cancel;
        def.context = &left;
        must(motus_run_create(s, &def, &r, &err), &err, "run");
        assert_int_equal(motus_run_finish(r, &err), MOTUS_CANCELLED);
        assert_true(motus_run_events(r) < 64 * 63 / 2);
        must(motus_run_finish(r, &err), &err, "finish");
        assert_int_equal(motus_run_events(r), 64 * 63 / 2);
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

/* Within a step of fixed size that is not the last one nothing can be saved until the step is at its end. */
static void saved_after_the_step(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_system *s = given_text(TICKS);
    motus_run *r = NULL, *again = NULL;
    int left = 2;
    const char *text;
    size_t length;
    def.method = "rk4";
    def.step = 2;
    def.until = 4;
    def.machine = "interpreter";
    def.progress = cancel;
    def.context = &left;
    must(motus_run_create(s, &def, &r, &err), &err, "run");
    assert_int_equal(motus_run_step(r, 1, &err), MOTUS_CANCELLED);
    assert_int_equal(motus_run_save(r, &text, &length, &err), MOTUS_UNAVAILABLE);
    must(motus_run_step(r, 1, &err), &err, "step");
    assert_true(motus_run_time(r) == 2);
    must(motus_run_save(r, &text, &length, &err), &err, "save");
    def.progress = NULL;
    must(motus_run_create(s, &def, &again, &err), &err, "run");
    must(motus_run_restore(again, text, length, &err), &err, "restore");
    must(motus_run_finish(r, &err), &err, "finish");
    must(motus_run_finish(again, &err), &err, "finish");
    assert_int_equal(motus_run_events(r), 400000);
    assert_int_equal(motus_run_events(again), 400000);
    assert_true(value(s, r, "x") == value(s, again, "x"));
    motus_run_destroy(again);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* Fails at the creation of a run to `until`. */
static motus_error refused(const char *text, double until)
{
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_system *s = given_text(text);
    motus_run *r = NULL;
    def.method = "rk4";
    def.step = 1;
    def.until = until;
    assert_int_equal(motus_run_create(s, &def, &r, &err), MOTUS_LIMIT);
    motus_system_destroy(s);
    return err;
}

static void clocks_without_end(void **state)
{
    (void)state;
    const motus_error err = refused("x'' = 0\nx(0) = 0\nx'(0) = 1\nwhen every 2e-15 as tick: record\n", 1);
    assert_non_null(strstr(err.message, "tick happens every 2e-15, which is 5e+14 times in this run"));
    refused(TICKS, 700);
}

/* 9000 cells pass 0 once each in a step, more in all than one function may; and another one passes 0 about 95 times. */
static void many_functions_pass(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_system *s = given_text("N = 9000\nx[i]'' = 0 for i = 1..N\nx[i](0) = -i/(N + 1) for i = 1..N\n"
                                 "x[i]'(0) = 1 for i = 1..N\nwhen x[i] = 0 as pass: record for i = 1..N\n"
                                 "when sin(300 t) = 0 as quick: record\n");
    motus_run *r = NULL;
    def.method = "rk4";
    def.step = 1;
    def.until = 1;
    def.machine = "interpreter";
    must(motus_run_create(s, &def, &r, &err), &err, "run");
    must(motus_run_finish(r, &err), &err, "run");
    assert_int_equal(motus_run_events(r), 9000 + 95); /* 300/pi = 95.49; the start is no event */
    motus_run_destroy(r);
    motus_system_destroy(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(callbacks_that_fail),
        cmocka_unit_test(cancelled_within_a_step),
        cmocka_unit_test(cancelled_while_places_are_sought),

        cmocka_unit_test(saved_after_the_step),
        cmocka_unit_test(clocks_without_end),
        cmocka_unit_test(many_functions_pass),
    };
    return cmocka_run_group_tests_name("events that fail", tests, NULL, NULL);
}
