/* The same bits on every machine: each model of models/ by one method of every family, interpreted and compiled; and
 * the cache of compiled objects under damage.
 *
 * A compiled row costs a compiler run, so it takes one row of each family's text (and of each kind of force), and of
 * those one in SHARE; with MOTUS_ALL_ROWS set, all. Steps are few, since different bits differ at once; the longer runs
 * are those of the golden test.
 */
#include "motus.h"
#include "test/given_cache.h"
#include "test/share.h"

#include <dirent.h>
#include <fcntl.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

static char *read_model(const char *name)
{
    char path[512];
    snprintf(path, sizeof path, "%s/models/%s", MOTUS_SOURCE_DIR, name);
    FILE *f = fopen(path, "rb");
    assert_non_null(f);
    static char text[1 << 16];
    size_t n = fread(text, 1, sizeof text - 1, f);
    fclose(f);
    text[n] = 0;
    return text;
}

static motus_system *open_text(const char *text, const char *set)
{
    motus_text_def def = motus_default_text();
    motus_error err = motus_default_error();
    motus_system *s = NULL;
    def.text = text;
    def.set = &set;
    def.set_count = set != NULL;
    if (motus_system_from_text(&def, &s, &err)) fail_msg("%s", err.message);
    return s;
}

enum { STEPS = 40 };

typedef struct end {
    double *state, *between; /* between: two times within one step */
    size_t count;
    int64_t evaluations, iterations;
    motus_status status;
} end;

static motus_status sample_within(motus_run *r, double step, end *e, motus_error *err)
{
    const double now = motus_run_time(r), times[2] = {now + 0.3 * step, now + 0.45 * step};
    size_t *columns = calloc(e->count + 1, sizeof *columns);
    for (size_t k = 0; k < e->count; k++) columns[k] = k + 1;
    const motus_status status = motus_run_sample(r, times, 2, columns, e->count, e->between, err);
    free(columns);
    return status;
}

static end run_on(motus_system *s, const char *machine, const char *method)
{
    motus_settings set = motus_default_settings();
    motus_settings_of(s, &set);
    if (isnan(set.step)) set.step = (set.until - set.from) / 512; /* its method adapts them */
    motus_run_def def = motus_default_run();
    motus_error err = motus_default_error();
    def.machine = machine;
    def.method = method;
    const motus_method *card = NULL;
    motus_method_find(method, &card, NULL);
    def.step = card->adaptive ? NAN : set.step;
    def.longest_step = card->adaptive ? set.step : 0;
    def.until = set.from + STEPS * set.step;
    motus_run *r = NULL;
    end e = {.count = motus_positions(s) + motus_velocities(s)};
    if (motus_run_create(s, &def, &r, &err)) fail_msg("%s by %s: %s", machine, method, err.message);
    assert_string_equal(motus_run_now(r).machine, machine);
    e.state = calloc(e.count + 1, sizeof *e.state);
    e.between = calloc(2 * e.count + 1, sizeof *e.between);
    /* Observes on the way too, since that is another function of the object. */
    e.status = motus_run_step(r, STEPS / 2, &err);
    if (!e.status) e.status = motus_run_state(r, e.state, e.state + motus_positions(s), &err);
    if (!e.status) e.status = sample_within(r, set.step, &e, &err);
    if (!e.status) e.status = motus_run_finish(r, &err);
    if (!e.status) e.status = motus_run_state(r, e.state, e.state + motus_positions(s), &err);
    e.evaluations = motus_run_now(r).evaluations;
    e.iterations = motus_run_now(r).iterations;
    motus_run_destroy(r);
    return e;
}

static void same_bits(motus_system *s, const char *model, const char *method)
{
    end a = run_on(s, "interpreter", method), b = run_on(s, "compiled", method);
    if (a.status != b.status || memcmp(a.state, b.state, a.count * sizeof(double)))
        fail_msg("%s by %s: the compiled machine differs", model, method);
    if (memcmp(a.between, b.between, 2 * a.count * sizeof(double)))
        fail_msg("%s by %s: the compiled machine differs between steps", model, method);
    assert_int_equal(a.evaluations, b.evaluations);
    assert_int_equal(a.iterations, b.iterations);
    free(a.state), free(a.between);
    free(b.state), free(b.between);
}

