/* A companion of a run: another computation of the same motion, whose distance from the run tells the run's error.
 *
 * It lands at times of the run: from one landing to the next it takes a whole number of equal steps (stepper_turn), so
 * that states are compared without interpolation.
 */
#ifndef API_ERROR_COMPANION_H
#define API_ERROR_COMPANION_H

#include "api/error/witness.h"

typedef struct companion {
    motus_system *system; /* NULL: the run's */
    machine machine;
    bool waits; /* a compiler is at work for `system` */
    stepper *stepper;
    events *events; /* of the rules of its system; NULL: there are none */
    bool over;      /* an event has ended it */
    double *x, *v;  /* the state at the last landing, in the inside order */
    double t;       /* the time of the last landing */
    int64_t before; /* steps that the run had taken when the companion began */
    bool controls;  /* it controls its error */
    int64_t room;   /* how many steps it may still take, if `controls` */
    pace pace;
} companion;

/* Returns the method of the half: the run's without error control, or with a smaller tolerance where the system's force
 * is not smooth. A Taylor series keeps its tolerance; Beeman's method is replaced (companion.c). */
chosen companion_method(const chosen *, const motus_system *);
/* Begins at a copy of the state x, v at t, with the run's method. */
motus_status companion_begin(companion *, const motus_run *, double t, const double *x, const double *v, motus_error *);
/* Lands at t. steps: how many the run has taken since the last landing; the last one may count in part. */
motus_status companion_land(companion *, const motus_run *, double t, int64_t steps, motus_error *);
/* An event at which the run stands. */
typedef struct companion_goal {
    int64_t acted; /* how often rules have assigned */
    bool ends;     /* the event ended the run, and ends the companion */
    bool enough;   /* `acted` actions are enough, even if the last of them ends nothing */
} companion_goal;
/* Goes on to the companion's own event that reaches the goal, but at most `span` further. */
motus_status companion_reach(companion *, const companion_goal *, double span, motus_error *);
/* Moves the state by its rounding, for rows that compute the motion by a formula: halving their steps changes
 * nothing. */
motus_status companion_jog(companion *, const motus_run *, motus_error *);
/* Moves numbers by at least an ulp, or by `size` if given; a hash of their places and `salt` says up or down. */
void companion_move(double *y, size_t count, const double *size, uint32_t salt);
/* Moves the state by dx and dv. */
motus_status companion_shift(companion *, const motus_run *, const double *dx, const double *dv, motus_error *);
/* Goes to t as the witness leads, instead of by steps of its own. The companion must have no events. */
motus_status companion_led(companion *, const motus_run *, witness *, double t, motus_error *);
/* Repeats the steps of the run, and so lands where the run stands. */
motus_status companion_repeat(companion *, const motus_run *, motus_error *);
/* Returns how many numbers a restart state keeps of a companion with events, besides its state; writes them unless
 * `out` is NULL. */
size_t companion_keep(const companion *, double *out);
/* Resumes from the numbers of companion_keep at *at, and moves *at past them. MOTUS_STATE: they are not a
 * companion's. */
motus_status companion_resume(companion *, const motus_run *, const double **at, const double *end, motus_error *);
bool companion_skip(const double **at, const double *end); /* moves *at past such numbers; false: they are damaged */
void companion_end(companion *, const motus_allocator *);

#endif
