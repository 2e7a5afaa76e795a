/* The life and the steps of events. See events.h. */
#include "core/events_parts.h"

#include <math.h>
#include <string.h>

/* Life ------------------------------------------------------------------------------------------------------------ */

static double *place(instant *i, const events *e, double *at)
{
    const size_t nx = e->problem.nx, nv = e->problem.nv, f = e->rules.functions;
    i->x = at, i->v = i->x + nx, i->a = i->v + nv;
    i->g = i->a + nv, i->rate = i->g + f, i->bound = i->rate + f;
    return i->bound + f;
}

/* A block of memory in which arrays follow one another; block NULL: their bytes are only counted. */
typedef struct layout {
    char *block;
    size_t at;
} layout;

static void *next(layout *l, size_t count, size_t size)
{
    const size_t here = l->at;
    l->at += (count * size + 15) / 16 * 16;
    return l->block ? l->block + here : NULL;
}

/* Gives every array its place in a block; returns the bytes of all. */
static size_t arrange(events *e, char *block)
{
    layout l = {block, 0};
    const size_t n = e->rules.count, f = e->rules.functions, nx = e->problem.nx, nv = e->problem.nv;
    size_t instances = 0, times = 0;
    for (size_t k = 0; k < n; k++) {
        const rule *r = &e->rules.rule[k];
        instances += r->instances + 1;
        times += (r->instances + 1) * RECENT * (size_t)recent_levels(r);
    }
    double *numbers = next(&l, 5 * (nx + 2 * nv + 3 * f), sizeof *numbers);
    e->after = next(&l, nx + nv, sizeof *e->after);
    e->width = next(&l, nx + nv, sizeof *e->width);
    e->swarm_state = next(&l, e->rules.settle ? 2 * SWARMS * (nx + nv) : 0, sizeof *e->swarm_state);
    e->most = next(&l, nx + nv, sizeof *e->most);
    e->growth_most = next(&l, GROWTH_MARKS * (nx + nv), sizeof *e->growth_most);
    e->fired = next(&l, f, sizeof *e->fired);
    e->before = next(&l, f, sizeof *e->before);
    e->instances = next(&l, n, sizeof *e->instances);
    e->recent = next(&l, instances, sizeof *e->recent);
    e->recent_t = next(&l, times, sizeof *e->recent_t);
    e->limit_off = next(&l, nx + nv, sizeof *e->limit_off);
    e->happened = next(&l, instances, sizeof *e->happened);
    e->count = next(&l, n, sizeof *e->count);
    e->ticks = next(&l, n, sizeof *e->ticks);
    e->rule_of = next(&l, f, sizeof *e->rule_of);
    e->side = next(&l, 4 * f, 1); /* one after the other, so that they are kept and restored together */
    e->was = next(&l, 4 * f, 1);
    e->sign = next(&l, f, 1);
    e->look = next(&l, f, 1);
    e->passed = next(&l, f, 1);
    e->zero = next(&l, f, 1);
    e->touched = next(&l, f, 1);
    e->arrives = next(&l, f, 1);
    e->level = next(&l, f, 1);
    e->held = next(&l, instances, 1);
    e->steady = next(&l, instances, 1);
    e->ticked = next(&l, n, 1);
    e->unkept = next(&l, n, sizeof *e->unkept);
    if (!block) return l.at;
    numbers = place(&e->left, e, numbers);
    numbers = place(&e->right, e, numbers);
    numbers = place(&e->here, e, numbers);
    numbers = place(&e->next, e, numbers);
    place(&e->best, e, numbers);
    e->stands = (uint8_t *)e->side + f;
    e->open = e->stands + f;
    e->heads = (int8_t *)e->open + f;
    return l.at;
}

static void forget_happened(events *e)
{
    for (size_t k = 0; k < e->rules.count; k++)
        for (size_t i = 0; i < e->rules.rule[k].instances; i++) e->happened[e->instances[k] + i] = NAN;
}

