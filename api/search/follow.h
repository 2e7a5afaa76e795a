/* The motion of a draft, followed from its start: what swings, settles, falls, runs away. */
#ifndef API_SEARCH_FOLLOW_H
#define API_SEARCH_FOLLOW_H

#include "api/system/system.h"

typedef enum follow_end {
    FOLLOW_GOES_ON,
    FOLLOW_INFINITE,  /* a position or first-order variable becomes infinite */
    FOLLOW_SINGULAR,  /* a velocity or the force becomes infinite */
    FOLLOW_UNDEFINED, /* the force has no value beyond */
} follow_end;

typedef struct followed {
    bool rests;               /* the start is an equilibrium, and nothing was followed */
    double shortest, longest; /* periods, from a turning point to the next but one; 0: nothing swings */
    size_t fastest, slowest;  /* the numbers of v with these periods */
    bool irregular;           /* the periods of a number differ, and these are means */
    double change;  /* the shortest time in which the motion changes as a harmonic one does in 1/15 of its period */
    double grown;   /* how long until it has grown FOLLOW_GROWTH times; 0: it does not */
    double since;   /* `grown` is from its size at this time after the start */
    double landed;  /* how long until the number `falling` is 0; 0: it never is */
    size_t falling; /* the number with the largest force */
    double settled; /* how long until it stays within 1 % of where it ends; 0: it does not */
    double elapsed; /* how long it was followed */
    bool cut;       /* it was followed to the limit of the draft */
    double step;    /* the mean of its last steps */
    double fast;    /* the largest rate at which positions move; 0: not known */
    follow_end end;
    double bound; /* how long until `end` */
} followed;

enum { FOLLOW_GROWTH = 20 };

/* Follows the motion for at most the time `horizon`, as far as the draft allows; a fall is followed to its end. rate:
 * the fastest at the start, > 0. way: 1, or -1 backward. False: no memory. */
bool follow_motion(motus_system *, double from, double way, double rate, double horizon, followed *);

#endif
