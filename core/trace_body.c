/* The texts of step/ with a TRACE that tells what happens: the body that a stepper borrows for one step.
 *
 * Invariant: the operations on the state are the texts' own; what is told besides is read off their workspace after each stage, or formed
 * in the tracer's room and in arrays that no later operation reads. No formula of a step stands here.
 */
#include "core/trace_body.h"

static const tracing *tracing_of(const work *w) { return ((const stepper_host *)w->user)->tracing; }
static void trace_stage(work *, int i);
#undef TRACE
#define TRACE(w, i) (tracing_of(w) ? trace_stage(w, i) : (void)0)

#include "core/stepper_texts.h"

_Static_assert((int)STAGES_MAX <= (int)TRACE_ROW_MAX, "a row of a tableau is told whole");

static void tell(const work *w, trace_event e)
{
    const tracing *in = tracing_of(w);
    e.stages = w->row->family == TWO_STEP ? 1 : w->stages;
    e.iterations = w->iterations - in->iterations;
    in->to->see(in->to->ctx, &e);
}

/* The two-step methods hold only the increment, or move the arrays on: the positions before these. */
void trace_begin(const work *w)
{
    double *before = tracing_of(w)->to->x;
    if (w->row->family != TWO_STEP || w->row->two_step == BEEMAN || w->n == 0) return;
    const bool literal = w->row->two_step == VERLET_LITERAL;
    EACH(k) before[k] = literal ? w->old[k] : w->x[k] - w->v[k];
}

/* Kick and drift may have been made in one pass: who sees the kick without positions knows that they still are what they were. */
static void tell_splitting(const work *w, int i)
{
    const tracing *in = tracing_of(w);
    const int last = w->stages - 1;
    if (w->kicks >> i & 1) {
        const real *a = w->a;
        if (w->row->gyroscopic) {                      /* the slope that solves the implicit kick: the increment is b h a */
            EACHV(k) in->to->v[k] = w->delta[k] / w->kick[i];
            a = in->to->v;
        }
        tell(w, (trace_event){.kind = MOTUS_EVENT_KICK, .stage = i + 1, .time = time_in(w, w->c[i]), .coefficient = in->unit.kick[i], .v = w->v, .a = a});
    }
    if (w->drifts >> i & 1)
        tell(w, (trace_event){.kind = MOTUS_EVENT_DRIFT, .stage = i + 1, .time = time_in(w, i < last ? w->c[i + 1] : 1), .coefficient = in->unit.drift[i],
                              .x = w->x});
    if (w->merged && i == last - 1)
        tell(w, (trace_event){.kind = MOTUS_EVENT_KICK, .stage = last + 1, .time = time_in(w, 1), .coefficient = in->unit.kick[last]});
}

static void tell_tableau(const work *w, int i, const real *X, const real *V, const real *A)
{
    const work *unit = &tracing_of(w)->unit;
    tell(w, (trace_event){.kind = MOTUS_EVENT_STAGE, .stage = i + 1, .time = time_in(w, w->c[i]), .coefficient = unit->c[i], .weight = unit->hb[i],
                          .weight_x = unit->hhb[i], .row = unit->ha[i], .row_x = unit->hha[i], .x = X, .v = V, .a = A});
}

static void tell_two_step(const work *w)
{
    const tracer *to = tracing_of(w)->to;
    const bool first = w->n == 0;
    trace_event e = {.kind = MOTUS_EVENT_STEP, .stage = 1, .time = time_of(w, w->n), .coefficient = 1, .x = w->x};
    if (w->row->two_step == BEEMAN) {
        e.before_a = w->a;                             /* its array is free for the next acceleration */
    } else {
        if (w->row->two_step == VERLET_LITERAL) EACHV(k) to->v[k] = (w->x[k] - w->old[k]) * w->per_h;
        else EACHV(k) to->v[k] = w->v[k] * w->per_h;
        e.v = to->v;
        e.before_x = first ? NULL : to->x;
        e.kind = first ? MOTUS_EVENT_TAYLOR : MOTUS_EVENT_STEP;
    }
    tell(w, e);
}

static void trace_stage(work *w, int i)
{
    const size_t stage = (size_t)i * w->stride;
    switch (w->row->family) {
    case SPLITTING: tell_splitting(w, i); break;
    case RUNGE_KUTTA: tell_tableau(w, i, w->xs, w->vs + stage, w->ks + stage); break;
    case TWO_STEP: tell_two_step(w); break;
    case IMPLICIT:
        tell(w, (trace_event){.kind = MOTUS_EVENT_SOLVE, .time = time_of(w, w->n)});
        for (int j = 0; j < w->stages; j++) {
            implicit_stage(w, j);
            tell_tableau(w, j, w->xs, w->vs, w->ks + (size_t)j * w->stride);
        }
        break;
    case EXACT: break;
    }
}

trace_room trace_room_of(const problem *p, const chosen *method)
{
    const work unit = stepper_plan(p, method, 0, 1);
    trace_room room = {0};
    switch (unit.row->family) {
    case SPLITTING:
        for (int i = 0; i < unit.stages; i++) {
            room.v += 2 * (unit.kicks >> i & 1);
            room.x += unit.drifts >> i & 1;
        }
        room.events = room.v / 2 + room.x;
        break;
    case TWO_STEP: room = (trace_room){.events = 1, .x = 2, .v = 2}; break;
    case RUNGE_KUTTA:
    case IMPLICIT: room = (trace_room){.events = (size_t)unit.stages + 1, .x = (size_t)unit.stages, .v = 2 * (size_t)unit.stages}; break;
    case EXACT: break;
    }
    return room;
}

const stepper_body trace_body = STEPPER_BODY("trace");
