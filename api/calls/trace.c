/* The trace of one step: the events that the stepper reports, kept as entries with their numbers in the outside order.
 *
 * Invariant: all memory is taken before the step, for the most events that the row can report, so without memory the
 * run is unchanged. An entry shares the numbers that its event does not change with the entry before it.
 */
#include "api/why/diagnosis.h"
#include "api/motion/run.h"

#include <math.h>
#include <string.h>

typedef struct trace {
    motus_system *system;
    double step;
    size_t count;
    motus_trace_entry *entry;
    const motus_trace_entry **list; /* pointers to the entries, for the caller */
    double *next;                   /* the unused room for numbers */
    /* Of an adaptive method: entries that stay when another candidate begins, the unused room after them and before the
     * last of them, and the error of the candidate. */
    size_t kept;
    double *first, *before;
    double error;
} trace;

/* The entries START and END; the closing kick and the step of a recurrence share their numbers. */
enum { TRACE_ENDS = 2 };

static trace *make(motus_run *r)
{
    const motus_system *s = r->system;
    const trace_room room = trace_room_of(r->stepper);
    const size_t refused = row_adaptive(&r->chosen) ? MOTUS_REFUSED_MAX : 0;
    const size_t events = room.events + TRACE_ENDS + refused;
    const uint64_t numbers = (uint64_t)(room.x + TRACE_ENDS + refused) * s->positions +
                             (uint64_t)(room.v + 2 * TRACE_ENDS + refused) * s->velocities + room.rows;
    const uint64_t bytes =
        sizeof(trace) + events * (sizeof(motus_trace_entry) + sizeof(motus_trace_entry *)) + numbers * sizeof(double);
    if (!r->trace && bytes <= SIZE_MAX) r->trace = take(&r->allocator, 1, (size_t)bytes);
    trace *t = r->trace;
    if (!t) return NULL;
    t->entry = (motus_trace_entry *)(t + 1);
    t->next = (double *)(t->entry + events);
    t->list = (const motus_trace_entry **)(t->next + numbers);
    for (size_t k = 0; k < events; k++) t->list[k] = &t->entry[k];
    t->system = r->system;
    t->count = 0;
    return t;
}

static const double *keep_x(trace *t, const double *x)
{
    double *out = t->next;
    t->next += t->system->positions;
    system_outside(t->system, x, NULL, out, NULL);
    return out;
}

static const double *keep_v(trace *t, const double *v)
{
    double *out = t->next;
    t->next += t->system->velocities;
    system_outside(t->system, NULL, v, NULL, out);
    return out;
}

static const double *keep_row(trace *t, const double *row, int stages)
{
    double *out = t->next;
    t->next += stages;
    memcpy(out, row, (size_t)stages * sizeof *row);
    return out;
}

static void see(void *ctx, const trace_event *e)
{
    trace *t = ctx;
    const motus_trace_entry *start = t->entry, *last = &t->entry[t->count - 1];
    const bool recurrence = e->kind == MOTUS_TRACE_STEP || e->kind == MOTUS_TRACE_TAYLOR;
    motus_trace_entry *out = &t->entry[t->count++];
    *out = (motus_trace_entry){.kind = e->kind,
                               .stage = e->stage,
                               .stages = e->stages,
                               .iterations = e->iterations,
                               .time = e->time,
                               .step = t->step,
                               .coefficient = e->coefficient,
                               .weight = e->weight,
                               .weight_x = e->weight_x,
                               .x = last->x,
                               .v = last->v,
                               .error = NAN};
    if (last->kind == MOTUS_TRACE_REFUSED) out->x = start->x, out->v = start->v;
    if (e->row) {
        out->row = keep_row(t, e->row, e->stages);
        out->row_x = keep_row(t, e->row_x, e->stages);
    }
    if (e->x) out->x = keep_x(t, e->x);
    if (e->v)
        out->v = keep_v(t, e->v);
    else if (recurrence || e->kind == MOTUS_TRACE_KICK)
        out->v = NULL; /* `complete` fills it in */
    if (e->a)
        out->a = keep_v(t, e->a);
    else if (recurrence)
        out->a = start->a;
    if (e->before_x) out->before_x = keep_x(t, e->before_x);
    if (e->before_a) out->before_a = keep_v(t, e->before_a);
}

/* Forgets the entries of a candidate that was refused. */
static void again(void *ctx, double h)
{
    trace *t = ctx;
    t->count = t->kept;
    t->next = t->first;
    t->step = t->entry->step = h;
}

