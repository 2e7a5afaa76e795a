/* Errors of a run, and refused requests: each error has its time, its variable or a hint, and the stepper stands at
 * the last good step.
 */
#include "test/stepper_test.h"

static int oscillator(void *ctx, double t, double *x, double *v, double *a)
{
    (void)ctx, (void)v;
    a[0] = -x[0] + x[0] * x[0] * x[0] + 0.1 * cos(t);
    return 0;
}

/* Errors ----------------------------------------------------------------------------------------------------------- */

/* x'' = 2 (x - centre)^3 diverges in finite time if it starts outward; the rest of a long family is at rest. */
typedef struct burst {
    size_t n, hot;
    int64_t calls, fail_at;
} burst;
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
    while (!status && stepper_steps(s) < 1000) status = stepper_advance(s, (stepper_limit){chunk, NAN}, NULL, &err);
    assert_int_equal(status, MOTUS_DIVERGED);
    assert_true(err.time > 0.9 && err.time < 1.2);
    char expected[64];
    snprintf(expected, sizeof expected, "y[%zu]", b.hot + 1);
    assert_int_equal(strncmp(err.variable, expected, strlen(expected)), 0);
    assert_non_null(strstr(err.message, expected));
    /* It stands at the last finite step: the next one is the reported one, and repeating it fails again. */
    const int64_t at = stepper_steps(s);
    assert_true(fabs(stepper_time(s) + 0.01 - err.time) < 1e-9);
    memset(x, 0, 2 * n * sizeof *x);
    x[b.hot] = v[b.hot] = 1;
    stepper *again = begin(&p, method, 0, 0.01, x, v);
    assert_int_equal(stepper_advance(again, (stepper_limit){at, NAN}, NULL, NULL), MOTUS_OK);
    double *carry = calloc(2 * stepper_carry(s), sizeof *carry);
    stepper_save(s, carry);
    stepper_save(again, carry + stepper_carry(s));
    assert_memory_equal(carry, carry + stepper_carry(s), stepper_carry(s) * sizeof *carry);
    assert_int_equal(stepper_evaluations(s), stepper_evaluations(again));
    assert_int_equal(stepper_advance(again, (stepper_limit){1, NAN}, NULL, &err), MOTUS_DIVERGED);
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
        divergence(methods[i], 5000, 1000); /* beyond the size that is checked after every step */
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
        assert_int_equal(stepper_advance(s, (stepper_limit){400, NAN}, NULL, &err), MOTUS_CALLBACK);
        assert_true(isfinite(err.time) && err.time >= 2 && (row_card(k)->adaptive || err.time <= 4));
        assert_true(stepper_time(s) == err.time); /* it stands where the failing step began */
        /* Once the callback works again, the run continues as without the failure. */
        stepper *whole = begin(&p, row_card(k)->name, 2, 0.01, &x, &v);
        assert_int_equal(stepper_advance(s, (stepper_limit){400 - stepper_steps(s), NAN}, NULL, &err), MOTUS_OK);
        assert_int_equal(stepper_advance(whole, (stepper_limit){400, NAN}, NULL, &err), MOTUS_OK);
        const outcome one = finish(s), other = finish(whole);
        assert_memory_equal(&one, &other, sizeof one);
    }
}

static int inverse(void *ctx, double t, double *x, double *v, double *a)
{
    (void)ctx, (void)t, (void)v;
    a[0] = 1 / x[0];
    return 0;
}

