/* The rules of the language, by number: the values of expressions, lines that --set replaces, and what is refused.
 *
 * Values are compared to the bit: the expressions are chosen so that every operation in them is exact, or the same as
 * in C. Complete files are in test/right; files that must be refused, with line, column and message, in test/wrong.
 */
#include "test/given.h"

#include <float.h>
#include <stdbool.h>

/* ---- one expression, evaluated at the start ---- */

/* x = 2, x' = 3, r = (1, 2, 3), r' = (4, 5, 6), s = 7, u[1…4] = 10 … 40, u[0] = u[5] = -1; u[i]' = i; t = 0 */
static const char given[] = "x'' = -x + 0 t\nx(0) = 2\nx'(0) = 3\n"
                            "r'' = -r\nr(0) = (1, 2, 3)\nr'(0) = (4, 5, 6)\n"
                            "s' = x\ns(0) = 7\n"
                            "N = 4\nu[i]'' = u[i+1] - u[i-1] for i = 1..N\nu[0] = -1\nu[N+1] = -1\nu[i](0) = 10 i for "
                            "i = 1..N\nu[i]'(0) = i for i = 1..N\n"
                            "a = 5\nb = 3\nbeta = 10\ngamma = 4\ne = 2\nxy = 100\ny = 8\ng = (0, -10)\nm = [3, 4, "
                            "5]\nplaces = [(1, 2), (3, 4)]\n"
                            "A[i,j] = 10 i + j for i = 1..2, j = 1..3\n";

typedef struct example {
    const char *expression;
    double value;
} example;

static motus_status read_text(const char *text, const char *const *set, size_t count, motus_system **s,
                              motus_error *err)
{
    motus_text_def def = motus_default_text();
    def.text = text;
    def.set = set;
    def.set_count = count;
    return motus_system_from_text(&def, s, err);
}

/* The column at the start; NaN and a message if it is refused. */
static double at_start(const char *text, const char *const *set, size_t count, const char *column)
{
    motus_system *s = NULL;
    motus_run *r = NULL;
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    size_t first = 0, n = 0;
    double value = NAN;
    def.step = 0.1;
    def.method = "rk4";
    if (read_text(text, set, count, &s, &err) == MOTUS_OK &&
        motus_column_find(s, column, &first, &n, &err) == MOTUS_OK) {
        motus_settings settings = motus_default_settings();
        motus_settings_of(s, &settings);
        def.until = settings.from + 1;
        if (n != 1)
            print_error("%s is %zu columns\n", column, n);
        else if (motus_run_create(s, &def, &r, &err) == MOTUS_OK)
            (void)motus_run_values(r, &first, 1, &value, &err);
    }
    if (err.message[0])
        print_error("%d:%d: %s (%s)\n    %s\n    %s\n", err.line, err.column, err.message, err.hint, err.source,
                    err.caret);
    motus_run_destroy(r);
    motus_system_destroy(s);
    return value;
}

static bool same(double a, double b) { return a == b || (isnan(a) && isnan(b)); }

/* ulps: how many units in the last place the value may be off; motus's elementary functions are within 1, and so are
 * those of C. */
static void examples(const example *e, size_t count, int ulps)
{
    int faults = 0;
    for (size_t i = 0; i < count; i++) {
        char text[4096];
        snprintf(text, sizeof text, "%swanted = %s\nlook = (wanted) + 0 t\n", given, e[i].expression);
        double got = at_start(text, NULL, 0, "look");
        double room = ulps * (nextafter(fabs(e[i].value), INFINITY) - fabs(e[i].value));
        if (!same(got, e[i].value) && !(fabs(got - e[i].value) <= room)) {
            print_error("%s is %.17g, not %.17g\n", e[i].expression, got, e[i].value);
            faults++;
        }
    }
    assert_int_equal(faults, 0);
}
#define EXAMPLES(...)                         \
    do {                                      \
        const example e[] = {__VA_ARGS__};    \
        examples(e, sizeof e / sizeof *e, 0); \
    } while (0)
#define EXAMPLES_NEAR(...)                    \
    do {                                      \
        const example e[] = {__VA_ARGS__};    \
        examples(e, sizeof e / sizeof *e, 2); \
    } while (0)

/* Expects a refusal: the status, and a part of the message or the hint. The column counts from the beginning of the
 * expression. */
typedef struct refusal {
    const char *expression;
    motus_status status;
    int column;
    const char *named;
} refusal;

static int line_of_expression(void)
{
    int line = 1;
    for (const char *p = given; *p; p++) line += *p == '\n';
    return line;
}

static void refusals(const refusal *e, size_t count)
{
    int faults = 0;
    for (size_t i = 0; i < count; i++) {
        char text[4096];
        motus_system *s = NULL;
        motus_error err = motus_default_error();
        snprintf(text, sizeof text, "%swanted = %s\n", given, e[i].expression);
        motus_status status = read_text(text, NULL, 0, &s, &err);
        if (status != e[i].status || err.line != line_of_expression() || err.column != 9 + e[i].column ||
            (!strstr(err.message, e[i].named) && !strstr(err.hint, e[i].named))) {
            print_error("%s: %s %d:%d %s (%s)\n    and not %s, column %d, naming %s\n", e[i].expression,
                        motus_status_word(status), err.line, err.column - 9, err.message, err.hint,
                        motus_status_word(e[i].status), e[i].column, e[i].named);
            faults++;
        }
        assert_true(status != MOTUS_OK ? s == NULL : s != NULL);
        motus_system_destroy(s);
    }
    assert_int_equal(faults, 0);
}
#define REFUSALS(...)                      \
    do {                                   \
        const refusal e[] = {__VA_ARGS__}; \
        refusals(e, sizeof e / sizeof *e); \
    } while (0)

static void rule_1_names_and_numbers(void **unused)
{
    (void)unused;
    EXAMPLES({"xy", 100}, {"x y", 16}, {"beta gamma e", 80}, {"2e3", 2000}, {"2e", 4}, {"2 e", 4}, {"2.5", 2.5},
             {"0.5e-1", 0.5e-1}, {"1E2", 100}, {"3x", 6}, {"2e1x", 40}, {"2pi", 2 * 3.14159265358979323846},
             {"1e+2", 100}, {"0.1", 0.1}, {"179769313486231570e291", 1.7976931348623157e308}, {"4.9e-324", 4.9e-324},
             {"1e-999", 0}, {"sum(i = 1..3: i)", 6}, {"007", 7}, {"2π", 2 * 3.14159265358979323846}, {"π x - pi x", 0},
             {"cos(π)", -1});
    REFUSALS({"1.", MOTUS_SYNTAX, 1, "1.0"}, {".5", MOTUS_SYNTAX, 1, "0.5"}, {"x.5", MOTUS_SYNTAX, 2, "0.5"},
             {"1.5.2", MOTUS_SYNTAX, 1, "one decimal"}, {"yx", MOTUS_NAME, 1, "write y x"},
             {"wx", MOTUS_NAME, 1, "not defined"});
}

static void rule_2_precedence(void **unused)
{
    (void)unused;
    EXAMPLES({"-x^2", -4}, {"-a x' + x", -13}, {"2^3^2", 512}, {"2^-1", 0.5}, {"x^+2", 4}, {"2^-x^2", 0.0625},
             {"12/x/b", 2}, {"12/x*b", 18}, {"a - b - x", 0}, {"a - (b - x)", 4}, {"2x^2", 8}, {"2x^2y", 64},
             {"a b^2", 45}, {"2 x y", 32}, {"(2)(3)", 6}, {"2(3)", 6}, {"x'^2", 9}, {"x' x", 6}, {"r.x^2 + r.z", 4},
             {"r'.y^2", 25}, {"2r.y", 4}, {"r[3]^2", 9}, {"u[2]^2", 400}, {"u[2]'^2", 4}, {"2u[3]'", 6},
             {"u[1]' u[2]", 20}, {"2*-3", -6}, {"6/-3", -2}, {"a*b + x*y", 31}, {"+a", 5}, {"-(-a)", 5},
             {"if(1 + 1 == 2, 1, 0)", 1}, {"if(not 1 > 2 and 2 > 1, 1, 0)", 1},
             {"if(1 > 2 and 1 > 2 or 2 > 1, 1, 0)", 1}, {"if(2 > 1 or 1 > 2 and 1 > 2, 1, 0)", 1},
             {"if(not (1 > 2 or 2 > 1), 1, 0)", 0}, {"-2^2", -4});
}

static void rule_2_juxtaposition(void **unused)
{
    (void)unused;
    EXAMPLES({"2 x", 4}, {"2 sin(0) x", 0}, {"x |x'|", 6}, {"2|x|", 4}, {"(a)(b)x", 30}, {"a (b)", 15}, {"x' y", 24},
             {"dot(r, r) x", 28}, {"2 sum(i = 1..2: i) x", 12}, {"2·x", 4}, {"a × b", 15}, {"a⋅x ∗ 2·3", 60},
             {"1/2·x", 1}, {"x·-b − a", -11});
    REFUSALS({"x 2", MOTUS_SYNTAX, 1, "2 x"}, {"2 3^2", MOTUS_SYNTAX, 1, "2*3"}, {"(r 2).x", MOTUS_SYNTAX, 2, "2 r"},
             {"2 3", MOTUS_SYNTAX, 1, "write 2*3, or 2.3 for"}, {"0.5 1.2 x", MOTUS_SYNTAX, 1, "write 0.5*1.2"},
             {"(a)2", MOTUS_SYNTAX, 1, "2 (a)"}, {"x' 2", MOTUS_SYNTAX, 1, "2 x'"},
             {"sin(x) 2", MOTUS_SYNTAX, 1, "2 sin(x)"}, {"|x| 2", MOTUS_SYNTAX, 1, "2 |x|"},
             {"a b 2", MOTUS_SYNTAX, 3, "2 b"}, {"a - -b", MOTUS_SYNTAX, 5, "bracket"},
             {"1 < x > 3", MOTUS_SYNTAX, 7, "1 < x and x > 3"}, {"x**2", MOTUS_SYNTAX, 2, "^"});
}

/* There is no decimal number 0.5.1.2 to be offered. */
static void rule_2_two_decimal_numbers(void **unused)
{
    (void)unused;
    motus_system *s = NULL;
    motus_error err = motus_default_error();
    assert_int_equal(read_text("z'' = 0.5 1.2 z'\nz(0) = 1\nz'(0) = 0\n", NULL, 0, &s, &err), MOTUS_SYNTAX);
    assert_string_equal(err.hint, "write 0.5*1.2");
}

static void rule_3_division(void **unused)
{
    (void)unused;
    EXAMPLES({"a x^2/2", 10}, {"(1/2) x", 1}, {"1/(2 x)", 0.25}, {"1/2*x", 1}, {"1/x + y", 8.5}, {"1/2 - x", -1.5},
             {"a b/b", 5}, {"12/x/b", 2}, {"1/x^2", 0.25}, {"1/sin(x)", 1 / sin(2)}, {"a/(x) + 0", 2.5}, {"1/|x|", 0.5},
             {"1/2*x y", 8});
}

