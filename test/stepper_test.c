/* The stepper as its callers see it: restarts and looks that change no bit, instruction sets that agree, errors that name their place,
 * memory that is given back, linear systems of every shape, driven boundaries.
 */
#include "core/stepper.h"
#include "core/stepper_body.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#undef fail                    /* cmocka has a macro of that name; here it is the house's */
#define explain(...) (print_error(__VA_ARGS__), print_error("\n"), _fail(__FILE__, __LINE__))
#define assert_near(a, b, margin) (fabs((a) - (b)) <= (margin) ? (void)0 : explain(#a " is %.17g, not %.17g within %g", (a), (b), (margin)))

/* Problems ---------------------------------------------------------------------------------------------------------- */

static int oscillator(void *ctx, double t, double *x, double *v, double *a)
{
    (void)ctx, (void)v;
    a[0] = -x[0] + x[0] * x[0] * x[0] + 0.1 * cos(t);
    return 0;
}

static int cubic(void *ctx, double t, double *x, double *v, double *a)
{
    (void)ctx, (void)t;
    a[0] = -v[0] - x[0] * x[0] * x[0];
    return 0;
}
static int cubic_jvp(void *ctx, double t, double *x, double *v, const double *dx, const double *dv, double *da)
{
    (void)ctx, (void)t, (void)v;
    da[0] = 0;
    if (dx) da[0] -= 3 * x[0] * x[0] * dx[0];
    if (dv) da[0] -= dv[0];
    return 0;
}

/* Two coupled positions and a companion; with `tangle`, all of it nonlinear in the velocities. */
typedef struct mix { bool tangle; } mix;
static int mixed(void *ctx, double t, double *x, double *v, double *a)
{
    const mix *m = ctx;
    a[0] = -x[0] - 2 * x[0] * x[1] + 0.1 * t;
    a[1] = -x[1] - x[0] * x[0] + x[1] * x[1];
    a[2] = x[0] * x[1] - 0.5;
    if (!m->tangle) return 0;
    a[0] -= 0.3 * v[0] * (1 + v[1] * v[1]) - 0.2 * v[2] * v[0];
    a[1] -= 0.1 * v[1] * v[1] * v[1] - v[2];
    a[2] -= 0.5 * v[2] - v[0] * v[1];
    return 0;
}

static int turning(void *ctx, double t, double *x, double *v, double *a)
{
    (void)ctx, (void)t;
    const double b[3] = {x[1], 0.3, 1 + x[0] * x[1]};
    a[0] = v[1] * b[2] - v[2] * b[1] - x[0];
    a[1] = v[2] * b[0] - v[0] * b[2];
    a[2] = v[0] * b[1] - v[1] * b[0];
    return 0;
}

static mix still = {false}, tangled = {true};
static const problem problems[] = {
    {.ctx = &still, .nx = 2, .nv = 3, .accel = mixed, .traits = {.time = true, .companions = true}},
    {.ctx = &tangled, .nx = 2, .nv = 3, .accel = mixed, .traits = {.velocity = true, .time = true, .companions = true}},
    {.nx = 3, .nv = 3, .accel = turning, .traits = {.velocity = true, .linear_v = true, .gyroscopic = true}},
};
enum { PROBLEMS = sizeof problems / sizeof *problems };
static const double start_x[3] = {0.2, -0.3, 0.1}, start_v[3] = {0.4, 0.1, -0.2};

static stepper *begin(const problem *p, const char *method, double t0, double h, const double *x, const double *v)
{
    chosen c;
    stepper *s = NULL;
    motus_error err = {0};
    assert_int_equal(row_choose(method, &c, NULL, &err), MOTUS_OK);
    if (stepper_create(p, &c, t0, h, x, v, NULL, &s, &err)) explain("%s: %s", method, err.message);
    return s;
}

static bool admitted(const problem *p, size_t k)
{
    chosen c;
    return !row_choose(row_card(k)->name, &c, NULL, NULL) && !row_admits(&c, &p->traits, NULL);
}

/* Bits -------------------------------------------------------------------------------------------------------------- */

typedef struct outcome { double x[3], v[3], time; int64_t evaluations, iterations; } outcome;

static outcome finish(stepper *s)
{
    outcome o = {0};
    assert_int_equal(stepper_sync(s, o.x, o.v, NULL, NULL), MOTUS_OK);
    o.time = stepper_time(s);
    o.evaluations = stepper_evaluations(s);
    o.iterations = stepper_iterations(s);
    stepper_destroy(s);
    return o;
}

