/* step/reduce.h for one number at a time. */
#ifndef RUN_REDUCTION_H
#define RUN_REDUCTION_H

#include <time.h>                /* before `clock` is the texts' */
#include "core/stepper_body.h"
#include "lang/base/functions.h"

#define LEAST(a, b) motus_min(a, b)
#define MOST(a, b) motus_max(a, b)
#define CHOOSE(condition, a, b) ((condition) ? (a) : (b))
#include "step/reduce.h"

#endif
