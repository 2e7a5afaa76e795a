/* motus sweep: what its source files share. */
#ifndef CLI_SWEEP_SWEEP_H
#define CLI_SWEEP_SWEEP_H

#include "cli/files/archived.h"
#include "cli/files/checks.h"
#include "cli/files/file.h"
#include "cli/files/shard.h"
#include "cli/files/stop.h"
#include "cli/files/target.h"
#include "cli/model/grid.h"
#include "cli/model/load.h"

#include <inttypes.h>

/* What is recorded of each trajectory. Behind the `count` items come SWEEP_JUDGED more, which judge an accuracy. */
typedef struct sweep_records {
    motus_record *items;
    size_t count;
    bool ended; /* the event that ended the trajectory is recorded too */
} sweep_records;
enum { SWEEP_REACHED, SWEEP_TOLERANCE, SWEEP_JUDGED };

enum { SWEEP_NAME = MOTUS_NAME_MAX + 64 + 32 }; /* room for "time_of_max(…)" and ".error" */
motus_status sweep_records_read(sweep_records *, const load *, const char *list, motus_error *);
void sweep_record_name(const load *, const motus_record *, char out[SWEEP_NAME]);
/* Returns whether a record has an error: a number of steps and the time have none. */
bool sweep_record_errs(const motus_record *);

typedef struct sweep {
    const options *options;
    load model;
    grid grid;
    shard shard;   /* the trajectories that this command computes, and the size of their blocks */
    uint64_t rows; /* the trajectories of the shard: the rows of the complete file */
    uint64_t
        block; /* the size of the blocks in an archive that is continued or verified; 0: sweep_block.c chooses it */
    sweep_records records;
    const char *method;
    double step, until; /* step NaN: the steps are adaptive; until NaN: each trajectory has its own end */
    double tolerance;   /* NaN: the steps are fixed */
    double accuracy;    /* of every trajectory, which then has a tolerance of its own; NaN: none is wanted */
    int absolute;
    int64_t every; /* steps between two samples for min, max and mean */
    motus_ensemble *ensemble;
    bool noted; /* the note why no faster machine runs the sweep was printed */
    /* The columns of a row: the number of the trajectory, varied numbers, records; with --errors, the errors of the
     * records that have one, and whether any digit is significant; `ended`, if it is recorded; stopped, stopped_by. */
    size_t columns;
    /* The columns of the table of events, and after them those that the picture of a section needs. */
    size_t *event_columns, event_columns_count, event_columns_more;
    bool errors;
    char *head; /* the lines above the rows of a CSV; of a .npy, the text of the file beside it */
    size_t head_length;
    char fingerprint[17]; /* sweep_head_fingerprint() of this version */
} sweep;

typedef struct sweep_section sweep_section;
/* Reads the model and makes the ensemble; the caller has set `options` and `shard`. Touches no file of results. Call
 * sweep_free() in any case. */
motus_status sweep_begin(sweep *, sweep_section *, stop_progress *, motus_error *);
void sweep_free(sweep *);
/* Returns the column `ended` of a row; SIZE_MAX: it is not recorded. */
static inline size_t sweep_ended(const sweep *s) { return s->records.ended ? s->columns - 3 : SIZE_MAX; }
/* Returns how many records the ensemble keeps (sweep_record.c). They include those that judge an accuracy, if there is
 * one, or if nothing else is recorded. */
size_t sweep_kept(const sweep *);
/* Returns the number by which a .npy names the event that ended a trajectory; 0 for "", no event; -1 if the model
 * has no event of this name. */
int sweep_event_number(const sweep *, const char *name);
/* Rows: values[axis][i], results[record][i], errors[record][i] (NULL without --errors), stopped[i]. */
typedef struct sweep_rows {
    double *const *values, *const *results, *const *errors;
    const double *stopped;
} sweep_rows;
/* Writes the values of `count` rows, except their first column, the number of the trajectory. What a trajectory that
 * stopped does not have is NaN. The columns of `out` are `next_column` apart, and its rows `next_row`. */
void sweep_row_numbers(const sweep *, const sweep_rows *, size_t from, size_t count, double *out, size_t next_row,
                       size_t next_column);
