/* Traced steps: the trace of a step gives its end by the published formulas, and tracing changes no bit.
 *
 * For every model of models/, other models with every kind of force, and callbacks, by every method that they admit;
 * forward and backward, over the shorter last step; by the compiled machine too.
 */
#include "api/system/system.h"
#include "core/rows.h"
#include "core/stepper.h"
#include "test/ensemble_given.h"
#include "test/trace_replay.h"

#include <stdbool.h>

enum { STEPS = 9 };

static motus_run *create(motus_system *s, const char *method, double step, double until, const char *machine)
{
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    def.method = method;
    given_step(&def, step);
    /* an adaptive method: few steps; stages that solve an equation are as exact as the tolerance */
    if (isnan(def.step)) def.tolerance = strcmp(method, "radau15") ? 1e-4 : 1e-15;
    def.until = until;
    def.machine = machine;
    def.switches = MOTUS_SWITCHES_STEP; /* a step that ends at a switch cannot be traced */
    must(motus_run_create(s, &def, &r, &err), &err, method);
    return r;
}

static void same_saved(motus_run *a, motus_run *b, const char *what)
{
    const char *p, *q;
    size_t n, m;
    motus_error err = motus_default_error();
    must(motus_run_save(a, &p, &n, &err), &err, what);
    must(motus_run_save(b, &q, &m, &err), &err, what);
    if (n != m || memcmp(p, q, n))
        fail_msg("%s, %s: what is carried differs:\n%s\n%s", what, motus_run_now(a).method, p, q);
}

static void same_numbers(const double *p, const double *q, size_t n, const char *what, const char *method)
{
    for (size_t k = 0; k < n; k++)
        if (memcmp(&p[k], &q[k], sizeof *p))
            fail_msg("%s, %s: number %zu is %a in one and %a in the other", what, method, k, p[k], q[k]);
}

/* Three runs: not traced and observed once, at the end; all steps traced; every other step traced. */
static void one(motus_system *s, const char *name, double h, double until, const char *machine, const char *what)
{
    const motus_method *m;
    motus_error err = motus_default_error();
    must(motus_method_find(name, &m, &err), &err, name);
    const size_t nx = motus_positions(s), nv = motus_velocities(s);
    motus_run *plain = create(s, name, h, until, "auto"), *traced = create(s, name, h, until, machine),
              *mixed = create(s, name, h, until, machine);
    double *kept = calloc(2 * (nx + 2 * nv) + 1, sizeof *kept), *now = kept + nx + nv, *before = now + nx;
    assert_non_null(kept);
    int64_t total = motus_run_now(traced).steps_total;
    if (m->adaptive) {
        motus_run *whole = create(s, name, h, until, "interpreter");
        finish(whole);
        total = motus_run_steps(whole);
        motus_run_destroy(whole);
    }
    for (int64_t n = 0; n < total; n++) {
        const motus_trace_entry *const *e;
        size_t count;
        const int64_t iterations = motus_run_now(traced).iterations;
        const double start = motus_run_time(traced);
        must(motus_run_trace(traced, &e, &count, &err), &err, name);
        assert_true(count >= 2);
        const motus_trace_entry *first = e[0], *end = e[count - 1];
        assert_true(first->time == start && end->time == motus_run_time(traced));
        assert_int_equal(motus_run_steps(traced), n + 1);
        assert_int_equal(end->iterations, motus_run_now(traced).iterations - iterations);
        /* the shorter step is a new leg */
        const bool again = n > 0 && !(n == total - 1 && motus_run_now(traced).shorter_last != 0);
        trace_replay(s, m, e, count, again ? now : NULL, again ? before : NULL, what);
        memcpy(now, first->x, nx * sizeof *now);
        if (first->a) memcpy(before, first->a, nv * sizeof *before);
        take_steps(plain, 1);
        motus_run *fresh = create(s, name, h, until, "interpreter");
        take_steps(fresh, n + 1);
        must(motus_run_state(fresh, kept, kept + nx, &err), &err, name);
        same_numbers(end->x, kept, nx, what, name);
        same_numbers(end->v, kept + nx, nv, what, name);
        motus_run_destroy(fresh);
        if (n % 2)
            must(motus_run_trace(mixed, &e, &count, &err), &err, name);
        else
            take_steps(mixed, 1);
    }
    for (int i = 0; i < 2; i++) {
        motus_run *r = i ? mixed : traced;
        assert_true(motus_run_done(r));
        same_state(s, plain, r, what);
        same_saved(plain, r, what);
        assert_int_equal(motus_run_now(r).evaluations, motus_run_now(plain).evaluations);
        assert_int_equal(motus_run_now(r).iterations, motus_run_now(plain).iterations);
        assert_int_equal(motus_run_steps(r), total);
    }
    const motus_trace_entry *const *e = (const motus_trace_entry *const *)kept;
    size_t count = 7;
    must(motus_run_trace(traced, &e, &count, &err), &err, name);
    assert_true(count == 0 && !e); /* no step is left */
    free(kept);
    motus_run_destroy(plain);
    motus_run_destroy(traced);
    motus_run_destroy(mixed);
}

