/* The file of one shard of a sweep, for `motus merge`. */
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
    size_t width;   /* bytes in a row of a .npy */
    /* The head of the whole sweep: the lines above the rows, or the .json beside a .npy; for an archive, what all its
     * shards share. */
    char *head;
    const char *its;  /* the end of `head` that all shards of a sweep share */
    uint64_t at;      /* where the first row begins that has not been copied */
    uint64_t checked; /* its bytes match their checks up to here; UINT64_MAX: it has no checks */
    bool broken;      /* the bytes after `checked` do not match their checks */
} part;

/* Reads the head. Call part_close() in any case. */
motus_status part_open(part *, const char *path, motus_error *);
/* Copies the rows of a block to a file, unless the part is an archive. The blocks come in their order. */
motus_status part_copy(part *, uint64_t block, file_out *, motus_error *);
/* Checks that the file ends after its last block. */
motus_status part_end(part *, motus_error *);
void part_close(part *);

/* Makes the error for a part whose last trajectories are missing. */
motus_status part_unfinished(const part *, motus_error *);

/* Makes the archive of the whole sweep, where of[k] is shard k + 1 or NULL (part_archive.c). *missing becomes the
 * number of blocks that no part has; if `missing` is NULL, a missing block is an error. */
motus_status part_archive_join(part *const *of, const char *output, uint64_t *missing, bool compress, stop_progress *,
                               motus_error *);

#endif
