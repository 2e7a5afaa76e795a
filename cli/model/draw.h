/* Counter-based random numbers: each is a function of the seed, the stream (one for each --random) and the index of
 * the trajectory. */
#ifndef CLI_MODEL_DRAW_H
#define CLI_MODEL_DRAW_H

#include <stdint.h>

/* Philox4x32-10 [Salmon11]: four random words from a counter and a key. */
void draw_philox(const uint32_t counter[4], const uint32_t key[2], uint32_t out[4]);

/* In [0, 1), a multiple of 2^-53. */
double draw_uniform(uint64_t seed, uint32_t stream, uint64_t index);
/* Normal: mean 0, standard deviation 1. */
double draw_normal(uint64_t seed, uint32_t stream, uint64_t index);

#endif
