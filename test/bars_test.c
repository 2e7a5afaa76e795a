/* Bars of error against motions that are known to 22 digits, test/reference.txt: how many errors are within their bar,
 * and how many bars are tight.
 *
 * Counted are all numbers of all cases of smooth forces at all times of the file, by every method of the catalogue with
 * five steps or tolerances, from coarse ones down to those where round-off rules, at steps and, by dense output,
 * between them. The
 * motions are those of exact decimals, so the bars have to cover the rounding of what the model says. A bar is tight
 * where it is at most 10 times the error, or 4 ulp.
 * Among numbers that are normally distributed 99 % lie within 2.6 standard deviations; a bar that one sample has to set
 * cannot have more than 99 % of the errors and 90 % of the tightness everywhere, and so all are counted together.
 *
 * Of forces with kinks and jumps three motions are known by formulas.
 */
#include "test/given.h"
#include "test/share.h"

enum { LINES_MAX = 2000, TEXT_ROOM = 4096, COLUMNS_MAX = 40, SETS_MAX = 8, TIMES_MAX = 8, CASES_MAX = 60 };

typedef struct known { /* a time and the numbers then */
    double t;
    size_t count;
    char names[COLUMNS_MAX][24];
    long double values[COLUMNS_MAX];
} known;

typedef struct problem_case {
    char label[64], model[64], text[TEXT_ROOM], set[SETS_MAX][64];
    size_t set_count, time_count;
    double step; /* by a method of order 8 */
    known times[TIMES_MAX];
} problem_case;

static problem_case cases[CASES_MAX];
static size_t case_count;

typedef struct tally {
    long counted, covered, tight, withheld, none;
} tally;

static const char *after(const char *line, const char *word)
{
    size_t n = strlen(word);
    return !strncmp(line, word, n) && line[n] == ' ' ? line + n + 1 : NULL;
}

/* Whether a time of the file is a double; else the numbers there are not those of our time. */
static int is_double(const char *digits)
{
    const long double t = strtold(digits, NULL);
    return t == (long double)(double)t && strlen(digits) < 12;
}

static void read_line(char *line, known **at)
{
    problem_case *c = case_count ? &cases[case_count - 1] : NULL;
    const char *v;
    if ((v = after(line, "case"))) {
        assert_true(case_count < CASES_MAX);
        c = &cases[case_count++];
        snprintf(c->label, sizeof c->label, "%s", v);
        *at = NULL;
    } else if (!c || line[0] == '#' || !line[0] || after(line, "method")) {
        if (!line[0]) *at = NULL;
    } else if ((v = after(line, "model"))) {
        snprintf(c->model, sizeof c->model, "%s", v);
    } else if ((v = after(line, "|"))) {
        const size_t n = strlen(c->text);
        snprintf(c->text + n, sizeof c->text - n, "%s\n", v);
    } else if ((v = after(line, "set"))) {
        snprintf(c->set[c->set_count++], sizeof c->set[0], "%s", v);
    } else if ((v = after(line, "step"))) {
        c->step = strtod(v, NULL);
    } else if ((v = after(line, "at"))) {
        char digits[64];
        assert_int_equal(sscanf(v, "%63s", digits), 1);
        assert_true(c->time_count < TIMES_MAX);
        static known other;
        *at = is_double(digits) ? &c->times[c->time_count++] : &other;
        **at = (known){.t = strtod(digits, NULL)};
    } else if (*at) {
        char digits[64];
        known *k = *at;
        assert_true(k->count < COLUMNS_MAX);
        assert_int_equal(sscanf(line, "%23s %63s", k->names[k->count], digits), 2);
        k->values[k->count++] = strtold(digits, NULL);
    }
}

static void read_cases(void)
{
    char path[1024];
    given_path(path, sizeof path, "test", "reference.txt");
    char *text = given_file(path);
    known *at = NULL;
    for (char *p = text, *end; *p; p = end + 1) {
        end = p + strcspn(p, "\n");
        if (!*end) break;
        *end = 0;
        read_line(p, &at);
    }
    free(text);
}

static motus_system *open_case(const problem_case *c)
{
    const char *set[SETS_MAX];
    for (size_t i = 0; i < c->set_count; i++) set[i] = c->set[i];
    return c->model[0] ? given_model(c->model, set, c->set_count)
                       : given_text_with(c->text, set, c->set_count, c->label);
}

static double ulp_of(double value) { return nextafter(fabs(value), INFINITY) - fabs(value); }

