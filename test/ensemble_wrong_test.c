/* Ensembles with errors: a trajectory that diverges and its neighbours, requests that are refused, a progress hook
 * that cancels; and a system that several ensembles and runs share.
 */
#include "test/ensemble_given.h"

#include <stdatomic.h>
#include <stdbool.h>

enum { FEW = 5 };

/* A definition with one record of each kind of the first position, and one varied name. */
static motus_record records[] = {{MOTUS_REDUCE_FINAL, 1}, {MOTUS_REDUCE_MIN, 1},         {MOTUS_REDUCE_MAX, 1},
                                 {MOTUS_REDUCE_MEAN, 1},  {MOTUS_REDUCE_TIME_OF_MAX, 1}, {MOTUS_REDUCE_FINAL, 0}};
enum { RECORDS = sizeof records / sizeof *records };

static motus_ensemble_def define(const char *const *names, size_t count, const char *method, double step, double until,
                                 const char *machine)
{
    motus_ensemble_def def = motus_default_ensemble();
    def.vary = names;
    def.vary_count = count;
    def.records = records;
    def.record_count = RECORDS;
    def.method = method;
    def.step = step;
    def.until = until;
    def.machine = machine;
    return def;
}

/* Trajectories that stop ------------------------------------------------------------------------------------------- */

/* The time at which a run with this value stops: NaN if it reaches its end, minus infinity if the model cannot be
 * read. */
static double when_a_run_stops(const char *text, const char *name, double x, const char *method, double step,
                               double until, int64_t every)
{
    char set[80];
    const char *list[] = {set};
    motus_error err = motus_default_error();
    motus_text_def def = motus_default_text();
    motus_system *s = NULL;
    snprintf(set, sizeof set, "%s=%.17g", name, x);
    def.text = text;
    def.set = list;
    def.set_count = 1;
    if (!isfinite(x) || motus_system_from_text(&def, &s, &err) != MOTUS_OK) return -INFINITY;
    motus_run *r = given_run(s, method, step, until);
    double y, stopped = NAN;
    motus_status status = MOTUS_OK;
    size_t k = 1;
    while (status == MOTUS_OK) {
        if (motus_run_done(r) || (every && motus_run_steps(r) % every == 0))
            status = motus_run_values(r, &k, 1, &y, &err);
        if (motus_run_done(r)) break;
        if (status == MOTUS_OK) status = motus_run_step(r, 1, &err);
    }
    if (status != MOTUS_OK) {
        assert_true(status == MOTUS_DIVERGED || status == MOTUS_SOLVE);
        stopped = err.time;
    }
    motus_run_destroy(r);
    motus_system_destroy(s);
    return stopped;
}

/* The same ensemble on both machines; every trajectory stops when a run would, and the others are unchanged by it. */
static void stops_alike(const char *text, const char *name, const double x[FEW], const char *method, double step,
                        double until, int64_t every, int stops)
{
    motus_system *s = given_text(text);
    const double *values[] = {x};
    int stopped = 0;
    outcome o[2];
    for (int last = 0; last < 2; last++) { /* only the ends, and samples on the way */
        for (int m = 0; m < 2; m++) {
            motus_ensemble_def def = define(&name, 1, method, step, until, m ? "compiled" : "interpreter");
            def.every = every;
            def.record_count = last ? 1 : RECORDS;
            def.lanes = m ? 4 : 0;
            motus_ensemble *e = given_ensemble(s, &def, method);
            o[m] = go(e, FEW, def.record_count, values, text);
            for (size_t i = 0; i < FEW; i++) {
                double alone[RECORDS], one = x[i], when, *at[RECORDS];
                const double *list[] = {&one};
                for (size_t r = 0; r < RECORDS; r++) at[r] = &alone[r];
                motus_error err = motus_default_error();
                must(motus_ensemble_run(e, 1, list, at, &when, &err), &err, "alone");
                assert_true(same_number(when, o[m].stopped[i]));
                for (size_t r = 0; r < def.record_count; r++) {
                    assert_true(same_number(alone[r], o[m].at[r][i]));
                    assert_true(isnan(o[m].stopped[i]) != isnan(o[m].at[r][i]));
                }
            }
            motus_ensemble_destroy(e);
        }
        same_outcome(&o[0], &o[1], method);
        for (size_t i = 0; i < FEW; i++) {
            double expected = when_a_run_stops(text, name, x[i], method, step, until, last ? 0 : every);
            if (expected > -INFINITY && !same_number(expected, o[0].stopped[i]))
                fail_msg("%s, %s = %g: stopped at %g, a run at %g", method, name, x[i], o[0].stopped[i], expected);
            stopped += !isnan(o[0].stopped[i]);
        }
        forget(&o[0]);
        forget(&o[1]);
    }
    motus_system_destroy(s);
    if (stopped < 2 * stops || stopped == 2 * FEW)
        fail_msg("%s, step %g: %d stopped, of %d; at least %d should", method, step, stopped, 2 * FEW, 2 * stops);
}

