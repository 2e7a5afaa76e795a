/* motus run: what its source files share. */
#ifndef CLI_RUN_RUN_H
#define CLI_RUN_RUN_H

#include "cli/files/stop.h"
#include "cli/model/load.h"
#include "cli/run/csv.h"
#include "cli/run/walk.h"
#include "cli/words/options.h"

#include <motus-archive.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* ---- run_command.c ---- */

/* The command that makes the rows, with every setting written out, to be freed also after a failure: the method and
 * the steps are those that the run has found. */
motus_status run_command_text(const options *, const motus_run *, double until, char **text, motus_error *);
/* The hash of all that the rows depend on. Returns out. */
enum { RUN_FINGERPRINT = 17 };
const char *run_command_fingerprint(const char *version, const char *model, const char *command,
                                    char out[RUN_FINGERPRINT]);

/* The options of the archive's command, and of those that are given now what is not the motion itself. */
typedef struct run_command {
    options options;
    options_list argv;
    char *words, *model;
} run_command;
/* The command of an archive alone, with threads and machine of the one that asks. MOTUS_STATE: it is not that of a run.
 * Call run_command_free() in any case. */
motus_status run_command_of(run_command *, motus_archive *, const options *, motus_error *);
/* Of the archive that the options name, for a run that goes on; MOTUS_ARGUMENT: an option that the archive decides. */
motus_status run_command_read(run_command *, const options *, motus_error *);
void run_command_free(run_command *);

/* The definition of a run with the settings that the options have. */
motus_run_def run_make_asked(const options *);
/* Settles step and end of the model, which is loaded, and creates the run; *def is its definition. Names in the notes
 * of the run are told unless the command is quiet. */
motus_status run_make(const options *, load *, stop_progress *, motus_bars, motus_run_def *def, motus_run **,
                      motus_error *);
/* When rows are taken: as the options say, else the model, else every step. Stride or period, of which the other is
 * 0. */
walk_observer run_make_rows(const options *, const load *, const motus_run *);

/* ---- run_state.c ---- */

/* A state in the archive of a run: how many rows there are up to it, the library's restart state, and the rows of the
 * block that is not complete. */
typedef struct run_state {
    uint64_t rows;
    int64_t samples;         /* how many times of a period rows were taken at */
    bool due;                /* the row that may be due where the run stands has not been taken */
    const char *text, *rest; /* the restart state, and behind it the rows */
    size_t length, rest_length;
} run_state;

/* The bytes of a state, to be freed: the `rest` is left to the caller, who writes *rest of these bytes. NULL: no
 * memory. */
char *run_state_write(const run_state *, size_t *length, char **rest);
/* False: these bytes, behind which a 0 stands, are no state. */
bool run_state_read(const char *bytes, size_t length, run_state *);
/* What a slot has room for beside a restart state of this length and rows of so many bytes: a quarter more. */
size_t run_state_slot(size_t length, size_t rest);

/* ---- run_again.c: computes the first rows of the archive of a run once more ---- */

enum { RUN_WHERE = 256 };
/* Whether the first `rows` rows have the bytes that the run of the options has; `where`, where they have not: which row
 * and which number. progress: NULL, none is told. MOTUS_STATE: the archive has other columns. */
motus_status run_again_rows(const options *, motus_archive *, uint64_t rows, bool *same, char where[RUN_WHERE],
                            stop_progress *, motus_error *);

/* ---- run_columns.c ---- */

/* The columns of a run in an archive. A family is one column, whose rows have its members, and their components.
 * Families of vectors in 2 or 3 dimensions, quantities and invariants have the names of H5MD 1.1 too (nongnu.org/h5md),
 * so that programs for the motion of particles read them. */
typedef struct run_column {
    char name[MOTUS_NAME_MAX + 96];
    size_t from, width; /* where its numbers are in a row of the CSV, errors behind values; the last column is
                           `significant`, with from SIZE_MAX, where errors are told */
} run_column;

typedef struct run_columns {
    run_column *columns; /* as many as there are */
    motus_archive_column *described;
    size_t count;
    size_t width; /* of all columns together */
    motus_archive_link *links;
    size_t link_count;
    motus_archive_attribute *attributes;
    size_t attribute_count;
    char **texts; /* of links and attributes */
    size_t text_count;
} run_columns;

/* Call run_columns_free() in any case. */
motus_status run_columns_make(run_columns *, const csv *, motus_error *);
void run_columns_free(run_columns *);
/* Whether the archive has these columns. */
bool run_columns_fit(const run_columns *, const motus_archive *);
/* Room for so many rows of each column, to be freed by run_columns_drop(); NULL: no memory. */
double **run_columns_rooms(const run_columns *, size_t rows);
void run_columns_drop(const run_columns *, double **rooms);
/* Puts the values that a walk gives, of which row i is to consist, into the rooms. */
void run_columns_put(const run_columns *, const csv *, const double *values, double *const *rooms, size_t i);

/* ---- run_archive.c ---- */

/* The archive of a run, FILE.h5: its rows, and the states from which it goes on. */
typedef struct run_archive run_archive;

/* The name of the note with the time and the number of rows at which a run that adapts its steps went on to a later
 * end. */
#define RUN_FIRST_END "first_end"

/* What the archive of a run is of. */
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