static bool chosen(const char *name)
{
    static const char *const rows[] = {"verlet",
                                       "blanes-moan6",
                                       "boris",
                                       "rk4",
                                       "newmark",
                                       "gauss4",
                                       "leapfrog",
                                       "kahan-li8",
                                       "dopri5",
                                       "dop853",
                                       "dep6",
                                       "fine5",
                                       "radau15",
                                       "gragg-stormer",
                                       "gragg",
                                       "verlet-reversible",
                                       "kahan-li8-reversible"};
    if (getenv("MOTUS_ALL_ROWS")) return true;
#ifdef SANITIZED
    /* The sanitizers check the library's part, which is the same for every row. */
    return !strcmp(name, "gauss4");
#endif
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (!strcmp(rows[i], name)) return true;
    return false;
}

/* What the texts of families and the emitted acceleration distinguish in a force. */
static unsigned kind_of(const motus_system *s, const char *text)
{
    motus_analysis a = motus_default_analysis();
    assert_int_equal(motus_analysis_of(s, &a), MOTUS_OK);
    const bool facts[] = {a.velocity_dependent,
                          a.linear_in_velocity,
                          a.time_dependent,
                          a.affine,
                          a.gyroscopic,
                          strstr(text, "sum("),
                          strstr(text, "for i"),
                          a.smooth,
                          motus_positions(s) < motus_velocities(s)};
    unsigned kind = 0;
    for (size_t k = 0; k < sizeof facts / sizeof *facts; k++) kind = 2 * kind + facts[k];
    return kind;
}

static int by_name(const struct dirent **a, const struct dirent **b) { return strcmp((*a)->d_name, (*b)->d_name); }

/* Every model by some rows, and every row by a model of each kind of force; with MOTUS_ALL_ROWS all pairs. */
static void every_model(void **state)
{
    enum { KINDS = 1 << 9, TURNS = 4 }; /* a model whose kind a row has had takes every fourth row */
    static unsigned char had[256][KINDS];
    char path[512];
    struct dirent **files;
    int pairs = 0, tried = 0;
    (void)state;
    snprintf(path, sizeof path, "%s/models", MOTUS_SOURCE_DIR);
    const int count = scandir(path, &files, NULL, by_name);
    assert_true(count > 0);
    for (int n = 0; n < count; n++) {
        if (strstr(files[n]->d_name, ".motus")) {
            const char *text = read_model(files[n]->d_name);
            motus_system *s = open_text(text, NULL);
            const unsigned kind = kind_of(s, text);
            int turn = n;
            for (size_t k = 0; k < motus_method_count(); k++) {
                const motus_method *m = motus_method_at(k);
                if (!chosen(m->name) || motus_method_admits(s, m->name, NULL) != MOTUS_OK) continue;
                if (had[k][kind] && turn++ % TURNS && !getenv("MOTUS_ALL_ROWS")) continue;
                had[k][kind] = 1;
                pairs++;
                if (share_takes(&tried)) same_bits(s, files[n]->d_name, m->name);
            }
            motus_system_destroy(s);
        }
        free(files[n]);
    }
    free(files);
    print_message("%d pairs of model and method\n", pairs);
    assert_true(pairs >= 10);
}

/* All that the compiled text can contain: nested and masked sums, wrapped indices, driven boundaries, lists,
 * conditions, first-order variables. */
static void every_construct(void **state)
{
    (void)state;
    static const char text[] =
        "N = 9\nm = [1, 2, 3]\nw[i] = 1 + i/10 for i = 1..N\n"
        "u[i]'' = w[i] (u[i+1] - 2 u[i] + u[i-1]) + 0.1 sum(j = 1..N, j != i: (u[j] - u[i])/(1 + |u[j] - u[i]|^3)) for "
        "i = 1..N\n"
        "u[0] = 0.1 sin(t)\nu[N+1] = 0\nu[i](0) = sin(i) for i = 1..N\nu[i]'(0) = 0 for i = 1..N\n"
        "p[i]'' = p[mod(i, N)+1] - 2 p[i] + p[mod(i-2, N)+1] + if(p[i] > 0.5, -p[i]^2, 0.3) for i = 1..N\n"
        "p[i](0) = cos(i) for i = 1..N\np[i]'(0) = 0 for i = 1..N\n"
        "r'' = -m[2] r/|r|^3 + (t, 0, sum(k = 1..3: m[k] sum(j = k..3: exp(-j)))) \nr(0) = (1, 2, 0)\nr'(0) = (0, 0.3, "
        "0)\n"
        "s' = -s r.x + floor(t) + sum(k = 1..40: 1/k^2)\ns(0) = 1\n"
        "step 0.05\nuntil 3\n";
    for (int n = 4; n <= 41; n += 37) {
        char set[16];
        snprintf(set, sizeof set, "N=%d", n);
        motus_system *s = open_text(text, set);
        static const char *const rows[] = {"rk4", "gauss4", "verlet", "kahan-li8-reversible", "gauss12-reversible"};
        for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) same_bits(s, "every construct", rows[k]);
        motus_system_destroy(s);
    }
}