/* A factor behind a blank multiplies the quotient, from the left: a is 5, b 3, x 2, x' 3, y 8, e 2, u[2] 20, m[1] 3. */
static void rule_3_a_factor_after_a_quotient(void **unused)
{
    (void)unused;
    EXAMPLES({"1/2 x", 1}, {"-1/2 x", -1}, {"3/2 x^2", 6}, {"a/2 (y - x)", 15}, {"a/2 |-y|", 20}, {"12/b sin(0)", 0},
             {"a/2 pi", 2.5 * 3.14159265358979323846}, {"1/2 x'^2", 4.5}, {"1/2 a |r'|^2", 2.5 * 77}, {"a/2 y*b", 60},
             {"a/2*b y", 60}, {"a/2 x/5", 1}, {"1/2 a x b", 15}, {"6/b y/x e", 16}, {"1/-2 x", -1}, {"a/x^2 y", 10},
             {"1/2 u[2]", 10}, {"1/2 m[1]", 1.5}, {"1/2 r.y", 1}, {"(1/2 r).z", 1.5}, {"a/(x) (y)", 20},
             {"a/|x| (y)", 20}, {"6/2 x(0)", 6}, {"1/sqrt(4) x", 1}, {"(1/2\n x)", 1}, {"1 / 2 x", 1},
             {"1/2 x - 1/2 y", -3}, {"2^(1/2 x)", 2}, {"|1/2 x - 3|", 2}, {"max(1/2 y, 1)", 4},
             {"1/2 sum(i = 1..3: i)", 3}, {"1/2 dot(r, r) x", 14});
    REFUSALS({"1/2x", MOTUS_SYNTAX, 3, "1/2 x, with a blank, for (1/2) x; or 1/(2 x)"},
             {"a/2b", MOTUS_SYNTAX, 3, "a/(2 b)"}, {"1/2(x)", MOTUS_SYNTAX, 3, "1/2 (x), with a blank"},
             {"a/b(x)", MOTUS_SYNTAX, 3, "b (x), with a blank, to multiply the quotient; (b (x))"},
             {"a/(b)x", MOTUS_SYNTAX, 3, "or a/((b) x)"}, {"a/(b)(x)", MOTUS_SYNTAX, 3, "a/(b) (x)"},
             {"a/2|x|", MOTUS_SYNTAX, 3, "a/2 |x|"}, {"a/|b||x|", MOTUS_SYNTAX, 3, "a/|b| |x|"},
             {"a/2sin(x)", MOTUS_SYNTAX, 3, "a/2 sin(x)"}, {"a/2pi", MOTUS_SYNTAX, 3, "a/(2 pi)"},
             {"a/b^2(x)", MOTUS_SYNTAX, 3, "a/b^2 (x)"}, {"a/x'y", MOTUS_SYNTAX, 3, "a/x' y"},
             {"a/2 x/3y", MOTUS_SYNTAX, 7, "a/2 x/3 y"}, {"a*b/2x", MOTUS_SYNTAX, 5, "(a*b/2) x"},
             {"1/x 2", MOTUS_SYNTAX, 3, "1/x*2 or 1/(x*2)"}, {"1/2 3", MOTUS_SYNTAX, 3, "1/2*3 or 1/(2*3)"},
             {"a/b [1, 2]", MOTUS_SYNTAX, 5, ""}, {"a/x (0)", MOTUS_SYNTAX, 3, "x*(0)"});
}

static void rule_4_brackets_behind_names(void **unused)
{
    (void)unused;
    EXAMPLES({"abs (-3)", 3}, {"sqrt(16)", 4}, {"x(0)", 2}, {"x'(0)", 3}, {"r'(0).y", 5}, {"u[2](0)", 20},
             {"u[2]'(0) y", 16}, {"x(0)^2", 4}, {"2x(0) y", 32}, {"x(1 - 1)", 2}, {"a (b)", 15}, {"a (2 abs(-1))", 10},
             {"x (x + 1)", 6}, {"x*(3)", 6}, {"beta (x)", 20}, {"pi (2)", 2 * 3.14159265358979323846}, {"t (2)", 0},
             {"s(0)", 7}, {"x'(0) t + 1", 1}, {"2(a)", 10}, {"r(0).z y", 24}, {"dot(r(0), r'(0))", 32});
}

static void rule_4_refused(void **unused)
{
    (void)unused;
    REFUSALS({"beta(x)", MOTUS_SYNTAX, 1, "write beta*(x) or beta (x)"}, {"f(t)", MOTUS_NAME, 1, "f"},
             {"t(2)", MOTUS_SYNTAX, 1, "t*(2)"}, {"π(2)", MOTUS_SYNTAX, 1, "pi*(2)"},
             {"x (0)", MOTUS_SYNTAX, 1, "x(0)"}, {"x (a)", MOTUS_SYNTAX, 1, "x*(a)"},
             {"x (y)", MOTUS_SYNTAX, 1, "x*(y)"}, {"x' (0)", MOTUS_SYNTAX, 1, "x'(0)"},
             {"u[1] (0)", MOTUS_SYNTAX, 1, "u[1](0)"}, {"x(t)", MOTUS_SHAPE, 1, "x*("},
             {"x(1)", MOTUS_SHAPE, 1, "start is 0"}, {"x''(0)", MOTUS_SHAPE, 1, "equation"},
             {"sinn(x)", MOTUS_NAME, 1, "sin"}, {"u(0)", MOTUS_SHAPE, 1, "u"}, {"xy(2)", MOTUS_SYNTAX, 1, "xy*(2)"},
             {"2 a(x)", MOTUS_SYNTAX, 3, "a*(x)"}, {"m(1)", MOTUS_SYNTAX, 1, "not a function"},
             {"f(x, y)", MOTUS_NAME, 1, "f(…) = …"}, {"a(x, y)", MOTUS_SYNTAX, 1, "not a function"},
             {"x(0, 1)", MOTUS_SHAPE, 1, "not a function"});
}

static void rule_5_functions(void **unused)
{
    (void)unused;
    EXAMPLES_NEAR({"sin(x)", sin(2)}, {"cos(x)", cos(2)}, {"tan(x)", tan(2)}, {"asin(x/4)", asin(0.5)},
                  {"acos(x/4)", acos(0.5)}, {"atan(x)", atan(2)}, {"atan2(-x, -b)", atan2(-2, -3)},
                  {"sinh(x)", sinh(2)}, {"cosh(x)", cosh(2)}, {"tanh(x)", tanh(2)}, {"exp(x)", exp(2)},
                  {"log(x)", log(2)}, {"sqrt(x)", sqrt(2)}, {"cbrt(27)", 3}, {"hypot(3, 4)", 5});
    EXAMPLES({"abs(-x)", 2}, {"min(x, a, -1)", -1}, {"max(x, a, -1)", 5}, {"floor(-2.5)", -3}, {"mod(7, 3)", 1},
             {"mod(-1, 3)", 2}, {"sign(-3)", -1}, {"sign(0)", 0}, {"x^a", 32}, {"2^x", 4});
    EXAMPLES_NEAR({"erf(0.5)", erf(0.5)}, {"sin(x)^2", sin(2) * sin(2)}, {"x^0.5", pow(2, 0.5)}, {"sin (x)", sin(2)},
                  {"atan2(1, 0)", atan2(1, 0)});
    REFUSALS({"sin x", MOTUS_SYNTAX, 1, "sin(x)"}, {"sin 2", MOTUS_SYNTAX, 1, "sin(2)"},
             {"sin^2(x)", MOTUS_SYNTAX, 1, "sin(x)^2"}, {"sin", MOTUS_SYNTAX, 1, "sin("},
             {"2 cos x", MOTUS_SYNTAX, 3, "cos(x)"}, {"sin + 1", MOTUS_SYNTAX, 1, "sin("},
             {"atan2(x)", MOTUS_SYNTAX, 1, "2 arguments"}, {"sin(x, y)", MOTUS_SYNTAX, 1, "1 argument"},
             {"min(x)", MOTUS_SYNTAX, 1, "at least 2"}, {"sin|x|", MOTUS_SYNTAX, 1, "sin("},
             {"sqrt x", MOTUS_SYNTAX, 1, "sqrt(x)"});
}

static void rule_6_primes(void **unused)
{
    (void)unused;
    EXAMPLES({"x'", 3}, {"x''", -2}, {"r'.x", 4}, {"r''.z", -3}, {"u[3]'", 3}, {"u[2]''", 20}, {"s'", 2}, {"s", 7},
             {"x′", 3}, {"x’", 3}, {"x″", -2}, {"x′′", -2}, {"−x", -2}, {"2 − x", 0}, {"x'x", 6}, {"2x'", 6});
    REFUSALS({"(x y)'", MOTUS_SYNTAX, 6, "name"}, {"x^2'", MOTUS_SYNTAX, 4, "name"}, {"x'''", MOTUS_SYNTAX, 2, "x''"},
             {"x‴", MOTUS_SYNTAX, 2, "x''"}, {"a'", MOTUS_NAME, 1, "parameter"}, {"r.x'", MOTUS_SYNTAX, 4, "r'.x"},
             {"r[1]'", MOTUS_SHAPE, 1, "r'[…]"}, {"x '", MOTUS_SYNTAX, 3, "directly"},
             {"x(0)'", MOTUS_SYNTAX, 5, "x'(0)"}, {"s''", MOTUS_SHAPE, 1, "first order"},
             {"u[0]''", MOTUS_NAME, 1, "no equation"}, {"sum(i = 0..2: u[i]'')", MOTUS_NAME, 15, "u[0]''"},
             {"t'", MOTUS_SHAPE, 1, "primes"}, {"m[1]'", MOTUS_NAME, 1, "primes"},
             {"sin'(x)", MOTUS_SYNTAX, 4, "primes"}, {"|x|'", MOTUS_SYNTAX, 4, ""});
}

static void rule_7_bars(void **unused)
{
    (void)unused;
    EXAMPLES({"a |r'|^2/2", 192.5}, {"x' |x'|", 9}, {"|-x| b |-y|", 48}, {"|x - |y||", 6}, {"||x| - a|", 3},
             {"|x||y|", 16}, {"|(|x| - |y|)|", 6}, {"|x| + |y|", 10}, {"-|x|", -2}, {"2|x|/|y|", 0.5}, {"|r|^2", 14},
             {"|r|^4", 196}, {"|r|", sqrt(14)}, {"|r|^3", 14 * sqrt(14)}, {"|r - r'|^2", 27}, {"|(3, 4)|", 5},
             {"sin(|x|)", sin(2)}, {"|x|^2", 4}, {"if(|x| > 1, |y|, 0)", 8}, {"|u[1] - u[2]|", 10}, {"(|x|)", 2},
             {"|m[|-1|]|", 3}, {"|-3|", 3}, {"|x|^-1", 0.5}, {"x |y| b", 48}, {"|(x |-y|)|", 16},
             {"|max(x |y|, 1) - 20|", 4});
    REFUSALS({"|x", MOTUS_SYNTAX, 1, "abs("}, {"a |", MOTUS_SYNTAX, 4, ""}, {"(|x)", MOTUS_SYNTAX, 2, "closed"},
             {"||", MOTUS_SYNTAX, 3, ""});
}

