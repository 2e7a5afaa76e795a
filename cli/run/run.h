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

/* Writes the command that makes the rows, with every setting; the method and the steps are those that the run has
 * found. The caller frees *text, also after a failure. */
motus_status run_command_text(const options *, const motus_run *, double until, char **text, motus_error *);
enum { RUN_FINGERPRINT = 17 };
/* Writes the hash of all that the rows depend on. Returns out. */
const char *run_command_fingerprint(const char *version, const char *model, const char *command,
                                    char out[RUN_FINGERPRINT]);

/* The options of an archive's command, with the settings of the present command that do not change the motion. */
typedef struct run_command {
    options options;
    options_list argv;
    char *words, *model;
} run_command;
/* Reads the command of an archive, with our threads and machine. MOTUS_STATE: it is not that of a run. Call
 * run_command_free() in any case. */
motus_status run_command_of(run_command *, motus_archive *, const options *, motus_error *);
/* Reads the command of the archive that the options name, for a run that continues. MOTUS_ARGUMENT: an option is given
 * that the archive decides. */
motus_status run_command_read(run_command *, const options *, motus_error *);
void run_command_free(run_command *);

/* Returns the definition of a run with the settings of the options. */
motus_run_def run_make_asked(const options *);
/* Settles what the options and the model ask for, and creates the run; *def is its definition. Prints the notes of
 * the run unless the command is quiet. */
motus_status run_make(const options *, load *, stop_progress *, motus_bars, motus_run_def *def, motus_run **,
                      motus_error *);
/* Returns whether the options or the model say when rows are taken. */
bool run_make_asks_rows(const options *, const load *);
/* Returns when rows are taken: as the options say, or the model, or at every step. Either the stride or the period is
 * 0. */
walk_observer run_make_rows(const options *, const load *, const motus_run *);

/* ---- run_state.c ---- */

/* A state in the archive of a run. */
typedef struct run_state {
    uint64_t rows;           /* the rows before the state */
    int64_t samples;         /* how many samples of a period were taken */
    bool due;                /* a row that may be due at the state has not been taken */
    const char *text, *rest; /* the library's restart state; the rows of the block that is not complete */
    size_t length, rest_length;
} run_state;

/* Returns the bytes of a state, which the caller frees. The caller also writes the rows of the incomplete block to
 * *rest, which lies in them. NULL: no memory. */
char *run_state_write(const run_state *, size_t *length, char **rest);
/* Reads a state. A byte 0 follows the bytes. Returns false if they are not a state. */
bool run_state_read(const char *bytes, size_t length, run_state *);
/* Returns the size of a slot for a state with a restart state of this length, and a quarter more, and `rest` bytes of
 * rows. */
size_t run_state_slot(size_t length, size_t rest);

/* ---- run_again.c ---- */

enum { RUN_WHERE = 256 };
/* Computes the first rows of an archive again and compares their bytes. If they are not the `same`, `where` says in
 * which row and which number. The progress may be NULL. MOTUS_STATE: the archive has other columns. */
motus_status run_again_rows(const options *, motus_archive *, uint64_t rows, bool *same, char where[RUN_WHERE],
                            stop_progress *, motus_error *);

/* ---- run_columns.c ---- */

/* The columns of a run in an archive. A family is one column, whose rows have its members and their components.
 * Families of vectors in 2 or 3 dimensions, quantities and invariants also have the names of H5MD 1.1
 * (nongnu.org/h5md), so that programs for the motion of particles can read them. */
typedef struct run_column {
    char name[MOTUS_NAME_MAX + 96];
    size_t from, width; /* the place of its numbers among values and errors of a row; SIZE_MAX: it is `significant` */
} run_column;

typedef struct run_columns {
    run_column *columns;
    motus_archive_column *described; /* the columns as the library of archives describes them */
    size_t count;
    size_t width; /* numbers in a row of all columns together */
    motus_archive_link *links;
    size_t link_count;
    motus_archive_attribute *attributes;
    size_t attribute_count;
    char **texts; /* the texts of links, attributes and comments */
    size_t text_count;
} run_columns;

/* Call run_columns_free() in any case. */
motus_status run_columns_make(run_columns *, const csv *, motus_error *);
void run_columns_free(run_columns *);
/* Returns whether the archive has these columns. */
bool run_columns_fit(const run_columns *, const motus_archive *);
/* Returns rooms: memory for `rows` rows of each column, which run_columns_drop() frees. NULL: no memory. */
double **run_columns_rooms(const run_columns *, size_t rows);
void run_columns_drop(const run_columns *, double **rooms);
/* Puts the values from a walk into row i of the rooms. */
void run_columns_put(const run_columns *, const csv *, const double *values, double *const *rooms, size_t i);

/* ---- run_archive.c ---- */

/* The archive of a run, FILE.h5: its rows, and the states from which it continues. */
typedef struct run_archive run_archive;

/* The name of a note with a time and a number of rows: where a run with adaptive steps ended before it continued to a
 * later end. */
#define RUN_FIRST_END "first_end"

/* The run whose archive is opened. */
typedef struct run_archive_def {
    const options *options;
    const load *model;
    const csv *plan; /* the columns */
    motus_run *run;
    double start, until;
    const walk_observer *rows; /* their stride or period */
    const char *from;          /* the archive that the run continues, which may be the output; NULL: the run begins */
} run_archive_def;

/* Opens the file of --output, and moves the run to the latest state in it, with --resume, or in `from`. The file is
 * made, or grows, so that it has room for the rows up to the end. Call run_archive_close() in any case. */
motus_status run_archive_open(run_archive **, const run_archive_def *, motus_error *);
/* Sets what takes the rows and what saves states. */
void run_archive_observe(run_archive *, walk_observer *, walk_keeper *);
/* Writes the last rows and the last state at the end of the run, and makes the file exactly as large as they need. */
motus_status run_archive_finish(run_archive *, motus_error *);
int64_t run_archive_rows(const run_archive *);
/* Replaces the finished file by a compressed one. */
motus_status run_archive_compress(run_archive *, motus_error *);
/* Prints, after a failure, what the file has, or removes a new file that no run could continue. `whole` says whether
 * the run has reached its end. */
void run_archive_leave(run_archive *, bool whole);
void run_archive_close(run_archive *);

#endif
