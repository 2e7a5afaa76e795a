/* Systems from C: the same motion as from a text, with and without a derivative, with first-order variables, an exact
 * motion, an invariant.
 *
 * Where the callback has the operations of the language's normal form (rule 15 of the language: a product that is
 * added at once is a fused multiply-add), the bits are equal, for every explicit method.
 */
#include "test/given.h"

#include <stdint.h>
#include "lang/base/functions.h"

typedef struct oscillator {
    double F, k, c;
    int64_t calls, derivatives, fail_at, failures;
    int answer; /* of a call that fails */
} oscillator;

static motus_system *system_of(const motus_callback_def *def)
{
    motus_system *s = NULL;
    motus_error err = motus_default_error();
    must(motus_system_from_callback(def, &s, &err), &err, "callback");
    return s;
}

/* x'' = -x + x^3 + F cos(t) */
static int driven(void *context, double t, const double *x, const double *v, double *a)
{
    oscillator *o = context;
    (void)v;
    if (++o->calls == o->fail_at) {
        o->failures++;
        return o->answer;
    }
    a[0] = fma(o->F, motus_cos(t), fma(x[0] * x[0], x[0], -x[0]));
    return 0;
}

static int driven_derivative(void *context, double t, const double *x, const double *v, const double *dx,
                             const double *dv, double *da)
{
    oscillator *o = context;
    (void)t;
    (void)v;
    (void)dv;
    o->derivatives++;
    da[0] = (3 * x[0] * x[0] - 1) * dx[0];
    return 0;
}

static const char driven_text[] = "F = 0.1\nx'' = -x + x^3 + F cos(t)\nx(0) = 0.25\nx'(0) = 0.125\n";

static motus_callback_def driven_def(oscillator *o)
{
    static const double x = 0.25, v = 0.125;
    motus_callback_def def = motus_default_callback();
    *o = (oscillator){.F = 0.1, .answer = -7};
    def.positions = 1;
    def.x = &x;
    def.v = &v;
    def.acceleration = driven;
    def.depends_on_velocity = 0;
    def.context = o;
    return def;
}

static int implicit(const char *method)
{
    const motus_method *m = NULL;
    assert_int_equal(motus_method_find(method, &m, NULL), MOTUS_OK);
    return !strcmp(m->family, "implicit");
}

static void text_and_callback_give_the_same_bits(void **state)
{
    (void)state;
    oscillator o;
    motus_callback_def def = driven_def(&o);
    motus_system *c = system_of(&def), *s = given_text(driven_text);
    int compared = 0;
    for (size_t i = 0; i < motus_method_count(); i++) {
        const char *method = motus_method_at(i)->name;
        if (motus_method_admits(c, method, NULL) != MOTUS_OK || implicit(method)) continue;
        motus_run *p = given_run(s, method, 0.01, 10), *q = given_run(c, method, 0.01, 10);
        finish(p);
        finish(q);
        size_t n = 0;
        double *y = whole_state(s, p, &n), *z = whole_state(c, q, NULL);
        assert_int_equal(n, 2);
        if (memcmp(y, z, sizeof(double[2])))
            fail_msg("%s: %a, %a from the text, %a, %a from the callback", method, y[0], y[1], z[0], z[1]);
        assert_int_equal(motus_run_now(p).evaluations, motus_run_now(q).evaluations);
        assert_string_equal(motus_run_now(p).machine, "interpreter");
        assert_string_equal(motus_run_now(q).machine, "callback");
        free(y);
        free(z);
        motus_run_destroy(p);
        motus_run_destroy(q);
        compared++;
    }
    assert_true(compared > 20);
    motus_system_destroy(c);
    motus_system_destroy(s);
}

/* Evaluations count what steps used: as many as the card says, and one for the start where a method needs it. The
 * callback is called once more where the state after the last step needs it, and observing that state calls nothing. */
static void calls_are_counted(void **state)
{
    (void)state;
    enum { STEPS = 100 };
    for (size_t i = 0; i < motus_method_count(); i++) {
        const motus_method *m = motus_method_at(i);
        oscillator o;
        motus_callback_def def = driven_def(&o);
        motus_system *c = system_of(&def);
        if (motus_method_admits(c, m->name, NULL) == MOTUS_OK) {
            motus_run *r = given_run(c, m->name, 0.01, 0.01 * STEPS);
            take_steps(r, STEPS);
            const int64_t calls = o.calls, used = motus_run_now(r).evaluations;
            double x[2], v[2];
            assert_true(calls == used || calls == used + 1);
            assert_int_equal(motus_run_state(r, x, v, NULL), MOTUS_OK);
            assert_int_equal(o.calls, calls);
            /* the count of an extrapolation is that of its declared order, and the laws test it line by line */
            if (m->evaluations && strcmp(m->family, "extrapolation") != 0) {
                const motus_run_statistics done = motus_run_now(r);
                /* a refused step of an adaptive method evaluates all stages but the first again */
                int64_t more = used - (int64_t)m->evaluations * STEPS - (int64_t)m->evaluations * done.refused;
                /* reversible steps begin with a look at the time scale, before and after the start */
                if (more < (m->adaptive ? -done.refused : 0) || more > (m->adaptive && m->reversible ? 3 : 1))
                    fail_msg("%s: %lld calls in %d steps, %d a step declared", m->name, (long long)o.calls, STEPS,
                             m->evaluations);
            }
            motus_run_destroy(r);
        }
        motus_system_destroy(c);
    }
}

