/* The hull of a state: the smallest box of indices that contains its equations and boundary lines. */
#ifndef LANG_LOWER_HULL_H
#define LANG_LOWER_HULL_H

#include "lang/model/model.h"

/* Fills in the hull, `owner` and `cells` of a state, once; `progress` is 1 meanwhile and 2 afterwards. */
bool hull_find(model *, model_state *);
/* Raises the cells [first, last] of a map over the hull to `as`; with `once`, complains where a cell is marked
 * already. */
bool hull_mark(model *, const model_state *, const statement *, const int64_t first[], const int64_t last[],
               uint8_t *map, uint8_t as, bool once);
/* Complains that a line does not have as many indices as its state. Returns false. */
bool hull_indices_wrong(model *, const model_state *, span at);

#endif
