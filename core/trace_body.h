/* The stepper's body that tells: core/trace_body.c, and what it finds through the workspace while it does. */
#ifndef CORE_TRACE_BODY_H
#define CORE_TRACE_BODY_H

#include "core/stepper_body.h"
#include "core/trace.h"

typedef struct tracing {
    const tracer *to;
    int64_t iterations; /* before the step */
} tracing;

extern const stepper_body trace_body;
/* Before the step: keeps what the step will have overwritten when it is told. */
void trace_begin(work *);

#endif
