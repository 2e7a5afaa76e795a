/* Large systems: tiles, threads and sums in lanes give the bits of the interpreter, for any division into calls; a
 * motion that diverges is reported with the same step, time and variable.
 *
 * Sizes lie below and above where tiling begins, and are no multiples of a tile; numbers of steps are no multiples of
 * a sweep's.
 */
#include "motus.h"
#include "test/given_cache.h"
#include "test/share.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* A chain with fixed ends. */
static const char chain[] =
    "N = 10\nA = 3\nx[i]'' = x[i+1] - 2 x[i] + x[i-1] + 0.7 ((x[i+1] - x[i])^3 - (x[i] - x[i-1])^3) for i = 1..N\n"
    "x[0] = 0.25\nx[N+1] = -0.125\nx[i](0) = A sin(37 i) for i = 1..N\nx[i]'(0) = 0 for i = 1..N\nstep 0.1\nuntil 1\n";
/* Vectors, ends with their own equations, a second family with a wider stencil and other indices. */
static const char ends[] =
    "N = 10\nr[i]'' = 0.9 (r[i+1] - 2 r[i] + r[i-1]) - 0.2 r[i] |r[i]|^2 + w[i]*(0, 1) for i = 2..N-1\n"
    "r[1]'' = 0.9 (r[2] - r[1])\nr[N]'' = 0.9 (r[N-1] - r[N])\nw[i]'' = -w[i] + r[i+1].x - r[i-2].y for i = 3..N-1\n"
    "w[0] = 0.1\nw[1] = 0.1\nw[2] = 0.2\nw[N] = 0\nr[i](0) = (sin(i), cos(2 i)) for i = 1..N\nr[i]'(0) = (0.1, 0) for "
    "i = 1..N\n"
    "w[i](0) = cos(i)/3 for i = 3..N-1\nw[i]'(0) = 0 for i = 3..N-1\nstep 0.1\nuntil 1\n";
/* A lattice: rows are the tiles; a force that depends on time. */
static const char lattice[] =
    "N = 10\nM = 30\nu[i,j]'' = u[i+1,j] + u[i-1,j] + u[i,j+1] + u[i,j-1] - 4 u[i,j] - 0.3 u[i,j]^3 + 0.1 cos(t) for i "
    "= 1..N, j = 1..M\n"
    "u[0,j] = 0 for j = 1..M\nu[N+1,j] = 0 for j = 1..M\nu[i,0] = 0 for i = 1..N\nu[i,M+1] = 0 for i = 1..N\n"
    "u[i,j](0) = sin(i) cos(2 j) for i = 1..N, j = 1..M\nu[i,j]'(0) = 0 for i = 1..N, j = 1..M\nstep 0.1\nuntil 1\n";
/* First-order variables, and a force that depends on the velocity. */
static const char damped[] =
    "N = 10\nx[i]'' = x[i+1] - 2 x[i] + x[i-1] - 0.05 x[i]' + 0.1 s[i] for i = 1..N\nx[0] = 0\nx[N+1] = 0\n"
    "s[i]' = -s[i] + x[i] + 0.1 (s[i+1] - s[i]) for i = 1..N\ns[N+1] = 0.5\nx[i](0) = sin(i) for i = 1..N\nx[i]'(0) = "
    "0 for i = 1..N\n"
    "s[i](0) = cos(i) for i = 1..N\nstep 0.1\nuntil 1\n";
/* Models that cannot be tiled: a driven end, and a ring. */
static const char driven[] = "N = 10\nx[i]'' = x[i+1] - 2 x[i] + x[i-1] for i = 1..N\nx[0] = sin(t)\nx[N+1] = "
                             "0\nx[i](0) = cos(i) for i = 1..N\nx[i]'(0) = 0 for i = 1..N\n"
                             "p[i]'' = p[mod(i, N)+1] - 2 p[i] + p[mod(i-2, N)+1] for i = 1..N\np[i](0) = sin(i) for i "
                             "= 1..N\np[i]'(0) = 0 for i = 1..N\nstep 0.1\nuntil 1\n";