/* A family that nothing pushes has no operation over vectors. */
static void families_without_force(void **state)
{
    (void)state;
    static const char text[] = "x[i]'' = 0 for i = 1..8\nx[i](0) = i for i = 1..8\nx[i]'(0) = 1/i for i = 1..8\n"
                               "step 0.05\nuntil 3\n";
    motus_system *s = open_text(text, NULL);
    static const char *const rows[] = {"verlet", "rk4", "gauss4"};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) same_bits(s, text, rows[k]);
    motus_system_destroy(s);
}

/* First-order variables that read velocities and that nothing reads: a kick evaluates at several velocities, in the
 * windows of a family too. */
static void variables_that_follow(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "x'' = -x^3 + 0.1 cos(t)\nx(0) = 0.3\nx'(0) = 0.1\ns' = x'^2 + t x\ns(0) = 0.5\nstep 0.05\nuntil 3\n",
        "N = 40\nu[i]'' = u[i+1] - 2 u[i] + u[i-1] for i = 1..N\nu[0] = 0.1 sin(t)\nu[N+1] = 0\n"
        "u[i](0) = sin(i) for i = 1..N\nu[i]'(0) = 0 for i = 1..N\nw' = sum(i = 1..N: u[i]'^4)\nw(0) = 0\n"
        "step 0.05\nuntil 3\n"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        motus_system *s = open_text(texts[i], NULL);
        static const char *const rows[] = {"velocity-verlet", "blanes-moan4", "kahan-li8",
                                           "dopri5",          "dop853",       "verlet-reversible"};
        for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
            assert_int_equal(motus_method_admits(s, rows[k], NULL), MOTUS_OK);
            same_bits(s, texts[i], rows[k]);
        }
        assert_int_equal(motus_method_admits(s, "blanes-moan6", NULL), MOTUS_METHOD);
        motus_system_destroy(s);
    }
}

/* A compiled text contains only the functions that its model uses; each is tested alone, so that none depends on a
 * function that another includes. */
static void every_function(void **state)
{
    (void)state;
    static const char *const calls[] = {"sin(x)",
                                        "cos(x)",
                                        "tan(x)",
                                        "asin(x/9)",
                                        "acos(x/9)",
                                        "atan(x)",
                                        "atan2(x, t+1)",
                                        "sinh(x)",
                                        "cosh(x)",
                                        "tanh(x)",
                                        "exp(-x)",
                                        "log(x+4)",
                                        "sqrt(x+4)",
                                        "cbrt(x)",
                                        "hypot(x, t)",
                                        "abs(x)",
                                        "min(x, t)",
                                        "max(x, t)",
                                        "floor(3 x)",
                                        "mod(3 x, 0.7)",
                                        "sign(x)",
                                        "erf(x)",
                                        "(x+4)^t",
                                        "if(x < 0 and t > 0.2 or not (x >= 0.5), 1, x)",
                                        "if(x <= t, 1, if(x == 0.5, 2, if(x != 0.25, 3, 4)))",
                                        "-x/(2 - t) - 0.1 x"};
    for (size_t i = 0; i < sizeof calls / sizeof *calls; i++) {
        char text[200];
        snprintf(text, sizeof text, "x'' = 0.5 (%s) - x\nx(0) = 1\nx'(0) = 0.1\nstep 0.05\nuntil 3\n", calls[i]);
        motus_system *s = open_text(text, NULL);
        same_bits(s, calls[i], "leapfrog");
        motus_system_destroy(s);
    }
}

static int entries(char *one, size_t size)
{
    char path[600];
    snprintf(path, sizeof path, "%s/motus", given_cache);
    DIR *d = opendir(path);
    int n = 0;
    for (struct dirent *e; d && (e = readdir(d));)
        if (strlen(e->d_name) > 3 && !strcmp(e->d_name + strlen(e->d_name) - 3, ".so")) {
            n++;
            if (one) snprintf(one, size, "%s/%s", path, e->d_name);
        }
    if (d) closedir(d);
    return n;
}

