/* The studies: compare and converge, of callback systems and texts, on motions with a known solution. */
#include "motus.h"
#include "study/fit.h"
#include "study/paced.h"
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

/* Systems -------------------------------------------------------------------------------------------------------- */

static int spring_accel(void *context, double t, const double *x, const double *v, double *a)
{
    (void)context, (void)t, (void)v;
    a[0] = -x[0];
    return 0;
}

static int spring_exact(void *context, double t, double *x, double *v)
{
    (void)context;
    x[0] = cos(t);
    v[0] = -sin(t);
    return 0;
}

static int spring_energy(void *context, double t, const double *x, const double *v, double *value)
{
    (void)context, (void)t;
    *value = (v[0] * v[0] + x[0] * x[0]) / 2;
    return 0;
}

static int damped_accel(void *context, double t, const double *x, const double *v, double *a)
{
    (void)context, (void)t;
    a[0] = -x[0] - 0.5 * v[0];
    return 0;
}

/* A force with a jump: no method keeps a high order on it. */
static int jumping_accel(void *context, double t, const double *x, const double *v, double *a)
{
    (void)context, (void)t, (void)v;
    a[0] = x[0] > 0 ? -1 - x[0] : 1.5 - x[0];
    return 0;
}

/* x'' = 2 x³, x = 1/(1 - t): the motion ends at t = 1. */
static int bursting_accel(void *context, double t, const double *x, const double *v, double *a)
{
    (void)context, (void)t, (void)v;
    a[0] = 2 * x[0] * x[0] * x[0];
    return 0;
}

static motus_callback_def spring_def(void)
{
    static const double x[] = {1}, v[] = {0};
    motus_callback_def def = motus_default_callback();
    def.positions = 1;
    def.x = x;
    def.v = v;
    def.acceleration = spring_accel;
    def.exact = spring_exact;
    def.invariant = spring_energy;
    def.depends_on_velocity = def.depends_on_time = 0;
    return def;
}

static motus_system *system_of(const motus_callback_def *def)
{
    motus_system *s = NULL;
    motus_error e = motus_default_error();
    assert_int_equal(motus_system_from_callback(def, &s, &e), MOTUS_OK);
    return s;
}

static motus_system *system_of_text(const char *text)
{
    motus_text_def def = motus_default_text();
    motus_system *s = NULL;
    motus_error e = motus_default_error();
    def.text = text;
    if (motus_system_from_text(&def, &s, &e) != MOTUS_OK) fail_msg("%s", e.message);
    return s;
}

static motus_study_def study_of(const char *const *methods, size_t count, double step, double until)
{
    motus_study_def def = motus_default_study();
    def.methods = methods;
    def.method_count = count;
    def.step = step;
    def.until = until;
    return def;
}

static motus_comparison *compare(motus_system *s, const motus_study_def *def)
{
    motus_comparison *c = NULL;
    motus_error e = motus_default_error();
    if (motus_compare(s, def, &c, &e) != MOTUS_OK) fail_msg("%s", e.message);
    return c;
}

static motus_convergence *converge(motus_system *s, const motus_study_def *def)
{
    motus_convergence *c = NULL;
    motus_error e = motus_default_error();
    if (motus_converge(s, def, &c, &e) != MOTUS_OK) fail_msg("%s", e.message);
    return c;
}

static const motus_compare_row *row_of(const motus_comparison *c, const char *method)
{
    for (size_t k = 0; k < c->row_count; k++)
        if (strncmp(c->rows[k]->method, method, strlen(method)) == 0) return c->rows[k];
    fail_msg("no row %s", method);
    return NULL;
}

static const motus_converge_row *slope_of(const motus_convergence *c, const char *method)
{
    for (size_t k = 0; k < c->row_count; k++)
        if (strncmp(c->rows[k]->method, method, strlen(method)) == 0) return c->rows[k];
    fail_msg("no row %s", method);
    return NULL;
}

#define NEAR(a, b, tolerance) assert_true(fabs((a) - (b)) <= (tolerance))

/* Compare -------------------------------------------------------------------------------------------------------- */

static void every_number_of_a_spring(void **state)
{
    (void)state;
    motus_callback_def callback = spring_def();
    motus_system *s = system_of(&callback);
    const char *methods[] = {"explicit-euler", "symplectic-euler", "verlet"};
    const double h = 0.05, T = 50;
    const int n = 1000;
    motus_study_def def = study_of(methods, 3, h, T);
    motus_comparison *c = compare(s, &def);
    assert_int_equal(c->row_count, 3);
    assert_string_equal(c->reference, "exact");
    assert_true(c->reference_error == 0);
    /* Explicit Euler turns by atan h and grows by sqrt(1 + h²) in each step; there and back it has grown by (1 +
     * h²)^n. */
    const motus_compare_row *r = c->rows[0];
    assert_int_equal(r->steps, n);
    assert_int_equal(r->evaluations, n);
    assert_int_equal(r->order, 1);
    double growth = pow(1 + h * h, n);
    NEAR(r->error_final_x, fabs(sqrt(growth) * cos(n * atan(h)) - cos(T)), 1e-10);
    NEAR(r->error_final_v, fabs(-sqrt(growth) * sin(n * atan(h)) + sin(T)), 1e-10);
    assert_true(r->error_max_x >= r->error_final_x);
    assert_int_equal(r->invariant_count, 1);
    NEAR(r->invariants[0]->initial, 0.5, 0);
    NEAR(r->invariants[0]->final, growth / 2, 1e-10);
    NEAR(r->invariants[0]->max_drift, growth / 2 - 0.5, 1e-10);
    assert_true(r->invariants[0]->trending);
    NEAR(r->reversal, (growth - 1) / 2, 0.01); /* in units of the range, 2 */
    /* Symplectic Euler keeps x² + v² + h x v to the rounding: the energy swings within h/2 of a half, and has no
     * trend. */
    r = c->rows[1];
    assert_true(r->invariants[0]->max_drift > 0.2 * h / 2 && r->invariants[0]->max_drift < 0.6 * h);
    assert_false(r->invariants[0]->trending);
    assert_true(r->reversal > 1e-4);
    r = c->rows[2];
    assert_false(r->invariants[0]->trending);
    assert_true(r->reversal < 1e-13);
    assert_true(r->error_max_x < 0.01 && r->error_max_x > 0.001);
    assert_true(r->seconds > 0);
    assert_non_null(strstr(c->remarks, "explicit-euler"));
    assert_non_null(strstr(c->remarks, "without bound"));
    motus_comparison_destroy(c);
    motus_system_destroy(s);
}

