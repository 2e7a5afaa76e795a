/* A companion of a run: another computation of the same motion, from whose distance the error of the run is told.
 *
 * It lands where it is sent, at times of the run: from one landing to the next it takes a whole number of equal steps
 * (stepper_turn), so that it is compared without any interpolation. See companion.c for how many.
 */
#ifndef API_ERROR_COMPANION_H
#define API_ERROR_COMPANION_H

#include "api/error/witness.h"

typedef struct companion {
    motus_system *system; /* its own; NULL: the run's */
    machine machine;
    bool waits; /* a compiler is at work for its system */
    stepper *stepper;
    events *events; /* of its system's rules; NULL: it has none */
    bool over;      /* an event has ended it */
    double *x, *v;  /* its state at the last landing, in the inside order */
    double t;       /* of the last landing */
    int64_t before; /* steps that the run had taken when it began */
    bool controls;  /* it controls its error, and */
    int64_t room;   /*   may take so many steps more */
    pace pace;
} companion;

/* The method of the companion of about half the step: that of the run, without error control, or with less allowed
 * where the system's force is not smooth; a Taylor series keeps its tolerance, and Beeman's has another method, see
 * companion.c. */
chosen companion_method(const chosen *, const motus_system *);
/* From the state x, v at t, where the run stands, with the run's method. The state is copied. */
motus_status companion_begin(companion *, const motus_run *, double t, const double *x, const double *v, motus_error *);
/* Lands at t, where the run has taken `steps` steps since the last landing, of which the last may be in part. */
motus_status companion_land(companion *, const motus_run *, double t, int64_t steps, motus_error *);
/* Where the run stands at an event. */
typedef struct companion_goal {
    int64_t acted; /* so often a rule has assigned */
    bool ends;     /* the event ended the run, and is to end the companion */
    bool enough;   /* that many actions are enough, even where the last of them does not end it */
} companion_goal;
/* Goes on until it stands at such an event too, but at most `span` further. */
motus_status companion_reach(companion *, const companion_goal *, double span, motus_error *);
/* Moves its state by what rounding may make of it: of exact motions, which steps do not tell apart. */
motus_status companion_jog(companion *, const motus_run *, motus_error *);
/* Moves numbers by at least an ulp, and by `size` where it is given; up or down, by a hash of their places and
 * `salt`. */
void companion_move(double *y, size_t count, const double *size, uint32_t salt);
/* Moves its state by these differences. */
motus_status companion_shift(companion *, const motus_run *, const double *dx, const double *dv, motus_error *);
/* To t, in place of steps of its own as the witness leads it; it has no events. */
motus_status companion_led(companion *, const motus_run *, witness *, double t, motus_error *);
/* Repeats the steps of the run, and so stands where the run stands. */
motus_status companion_repeat(companion *, const motus_run *, motus_error *);
/* What a restart state has of a companion with events, besides its state: tells how many numbers, and writes them where
 * `out` is not NULL. */
size_t companion_keep(const companion *, double *out);
/* A companion that has begun goes on with them; *at moves behind them. MOTUS_STATE: they are not its own. */
motus_status companion_resume(companion *, const motus_run *, const double **at, const double *end, motus_error *);
bool companion_skip(const double **at, const double *end); /* moves behind them alone; false: they are damaged */
void companion_end(companion *, const motus_allocator *);

#endif
