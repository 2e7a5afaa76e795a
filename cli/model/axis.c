/* Reads the value of one --vary or --random.
 *
 *     --vary     NAME=FROM:TO:COUNT   NAME=log:FROM:TO:COUNT   NAME=A,B,C   NAME=@FILE:COLUMN
 *     --random   NAME=FROM:TO         NAME=normal:MEAN:DEVIATION
 *
 * Invariant: numbers are constant expressions of the language. Each is finite, and each count at least 1.
 */
#include "cli/files/column.h"
#include "cli/model/grid.h"
#include "cli/words/complain.h"
#include "cli/words/words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PARTS = 5 };

typedef struct reading {
    const char *option, *spec;
    char *text; /* a copy, cut into parts */
    char where[MOTUS_TEXT_MAX / 2];
    motus_error *err;
} reading;

static motus_status wrong(const reading *r, const char *what)
{
    bool drawn = strcmp(r->option, "--random") == 0;
    fail(r->err, MOTUS_ARGUMENT, "%s: %s", r->where, what);
    hint(r->err, "%s",
         drawn ? "F=0:1 or F=normal:MEAN:DEVIATION" : "F=0:1:11, F=log:0.1:10:5, F=1,2,5 or F=@values.csv:column");
    return MOTUS_ARGUMENT;
}

static char *trim(char *s)
{
    s += strspn(s, " ");
    for (char *end = s + strlen(s); end > s && end[-1] == ' ';) *--end = 0;
    return s;
}

/* Cuts a text at each `mark` outside brackets. Returns the number of parts, or most + 1 if there are more than
 * `most`. */
static size_t cut(char *s, char mark, char **parts, size_t most)
{
    size_t count = 0;
    int depth = 0;
    char *part = s;
    for (;; s++) {
        depth += (*s == '(' || *s == '[') - (*s == ')' || *s == ']');
        if (*s && !(*s == mark && depth <= 0)) continue;
        bool last = !*s;
        *s = 0;
        if (count < most) parts[count] = trim(part);
        count++;
        if (last || count > most) return count;
        part = s + 1;
    }
}

static motus_status number(const reading *r, const char *text, double *value)
{
    return typed_constant(text, r->where, value, r->err);
}

static motus_status read_range(const reading *r, char **parts, bool logarithmic, axis *a)
{
    double from, to;
    int64_t count;
    const char *rest;
    motus_status status = number(r, parts[0], &from);
    if (!status) status = number(r, parts[1], &to);
    if (status) return status;
    if (!typed_count(parts[2], &count, &rest) || *rest) return wrong(r, "its count is not an integer above 0");
    if ((uint64_t)count > GRID_MOST)
        return fail(r->err, MOTUS_LIMIT, "%s: a count above %llu", r->where, (unsigned long long)GRID_MOST);
    if (count == 1 && from != to) return wrong(r, "a count of 1 needs FROM and TO to be equal");
    if (logarithmic && (from == 0 || to == 0 || (from > 0) != (to > 0)))
        return wrong(r, "a log range needs two ends of the same sign, and not 0");
    if (logarithmic && fabs(log10(fabs(to)) - log10(fabs(from))) > 300)
        return wrong(r, "the ends are more than 300 decades apart");
    if (!logarithmic && !isfinite((double)count * (fabs(from) + fabs(to)))) return wrong(r, "its ends are too large");
    a->kind = AXIS_RANGE;
    a->range = logarithmic ? range_log(from, to, (uint64_t)count) : range_linear(from, to, (uint64_t)count);
    a->count = (uint64_t)count;
    return MOTUS_OK;
}

static motus_status read_list(const reading *r, char *text, axis *a)
{
    size_t most = 1;
    for (const char *s = text; *s; s++) most += *s == ',';
    char **parts = malloc(most * sizeof *parts);
    a->list = malloc(most * sizeof *a->list);
    motus_status status = parts && a->list ? MOTUS_OK : complain_memory(r->err);
    a->kind = AXIS_LIST;
    a->count = status ? 0 : cut(text, ',', parts, most);
    for (size_t i = 0; !status && i < a->count; i++) status = number(r, parts[i], &a->list[i]);
    free(parts);
    return status;
}

static motus_status read_vary(const reading *r, char *text, axis *a)
{
    if (*text == '@') {
        column values;
        a->kind = AXIS_LIST;
        const motus_status status = column_of(trim(text + 1), &a->path, &values, r->err);
        a->list = values.value, a->count = values.count;
        free(values.line);
        return status;
    }
    char *parts[PARTS] = {NULL};
    char *copy = strdup(text);
    if (!copy) return complain_memory(r->err);
    size_t count = cut(copy, ':', parts, PARTS);
    motus_status status;
    if (count == 1)
        status = read_list(r, text, a);
    else if (count == 3)
        status = read_range(r, parts, false, a);
    else if (count == 4 && strcmp(parts[0], "log") == 0)
        status = read_range(r, parts + 1, true, a);
    else if (count == 4 && strcmp(parts[3], "log") == 0)
        status = wrong(r, "log has to come first");
    else if (count == 2)
        status = wrong(r, "the count is missing, FROM:TO:COUNT");
    else
        status = wrong(r, "this is not a range");
    free(copy);
    return status;
}

static motus_status read_random(const reading *r, char *text, axis *a)
{
    char *parts[PARTS];
    size_t count = cut(text, ':', parts, PARTS);
    bool normal = count == 3 && strcmp(parts[0], "normal") == 0;
    if (count != 2 && !normal) return wrong(r, "this is not a distribution");
    motus_status status = number(r, parts[normal], &a->range.from);
    if (!status) status = number(r, parts[normal + 1], &a->range.to);
    if (status) return status;
    if (normal && a->range.to < 0) return wrong(r, "the standard deviation is negative");
    if (!isfinite(normal ? fabs(a->range.from) + 40 * a->range.to : a->range.to - a->range.from))
        return wrong(r, "its numbers are too large");
    a->kind = normal ? AXIS_NORMAL : AXIS_UNIFORM;
    a->count = 1;
    return MOTUS_OK;
}

motus_status axis_read(axis *a, const char *option, const char *spec, motus_error *err)
{
    *a = (axis){.spec = spec};
    reading r = {.option = option, .spec = spec, .text = strdup(spec), .err = err};
    if (!r.text) return complain_memory(err);
    /* a message shows only the beginning of a long list */
    snprintf(r.where, sizeof r.where, "%s %.100s%s", option, spec, strlen(spec) > 100 ? "..." : "");
    char *equals = strchr(r.text, '=');
    *equals = 0;
    a->name = strdup(trim(r.text));
    motus_status status;
    if (!a->name)
        status = complain_memory(err);
    else if (!*a->name)
        status = wrong(&r, "the name is missing");
    else if (strcmp(option, "--random") == 0)
        status = read_random(&r, trim(equals + 1), a);
    else
        status = read_vary(&r, trim(equals + 1), a);
    free(r.text);
    return status;
}

void axis_free(axis *a)
{
    free(a->name);
    free(a->path);
    free(a->list);
}