static void some_diverge(void **state)
{
    (void)state;
    static const char drive[] = "F = 0.1\nx'' = -x + x^3 + F cos(t)\nx(0) = 0\nx'(0) = 0\n";
    static const double x[FEW] = {0.1, 50, -0.5, 1.5, 1e200};
    static const char *const methods[] = {"verlet",    "velocity-verlet", "leapfrog",       "rk4",
                                          "kahan-li8", "beeman",          "verlet-literal", "gauss4"};
    for (size_t k = 0; k < sizeof methods / sizeof *methods; k++) {
#ifdef SANITIZED
        if (k % 3) continue;
#endif
        stops_alike(drive, "x(0)", x, methods[k], 0.01, 20, 3, 3);
        if (strcmp(methods[k], "verlet-literal")) stops_alike(drive, "x(0)", x, methods[k], 0.3, 0.5, 1, 1);
    }
}

/* Trajectories with ends of their own stop when they would stop one at a time, whatever steps their lanes take
 * together. */
static void some_diverge_before_their_ends(void **state)
{
    (void)state;
    enum { MANY = 200 };
    static const char *const vary[] = {"k", "until"}, *const methods[] = {"verlet", "velocity-verlet", "rk4"};
    static double k[MANY], until[MANY];
    const double *values[] = {k, until};
    motus_system *s = given_text("k = 1\nx'' = k x^3\nx(0) = 1\nx'(0) = 0\n");
    for (int i = 0; i < MANY; i++) {
        k[i] = i % 3 ? -0.1 * (i * 37 % 80) : 1 + 0.1 * i;
        until[i] = 0.0501 * (i * 29 % 80 - 20);
    }
    for (size_t m = 0; m < sizeof methods / sizeof *methods; m++)
        for (int64_t every = 1; every <= 3; every += 2) {
            outcome o[2];
            for (int lanes = 0; lanes < 2; lanes++) {
                motus_ensemble_def def = define(vary, 2, methods[m], 0.01, NAN, lanes ? "compiled" : "interpreter");
                def.every = every;
                def.lanes = lanes ? 16 : 0;
                motus_ensemble *e = given_ensemble(s, &def, methods[m]);
                o[lanes] = go(e, MANY, def.record_count, values, methods[m]);
                motus_ensemble_destroy(e);
            }
            same_outcome(&o[0], &o[1], methods[m]);
            forget(&o[0]);
            forget(&o[1]);
        }
    motus_system_destroy(s);
}

static void a_domain_is_left(void **state)
{
    (void)state;
    static const char root[] = "c = 1\nx'' = -c sqrt(x)\nx(0) = 4\nx'(0) = 0\n",
                      pole[] = "c = 1\nx'' = 1/(x - c)\nx(0) = 1\nx'(0) = 0\n",
                      start[] = "c = 1\nx'' = -x\nx(0) = 1/c\nx'(0) = sqrt(c)\n";
    static const double c[FEW] = {1, 0.001, 2, 100, 0.002}, places[FEW] = {1, 3, 1, -2, 0},
                        signs[FEW] = {1, 0, -1, 4, 2}, wild[FEW] = {1, INFINITY, 2, NAN, 3};
    static const char *const methods[] = {"verlet", "rk4", "velocity-verlet"};
    for (size_t k = 0; k < 3; k++) {
        stops_alike(root, "c", c, methods[k], 0.01, 10, 1, 3);
        stops_alike(pole, "c", places, methods[k], 0.01, 1, 5, 2);
        stops_alike(start, "c", signs, methods[k], 0.01, 1, 1, 2);
        stops_alike(start, "x(0)", wild, methods[k], 0.01, 1, 1, 2);
        stops_alike(root, "c", wild, methods[k], 0.01, 1, 1, 2);
    }
}