static void looking_and_restarting_change_no_bit(void **state)
{
    (void)state;
    int rows = 0;
    for (int q = 0; q < PROBLEMS; q++)
        for (size_t k = 0; k < row_count(); k++) {
            const problem *p = &problems[q];
            const char *name = row_card(k)->name;
            if (!admitted(p, k)) continue;
            rows++;
            stepper *plain = begin(p, name, 0.5, 0.05, start_x, start_v);
            assert_int_equal(stepper_advance(plain, 45, NULL), MOTUS_OK);

            stepper *watched = begin(p, name, 0.5, 0.05, start_x, start_v);
            double x[3], v[3], a[3], carry[32];
            for (int i = 0; i < 45; i++) {
                assert_int_equal(stepper_sync(watched, x, v, i % 2 ? a : NULL, NULL), MOTUS_OK);
                if (i == 0 || i == 21) {          /* on to another stepper, made alike */
                    assert_in_range(stepper_carry(watched), 0, 32);
                    stepper_save(watched, carry);
                    stepper *next = begin(p, name, 0.5, 0.05, start_x, start_v);
                    assert_int_equal(stepper_load(next, stepper_steps(watched), stepper_evaluations(watched), stepper_iterations(watched),
                                                  carry, NULL), MOTUS_OK);
                    stepper_destroy(watched);
                    watched = next;
                }
                assert_int_equal(stepper_advance(watched, 1, NULL), MOTUS_OK);
            }
            const outcome one = finish(plain), other = finish(watched);
            if (memcmp(&one, &other, sizeof one)) explain("%s on problem %d: looking or restarting changed the result", name, q);
        }
    assert_true(rows > 50);
}

static void instruction_sets_agree(void **state)
{
    (void)state;
    const stepper_body *bodies[3] = {&stepper_body_base};
    int count = 1;
#if defined __x86_64__
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) bodies[count++] = &stepper_body_avx2;
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq"))
        bodies[count++] = &stepper_body_avx512;
#endif
    for (int q = 0; q < PROBLEMS; q++)
        for (size_t k = 0; k < row_count(); k++) {
            if (!admitted(&problems[q], k)) continue;
            outcome o[3];
            for (int b = 0; b < count; b++) {
                stepper *s = begin(&problems[q], row_card(k)->name, 0, 0.05, start_x, start_v);
                stepper_use_body(s, bodies[b]);
                assert_int_equal(stepper_advance(s, 100, NULL), MOTUS_OK);
                o[b] = finish(s);
                if (memcmp(&o[0], &o[b], sizeof *o)) explain("%s on problem %d: %s differs", row_card(k)->name, q, bodies[b]->name);
            }
        }
}

static double run(const problem *p, const char *method, double h, int64_t steps, double x0)
{
    const double zero = 0;
    stepper *s = begin(p, method, 0, h, &x0, &zero);
    double x, v;
    assert_int_equal(stepper_advance(s, steps, NULL), MOTUS_OK);
    assert_int_equal(stepper_sync(s, &x, &v, NULL, NULL), MOTUS_OK);
    assert_true(stepper_time(s) == (double)steps * h);
    assert_int_equal(stepper_evaluations(s), steps);
    assert_int_equal(stepper_iterations(s), 0);
    stepper_destroy(s);
    return x;
}

/* The notebook's two recurrences: summed Verlet within round-off of the exact recurrence, the literal one on the notebook's numbers. */
static void founding_recurrences(void **state)
{
    (void)state;
    const problem a = {.nx = 1, .nv = 1, .accel = oscillator, .traits = {.time = true}};
    assert_near(run(&a, "verlet", 0.001, 100000, 0), 0.04778239807187258, 1e-13);
    assert_near(run(&a, "verlet-literal", 0.001, 100000, 0), 0.04778239807006475, 1e-11);
    const problem b = {.nx = 1, .nv = 1, .accel = cubic, .jvp = cubic_jvp, .traits = {.velocity = true, .linear_v = true, .constant_jv = true}};
    assert_near(run(&b, "verlet", 0.001, 3000, 10), -3.489442177206087865, 1e-13);
    assert_near(run(&b, "verlet-literal", 0.001, 3000, 10), -3.4894421772061026, 1e-13);
}

