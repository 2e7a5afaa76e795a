/* Restart states: a restarted run has the bits of an uninterrupted one; a state that does not fit is refused and
 * changes nothing.
 */
#include "test/saved.h"

static const char *const texts[] = {
    "x'' = -x - 0.1 x^3 + 0.1 cos(t)\nx(0.5) = 1\nx'(0.5) = 0.1\n",
    "x'' = -x' - x^3\nx(0) = 2\nx'(0) = 0\n",
    "r'' = -r/|r|^3 + 0.1 cross(r', (0, 0, 1))\nr(0) = (1, 0, 0.1)\nr'(0) = (0, 1, 0)\n",
    "y'' = -9.81 - 0.1 y' |y'|\ny(0) = 1\ny'(0) = 3\ns' = y'^2 - s\ns(0) = 0.5\n",
    ("x[i]'' = x[i+1] - 2 x[i] + x[i-1] + 0.5 (x[i+1] - x[i])^3 - 0.5 (x[i] - x[i-1])^3 for i = 1..5\nx[0] = 0.1 "
     "sin(t)\nx[6] = 0\n"
     "x[i](0) = sin(i) for i = 1..5\nx[i]'(0) = 0 for i = 1..5\n"),
    "r'' = (0.5, -9.81)\nr(0) = (0, 0)\nr'(0) = (1, 4.5)\n",
};

/* Interrupted after n steps and continued in another system, as by a new process; with or without observations before
 * and after. */
static void interrupted(const char *text, const char *method, double start, int64_t n, int look)
{
    motus_system *s = given_text(text), *other = given_text(text);
    motus_run *whole = given_run(s, method, 0.01, start + 0.5), *first = given_run(s, method, 0.01, start + 0.5),
              *second = given_run(other, method, 0.01, start + 0.5);
    motus_error err;
    finish(whole);
    take_steps(first, n);
    if (look) free(whole_state(s, first, NULL));
    kept k = save(first);
    take_steps(second, look ? 3 : 0); /* it may have been at another state */
    must(restore(second, k, &err), &err, "restore");
    same_state(s, first, second, "restored");
    same_counts(first, second);
    finish(second);
    same_state(s, whole, second, "uninterrupted and restarted");
    same_counts(whole, second);
    free(k.text);
    motus_run_destroy(whole);
    motus_run_destroy(first);
    motus_run_destroy(second);
    motus_system_destroy(s);
    motus_system_destroy(other);
}

static void restarted_equals_uninterrupted(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        motus_system *s = given_text(texts[i]);
        motus_settings set = motus_default_settings();
        motus_settings_of(s, &set);
        for (size_t k = 0; k < motus_method_count(); k++) {
            const char *method = motus_method_at(k)->name;
            if (motus_method_admits(s, method, NULL) != MOTUS_OK) continue;
            for (int look = 0; look < 2; look++) {
                interrupted(texts[i], method, set.from, 0, look);
                interrupted(texts[i], method, set.from, 1, look);
                interrupted(texts[i], method, set.from, 23, look);
                interrupted(texts[i], method, set.from, 50, look);
            }
        }
        motus_system_destroy(s);
    }
}

/* A state saved after a shorter last step is that of the full steps before it: it continues to a later end as if
 * there had been no end. */
static void the_short_step_leaves_no_trace(void **state)
{
    (void)state;
    static const char *const methods[] = {"verlet",  "velocity-verlet", "kahan-li8", "gauss6",
                                          "newmark", "beeman",          "rk4"};
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        motus_system *s = given_text(texts[0]);
        motus_run *early = given_run(s, methods[i], 0.01, 0.5 + 0.2345),
                  *late = given_run(s, methods[i], 0.01, 0.5 + 0.4567),
                  *straight = given_run(s, methods[i], 0.01, 0.5 + 0.4567);
        motus_error err;
        finish(early);
        kept k = save(early);
        double t = motus_run_time(early);
        must(restore(late, k, &err), &err, "a later end");
        assert_int_equal(motus_run_steps(late), 23);
        finish(late);
        finish(straight);
        same_state(s, late, straight, "through an earlier end");
        same_counts(late, straight);
        /* Restored into its own run: before its shorter step. */
        must(restore(early, k, &err), &err, "back");
        assert_int_equal(motus_run_steps(early), 23);
        assert_false(motus_run_done(early));
        finish(early);
        assert_true(motus_run_time(early) == t);
        free(k.text);
        motus_run_destroy(early);
        motus_run_destroy(late);
        motus_run_destroy(straight);
        motus_system_destroy(s);
    }
}

