/* Statements as MathML in a page that shows untrusted models: all text of the model is escaped; what is large or deep
 * is cut, and still well-formed; every model of models/ can be shown; changes by `set` are shown.
 */
#include "test/given.h"
#include "test/mathml.h"

#include <dirent.h>

enum { ROOM = 1 << 20, BYTES_MAX = (1 << 16) + (1 << 15) };

static char out[ROOM];

/* Checks that every statement is well-formed and bounded; out: the last, in short form. */
static int all_well(motus_system *s, const char *what)
{
    int deepest = 0;
    for (size_t k = 0; k < motus_statement_count(s); k++) {
        int depth = 0;
        const char *text = motus_statement_mathml(s, k), *wrong;
        assert_non_null(text);
        assert_true(strlen(text) < BYTES_MAX);
        wrong = mathml_read(text, out, ROOM, &depth);
        if (wrong) fail_msg("%s: %s: %.2000s", what, wrong, text);
        deepest = depth > deepest ? depth : deepest;
    }
    return deepest;
}

static void models(void **state)
{
    (void)state;
    int read = 0;
    DIR *folder = opendir(MOTUS_SOURCE_DIR "/models");
    assert_non_null(folder);
    for (struct dirent *entry; (entry = readdir(folder)) != NULL;) {
        if (!strstr(entry->d_name, ".motus")) continue;
        char path[1024], *text;
        given_path(path, sizeof path, "models", entry->d_name);
        text = given_file(path);
        motus_system *s = given_text(text);
        assert_true(motus_statement_count(s) >= 4);
        assert_in_range(all_well(s, entry->d_name), 3, 40);
        assert_null(strstr(out, "⋯")); /* none of them is cut */
        /* Each statement begins with its name, in the line that it reports. */
        for (size_t k = 0; k < motus_statement_count(s); k++) {
            motus_statement one = motus_default_statement();
            assert_int_equal(motus_statement_at(s, k, &one), MOTUS_OK);
            const char *line = text;
            for (int i = 1; i < one.line; i++) line = strchr(line, '\n') + 1;
            if (!strncmp(line, "when ", 5)) continue; /* its name stands behind `as` */
            line += !strncmp(line, "invariant ", 10) ? 10 : !strncmp(line, "exact ", 6) ? 6 : 0;
            if (strncmp(line, one.name, strlen(one.name)))
                fail_msg("%s: line %d does not begin with %s", entry->d_name, one.line, one.name);
        }
        motus_system_destroy(s);
        free(text);
        read++;
    }
    closedir(folder);
    assert_true(read >= 18);
}

/* A model has no free text: a method that there is not is refused, with a message that a terminal can show. */
static void nasty_methods(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        motus_status status;
    } cases[] = {{"</math><script>alert(1)</script>", MOTUS_METHOD},
                 {"\"a\" 'b' & &amp ]]>", MOTUS_METHOD},
                 {"rk4 </math>", MOTUS_METHOD},
                 {"é", MOTUS_METHOD},
                 {"a\001b\x7F\tc", MOTUS_SYNTAX},
                 {"\xFF\xC3(\xED\xA0\x80\xEF\xBF\xBF\xC2\x85\xF4\x90\x80\x80\xC0\xBC", MOTUS_SYNTAX},
                 {"é\xE2\x82", MOTUS_SYNTAX}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char text[512];
        motus_system *s = NULL;
        motus_error err = motus_default_error();
        motus_text_def def = motus_default_text();
        snprintf(text, sizeof text, "z'' = -z\nz(0) = 1\nz'(0) = 0\nmethod %s\n", cases[k].name);
        def.text = text;
        assert_int_equal(motus_system_from_text(&def, &s, &err), cases[k].status);
        assert_int_equal(err.line, 4);
        assert_int_equal(err.column, 8);
        for (const char *c = err.message; *c; c++) assert_true((unsigned char)*c >= 0x20 && *c != 0x7F);
        motus_system_destroy(s);
    }
}

