/* How a run chooses its steps: of one size, or by a tolerance. */
#ifndef API_REQUEST_CONTROL_H
#define API_REQUEST_CONTROL_H

#include "api/system/system.h"

/* What a definition says of it; NaN: nothing, the limits of the steps 0: none. named: it names the method too. */
typedef struct control_wish {
    bool named;
    double step, tolerance, shortest, longest;
    bool absolute;
    int64_t count; /* the most steps; 0: any number */
} control_wish;
control_wish control_wish_of_run(const motus_run_def *);

/* Writes the tolerance and the limits of the steps to the method that was chosen. MOTUS_ARGUMENT: the definition or the
 * model gives a number that the method does not take, or one out of its range. */
motus_status control_choose(const motus_system *, const control_wish *, chosen *, motus_error *);

/* Whether an error can be asked for at all: `what` is "a tolerance" or "an accuracy". MOTUS_ARGUMENT. */
motus_status control_admits(const char *what, double value, bool absolute, motus_error *);

#endif
