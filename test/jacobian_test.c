/* motus_run_jacobian against derivatives by hand: models, which have exact derivatives; callbacks with and without a
 * derivative; families, whose internal order of numbers differs from the public one.
 */
#include "test/given.h"

#include <float.h>

static motus_run *run_of(motus_system *s, int64_t steps)
{
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    if (isnan(def.step)) def.step = 0.01;
    def.until = 10;
    must(motus_run_create(s, &def, &r, &err), &err, "motus_run_create");
    must(motus_run_step(r, steps, &err), &err, "motus_run_step");
    return r;
}

static void derive(motus_run *r, double *dx, double *dv)
{
    motus_error err = motus_default_error();
    must(motus_run_jacobian(r, dx, dv, &err), &err, "motus_run_jacobian");
}

static void state_of(motus_run *r, double *x, double *v)
{
    motus_error err = motus_default_error();
    must(motus_run_state(r, x, v, &err), &err, "motus_run_state");
}

static void models_by_hand(void **state)
{
    (void)state;
    double x[2], v[2], dx[4], dv[4];
    motus_system *s = given_text("w = 1.3\ntheta'' = -w^2 sin(theta)\ntheta(0) = 2\ntheta'(0) = 0\n");
    motus_run *r = run_of(s, 37);
    state_of(r, x, v);
    derive(r, dx, dv);
    near(dx[0], -1.69 * cos(x[0]), 1e-15, "pendulum");
    assert_true(dv[0] == 0);
    motus_run_destroy(r);
    motus_system_destroy(s);

    s = given_text("k = 3\nm = 2\nx'' = -(k/m) x\nx(0) = 1\nx'(0) = 0.5\n");
    r = run_of(s, 0);
    derive(r, dx, dv);
    assert_true(dx[0] == -1.5 && dv[0] == 0);
    motus_run_destroy(r);
    motus_system_destroy(s);

    s = given_text("mu = 5\nx'' = mu (1 - x^2) x' - x\nx(0) = 2\nx'(0) = 1\n");
    r = run_of(s, 12);
    state_of(r, x, v);
    derive(r, dx, NULL);
    derive(r, NULL, dv);
    near(dx[0], -10 * x[0] * v[0] - 1, 1e-14 * (10 * fabs(x[0] * v[0]) + 1), "van der Pol, x");
    near(dv[0], 5 * (1 - x[0] * x[0]), 1e-14 * 20, "van der Pol, v");
    motus_run_destroy(r);
    motus_system_destroy(s);

    /* Kepler: a = -r/|r|³, da/dr = -1/|r|³ + 3 r rᵀ/|r|⁵ */
    s = given_text("r'' = -r/|r|^3\nr(0) = (0.4, 0.1)\nr'(0) = (0, 2)\n");
    r = run_of(s, 25);
    state_of(r, x, v);
    derive(r, dx, dv);
    const double d = hypot(x[0], x[1]), d3 = d * d * d, d5 = d3 * d * d;
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) {
            near(dx[2 * i + j], (i == j ? -1 / d3 : 0) + 3 * x[i] * x[j] / d5, 16 * DBL_EPSILON * 4 / d3, "Kepler");
            assert_true(dv[2 * i + j] == 0);
        }
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* Vectors in a family, a cell in between without an equation, a driven boundary, and a first-order variable: rows and
 * columns have the order of motus_run_state. */
static void a_family_by_hand(void **state)
{
    (void)state;
    motus_system *s = given_text(
        "r[i]'' = (2 r[i+1].x + 3 r[i-1].y, r[i].x r[i].y s - r[i]'.x)   for i = 1..2\nr[0] = (t, 7)\nr[3] = (0, 0)\n"
        "s' = -s^2 + r[2].y\n"
        "r[i](0) = (i, 10 i)   for i = 1..2\nr[i]'(0) = (0, 0)   for i = 1..2\ns(0) = 4\n");
    motus_run *r = run_of(s, 3);
    double x[4], v[5], dx[20], dv[25];
    state_of(r, x, v);
    derive(r, dx, dv);
    /* positions r[1].x, r[1].y, r[2].x, r[2].y; v: their velocities, s */
    const double want_x[5][4] = {
        {0, 0, 2, 0}, {x[1] * v[4], x[0] * v[4], 0, 0}, {0, 3, 0, 0}, {0, 0, x[3] * v[4], x[2] * v[4]}, {0, 0, 0, 1}};
    const double want_v[5][5] = {
        {0}, {-1, 0, 0, 0, x[0] * x[1]}, {0}, {0, 0, -1, 0, x[2] * x[3]}, {0, 0, 0, 0, -2 * v[4]}};
    for (int i = 0; i < 5; i++) {
        for (int j = 0; j < 4; j++)
            near(dx[4 * i + j], want_x[i][j], 4 * DBL_EPSILON * fabs(want_x[i][j]), "family, x");
        for (int j = 0; j < 5; j++)
            near(dv[5 * i + j], want_v[i][j], 4 * DBL_EPSILON * fabs(want_v[i][j]), "family, v");
    }
    motus_run_destroy(r);
    motus_system_destroy(s);
}

static int pull(void *context, double t, const double *x, const double *v, double *a)
{
    int *calls = context;
    (void)t;
    if (calls && (*calls)-- == 0) return 1;
    a[0] = -sin(x[0]) * x[1] - 0.3 * v[1];
    a[1] = x[0] * x[0] * x[0] - 2 * v[0] + v[2];
    a[2] = -v[2] + x[1];
    return 0;
}

