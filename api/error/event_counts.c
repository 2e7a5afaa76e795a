/* See event_bars.h.
 *
 * A function that is nowhere 0 within the bars of the state has passed 0 as often in the exact motion as in the run.
 * Where it may be 0, the exact motion may be on its other side, so that one of them has had an event and the other has
 * not; unless the function moves against the direction that the event asks for.
 */
#include "api/error/event_bars.h"

#include "api/error/bars.h"

#include <math.h>
#include <string.h>

typedef struct look {
    motus_run *run;
    double landed; /* the time of the bars */
    double t, late;
    const double *x, *v;
    double *dx, *dv, *a;  /* half the widths of the box, and the accelerations */
    double *to_x, *to_v;  /* room for a state */
    double *size;         /* of the accelerations */
    double *g, *now;      /* values of the functions, and room for as many numbers */
    int8_t *sign, *heads; /* of the functions and of their rates along the run; 0: open */
    bool slopes;          /* `heads` is known */
    interval *box;
} look;

static double bar(void *ctx, size_t column)
{
    const look *l = ctx;
    return bars_of(l->run->bars, l->landed, column);
}

static void take_state(look *l, double part)
{
    const problem *p = &l->run->system->problem;
    for (size_t k = 0; k < p->nx; k++) l->to_x[k] = l->x[k] + part * l->dx[k];
    for (size_t k = 0; k < p->nv; k++) l->to_v[k] = l->v[k] + part * l->dv[k];
    if (p->refresh) p->refresh(p->ctx, l->t, l->to_x, l->to_v);
}

/* Makes the box of the state within its bars. Modes have no bars, and are as far off as the companion's. All is late by
 * what the times of events share and by the rounding of the run's end. */
static bool find_box(look *l)
{
    interval *const box = l->box;
    const motus_run *r = l->run;
    const problem *p = &r->system->problem;
    const size_t moving = p->nx - p->modes;
    if (!system_box(r->system, l->x, l->v, bar, l, box, box + p->nx)) return false;
    memset(l->dx, 0, p->nx * sizeof *l->dx);
    memset(l->dv, 0, p->nv * sizeof *l->dv);
    memset(l->a, 0, p->nv * sizeof *l->a);
    take_state(l, 0);
    if (p->accel(p->ctx, l->t, l->to_x, l->to_v, l->a)) return false;
    for (size_t k = 0; k < moving; k++)
        l->dx[k] = (box[k].high - box[k].low) / 2 + l->late * fabs(l->v[k]) + events_ulp(l->x[k]);
    for (size_t k = moving; k < p->nx; k++) l->dx[k] = bars_part(r) * fabs(l->x[k] - r->bars->half.x[k]);
    for (size_t k = 0; k < p->nv; k++) {
        const interval *in = &box[p->nx + k];
        l->dv[k] = (in->high - in->low) / 2 + l->late * fabs(l->a[k]) + events_ulp(l->v[k]);
        l->size[k] = fabs(l->a[k]);
    }
    return true;
}

/* Returns whether the box leaves the sign of function f open. least: a lower bound on its size, if above 0. */
static bool is_open(const look *l, size_t f, double least)
{
    const rules *rules = l->run->rules;
    const double t[2] = {l->t - l->late, l->t + l->late};
    if (least > 0 || isnan(l->g[f]) || events_settled(l->run->events, f)) return false;
    return !rules->apart || !rules->apart(rules->ctx, f, false, t, l->to_x, l->to_v, l->dx, l->dv, l->size);
}

/* Finds the signs of the functions. Returns whether the box leaves any open. */
static bool find_signs(look *l)
{
    const rules *rules = l->run->rules;
    const bool bounded = rules->least && !l->run->system->problem.refresh;
    bool any = false;
    if (bounded) rules->least(rules->ctx, l->to_x, l->to_v, l->dx, l->dv, l->now);
    for (size_t f = 0; f < rules->functions; f++) {
        const bool open = is_open(l, f, bounded ? l->now[f] : 0);
        l->sign[f] = (int8_t)(open ? 0 : (l->g[f] > 0) - (l->g[f] < 0));
        any |= open;
    }
    return any;
}