static void no_solution(void **state)
{
    (void)state;
    static const char text[] = "x'' = exp(x')\nx(0) = 0\nx'(0) = 1\n";
    static const double v[FEW] = {1, -8, -9, 0.9, -10};
    stops_alike(text, "x'(0)", v, "implicit-midpoint", 2, 10, 1, 2);
}

/* A trajectory whose neighbours stopped costs no more than before: it is not computed step by step in every chunk. */
static atomic_long accelerations;
static int softening(void *context, size_t first, size_t count, double t, const double *x, const double *v, double *a)
{
    (void)context, (void)first, (void)t, (void)v;
    accelerations += (long)count;
    for (size_t j = 0; j < count; j++) a[j] = -x[j] + x[j] * x[j] * x[j];
    return 0;
}

static void stopped_trajectories_cost_nothing(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    motus_callback_def callback = motus_default_callback();
    motus_system *s = NULL;
    const double zero = 0;
    callback.positions = 1;
    callback.x = callback.v = &zero;
    callback.block = softening;
    callback.depends_on_velocity = 0;
    must(motus_system_from_callback(&callback, &s, &err), &err, "softening");
    static const char *const names[] = {"x(0)"};
    enum { COUNT = 64 };
    double x[COUNT];
    long of[2];
    const double *values[] = {x};
    motus_ensemble_def def = define(names, 1, "velocity-verlet", 0.01, 200, NULL);
    def.record_count = 1;
    for (int lost = 0; lost < 2; lost++) {
        motus_ensemble *e = given_ensemble(s, &def, "lost");
        for (int i = 0; i < COUNT; i++) x[i] = lost && i % 4 == 0 ? 100 : 0.01 * i;
        accelerations = 0;
        outcome o = go(e, COUNT, 1, values, "lost");
        of[lost] = accelerations;
        assert_true(isnan(o.stopped[0]) == !lost);
        forget(&o);
        motus_ensemble_destroy(e);
    }
    motus_system_destroy(s);
    print_message("with every fourth trajectory lost: %ld accelerations in place of %ld\n", of[1], of[0]);
    assert_true(of[0] >= 20000 * COUNT && of[1] < of[0] + of[0] / 10);
}

/* Requests that are refused ---------------------------------------------------------------------------------------- */

static const char model_text[] =
    "N = 3\nh = 0.01\nT = 2\nL = 1 + 1\ng = (0, -9.81)\nm = [1, 2]\nkay = 2\nfrom_here = 0\n"
    "r'' = g - kay r\nr(from_here) = (0, 1)\nr'(0) = (1, 2)\nz'' = -z\nz(0) = 1\nz'(0) = 0\n"
    "u[i]'' = -m[2] u[i] for i = 1..N\nu[i](0) = i for i = 1..N\nu[i]'(0) = 0 for i = 1..N\n"
    "w = sum(i = 1..L: u[i])\nspeed = |r'|\ninvariant e = z^2 + z'^2\nstep h\nuntil 2 T\n";

static void refused(motus_system *s, const motus_ensemble_def *def, motus_status expected, const char *part)
{
    motus_error err = motus_default_error();
    motus_ensemble *e = (motus_ensemble *)&err;
    motus_status status = motus_ensemble_create(s, def, &e, &err);
    if (status != expected || (!strstr(err.message, part) && !strstr(err.hint, part)))
        fail_msg("%s: %s, %s (%s), and %s with \"%s\" was due",
                 def->vary_count && def->vary && def->vary[0] ? def->vary[0] : "", motus_status_word(status),
                 err.message, err.hint, motus_status_word(expected), part);
    assert_null(e);
    assert_int_equal(err.status, expected);
    assert_int_equal(motus_ensemble_create(s, def, &e, NULL), expected);
}

