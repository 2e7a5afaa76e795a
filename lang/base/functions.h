/* The elementary functions over one kind of number (step/functions_core.h says how it is named); included once for each
 * kind. */
#include "step/functions_core.h"
#include "step/functions_plain.h"
#include "step/functions_exponential.h"
#include "step/functions_logarithm.h"
#include "step/functions_power.h"
#include "step/functions_hyperbolic.h"
#include "step/functions_circular.h"
#include "step/functions_inverse.h"
#include "step/functions_root.h"
#include "step/functions_error.h"
#include "step/functions_end.h"