/* Of the adaptive methods one of each form: a last stage at the end or none, two estimates, Nyström's, coupled
 * stages, reversible steps. */
static bool telling(const char *name)
{
    static const char *const names[] = {
        "dopri5",           "dop853", "dep6", "fine5", "radau15", "verlet-reversible", "kahan-li8-reversible",
        "gauss8-reversible"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (!strcmp(name, names[i])) return true;
    return false;
}

static int every_method(motus_system *s, double h, double way, const char *machine, const char *what)
{
    motus_settings set = motus_default_settings();
    motus_settings_of(s, &set);
    int count = 0;
    for (size_t k = 0; k <= motus_method_count(); k++) {
        const char *name = k < motus_method_count() ? motus_method_at(k)->name : "newmark(1/6, 0.6)";
        if (motus_method_admits(s, name, NULL) != MOTUS_OK || (given_adaptive(name) && !telling(name))) continue;
        const bool uniform = !strcmp(name, "verlet-literal");
        one(s, name, h, set.from + way * h * (STEPS + (uniform ? 0 : 0.4)), machine, what);
        count++;
    }
    return count;
}

static const char *const models[] = {"arenstorf",
                                     "chain",
                                     "charged-particle",
                                     "comet",
                                     "crossed-fields",
                                     "damped-cubic",
                                     "damped-spring",
                                     "double-pendulum",
                                     "driven-oscillator",
                                     "duffing",
                                     "henon-heiles",
                                     "kepler",
                                     "outer-solar-system",
                                     "pendulum",
                                     "penning-trap",
                                     "projectile-drag",
                                     "projectile",
                                     "resonance",
                                     "spring",
                                     "three-body-figure-eight",
                                     "thrown-ball",
                                     "thrown-ball-air",
                                     "ueda",
                                     "van-der-pol"};

static void every_model(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof models / sizeof *models; i++) {
        char file[64];
        snprintf(file, sizeof file, "%s.motus", models[i]);
        motus_system *s = given_model(file, NULL, 0);
        motus_settings set = motus_default_settings();
        motus_settings_of(s, &set);
        assert_true(every_method(s, set.step, 1, "interpreter", models[i]) >= 10);
        motus_system_destroy(s);
    }
}