static void a_reference_run_replaces_the_exact_motion(void **state)
{
    (void)state;
    motus_callback_def known = spring_def(), unknown = spring_def();
    unknown.exact = NULL;
    motus_system *a = system_of(&known), *b = system_of(&unknown);
    const char *methods[] = {"explicit-euler", "verlet", "rk4", "forest-ruth"};
    motus_study_def def = study_of(methods, 4, 0.125, 20);
    motus_comparison *p = compare(a, &def), *q = compare(b, &def);
    assert_string_not_equal(q->reference, "exact");
    assert_true(q->reference_error > 0 && q->reference_error < 1e-12);
    for (size_t k = 0; k < 4; k++) {
        /* cos and sin themselves are rounded */
        NEAR(p->rows[k]->error_max_x, q->rows[k]->error_max_x, q->reference_error + 1e-15);
        NEAR(p->rows[k]->error_max_v, q->rows[k]->error_max_v, q->reference_error + 1e-15);
        NEAR(p->rows[k]->error_final_x, q->rows[k]->error_final_x, q->reference_error + 1e-15);
    }
    motus_comparison_destroy(p);
    motus_comparison_destroy(q);
    motus_system_destroy(a);
    motus_system_destroy(b);
}

/* Where the force is discontinuous no reference reaches round-off; its error estimate must be honest there too. */
static void the_error_estimate_holds_at_a_jump(void **state)
{
    (void)state;
    motus_callback_def callback = spring_def();
    callback.acceleration = jumping_accel;
    callback.exact = NULL;
    motus_system *s = system_of(&callback);
    const char *methods[] = {"rk4", "verlet", "implicit-midpoint"};
    motus_study_def def = study_of(methods, 3, 0.01, 2);
    motus_comparison *c = compare(s, &def);
    assert_true(c->reference_error > 1e-12 && c->reference_error < 1e-4);
    /* x = -1 + 2 cos t down to x = 0 at t = pi/3; from there, with v = -sqrt 3, x = 3/2 (1 - cos u) - sqrt 3 sin u */
    double u = 2 - acos(0.5), exact = 1.5 * (1 - cos(u)) - sqrt(3) * sin(u);
    for (size_t k = 0; k < 3; k++) {
        motus_run_def run = motus_default_run();
        motus_run *r = NULL;
        double x;
        run.method = methods[k];
        run.step = 0.01;
        run.until = 2;
        assert_int_equal(motus_run_create(s, &run, &r, NULL), MOTUS_OK);
        assert_int_equal(motus_run_finish(r, NULL), MOTUS_OK);
        assert_int_equal(motus_run_state(r, &x, NULL, NULL), MOTUS_OK);
        NEAR(fabs(x - exact), c->rows[k]->error_final_x, c->reference_error);
        motus_run_destroy(r);
    }
    motus_comparison_destroy(c);
    motus_system_destroy(s);
}

static const char parabola[] = "g = (0, -9.81)\nr'' = g\nr(0) = (0, 0)\nr'(0) = (1, 4.5)\n"
                               "exact r = r(0) + r'(0) t + g t^2/2\nstep 0.05\nuntil 3\n";

static void euler_methods_miss_the_parabola(void **state)
{
    (void)state;
    motus_system *s = system_of_text(parabola);
    motus_comparison *c = compare(s, NULL);
    assert_true(c->row_count > 20);
    for (size_t k = 0; k < c->row_count; k++) {
        const motus_compare_row *r = c->rows[k];
        assert_string_not_equal(r->method, "exact");
        assert_int_equal(r->status, MOTUS_OK);
        if (r->order == 1)
            NEAR(r->error_final_x, 9.81 * 0.05 * 3 / 2, 1e-12);
        else
            assert_true(r->error_max_x < 1e-12 && r->error_max_v < 1e-12);
    }
    assert_non_null(strstr(c->remarks, "equal and opposite"));
    assert_non_null(strstr(c->remarks, "½ |a| h t = 0.73575"));
    assert_non_null(strstr(c->remarks, "parabola"));
    motus_comparison_destroy(c);
    /* With one of the Euler methods alone the remark about opposite errors is not made. */
    const char *one[] = {"explicit-euler"};
    motus_study_def def = study_of(one, 1, NAN, NAN);
    c = compare(s, &def);
    assert_null(strstr(c->remarks, "opposite"));
    assert_non_null(strstr(c->remarks, "½ |a| h t = 0.73575"));
    motus_comparison_destroy(c);
    motus_system_destroy(s);
}

