/* Which trajectories of a sweep one command computes.
 *
 * A sweep is cut into blocks of SHARD_BLOCK trajectories in the order of their numbers, or of fewer if a trajectory
 * takes much work (sweep_block.c). Shard K of N has every Nth block from block K on, so that work that grows along an
 * axis is shared evenly. The rows of its file are its trajectories in their order. A whole sweep is shard 1 of 1.
 */
#ifndef CLI_FILES_SHARD_H
#define CLI_FILES_SHARD_H

#include "motus.h"

#include <stdbool.h>
#include <stdint.h>

enum { SHARD_BLOCK = 4096, SHARD_MOST = 1000000, SHARD_TEXT = 16, SHARD_TITLE = 48 };

typedef struct shard {
    uint64_t number, count; /* 1 <= number <= count */
    uint64_t block;         /* trajectories in a block */
} shard;

/* Reads "3/100" or "3/100 in blocks of 64" at the beginning of a text. Returns its length; 0: it is not there. */
size_t shard_parse(shard *, const char *text);
/* Reads "3/100", "slurm" (the task of a Slurm array), or NULL, the whole sweep. */
motus_status shard_read(shard *, const char *text, motus_error *);
bool shard_whole(const shard *);
/* Writes "3/100". Returns out. */
const char *shard_text(const shard *, char out[SHARD_TEXT]);
/* Writes "3/100", or "3/100 in blocks of 64" if its blocks do not have SHARD_BLOCK trajectories. Returns out. */
const char *shard_title(const shard *, char out[SHARD_TITLE]);
/* Returns how many of `total` trajectories a shard has. */
uint64_t shard_rows(const shard *, uint64_t total);
/* Returns how many blocks `rows` rows fill, the last one perhaps in part. */
static inline uint64_t shard_blocks(const shard *s, uint64_t rows) { return rows / s->block + (rows % s->block > 0); }
/* Returns the number of the trajectory in a row; both count from 0. */
uint64_t shard_trajectory(const shard *, uint64_t row);
/* Returns how many rows from `row` on have trajectories with consecutive numbers. */
uint64_t shard_run(const shard *, uint64_t row);
/* Returns a name with the shard's number for `%K`, or unchanged for a whole sweep. The caller frees it. NULL: no
 * memory. */
char *shard_file(const shard *, const char *name);

#endif
