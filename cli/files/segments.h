/* A table whose blocks are computed in any order, by one process or several: the events of a sweep into an archive.
 *
 * Each process appends the blocks that it computes to a file of its own, a segment, in the folder TABLE.segments; when
 * all blocks are there, one process joins them, in their order, to the table, and removes the folder. In a segment a
 * line behind each block has its number, its length and a hash of its bytes: what a killed process was writing lacks
 * that line and is passed over, and its block is computed again.
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

/* Whether segments of this table are there: a sweep was interrupted. */
bool segments_there(const char *table);

/* `head`: the lines above the rows, which every segment begins with; `same` tells whether those of a segment found are
 * of the same sweep; `first`: the number that this process tries to give to its segment. Touches no file. Call
 * segments_free() in any case. */
motus_status segments_make(segments **, const char *table, const char *head,
                           bool (*same)(const char *ours, const char *theirs), uint64_t blocks, size_t first,
                           motus_error *);
void segments_free(segments *);

/* Reads all segments: segments_have() then tells which blocks are there, whole. MOTUS_STATE: one is of another
 * sweep. */
motus_status segments_find(segments *, motus_error *);
bool segments_have(const segments *, uint64_t block);
/* Removes the segments and their folder. */
motus_status segments_remove(const segments *, motus_error *);

/* Appends rows of the block that is being computed; and: it is whole. */
motus_status segments_put(segments *, const char *rows, size_t length, motus_error *);
motus_status segments_end_block(segments *, uint64_t block, motus_error *);
/* What this process has written is on the disk. */
motus_status segments_finish(segments *, motus_error *);

/* When all processes have finished: writes the table, with `last` behind its rows, and removes the segments. */
motus_status segments_join(segments *, const char *last, stop_progress *, motus_error *);

#endif
