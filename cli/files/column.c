/* Numbers from a column of a file: values separated by commas, semicolons, tabs or blanks.
 *
 * Invariant: every row gives one finite number, or the error names its line. Rows begin with the first line that has a
 * number, or behind the line that names the column; what stands before is a head. The last line of the head, or the
 * first row, tells what stands between columns. Where that is no comma, a comma in a number is a decimal comma; where
 * rows like 0,5 may be one number as well as two columns, the file is refused.
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
    char said;        /* what separates columns by a line sep=; 0: there is none */
    char between;     /* what separates them; ' ' also for several blanks and tabs */
    bool all;         /* all columns are wanted, row by row */
    bool begun;       /* the head is behind */
    bool units;       /* a line of units is behind the names */
    size_t place;     /* the place of the column, from 0; SIZE_MAX: not known yet */
    size_t columns;   /* of the head; 0: there is none */
    size_t words;     /* the place of a cell of the first row that is a word; SIZE_MAX: there is none */
    long long first;  /* the line of the first row */
    bool doubtful;    /* every row so far may be one number with a decimal comma */
    char head[128];   /* the first line */
} reading;

static char separator_of(const reading *f)
{
    const char *const line = f->line;
    if (f->said) return f->said;
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

/* Refuses a cell in quotes without its end. */
static motus_status check_quotes(const reading *f, motus_error *err)
{
    if (f->between == ' ' || !strchr(f->line, '"')) return MOTUS_OK;
    char *s;
    for (size_t k = 0; (s = field_at(f, f->line, k)); k++) {
        if (*s != '"') continue;
        for (s++; *s && !(*s == '"' && s[1] != '"'); s++) s += *s == '"';
        if (*s) continue;
        bad(f, MOTUS_ARGUMENT, "a quote has no end in this line", err);
        hint(err, "a cell ends in its line: close the quote, or remove it");
        return MOTUS_ARGUMENT;
    }
    return MOTUS_OK;
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
        if (c == '\r') { /* alone it ends a line, too */
            const int next = getc_unlocked(f->stream);
            if (next != '\n' && next != EOF) ungetc(next, f->stream);
            break;
        }
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
        const char first = f->line[strspn(f->line, " \t")];
        if (first && first != '#' && first != '%') return MOTUS_OK;
    }
}

/* Returns whether a text is a number, which may be infinite or NaN; *value is then not finite. Overwrites a decimal
 * comma, and the D of an exponent, as FORTRAN writes it. */