/* All pairs without i = j; sums with conditions on time and index. */
static const char pairs[] = "N = 10\nr[i]'' = sum(j = 1..N, j != i: (r[j] - r[i])/(N |r[j] - r[i]|^3)) + sum(j = 3..N, "
                            "r[j].x > r[i].y: 0.01 r[j]) for i = 1..N\n"
                            "r[i](0) = (cos(i), sin(2 i), sin(3 i + 0.4)) for i = 1..N\nr[i]'(0) = (0, 0, 0) for i = "
                            "1..N\nstep 0.01\nuntil 1\n";

/* Numbers that are not contiguous: the transposed lattice, and sums along columns; a function of every cell. */
static const char across[] = "N = 10\nu[i,j]'' = 0.3 (u[j,i] - u[i,j]) - 0.1 sin(u[i,j]) + sum(k = 1..N, k != j: 0.01 "
                             "u[k,j] u[i,k]) + 0.1 u[mod(i, N)+1, mod(j+2, N)+1] "
                             "for i = 1..N, j = 1..N\nu[i,j](0) = sin(i) cos(2 j) for i = 1..N, j = 1..N\nu[i,j]'(0) = "
                             "0 for i = 1..N, j = 1..N\n"
                             "w[i]'' = u[i,i] - 2 w[i] + w[mod(i+1, N)+1] exp(-w[i]^2) - u[3,i] for i = 1..N\nw[i](0) "
                             "= sin(3 i) for i = 1..N\nw[i]'(0) = 0.1 i for i = 1..N\n"
                             "step 0.1\nuntil 1\n";

static motus_system *open_text(const char *text, int n)
{
    char set[2][24];
    snprintf(set[0], sizeof set[0], "N=%d", n);
    const char *list[] = {set[0]};
    motus_text_def def = motus_default_text();
    motus_error err = motus_default_error();
    motus_system *s = NULL;
    def.text = text;
    def.set = list;
    def.set_count = 1;
    if (motus_system_from_text(&def, &s, &err)) fail_msg("%s", err.message);
    return s;
}

typedef struct end {
    double *state;
    int64_t evaluations, steps;
    motus_status status;
    motus_error error;
} end;

/* steps in one call, or (cut) in calls of 1, 2, 3, … steps with observations in between */
static end go(motus_system *s, const char *machine, int threads, const char *method, int steps, bool cut)
{
    motus_settings set = motus_default_settings();
    motus_settings_of(s, &set);
    motus_run_def def = motus_default_run();
    def.machine = machine;
    def.method = method;
    def.threads = threads;
    def.step = set.step;
    def.until = set.from + steps * set.step;
    motus_run *r = NULL;
    const size_t nx = motus_positions(s), nv = motus_velocities(s);
    end e = {.state = calloc(nx + nv, sizeof(double)), .error = motus_default_error()};
    assert_non_null(e.state);
    if (motus_run_create(s, &def, &r, &e.error)) fail_msg("%s by %s: %s", machine, method, e.error.message);
    for (int n = 1; cut && !e.status && !motus_run_done(r); n++) {
        e.status = motus_run_step(r, n, &e.error);
        if (!e.status && n % 3 == 0) e.status = motus_run_state(r, e.state, e.state + nx, &e.error);
    }
    if (!e.status) e.status = motus_run_finish(r, &e.error);
    motus_status looked = motus_run_state(r, e.state, e.state + nx, NULL);
    assert_true(looked == MOTUS_OK || e.status != MOTUS_OK);
    e.evaluations = motus_run_now(r).evaluations;
    e.steps = motus_run_steps(r);
    motus_run_destroy(r);
    return e;
}

static void same(const char *text, int n, const char *method, int steps)
{
    motus_system *s = open_text(text, n);
    const size_t bytes = (motus_positions(s) + motus_velocities(s)) * sizeof(double);
    end a = go(s, "interpreter", 1, method, steps, false);
    for (int way = 0; way < 4; way++) {
        const int threads = 1 + 2 * (way / 2);
        end b = go(s, "compiled", threads, method, steps, way % 2);
        if (a.status != b.status || memcmp(a.state, b.state, bytes))
            fail_msg("N = %d by %s, %d steps, %d threads, %s: the bits differ\n%.200s", n, method, steps, threads,
                     way % 2 ? "cut" : "in one go", text);
        assert_int_equal(a.evaluations, b.evaluations);
        assert_int_equal(a.steps, b.steps);
        assert_string_equal(a.error.message, b.error.message);
        assert_string_equal(a.error.variable, b.error.variable);
        assert_true(a.error.time == b.error.time || (isnan(a.error.time) && isnan(b.error.time)));
        free(b.state);
    }
    free(a.state);
    motus_system_destroy(s);
}

