/* Model files that are tests: their comments say what must come of them.
 *
 *     test/wrong/       # expect: LINE:COLUMN status | fragment of the message | fragment of the hint
 *     test/right/ and test/newcomer/
 *                       # start: column = value              at the start, to the bit
 *                       # end: column = value ± tolerance    where the run ends
 *
 * Invariant: every file of these folders says something, and what it says is checked; a file that expects nothing
 * fails.
 */
#include "test/given.h"

#include <dirent.h>
#include <stdbool.h>

typedef struct text {
    char *bytes;
    size_t length;
} text;

static text load(const char *path)
{
    FILE *file = fopen(path, "rb");
    text t = {0};
    if (!file) fail_msg("%s cannot be read", path);
    size_t room = 1 << 20;
    t.bytes = malloc(room);
    assert_non_null(t.bytes);
    t.length = fread(t.bytes, 1, room - 1, file);
    t.bytes[t.length] = 0;
    fclose(file);
    return t;
}

static int by_name(const void *a, const void *b) { return strcmp(*(char *const *)a, *(char *const *)b); }

/* Calls `each` for every model of a folder, sorted by name; returns their number. */
static size_t for_models(const char *folder, void (*each)(const char *name, text t, int *faults))
{
    char path[1024], *names[1024];
    size_t count = 0;
    int faults = 0;
    snprintf(path, sizeof path, "%s/test/%s", MOTUS_SOURCE_DIR, folder);
    DIR *dir = opendir(path);
    if (!dir) fail_msg("there is no folder %s", path);
    for (struct dirent *entry; (entry = readdir(dir)) && count < 1024;)
        if (strlen(entry->d_name) > 6 && !strcmp(entry->d_name + strlen(entry->d_name) - 6, ".motus"))
            names[count++] = strdup(entry->d_name);
    closedir(dir);
    qsort(names, count, sizeof *names, by_name);
    for (size_t i = 0; i < count; i++) {
        snprintf(path, sizeof path, "%s/test/%s/%s", MOTUS_SOURCE_DIR, folder, names[i]);
        text t = load(path);
        each(names[i], t, &faults);
        free(t.bytes);
        free(names[i]);
    }
    if (faults) fail_msg("%d of the %zu models in test/%s do not do as they say", faults, count, folder);
    return count;
}

#define FAULT(...) (print_error(__VA_ARGS__), ++*faults)

/* Reads the model, creates a run, runs it to its end. */
static motus_status go(text t, motus_system **s, motus_run **r, motus_error *err)
{
    motus_text_def def = motus_default_text();
    motus_run_def run = motus_default_run();
    motus_settings settings = motus_default_settings();
    def.text = t.bytes;
    def.length = t.length;
    *r = NULL;
    motus_status status = motus_system_from_text(&def, s, err);
    if (status != MOTUS_OK) return status;
    motus_settings_of(*s, &settings);
    if (isnan(settings.step)) run.step = 0.1;
    if (isnan(settings.until)) run.until = settings.from + 1;
    return motus_run_create(*s, &run, r, err);
}

/* ---- wrong ---- */

/* Checks that the error has the line of the text, and a caret at its column. */
static bool points(const motus_error *err)
{
    size_t blanks = strspn(err->caret, " ");
    return err->line > 0 && err->column > 0 && err->caret[blanks] == '^' && (int)blanks <= err->column - 1 &&
           strspn(err->caret + blanks, "^") == strlen(err->caret + blanks);
}

static bool printable(const char *s)
{
    for (; *s; s++)
        if ((unsigned char)*s < 0x20 || *s == 0x7F) return false;
    return true;
}

