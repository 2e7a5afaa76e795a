/* The file of one shard of a sweep, as it is merged. */
#ifndef CLI_SWEEP_PART_H
#define CLI_SWEEP_PART_H

#include "cli/files/file.h"
#include "cli/files/shard.h"
#include "cli/files/stop.h"

typedef enum part_kind { PART_ROWS, PART_EVENTS, PART_NPY, PART_ARCHIVE } part_kind; /* CSV, CSV, .npy, .h5 */

typedef struct part {
    const char *path;
    part_kind kind;
    shard shard;
    uint64_t total; /* trajectories of the whole sweep */
    size_t width;   /* bytes of a row of a .npy */
    /* that of the whole sweep: the lines above the rows, or the .json beside a .npy; of an archive what its shards have
     * in common */
    char *head;
    const char *its;  /* in it: what the heads of all shards of a sweep have in common, to its end */
    uint64_t at;      /* where the first row begins that has not been copied */
    uint64_t checked; /* up to where its bytes have their checks; UINT64_MAX: there are none */
    bool broken;      /* those behind do not have them */
} part;

/* Reads the head. MOTUS_STATE: this is no shard; call part_close() in any case. */
motus_status part_open(part *, const char *path, motus_error *);
/* Copies the rows of a block of the sweep, but not of an archive, to a file, block after block in their order;
 * MOTUS_STATE: they are not all there. */
motus_status part_copy(part *, uint64_t block, file_out *, motus_error *);
/* MOTUS_STATE: the file does not end behind its last block. */
motus_status part_end(part *, motus_error *);
void part_close(part *);

/* The error: its last trajectories are missing. */
motus_status part_unfinished(const part *, motus_error *);

/* part_archive.c: makes the archive of the whole sweep, where of[k] is shard k + 1. *missing is how many blocks no part
 * has; NULL: that is an error, and no part is NULL. */
motus_status part_archive_join(part *const *of, const char *output, uint64_t *missing, bool compress, stop_progress *,
                               motus_error *);

#endif