/* Implicit methods solve to round-off, so their results do not depend on how the derivative is computed: each number
 * of a step is solved to some units in its last place, over 1000 steps. */
static void difference_quotients_stand_in_for_a_derivative(void **state)
{
    (void)state;
    static const char *const methods[] = {
        "newmark", "newmark(1/6, 1/2)", "implicit-midpoint", "gauss4", "gauss6", "gauss8", "gauss16"};
    const double bound = 1000 * 8 * ROUNDING;
    motus_system *s = given_text(driven_text);
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        oscillator with, without;
        motus_callback_def a = driven_def(&with), b = driven_def(&without);
        a.derivative = driven_derivative;
        motus_system *p = system_of(&a), *q = system_of(&b);
        motus_run *given = given_run(s, methods[i], 0.01, 10), *derived = given_run(p, methods[i], 0.01, 10),
                  *quotient = given_run(q, methods[i], 0.01, 10);
        finish(given);
        finish(derived);
        finish(quotient);
        /* Of several stages the iteration contracts without one. */
        assert_true((with.derivatives > 0) == (i < 3) && without.derivatives == 0);
        near(value(p, derived, "x"), value(s, given, "x"), bound, methods[i]);
        near(value(q, quotient, "x"), value(s, given, "x"), bound, methods[i]);
        near(value(q, quotient, "x'"), value(s, given, "x'"), bound, methods[i]);
        /* With an inexact derivative Newton's method takes few more iterations. */
        assert_true(motus_run_now(quotient).iterations <= 2 * motus_run_now(derived).iterations);
        motus_run_destroy(given);
        motus_run_destroy(derived);
        motus_run_destroy(quotient);
        motus_system_destroy(p);
        motus_system_destroy(q);
    }
    motus_system_destroy(s);
}

/* Two masses with quadratic drag, coupled in positions and velocities, and heat as a first-order variable: s' = the
 * power that the drag takes. */
static int dragged(void *context, double t, const double *x, const double *v, double *a)
{
    oscillator *o = context;
    (void)t;
    o->calls++;
    double w = v[0] - v[1], drag = o->c * w * fabs(w);
    a[0] = -o->k * x[0] - drag;
    a[1] = -o->k * x[1] + drag;
    a[2] = drag * w;
    return 0;
}

static int dragged_derivative(void *context, double t, const double *x, const double *v, const double *dx,
                              const double *dv, double *da)
{
    oscillator *o = context;
    (void)t;
    (void)x;
    o->derivatives++;
    double w = v[0] - v[1], dw = dv[0] - dv[1], slope = 2 * o->c * fabs(w);
    da[0] = -o->k * dx[0] - slope * dw;
    da[1] = -o->k * dx[1] + slope * dw;
    da[2] = 1.5 * slope * w * dw;
    return 0;
}

static int dragged_energy(void *context, double t, const double *x, const double *v, double *value)
{
    const oscillator *o = context;
    (void)t;
    *value = (v[0] * v[0] + v[1] * v[1] + o->k * (x[0] * x[0] + x[1] * x[1])) / 2 + v[2];
    return 0;
}

static motus_callback_def dragged_def(oscillator *o)
{
    static const double x[2] = {1, -0.5}, v[3] = {0, 1, 0.25};
    motus_callback_def def = motus_default_callback();
    *o = (oscillator){.k = 2, .c = 0.3};
    def.positions = 2;
    def.first_order = 1;
    def.x = x;
    def.v = v;
    def.acceleration = dragged;
    def.invariant = dragged_energy;
    def.depends_on_time = 0;
    def.context = o;
    return def;
}

static const char dragged_text[] =
    "k = 2\nc = 0.3\nw = x' - y'\ndrag = c w |w|\nx'' = -k x - drag\ny'' = -k y + drag\ns' = drag w\n"
    "x(0) = 1\nx'(0) = 0\ny(0) = -0.5\ny'(0) = 1\ns(0) = 0.25\ninvariant e = (x'^2 + y'^2 + k (x^2 + y^2))/2 + s\n";