/* Finds the directions in which functions go along the run, if their rates in the middle and at corners agree. */
static bool find_slopes(look *l)
{
    const motus_run *r = l->run;
    const rules *rules = r->rules;
    const problem *p = &r->system->problem;
    const double way = r->timing.h < 0 ? -1 : 1;
    if (l->slopes) return true;
    memset(l->heads, 0, rules->functions);
    if (!rules->rates) return true;
    for (int turn = -1; turn <= 1; turn++) {
        take_state(l, turn);
        if (p->accel(p->ctx, l->t, l->to_x, l->to_v, l->a)) return true;
        if (rules->rates(rules->ctx, l->t, l->to_x, l->to_v, l->a, l->now)) return false;
        for (size_t f = 0; f < rules->functions; f++) {
            const int8_t heads = (int8_t)((way * l->now[f] > 0) - (way * l->now[f] < 0));
            l->heads[f] = turn < 0 || l->heads[f] == heads ? heads : 0;
        }
    }
    return l->slopes = true;
}

/* Returns whether an event may happen where function f, of instance i of a rule, passes 0 or touches it. */
static bool may_happen(look *l, const rule *r, size_t i, size_t f)
{
    const int heads = l->heads[f];
    if (r->kind == RULE_ROOT) return !r->direction || !heads || heads == r->direction;
    bool holds[3];
    for (int sign = -1; sign <= 1; sign++) {
        l->sign[f] = (int8_t)sign;
        holds[sign + 1] = rules_hold(r, i, l->sign);
    }
    l->sign[f] = 0;
    if (!heads) return holds[0] != holds[1] || holds[1] != holds[2];
    const bool before = holds[1 - heads], after = holds[1 + heads];
    return !before && (holds[1] || after);
}

static bool instance_open(look *l, const rule *r, size_t i)
{
    size_t open = 0, which = 0;
    for (size_t k = 0; k < r->leaves; k++) {
        const size_t f = r->first + k * r->instances + i;
        if (l->sign[f] == 0 && is_open(l, f, 0)) open++, which = f;
    }
    if (open == 0) return false;
    if (!find_slopes(l)) return true;
    return open > 1 || may_happen(l, r, i, which);
}

/* Returns whether the number of any events is uncertain. Events that accumulate have no number, and make no other
 * uncertain. */
static bool any_open(look *l)
{
    const rules *rules = l->run->rules;
    events_limit limit = {.rule = SIZE_MAX};
    events_accumulated(l->run->events, &limit);
    if (!find_signs(l)) return false;
    for (size_t k = 0; k < rules->count; k++) {
        const rule *r = &rules->rule[k];
        if (r->internal || (r->kind != RULE_ROOT && r->kind != RULE_CONDITION) || k == limit.rule) continue;
        for (size_t i = 0; i < r->instances; i++)
            if (instance_open(l, r, i)) return true;
    }
    return false;
}

/* Makes room for a look, which `finish` gives back. False: no memory. */
static bool begin(look *l, motus_run *r, double landed)
{
    const problem *p = &r->system->problem;
    const size_t nx = p->nx, nv = p->nv, n = r->rules->functions;
    interval *const box = take(&r->allocator, nx + nv + 1, sizeof *box);
    double *const room = take(&r->allocator, 2 * nx + 4 * nv + 3 * n + 1, sizeof *room);
    *l = (look){.run = r, .landed = landed, .late = bars_late(r, landed), .dx = room, .box = box};
    if (!room || !box) return false;
    l->dv = l->dx + nx, l->to_x = l->dv + nv, l->to_v = l->to_x + nx, l->a = l->to_v + nv, l->size = l->a + nv;
    l->g = l->size + nv, l->now = l->g + n;
    l->sign = (int8_t *)(void *)(l->now + n), l->heads = l->sign + n;
    return true;
}

static motus_status finish(look *l, bool memory, motus_error *err)
{
    const motus_allocator *const a = &l->run->allocator;
    give(a, l->dx);
    give(a, l->box);
    return memory ? MOTUS_OK : fail(err, MOTUS_MEMORY, "no memory for bars of error");
}

/* Looks at the box and the functions around a state. */
static bool look_at(look *l, double t, const double *x, const double *v)
{
    const rules *rules = l->run->rules;
    l->t = t, l->x = x, l->v = v, l->slopes = false;
    return find_box(l) && !rules->values(rules->ctx, t, l->to_x, l->to_v, l->g);
}

