/* Computes a traced step again from its entries, by the published formulas of the method's family. */
#ifndef TEST_TRACE_REPLAY_H
#define TEST_TRACE_REPLAY_H

#include "motus.h"

/* Fails the test where an entry is not what the formula makes of the entries before it, or a slope is not the
 * acceleration at its place. `before`: positions and acceleration at the start of the step before, which two-step
 * methods must trace, or NULL. */
void trace_replay(const motus_system *, const motus_method *, const motus_trace_entry *const *, size_t count,
                  const double *before_x, const double *before_a, const char *what);

#endif