/* The folder of a compilation, as a process that was killed `seconds` ago has left it, with one file. */
static void leave_folder(const char *name, const char *file, time_t seconds, char *path, size_t size)
{
    char inside[900];
    snprintf(path, size, "%s/motus/%s", given_cache, name);
    assert_int_equal(mkdir(path, 0700), 0);
    snprintf(inside, sizeof inside, "%s/%s", path, file);
    FILE *f = fopen(inside, "w");
    assert_non_null(f);
    fclose(f);
    const struct timespec then[2] = {{.tv_sec = time(NULL) - seconds}, {.tv_sec = time(NULL) - seconds}};
    assert_int_equal(utimensat(AT_FDCWD, path, then, 0), 0);
}

static void remove_left(const char *path, const char *file)
{
    char inside[900];
    snprintf(inside, sizeof inside, "%s/%s", path, file);
    unlink(inside);
    rmdir(path);
}

/* What a killed process has left of a compilation goes with the next one; what may be another process's stays. */
static void abandoned_folders_are_removed(void **state)
{
    (void)state;
    char old[600], young[600], foreign[600];
    motus_system *s = open_text("x'' = -x - 0.25 x^3\nx(0) = 1\nx'(0) = 0\nstep 0.01\nuntil 1\n", NULL);
    same_bits(s, "abandoned", "leapfrog");
    motus_cache_clear();
    leave_folder("build-abcdef", "model.c", 3600, old, sizeof old);
    leave_folder("build-ghijkl", "model.c", 30, young, sizeof young);
    leave_folder("build-mnopqr", "thesis", 3600, foreign, sizeof foreign);
    motus_system_destroy(s);
    s = open_text("x'' = -x - 0.125 x^3\nx(0) = 1\nx'(0) = 0\nstep 0.01\nuntil 1\n", NULL);
    same_bits(s, "abandoned", "leapfrog");
    motus_system_destroy(s);
    assert_int_not_equal(access(old, F_OK), 0);
    assert_int_equal(access(young, F_OK), 0);
    assert_int_equal(access(foreign, F_OK), 0);
    remove_left(young, "model.c");
    remove_left(foreign, "thesis");
}

/* Many variables, each with a line of its own: their stores are divided for the compiler. */
static void many_variables(void **state)
{
    (void)state;
    enum { VARIABLES = 150, ROOM = 80 };
    static char text[VARIABLES * ROOM + 40];
    size_t n = 0;
    for (int i = 1; i <= VARIABLES; i++)
        n += (size_t)snprintf(text + n, sizeof text - n, "x%d'' = -x%d^3 + 0.1 x%d\nx%d(0) = %d/7\nx%d'(0) = 0\n", i, i,
                              i % VARIABLES + 1, i, i, i);
    snprintf(text + n, sizeof text - n, "step 0.001\nuntil 0.1\n");
    motus_system *s = open_text(text, NULL);
    same_bits(s, "many variables", "leapfrog");
    motus_system_destroy(s);
}

/* One text serves every N and every parameter but those that make an operation exact. */
static void one_object_for_all_sizes(void **state)
{
    (void)state;
    motus_cache_clear();
    char *text = strdup(read_model("chain.motus"));
    static const char *const sets[] = {"N=5", "N=200", "beta=0.1"};
    for (int i = 0; i < 3; i++) {
        motus_system *s = open_text(text, sets[i]);
        same_bits(s, "chain", "leapfrog");
        motus_system_destroy(s);
    }
    free(text);
    assert_int_equal(entries(NULL, 0), 1);
}

/* Products with 1 and -1 are left out of the text, quotients by powers of two become products; other numbers, set
 * later, want another text. */
static const char exact_numbers[] = "a = 1\nb = -1\nc = 4\nx'' = -a x/c + b y - y (a x - y) + x b^2/(c y^2)\n"
                                    "y'' = x/(a b) - a y^3 + b x x' - (x b - c y)/c\n"
                                    "x(0) = 0.3\nx'(0) = 0.1\ny(0) = 0.7\ny'(0) = -0.2\nstep 0.1\nuntil 4\n";