static void count(tally *t, double value, double bar, long double truth)
{
    const long double error = fabsl((long double)value - truth);
    if (isnan(bar)) {
        t->none++;
    } else if (isinf(bar)) {
        t->withheld++;
    } else {
        t->counted++;
        t->covered += error <= (long double)bar;
        t->tight += (long double)bar <= 10 * error || bar <= 4 * ulp_of(value);
    }
}

/* One run, with its errors at all times of the case. False: the method does not admit it, or the run fails. */
static int one_run(const problem_case *c, motus_system *s, const char *method, double step, double tolerance,
                   double most, tally *t)
{
    motus_run_def def = motus_default_run();
    motus_error err = motus_default_error();
    motus_run *r = NULL;
    def.method = method;
    if (step > 0)
        def.step = step;
    else
        def.tolerance = tolerance;
    def.until = c->times[c->time_count - 1].t;
    def.start = 0;
    def.machine = "interpreter";
    if (step == 0) def.most_steps = (int64_t)most;
    def.error = MOTUS_BARS_CHEAP;
    if (motus_run_create(s, &def, &r, &err) != MOTUS_OK) return 0;
    motus_status status = MOTUS_OK;
    for (size_t i = 0; i < c->time_count && status == MOTUS_OK; i++) {
        const known *k = &c->times[i];
        size_t columns[COLUMNS_MAX];
        double values[COLUMNS_MAX], errors[COLUMNS_MAX];
        for (size_t n = 0; n < k->count; n++) columns[n] = column(s, k->names[n]);
        status = motus_run_sample_errors(r, &k->t, 1, columns, k->count, values, errors, &err);
        for (size_t n = 0; n < k->count && status == MOTUS_OK; n++) count(t, values[n], errors[n], k->values[n]);
    }
    motus_run_destroy(r);
    return status == MOTUS_OK;
}

static void add(tally *to, const tally *t)
{
    to->counted += t->counted;
    to->covered += t->covered;
    to->tight += t->tight;
    to->withheld += t->withheld;
    to->none += t->none;
}

static double percent(long part, long all) { return all ? 100.0 * (double)part / (double)all : 100; }

static void print_tally(const char *name, const tally *t)
{
    printf("  %-34s %6ld numbers, %5ld withheld, %3ld without; covered %6.2f %%, tight %6.2f %%\n", name, t->counted,
           t->withheld, t->none, percent(t->covered, t->counted), percent(t->tight, t->counted));
}

/* The numbers are the same under the sanitizers, which are several times slower: there the three finest sizes, nine
 * tenths of the work, are left out. */
#ifdef SANITIZED
enum { METHODS_MAX = 128, SIZES = 5, FIRST_SIZE = 3 };
#else
enum { METHODS_MAX = 128, SIZES = 5, FIRST_SIZE = 0 };
#endif

/* The finest of five sizes, in units of the step of the case, and each next one is twice as large: from coarse steps
 * down to those of round-off. */
static double finest(const motus_method *m)
{
    return m->order <= 2 ? 0.25 : m->order <= 5 ? 0.5 : m->order <= 8 ? 1 : 2;
}

static const double WITHIN = 0.9371;

/* Runs that take longer than this are left out: steps times stages times numbers. */
static const double WORK_MAX = 1e5;

static tally all, by_method[METHODS_MAX];

static void one_case(void **state)
{
    const problem_case *c = *state;
    motus_system *s = open_case(c);
    const known *last = &c->times[c->time_count - 1];
    tally here = {0};
    int turn = 0;
    for (size_t m = 0; m < motus_method_count(); m++)
        for (int i = FIRST_SIZE; i < SIZES; i++) {
            const motus_method *card = motus_method_at(m);
            /* every second one is such that the times of the file lie within its steps */
            const double step = card->adaptive ? 0 : c->step * finest(card) * (1 << i) * (i % 2 ? WITHIN : 1);
            const double tolerance = 1e-12 * pow(100, i);
            if (!share_takes(&turn)) continue;
            tally t = {0};
            const double most = WORK_MAX / (card->stages * (double)last->count);
            if (step > 0 && last->t / step > most) continue;
            if (!one_run(c, s, card->name, step, tolerance, most, &t)) continue;
            add(&here, &t);
            add(&by_method[m], &t);
        }
    motus_system_destroy(s);
    add(&all, &here);
    print_tally(c->label, &here);
    assert_true(here.counted > 0 || share_one_in() > 1);
    assert_int_equal(here.none, 0);
    /* Of a share of the cases chance may take more: three standard deviations. */
    const double outside = 0.03 * (double)here.counted, chance = share_one_in() > 1 ? 3 * sqrt(outside) : 0;
    if ((double)(here.counted - here.covered) > outside + chance)
        fail_msg("%s: too few errors are within their bars", c->label);
}

