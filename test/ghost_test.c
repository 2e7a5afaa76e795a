/* Ghost cells: boundary cells whose line depends on a state. They are compared, to the bit, with the same equations
 * written without them, on every machine; and with what is known of free ends and of a hinged beam. */
#include "given.h"

#include <stdbool.h>

#define START(x) x "[i](0) = sin(i) for i = 1..N\n" x "[i]'(0) = cos(3 i) for i = 1..N\n"

/* The family with ghost cells, and without. */
static const struct {
    const char *name, *with, *without;
} pairs[] = {
    {"free ends", "N = 9\nx[i]'' = x[i+1] - 2 x[i] + x[i-1] for i = 1..N\nx[0] = x[1]\nx[N+1] = x[N]\n" START("x"),
     "N = 9\nx[1]'' = x[2] - 2 x[1] + x[1]\nx[i]'' = x[i+1] - 2 x[i] + x[i-1] for i = 2..N-1\n"
     "x[N]'' = x[N] - 2 x[N] + x[N-1]\n" START("x")},
    {"a moving mirror, and friction between neighbours",
     "N = 6\nq = 0.2\nx[i]'' = -q (2 x[i]' - x[i-1]' - x[i+1]') + (x[i+1] - x[i])^3 - (x[i] - x[i-1])^3 for i = 1..N\n"
     "x[0] = 2 sin(t) - x[1]\nx[N+1] = q x[N]^2\n" START("x"),
     "N = 6\nq = 0.2\nx[1]'' = -q (2 x[1]' - (2 cos(t) - x[1]') - x[2]') + (x[2] - x[1])^3 - "
     "(x[1] - (2 sin(t) - x[1]))^3\n"
     "x[i]'' = -q (2 x[i]' - x[i-1]' - x[i+1]') + (x[i+1] - x[i])^3 - (x[i] - x[i-1])^3 for i = 2..N-1\n"
     "x[N]'' = -q (2 x[N]' - x[N-1]' - q (2 x[N]' x[N])) + (q x[N]^2 - x[N])^3 - (x[N] - x[N-1])^3\n" START("x")},
    {"two cells beyond the end",
     "N = 7\nu[i]'' = -(u[i+2] - 4 u[i+1] + 6 u[i] - 4 u[i-1] + u[i-2]) for i = 1..N\nu[0] = 0\nu[-1] = -u[1]\n"
     "u[N+1] = u[N]\nu[N+2] = 2 u[N+1] - u[N-1]\n" START("u"),
     "N = 7\nu[0] = 0\nu[1]'' = -(u[3] - 4 u[2] + 6 u[1] - 4 u[0] + (-u[1]))\n"
     "u[i]'' = -(u[i+2] - 4 u[i+1] + 6 u[i] - 4 u[i-1] + u[i-2]) for i = 2..N-2\n"
     "u[N-1]'' = -(u[N] - 4 u[N] + 6 u[N-1] - 4 u[N-2] + u[N-3])\n"
     "u[N]'' = -(2 u[N] - u[N-1] - 4 u[N] + 6 u[N] - 4 u[N-1] + u[N-2])\n" START("u")},
    {"heat between insulated ends",
     "N = 8\nT[i]' = T[i+1] - 2 T[i] + T[i-1] for i = 1..N\nT[0] = T[1]\nT[N+1] = T[N]\nT[i](0) = sin(i) for i = "
     "1..N\n",
     "N = 8\nT[1]' = T[2] - 2 T[1] + T[1]\nT[i]' = T[i+1] - 2 T[i] + T[i-1] for i = 2..N-1\n"
     "T[N]' = T[N] - 2 T[N] + T[N-1]\nT[i](0) = sin(i) for i = 1..N\n"},
    {"a membrane with edges of three kinds",
     "N = 4\nM = 3\nu[i,j]'' = u[i+1,j] + u[i-1,j] + u[i,j+1] + u[i,j-1] - 4 u[i,j] for i = 1..N, j = 1..M\n"
     "u[0,j] = u[1,j] for j = 1..M\nu[N+1,j] = 0 for j = 1..M\nu[i,0] = -u[i,1] for i = 1..N\n"
     "u[i,M+1] = u[i,M] for i = 1..N\nu[i,j](0) = sin(i + 2 j) for i = 1..N, j = 1..M\n"
     "u[i,j]'(0) = 0 for i = 1..N, j = 1..M\n",
     "N = 4\nM = 3\nu[N+1,j] = 0 for j = 1..M\n"
     "u[1,1]'' = u[2,1] + u[1,1] + u[1,2] + (-u[1,1]) - 4 u[1,1]\n"
     "u[1,2]'' = u[2,2] + u[1,2] + u[1,3] + u[1,1] - 4 u[1,2]\n"
     "u[1,3]'' = u[2,3] + u[1,3] + u[1,3] + u[1,2] - 4 u[1,3]\n"
     "u[i,1]'' = u[i+1,1] + u[i-1,1] + u[i,2] + (-u[i,1]) - 4 u[i,1] for i = 2..N\n"
     "u[i,2]'' = u[i+1,2] + u[i-1,2] + u[i,3] + u[i,1] - 4 u[i,2] for i = 2..N\n"
     "u[i,3]'' = u[i+1,3] + u[i-1,3] + u[i,3] + u[i,2] - 4 u[i,3] for i = 2..N\n"
     "u[i,j](0) = sin(i + 2 j) for i = 1..N, j = 1..M\nu[i,j]'(0) = 0 for i = 1..N, j = 1..M\n"},
    {"a force from an energy",
     "N = 8\nV(d) = d^2/2 + d^4/4\nE = sum(i = 0..N: V(x[i+1] - x[i]))\nx[i]'' = -diff(E, x[i]) for i = 1..N\n"
     "x[0] = x[1]\nx[N+1] = x[N]\n" START("x"),
     NULL},
};
enum { PAIRS = sizeof pairs / sizeof *pairs, NUMBERS = 64 };