static void set_number(motus_system *s, const char *name, double value)
{
    motus_error err = motus_default_error();
    if (motus_system_set(s, name, &value, 1, &err)) fail_msg("%s", err.message);
}

static void exact_operations_are_left_out(void **state)
{
    (void)state;
    static const double values[] = {1, -1, 3, 0.25};
    static const char *const names[] = {"a", "b", "c"};
    enum { VALUES = sizeof values / sizeof *values };
    motus_cache_clear();
    motus_system *s = open_text(exact_numbers, NULL);
    same_bits(s, "exact numbers", "leapfrog");
    for (int n = 0; n < 3; n++)
        for (int k = 0; k < VALUES; k++) {
            set_number(s, names[n], values[k]);
            same_bits(s, "exact numbers", "leapfrog");
        }
    motus_system_destroy(s);
    /* such a number has a text already, that of a = 3 */
    const int before = entries(NULL, 0);
    s = open_text(exact_numbers, "a=0.7");
    same_bits(s, "exact numbers", "leapfrog");
    set_number(s, "a", 0.9);
    same_bits(s, "exact numbers", "leapfrog");
    assert_int_equal(entries(NULL, 0), before);
    motus_system_destroy(s);
}

/* Forces between pairs: their long part is computed once for both, wherever exchanging i and j leaves its bits as they
 * are, and the terms reach every sum in its order. All z are 0, so signs of zeros count. */
static void pairs_are_taken_once(void **state)
{
    static const struct {
        const char *force;
        bool once;
    } forces[] = {
        {"sum(j = 1..N, j != i: m[j] (r[j] - r[i])/|r[j] - r[i]|^3)", true},
        {"-r[i] + sum(j = 1..N, i != j: m[i] m[j] (r[i] - r[j])/(1 + |r[j] - r[i]|^2)^1.5)", true},
        {"sum(j = 1..N, j != i: (r[j]' - r[i]') exp(-|r[i] - r[j]|^2)) - 0.1 r[i]'", true},
        {"sum(j = 1..N, j != i: (i - 2 j) (r[j] - r[i])/(|r[j] - r[i]|^3 sqrt(i + j)) + m[i] r[j])", true},
        {"sum(j = 1..N, j != i: cos(t) (r[j] - r[i])/|r[j] - r[i]|) + sum(k = 2..N: m[k] (r[k] - r[i]))", true},
        {"sum(j = 1..N, j != i: cos(t) (r[j] - r[i])/|r[j] - r[i]|) + sum(k = 1..N: m[k] (r[k] - r[i]))", false},
        {"sum(j = 1..N, j != i: (r[j] - 2 r[i])/|r[j] - 2 r[i]|^3)", false},
        {"sum(j = 2..N, j != i: (r[j] - r[i])/|r[j] - r[i]|^3)", false},
        {"sum(j = 1..N, j > i: (r[j] - r[i])/|r[j] - r[i]|^3)", false},
    };
    static const int sizes[] = {2, 3, 16, 17, 24, 45};
    (void)state;
    for (size_t f = 0; f < sizeof forces / sizeof *forces; f++)
        for (size_t n = 0; n < sizeof sizes / sizeof *sizes; n++) {
            char text[800];
            motus_error err = motus_default_error();
            snprintf(text, sizeof text,
                     "N = %d\nm[i] = 1/(1 + i)   for i = 1..N\nr[i]'' = %s   for i = 1..N\n"
                     "r[i](0) = (sqrt(i) cos(2.4 i), sqrt(i) sin(2.4 i), 0)   for i = 1..N\n"
                     "r[i]'(0) = (sin(i)/9, cos(3 i)/9, 0)   for i = 1..N\nstep 0.01\nuntil 1\n",
                     sizes[n], forces[f].force);
            motus_system *s = open_text(text, NULL);
            same_bits(s, forces[f].force, "rk4");
            const char *c = motus_compiled_text(s, "rk4", &err);
            assert_non_null(c);
            if ((strstr(c, "if (own && ") != NULL) != forces[f].once) fail_msg("%s", forces[f].force);
            motus_system_destroy(s);
        }
}

enum { TRAJECTORIES = 3 };

