/* Runs that end a step where a switch changes its side (motus_run_def.switches): the step is taken in pieces, each of
 * which the force is smooth in. Between such steps nothing differs from other runs.
 */
#ifndef API_MOTION_LOCATE_H
#define API_MOTION_LOCATE_H

#include "api/motion/run.h"

typedef struct locate locate;

/* What the run needs for it, as r->locate, where the model has something to locate or to resolve; the run then uses the
 * machine of held sides. Call it after the method was chosen and before the stepper is made. */
motus_status locate_prepare(motus_run *, motus_switches, motus_error *);
/* Finds the sides at the start of the run, or of a new leg, whose state the stepper has. */
motus_status locate_begin(motus_run *, motus_error *);
/* Takes one step, or the shorter last one. Fails as stepper_advance does, and with MOTUS_SOLVE where the motion slides
 * along a switch. */
motus_status locate_step(motus_run *, stepper_stop *why, motus_error *);
int64_t locate_steps(const motus_run *); /* of the run's leg, before the stepper's present one */
/* Computes with the run's sides from now on; other runs of the system may have bound theirs. False: no memory. */
bool locate_bind(motus_run *);
void locate_statistics(const motus_run *, motus_statistics *);
void locate_destroy(motus_run *);

#endif
