/* Values from a column of a CSV file.
 *
 * Invariant: every row gives one finite number, or the error names its line.
 */
#include "cli/files/file.h"
#include "cli/model/grid.h"
#include "cli/words/complain.h"
#include "cli/words/words.h"

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
    size_t place;     /* the place of the column, from 0; SIZE_MAX: not known yet */
} table_file;

/* Cuts out field `k` of the line, without its quotes. Returns NULL if the line has fewer fields. */
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

static motus_status bad(const table_file *f, motus_status status, const char *what, motus_error *err)
{
    return fail(err, status, "%s:%lld: %s", f->path, f->number, what);
}

/* Reads a line, without its end, of a stream that may be endless, as its lines may be. *more is false at the end. */
static motus_status read_line(table_file *f, size_t *length, bool *more, motus_error *err)
{
    enum { FIRST = 256 };
    size_t used = 0;
    int c = EOF;
    errno = 0;
    f->number++;
    for (;;) {
        if (used == f->room) {
            const size_t room = f->room ? 2 * f->room : FIRST;
            char *larger = realloc(f->line, room);
            if (!larger) return complain_memory(err);
            f->line = larger;
            f->room = room;
        }
        c = getc_unlocked(f->stream);
        if (c == EOF || c == '\n') break;
        if (c == 0) return bad(f, MOTUS_ARGUMENT, "the line has a byte 0: this is no text", err);
        if (used == FILE_LINE_MAX)
            return complain(err, MOTUS_LIMIT,
                            "a file of values has a value a line, or a line for the values of all columns",
                            "%s:%lld: the line is longer than %zu bytes", f->path, f->number, FILE_LINE_MAX);
        f->line[used++] = (char)c;
    }
    f->line[used] = 0;
    *length = used;
    *more = c != EOF || used > 0;
    return c == EOF && ferror(f->stream) ? file_cannot("read", f->path, errno, err) : MOTUS_OK;
}

/* Reads the next line that is neither empty nor a comment. *more is false at the end. */
static motus_status next_line(table_file *f, bool *more, motus_error *err)
{
    static const char mark[] = "\xEF\xBB\xBF"; /* some programs begin a file in UTF-8 with it */
    for (;;) {
        size_t length = 0;
        const motus_status status = read_line(f, &length, more, err);
        if (status || !*more) return status;
        if (f->number == 1 && length >= strlen(mark) && memcmp(f->line, mark, strlen(mark)) == 0)
            memmove(f->line, f->line + strlen(mark), (length -= strlen(mark)) + 1);
        while (length > 0 && f->line[length - 1] == '\r') f->line[--length] = 0;
        if (length > 0 && f->line[0] != '#') return MOTUS_OK;
    }
}

/* Returns whether a text is a number, which may be infinite or NaN; *value is then not finite. */
static bool is_number(const char *s, double *value)
{
    s += strspn(s, " \t");
    if (typed_decimal(s, value)) return true;
    *value = NAN;
    s += *s == '-' || *s == '+';
    return strcasecmp(s, "nan") == 0 || strcasecmp(s, "inf") == 0 || strcasecmp(s, "infinity") == 0;
}

/* Finds the column by the first line. *is_row says whether that line is a row, and not the head. */
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
        *is_row = !s || is_number(s, &value); /* read_row() reports a line that is too short */
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

static motus_status read_row(table_file *f, double **list, uint64_t *count, motus_error *err)
{
    char *s = field(f->line, f->place), what[128];
    double value = 0;
    if (!s) return bad(f, MOTUS_ARGUMENT, "the line has too few columns", err);
    if (!is_number(s, &value) || !isfinite(value)) {
        snprintf(what, sizeof what, "%.60s is not a finite number", *s ? s : "nothing");
        return bad(f, MOTUS_ARGUMENT, what, err);
    }
    if (*count == FILE_VALUES_MAX)
        return fail(err, MOTUS_LIMIT, "%s has more than %d values", f->path, FILE_VALUES_MAX);
    if ((*count & (*count - 1)) == 0) { /* the list is full with 0, 1, 2, 4, 8, … numbers */
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
    motus_status status = file_open(path, &f.stream, err);
    if (status) return status;
    bool more = true;
    while (!status && !(status = next_line(&f, &more, err)) && more) {
        bool is_row = f.place != SIZE_MAX;
        if (!is_row) status = find_column(&f, &is_row, err);
        if (!status && is_row) status = read_row(&f, list, count, err);
    }
    if (!status && *count == 0) status = fail(err, MOTUS_ARGUMENT, "%s holds no values", path);
    fclose(f.stream);
    free(f.line);
    return status;
}