/* Errors ------------------------------------------------------------------------------------------------------------ */

/* x'' = 2 (x - centre)^3 grows without bound in finite time where it starts outward; the rest of a long family only rests. */
typedef struct burst { size_t n, hot; int64_t calls, fail_at; } burst;
static int bursting(void *ctx, double t, double *x, double *v, double *a)
{
    burst *b = ctx;
    (void)t, (void)v;
    if (++b->calls == b->fail_at) return 1;
    memset(a, 0, b->n * sizeof *a);
    a[b->hot] = 2 * x[b->hot] * x[b->hot] * x[b->hot];
    return 0;
}
static void cell_name(void *ctx, bool in_v, size_t k, char *out, size_t size)
{
    (void)ctx;
    snprintf(out, size, "y[%zu]%s", k + 1, in_v ? "'" : "");
}

static void divergence(const char *method, size_t n, int64_t chunk)
{
    burst b = {.n = n, .hot = n / 2};
    const problem p = {.ctx = &b, .nx = n, .nv = n, .accel = bursting, .name = cell_name, .traits = {.gradient = true}};
    double *x = calloc(2 * n, sizeof *x), *v = x + n;
    x[b.hot] = v[b.hot] = 1;
    stepper *s = begin(&p, method, 0, 0.01, x, v);
    motus_error err = {0};
    motus_status status = MOTUS_OK;
    while (!status && stepper_steps(s) < 1000) status = stepper_advance(s, chunk, &err);
    assert_int_equal(status, MOTUS_DIVERGED);
    assert_true(err.time > 0.9 && err.time < 1.2);
    char expected[64];
    snprintf(expected, sizeof expected, "y[%zu]", b.hot + 1);
    assert_int_equal(strncmp(err.variable, expected, strlen(expected)), 0);
    assert_non_null(strstr(err.message, expected));
    /* It stands at the last finite step: the next one is the one that was reported, and reaching it anew fails alike. */
    const int64_t at = stepper_steps(s);
    assert_true(fabs(stepper_time(s) + 0.01 - err.time) < 1e-9);
    memset(x, 0, 2 * n * sizeof *x);
    x[b.hot] = v[b.hot] = 1;
    stepper *again = begin(&p, method, 0, 0.01, x, v);
    assert_int_equal(stepper_advance(again, at, NULL), MOTUS_OK);
    double *carry = calloc(2 * stepper_carry(s), sizeof *carry);
    stepper_save(s, carry);
    stepper_save(again, carry + stepper_carry(s));
    assert_memory_equal(carry, carry + stepper_carry(s), stepper_carry(s) * sizeof *carry);
    assert_int_equal(stepper_evaluations(s), stepper_evaluations(again));
    assert_int_equal(stepper_advance(again, 1, &err), MOTUS_DIVERGED);
    assert_int_equal(stepper_steps(again), at);
    stepper_destroy(again);
    stepper_destroy(s);
    free(carry);
    free(x);
}

static void divergence_names_time_and_variable(void **state)
{
    (void)state;
    static const char *const methods[] = {"verlet", "velocity-verlet", "leapfrog", "rk4", "kahan-li6", "beeman"};
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        divergence(methods[i], 3, 1);
        divergence(methods[i], 3, 1000);
        divergence(methods[i], 5000, 1000);       /* beyond the size that is looked at after every step */
        divergence(methods[i], 5000, 7);
    }
}

static void failing_callback(void **state)
{
    (void)state;
    for (size_t k = 0; k < row_count(); k++) {
        burst b = {.n = 1};
        const problem p = {.ctx = &b, .nx = 1, .nv = 1, .accel = bursting, .traits = {.gradient = true}};
        if (!admitted(&p, k)) continue;
        const double x = 0.1, v = 0;
        stepper *s = begin(&p, row_card(k)->name, 2, 0.01, &x, &v);
        b.fail_at = 200;
        motus_error err = {0};
        assert_int_equal(stepper_advance(s, 1000, &err), MOTUS_CALLBACK);
        assert_true(isfinite(err.time) && err.time >= 2 && err.time <= 4);
        double out, speed;
        b.fail_at = 0;
        assert_int_equal(stepper_sync(s, &out, &speed, NULL, NULL), MOTUS_OK);
        assert_true(isfinite(out));
        b.fail_at = b.calls + 1;
        int64_t before = stepper_steps(s);
        assert_int_equal(stepper_advance(s, 1, &err), stepper_steps(s) == before ? MOTUS_CALLBACK : MOTUS_OK);
        stepper_destroy(s);
    }
}

