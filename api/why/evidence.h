/* What a failed or crawling run shows of its cause: trial steps and samples of the force near its last good step.
 *
 * Each function tells one kind of evidence and judges nothing else. Invariant: the run is not touched, and the evidence
 * is the same on all machines.
 */
#ifndef API_WHY_EVIDENCE_H
#define API_WHY_EVIDENCE_H

#include "core/stepper.h"
#include "api/system/system.h"

#include <stdbool.h>
#include <stddef.h>

/* ---- power.c: the power of the time with which a number grows towards an instant, from samples before it ---- */

/* A number that goes as (at - t)^-exponent. */
typedef struct power {
    double at, at_error, exponent, exponent_error;
} power;

/* Fits a power to samples y > 0 at increasing times t, which are rounded by `rounding`. False: the samples do not
 * follow one power over two decades of the distance. */
bool power_fit(const double *t, const double *y, size_t count, double rounding, power *out);

/* ---- stability.c: how long the steps of a method may be for a rate of the motion ---- */

/* Returns the largest product of step and |rate| for which steps of the method do not grow, along the direction of a
 * rate re + i im. 0: they always grow. NaN: even the shortest steps have no result, as where an iteration fails to
 * converge. */
double stability_bound(const char *method, double re, double im);

/* ---- trial.c: trial steps from a state, apart from the run: how far another method, step or tolerance leads ----
 *
 * A trial evaluates the equations of the run and counts its own time from 0 on, so that steps near the rounding of the
 * run's time remain possible. Invariant: the run is not touched; a trial is the same on all machines. */

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

/* Where a trial with a limited number of steps leads. */
typedef struct trial_course {
    motus_status status; /* MOTUS_STEPS: the steps were too few */
    int64_t steps;
    double gone, largest; /* the time that was covered, and the largest number of x and v on the way */
} trial_course;
/* Runs a trial. end: NULL, or room for its last state, x and then v. */
trial_course trial_run(const problem *, const motus_allocator *, const chosen *, double t, double h, const double *x,
                       const double *v, int64_t steps, double until, double *end);

/* ---- evidence.c ---- */

typedef struct evidence {
    motus_system *system;
    const problem *problem;
    const chosen *row;
    bool adaptive;
    double way;                         /* 1; -1 where the run goes backward */
    double begin, until;                /* the leg's ends */
    double h, noted;                    /* the size of the last step, and the time of the failure */
    double early_t, *early_x, *early_v; /* the state some steps before the last good one */
    bool origin;                        /* the state at `begin` is known */
    double *origin_x, *origin_v;        /* the state at `begin`, which has no error yet */
    double t, *x, *v, *a;               /* the last good state, and the force there */
    double *other_x, *other_v, *b, *c;  /* room */
    int64_t steps;                      /* the most steps of one trial */
} evidence;

/* Collects what trials need. home: where the system is located, the system as it was written, whose positions come
 * first; trials use its force, since with sides held a force would go on beyond a switch unchanged. NULL: trials use
 * the stepper's system. False: there is no memory, no state, or no finite force at the last good state. */
bool evidence_begin(evidence *, motus_system *, motus_system *home, stepper *, double noted);
/* Seeks evidence from this state instead of the last good one. */
void evidence_from(evidence *, double t, const double *x, const double *v);
void evidence_end(evidence *);

/* Where controlled steps lead: from the start where that takes few enough steps, else from the early state. */
typedef enum evidence_way {
    EVIDENCE_UNKNOWN,  /* too few steps, a halt for another reason, or disagreement */
    EVIDENCE_ON,       /* beyond the failure */
    EVIDENCE_SINGULAR, /* to a time at which the force has no finite value */
    EVIDENCE_INFINITE  /* to the largest numbers */
} evidence_way;
typedef struct evidence_ahead {
    evidence_way way;
    double gone;                                 /* the time that was covered */
    double t, t_error, exponent, exponent_error; /* SINGULAR: the run's time, and the power of the growing number */
    size_t which;                                /* the number of v that changes most at the end */
    bool in_v;                                   /* INFINITE: a number of v is infinite, else one of x */
    double largest;                              /* the largest number of a state on the way */
    bool from_start;                             /* steps from the start, which have none of the run's errors */
    bool drifted;                                /* steps from the start go on, and those from the early state do not */
} evidence_ahead;
evidence_ahead evidence_look(evidence *);

/* Returns whether the force jumps near the last good state: its number `which`, from `before` to `after` in the run's
 * direction. */
bool evidence_jump(evidence *, size_t *which, double *before, double *after);
/* Returns whether number `which` of the force has no finite value just after the last good state: at time `at`, and the
 * state in other_x and other_v. */
bool evidence_undefined(evidence *, size_t *which, double *at);
/* Returns the time since which it has none, at the latest `at`, if that depends on the time alone. Leaves the state
 * there in other_x and other_v. */
double evidence_undefined_since(evidence *, size_t which, double at);
/* Returns whether number `which` of the force has no finite value at the last good state. */
bool evidence_undefined_here(evidence *, size_t *which);
/* Returns whether the rounding of the force takes a tenth or more of the error that the present steps may have, and the
 * number `which` of the force that takes most. */
bool evidence_noise(evidence *, size_t *which);
/* Finds the largest eigenvalue of the equations linearised at a state, and the number of v that takes part in it most.
 * False: it cannot be computed. */
bool evidence_rate(evidence *, bool early, double *re, double *im, size_t *which);

/* Where a trial begins: at the last good state, the early one, or the state at the start, if known. */
typedef enum evidence_place { EVIDENCE_FROM_LAST, EVIDENCE_FROM_EARLY, EVIDENCE_FROM_START } evidence_place;
/* Trial steps with another method, step or tolerance. */
typedef struct evidence_trial {
    const char *method; /* NULL: the run's */
    /* 0: the run's */
    double step, tolerance;
    bool absolute;
    evidence_place from;
} evidence_trial;
/* Takes the steps of a trial up to `until`. end: NULL, or room for nx + nv numbers. */
trial_course evidence_try(evidence *, const evidence_trial *, int64_t steps, double until, double *end);

#endif
