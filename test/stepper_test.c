/* The stepper: restarts and observations that change no bit, instruction sets that agree, driven boundaries, exact
 * motion, and the two founding recurrences.
 */
#include "test/stepper_test.h"
#include "core/stepper_body.h"

/* Problems --------------------------------------------------------------------------------------------------------- */

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

/* Two coupled positions and a first-order variable; with `tangle`, all of it nonlinear in the velocities. */
typedef struct mix {
    bool tangle;
} mix;
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
    {.ctx = &still, .nx = 2, .nv = 3, .accel = mixed, .traits = {.time = true, .first_order = true}},
    {.ctx = &tangled,
     .nx = 2,
     .nv = 3,
     .accel = mixed,
     .traits = {.velocity = true, .time = true, .first_order = true}},
    {.nx = 3, .nv = 3, .accel = turning, .traits = {.velocity = true, .linear_v = true, .gyroscopic = true}},
};
enum { PROBLEMS = sizeof problems / sizeof *problems };
static const double start_x[3] = {0.2, -0.3, 0.1}, start_v[3] = {0.4, 0.1, -0.2};

/* Bits ------------------------------------------------------------------------------------------------------------- */

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
            assert_int_equal(stepper_advance(plain, (stepper_limit){45, NAN}, NULL, NULL), MOTUS_OK);

            stepper *watched = begin(p, name, 0.5, 0.05, start_x, start_v);
            double x[3], v[3], a[3], carry[64];
            for (int i = 0; i < 45; i++) {
                assert_int_equal(stepper_sync(watched, x, v, i % 2 ? a : NULL, NULL), MOTUS_OK);
                if (i == 0 || i == 21) { /* continues in another, equal stepper */
                    assert_in_range(stepper_carry(watched), 0, 64);
                    const stepper_count at = stepper_save(watched, carry);
                    stepper *next = begin(p, name, 0.5, 0.05, start_x, start_v);
                    assert_int_equal(stepper_load(next, at, carry, NULL), MOTUS_OK);
                    stepper_destroy(watched);
                    watched = next;
                }
                assert_int_equal(stepper_advance(watched, (stepper_limit){1, NAN}, NULL, NULL), MOTUS_OK);
            }
            const outcome one = finish(plain), other = finish(watched);
            if (memcmp(&one, &other, sizeof one))
                explain("%s on problem %d: looking or restarting changed the result", name, q);
        }
    assert_true(rows > 50);
}

static void instruction_sets_agree(void **state)
{
    (void)state;
    const stepper_body *bodies[3] = {&stepper_body_base};
    int count = 1;
#if defined __x86_64__ && !defined ONE_ISA
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
                assert_int_equal(stepper_advance(s, (stepper_limit){100, NAN}, NULL, NULL), MOTUS_OK);
                o[b] = finish(s);
                if (memcmp(&o[0], &o[b], sizeof *o))
                    explain("%s on problem %d: %s differs", row_card(k)->name, q, bodies[b]->name);
            }
        }
}

static double run(const problem *p, const char *method, double h, int64_t steps, double x0)
{
    const double zero = 0;
    stepper *s = begin(p, method, 0, h, &x0, &zero);
    double x, v;
    assert_int_equal(stepper_advance(s, (stepper_limit){steps, NAN}, NULL, NULL), MOTUS_OK);
    assert_int_equal(stepper_sync(s, &x, &v, NULL, NULL), MOTUS_OK);
    assert_true(stepper_time(s) == (double)steps * h);
    assert_int_equal(stepper_evaluations(s), steps);
    assert_int_equal(stepper_iterations(s), 0);
    stepper_destroy(s);
    return x;
}

/* The notebook's two recurrences: summed Verlet within round-off of the exact recurrence, the literal one with the
 * notebook's numbers. */
static void founding_recurrences(void **state)
{
    (void)state;
    const problem a = {.nx = 1, .nv = 1, .accel = oscillator, .traits = {.time = true}};
    assert_near(run(&a, "verlet", 0.001, 100000, 0), 0.04778239807187258, 1e-13);
    assert_near(run(&a, "verlet-literal", 0.001, 100000, 0), 0.04778239807006475, 1e-11);
    const problem b = {.nx = 1,
                       .nv = 1,
                       .accel = cubic,
                       .jvp = cubic_jvp,
                       .traits = {.velocity = true, .linear_v = true, .constant_jv = true}};
    assert_near(run(&b, "verlet", 0.001, 3000, 10), -3.489442177206087865, 1e-13);
    assert_near(run(&b, "verlet-literal", 0.001, 3000, 10), -3.4894421772061026, 1e-13);
}

/* Boundaries and exact motion -------------------------------------------------------------------------------------- */

/* Cell 0 is driven, cell 1 is coupled to it; `apart` is the same with the drive written into the force. */
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
            static const size_t alone[] = {0, 1, 2}; /* the cell has no part in the error of the other number */
            const problem cell = {.ctx = velocity ? &dummy : NULL,
                                  .variables = alone,
                                  .variable_count = 2,
                                  .nx = 2,
                                  .nv = 2,
                                  .accel = hanging,
                                  .refresh = drive,
                                  .traits = traits};
            const problem none = {.ctx = velocity ? &dummy : NULL, .nx = 1, .nv = 1, .accel = apart, .traits = traits};
            if (!admitted(&cell, k)) continue;
            rows++;
            const double x0[2] = {0, 0.5}, v0[2] = {1, -0.25};
            stepper *a = begin(&cell, row_card(k)->name, 0, 0.0625, x0, v0);
            stepper *b = begin(&none, row_card(k)->name, 0, 0.0625, x0 + 1, v0 + 1);
            double x[2], v[2], y, w;
            for (int i = 0; i < 40; i++) {
                assert_int_equal(stepper_advance(a, (stepper_limit){1, NAN}, NULL, NULL), MOTUS_OK);
                assert_int_equal(stepper_advance(b, (stepper_limit){1, NAN}, NULL, NULL), MOTUS_OK);
                assert_int_equal(stepper_sync(a, x, v, NULL, NULL), MOTUS_OK);
                assert_int_equal(stepper_sync(b, &y, &w, NULL, NULL), MOTUS_OK);
                assert_true(x[0] == sin(stepper_time(a)) && v[0] == cos(stepper_time(a)));
                if (velocity == 0 && row_card(k)->evaluations) {
                    assert_true(x[1] == y && v[1] == w); /* explicit: the same operations, the same bits */
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
    assert_int_equal(stepper_advance(s, (stepper_limit){16, NAN}, NULL, NULL), MOTUS_OK);
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
    assert_int_equal(stepper_advance(s, (stepper_limit){7, NAN}, NULL, NULL), MOTUS_OK);
    assert_int_equal(stepper_sync(s, x, v, NULL, NULL), MOTUS_OK);
    assert_true(x[0] == cos(3.5) && v[0] == -sin(3.5));
    stepper_destroy(s);
    motus_error err = {0};
    assert_int_equal(stepper_create(&(machine){.problem = &swinging}, &c, 0, 0.5, &zero, &zero, NULL, &s, &err),
                     MOTUS_METHOD);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(looking_and_restarting_change_no_bit),
        cmocka_unit_test(instruction_sets_agree),
        cmocka_unit_test(founding_recurrences),
        cmocka_unit_test(driven_boundaries),
        cmocka_unit_test(exact_motion),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
