/* A row: one method, with its card, which describes it to users, and its coefficients, which the texts of step/ use.
 *
 * Invariant: a row is constant and complete; no other place decides anything about a method. step/plan.h computes once
 * what follows from the row, and work_scale what follows from the step. An includer may define `coef` and K(x) first,
 * for coefficients of 33 digits: with these the laws measure order 8 far above rounding.
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
/* newmark with gamma other than 1/2, of order 1 and not reversible: not in the catalogue */
extern const row methods_newmark_damped;
bool row_has(const row *, family_fact);

#endif
