/* What may be set: the parameters of a model and its initial values, their present values, their lines, and which of
 * them decide more than numbers.
 */
#include "test/given.h"

static const char text[] =
    "N = 3          # cells\ng = (0, -9.81)\nF = 0.2 + 0.1\nk = [1, 4,\n     9]\nT = 2\nM = N + 0\n"
    "c[i] = k[i] + F   for i = 1..M\n"
    "P = 2\nQ = P + 0\nq[i] = i g   for i = 1..Q\n"
    "x[i]'' = -c[i] x[i] + x[0]   for i = 1..N\nx[0] = 0\nx[i](1.5) = k[i]   for i = 1..N\nx[i]'(1.5) = 0   for i = "
    "1..N\n"
    "r'' = g\nr(1.5) = (1, 2)\nr'(1.5) = (F, 4)\ns' = -s\ns(1.5) = 5\nspeed = |r'|\nuntil 1.5 + T\nstep T/100\n";

typedef struct expected {
    const char *name, *text;
    int components, list;
    size_t count;
    double values[4];
    const char *decides;
} expected;

static void check(motus_system *s, const expected *list, size_t count)
{
    assert_int_equal(motus_parameter_count(s), count);
    for (size_t k = 0; k < count; k++) {
        motus_parameter p = motus_default_parameter();
        double values[8];
        assert_int_equal(motus_parameter_at(s, k, &p), MOTUS_OK);
        assert_string_equal(p.name, list[k].name);
        if (p.length != strlen(list[k].text) || strncmp(p.text, list[k].text, p.length))
            fail_msg("%s is written \"%.*s\", expected \"%s\"", p.name, (int)p.length, p.text, list[k].text);
        assert_int_equal(p.components, list[k].components);
        assert_int_equal(p.list, list[k].list);
        assert_int_equal(p.count, list[k].count);
        if (list[k].decides ? !p.decides || strcmp(p.decides, list[k].decides) : p.decides != NULL)
            fail_msg("%s decides %s, expected %s", p.name, p.decides ? p.decides : "nothing",
                     list[k].decides ? list[k].decides : "nothing");
        assert_int_equal(motus_parameter_values(s, k, values), MOTUS_OK);
        for (size_t i = 0; i < p.count; i++) assert_true(values[i] == list[k].values[i]);
    }
}

static const char size[] = "a size or an index";

static void parameters(void **state)
{
    (void)state;
    const expected all[] = {
        {"N", "3", 0, 0, 1, {3}, size},
        {"g", "(0, -9.81)", 2, 0, 2, {0, -9.81}, NULL},
        {"F", "0.2 + 0.1", 0, 0, 1, {0.2 + 0.1}, NULL},
        {"k", "[1, 4,\n     9]", 0, 1, 3, {1, 4, 9}, NULL},
        {"T", "2", 0, 0, 1, {2}, "until"},
        {"M", "N + 0", 0, 0, 1, {3}, size},
        {"c", "k[i] + F", 0, 1, 3, {1 + (0.2 + 0.1), 4 + (0.2 + 0.1), 9 + (0.2 + 0.1)}, NULL},
        {"P", "2", 0, 0, 1, {2}, size},
        {"Q", "P + 0", 0, 0, 1, {2}, size},
        {"q", "i g", 2, 1, 4, {0, -9.81, 0, 2 * -9.81}, NULL},
    };
    motus_system *s = given_text(text);
    motus_parameter p = motus_default_parameter();
    check(s, all, 10);
    motus_parameter_at(s, 9, &p);
    assert_true(p.dimensions == 1 && p.first[0] == 1 && p.last[0] == 2);
    motus_system_destroy(s);

    /* the set value, and what follows from it */
    expected other[10];
    memcpy(other, all, sizeof other);
    other[1] = (expected){"g", "(1, 2)", 2, 0, 2, {1, 2}, NULL};
    other[2] = (expected){"F", "7", 0, 0, 1, {7}, NULL};
    other[6] = (expected){"c", "k[i] + F", 0, 1, 3, {8, 11, 16}, NULL};
    other[9] = (expected){"q", "i g", 2, 1, 4, {1, 2, 2, 4}, NULL};
    const char *set[] = {"F = 7", "g=(1, 2)"};
    s = given_text_with(text, set, 2, "set");
    check(s, other, 10);
    motus_system_destroy(s);
}