static void short_last_steps_and_reversal(void **state)
{
    (void)state;
    motus_callback_def callback = spring_def();
    motus_system *s = system_of(&callback);
    const char *methods[] = {"verlet", "rk4", "gauss4", "pefrl"};
    for (int backward = 0; backward < 2; backward++)
        for (int few = 0; few < 2; few++) {
            motus_study_def def = study_of(methods, 4, few ? 5 : 0.03, backward ? -2 : 2);
            motus_comparison *c = compare(s, &def);
            for (size_t k = 0; k < 4; k++) {
                assert_int_equal(c->rows[k]->status, MOTUS_OK);
                assert_int_equal(c->rows[k]->steps, few ? 1 : 67);
                assert_non_null(strstr(c->rows[k]->note, "last step"));
                /* The run back takes the shorter step first: else it would not reverse the run. */
                if (k != 1 && !few) assert_true(c->rows[k]->reversal < 1e-13);
                assert_true(few || c->rows[k]->error_final_x < 1e-3);
            }
            motus_comparison_destroy(c);
        }
    motus_system_destroy(s);
}

static void equal_work(void **state)
{
    (void)state;
    motus_callback_def callback = spring_def();
    callback.exact = NULL;
    motus_system *s = system_of(&callback);
    motus_study_def def = motus_default_study();
    def.until = 20;
    def.evaluations = 5000;
    motus_comparison *c = compare(s, &def);
    for (size_t k = 0; k < c->row_count; k++) {
        const motus_compare_row *r = c->rows[k];
        assert_int_equal(r->status, MOTUS_OK);
        assert_true(llabs(r->evaluations - 5000) <= 100);
        NEAR(r->step * (double)r->steps, 20, 1e-9);
        assert_true(r->error_max_x < 0.1);
    }
    assert_true(row_of(c, "kahan-li8")->step > 10 * row_of(c, "verlet")->step);
    /* At equal work, with enough of it, the higher order is more accurate. */
    assert_true(row_of(c, "kahan-li8")->error_max_x < 1e-6 * row_of(c, "verlet")->error_max_x);
    motus_comparison_destroy(c);
    motus_system_destroy(s);
}

/* Errors of first-order variables are errors of their own; where there are no positions, none are told of these. */
static void errors_of_first_order_variables(void **state)
{
    (void)state;
    const char *methods[] = {"explicit-euler", "rk4"};
    motus_system *s = system_of_text("x' = -x\nx(0) = 1\nexact x = exp(-t)\n");
    motus_study_def def = study_of(methods, 2, 0.1, 1);
    motus_comparison *c = compare(s, &def);
    /* (1 - h)^n misses exp(-1) by h/(2 e) and a little more; the error of rk4 is below h^4/120 */
    assert_true(c->rows[0]->error_final_s > 0.1 / (2 * exp(1)) && c->rows[0]->error_final_s < 0.11 / (2 * exp(1)));
    assert_true(c->rows[0]->error_max_s >= c->rows[0]->error_final_s);
    assert_true(c->rows[1]->error_max_s > 1e-8 && c->rows[1]->error_max_s < 1e-6);
    assert_true(isnan(c->rows[1]->error_max_x) && isnan(c->rows[1]->error_max_v));
    motus_comparison_destroy(c);
    motus_system_destroy(s);
    s = system_of_text(
        "x'' = -x\ns' = x'^2\nx(0) = 1\nx'(0) = 0\ns(0) = 0\nexact x = cos(t)\nexact s = t/2 - sin(2 t)/4\n");
    def = study_of(methods, 2, 0.1, 1);
    c = compare(s, &def);
    assert_true(c->rows[0]->error_max_x > 1e-3 && c->rows[0]->error_max_v > 1e-3 && c->rows[0]->error_max_s > 1e-3);
    assert_true(c->rows[0]->error_max_s != c->rows[0]->error_max_v);
    motus_comparison_destroy(c);
    motus_system_destroy(s);
    s = system_of_text("x'' = -x\nx(0) = 1\nx'(0) = 0\nexact x = cos(t)\n");
    def = study_of(methods, 2, 0.1, 1);
    c = compare(s, &def);
    assert_true(isnan(c->rows[0]->error_max_s) && isnan(c->rows[0]->error_final_s) && c->rows[0]->error_max_v > 0);
    motus_comparison_destroy(c);
    motus_system_destroy(s);
}

static void failed_rows_have_status_and_note(void **state)
{
    (void)state;
    motus_callback_def callback = spring_def();
    callback.acceleration = damped_accel;
    callback.exact = NULL;
    callback.depends_on_velocity = 1;
    motus_system *s = system_of(&callback);
    const char *methods[] = {"blanes-moan6", "rk4"};
    motus_study_def def = study_of(methods, 2, 0.1, 5);
    motus_comparison *c = compare(s, &def);
    assert_int_equal(c->rows[0]->status, MOTUS_METHOD);
    assert_true(strlen(c->rows[0]->note) > 20);
    assert_true(isnan(c->rows[0]->error_max_x) && isnan(c->rows[0]->reversal));
    assert_int_equal(c->rows[1]->status, MOTUS_OK);
    assert_true(c->rows[1]->error_max_x < 1e-4);
    motus_comparison_destroy(c);
    motus_system_destroy(s);

    static const double one[] = {1};
    callback.acceleration = bursting_accel;
    callback.depends_on_velocity = 0;
    callback.v = one;
    callback.invariant = NULL;
    s = system_of(&callback);
    methods[0] = "verlet";
    def = study_of(methods, 2, 0.001, 2);
    c = compare(s, &def);
    assert_int_equal(strncmp(c->reference, "none", 4), 0);
    for (size_t k = 0; k < 2; k++) {
        assert_int_equal(c->rows[k]->status, MOTUS_DIVERGED);
        assert_true(isnan(c->rows[k]->error_final_x));
        assert_true(c->rows[k]->steps < 2000);
    }
    assert_non_null(strstr(c->remarks, "there is no reference solution"));
    motus_comparison_destroy(c);
    motus_system_destroy(s);
}