static void rule_8_lines(void **unused)
{
    (void)unused;
    EXAMPLES({"(1 +\n 2\n + 3)", 6}, {"1 +\n 2", 3}, {"1 -   # a remark\n\n 2", -1}, {"\n 4", 4}, {"max(1,\n 7)", 7},
             {"2 *\n3", 6}, {"12 /\n3", 4}, {"2^\n3", 8}, {"m[\n2\n]", 4}, {"if(1 <\n 2 and\n 3 > 2, 1, 0)", 1},
             {"sum(\ni = 1..3,\n i != 2:\n i)", 4}, {"if(not\n1 > 2, 1, 0)", 1}, {"-\n3", -3});
    assert_true(at_start("x'' =\n -x\nx(0) = 3\r\n\tx'(0) = 0# no blank\n\n\n#end", NULL, 0, "x") == 3);
    motus_system *s = given_text("x'' = -k x; k = 2;; x(0) = 3; x'(0) = 0 # one; two\n;method rk4; step 0.5; until 2;");
    motus_settings m = motus_default_settings();
    motus_settings_of(s, &m);
    assert_string_equal(m.method, "rk4");
    assert_true(m.step == 0.5 && m.until == 2);
    assert_string_equal(motus_equation_text(s, 0), "x'' = -k x");
    motus_system_destroy(s);
}

static void rule_9_shapes(void **unused)
{
    (void)unused;
    EXAMPLES({"(2 r).y", 4}, {"(r/2).z", 1.5}, {"(r - r').x", -3}, {"(-r).x", -1}, {"dot(r, r')", 32},
             {"cross(r, r').x", -3}, {"cross(r, r').y", 6}, {"cross(r, r').z", -3}, {"cross((1, 2), (3, 4))", -2},
             {"(x r).z", 6}, {"(if(x > 0, r, r')).y", 2}, {"(r x).z", 6}, {"sum(i = 1..2: i r).z", 9},
             {"(1, 2, 3, 4, 5)[5]", 5}, {"g.y", -10}, {"g[2]", -10}, {"dot(g, (1, 2))", -20}, {"(2 places[2]).y", 8},
             {"(a g/b).y", -50.0 * (1.0 / 3)}, {"r · r'", 32}, {"(r × r').y", 6}, {"(1, 2) × (3, 4)", -2},
             {"1/2 r ⋅ r'/2", 8}, {"(r × (r' × r)).x + 0", 24}, {"(x × r).z", 6}, {"2 × a × (1, 1) · (3, 4)", 70},
             {"(r · r) × a", 70}, {"(r × r' a/b).y", 10}, {"r · r' x × a", 320});
    REFUSALS({"r r'", MOTUS_SHAPE, 1, "dot(r, r'), cross(r, r')"}, {"r*r", MOTUS_SHAPE, 1, "|v|^2"},
             {"r^2", MOTUS_SHAPE, 1, "|r|^2"}, {"1/r", MOTUS_SHAPE, 1, "|r|"}, {"r + 1", MOTUS_SHAPE, 1, "|r|"},
             {"1 - r", MOTUS_SHAPE, 1, "|r|"}, {"r + (1, 2)", MOTUS_SHAPE, 1, "length 2"},
             {"sin(r)", MOTUS_SHAPE, 5, "|r|"}, {"dot(r, g)", MOTUS_SHAPE, 1, "equal length"},
             {"dot(x, x)", MOTUS_SHAPE, 1, "vectors"}, {"cross(w4, w4)", MOTUS_NAME, 7, "w4"},
             {"x.x", MOTUS_SHAPE, 1, "no components"}, {"r[4]", MOTUS_SHAPE, 3, "1 to 3"},
             {"r[0]", MOTUS_SHAPE, 3, "1 to 3"}, {"g.z", MOTUS_SHAPE, 3, "1 to 2"},
             {"r.w", MOTUS_SYNTAX, 3, ".x .y .z"}, {"2^r", MOTUS_SHAPE, 3, "exponent"},
             {"(r, 1)", MOTUS_SHAPE, 2, "component"}, {"if(x > 0, r, 0)", MOTUS_SHAPE, 1, "fit"},
             {"min(r, r)", MOTUS_SHAPE, 5, "vector"}, {"r < r'", MOTUS_SHAPE, 1, "comparison"},
             {"r × r' × r", MOTUS_SHAPE, 1, "write brackets: (r × r') …"},
             {"r · r × r'", MOTUS_SHAPE, 1, "multiplied first"}, {"r × r' a × r", MOTUS_SHAPE, 1, "multiplied first"},
             {"r × g", MOTUS_SHAPE, 1, "length 3"}, {"(x > 0) + r", MOTUS_SHAPE, 1, "a number and a vector"},
             {"(x > 0).x", MOTUS_SHAPE, 1, "a condition"});
}

static void rule_10_parameters_and_quantities(void **unused)
{
    (void)unused;
    const char *text = "p = 2 q\nq = 3\nmoves = p x\nalso = moves + 1\ntimed = t\nx'' = -p x\nx(0) = p + q\nx'(0) = "
                       "0\nlist = [q, 2 q]\n"
                       "w = (q, p)\nf = list[2] + w.y + 0 t\nr'' = -r\nr(0) = w\nr'(0) = (0, 0)\n";
    assert_true(at_start(text, NULL, 0, "moves") == 54);
    assert_true(at_start(text, NULL, 0, "also") == 55);
    assert_true(at_start(text, NULL, 0, "timed") == 0);
    motus_system *s = given_text(text);
    assert_int_equal(motus_quantity_count(s), 4);
    size_t first, count;
    motus_error err = motus_default_error();
    /* a parameter has no column */
    assert_int_equal(motus_column_find(s, "p", &first, &count, &err), MOTUS_NAME);
    motus_system_destroy(s);
}

typedef struct setting {
    const char *set, *column;
    double value;
} setting;

static double quantity(motus_system *s, const char *name)
{
    motus_run *r = given_run(s, "rk4", 1, 1);
    size_t at, count;
    double value;
    motus_error err = motus_default_error();
    must(motus_column_find(s, name, &at, &count, &err), &err, name);
    must(motus_run_values(r, &at, 1, &value, &err), &err, name);
    motus_run_destroy(r);
    return value;
}

/* Of lines about the same place that with fewer indices holds; what is set holds before all. */
static void rule_10_families_by_places(void **state)
{
    (void)state;
    const char text[] =
        "q = 3\nk[i] = 1 + q/10 for i = 1..4\nk[3] = 2 q\nc[1,j] = 100 + j for j = 1..3\nc[2,2] = 7\n"
        "c[i,j] = i + j for i = 1..2, j = 1..3\nd[1] = 5\nd[2] = d0\nd0 = 6\nx'' = -x\nx(0) = 1\nx'(0) = 0\n"
        "K[i] = k[i] + 0 t for i = 1..4\nC[i,j] = c[i,j] + 0 t for i = 1..2, j = 1..3\nD = d[1] + d[2] + 0 t\n";
    motus_system *s = given_text(text);
    assert_true(quantity(s, "K[1]") == 1.3 && quantity(s, "K[3]") == 6 && quantity(s, "K[4]") == 1.3);
    assert_true(quantity(s, "C[1,3]") == 103 && quantity(s, "C[2,2]") == 7 && quantity(s, "C[2,3]") == 5);
    assert_true(quantity(s, "D") == 11);
    const double q = 10, all[] = {1, 2, 3, 4};
    motus_error err = motus_default_error();
    must(motus_system_set(s, "q", &q, 1, &err), &err, "q"); /* each line again, in its places alone */
    assert_true(quantity(s, "K[1]") == 2 && quantity(s, "K[3]") == 20 && quantity(s, "K[4]") == 2);
    must(motus_system_set(s, "k", all, 4, &err), &err, "k");
    assert_true(quantity(s, "K[3]") == 3);
    motus_system_destroy(s);
    const char *const set[] = {"k[3]=9", "k[4]=8", "q=10"};
    s = given_text_with(text, set, 3, text);
    assert_true(quantity(s, "K[2]") == 2 && quantity(s, "K[3]") == 9 && quantity(s, "K[4]") == 8);
    motus_system_destroy(s);
    const char *const family[] = {"k[i]=i for i = 1..4"};
    s = given_text_with(text, family, 1, text);
    assert_true(quantity(s, "K[3]") == 3);
    motus_system_destroy(s);
}

static void rule_10_set(void **unused)
{
    (void)unused;
    const char *text = "p = 2 q\nq = 3\nx'' = -p x\nx(0) = p + q\nx'(0) = 0\nlist = [q, 2 q]\nw = (q, p)\nf = list[2] "
                       "+ w.y + 0 t\nh = list[1] + 0 t\n"
                       "r'' = -r\nr(0) = w\nr'(0) = (0, 0)\nu[i]'' = 0 for i = 1..3\nu[i](0) = i for i = "
                       "1..3\nu[i]'(0) = 0 for i = 1..3\nu[3](0) = 33\nu[1](0) = u[3](0)\nN = 1\n";
    static const setting one[] = {
        {"q=4", "x", 12},
        {"p=7", "x", 10},
        {"p = q^2", "x", 12},
        {"x(0)=p", "x", 6},
        {"x'(0)=-1", "x'", -1},
        {"list=[7, 8]", "h", 7},
        {"list=[1, 5]", "f", 11},
        {"w=(1, 2)", "r.y", 2},
        {"r(0)=(8, 9)", "r.y", 9},
        {"u[i](0) = 10 i for i = 1..3", "u[2]", 20},
        {"u[2](0) = 77", "u[2]", 77},
        {"u[2](0) = 77", "u[3]", 33},
        {"u[3](0) = 77", "u[3]", 77},
        {"u[3](0) = 77", "u[1]", 77},
        {"u[i](0) = 10 i for i = 1..3", "u[3]", 30},
        {"u[i](0) = 10 i for i = 2..3", "u[1]", 30},
        {"u[i](0) = 10 i for i = 1..2", "u[3]", 33},
        {"r'(0)=(1, 2)", "r'.x", 1},
        {"  q = 5 ", "x", 15},
        {"q=1e-3", "r.x", 1e-3},
    };
    for (size_t i = 0; i < sizeof one / sizeof *one; i++) {
        double got = at_start(text, &one[i].set, 1, one[i].column);
        if (got != one[i].value)
            fail_msg("--set \"%s\": %s is %.17g, not %.17g", one[i].set, one[i].column, got, one[i].value);
    }
    const char *both[] = {"q=1", "p=q + 1"};
    assert_true(at_start(text, both, 2, "x") == 3);
}

