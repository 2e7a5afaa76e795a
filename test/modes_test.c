/* Modes that a host program may have set and the library must neither depend on nor change: the rounding mode,
 * flushing to zero, the locale.
 */
#include "base/decimal.h"
#include "test/given.h"

#include <fenv.h>
#include <locale.h>
#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

/* A motion that decays through the subnormal numbers, where flushing would change it. */
static const char dying[] =
    "x'' = -2 x' - 3 x\nx(0) = 1e-300\nx'(0) = 0\ny'' = -sin(y)\ny(0) = 1.1\ny'(0) = 1/3\nq = x y + 1/3\n"
    "invariant e = y'^2/2 - cos(y)\n";

static uint64_t everything(void)
{
    uint64_t h = 14695981039346656037u;
    motus_system *s = given_text(dying);
    static const char *const methods[] = {"rk4", "verlet", "gauss6", "newmark(1/6, 1/2)"};
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        motus_run *r = given_run(s, methods[i], 0.013, 30), *again = given_run(s, methods[i], 0.013, 30);
        size_t columns[8], all = motus_column_count(s);
        double out[8], t[2] = {29.5, 29.999};
        for (size_t k = 0; k < all; k++) columns[k] = k;
        motus_error err = motus_default_error();
        take_steps(r, 2000);
        const char *text;
        size_t length;
        must(motus_run_save(r, &text, &length, &err), &err, "save");
        must(motus_run_restore(again, text, length, &err), &err, "restore");
        for (int turn = 0; turn < 2; turn++, r = again) {
            for (int j = 0; j < 2; j++) {
                must(motus_run_sample(r, &t[j], 1, columns, all, out, &err), &err, "sample");
                for (size_t k = 0; k < all * sizeof *out; k++) h = (h ^ ((unsigned char *)out)[k]) * 1099511628211u;
            }
            finish(r);
            must(motus_run_values(r, columns, all, out, &err), &err, "values");
            for (size_t k = 0; k < all * sizeof *out; k++) h = (h ^ ((unsigned char *)out)[k]) * 1099511628211u;
            motus_run_destroy(r);
        }
    }
    motus_study_def def = motus_default_study();
    motus_comparison *c = NULL;
    motus_error err = motus_default_error();
    def.methods = methods;
    def.method_count = 2;
    def.step = 0.05;
    def.until = 2;
    must(motus_compare(s, &def, &c, &err), &err, "compare");
    for (size_t i = 0; i < c->row_count; i++) {
        const motus_compare_row *row = c->rows[i];
        const double numbers[] = {row->error_max_x,         row->error_max_v, row->error_final_x,
                                  row->error_final_v,       row->reversal,    row->invariants[0]->max_drift,
                                  row->invariants[0]->trend};
        for (size_t k = 0; k < sizeof numbers; k++) h = (h ^ ((const unsigned char *)numbers)[k]) * 1099511628211u;
    }
    motus_comparison_destroy(c);
    motus_system_destroy(s);
    return h;
}

static void rounding_and_flush_modes(void **state)
{
    (void)state;
    uint64_t plain = everything();
    static const int roundings[] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    for (int i = 0; i < 4; i++)
        for (int flush = 0; flush < 2; flush++) {
            fesetround(roundings[i]);
#if defined(__x86_64__)
            unsigned before = _mm_getcsr();
            if (flush) _mm_setcsr(before | 0x8040); /* flush to zero, denormals are zero */
            unsigned set = _mm_getcsr() & ~0x3Fu;
#endif
            uint64_t other = everything();
            int rounding = fegetround();
#if defined(__x86_64__)
            unsigned after = _mm_getcsr() & ~0x3Fu; /* except the exception flags */
            _mm_setcsr(before);
#endif
            fesetround(FE_TONEAREST);
            assert_int_equal(rounding, roundings[i]);
#if defined(__x86_64__)
            assert_int_equal(after, set);
#endif
            if (other != plain)
                fail_msg("with rounding mode %d%s the bits are others", roundings[i], flush ? " and flushing" : "");
        }
}

/* A locale with a decimal comma: one that the system has, or one made for the occasion. */
static int decimal_comma(char *folder)
{
    static const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "nl_NL.UTF-8", "pt_BR.UTF-8"};
    for (int made = 0; made < 2; made++) {
        for (size_t i = 0; i < sizeof names / sizeof *names; i++)
            if (setlocale(LC_ALL, names[i]) && !strcmp(localeconv()->decimal_point, ",")) return 1;
        char command[256];
        snprintf(command, sizeof command, "localedef --no-archive -i de_DE -f UTF-8 %s/de_DE.UTF-8 >%s/log 2>&1",
                 folder, folder);
        if (made || system(command) == -1 || setenv("LOCPATH", folder, 1)) return 0;
    }
    return 0;
}

