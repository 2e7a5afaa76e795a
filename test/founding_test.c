/* The two founding problems, from their model files: the projectile, and the two recurrences of the notebook.
 *
 * Numbers of the notebook are those of its own loop in double precision; beside them are the values of the same
 * recurrences in exact arithmetic (200 bits, h = 1/1000), 22 digits, and the solutions of the equations.
 */
#include "test/given.h"

/* The projectile --------------------------------------------------------------------------------------------------- */

enum { PAGE_STEPS = 60 };
static const double PAGE_H = 0.05, PAGE_G = 9.81, PAGE_T = 3, PAGE_Y = -30.645, PAGE_X = 3;

/* The bound on rounding in n steps: each step rounds y (below 31) and v (below 25), and an error of v acts until the
 * end; stages and products with h round quantities of size h v; the literals 9.81, 4.5 and 0.05 are rounded too. */
static double page_rounding(void)
{
    const double n = PAGE_STEPS, y = 31, v = 25;
    return ROUNDING *
           (n * y + PAGE_H * v * (n * (n + 1) / 2 + 2 * n) + 2 * (PAGE_T * v + PAGE_G * PAGE_T * PAGE_T / 2));
}

static void page(const char *method, double above)
{
    motus_system *s = given_model("projectile.motus", NULL, 0);
    motus_run *r = given_run(s, method, NAN, NAN);
    assert_true(motus_run_now(r).step == PAGE_H);
    assert_int_equal(motus_run_now(r).steps_total, PAGE_STEPS);
    finish(r);
    assert_true(motus_run_time(r) == PAGE_T);
    near(value(s, r, "exact r.y"), PAGE_Y, page_rounding(), "the parabola");
    near(value(s, r, "r.y") - PAGE_Y, above, page_rounding(), method);
    near(value(s, r, "r.x"), PAGE_X, page_rounding(), method);
    near(value(s, r, "r'.y"), 4.5 - PAGE_G * PAGE_T, page_rounding(), method);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* y_n = y(t_n) ± (1/2) g h t_n: explicit Euler drifts with the velocity before the kick, symplectic Euler with that
 * after it. */
static void eulers_miss_by_equal_and_opposite_amounts(void **state)
{
    (void)state;
    const double miss = PAGE_G * PAGE_H * PAGE_T / 2; /* 0.73575 */
    near(miss, 0.73575, 1e-15, "half g h t");
    page("explicit-euler", miss);
    page("symplectic-euler", -miss);
    page(NULL, -miss); /* the model's own method */
}

static void order_two_is_exact_on_the_parabola(void **state)
{
    (void)state;
    static const char *const methods[] = {"midpoint", "rk2",  "verlet", "velocity-verlet",
                                          "leapfrog", "heun", "exact",  "implicit-midpoint"};
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) page(methods[i], 0);
}

/* The notebook ----------------------------------------------------------------------------------------------------- */

typedef struct entry {
    int64_t n;
    double loop, other; /* the notebook's loop, and the same with its terms in another order */
    double recursion;   /* the recursion in exact arithmetic */
} entry;

static const entry driven[] = {
    {1000, 0.0420751676095948, 0.0420751676095948, 0.04207516760960441335731},
    {10000, -0.17387738215185217, -0.1738773821519342, -0.1738773821515826231245},
    {50000, -0.8190196386786806, -0.819019638694558, -0.8190196386833164899665},
    {99999, 0.047965273379025807, 0.04796527337802404, 0.04796527337984273140351},
    {100000, 0.04778239807105365, 0.04778239807006475, 0.04778239807187257792945},
    {100001, 0.0475995613216654, 0.04759956132068937, 0.04759956132248632500668},
};
static const entry damped[] = {
    {500, -5.818576420328005, -5.818576420319053, -5.818576420328394541357},
    {1000, 4.071615394296948, 4.071615394278456, 4.071615394297357525042},
    {2000, 4.921628363830442, 4.921628363843683, 4.921628363830870650900},
    {2999, -3.4949045525253655, -3.4949045525058433, -3.494904552525354153021},
    {3000, -3.4894421772061026, -3.489442177186423, -3.489442177206087865029},
    {3001, -3.4839427945965586, -3.483942794576722, -3.483942794596540482995},
};
enum { ENTRIES = 6 };
static const double DRIVEN_SOLUTION = 0.04778309565760846604243, DAMPED_SOLUTION = -3.489418164528281725538;

