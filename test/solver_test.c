/* The linear systems of implicit methods: sparse, dense and by difference quotients give the same; a million unknowns
 * take proportional memory; singular ones are errors; every allocation may fail.
 */
#include "test/stepper_test.h"
#include "core/solver.h"

static int cubic(void *ctx, double t, double *x, double *v, double *a)
{
    (void)ctx, (void)t;
    a[0] = -v[0] - x[0] * x[0] * x[0];
    return 0;
}
/* x'' = -x - C v with C a permuted ring: row k couples to next[k] and to its predecessor. */
typedef struct ring {
    size_t n, *next;
    bool told;
    int64_t jvps;
} ring;
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
    static const char *const methods[] = {"verlet", "verlet-literal", "newmark", "gauss4", "gauss6"};
    for (size_t i = 0; i < 2 * (sizeof methods / sizeof *methods); i++) {
        size_t next[N];
        for (size_t k = 0; k < N; k++) next[k] = (k + (i % 2 ? 7 : 6)) % N; /* one ring, or six */
        const char *method = methods[i / 2];
        double x[3][N], v[3][N], x0[N], v0[N];
        int64_t jvps[2];
        for (size_t k = 0; k < N; k++) x0[k] = 0.1 * (double)(k % 5), v0[k] = 0.05 * (double)(k % 7);
        for (int how = 0; how < 3; how++) {
            ring r = {.n = N, .next = next};
            problem p = {.ctx = &r,
                         .nx = N,
                         .nv = N,
                         .accel = ring_force,
                         .traits = {.velocity = true, .linear_v = true, .constant_jv = true}};
            if (how < 2) p.jvp = ring_jvp;
            if (how == 0) p.pattern = ring_pattern; /* else dense, and then by difference quotients */
            stepper *s = begin(&p, method, 0, 0.05, x0, v0);
            assert_int_equal(stepper_advance(s, (stepper_limit){20, NAN}, NULL, NULL), MOTUS_OK);
            assert_int_equal(stepper_sync(s, x[how], v[how], NULL, NULL), MOTUS_OK);
            if (how < 2) jvps[how] = r.jvps;
            stepper_destroy(s);
        }
        for (size_t k = 0; k < N; k++)
            for (int how = 1; how < 3; how++) {
                assert_near(x[how][k], x[0][k], 1e-12);
                assert_near(v[how][k], v[0][k], 1e-11);
            }
        assert_true(jvps[0] * 4 <= jvps[1]); /* colours: a few derivatives instead of N */
    }
}

/* LU against the product: a band with small diagonals, so that rows are exchanged. */
static void pivoting(void **state)
{
    (void)state;
    enum { N = 40, LOWER = 3, UPPER = 2, HEIGHT = 2 * LOWER + UPPER + 1 };
    double dense[N][N] = {{0}}, matrix[N * HEIGHT] = {0}, solution[N], b[N] = {0};
    uint32_t pivot[N], seed = 1, exchanged = 0;
    for (size_t i = 0; i < N; i++) {
        solution[i] = 1 + (double)(i % 4);
        for (size_t j = i < LOWER ? 0 : i - LOWER; j <= i + UPPER && j < N; j++) {
            seed = seed * 1664525u + 1013904223u;
            dense[i][j] = (double)(seed >> 16) / 65536 - 0.5;
            if (i == j) dense[i][j] *= 0.01;
            matrix[j * HEIGHT + LOWER + UPPER + i - j] = dense[i][j];
        }
    }
    for (size_t i = 0; i < N; i++)
        for (size_t j = 0; j < N; j++) b[i] += dense[i][j] * solution[j];
    static double other_matrix[sizeof matrix / sizeof *matrix], other_b[N];
    uint32_t other_pivot[N];
    memcpy(other_matrix, matrix, sizeof matrix);
    memcpy(other_b, b, sizeof b);
    assert_true(solver_band_base.factor(N, LOWER, UPPER, other_matrix, other_pivot));
    solver_band_base.back(N, LOWER, UPPER, other_matrix, other_pivot, other_b);
    const solver_band *best = solver_best_band();
    assert_true(best->factor(N, LOWER, UPPER, matrix, pivot));
    best->back(N, LOWER, UPPER, matrix, pivot, b);
    assert_memory_equal(matrix, other_matrix, sizeof matrix);
    assert_memory_equal(b, other_b, sizeof b);
    for (size_t i = 0; i < N; i++) {
        exchanged += pivot[i] != i;
        assert_near(b[i], solution[i], 1e-10);
    }
    assert_true(exchanged > N / 2);
    memset(matrix, 0, sizeof matrix);
    assert_false(best->factor(N, LOWER, UPPER, matrix, pivot));
}

typedef struct meter {
    size_t now, most, count, fail_at;
} meter;
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
    for (size_t k = 0; k < n; k++)
        da[k] = (dx ? -dx[k] : 0) - (dv ? 3 * (1 + (double)(k % 3)) * v[k] * v[k] * dv[k] : 0);
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
    problem p = {.ctx = &n,
                 .nx = n,
                 .nv = n,
                 .accel = damped,
                 .jvp = damped_jvp,
                 .pattern = damped_pattern,
                 .traits = {.velocity = true}};
    double *x = malloc(2 * n * sizeof *x), *v = x + n;
    for (size_t k = 0; k < n; k++) x[k] = 1, v[k] = 0.5;
    chosen c;
    row_choose("verlet", &c, NULL, NULL);
    meter m = {0};
    const motus_allocator hooks = {metered, unmetered, &m};
    stepper *s = NULL;
    motus_error err = {0};
    assert_int_equal(stepper_create(&(machine){.problem = &p}, &c, 0, 0.01, x, v, &hooks, &s, &err), MOTUS_OK);
    assert_true(m.most < n * 32 * sizeof(double)); /* a fixed number of numbers for each mass */
    assert_int_equal(stepper_advance(s, (stepper_limit){3, NAN}, NULL, &err), MOTUS_OK);
    stepper_destroy(s);
    assert_int_equal(m.now, 0);

    p.pattern = NULL; /* dense: refused before memory of that size is allocated */
    m = (meter){0};
    assert_int_equal(stepper_create(&(machine){.problem = &p}, &c, 0, 0.01, x, v, &hooks, &s, &err), MOTUS_LIMIT);
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
    stepper *s = begin(&p, "verlet", 0, -2, &one, &one); /* a = -v: q = 1 - h/2 (-1) = 1 + h/2 = 0 */
    motus_error err = {0};
    assert_int_equal(stepper_advance(s, (stepper_limit){5, NAN}, NULL, &err), MOTUS_SOLVE);
    assert_int_equal(stepper_steps(s), 1);
    stepper_destroy(s);
}

static void allocation_failures(void **state)
{
    (void)state;
    size_t next[6] = {3, 4, 5, 1, 2, 0};
    ring r = {.n = 6, .next = next};
    const problem p = {
        .ctx = &r, .nx = 6, .nv = 6, .accel = ring_force, .pattern = ring_pattern, .traits = {.velocity = true}};
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
            const motus_status status =
                stepper_create(&(machine){.problem = &p}, &c, 0, 0.01, start, start, &hooks, &s, &err);
            if (!status) {
                const size_t taken = m.count;
                assert_int_equal(stepper_advance(s, (stepper_limit){20, NAN}, NULL, &err), MOTUS_OK);
                assert_int_equal(m.count, taken); /* nothing is allocated later */
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pivoting),
        cmocka_unit_test(structure_does_not_change_the_motion),
        cmocka_unit_test(a_million_damped_masses),
        cmocka_unit_test(singular_matrix),
        cmocka_unit_test(allocation_failures),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