static void a_step_beyond_the_limit(void **state)
{
    (void)state;
    motus_callback_def callback = spring_def();
    motus_system *s = system_of(&callback);
    const char *methods[] = {"verlet", "implicit-midpoint"};
    motus_study_def def = study_of(methods, 2, 2.5, 1000);
    motus_comparison *c = compare(s, &def);
    assert_non_null(strstr(c->remarks, "verlet: the step 2.5 is beyond its stability limit"));
    assert_null(strstr(c->remarks, "implicit-midpoint: the step"));
    motus_comparison_destroy(c);
    motus_system_destroy(s);
}

/* Converge ------------------------------------------------------------------------------------------------------- */

static void certificates(void **state)
{
    (void)state;
    motus_callback_def callback = spring_def();
    motus_system *s = system_of(&callback);
    motus_study_def def = motus_default_study();
    def.until = 5;
    motus_convergence *c = converge(s, &def);
    assert_true(c->passed);
    assert_string_equal(c->reference, "exact");
    for (size_t k = 0; k < c->row_count; k++) {
        const motus_converge_row *r = c->rows[k];
        char text[64];
        assert_true((r->passed || r->uncertain) && r->status == MOTUS_OK);
        assert_true(!r->uncertain || r->adaptive);
        if (r->adaptive) continue;
        if (r->declared > 10) { /* round-off before the slope has settled, or at every step */
            assert_true(r->exact_here || r->observed >= 8);
            continue;
        }
        snprintf(text, sizeof text, "observed %.2f, declared %d", r->observed, r->declared);
        assert_string_equal(r->certificate, text);
        size_t used = 0;
        const motus_method *card = NULL;
        assert_int_equal(motus_method_find(r->method, &card, NULL), MOTUS_OK);
        for (size_t i = 0; i < r->point_count; i++) {
            used += r->points[i]->used != 0;
            /* as the card says, and one more for the first step of a FSAL method */
            double expected = card->evaluations * ceil(5 / r->points[i]->step),
                   spent = (double)r->points[i]->evaluations;
            assert_true(card->evaluations ? spent == expected || spent == expected + 1 : spent > 0);
        }
        assert_true(used >= FIT_POINTS_MIN);
        assert_true(r->observed > r->declared - 0.15 - 2 * r->standard_error && r->observed < r->declared + 0.3);
    }
    motus_convergence_destroy(c);
    motus_system_destroy(s);
}

/* Methods of kicks and drifts would lose their order, and that which judges the reference as well. */
/* Rows that choose their steps: the error goes with the order of the mean step, with the tolerance, and between steps
 * with the order due to dense output. */
static void adaptive_certificates(void **state)
{
    (void)state;
    motus_callback_def callback = spring_def();
    motus_system *s = system_of(&callback);
    const char *methods[] = {"dopri5", "fine4", "verner7", "blanes-moan4-reversible", "radau15"};
    motus_study_def def = study_of(methods, 5, NAN, 6);
    motus_convergence *c = converge(s, &def);
    for (size_t k = 0; k < 4; k++) {
        const motus_converge_row *r = c->rows[k];
        const motus_method *card = NULL;
        assert_int_equal(motus_method_find(r->method, &card, NULL), MOTUS_OK);
        if (!r->passed) fail_msg("%s: %s", r->method, r->certificate);
        assert_true(r->adaptive && !r->uncertain && r->status == MOTUS_OK);
        assert_int_equal(r->declared, card->order);
        assert_int_equal(r->between_due, card->order < card->dense_order + 1 ? card->order : card->dense_order + 1);
        assert_true(r->observed >= r->declared - 0.25);
        if (k != 1) NEAR(r->power, r->power_due, 0.12); /* fine4 has order 5 on this motion */
        assert_true(r->between >= r->between_due - 0.5);
        assert_non_null(strstr(r->certificate, "power of the tolerance"));
        assert_true(r->point_count > 8);
        for (size_t i = 1; i < r->point_count; i++) assert_true(r->points[i]->tolerance < r->points[i - 1]->tolerance);
        /* a point is a run, and its error between steps contains that at their ends and of the interpolation */
        const motus_point *p = r->points[r->point_count / 2];
        motus_run_def run_def = motus_default_run();
        motus_run *run = NULL;
        motus_error e = motus_default_error();
        run_def.method = r->method;
        run_def.tolerance = p->tolerance;
        run_def.until = 6;
        assert_int_equal(motus_run_create(s, &run_def, &run, &e), MOTUS_OK);
        assert_int_equal(motus_run_finish(run, &e), MOTUS_OK);
        NEAR(p->step * (double)motus_run_steps(run), run_def.until, 1e-12);
        assert_int_equal(motus_run_now(run).evaluations, p->evaluations);
        double x, v;
        assert_int_equal(motus_run_state(run, &x, &v, &e), MOTUS_OK);
        assert_true(fabs(x - cos(run_def.until)) <= 2 * p->error + 1e-14); /* the motion's size is nearly 2 */
        assert_true(p->error_between > 0 && p->error_between < 1e3 * p->error);
        motus_run_destroy(run);
    }
    /* round-off comes before radau15 shows order 15: nothing is said, and nothing has failed */
    const motus_converge_row *r = c->rows[4];
    assert_true(!r->passed && r->uncertain && r->status == MOTUS_OK && strstr(r->certificate, "not certified"));
    assert_true(c->passed);
    motus_convergence_destroy(c);
    motus_system_destroy(s);
    /* and where the force jumps no row has its order */
    s = system_of_text("x'' = if(x > 0, -1 - x, 3/2 - x)\nx(0) = 1\nx'(0) = 0\n");
    def = study_of(methods, 1, NAN, 6);
    c = converge(s, &def);
    assert_true(!c->rows[0]->passed && c->rows[0]->uncertain && strstr(c->rows[0]->certificate, "the force jumps"));
    motus_convergence_destroy(c);
    motus_system_destroy(s);
}

