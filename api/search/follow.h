/* The motion of a draft, followed from its start: what swings, settles, falls, runs away. */
#ifndef API_SEARCH_FOLLOW_H
#define API_SEARCH_FOLLOW_H

#include "api/system/system.h"

typedef enum follow_end {
    FOLLOW_GOES_ON,
    FOLLOW_INFINITE,  /* a position or a first-order variable */
    FOLLOW_SINGULAR,  /* a velocity, or the force */
    FOLLOW_UNDEFINED, /* the force has no value beyond */
} follow_end;

typedef struct followed {
    bool rests;               /* the start is an equilibrium: nothing was followed */
    double shortest, longest; /* swings, from a turning point to the next but one; 0: nothing swings */
    size_t fastest, slowest;  /* the numbers of v that have them */
    bool irregular;           /* their lengths differ, and these are means */
    double change;  /* the shortest time in which the motion changes as a harmonic one does in 1/15 of its period */
    double grown;   /* how long until it has grown FOLLOW_GROWTH times; 0: it does not */
    double since;   /*   from its size at this time after the start; 0: from its size at the start */
    double landed;  /* how long until the number with the largest force falls to 0; 0: it does not */
    size_t falling; /*   this number */
    double settled; /* how long until it is within 1 % of where it is at the end of what was followed; 0: it is not */
    double elapsed; /* how long it was followed */
    bool cut;       /* as far as the draft allows, and not further */
    double step;    /* its last steps, a mean of some */
    double fast;    /* the largest rate at which positions move, 0: not known */
    follow_end end;
    double bound; /* how long until that end */
} followed;

enum { FOLLOW_GROWTH = 20 };

/* rate: the fastest at the start, > 0. way: 1, or -1 backward. It is followed for at most `horizon` of time, and as far
 * as the draft allows; a fall to its end. False: no memory. */
bool follow_motion(motus_system *, double from, double way, double rate, double horizon, followed *);

#endif