motus_status events_create(const rules *r, const machine *m, const chosen *method, const motus_allocator *a,
                           events **out, motus_error *err)
{
    const size_t head = (sizeof(events) + 63) / 64 * 64;
    events sizes = {.rules = *r, .problem = *m->problem};
    char *block = take(a, 1, head + arrange(&sizes, NULL));
    if (!block) return fail(err, MOTUS_MEMORY, "no memory for the events");
    events *e = (events *)(void *)block;
    *e = sizes;
    if (a) e->allocator = *a;
    e->machine = *m;
    e->method = *method;
    arrange(e, block + head);
    size_t instances = 0;
    double *times = e->recent_t;
    for (size_t k = 0; k < r->count; k++) {
        const rule *one = &r->rule[k];
        e->instances[k] = instances;
        for (size_t i = 0; i <= one->instances; i++, times += RECENT * recent_levels(one))
            e->recent[instances++].t = times;
        for (size_t f = 0; f < one->leaves * one->instances; f++) e->rule_of[one->first + f] = (uint32_t)k;
        e->clocks |= one->kind == RULE_CLOCK;
    }
    forget_happened(e);
    events_forget_extrema(e);
    *out = e;
    return MOTUS_OK;
}

motus_status events_again(const events *e, events **out, motus_error *err)
{
    return events_create(&e->rules, &e->machine, &e->method, &e->allocator, out, err);
}

void events_destroy(events *e)
{
    if (!e) return;
    const motus_allocator a = e->allocator;
    stepper_destroy(e->probe);
    give(&a, e->samples);
    give(&a, e->past);
    give(&a, e->candidate);
    give(&a, e->row);
    give(&a, e->row_at);
    give(&a, e->row_state);
    give(&a, e->kept);
    give(&a, e->kept_state);
    give(&a, e->jump);
    give(&a, e->off);
    give(&a, e->extremum);
    give(&a, e->saved);
    give(&a, e);
}

/* Start ----------------------------------------------------------------------------------------------------------- */

static motus_status observe(stepper *s, instant *to, motus_error *err)
{
    to->t = stepper_time(s);
    to->lost = stepper_lost(s);
    return stepper_sync(s, to->x, to->v, NULL, err);
}

static motus_status check_clocks(const events *e, motus_error *err)
{
    const double most = fmax(fabs(e->start), fabs(e->until));
    for (size_t k = 0; k < e->rules.count; k++) {
        const rule *r = &e->rules.rule[k];
        if (r->kind != RULE_CLOCK || (isfinite(r->period) && r->period > 8 * events_ulp(most))) continue;
        fail(err, MOTUS_ARGUMENT, "%s happens every %g, which is lost beside the time %g", r->name, r->period, most);
        hint(err, "its period is a positive number that changes the time");
        return MOTUS_ARGUMENT;
    }
    for (size_t k = 0; k < e->rules.count; k++) {
        const rule *r = &e->rules.rule[k];
        const double ticks = r->kind == RULE_CLOCK ? fabs(e->until - e->start) / r->period : 0;
        if (!(ticks > EVENTS_ROWS_MOST)) continue;
        fail(err, MOTUS_LIMIT, "%s happens every %g, which is %.2g times in this run; at most %d fit", r->name,
             r->period, ticks, EVENTS_ROWS_MOST);
        hint(err, "take a longer period, or let the run end before");
        return MOTUS_LIMIT;
    }
    return MOTUS_OK;
}

/* Sets the sides of switches at the start, and puts them into the stepper's state. */
static motus_status settle(events *e, stepper *s, motus_error *err)
{
    instant *at = &e->left;
    const motus_status status = e->rules.settle(e->rules.ctx, e->way, at->t, at->x, at->v, err);
    return status ? status : stepper_jump(s, at->t, at->lost, stepper_step(s), at->x, at->v, err);
}

/* Takes the sides of all functions from their values at `left`. */
static motus_status take_sides(events *e, motus_error *err)
{
    motus_status status = events_values(e, &e->left, err);
    if (status) return status;
    status = events_has_values(e, &e->left, err);
    if (!status) status = events_judge(e, &e->left, err);
    for (size_t f = 0; f < e->rules.functions; f++) {
        const double g = e->left.g[f];
        const bool internal = e->rules.rule[e->rule_of[f]].internal;
        e->fired[f] = NAN, e->open[f] = 0;
        e->stands[f] = isfinite(g) && fabs(g) <= e->left.bound[f];
        e->heads[f] = 0;
        e->side[f] = (int8_t)(isnan(g) ? 0 : internal ? 1 : e->stands[f] ? 0 : g > 0 ? 1 : -1);
    }
    return status;
}