/* An ensemble varies what decides only numbers, and refuses what decides more. */
static void decides_what_an_ensemble_refuses(void **state)
{
    (void)state;
    motus_system *s = given_text(text);
    size_t refused = 0;
    for (size_t k = 0; k < motus_parameter_count(s); k++) {
        motus_parameter p = motus_default_parameter();
        motus_parameter_at(s, k, &p);
        char name[80];
        snprintf(name, sizeof name, p.list ? "%s[1]" : p.components ? "%s.x" : "%s", p.name);
        if (p.list && p.components) continue; /* an ensemble varies no vectors of lists */
        const char *vary[] = {name};
        motus_error e = motus_default_error();
        motus_ensemble_def def = motus_default_ensemble();
        const motus_record record = {MOTUS_REDUCE_FINAL, 1};
        def.vary = vary;
        def.vary_count = 1;
        def.records = &record;
        def.record_count = 1;
        def.machine = "interpreter";
        motus_ensemble *ensemble = NULL;
        const motus_status status = motus_ensemble_create(s, &def, &ensemble, &e);
        if (status != (p.decides ? MOTUS_ARGUMENT : MOTUS_OK))
            fail_msg("%s decides %s, and the ensemble says: %s", name, p.decides ? p.decides : "nothing",
                     status ? e.message : "done");
        refused += status != MOTUS_OK;
        motus_ensemble_destroy(ensemble);
    }
    assert_int_equal(refused, 5);
    motus_system_destroy(s);
}

static void initials(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        size_t variable;
        int is_velocity;
        size_t count;
        double values[3];
    } all[] = {
        {"x(1.5)", 0, 0, 3, {1, 4, 9}},       {"x'(1.5)", 0, 1, 3, {0}}, {"r(1.5)", 1, 0, 2, {1, 2}},
        {"r'(1.5)", 1, 1, 2, {0.2 + 0.1, 4}}, {"s(1.5)", 2, 0, 1, {5}},
    };
    motus_system *s = given_text(text);
    assert_int_equal(motus_initial_count(s), 5);
    for (size_t k = 0; k < 5; k++) {
        motus_initial i = motus_default_initial();
        double values[4];
        assert_int_equal(motus_initial_at(s, k, &i), MOTUS_OK);
        assert_string_equal(i.name, all[k].name);
        assert_true(i.variable == all[k].variable && i.is_velocity == all[k].is_velocity && i.count == all[k].count);
        assert_int_equal(motus_initial_values(s, k, values), MOTUS_OK);
        for (size_t j = 0; j < i.count; j++) assert_true(values[j] == all[k].values[j]);
        /* its name is one that `set` knows */
        if (i.variable == 0) continue;
        char line[120];
        snprintf(line, sizeof line, i.count == 2 ? "%s=(7, 8)" : "%s=7", i.name);
        const char *set[] = {line};
        motus_system *other = given_text_with(text, set, 1, line);
        assert_int_equal(motus_initial_values(other, k, values), MOTUS_OK);
        assert_true(values[0] == 7 && (i.count == 1 || values[1] == 8));
        motus_system_destroy(other);
    }
    motus_system_destroy(s);
}

static int none(void *context, double t, const double *x, const double *v, double *a)
{
    (void)context, (void)t, (void)x, (void)v;
    a[0] = a[1] = a[2] = 0;
    return 0;
}

static void callbacks_and_wrong_requests(void **state)
{
    (void)state;
    static const double x[] = {1, 2}, v[] = {3, 4, 5};
    motus_callback_def def = motus_default_callback();
    motus_error err = motus_default_error();
    def.positions = 2;
    def.first_order = 1;
    def.x = x;
    def.v = v;
    def.acceleration = none;
    motus_system *s = NULL;
    must(motus_system_from_callback(&def, &s, &err), &err, "callback");
    assert_int_equal(motus_parameter_count(s), 0);
    assert_int_equal(motus_initial_count(s), 3);
    double values[2];
    motus_initial i = motus_default_initial();
    assert_int_equal(motus_initial_values(s, 1, values), MOTUS_OK);
    assert_true(values[0] == 3 && values[1] == 4);
    assert_int_equal(motus_initial_values(s, 2, values), MOTUS_OK);
    assert_true(values[0] == 5);
    assert_int_equal(motus_initial_at(s, 2, &i), MOTUS_OK);
    assert_string_equal(i.name, "s(0)");
    motus_parameter p = motus_default_parameter();
    assert_int_equal(motus_parameter_at(s, 0, &p), MOTUS_ARGUMENT);
    assert_int_equal(motus_parameter_values(s, 0, values), MOTUS_ARGUMENT);
    assert_int_equal(motus_initial_at(s, 3, &i), MOTUS_ARGUMENT);
    assert_int_equal(motus_initial_at(s, 0, NULL), MOTUS_ARGUMENT);
    assert_int_equal(motus_initial_values(s, 0, NULL), MOTUS_ARGUMENT);
    assert_int_equal(motus_parameter_count(NULL) + motus_initial_count(NULL), 0);
    assert_int_equal(motus_parameter_at(NULL, 0, &p), MOTUS_ARGUMENT);
    assert_int_equal(motus_initial_at(NULL, 0, &i), MOTUS_ARGUMENT);
    motus_system_destroy(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parameters),
        cmocka_unit_test(decides_what_an_ensemble_refuses),
        cmocka_unit_test(initials),
        cmocka_unit_test(callbacks_and_wrong_requests),
    };
    return cmocka_run_group_tests_name("parameters", tests, NULL, NULL);
}
