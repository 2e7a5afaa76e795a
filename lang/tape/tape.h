/* A program as a tape: the interpreter's code. It computes W values along the innermost loop at a time; W is chosen so
 * that the registers fit the L1 cache. There are kernels for each instruction set; one set is chosen at the start.
 */
#ifndef LANG_TAPE_TAPE_H
#define LANG_TAPE_TAPE_H

#include "lang/graph/graph.h"

typedef struct tape tape;

typedef struct binding { /* run-time numbers; the arrays must outlive the tape's use */
    const array *arrays;
    const int64_t *ints;
    const double *pool;
} binding;

tape *tape_create(arena *, const program *); /* NULL: arena failed */
/* The tape of these outputs, for callers that need no program: it is kept only where the tape needs it later. */
tape *tape_of(arena *, graph *, const output *, size_t count);
/* Takes the run-time numbers, chooses the width, takes scratch memory (from the arena), and computes everything that
 * depends on parameters alone. Call it again after parameters have changed. False: no memory. */
bool tape_bind(tape *, const binding *);
/* Runs: base[s] is the start of space s (SPACE_POOL is taken from the binding). */
void tape_run(tape *, double t, double *const base[SPACES]);

#endif
