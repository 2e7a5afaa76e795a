/* What is said of a force: that it is a gradient, that an energy exists, that a velocity term does no work. It is
 * proved, or said to be sampled, or not said. */
#include "test/given.h"

#include <stdbool.h>

typedef enum answer { NO, SAMPLED, PROVED, ENERGY } answer;
static const char *const words[] = {"not said", "sampled", "proved", "proved with an energy"};

typedef struct row {
    const char *forces; /* of x, y and z, in this order, separated by ';' */
    answer answer;
} row;

static motus_system *system_of(const char *forces)
{
    char text[2048] = "";
    size_t n = 0;
    static const char names[] = "xyz";
    for (const char *at = forces; *at;) {
        const size_t length = strcspn(at, ";");
        int wrote = snprintf(text + strlen(text), sizeof text - strlen(text),
                             "%c'' = %.*s\n%c(0) = 0.7\n%c'(0) = 0.2\n", names[n], (int)length, at, names[n], names[n]);
        assert_true(wrote > 0 && strlen(text) + 1 < sizeof text && n < 3);
        n++;
        at += length + (at[length] == ';');
    }
    return given_text(text);
}

static motus_analysis analysis_of(motus_system *s)
{
    motus_analysis a = motus_default_analysis();
    assert_int_equal(motus_analysis_of(s, &a), MOTUS_OK);
    return a;
}

static bool says(motus_system *s, const char *what) { return strstr(motus_explain(s), what) != NULL; }

static void judge(const char *what, motus_system *s, answer wanted)
{
    const motus_analysis a = analysis_of(s);
    const answer got = !a.gradient ? NO : a.sampled_gradient ? SAMPLED : a.energy ? ENERGY : PROVED;
    if (got != wanted) fail_msg("%s: a gradient is %s, not %s\n%s", what, words[got], words[wanted], motus_explain(s));
    assert_int_equal(says(s, "is a gradient"), got != NO);
    assert_int_equal(says(s, "as far as sampled"), got == SAMPLED);
    assert_int_equal(says(s, "so an energy exists\n"), got == ENERGY);
    motus_geometry g;
    assert_int_equal(motus_method_geometry(s, "velocity-verlet", &g, NULL), MOTUS_OK);
    assert_int_equal(g, got == NO ? MOTUS_GEOMETRY_VOLUME : MOTUS_GEOMETRY_SYMPLECTIC);
    motus_system_destroy(s);
}

