/* Numbers set in a system: the same bits as of a text read with `set`, refusals that change nothing, and clones that
 * have the numbers too.
 */
#include "test/ensemble_given.h"

#include <dirent.h>
#include <stdbool.h>

/* ---- comparing two systems ---- */

static void same_values(const double *a, const double *b, size_t count, const char *what, const char *name)
{
    for (size_t k = 0; k < count; k++)
        if (!same_number(a[k], b[k])) fail_msg("%s: number %zu of %s is %a, expected %a", what, k, name, a[k], b[k]);
}

/* Compares parameters, initial values, and the bits of a run. */
static void same_systems(motus_system *got, motus_system *expected, const char *machine, const char *what)
{
    assert_int_equal(motus_parameter_count(got), motus_parameter_count(expected));
    for (size_t k = 0; k < motus_parameter_count(got) + motus_initial_count(got); k++) {
        const size_t i = k - motus_parameter_count(got);
        const bool initial = k >= motus_parameter_count(got);
        motus_parameter p = motus_default_parameter();
        motus_initial n = motus_default_initial();
        assert_int_equal(initial ? motus_initial_at(got, i, &n) : motus_parameter_at(got, k, &p), MOTUS_OK);
        const size_t count = initial ? n.count : p.count;
        double *a = malloc((count + 1) * sizeof *a), *b = malloc((count + 1) * sizeof *b);
        assert_true(a && b);
        assert_int_equal(initial ? motus_initial_values(got, i, a) : motus_parameter_values(got, k, a), MOTUS_OK);
        assert_int_equal(initial ? motus_initial_values(expected, i, b) : motus_parameter_values(expected, k, b),
                         MOTUS_OK);
        same_values(a, b, count, what, initial ? n.name : p.name);
        free(a);
        free(b);
    }
    motus_run_def def = motus_default_run();
    motus_run *p = NULL, *q = NULL;
    motus_error one = motus_default_error(), two = motus_default_error();
    def.step = 0.001;
    def.until = 0.02;
    def.machine = machine;
    const motus_status status = motus_run_create(got, &def, &p, &one), due = motus_run_create(expected, &def, &q, &two);
    if (status != due || strcmp(one.message, two.message))
        fail_msg("%s: a run is refused, or not: %s and %s", what, one.message, two.message);
    const motus_status end = p ? motus_run_finish(p, &one) : MOTUS_OK;
    assert_int_equal(end, q ? motus_run_finish(q, &two) : MOTUS_OK);
    if (p && end == MOTUS_OK) same_state(got, p, q, what);
    motus_run_destroy(p);
    motus_run_destroy(q);
}

/* "F=0.5", "r(0)=(1, 2)", "m=[1, 2]" with every digit; false: a text cannot express it. */
static bool write_setting(char *out, size_t size, const char *name, int components, int list, int dimensions,
                          const double *values, size_t count)
{
    if (dimensions > 1 || (list && components) || count > 32) return false;
    int n = snprintf(out, size, "%s=%s", name, list ? "[" : components ? "(" : "");
    for (size_t k = 0; k < count; k++) n += snprintf(out + n, size - (size_t)n, "%s%.17g", k ? ", " : "", values[k]);
    snprintf(out + n, size - (size_t)n, "%s", list ? "]" : components ? ")" : "");
    return true;
}

typedef struct tally {
    int same, refused, decided;
} tally;

/* One name of one model: by motus_system_set, and by a text read with `set`. */
static void set_both(const char *text, const char *name, const double *values, size_t count, const char *setting,
                     const char *machine, tally *sum)
{
    motus_system *s = given_text(text), *t = NULL;
    motus_error err = motus_default_error(), other = motus_default_error();
    motus_text_def def = motus_default_text();
    def.text = text;
    def.set = &setting;
    def.set_count = 1;
    const motus_status status = motus_system_set(s, name, values, count, &err),
                       due = motus_system_from_text(&def, &t, &other);
    if (status != due) fail_msg("%s: %s (%s), and read with `set`: %s", setting, err.message, err.hint, other.message);
    if (status == MOTUS_OK) {
        same_systems(s, t, machine, setting);
    } else { /* and nothing has changed */
        motus_system *before = given_text(text);
        same_systems(s, before, machine, setting);
        motus_system_destroy(before);
    }
    sum->same += status == MOTUS_OK;
    sum->refused += status != MOTUS_OK;
    motus_system_destroy(s);
    motus_system_destroy(t);
}