motus_status events_begin(events *e, stepper *s, double until, motus_error *err)
{
    e->start = e->grid_start = stepper_time(s);
    e->grid_step = stepper_step(s);
    e->until = e->leg_end = until;
    e->way = until < e->start ? -1 : 1;
    e->steps = 0;
    e->broken = e->stopped = false;
    e->first = true;
    e->end = EVENTS_END_NONE;
    e->at_once = NAN;
    e->after_rule = SIZE_MAX;
    e->interval = INFINITY;
    events_unsave(e);
    e->turned_at = NAN;
    events_swarm_forget(e);
    e->pace = INFINITY;
    motus_status status = check_clocks(e, err);
    if (!status) status = observe(s, &e->left, err);
    if (!status && e->rules.settle) status = settle(e, s, err);
    if (!status) status = take_sides(e, err);
    if (status) return status;
    memset(e->most, 0, (e->problem.nx + e->problem.nv) * sizeof *e->most);
    e->taken = 0;
    e->pieces = 0, e->unseen = 0, e->unseen_at = NAN;
    events_may_look(e, INT64_MAX);
    memset(e->passed, 0, e->rules.functions);
    events_suppose(e);
    forget_happened(e);
    return status || events_keep_now(e, e->start, e->left.x) ? status
                                                             : fail(err, MOTUS_MEMORY, "no memory for the events");
}

/* Steps ----------------------------------------------------------------------------------------------------------- */

/* Tells whether a candidate belongs to an event that has happened already. */
static bool told(const events *e, const candidate *c)
{
    const double t = e->left.t + c->at, near = 4 * events_ulp(t);
    if (c->kind == CANDIDATE_TIME) return e->way * (events_tick(e, c->of) - t) > near;
    return fabs(e->fired[c->of] - t) <= near;
}

/* Goes on from an instant with step h, or with a unit of the time where the step is too short to change it. */
static motus_status jump(const events *e, stepper *s, const instant *to, double h, motus_error *err)
{
    if (to->t + h == to->t) h = e->way * events_ulp(to->t);
    return stepper_go_on(s, to->t, to->lost, h, to->x, to->v, err);
}

static motus_status restart(events *e, stepper *s, double h, motus_error *err) { return jump(e, s, &e->here, h, err); }

enum { PAST_HEAD = 3 };

/* Keeps where the piece that led to an action at time `end` began, for dense output. False: no memory. */
static bool keep_past(events *e, double end)
{
    const size_t nx = e->problem.nx, nv = e->problem.nv, each = PAST_HEAD + nx + nv;
    void *past = e->past;
    if (!events_grow(&e->allocator, &past, e->pasts, &e->past_room, 1, each * sizeof *e->past)) return false;
    e->past = past;
    e->past_end = end;
    double *to = e->past + e->pasts++ * each;
    to[0] = e->left.t, to[1] = e->left.lost, to[2] = (double)e->acted_left;
    memcpy(to + PAST_HEAD, e->left.x, nx * sizeof *to);
    memcpy(to + PAST_HEAD + nx, e->left.v, nv * sizeof *to);
    e->acted_left = e->acted;
    return true;
}

/* Tells whether a function that has just passed 0 stays there: it is beyond 0 at the end of the step, and has no other
 * candidate that might lead it there. */
static bool stays_beyond(const events *e, const candidate *c)
{
    for (size_t k = 0; k < e->candidates; k++) {
        const candidate *other = &e->candidate[k];
        if (!other->gone && other->kind != CANDIDATE_TIME && other->of == c->of) return false;
    }
    return e->right.g[c->of] * c->kind > 0;
}

/* Tells whether a function passes 0 again in the instant in which an action has answered its passage: its slope is 0,
 * or so small that it comes back within the rounding of the time. It would pass again however often the rule acted, so
 * its events accumulate here. */
static bool comes_back(events *e, const candidate *c)
{
    const bool passes = c->kind == CANDIDATE_FALLS || c->kind == CANDIDATE_RISES;
    if (!passes || e->side[c->of] != -(int)c->kind || (c->at != 0 && !stays_beyond(e, c))) return false;
    const size_t k = e->rule_of[c->of];
    const rule *r = &e->rules.rule[k];
    if (r->kind != RULE_ROOT || (r->direction && r->direction != (int)c->kind)) {
        e->side[c->of] = (int8_t)c->kind;
        return false;
    }
    const double near = 4 * events_ulp(e->left.t);
    if (!r->assigns || !(fabs(e->at_once - e->left.t) <= near && fabs(e->fired[c->of] - e->left.t) <= near))
        return false;
    events_end_here(e, k, c->of - r->first, e->left.t);
    return true;
}

static bool ask(events *e)
{
    enum { LOOK = 16 }; /* it asks at one chance in LOOK */
    if (e->asks && ++e->asked % LOOK == 0) e->cancelled = e->asks(e->asks_ctx) != 0;
    return e->cancelled;
}

