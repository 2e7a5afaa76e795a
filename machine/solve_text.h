/* Linear systems of lanes as C text: the order and structure that core/solver.c finds when a run begins are found here
 * when the text is written. */
#ifndef MACHINE_SOLVE_TEXT_H
#define MACHINE_SOLVE_TEXT_H

#include "machine/compose.h"

enum {
    SOLVE_TEXT_MAX = 12,                      /* most unknowns of all stages: the text has every entry of the matrix */
    SOLVE_OPERATIONS_MAX = OPERATIONS_MAX / 8 /* most operations of the graph: a derivative is several times as long */
};

/* Tells whether the linear systems of a row, if it has any, can be a text. */
bool solve_text_admits(const model *, const problem *, const chosen *);
struct work; /* step/work.h */
/* Tells whether a step solves one equation, so that its matrix is the same in all steps if derivatives are constant. At
 * most one stage stands outside this equation, such as the end of Newmark's step or the other half of a kick. */
bool solve_text_single(const struct work *plan);
/* Makes the programs of da along dx and along dv that the row needs; returns how many: 0, 1 or 2. */
size_t solve_text_programs(model *, const problem *, const chosen *, composed_program programs[2]);
/* Writes structure, derivatives and matrix; the text machine/text/solve.h follows. False: no memory. */
bool solve_text_write(emit_text *, const composition *);

#endif
