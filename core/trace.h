/* The trace of a step: an event for each kick, drift and stage of the method, in their order.
 *
 * Invariant: tracing changes no bit of the step. The numbers of an event are in the stepper's own order (a caller of
 * motus.h has another) and valid until `see` returns.
 */
#ifndef CORE_TRACE_H
#define CORE_TRACE_H

#include "core/methods.h"

typedef struct trace_event {
    motus_trace_kind kind;                /* never START or END, for which the caller observes the state */
    int stage, stages;                    /* from 1 */
    int64_t iterations;                   /* of the implicit equation, in this step so far */
    double time;                          /* of the acceleration; of a drift: after it */
    double coefficient, weight, weight_x; /* in units of the step, with the digits of the row */
    const double *row, *row_x;
    /* The numbers after the event; NULL: unchanged. Of KICK and STEP, v is NULL where the closing kick belongs to the
     * next step: v and a are then those of END. Of STEP and TAYLOR, a is NULL where it is that of START. */
    const double *x, *v, *a;
    const double *before_x, *before_a; /* of recurrences: the numbers one step before START */
} trace_event;

typedef struct tracer {
    void *ctx;
    void (*see)(void *ctx, const trace_event *);
    /* Is called when a candidate of step h begins; the events of an earlier candidate no longer count. */
    void (*again)(void *ctx, double h);
    /* Takes the size of a candidate, which the step itself may have found, its error in units of what is allowed, and
     * the state to which it leads; x, v NULL: not known. */
    void (*judged)(void *ctx, double h, double error, const double *x, const double *v);
    double *x, *v; /* room for nx and nv numbers */
} tracer;

/* The most that one step can report: events, arrays of nx and of nv numbers in them, and numbers in rows of stages. */
typedef struct trace_room {
    size_t events, x, v, rows;
} trace_room;
struct stepper;
trace_room trace_room_of(const struct stepper *);

#endif
