/* Linear systems of lanes as C text: what core/solver.c finds out when a run begins is found out here when the text
 * is written.
 */
#ifndef MACHINE_SOLVE_TEXT_H
#define MACHINE_SOLVE_TEXT_H

#include "machine/compose.h"

enum {
    SOLVE_TEXT_MAX = 12,                      /* unknowns of all stages: their matrix is in the text, entry by entry */
    SOLVE_OPERATIONS_MAX = OPERATIONS_MAX / 8 /* of the graph: a derivative is some times as long */
};

/* Whether a row's linear systems, if it has any, can be a text. */
bool solve_text_admits(const model *, const problem *, const chosen *);
/* Whether a step solves one equation, so that its matrix is the same in all steps where derivatives are constant: at
 * most one stage stands outside of it, as the end of Newmark's step or the other half of a kick does. */
struct work; /* step/work.h */
bool solve_text_single(const struct work *plan);
/* The programs of da along dx and along dv that the row needs, by these names; returns how many: 0, 1 or 2. */
size_t solve_text_programs(model *, const problem *, const chosen *, composed_program programs[2]);
/* Structure, derivatives and matrix, for machine/text/solve.h, which follows. False: the arena failed. */
bool solve_text_write(emit_text *, const composition *);

#endif
