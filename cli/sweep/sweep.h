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

/* What is recorded of each trajectory; and behind it SWEEP_JUDGED records, by which an accuracy is judged. */
typedef struct sweep_records {
    motus_record *items;
    size_t count;
    bool ended; /* also which event ended the trajectory */
} sweep_records;
enum { SWEEP_REACHED, SWEEP_TOLERANCE, SWEEP_JUDGED };

enum { SWEEP_NAME = MOTUS_NAME_MAX + 64 + 32 }; /* room for "time_of_max(…)" and ".error" */
motus_status sweep_records_read(sweep_records *, const load *, const char *list, motus_error *);
void sweep_record_name(const load *, const motus_record *, char out[SWEEP_NAME]);
/* Whether it has an error: not a number of steps, nor the time. */
bool sweep_record_errs(const motus_record *);

typedef struct sweep {
    const options *options;
    load model;
    grid grid;
    shard shard;    /* which of the trajectories this command computes, in which blocks, */
    uint64_t rows;  /*   and how many they are: the rows of the complete file */
    uint64_t block; /* of a file that is continued or examined; 0: it follows from the work (sweep_block.c) */
    sweep_records records;
    const char *method;
    double step, until; /* step NaN: it adapts, */
    double tolerance;   /*   by this tolerance; NaN: it does not */
    double accuracy;    /* of every trajectory, which then has a tolerance of its own; NaN: none is asked for */
    int absolute;
    int64_t every; /* steps between two samples for min, max and mean */
    motus_ensemble *ensemble;
    bool noted; /* why no faster machine runs it */
    /* of a row: number, varied, recorded; where errors are told, those of the records that have some, and whether any
     * digit is significant; where it is recorded, ended; stopped, stopped_by */
    size_t columns;
    /* of the table of events, NULL: none is asked for; behind them those that the picture of a section needs */
    size_t *event_columns, event_columns_count, event_columns_more;
    bool errors;
    char *head; /* the lines above the rows of a CSV; of a .npy, the text of the file beside it */
    size_t head_length;
    char fingerprint[17]; /* sweep_head_fingerprint() of this version */
} sweep;

typedef struct sweep_section sweep_section;
/* The sweep of its options, which are set, as is its shard: reads the model, and makes the ensemble. Touches no file of
 * results. Call sweep_free() in any case. */
motus_status sweep_begin(sweep *, sweep_section *, stop_progress *, motus_error *);
void sweep_free(sweep *);
/* Where `ended` is in a row; SIZE_MAX: it is not recorded. */
static inline size_t sweep_ended(const sweep *s) { return s->records.ended ? s->columns - 3 : SIZE_MAX; }
/* sweep_record.c: how many records the ensemble keeps: those that accuracies are judged by too, and where nothing else
 * is recorded. */
size_t sweep_kept(const sweep *);
/* The number in a .npy of the event that ended a trajectory, 0: none; -1: the model has no event of this name. */
int sweep_event_number(const sweep *, const char *name);
/* Rows: values[axis][i], results[record][i], errors[record][i] (NULL: not told), stopped[i]. */
typedef struct sweep_rows {
    double *const *values, *const *results, *const *errors;
    const double *stopped;
} sweep_rows;
/* The numbers of `count` of them, behind the number of the trajectory: NaN in all that one which stopped has not. The
 * next number of a row is `next_column` behind one, that of the next row `next_row`. */
void sweep_row_numbers(const sweep *, const sweep_rows *, size_t from, size_t count, double *out, size_t next_row,
                       size_t next_column);
/* Whether a number of trajectory i has no significant digit. */
bool sweep_row_lost(const sweep *, const sweep_rows *, size_t i);

/* What the steps do at the switches of the force, a word of --switches; NULL: there are none, or steps of one size lead
 * across them, as they do unless told otherwise. */
const char *sweep_switches(const sweep *);

/* sweep_head.c: the line of the command, "# motus sweep …\n", which makes the rows. */
motus_status sweep_head_command(const sweep *, file_out *, motus_error *);
/* The command without the comment sign, to be freed also after a failure. */
motus_status sweep_head_text(const sweep *, char **text, motus_error *);
/* The name of a column of a row. Returns out. */
const char *sweep_head_name(const sweep *, size_t column, char out[SWEEP_NAME]);
/* The second line of a CSV: the version, `what` trajectories and how many, the fingerprint, and the shard where it is
 * not the whole sweep. Returns out. */
enum { SWEEP_IDENTITY = 240 };
const char *sweep_head_identity(const sweep *, const char *what, char out[SWEEP_IDENTITY]);
/* The hash of everything that the numbers depend on, as that version of motus makes it. Returns out. */
enum { SWEEP_FINGERPRINT = 17 };
const char *sweep_head_fingerprint(const sweep *, const char *version, char out[SWEEP_FINGERPRINT]);
/* Makes the head: it depends on the request alone, not on machine or threads, so that files can be compared. */
motus_status sweep_head_make(sweep *, bool npy, motus_error *);
/* The 128 bytes at the beginning of a .npy. */
enum { SWEEP_NPY_HEAD = 128 };
void sweep_npy_head(uint64_t rows, size_t columns, char out[SWEEP_NPY_HEAD]);