static void names(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        motus_status status;
        const char *part;
    } cases[] = {{"key", MOTUS_NAME, "kay"},
                 {"F", MOTUS_NAME, "neither a parameter"},
                 {"", MOTUS_NAME, "neither"},
                 {"speed", MOTUS_NAME, "computed along the way"},
                 {"g", MOTUS_SHAPE, "g.x"},
                 {"m", MOTUS_SHAPE, "m[1]"},
                 {"m[3]", MOTUS_SHAPE, "m[1]"},
                 {"m[0]", MOTUS_NAME, "neither"},
                 {"m[1", MOTUS_NAME, "neither"},
                 {"m[1]x", MOTUS_NAME, "neither"},
                 {"g.z", MOTUS_SHAPE, "component"},
                 {"g.w", MOTUS_NAME, "neither"},
                 {"kay.x", MOTUS_SHAPE, "no components"},
                 {"kay'", MOTUS_NAME, "neither"},
                 {"r(0)", MOTUS_SHAPE, "r.x(0)"},
                 {"u(0)", MOTUS_SHAPE, "u[1](0)"},
                 {"u[4](0)", MOTUS_NAME, "neither"},
                 {"z", MOTUS_NAME, "z(0)"},
                 {"z(1)", MOTUS_NAME, "the start is 0"},
                 {"z(nan)", MOTUS_NAME, "neither"},
                 {"z()", MOTUS_NAME, "neither"},
                 {"z(0x0)", MOTUS_NAME, "neither"},
                 {"z(0", MOTUS_NAME, "neither"},
                 {"z''(0)", MOTUS_NAME, "neither"},
                 {"speed(0)", MOTUS_NAME, "neither"},
                 {"t(0)", MOTUS_NAME, "neither"},
                 {"N", MOTUS_ARGUMENT, "size"},
                 {"L", MOTUS_ARGUMENT, "size"},
                 {"h", MOTUS_ARGUMENT, "step"},
                 {"T", MOTUS_ARGUMENT, "the end"},
                 {"from_here", MOTUS_ARGUMENT, "the start"}};
    motus_system *s = given_text(model_text);
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
        for (int m = 0; m < 2; m++) {
            motus_ensemble_def def = define(&cases[k].name, 1, "verlet", NAN, NAN, m ? "interpreter" : NULL);
            refused(s, &def, cases[k].status, cases[k].part);
        }
    char name[300];
    memset(name, 'x', sizeof name);
    memcpy(name + sizeof name - 4, "(0)", 4);
    const char *list[] = {name};
    motus_ensemble_def def = define(list, 1, "verlet", NAN, NAN, NULL);
    refused(s, &def, MOTUS_NAME, "neither");
    /* The caller's step and end. */
    static const char *const of_time[] = {"h", "T"}, *const twice[] = {"kay", "g.y", "kay"},
                             *const same_place[] = {"u[2](0)", "u[2](0.0)"}, *const none[] = {NULL};
    def = define(of_time, 2, "verlet", 0.01, 1, "interpreter");
    motus_ensemble_destroy(given_ensemble(s, &def, "own step and end"));
    def.step = NAN;
    refused(s, &def, MOTUS_ARGUMENT, "step");
    def = define(twice, 3, "verlet", NAN, NAN, NULL);
    refused(s, &def, MOTUS_ARGUMENT, "kay varies twice");
    def.vary = same_place;
    def.vary_count = 2;
    refused(s, &def, MOTUS_ARGUMENT, "varies twice");
    def.vary = none;
    def.vary_count = 1;
    refused(s, &def, MOTUS_ARGUMENT, "NULL");
    motus_system_destroy(s);
}

