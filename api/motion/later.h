/* Which machine a run takes, and when. A long run begins in the interpreter while the compiler works, and goes on
 * compiled at the end of a step, so that nobody waits for a compiler. Likewise it goes from a text that is compiled
 * soon to a longer one, which is faster.
 *
 * Invariant: the bits, the counters and the errors do not depend on when a run goes over, nor on whether it does.
 */
#ifndef API_MOTION_LATER_H
#define API_MOTION_LATER_H

#include "api/motion/run.h"

/* Chooses the machine of a run that takes about `steps` steps; 0: the number is not known. "compiled" waits for the
 * compiler, because the caller asks for it. */
motus_status later_choose(motus_run *, const char *wanted, double steps, motus_error *);
/* Returns how many steps the run may take before it calls later_look; 0 or less: it calls now. */
int64_t later_room(const motus_run *);
/* Starts a compiler where the work that is left repays it, or goes on compiled where the object is there. */
motus_status later_look(motus_run *, motus_error *);
/* Makes the run look after its next step, since its steps are counted anew or it waits for something else. */
void later_hurry(motus_run *);
/* Forgets the compiler: the run ends, or cannot go on compiled. */
void later_end(motus_run *);
/* For tests, before the first step: begins in the interpreter and goes on compiled after exactly `step` steps, at least
 * 1, and with the longer text after `longer` steps (0: as usual); there the run waits for the compiler. */
motus_status later_at(motus_run *, int64_t step, int64_t longer, motus_error *);

#endif