/* sweep_block.c: how many trajectories a block has, a power of two up to SHARD_BLOCK. */
motus_status sweep_block_choose(const sweep *, uint64_t *block, motus_error *);

/* sweep_batch.c: trajectories of a sweep that are computed by one call, and the memory for them. */
typedef struct sweep_batch {
    size_t most, count,
        lanes; /* room for how many trajectories; how many take BATCH_MS; lanes of all threads together */
    double **values, **results, **errors, *stopped, *room; /* errors: NULL where none are told */
    double **shifted;                                      /* values, from some trajectory of the batch on */
} sweep_batch;

/* Lanes of all threads together: as many trajectories as advance at once. They may grow, when a compiler has ended. */
size_t sweep_batch_lanes(const sweep *);
/* Call sweep_batch_free() in any case. */
motus_status sweep_batch_make(sweep_batch *, const sweep *, motus_error *);
void sweep_batch_free(sweep_batch *);
/* Computes the `count` trajectories of the rows from `row` on, count <= most. `computing`: seconds of the integration
 * are added to it; NULL: they are not. MOTUS_ACCURACY: one does not reach its accuracy. */
motus_status sweep_batch_compute(sweep_batch *, const sweep *, uint64_t row, size_t count, double *computing,
                                 motus_error *);
/* What the last ones were. */
sweep_rows sweep_batch_rows(const sweep_batch *);
/* After a batch that took `seconds`: changes the count, a multiple of the lanes, towards BATCH_MS for a batch. */
void sweep_batch_adapt(sweep_batch *, const sweep *, double seconds);
/* The bytes of its memory. */
size_t sweep_batch_bytes(const sweep_batch *, const sweep *);

/* How the work of a team was shared, for --json. */
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
    sweep_archive *archive;      /* NULL: it is none */
    struct sweep_events *events; /* whose events are to be there before its rows are */
    uint64_t rows, bytes;        /* complete rows in the file, and where they end; of an archive the next row */
    uint64_t lost;               /* how many of these trajectories have no significant digit at their end, */
    uint64_t stopped;            /*   and how many stopped, */
    uint64_t stopped_by[MOTUS_CAUSE_COUNT]; /*   by which cause */
    uint64_t found;                         /* rows of an earlier, interrupted command; of an archive anywhere in it */
    sweep_share share;                      /* of this process, of an archive */
    checks checks;                          /* of a CSV or .npy */
    char *buffer;
    double *numbers; /* room for those of a row */
    size_t used, room;
} sweep_file;

motus_status sweep_file_check(const options *, motus_error *);
motus_status sweep_file_open(sweep_file *, const sweep *, motus_error *);
/* Adds `count` rows. After a failure the file keeps its complete rows. */
motus_status sweep_file_rows(sweep_file *, size_t count, const sweep_rows *, motus_error *);
/* How many rows from f->rows on are missing, up to the next that is there, or to the end. */
uint64_t sweep_file_left(const sweep_file *);
/* How many rows are there; waits for all. */
uint64_t sweep_file_have(const sweep_file *);
double sweep_file_done(const sweep_file *); /* as far as this process knows */
/* Writes everything to the disk. */
motus_status sweep_file_finish(sweep_file *, motus_error *);
void sweep_file_close(sweep_file *);

/* sweep_archive.c: the file of rows as an archive, whose blocks may be written in any order. */
/* The rows of a block of the archive that is continued; 0: there is none. */
uint64_t sweep_archive_block(const options *);
/* `found`: the file is there, and its blocks that are whole are kept. Call sweep_archive_close() in any case. */
motus_status sweep_archive_open(sweep_file *, bool found, motus_error *);
/* Shares the missing blocks among all, when each has opened the file; waits for all. */
void sweep_archive_begin(sweep_file *);
uint64_t sweep_archive_left(const sweep_file *);
uint64_t sweep_archive_have(const sweep_file *); /* waits for all */
/* How many rows are done, by all, as far as this process knows; and: the others need compute no more. */
double sweep_archive_done(const sweep_file *);
void sweep_archive_give_up(sweep_file *);
bool sweep_archive_given_up(const sweep_file *); /* by any of them */
/* Whether what all have written has come into the file: MOTUS_FILE, it has not. */
motus_status sweep_archive_look(sweep_file *, motus_error *);
motus_status sweep_archive_rows(sweep_file *, size_t count, const sweep_rows *, motus_error *);
motus_status sweep_archive_finish(sweep_file *, motus_error *);
/* Then, where it is asked for: replaces the file by a compressed one. */
motus_status sweep_archive_compress(sweep_file *, motus_error *);
void sweep_archive_close(sweep_file *);

