/* Columns of a run kept in memory, one array each, at a bounded number of steps. */
#ifndef CLI_RECORD_H
#define CLI_RECORD_H

#include "cli/walk.h"

typedef struct record {
    size_t *columns;
    double **values; /* values[k][row] of columns[k] */
    size_t count;
    size_t rows, room; /* a record with room for one row keeps the last */
    int64_t stride;
} record;

/* For at most `looks` looks at a run of `steps` steps; looks = 1: at the end only. */
record record_for(int64_t steps, int64_t looks);
/* One more column: its array, which stays where it is. NULL when there is no memory. */
double *record_want(record *, size_t column);
walk_watcher record_watcher(record *);
void record_free(record *);

#endif
