/* Trial steps from a state, apart from the run: how far another method, step or tolerance leads.
 *
 * A trial evaluates the equations of the run and counts its own time from 0 on, so that steps near the rounding of the
 * run's time remain possible. Invariant: the run is not touched; a trial is the same on all machines.
 */
#ifndef API_WHY_TRIAL_H
#define API_WHY_TRIAL_H

#include "core/stepper.h"

typedef struct trial {
    const problem *own;
    problem problem; /* the equations of `own`, with time counted from 0 */
    double from;     /* the run's time at the trial's 0 */
    stepper *stepper;
    int64_t steps; /* the most steps it may take */
} trial;

/* Begins at time t and state (x, v). h: the size of fixed steps; for adaptive ones only its sign counts. False: a trial
 * cannot begin there. */
bool trial_begin(trial *, const problem *, const motus_allocator *, const chosen *, double t, double h, const double *x,
                 const double *v, int64_t steps);
void trial_end(trial *);
/* Takes one step towards `until`, in the trial's time. `arrived`: the step ended there. */
motus_status trial_step(trial *, double until, bool *arrived);

/* Where at most so many steps lead. */
typedef struct trial_course {
    motus_status status; /* MOTUS_STEPS: the steps were too few */
    int64_t steps;
    double gone, largest; /* the time that was covered, and the largest number of x and v on the way */
} trial_course;
/* Runs a trial. end: NULL, or room for its last state, x and then v. */
trial_course trial_run(const problem *, const motus_allocator *, const chosen *, double t, double h, const double *x,
                       const double *v, int64_t steps, double until, double *end);

#endif
