/* The motion of a draft, followed from its start: what swings, what runs away. */
#ifndef API_FOLLOW_H
#define API_FOLLOW_H

#include "api/system.h"

typedef struct followed {
    double shortest, longest; /* swings, from a turning point to the next but one; 0: nothing swings */
    size_t slowest;           /* the number of v that has the longest */
    double change; /* the shortest time in which the motion changes as a harmonic one does in 1/15 of its period */
    double grown;  /* how long until it has grown FOLLOW_GROWTH times; 0: it does not */
    double landed; /* how long until the number with the largest force is at 0, where that force lasts; 0: it is not */
    double bound;  /* how long until it is infinite, or so fast that no step can follow; 0: it is not */
} followed;

enum { FOLLOW_GROWTH = 20 };

/* rate: the fastest at the start, > 0. way: 1, or -1 backward. It is followed for at most `horizon` of time, and as far
 * as the draft allows. False: no memory. */
bool follow_motion(motus_system *, double from, double way, double rate, double horizon, followed *);

#endif
