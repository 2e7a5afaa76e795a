/* Numbers from a column of a file: values separated by commas, semicolons, tabs or blanks.
 *
 * Invariant: every row gives one finite number, or the error names its line. What stands between columns is told by the
 * first line. Where that is no comma, a comma in a number is a decimal comma; where rows like 0,5 may be one number as
 * well as two columns, the file is refused.
 */
#include "cli/files/column.h"

#include "cli/files/file.h"
#include "cli/words/complain.h"
#include "cli/words/words.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

typedef struct reading {
    const char *path, *column;
    FILE *stream;
    char *line;
    size_t room;
    long long number; /* of the line */
    char between;     /* what separates columns; ' ' also for several blanks and tabs */
    size_t place;     /* the place of the column, from 0; SIZE_MAX: not known yet */
    size_t columns;   /* of the head; 0: there is none */
    bool doubtful;    /* every row so far may be one number with a decimal comma */
} reading;

static char separator_of(const char *line)
{
    return strchr(line, '\t') ? '\t' : strchr(line, ';') ? ';' : strchr(line, ',') ? ',' : ' ';
}

/* Returns the rest of a line from field `k` on; NULL: it has fewer fields. */
static char *field_at(const reading *f, char *s, size_t k)
{
    for (;; k--) {
        s += strspn(s, f->between == '\t' ? " " : " \t");
        if (k == 0 || (!*s && f->between == ' ')) return *s || f->between != ' ' ? s : NULL;
        if (*s == '"' && f->between != ' ')
            for (s++; *s && !(*s == '"' && s[1] != '"'); s++) s += *s == '"'; /* "" stands for " */
        s += f->between == ' ' ? strcspn(s, " \t") : strcspn(s, (const char[]){f->between, 0});
        if (f->between != ' ' && *s++ != f->between) return NULL;
    }
}

static size_t count_fields(const reading *f, char *s)
{
    size_t n = 0;
    while (field_at(f, s, n)) n++;
    return n;
}

/* Cuts out field `k` of the line, without its quotes. Returns NULL if the line has fewer fields. */
static char *field(const reading *f, char *s, size_t k)
{
    char *const start = s = field_at(f, s, k), *out = start;
    if (!s) return NULL;
    if (*s == '"' && f->between != ' ') {
        for (s++; *s && !(*s == '"' && s[1] != '"'); *out++ = *s++) s += *s == '"';
    } else {
        out = s + (f->between == ' ' ? strcspn(s, " \t") : strcspn(s, (const char[]){f->between, 0}));
        while (out > start && (out[-1] == ' ' || out[-1] == '\t')) out--;
    }
    *out = 0;
    return start;
}

static motus_status bad(const reading *f, motus_status status, const char *what, motus_error *err)
{
    return fail(err, status, "%s:%lld: %s", f->path, f->number, what);
}

/* Reads a line, without its end, of a stream that may be endless, as its lines may be. *more is false at the end. */
static motus_status read_line(reading *f, size_t *length, bool *more, motus_error *err)
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
static motus_status next_line(reading *f, bool *more, motus_error *err)
{
    static const char mark[] = "\xEF\xBB\xBF"; /* some programs begin a file in UTF-8 with it */
    for (;;) {
        size_t length = 0;
        const motus_status status = read_line(f, &length, more, err);
        if (status || !*more) return status;
        if (f->number == 1 && length >= strlen(mark) && memcmp(f->line, mark, strlen(mark)) == 0)
            memmove(f->line, f->line + strlen(mark), (length -= strlen(mark)) + 1);
        while (length > 0 && f->line[length - 1] == '\r') f->line[--length] = 0;
        const char first = f->line[strspn(f->line, " \t")];
        if (first && first != '#' && first != '%') return MOTUS_OK;
    }
}

/* Returns whether a text is a number, which may be infinite or NaN; *value is then not finite. Overwrites a decimal
 * comma. */
static bool is_number(const reading *f, char *s, double *value)
{
    char *const comma = f->between == ',' || strchr(s, '.') ? NULL : strchr(s, ',');
    if (comma) *comma = '.';
    if (typed_decimal(s, value)) return true;
    if (comma) *comma = ',';
    *value = NAN;
    s += *s == '-' || *s == '+';
    return strcasecmp(s, "nan") == 0 || strcasecmp(s, "inf") == 0 || strcasecmp(s, "infinity") == 0;
}

/* Returns whether a row may be one number with a decimal comma: 0,5. */
static bool is_doubtful(const char *s)
{
    s += strspn(s, " \t");
    s += *s == '-' || *s == '+';
    const size_t whole = strspn(s, "0123456789");
    if (!whole || s[whole] != ',') return false;
    s += whole + 1;
    const size_t decimals = strspn(s, "0123456789");
    return decimals > 0 && !s[decimals + strspn(s + decimals, " \t")];
}

