/* Runs with fixed steps that end a step where a switch changes its side (motus_run_def.switches): such a step is taken
 * in pieces, in each of which the force is smooth. Other steps are those of any run. */
#ifndef API_MOTION_LOCATE_H
#define API_MOTION_LOCATE_H

#include "api/motion/run.h"

typedef struct locate locate;

/* Makes r->locate where the model has something to locate or to resolve; the run then uses the machine of held sides.
 * Call it after the method is chosen and before the stepper is made. */
motus_status locate_prepare(motus_run *, motus_switches, motus_error *);
/* Finds the sides at the stepper's state, where the run or a leg starts. */
motus_status locate_begin(motus_run *, motus_error *);
/* Takes one step, or the shorter last one. Fails as stepper_advance does, and with MOTUS_SOLVE where the motion slides
 * along a switch. */
motus_status locate_step(motus_run *, stepper_stop *why, motus_error *);
int64_t locate_steps(const motus_run *); /* of the leg, before the stepper's own count began */
/* Binds the run's sides, since another run of the system may have bound its own. False: no memory. */
bool locate_bind(motus_run *);
void locate_statistics(const motus_run *, motus_run_statistics *);
void locate_destroy(motus_run *);

#endif
