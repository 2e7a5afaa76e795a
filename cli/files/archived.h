/* What archives of sweeps and of runs have in common: what they say of themselves, and room for one of their blocks. */
#ifndef CLI_FILES_ARCHIVED_H
#define CLI_FILES_ARCHIVED_H

#include "motus.h"

#include <stdbool.h>

typedef struct motus_archive motus_archive;
/* Whether the archive is that of a sweep, by its columns: one number or word in a row, at last when and why a
 * trajectory stopped. */
bool archived_sweep(const motus_archive *);
/* Whether a note of the archive is this text; NULL: whether it has no such note. */
bool archived_says(const motus_archive *, const char *name, const char *text);
/* MOTUS_STATE: the numbers of a block's rows are not those of its trajectories, or of a run's rows. */
motus_status archived_numbers(motus_archive *, const char *path, uint64_t block, motus_error *);
/* The error: it is the archive of another sweep or run (`what`), and which command made it. */
motus_status archived_another(motus_archive *, const char *path, const char *what, motus_error *);
/* The error: another version has begun the file of a sweep or a run, and it cannot be continued, by what is said. */
motus_status archived_by_other(const char *path, const char *version, const char *why, motus_error *);

/* Room for the columns of one block. */
typedef struct block_room {
    double **columns;     /* those of words hold bytes */
    const void **written; /* the same, as motus_archive_write takes them */
    size_t count;
} block_room;

/* For `count` columns of `rows` numbers; call block_room_free() also after a failure. */
motus_status block_room_make(block_room *, size_t count, size_t rows, motus_error *);
void block_room_free(block_room *);

#endif