/* The rule itself, on errors that are made: c h^ends at the ends of steps, c h^between between them, at tolerances
 * h^power, all with a scatter, down to 1e-15. */
static motus_converge_row judged(const char *method, double ends, double between, double power)
{
    enum { COUNT = 40 };
    static motus_point points[COUNT];
    static char text[MOTUS_TEXT_MAX];
    const motus_method *card = NULL;
    assert_int_equal(motus_method_find(method, &card, NULL), MOTUS_OK);
    motus_converge_row row = {.point_count = COUNT, .certificate = text};
    for (size_t i = 0; i < COUNT; i++) {
        const double h = 0.5 * exp(-(double)i * 0.17), scatter = 1 + 0.05 * sin(7.0 * (double)i);
        points[i] = (motus_point){.step = h,
                                  .error = scatter * 0.1 * pow(h, ends) + 1e-15,
                                  .error_between = scatter * 0.2 * pow(h, between) + 1e-15,
                                  .tolerance = 0.1 * pow(h, power)};
    }
    const paced_noise noise = {1e-15, 1e-16, 6};
    paced_certify(card, &noise, false, points, &row, text, sizeof text);
    return row;
}

static void the_rule_of_adaptive_certificates(void **state)
{
    (void)state;
    motus_converge_row r = judged("dopri5", 5, 5, 5);
    assert_true(r.passed && !r.uncertain);
    NEAR(r.observed, 5, 0.1);
    NEAR(r.power, 1, 0.02);
    NEAR(r.between, 5, 0.1);
    assert_true(judged("dopri5", 6, 5, 5).passed);                     /* better is no fault */
    assert_int_equal(judged("dopri5", 3.5, 5, 5).status, MOTUS_ORDER); /* an order is lost */
    assert_true(!judged("dopri5", 3.5, 5, 5).passed && !judged("dopri5", 3.5, 5, 5).uncertain);
    assert_int_equal(judged("dopri5", 5, 3.5, 5).status, MOTUS_ORDER); /* between steps */
    r = judged("dopri5", 4.5, 5, 5);
    assert_true(!r.passed && r.uncertain && r.status == MOTUS_OK); /* neither */
    r = judged("dopri5", 5, 5, 7);
    assert_true(!r.passed && r.uncertain &&
                strstr(r.certificate, "tolerance: 0.7")); /* tolerances that say too little */
    r = judged("verner9", 30, 30, 30);
    assert_true(!r.passed && r.uncertain && isnan(r.observed)); /* too few points */
}

static void an_undeclared_velocity_is_refused(void **state)
{
    (void)state;
    motus_callback_def callback = spring_def();
    callback.acceleration = damped_accel;
    callback.exact = NULL;
    motus_system *s = system_of(&callback);
    const char *methods[] = {"velocity-verlet", "forest-ruth", "rk4"};
    motus_study_def def = study_of(methods, 3, 0.1, 5);
    motus_error err = motus_default_error();
    motus_convergence *c;
    motus_comparison *d;
    motus_reference *r;
    assert_int_equal(motus_converge(s, &def, &c, &err), MOTUS_CALLBACK);
    assert_non_null(strstr(err.message, "reads the velocity, though its definition says that it does not"));
    assert_int_equal(motus_compare(s, &def, &d, &err), MOTUS_CALLBACK);
    assert_non_null(strstr(err.hint, "depends_on_velocity"));
    assert_int_equal(motus_reference_create(s, &def, &r, NULL), MOTUS_CALLBACK);
    motus_system_destroy(s);
}

static void a_jump_costs_the_order(void **state)
{
    (void)state;
    motus_callback_def callback = spring_def();
    callback.acceleration = jumping_accel;
    callback.exact = NULL;
    motus_system *s = system_of(&callback);
    const char *methods[] = {"rk4", "kahan-li6"};
    motus_study_def def = study_of(methods, 2, NAN, 5);
    motus_convergence *c = converge(s, &def);
    assert_false(c->rows[0]->passed);
    assert_false(c->rows[1]->passed);
    motus_convergence_destroy(c);
    motus_system_destroy(s);
}

/* A jump at half of the run, where steps of simple fractions of it would end. */
static void no_certificate_by_luck(void **state)
{
    (void)state;
    motus_system *s = system_of_text("x'' = -x + if(t > 2.5, 1, 0)\nx(0) = 1\nx'(0) = 0\nuntil 5\nstep 0.1\n");
    motus_convergence *c = converge(s, NULL);
    for (size_t k = 0; k < c->row_count; k++) {
        assert_true(c->rows[k]->passed == 0 || c->rows[k]->declared == 1);
        if (c->rows[k]->declared > 1) assert_non_null(strstr(c->rows[k]->certificate, "the force jumps at t = 2.5"));
    }
    motus_convergence_destroy(c);
    motus_system_destroy(s);
}

