/* Text for a terminal: made safe, measured in columns; numbers for tables. */
#ifndef CLI_WORDS_TEXT_H
#define CLI_WORDS_TEXT_H

#include "base/decimal.h"
#include "tell/json.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* Reads the character at s. Returns its bytes. A byte that is not UTF-8 reads as U+FFFD. */
size_t text_decode(const char *s, uint32_t *character);

/* Copies a text so that it is safe for a terminal, cut between characters if it does not fit. */
void text_safe(const char *s, char *out, size_t size);
void text_put(FILE *out, const char *s);
/* Returns how many columns text_safe(s) takes on a terminal. */
size_t text_width(const char *s);
/* Returns how many columns a line on this stream may have: those of its terminal, or 80. */
size_t text_columns(FILE *out);
/* Prints each line of `s` indented, and wrapped so that it fits the terminal and can be read. */
void text_wrap(FILE *out, const char *s, size_t indent);
/* The same where the first line goes on at a column; the others are indented. Does not end the last line. */
void text_flow(FILE *out, const char *s, size_t column, size_t indent, size_t width);
/* Formats prose, and prints it as text_wrap() does, with lines that go on indented by 4. */
void text_say(FILE *out, const char *format, ...);

/* Writes a number with |digits| significant digits, always with an exponent if `digits` is negative; NaN as "-". */
void text_brief(double value, int digits, char out[DECIMAL_MAX]);
/* Writes a time as "12.3 ms" or "4.56 s". */
void text_seconds(double seconds, char out[DECIMAL_MAX]);

/* Opens a JSON object on a stream, which json_end() closes; ferror() shows failures. */
json text_json(FILE *);

/* A table of text: each column as wide as its widest cell on a terminal. */
typedef struct table table;

/* `align` has a letter for each column, 'l' or 'r'. Returns NULL if memory runs out; the other calls accept NULL. */
table *table_create(const char *align);
void table_destroy(table *);
/* Add the next cell, row by row; the first row is the heading. */
void table_cell(table *, const char *text);
void table_number(table *, double value, int digits); /* as text_brief() */
void table_exact(table *, double value);              /* as decimal() */
void table_bar(table *, double value, double error);  /* as bar_text() */
void table_integer(table *, long long value);
/* Print the table, for a terminal or as Markdown. They return false if memory ran out while the table was made. */
bool table_print(const table *, FILE *, int indent, bool colours);
bool table_markdown(const table *, FILE *);

#endif
