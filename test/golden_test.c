/* Golden results: the bits of the state after 50 steps, for every model in models/ and every method that admits it,
 * are those of test/golden.txt. Any change of the language's normal form, of a method's text or of a row changes
 * them, as does a machine that computes other bits.
 *
 * `golden_test --write` writes the file.
 */
#include "test/given.h"

#include <dirent.h>

enum { STEPS = 50, NAME = 64, MODELS_MAX = 100, LINES_MAX = 4000 };

static uint64_t mix(uint64_t h, const void *bytes, size_t n) /* FNV-1a */
{
    for (size_t i = 0; i < n; i++) h = (h ^ ((const unsigned char *)bytes)[i]) * 1099511628211u;
    return h;
}
static const uint64_t START = 14695981039346656037u;

/* The models' names, in order. */
static char models[MODELS_MAX][NAME];
static size_t model_count;

static int by_name(const void *a, const void *b) { return strcmp(a, b); }

static void find_models(void)
{
    char folder[1024];
    snprintf(folder, sizeof folder, "%s/models", MOTUS_SOURCE_DIR);
    DIR *d = opendir(folder);
    for (struct dirent *e; d && (e = readdir(d));) {
        size_t n = strlen(e->d_name);
        if (n > 6 && n < NAME && !strcmp(e->d_name + n - 6, ".motus") && model_count < MODELS_MAX)
            memcpy(models[model_count++], e->d_name, n + 1);
    }
    if (d) closedir(d);
    qsort(models, model_count, NAME, by_name);
}

typedef struct line {
    char model[NAME], method[NAME];
    uint64_t hash;
} line;

/* One line: the hash of x and v after the steps, or of the error. */
static line compute(motus_system *s, const char *model, const char *method)
{
    line l = {0};
    snprintf(l.model, NAME, "%s", model);
    snprintf(l.method, NAME, "%s", method);
    motus_settings set = motus_default_settings();
    motus_settings_of(s, &set);
    /* a model by an adaptive method has no step */
    const double step = isnan(set.step) ? (set.until - set.from) / 512 : set.step;
    motus_run *r = given_run(s, method, step, set.from + STEPS * step);
    motus_error err = motus_default_error();
    motus_status status = motus_run_step(r, STEPS, &err);
    size_t n = 0;
    if (status == MOTUS_OK) {
        double *y = whole_state(s, r, &n);
        l.hash = mix(START, y, n * sizeof *y);
        free(y);
    } else {
        l.hash = mix(mix(START, &status, sizeof status), err.message, strlen(err.message));
    }
    motus_run_destroy(r);
    return l;
}

static size_t compute_model(const char *model, line *out)
{
    motus_system *s = given_model(model, NULL, 0);
    size_t n = 0;
    for (size_t k = 0; k < motus_method_count(); k++)
        if (motus_method_admits(s, motus_method_at(k)->name, NULL) == MOTUS_OK)
            out[n++] = compute(s, model, motus_method_at(k)->name);
    motus_system_destroy(s);
    return n;
}

/* The file --------------------------------------------------------------------------------------------------------- */

static line recorded[LINES_MAX];
static size_t recorded_count;

static void golden_path(char *out, size_t size) { given_path(out, size, "test", "golden.txt"); }

static void read_golden(void)
{
    char path[1024];
    golden_path(path, sizeof path);
    char *text = given_file(path);
    for (char *p = text; *p; p += strcspn(p, "\n"), p += *p == '\n') {
        line *l = &recorded[recorded_count];
        unsigned long long hash;
        if (*p == '#' || *p == '\n') continue;
        assert_true(recorded_count < LINES_MAX);
        if (sscanf(p, "%63s %63s %llx", l->model, l->method, &hash) != 3) fail_msg("golden.txt: %.60s", p);
        l->hash = hash;
        recorded_count++;
    }
    free(text);
}

static int write_golden(void)
{
    char path[1024];
    line l[NAME];
    golden_path(path, sizeof path);
    FILE *f = fopen(path, "w");
    if (!f) return 1;
    fprintf(f,
            "# The state after %d steps: model, method, hash (FNV-1a of the bytes of x and v, little-endian).\n"
            "# Written by golden_test --write; see golden_test.c.\n",
            STEPS);
    for (size_t i = 0; i < model_count; i++) {
        size_t n = compute_model(models[i], l);
        for (size_t k = 0; k < n; k++)
            fprintf(f, "%-30s %-24s %016llx\n", l[k].model, l[k].method, (unsigned long long)l[k].hash);
    }
    return fclose(f) != 0;
}

static const line *find(const char *model, const char *method)
{
    for (size_t i = 0; i < recorded_count; i++)
        if (!strcmp(recorded[i].model, model) && !strcmp(recorded[i].method, method)) return &recorded[i];
    return NULL;
}

/* Tests ------------------------------------------------------------------------------------------------------------ */

static void a_model(void **state)
{
    const char *model = *state;
    line l[NAME];
    size_t n = compute_model(model, l), lines = 0, wrong = 0;
    assert_true(n > 8);
    for (size_t i = 0; i < recorded_count; i++) lines += !strcmp(recorded[i].model, model);
    if (lines != n)
        fail_msg("%s has %zu lines in golden.txt and %zu methods; golden_test --write writes them anew", model, lines,
                 n);
    for (size_t k = 0; k < n; k++) {
        const line *r = find(model, l[k].method);
        if (!r) fail_msg("%s by %s is not in golden.txt; golden_test --write writes it anew", model, l[k].method);
        if (r->hash != l[k].hash && wrong++ < 5)
            print_error("%s by %s: %016llx, recorded %016llx\n", model, l[k].method, (unsigned long long)l[k].hash,
                        (unsigned long long)r->hash);
    }
    if (wrong) fail_msg("%zu of %zu results have other bits", wrong, n);
}

/* Every line of the file is still computed. */
static void every_line_is_computed(void **state)
{
    (void)state;
    for (size_t i = 0; i < recorded_count; i++) {
        int known = 0;
        for (size_t k = 0; k < model_count; k++) known |= !strcmp(models[k], recorded[i].model);
        if (!known) fail_msg("%s is on record and not in models/", recorded[i].model);
        assert_ptr_equal(find(recorded[i].model, recorded[i].method), &recorded[i]);
    }
    assert_true(recorded_count > 100);
}

int main(int argc, char **argv)
{
    static struct CMUnitTest tests[MODELS_MAX + 1];
    find_models();
    if (argc > 1 && !strcmp(argv[1], "--write")) return write_golden();
    read_golden();
    for (size_t i = 0; i < model_count; i++)
        tests[i] = (struct CMUnitTest){.name = models[i], .test_func = a_model, .initial_state = models[i]};
    tests[model_count] = (struct CMUnitTest)cmocka_unit_test(every_line_is_computed);
    return _cmocka_run_group_tests("golden results", tests, model_count + 1, NULL, NULL);
}
