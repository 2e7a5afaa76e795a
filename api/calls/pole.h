/* Whether a way leads through a pole of the force, at which the force cannot be integrated. */
#ifndef API_CALLS_POLE_H
#define API_CALLS_POLE_H

#include "api/system/system.h"

/* A way from one state to another in the time h: cubics with the velocities of both ends, or a straight line, for which
 * h may be 0. */
typedef struct pole_way {
    motus_system *system; /* with known poles */
    double t, h;
    const double *x, *v, *end_x, *end_v;
    bool straight;
    interval *box; /* room for nx + nv */
    double *room;  /* 4 nv numbers */
} pole_way;

/* Returns whether a divisor (or another operation with a pole: lang/model/resolution.h) passes or touches 0 on the way,
 * and the force grows there as the inverse of the time, or faster. */
bool pole_on(const pole_way *);

#endif
