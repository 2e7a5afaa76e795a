/* Events of a run. See run_events.h. */
#include "api/run_events.h"

#include "api/event_bars.h"

#include <math.h>
#include <string.h>

motus_status run_events_begin(motus_run *r, motus_error *err)
{
    motus_status status = system_rules(r->system, &r->rules, err);
    if (status != MOTUS_OK || !r->rules) return status;
    if (r->locate)
        return fail(err, MOTUS_UNAVAILABLE,
                    "a run with events cannot resolve switches, nor locate those beyond which the force may be "
                    "undefined by steps of one size");
    if (!r->events) status = events_create(r->rules, &r->machine, &r->chosen, &r->allocator, &r->events, err);
    if (status == MOTUS_OK) events_may_save(r->events);
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

void run_events_statistics(const motus_run *r, motus_statistics *out)
{
    size_t rule;
    if (!r->events) return;
    out->events_unseen = events_unseen(r->events, &rule, &out->events_unseen_from);
    if (out->events_unseen) out->events_unseen_of = r->rules->rule[rule].name;
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
    events_may_save(fresh);
    return MOTUS_OK;
}

/* ---- the table ---- */

int64_t motus_run_events(const motus_run *r) { return r && r->events ? (int64_t)events_rows(r->events) : 0; }

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

motus_status motus_run_event(motus_run *r, int64_t k, motus_event_row *out)
{
    if (!r || !out || k < 0 || k >= motus_run_events(r) ||
        motus_struct_check(MOTUS_DEF_EVENT_ROW, out, NULL) != MOTUS_OK)
        return MOTUS_ARGUMENT;
    const modes m = modes_enter();
    const event row = events_row(r->events, (size_t)k, false, NULL, NULL);
    run_events_row(r->rules, &row, event_bars_time(r, (size_t)k), out);
    modes_leave(m);
    return MOTUS_OK;
}

motus_status motus_run_event_values(motus_run *r, int64_t k, int after, const size_t *columns, size_t count,
                                    double *out, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!r || k < 0 || k >= motus_run_events(r) || (count && (!columns || !out)))
        return fail(err, MOTUS_ARGUMENT,
                    "motus_run_event_values needs a run, the number of an event, columns and a "
                    "place for the values");
    const double *x, *v;
    const modes m = modes_enter();
    const event row = events_row(r->events, (size_t)k, after != 0, &x, &v);
    const motus_status status = system_values_of(r->system, row.t, x, v, r->mid_x, columns, count, out, err);
    modes_leave(m);
    return status;
}

void motus_run_keep_jumps(motus_run *r, int keep)
{
    if (r && r->events) events_keep_jumps(r->events, keep != 0);
}

int64_t motus_run_jumps(const motus_run *r) { return r && r->events ? (int64_t)events_jumps(r->events) : 0; }

motus_status motus_run_jump(motus_run *r, int64_t k, int after, const size_t *columns, size_t count, double *time,
                            int *moves, double *out, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!r || k < 0 || k >= motus_run_jumps(r) || !time || (count && (!columns || !out)))
        return fail(err, MOTUS_ARGUMENT,
                    "motus_run_jump needs a run, the number of an action that is kept, a place for its time, columns "
                    "and a place for the values");
    const double *sides[2];
    const modes m = modes_enter();
    const bool assigns = events_jump(r->events, (size_t)k, time, &sides[0], &sides[1]);
    const double *const side = sides[after != 0];
    if (moves) *moves = assigns;
    const double *const v = side + r->system->problem.nx;
    const motus_status status = system_values_of(r->system, *time, side, v, r->mid_x, columns, count, out, err);
    modes_leave(m);
    return status;
}

const char *motus_run_ended(motus_run *r, int *accumulated, double *time, double *error)
{
    size_t rule = 0;
    events_limit limit = {.t = NAN, .error = NAN};
    const events_end end = r && r->events ? events_ended(r->events, &rule) : EVENTS_END_NONE;
    const bool gathers = r && r->events && events_accumulated(r->events, &limit);
    if (accumulated) *accumulated = gathers;
    if (time) *time = limit.t;
    if (error) {
        const modes m = modes_enter();
        *error = gathers ? event_bars_limit(r, &limit) : NAN;
        modes_leave(m);
    }
    return end == EVENTS_END_NONE ? "" : r->rules->rule[rule].name;
}

const char *motus_run_accumulates(const motus_run *r)
{
    events_limit limit = {0};
    return r && r->events && events_accumulated(r->events, &limit) ? r->rules->rule[limit.rule].name : "";
}