static void set_all_of(const char *text, const char *machine, tally *sum)
{
    motus_system *s = given_text(text);
    for (size_t k = 0; k < motus_parameter_count(s) + motus_initial_count(s); k++) {
        const size_t i = k - motus_parameter_count(s);
        motus_parameter p = motus_default_parameter();
        motus_initial n = motus_default_initial();
        motus_variable v = motus_default_variable();
        const bool initial = k >= motus_parameter_count(s);
        assert_int_equal(initial ? motus_initial_at(s, i, &n) : motus_parameter_at(s, k, &p), MOTUS_OK);
        if (initial) assert_int_equal(motus_variable_at(s, n.variable, &v), MOTUS_OK);
        const size_t count = initial ? n.count : p.count;
        double *values = malloc((count + 1) * sizeof *values);
        assert_non_null(values);
        assert_int_equal(initial ? motus_initial_values(s, i, values) : motus_parameter_values(s, k, values), MOTUS_OK);
        for (size_t j = 0; j < count; j++) values[j] = 1.03125 * values[j] + 0.015625 * (double)(j + 1);
        char setting[1024];
        motus_error err = motus_default_error();
        if (!initial && p.decides) {
            motus_system *other = given_text(text);
            assert_int_equal(motus_system_set(other, p.name, values, count, &err), MOTUS_ARGUMENT);
            assert_true(strstr(err.message, p.decides) && strlen(err.hint) > 10);
            motus_system_destroy(other);
            sum->decided++;
        } else if (!(initial && v.dimensions) &&
                   write_setting(setting, sizeof setting, initial ? n.name : p.name,
                                 initial ? v.components : p.components, initial ? 0 : p.list,
                                 initial ? 0 : p.dimensions, values, count)) {
            if (initial || !p.list || p.text[0] == '[') /* a text can set a list, but no family of parameters */
                set_both(text, initial ? n.name : p.name, values, count, setting, machine, sum);
        }
        free(values);
    }
    motus_system_destroy(s);
}

static void every_number_of_every_model(void **state)
{
    (void)state;
    char path[1024];
    given_path(path, sizeof path, "models", "");
    DIR *folder = opendir(path);
    assert_non_null(folder);
    tally sum = {0};
    for (struct dirent *one; (one = readdir(folder));) {
        if (!strstr(one->d_name, ".motus")) continue;
        given_path(path, sizeof path, "models", one->d_name);
        char *text = given_file(path);
        set_all_of(text, "interpreter", &sum);
        free(text);
    }
    closedir(folder);
    if (sum.same < 60 || sum.refused < 5 || sum.decided < 2)
        fail_msg("only %d settings compared, %d refused, %d that decide more", sum.same, sum.refused, sum.decided);
}

static void compiled_models_too(void **state)
{
    (void)state;
    tally sum = {0};
    set_all_of("k = 2\nF = 0.1\nA = 1\ng = (0, -1)\nx'' = -k x + F cos(t)\nx(0) = A\nx'(0) = k A\n"
               "r'' = g - 0.1 r'\nr(0) = (A, 0)\nr'(0) = (0, 1)\n",
               "compiled", &sum);
    assert_int_equal(sum.same, 8);
}

/* ---- several, one after the other ---- */

static const char chained[] = "A = 1\nB = 2 A\nk = [1, 4, 9]\nN = 3\nc[i] = k[i] + B   for i = 1..N\n"
                              "x'' = -B x\nx(0) = A\nx'(0) = x(0) + B\n"
                              "y[i]'' = -c[i] y[i] + y[0]   for i = 1..N\ny[0] = A\ny[i](0) = A i   for i = 1..N\n"
                              "y[2](0) = B\ny[i]'(0) = y[i](0)   for i = 1..N\n"
                              "r'' = -A r\nr(0) = (A, 0)\nr'(0) = (0, B)\ns' = -B s\ns(0) = A\n";

static void set(motus_system *s, const char *name, size_t count, const double *values)
{
    motus_error err = motus_default_error();
    must(motus_system_set(s, name, values, count, &err), &err, name);
}