/* delta = h² (1e6 + ((d + delta/2)/h)² 1e3): no real solution once the step is large. */
static int insoluble(void *ctx, double t, double *x, double *v, double *a)
{
    (void)ctx, (void)t, (void)x;
    a[0] = 1e6 + 1e3 * v[0] * v[0];
    return 0;
}

static void failed_solve_names_time_and_variable(void **state)
{
    (void)state;
    static const char *const methods[] = {"verlet", "verlet-literal", "implicit-midpoint", "gauss4", "newmark"};
    const problem p = {.nx = 1, .nv = 1, .accel = insoluble, .name = cell_name, .traits = {.velocity = true}};
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        const double zero = 0;
        stepper *s = begin(&p, methods[i], 3, 0.25, &zero, &zero);
        motus_error err = {0};
        assert_int_equal(stepper_advance(s, 5, &err), MOTUS_SOLVE);
        assert_string_equal(err.variable, "y[1]'");
        assert_true(err.time >= 3 && err.time < 5);
        assert_true(strlen(err.hint) > 0);
        double x, v;
        if (stepper_steps(s) == 0) assert_int_equal(stepper_sync(s, &x, &v, NULL, NULL), MOTUS_OK);
        stepper_destroy(s);
    }
}

static void refused_requests(void **state)
{
    (void)state;
    motus_error err = {0};
    chosen c;
    const motus_method *card = NULL;
    assert_int_equal(row_choose("verlt", &c, NULL, &err), MOTUS_METHOD);
    assert_non_null(strstr(err.hint, "verlet"));
    assert_int_equal(row_choose("rk4(1)", &c, NULL, &err), MOTUS_METHOD);
    static const char *const wrong[] = {"newmark(", "newmark(1/4", "newmark(1/4,", "newmark(1/0, 1/2)", "newmark(1,2)", "newmark(a,b)",
                                        "newmark(1/4, 1/2) x", "newmark(-1, 1/2)", "", "(1)", "newmark(1e999, 1/2)"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) assert_int_equal(row_choose(wrong[i], &c, NULL, &err), MOTUS_METHOD);
    assert_int_equal(row_choose("Newmark( 1/6 , 1/2 )", &c, &card, &err), MOTUS_OK);
    assert_string_equal(c.name, "newmark(0.16666666666666666, 0.5)");
    assert_int_equal(card->order, 2);
    chosen again;
    assert_int_equal(row_choose(c.name, &again, NULL, NULL), MOTUS_OK);
    assert_true(again.argument[0] == c.argument[0] && again.argument[1] == c.argument[1]);
    assert_int_equal(row_choose("newmark(0.3025, 0.6)", &c, &card, &err), MOTUS_OK);
    assert_int_equal(card->order, 1);
    assert_int_equal(row_choose("newmark", &c, &card, &err), MOTUS_OK);
    assert_string_equal(c.name, "newmark(0.25, 0.5)");
    row_choose("verlet-literal", &c, NULL, NULL);
    assert_true(row_uniform(&c));
    row_choose("verlet", &c, NULL, NULL);
    assert_false(row_uniform(&c));

    const traits velocity = {.velocity = true}, plain = {0}, constant = {.constant = true};
    static const struct { const char *method, *hint; } pairs[] = {
        {"velocity-verlet", "verlet"}, {"pefrl", "gauss4"}, {"kahan-li6", "gauss6"}, {"kahan-li8", "gauss8"}, {"boris", "verlet"}};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        row_choose(pairs[i].method, &c, &card, NULL);
        char reason[256];
        assert_int_equal(row_admits(&c, &velocity, &err), MOTUS_METHOD);
        assert_int_equal(strncmp(err.hint, pairs[i].hint, strlen(pairs[i].hint)), 0);
        row_reason(card, &velocity, reason, sizeof reason);
        assert_non_null(strstr(err.message, reason));
    }
    row_choose("exact", &c, NULL, NULL);
    assert_int_equal(row_admits(&c, &plain, &err), MOTUS_METHOD);
    assert_int_equal(row_admits(&c, &constant, &err), MOTUS_OK);

    const problem p = {.nx = 1, .nv = 1, .accel = oscillator, .traits = {.time = true}};
    const double zero = 0, nan_value = NAN;
    stepper *s = NULL;
    row_choose("verlet", &c, NULL, NULL);
    assert_int_equal(stepper_create(&p, &c, 0, 0, &zero, &zero, NULL, &s, &err), MOTUS_ARGUMENT);
    assert_int_equal(stepper_create(&p, &c, 1e20, 1, &zero, &zero, NULL, &s, &err), MOTUS_ARGUMENT);
    assert_int_equal(stepper_create(&p, &c, 0, NAN, &zero, &zero, NULL, &s, &err), MOTUS_ARGUMENT);
    assert_int_equal(stepper_create(&p, &c, 0, 1, &nan_value, &zero, NULL, &s, &err), MOTUS_ARGUMENT);
    s = begin(&p, "verlet", 0, 0.1, &zero, &zero);
    const double carry[2] = {1, NAN};
    assert_int_equal(stepper_load(s, 1, 1, 0, carry, &err), MOTUS_STATE);
    assert_int_equal(stepper_load(s, -1, 1, 0, carry, &err), MOTUS_STATE);
    stepper_destroy(s);
}

