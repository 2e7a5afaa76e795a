/* Motions known to 22 digits and more, test/reference.txt, against the library's.
 *
 * The bound of each comparison is computed from the four errors of a computation:
 *   - shift: the numbers of the model are rounded to double precision; how far that alone moves the exact motion is in
 *     the file.
 *   - halving: the method's truncation and rounding, measured as the largest change of any position, and of any
 *     velocity, when the step is halved and halved again, here or at an earlier time of the same case. Truncation of
 *     order p >= 2 is at most 4/3 of it; rounding is of its size, being different at every step size.
 *   - unit: the rounding of the method's step and coefficients, which is the same at every step size, so that halving
 *     does not show it. It acts as if time and numbers were scaled by one part in 2^53, and moves y by
 *     (y + t y') 2^-53.
 *   - nudge: where neighbouring motions diverge, early rounding grows. Measured as the change of the result when every
 *     number of the start is moved by one part in 2^30 of the largest of its kind, scaled to one part in 2^53.
 * The bound is 4 (shift + halving + unit + nudge). `known_test --write` measures halvings and nudges and writes
 * them into the file.
 */
#include "test/given.h"

enum { LINES_MAX = 2000, TEXT_ROOM = 4096, COLUMNS_MAX = 40, SETS_MAX = 8 };
static const double FEW = 4;

typedef struct block { /* the computation, as the lines of a case before its first `at` define it */
    char label[64], model[64], method[32], text[TEXT_ROOM];
    char set[SETS_MAX][64];
    size_t set_count;
    double step;
} block;

static char *lines[LINES_MAX];
static int line_count;
static char path[1024];

static void read_lines(void)
{
    given_path(path, sizeof path, "test", "reference.txt");
    char *text = given_file(path);
    for (char *p = text; *p;) {
        size_t n = strcspn(p, "\n");
        assert_true(line_count < LINES_MAX);
        lines[line_count] = calloc(1, n + 1);
        assert_non_null(lines[line_count]);
        memcpy(lines[line_count++], p, n);
        p += n + (p[n] == '\n');
    }
    free(text);
}

/* The value of a line "word value"; NULL: another word. */
static const char *after(const char *line, const char *word)
{
    size_t n = strlen(word);
    return !strncmp(line, word, n) && line[n] == ' ' ? line + n + 1 : NULL;
}

static motus_system *open_block(const block *b)
{
    const char *set[SETS_MAX];
    for (size_t i = 0; i < b->set_count; i++) set[i] = b->set[i];
    return b->model[0] ? given_model(b->model, set, b->set_count) : given_text(b->text);
}

/* A run with a changed start: every number up or down, by `nudge` times the largest of its kind. */
static motus_run *nudged(motus_system *s, const block *b, double until, double nudge)
{
    size_t nx = motus_positions(s), n = 0;
    motus_run *r = given_run(s, b->method, b->step, until), *moved = NULL;
    double *y = whole_state(s, r, &n), size[2] = {0};
    for (size_t k = 0; k < n; k++) size[k >= nx] = fmax(size[k >= nx], fabs(y[k]));
    for (size_t k = 0; k < n; k++)
        y[k] += (k * k % 5 < 2 ? nudge : -nudge) * size[k >= nx]; /* signs that are not a translation */
    motus_run_def def = motus_default_run();
    motus_error err = motus_default_error();
    def.method = b->method;
    def.step = b->step;
    def.until = until;
    def.start = 0;
    def.x = y;
    def.v = y + nx;
    must(motus_run_create(s, &def, &moved, &err), &err, b->label);
    motus_run_destroy(r);
    free(y);
    return moved;
}

/* The columns at `until`, with the step divided by `parts`, from a start changed by `nudge`; if `rate` is given, also
 * their rate of change in the last step. */