/* Ends the step at `here` where the caller cancels among its events; the next step finds the later events. */
static motus_status cancelled(events *e, bool *is, motus_error *err)
{
    *is = ask(e);
    const motus_status status = *is ? events_complete(e, err) : MOTUS_OK;
    if (*is && !status) events_stand(e);
    return status;
}

/* Ends the step where it began if the caller cancels before an event of the step has happened. */
static bool cancelled_before(events *e)
{
    if (ask(e)) events_copy(e, &e->here, &e->left);
    return e->cancelled;
}

/* Takes over the side to which a function jumps, or that it stays at 0: neither is a root. False: it belongs to a
 * condition, which this may change. */
static bool changes_side(events *e, const candidate *c)
{
    e->side[c->of] = (int8_t)c->kind;
    if (!c->kind) e->stands[c->of] = 1;
    return e->rules.rule[e->rule_of[c->of]].kind == RULE_ROOT;
}

/* Does what happens at a located candidate of the present step. */
static motus_status follow(events *e, stepper *s, candidate *c, bool *assigned, stepper_stop *why, motus_error *err)
{
    const candidate at = *c;
    c->followed = true;
    if (at.jumps && changes_side(e, &at)) {
        c->gone = true;
        return MOTUS_OK;
    }
    bool same = false;
    if (at.kind == CANDIDATE_TOUCHES && !told(e, &at)) {
        motus_status status = events_lingered(e, &at, &same, err);
        if (!status) status = events_locate(e, (size_t)(c - e->candidate), err);
        if (status) return status;
    }
    const bool again = same || told(e, &at), back = again && comes_back(e, &at), happens = !again || back;
    c->gone = true;
    motus_status status = MOTUS_OK;
    e->doubt = e->blurred = 0;
    const bool touches = at.kind == CANDIDATE_TOUCHES, left = !touches && at.low == at.high; /* it has stood at 0 */
    if (back) status = events_unbounded(e, err);
    if (happens && !status && at.kind != CANDIDATE_TIME && !at.jumps && !left &&
        !e->rules.rule[e->rule_of[at.of]].internal)
        status = events_doubt(e, at.of, at.at, touches, &e->doubt, err);
    if (happens && !status) status = events_fire(e, &at, assigned, err);
    if (at.kind == CANDIDATE_TIME) /* a clock may tick again in this step */
        c->gone = !events_next_tick(e, at.of, c) || !(e->way * (c->at - at.at) > 0);
    if (!happens) { /* the function goes on to the side of the candidate */
        if (e->rules.settle && (at.kind == CANDIDATE_RISES || at.kind == CANDIDATE_FALLS))
            e->side[at.of] = (int8_t)at.kind;
        return MOTUS_OK;
    }
    const bool ends = !status && e->has_limit && (!e->limit_told || (back && !*assigned));
    if (ends) e->end = EVENTS_END_ACCUMULATED, e->end_rule = e->limit.rule;
    if (e->end == EVENTS_END_NONE && !status && !*assigned) status = cancelled(e, assigned, err);
    if (status || e->end == EVENTS_END_NONE) return status;
    *why = STOP_EVENT;
    if (!keep_past(e, e->here.t)) return events_no_memory(err); /* what lies before the end is sampled */
    events_copy(e, &e->left, &e->here);
    return restart(e, s, stepper_step(s), err);
}

/* Does what happens in the step from `left` to `right`. *assigned: it ended at `here`, which an action changed, or at
 * which it was cancelled. */
static motus_status go_through(events *e, stepper *s, bool *assigned, stepper_stop *why, motus_error *err)
{
    candidate *c;
    bool before = true;
    motus_status status = MOTUS_OK;
    while (!status && !*assigned && *why != STOP_EVENT && (c = events_earliest(e))) {
        if (c->idle) {
            e->side[c->of] = (int8_t)c->kind;
            c->gone = true;
            before = false;
        } else if (!c->located || c->at != e->here_at) {
            const bool was = c->located;
            const size_t number = (size_t)(c - e->candidate);
            status = events_locate(e, number, err);
            c = &e->candidate[number];
            e->here_at = c->at;
            if (was) before = false;
            if (was && !status) status = follow(e, s, c, assigned, why, err);
            if (before && !status) *assigned = cancelled_before(e);
        } else {
            before = false;
            status = follow(e, s, c, assigned, why, err);
        }
    }
    return status;
}

