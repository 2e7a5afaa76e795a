/* Lower bounds of the size of formulas on a box of states: what a step of the run keeps within. */
#ifndef MACHINE_LEAST_H
#define MACHINE_LEAST_H

#include "lang/model/model.h"

/* How far the value may be on the box from that at its centre, which SPACE_X and SPACE_V hold; SPACE_DX and SPACE_DV
 * hold the half widths. Infinite of what depends on time or accelerations, in which a box has no width. */
node least_radius(model *, node value);
/* A number that |value| nowhere falls below on the box; not positive: none is known. */
node least_size(model *, node value);
/* That of every function of the model's rules, in their order. NULL: no memory. */
output *least_sizes(model *, size_t *count);
/* Whether these may tell of most steps that nothing has happened: of functions of time none are known, and those of
 * located switches (machine/sides.h) are not among the model's own. */
bool least_bounded(const model *);
/* The same of the rate of `value`, as far as it tells how the value changes: not positive where that may jump. */
node least_rate(model *, node value, node rate);

#endif
