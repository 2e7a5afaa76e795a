/* The stepper's body for traced steps, and the data that it finds through the workspace. */
#ifndef CORE_TRACE_BODY_H
#define CORE_TRACE_BODY_H

#include "core/stepper_body.h"
#include "core/trace.h"

typedef struct tracing {
    const tracer *to;
    int64_t iterations; /* the counter before the step */
} tracing;

extern const stepper_body trace_body;
/* Keeps, before a step, the numbers that the step overwrites and an event needs. */
void trace_begin(work *);

#endif