static void backward_runs_restart_too(void **state)
{
    (void)state;
    motus_system *s = given_text(texts[0]);
    motus_run *whole = given_run(s, "verlet", 0.01, -0.5), *again = given_run(s, "verlet", 0.01, -0.5),
              *forward = given_run(s, "verlet", 0.01, 1.5);
    motus_error err;
    take_steps(whole, 40);
    kept k = save(whole);
    must(restore(again, k, &err), &err, "backward");
    finish(whole);
    finish(again);
    same_state(s, whole, again, "backward");
    assert_int_equal(restore(forward, k, &err), MOTUS_STATE);
    free(k.text);
    motus_run_destroy(whole);
    motus_run_destroy(again);
    motus_run_destroy(forward);
    motus_system_destroy(s);
}

/* The state is text with hexadecimal numbers, and saving twice gives the same bytes. */
static void the_state_is_readable_text(void **state)
{
    (void)state;
    motus_system *s = given_text("x'' = -x\nx(0) = 1\nx'(0) = 0\n");
    motus_run *r = given_run(s, "leapfrog", 0.25, 10);
    kept before = save(r);
    assert_non_null(strstr(before.text, "\nmethod leapfrog\n"));
    assert_non_null(strstr(before.text, "\nstep 0x1.0000000000000p-2\n"));
    assert_non_null(strstr(before.text, "\nat 0 0 0\n"));
    take_steps(r, 3);
    kept a = save(r), b = save(r);
    assert_string_equal(a.text, b.text);
    assert_string_not_equal(a.text, before.text);
    free(before.text);
    free(a.text);
    free(b.text);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* Refusals --------------------------------------------------------------------------------------------------------- */

typedef struct offer {
    const char *why, *text, *method;
    double step, until, start;
} offer;

#define CHAIN(n, strength, side, stiffness, end)                                                                    \
    "N = " #n "\nk = " #strength "\nx[i]'' = k x[i " #side " 1] - " #stiffness " x[i] for i = 1..N\nx[N+1] = " #end \
    "\nx[0] = 0\nx[i](0) = i for i = 1..N\nx[i]'(0) = 0 for i = 1..N\n"

static void what_does_not_fit_is_refused(void **state)
{
    (void)state;
    static const char chain[] = CHAIN(3, 2, +, 2, 0);
    static const offer given = {"itself", chain, "verlet", 0.01, 1, NAN},
                       offers[] = {
                           {"another force", CHAIN(3, 2, +, 3, 0), "verlet", 0.01, 1, NAN},
                           {"another neighbour", CHAIN(3, 2, -, 2, 0), "verlet", 0.01, 1, NAN},
                           {"another parameter", CHAIN(3, 3, +, 2, 0), "verlet", 0.01, 1, NAN},
                           {"another boundary", CHAIN(3, 2, +, 2, 1), "verlet", 0.01, 1, NAN},
                           {"another length", CHAIN(4, 2, +, 2, 0), "verlet", 0.01, 1, NAN},
                           {"another method", chain, "leapfrog", 0.01, 1, NAN},
                           {"another step", chain, "verlet", 0.02, 1, NAN},
                           {"another start", chain, "verlet", 0.01, 1, 0.5},
                           {"an end before the state", chain, "verlet", 0.01, 0.05, NAN},
                       };
    motus_system *s = given_text(given.text);
    motus_run *r = given_run(s, given.method, given.step, given.until);
    take_steps(r, 10);
    kept k = save(r);
    for (size_t i = 0; i < sizeof offers / sizeof *offers; i++) {
        const offer *o = &offers[i];
        motus_system *other = given_text(o->text);
        motus_run_def def = motus_default_run();
        motus_error err = motus_default_error();
        motus_run *q = NULL, *untouched = NULL;
        def.method = o->method;
        def.step = o->step;
        def.until = o->until;
        def.start = o->start;
        must(motus_run_create(other, &def, &q, &err), &err, o->why);
        must(motus_run_create(other, &def, &untouched, &err), &err, o->why);
        take_steps(q, 2);
        take_steps(untouched, 2);
        if (restore(q, k, &err) != MOTUS_STATE) fail_msg("%s was accepted", o->why);
        assert_true(strlen(err.message) > 10);
        same_state(other, q, untouched, "after a refusal");
        finish(q);
        finish(untouched);
        same_state(other, q, untouched, "at the end, after a refusal");
        motus_run_destroy(q);
        motus_run_destroy(untouched);
        motus_system_destroy(other);
    }
    free(k.text);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* The same numbers with other sums. */
static void sums_with_other_bounds_are_other_models(void **state)
{
    (void)state;
    static const char *const bodies[] = {"sum(j = 1..3, j != i: x[j] - x[i])", "sum(j = 1..2, j != i: x[j] - x[i])",
                                         "sum(j = 1..i, j != i: x[j] - x[i])", "sum(j = 1..3, j < i: x[j] - x[i])"};
    enum { BODIES = 4 };
    kept k[BODIES];
    motus_system *s[BODIES];
    motus_run *r[BODIES];
    for (int i = 0; i < BODIES; i++) {
        char text[256];
        snprintf(text, sizeof text, "x[i]'' = %s for i = 1..3\nx[i](0) = i for i = 1..3\nx[i]'(0) = 0 for i = 1..3\n",
                 bodies[i]);
        s[i] = given_text(text);
        r[i] = given_run(s[i], "rk4", 0.01, 1);
        take_steps(r[i], 5);
        k[i] = save(r[i]);
    }
    for (int i = 0; i < BODIES; i++)
        for (int j = 0; j < BODIES; j++) {
            motus_error err;
            assert_int_equal(restore(r[i], k[j], &err), i == j ? MOTUS_OK : MOTUS_STATE);
        }
    for (int i = 0; i < BODIES; i++) {
        free(k[i].text);
        motus_run_destroy(r[i]);
        motus_system_destroy(s[i]);
    }
}

static void damage_is_seen(void **state)
{
    (void)state;
    motus_system *s = given_text(texts[3]);
    motus_run *r = given_run(s, "verlet", 0.01, 1), *q = given_run(s, "verlet", 0.01, 1);
    take_steps(r, 7);
    take_steps(q, 7);
    kept k = save(r);
    motus_error err;
    no_damage_passes(q, k);
    same_state(s, r, q, "after all that");
    must(restore(q, k, &err), &err, "undamaged");
    free(k.text);
    motus_run_destroy(r);
    motus_run_destroy(q);
    motus_system_destroy(s);
}

static void forged_states_do_no_harm(void **state)
{
    (void)state;
    motus_system *s = given_text(texts[3]);
    motus_run *r = given_run(s, "verlet", 0.01, 1);
    take_steps(r, 7);
    kept k = save(r);
    motus_error err;
    char *copy = malloc(k.length + 64);
    assert_non_null(copy);
    assert_true(refuse_forgeries(r, k) > 100);
    /* Invalid numbers, counters that are negative or too large, a carry that is too long. */
    static const struct {
        const char *from, *to;
    } forged[] = {{"\nat 7 ", "\nat -7 "},
                  {"\nat 7 ", "\nat 99999999999999999999 "},
                  {"\nat 7 ", "\nat 101 "},
                  {"\ncarry ", "\ncarry 9"},
                  {"\ncarry ", "\ncarry 1"},
                  {"\nstep 0x1", "\nstep 0x2"},
                  {"p-", "p-9"},
                  {"p-", "p+9"},
                  {"p-", "p-99999"},
                  {"p-", "p-999999999999"},
                  {"0x1.", "0x1"},
                  {"0x1.", "nan "},
                  {"method verlet", "method leapfrog"}};
    for (size_t i = 0; i < sizeof forged / sizeof *forged; i++) {
        const char *at = strstr(k.text, forged[i].from);
        assert_non_null(at);
        int n = snprintf(copy, k.length + 64, "%.*s%s%s", (int)(at - k.text), k.text, forged[i].to,
                         at + strlen(forged[i].from));
        seal(copy, (size_t)n);
        if (restore(r, (kept){copy, (size_t)n}, &err) != MOTUS_STATE)
            fail_msg("accepted: %s for %s", forged[i].to, forged[i].from);
    }
    must(restore(r, k, &err), &err, "undamaged");
    finish(r);
    free(copy);
    free(k.text);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* The steps before a restart count: the limit is met at the same step, in the same words, and more are never taken. */
static void limit_of_steps(void **state)
{
    (void)state;
    motus_system *s = given_text(texts[0]);
    motus_error err = motus_default_error(), other = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *whole = NULL, *first = NULL, *second = NULL;
    def.method = "dopri5", def.until = 20, def.machine = "interpreter", def.most_steps = 30;
    must(motus_run_create(s, &def, &whole, &err), &err, "whole");
    must(motus_run_create(s, &def, &first, &err), &err, "first");
    must(motus_run_create(s, &def, &second, &err), &err, "second");
    assert_int_equal(motus_run_finish(whole, &err), MOTUS_STEPS);
    assert_int_equal(motus_run_steps(whole), 30);
    assert_true(err.time == motus_run_time(whole) && strstr(err.message, "after 30 steps") != NULL);
    assert_int_equal(motus_run_step(whole, 1, &err), MOTUS_STEPS);
    assert_int_equal(motus_run_step(whole, 0, &err), MOTUS_OK);
    take_steps(first, 12);
    kept k = save(first);
    must(restore(second, k, &err), &err, "restore");
    assert_int_equal(motus_run_step(second, 18, &err), MOTUS_OK);
    assert_int_equal(motus_run_finish(second, &other), MOTUS_STEPS);
    same_state(s, whole, second, "at the limit");
    same_counts(whole, second);
    double x = 1, v = 0; /* another leg has as many again */
    must(motus_run_set_state(second, NAN, &x, &v, &err), &err, "set");
    assert_int_equal(motus_run_finish(second, &err), MOTUS_STEPS);
    assert_int_equal(motus_run_steps(second), 30);
    const motus_run_statistics all = motus_run_now(second);
    assert_int_equal(all.steps, 60);
    def.most_steps = -1, def.until = 21;
    motus_run *none = NULL;
    assert_int_equal(motus_run_create(s, &def, &none, &err), MOTUS_ARGUMENT);
    def.most_steps = 5, def.method = "rk4", def.step = 0.1;
    assert_int_equal(motus_run_create(s, &def, &none, &err), MOTUS_ARGUMENT);
    free(k.text);
    motus_run_destroy(whole);
    motus_run_destroy(first);
    motus_run_destroy(second);
    motus_system_destroy(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(restarted_equals_uninterrupted),
        cmocka_unit_test(the_short_step_leaves_no_trace),
        cmocka_unit_test(backward_runs_restart_too),
        cmocka_unit_test(the_state_is_readable_text),
        cmocka_unit_test(what_does_not_fit_is_refused),
        cmocka_unit_test(sums_with_other_bounds_are_other_models),
        cmocka_unit_test(damage_is_seen),
        cmocka_unit_test(forged_states_do_no_harm),
        cmocka_unit_test(limit_of_steps),
    };
    return cmocka_run_group_tests_name("restart states", tests, NULL, NULL);
}