static void rule_10_set_refused(void **unused)
{
    (void)unused;
    const char *text = "p = 2\nmoves = p x\nx'' = -p x\nx(0) = 1\nx'(0) = 0\ninvariant E = x\nmethod rk4\nm = [1, 2]\n"
                       "u[i]'' = u[i-1] for i = 1..2\nu[0] = 1\nu[i](0) = 0 for i = 1..2\nu[i]'(0) = 0 for i = 1..2\n";
    static const struct {
        const char *set;
        motus_status status;
        const char *named;
    } wrong[] = {
        {"moves=3", MOTUS_ARGUMENT, "quantity"},
        {"E=3", MOTUS_NAME, "E"},
        {"pp=3", MOTUS_NAME, "did you mean p?"},
        {"p", MOTUS_SYNTAX, "="},
        {"p=", MOTUS_SYNTAX, "value"},
        {"", MOTUS_SYNTAX, "F=0.2"},
        {"p=(1, 2)", MOTUS_SHAPE, "vector"},
        {"x''=-x", MOTUS_ARGUMENT, "parameters and initial values"},
        {"method rk4", MOTUS_ARGUMENT, "`method = rk4` of the definition"},
        {"p=1\nq=2", MOTUS_SYNTAX, "one definition"},
        {"p=1 2", MOTUS_SYNTAX, "1*2"},
        {"x=3", MOTUS_ARGUMENT, "x(0)"},
        {"u[0]=3", MOTUS_ARGUMENT, "u[…](0)"},
        {"m[9]=3", MOTUS_ARGUMENT, "entries have the numbers 1 to"},
        {"x[1](0)=3", MOTUS_SHAPE, "family"},
        {"u(0)=3", MOTUS_SHAPE, "u[i]"},
        {"y(0)=1", MOTUS_NAME, "y"},
        {"x(1)=1", MOTUS_ARGUMENT, "start"},
        {"p=p", MOTUS_NAME, "circle"},
        {"p=1/0", MOTUS_ARGUMENT, "finite"},
        {"x''(0)=1", MOTUS_SYNTAX, "equation"},
        {"step=0.1", MOTUS_ARGUMENT, "`step = 0.1` of the definition"},
    };
    int faults = 0;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        motus_system *s = NULL;
        motus_error err = motus_default_error();
        motus_status status = read_text(text, &wrong[i].set, 1, &s, &err);
        if (status != wrong[i].status || (!strstr(err.message, wrong[i].named) && !strstr(err.hint, wrong[i].named))) {
            print_error("--set \"%s\": %s: %s (%s)\n", wrong[i].set, motus_status_word(status), err.message, err.hint);
            faults++;
        }
        motus_system_destroy(s);
    }
    assert_int_equal(faults, 0);
}

static void rule_11_indices(void **unused)
{
    (void)unused;
    EXAMPLES({"u[N]", 40}, {"u[N+1]", -1}, {"u[0]", -1}, {"u[1 + 2 - 1]", 20}, {"sum(i = 1..N: u[i])", 100},
             {"sum(i = 1..N: u[i+1])", 89}, {"sum(i = 1..N: u[mod(i, N)+1])", 100},
             {"sum(i = 1..1: u[mod(i - 2, N) + 1])", 40}, {"sum(i = 3..3: u[mod(2 + i, N)+1])", 20}, {"A[2,3]", 23},
             {"sum(i = 1..2, j = 1..3: A[i,j])", 102}, {"sum(i = 1..2: A[i,i+1])", 35}, {"m[2]", 4}, {"places[2].y", 4},
             {"places[2][1]", 3}, {"sum(i = 1..3: m[i] u[i])", 260}, {"r[2]", 2}, {"r'[2]", 5}, {"(r)[3]", 3},
             {"u[2*2 - 3]", 10}, {"u[b]", 30}, {"u[a - b]", 20}, {"sum(i = -1..0: u[1 - (-i) + 1 - 1])", -1 + 10},
             {"A[1,1]", 11});
    REFUSALS({"u[6]", MOTUS_NAME, 1, "u[6]"}, {"u[-1]", MOTUS_NAME, 1, "u[-1]"},
             {"sum(i = 1..N+2: u[i])", MOTUS_NAME, 17, "u[6]"}, {"sum(i = 1..2: u[2i])", MOTUS_SHAPE, 17, "i + c"},
             {"sum(i = 1..2: u[N - i])", MOTUS_SHAPE, 21, "i + c"},
             {"sum(i = 1..2: u[mod(i, N)])", MOTUS_SHAPE, 17, "+ 1"}, {"u[1.5]", MOTUS_SHAPE, 3, "whole"},
             {"u[x]", MOTUS_SHAPE, 3, "state"}, {"u", MOTUS_SHAPE, 1, "u[i]"}, {"m", MOTUS_SHAPE, 1, "m[1]"},
             {"m[4]", MOTUS_NAME, 3, "1 to 3"}, {"m[0]", MOTUS_NAME, 3, "1 to 3"},
             {"u[1,2]", MOTUS_SHAPE, 1, "1 index"}, {"A[1]", MOTUS_SHAPE, 1, "2 indices"},
             {"a[1]", MOTUS_SHAPE, 1, "one number"}, {"2 [1, 2]", MOTUS_SYNTAX, 3, ""},
             {"u [1]", MOTUS_SYNTAX, 3, "directly"}, {"u[1][2]", MOTUS_SHAPE, 1, "no components"},
             {"u[]", MOTUS_SYNTAX, 3, ""});
}

static void rule_12_sums(void **unused)
{
    (void)unused;
    EXAMPLES({"sum(j = 1..0: 1/0)", 0}, {"sum(j = 5..3: j)", 0}, {"sum(j = 1..4, j != 2: 1/(j - 2))", -1 + 1 + 0.5},
             {"sum(j = 1..N, j > 1, j < 4: j)", 5}, {"sum(i = 1..3, j = i+1..3: 10 i + j)", 12 + 13 + 23},
             {"sum(i = 1..2: i sum(j = 1..i: j))", 1 + 2 * 3}, {"2 sum(j = 1..3: j)^2", 72}, {"sum(j = 1..1: 7)", 7},
             {"sum(j = 1..100: j)", 5050}, {"sum(j = 1..17: j)", 153}, {"sum(j = -2..2: j^2)", 10},
             {"sum(j = 1..3, j == 2 or j == 3: j)", 5}, {"sum(i = 1..3, i > 3: 1)", 0},
             {"(sum(i = 1..2: places[i])).y", 6}, {"sum(i = 1..3: x)", 6},
             {"sum(i = 1..2, j = 1..2, k = 1..2: i j k)", 27});
    REFUSALS({"sum(x)", MOTUS_SYNTAX, 5, "index"}, {"sum(i = 1..3)", MOTUS_SYNTAX, 13, ":"},
             {"sum(i = 1: i)", MOTUS_SYNTAX, 10, ".."}, {"sum(i = 1..3, i: i)", MOTUS_SHAPE, 15, "condition"},
             {"sum(a = 1..3: a)", MOTUS_NAME, 5, "a"}, {"sum(i = 1..2: sum(i = 1..2: i))", MOTUS_SHAPE, 19, "twice"},
             {"sum(i = 1..x: i)", MOTUS_SHAPE, 12, "state"},
             {"sum(i = 1..2, 1 < 2, j = 1..2: i)", MOTUS_SYNTAX, 22, "before the conditions"},
             {"i", MOTUS_NAME, 1, "not defined"}, {"sum i", MOTUS_SYNTAX, 1, "sum"},
             {"sum(i = 1..1e9, j = 1..1e9: 1)", MOTUS_LIMIT, 1, "terms"});
}

/* A masked term is not selected rather than multiplied by zero: the NaN of 0/0 does not enter. */
static void rule_12_masks_select(void **unused)
{
    (void)unused;
    EXAMPLES({"sum(j = 1..3, j != 2: (x - 2)/(j - 2) + 1)", 2},
             {"sum(i = 1..4, j = 1..4, i != j: u[i]/(u[i] - u[j]))", 6});
}

static void rule_14_conditions(void **unused)
{
    (void)unused;
    EXAMPLES({"(x > 0) a", 5}, {"a (x < 0) y", 0}, {"(x > 0)*(y > 0) a", 5}, {"(x > 0) (y < 0) + 1", 1},
             {"(x > 1 and y > 1) r.z", 3}, {"((x > 0) r).y", 2}, {"(r (x < 0)).y", 0}, {"(x > 0) a/2", 2.5},
             {"-(x > 0) a", -5}, {"diff((x > 0) x^2, x)", 4});
    EXAMPLES({"if(x > 0, 1, 0)", 1}, {"if(x < 0, 1/0, 4)", 4}, {"if(x > 0, 4, sqrt(-x))", 4}, {"if(x >= 2, 1, 0)", 1},
             {"if(x <= 1, 1, 0)", 0}, {"if(x == 2, 1, 0)", 1}, {"if(x != 2, 1, 0)", 0}, {"if(x ≠ 2, 1, 0)", 0},
             {"if(x ≤ 2, 1, 0)", 1}, {"if(x ≥ 3, 1, 0)", 0}, {"x''", -2}, {"x'' + x", 0}, {"s' + u[1]''", 2 + 21});
    REFUSALS({"if(x, 1, 0)", MOTUS_SHAPE, 4, "x != 0"}, {"if(x > 0, 1)", MOTUS_SYNTAX, 1, "3 arguments"},
             {"if(x = 0, 1, 0)", MOTUS_SYNTAX, 6, "=="}, {"x and y", MOTUS_SHAPE, 1, "x != 0"},
             {"not x", MOTUS_SHAPE, 5, "x != 0"}, {"1 == x != 2", MOTUS_SYNTAX, 8, "1 == x and x != 2"},
             {"1 != x != 2", MOTUS_SYNTAX, 8, "goes one way"});
}

/* Nor in derivatives: Newton's method on this force meets the derivative of the branch not taken, which is NaN at x =
 * 0. */
