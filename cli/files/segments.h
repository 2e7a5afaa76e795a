/* A table whose blocks are computed in any order, by one process or several: the events of a sweep into an archive.
 *
 * Each process appends the blocks that it computes to a file of its own, a segment, in the folder TABLE.segments. When
 * all blocks are there, one process joins them in their order to the table, and removes the folder. Behind each block
 * of a segment, a line has the block's number, its length and a hash of its bytes. The block that a killed process was
 * writing lacks that line; it is ignored and computed again.
 *
 * Invariants: the table has its name only when it is complete; its bytes do not depend on processes or segments.
 */
#ifndef CLI_FILES_SEGMENTS_H
#define CLI_FILES_SEGMENTS_H

#include "cli/files/stop.h"
#include "motus.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct segments segments;

/* Returns whether this table has segments, which an interrupted sweep leaves. */
bool segments_there(const char *table);

/* Prepares the segments of a table, without touching a file. Every segment begins with `head`, the lines above the
 * rows; `same` says whether the head of a segment on the disk is of our sweep. This process numbers its segment
 * `first`, or with the next number that is free. Call segments_free() in any case. */
motus_status segments_make(segments **, const char *table, const char *head,
                           bool (*same)(const char *ours, const char *theirs), uint64_t blocks, size_t first,
                           motus_error *);
void segments_free(segments *);

/* Reads all segments. MOTUS_STATE: one is of another sweep. */
motus_status segments_find(segments *, motus_error *);
/* Returns whether segments_find() found a whole block. */
bool segments_have(const segments *, uint64_t block);
/* Removes the segments and their folder. */
motus_status segments_remove(const segments *, motus_error *);

/* Appends rows of the present block. */
motus_status segments_put(segments *, const char *rows, size_t length, motus_error *);
/* Writes the line that says that the present block is whole. */
motus_status segments_end_block(segments *, uint64_t block, motus_error *);
/* Writes to the disk what this process has appended, and closes its segment. */
motus_status segments_finish(segments *, motus_error *);

/* Writes the table, with `last` after its rows, and removes the segments. Call it when all processes have finished. */
motus_status segments_join(segments *, const char *last, stop_progress *, motus_error *);

#endif
