/* Numbers from a column of a file: CSV, TSV, or separated by blanks. */
#ifndef CLI_FILES_COLUMN_H
#define CLI_FILES_COLUMN_H

#include "motus.h"

#include <stdint.h>

typedef struct column {
    double *value;
    long long *line; /* of each value, in the file */
    uint64_t count;
} column;

/* Reads a column. `name` is its name in a line before the first row, or its number from 1, NULL for the only one, or
 * "*": all columns, row by row. Lines that begin with # or %, and empty ones, do not count. */
motus_status column_read(const char *path, const char *name, column *, motus_error *);
/* Reads the column that a text PATH:NAME or PATH names; the caller frees *path. */
motus_status column_of(const char *place, char **path, column *, motus_error *);
void column_free(column *);

#endif
