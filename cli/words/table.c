/* A table of text.
 *
 * Invariant: the cells are one list, row by row, each as text_safe() makes it. A table that ran out of memory prints
 * nothing.
 */
#include "cli/words/text.h"

#include "tell/bar.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_COLUMNS = 32 };

struct table {
    char align[MOST_COLUMNS + 1];
    size_t columns, count, room;
    char **cells;
    bool failed;
};

table *table_create(const char *align)
{
    table *t = calloc(1, sizeof *t);
    if (!t) return NULL;
    t->columns = strlen(align);
    if (t->columns > MOST_COLUMNS) t->columns = MOST_COLUMNS;
    memcpy(t->align, align, t->columns);
    return t;
}

void table_destroy(table *t)
{
    if (!t) return;
    for (size_t i = 0; i < t->count; i++) free(t->cells[i]);
    free(t->cells);
    free(t);
}

void table_cell(table *t, const char *text)
{
    if (!t || t->failed) return;
    if (t->count == t->room) {
        size_t room = t->room ? 2 * t->room : 64;
        char **cells = realloc(t->cells, room * sizeof *cells);
        if (!cells) {
            t->failed = true;
            return;
        }
        t->cells = cells;
        t->room = room;
    }
    size_t size = 3 * strlen(text) + 1; /* U+FFFD for one byte takes three */
    char *cell = malloc(size);
    if (!cell) {
        t->failed = true;
        return;
    }
    text_safe(text, cell, size);
    t->cells[t->count++] = cell;
}

void table_number(table *t, double value, int digits)
{
    char text[DECIMAL_MAX];
    text_brief(value, digits, text);
    table_cell(t, text);
}

void table_exact(table *t, double value)
{
    char text[DECIMAL_MAX];
    decimal(value == 0 ? 0 : value, text); /* no -0 */
    table_cell(t, text);
}

void table_bar(table *t, double value, double error)
{
    char text[BAR_MAX];
    table_cell(t, bar_text(value, error, text));
}

void table_integer(table *t, long long value)
{
    char text[DECIMAL_MAX];
    snprintf(text, sizeof text, "%lld", value);
    table_cell(t, text);
}

bool table_print(const table *t, FILE *out, int indent, bool colours)
{
    if (!t || t->failed) return false;
    size_t width[MOST_COLUMNS] = {0};
    for (size_t i = 0; i < t->count; i++) {
        size_t w = text_width(t->cells[i]);
        if (w > width[i % t->columns]) width[i % t->columns] = w;
    }
    for (size_t i = 0; i < t->count; i++) {
        size_t column = i % t->columns, pad = width[column] - text_width(t->cells[i]);
        bool heading = i < t->columns, last = column == t->columns - 1 || i == t->count - 1;
        if (last && column > 0 && !t->cells[i][0]) {
            putc('\n', out);
            continue;
        }
        fprintf(out, "%*s", column == 0 ? indent : 2, "");
        if (t->align[column] == 'r') fprintf(out, "%*s", (int)pad, "");
        fprintf(out, "%s%s%s", heading && colours ? "\033[2m" : "", t->cells[i], heading && colours ? "\033[0m" : "");
        if (t->align[column] != 'r' && !last) fprintf(out, "%*s", (int)pad, "");
        if (last) putc('\n', out);
    }
    return true;
}

bool table_markdown(const table *t, FILE *out)
{
    if (!t || t->failed) return false;
    for (size_t i = 0; i < t->count; i++) {
        size_t column = i % t->columns;
        fputs(column == 0 ? "| " : " | ", out);
        for (const char *s = t->cells[i]; *s; s++) {
            if (*s == '|' || *s == '\\' || *s == '*' || *s == '_' || *s == '`' || *s == '<') putc('\\', out);
            putc(*s, out);
        }
        if (column < t->columns - 1) continue;
        fputs(" |\n", out);
        if (i == t->columns - 1)
            for (size_t k = 0; k < t->columns; k++)
                fprintf(out, "%s%s%s", k == 0 ? "|" : "", t->align[k] == 'r' ? "--:|" : ":--|",
                        k == t->columns - 1 ? "\n" : "");
    }
    return true;
}