/* The order that a force allows, and the time, with the digits that tell it from the ends of the motion. */
static void what_a_force_allows(void **state)
{
    (void)state;
    static const struct {
        const char *text, *says;
    } rows[] = {
        {"x'' = -x - sqrt(x^2)\nx(0) = 1\nx'(0) = 0\nuntil 2\n",
         "the slope of the force jumps at t = 1.11072. No method of "
         "fixed step has more than order 2 here"},
        {"x'' = -x + 0.1 |x|^1.3\nx(0) = 1\nx'(0) = 0\nuntil 2\n", "derivative 2 of the force is infinite at t = "},
        {"x'' = -x + 0.1 |x|^1.3\nx(0) = 1\nx'(0) = 0\nuntil 2\n", "more than order 2.3 here"},
        {"x'' = -cbrt(x)\nx(0) = 1\nx'(0) = 0\nuntil 2\n", "the slope of the force is infinite at t = "},
        {"x'' = -cbrt(x)\nx(0) = 1\nx'(0) = 0\nuntil 2\n", "more than order 1.33 here"},
        {"x'' = -x + if(x > 0, sin(x), x - x^3/6)\nx(0) = 1\nx'(0) = -1\nuntil 2\n",
         "derivative 5 of the force jumps at t"},
        {"x'' = -sign(x)\nx(1e6) = 1\nx'(1e6) = 0\nuntil 1000002\n", "the force jumps at t = 1000001.41421."},
    };
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        motus_system *s = system_of_text(rows[k].text);
        motus_study_def def = motus_default_study();
        const char *const methods[] = {"rk4", "velocity-verlet"};
        def.step = 0.02;
        def.methods = methods;
        def.method_count = 2;
        motus_comparison *c = compare(s, &def);
        if (!strstr(c->remarks, rows[k].says)) fail_msg("%s: %s", rows[k].text, c->remarks);
        motus_comparison_destroy(c);
        motus_system_destroy(s);
    }
    static const char *const smooth[] = {"x'' = -x - sqrt(x^2 + 1)\nx(0) = 1\nx'(0) = 0\nuntil 5\nstep 0.05\n",
                                         "r'' = -r/|r|^3\nr(0) = (1, 0)\nr'(0) = (0, 0.6)\nuntil 5\nstep 0.01\n"};
    for (size_t k = 0; k < sizeof smooth / sizeof *smooth; k++) {
        motus_system *s = system_of_text(smooth[k]);
        motus_comparison *c = compare(s, NULL);
        if (strstr(c->remarks, "smooth")) fail_msg("%s: %s", smooth[k], c->remarks);
        motus_comparison_destroy(c);
        motus_system_destroy(s);
    }
}

/* Where a force allows just the order of a method, the errors at the jump are of it too, and differ from step to
 * step. */
static void just_the_order_allowed(void **state)
{
    (void)state;
    for (int k = 0; k < 4; k++) {
        char text[128];
        snprintf(text, sizeof text, "x'' = -x + |sin(x)|\nx(0) = %d\nx'(0) = %d\nuntil 20\n", k / 2 ? 1 : -1, k % 2);
        motus_system *s = system_of_text(text);
        motus_study_def def = motus_default_study();
        const char *const methods[] = {"velocity-verlet", "rk4"};
        def.methods = methods;
        def.method_count = 2;
        motus_convergence *c = converge(s, &def);
        assert_true(c->rows[0]->passed && fabs(c->rows[0]->observed - 2) < 0.4);
        /* order 4 is not shown, and not denied: the errors keep the order that the force leaves */
        assert_false(c->rows[1]->passed);
        assert_true(c->rows[1]->uncertain && c->rows[1]->status == MOTUS_OK && c->passed);
        motus_convergence_destroy(c);
        motus_system_destroy(s);
    }
}

static void exact_here(void **state)
{
    (void)state;
    motus_system *s = system_of_text(parabola);
    motus_convergence *c = converge(s, NULL);
    assert_true(c->passed);
    for (size_t k = 0; k < c->row_count; k++) {
        assert_int_equal(c->rows[k]->exact_here, c->rows[k]->declared > 1);
        assert_true(c->rows[k]->exact_here == isnan(c->rows[k]->observed));
    }
    assert_string_equal(slope_of(c, "verlet")->certificate, "exact here, declared 2");
    motus_convergence_destroy(c);
    motus_system_destroy(s);
}

static void long_motions_are_cut(void **state)
{
    (void)state;
    motus_system *s = system_of_text("x'' = -x\nx(0) = 1\nx'(0) = 0\nstep 0.1\nuntil 10000\n");
    const char *methods[] = {"verlet", "kahan-li8"};
    motus_study_def def = study_of(methods, 2, NAN, NAN);
    motus_convergence *c = converge(s, &def);
    assert_true(c->passed);
    assert_non_null(strstr(c->reference, "not 10000: over a longer motion"));
    motus_convergence_destroy(c);
    def.until = 60; /* an end that the user gives is not cut */
    c = converge(s, &def);
    assert_null(strstr(c->reference, "not 60"));
    NEAR(c->rows[0]->points[0]->step, 7.5, 1e-12);
    motus_convergence_destroy(c);
    motus_system_destroy(s);
}

/* Round-off may come before the slope of a good method has settled: that is no failure. */
static void round_off_that_comes_too_soon_is_no_failure(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "x'' = -sin(x) + 0.3 cos(t)\nx(0) = 1; x'(0) = 0\nuntil 10\n",
        "x'' = -1.61 sin(x) + 0.2 cos(1.1 t)\nx(0) = 0.83; x'(0) = -0.4\nuntil 14.67\n",
        "x'' = -1.3 tanh(1.7 x)\nx(0) = 1.2; x'(0) = 0.5\nuntil 12\n",
        "x'' = -x exp(-0.3 x^2)\nx(0) = -1.1; x'(0) = 0.7\nuntil 17\n",
    };
    size_t uncertain = 0;
    for (size_t m = 0; m < sizeof texts / sizeof *texts; m++) {
        motus_system *s = system_of_text(texts[m]);
        const char *const methods[] = {"blanes-moan6-14", "kahan-li8", "rk4",     "rk4-38",  "gauss8",
                                       "gauss10",         "gauss12",   "gauss14", "gauss16", "radau15-fixed"};
        motus_study_def def = study_of((const char **)methods, 10, NAN, NAN);
        motus_convergence *c = converge(s, &def);
        for (size_t k = 0; k < c->row_count; k++) {
            const motus_converge_row *r = c->rows[k];
            if (!(r->passed || r->uncertain) || r->status != MOTUS_OK)
                fail_msg("%s: %s: %s", texts[m], r->method, r->certificate);
            uncertain += r->uncertain != 0;
        }
        assert_true(c->passed);
        motus_convergence_destroy(c);
        motus_system_destroy(s);
    }
    assert_true(uncertain > 0);
}