/* Whether an earlier case has the same motion, for another method of another test. */
static int repeats(const problem_case *c)
{
    for (const problem_case *b = cases; b < c; b++)
        if (!strcmp(b->model, c->model) && !strcmp(b->text, c->text) && !memcmp(b->set, c->set, sizeof b->set) &&
            b->time_count)
            return 1;
    return 0;
}

static void all_together(void **state)
{
    (void)state;
    for (size_t m = 0; m < motus_method_count(); m++) print_tally(motus_method_at(m)->name, &by_method[m]);
    print_tally("all", &all);
    assert_true(all.counted > 10000 / share_one_in());
    assert_true(percent(all.covered, all.counted) >= 99);
    assert_true(percent(all.tight, all.counted) >= 90);
}

/* ---- kinks and jumps ---- */

/* Motions from x = 1/2 at rest whose force changes at x = 0: they swing with one frequency on the right and another on
 * the left. 0: the force is constant there. */
typedef struct kinked {
    const char *text;
    long double right, left;
} kinked;

static const long double PI = 3.14159265358979323846264338327950288L;
static const kinked kinks[] = {
    {"x'' = -sign(x)\nx(0) = 0.5\nx'(0) = 0\n", 0, 0},
    {"x'' = -(1 + 3 (x < 0)) x\nx(0) = 0.5\nx'(0) = 0\n", 1, 2},
    {"x'' = -x - 0.5 |x|\nx(0) = 0.5\nx'(0) = 0\n", 1.22474487139158904909864203735294570L,
     0.70710678118654752440084436210484904L},
};
enum { KINKS = sizeof kinks / sizeof *kinks, ENDS = 200, WISHES = 5, TOLERANCES = 3 };

static void known_kinked(const kinked *m, long double t, long double y[2])
{
    if (m->right == 0) { /* parabolas, of two units of time each */
        const long double s = fmodl(t + 1, 4), side = s < 2 ? 1 : -1, at = s < 2 ? s : s - 2;
        y[0] = side * (at - at * at / 2), y[1] = side * (1 - at);
        return;
    }
    const long double half = PI / m->right, s = fmodl(t + half / 2, half + PI / m->left), side = s < half ? 1 : -1;
    const long double rate = s < half ? m->right : m->left, at = s < half ? s : s - half, speed = m->right / 2;
    y[0] = side * speed / rate * sinl(rate * at), y[1] = side * speed * cosl(rate * at);
}

static void kinked_run(const kinked *m, motus_system *s, const char *method, double until, int wish, tally *t)
{
    static const double wishes[WISHES] = {1e-4, 1e-7, 1e-10, 1e-4, 1e-7};
    motus_run_def def = motus_default_run();
    motus_error err = motus_default_error();
    motus_run *r = NULL;
    def.method = method, def.machine = "interpreter", def.error = MOTUS_BARS_CHEAP, def.until = until;
    if (wish < TOLERANCES)
        def.tolerance = wishes[wish];
    else
        def.accuracy = wishes[wish];
    motus_status status = motus_run_create(s, &def, &r, &err);
    if (status == MOTUS_OK) status = motus_run_finish(r, &err);
    if (status != MOTUS_ACCURACY) must(status, &err, method);
    const size_t columns[2] = {1, 2};
    double values[2], errors[2];
    long double truth[2];
    known_kinked(m, until, truth);
    if (status == MOTUS_OK) must(motus_run_errors(r, columns, 2, values, errors, &err), &err, method);
    for (size_t k = 0; k < 2 && status == MOTUS_OK; k++) count(t, values[k], errors[k], truth[k]);
    motus_run_destroy(r);
}

