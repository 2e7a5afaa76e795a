/* Text for a terminal: made safe, measured in columns; numbers for tables. */
#ifndef CLI_WORDS_TEXT_H
#define CLI_WORDS_TEXT_H

#include "base/decimal.h"
#include "tell/json.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* The character at s and the bytes it takes; bytes that are not UTF-8 read as U+FFFD, one at a time. */
size_t text_decode(const char *s, uint32_t *character);

/* A copy that is safe for a terminal, cut between characters if it does not fit. */
void text_safe(const char *s, char *out, size_t size);
void text_put(FILE *out, const char *s);
/* The columns that text_safe(s) takes on a terminal. */
size_t text_width(const char *s);
/* Wraps each line of `s` at `width` columns, indented. */
void text_wrap(FILE *out, const char *s, size_t indent, size_t width);

/* |digits| significant digits, if negative always with an exponent; "-" for NaN. */
void text_brief(double value, int digits, char out[DECIMAL_MAX]);
/* "12.3 ms", "4.56 s". */
void text_seconds(double seconds, char out[DECIMAL_MAX]);

/* A JSON object to a stream, up to json_end(); failures show in ferror(). */
json text_json(FILE *);

/* A table of text: each column as wide as its widest cell on a terminal. */
typedef struct table table;

/* `align`: one letter a column, 'l' or 'r'. NULL: out of memory; every call takes NULL. */
table *table_create(const char *align);
void table_destroy(table *);
/* The next cell, row by row; the first row is the heading. */
void table_cell(table *, const char *text);
void table_number(table *, double value, int digits); /* as text_brief() */
void table_exact(table *, double value);              /* the shortest decimal that reads back the same */
void table_bar(table *, double value, double error);  /* as bar_text() */
void table_integer(table *, long long value);
/* False: memory ran out while the table was made. */
bool table_print(const table *, FILE *, int indent, bool colours);
/* The same as a Markdown table. */
bool table_markdown(const table *, FILE *);

#endif
