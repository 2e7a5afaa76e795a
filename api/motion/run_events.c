/* Events of a run. See run_events.h. */
#include "api/motion/run_events.h"

/* Prepares events for what the run may be asked for. */
static void expect(const motus_run *r, events *e)
{
    events_may_save(e);
    events_doubted(e, r->company != NULL);
}

motus_status run_events_begin(motus_run *r, motus_error *err)
{
    motus_status status = system_rules(r->system, &r->rules, err);
    if (status != MOTUS_OK || !r->rules) return status;
    if (r->locate) return fail(err, MOTUS_UNAVAILABLE, "a run with events cannot resolve switches");
    if (!r->events) status = events_create(r->rules, &r->machine, &r->chosen, &r->allocator, &r->events, err);
    if (status == MOTUS_OK) expect(r, r->events);
    return status == MOTUS_OK ? events_begin(r->events, r->stepper, r->timing.until, err) : status;
}

static int asks(const void *ctx)
{
    const pace *p = ctx;
    return p->tell(p->ctx, pace_now());
}

motus_status run_events_steps(events *e, stepper *s, const pace *p, int64_t n, double until, stepper_stop *why,
                              motus_error *err)
{
    enum { LOOK = 16 }; /* steps between two looks at the clock */
    const int64_t began = events_steps(e);
    int64_t look = 0;
    motus_status status = MOTUS_OK;
    events_listen(e, p->tell ? asks : NULL, p);
    for (int64_t i = 0; i < n && status == MOTUS_OK && *why == STOP_STEPS; i = events_steps(e) - began) {
        if (p->tell && i >= look) {
            if (p->tell(p->ctx, pace_now())) return MOTUS_CANCELLED;
            look = i + LOOK;
        }
        const int64_t room = p->tell && look < n ? look - i : n - i;
        status = events_go(e, s, until, room, why, err);
    }
    if (status != MOTUS_OK) *why = STOP_FAILED;
    return status;
}

motus_status run_events_advance(motus_run *r, int64_t n, stepper_stop *why, motus_error *err)
{
    *why = r->arrived ? STOP_UNTIL : STOP_STEPS;
    return run_events_steps(r->events, r->stepper, &r->pace, n, r->timing.until, why, err);
}

int64_t run_events_turns(const motus_run *r) { return r->events ? events_turns(r->events) : 0; }

void run_events_statistics(const motus_run *r, motus_run_statistics *out)
{
    size_t rule;
    if (!r->events) return;
    out->events_unseen = events_unseen(r->events, &rule, &out->events_unseen_from);
    if (out->events_unseen) out->events_unseen_of = r->rules->rule[rule].name;
    out->events_held = (int64_t)events_held(r->events, &rule);
    if (out->events_held) out->events_held_of = r->rules->rule[rule].name;
}

int64_t run_events_acted(const motus_run *r) { return r->events ? events_acted(r->events) : 0; }

bool run_events_ended(const motus_run *r) { return r->events && events_ended(r->events, NULL) != EVENTS_END_NONE; }

motus_status run_events_sample(motus_run *r, double t, double *x, double *v, motus_error *err)
{
    return events_sample(r->events, r->stepper, t, x, v, err);
}

/* ---- restart ---- */

motus_status run_events_load(motus_run *r, stepper_count then, const double *carry, const double *numbers, size_t count,
                             motus_error *err)
{
    const timing *t = &r->timing;
    const events_leg leg = {t->t0, t->h, t->until, then, carry};
    events *fresh = NULL;
    motus_status status = events_again(r->events, &fresh, err);
    if (status == MOTUS_OK) status = events_load(fresh, r->stepper, &leg, numbers, count, err);
    if (status == MOTUS_OK && (events_time(fresh) - t->until) * t->h > 0)
        status = run_refuse_beyond(r, events_time(fresh), err);
    if (status == MOTUS_OK) status = events_load_stepper(fresh, r->stepper, &leg, err);
    events_destroy(status == MOTUS_OK ? r->events : fresh);
    if (status != MOTUS_OK) return status;
    r->events = fresh;
    expect(r, fresh);
    return MOTUS_OK;
}

void run_events_row(const rules *rules, const event *row, double error, motus_event_row *out)
{
    motus_event_row ours = motus_default_event_row();
    ours.name = rules->rule[row->rule].name;
    ours.count = row->count;
    ours.time = row->t;
    ours.touched = row->touched;
    ours.changed = row->changed;
    ours.error = error;
    rules->name(rules->ctx, row->rule, row->instance, ours.instance, sizeof ours.instance);
    motus_struct_write(MOTUS_DEF_EVENT_ROW, &ours, out);
}