/* Returns whether a number of trajectory i has no significant digit. */
bool sweep_row_lost(const sweep *, const sweep_rows *, size_t i);

/* Returns the word of --switches for this sweep; NULL: the force has no switches, or fixed steps cross them, as they do
 * by default. */
const char *sweep_switches(const sweep *);

/* sweep_head.c: the head of the file. */

/* Writes the line of the command that makes the rows, "# motus sweep …\n". */
motus_status sweep_head_command(const sweep *, file_out *, motus_error *);
/* Writes that command alone. The caller frees *text, also after a failure. */
motus_status sweep_head_text(const sweep *, char **text, motus_error *);
/* Returns the name of a column, which may be in `out`. */
const char *sweep_head_name(const sweep *, size_t column, char out[SWEEP_NAME]);
enum { SWEEP_IDENTITY = 240 };
/* Writes the second line of a CSV: the version, "`what`trajectories" and their number, the fingerprint, and the shard
 * unless it is the whole sweep. Returns out. */
const char *sweep_head_identity(const sweep *, const char *what, char out[SWEEP_IDENTITY]);
enum { SWEEP_FINGERPRINT = 17 };
/* Writes the hash of everything that the numbers depend on, as a version of motus makes it. Returns out. */
const char *sweep_head_fingerprint(const sweep *, const char *version, char out[SWEEP_FINGERPRINT]);
/* Makes the head. It depends on the request alone, not on machine or threads, so that files can be compared. */
motus_status sweep_head_make(sweep *, bool npy, motus_error *);
enum { SWEEP_NPY_HEAD = 128 };
/* Writes the bytes at the beginning of a .npy. */
void sweep_npy_head(uint64_t rows, size_t columns, char out[SWEEP_NPY_HEAD]);

/* Chooses how many trajectories a block has, a power of two up to SHARD_BLOCK (sweep_block.c). */
motus_status sweep_block_choose(const sweep *, uint64_t *block, motus_error *);

/* Trajectories of a sweep that one call computes, and the memory for them (sweep_batch.c). */
typedef struct sweep_batch {
    size_t most, count, lanes; /* trajectories: room for them; those that take BATCH_MS; those that advance at once */
    double **values, **results, **errors, *stopped, *room; /* errors: NULL without --errors */
    double **shifted;                                      /* `values`, from a trajectory of the batch on */
} sweep_batch;

/* Returns how many trajectories advance at once, in the lanes of all threads. They may become more when a compiler has
 * ended. */
size_t sweep_batch_lanes(const sweep *);
/* Call sweep_batch_free() in any case. */
motus_status sweep_batch_make(sweep_batch *, const sweep *, motus_error *);
void sweep_batch_free(sweep_batch *);
/* Computes the trajectories of `count` rows from `row` on, at most batch.most. Adds the seconds of the integration to
 * *computing, which may be NULL. MOTUS_ACCURACY: a trajectory does not reach its accuracy. */
motus_status sweep_batch_compute(sweep_batch *, const sweep *, uint64_t row, size_t count, double *computing,
                                 motus_error *);
/* Returns the rows that were computed last. */
sweep_rows sweep_batch_rows(const sweep_batch *);
/* Changes `count`, a multiple of the lanes, after a batch that took `seconds`, so that a batch takes BATCH_MS. */
void sweep_batch_adapt(sweep_batch *, const sweep *, double seconds);
/* Returns the bytes of its memory. */
size_t sweep_batch_bytes(const sweep_batch *, const sweep *);

/* The share of one process in the work of a team, for --json. */
typedef struct sweep_share {
    uint64_t blocks, rows;
    double computing, waiting, writing; /* seconds */
} sweep_share;