static void gradients(void **state)
{
    (void)state;
    static const row rows[] = {
        /* not gradients: far from the start, hidden by a large term, by jumps alone, late */
        {"-x + max(x-3,0) y; -y", NO},
        {"-1e20 x + y; -y", NO},
        {"-x + if(y > 3, 1, 0); -y", NO},
        {"-x + if(y > 3, y, 0); -y + if(y > 3, x, 0)", NO},
        {"-x + floor(y); -y + floor(x)", NO},
        {"-x + if(t > 1000, y, 0); -y", NO},
        {"-x + exp(-1000 (t - 50)^2) y; -y", NO},
        {"-x + exp(-1000 (t - 50)^2) (x + y); -y", NO},
        {"-x + |y|; -y", NO},
        {"-x + min(y, sin(x)); -y", NO},
        {"-x + 1e-30 y; -y", NO},
        {"-x + y; -y - x", NO},
        {"y z; x z; x y + x", NO},
        /* by jumps that the formula shows as a quotient or as an angle: their derivative is symmetric elsewhere */
        {"y/|y|; 0 x", NO},
        {"y/sqrt(y^2); 0 x", NO},
        {"y/hypot(y, 0); -y", NO},
        {"acos(y/sqrt(y^2)); -y", NO},
        {"-x + y exp(-0.5 log(y^2)); -y", NO},
        {"tanh(1/y); -x (1 - tanh(1/y)^2)/y^2", NO},
        {"-x + |y - x|/(y - x); -y", NO},
        {"atan2(y, x) - x y/(x^2 + y^2); x^2/(x^2 + y^2)", NO},
        {"-y^2/(x^2 + y^2); atan(y/x) + x y/(x^2 + y^2)", NO},
        {"x/hypot(x, y) atan2(y, x) - y/hypot(x, y); y/hypot(x, y) atan2(y, x) + x/hypot(x, y)", NO},
        /* gradients */
        {"sign(x) |x|^-0.5 + x/|x| - y; y/sqrt(y^2) - x", ENERGY}, /* each of its own place alone */
        {"-1/(x - y)^3; 1/(x - y)^3", ENERGY},
        {"-(x - 1)/((x - 1)^2 + y^2)^1.5 - x/(x^2 + y^2); -y/((x - 1)^2 + y^2)^1.5 - y/(x^2 + y^2)", PROVED},
        {"-sign(x) |x|^1.5", ENERGY},
        {"if(x > 1, floor(x), -x)", ENERGY},
        {"-x - 2 x y; -y - x^2 + y^2", ENERGY},
        {"-x + 3 y; -y + x", ENERGY},
        {"-x + 3 (0.1 y); -y + 0.3 x", ENERGY},
        {"-x/(x^2 + y^2)^1.5; -y/(x^2 + y^2)^1.5", ENERGY},
        {"-x/hypot(x, y)^3; -y/sqrt(x^2 + y^2)^3", ENERGY},
        {"-x/(x^2 + y^2 + 0.01)^1.5 - y; -y/(0.01 + y y + x x)^(3/2) - x", ENERGY},
        {"tanh(x - y) - |x - y|; tanh(y - x) + |x - y|", ENERGY},
        {"exp(y - x) - exp(x - z); exp(z - y) - exp(y - x); exp(x - z) - exp(z - y)", ENERGY},
        {"if(x^2 + y^2 < 1, -x, 0); if(x^2 + y^2 < 1, -y, 0)", ENERGY}, /* the jump is along the normal */
        {"y z; x z; x y", ENERGY},
        {"max(x y, 0) y; max(y x, 0) x", ENERGY},
        {"(x + y) mod(x + y, 2); (y + x) mod(y + x, 2)", ENERGY},
        {"cos(y) cosh(x) + atan(x y) y; -sin(y) sinh(x) + atan(x y) x", ENERGY},
        {"-x^3 - y^2 x/(x + y)^3 + y^2 x/(x + y)^3; -y", ENERGY},
        {"(x^2 - y^2)/(x - y) + y; x + y", PROVED}, /* a pole where there is none, 0/0: no more is said than is known */
        /* its potential is the angle: it grows at each turn */
        {"-y/(x^2 + y^2); x/(x^2 + y^2)", PROVED},
        /* at every time */
        {"-x cos(t) + y; x - y^3", PROVED},
        /* sin² = 1 - cos² is no identity of the algebra */
        {"-x sin(y)^2; -x^2 sin(y) cos(y) (sin(x)^2 + cos(x)^2)", SAMPLED},
        {"-x sin(y)^2 - |x|; -x^2 sin(y) cos(y) (sin(x)^2 + cos(x)^2) + if(t > 1000, y, 0)", SAMPLED},
        {"-x sin(y)^2; -x^2 sin(y) cos(y) (sin(x)^2 + cos(x)^2) + if(t > 1000, x, 0)", NO},
        {"-x sin(y)^2; -x^2 sin(y) cos(y) (sin(x)^2 + cos(x)^2) + max(x - 1000, 0)", NO},
    };
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++)
        judge(rows[k].forces, system_of(rows[k].forces), rows[k].answer);
}