static const char *const texts[] = {
    "g = (0, -9.81)\nr'' = g\nr(0) = (0, 0)\nr'(0) = (1, 4.5)\nstep 0.05\nuntil 3\n",
    "x'' = -x + x^3 + 0.1 cos(t)\nx(0) = 0.3\nx'(0) = 0.1\ns' = x\ns(0) = 0.5\nstep 0.05\nuntil 3\n",
    "y'' = -9.81 - 0.1 y' |y'|\ny(0) = 1\ny'(0) = 3\ns' = y'^2 - s\ns(0) = 0.5\nstep 0.05\nuntil 3\n",
    "N = 5\nx[i]'' = x[i+1] - 2 x[i] + x[i-1] - 0.1 x[i]'^3   for i = 1..N\nx[0] = sin(t)\nx[N+1] = 0\n"
    "x[i](0) = i   for i = 1..N\nx[i]'(0) = 0   for i = 1..N\nr'' = -r\nr(0) = (1, 2)\nr'(0) = (0, 1)\nstep "
    "0.05\nuntil 3\n",
    "N = 5\nx[i]'' = x[i+1] - 2 x[i] + x[i-1]   for i = 1..N\nx[0] = sin(t)\nx[N+1] = 0\n"
    "x[i](0) = i   for i = 1..N\nx[i]'(0) = 0   for i = 1..N\nr'' = -r\nr(0) = (1, 2)\nr'(0) = (0, 1)\nstep "
    "0.05\nuntil 3\n",
    "x'' = -x^3 + 0.1 cos(t)\nx(0) = 0.3\nx'(0) = 0.1\ns' = x'^2 + t x\ns(0) = 0.5\nstep 0.05\nuntil 3\n",
    "s' = -s\ns(0) = 1\nexact s = exp(-t)\nstep 0.05\nuntil 3\n",
};

static void every_force(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        for (int back = 0; back < 2; back++) {
            motus_system *s = given_text(texts[i]);
            assert_true(every_method(s, 0.05, back ? -1 : 1, "interpreter", texts[i]) >= 10);
            motus_system_destroy(s);
        }
}

/* ---- callbacks ---- */

typedef struct wall {
    double after;
} wall; /* beyond this time the callback fails; 0: never */

static int spring(void *context, double t, const double *x, const double *v, double *a)
{
    const wall *w = context;
    a[0] = -x[0] + cos(t);
    a[1] = -x[1] * x[1] * x[1] + x[0];
    a[2] = x[0];
    (void)v;
    return w->after > 0 && t > w->after;
}

static motus_system *from_callback(wall *w, bool velocity)
{
    static const double x[2] = {1, 2}, v[3] = {0, 1, 0};
    motus_callback_def def = motus_default_callback();
    motus_error err = motus_default_error();
    motus_system *s = NULL;
    def.positions = 2;
    def.first_order = 1;
    def.x = x;
    def.v = v;
    def.acceleration = spring;
    def.depends_on_velocity = velocity;
    def.context = w;
    must(motus_system_from_callback(&def, &s, &err), &err, "callback");
    return s;
}

static void callbacks(void **state)
{
    (void)state;
    for (int velocity = 0; velocity < 2; velocity++) {
        wall w = {0};
        motus_system *s = from_callback(&w, velocity);
        for (size_t k = 0; k < motus_method_count(); k++) {
            const char *name = motus_method_at(k)->name;
            if (motus_method_admits(s, name, NULL) == MOTUS_OK)
                one(s, name, 0.05, strcmp(name, "verlet-literal") ? 0.47 : 0.45, NULL,
                    velocity ? "callback of x, v, t" : "callback of x, t");
        }
        motus_system_destroy(s);
    }
}

/* ---- the compiled machine ---- */

static void compiled_too(void **state)
{
    (void)state;
    static const char *const some[][2] = {{"charged-particle.motus", "boris"}, {"chain.motus", "verlet"},
                                          {"chain.motus", "velocity-verlet"},  {"duffing.motus", "rk4"},
                                          {"damped-cubic.motus", "gauss4"},    {"chain.motus", "kahan-li6"},
                                          {"projectile.motus", "beeman"}};
    for (size_t i = 0; i < sizeof some / sizeof *some; i++) {
        motus_system *s = given_model(some[i][0], NULL, 0);
        motus_settings set = motus_default_settings();
        motus_settings_of(s, &set);
        one(s, some[i][1], set.step, set.from + set.step * (STEPS + 0.4), "compiled", some[i][0]);
        motus_system_destroy(s);
    }
    /* Large enough for windows and tiles, with untraced steps in between that are taken in one sweep. */
    const char *const many[] = {"N=20000"};
    for (int i = 0; i < 2; i++) {
        const char *method = i ? "velocity-verlet" : "leapfrog";
        motus_system *s = given_model("chain.motus", many, 1);
        motus_run *plain = create(s, method, 0.1, 2.05, "compiled"), *traced = create(s, method, 0.1, 2.05, "compiled");
        motus_error err = motus_default_error();
        finish(plain);
        while (!motus_run_done(traced)) {
            const motus_trace_entry *const *e;
            size_t count;
            take_steps(traced, 6);
            must(motus_run_trace(traced, &e, &count, &err), &err, method);
        }
        same_state(s, plain, traced, "20000 masses");
        same_saved(plain, traced, "20000 masses");
        motus_run_destroy(plain);
        motus_run_destroy(traced);
        motus_system_destroy(s);
    }
}