/* The file of rows. */
typedef struct sweep_archive sweep_archive;
typedef struct sweep_file {
    const sweep *sweep;
    const char *path; /* "-": standard output */
    int descriptor;
    bool npy, regular;
    sweep_archive *archive;      /* NULL: the file is not an archive */
    struct sweep_events *events; /* written before the rows of their trajectories */
    uint64_t rows, bytes;        /* the complete rows, and where they end; in an archive, `rows` is the next row */
    uint64_t lost;               /* trajectories without a significant digit at their end */
    uint64_t stopped;            /* trajectories that stopped */
    uint64_t stopped_by[MOTUS_CAUSE_COUNT]; /* trajectories that stopped by each cause */
    uint64_t found;                         /* rows that an earlier command has written */
    sweep_share share;                      /* of this process, in an archive */
    checks checks;                          /* of a CSV or .npy */
    char *buffer;
    double *numbers; /* memory for the numbers of a row */
    size_t used, room;
} sweep_file;

motus_status sweep_file_check(const options *, motus_error *);
motus_status sweep_file_open(sweep_file *, const sweep *, motus_error *);
/* Adds `count` rows. After a failure the file keeps its complete rows. */
motus_status sweep_file_rows(sweep_file *, size_t count, const sweep_rows *, motus_error *);
/* Returns how many rows from f->rows on are missing, up to the next one that the file has, or to the end. */
uint64_t sweep_file_left(const sweep_file *);
/* Returns how many rows the file has; waits for all processes. */
uint64_t sweep_file_have(const sweep_file *);
double sweep_file_done(const sweep_file *); /* returns how many rows are done, as far as this process knows */
/* Writes everything to the disk. */
motus_status sweep_file_finish(sweep_file *, motus_error *);
void sweep_file_close(sweep_file *);

/* sweep_archive.c: the file of rows as an archive, whose blocks may be written in any order. */

/* Returns the rows in a block of the archive that is continued; 0: none is. */
uint64_t sweep_archive_block(const options *);
/* Opens the archive, or makes it unless it was `found`; its whole blocks are kept. Call sweep_archive_close() in any
 * case. */
motus_status sweep_archive_open(sweep_file *, bool found, motus_error *);
/* Shares the missing blocks among all processes, when each has opened the file; waits for all. */
void sweep_archive_begin(sweep_file *);
uint64_t sweep_archive_left(const sweep_file *);
uint64_t sweep_archive_have(const sweep_file *); /* waits for all processes */
double sweep_archive_done(const sweep_file *);
/* Tells all processes to compute no more blocks. */
void sweep_archive_give_up(sweep_file *);
bool sweep_archive_given_up(const sweep_file *); /* returns whether a process has given up */
/* Fails if blocks that processes have written are not in the file. */
motus_status sweep_archive_look(sweep_file *, motus_error *);
motus_status sweep_archive_rows(sweep_file *, size_t count, const sweep_rows *, motus_error *);
motus_status sweep_archive_finish(sweep_file *, motus_error *);
/* Replaces the finished file by a compressed one. */
motus_status sweep_archive_compress(sweep_file *, motus_error *);
void sweep_archive_close(sweep_file *);

/* Returns the shares of all processes by their ranks; waits for all. The caller frees them. NULL: no memory. */
sweep_share *sweep_report_gather(const team *, const sweep_share *mine);
/* Prints what was computed in `wall` seconds. `all` has the shares of a team; NULL: there is none. */
void sweep_report(const sweep *, const sweep_file *, double wall, const sweep_share *all);

/* sweep_again.c: computes rows of an archive again. */

typedef struct sweep_again sweep_again;
motus_status sweep_again_make(sweep_again **, const sweep *, motus_error *); /* call sweep_again_free() in any case */
void sweep_again_free(sweep_again *);
enum { SWEEP_WHERE = 256 };
/* Computes rows of an archive and compares their bytes. If they are not the `same`, `where` says in which trajectory
 * and which number. */
motus_status sweep_again_rows(sweep_again *, motus_archive *, uint64_t row, size_t count, bool *same,
                              char where[SWEEP_WHERE], motus_error *);

/* Prints what the sweep would take, from a sample that it computes (sweep_plan.c). Touches no file. */
motus_status sweep_plan(const sweep *, stop_progress *, motus_error *);

/* Finds the rows of an interrupted sweep that match their checks: sets rows, bytes, stopped, stopped_by. `end` is the
 * length of the file. */
motus_status sweep_resume(sweep_file *, uint64_t end, motus_error *);