static const char *const methods[] = {"verlet",    "velocity-verlet", "rk4",    "beeman",
                                      "kahan-li6", "newmark",         "gauss4", "implicit-midpoint"};
enum { METHODS = sizeof methods / sizeof *methods };

/* The state after 40 steps, or false: the method does not admit the model. */
static bool travel(motus_system *s, const char *method, const char *machine, double *y)
{
    motus_error err = motus_default_error();
    if (motus_method_admits(s, method, &err) != MOTUS_OK) return false;
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    def.method = method, def.machine = machine, def.step = 0.05, def.until = 2.01;
    must(motus_run_create(s, &def, &r, &err), &err, method);
    finish(r);
    must(motus_run_state(r, y, y + motus_positions(s), &err), &err, method);
    assert_string_equal(motus_run_now(r).machine, machine);
    motus_run_destroy(r);
    return true;
}

static void same_as_without(void **state)
{
    (void)state;
    for (size_t k = 0; k < PAIRS; k++) {
        motus_system *s = given_text(pairs[k].with);
        motus_system *t = pairs[k].without ? given_text(pairs[k].without) : NULL;
        int ran = 0;
        for (size_t i = 0; i < METHODS; i++) {
            double y[NUMBERS] = {0}, z[NUMBERS] = {0};
            if (!travel(s, methods[i], "interpreter", y)) continue;
            ran++;
            if (t) {
                assert_int_equal(motus_velocities(s), motus_velocities(t));
                assert_true(travel(t, methods[i], "interpreter", z));
                if (memcmp(y, z, sizeof y) != 0) fail_msg("%s by %s: other bits", pairs[k].name, methods[i]);
            }
            assert_true(travel(s, methods[i], "compiled", z));
            if (memcmp(y, z, sizeof y) != 0) fail_msg("%s by %s: compiled other bits", pairs[k].name, methods[i]);
        }
        assert_true(ran >= 4);
        motus_system_destroy(s);
        motus_system_destroy(t);
    }
}

/* Exact derivatives have the ghost cells' part: they agree with difference quotients of runs. */
static void derivatives(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    for (size_t k = 0; k < PAIRS; k++) {
        if (!pairs[k].without) continue;
        double here[2][NUMBERS * NUMBERS] = {{0}}, there[2][NUMBERS * NUMBERS] = {{0}};
        motus_system *s[2] = {given_text(pairs[k].with), given_text(pairs[k].without)};
        for (int i = 0; i < 2; i++) {
            motus_run *r = given_run(s[i], "rk4", 0.1, 1);
            must(motus_run_jacobian(r, i ? there[0] : here[0], i ? there[1] : here[1], &err), &err, pairs[k].name);
            motus_run_destroy(r);
            motus_system_destroy(s[i]);
        }
        for (size_t i = 0; i < NUMBERS * NUMBERS; i++)
            for (int j = 0; j < 2; j++) assert_true(fabs(here[j][i] - there[j][i]) <= 1e-14 * (1 + fabs(there[j][i])));
    }
}

static void in_lanes(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    const double q[] = {0.1, 0.2, 0.3, 0.4, 0.5};
    enum { COUNT = sizeof q / sizeof *q, CELL = 4 };
    for (int lanes = 1; lanes <= 4; lanes += 3) {
        motus_system *s = given_text(pairs[1].with);
        const char *vary[] = {"q"};
        const double *values[] = {q};
        double ends[COUNT], *results[] = {ends}, y[NUMBERS];
        motus_record record = {.how = MOTUS_REDUCE_FINAL, .column = 1 + CELL};
        motus_ensemble_def def = motus_default_ensemble();
        def.vary = vary, def.vary_count = 1, def.records = &record, def.record_count = 1;
        def.method = "kahan-li6", def.step = 0.05, def.until = 2.01, def.lanes = lanes, def.machine = "compiled";
        motus_ensemble *e = NULL;
        must(motus_ensemble_create(s, &def, &e, &err), &err, "ensemble");
        must(motus_ensemble_run(e, COUNT, values, results, NULL, &err), &err, "ensemble");
        motus_ensemble_destroy(e);
        for (int k = 0; k < COUNT; k++) {
            must(motus_system_set(s, "q", &q[k], 1, &err), &err, "q");
            assert_true(travel(s, "kahan-li6", "interpreter", y));
            assert_true(y[CELL] == ends[k]);
        }
        motus_system_destroy(s);
    }
}

