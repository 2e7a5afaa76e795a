/* Bounds on the rounding errors of formulas that are evaluated at a state. */
#ifndef MACHINE_ROUNDING_H
#define MACHINE_ROUNDING_H

#include "lang/model/model.h"
#include "lang/tape/tape.h"

/* Make, in the model's arena, a tape of the bounds of these outputs, in units of 2^-53, or the bounds as outputs. Time
 * and state are taken as known to half a unit in the last place. NULL: no memory. */
tape *rounding_tape(model *, const output *, size_t count);
output *rounding_outputs(model *, const output *, size_t count);

#endif
