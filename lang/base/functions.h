/* The elementary functions over one kind of number (step/functions/core.h says how it is named); included once for each
 * kind. */
#include "step/functions/core.h"
#include "step/functions/plain.h"
#include "step/functions/exponential.h"
#include "step/functions/logarithm.h"
#include "step/functions/power.h"
#include "step/functions/hyperbolic.h"
#include "step/functions/circular.h"
#include "step/functions/inverse.h"
#include "step/functions/root.h"
#include "step/functions/error.h"
#include "step/functions/end.h"
