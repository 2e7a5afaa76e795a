/* Lower bounds on the size of formulas over a box of states, which contains those of a step. */
#ifndef MACHINE_LEAST_H
#define MACHINE_LEAST_H

#include "lang/model/model.h"

/* Bounds how far the value on the box may be from that at its centre, which SPACE_X and SPACE_V hold; SPACE_DX and
 * SPACE_DV hold the half widths. Infinite if the value depends on the time or on accelerations, for which a box has no
 * width. */
node least_radius(model *, node value);
/* Bounds |value| on the box from below; not positive: no bound is known. */
node least_size(model *, node value);
/* Makes the lower bounds of all functions of the model's rules, in their order. NULL: no memory. */
output *least_sizes(model *, size_t *count);
/* Tells whether these bounds can prove of steps that nothing happens: functions of the time have none, and those of
 * located switches (machine/sides.h) are not among the model's own. */
bool least_bounded(const model *);
/* Bounds the size of the rate of `value` from below; not positive where the value may jump. */
node least_rate(model *, node value, node rate);

#endif