static void nonlinear_velocity_terms_and_first_order_variables(void **state)
{
    (void)state;
    static const char *const methods[] = {"verlet", "verlet-literal",   "newmark", "gauss4", "gauss6",
                                          "rk4",    "implicit-midpoint"};
    motus_system *s = given_text(dragged_text);
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        oscillator with, without;
        motus_callback_def a = dragged_def(&with), b = dragged_def(&without);
        a.derivative = dragged_derivative;
        motus_system *p = system_of(&a), *q = system_of(&b);
        motus_run *given = given_run(s, methods[i], 0.01, 5), *derived = given_run(p, methods[i], 0.01, 5),
                  *quotient = given_run(q, methods[i], 0.01, 5);
        finish(given);
        finish(derived);
        finish(quotient);
        /* before anything is observed; the verlets have evaluated the acceleration of the last state already */
        if (strncmp(methods[i], "verlet", 6)) assert_int_equal(motus_run_now(quotient).evaluations, without.calls);
        static const char *const names[][2] = {{"x", "x[1]"},   {"y", "x[2]"}, {"x'", "x[1]'"},
                                               {"y'", "x[2]'"}, {"s", "s"},    {"e", "invariant"}};
        /* 500 steps; the literal recurrence rounds full positions, not increments, and divides by h^2 at the end of
         * each. */
        const double bound = 500 * 8 * ROUNDING * (strcmp(methods[i], "verlet-literal") ? 1 : 1 / 0.01);
        for (size_t k = 0; k < 6; k++) {
            near(value(p, derived, names[k][1]), value(s, given, names[k][0]), bound, methods[i]);
            near(value(q, quotient, names[k][1]), value(s, given, names[k][0]), bound, methods[i]);
        }
        const int needed = strcmp(methods[i], "rk4") && strncmp(methods[i], "gauss", 5);
        assert_int_equal(with.derivatives > 0, needed);
        motus_run_destroy(given);
        motus_run_destroy(derived);
        motus_run_destroy(quotient);
        motus_system_destroy(p);
        motus_system_destroy(q);
    }
    motus_system_destroy(s);
}

/* x'' = -k x - c x', declared linear, is solved in closed form, without iterations, to the bits of the text. */
static int braked(void *context, double t, const double *x, const double *v, double *a)
{
    oscillator *o = context;
    (void)t;
    o->calls++;
    a[0] = fma(-o->c, v[0], -o->k * x[0]);
    return 0;
}

static int braked_derivative(void *context, double t, const double *x, const double *v, const double *dx,
                             const double *dv, double *da)
{
    const oscillator *o = context;
    (void)t;
    (void)x;
    (void)v;
    da[0] = fma(-o->c, dv[0], -o->k * dx[0]);
    return 0;
}

static void linear_velocity_terms_take_one_step(void **state)
{
    (void)state;
    static const double x = 1, v = 0.5;
    motus_system *s = given_text("k = 2\nc = 0.75\nx'' = -k x - c x'\nx(0) = 1\nx'(0) = 0.5\n");
    for (int quotient = 0; quotient < 2; quotient++) {
        oscillator o = {.k = 2, .c = 0.75};
        motus_callback_def def = motus_default_callback();
        def.positions = 1;
        def.x = &x;
        def.v = &v;
        def.acceleration = braked;
        def.derivative = quotient ? NULL : braked_derivative;
        def.linear_in_velocity = 1;
        def.depends_on_time = 0;
        def.context = &o;
        motus_system *c = system_of(&def);
        motus_run *p = given_run(c, "verlet", 0.01, 10), *q = given_run(s, "verlet", 0.01, 10);
        finish(p);
        finish(q);
        assert_int_equal(motus_run_now(p).iterations, 0);
        near(value(c, p, "x"), value(s, q, "x"), 1000 * 4 * ROUNDING, "x");
        near(value(c, p, "x'"), value(s, q, "x'"), 1000 * 4 * ROUNDING, "x'");
        motus_run_destroy(p);
        motus_run_destroy(q);
        motus_system_destroy(c);
    }
    motus_system_destroy(s);
}

/* Failures and the rest of the definition -------------------------------------------------------------------------- */

/* A value below 0 is a failure of the callback, one above 0 only of this place; the run is at its last good step. */
static void a_failing_callback_stops_the_run_and_not_more(void **state)
{
    (void)state;
    int answers[] = {-7, 3}, turn = 0;
    static const char *const methods[] = {"verlet",    "velocity-verlet", "rk4",    "gauss4",
                                          "kahan-li8", "newmark",         "beeman", "leapfrog"};
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++)
        for (int64_t when = 1; when < 400; when = when * 2 + 5) {
            oscillator o, steady;
            motus_callback_def def = driven_def(&o), good = driven_def(&steady);
            motus_system *s = system_of(&def), *g = system_of(&good);
            motus_run *r = given_run(s, methods[i], 0.01, 5), *whole = given_run(g, methods[i], 0.01, 5);
            motus_error err = motus_default_error();
            o.fail_at = when;
            o.answer = answers[turn++ % 2];
            if (motus_run_finish(r, &err) != MOTUS_CALLBACK)
                fail_msg("%s, call %lld: %s", methods[i], (long long)when, err.message);
            assert_int_equal(o.failures, 1);
            assert_true(err.time >= 0 && err.time <= 5 && err.status == MOTUS_CALLBACK);
            assert_non_null(strstr(err.message, "callback"));
            assert_int_equal(err.returned, o.answer);
            assert_int_equal(strstr(err.message, "cannot be evaluated") != NULL, o.answer > 0);
            assert_false(motus_run_done(r));
            int64_t at = motus_run_steps(r);
            assert_true(motus_run_time(r) == 0.01 * (double)at && err.time >= motus_run_time(r) - 0.01 &&
                        err.time <= motus_run_time(r) + 0.01);
            /* After the failure the run continues, to the bits of a run without one. */
            finish(r);
            finish(whole);
            same_state(s, r, whole, "after a failure");
            motus_run_destroy(r);
            motus_run_destroy(whole);
            motus_system_destroy(s);
            motus_system_destroy(g);
        }
}

