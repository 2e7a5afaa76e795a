/* Why a run failed, or crawls: the cause, where the evidence suffices, and what to try.
 *
 * Invariant: a cause is named only where trial steps or samples of the force near the failure show it; else the error
 * keeps what it says, time and variable. What is to be tried has been tried, from a state shortly before the failure,
 * where `verified` says so.
 */
#ifndef API_WHY_DIAGNOSIS_H
#define API_WHY_DIAGNOSIS_H

#include "api/system/system.h"
#include "core/stepper.h"

/* Whether the run of a definition comes to its end within so many steps; rooms above take the steps. */
typedef bool diagnosis_leads(motus_system *, const motus_run_def *, int64_t steps);

/* Whose steps are judged. */
typedef struct diagnosed {
    motus_system *system, *home; /* home: the system as it was written, where the first one is located; NULL */
    diagnosis_leads *leads;
} diagnosed;

/* Adds the cause to the error of a stepper that has failed; an error that has a cause stays as it is. */
void diagnosis_add(const diagnosed *, stepper *, motus_error *);
/* Of a run whose steps pass a singularity of the force after the time t, where it had the state (x, v): the instant and
 * the power. end: the time as a text, at which the run may end. */
void diagnosis_singular(const diagnosed *, stepper *, double t, const double *x, const double *v, const char *end,
                        motus_error *);
/* A stepper_judge, whose context is a `diagnosed`: a run that may crawl ends where a cause is found. */
motus_status diagnosis_crawls(void *diagnosed, stepper *, int64_t steps, double gone, motus_error *);

#endif