static void nasty(void **state)
{
    (void)state;
    static const char *const cases[][2] = {
        {"ключ_ё2 = 1", "msub{ключ|ё2}=1"},
        {"名前₁ = 1", "msub{名前|1}=1"},
        {"𝔵 = 1", "𝔵=1"},
        {"x_\xCC\xB8y = 1", "x_\xCC\xB8y=1"}, /* a combining stroke would cross out the end of a tag */
        {"__ = 1", "__=1"},
        {"a_b_c = 1", "msub{a|b,c}=1"},
        {"a₊₍ₙ₎ = 1", "msub{a|+(n)}=1"},
        {"Α = 1", "Α=1"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char text[512];
        snprintf(text, sizeof text, "z'' = -z\nz(0) = 1\nz'(0) = 0\n%s\n", cases[k][0]);
        motus_system *s = given_text(text);
        all_well(s, cases[k][0]);
        if (cases[k][1] && strcmp(out, cases[k][1]))
            fail_msg("%s\n  is       %s\n  should be %s", cases[k][0], out, cases[k][1]);
        motus_system_destroy(s);
    }
}

/* Limits ----------------------------------------------------------------------------------------------------------- */

typedef struct text {
    char *bytes;
    size_t length, room;
} text;

static void write_times(text *t, const char *s, size_t times)
{
    size_t n = strlen(s), wanted = t->length + n * times + 1;
    if (wanted > t->room) {
        t->room = 2 * wanted;
        t->bytes = realloc(t->bytes, t->room);
        assert_non_null(t->bytes);
    }
    for (; times > 0; times--, t->length += n) memcpy(t->bytes + t->length, s, n);
    t->bytes[t->length] = 0;
}

/* The depth of a model whose last line is  before, open × times, middle, close × times, behind. */
static int depth_of(const char *before, const char *open, size_t times, const char *middle, const char *close,
                    const char *behind)
{
    text t = {0};
    write_times(&t, "k = 1\nx'' = -x\nx(0) = 1\nx'(0) = 0\n", 1);
    write_times(&t, before, 1);
    write_times(&t, open, times);
    write_times(&t, middle, 1);
    write_times(&t, close, times);
    write_times(&t, behind, 1);
    motus_system *s = given_text(t.bytes);
    int depth = all_well(s, open);
    motus_system_destroy(s);
    free(t.bytes);
    return depth;
}

static size_t count_of(const char *what)
{
    size_t count = 0;
    for (const char *at = out; (at = strstr(at, what)) != NULL; at += strlen(what)) count++;
    return count;
}

static void limits(void **state)
{
    (void)state;
    /* Long chains are cut after their beginning. */
    depth_of("a1 = 2\ne = a1", " + x", 50000, "", "", "\n");
    assert_int_equal(strncmp(out, "e=msub{a|1}+x+x+", 16), 0);
    assert_int_equal(count_of("x"), 64);
    assert_non_null(strstr(out, "+⋯"));
    depth_of("e = x", " k", 50000, "", "", "\n");
    assert_int_equal(count_of("k"), 64);
    depth_of("e = if(x > 0", " or x > k", 5000, "", "", ", 1, 2)\n");
    assert_int_equal(count_of("_or_"), 65);
    depth_of("e = if(x > 0", " and x > k", 64, "", "", ", 1, 2)\n");
    assert_null(strstr(out, "⋯")); /* 65 terms are not too many */
    depth_of("e = [1", ", 2", 50000, "", "", "]\n");
    assert_string_equal(out, "e={[1,2,2,2,2,2,2,2,2,2,…,2]}");
    depth_of("e = min(k", ", x", 11, "", "", ")\n");
    assert_string_equal(out, "e=min@{(k,x,x,x,x,x,x,x,x,x,x,x)}");
    depth_of("e = 1.", "1", 100000, "", "", "\n");
    assert_int_equal(count_of("1"), 47);
    assert_non_null(strstr(out, "…"));
    /* Deep expressions are cut inside. */
    static const char *const deep[][5] = {{"e = ", "1+(", "x", ")", "\n"},
                                          {"e = ", "sin(", "x", ")", "\n"},
                                          {"e = ", "x^(", "x", ")", "\n"},
                                          {"e = x", "/k", "", "", "\n"},
                                          {"e = ", "1/(k+", "k", ")", "\n"},
                                          {"e = ", "if(x > 0, ", "x", ", 0)+1", "\n"},
                                          {"e = ", "if(if(x > 0, x, 0) > 0, 1, ", "x", "+1)", "\n"},
                                          {"e = ", "sqrt(", "x", ")", "\n"},
                                          {"e = ", "cbrt(1+", "x", ")", "\n"},
                                          {"e = ", "|k+", "x", "|", "\n"},
                                          {"e = ", "-(", "x", ")", "\n"},
                                          {"e = ", "x^x^", "x", "", "\n"},
                                          {"e = ", "(k (", "x", " k)^k)^x", "\n"}};
    for (size_t k = 0; k < sizeof deep / sizeof *deep; k++) {
        size_t times = k + 1 == sizeof deep / sizeof *deep ? 100 : 120;
        int depth = depth_of(deep[k][0], deep[k][1], times, deep[k][2], deep[k][3], deep[k][4]);
        if (depth < 24 || !strstr(out, "…")) fail_msg("%s: depth %d, %.200s", deep[k][1], depth, out);
    }
    depth_of("e = if(", "not ", 120, "x > 0", "", ", 1, 2)\n");
    assert_int_equal(count_of("not"), 48);
    assert_non_null(strstr(out, "…"));
    /* Expressions that branch repeatedly are bounded. */
    text t = {0};
    write_times(&t, "x'' = -x\nx(0) = 1\nx'(0) = 0\ne = ", 1);
    write_times(&t, "(((1/x + (", 6);
    for (int i = 0; i < 40; i++)
        write_times(&t, "sin(x) + |x|^(x + |x|) + min(x^2, x/(x + 1)) + ", 20), write_times(&t, "1/(x + ", 1);
    write_times(&t, "x", 1);
    write_times(&t, ")", 40);
    write_times(&t, "))))", 6);
    write_times(&t, "\n", 1);
    motus_system *s = given_text(t.bytes);
    all_well(s, "branches");
    assert_true(strlen(motus_statement_mathml(s, 3)) > 1 << 16);
    assert_int_equal(count_of("…"), 1);
    motus_system_destroy(s);
    free(t.bytes);
}

/* What `set` says -------------------------------------------------------------------------------------------------- */

static void settings(void **state)
{
    (void)state;
    static const char text[] = "\nF =\n  0.1\nx'' = -x + F\nx(0) = 1\nx'(0) = 0\nu[i]'' = 0 for i = 1..3\nu[1](0) = "
                               "1\nu[i](0) = 2 for i = 2..3\nu[i]'(0) = 0 for i = 1..3\nG = F\n";
    const char *const set[] = {"F = 7", "\n\n F = 8e-3", "x(0) = F", "u[2](0) = 5"};
    static const struct {
        int line, is_set;
        const char *in_short;
    } expected[] = {{2, 1, "F={8×msup{10|{−3}}}"},
                    {4, 0, "msup{x|′′}=−x+F"},
                    {5, 1, "{x@{(0)}}=F"},
                    {6, 0, "{msup{x|′}@{(0)}}=0"},
                    {7, 0, "msubsup{u|i|′′}=0 {for_i=1,…,3}"},
                    {8, 0, "{msub{u|1}@{(0)}}=1"},
                    {9, 0, "{msub{u|i}@{(0)}}=2 {for_i=2,3}"},
                    {10, 0, "{msubsup{u|i|′}@{(0)}}=0 {for_i=1,…,3}"},
                    {11, 0, "G=F"},
                    {0, 1, "{msub{u|2}@{(0)}}=5"}};
    motus_system *s = given_text_with(text, set, 4, "set");
    assert_int_equal(motus_statement_count(s), sizeof expected / sizeof *expected);
    for (size_t k = 0; k < motus_statement_count(s); k++) {
        motus_statement one = motus_default_statement();
        const char *wrong;
        assert_int_equal(motus_statement_at(s, k, &one), MOTUS_OK);
        wrong = mathml_read(motus_statement_mathml(s, k), out, ROOM, NULL);
        assert_null(wrong);
        assert_string_equal(out, expected[k].in_short);
        assert_int_equal(one.line, expected[k].line);
        assert_int_equal(one.is_set, expected[k].is_set);
    }
    motus_system_destroy(s);
}

/* A quantity cannot be set, not even twice. */
static void set_twice(void **state)
{
    (void)state;
    const char *const set[] = {"F = 1", "F = 2"};
    motus_error err = motus_default_error();
    motus_text_def def = motus_default_text();
    motus_system *s = NULL;
    def.text = "F = cos(t)\nx'' = F\nx(0) = 0\nx'(0) = 0\n";
    def.set = set;
    for (def.set_count = 1; def.set_count <= 2; def.set_count++) {
        assert_int_equal(motus_system_from_text(&def, &s, &err), MOTUS_ARGUMENT);
        assert_non_null(strstr(err.message, "F is a quantity"));
    }
}

static int still(void *context, double t, const double *x, const double *v, double *a)
{
    (void)context, (void)t, (void)x, (void)v;
    a[0] = 0;
    return 0;
}

static void callback(void **state)
{
    (void)state;
    double one = 1;
    motus_callback_def def = motus_default_callback();
    motus_system *s = NULL;
    motus_statement statement = motus_default_statement();
    def.positions = 1;
    def.x = def.v = &one;
    def.acceleration = still;
    must(motus_system_from_callback(&def, &s, NULL), NULL, "callback");
    assert_int_equal(motus_statement_count(s), 0);
    assert_int_equal(motus_statement_at(s, 0, &statement), MOTUS_ARGUMENT);
    assert_null(motus_statement_mathml(s, 0));
    motus_system_destroy(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(models),   cmocka_unit_test(nasty_methods),
                                       cmocka_unit_test(nasty),    cmocka_unit_test(limits),
                                       cmocka_unit_test(settings), cmocka_unit_test(set_twice),
                                       cmocka_unit_test(callback)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
