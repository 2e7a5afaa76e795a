/* Which trajectories of a sweep one command computes.
 *
 * A sweep is cut into blocks of trajectories by their number alone: of SHARD_BLOCK, or of fewer where a trajectory
 * takes much work (sweep_block.c). Shard K of N has every Nth block from block K on, so that work which grows along an
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
    uint64_t block;         /* trajectories of a block */
} shard;

/* Reads "3/100", or with the blocks that it has, at the beginning of a text; returns its length, 0: there is none. */
size_t shard_parse(shard *, const char *text);
/* "3/100", "slurm" (the task of a Slurm array), or NULL: the whole sweep. */
motus_status shard_read(shard *, const char *text, motus_error *);
bool shard_whole(const shard *);
/* "3/100". Returns out. */
const char *shard_text(const shard *, char out[SHARD_TEXT]);
/* The same, and the size of its blocks where it is not SHARD_BLOCK: "3/100 in blocks of 64". Returns out. */
const char *shard_title(const shard *, char out[SHARD_TITLE]);
/* How many of `total` trajectories it has. */
uint64_t shard_rows(const shard *, uint64_t total);
/* The blocks that so many rows are. */
static inline uint64_t shard_blocks(const shard *s, uint64_t rows) { return rows / s->block + (rows % s->block > 0); }
/* The number of the trajectory of a row, both from 0. */
uint64_t shard_trajectory(const shard *, uint64_t row);
/* How many rows from `row` on are trajectories of consecutive numbers. */
uint64_t shard_run(const shard *, uint64_t row);
/* The name of a file of this shard: `%K` becomes its number. A whole sweep leaves the name as it is. NULL: no memory;
 * else to be freed. */
char *shard_file(const shard *, const char *name);

#endif
