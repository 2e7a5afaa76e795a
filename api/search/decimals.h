/* What the rounding of a model's decimals does to an answer. */
#ifndef API_SEARCH_DECIMALS_H
#define API_SEARCH_DECIMALS_H

#include "api/motion/run.h"

/* Finds how far the answer moves where every decimal is read as the double on its other side: the largest change of a
 * number of the state at the end, relative to the largest number of its kind, or absolute. `run` is at its end; `def`
 * is its definition, whose hook may cancel. NaN: not known, or not clearly more than rounding. */
motus_status decimals_part(const motus_run_def *def, motus_run *run, bool absolute, double *part, motus_error *);

#endif