/* A set number stays set, in any order, as in a text where every `set` replaces its line. */
static void what_was_set_stays(void **state)
{
    (void)state;
    static const struct {
        const char *name, *setting;
        size_t count;
        double values[3];
    } steps[] = {{"A", "A=3", 1, {3}},
                 {"x(0)", "x(0)=0.5", 1, {0.5}},
                 {"B", "B=0.25", 1, {0.25}},
                 {"r'(0)", "r'(0)=(1, -1)", 2, {1, -1}},
                 {"k", "k=[2, 3, 5]", 3, {2, 3, 5}},
                 {"s(0)", "s(0)=7", 1, {7}}};
    enum { STEPS = sizeof steps / sizeof *steps };
    /* All rotations of five, forward and backward, have every pair in both orders. */
    for (int start = 0; start < STEPS; start++)
        for (int way = -1; way <= 1; way += 2) {
            motus_system *s = given_text(chained);
            const char *settings[STEPS + 1];
            for (int n = 0; n < STEPS; n++) {
                const int k = ((start + way * n) % STEPS + STEPS) % STEPS;
                set(s, steps[k].name, steps[k].count, steps[k].values);
                settings[n] = steps[k].setting;
                motus_system *t = given_text_with(chained, settings, (size_t)n + 1, "set"), *c = NULL;
                same_systems(s, t, "interpreter", settings[n]);
                must(motus_system_clone(s, &c, NULL), &(motus_error){0}, "clone");
                same_systems(c, t, "interpreter", "a clone");
                motus_system_destroy(t);
                /* A clone changes independently, and keeps what was set before. */
                settings[n + 1] = "A=11";
                t = given_text_with(chained, settings, (size_t)n + 2, "set");
                set(c, "A", 1, (const double[]){11});
                same_systems(c, t, "interpreter", "a clone of its own");
                motus_system_destroy(t);
                t = given_text_with(chained, settings, (size_t)n + 1, "set");
                same_systems(s, t, "interpreter", "beside its clone");
                motus_system_destroy(c);
                motus_system_destroy(t);
            }
            /* A number set early is set again, after lines that used it were overridden. */
            settings[STEPS] = "A=11";
            set(s, "A", 1, (const double[]){11});
            motus_system *t = given_text_with(chained, settings, STEPS + 1, "set");
            same_systems(s, t, "interpreter", "set again");
            motus_system_destroy(t);
            motus_system_destroy(s);
        }
}

