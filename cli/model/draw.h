/* Counter-based random numbers: each is a function of the seed, the stream (one for each --random) and the number of
 * the trajectory. */
#ifndef CLI_MODEL_DRAW_H
#define CLI_MODEL_DRAW_H

#include <stdint.h>

/* Computes four random words from a counter and a key: Philox4x32-10 [Salmon11]. */
void draw_philox(const uint32_t counter[4], const uint32_t key[2], uint32_t out[4]);

/* Returns a number in [0, 1), a multiple of 2^-53. */
double draw_uniform(uint64_t seed, uint32_t stream, uint64_t index);
/* Returns a number from the normal distribution with mean 0 and standard deviation 1. */
double draw_normal(uint64_t seed, uint32_t stream, uint64_t index);

#endif