static void families(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        answer answer;
    } rows[] = {
        {"m = [1, 3, 2, 0.5]\nr[i]'' = sum(j = 1..4, j != i: m[j] (r[j] - r[i])/|r[j] - r[i]|^3) for i = 1..4\n"
         "r[i](0) = (i, i^2, 0) for i = 1..4\nr[i]'(0) = (0, 0, 0) for i = 1..4\n",
         ENERGY},
        {"m = [1, 3, 2, 0.5]\nr[i]'' = sum(j = 1..4, j != i: (m[i] + m[j]^2) (r[j] - r[i])/|r[j] - r[i]|^3) for i = "
         "1..4\n"
         "r[i](0) = (i, i^2, 0) for i = 1..4\nr[i]'(0) = (0, 0, 0) for i = 1..4\n",
         NO},
        {"x[i]'' = x[i-1] - 2 x[i] + x[i+1] - x[i]^3 for i = 1..20\nx[0] = 0\nx[21] = sin(t)\nx[i](0) = i for i = "
         "1..20\n"
         "x[i]'(0) = 0 for i = 1..20\n",
         PROVED},
        {"x[i]'' = x[i-1] - 2 x[i] + 1.01 x[i+1] for i = 1..20\nx[0] = 0\nx[21] = 0\nx[i](0) = i for i = 1..20\n"
         "x[i]'(0) = 0 for i = 1..20\n",
         ENERGY}, /* the masses form a geometric series */
        {"x[i]'' = x[i-1] - 2 x[i] + (1 + 0.01 x[i]) x[i+1] for i = 1..20\nx[0] = 0\nx[21] = 0\nx[i](0) = i for i = "
         "1..20\n"
         "x[i]'(0) = 0 for i = 1..20\n",
         NO},
        {"x[i]'' = (x[i+1] - x[i])^7 - (x[i] - x[i-1])^7 for i = 1..5000\nx[0] = 0\nx[5001] = 0\n"
         "x[i](0) = sin(i) for i = 1..5000\nx[i]'(0) = 0 for i = 1..5000\n",
         SAMPLED}, /* too large for a proof */
        {"x[i]'' = (x[i+1] - x[i])^7 - 1.001 (x[i] - x[i-1])^7 for i = 1..5000\nx[0] = 0\nx[5001] = 0\n"
         "x[i](0) = sin(i) for i = 1..5000\nx[i]'(0) = 0 for i = 1..5000\n",
         NO},
    };
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++)
        judge(rows[k].text, given_text(rows[k].text), rows[k].answer);
}

/* The words change with the numbers. */
static void other_numbers(void **state)
{
    (void)state;
    motus_system *s = given_text("k = 0\nx'' = -x + k y\ny'' = -y\nx(0) = 1\ny(0) = 1\nx'(0) = 0\ny'(0) = 0\n");
    motus_error err = motus_default_error();
    const double k = 1e-9;
    assert_true(analysis_of(s).gradient);
    must(motus_system_set(s, "k", &k, 1, &err), &err, "k");
    assert_false(analysis_of(s).gradient);
    assert_false(says(s, "gradient"));
    motus_system_destroy(s);
}

static void velocity_terms(void **state)
{
    (void)state;
    static const row rows[] = {
        {"-x - if(t > 1000, 0.1 x', 0)", NO},
        {"-x - exp(-1000 (t - 50)^2) x'", NO},
        {"1e20 y' - x'; -1e20 x'", NO},
        {"y' - if(x > 50, x', 0); -x'", NO},
        {"y' - max(x - 50, 0) x'; -x'", NO},
        {"y'; -x' + 1e-12 y'", NO},
        {"x^2 y' - sin(t); -x x x'", PROVED},
        {"y' z - z' x; z' y - x' z; x' x - y' y", PROVED},
        {"if(x > 3, y', 0); -if(x > 3, 1, 0) x'", PROVED},
        {"y' (sin(x)^2 + cos(x)^2); -x'", SAMPLED},
        {"y' (sin(x)^2 + cos(x)^2) + if(t > 1000, y', 0); -x' - if(t > 1000, x', 0)", SAMPLED},
        {"y' (sin(x)^2 + cos(x)^2) + if(t > 1000, y', 0); -x' - if(t > 1000, y', 0)", NO},
    };
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        motus_system *s = system_of(rows[k].forces);
        const motus_analysis a = analysis_of(s);
        const answer got = !a.gyroscopic ? NO : a.sampled_gyroscopic ? SAMPLED : PROVED;
        if (got != rows[k].answer)
            fail_msg("%s: no work is %s, not %s\n%s", rows[k].forces, words[got], words[rows[k].answer],
                     motus_explain(s));
        assert_int_equal(says(s, "does no work"), got != NO);
        assert_int_equal(says(s, "as far as sampled"), got == SAMPLED);
        assert_int_equal(motus_method_admits(s, "boris", NULL), got == NO ? MOTUS_METHOD : MOTUS_OK);
        motus_system_destroy(s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gradients),
        cmocka_unit_test(families),
        cmocka_unit_test(other_numbers),
        cmocka_unit_test(velocity_terms),
    };
    return cmocka_run_group_tests_name("field", tests, NULL, NULL);
}
