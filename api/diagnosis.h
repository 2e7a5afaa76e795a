/* Why a run failed, or crawls: the cause, where the evidence suffices, and what to try.
 *
 * Invariant: a cause is named only where trial steps or samples of the force near the failure show it; else the error
 * keeps what it says, time and variable. What is to be tried has been tried, from a state shortly before the failure,
 * where `verified` says so.
 */
#ifndef API_DIAGNOSIS_H
#define API_DIAGNOSIS_H

#include "api/system.h"
#include "core/stepper.h"

/* Adds the cause to the error of a stepper that has failed; one that has a cause stays as it is. home: the system as it
 * was written, where the first one is located; NULL. */
void diagnosis_add(motus_system *, motus_system *home, stepper *, motus_error *);
/* Of a run whose steps pass a singularity of the force after the time t, where it had the state (x, v): the instant and
 * the power. end: the time as a text, at which the run may end. */
void diagnosis_singular(motus_system *, stepper *, double t, const double *x, const double *v, const char *end,
                        motus_error *);
/* A stepper_judge, whose context is the system: a run that may crawl ends where a cause is found. */
motus_status diagnosis_crawls(void *system, stepper *, int64_t steps, double gone, motus_error *);

#endif
