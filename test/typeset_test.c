/* Statements as MathML: the output for each kind of tree, brackets only where the meaning needs them, all text
 * escaped, bounds on the output. test/mathml.h reads it, and defines the short form used here.
 */
#include "test/given.h"
#include "test/mathml.h"

enum { ROOM = 1 << 20 };

/* The model of the expressions below: numbers a b c n, states x and y, vector states r and s, a family q, a list m,
 * names of all kinds. */
static const char world[] =
    "a = 1\nb = 2\nc = 3\nn = 2\nm = [1, 2, 3]\nspeed = 4\nomega0 = 1\nx_max = 1\nGamma = 1\nmu = 1\nm1_max = 1\nθ1 = "
    "1\nV(q) = q\nW(p, q) = p q\nk₁₂ = 1\nvₓ = 1\n_low = 1\nend_ = 1\nalpha_beta = 1\n"
    "x'' = -x\nx(0) = 1\nx'(0) = 0\ny'' = -y\ny(0) = 1\ny'(0) = 0\nr'' = -r\nr(0) = (1, 0, 0)\nr'(0) = (0, 1, 0)\ns'' "
    "= -s\ns(0) = (1, 0, 0)\ns'(0) = (0, 1, 0)\n"
    "q[i]'' = -q[i] for i = 1..3\nq[i](0) = 1 for i = 1..3\nq[i]'(0) = 0 for i = 1..3\n"
    "w[i]'' = -w[i] for i = 1..3\nw[i](0) = (1, 0, 0) for i = 1..3\nw[i]'(0) = (0, 0, 0) for i = 1..3\n"
    "u[i, j]'' = -u[i, j] for i = 1..3, j = 1..2\nu[i, j](0) = 1 for i = 1..3, j = 1..2\nu[i, j]'(0) = 0 for i = 1..3, "
    "j = 1..2\n";

/* Statement k in short form; it is well-formed, or the test fails. */
static const char *short_form(motus_system *s, size_t k, char *out)
{
    const char *text = motus_statement_mathml(s, k), *wrong;
    assert_non_null(text);
    wrong = mathml_read(text, out, ROOM, NULL);
    if (wrong) fail_msg("%s: %s", wrong, text);
    return out;
}

/* The last statement of that model with one more line. */
static const char *last_of(const char *line, char *out)
{
    char *text = malloc(sizeof world + strlen(line) + 8);
    assert_non_null(text);
    sprintf(text, "%s%s\n", world, line);
    motus_system *s = given_text(text);
    short_form(s, motus_statement_count(s) - 1, out);
    motus_system_destroy(s);
    free(text);
    return out;
}

static void same(const char *line, const char *expected)
{
    static char out[ROOM];
    if (strcmp(last_of(line, out), expected)) fail_msg("%s\n  is       %s\n  should be %s", line, out, expected);
}

/* Each kind of tree ------------------------------------------------------------------------------------------------ */

