/* Where a motion passes an infinite slope of its force, as that of cbrt(x) at x = 0. There no method has the errors
 * that its order says, and Taylor series end. */
#ifndef API_SEARCH_STEEP_H
#define API_SEARCH_STEEP_H

#include "api/motion/run.h"

typedef struct steep {
    bool known;                /* it has been looked for */
    char text[MOTUS_TEXT_MAX]; /* "the force has an infinite slope where x - 1 is 0, first at t = 2.5"; "": nowhere */
} steep;

/* The first place on the motion of this definition, whose end is known, unless it was looked for. MOTUS_CANCELLED,
 * MOTUS_MEMORY. */
motus_status steep_find(motus_system *, const motus_run_def *, steep *, motus_error *);

#endif