/* The end varies where the definition has none; one that no run could have is refused before anything is computed. */
static void ends_that_differ(motus_system *s, double *const *at)
{
    const char *const end[] = {"until"}, *const both[] = {"until", "until"};
    motus_ensemble *e = NULL;
    motus_error err = motus_default_error();
    motus_ensemble_def def = define(end, 1, "verlet", 0.01, 3, NULL);
    assert_int_equal(motus_ensemble_create(s, &def, &e, &err), MOTUS_ARGUMENT);
    assert_non_null(strstr(err.message, "only one of them"));
    def = define(both, 2, "verlet", 0.01, NAN, NULL);
    assert_int_equal(motus_ensemble_create(s, &def, &e, &err), MOTUS_ARGUMENT);
    assert_non_null(strstr(err.message, "until varies twice"));
    static const struct {
        double end;
        const char *method, *words;
        motus_status status;
    } cases[] = {{INFINITY, "verlet", "finite", MOTUS_ARGUMENT},
                 {NAN, "verlet", "not a number", MOTUS_ARGUMENT},
                 {1e17, "verlet", "steps", MOTUS_LIMIT},
                 {0.015, "verlet-literal", "equal steps", MOTUS_METHOD}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
        for (int m = 0; m < 2; m++) {
            const double ends[] = {0.5, cases[k].end}, *values[] = {ends};
            def = define(end, 1, cases[k].method, 0.01, NAN, m ? "interpreter" : "compiled");
            must(motus_ensemble_create(s, &def, &e, &err), &err, "ends");
            assert_int_equal(motus_ensemble_now(e).steps, 0);
            at[0][0] = 77;
            assert_int_equal(motus_ensemble_check(e, 1, values, &err), MOTUS_OK);
            assert_int_equal(motus_ensemble_check(e, 2, values, &err), cases[k].status);
            assert_int_equal(motus_ensemble_run(e, 2, values, at, NULL, &err), cases[k].status);
            assert_non_null(strstr(err.message, "until, value 2 of 2"));
            assert_non_null(strstr(err.message, cases[k].words));
            assert_true(at[0][0] == 77);
            must(motus_ensemble_run(e, 1, values, at, NULL, &err), &err, "one end");
            assert_true(at[0][0] != 77);
            motus_ensemble_destroy(e);
        }
}

static void definitions(void **state)
{
    (void)state;
    motus_system *s = given_text(model_text);
    static const char *const vary[] = {"kay"};
    const motus_ensemble_def good = define(vary, 1, "verlet", NAN, 0.05, "interpreter");
    motus_record bad[] = {{MOTUS_REDUCE_FINAL, 1000}, {(motus_reduction)77, 1}};
    motus_ensemble_def def;
#define BAD(change, status, part)       \
    do {                                \
        def = good;                     \
        change;                         \
        refused(s, &def, status, part); \
    } while (0)
    BAD(def.lanes = 3, MOTUS_ARGUMENT, "power of two");
    BAD(def.lanes = -1, MOTUS_ARGUMENT, "power of two");
    BAD(def.lanes = 128, MOTUS_ARGUMENT, "power of two");
    BAD(def.threads = -1, MOTUS_ARGUMENT, "threads");
    BAD(def.threads = 1 << 20, MOTUS_ARGUMENT, "threads");
    BAD(def.every = 0, MOTUS_ARGUMENT, "every");
    BAD(def.every = -3, MOTUS_ARGUMENT, "every");
    BAD(def.machine = "abacus", MOTUS_ARGUMENT, "abacus");
    BAD(def.records = NULL, MOTUS_ARGUMENT, "`records`");
    BAD(def.record_count = 0, MOTUS_ARGUMENT, "recorded");
    BAD((def.records = bad, def.record_count = 1), MOTUS_ARGUMENT, "column 1000");
    BAD((def.records = bad + 1, def.record_count = 1), MOTUS_ARGUMENT, "no reduction");
    BAD(def.vary = NULL, MOTUS_ARGUMENT, "`vary`");
    BAD(def.method = "rk5000", MOTUS_METHOD, "rk5000");
    BAD(def.method = "boris", MOTUS_METHOD, "boris");
    BAD(def.step = 0, MOTUS_ARGUMENT, "step");
    BAD(def.step = -1, MOTUS_ARGUMENT, "step");
    BAD(def.until = INFINITY, MOTUS_ARGUMENT, "finite");
    BAD((def.step = 1e-300), MOTUS_LIMIT, "steps");
#undef BAD
    motus_ensemble *e = NULL;
    assert_int_equal(motus_ensemble_create(NULL, &good, &e, NULL), MOTUS_ARGUMENT);
    assert_int_equal(motus_ensemble_create(s, NULL, &e, NULL), MOTUS_ARGUMENT);
    assert_int_equal(motus_ensemble_create(s, &good, NULL, NULL), MOTUS_ARGUMENT);
    e = given_ensemble(s, &good, "good");
    double x[2] = {1, 2}, room[RECORDS][2], *at[RECORDS], *some[RECORDS] = {NULL};
    const double *values[] = {x}, *nothing[] = {NULL};
    for (size_t r = 0; r < RECORDS; r++) at[r] = room[r];
    assert_int_equal(motus_ensemble_run(NULL, 2, values, at, NULL, NULL), MOTUS_ARGUMENT);
    assert_int_equal(motus_ensemble_run(e, 2, NULL, at, NULL, NULL), MOTUS_ARGUMENT);
    assert_int_equal(motus_ensemble_run(e, 2, nothing, at, NULL, NULL), MOTUS_ARGUMENT);
    assert_int_equal(motus_ensemble_run(e, 2, values, NULL, NULL, NULL), MOTUS_ARGUMENT);
    assert_int_equal(motus_ensemble_run(e, 2, values, some, NULL, NULL), MOTUS_ARGUMENT);
    assert_int_equal(motus_ensemble_run(e, 0, values, at, NULL, NULL), MOTUS_OK);
    assert_int_equal(motus_ensemble_run(e, 2, values, at, NULL, NULL), MOTUS_OK); /* `stopped` may be NULL */
    assert_true(isfinite(room[0][1]));
    assert_int_equal(motus_ensemble_check(e, 2, values, NULL), MOTUS_OK);
    assert_int_equal(motus_ensemble_check(e, 2, nothing, NULL), MOTUS_ARGUMENT);
    assert_int_equal(motus_ensemble_check(NULL, 2, values, NULL), MOTUS_ARGUMENT);
    assert_int_equal(motus_ensemble_pilots(e, 2, nothing, NULL), MOTUS_ARGUMENT);
    assert_int_equal(motus_ensemble_pilots(NULL, 2, values, NULL), MOTUS_ARGUMENT);
    motus_ensemble_destroy(e);
    ends_that_differ(s, at);
    motus_ensemble_destroy(NULL);
    const motus_ensemble_statistics none = motus_ensemble_now(NULL);
    assert_true(none.steps == 0 && none.lanes == 1 && none.threads == 1);
    assert_string_equal(none.note, "");
    motus_system_destroy(s);
}

/* Sharing a system ------------------------------------------------------------------------------------------------- */

static char *everything_about(motus_system *s)
{
    static char text[20000];
    size_t n = 0;
    motus_column c = motus_default_column();
    n += (size_t)snprintf(text + n, sizeof text - n, "%s", motus_explain(s));
    for (size_t k = 0; motus_equation_text(s, k) && n < sizeof text; k++)
        n += (size_t)snprintf(text + n, sizeof text - n, "%s\n", motus_equation_text(s, k));
    for (size_t k = 0; motus_column_at(s, k, &c) == MOTUS_OK && n < sizeof text; k++)
        n += (size_t)snprintf(text + n, sizeof text - n, "%s %d\n", c.name, (int)c.kind);
    assert_true(n < sizeof text);
    return strdup(text);
}

/* Runs begun before, between and after ensembles, and unfinished runs, keep the model's own numbers. */
static void a_system_is_left_as_it_was(void **state)
{
    (void)state;
    static const char text[] = "A = 1\nk = 2\nu[i]'' = k (u[i+1] - 2 u[i] + u[i-1]) for i = 1..4\nu[0] = A\nu[5] = k "
                               "sin(t)\nu[i](0) = A i for i = 1..4\nu[i]'(0) = 0 for i = 1..4\n"
                               "x'' = -k x\nx(0) = A\nx'(0) = k\nq = k x + u[0]\n";
    static const char *const vary[] = {"A", "k"}, *const machines[] = {"interpreter", "compiled"},
                             *const methods[] = {"gauss4", "leapfrog"};
    const double a[3] = {2, 3, -4}, k[3] = {1, 5, -1}, *const values[] = {a, k};
    for (int m = 0; m < 2; m++)
        for (int n = 0; n < 2; n++) {
            motus_system *s = given_text(text), *untouched = given_text(text);
            char *before = everything_about(s);
            motus_run *half = given_run(s, methods[n], 0.1, 2), *whole = given_run(untouched, methods[n], 0.1, 2);
            take_steps(half, 7);
            motus_ensemble_def def = define(vary, 2, methods[n], 0.1, 1.05, machines[m]);
            motus_ensemble *one = given_ensemble(s, &def, "one");
            def.vary_count = 1;
            def.every = 3;
            motus_ensemble *other = given_ensemble(s, &def, "other");
            outcome first = go(one, 3, RECORDS, values, "first");
            finish(half);
            finish(whole);
            same_state(s, half, whole, "a run half done while an ensemble ran");
            assert_true(same_number(value(s, half, "q"), value(untouched, whole, "q")));
            motus_run *after = given_run(s, methods[n], 0.1, 2);
            finish(after);
            same_state(s, after, whole, "a run after an ensemble");
            outcome between = go(other, 3, RECORDS, values, "other"), second = go(one, 3, RECORDS, values, "second");
            same_outcome(&first, &second, "twice");
            motus_ensemble *fresh = given_ensemble(untouched, &def, "fresh");
            outcome alone = go(fresh, 3, RECORDS, values, "fresh");
            same_outcome(&between, &alone, "beside another ensemble");
            char *later = everything_about(s);
            assert_string_equal(before, later);
            free(before);
            free(later);
            forget(&first);
            forget(&between);
            forget(&second);
            forget(&alone);
            motus_ensemble_destroy(one);
            motus_ensemble_destroy(other);
            motus_ensemble_destroy(fresh);
            motus_run_destroy(half);
            motus_run_destroy(whole);
            motus_run_destroy(after);
            motus_system_destroy(s);
            motus_system_destroy(untouched);
        }
}

/* Without varied numbers all trajectories are the model's. */
static void nothing_varies(void **state)
{
    (void)state;
    motus_system *s = given_text(model_text);
    for (int m = 0; m < 2; m++) {
        motus_ensemble_def def = define(NULL, 0, "leapfrog", NAN, 0.055, m ? "compiled" : "interpreter");
        motus_ensemble *e = given_ensemble(s, &def, "nothing varies");
        outcome o = go(e, 3, RECORDS, NULL, "nothing varies");
        motus_run *r = given_run(s, "leapfrog", NAN, 0.055);
        finish(r);
        for (size_t i = 0; i < 3; i++) assert_true(same_number(o.at[0][i], value(s, r, "r.x")));
        motus_run_destroy(r);
        forget(&o);
        motus_ensemble_destroy(e);
    }
    motus_system_destroy(s);
}

/* Whether boris is admitted is checked for each trajectory's parameters; afterwards the system is unchanged. */
static void a_method_that_no_longer_fits(void **state)
{
    (void)state;
    motus_system *s = given_text(
        "k = 0\nx'' = y' - k x'\ny'' = -x' - k y'\nx(0) = 1\ny(0) = 0\nx'(0) = 0\ny'(0) = 1\nstep 0.01\nuntil 0.1\n");
    static const char *const vary[] = {"k"};
    const double k[2] = {0, 0.5}, *values[] = {k};
    double results[2], *places[] = {results};
    const motus_record record = {MOTUS_REDUCE_FINAL, 1};
    motus_ensemble_def def = motus_default_ensemble();
    motus_error err = motus_default_error();
    motus_ensemble *e;
    def.vary = vary;
    def.vary_count = 1;
    def.records = &record;
    def.record_count = 1;
    def.method = "boris";
    def.machine = "interpreter";
    assert_int_equal(motus_ensemble_create(s, &def, &e, &err), MOTUS_OK);
    assert_int_equal(motus_ensemble_run(e, 1, values, places, NULL, &err), MOTUS_OK);
    assert_int_equal(motus_ensemble_run(e, 2, values, places, NULL, &err), MOTUS_METHOD);
    assert_non_null(strstr(err.message, "boris"));
    assert_int_equal(motus_method_admits(s, "boris", NULL), MOTUS_OK);
    assert_int_equal(motus_ensemble_run(e, 1, values, places, NULL, &err), MOTUS_OK);
    motus_ensemble_destroy(e);
    motus_system_destroy(s);
}

static void observed_and_cancelled(void **state)
{
    (void)state;
    static const char *const vary[] = {"x(0)"};
    enum { COUNT = 300 };
    double x[COUNT], result[COUNT], *at[] = {result};
    const double *values[] = {x};
    for (int i = 0; i < COUNT; i++) x[i] = 0.01 * i;
    for (int m = 0; m < 3; m++) { /* many short ones; a single long one; lanes */
        motus_system *s = given_text("x'' = -sin(x)\nx(0) = 0\nx'(0) = 0\n");
        const size_t count = m == 1 ? 1 : COUNT;
        given_progress w = {0, 3, 0};
        motus_ensemble_def def = define(vary, 1, "kahan-li8", 0.001,
                                        m == 0   ? 1
                                        : m == 1 ? 400
                                                 : 200,
                                        m < 2 ? "interpreter" : "compiled");
        def.record_count = 1;
        def.progress = given_observe;
        def.context = &w;
        motus_ensemble *e = given_ensemble(s, &def, "observed");
        motus_error err = motus_default_error();
        assert_int_equal(motus_ensemble_run(e, count, values, at, NULL, &err), MOTUS_CANCELLED);
        assert_int_equal(w.calls, 3);
        assert_true(w.last < 0.9 && strstr(err.message, "cancelled"));
        /* After a cancelled call the ensemble works, and the model has its own numbers. */
        motus_run *r = given_run(s, "kahan-li8", 0.01, 1);
        finish(r);
        assert_true(value(s, r, "x") == 0);
        motus_run_destroy(r);
        motus_ensemble_destroy(e);
        motus_system_destroy(s);
    }
}

/* Without a compiler the interpreter computes the ensemble, and a note says why; machine "compiled" is refused. */
static void without_a_compiler(void **state)
{
    (void)state;
    char *path = strdup(getenv("PATH"));
    setenv("PATH", "/nowhere", 1);
    unsetenv("CC");
    motus_system *s = given_text("k = 1\nx'' = -k x + 1\nx(0) = 1\nx'(0) = 0\n");
    static const char *const vary[] = {"k"};
    motus_ensemble_def def = define(vary, 1, "leapfrog", 0.1, 1, "auto");
    motus_ensemble *e = given_ensemble(s, &def, "no compiler");
    assert_string_equal(motus_ensemble_now(e).machine, "interpreter");
    assert_non_null(strstr(motus_ensemble_now(e).note, "no C compiler"));
    motus_ensemble_destroy(e);
    def.machine = "compiled";
    refused(s, &def, MOTUS_TOOL, "no C compiler");
    motus_system_destroy(s);
    setenv("PATH", path, 1);
    free(path);
}

int main(void)
{
    open_cache();
    const struct CMUnitTest tests[] = {cmocka_unit_test(some_diverge),
                                       cmocka_unit_test(some_diverge_before_their_ends),
                                       cmocka_unit_test(a_domain_is_left),
                                       cmocka_unit_test(no_solution),
                                       cmocka_unit_test(stopped_trajectories_cost_nothing),
                                       cmocka_unit_test(names),
                                       cmocka_unit_test(definitions),
                                       cmocka_unit_test(a_system_is_left_as_it_was),
                                       cmocka_unit_test(nothing_varies),
                                       cmocka_unit_test(a_method_that_no_longer_fits),
                                       cmocka_unit_test(observed_and_cancelled),
                                       cmocka_unit_test(without_a_compiler)};
    int failed = cmocka_run_group_tests_name("ensembles that meet trouble", tests, NULL, NULL);
    close_cache();
    return failed;
}