/* An order is measured up to the end that was asked for, and a jump just before it is seen. */
static void the_last_twentieth_counts(void **state)
{
    (void)state;
    motus_system *s = system_of_text("x'' = if(t < 9.8, -x, 1 - x)\nx(0) = 1\nx'(0) = 0\nuntil 10\n");
    const char *methods[] = {"rk4", "verlet"};
    motus_study_def def = study_of(methods, 2, NAN, NAN);
    motus_convergence *c = converge(s, &def);
    for (size_t k = 0; k < 2; k++) assert_non_null(strstr(c->rows[k]->certificate, "the force jumps at t = 9.8"));
    for (size_t k = 0; k < 2; k++) assert_true(!c->rows[k]->passed && c->rows[k]->uncertain);
    motus_convergence_destroy(c);
    motus_system_destroy(s);
}

#ifdef MOTUS_SOURCE_DIR
static void models_certify_every_method(void **state)
{
    (void)state;
    const char *models[] = {"pendulum", "damped-cubic", "projectile-drag", "charged-particle"};
    for (size_t m = 0; m < 4; m++) {
        char path[1024], *text = calloc(1, 1 << 16);
        snprintf(path, sizeof path, MOTUS_SOURCE_DIR "/models/%s.motus", models[m]);
        FILE *f = fopen(path, "rb");
        assert_non_null(f);
        assert_true(fread(text, 1, (1 << 16) - 1, f) > 0);
        fclose(f);
        motus_system *s = system_of_text(text);
        motus_convergence *c = converge(s, NULL);
        assert_true(c->row_count >= 14);
        size_t certified = 0;
        for (size_t k = 0; k < c->row_count; k++) certified += c->rows[k]->adaptive && c->rows[k]->passed;
        if (certified < 3) fail_msg("%s: %zu adaptive rows", models[m], certified);
        for (size_t k = 0; k < c->row_count; k++)
            if (!c->rows[k]->passed && !c->rows[k]->uncertain)
                fail_msg("%s: %s: %s", models[m], c->rows[k]->method, c->rows[k]->certificate);
        assert_true(c->passed);
        motus_convergence_destroy(c);
        motus_system_destroy(s);
        free(text);
    }
}

static void the_error_of_verlet_to_twenty_digits(void **state)
{
    (void)state;
    motus_system *s =
        system_of_text("F = 0.1\nx'' = -x + x^3 + F cos(t)\nx(0) = 0\nx'(0) = 0\nstep 0.001\nuntil 100\n");
    const char *methods[] = {"verlet"};
    motus_study_def def = study_of(methods, 1, NAN, NAN);
    motus_comparison *c = compare(s, &def);
    /* the recursion in exact arithmetic, and the solution, both to 20 digits */
    NEAR(c->rows[0]->error_final_x, 0.04778309565760846604243 - 0.04778239807187257792945, 2e-14);
    assert_true(c->reference_error < 1e-13);
    motus_comparison_destroy(c);
    motus_system_destroy(s);
}
#endif

/* Requests, cancelling, memory ----------------------------------------------------------------------------------- */

static void wrong_requests(void **state)
{
    (void)state;
    motus_callback_def callback = spring_def();
    motus_system *s = system_of(&callback);
    motus_comparison *c = (motus_comparison *)s;
    motus_convergence *v = (motus_convergence *)s;
    motus_error e = motus_default_error();
    motus_study_def def = motus_default_study();
    assert_int_equal(motus_compare(s, &def, &c, &e), MOTUS_ARGUMENT); /* no step, no end */
    assert_null(c);
    assert_true(e.message[0] && e.hint[0]);
    assert_int_equal(motus_converge(s, &def, &v, &e), MOTUS_ARGUMENT);
    assert_null(v);
    def.until = 1;
    assert_int_equal(motus_compare(s, &def, &c, &e), MOTUS_ARGUMENT); /* no step */
    def.step = -1;
    assert_int_equal(motus_compare(s, &def, &c, &e), MOTUS_ARGUMENT);
    def.step = INFINITY;
    assert_int_equal(motus_compare(s, &def, &c, &e), MOTUS_ARGUMENT);
    def.step = 0.1;
    def.until = 0;
    assert_int_equal(motus_compare(s, &def, &c, &e), MOTUS_ARGUMENT); /* no length */
    assert_int_equal(motus_converge(s, &def, &v, &e), MOTUS_ARGUMENT);
    def.until = INFINITY;
    assert_int_equal(motus_compare(s, &def, &c, &e), MOTUS_ARGUMENT);
    def.until = 1;
    def.evaluations = -1;
    assert_int_equal(motus_compare(s, &def, &c, &e), MOTUS_ARGUMENT);
    def.evaluations = 0;
    const char *unknown[] = {"verlet", "verletto"};
    def.methods = unknown;
    def.method_count = 2;
    assert_int_equal(motus_compare(s, &def, &c, &e), MOTUS_METHOD);
    assert_non_null(strstr(e.message, "verletto"));
    assert_int_equal(motus_converge(s, &def, &v, NULL), MOTUS_METHOD);
    unknown[1] = NULL;
    assert_int_equal(motus_converge(s, &def, &v, &e), MOTUS_ARGUMENT);
    def.size = 0;
    assert_int_equal(motus_compare(s, &def, &c, &e), MOTUS_ARGUMENT);
    assert_int_equal(motus_compare(NULL, &def, &c, &e), MOTUS_ARGUMENT);
    assert_int_equal(motus_converge(s, &def, NULL, &e), MOTUS_ARGUMENT);
    motus_comparison_destroy(NULL);
    motus_convergence_destroy(NULL);
    motus_system_destroy(s);
}