static bool is_number(const reading *f, char *s, double *value)
{
    char *const comma = f->between == ',' || strchr(s, '.') ? NULL : strchr(s, ','), *const power = strpbrk(s, "dD");
    if (comma) *comma = '.';
    if (power && strspn(s, "+-.0123456789") == (size_t)(power - s)) *power = 'e';
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

/* Returns whether a text stands for a missing number. */
static bool is_missing(const char *s)
{
    static const char *const marks[] = {"", "-", "--", "?", "na", "n/a", "null", "nil", "none", "missing"};
    bool is = false;
    for (size_t i = 0; i < sizeof marks / sizeof *marks; i++) is |= strcasecmp(s, marks[i]) == 0;
    return is;
}

/* Counts the cells of the line that are numbers, or stand for missing ones. *words: the place of another; SIZE_MAX:
 * there is none. */
static size_t count_numbers(const reading *f, size_t columns, char **copy, size_t *words)
{
    size_t numbers = 0;
    double value;
    *words = SIZE_MAX;
    for (size_t k = 0; k < columns; k++) {
        char *const s = copy_field(f, copy, k);
        if (s && is_number(f, s, &value))
            numbers++;
        else if (s && is_missing(s))
            numbers += *s != 0;
        else if (s)
            *words = k;
    }
    return numbers;
}

/* Finds the place of the column with the wanted name, if the line has it. */
static motus_status find_name(reading *f, size_t columns, char **copy, motus_error *err)
{
    for (size_t k = 0; k < columns; k++) {
        const char *const s = copy_field(f, copy, k);
        if (!s || strcmp(s, f->column) != 0) continue;
        if (f->place != SIZE_MAX) {
            fail(err, MOTUS_NAME, "%s:%lld: columns %zu and %zu have the name %s", f->path, f->number, f->place + 1,
                 k + 1, f->column);
            hint(err, "give the number of one: F=@%s:%zu", f->path, k + 1);
            return MOTUS_NAME;
        }
        f->place = k;
    }
    return MOTUS_OK;
}

static motus_status no_column(const reading *f, bool named, size_t columns, motus_error *err)
{
    fail(err, MOTUS_NAME, "%s has no column %s", f->path, f->column ? f->column : "1");
    if (named)
        hint(err, "its first line is: %s", f->head);
    else
        hint(err, "its columns have the numbers 1 to %zu", columns);
    return MOTUS_NAME;
}

/* Looks at a line that is of the head, or the first row: then *is_row is true. Behind the names there may be a line of
 * units. */
static motus_status look_at_head(reading *f, bool *is_row, motus_error *err)
{
    int64_t n = 1;
    const char *rest = "";
    const bool number = f->column && typed_count(f->column, &n, &rest) && !*rest, named = f->place != SIZE_MAX,
               name = f->column && !f->all && !number && strspn(f->column, "+-0123456789.") != strlen(f->column);
    const char before = f->between;
    char *copy = NULL;
    if (!f->head[0]) snprintf(f->head, sizeof f->head, "%.120s", f->line);
    if (!strncmp(f->line, "sep=", 4) && f->line[4] && !f->line[5]) /* Excel writes it */
        return f->said = f->line[4], MOTUS_OK;
    char *const mark = strchr(f->line, '#');
    size_t columns = 0, numbers = 0;
    for (int whole = !mark; whole < 2 && (whole == 0 || !numbers || f->words != SIZE_MAX); whole++) {
        if (mark) *mark = whole ? '#' : 0; /* it begins a comment behind numbers, but not in a name */
        if (!named) f->between = separator_of(f);
        columns = count_fields(f, f->line);
        numbers = count_numbers(f, columns, &copy, &f->words);
    }
    motus_status status = check_quotes(f, err);
    if (!status && name && !named) status = find_name(f, columns, &copy, err);
    free(copy);
    *is_row = f->begun = f->units || (numbers && (!(f->all || name) || named || f->words == SIZE_MAX));
    f->units = named;
    if (named || !*is_row || status) {
        if (!named) f->columns = columns;
        f->words = SIZE_MAX;
        return status;
    }
    f->first = f->number;
    const bool alone = before == ' ' && f->columns == 1; /* the head is a word, and not columns with other separators */
    if (alone && is_doubtful(f->line))
        f->between = ' ';
    else if (f->between != before)
        f->columns = 0; /* the head is prose */
    if (!f->column && columns > 1 && f->columns != 1 && (f->columns || !is_doubtful(f->line))) {
        fail(err, MOTUS_ARGUMENT, "%s has several columns", f->path);
        hint(err, "name one, or give its number: F=@%s:1; all of them, row by row: F=@%s:*", f->path, f->path);
        return MOTUS_ARGUMENT;
    }
    if (name || (f->column && !f->all && (!number || n < 1 || (size_t)n > columns)))
        return no_column(f, name, columns, err);
    f->place = (size_t)n - 1;
    return MOTUS_OK;
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

/* Refuses a cell. */
static motus_status no_number(const reading *f, const char *s, motus_error *err)
{
    char what[128];
    snprintf(what, sizeof what, "%.60s is not a finite number", *s ? s : "nothing");
    bad(f, MOTUS_ARGUMENT, what, err);
    if (*s && strspn(s, "+-0123456789.,' _") == strlen(s) && strcspn(s, "0123456789") < strlen(s))
        hint(err, "write a decimal point or comma, and no marks for thousands");
    else
        hint(err, "remove the line, or begin it with #: then it does not count");
    return MOTUS_ARGUMENT;
}

static motus_status keep(reading *f, column *to, double value, motus_error *err)
{
    if (to->count == FILE_VALUES_MAX)
        return fail(err, MOTUS_LIMIT, "%s has more than %d values", f->path, FILE_VALUES_MAX);
    if (!grow(&to->value, sizeof *to->value, to->count) || !grow(&to->line, sizeof *to->line, to->count))
        return complain_memory(err);
    to->line[to->count] = f->number;
    to->value[to->count++] = value;
    return MOTUS_OK;
}

/* Takes a cell out of the line, and keeps its number. *more false: the line has fewer cells. */
static motus_status take_cell(reading *f, size_t place, char **copy, bool *more, column *to, motus_error *err)
{
    double value = 0;
    char *const s = f->all ? copy_field(f, copy, place) : field(f, f->line, place);
    *more = s != NULL;
    if (!s || (f->all && !*s)) return MOTUS_OK;
    return is_number(f, s, &value) && isfinite(value) ? keep(f, to, value, err) : no_number(f, s, err);
}

/* Returns whether a cell is a number in this line. */
static bool number_at(const reading *f, size_t place)
{
    double value;
    char *copy = NULL, *const s = copy_field(f, &copy, place);
    const bool is = s && is_number(f, s, &value) && isfinite(value);
    free(copy);
    return is;
}

static motus_status read_row(reading *f, column *to, motus_error *err)
{
    char *copy = NULL, *end;
    bool more = true;
    f->line[strcspn(f->line, "#")] = 0; /* a comment behind the numbers */
    motus_status status = check_quotes(f, err);
    if (status) return status;
    f->doubtful = f->doubtful && !f->columns && f->between == ',' && is_doubtful(f->line);
    if (f->columns && f->between != ' ' && !f->all && (end = field_at(f, f->line, f->columns)) &&
        end[strspn(end, " \t,;")])
        return bad(f, MOTUS_ARGUMENT, "the line has more columns than the line of their names", err);
    if (f->words != SIZE_MAX && f->number > f->first && number_at(f, f->words)) {
        fail(err, MOTUS_ARGUMENT, "%s:%lld: column %zu has a word, and a number in line %lld", f->path, f->first,
             f->words + 1, f->number);
        hint(err, "begin the lines before the first row with #: then they do not count");
        return MOTUS_ARGUMENT;
    }
    size_t k = f->all ? 0 : f->place;
    do status = take_cell(f, k++, &copy, &more, to, err);
    while (f->all && more && !status);
    free(copy);
    return status || more || f->all ? status : bad(f, MOTUS_ARGUMENT, "the line has too few columns", err);
}

motus_status column_read(const char *path, const char *name, column *to, motus_error *err)
{
    reading f = {.path = path, .column = name, .place = SIZE_MAX, .words = SIZE_MAX, .doubtful = true};
    f.all = name && !strcmp(name, "*");
    *to = (column){0};
    motus_status status = file_open(path, &f.stream, err);
    if (status) return status;
    bool more = true;
    while (!status && !(status = next_line(&f, &more, err)) && more) {
        bool is_row = f.begun;
        if (!is_row) status = look_at_head(&f, &is_row, err);
        if (!status && is_row) status = read_row(&f, to, err);
    }
    const bool named = name && !f.all && f.place == SIZE_MAX && f.head[0];
    if (!status && named) status = no_column(&f, true, 0, err);
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
    char *name = colon ? colon + 1 + strspn(colon + 1, " ") : NULL;
    for (size_t n = name ? strlen(name) : 0; n > 0 && name[n - 1] == ' ';) name[--n] = 0;
    return column_read(*path, name && *name ? name : NULL, to, err);
}

void column_free(column *c)
{
    free(c->value);
    free(c->line);
    *c = (column){0};
}
