/* The trace of a step: an event for each kick, drift and stage of the method, in their order.
 *
 * Invariant: tracing changes no bit of the step. The numbers of an event are in the inside order, and are valid until
 * `see` returns.
 */
#ifndef CORE_TRACE_H
#define CORE_TRACE_H

#include "core/methods.h"

typedef struct trace_event {
    motus_trace_kind kind;                /* but START and END, for which the caller observes the state */
    int stage, stages;                    /* from 1 */
    int64_t iterations;                   /* of the implicit equation, in this step so far */
    double time;                          /* of the acceleration; of a drift: after it */
    double coefficient, weight, weight_x; /* in units of the step, all of them exactly as in the row */
    const double *row, *row_x;
    /* After the event. NULL: unchanged. v NULL of KICK and STEP: the v and a of END, because the closing kick is not
     * made in this step. a NULL of STEP and TAYLOR: the a of START. */
    const double *x, *v, *a;
    const double *before_x, *before_a; /* of recurrences: one step before START */
} trace_event;

typedef struct tracer {
    void *ctx;
    void (*see)(void *ctx, const trace_event *);
    void (*again)(void *ctx, double h); /* a candidate of step h begins; the events of one before it count no more */
    /* its size, which the step itself may have found, its error, in units of what is allowed, and the state to which it
     * leads; NULL: not known */
    void (*judged)(void *ctx, double h, double error, const double *x, const double *v);
    double *x, *v; /* room for nx and nv numbers */
} tracer;

/* The most that one step can report: events, arrays like x and like v in them, and numbers in the rows of stages. */
typedef struct trace_room {
    size_t events, x, v, rows;
} trace_room;
struct stepper;
trace_room trace_room_of(const struct stepper *);

#endif
