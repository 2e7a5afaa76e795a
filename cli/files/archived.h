/* What archives of sweeps and of runs have in common: their notes and columns, and memory for one of their blocks. */
#ifndef CLI_FILES_ARCHIVED_H
#define CLI_FILES_ARCHIVED_H

#include "motus.h"

#include <stdbool.h>

typedef struct motus_archive motus_archive;
/* Returns whether an archive is that of a sweep, by its columns: they have one number or word in each row, and the last
 * two are `stopped` and `stopped_by`. */
bool archived_sweep(const motus_archive *);
/* Returns whether a note of the archive is `text`, or, if `text` is NULL, whether there is no such note. */
bool archived_says(const motus_archive *, const char *name, const char *text);
/* Returns a note of the archive, or "" if there is none. */
const char *archived_note(const motus_archive *, const char *name);
/* Checks that the rows of a block have the numbers of its trajectories, or of a run's rows. */
motus_status archived_numbers(motus_archive *, const char *path, uint64_t block, motus_error *);
/* Makes the error for an archive of another sweep or run (`what`), with the command that made it. */
motus_status archived_another(motus_archive *, const char *path, const char *what, motus_error *);
/* Reports on a file that another version began, after some of its rows were computed again: a note if they have the
 * same bits (`where` is NULL), or else an error. `compared` is false if the file has no rows to compare. */
motus_status archived_compared(const char *path, const char *version, bool compared, const char *where, bool quiet,
                               motus_error *);

/* Memory for the columns of one block. */
typedef struct block_room {
    double **columns;     /* bytes in columns of words */
    const void **written; /* `columns`, in the type that motus_archive_write() takes */
    size_t count;
} block_room;

/* Takes memory for `count` columns of `rows` numbers. Call block_room_free() also after a failure. */
motus_status block_room_make(block_room *, size_t count, size_t rows, motus_error *);
void block_room_free(block_room *);

#endif
