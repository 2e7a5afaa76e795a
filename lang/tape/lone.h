/* One output of a program, in one of its cells, evaluated alone: with the bits that a tape of all outputs computes. */
#ifndef LANG_TAPE_LONE_H
#define LANG_TAPE_LONE_H

#include "lang/tape/tape.h"

typedef struct lone lone;

/* Makes the evaluator; *out NULL: an output has sums, which only a tape computes. False: the arena failed. */
bool lone_create(arena *, graph *, const output *, size_t count, lone **out);
/* Evaluates an output at these indices of its loops; NaN: it has no cell there. */
double lone_run(lone *, size_t output, const int64_t *index, const binding *, double t, double *const base[SPACES]);

#endif
