/* The archive of a run, FILE.h5: its rows, and the states from which it goes on. */
#ifndef CLI_RUN_RUN_ARCHIVE_H
#define CLI_RUN_RUN_ARCHIVE_H

#include "cli/run/csv.h"
#include "cli/run/walk.h"

typedef struct run_archive run_archive;

/* What the archive of a run is of. */
/* The name of the note with the time and the number of rows at which a run that adapts its steps went on to a later
 * end. */
#define RUN_FIRST_END "first_end"

typedef struct run_archive_def {
    const options *options;
    const load *model;
    const csv *plan; /* which columns */
    motus_run *run;
    double start, until;
    const walk_observer *rows; /* their stride or period */
    const char *from; /* an archive with whose state the run goes on, which may be the output itself; else NULL */
} run_archive_def;

/* Opens the file of --output, and moves the run to where it goes on: with --resume, or of `from`, to the latest state
 * there, else to its beginning. The file is made anew, or grows, so that it has room for the rows up to the end. Call
 * run_archive_close() in any case. */
motus_status run_archive_open(run_archive **, const run_archive_def *, motus_error *);
/* Who takes the rows, and who keeps states. */
void run_archive_observe(run_archive *, walk_observer *, walk_keeper *);
/* At the end: all rows and the last state are in the file, which has no room for more. */
motus_status run_archive_finish(run_archive *, motus_error *);
/* Then: replaces the file by a compressed one. */
motus_status run_archive_compress(run_archive *, motus_error *);
/* After a failure: says what the file has. A new one from which nothing goes on is removed. `whole`: the run itself has
 * reached its end. */
void run_archive_leave(run_archive *, bool whole);
void run_archive_close(run_archive *);

#endif
