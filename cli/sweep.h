/* motus sweep: what its files share. */
#ifndef CLI_SWEEP_H
#define CLI_SWEEP_H

#include "cli/grid.h"
#include "cli/load.h"

/* What is recorded of each trajectory. */
typedef struct sweep_records {
    motus_record *items;
    size_t count;
} sweep_records;

enum { SWEEP_NAME = MOTUS_NAME_MAX + 64 + 16 }; /* room for "time_of_max(…)" */
motus_status sweep_records_read(sweep_records *, const load *, const char *list, motus_error *);
void sweep_record_name(const load *, const motus_record *, char out[SWEEP_NAME]);

typedef struct sweep {
    const options *options;
    load model;
    grid grid;
    sweep_records records;
    const char *method;
    double step, until;
    int64_t every; /* steps between two looks */
    motus_ensemble *ensemble;
    size_t columns; /* of a row: number, varied, recorded, stopped */
    char *head;     /* the lines above the rows of a CSV; of a .npy, the text of the file beside it */
    size_t head_length;
    char fingerprint[17]; /* of everything that decides the numbers */
} sweep;

/* What is written above the rows: it depends on the request, not on how or where it is done, so that files can be
 * compared. */
motus_status sweep_head_make(sweep *, bool npy, motus_error *);

/* The file of rows. */
typedef struct sweep_file {
    const sweep *sweep;
    const char *path; /* "-": standard output */
    int descriptor;
    bool npy, regular;
    uint64_t rows, bytes; /* whole rows that are there; where they end */
    uint64_t stopped;     /* of these */
    uint64_t found;       /* rows that were there before this began */
    char *buffer;
    size_t used, room;
} sweep_file;

motus_status sweep_file_check(const options *, motus_error *);
motus_status sweep_file_open(sweep_file *, const sweep *, motus_error *);
/* `count` more rows: values[axis][i], results[record][i]. After a failure the rows written whole are still there. */
motus_status sweep_file_rows(sweep_file *, size_t count, double *const *values, double *const *results,
                             const double *stopped, motus_error *);
/* Everything on the disk. */
motus_status sweep_file_finish(sweep_file *, motus_error *);
void sweep_file_close(sweep_file *);

/* Finding the rows that an earlier sweep left: sets rows, bytes, stopped. `end`: the file's length. */
motus_status sweep_resume(sweep_file *, uint64_t end, motus_error *);
/* The 128 bytes at the beginning of a .npy of so many rows. */
enum { SWEEP_NPY_HEAD = 128 };
void sweep_npy_head(const sweep *, uint64_t rows, char out[SWEEP_NPY_HEAD]);

#endif
