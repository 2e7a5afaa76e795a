/* What a failed or crawling run shows of its cause: trial steps and samples of the force near its last good step.
 *
 * Each function tells one kind of evidence and judges nothing else. Invariant: the run is not touched, and the evidence
 * is the same on all machines.
 */
#ifndef API_WHY_EVIDENCE_H
#define API_WHY_EVIDENCE_H

#include "api/why/power.h"
#include "api/why/trial.h"
#include "api/system/system.h"

typedef struct evidence {
    motus_system *system;
    const problem *problem;
    const chosen *row;
    bool adaptive;
    double way;                         /* 1, or -1 where the run goes backward */
    double begin, until;                /* of the leg */
    double h, noted;                    /* the size of the last step, and the time of the failure */
    double early_t, *early_x, *early_v; /* some steps before it */
    bool origin;                        /* the state at `begin` is known: */
    double *origin_x, *origin_v;        /*   it has no error yet */
    double t, *x, *v, *a;               /* the last good state, and the force there */
    double *other_x, *other_v, *b, *c;  /* room */
    double *rate_room;
    int64_t steps; /* that one trial may take */
} evidence;

/* home: where the system is located, as it was written, with the force of which trials are made: one with sides goes on
 * beyond a switch as it was before. Its positions are the first ones. NULL: it is the stepper's. False: there is no
 * memory, no state, or no finite force at the last good one. */
bool evidence_begin(evidence *, motus_system *, motus_system *home, stepper *, double noted);
/* The same from another state, for which the evidence is sought. */
void evidence_from(evidence *, double t, const double *x, const double *v);
void evidence_end(evidence *);

/* How controlled steps go on: from the start where they are not too many, else from the early state. */
typedef enum evidence_way {
    EVIDENCE_UNKNOWN,  /* they were too few, come to a halt for another reason, or do not agree */
    EVIDENCE_ON,       /* beyond the failure */
    EVIDENCE_SINGULAR, /* to a time at which the force has no finite value */
    EVIDENCE_INFINITE  /* to the largest numbers */
} evidence_way;
typedef struct evidence_ahead {
    evidence_way way;
    double gone;                                 /* the time that was covered */
    double t, t_error, exponent, exponent_error; /* SINGULAR: the run's time, and the power of the number */
    size_t which;                                /* the number of v whose change is the largest at the end */
    bool in_v;                                   /* INFINITE: it is a number of v, else of x */
    double largest;                              /* number of the states on the way */
    bool from_start;                             /* these are steps from the start, so no errors of the run are in it */
    bool drifted;                                /* and go on, where those from the early state do not */
} evidence_ahead;
evidence_ahead evidence_look(evidence *);

/* Whether the force jumps within the next steps: number `which` of it from `before` to `after`. */
bool evidence_jump(evidence *, size_t *which, double *before, double *after);
/* Whether the force has no finite value just after the last good state, and which number of it. */
bool evidence_undefined(evidence *, size_t *which);
/* The same at that state itself. */
bool evidence_undefined_here(evidence *, size_t *which);
/* Whether the rounding of the force alone makes steps of the present size fail the tolerance: which number. */
bool evidence_noise(evidence *, size_t *which);
/* The eigenvalue of largest size of the equations linearised at a state, and the number of v that takes part in it
 * most. False: it cannot be computed. */
bool evidence_rate(evidence *, bool early, double *re, double *im, size_t *which);

/* From the last good state, the early one, or that at the start, which has to be known. */
typedef enum evidence_place { EVIDENCE_FROM_LAST, EVIDENCE_FROM_EARLY, EVIDENCE_FROM_START } evidence_place;
/* Trial steps with another method, step (0: the run's), or tolerance (0: the run's). */
typedef struct evidence_trial {
    const char *method; /* NULL: the run's */
    double step, tolerance;
    bool absolute;
    evidence_place from;
} evidence_trial;
/* end: NULL, or room for nx + nv numbers. */
trial_course evidence_try(evidence *, const evidence_trial *, int64_t steps, double until, double *end);

#endif