/* Takes a step, with a mark; or steps up to the limit while bounds prove that nothing happens, and then `left` is where
 * the last one began. */
static motus_status go_on(events *e, stepper *s, stepper_limit limit, stepper_stop *why, motus_error *err)
{
    e->boxed = e->right.valued = false;
    if (limit.steps > 1 && e->pause == 0 && events_watchable(e, s)) return events_watch(e, s, limit, why, err);
    if (e->pause > 0) e->pause--;
    const motus_status status = stepper_mark(s, err);
    return status ? status : stepper_advance(s, (stepper_limit){1, limit.until}, why, err);
}

/* Takes a step towards `until`, or to an action before its end; or up to `most` steps while bounds prove that nothing
 * happens. A step that is too long to show how a function leaves 0 at its start is repeated, shorter. */
static motus_status piece(events *e, stepper *s, double until, int64_t most, bool *assigned, stepper_stop *why,
                          motus_error *err)
{
    enum { PART = 4, SHORTER_MOST = 12 };
    motus_status status = MOTUS_OK;
    double whole = 0, end = until;
    e->whole = 0;
    e->shorter = SHORTER_MOST;
    events_extend(e, e->left.x, e->left.v);
    e->taken++;
    events_may_look(e, 1);
    for (;;) {
        if (!status) status = go_on(e, s, (stepper_limit){whole == 0 ? most : 1, end}, why, err);
        if (end != until && *why == STOP_UNTIL) *why = STOP_STEPS;
        if (!status) status = observe(s, &e->right, err);
        if (!status && e->right.t == e->left.t) return MOTUS_OK;
        e->span = (e->right.t - e->left.t) + (e->right.lost - e->left.lost);
        if (!status) status = events_find(e, s, err);
        if (status || !e->hidden) break;
        if (whole == 0) whole = e->span;
        double h = e->span / PART;
        if (fabs(h) < 4 * events_ulp(e->left.t)) { /* no step shows it: the dense output of the whole step counts */
            memset(e->heads, 0, e->rules.functions);
            if (e->span == whole) { /* the whole step is the present one, and may be too short to be repeated */
                status = events_find(e, s, err);
                break;
            }
            h = whole;
        }
        *why = STOP_STEPS;
        /* reversible steps find their sizes themselves, so only an earlier end makes one shorter */
        end = row_reversible_steps(&e->method) && h != whole ? e->left.t + h : until;
        status = jump(e, s, &e->left, h, err);
    }
    e->whole = whole;
    if (!status && e->first) events_suppose(e);
    e->first = false;
    e->here_at = NAN;
    if (!status && e->candidates) status = go_through(e, s, assigned, why, err);
    const bool cut = *assigned || *why == STOP_EVENT;
    if (cut) events_cut_extrema(e, e->here.t);
    if (!status && !cut) status = events_keeps_values(e, err);
    if (!status && e->witness) e->halted |= e->witness(e->witness_ctx, s, cut ? e->here.t : e->right.t);
    return status;
}

/* Returns the piece, of those that led to actions, in which t lies; NULL: t lies after them, in the stepper's own
 * step. */
static const double *past_at(const events *e, double t)
{
    const size_t each = PAST_HEAD + e->problem.nx + e->problem.nv;
    const double *at = NULL;
    for (size_t k = 0; k < e->pasts && e->way * (t - e->past[k * each]) >= 0; k++) at = e->past + k * each;
    return e->way * (t - e->past_end) >= 0 ? NULL : at;
}

motus_status events_sample(events *e, stepper *s, double t, double *x, double *v, motus_error *err)
{
    const size_t nx = e->problem.nx, nv = e->problem.nv;
    const double *const from = past_at(e, t);
    if (!from) {
        const motus_status status = stepper_sample(s, t, x, v, err);
        if (!status) events_keep(e, t, x);
        return status;
    }
    memcpy(x, from + PAST_HEAD, nx * sizeof *x);
    memcpy(v, from + PAST_HEAD + nx, nv * sizeof *v);
    motus_status status = MOTUS_OK;
    if (t != from[0]) {
        double end, rest;
        status = events_probe(e, from[0], from[1], x, v, (t - from[0]) - from[1], &end, &rest, err);
        if (!status) status = stepper_sync(e->probe, x, v, NULL, err);
    }
    if (!status) events_keep(e, t, x);
    return status;
}

bool events_sampled_exactly(const events *e, double t) { return past_at(e, t) != NULL; }

