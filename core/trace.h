/* What is told of one step to whoever looks in: the kicks, drifts and stages that the method makes, one event after
 * the other.
 *
 * Invariant: telling changes no bit of the step. Numbers are in the problem's order and live only until `see`
 * returns.
 */
#ifndef CORE_TRACE_H
#define CORE_TRACE_H

#include "core/methods.h"

typedef struct trace_event {
    motus_event kind;                     /* START and END are the caller's, who can look at the state there */
    int stage, stages;                    /* from 1 */
    int64_t iterations;                   /* of Newton's method, in this step so far */
    double time;                          /* at which the slope was taken; of a drift: to which it leads */
    double coefficient, weight, weight_x; /* in units of the step, all of them exactly as in the row */
    const double *row, *row_x;
    /* After the event; NULL: unchanged. KICK and STEP: v NULL: that of the end of the step, where the closing kick
     * waits; the slope then is that of the end as well. STEP and TAYLOR: the slope is that of the start, and not told
     * again. */
    const double *x, *v, *a;
    const double *before_x, *before_a; /* of the step before, in recurrences */
} trace_event;

typedef struct tracer {
    void *ctx;
    void (*see)(void *ctx, const trace_event *);
    double *x, *v; /* room for nx and nv numbers */
} tracer;

/* The most that one step can tell: events, arrays like x and like v in them, and numbers in the rows of stages. */
typedef struct trace_room {
    size_t events, x, v, rows;
} trace_room;
struct stepper;
trace_room trace_room_of(const struct stepper *);

#endif
