/* A fingerprint of the bits that this processor computes. */
#ifndef MPI_BITS_H
#define MPI_BITS_H

#include "motus.h"

#include <stdint.h>

/* Computes a hash of the last positions and velocities of 64 chaotic trajectories, in the widest lanes of the
 * processor. Processors with different hashes must not compute one sweep together. */
motus_status bits_compute(uint64_t *hash, motus_error *);

#endif
