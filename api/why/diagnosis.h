/* Why a run failed, or crawls: the cause, where the evidence suffices, and what to try.
 *
 * Invariant: a cause is named only where trial steps or samples of the force near the failure show it; else the error
 * keeps what it says, time and variable. Where `verified` says so, the advice has been tried from a state shortly
 * before the failure.
 */
#ifndef API_WHY_DIAGNOSIS_H
#define API_WHY_DIAGNOSIS_H

#include "api/system/system.h"
#include "core/stepper.h"

/* Returns whether the run of a definition comes to its end within `steps` steps. Rooms above supply it. */
typedef bool diagnosis_leads(motus_system *, const motus_run_def *, int64_t steps);

/* The run whose steps are judged. */
typedef struct diagnosed {
    motus_system *system, *home; /* home: where `system` is located, the system as it was written; else NULL */
    diagnosis_leads *leads;
} diagnosed;

/* Adds the cause to the error of a stepper that has failed. An error that has a cause stays as it is. */
void diagnosis_add(const diagnosed *, stepper *, motus_error *);
/* Reports the singularity of the force that the steps of a run pass after the time t and the state (x, v): its instant
 * and power. end: a time before it at which the run may end, as a text. */
void diagnosis_singular(const diagnosed *, stepper *, double t, const double *x, const double *v, const char *end,
                        motus_error *);
/* Ends a run that crawls where a cause is found: a stepper_judge, whose context is a `diagnosed`. */
motus_status diagnosis_crawls(void *diagnosed, stepper *, int64_t steps, double gone, motus_error *);

#endif