void events_move(events *e, const machine *m)
{
    e->machine = *m;
    stepper_destroy(e->probe);
    e->probe = NULL;
}

/* Computes the acceleration at time t in the state `left` into a. */
static void accelerate(const events *e, double t, double *a)
{
    const problem *p = &e->problem;
    memset(a, 0, p->nv * sizeof *a);
    if (p->accel(p->ctx, t, e->left.x, e->left.v, a)) memset(a, 0, p->nv * sizeof *a);
}

/* Adds to `size` a part of how far the acceleration changes between two times by the time alone. */
static void add_change(const events *e, double part, const double *from, const double *to, double *size)
{
    for (size_t k = 0; k < e->problem.nv; k++)
        if (isfinite(to[k] - from[k])) size[k] += part * fabs(to[k] - from[k]);
}

/* Returns the time at which switches change next along `way`, but not beyond `end`. */
static double known_time(const events *e, double way, double end)
{
    const double t = e->rules.next ? e->rules.next(e->rules.ctx, way, e->left.t, e->left.x) : end;
    return way * (end - t) > 0 ? t : end;
}

/* Returns how much the changes of a force count, twice what they do; more if the stages have large weights of both
 * signs, since the time of each stage is rounded. */
static double changes_count(const events *e) { return fmax(1, row_weights(&e->method) / 2); }

/* Begins to measure what the rounding of a known time does to velocities, in units of this rounding: the jump of the
 * acceleration there, and half its change by the time alone from the known time before and to the one after, because
 * rounded points of the time make the force between them steeper or less steep. */
static void begin_jog(events *e, double *before, double *size)
{
    double *const there = e->best.a;
    memset(size, 0, e->problem.nv * sizeof *size);
    accelerate(e, e->left.t, before);
    accelerate(e, known_time(e, -e->way, e->start), there);
    add_change(e, changes_count(e), there, before, size);
}

/* Moves a companion as if the switches that have passed had changed earlier or later, by a part of the rounding of
 * their time that differs from one to the next, and its sign from some to the next, so that changes back and forth do
 * not cancel it. */
static void jog_times(events *e, const double *before, double *size)
{
    enum { ALIKE = 3 }; /* 2^ALIKE switches have one sign */
    double *const after = e->next.a, *const there = e->best.a;
    const uint32_t salt = (uint32_t)(e->passed_times + 1) * 0x9e3779b9u,
                   turn = ((uint32_t)(e->passed_times >> ALIKE) + 1) * 0x9e3779b9u;
    const double part = 0.5 + (salt & 0xFFFF) * 0x1p-17, by = (turn >> 31 ? part : -part) * events_ulp(e->left.t);
    accelerate(e, e->left.t, after);
    accelerate(e, known_time(e, e->way, e->leg_end), there);
    add_change(e, 1, before, after, size);
    add_change(e, changes_count(e), after, there, size);
    for (size_t k = 0; k < e->problem.nv; k++) e->left.v[k] += size[k] * by;
}

/* Gives switches that change at known times their sides for the motion from `left` on; h: the size of the next step. */
static motus_status pass_times(events *e, stepper *s, double h, motus_error *err)
{
    int64_t passed = 0;
    if (e->jog && e->stopped) begin_jog(e, e->here.a, e->right.a);
    const motus_status status =
        e->rules.pass ? e->rules.pass(e->rules.ctx, e->way, e->left.t, e->left.x, e->left.v, &passed, err) : MOTUS_OK;
    if (status || (!passed && !e->stopped)) return status;
    if (e->jog && e->stopped && passed) jog_times(e, e->here.a, e->right.a);
    e->passed_times += passed;
    e->stopped = e->left.valued = e->boxed = false;
    return jump(e, s, &e->left, h, err);
}

/* Returns the end of the next step: `until`, or the first known time before it at which a switch changes. A rounding
 * counts, since by it a companion, whose decimals are others, tells what the rounding of that time does. */
static double next_stop(const events *e, double until)
{
    const double stop = e->rules.next ? e->rules.next(e->rules.ctx, e->way, e->left.t, e->left.x) : until;
    return e->way * (until - stop) > 0 ? stop : until;
}

/* Takes steps of which nothing is asked but their ends. */
static motus_status plain_steps(events *e, stepper *s, stepper_limit limit, stepper_stop *why, motus_error *err)
{
    const int64_t before = stepper_steps(s);
    motus_status status = stepper_advance(s, limit, why, err);
    if (!status) status = observe(s, &e->right, err);
    const int64_t steps = stepper_steps(s) - before;
    e->first = false;
    e->taken += steps, e->steps += steps - 1;
    e->candidates = 0;
    return status;
}