static int circle(void *context, double t, double *x, double *v)
{
    oscillator *o = context;
    if (o->fail_at < 0) return 1;
    x[0] = cos(t);
    v[0] = -sin(t);
    return 0;
}

static int pull(void *context, double t, const double *x, const double *v, double *a)
{
    (void)context;
    (void)t;
    (void)v;
    a[0] = -x[0];
    return 0;
}

static int broken_invariant(void *context, double t, const double *x, const double *v, double *value)
{
    (void)context;
    (void)t;
    (void)x;
    (void)v;
    (void)value;
    return -3;
}

static void exact_and_invariant_callbacks(void **state)
{
    (void)state;
    const double x = 1, v = 0;
    oscillator o = {0};
    motus_callback_def def = motus_default_callback();
    def.positions = 1;
    def.x = &x;
    def.v = &v;
    def.acceleration = pull;
    def.exact = circle;
    def.invariant = broken_invariant;
    def.depends_on_velocity = def.depends_on_time = 0;
    def.context = &o;
    motus_system *s = system_of(&def);
    assert_true(motus_has_exact(s));
    assert_int_equal(motus_column_count(s), 1 + 2 + 1 + 2);
    assert_int_equal(motus_invariant_count(s), 1);
    motus_run *r = given_run(s, "leapfrog", 0.1, 2), *e = given_run(s, "exact", 0.1, 2);
    finish(r);
    finish(e);
    assert_true(value(s, r, "exact x") == cos(2) && value(s, r, "exact x'") == -sin(2));
    assert_true(value(s, e, "x") == cos(2) && value(s, e, "x'") == -sin(2));
    /* A callback that fails is an error; other columns can still be read. */
    size_t k = column(s, "invariant");
    double out;
    motus_error err = motus_default_error();
    assert_int_equal(motus_run_values(r, &k, 1, &out, &err), MOTUS_CALLBACK);
    assert_non_null(strstr(err.message, "invariant"));
    o.fail_at = -1;
    k = column(s, "exact x");
    assert_int_equal(motus_run_values(r, &k, 1, &out, &err), MOTUS_CALLBACK);
    assert_int_equal(motus_run_state(e, &out, NULL, &err), MOTUS_OK); /* computed before */
    assert_true(isfinite(value(s, r, "x")));
    /* The texts of a system without a model text. */
    assert_true(strlen(motus_explain(s)) > 10);
    assert_null(motus_equation_text(s, 0));
    motus_settings set = motus_default_settings();
    motus_settings_of(s, &set);
    assert_true(set.from == 0 && isnan(set.step) && isnan(set.until) && !set.method);
    motus_run_destroy(r);
    motus_run_destroy(e);
    motus_system_destroy(s);
}

/* Names, quantities, invariants ------------------------------------------------------------------------------------ */

/* A ring of three masses and the work done on the first, with names or without. */
typedef struct ring {
    int64_t calls;
    int fail;
} ring;

static int ring_force(void *context, double t, const double *x, const double *v, double *a)
{
    (void)context;
    (void)t;
    for (int k = 0; k < 3; k++) a[k] = x[(k + 1) % 3] - 2 * x[k] + x[(k + 2) % 3];
    a[3] = a[0] * v[0];
    a[4] = v[1];
    return 0;
}

static int ring_quantity(void *context, double t, const double *x, const double *v, double *values)
{
    ring *r = context;
    (void)v;
    r->calls++;
    values[0] = x[0] + x[1];
    values[1] = t;
    return r->fail;
}

static int ring_invariant(void *context, double t, const double *x, const double *v, double *values)
{
    ring *r = context;
    (void)t;
    r->calls++;
    values[0] = v[0] + v[1] + v[2];
    values[1] = 0;
    for (int k = 0; k < 3; k++) values[1] += v[k] * v[k] / 2 + (x[k] - x[(k + 1) % 3]) * (x[k] - x[(k + 1) % 3]) / 2;
    return 0;
}

static motus_callback_def ring_def(ring *r)
{
    static const double x[3] = {1, 2, 4}, v[5] = {0.5, 0, -1, 8, 9};
    motus_callback_def def = motus_default_callback();
    *r = (ring){0};
    def.positions = 3;
    def.first_order = 2;
    def.x = x;
    def.v = v;
    def.acceleration = ring_force;
    def.quantity = ring_quantity;
    def.quantities = 2;
    def.invariant = ring_invariant;
    def.invariants = 2;
    def.context = r;
    return def;
}

static void are_columns(const motus_system *s, const char *const *names, size_t count)
{
    assert_int_equal(motus_column_count(s), count);
    for (size_t k = 0; k < count; k++) {
        motus_column c = motus_default_column();
        size_t back = 0;
        assert_int_equal(motus_column_at(s, k, &c), MOTUS_OK);
        assert_string_equal(c.name, names[k]);
        assert_int_equal(column(s, names[k]), k);
        assert_int_equal(motus_column_of(s, &c, &back, NULL), MOTUS_OK);
        assert_int_equal(back, k);
    }
}