/* Whether a number in a text has a decimal comma. */
static int has_comma(const char *text)
{
    for (const char *c = strchr(text, ','); c; c = strchr(c + 1, ','))
        if (c > text && strchr("0123456789", c[-1]) && c[1] && strchr("0123456789", c[1])) return 1;
    return 0;
}

static void a_decimal_comma_changes_nothing(void **state)
{
    (void)state;
    char folder[] = P_tmpdir "/motus-locale-XXXXXX", command[64];
    uint64_t plain = everything();
    assert_non_null(mkdtemp(folder));
    int found = decimal_comma(folder);
    snprintf(command, sizeof command, "rm -r %s", folder);
    assert_int_equal(system(command), 0);
    if (!found) {
        setlocale(LC_ALL, "C");
        skip();
    }
    uint64_t other = everything();
    char digits[DECIMAL_MAX], fast[DECIMAL_MAX];
    double read = 0;
    decimal_write_plain(-0.1, digits);
    decimal_write(-0.1, fast);
    const size_t length = decimal_read("2.5e-1,5", SIZE_MAX, &read);
    motus_system *s = given_text("k = 2.5\nx'' = -k x\nx(0) = 0.5\nx'(0) = 0\nmethod newmark(0.25, 0.5)\n");
    motus_run *r = given_run(s, NULL, 0.125, 1);
    char equation[64], method[64], message[MOTUS_TEXT_MAX];
    snprintf(equation, sizeof equation, "%s", motus_equation_text(s, 0));
    snprintf(method, sizeof method, "%s", motus_run_now(r).method);
    double far = 2.5, out, x = value(s, r, "x");
    size_t k = 1;
    motus_error err = motus_default_error();
    motus_status status = motus_run_sample(r, &far, 1, &k, 1, &out, &err);
    snprintf(message, sizeof message, "%s", err.message);
    motus_study_def study = motus_default_study();
    motus_comparison *c = NULL;
    study.step = -1.5;
    motus_status refused = motus_compare(s, &study, &c, &err);
    motus_run_destroy(r);
    motus_system_destroy(s);
    char passes[2 * MOTUS_TEXT_MAX], jumps[MOTUS_TEXT_MAX];
    motus_error what = motus_default_error();
    s = given_text("x'' = -x/(x^2 + 1e-6)^1.5\nx(0) = 1\nx'(0) = 0\nstep 0.01\nuntil 3\n");
    const motus_status unresolved = motus_run_singular(s, NULL, &what);
    snprintf(passes, sizeof passes, "%s %s", what.message, what.hint);
    motus_system_destroy(s);
    motus_run_def def = motus_default_run();
    def.method = "dop853";
    def.switches = MOTUS_SWITCHES_STEP;
    def.until = 30;
    s = given_text("x'' = -x - 0.5 sign(x')\nx(0) = 3\nx'(0) = 0\n");
    must(motus_run_create(s, &def, &r, &what), &what, "run");
    const motus_status stuck = motus_run_finish(r, &what);
    snprintf(jumps, sizeof jumps, "%s", what.message);
    motus_run_destroy(r);
    motus_system_destroy(s);
    setlocale(LC_ALL, "C");
    assert_int_equal(unresolved, MOTUS_UNRESOLVED);
    assert_false(has_comma(passes));
    assert_int_equal(stuck, MOTUS_STEPS);
    if (!strstr(jumps, "jumps from") || has_comma(jumps)) fail_msg("%s", jumps);
    assert_true(other == plain && x == 0.5 && status == MOTUS_ARGUMENT);
    assert_string_equal(method, "newmark(0.25, 0.5)");
    assert_null(strchr(equation, ','));
    assert_non_null(strstr(message, "2.5"));
    assert_int_equal(refused, MOTUS_ARGUMENT);
    assert_non_null(strstr(err.message, "-1.5"));
    assert_string_equal(digits, "-0.1");
    assert_string_equal(fast, "-0.1");
    assert_int_equal(length, 6);
    assert_true(read == 0.25);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rounding_and_flush_modes),
        cmocka_unit_test(a_decimal_comma_changes_nothing),
    };
    return cmocka_run_group_tests_name("the host's modes", tests, NULL, NULL);
}
