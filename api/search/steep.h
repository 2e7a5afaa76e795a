/* Where a motion passes an infinite slope of its force, as of cbrt(x) at x = 0. There no method has the errors of its
 * order, and Taylor series end. */
#ifndef API_SEARCH_STEEP_H
#define API_SEARCH_STEEP_H

#include "api/motion/run.h"

typedef struct steep {
    bool known;                /* it has been looked for */
    char text[MOTUS_TEXT_MAX]; /* "the force has an infinite slope where x - 1 is 0, first at t = 2.5"; "": nowhere */
} steep;

/* Finds the first such place on the motion of a definition with an end, once. MOTUS_CANCELLED, MOTUS_MEMORY. */
motus_status steep_find(motus_system *, const motus_run_def *, steep *, motus_error *);

#endif
