/* machine/text/reduce.h with real = double. */
#ifndef MACHINE_REDUCTION_H
#define MACHINE_REDUCTION_H

#include <time.h> /* before the texts define `clock` */
#include "core/stepper_body.h"
#include "lang/base/functions.h"

#define LEAST(a, b) motus_min(a, b)
#define MOST(a, b) motus_max(a, b)
#define CHOOSE(condition, a, b) ((condition) ? (a) : (b))
#include "machine/text/reduce.h"

#endif