static void names_are_unique(void **state)
{
    (void)state;
    for (size_t k = 0; k < row_count(); k++) {
        const motus_method *card = row_card(k), *found = NULL;
        chosen c;
        assert_true(card->name && card->aliases && card->family && card->cite && strlen(card->formula) > 0 && strlen(card->use) > 0);
        char words[256];
        snprintf(words, sizeof words, "%s %s", card->name, card->aliases);
        for (char *word = strtok(words, " "); word; word = strtok(NULL, " ")) {
            assert_int_equal(row_choose(word, &c, &found, NULL), MOTUS_OK);
            if (found != card) explain("%s leads to %s, not to %s", word, found->name, card->name);
        }
    }
}

/* Errors are printable whatever is put into them. */
static void errors_are_safe(void **state)
{
    (void)state;
    motus_error err = {0};
    char wild[2 * MOTUS_TEXT_MAX];
    for (size_t i = 0; i + 1 < sizeof wild; i++) wild[i] = (char)(1 + i * 37 % 255);
    wild[sizeof wild - 1] = 0;
    fail(&err, MOTUS_NAME, "%s", wild);
    for (const unsigned char *c = (unsigned char *)err.message; *c; c++) assert_true(*c >= 0x20 && *c != 0x7F);
    fail(&err, MOTUS_NAME, "a\033[31mb\nc\xc2\x9b" "d\xe2\x80\xae" "e\xffµ");
    assert_string_equal(err.message, "a?[31mb c?d?e?µ");
    for (size_t i = 0; i + 2 < sizeof wild; i += 2) memcpy(wild + i, "µ", 2);
    fail(&err, MOTUS_NAME, "x%s", wild);
    assert_true(strlen(err.message) < MOTUS_TEXT_MAX);
    assert_string_equal(err.message + strlen(err.message) - 3, "...");
    assert_null(strchr(err.message, '?'));
    assert_int_equal(fail(NULL, MOTUS_LIMIT, "x"), MOTUS_LIMIT);
    hint(NULL, "x");
}

/* Linear systems ---------------------------------------------------------------------------------------------------- */

/* x'' = -x - C v with C a shuffled ring: row k couples to next[k] and to the one it came from. */
typedef struct ring { size_t n, *next; bool told; int64_t jvps; } ring;
static int ring_force(void *ctx, double t, double *x, double *v, double *a)
{
    const ring *r = ctx;
    (void)t;
    for (size_t k = 0; k < r->n; k++) a[k] = -x[k] - 0.5 * v[k];
    for (size_t k = 0; k < r->n; k++) {
        a[k] += 0.3 * v[r->next[k]] + 0.1 * x[r->next[k]] * x[k];
        a[r->next[k]] -= 0.2 * v[k];
    }
    return 0;
}
static int ring_jvp(void *ctx, double t, double *x, double *v, const double *dx, const double *dv, double *da)
{
    ring *r = ctx;
    (void)t, (void)v;
    r->jvps++;
    for (size_t k = 0; k < r->n; k++) da[k] = (dx ? -dx[k] : 0) - (dv ? 0.5 * dv[k] : 0);
    for (size_t k = 0; k < r->n; k++) {
        if (dv) da[k] += 0.3 * dv[r->next[k]], da[r->next[k]] -= 0.2 * dv[k];
        if (dx) da[k] += 0.1 * (dx[r->next[k]] * x[k] + x[r->next[k]] * dx[k]);
    }
    return 0;
}
static void ring_pattern(void *ctx, bool in_v, void (*emit)(void *, size_t, size_t), void *arg)
{
    const ring *r = ctx;
    for (size_t k = 0; k < r->n; k++) {
        emit(arg, k, k);
        emit(arg, k, r->next[k]);
        if (in_v) emit(arg, r->next[k], k), emit(arg, k, k);
    }
}

