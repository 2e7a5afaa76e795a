/* Which machine a run takes, and when: nobody waits for a compiler. A run that is long enough begins in the interpreter
 * while the compiler works, and goes on compiled at the end of a step.
 *
 * Invariant: the bits, the counters and the errors do not depend on when that happens, nor on whether it does.
 */
#ifndef API_MOTION_LATER_H
#define API_MOTION_LATER_H

#include "api/motion/run.h"

/* Chooses the machine of a run that takes about so many steps, 0: not known. "compiled" waits for the compiler, because
 * the caller asks for it. */
motus_status later_choose(motus_run *, const char *wanted, double steps, motus_error *);
/* How many steps the run may take before it looks again, 0 or less: it is to look now. */
int64_t later_room(const motus_run *);
/* Starts a compiler where what is left repays it, or goes on compiled where the object is there. */
motus_status later_look(motus_run *, motus_error *);
/* Its steps are counted anew, or it waits for something else: it looks after the next step. */
void later_hurry(motus_run *);
/* The run ends, or cannot go on compiled. */
void later_end(motus_run *);
/* For tests, before the first step: the run begins in the interpreter and goes on compiled after exactly so many steps,
 * at least 1, where it waits for the compiler. */
motus_status later_at(motus_run *, int64_t step, motus_error *);

#endif
