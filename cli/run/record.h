/* Columns of a run in memory, one array each, at a bounded number of steps. */
#ifndef CLI_RUN_RECORD_H
#define CLI_RUN_RECORD_H

#include "cli/run/walk.h"

typedef struct record {
    size_t *columns;
    double **values; /* values[k][row] of columns[k] */
    size_t count;
    size_t rows, room; /* a record with room for one row keeps the last */
    int64_t stride;
    double period;   /* where steps adapt: of time, in place of a stride of steps */
    double **errors; /* errors[k][row] of columns[k]; NULL: they are not recorded */
    bool with_errors;
    int jumps; /* for how many there is room; 0: they are not recorded */
} record;

/* For at most `samples` samples of a run of `steps` steps over the time `way`; 0: steps adapt. 1: at the end only. */
record record_for(int64_t steps, double way, int64_t samples);
/* The same with both sides of jumps, and a row of NaN between them; without errors. Call before record_add(). */
record record_with_jumps(record);
/* Adds a column and returns its array, which is never moved. NULL: out of memory. */
double *record_add(record *, size_t column);
walk_observer record_observer(record *);
void record_free(record *);

#endif