static motus_status adaptive_step(events *e, stepper *s, double until, int64_t most, stepper_stop *why,
                                  motus_error *err)
{
    bool assigned = false;
    motus_status status = pass_times(e, s, stepper_next(s), err);
    if (status) return status;
    const double stop = next_stop(e, until);
    if (e->rules.next && stepper_steps(s) == 0) stepper_expect_blur(s, stop);
    if (e->rules.functions == 0 && !e->clocks && !e->witness)
        status = plain_steps(e, s, (stepper_limit){most, stop}, why, err);
    else
        status = piece(e, s, stop, most, &assigned, why, err);
    if (status || *why == STOP_EVENT) return status;
    e->stopped = stop != until && *why == STOP_UNTIL && !assigned;
    if (e->stopped) *why = STOP_STEPS;
    /* the sizes of reversible steps follow from one another, so a step shortened for events would shorten all later
     * steps */
    const bool shortened = row_reversible_steps(&e->method) && e->whole != 0;
    if (assigned || (shortened && *why != STOP_UNTIL)) {
        const instant *now = assigned ? &e->here : &e->right;
        double h = shortened ? e->whole : e->span;
        if (now->t + h == now->t) h = e->way * 4 * events_ulp(now->t); /* it was cut short by `until` */
        /* the size tells how fast the motion changes, except that of a last step to a switch that hardly changes t */
        if (e->rules.settle && fabs(h) <= 64 * events_ulp(now->t)) h = e->grid_step;
        if (assigned && e->rules.settle && fabs(h) > e->pace) h = e->way * e->pace;
        if (!keep_past(e, now->t)) return events_no_memory(err);
        status = jump(e, s, now, h, err);
        if (!status) status = stepper_advance(s, (stepper_limit){0, until}, why, err);
    }
    events_copy(e, &e->left, assigned ? &e->here : &e->right);
    return status;
}

/* Returns the next time of the grid. */
static double grid_end(const events *e) { return e->grid_start + (double)(e->steps + 1) * e->grid_step; }

/* Returns how many fixed steps, at most `most`, may be watched: the last ones to `until` are taken one by one, and a
 * witness is shown every fixed step. */
static int64_t grid_room(const events *e, double until, int64_t most)
{
    const double left = (until - e->left.t) / e->grid_step - 2;
    if (e->broken || e->witness || !(left > 1)) return 1;
    return left < (double)most ? (int64_t)left : most;
}

/* Takes a fixed step to the next time of the grid, in short steps that end on actions and begin there. A step that is
 * cancelled on its way is `broken`. Takes up to `most` steps while bounds prove that nothing happens. */
static motus_status grid_step(events *e, stepper *s, double until, int64_t most, stepper_stop *why, motus_error *err)
{
    const double grid = grid_end(e);
    const bool last = e->way * (until - grid) <= 8 * events_ulp(until);
    double end = last ? until : grid;
    /* a run to a later end would take another step here, or find only in its next step what happens at this end */
    if (last && e->may_save && !e->broken && !events_save_here(e, s)) return events_no_memory(err);
    for (;;) {
        bool assigned = false;
        motus_status status = pass_times(e, s, e->broken ? (end - e->left.t) - e->left.lost : e->grid_step, err);
        const double stop = next_stop(e, end);
        if (!status && stop != end) {
            e->broken = true;
            status = jump(e, s, &e->left, (stop - e->left.t) - e->left.lost, err);
        }
        if (!status) status = piece(e, s, e->broken ? stop : until, grid_room(e, until, most), &assigned, why, err);
        if (status || *why == STOP_EVENT) return status;
        if (!last) end = grid_end(e); /* watched steps have moved it */
        const double left = assigned ? (end - e->here.t) - e->here.lost : (end - e->right.t) - e->right.lost;
        const bool near = fabs(left) <= 8 * events_ulp(end);
        if (!e->broken && !assigned && near) break; /* the usual step */
        e->broken = !near;
        const instant *now = assigned ? &e->here : &e->right;
        if (!keep_past(e, now->t)) return events_no_memory(err);
        events_copy(e, &e->left, now);
        *why = near && last ? STOP_UNTIL : STOP_STEPS;
        status = jump(e, s, &e->left, near ? e->grid_step : left, err);
        if (!status && near && last) status = stepper_advance(s, (stepper_limit){0, e->left.t}, why, err);
        if (status || near) return status;
        if (e->cancelled) return MOTUS_CANCELLED;
    }
    events_copy(e, &e->left, &e->right);
    return MOTUS_OK;
}

