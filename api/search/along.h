/* How fast a motion is along its way, and not at its start alone: the rates of the equations linearised at states of a
 * short pilot run. */
#ifndef API_SEARCH_ALONG_H
#define API_SEARCH_ALONG_H

#include "api/system/linear.h"
#include "api/system/system.h"

enum { ALONG_MOST = 64 };

typedef struct along_place {
    double time, span; /* from the start on; it stands for so much time before it */
    linear_rates rates;
} along_place;

typedef struct along {
    size_t count;
    along_place places[ALONG_MOST];
    double time; /* how long it was followed, */
    bool whole;  /*   which is as long as was asked for, or to an event that ends the motion */
} along;

/* Follows the motion from the state and the time of `at` for so long; backward where `way` is -1. `first`: its
 * rates there, the first place. `at` ends with the last state at which rates were taken; work: room for
 * (RATE_MOTION_MAX + 1) n numbers. The effort is bounded and counted in operations, so that the places are the same
 * on every machine. What ends the motion early, a singularity say, is no error. MOTUS_MEMORY. */
motus_status along_motion(motus_system *, double way, double duration, linear *at, double *work,
                          const linear_rates *first, along *, motus_error *);

/* Where the motion is fastest for longer than it takes to run into a singularity. */
const along_place *along_fastest(const along *);
/* The longest period of rates that are above `noise`, or the scale of time where the slowest of them does not
 * oscillate; 0: there is none. */
double along_period(const linear_rates *, double noise, bool *turns);
/* How long the longest of these takes in the mean over the time; noise: relative to the fastest rate. 0: there is none.
 */
double along_mean_period(const along *, double noise);

#endif
