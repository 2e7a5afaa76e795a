/* What the reference solution claims about itself, for 700 random models: smooth ones, some with kinks and jumps, with
 * late short kicks, with singularities. The truth is that of motion_truth.h.
 *
 * A claim that is below a tenth of the true error fails the test. Of the 700 one in SHARE is tried, the first ones.
 * CLAIMS=n tries n models, of which 2000 take four minutes; CLAIM=k prints model k alone.
 */
#include "test/given.h"

#include "test/motion_kinds.h"
#include "test/motion_truth.h"
#include "test/share.h"

static const char *const kinds[] = {"smooth", "kinked", "late kicks", "singular"};

enum { CELLS = 2 };

static void text_of(const motion *m, char *out, size_t size)
{
    if (m->index) {
        char f[4096];
        motion_print(m, m->force[0], f, sizeof f);
        size_t n = (size_t)snprintf(out, size,
                                    strcmp(m->index, "[j]") ? "x[i]'' = %s" : "x[i]'' = sum(j = 1..2, j == i: %s)", f);
        n += (size_t)snprintf(out + n, size - n, " for i = 1..2\nx[1](0) = %.17g\nx[1]'(0) = %.17g\n", m->cell_x,
                              m->cell_v);
        n += (size_t)snprintf(out + n, size - n, "x[2](0) = %.17g\nx[2]'(0) = %.17g\n", m->x[0], m->v[0]);
        snprintf(out + n, size - n, "until %.17g\n", (double)m->until);
    } else {
        motion_text(m, out, size);
    }
    const size_t n = strlen(out);
    snprintf(out + n, size - n, "step %.17g\n", m->step);
}

/* Claims -------------------------------------------------------------------------------------------------------- */

enum { TIMES = MOTION_TRUTH_TIMES };
typedef enum outcome { TOO_SMALL, SMALL, CLOSE, LARGE, TOO_LARGE, SILENT, NO_TRUTH, FALSE_CLAIM, OUTCOMES } outcome;
static const char *const outcomes[] = {"< 0.1", "0.1 to 1",     "1 to 10",  "10 to 100",
                                       "> 100", "none claimed", "no truth", "claimed without truth"};

/* The largest error of the reference r (NULL: there is none) for the variables, or for this cell of a family. False:
 * there is no truth. */
static bool compare(const motion *m, int cell, motus_reference *r, double *error)
{
    static motion_truth truth;
    motion one = *m;
    if (m->index && cell == 0) one.x[0] = m->cell_x, one.v[0] = m->cell_v;
    quad times[TIMES];
    for (int k = 0; k < TIMES; k++) times[k] = (double)m->until * (k + 1) / TIMES;
    if (motion_truth_find(&one, times, TIMES, false, &truth)) return false;
    for (int k = 0; k < TIMES && r; k++) {
        const double t = (double)times[k];
        double x[MOTION_VARIABLES * CELLS], v[MOTION_VARIABLES * CELLS];
        motus_error err = motus_default_error();
        must(motus_reference_at(r, &t, 1, x, v, &err), &err, "a state of the reference");
        for (int i = 0; i < m->variables; i++) {
            const int at = m->index ? cell : i;
            *error = fmax(*error, (double)motion_absolute(truth.y[k][i] - x[at]));
            *error = fmax(*error, (double)motion_absolute(truth.y[k][m->variables + i] - v[at]));
        }
    }
    return true;
}

static outcome judge(const motion *m, bool told)
{
    char text[16384];
    text_of(m, text, sizeof text);
    if (told) printf("%s", text);
    motus_system *s = given_text(text);
    motus_study_def def = motus_default_study();
    motus_error err = motus_default_error();
    motus_reference *r;
    const motus_status status = motus_reference_create(s, &def, &r, &err);
    if (status != MOTUS_OK && status != MOTUS_DIVERGED) fail_msg("%s\n%s", text, err.message);
    double error = 0;
    bool truth = true;
    const int cells = m->index ? CELLS : 1;
    for (int cell = 0; cell < cells && truth; cell++) truth = compare(m, cell, status == MOTUS_OK ? r : NULL, &error);
    const double claim = status == MOTUS_OK ? motus_reference_error(r) : NAN;
    if (told)
        printf("%s: claimed %.3g, true %.3g, truth %d\n", status == MOTUS_OK ? motus_reference_name(r) : err.message,
               claim, error, truth);
    if (status == MOTUS_OK) motus_reference_destroy(r);
    motus_system_destroy(s);
    if (!truth) return status != MOTUS_OK ? NO_TRUTH : m->kind == MOTION_CLAIM_SINGULAR ? FALSE_CLAIM : NO_TRUTH;
    if (status != MOTUS_OK) return SILENT;
    const double ratio = claim / error;
    return error == 0        ? CLOSE
           : !(ratio >= 0.1) ? TOO_SMALL
           : ratio < 1       ? SMALL
           : ratio < 10      ? CLOSE
           : ratio < 100     ? LARGE
                             : TOO_LARGE;
}

static void claims(void **state)
{
    (void)state;
    const char *all = getenv("CLAIMS"), *one = getenv("CLAIM");
    const int first = one ? atoi(one) : 0, count = one ? 1 : all ? atoi(all) : 700 / share_one_in();
    int counts[MOTION_CLAIMS][OUTCOMES] = {0}, sums[MOTION_CLAIMS] = {0};
    for (int k = first; k < first + count; k++) {
        motion m;
        motion_kinds_claim(&m, k);
        const outcome o = judge(&m, one);
        counts[m.kind][o]++;
        sums[m.kind]++;
        if (o == TOO_SMALL || o == FALSE_CLAIM || getenv("CLAIMS_ALL"))
            printf("model %d (%s): %s\n", k, kinds[m.kind], outcomes[o]);
    }
    printf("claimed error by true error\n%12s", "");
    for (int o = 0; o < OUTCOMES; o++) printf("  %s", outcomes[o]);
    for (int kind = 0; kind < MOTION_CLAIMS; kind++) {
        printf("\n%12s", kinds[kind]);
        for (int o = 0; o < OUTCOMES; o++) printf("  %*d", (int)strlen(outcomes[o]), counts[kind][o]);
    }
    printf("\n");
    for (int kind = 0; kind < MOTION_CLAIMS; kind++) {
        assert_int_equal(counts[kind][TOO_SMALL], 0);
        assert_int_equal(counts[kind][FALSE_CLAIM], 0);
    }
    if (one) return;
    assert_true(20 * counts[MOTION_CLAIM_SMOOTH][TOO_LARGE] <= sums[MOTION_CLAIM_SMOOTH]);
}

int main(void)
{
    motion_round_numbers(true); /* the reference is that of the doubles */
    const struct CMUnitTest tests[] = {cmocka_unit_test(claims)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