/* Steps and the companion's steps pass a jump at places of their own. */
static void forces_with_kinks(void **state)
{
    (void)state;
    static const char *const methods[] = {"taylor", "dop853", "radau15", "auto"};
    for (int m = 0; m < 4; m++) {
        const int first = strcmp(methods[m], "auto") ? 0 : TOLERANCES; /* auto wants an accuracy */
        tally t = {0};
        int turn = 0;
        for (size_t k = 0; k < KINKS; k++) {
            motus_system *s = given_text(kinks[k].text);
            uint64_t z = 12345 + k;
            for (int i = 0; i < ENDS * (WISHES - first); i++) {
                z = z * 6364136223846793005u + 1442695040888963407u;
                if (!share_takes(&turn)) continue;
                kinked_run(&kinks[k], s, methods[m], 2 + 12 * (double)(z >> 11) * 0x1p-53, first + i / ENDS, &t);
            }
            motus_system_destroy(s);
        }
        print_tally(methods[m], &t);
        assert_true(t.counted > ENDS * 2 * (long)KINKS * (WISHES - first) / share_one_in() * 9 / 10 && t.none == 0);
        if (percent(t.covered, t.counted) < 99) fail_msg("%s: too few errors are within their bars", methods[m]);
        if (percent(t.tight, t.counted) < 90) fail_msg("%s: too few bars are tight", methods[m]);
    }
}

/* ---- numbers that vanish, times that are rounded ---- */

