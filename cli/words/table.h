/* A table of text: each column as wide as its widest cell on a terminal. */
#ifndef CLI_WORDS_TABLE_H
#define CLI_WORDS_TABLE_H

#include <stdbool.h>
#include <stdio.h>

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
