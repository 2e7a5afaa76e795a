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
    bool errors; /* the error of every column but t behind them, and `significant` */
    char *line;  /* room for one row */
    int64_t rows;
} csv;

/* Chooses the columns (the options', or all). */
motus_status csv_plan(csv *, const load *, const options *, motus_error *);
motus_status csv_begin(csv *, file_out *, const options *, const motus_run *, motus_error *);
/* The line of the names, for csv_row(). */
motus_status csv_names(csv *, file_out *, motus_error *);
/* Writes one row; context is a csv. The take of a walk_observer. */
motus_status csv_row(void *context, const double *values, motus_error *);
/* Whether any digit of the values is known, by the errors behind them. */
bool csv_significant(const csv *, const double *values);
/* Writes both sides of a jump; the jump of a walk_observer. */
motus_status csv_jump(void *context, const double *before, const double *after, motus_error *err);
void csv_free(csv *);

/* The comment with the command and the run's method. */
motus_status csv_comment(file_out *, const options *, const motus_run *, motus_error *);
/* Numbers, a comma before each. */
motus_status csv_numbers(file_out *, const double *, size_t count, motus_error *);
/* The name of a column, quoted where it holds a comma or a quote. */
motus_status csv_name(file_out *, const char *name, motus_error *);

/* event_file.c: the table of a run's events as CSV: what happened, when, and the numbers before and after. */
/* Of a run at its end: event, t, t.error where the times' errors are known, count, touched, the columns of the options
 * (else state, quantities and invariants) on arrival, and the same with .after as the actions left them. */
motus_status event_file_write(file_out *, const load *, const options *, motus_run *, motus_error *);

/* The columns of such a table, to be freed; and its text: the names from `event` on, and a row. */
motus_status event_file_columns(const load *, const options *, size_t **columns, size_t *count, motus_error *);
motus_status event_file_names(file_out *, const load *, const size_t *columns, size_t count, bool errors,
                              motus_error *);
motus_status event_file_row(file_out *, const motus_event_row *, bool errors, const double *values, const double *after,
                            size_t count, motus_error *);

#endif
