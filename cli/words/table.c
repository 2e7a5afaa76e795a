/* A table of text.
 *
 * Invariant: the cells are one list, row by row, each as text_safe() makes it. A table that ran out of memory prints
 * nothing. No line is wider than the terminal, unless the first column and another one are.
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

enum { GAP = 2, PROSE = 24 }; /* columns between cells; the least for prose in the last column */

typedef struct layout {
    size_t width[MOST_COLUMNS];
    size_t indent, wide; /* wide: the columns of the terminal */
    bool colours;
} layout;

/* Prints the first column and those from `from` up to `to`. */
static void print_block(const table *t, FILE *out, const layout *l, size_t from, size_t to)
{
    for (size_t row = 0; row * t->columns < t->count; row++) {
        size_t at = l->indent;
        fprintf(out, "%*s", (int)l->indent, "");
        for (size_t k = 0; k < to; k = k ? k + 1 : from) {
            const size_t i = row * t->columns + k, next = k ? k + 1 : from;
            const char *cell = i < t->count ? t->cells[i] : "";
            const size_t pad = l->width[k] - text_width(cell);
            const bool last = next >= to || i + 1 >= t->count, heading = row == 0 && l->colours;
            if (last && k > 0 && !*cell) break;
            if (k > 0) fprintf(out, "%*s", GAP, "");
            if (k > 0) at += GAP;
            if (t->align[k] == 'r') fprintf(out, "%*s", (int)pad, "");
            fputs(heading ? "\033[2m" : "", out);
            if (last && t->align[k] != 'r' && k > 0)
                text_flow(out, cell, at, at, l->wide);
            else
                fputs(cell, out);
            fputs(heading ? "\033[0m" : "", out);
            if (t->align[k] != 'r' && !last) fprintf(out, "%*s", (int)pad, "");
            at += l->width[k];
        }
        putc('\n', out);
    }
}

/* A table that is wider than the terminal is printed in parts, each with the first column; prose in the last column is
 * wrapped there. */
bool table_print(const table *t, FILE *out, int indent, bool colours)
{
    if (!t || t->failed) return false;
    layout l = {.indent = (size_t)indent, .wide = text_columns(out), .colours = colours};
    for (size_t i = 0; i < t->count; i++) {
        size_t w = text_width(t->cells[i]);
        if (w > l.width[i % t->columns]) l.width[i % t->columns] = w;
    }
    for (size_t from = 1, to; from == 1 || from < t->columns; from = to) {
        size_t at = l.indent + l.width[0];
        for (to = from; to < t->columns; to++) {
            const bool prose = to == t->columns - 1 && t->align[to] != 'r' && l.width[to] > PROSE;
            at += GAP + (prose ? PROSE : l.width[to]);
            if (at > l.wide && to > from) break;
        }
        if (from > 1) putc('\n', out);
        print_block(t, out, &l, from, to);
        if (to == from) break; /* one column only */
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