/* All cells of a family are set at once, which a text needs several lines for. */
static void families(void **state)
{
    (void)state;
    static const char *const cells[] = {"y[1](0)=8", "y[2](0)=9", "y[3](0)=10", "A=5"};
    static const double y[3] = {8, 9, 10}, c[3] = {2, 2.5, 3}, A = 5, B = 7;
    motus_system *s = given_text(chained), *t = given_text_with(chained, cells, 4, "cells");
    set(s, "y(0)", 3, y);
    set(s, "A", 1, &A);
    same_systems(s, t, "interpreter", "a family");
    motus_system_destroy(t);
    /* c[i] = k[i] + B is overridden: from then on it does not depend on B. */
    set(s, "c", 3, c);
    set(s, "B", 1, &B);
    double now[3];
    assert_int_equal(motus_parameter_values(s, 4, now), MOTUS_OK);
    same_values(now, c, 3, "a family of parameters", "c");
    motus_run *r = given_run(s, "rk4", 0.01, 0.1);
    finish(r);
    assert_true(isfinite(value(s, r, "y[3]")));
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* ---- refusals ---- */

static void refusals(void **state)
{
    (void)state;
    static const char text[] =
        "N = 2\nk = 4\nd = 1/k\nT = 2\nw = (1, 2)\nx'' = -k x\nx(0) = 1\nx'(0) = 0\nexact x = x(0) cos(sqrt(k) t)\n"
        "energy = x'^2\nstep T/100\nuntil T\n";
    static const struct {
        const char *name;
        size_t count;
        double values[2];
        motus_status status;
        const char *message, *hint;
    } cases[] = {{"q", 1, {1}, MOTUS_NAME, "neither a parameter nor an initial value", ""},
                 {"energy", 1, {1}, MOTUS_NAME, "neither", "is a quantity"},
                 {"x", 1, {1}, MOTUS_NAME, "neither", "x(0)"},
                 {"x(1)", 1, {1}, MOTUS_NAME, "neither", "x(0)"},
                 {"w.x", 1, {1}, MOTUS_NAME, "neither", "by its name alone"},
                 {"x''(0)", 1, {1}, MOTUS_NAME, "neither", ""},
                 {"", 1, {1}, MOTUS_NAME, "neither", ""},
                 {"(0)", 1, {1}, MOTUS_NAME, "neither", ""},
                 {"k", 2, {1, 1}, MOTUS_SHAPE, "k is 1 number, but the call gives 2", ""},
                 {"w", 1, {1}, MOTUS_SHAPE, "w is 2 numbers, but the call gives 1", ""},
                 {"k", 1, {NAN}, MOTUS_ARGUMENT, "not a finite number", ""},
                 {"x(0)", 1, {INFINITY}, MOTUS_ARGUMENT, "not a finite number", ""},
                 {"k", 1, {0}, MOTUS_ARGUMENT, "d depends on k", ""},
                 {"T", 1, {3}, MOTUS_ARGUMENT, "T decides `step`", "`set`"},
                 {"x'(0)", 1, {1}, MOTUS_ARGUMENT, "does not meet the initial value", ""}};
    motus_system *s = given_text(text), *before = given_text(text);
    motus_error err = motus_default_error();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const motus_status status = motus_system_set(s, cases[i].name, cases[i].values, cases[i].count, &err);
        if (status != cases[i].status || !strstr(err.message, cases[i].message) || !strstr(err.hint, cases[i].hint))
            fail_msg("%s, case %zu: %s: %s (%s)", cases[i].name, i, motus_status_word(status), err.message, err.hint);
        same_systems(s, before, "interpreter", cases[i].name);
    }
    assert_true(err.line > 0 && strchr(err.caret, '^')); /* of the exact line */
    const double one = 1;
    assert_int_equal(motus_system_set(NULL, "k", &one, 1, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_system_set(s, NULL, &one, 1, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_system_set(s, "k", NULL, 1, &err), MOTUS_ARGUMENT);
    motus_system_destroy(before);
    assert_int_equal(motus_system_clone(NULL, &before, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_system_clone(s, NULL, &err), MOTUS_ARGUMENT);
    assert_null(before);
    motus_system_destroy(s);

    /* A refused setting overrides no line. */
    const double none = 0, three = 3;
    s = given_text("A = 2\nx'' = -x\nx(0) = A\nx'(0) = 0\nd = 1/x(0)\n");
    assert_int_equal(motus_system_set(s, "x(0)", &none, 1, &err), MOTUS_ARGUMENT);
    set(s, "A", 1, &three);
    double now;
    assert_int_equal(motus_initial_values(s, 0, &now), MOTUS_OK);
    assert_true(now == three);
    motus_system_destroy(s);

    s = given_text("k = 4\nx'' = -k x\nx(0) = 1\nx'(0) = 0\nexact x = cos(2 t)\n");
    assert_int_equal(motus_system_set(s, "k", &one, 1, &err), MOTUS_ARGUMENT);
    assert_non_null(strstr(err.message, "does not obey the equation"));
    motus_system_destroy(s);
}

/* While a run, an ensemble or a reference exists, the equations cannot change. */
static void not_while_somebody_uses_it(void **state)
{
    (void)state;
    motus_system *s = given_text("k = 1\nx'' = -k x\nx(0) = 1\nx'(0) = 0\nstep 0.01\nuntil 1\n");
    motus_error err = motus_default_error();
    const double k = 2;
    const motus_record record = {MOTUS_REDUCE_FINAL, 1};
    motus_ensemble_def flock = motus_default_ensemble();
    motus_ensemble *e = NULL;
    motus_reference *reference = NULL;
    motus_comparison *comparison = NULL;
    motus_run *r = given_run(s, NULL, NAN, NAN), *none = NULL;
    flock.records = &record, flock.record_count = 1, flock.machine = "interpreter";
    assert_int_equal(motus_system_set(s, "k", &k, 1, &err), MOTUS_ARGUMENT);
    assert_true(strstr(err.message, "1 run,") && strstr(err.hint, "clone"));
    must(motus_ensemble_create(s, &flock, &e, &err), &err, "ensemble");
    motus_run_destroy(r);
    assert_int_equal(motus_system_set(s, "k", &k, 1, &err), MOTUS_ARGUMENT);
    must(motus_reference_create(s, NULL, &reference, &err), &err, "reference");
    motus_ensemble_destroy(e);
    assert_int_equal(motus_system_set(s, "k", &k, 1, &err), MOTUS_ARGUMENT);
    motus_reference_destroy(reference);
    /* Failed calls and finished studies do not hold the system. */
    motus_run_def def = motus_default_run();
    def.step = -1;
    assert_int_equal(motus_run_create(s, &def, &none, &err), MOTUS_ARGUMENT);
    flock.step = -1;
    assert_int_equal(motus_ensemble_create(s, &flock, &e, &err), MOTUS_ARGUMENT);
    must(motus_compare(s, NULL, &comparison, &err), &err, "compare");
    must(motus_system_set(s, "k", &k, 1, &err), &err, "set");
    motus_comparison_destroy(comparison);
    motus_system_destroy(s);
}

/* ---- what else uses the numbers ---- */

/* An ensemble uses what was set, on every thread and in lanes: A varies, and the set x(0) no longer follows A. */
static void ensembles(void **state)
{
    (void)state;
    enum { COUNT = 9 };
    double A[COUNT], x0 = 0.5;
    const double *values[] = {A};
    static const char *const vary[] = {"A"}, *const machines[] = {"interpreter", "compiled"};
    motus_record records[4];
    for (int k = 0; k < COUNT; k++) A[k] = 0.5 + 0.25 * k;
    static const char text[] =
        "A = 1\nB = 2 A\nx'' = -B x\nx(0) = A\nx'(0) = x(0) + B\nr'' = -A r\nr(0) = (A, 0)\nr'(0) = (0, B)\n";
    motus_system *s = given_text(text);
    set(s, "x(0)", 1, &x0);
    set(s, "r'(0)", 2, (const double[]){1, -1});
    for (size_t k = 0; k < 4; k++) records[k] = (motus_record){MOTUS_REDUCE_FINAL, k + 1};
    for (int m = 0; m < 2; m++) {
        motus_ensemble_def def = motus_default_ensemble();
        def.vary = vary, def.vary_count = 1, def.records = records, def.record_count = 4;
        def.method = "rk4", def.step = 0.01, def.until = 1, def.threads = 3, def.machine = machines[m];
        motus_ensemble *e = given_ensemble(s, &def, machines[m]);
        assert_string_equal(motus_ensemble_now(e).machine, machines[m]);
        outcome o = go(e, COUNT, 4, values, machines[m]);
        for (int k = 0; k < COUNT; k++) {
            char setting[64];
            snprintf(setting, sizeof setting, "A=%.17g", A[k]);
            const char *const sets[] = {setting, "x(0)=0.5", "r'(0)=(1, -1)"};
            motus_system *t = given_text_with(text, sets, 3, setting);
            motus_run *r = given_run(t, "rk4", 0.01, 1);
            finish(r);
            assert_true(same_number(value(t, r, "x"), o.at[0][k]) && same_number(value(t, r, "r.x"), o.at[1][k]));
            motus_run_destroy(r);
            motus_system_destroy(t);
        }
        forget(&o);
        motus_ensemble_destroy(e);
    }
    motus_system_destroy(s);
}

/* Whether a velocity term does work is tested at states, with the present numbers. */
static void methods_follow(void **state)
{
    (void)state;
    motus_system *s = given_text("d = 0\nr'' = cross(r', (0, 0, 2)) - d r'\nr(0) = (1, 0, 0)\nr'(0) = (0, 1, 0)\n"),
                 *c = NULL;
    motus_analysis a = motus_default_analysis();
    const double one = 1, none = 0;
    /* A clone of a system that was not analysed yet is analysed itself. */
    must(motus_system_clone(s, &c, NULL), &(motus_error){0}, "clone");
    assert_int_equal(motus_method_admits(c, "boris", NULL), MOTUS_OK);
    motus_system_destroy(c);
    const char *turning = motus_explain(s);
    assert_non_null(strstr(turning, "Boris"));
    assert_int_equal(motus_method_admits(s, "boris", NULL), MOTUS_OK);
    set(s, "d", 1, &one);
    assert_int_equal(motus_analysis_of(s, &a), MOTUS_OK);
    assert_false(a.gyroscopic);
    assert_int_equal(motus_method_admits(s, "boris", NULL), MOTUS_METHOD);
    assert_null(strstr(motus_explain(s), "Boris"));
    must(motus_system_clone(s, &c, NULL), &(motus_error){0}, "clone");
    assert_int_equal(motus_method_admits(c, "boris", NULL), MOTUS_METHOD);
    motus_system_destroy(c);
    set(s, "d", 1, &none);
    assert_int_equal(motus_method_admits(s, "boris", NULL), MOTUS_OK);
    assert_ptr_equal(motus_explain(s), turning);
    motus_system_destroy(s);
}

/* A restart state depends on the numbers with which it was written. */
static void states_belong_to_their_numbers(void **state)
{
    (void)state;
    motus_system *s = given_text("k = 1\nx'' = -k x\nx(0) = 1\nx'(0) = 0\n");
    motus_error err = motus_default_error();
    const double one = 1, two = 2;
    const char *text;
    size_t length;
    motus_run *r = given_run(s, "verlet", 0.01, 1);
    take_steps(r, 10);
    must(motus_run_save(r, &text, &length, &err), &err, "save");
    char *kept = strdup(text);
    motus_run_destroy(r);
    for (int again = 0; again < 2; again++) {
        set(s, "k", 1, again ? &one : &two);
        r = given_run(s, "verlet", 0.01, 1);
        assert_int_equal(motus_run_restore(r, kept, length, &err), again ? MOTUS_OK : MOTUS_STATE);
        motus_run_destroy(r);
    }
    free(kept);
    motus_system_destroy(s);
}

static int hang(void *context, double t, const double *x, const double *v, double *a)
{
    (void)context;
    a[0] = -x[0] + v[2];
    a[1] = -x[1];
    a[2] = cos(t);
    return 0;
}

static void callbacks(void **state)
{
    (void)state;
    static const double x[] = {1, 2}, v[] = {3, 4, 5}, other[] = {7, 8, 9};
    static const char *const names[] = {"a", "b", "c"};
    motus_error err = motus_default_error();
    for (int named = 0; named < 2; named++) {
        motus_callback_def def = motus_default_callback();
        def.positions = 2, def.first_order = 1, def.x = x, def.v = v, def.acceleration = hang, def.start = -1.5;
        def.names = named ? names : NULL;
        motus_system *s = NULL, *c = NULL, *t = NULL;
        must(motus_system_from_callback(&def, &s, &err), &err, "callback");
        set(s, named ? "b'(-1.5)" : "x'(-1.5)", named ? 1 : 2, other);
        set(s, named ? "c(-1.5)" : "s(-1.5)", 1, other + 2);
        assert_int_equal(motus_system_set(s, "k", other, 1, &err), MOTUS_NAME);
        assert_int_equal(motus_system_set(s, named ? "b(-1.5)" : "x(-1.5)", other, 3, &err), MOTUS_SHAPE);
        must(motus_system_clone(s, &c, &err), &err, "clone");
        def.v = named ? (const double[]){3, 7, 9} : (const double[]){7, 8, 9};
        must(motus_system_from_callback(&def, &t, &err), &err, "callback");
        same_systems(s, t, NULL, "a callback");
        same_systems(c, t, NULL, "its clone");
        motus_system_destroy(s);
        motus_system_destroy(c);
        motus_system_destroy(t);
    }
}

/* ---- memory ---- */

static void *count_take(void *context, size_t bytes)
{
    *(int64_t *)context += 1;
    return malloc(bytes);
}

static void count_give(void *context, void *block)
{
    *(int64_t *)context -= block != NULL;
    free(block);
}

/* Setting a number many times takes no more memory than setting it once. */
static void setting_again_takes_no_memory(void **state)
{
    (void)state;
    int64_t blocks = 0, after = 0;
    motus_text_def def = motus_default_text();
    motus_error err = motus_default_error();
    motus_system *s = NULL;
    def.text = "k = 4\nA = 1\nx'' = -k x\nx(0) = A\nx'(0) = 0\nexact x = x(0) cos(sqrt(k) t)\n";
    def.allocator = (motus_allocator){count_take, count_give, &blocks};
    must(motus_system_from_text(&def, &s, &err), &err, "text");
    for (int n = 0; n < 2000; n++) {
        const double k = 1 + 0.001 * n;
        set(s, "k", 1, &k);
        set(s, n % 2 ? "A" : "x(0)", 1, &k);
        motus_run *r = given_run(s, "exact", 0.1, 0.5);
        finish(r);
        motus_run_destroy(r);
        if (n == 1) after = blocks;
    }
    assert_int_equal(blocks, after);
    motus_system_destroy(s);
    assert_int_equal(blocks, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_number_of_every_model),
        cmocka_unit_test(compiled_models_too),
        cmocka_unit_test(what_was_set_stays),
        cmocka_unit_test(families),
        cmocka_unit_test(refusals),
        cmocka_unit_test(not_while_somebody_uses_it),
        cmocka_unit_test(ensembles),
        cmocka_unit_test(methods_follow),
        cmocka_unit_test(states_belong_to_their_numbers),
        cmocka_unit_test(callbacks),
        cmocka_unit_test(setting_again_takes_no_memory),
    };
    open_shared_cache();
    const int failed = cmocka_run_group_tests_name("numbers that are set", tests, NULL, NULL);
    close_cache();
    return failed;
}