static void numbers_have_names(void **state)
{
    (void)state;
    static const char *const plain[] = {"t",           "x[1]",         "x[2]",        "x[3]", "x[1]'",
                                        "x[2]'",       "x[3]'",        "s[1]",        "s[2]", "quantity[1]",
                                        "quantity[2]", "invariant[1]", "invariant[2]"};
    static const char *const named[] = {"t",    "left", "θ₁",  "right", "left'",    "θ₁'",   "right'",
                                        "work", "heat", "sum", "clock", "momentum", "energy"};
    char copies[9][16];
    const char *names[5], *quantities[2], *invariants[2];
    for (int k = 0; k < 9; k++) snprintf(copies[k], sizeof copies[k], "%s", named[k < 3 ? k + 1 : k + 4]);
    for (int k = 0; k < 5; k++) names[k] = copies[k];
    for (int k = 0; k < 2; k++) {
        quantities[k] = copies[5 + k];
        invariants[k] = copies[7 + k];
    }
    ring r;
    motus_callback_def def = ring_def(&r);
    motus_system *s = system_of(&def);
    are_columns(s, plain, 13);
    motus_variable v = motus_default_variable();
    assert_int_equal(motus_variable_count(s), 2);
    assert_int_equal(motus_variable_at(s, 0, &v), MOTUS_OK);
    assert_true(v.dimensions == 1 && v.first[0] == 1 && v.last[0] == 3 && v.count == 3);
    assert_int_equal(motus_quantity_count(s), 1);
    size_t numbers = 0, first, count;
    assert_string_equal(motus_invariant_name(s, 0, &numbers), "invariant");
    assert_int_equal(numbers, 2);
    assert_null(motus_invariant_name(s, 1, NULL));
    assert_int_equal(motus_column_find(s, "invariant", &first, &count, NULL), MOTUS_OK);
    assert_true(first == 11 && count == 2);
    assert_int_equal(motus_column_find(s, "x[0]", &first, &count, NULL), MOTUS_NAME);
    motus_system_destroy(s);

    def.names = names;
    def.quantity_names = quantities;
    def.invariant_names = invariants;
    s = system_of(&def);
    memset(copies, '?', sizeof copies); /* they were copied */
    memset(names, 0, sizeof names);
    are_columns(s, named, 13);
    assert_int_equal(motus_variable_count(s), 5);
    assert_int_equal(motus_variable_at(s, 3, &v), MOTUS_OK);
    assert_true(!strcmp(v.name, "work") && v.order == 1 && v.dimensions == 0 && v.count == 1);
    assert_int_equal(motus_quantity_count(s), 2);
    assert_string_equal(motus_quantity_name(s, 1, &numbers), "clock");
    assert_int_equal(numbers, 1);
    assert_int_equal(motus_invariant_count(s), 2);
    motus_initial i = motus_default_initial();
    assert_int_equal(motus_initial_count(s), 3 * 2 + 2);
    assert_int_equal(motus_initial_at(s, 3, &i), MOTUS_OK);
    assert_string_equal(i.name, "θ₁'(0)");
    motus_error err = motus_default_error();
    assert_int_equal(motus_column_find(s, "momentun", &first, &count, &err), MOTUS_NAME);
    assert_non_null(strstr(err.hint, "momentum"));
    motus_system_destroy(s);
}

/* One call computes all quantities and another all invariants, whatever columns are read. */
static void quantities_and_invariants(void **state)
{
    (void)state;
    static const char *const invariants[] = {"momentum", "energy"};
    ring r;
    motus_callback_def def = ring_def(&r);
    def.invariant_names = invariants;
    motus_system *s = system_of(&def);
    motus_run *run = given_run(s, "rk4", 0.01, 1);
    finish(run);
    double x[3], v[5], out[6];
    motus_error err = motus_default_error();
    const size_t columns[6] = {column(s, "energy"),      column(s, "momentum"), column(s, "quantity[2]"),
                               column(s, "quantity[1]"), column(s, "x[2]"),     column(s, "energy")};
    must(motus_run_state(run, x, v, &err), &err, "state");
    r.calls = 0;
    must(motus_run_values(run, columns, 6, out, &err), &err, "values");
    assert_int_equal(r.calls, 3); /* invariants, quantities, and invariants again */
    assert_true(out[0] == out[5] && out[1] == v[0] + v[1] + v[2] && out[2] == motus_run_time(run) &&
                out[3] == x[0] + x[1] && out[4] == x[1]);
    near(out[1], -0.5, 100 * 8 * ROUNDING, "the momentum");
    r.fail = 5;
    assert_int_equal(motus_run_values(run, columns, 6, out, &err), MOTUS_CALLBACK);
    assert_true(strstr(err.message, "quantity") && err.returned == 5 && err.time == 1);
    r.fail = 0;
    motus_run_destroy(run);

    /* A comparison reports the drift of each invariant under its name. */
    motus_study_def study = motus_default_study();
    const char *methods[] = {"midpoint"};
    motus_comparison *c = NULL;
    study.methods = methods, study.method_count = 1, study.step = 0.05, study.until = 2;
    motus_system_destroy(s);
    s = system_of(&def);
    must(motus_compare(s, &study, &c, &err), &err, "compare");
    assert_int_equal(c->rows[0]->status, MOTUS_OK);
    assert_int_equal(c->rows[0]->invariant_count, 2);
    assert_string_equal(c->rows[0]->invariants[1]->name, "energy");
    assert_true(c->rows[0]->invariants[0]->max_drift < 1e-13 && c->rows[0]->invariants[1]->max_drift > 1e-6);
    motus_comparison_destroy(c);
    motus_system_destroy(s);
}