static void structure_does_not_change_the_motion(void **state)
{
    (void)state;
    enum { N = 30 };
    size_t next[N];
    for (size_t k = 0; k < N; k++) next[k] = (k + 7) % N;
    static const char *const methods[] = {"verlet", "verlet-literal", "newmark", "gauss4", "gauss6"};
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        double x[3][N], v[3][N], x0[N], v0[N];
        int64_t jvps[2];
        for (size_t k = 0; k < N; k++) x0[k] = 0.1 * (double)(k % 5), v0[k] = 0.05 * (double)(k % 7);
        for (int how = 0; how < 3; how++) {
            ring r = {.n = N, .next = next};
            problem p = {.ctx = &r, .nx = N, .nv = N, .accel = ring_force, .traits = {.velocity = true, .linear_v = true, .constant_jv = true}};
            if (how < 2) p.jvp = ring_jvp;
            if (how == 0) p.pattern = ring_pattern;       /* else dense, and then by difference quotients */
            stepper *s = begin(&p, methods[i], 0, 0.05, x0, v0);
            assert_int_equal(stepper_advance(s, 20, NULL), MOTUS_OK);
            assert_int_equal(stepper_sync(s, x[how], v[how], NULL, NULL), MOTUS_OK);
            if (how < 2) jvps[how] = r.jvps;
            stepper_destroy(s);
        }
        for (size_t k = 0; k < N; k++)
            for (int how = 1; how < 3; how++) {
                assert_near(x[how][k], x[0][k], 1e-12);
                assert_near(v[how][k], v[0][k], 1e-11);
            }
        assert_true(jvps[0] * 4 <= jvps[1]);              /* colours: a few derivatives instead of N */
    }
}

typedef struct meter { size_t now, most, count, fail_at; } meter;
static void *metered(void *context, size_t bytes)
{
    meter *m = context;
    if (++m->count == m->fail_at) return NULL;
    size_t *block = malloc(bytes + 16);
    if (!block) return NULL;
    block[0] = bytes;
    m->now += bytes;
    if (m->now > m->most) m->most = m->now;
    return block + 2;
}
static void unmetered(void *context, void *block)
{
    meter *m = context;
    size_t *start = (size_t *)block - 2;
    m->now -= start[0];
    free(start);
}

static int damped(void *ctx, double t, double *x, double *v, double *a)
{
    (void)t;
    const size_t n = *(size_t *)ctx;
    for (size_t k = 0; k < n; k++) a[k] = -x[k] - (1 + (double)(k % 3)) * v[k] * v[k] * v[k];
    return 0;
}
static int damped_jvp(void *ctx, double t, double *x, double *v, const double *dx, const double *dv, double *da)
{
    (void)t, (void)x;
    const size_t n = *(size_t *)ctx;
    for (size_t k = 0; k < n; k++) da[k] = (dx ? -dx[k] : 0) - (dv ? 3 * (1 + (double)(k % 3)) * v[k] * v[k] * dv[k] : 0);
    return 0;
}
static void damped_pattern(void *ctx, bool in_v, void (*emit)(void *, size_t, size_t), void *arg)
{
    (void)in_v;
    for (size_t k = 0; k < *(size_t *)ctx; k++) emit(arg, k, k);
}

