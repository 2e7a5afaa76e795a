/* A program as a tape, the code of the interpreter. It computes W values along the innermost loop at a time, with W
 * chosen so that the registers fit the L1 cache. Kernels exist for several instruction sets, of which one is chosen at
 * the start.
 */
#ifndef LANG_TAPE_TAPE_H
#define LANG_TAPE_TAPE_H

#include "lang/graph/graph.h"

typedef struct tape tape;

typedef struct binding { /* the numbers at run time, which must outlive the use of the tape */
    const array *arrays;
    const int64_t *ints;
    const double *pool;
} binding;

tape *tape_create(arena *, const program *); /* NULL: the arena failed */
/* Makes a tape from outputs, without a program of the caller; keeps a program of its own only if tape_bind may need
 * it. */
tape *tape_of(arena *, graph *, const output *, size_t count);
/* Takes the numbers at run time, chooses the width, takes scratch memory from the arena, and computes everything that
 * depends on parameters alone. Call it again after parameters have changed. False: no memory. */
bool tape_bind(tape *, const binding *);
/* Runs the tape; base[s] is the start of space s (the binding has that of SPACE_POOL). */
void tape_run(tape *, double t, double *const base[SPACES]);

#endif