/* Copies the line and cuts out a field of it. NULL: there is none, or no memory. */
static char *copy_field(const reading *f, char **copy, size_t k)
{
    free(*copy);
    *copy = strdup(f->line);
    return *copy ? field(f, *copy, k) : NULL;
}

/* Returns whether a field of the line is a number: then the line is no head. */
static bool has_number(const reading *f, size_t columns, char **copy)
{
    bool any = false;
    double value;
    for (size_t k = 0; k < columns && !any; k++) {
        char *const s = copy_field(f, copy, k);
        any = s && is_number(f, s, &value);
    }
    return any;
}

/* Finds the column by the first line. *is_row says whether that line is a row, and not the head. */
static motus_status find_column(reading *f, bool *is_row, motus_error *err)
{
    int64_t n = 1;
    const char *rest = "";
    const bool counted = !f->column || (typed_count(f->column, &n, &rest) && !*rest);
    char *copy = NULL, *s;
    motus_status status = MOTUS_OK;
    f->between = separator_of(f->line);
    f->doubtful = true;
    const size_t columns = count_fields(f, f->line);
    if (!f->column && columns > 1 && !is_doubtful(f->line)) {
        fail(err, MOTUS_ARGUMENT, "%s has several columns", f->path);
        hint(err, "name one, or give its number: F=@%s:1", f->path);
        return MOTUS_ARGUMENT;
    }
    if (counted) {
        f->place = (size_t)n - 1;
        s = copy_field(f, &copy, f->place);
        *is_row = !s || has_number(f, columns, &copy); /* read_row() reports what is missing or no number */
    }
    for (size_t k = 0; f->place == SIZE_MAX && k < columns; k++)
        if ((s = copy_field(f, &copy, k)) && strcmp(s, f->column) == 0) f->place = k;
    if (f->place == SIZE_MAX) {
        fail(err, MOTUS_NAME, "%s has no column %s", f->path, f->column);
        hint(err, "its first line is: %.200s", f->line);
        status = MOTUS_NAME;
    }
    free(copy);
    if (!*is_row) f->columns = columns;
    return status;
}

/* Grows a list that is full when it has 0, 1, 2, 4, 8, … numbers. */
static bool grow(void *list, size_t size, uint64_t count)
{
    void **const at = list;
    if (count & (count - 1)) return true;
    void *const larger = realloc(*at, (count ? 2 * count : 1) * size);
    if (larger) *at = larger;
    return larger != NULL;
}

static motus_status read_row(reading *f, column *to, motus_error *err)
{
    f->doubtful = f->doubtful && !f->columns && f->between == ',' && is_doubtful(f->line);
    if (f->columns && count_fields(f, f->line) > f->columns)
        return bad(f, MOTUS_ARGUMENT, "the line has more columns than the first line has names", err);
    char *s = field(f, f->line, f->place), what[128];
    double value = 0;
    if (!s) return bad(f, MOTUS_ARGUMENT, "the line has too few columns", err);
    if (!is_number(f, s, &value) || !isfinite(value)) {
        snprintf(what, sizeof what, "%.60s is not a finite number", *s ? s : "nothing");
        return bad(f, MOTUS_ARGUMENT, what, err);
    }
    if (to->count == FILE_VALUES_MAX)
        return fail(err, MOTUS_LIMIT, "%s has more than %d values", f->path, FILE_VALUES_MAX);
    if (!grow(&to->value, sizeof *to->value, to->count) || !grow(&to->line, sizeof *to->line, to->count))
        return complain_memory(err);
    to->line[to->count] = f->number;
    to->value[to->count++] = value;
    return MOTUS_OK;
}

motus_status column_read(const char *path, const char *name, column *to, motus_error *err)
{
    reading f = {.path = path, .column = name, .place = SIZE_MAX};
    *to = (column){0};
    motus_status status = file_open(path, &f.stream, err);
    if (status) return status;
    bool more = true;
    while (!status && !(status = next_line(&f, &more, err)) && more) {
        bool is_row = f.place != SIZE_MAX;
        if (!is_row) status = find_column(&f, &is_row, err);
        if (!status && is_row) status = read_row(&f, to, err);
    }
    if (!status && to->count == 0) status = fail(err, MOTUS_ARGUMENT, "%s holds no values", path);
    if (!status && f.doubtful)
        status =
            complain(err, MOTUS_ARGUMENT,
                     "write decimal points; or separate columns by semicolons or tabs, or name them in a first line",
                     "%s: each row may be a number with a decimal comma, or two columns", path);
    fclose(f.stream);
    free(f.line);
    return status;
}

motus_status column_of(const char *place, char **path, column *to, motus_error *err)
{
    *path = strdup(place);
    if (!*path) return complain_memory(err);
    char *const colon = strrchr(*path, ':');
    if (colon) *colon = 0;
    return column_read(*path, colon ? colon + 1 : NULL, to, err);
}

void column_free(column *c)
{
    free(c->value);
    free(c->line);
    *c = (column){0};
}
