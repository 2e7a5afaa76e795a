/* The trajectory as CSV: a comment with the command, the names of the columns, the numbers without loss. */
#ifndef CLI_RUN_CSV_H
#define CLI_RUN_CSV_H

#include "cli/files/file.h"
#include "cli/model/load.h"

typedef struct csv {
    file_out *file;
    const load *model;
    size_t *columns; /* the columns of the model, in the order of the file */
    size_t count;
    bool errors; /* after them come the error of every column but t, and `significant` */
    char *line;  /* memory for one row */
    int64_t rows;
    int64_t jumps; /* the rows have both sides of so many */
} csv;

/* Chooses the columns: those of --columns, or all. */
motus_status csv_plan(csv *, const load *, const options *, motus_error *);
motus_status csv_begin(csv *, file_out *, const options *, const motus_run *, motus_error *);
/* Writes the line of the names. Call it before csv_row(). */
motus_status csv_names(csv *, file_out *, motus_error *);
/* Writes one row; `context` is a csv. It is the `take` of a walk_observer. */
motus_status csv_row(void *context, const double *values, motus_error *);
/* Returns whether every value has a significant digit, by the errors after the values. */
bool csv_significant(const csv *, const double *values);
/* Writes both sides of a jump. It is the `jump` of a walk_observer. */
motus_status csv_jump(void *context, const double *before, const double *after, motus_error *err);
void csv_free(csv *);

/* Writes the comment with the command and the run's method. */
motus_status csv_comment(file_out *, const options *, const motus_run *, motus_error *);
/* Writes numbers, each after a comma. */
motus_status csv_numbers(file_out *, const double *, size_t count, motus_error *);
/* Writes the name of a column, in quotes if it has a comma or a quote. */
motus_status csv_name(file_out *, const char *name, motus_error *);

/* event_file.c: the table of a run's events as CSV. */

/* Writes the events of a finished run: event, t, t.error if the errors of times are known, count, touched, the columns
 * (those of --columns, or state, quantities and invariants) on arrival, and each again with .after, as the actions left
 * it. */
motus_status event_file_write(file_out *, const load *, const options *, motus_run *, motus_error *);

/* Chooses the columns of such a table; the caller frees them. */
motus_status event_file_columns(const load *, const options *, size_t **columns, size_t *count, motus_error *);
/* Write the names, from `event` on, and a row. */
motus_status event_file_names(file_out *, const load *, const size_t *columns, size_t count, bool errors,
                              motus_error *);
motus_status event_file_row(file_out *, const motus_event_row *, bool errors, const double *values, const double *after,
                            size_t count, motus_error *);

#endif