static int slope(void *context, double t, const double *x, const double *v, const double *dx, const double *dv,
                 double *da)
{
    int *calls = context;
    (void)t, (void)v;
    if (calls && (*calls)-- == 0) return 1;
    da[0] = -cos(x[0]) * x[1] * dx[0] - sin(x[0]) * dx[1] - 0.3 * dv[1];
    da[1] = 3 * x[0] * x[0] * dx[0] - 2 * dv[0] + dv[2];
    da[2] = dx[1] - dv[2];
    return 0;
}

static motus_system *callback_of(int with_slope, int linear, int *calls)
{
    static const double x[] = {0.7, 1.5}, v[] = {0.2, -0.4, 3};
    motus_error err = motus_default_error();
    motus_callback_def def = motus_default_callback();
    def.positions = 2;
    def.first_order = 1;
    def.x = x;
    def.v = v;
    def.acceleration = pull;
    def.derivative = with_slope ? slope : NULL;
    def.linear_in_velocity = linear;
    def.context = calls;
    motus_system *s = NULL;
    must(motus_system_from_callback(&def, &s, &err), &err, "callback");
    return s;
}

/* With a derivative: to rounding. Without: to half of the digits; with respect to v, in which the force is declared
 * linear, to nearly all. */
static void callbacks_by_hand(void **state)
{
    (void)state;
    for (int kind = 0; kind < 3; kind++) {
        motus_system *s = callback_of(kind == 0, kind == 2, NULL);
        motus_run *r = run_of(s, 0);
        double dx[6], dv[9];
        derive(r, dx, dv);
        const double want_x[] = {-cos(0.7) * 1.5, -sin(0.7), 3 * 0.49, 0, 0, 1},
                     want_v[] = {0, -0.3, 0, -2, 0, 1, 0, 0, -1};
        /* a difference quotient with a shift of √ε: ε/√ε from rounding, √ε times half the second derivative (4.2 at
         * most) from truncation */
        const double quotient = 16 * sqrt(DBL_EPSILON);
        for (int k = 0; k < 6; k++) near(dx[k], want_x[k], kind ? quotient : 4 * DBL_EPSILON, "callback, x");
        for (int k = 0; k < 9; k++) near(dv[k], want_v[k], kind == 1 ? quotient : 16 * DBL_EPSILON, "callback, v");
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

static void looking_changes_nothing(void **state)
{
    (void)state;
    motus_system *s = given_text("mu = 5\nx'' = mu (1 - x^2) x' - x\nx(0) = 2\nx'(0) = 1\n");
    motus_run *a = run_of(s, 5), *b = run_of(s, 5);
    motus_error err = motus_default_error();
    double dx, dv, x[2], v[2];
    const int64_t before = motus_run_now(a).evaluations;
    derive(a, &dx, &dv);
    assert_int_equal(motus_run_now(a).evaluations, before);
    must(motus_run_step(a, 5, &err), &err, "step");
    must(motus_run_step(b, 5, &err), &err, "step");
    state_of(a, &x[0], &v[0]);
    state_of(b, &x[1], &v[1]);
    assert_true(x[0] == x[1] && v[0] == v[1] && motus_run_now(a).evaluations == motus_run_now(b).evaluations);
    motus_run_destroy(a);
    motus_run_destroy(b);
    motus_system_destroy(s);
}

static void wrong_requests(void **state)
{
    (void)state;
    motus_error e = motus_default_error();
    assert_int_equal(motus_run_jacobian(NULL, NULL, NULL, &e), MOTUS_ARGUMENT);
    static double much[MOTUS_JACOBIAN_MAX * MOTUS_JACOBIAN_MAX];
    for (int extra = 0; extra < 2; extra++) {
        char text[200], set[20];
        snprintf(set, sizeof set, "N=%d", MOTUS_JACOBIAN_MAX + extra);
        const char *sets[] = {set};
        snprintf(text, sizeof text,
                 "N = 3\nx[i]'' = x[i+1] - 2 x[i] + x[i-1]   for i = 1..N\nx[0] = 0\nx[N+1] = 0\nx[i](0) = i   for i = "
                 "1..N\nx[i]'(0) = 0   for i = 1..N\n");
        motus_system *s = given_text_with(text, sets, 1, "chain");
        motus_run *r = run_of(s, 0);
        if (extra) {
            assert_int_equal(motus_run_jacobian(r, much, NULL, &e), MOTUS_LIMIT);
            assert_true(e.message[0] && e.hint[0]);
        } else {
            derive(r, much, NULL);
            for (int i = 0; i < MOTUS_JACOBIAN_MAX; i++)
                for (int j = 0; j < MOTUS_JACOBIAN_MAX; j++)
                    assert_true(much[i * MOTUS_JACOBIAN_MAX + j] == (i == j ? -2 : abs(i - j) == 1 ? 1 : 0));
        }
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
    for (int with_slope = 0; with_slope < 2; with_slope++) {
        int calls = 100;
        motus_system *s = callback_of(with_slope, 0, &calls);
        motus_run *r = run_of(s, 0);
        for (int k = 0; k < 3; k++) {
            double dx[6], dv[9];
            calls = k;
            assert_int_equal(motus_run_jacobian(r, dx, dv, &e), MOTUS_CALLBACK);
        }
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(models_by_hand),    cmocka_unit_test(a_family_by_hand),
        cmocka_unit_test(callbacks_by_hand), cmocka_unit_test(looking_changes_nothing),
        cmocka_unit_test(wrong_requests),
    };
    return cmocka_run_group_tests_name("jacobian", tests, NULL, NULL);
}