typedef struct calls {
    int calls, stop_at;
    double last;
} calls;

static int observing(void *context, double fraction)
{
    calls *w = context;
    assert_true(fraction >= 0 && fraction <= 1);
    assert_true(fraction >= w->last - 1e-9);
    w->last = fraction;
    return ++w->calls == w->stop_at;
}

static void progress_and_cancelling(void **state)
{
    (void)state;
    motus_callback_def callback = spring_def();
    callback.exact = NULL;
    motus_system *s = system_of(&callback);
    motus_study_def def = motus_default_study();
    def.step = 0.002;
    def.until = 100;
    def.progress = observing;
    for (int stop = 1; stop <= 3; stop++) {
        calls w = {0, stop, 0};
        def.context = &w;
        motus_comparison *c = NULL;
        motus_error e = motus_default_error();
        assert_int_equal(motus_compare(s, &def, &c, &e), MOTUS_CANCELLED);
        assert_int_equal(e.status, MOTUS_CANCELLED);
        assert_null(c);
        assert_int_equal(w.calls, stop);
        w = (calls){0, stop, 0};
        motus_convergence *v = NULL;
        assert_int_equal(motus_converge(s, &def, &v, NULL), MOTUS_CANCELLED);
        assert_null(v);
        assert_int_equal(w.calls, stop);
    }
    calls w = {0, 0, 0};
    def.context = &w;
    motus_comparison *c = compare(s, &def);
    assert_true(w.calls > 3);
    assert_true(w.last > 0.5);
    motus_comparison_destroy(c);
    w = (calls){0, 0, 0};
    motus_convergence *v = converge(s, &def);
    assert_true(w.calls > 3);
    motus_convergence_destroy(v);
    motus_system_destroy(s);
}

typedef struct purse {
    long left, open, refused;
} purse;

static void *spend(void *context, size_t bytes)
{
    purse *p = context;
    if (p->left == 0) {
        p->refused++;
        p->left = -1; /* fails once only: code that ignores it would go on and return a wrong answer */
        return NULL;
    }
    p->left -= p->left > 0;
    p->open++;
    return malloc(bytes);
}

static void spare(void *context, void *block)
{
    ((purse *)context)->open--;
    free(block);
}

static void every_allocation_may_fail(void **state)
{
    (void)state;
    for (int what = 0; what < 4; what++) {
        purse p = {-1, 0, 0};
        motus_callback_def callback = spring_def();
        callback.exact = NULL;
        callback.allocator = (motus_allocator){spend, spare, &p};
        motus_system *s = system_of(&callback);
        long before = p.open;
        const char *methods[] = {"verlet"};
        motus_study_def def = study_of(methods, 1, 0.5, 4);
        def.evaluations = what == 0 ? 40 : 0;
        if (what == 3) {
            methods[0] = "dopri5";
            def.step = NAN;
            def.coarsest = 1e-3;
        }
        motus_status status = MOTUS_MEMORY;
        /* There are thousands of allocations: the first ones fail one by one, then a sample of the rest. */
        for (long k = 0; status != MOTUS_OK; k = k < 60 ? k + 1 : k + k / 8) {
            motus_comparison *c = NULL;
            motus_convergence *v = NULL;
            motus_reference *r = NULL;
            motus_ranking *w = NULL;
            motus_error e = motus_default_error();
            p.left = k;
            p.refused = 0;
            status = what == 0   ? motus_compare(s, &def, &c, &e)
                     : what == 1 ? motus_converge(s, &def, &v, &e)
                     : what == 3 ? motus_rank(s, &def, &w, &e)
                                 : motus_reference_create(s, &def, &r, &e);
            const double times[] = {3.1, 0.2};
            double x[2];
            if (r) status = motus_reference_at(r, times, 2, x, NULL, &e);
            p.left = -1;
            assert_int_equal(status, p.refused ? MOTUS_MEMORY : MOTUS_OK);
            assert_int_equal(e.status, status);
            motus_comparison_destroy(c);
            motus_convergence_destroy(v);
            motus_reference_destroy(r);
            motus_ranking_destroy(w);
            assert_int_equal(p.open, before);
        }
        motus_system_destroy(s);
        assert_int_equal(p.open, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_error_estimate_holds_at_a_jump),
        cmocka_unit_test(every_number_of_a_spring),
        cmocka_unit_test(a_reference_run_replaces_the_exact_motion),
        cmocka_unit_test(euler_methods_miss_the_parabola),
        cmocka_unit_test(short_last_steps_and_reversal),
        cmocka_unit_test(equal_work),
        cmocka_unit_test(failed_rows_have_status_and_note),
        cmocka_unit_test(errors_of_first_order_variables),
        cmocka_unit_test(a_step_beyond_the_limit),
        cmocka_unit_test(certificates),
        cmocka_unit_test(adaptive_certificates),
        cmocka_unit_test(the_rule_of_adaptive_certificates),
        cmocka_unit_test(an_undeclared_velocity_is_refused),
        cmocka_unit_test(a_jump_costs_the_order),
        cmocka_unit_test(what_a_force_allows),
        cmocka_unit_test(just_the_order_allowed),
        cmocka_unit_test(no_certificate_by_luck),
        cmocka_unit_test(exact_here),
        cmocka_unit_test(long_motions_are_cut),
        cmocka_unit_test(round_off_that_comes_too_soon_is_no_failure),
        cmocka_unit_test(the_last_twentieth_counts),
#ifdef MOTUS_SOURCE_DIR
        cmocka_unit_test(models_certify_every_method),
        cmocka_unit_test(the_error_of_verlet_to_twenty_digits),
#endif
        cmocka_unit_test(wrong_requests),
        cmocka_unit_test(progress_and_cancelling),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests_name("study", tests, NULL, NULL);
}
