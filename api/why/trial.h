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
    problem problem; /* the same, its time counted from 0 */
    double from;     /* the run's time at 0 */
    stepper *stepper;
    int64_t steps; /* that it may take */
} trial;

/* At the state (x, v) of time t; h: of steps of one size, else its sign alone counts. False: it cannot be. */
bool trial_begin(trial *, const problem *, const motus_allocator *, const chosen *, double t, double h, const double *x,
                 const double *v, int64_t steps);
void trial_end(trial *);
/* One step towards the time `until` of its own. OK: made; `arrived` where it has ended there. */
motus_status trial_step(trial *, double until, bool *arrived);

/* Where up to so many steps lead: the time that was covered, and the largest number of x and of v on the way.
 * end: NULL, or room for the state there, x and then v. */
typedef struct trial_course {
    motus_status status; /* STEPS: they were too few */
    int64_t steps;
    double gone, largest;
} trial_course;
trial_course trial_run(const problem *, const motus_allocator *, const chosen *, double t, double h, const double *x,
                       const double *v, int64_t steps, double until, double *end);

#endif