static void rule_14_no_leak_in_derivatives(void **unused)
{
    (void)unused;
    motus_system *s = given_text(
        "x'' = if(x > 1, sqrt(x - 1) x', -x') - x\nx(0) = 0\nx'(0) = 0.5\nstep 0.1\nuntil 1\nmethod implicit-midpoint");
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    double x;
    must(motus_run_create(s, &def, &r, &err), &err, "create");
    must(motus_run_finish(r, &err), &err, "finish");
    must(motus_run_state(r, &x, NULL, &err), &err, "state");
    assert_true(isfinite(x) && x > 0);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* Chains of multiplications, fused multiply-adds, one quotient per vector, left-to-right and interleaved sums: to the
 * bit. */
static void rule_15_normal_form(void **unused)
{
    (void)unused;
    const double d = 0.1, q = 0.7;
    double parts[8] = {0};
    for (int j = 1; j <= 20; j++) parts[(j - 1) % 8] += 1.0 / j;
    char text[1024];
    static const char declared[] =
        "d = 0.1\nq = 0.7\nx'' = 0\nx(0) = 0.1\nx'(0) = 0.7\nr'' = 0 r\nr(0) = (0.1, 0.7)\nr'(0) = (0, 0)\n";
    const example e[] = {
        {"x^3", (d * d) * d},
        {"x^4", (d * d) * (d * d)},
        {"x^5", ((d * d) * (d * d)) * d},
        {"x^-2", 1 / (d * d)},
        {"x^0", 1},
        {"x x' + x", fma(d, q, d)},
        {"x x' - x", fma(d, q, -d)},
        {"x - x x'", fma(-d, q, d)},
        {"(r/3).x", d * (1.0 / 3)},
        {"x/3", d / 3},
        {"x + 0", d},
        {"x - x", 0},
        {"sum(j = 1..5: 1/j)", 0 + 1.0 / 1 + 1.0 / 2 + 1.0 / 3 + 1.0 / 4 + 1.0 / 5},
        {"sum(j = 1..20: 1/j)",
         ((parts[0] + parts[1]) + (parts[2] + parts[3])) + ((parts[4] + parts[5]) + (parts[6] + parts[7]))},
    };
    for (size_t i = 0; i < sizeof e / sizeof *e; i++) {
        snprintf(text, sizeof text, "%slook = if(t < 5, %s, 0)\n", declared, e[i].expression);
        double got = at_start(text, NULL, 0, "look");
        if (got != e[i].value) fail_msg("%s is %a, not %a", e[i].expression, got, e[i].value);
    }
}

/* A power with a literal exponent is the chain; with a parameter it is pow; a parameter's value changes no form. */
static void rule_15_parameters_do_not_rewrite(void **unused)
{
    (void)unused;
    const char *text = "n = 3\nk = 0\nx'' = -k x^n\nx(0) = 0.1\nx'(0) = 0\nlook = x^n\nnull = k/x\n";
    assert_true(fabs(at_start(text, NULL, 0, "look") - pow(0.1, 3)) <= 2 * DBL_EPSILON * pow(0.1, 3));
    motus_system *s = given_text(text);
    assert_string_equal(motus_equation_text(s, 0), "x'' = -k x^n");
    assert_null(motus_equation_text(s, 1));
    motus_analysis a = motus_default_analysis();
    motus_analysis_of(s, &a);
    assert_false(a.constant);
    motus_system_destroy(s);
}

/* ---- functions of one's own, and derivatives ---- */

typedef struct defined {
    const char *lines, *expression;
    double value;
} defined;

/* In the world of `given`: x = 2, x' = 3, r = (1, 2, 3), r' = (4, 5, 6), y = 8, a = 5, b = 3, u[1…4] = 10 … 40; t = 0
 */
static void in_given(const defined *e, size_t count)
{
    int faults = 0;
    for (size_t i = 0; i < count; i++) {
        char text[4096];
        snprintf(text, sizeof text, "%s%s\nwanted = %s\nlook = (wanted) + 0 t\n", given, e[i].lines, e[i].expression);
        const double got = at_start(text, NULL, 0, "look");
        if (!(fabs(got - e[i].value) <= 4e-16 * fabs(e[i].value))) {
            print_error("%s ; %s is %.17g, not %.17g\n", e[i].lines, e[i].expression, got, e[i].value);
            faults++;
        }
    }
    assert_int_equal(faults, 0);
}

/* A condition is a value, 1 or 0, and its value is a condition again. */
static void rule_14_values(void **unused)
{
    (void)unused;
    EXAMPLES({"x > 1", 1}, {"x > 2 or y < 0", 0}, {"(x > 0) + 1", 2}, {"sqrt(x > 0)", 1}, {"1/(x > 0)", 1},
             {"-(x > 0)", -1}, {"-(x > 0) + 1", 0}, {"|x < 0|", 0}, {"max(x > 0, 0)", 1}, {"(x > 0, y < 0).y", 0},
             {"(x > 0)^2", 1}, {"sum(i = 1..3: i > 1)", 2}, {"dot((x > 0, x < 0), (2, 3))", 2}, {"diff(x > 0, x)", 0});
    EXAMPLES({"1 < x < 3", 1}, {"1 < x < 2", 0}, {"1 < x <= 2 < 3 <= 3", 1}, {"3 > x >= 2 > 1", 1}, {"2 == x == a", 0},
             {"not 1 < x < 3", 0}, {"(1 < x < 3) a", 5}, {"sum(i = 1..5, 1 < i < 5: i)", 9});
    EXAMPLES({"(x > 0) == 1", 1}, {"(x > 0) == (y < 0)", 0}, {"(x < 0) != 1", 1}, {"(x > 0) >= (y > 0)", 1},
             {"(x > 0) < 2", 1}, {"(x > 0) == 1/2", 0}, {"if(if(x > 0, 1, 0), 3, 4)", 3}, {"if(a, 3, 4)", 3},
             {"if(if(x > 0, y < 0, y > 0), 3, 4)", 4}, {"if(x > 0, y > 0, 2) + 1", 2}, {"(x > 0) (y > 0) == 1", 1});
    const defined e[] = {
        {"lit = x > 1 and y > 1", "if(lit, 3, 4)", 3},
        {"lit = x > 1 and y > 1", "3 (1 - lit) + lit a", 5},
        {"lit = x > 1 and y > 1", "if(not lit or lit, 3, 4)", 3},
        {"lit = x > 1 and y > 1", "if(lit == 0, 3, 4)", 4},
        {"lit[i] = i > x for i = 1..4\nn = sum(i = 1..4, lit[i]: i)", "n + lit[3]", 8},
        {"on = 1 < 2\noff = not on", "if(on and not off, 3, 4) + on", 4},
        {"on[i] = i != 2 for i = 1..3", "sum(i = 1..3, on[i]: i)", 4},
        {"in(q) = 1 < q < 3", "if(in(x) and not in(a), in(x), 7)", 1},
    };
    in_given(e, sizeof e / sizeof *e);
}

/* A named condition is a switch: steps end where its own sides are equal, and so do events. */
static void rule_14_switches(void **unused)
{
    (void)unused;
    const char *const start = "\nx(0) = 1\nx'(0) = 0\nx'' = ", *const forces[] = {"if(x > 0, -1, 0)",
                                                                                  "-lit",
                                                                                  "-if(lit, 1, 0)",
                                                                                  "-(lit == 1)",
                                                                                  "-lit lit",
                                                                                  "-if(not lit, 0, lit)",
                                                                                  "-f(x)"};
    for (size_t i = 0; i < sizeof forces / sizeof *forces; i++) {
        char text[1024];
        snprintf(text, sizeof text, "lit = x > 0\nf(q) = q > 0%s%s\nuntil 3\nwhen %s as dark: record", start, forces[i],
                 i % 2 ? "not lit" : "x <= 0");
        motus_system *s = given_text(text);
        motus_run_def def = motus_default_run();
        motus_error err = motus_default_error();
        motus_run *r = NULL;
        motus_switch one = motus_default_switch();
        double x;
        assert_int_equal(motus_switch_at(s, 0, &one), MOTUS_OK);
        assert_true(one.located);
        assert_string_equal(one.surface, "x = 0");
        assert_int_equal(motus_switch_at(s, 1, &one), MOTUS_ARGUMENT);
        must(motus_run_create(s, &def, &r, &err), &err, "create");
        must(motus_run_finish(r, &err), &err, "finish");
        must(motus_run_state(r, &x, NULL, &err), &err, "state");
        assert_true(fabs(x + sqrt(2) * (3 - sqrt(2))) < 1e-14); /* it falls until t = sqrt(2), then goes on as it is */
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

static void rule_16_functions(void **unused)
{
    (void)unused;
    const defined e[] = {
        {"V(q) = q^2/2 + q^4", "V(x)", 18},
        {"V(q) = q^2/2 + q^4", "2 V(x + 1) V(0) + V(-1)", 1.5},
        {"F(p, q, n) = p q^n - q", "F(x, 3, a)", 2 * 243 - 3},
        {"F(p, q, n) = p q^n - q", "F(3, x, a)", 3 * 32 - 2},
        {"V(q) = W(q, a)\nW(p, q) = p + q", "V(x)", 7},      /* in any order, one by another */
        {"V(x) = x + y\nW(a) = V(a + 1)", "W(10)", 19},      /* an argument hides a state and a parameter */
        {"V(t) = cos(t) + t", "V(0) + t", 1},                /* … and the time */
        {"V(q) = a q x'", "V(x)", 30},                       /* parameters, states and t in the body */
        {"V(q) = p + q\np = 2 x", "V(1)", 5},                /* a quantity in the body */
        {"V(i) = u[i+1] - u[i]", "sum(i = 1..3: V(i))", 30}, /* an argument as an index */
        {"V(i) = u[i]", "V(mod(4, N) + 1) + V(N)", 50},
        {"S(f, n) = sum(j = 1..n: j f)", "S(x, 3)", 12},                      /* as a bound of a sum */
        {"S(f) = sum(j = 1..2: j f)", "S(sum(k = 1..3: k S(x)))", 3 * 6 * 6}, /* sums within sums */
        {"S(f) = sum(j = 1..2: j f)", "sum(k = 1..2: S(k u[k]))", 3 * 10 + 3 * 40},
        {"M(q) = |q|^2 + q.x + q[3]", "M(r) + M((3, 0, 4))", 14 + 4 + 25 + 7},
        {"D(p, q) = dot(p, q) p", "D(r, r').y", 64},
        {"H(c, p) = if(c and x > 1, p, 0)", "H(y > 7, 3) + H(y > 9, 4)", 3}, /* a condition */
        {"V(q) = x(0) q", "V(3)", 6},
        {"c = V(3)\nV(q) = q^2 b", "c + 0", 27}, /* in a parameter */
        {"V(q) = A[q, 2]", "V(1) + V(2)", 34},
    };
    in_given(e, sizeof e / sizeof *e);
}

/* The text with these lines, or the reason why it is refused. */
static void refused(const char *lines, motus_status status, int line, int column, const char *named)
{
    char text[1024];
    motus_system *s = NULL;
    motus_error err = motus_default_error();
    snprintf(text, sizeof text,
             "%s\nx'' = -x\nx(0) = 1\nx'(0) = 0\nr'' = -r\nr(0) = (1, 2)\nr'(0) = (0, 0)\nk = 2\nm = [k, 2]\n", lines);
    assert_int_equal(read_text(text, NULL, 0, &s, &err), status);
    if (err.line != line || err.column != column || (!strstr(err.message, named) && !strstr(err.hint, named)))
        fail_msg("%s\n  %d:%d %s (%s)\n  and not %d:%d %s", lines, err.line, err.column, err.message, err.hint, line,
                 column, named);
    assert_null(s);
}

static void rule_16_refused(void **unused)
{
    (void)unused;
    refused("V(q) = V(q - 1)", MOTUS_NAME, 1, 8, "V calls itself: V → V");
    refused("V(q) = 2 W(q)\nW(q) = U(q)\nU(p) = V(p)", MOTUS_NAME, 3, 8, "V → W → U → V");
    refused("V(q) = c q\nc = V(2)", MOTUS_NAME, 1, 8, "c → V → c");
    refused("V(q) = sum(i = 1..V(2): q)", MOTUS_NAME, 1, 19, "V calls itself");
    refused("V(q) = q\nf = V(x, 1)", MOTUS_SYNTAX, 2, 5, "V takes 1 argument, not 2");
    refused("V(p, q) = q\nf = V(x)", MOTUS_SYNTAX, 2, 5, "it is defined as V(p, q)");
    refused("V(q) = q\nf = V + x", MOTUS_SYNTAX, 2, 5, "in a bracket directly behind it");
    refused("V(q) = q\nf = V'(x)", MOTUS_SYNTAX, 2, 5, "diff(V(q), q)");
    refused("V(q, q) = q", MOTUS_NAME, 1, 6, "stands twice");
    refused("V(q) = p q", MOTUS_NAME, 1, 8, "p is not defined");
    refused("V(q) = q\nV = 3", MOTUS_NAME, 2, 1, "defined twice; the first time in line 1");
    refused("V(q) = q\nV(p) = 3", MOTUS_NAME, 2, 1, "defined twice");
    refused("x(q, p) = q", MOTUS_SYNTAX, 1, 1, "x has an equation of motion");
    refused("sin(q) = q", MOTUS_SYNTAX, 1, 1, "word of the language");
    refused("diff = 2", MOTUS_SYNTAX, 1, 1, "word of the language");
    refused("V(q) = q'\nf = V(x)", MOTUS_SHAPE, 1, 8, "takes no primes");
    refused("V(q) = q^2\nf = V(r)", MOTUS_SHAPE, 1, 8, "a vector has no powers");
    refused("V(q) = q.z\nf = V(r)", MOTUS_SHAPE, 1, 10, "1 to 2");
    refused("V(q) = x q\np = V(2)\nstep p", MOTUS_SHAPE, 3, 6, "p depends on a state or on time");
    refused("V(q) = q for i = 1..2", MOTUS_SHAPE, 1, 14, "cannot be a family");
    refused("V(q) = sum(q = 1..2: q)\nf = V(x)", MOTUS_SHAPE, 1, 12, "argument");
    refused("V(a, b, c, d, e, f, g, h, i) = a", MOTUS_LIMIT, 1, 1, "at most 8 arguments");
    refused("f = W(x)", MOTUS_NAME, 1, 5, "define it: W(…) = …");
    /* The second call has the nodes of the first, but other indices. */
    refused("V(i) = m[i]\nf = x sum(i = 1..2: V(i)) + sum(i = 2..3: V(i))", MOTUS_NAME, 1, 10, "m[3] is used here");
}

/* Forty functions each of which calls the one before twice: the same call is expanded once. */
static void rule_16_doubling(void **unused)
{
    (void)unused;
    char text[4096] = "x'' = -x\nx(0) = 1\nx'(0) = 0\nlook = f40(x)\nf0(q) = q\n";
    for (int i = 1; i <= 40; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text), "f%d(q) = f%d(q) + f%d(q)\n", i, i - 1, i - 1);
    assert_true(at_start(text, NULL, 0, "look") == 0x1p40);
}

/* A function is set as a parameter is. */
static void rule_16_set(void **unused)
{
    (void)unused;
    const char *text = "V(q) = q^2\nx'' = -V(x)\nx(0) = 3\nx'(0) = 0\nlook = V(x)\n", *other = "V(q) = q^3",
               *none = "W(q) = q";
    assert_true(at_start(text, NULL, 0, "look") == 9);
    assert_true(at_start(text, &other, 1, "look") == 27);
    motus_system *s = NULL;
    motus_error err = motus_default_error();
    assert_int_equal(read_text(text, &none, 1, &s, &err), MOTUS_NAME);
    assert_non_null(strstr(err.message, "the model has no function W"));
}

/* What stands on the left side besides the highest derivative goes to the right side. */
static void rule_20_left_sides(void **unused)
{
    (void)unused;
    static const char *const cases[][2] = {
        {"m x'' = -k x", "x'' = (-k x)/m"},
        {"x'' m = -k x", "x'' = (-k x)/m"},
        {"m*x'' = -k x", "x'' = (-k x)/m"},
        {"x'' (m + k) = -x", "x'' = (-x)/(m + k)"},
        {"(m + k) x'' = -x", "x'' = (-x)/(m + k)"},
        {"2 m x'' = -x", "x'' = (-x)/(2 m)"},
        {"|x| x'' = sqrt(m)", "x'' = sqrt(m)/abs(x)"},
        {"sqrt(m) x'' = -x", "x'' = (-x)/sqrt(m)"},
        {"V(x) x'' = -x", "x'' = (-x)/x^2"},
        {"m x'' + c x' + k x = F cos(t)", "x'' = (F cos(t) - k x - c x')/m"},
        {"x'' + k x = 0", "x'' = -k x"},
        {"-x'' = k x", "x'' = -k x"},
        {"k x - x'' = m", "x'' = k x - m"},
        {"k x - x'' = 0", "x'' = k x"},
        {"x'' - k x = 0", "x'' = k x"},
        {"F = k x + 0\nx''/m = F", "x'' = (k x + 0) m"},
        {"2 (x'' + x)/m = F", "x'' = F m/2 - x"},
        {"x'' + x' x(0) = 0", "x'' = -x' x(0)"},
        {"0 = x'' + k x", "x'' = -k x"},
        {"-k x = m x''", "x'' = (-k x)/m"},
        {"c x' = -x''", "x'' = -c x'"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[512];
        snprintf(text, sizeof text, "m = 2\nk = 3\nc = 4\n%s\n%s\nV(q) = q^2\nx(0) = 1\nx'(0) = 0\n",
                 strstr(cases[i][0], "F =") ? "" : "F = 5", cases[i][0]);
        motus_system *s = given_text(text);
        assert_string_equal(motus_equation_text(s, 0), cases[i][1]);
        motus_system_destroy(s);
    }
}

/* The highest derivative of a state stands for the right side of its equation, cell by cell. */
static void rule_20_rates(void **unused)
{
    (void)unused;
    motus_system *s = given_text("u[1]'' = -u[1]\nu[i]'' = -i u[i] for i = 2..3\nu[i](0) = i for i = 1..3\n"
                                 "u[i]'(0) = 0 for i = 1..3\ns' = u[3]''^2 + a\na = u[1]''\ns(0) = 0\n"
                                 "p[i]' = u[i]'' s' for i = 1..3\np[i](0) = 0 for i = 1..3\n"
                                 "when u[2]'' = 1 as e: record\nk = at(e, u[2]'')\nq = sum(i = 1..3: u[i]'')\n");
    static const char *const texts[] = {"u[1]'' = -u[1]", "u[i]'' = -i u[i]", "s' = (-3 u[3])^2 - u[1]",
                                        "p[1]' = (-u[1]) ((-3 u[3])^2 - u[1])",
                                        "p[i]' = (-i u[i]) ((-3 u[3])^2 - u[1])"};
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) assert_string_equal(motus_equation_text(s, k), texts[k]);
    assert_null(motus_equation_text(s, sizeof texts / sizeof *texts));
    motus_system_destroy(s);
}

/* The time has the name that the model gives it, and t is a coordinate if it has an equation. */
static void rule_21_time(void **unused)
{
    (void)unused;
    const char *const rest = "\nx(0) = 1\nx'(0) = 0\nq = x(0)",
                      *const cases[][3] = {
                          {"x'' = -x + t", "t", "x'' = -x + t"},
                          {"time s\nx'' = -x + s", "s", "x'' = -x + s"},
                          {"x'' = -x + F(1)\nF(t) = t^2 tau\ntime tau", "tau", "x'' = -x + 1 tau"},
                          {"time s\nt = 3\nx'' = -t x + s", "s", "x'' = -t x + s"},
                          {"x'' = -x + t + tau\nt' = 2\nt(0) = 0", "tau", "x'' = -x + t + tau"},
                          {"x'' = -x + t + s\nt' = 2\nt(0) = 0\ntau = 3", "s", "x'' = -x + t + s"},
                          {"x'' = -time x\ntime = 3", "t", "x'' = -time x"},
                          {"x'' = -time x\ntime' = x\ntime(0) = 3", "t", "x'' = -time x"},
                      };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[512];
        snprintf(text, sizeof text, "%s%s", cases[i][0], rest);
        motus_system *s = given_text(text);
        motus_column time = motus_default_column();
        assert_int_equal(motus_column_at(s, 0, &time), MOTUS_OK);
        assert_string_equal(time.name, cases[i][1]);
        assert_string_equal(motus_equation_text(s, 0), cases[i][2]);
        motus_system_destroy(s);
    }
}

/* An error of a run says when by the name of the time. */
static void rule_21_errors(void **unused)
{
    (void)unused;
    motus_system *s = given_text("x' = x^2\nt' = 2\nx(0) = 1\nt(0) = 0\nuntil 3");
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    def.method = "dop853";
    def.tolerance = 1e-9;
    must(motus_run_create(s, &def, &r, &err), &err, "create");
    assert_int_not_equal(motus_run_finish(r, &err), MOTUS_OK);
    if (!strstr(err.message, " tau = 1") || strstr(err.message, " t = ")) fail_msg("%s", err.message);
    motus_run_destroy(r);
    motus_system_destroy(s);
    /* what is found by reading, by events, by trial runs, and behind the run */
    static const struct {
        const char *lines, *method, *says;
    } cases[] = {{"x'' = -x - x'/10\ninvariant E = x^2 + x'^2", NULL, " at s = "},
                 {"x'' = -x\ninvariant E = x^2 + x'^2 + if(s > 3, 1, 0)", NULL, " s = 3"},
                 {"x'' = -x\nexact x = cos(s) + s^4", NULL, " at s = "},
                 {"x'' = -1\nwhen x = 0 as b: x' = -x'/2\nwhen b accumulates: x' = 0\nwhen x <= 0: x' = -x'", "rk4",
                  "one instant, s = "},
                 {"x'' = 6 x^2", "rk4", " s = "},
                 {"x'' = -x + interp(s, 0, 1, [0, 1, 2])", "dop853", "at s = 2 s goes beyond 2"},
                 {"x'' = -1e10*(x' - cos(s))", "dopri5", " at s = "}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char text[400];
        motus_status status;
        snprintf(text, sizeof text, "time s\n%s\nx(0) = 1\nx'(0) = 0\nuntil 30", cases[k].lines);
        err = motus_default_error();
        s = NULL, r = NULL;
        def = motus_default_run();
        def.method = cases[k].method;
        if (def.method && !strcmp(def.method, "rk4")) def.step = 0.01;
        status = read_text(text, NULL, 0, &s, &err);
        if (!status) status = motus_run_create(s, &def, &r, &err);
        if (!status) status = motus_run_finish(r, &err);
        if (!status || !strstr(err.message, cases[k].says) || strstr(err.message, " t = ") || strstr(err.hint, " t = "))
            fail_msg("%s: %s (%s)", cases[k].lines, err.message, err.hint);
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

static void rule_17_derivatives(void **unused)
{
    (void)unused;
    const defined e[] = {
        {"V(q) = q^2/2 + q^4", "diff(V(x), x)", 34},
        {"V(q) = q^2/2 + q^4", "diff(V(2 x), x)", 2 * (4 + 4 * 64)},
        {"", "diff(x^2 x'^3, x')", 4 * 27},
        {"", "diff(x^2 x'^3, x)", 4 * 27},
        {"", "diff(sin(3 t) x, t)", 6},
        {"", "diff(x'', x') + diff(x''^2, x'')", -4},
        {"", "diff(a x^2, a)", 4},
        {"p = a^2\nq = 2 p + a", "diff(q x, a)", 2 * (4 * 5 + 1)}, /* through what was computed from it */
        {"", "diff(m[2]^2 m[1], m[2])", 2 * 4 * 3},
        {"", "diff(g.y^2, g.y)", -20},
        {"", "diff(|r|^2, r).z", 6},
        {"", "diff(|r|^2, r.y) + diff(|r|^2, r[1])", 6},
        {"", "diff(r, r.y).y + diff(r, r.y).x", 1},
        {"", "diff(x r', x).z", 6},
        {"", "diff(dot(r, r'), r').y", 2},
        {"", "diff(s^3, s)", 3 * 49},
        {"F(q) = diff(q^3, q)", "F(x) + F(10)", 12 + 300},
        {"F(q) = diff(q^3 x, q)", "F(x)", 24}, /* x beside q is held fixed, though q is x */
        {"F(q, p) = diff(q^2 p, q)", "F(x, x)", 8},
        {"F(q) = diff(diff(q^4, q), q)", "F(x)", 48},
        {"V(q) = q^4\nF(q) = -diff(V(q), q)\nK(q) = diff(F(q), q)", "K(x + 1)", -12 * 9},
        {"F(q) = diff(|q|^2, q)", "F(2 r).y + F(r').x", 8 + 8},
        {"F(q) = diff(sum(j = 1..3: j q^2 u[j]), q)", "F(x)", 4 * 140},
        {"F(q) = diff(q^2, q)", "F(sum(j = 1..3: j x))", 24},
        {"F(q) = diff(sum(i = 1..2: i q^2), q)", "F(sum(j = 1..3: j x))", 72},
        {"F(q) = sum(i = 1..2: diff(q^2 i, q))", "F(sum(j = 1..3: j x))", 72},
        {"c = F(3)\nF(q) = diff(q^2, q)", "c + 0", 6},
        {"U = sum(i = 0..N: (u[i+1] - u[i])^2/2)", "diff(U, u[2])", 2 * 20 - 10 - 30},
        {"U = sum(i = 0..N: (u[i+1] - u[i])^2/2)", "diff(U, u[0])", -11},
        {"U = sum(i = 1..N: u[mod(i, N)+1] u[i])", "diff(U, u[1])", 60},
        {"G[i] = diff(sum(j = 1..4: u[j]^3), u[i]) for i = 1..4", "G[3]", 3 * 900},
        {"U = sum(i = 1..N-1: (u[i+1] - u[i])^2/2)\nG[i] = diff(U, u[i]) for i = 1..N", "G[4] + 100 G[1]", 10 - 1000},
        {"U = sum(j = 2..N, j != 3: u[j] u[j-1])\nG[i] = diff(U, u[i]) for i = 1..N", "G[2] + G[3] + G[4]",
         10 + 40 + 30},
        {"U = sum(j = 0..N+1, j != 3: u[j]^2)\nG[i] = diff(U, u[i]) for i = 1..N", "G[2] + 1000 G[3]", 40},
        {"U = sum(j = 1..N, k = 1..N, j != k: u[j] u[k])/2\nG[i] = diff(U, u[i]) for i = 1..N", "G[2]", 80},
        {"U = sum(j = 0..N: j u[j+1]^2)\nG[i] = diff(U, u[i + 1]) for i = 0..N-1", "G[3]", 3 * 80},
        {"U = sum(j = 1..N: u[j]^2 u[2])\nG[i] = diff(U, u[i]) for i = 1..N", "G[2]", 3 * 400 + 100 + 900 + 1600},
        {"U = sum(i = 1..N, j = i+1..N: (u[i] - u[j])^2)", "diff(U, u[1])", 2 * (-10 - 20 - 30)},
        {"", "diff(exp(x) (x - 2) y, x)", exp(2) * 8},
        {"", "diff(if(x > 1, x^2, x), x)", 4},
        {"", "diff(sqrt(x^2 + 5), x)", 2. / 3},
        {"", "diff(-a/x, x) - diff(a/x^3, x)", 5. / 4 + 15. / 16},
        {"", "diff(abs(-x) + x^a, x)", 1 + 80},
        {"", "diff(y, x) + diff(t, x)", 0},
    };
    in_given(e, sizeof e / sizeof *e);
    refused("f = diff(x^2, 2 x)", MOTUS_SHAPE, 1, 15, "2 x is not one");
    refused("f = diff(x^2, pi)", MOTUS_SHAPE, 1, 15, "pi is not one");
    refused("f = diff(E, E)\nE = x^2", MOTUS_SHAPE, 1, 13, "E is a quantity");
    refused("f = diff(2 r, r)", MOTUS_SHAPE, 1, 5, "matrix");
    refused("f = diff(m[1] x, k)", MOTUS_SHAPE, 1, 5, "a list or an initial value in this expression depends on k");
    refused("f = diff(x)", MOTUS_SYNTAX, 1, 5, "diff takes 2 arguments");
    refused("V(i) = diff(m[i] x, i)\nf = V(1)", MOTUS_SHAPE, 1, 15, "an index cannot depend");
}

/* More cells than sums are shortened for, each within the sum: none is counted twice, or left out. */
static void rule_17_many_cells(void **unused)
{
    (void)unused;
    char text[8192] = "N = 80\nw[i]'' = -w[i] for i = 1..N\nw[i](0) = i for i = 1..N\nw[i]'(0) = 0 for i = 1..N\n"
                      "G[i] = diff(U, w[i]) for i = 1..N\nlook = G[7] + 1000 G[80]\nU = sum(j = 1..N: w[j]^2/2";
    for (int i = 1; i <= 80; i++) snprintf(text + strlen(text), sizeof text - strlen(text), " + w[%d]", i);
    strcat(text, ")\n");
    assert_true(at_start(text, NULL, 0, "look") == 87 + 1000 * 160);
}

/* The equation that a potential gives, as one writes it; it is known to be a gradient, and smooth where the potential
 * is. */
static void rule_17_forces(void **unused)
{
    (void)unused;
    static const struct {
        const char *potential, *equation;
        int smooth;
    } cases[] = {{"k q^2/2 + q^4", "x'' = -(k x + 4 x^3)/m", 1},
                 {"-k/|q|", "x'' = -k sign(x)/(abs(x)^2 m)", 0},
                 {"-k/q + k^2/q^2", "x'' = -(k/x^2 - 2 k^2/x^3)/m", 1},
                 {"4 (1/q^12 - 1/q^6)", "x'' = -4 (6/x^7 - 12/x^13)/m", 1},
                 {"-g/L cos(q)", "x'' = -g sin(x)/(L m)", 1},
                 {"hypot(q, 2)", "x'' = -x/(hypot(x, 2) m)", 1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[512];
        snprintf(text, sizeof text,
                 "g = 10\nL = 2\nk = 2\nm = 3\nV(q) = %s\nx'' = -diff(V(x), x)/m\nx(0) = 1\nx'(0) = 0\n",
                 cases[i].potential);
        motus_system *s = given_text(text);
        motus_analysis a = motus_default_analysis();
        motus_analysis_of(s, &a);
        if (strcmp(motus_equation_text(s, 0), cases[i].equation))
            fail_msg("V(q) = %s: %s", cases[i].potential, motus_equation_text(s, 0));
        assert_true(a.gradient);
        assert_int_equal(!!a.smooth, cases[i].smooth);
        motus_system_destroy(s);
    }
    /* The force on one cell of a chain has two terms, though the energy is a sum: of the cell and its neighbours. */
    motus_system *chain =
        given_text("N = 4\nV(d) = d^2/2\nU = sum(i = 0..N: V(x[i+1] - x[i]))\nx[i]'' = -diff(U, x[i]) for "
                   "i = 1..N\nx[0] = 0\nx[N+1] = 0\nx[i](0) = i for i = 1..N\nx[i]'(0) = 0 for i = 1..N\n");
    assert_string_equal(motus_equation_text(chain, 0), "x[i]'' = -(x[i] - x[i-1] + (x[i] - x[i+1]))");
    motus_system_destroy(chain);
    /* The argument's sum has an index of its own within the function's. */
    motus_system *nested =
        given_text("F(q) = diff(sum(i = 1..2: i q^2), q)\nx'' = -F(sum(j = 1..3: j x))\nx(0) = 1\nx'(0) = 0\n");
    assert_string_equal(motus_equation_text(nested, 0), "x'' = -sum(i = 1..2: 2 i sum(j = 1..3: j x))");
    motus_system_destroy(nested);
    motus_system *s = given_text("V(q) = -1/|q|\nr'' = -diff(V(r), r)\nr(0) = (1, 0)\nr'(0) = (0, 1)\n");
    motus_analysis a = motus_default_analysis();
    motus_analysis_of(s, &a);
    assert_string_equal(motus_equation_text(s, 1), "r''.y = -r.y/sqrt(r.x^2 + r.y^2)^3");
    assert_true(a.gradient && a.smooth);
    motus_system_destroy(s);
}

static void analysis_reads_the_equations(void **unused)
{
    (void)unused;
    static const struct {
        const char *force;
        int velocity, linear, time, affine, constant, smooth;
    } known[] = {
        {"-x", 0, 1, 0, 1, 0, 1},        {"-x^3 - x'", 1, 1, 0, 0, 0, 1},
        {"-x'^2", 1, 0, 0, 0, 0, 1},     {"-x + cos(t)", 0, 1, 1, 1, 0, 1},
        {"-9.81", 0, 1, 0, 1, 1, 1},     {"-x' |x'|", 1, 0, 0, 0, 0, 0},
        {"-x t - x'", 1, 1, 1, 1, 0, 1}, {"if(x > 0, -x, 0)", 0, 1, 0, 0, 0, 0},
        {"-k q x", 0, 1, 1, 1, 0, 1},    {"-floor(x)", 0, 1, 0, 0, 0, 0},
        {"-x x'", 1, 1, 0, 0, 0, 1},
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        char text[512];
        snprintf(text, sizeof text, "k = 2\nq = 3 t\nx'' = %s\nx(0) = 1\nx'(0) = 0\n", known[i].force);
        motus_system *s = given_text(text);
        motus_analysis a = motus_default_analysis();
        motus_analysis_of(s, &a);
        if (!!a.velocity_dependent != known[i].velocity ||
            (known[i].velocity && !!a.linear_in_velocity != known[i].linear) || !!a.time_dependent != known[i].time ||
            !!a.affine != known[i].affine || !!a.constant != known[i].constant || !!a.smooth != known[i].smooth)
            fail_msg("%s: velocity %d, linear %d, time %d, affine %d, constant %d, smooth %d", known[i].force,
                     a.velocity_dependent, a.linear_in_velocity, a.time_dependent, a.affine, a.constant, a.smooth);
        assert_non_null(motus_explain(s));
        motus_system_destroy(s);
    }
}

static void settings_are_read(void **unused)
{
    (void)unused;
    static const char still[] = "x'' = 0\nx(2) = 1\nx'(2) = 0\n";
    motus_settings m = motus_default_settings();
    motus_system *s = given_text(still);
    motus_settings_of(s, &m);
    assert_null(m.method);
    assert_true(isnan(m.step) && isnan(m.until) && isnan(m.every_time) && m.every_steps == 0 && m.from == 2);
    motus_system_destroy(s);
    char text[512];
    snprintf(text, sizeof text,
             "h = 0.5\nstep h^2\nuntil 2 pi + h\nevery 3 h   # for later\nmethod   newmark(1/6, 1/2)  # with "
             "arguments\nfrom 4 h\n%s",
             still);
    s = given_text(text);
    motus_settings_of(s, &m);
    assert_string_equal(m.method, "newmark(1/6, 1/2)");
    assert_true(m.step == 0.25 && m.until == 2 * 3.14159265358979323846 + 0.5 && m.every_time == 1.5 &&
                m.every_steps == 0 && m.from == 2);
    motus_system_destroy(s);
    snprintf(text, sizeof text, "%sn = 5\nevery 2 n steps\n", still);
    s = given_text(text);
    motus_settings_of(s, &m);
    assert_true(isnan(m.every_time) && m.every_steps == 10);
    motus_system_destroy(s);
}

/* The caret is under the character, and the column counts characters, for lines of any length and letters. */
static void carets_stand_under_the_fault(void **unused)
{
    (void)unused;
    for (int before = 0; before < 400; before += 7)
        for (int after = 0; after < 300; after += 60) {
            char text[4096] = "x'' = x";
            for (int i = 0; i < before; i++) strcat(text, i % 3 ? " + θ" : " - x");
            strcat(text, " $");
            for (int i = 0; i < after; i++) strcat(text, "é");
            motus_system *s = NULL;
            motus_error err = motus_default_error();
            assert_int_equal(read_text(text, NULL, 0, &s, &err), MOTUS_SYNTAX);
            assert_int_equal(err.line, 1);
            assert_int_equal(err.column, 9 + 4 * before);
            size_t place = strcspn(err.caret, "^");
            assert_int_equal(strspn(err.caret, " "), place);
            const char *p = err.source;
            while (place > 0 && *p)
                for (place--, p++; ((unsigned char)*p & 0xC0) == 0x80;) p++;
            assert_int_equal(*p, '$');
        }
}

/* Texts without a line in them. */
/* What people bring from other languages and from print is refused with the text to write. */
static void first_words(void **unused)
{
    (void)unused;
    static const struct {
        const char *lines, *hint;
    } cases[] = {
        {"x'' = (0,5 + 1) x", "a decimal number is written with a point: 0.5"},
        {"x'' = -sin(0,5 x)", "a decimal number is written with a point: 0.5"},
        {"x'' = -x²", "write x^2"},
        {"x'' = -k x/10⁻³", "write 10^-3"},
        {"d²x/dt² = -x", "derivatives are written with primes: x'' = …"},
        {"g = 9.81 m/s²", "a unit is no part of a number: write it in a comment, 9.81 # m/s²"},
        {"x'' = -x.dot", "derivatives by the time are written with primes"},
        {"\\ddot{x} = -x", "derivatives are written with primes: x''"},
        {"x'' = -\\frac{k}{m} x", "write k/m"},
        {"x'' = -\\frac{k+1}{m} x", "write (k+1)/(m)"},
        {"x'' = -\\sqrt{x}", "write sqrt(x)"},
        {"x'' = -k \\cdot x", "a product is written"},
        {"x'' = -\\omega x", "write omega"},
        {"m = 2\nF = m*a", "Newton's law m x'' = F"},
        {"F = -x\nF = 2", "Newton's law is written m x'' = F"},
        {"x'' = -atan2(x)", "write atan2(y, x)"},
        {"x'' = -hypot(x)", "write hypot(a, b)"},
        {"x'' = -x // the spring", "a comment begins with #"},
        {"' the spring", "a comment begins with #"},
        {"r'' = -r\nr(0) = [0, 0, 1]; r'(0) = (0, 0, 0)", "a vector is written (0, 0, 1)"},
        {"r'' = -r\nr(0) = {0, 1}", "a vector is (1, 2)"},
        {"r'' = -r\nr(0) = <0, 1>", "a vector stands in round brackets"},
        {"r'' = -r\nr(0) = (0 1)", "(0, 1) for a vector"},
        {"x'' = 1_000 x", "write 1000"},
        {"x'' = 1 000 x", "write 1000"},
        {"x'' = 1'000 x", "write 1000"},
        {"x'' = -½ x", "write 1/2"},
        {"x'' = -x – 1", "write -"},
        {"x'' = -sin 2x", "write sin(2x)"},
        {"T = 0..10", "T[i] = i for i = 1..10"},
        {"x'' = delta(t)", "an event for a push"},
        {"y'' = -y; y(0) = 1; y_dot(0) = 0", "y'(0) = …"},
        {"T = [0, 1]\nx'' = interp(T, T, t)", "write interp(t, T, A)"},
        {"T = [0, 1]\nx'' = interp(t, T, T, 0)", "interp(t, T, A, hold) for the end values"},
        {"x'' = interp(t, x, T, T, A)", "on a uniform grid"},
        {"x'' = lookup(t, T, A)", "write interp(t, T, A)"},
    };
    int faults = 0;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char text[300];
        motus_system *s = NULL;
        motus_error err = motus_default_error();
        const bool equation = strstr(cases[k].lines, "x''") || strstr(cases[k].lines, "x/d");
        snprintf(text, sizeof text, "%s%s\nx(0) = 1\nx'(0) = 0\n", equation ? "" : "x'' = -x\n", cases[k].lines);
        assert_int_not_equal(read_text(text, NULL, 0, &s, &err), MOTUS_OK);
        if (!strstr(err.hint, cases[k].hint))
            print_error("%s: %s (%s)\n", cases[k].lines, err.message, err.hint), faults++;
    }
    assert_int_equal(faults, 0);
}

static void empty_texts(void **unused)
{
    (void)unused;
    static const char *const texts[] = {"", "\n\n", "# only a remark", "\xEF\xBB\xBF", "   \t\r\n", "k = 2"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        motus_system *s = NULL;
        motus_error err = motus_default_error();
        assert_int_equal(read_text(texts[i], NULL, 0, &s, &err), MOTUS_SYNTAX);
        assert_non_null(strstr(err.message, "no equation of motion"));
        assert_non_null(strstr(err.hint, "x'' ="));
        assert_null(s);
    }
}

static void rule_18_matrices(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "q = 2\nK = [[q, -1], [-1, 3]]\nL = [[1, 2, 3], [4, 5, 6]]\nm = 4\nx'' = -K x/m\nx(0) = (1, 10)\nx'(0) = (2, "
        "20)\n"
        "u'' = -u\nu(0) = (1, 2, 3)\nu'(0) = (0, 0, 0)\n",
        "a = K x\nb = -K/2 (x' - x)\nc = L u + 3 K x\nd = K L u\ne = [[1, 2, 3]] u\nf = K[2, 1] + K[1, 1] + 0 t\n"
        "g = dot(x, K x)\nh = [[0, 1], [-1, 0]] x'\n"};
    static const struct {
        const char *name;
        double value;
    } want[] = {{"a.x", -8}, {"a.y", 29}, {"b.x", 4}, {"b.y", -14.5}, {"c.x", -10}, {"c.y", 119}, {"d.x", -4},
                {"d.y", 82}, {"e", 14},   {"f", 1},   {"g", 282},     {"h.x", 20},  {"h.y", -2}};
    char text[1024];
    snprintf(text, sizeof text, "%s%s", texts[0], texts[1]);
    motus_system *s = given_text(text);
    for (size_t k = 0; k < sizeof want / sizeof *want; k++)
        if (quantity(s, want[k].name) != want[k].value)
            fail_msg("%s: %g, not %g", want[k].name, quantity(s, want[k].name), want[k].value);
    assert_string_equal(motus_equation_text(s, 0), "x''.x = -(K[1,1] x.x + K[1,2] x.y) (1/m)");
    const double q = 5;
    motus_error err = motus_default_error();
    must(motus_system_set(s, "q", &q, 1, &err), &err, "q");
    assert_true(quantity(s, "a.x") == -5);
    const double all[] = {1, 2, 3, 4}; /* row by row */
    must(motus_system_set(s, "K", all, 4, &err), &err, "K");
    assert_true(quantity(s, "a.x") == 21 && quantity(s, "a.y") == 43);
    for (size_t k = 0; k < motus_statement_count(s); k++) assert_non_null(motus_statement_mathml(s, k));
    motus_system_destroy(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rule_1_names_and_numbers),
        cmocka_unit_test(rule_2_precedence),
        cmocka_unit_test(rule_2_juxtaposition),
        cmocka_unit_test(rule_2_two_decimal_numbers),
        cmocka_unit_test(rule_3_division),
        cmocka_unit_test(rule_3_a_factor_after_a_quotient),
        cmocka_unit_test(rule_4_brackets_behind_names),
        cmocka_unit_test(rule_4_refused),
        cmocka_unit_test(rule_5_functions),
        cmocka_unit_test(rule_6_primes),
        cmocka_unit_test(rule_7_bars),
        cmocka_unit_test(rule_8_lines),
        cmocka_unit_test(rule_9_shapes),
        cmocka_unit_test(rule_10_parameters_and_quantities),
        cmocka_unit_test(rule_10_families_by_places),
        cmocka_unit_test(rule_10_set),
        cmocka_unit_test(rule_10_set_refused),
        cmocka_unit_test(rule_11_indices),
        cmocka_unit_test(rule_12_sums),
        cmocka_unit_test(rule_12_masks_select),
        cmocka_unit_test(rule_14_conditions),
        cmocka_unit_test(rule_14_values),
        cmocka_unit_test(rule_14_switches),
        cmocka_unit_test(rule_14_no_leak_in_derivatives),
        cmocka_unit_test(rule_15_normal_form),
        cmocka_unit_test(rule_15_parameters_do_not_rewrite),
        cmocka_unit_test(rule_16_functions),
        cmocka_unit_test(rule_16_refused),
        cmocka_unit_test(rule_16_doubling),
        cmocka_unit_test(rule_16_set),
        cmocka_unit_test(rule_20_left_sides),
        cmocka_unit_test(rule_20_rates),
        cmocka_unit_test(rule_21_time),
        cmocka_unit_test(rule_21_errors),
        cmocka_unit_test(rule_17_derivatives),
        cmocka_unit_test(rule_17_many_cells),
        cmocka_unit_test(rule_17_forces),
        cmocka_unit_test(rule_18_matrices),
        cmocka_unit_test(analysis_reads_the_equations),
        cmocka_unit_test(settings_are_read),
        cmocka_unit_test(carets_stand_under_the_fault),
        cmocka_unit_test(first_words),
        cmocka_unit_test(empty_texts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
