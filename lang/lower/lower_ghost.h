/* Ghost cells: boundary cells whose line depends on a state. */
#ifndef LANG_LOWER_LOWER_GHOST_H
#define LANG_LOWER_LOWER_GHOST_H

#include "lang/lower/lower.h"

/* Returns whether the right side of a boundary line reads a state, itself or by a quantity or function. */
bool lower_is_ghost(model *, const statement *);
bool lower_add_ghost(model *, model_state *, const statement *, const int64_t first[], const int64_t last[]);
/* Returns whether the cells [low, high] that r reads are, or contain, ghost cells. *out is then what replaces them, or
 * nothing yet if it asked for a cut or complained. */
bool lower_ghost(lowering *, const tree *, const model_state *, const reference *r, const int64_t low[],
                 const int64_t high[], value *out);

/* Asks for a cut at the first border of the cells [first, last] that [low, high], which r reads, crosses. */
void lower_ask_cut(lowering *, const tree *, int dims, const int64_t first[], const int64_t last[], const reference *r,
                   const int64_t low[], const int64_t high[]);
/* Takes a cut that was asked for in one of the levels first, first + 1, … What was lowered is then void: the range of
 * out->level is to be divided before the index out->at, and each part lowered. */
bool lower_cut(model *, int first, int count, model_cut *out);
/* Restricts a level of a left side that lower_target has read. */
void lower_narrow(lowering *, output *, int level, int64_t low, int64_t high);

/* Complains if a right side has not the shape of its state. */
bool lower_fits(model *, const statement *, const model_state *, value, const char *what);

#endif