/* x'' = 1/x from x = 0: no smaller step would help, so none is to blame. */
static void an_undefined_start_is_named(void **state)
{
    (void)state;
    const problem p = {.nx = 1, .nv = 1, .accel = inverse, .name = cell_name, .traits = {.gradient = true}};
    int said = 0;
    for (size_t k = 0; k < row_count(); k++) {
        if (!admitted(&p, k)) continue;
        const double zero = 0, one = 1;
        motus_error err = {0};
        stepper *s = begin(&p, row_card(k)->name, 3, 0.25, &zero, &one);
        const motus_status status = stepper_advance(s, (stepper_limit){5, NAN}, NULL, &err);
        if (status && stepper_steps(s) == 0) {
            assert_string_equal(err.message,
                                "the motion is undefined at t = 3: y[1]' has no finite rate of change there");
            assert_null(strstr(err.hint, "smaller step"));
            assert_true(stepper_time(s) == 3);
            said++;
        }
        stepper_destroy(s);
        /* A start that the force can bear, and a step that it cannot: the step's end is told, as ever. */
        const double near = -0.25;
        s = begin(&p, row_card(k)->name, 3, 0.25, &near, &one);
        if (stepper_advance(s, (stepper_limit){5, NAN}, NULL, &err)) assert_null(strstr(err.message, "at the start"));
        stepper_destroy(s);
    }
    assert_true(said > 15);
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
        assert_int_equal(stepper_advance(s, (stepper_limit){5, NAN}, NULL, &err), MOTUS_SOLVE);
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
    static const char *const wrong[] = {"newmark(",
                                        "newmark(1/4",
                                        "newmark(1/4,",
                                        "newmark(1/0, 1/2)",
                                        "newmark(1,2)",
                                        "newmark(a,b)",
                                        "newmark(1/4, 1/2) x",
                                        "newmark(-1, 1/2)",
                                        "",
                                        "(1)",
                                        "newmark(1e999, 1/2)"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        assert_int_equal(row_choose(wrong[i], &c, NULL, &err), MOTUS_METHOD);
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
    static const struct {
        const char *method, *hint;
    } pairs[] = {
        {"velocity-verlet", "verlet"}, {"pefrl", "forest-ruth"}, {"blanes-moan6", "yoshida6"}, {"boris", "verlet"}};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        row_choose(pairs[i].method, &c, &card, NULL);
        assert_int_equal(row_admits(&c, &velocity, &err), MOTUS_METHOD);
        assert_int_equal(strncmp(err.hint, pairs[i].hint, strlen(pairs[i].hint)), 0);
        assert_non_null(strstr(err.message, " does not admit this model: "));
    }
    row_choose("exact", &c, NULL, NULL);
    assert_int_equal(row_admits(&c, &plain, &err), MOTUS_METHOD);
    assert_int_equal(row_admits(&c, &constant, &err), MOTUS_OK);

    const problem p = {.nx = 1, .nv = 1, .accel = oscillator, .traits = {.time = true}};
    const double zero = 0, nan_value = NAN;
    stepper *s = NULL;
    row_choose("verlet", &c, NULL, NULL);
    assert_int_equal(stepper_create(&(machine){.problem = &p}, &c, 0, 0, &zero, &zero, NULL, &s, &err), MOTUS_ARGUMENT);
    assert_int_equal(stepper_create(&(machine){.problem = &p}, &c, 1e20, 1, &zero, &zero, NULL, &s, &err),
                     MOTUS_ARGUMENT);
    assert_int_equal(stepper_create(&(machine){.problem = &p}, &c, 0, NAN, &zero, &zero, NULL, &s, &err),
                     MOTUS_ARGUMENT);
    assert_int_equal(stepper_create(&(machine){.problem = &p}, &c, 0, 1, &nan_value, &zero, NULL, &s, &err),
                     MOTUS_ARGUMENT);
    s = begin(&p, "verlet", 0, 0.1, &zero, &zero);
    const double carry[2] = {1, NAN};
    assert_int_equal(stepper_load(s, (stepper_count){1, 1, 0, 0}, carry, &err), MOTUS_STATE);
    assert_int_equal(stepper_load(s, (stepper_count){-1, 1, 0, 0}, carry, &err), MOTUS_STATE);
    stepper_destroy(s);
}

static void names_are_unique(void **state)
{
    (void)state;
    for (size_t k = 0; k < row_count(); k++) {
        const motus_method *card = row_card(k), *found = NULL;
        chosen c;
        assert_true(card->name && card->aliases && card->family && card->cite && strlen(card->formula) > 0 &&
                    strlen(card->use) > 0);
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
    fail(&err, MOTUS_NAME,
         "a\033[31mb\nc\xc2\x9b"
         "d\xe2\x80\xae"
         "e\xffµ");
    assert_string_equal(err.message, "a?[31mb c?d?e?µ");
    for (size_t i = 0; i + 2 < sizeof wild; i += 2) memcpy(wild + i, "µ", 2);
    fail(&err, MOTUS_NAME, "x%s", wild);
    assert_true(strlen(err.message) < MOTUS_TEXT_MAX);
    assert_string_equal(err.message + strlen(err.message) - 3, "...");
    assert_null(strchr(err.message, '?'));
    assert_int_equal(fail(NULL, MOTUS_LIMIT, "x"), MOTUS_LIMIT);
    hint(NULL, "x");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(divergence_names_time_and_variable),
        cmocka_unit_test(failing_callback),
        cmocka_unit_test(an_undefined_start_is_named),
        cmocka_unit_test(failed_solve_names_time_and_variable),
        cmocka_unit_test(refused_requests),
        cmocka_unit_test(names_are_unique),
        cmocka_unit_test(errors_are_safe),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