static void expressions(void **state)
{
    (void)state;
    static const char *const cases[][2] = {
        /* numbers as they are spelled */
        {"0.50", "0.50"},
        {"1e-5", "{1×msup{10|{−5}}}"},
        {"1.50E+007", "{1.50×msup{10|7}}"},
        {"2e0", "{2×msup{10|0}}"},
        {"-3", "−3"},
        {"( # 1\n (2.5))", "2.5"},
        {"(1e3)^2", "msup{{({1×msup{10|3}})}|2}"},
        {"2^2", "msup{2|2}"},
        {"(-2)^2", "msup{{(−2)}|2}"},
        /* names */
        {"a", "a"},
        {"speed", "speed"},
        {"omega0", "msub{ω|0}"},
        {"x_max", "msub{x|max}"},
        {"Gamma", "Γ"},
        {"mu", "μ"},
        {"pi", "π"},
        {"t", "t"},
        {"m1_max", "msub{m|1,max}"},
        {"θ1", "msub{θ|1}"},
        {"k₁₂", "msub{k|12}"},
        {"vₓ", "msub{v|x}"},
        {"_low", "_low"},
        {"end_", "end_"},
        {"alpha_beta", "msub{α|β}"},
        {"x'", "msup{x|′}"},
        {"x''", "msup{x|′′}"},
        {"x'^2", "msup{x|{′2}}"},
        {"r'.y", "msubsup{r|y|′}"},
        {"r'.y^2", "msubsup{r|y|{′2}}"},
        {"omega0^2", "msubsup{ω|0|2}"},
        {"m[2]", "msub{m|2}"},
        {"q[2]'^n", "msubsup{q|2|{′n}}"},
        {"u[1, 2]", "msub{u|{1,2}}"},
        {"w[2].y", "msub{w|{2,y}}"},
        {"w[2]'[3]", "msubsup{w|{2,3}|′}"},
        {"sum(i = 1..2: q[i+1])", "munderover{∑|{i=1}|2}msub{q|{i+1}}"},
        {"q[mod(3, 2)+1]", "msub{q|{{(3mod2)}+1}}"},
        {"x(0)", "{x@{(0)}}"},
        {"x'(0)^2", "msup{{msup{x|′}@{(0)}}|2}"},
        {"r(0).x", "{msub{r|x}@{(0)}}"},
        {"cross(r, s).z", "msub{{(r×s)}|z}"},
        /* products */
        {"2 a b", "2~a~b"},
        {"a*2", "a⋅2"},
        {"2*3", "2⋅3"},
        {"2*3^2", "2⋅msup{3|2}"},
        {"2 (1/2)", "2⋅mfrac{1|2}"},
        {"a (1/2)", "a~mfrac{1|2}"},
        {"2 (a/b)", "2~mfrac{a|b}"},
        {"a (b + c)", "a~{(b+c)}"},
        {"x*(b + c)", "x⋅{(b+c)}"},
        {"x'*(b + c)", "msup{x|′}⋅{(b+c)}"},
        {"a*-b", "a~{(−b)}"},
        {"a*(1)", "a⋅1"},
        {"speed a", "speed~ a"},
        {"2 speed", "2~ speed"},
        {"speed^2 a", "msup{speed|2}~a"},
        {"a sin(b)", "a~ sin@{(b)}"},
        {"|a| |b|", "{|a|}~ {|b|}"},
        {"x |x|", "x~{|x|}"},
        {"sin(a) b", "sin@{(a)}~b"},
        /* powers, quotients, roots, fences */
        {"a^b^c", "msup{a|msup{b|c}}"},
        {"(a^b)^c", "msup{{(msup{a|b})}|c}"},
        {"a^(b + 1)", "msup{a|{b+1}}"},
        {"a^-b", "msup{a|{−b}}"},
        {"a^(b/c)", "msup{a|{b/c}}"},
        {"a^((b + 1)/(2 c))", "msup{a|{{(b+1)}/{(2~c)}}}"},
        {"a^((b/2) c)", "msup{a|{{(b/2)}~c}}"},
        {"(a/b)^2", "msup{{(mfrac{a|b})}|2}"},
        {"(a + b)/(c - 1)", "mfrac{{a+b}|{c−1}}"},
        {"a/b/c", "mfrac{mfrac{a|b}|c}"},
        {"a/(b/c)", "mfrac{a|mfrac{b|c}}"},
        {"a b/c", "mfrac{{a~b}|c}"},
        {"-a/b sin(c)", "−mfrac{a|b}~ sin@{(c)}"},
        {"1/2 a |r|^2", "mfrac{1|2}~a~msup{{|r|}|2}"},
        {"a/b (c - 1)", "mfrac{a|b}~{(c−1)}"},
        {"1/2 a/b c", "mfrac{{mfrac{1|2}~a}|b}~c"},
        {"a^(1/2 b)", "msup{a|{{(1/2)}~b}}"},
        {"sqrt(a + b)", "msqrt{a+b}"},
        {"sqrt(a)^3", "msup{msqrt{a}|3}"},
        {"cbrt(a + 1)", "mroot{{a+1}|3}"},
        {"abs(a - b)", "{|a−b|}"},
        {"|r|^3", "msup{{|r|}|3}"},
        {"floor(a/2)", "{⌊mfrac{a|2}⌋}"},
        {"mod(a + 1, 2 b)", "{(a+1)}mod2~b"},
        /* functions */
        {"sin(a)", "sin@{(a)}"},
        {"sin(a)^2", "msup{sin|2}@{(a)}"},
        {"sin(a)^-1", "msup{{(sin@{(a)})}|{−1}}"},
        {"sin(a)^b", "msup{{(sin@{(a)})}|b}"},
        {"asin(a)", "arcsin@{(a)}"},
        {"acos(a)", "arccos@{(a)}"},
        {"atan(a)", "arctan@{(a)}"},
        {"atan2(a, b)", "atan2@{(a,b)}"},
        {"log(a)", "ln@{(a)}"},
        {"exp(-a)", "exp@{(−a)}"},
        {"sign(a)", "sgn@{(a)}"},
        {"erf(a)", "erf@{(a)}"},
        {"min(a, b, c)", "min@{(a,b,c)}"},
        {"min(a, b)^2", "msup{{(min@{(a,b)})}|2}"},
        {"hypot(a, b)", "hypot@{(a,b)}"},
        {"tanh(a)^3 b", "msup{tanh|3}@{(a)}~b"},
        /* functions of one's own, derivatives */
        {"V(a)^2 b", "msup{{V@{(a)}}|2}~b"},
        {"W(a, x)", "{W@{(a,x)}}"},
        {"V(a/b)", "{V@{(mfrac{a|b})}}"},
        {"diff(V(a), a)", "mfrac{{∂{V@{(a)}}}|{∂a}}"},
        {"diff(x, x')", "mfrac{{∂x}|{∂msup{x|′}}}"},
        {"diff(a^2 b, a) c", "mfrac{∂|{∂a}}{(msup{a|2}~b)}~c"},
        {"a^diff(V(b), b)", "msup{a|{{∂{V@{(b)}}}/{∂b}}}"},
        {"diff(V(a), a)^2", "msup{{(mfrac{{∂{V@{(a)}}}|{∂a}})}|2}"},
        /* vectors and lists */
        {"(a, -b, 0)", "{(a,−b,0)}"},
        {"[1, a]", "{[1,a]}"},
        {"dot(r, s)", "r⋅s"},
        {"dot(2 r, s)", "{(2~r)}⋅s"},
        {"a dot(r, s)", "a~{(r⋅s)}"},
        {"-cross(r, s)", "−r×s"},
        {"a r × s", "a~r×s"},
        {"a r · (r + s)", "a~r⋅{(r+s)}"},
        {"dot(cross(r, s), r)", "{(r×s)}⋅r"},
        {"a (1, 2)", "a⋅{(1,2)}"},
        /* choices and comparisons */
        {"if(a < b, 1, 2)", "{{mtable{mtr{mtd{1}|mtd{if_a<b}}mtr{mtd{2}|mtd{otherwise}}}}"},
        {"if(a <= b and not (b >= c or a == 1), 1, if(a != b, 2, a))",
         "{{mtable{mtr{mtd{1}|mtd{if_a≤b_and_not_{(b≥c_or_a=1)}}}mtr{mtd{2}|mtd{if_a≠b}}mtr{mtd{a}|mtd{otherwise}}}}"},
        {"if((a < b or b < c) and not not (a < c and b < a), 1, 2)",
         "{{mtable{mtr{mtd{1}|mtd{if_{(a<b_or_b<c)}_and_not_not_{(a<c_and_b<a)}}}mtr{mtd{2}|mtd{otherwise}}}}"},
        {"a (b < c <= n)", "a~{(b<c≤n)}"},
        {"not 1 < a < b and b == c == n", "not_1<a<b_and_b=c=n"},
        {"if(a < b or (b < c or a > b and c > a), 1, 2)",
         "{{mtable{mtr{mtd{1}|mtd{if_a<b_or_{(b<c_or_a>b_and_c>a)}}}mtr{mtd{2}|mtd{otherwise}}}}"},
        {"if(a > 1, 1, 2) b", "{({{mtable{mtr{mtd{1}|mtd{if_a>1}}mtr{mtd{2}|mtd{otherwise}}}})}~b"},
        {"b + if(a > 1, 1, 2)", "b+{{mtable{mtr{mtd{1}|mtd{if_a>1}}mtr{mtd{2}|mtd{otherwise}}}}"},
        /* sums */
        {"sum(i = 1..n: q[i]) + 1", "munderover{∑|{i=1}|n}msub{q|i}+1"},
        {"sum(i = 1..3: q[i] + 1)", "munderover{∑|{i=1}|3}{(msub{q|i}+1)}"},
        {"sum(i = 1..3, i != 2 or a > 1, i > 0: q[i])", "munderover{∑|{i=1,{(i≠2_or_a>1)},i>0}|3}msub{q|i}"},
        {"sum(i = 1..3, j1 = i..n + 1, i != j1: q[i])",
         "munderover{∑|{i=1}|3}munderover{∑|{msub{j|1}=i,i≠msub{j|1}}|{n+1}}msub{q|i}"},
        {"sum(i = 1..3: q[i]) a", "{(munderover{∑|{i=1}|3}msub{q|i})}~a"},
        {"a sum(i = 1..3: q[i])", "a~munderover{∑|{i=1}|3}msub{q|i}"},
        {"sum(i = 1..3: q[i])^2", "msup{{(munderover{∑|{i=1}|3}msub{q|i})}|2}"},
        {"a sum(i = 1..3: q[i]) b", "a~{(munderover{∑|{i=1}|3}msub{q|i})}~b"},
        {"sum(i = 1..3: if(i == 2, 1, 0)) + 1",
         "munderover{∑|{i=1}|3}{({{mtable{mtr{mtd{1}|mtd{if_i=2}}mtr{mtd{0}|mtd{otherwise}}}})}+1"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char line[512], expected[512];
        snprintf(line, sizeof line, "e = %s", cases[k][0]);
        snprintf(expected, sizeof expected, "e=%s", cases[k][1]);
        same(line, expected);
    }
}

/* Complete statements, with their tags ----------------------------------------------------------------------------- */

static void statements(void **state)
{
    (void)state;
    static const char *const cases[][2] = {
        {"z'' = 0\nz(0) = 1\nz'(0) = 0\ninvariant energy = z'^2/2", "energy=mfrac{msup{z|{′2}}|2}"},
        {"f' = x\nf(0) = 0", "{f@{(0)}}=0"},
        {"g[i]'' = -g[i] for i = 1..5\ng[0] = 1\ng[i](0) = i for i = 1..5\ng[i]'(0) = 0 for i = 1..5",
         "{msubsup{g|i|′}@{(0)}}=0 {for_i=1,…,5}"},
        {"g[i, k]'' = 0 for i = 1..2, k = n..3\ng[i, k](0) = 0 for i = 1..2, k = n..3\ng[i, k]'(0) = 0 for i = 1..1, k "
         "= n..3\ng[2, k]'(0) = 1 for k = n..3",
         "{msubsup{g|{2,k}|′}@{(0)}}=1 {for_k=n,…,3}"},
        {"F(p, q) = p + q", "{F@{(p,q)}}=p+q"},
        {"step pi/1000", "step_mfrac{π|1000}"},
        {"every 10 steps", "every_10_steps"},
        {"every 0.1", "every_0.1"},
        {"time s_1", "time_msub{s|1}"},
        {"z(0) = 1\nz'(0) = 0\nn z'' + b z = 0", "msup{z|′′}=mfrac{{−b~z}|n}"},
        {"method newmark(1/4, 1/2)", "method_newmark(1/4, 1/2)"},
        {"when y = 0: record", "when_y=0:__record"},
        {"when x = y/2 falling as hit_0: x' = -x', stop after 3",
         "when_x=mfrac{y|2}_falling_as_hit_0:__msup{x|′}=−msup{x|′},_stop_after_3"},
        {"when x > 1 and not y < 2: y = 0, stop", "when_x>1_and_not_y<2:__y=0,_stop"},
        {"when every 1/2 as tick: q[i] = 0 for i = 1..3", "when_every_mfrac{1|2}_as_tick:__msub{q|i}=0 {for_i=1,…,3}"},
        {"when x = 0 as hit: record\nwhen hit accumulates: stop", "when_hit_accumulates:__stop"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) same(cases[k][0], cases[k][1]);

    same("", "{msubsup{u|{i,j}|′}@{(0)}}=0 {for_i=1,…,3_and_j=1,2}");
}

/* The kind and the line of each statement. */
static void kinds(void **state)
{
    (void)state;
    static const struct {
        motus_statement_kind kind;
        int line;
        const char *name, *in_short;
    } expected[] = {{MOTUS_STATEMENT_PARAMETER, 2, "k", "k=1"},
                    {MOTUS_STATEMENT_MOTION, 4, "x", "msup{x|′′}=−k~x"},
                    {MOTUS_STATEMENT_START, 5, "x", "{x@{(0)}}=1"},
                    {MOTUS_STATEMENT_START, 6, "x", "{msup{x|′}@{(0)}}=0"},
                    {MOTUS_STATEMENT_INVARIANT, 7, "energy", "energy=mfrac{msup{x|{′2}}|2}+mfrac{msup{x|2}|2}"},
                    {MOTUS_STATEMENT_QUANTITY, 8, "v", "v=msup{x|′}"},
                    {MOTUS_STATEMENT_MOTION, 10, "u", "msubsup{u|i|′′}=msub{u|{i+1}}−msub{u|i} {for_i=1}"},
                    {MOTUS_STATEMENT_BOUNDARY, 11, "u", "msub{u|2}=sin@{(t)}"},
                    {MOTUS_STATEMENT_START, 12, "u", "{msub{u|i}@{(0)}}=0 {for_i=1}"},
                    {MOTUS_STATEMENT_START, 13, "u", "{msubsup{u|i|′}@{(0)}}=0 {for_i=1}"},
                    {MOTUS_STATEMENT_FIRST_ORDER, 14, "fed", "msup{fed|′}=x"},
                    {MOTUS_STATEMENT_START, 15, "fed", "{fed@{(0)}}=0"},
                    {MOTUS_STATEMENT_SETTING, 16, "until", "until_1"},
                    {MOTUS_STATEMENT_SETTING, 17, "method", "method_verlet"},
                    {MOTUS_STATEMENT_FUNCTION, 18, "F", "{F@{(t)}}=t"},
                    {MOTUS_STATEMENT_EVENT, 19, "event1", "when_x=0:__record"}};
    static char out[ROOM];
    motus_statement one = motus_default_statement();
    motus_system *s = given_text(
        "# a comment\nk = 1\n\nx'' = -k x\nx(0) = 1\nx'(0) = 0\ninvariant energy = x'^2/2 + x^2/2\nv =\n x'\n"
        "u[i]'' = u[i+1] - u[i] for i = 1..1\nu[2] = sin(t)\nu[i](0) = 0 for i = 1..1\nu[i]'(0) = 0 for i = 1..1\n"
        "fed' = x\nfed(0) = 0\nuntil 1\nmethod verlet\nF(t) = t\nwhen x = 0: record\n");
    assert_int_equal(motus_statement_count(s), sizeof expected / sizeof *expected);
    for (size_t k = 0; k < motus_statement_count(s); k++) {
        assert_int_equal(motus_statement_at(s, k, &one), MOTUS_OK);
        assert_int_equal(one.kind, expected[k].kind);
        assert_int_equal(one.line, expected[k].line);
        assert_string_equal(one.name, expected[k].name);
        assert_int_equal(one.is_set, 0);
        assert_string_equal(short_form(s, k, out), expected[k].in_short);
    }
    assert_int_equal(motus_statement_at(s, motus_statement_count(s), &one), MOTUS_ARGUMENT);
    assert_int_equal(motus_statement_at(s, 0, NULL), MOTUS_ARGUMENT);
    assert_int_equal(motus_statement_at(NULL, 0, &one), MOTUS_ARGUMENT);
    assert_null(motus_statement_mathml(s, motus_statement_count(s)));
    assert_null(motus_statement_mathml(NULL, 0));
    motus_system_destroy(s);
}

/* The exact output. */
static void letters(void **state)
{
    (void)state;
    static const char *const expected[] = {
        "<mi>ω</mi><mo>=</mo><mn>2</mn>",
        "<msup><mi>x</mi><mo class=\"prime\">′′</mo></msup><mo>=</mo><mo "
        "form=\"prefix\">−</mo><msup><mi>ω</mi><mn>2</mn></msup><mo>&#x2062;</mo><mi>x</mi>",
        "<mrow><mi>x</mi><mo>&#x2061;</mo><mrow><mo stretchy=\"false\">(</mo><mn>0</mn><mo "
        "stretchy=\"false\">)</mo></mrow></mrow><mo>=</mo><mn>1</mn>",
        "<mrow><msup><mi>x</mi><mo class=\"prime\">′</mo></msup><mo>&#x2061;</mo><mrow><mo "
        "stretchy=\"false\">(</mo><mn>0</mn><mo stretchy=\"false\">)</mo>"
        "</mrow></mrow><mo>=</mo><mrow><mo form=\"prefix\" stretchy=\"false\">|</mo><mi>ω</mi><mo form=\"postfix\" "
        "stretchy=\"false\">|</mo></mrow>",
        "<mrow><mi>x</mi><mo>&#x2061;</mo><mrow><mo stretchy=\"false\">(</mo><mi>t</mi><mo "
        "stretchy=\"false\">)</mo></mrow></mrow><mo>=</mo>"
        "<mi>cos</mi><mo>&#x2061;</mo><mrow><mo stretchy=\"false\">(</mo><mi>ω</mi><mo>&#x2062;</mo><mi>t</mi><mo "
        "stretchy=\"false\">)</mo></mrow><mo>+</mo>"
        "<mi>sin</mi><mo>&#x2061;</mo><mrow><mo>(</mo><mfrac><mrow><mn>2</mn><mo>&#x2062;</mo><mi>ω</mi><mo>&#x2062;</"
        "mo><mi>t</mi></mrow><mn>2</mn></mfrac>"
        "<mo>)</mo></mrow>",
        "<mtext>step&#xA0;</mtext><mn>0.1</mn>"};
    motus_system *s = given_text("omega = 2\nx'' = -omega^2 x\nx(0) = 1\nx'(0) = |omega|\nexact x = cos(omega t) + "
                                 "sin(2 omega t/2)\nstep 0.1\n");
    for (size_t k = 0; k < sizeof expected / sizeof *expected; k++) {
        char whole[1024];
        snprintf(whole, sizeof whole, "<math xmlns=\"http://www.w3.org/1998/Math/MathML\" display=\"block\">%s</math>",
                 expected[k]);
        assert_string_equal(motus_statement_mathml(s, k), whole);
    }
    motus_system_destroy(s);
}

/* Brackets --------------------------------------------------------------------------------------------------------- */

/* Each row puts the text of each column in the place of #. There are brackets where the expression would have another
 * meaning without them; in an exponent quotients are written in a line, and need more of them. */
static void brackets(void **state)
{
    (void)state;
    static const char *const inner[] = {"a + b",
                                        "a - b",
                                        "-a",
                                        "a b",
                                        "a/b",
                                        "a^b",
                                        "2e1",
                                        "mod(a, b)",
                                        "dot(r, s)",
                                        "sin(a)",
                                        "sqrt(a)",
                                        "|a|",
                                        "if(a < b, 1, 2)",
                                        "sum(i = 1..3: q[i])",
                                        "x(0)"};
    static const char *const outer[][2] = {{"(#) + c", ".......(....(.."},
                                           {"c + (#)", "(((....(......."},
                                           {"(#) - c", ".......(....(.."},
                                           {"c - (#)", "(((....(......."},
                                           {"-(#)", "(((....(......."},
                                           {"(#) c", "(((....((...((."},
                                           {"c (#)", "((((...((......"},
                                           {"(#)/c", "..............."},
                                           {"c/(#)", "..............."},
                                           {"(#)^c", "((((((((((..((."},
                                           {"c^(#)", "..............."},
                                           {"c^((#) n)", "(((.(..((...((."},
                                           {"c^(n (#))", "(((((..((......"},
                                           {"c^((#)/n)", "(((....((...((."},
                                           {"c^(n/(#))", "(((((..((......"},
                                           {"mod((#), c)", "(((....((...((."},
                                           {"mod(c, (#))", "(((....((......"},
                                           {"|(#)|", "..............."},
                                           {"exp((#))", "..............."},
                                           {"sqrt((#)^2)", "(((((((((...((."},
                                           {"sum(k = 1..2: (#))", "(((....(......."},
                                           {"if((#) < c, 1, 2)", "............(.."},
                                           {"if(c > (#), 1, 2)", "..............."},
                                           {"((#), 1)", "..............."}};
    static char out[ROOM];
    for (size_t i = 0; i < sizeof outer / sizeof *outer; i++) {
        char is[sizeof inner / sizeof *inner + 1] = "";
        const char *hole = strchr(outer[i][0], '#');
        for (size_t k = 0; k < sizeof inner / sizeof *inner; k++) {
            int count = 0; /* of brackets: in the result, less those of its parts */
            for (int part = 0; part < 3; part++) {
                char line[256];
                const char *in = part == 1 ? "n" : inner[k];
                int before = part == 2 ? 0 : (int)(hole - outer[i][0]);
                snprintf(line, sizeof line, "e = %.*s%s%s", before, outer[i][0], in, part == 2 ? "" : hole + 1);
                last_of(line, out);
                for (const char *at = out; (at = strstr(at, "{(")) != NULL; at++) count += part == 0 ? 1 : -1;
            }
            assert_in_range(count, 0, 1);
            is[k] = count ? '(' : '.';
        }
        if (strcmp(is, outer[i][1])) fail_msg("%s\n  is       %s\n  should be %s", outer[i][0], is, outer[i][1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(expressions), cmocka_unit_test(statements),
                                       cmocka_unit_test(kinds), cmocka_unit_test(letters), cmocka_unit_test(brackets)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