motus_status events_go(events *e, stepper *s, double until, int64_t most, stepper_stop *why, motus_error *err)
{
    *why = STOP_STEPS;
    e->until = until;
    e->cancelled = e->halted = false;
    e->along = s;
    e->pasts = 0;
    e->acted_left = e->acted;
    e->pace = INFINITY;
    events_kept_forget(e);
    motus_status status =
        row_adaptive(&e->method) ? adaptive_step(e, s, until, most, why, err) : grid_step(e, s, until, most, why, err);
    e->along = NULL;
    if (!status) e->steps++;
    if (!status && e->cancelled) status = MOTUS_CANCELLED;
    if (!status && e->halted && *why == STOP_STEPS) *why = STOP_HALT;
    if (status) *why = STOP_FAILED;
    return status;
}

events_end events_ended(const events *e, size_t *rule)
{
    if (rule) *rule = e->end_rule;
    return e->end;
}

bool events_accumulated(const events *e, events_limit *out)
{
    if (e->has_limit && out) *out = e->limit;
    return e->has_limit;
}

void events_jog(events *e, events_jogger jog) { e->jog = jog; }
void events_doubted(events *e, bool doubted) { e->doubted = doubted; }

void events_witnessed(events *e, events_witness witness, void *ctx) { e->witness = witness, e->witness_ctx = ctx; }

void events_forget(events *e)
{
    size_t instances = 0;
    for (size_t k = 0; k < e->rules.count; k++) {
        e->count[k] = e->ticks[k] = 0;
        instances += e->rules.rule[k].instances + 1;
    }
    for (size_t i = 0; i < instances; i++) e->recent[i].number = 0;
    e->jumps = 0;
    events_forget_extrema(e);
    e->rows = e->numbers = e->kept_states = e->pasts = 0;
    e->acted = e->passed_times = 0;
    e->acted_sum = e->tail = 0;
    e->growths = 0;
    e->flights = e->turned_step = 0;
    e->flights_sum = 0;
    e->has_limit = e->limit_told = false;
    e->end = EVENTS_END_NONE;
}

void events_turn(events *e, const stepper *s)
{
    e->grid_start = stepper_time(s);
    e->grid_step = stepper_step(s);
    e->steps = 0;
    e->broken = false;
}

void events_listen(events *e, int (*asks)(const void *ctx), const void *ctx)
{
    e->asks = asks;
    e->asks_ctx = ctx;
}

bool events_partway(const events *e) { return e->broken && !e->saved && e->end == EVENTS_END_NONE; }

double events_latest(const events *e) { return e->at_once; }

bool events_ticks(const events *e, double t)
{
    for (size_t k = 0; k < e->rules.count; k++) {
        const rule *r = &e->rules.rule[k];
        const double n = r->kind == RULE_CLOCK ? rint((t - e->start) / (e->way * r->period)) : 0;
        if (n > 0 && fabs(e->start + n * e->way * r->period - t) <= 4 * events_ulp(t)) return true;
    }
    return false;
}

bool events_settled(const events *e, size_t f)
{
    return !e->side[f] || (e->stands[f] && !e->heads[f]) || (e->end == EVENTS_END_STOP && e->zero[f]);
}
int64_t events_acted(const events *e) { return e->acted; }

int64_t events_acted_before(const events *e, double t)
{
    const double *const from = past_at(e, t);
    return from ? (int64_t)from[2] : e->acted;
}

int64_t events_turns(const events *e)
{
    int64_t turns = 0;
    for (size_t k = 0; k < e->rules.count; k++)
        if (e->rules.rule[k].internal) turns += e->count[k];
    return turns + e->passed_times;
}

double events_interval(const events *e) { return e->interval; }
size_t events_rule_of(const events *e, size_t function) { return e->rule_of[function]; }
int64_t events_steps(const events *e) { return e->steps; }

size_t events_held(const events *e, size_t *rule)
{
    size_t found = 0;
    for (size_t k = e->rules.count; k-- > 0;) {
        bool holds = false;
        if (e->rules.rule[k].kind != RULE_CONDITION || e->count[k] > 0) continue;
        for (size_t i = 0; i < e->rules.rule[k].instances; i++) holds |= e->held[e->instances[k] + i];
        if (holds) *rule = k, found++;
    }
    return found;
}