/* Keeps a refused candidate as one entry. */
static void judged(void *ctx, double h, double error, const double *x, const double *v)
{
    trace *t = ctx;
    const motus_trace_entry *start = t->entry;
    t->error = error;
    t->step = t->entry->step = h;
    if (error <= 1) return;
    t->next = t->kept > MOTUS_REFUSED_MAX ? t->before : t->first;
    if (t->kept > MOTUS_REFUSED_MAX) t->kept--;
    t->before = t->next;
    motus_trace_entry *out = &t->entry[t->kept++];
    *out = (motus_trace_entry){.kind = MOTUS_TRACE_REFUSED, .time = start->time + t->step, .step = t->step};
    out->error = error;
    out->x = x ? keep_x(t, x) : start->x;
    out->v = v ? keep_v(t, v) : start->v;
    t->first = t->next;
}

/* Adds an entry with the present state; without the acceleration if it cannot be evaluated, since the method may not
 * need it here. */
static motus_status observe(motus_run *r, motus_trace_kind kind, motus_error *err)
{
    trace *t = r->trace;
    bool with_a = run_sync(r, true, NULL) == MOTUS_OK;
    motus_status status = with_a ? MOTUS_OK : run_sync(r, false, err);
    if (status != MOTUS_OK) return status;
    t->entry[t->count++] = (motus_trace_entry){.kind = kind,
                                               .time = stepper_time(r->stepper),
                                               .step = t->step,
                                               .x = keep_x(t, r->x),
                                               .v = keep_v(t, r->v),
                                               .a = with_a ? keep_v(t, r->a) : NULL,
                                               .error = t->error};
    return MOTUS_OK;
}

/* Fills in what is known only after the step: the final velocity, the number of stages, the iterations. */
static void complete(trace *t)
{
    motus_trace_entry *end = &t->entry[t->count - 1];
    const motus_trace_entry *last = end - 1;
    end->iterations = last->iterations;
    for (motus_trace_entry *e = t->entry; e <= end; e++) {
        e->stages = last->stages;
        if (e->v) continue;
        e->v = end->v;
        if (!e->a) e->a = end->a;
    }
}

static motus_status walk(motus_run *r, motus_error *err)
{
    trace *t = make(r);
    if (!t) return fail(err, MOTUS_MEMORY, "no memory for the trace of the step");
    /* for an adaptive step `again` sets the size */
    t->step = run_steps(r) < r->timing.whole ? r->timing.h : r->timing.last;
    t->error = NAN;
    motus_status status = observe(r, MOTUS_TRACE_START, err);
    t->first = t->next;
    t->kept = t->count;
    if (status == MOTUS_OK)
        status = stepper_trace(
            r->stepper, r->timing.until,
            &(tracer){.ctx = t, .see = see, .again = again, .judged = judged, .x = r->mid_x, .v = r->mid_v}, err);
    if (status != MOTUS_OK) diagnosis_add(&r->diagnosed, r->stepper, err);
    if (status == MOTUS_OK) status = run_moved(r, err);
    if (status == MOTUS_OK) status = observe(r, MOTUS_TRACE_END, err);
    if (status == MOTUS_OK) complete(t);
    return status;
}

motus_status motus_run_trace(motus_run *r, const motus_trace_entry *const **entries, size_t *count, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!r || !entries || !count)
        return fail(err, MOTUS_ARGUMENT, "motus_run_trace needs a run and places for the entries and their number");
    if (r->observing) return run_refuse_move(err);
    if (run_refuse(r, "traced", err) != MOTUS_OK) return MOTUS_UNAVAILABLE;
    if (system_located(r->system)) {
        fail(err, MOTUS_UNAVAILABLE, "a run whose steps end at switches cannot be traced");
        hint(err, "leave `switches` of the definition at MOTUS_SWITCHES_STEP, so that steps lead across");
        return MOTUS_UNAVAILABLE;
    }
    if (r->events) {
        fail(err, MOTUS_UNAVAILABLE, "a run with events cannot be traced: a step with events is several of the method");
        hint(err, "trace a run of the equations without events that motus_run_set_state sets to the same state");
        return MOTUS_UNAVAILABLE;
    }

    *entries = NULL;
    *count = 0;
    if (r->arrived) return MOTUS_OK;
    modes m = modes_enter();
    motus_status status = walk(r, err);
    modes_leave(m);
    if (status != MOTUS_OK) return status;
    *entries = r->trace->list;
    *count = r->trace->count;
    return MOTUS_OK;
}