/* ---- what goes wrong ---- */

/* The traced run has the same error as the untraced one that is observed after each step, and stands where that one
 * stands. */
static void same_failure(motus_system *s, const char *method, double h, motus_status expected, const char *what)
{
    motus_run *plain = create(s, method, h, 1000 * h, NULL), *traced = create(s, method, h, 1000 * h, NULL);
    motus_error one = motus_default_error(), two = motus_default_error();
    const motus_trace_entry *const *e = NULL;
    size_t count = 0;
    double x[8], v[8];
    motus_status status = MOTUS_OK;
    for (int n = 0; n < 4000 && status == MOTUS_OK; n++) {
        status = motus_run_step(plain, 1, &one);
        if (status == MOTUS_OK) status = motus_run_state(plain, x, v, &one);
        const motus_status other = motus_run_trace(traced, &e, &count, &two);
        if (other != status)
            fail_msg("%s, %s, step %d: %s and %s", what, method, n + 1, motus_status_word(status),
                     motus_status_word(other));
    }
    assert_int_equal(status, expected);
    assert_true(count == 0 && !e);
    if (strcmp(one.message, two.message) || strcmp(one.hint, two.hint) || strcmp(one.variable, two.variable) ||
        one.time != two.time)
        fail_msg("%s, %s: \"%s\" and \"%s\"", what, method, one.message, two.message);
    assert_int_equal(motus_run_steps(plain), motus_run_steps(traced));
    assert_int_equal(motus_run_now(plain).evaluations, motus_run_now(traced).evaluations);
    same_saved(plain, traced, what);
    motus_run_destroy(plain);
    motus_run_destroy(traced);
}