static void end_of(const char *text, double until, const long double *truth, size_t count, double least, double most)
{
    motus_system *s = given_text(text);
    motus_run_def def = motus_default_run();
    motus_error err = motus_default_error();
    motus_run *r = NULL;
    def.error = MOTUS_BARS_CHEAP, def.accuracy = 1e-6, def.machine = "interpreter", def.until = until;
    must(motus_run_create(s, &def, &r, &err), &err, text);
    must(motus_run_finish(r, &err), &err, text);
    for (size_t k = 0; k < count; k++) {
        const size_t column = k + 1;
        double value, error;
        must(motus_run_errors(r, &column, 1, &value, &error, &err), &err, text);
        if (!(fabsl(value - truth[k]) <= error)) fail_msg("%s: number %zu is %g ± %g", text, column, value, error);
        if (!(error >= least && error <= most)) fail_msg("%s: ± %g of number %zu", text, error, column);
    }
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* At a quarter of the period x is 0; pi/2 is a double only nearly. */
static void numbers_that_vanish(void **state)
{
    (void)state;
    static const long double quarter[] = {0, -1}, third[] = {0, 1};
    end_of("x'' = -x\nx(0) = 1\nx'(0) = 0\nuntil pi/2\naccuracy 1e-9", NAN, quarter, 2, 1e-16, 2e-6);
    end_of("x'' = -x\nx(0) = 1\nx'(0) = 0\nuntil 3 pi/2\naccuracy 1e-9", NAN, third, 2, 1e-16, 2e-6);
}

/* 1e9 + 20.3 is 5e-8 before what was written; the double that a caller gives may be meant. Truths: 34 digits. */
static void rounded_ends(void **state)
{
    (void)state;
    static const char text[] = "x'' = -sin(x)\nx(1e9) = -0.504\nx'(1e9) = -0.1\nuntil 1e9 + 20.3";
    static const long double truth[] = {-0.3150195572360L};
    end_of(text, NAN, truth, 1, 1.8e-8, 1e-6);
    end_of(text, 1000000020.3, truth, 1, 1.8e-8, 1e-6);
}

/* Differences of decimals that are rounded alike: what the rounding leaves is in the error, wherever they stand. */
static void decimals_that_cancel(void **state)
{
    (void)state;
    static const long double damped[] = {0.40528393032138L}, late[] = {-0.8129520370998899826L},
                             far[] = {-0.2163963550045140412L};
    static const char *const forces[] = {
        "x'' = -(1000000.85 - 1000000.33) x - 0.1 x'\nx(0) = 1\nx'(0) = 0\nuntil 10",
        "k = 1000000.85 - 1000000.33\nx'' = -k x - 0.1 x'\nx(0) = 1\nx'(0) = 0\nuntil 10",
        "a = 1000000.85\nb = 1000000.33\nx'' = -(a - b) x - 0.1 x'\nx(0) = 1\nx'(0) = 0\nuntil 10"};
    for (size_t k = 0; k < sizeof forces / sizeof *forces; k++) end_of(forces[k], NAN, damped, 1, 5e-11, 1e-8);
    end_of("x'' = -x\nx(0) = 1\nx'(0) = 0\nuntil 1000002.85 - 1000000.33", NAN, late, 1, 1e-11, 1e-8);
    end_of("x'' = -x\nx(0) = 1000000.85 - 1000000.33\nx'(0) = 0\nuntil 2", NAN, far, 1, 1e-11, 1e-8);
}

/* ... also where a parameter gets another number than its text has. */
static void decimals_that_cancel_when_set(void **state)
{
    (void)state;
    const double a = 1000.75;
    motus_error err = motus_default_error();
    motus_system *s = given_text("a = 1000.06\nx'' = a - 1000.69\nx(0) = 0\nx'(0) = 0\nuntil 1");
    must(motus_system_set(s, "a", &a, 1, &err), &err, "a");
    motus_run *r = NULL;
    motus_run_def def = motus_default_run();
    def.method = "dop853", def.machine = "interpreter", def.error = MOTUS_BARS_CHEAP;
    must(motus_run_create(s, &def, &r, &err), &err, "a");
    must(motus_run_finish(r, &err), &err, "a");
    const size_t column = 1;
    double value, error;
    must(motus_run_errors(r, &column, 1, &value, &error, &err), &err, "a");
    if (!(fabs(value - 0.03) <= error && error < 1e-12)) fail_msg("0.03 is %.17g, error %.3g", value, error);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* Of a motion that is cos(t) - 0.839 is 7e-5 from cos(10) -, quantities whose jumps lie within the error of the state,
 * and such as have jumped before and are decided: INFINITY, and at least the truth's distance; and an ulp. */
static void quantities_that_jump(void **state)
{
    (void)state;
    static const char text[] = "x'' = -x\nx(0) = 1\nx'(0) = 0\nbig = if(x > -0.839, 1, 0)\ns = sign(x + 0.839)\n"
                               "turn = x + if(x > -0.839 and x' > 0, 3, 0)\nf = floor(1000 x)\nk = if(x > -0.5, 1, 2)\n"
                               "c = floor(3 sin(t)) + 2\nn = 3\nwhen x = 0: n = n - 1\nodd = if(n > 0, 4, 5)";
    static const double truth[] = {0, -1, -0.839071529, -840, 2, 0, 0, 5},
                        verlet[] = {INFINITY, INFINITY, INFINITY, 1, 0, 0, 0, 0};
    for (int fine = 0; fine < 2; fine++) {
        motus_error err = motus_default_error();
        motus_system *s = given_text(text);
        motus_run *r = NULL;
        motus_run_def def = motus_default_run();
        def.method = fine ? "dop853" : "verlet", def.machine = "interpreter", def.until = 10,
        def.error = MOTUS_BARS_CHEAP;
        if (!fine) def.step = 0.05;
        must(motus_run_create(s, &def, &r, &err), &err, text);
        must(motus_run_finish(r, &err), &err, text);
        size_t column = 0, numbers = 0;
        must(motus_column_find(s, "big", &column, &numbers, &err), &err, "big");
        for (size_t k = 0; k < sizeof truth / sizeof *truth; k++, column++) {
            double value, error;
            must(motus_run_errors(r, &column, 1, &value, &error, &err), &err, text);
            const double least = fine ? 0 : verlet[k], most = fine || least == 0 ? 1e-8 : fmax(1.5, least);
            if (!(fabs(value - truth[k]) <= fmax(error, 1e-9)) || !(error >= least && error <= most))
                fail_msg("quantity %zu is %g ± %g by %s", k, value, error, def.method);
        }
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

int main(void)
{
    static struct CMUnitTest tests[CASES_MAX + 7];
    size_t count = 0;
    read_cases();
    if (motus_method_count() > METHODS_MAX) return 1;
    for (size_t i = 0; i < case_count; i++)
        if (cases[i].time_count && !repeats(&cases[i]))
            tests[count++] =
                (struct CMUnitTest){.name = cases[i].label, .test_func = one_case, .initial_state = &cases[i]};
    tests[count++] = (struct CMUnitTest)cmocka_unit_test(all_together);
    tests[count++] = (struct CMUnitTest)cmocka_unit_test(forces_with_kinks);
    tests[count++] = (struct CMUnitTest)cmocka_unit_test(numbers_that_vanish);
    tests[count++] = (struct CMUnitTest)cmocka_unit_test(rounded_ends);
    tests[count++] = (struct CMUnitTest)cmocka_unit_test(quantities_that_jump);
    tests[count++] = (struct CMUnitTest)cmocka_unit_test(decimals_that_cancel);
    tests[count++] = (struct CMUnitTest)cmocka_unit_test(decimals_that_cancel_when_set);
    return _cmocka_run_group_tests("bars of error", tests, count, NULL, NULL);
}