/* Returns whether a touch up to t has made it uncertain how often events have happened. */
static bool open_before(const motus_run *r, double t)
{
    const double way = r->timing.h < 0 ? -1 : 1;
    events_limit limit = {.rule = SIZE_MAX};
    events_accumulated(r->events, &limit);
    for (size_t k = 0; k < r->rules->count; k++)
        if (k != limit.rule && way * (t - event_counts_since(r->bars, k)) >= 0) return true;
    return false;
}

motus_status event_counts_open(motus_run *r, double t, const double *x, const double *v, bool *open, motus_error *err)
{
    look l;
    *open = open_before(r, t);
    /* a condition that already holds at the start is no event */
    if (*open || r->rules->functions == 0 || t == r->timing.t0) return MOTUS_OK;
    const bool memory = begin(&l, r, t);
    if (memory) *open = !look_at(&l, t, x, v) || any_open(&l);
    return finish(&l, memory, err);
}

/* Returns whether a function that is 0 where the motion rests is 0 wherever it rests: then positions have no part in
 * it, since a velocity at rest is exactly 0. */
static bool rests(look *l, size_t f)
{
    const rules *rules = l->run->rules;
    for (size_t k = 0; k < l->run->system->problem.nv; k++)
        if (l->v[k] == 0) l->dv[k] = 0;
    for (int turn = -1; turn <= 1; turn++) {
        take_state(l, turn);
        if (rules->values(rules->ctx, l->t, l->to_x, l->to_v, l->now) || l->now[f] != 0) return false;
    }
    return true;
}

/* Returns whether the rule of function f may have an event, or two, where the function has an extremum or a step ends.
 * At an extremum its direction is not known, whatever rounding leaves of its slope; at the end of a step only if its
 * slope may be 0. */
static bool touches(look *l, size_t f, events_near_kind kind)
{
    const bool level = kind == EVENTS_NEAR_EXTREMUM;
    if (kind == EVENTS_NEAR_REST) return !rests(l, f);
    const rules *rules = l->run->rules;
    const rule *r = &rules->rule[events_rule_of(l->run->events, f)];
    find_signs(l);
    if (l->sign[f] != 0 || !is_open(l, f, 0)) return false;
    if (!level && !find_slopes(l)) return true;
    if (level) l->heads[f] = 0;
    return l->heads[f] == 0 && may_happen(l, r, (f - r->first) % r->instances, f);
}

/* Widens the box, since between two landings an error may be as large as at either. */
static void widen(look *l)
{
    const problem *p = &l->run->system->problem;
    for (size_t k = 0; k < p->nx; k++) l->dx[k] = fmax(l->dx[k], events_off(l->run->events, k));
    for (size_t k = 0; k < p->nv; k++) l->dv[k] = fmax(l->dv[k], events_off(l->run->events, p->nx + k));
}

double event_counts_since(const bars *b, size_t k) { return b->open_since ? b->open_since[k] : NAN; }

bool event_counts_note(motus_run *r, size_t k, double t)
{
    bars *b = r->bars;
    const double way = r->timing.h < 0 ? -1 : 1;
    if (!b->open_since) {
        b->open_since = take(&r->allocator, r->rules->count, sizeof *b->open_since);
        for (size_t i = 0; b->open_since && i < r->rules->count; i++) b->open_since[i] = NAN;
    }
    if (b->open_since && !(way * (t - b->open_since[k]) >= 0)) b->open_since[k] = t;
    return b->open_since;
}

/* Notes rules with extrema that were not kept. */
static bool note_unkept(motus_run *r)
{
    bool memory = true;
    for (size_t k = 0; memory && k < r->rules->count; k++) {
        const double since = events_unkept(r->events, k);
        if (!isnan(since)) memory = event_counts_note(r, k, since);
    }
    return memory;
}

motus_status event_counts_touched(motus_run *r, double t, const double *x, const double *v, motus_error *err)
{
    look l;
    if (r->rules->functions == 0) return MOTUS_OK;
    bool memory = begin(&l, r, t) && note_unkept(r);
    for (size_t k = 0; memory && k < events_extrema(r->events); k++) {
        const double *at_x, *at_v;
        double at;
        events_near_kind kind;
        const size_t f = events_extremum(r->events, k, &kind, &at, &at_x, &at_v);
        if (!look_at(&l, at, at_x, at_v)) continue;
        widen(&l);
        if (touches(&l, f, kind)) memory = event_counts_note(r, events_rule_of(r->events, f), at);
    }
    if (memory && look_at(&l, t, x, v)) memory = events_near(r->events, l.dx);
    return finish(&l, memory, err);
}
