/* Long work in pieces of some milliseconds, so that a caller can follow and cancel it. */
#ifndef API_MOTION_PACE_H
#define API_MOTION_PACE_H

#include "core/stepper.h"

typedef struct pace {
    int64_t piece;  /* steps of the next piece; 0: not known yet */
    double seconds; /* how long a piece should take */
    /* Called after every piece; cancels by a result other than 0. NULL: all the work is one piece. */
    int (*tell)(void *ctx, double now);
    void *ctx;
} pace;

double pace_now(void); /* in seconds, monotonic */
/* Advances as stepper_advance does. MOTUS_CANCELLED, without a message: `tell` cancels. */
motus_status pace_advance(pace *, stepper *, stepper_limit, stepper_stop *why, motus_error *);

#endif