static void a_million_damped_masses(void **state)
{
    (void)state;
    size_t n = 1000000;
    problem p = {.ctx = &n, .nx = n, .nv = n, .accel = damped, .jvp = damped_jvp, .pattern = damped_pattern, .traits = {.velocity = true}};
    double *x = malloc(2 * n * sizeof *x), *v = x + n;
    for (size_t k = 0; k < n; k++) x[k] = 1, v[k] = 0.5;
    chosen c;
    row_choose("verlet", &c, NULL, NULL);
    meter m = {0};
    const motus_allocator hooks = {metered, unmetered, &m};
    stepper *s = NULL;
    motus_error err = {0};
    assert_int_equal(stepper_create(&p, &c, 0, 0.01, x, v, &hooks, &s, &err), MOTUS_OK);
    assert_true(m.most < n * 32 * sizeof(double));         /* a fixed number of numbers for each mass */
    assert_int_equal(stepper_advance(s, 3, &err), MOTUS_OK);
    stepper_destroy(s);
    assert_int_equal(m.now, 0);

    p.pattern = NULL;                                      /* dense: refused before anything of that size is taken */
    m = (meter){0};
    assert_int_equal(stepper_create(&p, &c, 0, 0.01, x, v, &hooks, &s, &err), MOTUS_LIMIT);
    assert_true(m.most < n * 16 * sizeof(double));
    assert_int_equal(m.now, 0);
    assert_non_null(strstr(err.message, "256 MiB"));
    free(x);
}

static void singular_matrix(void **state)
{
    (void)state;
    /* I - (h/2) J with J = 2/h: no delta at all. */
    const problem p = {.nx = 1, .nv = 1, .accel = cubic, .traits = {.velocity = true, .linear_v = true}};
    const double one = 1;
    stepper *s = begin(&p, "verlet", 0, -2, &one, &one);   /* a = -v: q = 1 - h/2 (-1) = 1 + h/2 = 0 */
    motus_error err = {0};
    assert_int_equal(stepper_advance(s, 5, &err), MOTUS_SOLVE);
    assert_int_equal(stepper_steps(s), 1);
    stepper_destroy(s);
}

static void allocation_failures(void **state)
{
    (void)state;
    size_t next[6] = {3, 4, 5, 1, 2, 0};
    ring r = {.n = 6, .next = next};
    const problem p = {.ctx = &r, .nx = 6, .nv = 6, .accel = ring_force, .pattern = ring_pattern, .traits = {.velocity = true}};
    static const char *const methods[] = {"verlet", "gauss4", "newmark", "rk4"};
    const double start[6] = {1, 2, 3, 4, 5, 6};
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        chosen c;
        row_choose(methods[i], &c, NULL, NULL);
        size_t failures = 0;
        for (size_t at = 1;; at++) {
            meter m = {.fail_at = at};
            const motus_allocator hooks = {metered, unmetered, &m};
            stepper *s = NULL;
            motus_error err = {0};
            const motus_status status = stepper_create(&p, &c, 0, 0.01, start, start, &hooks, &s, &err);
            if (!status) {
                const size_t taken = m.count;
                assert_int_equal(stepper_advance(s, 20, &err), MOTUS_OK);
                assert_int_equal(m.count, taken);          /* nothing is taken on the way */
                stepper_destroy(s);
                assert_int_equal(m.now, 0);
                break;
            }
            failures++;
            assert_int_equal(status, MOTUS_MEMORY);
            assert_true(strlen(err.message) > 0);
            assert_int_equal(m.now, 0);
        }
        assert_true(failures >= (strcmp(methods[i], "rk4") ? 5 : 1));
    }
}

/* Boundaries and exact motion ---------------------------------------------------------------------------------------- */

/* Cell 0 is driven, cell 1 hangs on it; `apart` is the same without a cell, the drive written into the force. */
static void drive(void *ctx, double t, double *x, double *v)
{
    (void)ctx;
    x[0] = sin(t);
    v[0] = cos(t);
}
static int hanging(void *ctx, double t, double *x, double *v, double *a)
{
    drive(ctx, t, x, v);
    a[0] = 0;
    a[1] = 2 * (x[0] - x[1]) - x[1] * x[1] * x[1];
    if (ctx) a[1] += 0.3 * (v[0] - v[1]);
    return 0;
}
static int apart(void *ctx, double t, double *x, double *v, double *a)
{
    a[0] = 2 * (sin(t) - x[0]) - x[0] * x[0] * x[0];
    if (ctx) a[0] += 0.3 * (cos(t) - v[0]);
    return 0;
}

