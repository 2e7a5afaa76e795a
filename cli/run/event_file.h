/* The table of a run's events as CSV: what happened, when, and the numbers before and after. */
#ifndef CLI_RUN_EVENT_FILE_H
#define CLI_RUN_EVENT_FILE_H

#include "cli/files/file.h"
#include "cli/model/load.h"

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