static void wrong_one(const char *name, text t, int *faults)
{
    int line, column, n = 0;
    char word[32], head[1024], *message, *hint, *end;
    snprintf(head, sizeof head, "%.*s", (int)strcspn(t.bytes, "\r\n"), t.bytes);
    if (sscanf(head, "# expect: %d:%d %31s%n", &line, &column, word, &n) != 3 || !(message = strstr(head + n, " | "))) {
        FAULT("%s: the first line expects nothing\n", name);
        return;
    }
    message += 3;
    end = strstr(message, " | ");
    hint = end ? end + 3 : "";
    if (end) *end = 0;
    motus_system *s = NULL;
    motus_run *r = NULL;
    motus_error err = motus_default_error();
    motus_status status = go(t, &s, &r, &err);
    if (status == MOTUS_OK) status = motus_run_finish(r, &err);
    if (strcmp(motus_status_word(status), word) || err.line != line || err.column != column ||
        !strstr(err.message, message) || !strstr(err.hint, hint) || (status != MOTUS_OK && err.status != status))
        FAULT("%s: %d:%d %s | %s | %s\n    and not: %d:%d %s | %s | %s\n", name, err.line, err.column,
              motus_status_word(status), err.message, err.hint, line, column, word, message, hint);
    else if (motus_status_exit(status) != 2)
        FAULT("%s: a wrong model is a wrong request, with exit status 2\n", name);
    else if (!points(&err))
        FAULT("%s: the caret does not stand under column %d:\n    %s\n    %s\n", name, err.column, err.source,
              err.caret);
    else if (!printable(err.message) || !printable(err.hint) || !printable(err.source))
        FAULT("%s: a control character in the message\n", name);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

static void wrong_models_are_refused(void **unused)
{
    (void)unused;
    size_t count = for_models("wrong", wrong_one);
    assert_true(count >= 80);
}

/* ---- right ---- */

/* "column = value" or "column = value ± tolerance" */
static bool promise(const char *line, char column[128], double *value, double *tolerance)
{
    const char *equals = strstr(line, " = ");
    char *end;
    if (!equals || equals - line >= 128) return false;
    snprintf(column, 128, "%.*s", (int)(equals - line), line);
    *value = strtod(equals + 3, &end);
    *tolerance = 0;
    if (end == equals + 3) return false;
    if (!strncmp(end, " ± ", strlen(" ± "))) {
        char *from = end + strlen(" ± ");
        *tolerance = strtod(from, &end);
        if (end == from) return false;
    }
    return *end == '\n' || *end == '\r' || *end == 0;
}

static int keep_promises(const char *name, text t, const char *when, motus_system *s, motus_run *r, int *faults)
{
    int count = 0;
    for (const char *line = t.bytes; line && *line; line = strchr(line, '\n') ? strchr(line, '\n') + 1 : NULL) {
        if (strncmp(line, when, strlen(when))) continue;
        char column[128];
        double value, tolerance, got;
        size_t first, n;
        motus_error err = motus_default_error();
        count++;
        if (!promise(line + strlen(when), column, &value, &tolerance))
            FAULT("%s: %.60s … is not read\n", name, line);
        else if (motus_column_find(s, column, &first, &n, &err) || n != 1 || motus_run_values(r, &first, 1, &got, &err))
            FAULT("%s: %s: %s\n", name, column, err.message);
        else if (!(fabs(got - value) <= tolerance))
            FAULT("%s: %s%s is %.17g, not %.17g ± %g\n", name, when, column, got, value, tolerance);
    }
    return count;
}

static void right_one(const char *name, text t, int *faults)
{
    motus_system *s = NULL;
    motus_run *r = NULL;
    motus_error err = motus_default_error();
    if (go(t, &s, &r, &err)) {
        FAULT("%s:%d:%d: %s (%s)\n    %s\n    %s\n", name, err.line, err.column, err.message, err.hint, err.source,
              err.caret);
    } else {
        int promises = keep_promises(name, t, "# start: ", s, r, faults);
        if (motus_run_finish(r, &err))
            FAULT("%s: %s (%s)\n", name, err.message, err.hint);
        else if (promises + keep_promises(name, t, "# end: ", s, r, faults) == 0)
            FAULT("%s promises nothing\n", name);
    }
    motus_run_destroy(r);
    motus_system_destroy(s);
}

static void right_models_move(void **unused)
{
    (void)unused;
    assert_true(for_models("right", right_one) > 0);
}

/* Models as a physicist would type them without having read the manual. */
static void newcomers_models_move(void **unused)
{
    (void)unused;
    assert_true(for_models("newcomer", right_one) > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wrong_models_are_refused),
        cmocka_unit_test(right_models_move),
        cmocka_unit_test(newcomers_models_move),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
