/* How fast a motion is along its way: the rates of the equations linearised at states of a short pilot. */
#ifndef API_SEARCH_ALONG_H
#define API_SEARCH_ALONG_H

#include "api/system/linear.h"
#include "api/system/system.h"

enum { ALONG_MOST = 64 };

typedef struct along_place {
    double time, span; /* time: from the start on; span: for how much time before it the place stands */
    linear_rates rates;
} along_place;

typedef struct along {
    size_t count;
    along_place places[ALONG_MOST];
    double time; /* how long the motion was followed */
    bool whole;  /* it was followed for the time asked for, or to an event that ends it */
} along;

/* Follows the motion from the state and the time of `at` for so long; backward if `way` is -1. first: the rates there,
 * for the first place. `at` ends with the last state at which rates were taken; work: room for (RATE_MOTION_MAX + 1) n
 * numbers. The effort is bounded and counted in operations, so that the places are alike on all machines. An early end
 * of the motion, as at a singularity, is no error. MOTUS_MEMORY. */
motus_status along_motion(motus_system *, double way, double duration, linear *at, double *work,
                          const linear_rates *first, along *, motus_error *);

/* Returns the place where the motion is fastest, unless it is about to run into a singularity. */
const along_place *along_fastest(const along *);
/* Returns the longest period of rates above `noise`, or the time scale of the slowest if that does not oscillate (turns
 * false). 0: there is none. */
double along_period(const linear_rates *, double noise, bool *turns);
/* Returns the mean of the longest periods over the time; noise: relative to the fastest rate. 0: none. */
double along_mean_period(const along *, double noise);

#endif
