/* The texts of step/ with a TRACE that reports events: the body of a stepper for a traced step.
 *
 * Invariant: the operations on the state are the texts' own. The numbers of an event are read from the workspace after
 * each stage, or computed in the tracer's room and in arrays that no later operation reads. This file has no formula of
 * a step.
 */
#include "core/stepper_parts.h"

#define TRACING
static const tracer *tracer_of(const work *w) { return w->services->tracing->to; }
static inline void family_trace(work *, int i);
#undef TRACE
#define TRACE(w, i) ((w)->services->tracing ? trace_at(w, i) : (void)0)
static void judged(const work *w);
static inline void trace_at(work *w, int i)
{
    if (i == TRACE_CANDIDATE)
        tracer_of(w)->again(tracer_of(w)->ctx, w->h);
    else if (i == TRACE_JUDGED)
        judged(w);
    else
        family_trace(w, i);
}

/* Reports the candidate with the state to which it leads, which rows that find their own sizes have not before they
 * accept. */
static void judged(const work *w)
{
    const tracer *to = tracer_of(w);
    for (size_t k = 0; w->dx && k < w->nx; k++) to->x[k] = w->x[k] + w->dx[k];
    for (size_t k = 0; w->dv && k < w->nv; k++) to->v[k] = w->v[k] + w->dv[k];
    to->judged(to->ctx, w->h, w->error, w->dx ? to->x : NULL, w->dv ? to->v : NULL);
}

static void tell(const work *w, trace_event e)
{
    const tracing *in = w->services->tracing;
    e.stages = w->stages;
    e.iterations = w->iterations - in->iterations;
    in->to->see(in->to->ctx, &e);
}

#include "core/stepper_host.h"

void trace_begin(work *w)
{
    if (!FIRST(w)) family_trace(w, -1);
}

trace_room trace_room_of(const stepper *s) { return family_room(&s->work); }

const stepper_body trace_body = STEPPER_BODY("trace");
