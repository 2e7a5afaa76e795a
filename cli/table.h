/* A table for people: columns as wide as their widest cell, measured as a terminal shows them. */
#ifndef CLI_TABLE_H
#define CLI_TABLE_H

#include <stdbool.h>
#include <stdio.h>

typedef struct table table;

/* `align`: one letter a column, 'l' or 'r'. NULL when there is no memory; every call takes NULL. */
table *table_create(const char *align);
void table_destroy(table *);
/* The next cell, row by row; the first row is the heading. */
void table_cell(table *, const char *text);
void table_number(table *, double value, int digits); /* brief; "-" for NaN */
void table_exact(table *, double value);              /* shortest that reads back the same */
void table_integer(table *, long long value);
/* false when memory ran out on the way. */
bool table_print(const table *, FILE *, int indent, bool colours);
/* The same as a Markdown table. */
bool table_markdown(const table *, FILE *);

#endif