/* Every row of a table, by one run that stops at each time. */
static void recurrence(const char *model, const char *method, const entry *table, int literal, double bound)
{
    motus_system *s = given_model(model, NULL, 0);
    motus_run *r = given_run(s, method, 0.001, 0.001 * (double)table[ENTRIES - 1].n);
    for (int i = 0; i < ENTRIES; i++) {
        char what[80];
        snprintf(what, sizeof what, "%s: x at step %lld", motus_run_now(r).method, (long long)table[i].n);
        take_steps(r, table[i].n - motus_run_steps(r));
        near(value(s, r, "x"), literal ? table[i].loop : table[i].recursion, bound, what);
        if (literal) near(value(s, r, "x"), table[i].other, bound, what);
    }
    assert_true(motus_run_done(r));
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* The bounds of the summed form are 1e-13 and 1e-12; the plain recurrence loses some 1e-12 (`lost`). */
static void verlet_is_the_recursion_in_exact_arithmetic(void **state)
{
    (void)state;
    recurrence("driven-oscillator.motus", NULL, driven, 0, 1e-13);
    recurrence("damped-cubic.motus", NULL, damped, 0, 1e-12);
}

/* The difference of two orders of the same terms measures the rounding of the plain form; a third order cannot be
 * expected to be nearer. */
static double lost(const entry *table)
{
    double most = 0;
    for (int i = 0; i < ENTRIES; i++) most = fmax(most, fabs(table[i].loop - table[i].other));
    return most;
}

static void verlet_literal_is_the_notebook_s_loop(void **state)
{
    (void)state;
    recurrence("driven-oscillator.motus", "verlet-literal", driven, 1, 2 * lost(driven));
    recurrence("damped-cubic.motus", "verlet-literal", damped, 1, 2 * lost(damped));
    motus_system *s = given_model("driven-oscillator.motus", NULL, 0);
    motus_run *r = given_run(s, "verlet-literal", NAN, NAN);
    finish(r);
    near(value(s, r, "x"), 0.04778239807006475, 1e-11, "x(100) of the notebook");
    motus_run_destroy(r);
    motus_system_destroy(s);
}

static double end_of(const char *model, double step)
{
    motus_system *s = given_model(model, NULL, 0);
    motus_run *r = given_run(s, "verlet", step, NAN);
    finish(r);
    double x = value(s, r, "x");
    motus_run_destroy(r);
    motus_system_destroy(s);
    return x;
}

/* At half the step the recursion is four times nearer to the solution: 4.00 to the printed digits. */
static void half_the_step_is_a_quarter_of_the_error(void **state)
{
    (void)state;
    double a = end_of("driven-oscillator.motus", 0.001), b = end_of("driven-oscillator.motus", 0.0005);
    near(b, 0.04778292126101846827806, 1e-13, "x(100) with h = 0.0005");
    near(a - DRIVEN_SOLUTION, -6.98e-7, 0.005e-7, "error of h = 0.001");
    near((a - DRIVEN_SOLUTION) / (b - DRIVEN_SOLUTION), 4, 0.005, "ratio");
    a = end_of("damped-cubic.motus", 0.001), b = end_of("damped-cubic.motus", 0.0005);
    near(b, -3.489424167534111204508, 1e-12, "x(3) with h = 0.0005");
    near(a - DAMPED_SOLUTION, -2.40e-5, 0.005e-5, "error of h = 0.001");
    near((a - DAMPED_SOLUTION) / (b - DAMPED_SOLUTION), 4, 0.005, "ratio");
}

/* The velocity term of the second example is solved in closed form: one evaluation a step and no iteration. */
static void damped_cubic_needs_no_iteration(void **state)
{
    (void)state;
    motus_system *s = given_model("damped-cubic.motus", NULL, 0);
    motus_run *r = given_run(s, NULL, NAN, NAN);
    finish(r);
    assert_int_equal(motus_run_now(r).iterations, 0);
    assert_int_equal(motus_run_steps(r), 3000);
    assert_int_equal(motus_run_now(r).evaluations, 3000);
    motus_analysis a = motus_default_analysis();
    motus_analysis_of(s, &a);
    assert_true(a.velocity_dependent && a.linear_in_velocity && !a.time_dependent && !a.affine);
    assert_non_null(strstr(motus_explain(s), "closed form"));
    motus_run_destroy(r);
    motus_system_destroy(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(eulers_miss_by_equal_and_opposite_amounts),
        cmocka_unit_test(order_two_is_exact_on_the_parabola),
        cmocka_unit_test(verlet_is_the_recursion_in_exact_arithmetic),
        cmocka_unit_test(verlet_literal_is_the_notebook_s_loop),
        cmocka_unit_test(half_the_step_is_a_quarter_of_the_error),
        cmocka_unit_test(damped_cubic_needs_no_iteration),
    };
    return cmocka_run_group_tests_name("founding documents", tests, NULL, NULL);
}