/* sweep_events.c: the table of the events of all trajectories, with their numbers. Beside an archive, whose blocks are
 * computed in any order, the table is joined from segments at the end (segments.h).
 *
 * Invariant: the events of a trajectory are written before its row. */

/* The line after the events, with the number of trajectories whose events are above it. */
#define SWEEP_EVENTS_WORDS "# end of the events of trajectories: "
#define SWEEP_EVENTS_END SWEEP_EVENTS_WORDS "%" PRIu64 "\n"
enum { SWEEP_EVENTS_LAST = sizeof SWEEP_EVENTS_END + 20 };
struct segments;
typedef struct sweep_events {
    const sweep *sweep;
    const char *path; /* NULL: no table is wanted */
    int descriptor;
    bool regular;
    uint64_t bytes; /* where the complete rows end */
    double *values; /* memory for the values of a row */
    char *head;     /* the lines above the rows */
    size_t head_length;
    struct segments *segments; /* NULL: the events are written in their order */
    bool complete;             /* the table was found with all events */
    checks checks;
} sweep_events;
motus_status sweep_events_check(const options *, motus_error *);
/* Returns whether the table is a file beside an archive. */
bool sweep_events_in_segments(const options *);
/* Checks, before any file is touched, that the table that --resume would continue is that of this sweep. Call
 * sweep_events_close() in any case. */
motus_status sweep_events_begin(sweep_events *, const sweep *, motus_error *);
/* Finds the events beside an archive. */
motus_status sweep_events_find(sweep_events *, motus_error *);
/* Returns whether the events of a block were found. */
bool sweep_events_have(const sweep_events *, uint64_t block);
/* Opens the table; the file of rows already has the first `rows` rows. */
motus_status sweep_events_open(sweep_events *, uint64_t rows, motus_error *);
/* Adds the events of the last batch, whose first trajectory has the row `first`. */
motus_status sweep_events_rows(sweep_events *, uint64_t first, size_t count, motus_error *);
motus_status sweep_events_finish(sweep_events *, motus_error *);
/* Joins the table from segments. Call it when all processes have finished. */
motus_status sweep_events_join(sweep_events *, stop_progress *, motus_error *);
void sweep_events_close(sweep_events *);

/* sweep_curves.c: the picture of what is recorded. */
typedef struct sweep_curves {
    const sweep *sweep;
    size_t axis, second;    /* the numbers that vary on the axes; second grid.count: there is one alone */
    size_t shown[6], count; /* records */
    bool random;
    double *numbers; /* both values, the records and their errors, for each row */
    size_t width, rows, room;
} sweep_curves;
motus_status sweep_curves_plan(sweep_curves *, const sweep *, motus_error *);
motus_status sweep_curves_take(sweep_curves *, uint64_t first, size_t count, const sweep_rows *, motus_error *);
motus_status sweep_curves_draw(sweep_curves *, file_out *, motus_error *);
void sweep_curves_close(sweep_curves *);

/* sweep_section.c: the picture of the points of --section, or else that of sweep_curves.c. Without --plot, each call
 * does nothing. */
struct sweep_section {
    const sweep *sweep;
    bool varied[2];         /* whether x and y of the picture are varied numbers */
    size_t axis[2];         /* axes of the grid, if they are varied */
    size_t of[2], place[2]; /* else columns, and their places among the event columns */
    double *values;         /* memory for the values of an event */
    double *points;         /* x, y and the number that gives the colour, for each point */
    size_t count, room;
    sweep_curves curves; /* without --section */
    file_out file;
};

motus_status sweep_section_check(const options *, motus_error *);
/* Chooses the plane, and adds its columns to the event columns. */
motus_status sweep_section_plan(sweep_section *, sweep *, motus_error *);
motus_status sweep_section_open(sweep_section *, motus_error *);
/* Takes the points of the last batch, whose first trajectory has the row `first`. */
motus_status sweep_section_take(sweep_section *, uint64_t first, size_t count, const sweep_rows *, motus_error *);
motus_status sweep_section_draw(sweep_section *, motus_error *);
void sweep_section_close(sweep_section *);

#endif