static void failures(void **state)
{
    (void)state;
    static const char escaping[] = "x'' = exp(x)\nx(0) = 1\nx'(0) = 1\nstep 0.1\nuntil 9\n",
                      rough[] = "x'' = -1e9 sin(1e6 x)\nx(0) = 1\nx'(0) = 0\nstep 0.1\nuntil 9\n";
    motus_system *s = given_text(escaping), *hard = given_text(rough);
    for (size_t k = 0; k < motus_method_count(); k++) {
        const motus_method *m = motus_method_at(k);
        if (motus_method_admits(s, m->name, NULL) != MOTUS_OK || m->evaluations == 0) continue;
        same_failure(s, m->name, 0.5, MOTUS_DIVERGED, "escaping");
        wall w = {.after = 1};
        motus_system *p = from_callback(&w, false);
        if (motus_method_admits(p, m->name, NULL) == MOTUS_OK)
            same_failure(p, m->name, 0.3, MOTUS_CALLBACK, "callback");
        motus_system_destroy(p);
    }
    same_failure(hard, "implicit-midpoint", 0.1, MOTUS_SOLVE, "rough");
    same_failure(s, "gauss4", 0.1, MOTUS_DIVERGED, "escaping"); /* where Newton's method has taken over */
    motus_error err = motus_default_error();
    motus_run *r = given_run(s, "rk4", 0.1, 0.2);
    const motus_trace_entry *const *e;
    size_t count;
    assert_int_equal(motus_run_trace(NULL, &e, &count, &err), MOTUS_ARGUMENT);
    assert_true(strstr(err.message, "motus_run_trace") != NULL);
    assert_int_equal(motus_run_trace(r, NULL, &count, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_run_trace(r, &e, NULL, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_run_steps(r), 0);
    motus_run_destroy(r);
    motus_system_destroy(s);
    motus_system_destroy(hard);
}

/* Where a step of this size leads that is refused by nothing. */
static void lead(motus_system *s, const char *name, const motus_trace_entry *start, double h, double *x, double *v)
{
    chosen method;
    motus_error err = motus_default_error();
    stepper *one;
    must(row_choose(name, &method, NULL, &err), &err, name);
    method.absolute = 1e300;
    const machine *m = &s->machine;
    must(stepper_create(m, &method, start->time, h, start->x, start->v, NULL, &one, &err), &err, name);
    must(stepper_turn(one, start->time, h, &err), &err, name);
    must(stepper_advance(one, (stepper_limit){1, NAN}, NULL, &err), &err, name);
    must(stepper_sync(one, x, v, NULL, &err), &err, name);
    stepper_destroy(one);
}

/* What is refused is told: where it would have led, and the error, from which the size of the next try follows. */
static void refusals(void **state)
{
    (void)state;
    static const char comet[] = "r'' = -r/|r|^3\nr(0) = (1.9, 0)\nr'(0) = (0, 0.23)\nuntil 9\nstep 0.01\n";
    motus_system *s = given_text(comet);
    motus_error err = motus_default_error();
    int64_t all = 0;
    for (size_t k = 0; k < motus_method_count(); k++) {
        const motus_method *m = motus_method_at(k);
        if (!m->adaptive || motus_method_admits(s, m->name, NULL) != MOTUS_OK) continue;
        chosen method;
        must(row_choose(m->name, &method, NULL, &err), &err, m->name);
        motus_run *r = create(s, m->name, 3, 40, "interpreter");
        while (!motus_run_done(r)) {
            const motus_trace_entry *const *e;
            size_t count, refused = 1;
            const motus_run_statistics before = motus_run_now(r);
            must(motus_run_trace(r, &e, &count, &err), &err, m->name);
            const motus_run_statistics now = motus_run_now(r);
            for (; refused < count && e[refused]->kind == MOTUS_TRACE_REFUSED; refused++) {
                const motus_trace_entry *it = e[refused], *next = e[refused + 1];
                assert_false(it->error <= 1);
                assert_true(isnan(e[0]->error) && fabs(it->step) > fabs(next->step));
                const double factor = 0.75 * pow(it->error, -1.0 / (method.row->tableau.order + 1));
                if (method.row->family == RUNGE_KUTTA && factor > 0.11 && motus_run_time(r) < 8)
                    assert_true(fabs(next->step / it->step / factor - 1) < 0.01);
                double x[2], v[2];
                lead(s, m->name, e[0], it->step, x, v);
                for (int i = 0; i < 2 && method.row->family == RUNGE_KUTTA; i++)
                    assert_true(fabs(x[i] - it->x[i]) < 1e-13 && fabs(v[i] - it->v[i]) < 1e-12);
            }
            const int64_t took = now.refused - before.refused;
            assert_int_equal(refused - 1, took < MOTUS_REFUSED_MAX ? took : MOTUS_REFUSED_MAX);
            assert_true(e[count - 1]->error <= 1 || now.refused == 0);
            const double way = e[count - 1]->time - e[0]->time;
            assert_true(fabs(e[0]->step - way) < 1e-14 && e[count - 1]->step == e[0]->step);
            all += took;
        }
        motus_run_destroy(r);
    }
    if (all <= 20) fail_msg("only %d refusals", (int)all);
    motus_system_destroy(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_model),  cmocka_unit_test(every_force), cmocka_unit_test(callbacks),
        cmocka_unit_test(compiled_too), cmocka_unit_test(failures),    cmocka_unit_test(refusals),
    };
    open_shared_cache();
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    close_cache();
    return failed;
}
