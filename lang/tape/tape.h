/* A program as a tape: the interpreter's code. It works on blocks of W values along the innermost loop; W is chosen
 * so that the registers of one block fit the L1 cache. Kernels exist per instruction set and are chosen once.
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
/* Takes the run-time numbers, computes block width, scratch memory (from the arena) and everything that depends on
 * parameters alone. May be called again after parameters change. False: no memory. */
bool tape_bind(tape *, const binding *);
/* Runs: base[s] is the start of space s (SPACE_POOL is taken from the binding). */
void tape_run(tape *, double t, double *const base[SPACES]);

#endif