static void names_that_are_refused(void **state)
{
    (void)state;
    static const char *const good[] = {"a", "b", "c", "d", "e"}, *const rest[] = {"f", "g"},
                             *const twice[] = {"f", "f"}, *const taken[] = {"f", "c"};
    static const char *const bad[] = {
        "",     "1a",  "a b", "x[1]",    "t",  "a'",
        "\xff", "a\n", " a",  "exact a", NULL, "abcdefghijklmnopqrstuvwxyzabcdefghijklmnopqrstuvwxyzabcdefghijklm"};
    ring r;
    motus_callback_def def = ring_def(&r);
    motus_error err = motus_default_error();
    motus_system *s = NULL;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        for (int k = 0; k < 3; k++) {
            const char *names[] = {"a", "b", "c", bad[i], "e"}, *more[] = {"f", bad[i]};
            def.names = k == 0 ? names : good;
            def.quantity_names = k == 1 ? more : NULL;
            def.invariant_names = k == 2 ? more : NULL;
            if (motus_system_from_callback(&def, &s, &err) != (bad[i] ? MOTUS_NAME : MOTUS_ARGUMENT) || s)
                fail_msg("\"%s\", %d: %s", bad[i] ? bad[i] : "NULL", k, err.message);
            assert_true(strlen(err.message) > 10);
        }
    def.names = good;
    def.quantity_names = twice;
    def.invariant_names = NULL;
    assert_int_equal(motus_system_from_callback(&def, &s, &err), MOTUS_NAME);
    assert_non_null(strstr(err.message, "called f"));
    def.quantity_names = rest;
    def.invariant_names = taken;
    assert_int_equal(motus_system_from_callback(&def, &s, &err), MOTUS_NAME);
    def.invariant_names = NULL;
    def.quantities = SIZE_MAX;
    assert_int_equal(motus_system_from_callback(&def, &s, &err), MOTUS_LIMIT);
    def.quantity = NULL; /* there is no function for it */
    must(motus_system_from_callback(&def, &s, &err), &err, "no quantities");
    assert_int_equal(motus_quantity_count(s), 0);
    motus_system_destroy(s);
}

/* x'' = -g above a floor; below it the force cannot be evaluated. */
static int over_a_floor(void *context, double t, const double *x, const double *v, double *a)
{
    (void)context;
    (void)t;
    (void)v;
    a[0] = -1;
    return x[0] < 0;
}

/* Whether a run fails in one call or step by step, it stands at the same step, whose state can be observed: also where
 * the acceleration is not defined at the end of a step, next to a snapshot, or in the shorter last step. */
static void a_failed_run_can_be_observed(void **state)
{
    (void)state;
    static const int64_t counts[] = {1, 2, 3, 62, 63, 64, 65, 66, 127, 128, 129, 130};
    const double height = 1, rest = 0, fall = sqrt(2);
    motus_callback_def def = motus_default_callback();
    motus_error err = motus_default_error();
    def.positions = 1, def.x = &height, def.v = &rest, def.acceleration = over_a_floor,
    def.depends_on_velocity = def.depends_on_time = 0;
    motus_system *s = system_of(&def);
    for (size_t m = 0; m < motus_method_count(); m++) {
        const char *name = motus_method_at(m)->name;
        if (motus_method_admits(s, name, NULL) != MOTUS_OK || !strcmp(name, "exact")) continue;
        for (size_t k = 0; k < sizeof counts / sizeof *counts; k++)
            for (int shorter = 0; shorter < 2; shorter++) {
                if (shorter && !strcmp(name, "verlet-literal")) continue; /* which takes equal steps only */
                /* the floor is in the middle of the step that follows `counts` steps; the shorter one crosses it */
                const double h = fall / ((double)counts[k] + 0.5);
                const double until = shorter ? h * ((double)counts[k] + 0.75) : h * 1000;
                motus_run *whole = given_run(s, name, h, until), *single = given_run(s, name, h, until);
                double x[2], v[2];
                const motus_status end = motus_run_finish(whole, &err);
                /* a method that evaluates within its steps may finish above the floor, or not know that it is below */
                assert_true((end == MOTUS_CALLBACK && err.returned == 1) || (end == MOTUS_OK && shorter));
                motus_status status = MOTUS_OK;
                while (status == MOTUS_OK && !motus_run_done(single)) {
                    status = motus_run_step(single, 1, &err);
                    if (motus_run_state(single, &x[0], &v[0], &err) != MOTUS_OK)
                        fail_msg("%s, %lld: %s", name, (long long)counts[k], err.message);
                }
                assert_int_equal(status, end);
                if (motus_run_state(whole, &x[1], &v[1], &err) != MOTUS_OK)
                    fail_msg("%s, %lld: %s", name, (long long)counts[k], err.message);
                assert_int_equal(motus_run_steps(whole), motus_run_steps(single));
                assert_true(motus_run_steps(whole) >= counts[k] - 2);
                assert_true(x[0] == x[1] && v[0] == v[1] && motus_run_time(whole) == motus_run_time(single));
                motus_run_destroy(whole);
                motus_run_destroy(single);
            }
    }
    motus_system_destroy(s);
}