static void ends_of(const char *machine, const double *values, double ends[TRAJECTORIES])
{
    motus_ensemble_def def = motus_default_ensemble();
    motus_error err = motus_default_error();
    motus_ensemble *e = NULL;
    const char *name = "k";
    const motus_record record = {MOTUS_REDUCE_FINAL, 1};
    double *const results[1] = {ends};
    motus_system *s = open_text("N = 5\nk = 1\nx[i]'' = k (x[i-1] - 2 x[i] + x[i+1])/k^3 for i = 1..N\nx[0] = 0\n"
                                "x[N+1] = 0\nx[i](0) = 1/i for i = 1..N\nx[i]'(0) = 0 for i = 1..N\nstep 0.1\n"
                                "until 4\n",
                                NULL);
    def.vary = &name, def.vary_count = 1;
    def.records = &record, def.record_count = 1;
    def.method = "gauss4", def.machine = machine;
    if (motus_ensemble_create(s, &def, &e, &err) || motus_ensemble_run(e, TRAJECTORIES, &values, results, NULL, &err))
        fail_msg("%s", err.message);
    motus_ensemble_destroy(e);
    motus_system_destroy(s);
}

/* Trajectories that are computed one by one share an object, whatever their numbers are. */
static void numbers_of_trajectories(void **state)
{
    (void)state;
    const double values[TRAJECTORIES] = {1, 2, 0.7};
    double a[TRAJECTORIES], b[TRAJECTORIES];
    ends_of("interpreter", values, a);
    ends_of("compiled", values, b);
    assert_memory_equal(a, b, sizeof a);
    assert_true(a[0] != a[1] && a[1] != a[2]);
}

static void compile_again(void)
{
    motus_system *s = open_text("x'' = -x\nx(0) = 1\nx'(0) = 0\nstep 0.1\nuntil 1\n", NULL);
    same_bits(s, "spring", "verlet");
    motus_system_destroy(s);
}

static void damaged_entries_are_rebuilt(void **state)
{
    (void)state;
    char path[1024];
    struct stat before, after;
    motus_cache_clear();
    compile_again();
    assert_int_equal(entries(path, sizeof path), 1);
    assert_int_equal(stat(path, &before), 0);
    compile_again(); /* from the cache: the file is unchanged */
    assert_int_equal(stat(path, &after), 0);
    assert_int_equal(before.st_ino, after.st_ino);
    for (int damage = 0; damage < 4; damage++) {
        stat(path, &before);
        if (damage == 0) { /* a changed bit in the middle */
            int fd = open(path, O_RDWR);
            char c;
            assert_int_equal(pread(fd, &c, 1, before.st_size / 2), 1);
            c ^= 1;
            assert_int_equal(pwrite(fd, &c, 1, before.st_size / 2), 1);
            close(fd);
        } else if (damage == 1) {
            assert_int_equal(truncate(path, before.st_size / 2), 0);
        } else if (damage == 2) { /* writable by others */
            assert_int_equal(chmod(path, 0666), 0);
        } else { /* a link to a valid object elsewhere */
            char aside[1100];
            snprintf(aside, sizeof aside, "%s.aside", path);
            assert_int_equal(rename(path, aside), 0);
            assert_int_equal(symlink(aside, path), 0);
        }
        compile_again();
        assert_int_equal(lstat(path, &after), 0);
        assert_true(S_ISREG(after.st_mode));
        assert_int_equal(after.st_mode & 077, 0);
        assert_int_not_equal(before.st_ino, after.st_ino);
    }
    assert_true(motus_cache_clear() >= 1);
}

/* A folder that others may write is not used, nor any file in it. */
static void shared_directory_is_not_trusted(void **state)
{
    (void)state;
    char path[600];
    snprintf(path, sizeof path, "%s/motus", given_cache);
    motus_cache_clear();
    compile_again();
    motus_cache_clear();
    assert_int_equal(chmod(path, 0777), 0);
    compile_again();
    assert_int_equal(entries(NULL, 0), 0);
    assert_int_equal(chmod(path, 0700), 0);
}

