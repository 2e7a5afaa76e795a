/* How far rounding may carry formulas off that are evaluated at a state. */
#ifndef MACHINE_ROUNDING_H
#define MACHINE_ROUNDING_H

#include "lang/model/model.h"
#include "lang/tape/tape.h"

/* The bounds of these outputs, in units of 2^-53; time and state are known to half a unit in the last place. In the
 * model's arena; NULL: no memory. */
tape *rounding_tape(model *, const output *, size_t count);
output *rounding_outputs(model *, const output *, size_t count); /* the outputs of that tape */

#endif