/* From its last good state another run goes on with smaller steps, nearer to the floor. */
static void a_run_goes_on_from_its_last_good_step(void **state)
{
    (void)state;
    static const char *const methods[] = {"velocity-verlet", "verlet", "rk4", "gauss4"};
    const double height = 1, rest = 0;
    motus_callback_def def = motus_default_callback();
    motus_error err = motus_default_error();
    def.positions = 1, def.x = &height, def.v = &rest, def.acceleration = over_a_floor,
    def.depends_on_velocity = def.depends_on_time = 0;
    motus_system *s = system_of(&def);
    for (size_t m = 0; m < sizeof methods / sizeof *methods; m++) {
        double x = height, v = rest;
        motus_run_def how = motus_default_run();
        how.method = methods[m], how.start = 0, how.until = 10, how.step = 0.25;
        for (int n = 0; n < 5; n++, how.step /= 8) {
            motus_run *r = NULL;
            motus_status status = MOTUS_OK;
            how.x = &x, how.v = &v;
            must(motus_run_create(s, &how, &r, &err), &err, methods[m]);
            while (status == MOTUS_OK) {
                status = motus_run_step(r, 1, &err);
                how.start = motus_run_time(r);
                double ahead[2];
                must(motus_run_state(r, &ahead[0], &ahead[1], NULL), &err, methods[m]);
                x = ahead[0], v = ahead[1];
            }
            assert_int_equal(status, MOTUS_CALLBACK);
            assert_true(err.returned == 1 && strstr(err.message, "cannot be evaluated") && strlen(err.hint) > 10);
            assert_true(err.time >= how.start && err.time <= how.start + how.step * (1 + 1e-9));
            motus_run_destroy(r);
        }
        near(how.start, sqrt(2), 1e-3, methods[m]);
    }
    motus_system_destroy(s);
}

/* Friction, in the second half of the run alone. */
static int late_friction(void *context, size_t first, size_t count, double t, const double *x, const double *v,
                         double *a)
{
    (void)context, (void)first;
    for (size_t j = 0; j < count; j++) a[j] = t < 0.5 ? -x[j] : -x[j] - v[j];
    return 0;
}

static int late_friction_alone(void *context, double t, const double *x, const double *v, double *a)
{
    return late_friction(context, 0, 1, t, x, v, a);
}

static const char reads_velocity[] = "the callback reads the velocity, though its definition says that it does not";

/* It is noticed at the first evaluation that does, in a run and in an ensemble. */
static void an_undeclared_velocity(void **state)
{
    (void)state;
    static const char *const vary[] = {"x(0)"};
    const double x = 1, v = 0.5, starts[] = {1, 2, 3, 4, 5};
    const double *values[] = {starts};
    double ends[5], *results[] = {ends};
    for (int block = 0; block < 2; block++) {
        motus_callback_def def = motus_default_callback();
        motus_error err = motus_default_error();
        def.positions = 1, def.x = &x, def.v = &v, def.depends_on_velocity = 0;
        if (block)
            def.block = late_friction;
        else
            def.acceleration = late_friction_alone;
        motus_system *s = system_of(&def);
        static const char *const methods[] = {"velocity-verlet", "rk4", "implicit-midpoint", "verlet"};
        for (size_t m = 0; m < sizeof methods / sizeof *methods; m++) {
            motus_run *r = given_run(s, methods[m], 0.01, 1);
            assert_int_equal(motus_run_finish(r, &err), MOTUS_CALLBACK);
            assert_string_equal(err.message, reads_velocity);
            assert_true(err.returned == 0 && fabs(err.time - 0.5) < 0.02 && strstr(err.hint, "depends_on_velocity"));
            double y, w;
            must(motus_run_state(r, &y, &w, &err), &err, methods[m]);
            assert_true(fabs(motus_run_time(r) - 0.5) < 0.02 && isfinite(y) && isfinite(w));
            motus_run_destroy(r);
        }
        const motus_record record = {MOTUS_REDUCE_FINAL, 1};
        motus_ensemble_def how = motus_default_ensemble();
        motus_ensemble *e;
        how.vary = vary, how.vary_count = 1, how.records = &record, how.record_count = 1;
        how.method = "velocity-verlet", how.step = 0.01, how.until = 1;
        must(motus_ensemble_create(s, &how, &e, &err), &err, "ensemble");
        assert_int_equal(motus_ensemble_run(e, 5, values, results, NULL, &err), MOTUS_CALLBACK);
        assert_string_equal(err.message, reads_velocity);
        motus_ensemble_destroy(e);
        motus_system_destroy(s);
    }
}

static int root(void *context, double t, const double *x, const double *v, double *a)
{
    (void)context, (void)t, (void)v;
    a[0] = -sqrt(x[0]);
    return 0;
}

