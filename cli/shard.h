/* Which trajectories of a sweep one command computes.
 *
 * A sweep is cut into blocks of SHARD_BLOCK trajectories by their number alone. Shard K of N has every Nth block from
 * block K on, so that work which grows along an axis is shared evenly. The rows of its file are its trajectories in
 * their order. A whole sweep is shard 1 of 1.
 */
#ifndef CLI_SHARD_H
#define CLI_SHARD_H

#include "motus.h"

#include <stdbool.h>
#include <stdint.h>

enum { SHARD_BLOCK = 4096, SHARD_MOST = 1000000, SHARD_TEXT = 16 };

typedef struct shard {
    uint64_t number, count; /* 1 <= number <= count */
} shard;

/* Reads "3/100" at the beginning of a text; returns its length, 0: there is none. */
size_t shard_parse(shard *, const char *text);
/* "3/100", "slurm" (the task of a Slurm array), or NULL: the whole sweep. */
motus_status shard_read(shard *, const char *text, motus_error *);
bool shard_whole(const shard *);
/* "3/100". Returns out. */
const char *shard_text(const shard *, char out[SHARD_TEXT]);
/* How many of `total` trajectories it has. */
uint64_t shard_rows(const shard *, uint64_t total);
/* The blocks that so many rows are. */
static inline uint64_t shard_blocks(uint64_t rows) { return rows / SHARD_BLOCK + (rows % SHARD_BLOCK > 0); }
/* The number of the trajectory of a row, both from 0. */
uint64_t shard_trajectory(const shard *, uint64_t row);
/* How many rows from `row` on are trajectories of consecutive numbers. */
uint64_t shard_run(const shard *, uint64_t row);
/* The name of a file of this shard: `%K` becomes its number. A whole sweep leaves the name as it is. NULL: no memory;
 * else to be freed. */
char *shard_file(const shard *, const char *name);

#endif