static void compute(const block *b, const char *const *names, size_t count, double until, int parts, double nudge,
                    double *out, double *rate)
{
    motus_system *s = open_block(b);
    motus_run *r = nudge == 0 ? given_run(s, b->method, b->step / parts, until) : nudged(s, b, until, nudge);
    take_steps(r, motus_run_now(r).steps_total - 1);
    double before = motus_run_time(r);
    for (size_t i = 0; rate && i < count; i++) rate[i] = value(s, r, names[i]);
    finish(r);
    for (size_t i = 0; i < count; i++) out[i] = value(s, r, names[i]);
    for (size_t i = 0; rate && i < count; i++) rate[i] = fabs(out[i] - rate[i]) / (until - before);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

static int is_velocity(const char *name) { return strchr(name, '\'') != NULL; }

/* Largest changes, of positions and of velocities. */
static void measure(const block *b, const char *const *names, size_t count, double until, double halving[2],
                    double nudge[2])
{
    double y[4][COLUMNS_MAX];
    for (int i = 0; i < 3; i++) compute(b, names, count, until, 1 << i, 0, y[i], NULL);
    compute(b, names, count, until, 1, 0x1p-30, y[3], NULL);
    halving[0] = halving[1] = nudge[0] = nudge[1] = 0;
    for (size_t k = 0; k < count; k++) {
        int v = is_velocity(names[k]);
        halving[v] = fmax(halving[v], fmax(fabs(y[0][k] - y[1][k]), fabs(y[1][k] - y[2][k])));
        nudge[v] = fmax(nudge[v], 0x1p-23 * fabs(y[3][k] - y[0][k]));
    }
}

/* Reads a line into the block; false: it is not one of the block's. */
static int describes(block *b, const char *line)
{
    const char *v;
    if ((v = after(line, "|"))) {
        size_t n = strlen(b->text);
        snprintf(b->text + n, sizeof b->text - n, "%s\n", v);
        assert_true(strlen(b->text) < sizeof b->text - 1);
    } else if ((v = after(line, "case"))) {
        memset(b, 0, sizeof *b);
        snprintf(b->label, sizeof b->label, "%s", v);
    } else if ((v = after(line, "model")))
        snprintf(b->model, sizeof b->model, "%s", v);
    else if ((v = after(line, "method")))
        snprintf(b->method, sizeof b->method, "%s", v);
    else if ((v = after(line, "set"))) {
        assert_true(b->set_count < SETS_MAX);
        snprintf(b->set[b->set_count++], sizeof b->set[0], "%s", v);
    } else if ((v = after(line, "step")))
        b->step = strtod(v, NULL);
    else
        return line[0] == 0 || line[0] == '#';
    return 1;
}

/* The values that follow line `at`, up to an empty one. */
static size_t read_values(int at, char names[][32], const char **list, double *expected)
{
    size_t n = 0;
    for (int i = at + 1; i < line_count && lines[i][0]; i++, n++) {
        char digits[64];
        assert_true(n < COLUMNS_MAX);
        assert_int_equal(sscanf(lines[i], "%31s %63s", names[n], digits), 2);
        expected[n] = strtod(digits, NULL);
        list[n] = names[n];
    }
    assert_true(n > 0);
    return n;
}

/* The largest so far in a case, of positions and of velocities. */
typedef struct largest {
    double halving[2], nudge[2], size[2], rate[2];
} largest;

static void judge(const block *b, int at, largest *most)
{
    char names[COLUMNS_MAX][32], what[160];
    const char *list[COLUMNS_MAX];
    double until, shift, halving[2], nudge[2], expected[COLUMNS_MAX], got[COLUMNS_MAX], rate[COLUMNS_MAX];
    if (sscanf(lines[at], "at %lf shift %lf halving %lf %lf nudge %lf %lf", &until, &shift, &halving[0], &halving[1],
               &nudge[0], &nudge[1]) != 6)
        fail_msg("reference.txt:%d: %s", at + 1, lines[at]);
    size_t n = read_values(at, names, list, expected);
    compute(b, list, n, until, 1, 0, got, rate);
    for (size_t k = 0; k < n; k++) {
        int v = is_velocity(list[k]);
        most->halving[v] = fmax(most->halving[v], halving[v]);
        most->nudge[v] = fmax(most->nudge[v], nudge[v]);
        most->size[v] = fmax(most->size[v], fabs(expected[k]));
        most->rate[v] = fmax(most->rate[v], rate[k]);
    }
    for (size_t k = 0; k < n; k++) {
        int v = is_velocity(list[k]);
        double unit = ROUNDING * (most->size[v] + until * most->rate[v]);
        snprintf(what, sizeof what, "%s: %s at %.17g by %s", b->label, list[k], until, b->method);
        near(got[k], expected[k], FEW * (shift + most->halving[v] + most->nudge[v] + unit), what);
    }
}

/* One case of the file, from its `case` line on. */
static void one_case(void **state)
{
    block b;
    largest most = {0};
    int judged = 0;
    for (int i = *(int *)*state; i < line_count; i++) {
        if (judged && after(lines[i], "case")) break;
        if (after(lines[i], "at")) {
            judge(&b, i, &most);
            judged++;
        } else if (!judged || !lines[i][0])
            assert_true(describes(&b, lines[i]));
    }
    assert_true(judged > 0);
}

static int write_measures(void)
{
    static block b;
    FILE *f = fopen(path, "w");
    if (!f) return 1;
    for (int i = 0; i < line_count; i++) {
        char names[COLUMNS_MAX][32], until[64], shift[32];
        const char *list[COLUMNS_MAX];
        double expected[COLUMNS_MAX], halving[2], nudge[2];
        if (!after(lines[i], "at")) {
            describes(&b, lines[i]);
            fprintf(f, "%s\n", lines[i]);
            continue;
        }
        if (sscanf(lines[i], "at %63s shift %31s", until, shift) != 2) return fclose(f), 1;
        size_t n = read_values(i, names, list, expected);
        measure(&b, list, n, strtod(until, NULL), halving, nudge);
        fprintf(f, "at %s shift %s halving %.1e %.1e nudge %.1e %.1e\n", until, shift, halving[0], halving[1], nudge[0],
                nudge[1]);
    }
    return fclose(f) != 0;
}

int main(int argc, char **argv)
{
    enum { CASES_MAX = 60 };
    static struct CMUnitTest tests[CASES_MAX];
    static int starts[CASES_MAX];
    size_t count = 0;
    read_lines();
    if (argc > 1 && !strcmp(argv[1], "--write")) return write_measures();
    for (int i = 0; i < line_count && count < CASES_MAX; i++)
        if (after(lines[i], "case")) {
            starts[count] = i;
            tests[count] = (struct CMUnitTest){
                .name = after(lines[i], "case"), .test_func = one_case, .initial_state = &starts[count]};
            count++;
        }
    int failed = _cmocka_run_group_tests("reference values", tests, count, NULL, NULL);
    for (int i = 0; i < line_count; i++) free(lines[i]);
    return failed;
}
