/* Values from a column of a CSV file.
 *
 * Invariant: every row gives one finite number, or the error names its line.
 */
#include "base/error.h"
#include "cli/complain.h"
#include "cli/grid.h"
#include "cli/typed.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

typedef struct table_file {
    const char *path, *column;
    FILE *stream;
    char *line;
    size_t room;
    long long number; /* of the line */
    size_t place;     /* of the column, from 0; SIZE_MAX: not known yet */
} table_file;

/* Field `k` of the line, without its quotes, cut out in place; NULL: the line has fewer. */
static char *field(char *s, size_t k)
{
    for (size_t i = 0;; i++) {
        char *start = s + strspn(s, " "), *out = start;
        s = start;
        if (*s == '"') {
            for (s++; *s && !(*s == '"' && s[1] != '"'); *out++ = *s++) s += *s == '"'; /* "" stands for " */
            s += strcspn(s, ",");
        } else {
            out = s += strcspn(s, ",");
            while (out > start && out[-1] == ' ') out--;
        }
        bool more = *s == ',';
        if (i == k) {
            *out = 0;
            return start;
        }
        if (!more) return NULL;
        s++;
    }
}

/* Reads the next line that is neither empty nor a comment. 1: there is one; 0: the end; -1: it cannot be read. */
static int next_line(table_file *f)
{
    errno = 0;
    for (ssize_t length; (length = getline(&f->line, &f->room, f->stream)) >= 0;) {
        static const char mark[] = "\xEF\xBB\xBF"; /* some programs begin a file of UTF-8 with it */
        if (f->number++ == 0 && strncmp(f->line, mark, strlen(mark)) == 0)
            memmove(f->line, f->line + strlen(mark), (size_t)(length -= (ssize_t)strlen(mark)) + 1);
        while (length > 0 && (f->line[length - 1] == '\n' || f->line[length - 1] == '\r')) f->line[--length] = 0;
        if (strlen(f->line) > 0 && f->line[0] != '#') return 1;
    }
    return ferror(f->stream) || errno == ENOMEM ? -1 : 0;
}

static motus_status cannot_read(const table_file *f, motus_error *err)
{
    return fail(err, MOTUS_FILE, "cannot read %s: %s", f->path, strerror(errno ? errno : EIO));
}

/* Whether the text is a number, which may be infinite or NaN. */
static bool is_number(const char *s, double *value)
{
    s += strspn(s, " \t");
    if (typed_decimal(s, value)) return true;
    *value = NAN;
    s += *s == '-' || *s == '+';
    return strcasecmp(s, "nan") == 0 || strcasecmp(s, "inf") == 0 || strcasecmp(s, "infinity") == 0;
}

/* Finds the column from the first line; *is_row: that line is a row and not the head. */
static motus_status find_column(table_file *f, bool *is_row, motus_error *err)
{
    int64_t n = 1;
    const char *rest = "";
    bool counted = !f->column || (typed_count(f->column, &n, &rest) && !*rest);
    char *copy = strdup(f->line);
    if (!copy) return complain_memory(err);
    motus_status status = MOTUS_OK;
    double value;
    char *s;
    if (!f->column && field(copy, 1)) {
        fail(err, MOTUS_ARGUMENT, "%s has several columns", f->path);
        hint(err, "name one, or give its number: F=@%s:1", f->path);
        status = MOTUS_ARGUMENT;
    } else if (counted) {
        f->place = (size_t)n - 1;
        memcpy(copy, f->line, strlen(f->line) + 1);
        s = field(copy, f->place);
        *is_row = !s || is_number(s, &value); /* read_row() refuses a line that is too short */
    }
    for (size_t k = 0; !status && f->place == SIZE_MAX; k++) {
        memcpy(copy, f->line, strlen(f->line) + 1);
        s = field(copy, k);
        if (!s) {
            memcpy(copy, f->line, strlen(f->line) + 1);
            fail(err, MOTUS_NAME, "%s has no column %s", f->path, f->column);
            hint(err, "its first line is: %.200s", copy);
            status = MOTUS_NAME;
        } else if (strcmp(s, f->column) == 0) {
            f->place = k;
        }
    }
    free(copy);
    return status;
}

static motus_status bad(const table_file *f, motus_status status, const char *what, motus_error *err)
{
    return fail(err, status, "%s:%lld: %s", f->path, f->number, what);
}

static motus_status read_row(table_file *f, double **list, uint64_t *count, motus_error *err)
{
    char *s = field(f->line, f->place), what[128];
    double value = 0;
    if (!s) return bad(f, MOTUS_ARGUMENT, "the line has too few columns", err);
    if (!is_number(s, &value) || !isfinite(value)) {
        snprintf(what, sizeof what, "%.60s is not a finite number", *s ? s : "nothing");
        return bad(f, MOTUS_ARGUMENT, what, err);
    }
    if ((*count & (*count - 1)) == 0) { /* full: 0, 1, 2, 4, 8, … */
        double *larger = realloc(*list, (*count ? 2 * *count : 1) * sizeof **list);
        if (!larger) return complain_memory(err);
        *list = larger;
    }
    (*list)[(*count)++] = value;
    return MOTUS_OK;
}

motus_status axis_file(const char *path, const char *column, double **list, uint64_t *count, motus_error *err)
{
    table_file f = {.path = path, .column = column, .place = SIZE_MAX};
    *list = NULL;
    *count = 0;
    f.stream = fopen(path, "r");
    if (!f.stream) return cannot_read(&f, err);
    motus_status status = MOTUS_OK;
    int more = 1;
    while (!status && (more = next_line(&f)) > 0) {
        bool is_row = f.place != SIZE_MAX;
        if (!is_row) status = find_column(&f, &is_row, err);
        if (!status && is_row) status = read_row(&f, list, count, err);
    }
    if (!status && more < 0) status = cannot_read(&f, err);
    if (!status && *count == 0) status = fail(err, MOTUS_ARGUMENT, "%s holds no values", path);
    fclose(f.stream);
    free(f.line);
    return status;
}
