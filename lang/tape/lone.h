/* One output of a program, in one of its cells, evaluated alone: with the bits that the tape of all outputs computes,
 * and in the time that this one takes. */
#ifndef LANG_TAPE_LONE_H
#define LANG_TAPE_LONE_H

#include "lang/tape/tape.h"

typedef struct lone lone;

/* *out NULL: an output has sums, which a tape alone computes. False: the arena failed. */
bool lone_create(arena *, graph *, const output *, size_t count, lone **out);
/* At these indices of its loops; no number where it has no cell there. */
double lone_run(lone *, size_t output, const int64_t *index, const binding *, double t, double *const base[SPACES]);

#endif
