/* A row: one method, whole. Its card is what people see, its coefficients are what the texts of step/ run.
 *
 * Invariant: a row is constant and complete; nothing about a method is decided anywhere else. What follows from the
 * row and a step (times of kicks, h b_i) is computed once by step/work.h. An includer may define `coef` and K(x)
 * first: the same rows then have coefficients of 33 digits, which is how the laws see order 8 far above round-off.
 */
#ifndef CORE_ROWS_H
#define CORE_ROWS_H

#include "core/methods.h"

#ifndef K
typedef double coef;
#define K(x) x
#endif

#include "step/families.def"
#define ROW_CARD motus_method card;
#include "step/row.h"

extern const row methods_table[];
extern const size_t methods_count;
/* newmark with gamma other than 1/2: order 1, not reversible; not in the catalogue */
extern const row methods_newmark_damped;

#endif