static void nan_for_another_reason(void **state)
{
    (void)state;
    const double x = 1, v = -1;
    motus_callback_def def = motus_default_callback();
    motus_error err = motus_default_error();
    def.positions = 1, def.x = &x, def.v = &v, def.acceleration = root, def.depends_on_velocity = 0;
    motus_system *s = system_of(&def);
    motus_run *r = given_run(s, "rk4", 0.01, 5);
    assert_int_equal(motus_run_finish(r, &err), MOTUS_DIVERGED);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

static int burst(void *context, double t, const double *x, const double *v, double *a)
{
    (void)context;
    (void)t;
    (void)v;
    a[0] = 0;
    a[1] = exp(x[1]) * exp(x[1]);
    return 0;
}

static void errors_know_the_names(void **state)
{
    (void)state;
    static const double x[2] = {0, 1}, v[2] = {0, 1};
    static const char *const names[] = {"calm", "steep"};
    for (int named = 0; named < 2; named++) {
        motus_callback_def def = motus_default_callback();
        motus_error err = motus_default_error();
        def.positions = 2, def.x = x, def.v = v, def.acceleration = burst,
        def.depends_on_velocity = def.depends_on_time = 0;
        def.names = named ? names : NULL;
        motus_system *s = system_of(&def);
        motus_run *r = given_run(s, "velocity-verlet", 0.1, 100);
        assert_int_equal(motus_run_finish(r, &err), MOTUS_DIVERGED);
        assert_true(!strncmp(err.variable, named ? "steep" : "x[2]", named ? 5 : 4) && err.returned == 0);
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

static void definitions_that_are_refused(void **state)
{
    (void)state;
    const double x[2] = {1, 2}, v[3] = {0, 0, 0}, bad[2] = {1, INFINITY};
    motus_callback_def good = motus_default_callback();
    good.positions = 2;
    good.x = x;
    good.v = v;
    good.acceleration = pull;
    motus_callback_def defs[8];
    for (int i = 0; i < 8; i++) defs[i] = good;
    defs[0].acceleration = NULL;
    defs[1].positions = 0;
    defs[2].x = NULL;
    defs[3].v = NULL;
    defs[4].x = bad;
    defs[5].v = bad;
    defs[6].start = NAN;
    defs[7].positions = SIZE_MAX;
    for (int i = 0; i < 8; i++) {
        motus_system *s = (motus_system *)&good;
        motus_error err = motus_default_error();
        motus_status status = motus_system_from_callback(&defs[i], &s, &err);
        assert_int_equal(status, i == 7 ? MOTUS_LIMIT : MOTUS_ARGUMENT);
        assert_null(s);
        assert_true(strlen(err.message) > 5);
    }
    motus_system *s = NULL;
    assert_int_equal(motus_system_from_callback(NULL, &s, NULL), MOTUS_ARGUMENT);
    assert_int_equal(motus_system_from_callback(&good, NULL, NULL), MOTUS_ARGUMENT);
}

/* First-order variables alone are a system too: s' = f. And the initial values were copied. */
static int decay(void *context, double t, const double *x, const double *v, double *a)
{
    (void)context;
    (void)t;
    (void)x;
    a[0] = -v[0];
    a[1] = v[0];
    return 0;
}

static void first_order_variables_alone(void **state)
{
    (void)state;
    double v[2] = {1, 0};
    motus_callback_def def = motus_default_callback();
    def.first_order = 2;
    def.v = v;
    def.acceleration = decay;
    motus_system *s = system_of(&def), *text = given_text("p' = -p\nq' = p\np(0) = 1\nq(0) = 0\n");
    v[0] = v[1] = 99;
    assert_true(motus_positions(s) == 0 && motus_velocities(s) == 2);
    static const char *const methods[] = {"rk4", "gauss6", "verlet", "newmark"};
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        motus_run *p = given_run(s, methods[i], 0.01, 1), *q = given_run(text, methods[i], 0.01, 1);
        finish(p);
        finish(q);
        near(value(s, p, "s[1]") + value(s, p, "s[2]"), 1, 100 * 8 * ROUNDING, "the sum");
        near(value(s, p, "s[1]"), value(text, q, "p"), 100 * 8 * ROUNDING, methods[i]);
        motus_run_destroy(p);
        motus_run_destroy(q);
    }
    motus_system_destroy(s);
    motus_system_destroy(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(text_and_callback_give_the_same_bits),
        cmocka_unit_test(calls_are_counted),
        cmocka_unit_test(difference_quotients_stand_in_for_a_derivative),
        cmocka_unit_test(nonlinear_velocity_terms_and_first_order_variables),
        cmocka_unit_test(linear_velocity_terms_take_one_step),
        cmocka_unit_test(a_failing_callback_stops_the_run_and_not_more),
        cmocka_unit_test(exact_and_invariant_callbacks),
        cmocka_unit_test(an_undeclared_velocity),
        cmocka_unit_test(nan_for_another_reason),
        cmocka_unit_test(numbers_have_names),
        cmocka_unit_test(quantities_and_invariants),
        cmocka_unit_test(names_that_are_refused),
        cmocka_unit_test(a_failed_run_can_be_observed),
        cmocka_unit_test(a_run_goes_on_from_its_last_good_step),
        cmocka_unit_test(errors_know_the_names),
        cmocka_unit_test(definitions_that_are_refused),
        cmocka_unit_test(first_order_variables_alone),
    };
    return cmocka_run_group_tests_name("callbacks", tests, NULL, NULL);
}
