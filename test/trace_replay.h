/* A traced step by hand: from its entries, by the formulas of the method's family as they stand on paper, to its
 * end. */
#ifndef TEST_TRACE_REPLAY_H
#define TEST_TRACE_REPLAY_H

#include "motus.h"

/* Fails the test where an entry is not what the formula makes of those before it, or a slope not the acceleration
 * where it was taken. `before`: positions and acceleration at the start of the step before, or NULL: two-step methods
 * must name them. */
void trace_replay(const motus_system *, const motus_method *, const motus_trace_entry *const *, size_t count,
                  const double *before_x, const double *before_a, const char *what);

#endif