static void driven_boundaries(void **state)
{
    (void)state;
    int dummy, rows = 0;
    for (int velocity = 0; velocity < 2; velocity++)
        for (size_t k = 0; k < row_count(); k++) {
            const traits traits = {.velocity = velocity, .linear_v = true, .constant_jv = true, .time = true};
            const problem cell = {.ctx = velocity ? &dummy : NULL, .nx = 2, .nv = 2, .accel = hanging, .refresh = drive, .traits = traits};
            const problem none = {.ctx = velocity ? &dummy : NULL, .nx = 1, .nv = 1, .accel = apart, .traits = traits};
            if (!admitted(&cell, k)) continue;
            rows++;
            const double x0[2] = {0, 0.5}, v0[2] = {1, -0.25};
            stepper *a = begin(&cell, row_card(k)->name, 0, 0.0625, x0, v0);
            stepper *b = begin(&none, row_card(k)->name, 0, 0.0625, x0 + 1, v0 + 1);
            double x[2], v[2], y, w;
            for (int i = 0; i < 40; i++) {
                assert_int_equal(stepper_advance(a, 1, NULL), MOTUS_OK);
                assert_int_equal(stepper_advance(b, 1, NULL), MOTUS_OK);
                assert_int_equal(stepper_sync(a, x, v, NULL, NULL), MOTUS_OK);
                assert_int_equal(stepper_sync(b, &y, &w, NULL, NULL), MOTUS_OK);
                assert_true(x[0] == sin(stepper_time(a)) && v[0] == cos(stepper_time(a)));
                if (velocity == 0 && row_card(k)->evaluations) {
                    assert_true(x[1] == y && v[1] == w);   /* explicit: the same operations, the same bits */
                } else {
                    assert_near(x[1], y, 1e-11);
                    assert_near(v[1], w, 1e-11);
                }
            }
            stepper_destroy(a);
            stepper_destroy(b);
        }
    assert_true(rows > 40);
}

static int fall(void *ctx, double t, double *x, double *v, double *a)
{
    (void)ctx, (void)t, (void)x, (void)v;
    a[0] = 0;
    a[1] = -9.81;
    return 0;
}
static int swing(void *ctx, double t, double *x, double *v)
{
    (void)ctx;
    x[0] = cos(t);
    v[0] = -sin(t);
    return 0;
}

static void exact_motion(void **state)
{
    (void)state;
    const problem falling = {.nx = 2, .nv = 2, .accel = fall, .traits = {.constant = true}};
    const double x0[2] = {0, 1}, v0[2] = {1, 4.5};
    stepper *s = begin(&falling, "exact", 1, 0.125, x0, v0);
    assert_int_equal(stepper_advance(s, 16, NULL), MOTUS_OK);
    double x[2], v[2], a[2];
    assert_int_equal(stepper_sync(s, x, v, a, NULL), MOTUS_OK);
    assert_near(x[0], 2.0, 1e-15);
    assert_near(x[1], 1 + 9 - 9.81 * 2, 4e-15);
    assert_near(v[1], 4.5 - 9.81 * 2, 4e-15);
    assert_true(a[1] == -9.81 && stepper_evaluations(s) == 0);
    stepper_destroy(s);

    const problem swinging = {.nx = 1, .nv = 1, .accel = oscillator, .exact = swing, .traits = {.has_exact = true}};
    chosen c;
    row_choose("exact", &c, NULL, NULL);
    const double one = 1, zero = 0;
    s = begin(&swinging, "exact", 0, 0.5, &one, &zero);
    assert_int_equal(stepper_advance(s, 7, NULL), MOTUS_OK);
    assert_int_equal(stepper_sync(s, x, v, NULL, NULL), MOTUS_OK);
    assert_true(x[0] == cos(3.5) && v[0] == -sin(3.5));
    stepper_destroy(s);
    motus_error err = {0};
    assert_int_equal(stepper_create(&swinging, &c, 0, 0.5, &zero, &zero, NULL, &s, &err), MOTUS_METHOD);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(looking_and_restarting_change_no_bit),
        cmocka_unit_test(instruction_sets_agree),
        cmocka_unit_test(founding_recurrences),
        cmocka_unit_test(divergence_names_time_and_variable),
        cmocka_unit_test(failing_callback),
        cmocka_unit_test(failed_solve_names_time_and_variable),
        cmocka_unit_test(refused_requests),
        cmocka_unit_test(names_are_unique),
        cmocka_unit_test(errors_are_safe),
        cmocka_unit_test(structure_does_not_change_the_motion),
        cmocka_unit_test(a_million_damped_masses),
        cmocka_unit_test(singular_matrix),
        cmocka_unit_test(allocation_failures),
        cmocka_unit_test(driven_boundaries),
        cmocka_unit_test(exact_motion),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