/* sweep_report.c: what every process has done, by their ranks; waits for all. To be freed; NULL: no memory. */
sweep_share *sweep_report_gather(const team *, const sweep_share *mine);
/* Prints what was computed, in a time of `wall` seconds, as the options ask for it; `all`: of a team, else NULL. */
void sweep_report(const sweep *, const sweep_file *, double wall, const sweep_share *all);

/* sweep_again.c: computes rows of an archive once more. */
typedef struct sweep_again sweep_again;
motus_status sweep_again_make(sweep_again **, const sweep *, motus_error *); /* call sweep_again_free() in any case */
void sweep_again_free(sweep_again *);
/* Whether rows of an archive have the bytes that are computed; `where`, where they have not: which trajectory and which
 * number. */
enum { SWEEP_WHERE = 256 };
motus_status sweep_again_rows(sweep_again *, motus_archive *, uint64_t row, size_t count, bool *same,
                              char where[SWEEP_WHERE], motus_error *);

/* sweep_plan.c: tells what the sweep would take, from a sample that it computes. Touches no file. */
motus_status sweep_plan(const sweep *, stop_progress *, motus_error *);

/* Finds the rows of an interrupted sweep that have their checks: sets rows, bytes, stopped, stopped_by. `end`: the
 * file's length. */
motus_status sweep_resume(sweep_file *, uint64_t end, motus_error *);
/* sweep_events.c: the table of the events of all trajectories, with their numbers. Beside an archive, whose blocks are
 * computed in any order, a file is joined from segments at the end (segments.h).
 *
 * Invariant: the events of a trajectory are written before its row is. */
/* Behind the events, with the number of the trajectories whose events they are. */
#define SWEEP_EVENTS_WORDS "# end of the events of trajectories: "
#define SWEEP_EVENTS_END SWEEP_EVENTS_WORDS "%" PRIu64 "\n"
enum { SWEEP_EVENTS_LAST = sizeof SWEEP_EVENTS_END + 20 };
struct segments;
typedef struct sweep_events {
    const sweep *sweep;
    const char *path; /* NULL: none is asked for */
    int descriptor;
    bool regular;
    uint64_t bytes; /* where the complete rows end */
    double *values; /* room for those of a row */
    char *head;     /* the lines above the rows */
    size_t head_length;
    struct segments *segments; /* NULL: the events are written in their order */
    bool complete;             /* the table was found, with all events */
    checks checks;
} sweep_events;
motus_status sweep_events_check(const options *, motus_error *);
/* Whether the table is a file beside an archive. */
bool sweep_events_in_segments(const options *);
/* Before any file is touched: whether what --resume is to continue is the table of this sweep. Call
 * sweep_events_close() in any case. */
motus_status sweep_events_begin(sweep_events *, const sweep *, motus_error *);
/* Finds which events beside an archive are there; then, whether those of a block are. */
motus_status sweep_events_find(sweep_events *, motus_error *);
bool sweep_events_have(const sweep_events *, uint64_t block);
/* `rows`: trajectories whose rows are in the file of rows already. */
motus_status sweep_events_open(sweep_events *, uint64_t rows, motus_error *);
/* Adds those of the last batch, whose first trajectory has the row `first`. */
motus_status sweep_events_rows(sweep_events *, uint64_t first, size_t count, motus_error *);
motus_status sweep_events_finish(sweep_events *, motus_error *);
/* When all processes have finished: makes the table of segments. */
motus_status sweep_events_join(sweep_events *, stop_progress *, motus_error *);
void sweep_events_close(sweep_events *);

/* sweep_section.c: the picture of the points of --section, where --plot asks for it; else each call does nothing. */
struct sweep_section {
    const sweep *sweep;
    bool varied[2]; /* whether x and y of the picture are varied numbers: axis[] of the grid; */
    size_t axis[2];
    size_t of[2], place[2]; /* else columns, and where they are among the event columns */
    double *values;         /* room for those of an event */
    double *points;         /* x, y and the number that gives the colour, of each */
    size_t count, room;
    file_out file;
};

motus_status sweep_section_check(const options *, motus_error *);
/* Chooses the plane, and adds its columns to those of events. */
motus_status sweep_section_plan(sweep_section *, sweep *, motus_error *);
motus_status sweep_section_open(sweep_section *, motus_error *);
/* Adds the points of the last batch, whose first trajectory has the row `first`. */
motus_status sweep_section_take(sweep_section *, uint64_t first, size_t count, double *const *values, motus_error *);
motus_status sweep_section_draw(sweep_section *, motus_error *);
void sweep_section_close(sweep_section *);

#endif