static double value_of(motus_run *r, motus_system *s, const char *name)
{
    motus_error err = motus_default_error();
    size_t first, count;
    double value;
    must(motus_column_find(s, name, &first, &count, &err), &err, name);
    must(motus_run_values(r, &first, 1, &value, &err), &err, name);
    return value;
}

/* Nothing pushes a chain with free ends as a whole. Rounding: of 2000 kicks of 9 cells. */
static void momentum(void **state)
{
    (void)state;
    motus_system *s = given_text("N = 9\nx[i]'' = (x[i+1] - x[i])^3 - (x[i] - x[i-1])^3 for i = 1..N\nx[0] = x[1]\n"
                                 "x[N+1] = x[N]\nquantity = sum(i = 1..N: x[i]')\n"
                                 "stretch[i] = x[i+1] - x[i] for i = 0..N\n" START("x"));
    motus_run *r = given_run(s, "verlet", 0.01, 20);
    const double before = value_of(r, s, "quantity");
    assert_true(value_of(r, s, "stretch[0]") == 0 && value_of(r, s, "stretch[9]") == 0);
    assert_true(value_of(r, s, "stretch[3]") == sin(4) - sin(3) ||
                fabs(value_of(r, s, "stretch[3]") - sin(4) + sin(3)) < 1e-15);
    finish(r);
    assert_true(fabs(value_of(r, s, "quantity") - before) < 2000 * 9 * 4 * ROUNDING);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* A hinged beam has the shapes sin(k π i/N), which are exact solutions: u'' = -δ⁴u with ω = 4 sin²(k π/2N). The reader
 * checks the exact line against the equation. */
static void hinged_beam(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    motus_system *s =
        given_text("N = 12\nk = 3\nw = 4 sin(k pi/(2 N))^2\nu[i]'' = -(u[i+2] - 4 u[i+1] + 6 u[i] - 4 u[i-1] + u[i-2]) "
                   "for i = 1..N-1\n"
                   "u[0] = 0\nu[N] = 0\nu[-1] = -u[1]\nu[N+1] = -u[N-1]\nu[i](0) = sin(k pi i/N) for i = 1..N-1\n"
                   "u[i]'(0) = 0 for i = 1..N-1\nexact u[i] = sin(k pi i/N) cos(w t) for i = 1..N-1\n"
                   "invariant energy = sum(i = 1..N-1: u[i]'^2/2) + sum(i = 0..N: (u[i+1] - 2 u[i] + u[i-1])^2/2)\n");
    motus_study_def def = motus_default_study();
    const char *names[] = {"kahan-li8", "gauss6"};
    def.methods = names, def.method_count = 2, def.step = 0.05, def.until = 30;
    motus_comparison *c = NULL;
    must(motus_compare(s, &def, &c, &err), &err, "beam");
    for (int k = 0; k < 2; k++) {
        assert_true(c->rows[k]->error_max_x < 1e-7);
        assert_true(c->rows[k]->invariants[0]->max_drift < 1e-7);
    }
    motus_comparison_destroy(c);
    motus_system_destroy(s);
}

/* Newton's method needs the derivatives of the ghost cells: without them it would not converge, or lose the order. */
static void certified(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    motus_system *s = given_text(pairs[5].with);
    motus_study_def def = motus_default_study();
    const char *names[] = {"gauss4", "implicit-midpoint", "kahan-li6", "rk4"};
    def.methods = names, def.method_count = 4, def.until = 3;
    motus_convergence *c = NULL;
    must(motus_converge(s, &def, &c, &err), &err, "chain");
    for (size_t k = 0; k < c->row_count; k++)
        if (!c->rows[k]->passed) fail_msg("%s: %s", names[k], c->rows[k]->certificate);
    motus_convergence_destroy(c);
    motus_analysis a = motus_default_analysis();
    must(motus_analysis_of(s, &a), &err, "analysis");
    assert_true(a.gradient);
    /* As short as by hand: the middle in two terms, not in a sum over all. */
    assert_string_equal(motus_equation_text(s, 2), "x[8]'' = -(x[8] - x[7] + (x[8] - x[7])^3)");
    assert_null(motus_equation_text(s, 3));
    motus_system_destroy(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(same_as_without), cmocka_unit_test(derivatives), cmocka_unit_test(in_lanes),
        cmocka_unit_test(momentum),        cmocka_unit_test(hinged_beam), cmocka_unit_test(certified),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