static void rows(const char *text, const char *const methods[], const int sizes[], int steps)
{
    int turn = 0;
    for (; *methods; methods++)
        for (const int *n = sizes; *n; n++)
            if (share_takes(&turn)) same(text, *n, *methods, steps);
}
#define LIST(type, ...) ((type const[]){__VA_ARGS__, 0})
typedef const char *text_of;

static void chains(void **state)
{
    (void)state;
    rows(chain,
         LIST(text_of, "velocity-verlet", "verlet", "kahan-li6", "rk4", "beeman", "position-verlet", "verlet-literal"),
         LIST(int, 10, 1000, 20011), 101);
    same(chain, 100000, "velocity-verlet", 67);
}

static void families(void **state)
{
    (void)state;
    rows(ends, LIST(text_of, "velocity-verlet", "verlet", "kahan-li6"), LIST(int, 10, 7919), 70);
}

static void lattices(void **state)
{
    (void)state;
    rows(lattice, LIST(text_of, "velocity-verlet", "verlet", "blanes-moan6", "rk4"), LIST(int, 10, 1201), 70);
}

static void first_order_variables(void **state)
{
    (void)state;
    rows(damped, LIST(text_of, "rk4", "heun"), LIST(int, 10, 7919), 41);
}

static void untiled(void **state)
{
    (void)state;
    rows(driven, LIST(text_of, "velocity-verlet", "kahan-li6"), LIST(int, 10, 7919), 41);
    same(chain, 3001, "implicit-midpoint", 5);
}

static void scattered(void **state)
{
    (void)state;
    rows(across, LIST(text_of, "velocity-verlet", "rk4", "kahan-li6"), LIST(int, 10, 17, 51), 9);
}

static void every_pair(void **state)
{
    (void)state;
    rows(pairs, LIST(text_of, "velocity-verlet", "rk4"), LIST(int, 10, 17, 200), 9);
}

/* With too large a step, the middle of a long chain diverges first. */
static void divergence(void **state)
{
    (void)state;
    static const char text[] = "N = 10\nx[i]'' = x[i+1] - 2 x[i] + x[i-1] - (1 + 40 exp(-((i - N/3)/20)^2)) x[i]^3 for "
                               "i = 1..N\nx[0] = 0\nx[N+1] = 0\n"
                               "x[i](0) = sin(37 i) for i = 1..N\nx[i]'(0) = 0 for i = 1..N\nstep 0.6\nuntil 60\n";
    motus_system *s = open_text(text, 20011);
    end a = go(s, "interpreter", 1, "velocity-verlet", 100, false);
    assert_int_equal(a.status, MOTUS_DIVERGED);
    free(a.state);
    motus_system_destroy(s);
    rows(text, LIST(text_of, "velocity-verlet", "verlet", "rk4"), LIST(int, 20011), 100);
}

static void threads_asked_for(void **state)
{
    (void)state;
    motus_system *s = open_text(chain, 10);
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    motus_error err = motus_default_error();
    def.threads = -1;
    assert_int_equal(motus_run_create(s, &def, &r, &err), MOTUS_ARGUMENT);
    def.threads = MOTUS_THREADS_MAX + 1;
    assert_int_equal(motus_run_create(s, &def, &r, &err), MOTUS_ARGUMENT);
    assert_non_null(strstr(err.message, "threads"));
    motus_system_destroy(s);
}

int main(void)
{
    open_shared_cache();
    const struct CMUnitTest tests[] = {cmocka_unit_test(chains),           cmocka_unit_test(families),
                                       cmocka_unit_test(lattices),         cmocka_unit_test(first_order_variables),
                                       cmocka_unit_test(untiled),          cmocka_unit_test(every_pair),
                                       cmocka_unit_test(scattered),        cmocka_unit_test(divergence),
                                       cmocka_unit_test(threads_asked_for)};
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    close_cache();
    return failed;
}