static void without_a_compiler(void **state)
{
    (void)state;
    char *path = strdup(getenv("PATH"));
    motus_cache_clear();
    setenv("PATH", "/nowhere", 1);
    unsetenv("CC");
    motus_system *s = open_text("x'' = -x\nx(0) = 1\nx'(0) = 0\nstep 0.1\nuntil 1e8\n", NULL);
    motus_run_def def = motus_default_run();
    motus_error err = motus_default_error();
    motus_run *r = NULL;
    def.method = "verlet", def.machine = "auto";
    /* the interpreter runs, and the note says why */
    assert_int_equal(motus_run_create(s, &def, &r, &err), MOTUS_OK);
    assert_string_equal(motus_run_now(r).machine, "interpreter");
    assert_non_null(strstr(motus_run_now(r).note, "no C compiler"));
    motus_run_destroy(r);
    def.machine = "compiled";
    assert_int_equal(motus_run_create(s, &def, &r, &err), MOTUS_TOOL);
    assert_non_null(strstr(err.message, "no C compiler"));
    def.machine = "abacus";
    assert_int_equal(motus_run_create(s, &def, &r, &err), MOTUS_ARGUMENT);
    motus_system_destroy(s);
    setenv("PATH", path, 1);
    free(path);
}

/* The compiled text contains no names of the model. */
static void no_text_of_the_model_is_compiled(void **state)
{
    (void)state;
    motus_system *s = open_text("zebra = 0.25   # a remark\nqqquagga'' = -zebra qqquagga\nqqquagga(0) = "
                                "1\nqqquagga'(0) = 0\nstep 0.1\nuntil 1\n",
                                NULL);
    const char *text = motus_compiled_text(s, "verlet", NULL);
    assert_non_null(text);
    assert_null(strstr(text, "zebra"));
    assert_null(strstr(text, "quagga"));
    assert_null(strstr(text, "remark"));
    motus_system_destroy(s);
}

/* The end of a run by Taylor series; with `between`, an object of another method is made and used while it is under
 * way. */
static void taylor_end(motus_system *s, const char *machine, bool between, double end[2])
{
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run(), other = motus_default_run();
    motus_run *r = NULL, *beside = NULL;
    def.method = "taylor", def.tolerance = 1e-10, def.until = 5, def.machine = machine;
    other.method = "verlet", other.step = 0.01, other.until = 1, other.machine = machine;
    assert_int_equal(motus_run_create(s, &def, &r, &err), MOTUS_OK);
    if (between) {
        assert_int_equal(motus_run_create(s, &other, &beside, &err), MOTUS_OK);
        assert_int_equal(motus_run_finish(beside, &err), MOTUS_OK);
    }
    assert_int_equal(motus_run_finish(r, &err), MOTUS_OK);
    assert_int_equal(motus_run_state(r, end, end + 1, &err), MOTUS_OK);
    assert_string_equal(motus_run_now(r).machine, machine);
    motus_run_destroy(beside);
    motus_run_destroy(r);
}

/* The objects of a model read numbers that are computed from its parameters. The text of Taylor series reads others
 * than that of Verlet. */
static void objects_do_not_share_numbers(void **state)
{
    (void)state;
    motus_system *s = open_text("k = 3\nm = 2\nd = 0.1\nx'' = -k/m x - d/m x'\nx(0) = 1\nx'(0) = 0\n", NULL);
    motus_error err = motus_default_error();
    for (int changed = 0; changed < 2; changed++) {
        double want[2], got[2];
        const double k = 3 + changed;
        assert_int_equal(motus_system_set(s, "k", &k, 1, &err), MOTUS_OK);
        taylor_end(s, "interpreter", false, want);
        taylor_end(s, "compiled", true, got);
        assert_memory_equal(got, want, sizeof want);
        taylor_end(s, "compiled", false, got);
        assert_memory_equal(got, want, sizeof want);
    }
    motus_system_destroy(s);
}

int main(void)
{
    open_cache();
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_model),
                                       cmocka_unit_test(every_construct),
                                       cmocka_unit_test(families_without_force),
                                       cmocka_unit_test(variables_that_follow),
                                       cmocka_unit_test(every_function),
                                       cmocka_unit_test(one_object_for_all_sizes),
                                       cmocka_unit_test(objects_do_not_share_numbers),
                                       cmocka_unit_test(exact_operations_are_left_out),
                                       cmocka_unit_test(numbers_of_trajectories),
                                       cmocka_unit_test(pairs_are_taken_once),
                                       cmocka_unit_test(damaged_entries_are_rebuilt),
                                       cmocka_unit_test(many_variables),
                                       cmocka_unit_test(abandoned_folders_are_removed),
                                       cmocka_unit_test(shared_directory_is_not_trusted),
                                       cmocka_unit_test(without_a_compiler),
                                       cmocka_unit_test(no_text_of_the_model_is_compiled)};
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    close_cache();
    return failed;
}
