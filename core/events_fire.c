/* What happens in one instant: rules act in the order of the text, each on the state that the one before left, until no
 * rule has anything left to do. See events_parts.h.
 *
 * A rule whose function passes 0 acts once for that passage. A function that still moves in the event's direction after
 * the action has left 0 to that side, however fast it moves. A function that the action turns back has not, and an
 * action of another rule may let it pass in the same instant.
 */
#include "core/events_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static int sign_of(double x) { return (x > 0) - (x < 0); }

/* Returns a bound on the rounding error of a function at `here`. Beside a jump that bound is as large as the jump, so
 * the bounds at the ends of the step limit it. */
static double bound_of(const events *e, size_t f)
{
    const double here = e->here.bound[f];
    if (!e->marked || !e->rules.rule[e->rule_of[f]].jump) return here;
    const double ends = fmax(fabs(e->left.g[f]), fabs(e->right.g[f]));
    return fmin(here, 4 * fmax(e->left.bound[f], e->right.bound[f]) + 0x1p-44 * ends);
}

/* Returns what a bound on rounding counts: it takes every number of the state as rounded by half a unit in the last
 * place, and those of a companion were also moved by a whole unit. */
static double units_of(const events *e) { return e->jog ? 3 : 1; }

/* Tells whether a function is 0 at `here`, but for its rounding error and that of the time. */
static bool is_zero(const events *e, size_t f)
{
    const instant *at = &e->here;
    return !events_far(e, &e->here, f) &&
           fabs(at->g[f]) <= units_of(e) * bound_of(e, f) + fabs(at->rate[f]) * events_ulp(at->t);
}

/* Tells whether a function is beyond 0 at `here` because it has jumped: its value exceeds its change within the
 * rounding of the time. Its own candidate, a rounding later, changes its side; until then it has the side before the
 * jump. */
static bool jumps_here(const events *e, size_t f)
{
    const instant *at = &e->here;
    const bool beyond = e->side[f] && sign_of(at->g[f]) == -e->side[f];
    const bool wide = fabs(at->g[f]) > 4 * bound_of(e, f) + 16 * fabs(at->rate[f]) * events_ulp(at->t);
    return beyond && (events_far(e, &e->here, f) || (e->rules.rule[e->rule_of[f]].jump && wide));
}

/* Truth ----------------------------------------------------------------------------------------------------------- */

void events_suppose(events *e)
{
    for (size_t k = 0; k < e->rules.count; k++) {
        const rule *r = &e->rules.rule[k];
        for (size_t i = 0; r->kind == RULE_CONDITION && i < r->instances; i++)
            e->held[e->instances[k] + i] = rules_hold(r, i, e->side);
    }
}

/* Acting ---------------------------------------------------------------------------------------------------------- */

static motus_status too_many(const events *e, size_t k, size_t i, motus_error *err)
{
    char t[DECIMAL_MAX], name[MOTUS_NAME_MAX] = "";
    const double now = e->here.t;
    if (e->rules.name) e->rules.name(e->rules.ctx, k, i, name, sizeof name);
    fail(err, MOTUS_EVENTS, "more than %d events in one instant, t = %s; the latest is %s", EVENTS_AT_ONCE,
         decimal_time(now, e->until - e->start, t), name[0] ? name : e->rules.rule[k].name);
    hint(err, "events answer one another without end: let the action of one end what the other waits for");
    if (!err) return MOTUS_EVENTS;
    err->time = now;
    snprintf(err->variable, sizeof err->variable, "%s", name[0] ? name : e->rules.rule[k].name);
    return MOTUS_EVENTS;
}

static motus_status not_finite(const events *e, size_t k, bool in_v, size_t which, motus_error *err)
{
    char t[DECIMAL_MAX], name[MOTUS_NAME_MAX] = "";
    const problem *p = &e->problem;
    if (p->name) p->name(p->ctx, in_v, which, name, sizeof name);
    fail(err, MOTUS_DIVERGED, "the action of %s at t = %s gives %s a value that is not finite", e->rules.rule[k].name,
         decimal_time(e->here.t, e->until - e->start, t), name[0] ? name : "the state");
    if (err) {
        err->time = e->here.t;
        snprintf(err->variable, sizeof err->variable, "%s", name);
    }
    return MOTUS_DIVERGED;
}

/* Moves, for a companion, the modes that were assigned in this step by a unit in the last place, always in one
 * direction, since the rounding of a sum of equal numbers keeps its sign for long. */
static void jog_modes(events *e)
{
    for (size_t k = 0; e->jog && k < e->rules.rounded_count; k++) {
        const size_t at = e->rules.rounded[k];
        if (e->here.x[at] != e->left.x[at]) e->jog(e->here.x + at, 1, (uint32_t)at, false);
    }
}

/* Does the action of an event to the state at `here`. */
static motus_status change(events *e, size_t k, size_t i, motus_error *err)
{
    instant *at = &e->here;
    bool in_v = false;
    size_t which = SIZE_MAX;
    const int answer = e->rules.act(e->rules.ctx, k, i, at->t, at->x, at->v, &in_v, &which);
    if (!answer) {
        jog_modes(e);
        return MOTUS_OK;
    }
    return which == SIZE_MAX ? events_refuse(e, "event_action", at->t, answer, err)
                             : not_finite(e, k, in_v, which, err);
}

/* Lets conditions that an action has made false become true again: in this instant, if they are false at the instant
 * itself, or later, if they are false as the motion goes on. */
static void release(events *e)
{
    for (int now = 0; now < 2; now++) {
        for (size_t f = 0; f < e->rules.functions; f++) {
            const int heads = now ? 0 : events_direction(e, &e->here, f);
            e->sign[f] = (int8_t)(e->zero[f] ? heads : sign_of(e->here.g[f]));
        }
        for (size_t k = 0; k < e->rules.count; k++) {
            const rule *r = &e->rules.rule[k];
            for (size_t i = 0; r->kind == RULE_CONDITION && i < r->instances; i++) {
                const size_t one = e->instances[k] + i;
                if (rules_hold(r, i, e->sign)) continue;
                if (now) {
                    e->happened[one] = NAN;
                } else {
                    if (e->held[one]) e->happened[one] = e->here.t; /* it need not become true in this instant */
                    e->held[one] = 0;
                }
            }
        }
    }
}

/* Writes the state at `here`, moved along the motion by a few roundings of the time, and every number by its own
 * rounding. */
static void move_by_rounding(const events *e, int turn, instant *to)
{
    enum { ULPS = 8 };
    const instant *at = &e->here;
    const int side = turn & 1 ? 1 : -1, other = turn & 2 ? -side : side;
    const double h = side * ULPS * events_ulp(at->t);
    events_copy(e, to, at);
    to->t += h;
    for (size_t k = 0; k < e->problem.nx - e->problem.modes; k++)
        to->x[k] += (k < e->problem.nv ? h * at->v[k] : 0) + (k % 2 ? other : side) * events_ulp(at->x[k]);
    for (size_t k = 0; k < e->problem.nv; k++) to->v[k] += h * at->a[k] + (k % 2 ? other : side) * events_ulp(at->v[k]);
}

/* Marks the functions at 0 whose rate under the new force is 0 but for rounding: when the force that holds them lets
 * go, they leave 0 with a slope of 0. */
static motus_status find_level(events *e, motus_error *err)
{
    enum { MARGIN = 4, TURNS = 4 };
    instant *at = &e->next;
    const problem *p = &e->problem;
    if (p->accel(p->ctx, e->here.t, e->here.x, e->here.v, e->here.a))
        return events_refuse(e, "acceleration", e->here.t, p->returned ? *p->returned : 0, err);
    motus_status status = MOTUS_OK;
    for (int turn = 0; turn < TURNS && !status; turn++) {
        move_by_rounding(e, turn, at);
        status = events_rates(e, at, err);
        for (size_t f = 0; f < e->rules.functions && !status; f++) {
            const double rate = fabs(e->here.rate[f]);
            e->level[f] |=
                e->zero[f] && (rate > 0 || e->rules.settle) && rate <= MARGIN * fabs(at->rate[f] - e->here.rate[f]);
        }
    }
    return status;
}

/* Tells whether a function at 0 may leave it with a slope of 0: it had none, or an action has taken nearly all of it.
 * */
static bool may_be_level(const events *e, size_t f, double before)
{
    const double rate = fabs(e->here.rate[f]);
    return e->zero[f] && rate > 0 && (before == 0 || rate <= 0x1p-20 * fabs(before));
}

/* Evaluates the functions after an action of instance i of rule k; e->before and the rates at `here` are first those
 * before the action. An event of this instant may happen again if another rule has changed the rate of its function: a
 * ball between two others meets both at once, and one of them again. */
static motus_status look_again(events *e, size_t k, size_t i, motus_error *err)
{
    instant *at = &e->here;
    const rule *r = &e->rules.rule[k];
    double *const rate = e->next.rate; /* room */
    memcpy(rate, at->rate, e->rules.functions * sizeof *rate);
    motus_status status = events_values(e, at, err);
    if (!status) status = events_judge(e, at, err);
    bool level = r->internal;
    for (size_t f = 0; f < e->rules.functions && !status; f++) {
        const bool own = f >= r->first && f < r->first + r->leaves * r->instances && (f - r->first) % r->instances == i;
        if (!own && fabs(at->rate[f] - rate[f]) > 0x1p-40 * fabs(rate[f])) e->fired[f] = NAN;
        /* a function that was 0 and has not changed stays 0, whatever its rate is now; so does one moved by a switch */
        const double moved = e->rules.settle ? fabs(at->g[f]) - fabs(e->before[f]) : fabs(at->g[f] - e->before[f]);
        const bool still = e->zero[f] && moved <= units_of(e) * at->bound[f];
        if (e->open[f] && fabs(at->rate[f]) > 2 * fabs(rate[f])) e->level[f] = 0;
        e->zero[f] = still || is_zero(e, f);
        level |= may_be_level(e, f, rate[f]);
    }
    if (!status && level) status = find_level(e, err);
    if (!status) release(e);
    return status;
}

static void jog(events *e, int64_t number, bool switched)
{
    const size_t nx = e->problem.nx - e->problem.modes;
    const uint32_t salt = (uint32_t)number * 0x9e3779b9u;
    if (!e->jog) return;
    e->jog(e->here.x, nx, salt, switched);
    e->jog(e->here.v, e->problem.nv, salt + (uint32_t)nx, switched);
}

/* Lets a companion act as much earlier or later as rounding of the state hides where a function passes 0: moves its
 * state by the velocities and accelerations after the action. */
static void lag(events *e, int64_t number)
{
    const problem *p = &e->problem;
    instant *at = &e->here;
    const double late = ((uint32_t)number * 0x9e3779b9u >> 31 ? 1 : -1) * e->blurred;
    if (!e->jog || late == 0) return;
    memset(at->a, 0, p->nv * sizeof *at->a);
    if (p->accel(p->ctx, at->t, at->x, at->v, at->a)) return;
    for (size_t k = 0; k < p->nx - p->modes; k++) at->x[k] += late * at->v[k];
    for (size_t k = 0; k < p->nv; k++) at->v[k] += isfinite(at->a[k]) ? late * at->a[k] : 0;
}

/* Tells whether the step that leads here is a whole flight between two switches under a constant force: it is the only
 * step since the latest turn, and moves by the mean of the velocities. The next flight then repeats its roundings. */
static bool ends_flight(const events *e)
{
    const size_t moving = e->problem.nx - e->problem.modes;
    const instant *from = &e->left, *to = &e->here;
    const double h = (to->t - from->t) + (to->lost - from->lost);
    bool constant = e->steps - e->turned_step <= 1;
    for (size_t k = 0; k < moving && constant; k++) {
        const double way = h * (from->v[k] + to->v[k]) / 2, far = fabs(h) * (fabs(from->v[k]) + fabs(to->v[k]));
        constant = fabs(to->x[k] - from->x[k] - way) <= 0x1p-40 * (fabs(from->x[k]) + fabs(to->x[k]) + far);
    }
    return constant;
}

enum { WAS_ZERO = UINT8_MAX }; /* of `arrives`: the function was 0, or its event has happened */

/* Sets `arrives` after a turn has led on to where the motion comes to rest, within a time that no step resolves, and
 * functions have come to 0 with it. A function that would have the other sign if the motion went on passes 0; else it
 * touches 0. `best` is the state before the turn. */
static motus_status arrive(events *e, motus_error *err)
{
    instant *at = &e->here, *beyond = &e->best;
    memcpy(beyond->x, at->x, e->problem.nx * sizeof *at->x);
    for (size_t k = 0; k < e->problem.nv; k++) beyond->v[k] = 2 * at->v[k] - beyond->v[k];
    beyond->t = at->t;
    const motus_status status = events_values(e, beyond, err);
    for (size_t f = 0; f < e->rules.functions; f++) {
        const bool rests = at->t != e->until || at->g[f] == 0; /* else the end of the run has cut the way short */
        const bool comes = !e->arrives[f] && e->zero[f] && e->side[f] && rests;
        if (e->arrives[f] && e->arrives[f] != WAS_ZERO) continue; /* another turn of this instant has set it */
        const int kind = sign_of(beyond->g[f]) == -e->side[f] ? -e->side[f] : CANDIDATE_TOUCHES;
        e->arrives[f] = (uint8_t)(comes && !e->rules.rule[e->rule_of[f]].internal ? kind + 2 : 0);
    }
    return status;
}

/* Turns a switch to its new side. All switches may turn in one instant, but none again and again. */
static motus_status turn(events *e, size_t k, size_t i, motus_error *err)
{
    instant *at = &e->here;
    if (e->turned_at != at->t) e->turned_at = at->t, e->turns = 0;
    if (++e->turns > EVENTS_AT_ONCE + 4 * e->rules.functions) return too_many(e, k, i, err);
    if (ends_flight(e)) e->flights++, e->flights_sum += at->t - e->start;
    e->turned_step = e->steps;
    memcpy(e->before, at->g, e->rules.functions * sizeof *at->g);
    jog(e, e->count[k], true);
    const double before = at->t;
    events_copy(e, &e->best, at);
    motus_status status = e->rules.turn(e->rules.ctx, k, i, e->way, e->until, &at->t, at->x, at->v, err);
    if (at->t != before) at->lost = 0;
    if (!status) status = events_swarm(e, e->rules.rule[k].first + i, err);
    const bool moved = e->best.t != at->t || memcmp(e->best.v, at->v, e->problem.nv * sizeof *at->v) != 0;
    for (size_t f = 0; f < e->rules.functions && moved; f++) {
        const bool told = e->way * (e->fired[f] - before) >= -4 * events_ulp(before);
        if ((e->zero[f] || told) && !e->arrives[f]) e->arrives[f] = WAS_ZERO;
    }
    if (!status) status = look_again(e, k, i, err);
    if (!status && moved) status = arrive(e, err);
    return status ? status : events_note_rest(e, err);
}

static motus_status act(events *e, size_t k, size_t i, motus_error *err)
{
    instant *at = &e->here;
    if (e->rules.rule[k].internal) return turn(e, k, i, err);
    if (e->at_once != at->t) {
        if (!isnan(e->at_once)) e->interval = fabs(at->t - e->at_once);
        e->at_once = at->t;
        e->actions = 0;
    }
    e->acted++;
    e->acted_sum += at->t - e->start;
    events_swarm_forget(e); /* where switches accumulate together with events, the events tell the limit */
    if (++e->actions > EVENTS_AT_ONCE) return too_many(e, k, i, err);
    const size_t n = e->rules.functions;
    if (n) memcpy(e->before, at->g, n * sizeof *at->g);
    motus_status status = change(e, k, i, err);
    if (status) return status;
    jog(e, e->acted, false);
    lag(e, e->acted);
    if (e->rules.settle) status = e->rules.settle(e->rules.ctx, e->way, at->t, at->x, at->v, err);
    if (!status) status = look_again(e, k, i, err);
    return status ? status : events_growth(e, k, i, err);
}

static motus_status no_room(motus_error *err) { return fail(err, MOTUS_MEMORY, "no memory for the table of events"); }

static motus_status table_full(const events *e, size_t k, motus_error *err)
{
    char t[DECIMAL_MAX];
    const char *const name = e->rules.rule[k].name;
    fail(err, MOTUS_LIMIT, "the table of events is full at t = %s: it has %d rows, and %s has one more",
         decimal_time(e->here.t, e->until - e->start, t), EVENTS_ROWS_MOST, name);
    hint(err, "record fewer events, or let the run end before");
    if (err) err->time = e->here.t, snprintf(err->variable, sizeof err->variable, "%s", name);
    return MOTUS_LIMIT;
}

/* Lets an event of a rule happen: counts it, adds its row, does its action. */
static motus_status happen(events *e, size_t k, size_t i, bool touched, bool *assigned, motus_error *err)
{
    const rule *r = &e->rules.rule[k];
    e->count[k]++;
    if (r->records && e->rows >= EVENTS_ROWS_MOST) return table_full(e, k, err);
    if (r->records && !events_note(e, k, i, touched, &e->here)) return no_room(err);
    if ((r->keeps || r->assigns) && !events_note_jump(e, r, &e->here, false)) return no_room(err);
    if (r->keeps && !r->assigns) {
        const motus_status status = change(e, k, i, err);
        if (status) return status;
        if (!events_keep_now(e, e->here.t, e->here.x)) return no_room(err);
    }
    if (r->assigns) {
        const motus_status status = act(e, k, i, err);
        if (status) return status;
        *assigned = true;
        if (!events_keep_now(e, e->here.t, e->here.x) || (r->records && !events_note_after(e, &e->here)))
            return no_room(err);
    }
    if ((r->keeps || r->assigns) && !events_note_jump(e, r, &e->here, true)) return no_room(err);
    if (r->stop && e->count[k] >= r->stop && e->end == EVENTS_END_NONE) e->end = EVENTS_END_STOP, e->end_rule = k;
    return MOTUS_OK;
}

/* Asking ---------------------------------------------------------------------------------------------------------- */

/* Tells whether the rate of a function at `here` exceeds the rounding error of its rates at the ends of the step. */
static bool moves(const events *e, size_t f)
{
    const double most = e->marked ? fmax(fabs(e->left.rate[f]), fabs(e->right.rate[f])) : 0;
    return fabs(e->here.rate[f]) > 0x1p-44 * most;
}

/* Returns the direction in which a function at 0 leaves it after an action; 0: rounding hides it. */
static int heads(const events *e, size_t f) { return moves(e, f) ? events_direction(e, &e->here, f) : 0; }

/* Tells whether a candidate is in this instant or, where it has not been located, may be. */
static bool is_here(const events *e, const candidate *c)
{
    if (c->located) return fabs(c->at - e->here_at) <= 4 * events_ulp(e->here.t);
    return e->way * (e->here_at - c->low) >= 0 && e->way * (c->high - e->here_at) >= 0;
}

/* Returns a candidate of function f in this instant that is not gone; `touches`: one that may be a touch. NULL: none.
 * */
static candidate *about(const events *e, size_t f, bool touches)
{
    for (size_t k = 0; k < e->candidates; k++) {
        candidate *c = &e->candidate[k];
        const bool stays = c->sampled && !c->located && !c->near; /* with CANDIDATE_TOUCHES: it comes to 0 and stays */
        const bool touch = (c->near || (c->kind == CANDIDATE_TOUCHES && !stays)) && !c->jumps;
        if (c->gone || c->kind == CANDIDATE_TIME || c->of != f || (touches && !touch)) continue;
        if (is_here(e, c)) return c;
    }
    return NULL;
}

/* Tells whether a located crossing or jump of function f is in this instant, followed or not, and the side to which it
 * leads; 0: the function stays 0 from there on. */
static bool is_led(const events *e, size_t f, int *side)
{
    for (size_t k = 0; k < e->candidates; k++) {
        const candidate *c = &e->candidate[k];
        const bool touch = c->near || (c->kind == CANDIDATE_TOUCHES && !c->jumps && !c->sampled);
        if (c->kind == CANDIDATE_TIME || c->of != f || touch || (c->gone && !c->followed)) continue;
        if (!c->located && !(c->sampled && c->kind == CANDIDATE_TOUCHES)) continue;
        if (!is_here(e, c)) continue;
        *side = c->kind;
        return true;
    }
    return false;
}

/* Returns the direction in which function f leaves 0 here: by its candidate or, after an action, by its slope. */
static int leaves(const events *e, size_t f, const candidate *c, bool acted)
{
    int side;
    if (!acted && c->kind != CANDIDATE_TIME && c->of == f) return c->kind;
    return !acted && is_led(e, f, &side) ? side : events_direction(e, &e->here, f);
}

static candidate *touching(const events *e, size_t f) { return about(e, f, true); }

/* Returns the side on which function f goes on; 0: it stays at 0. */
static int goes_on(const events *e, size_t f, const candidate *c, bool acted)
{
    const bool own = !acted && c->kind != CANDIDATE_TIME && c->of == f;
    if (own && (c->kind != CANDIDATE_TOUCHES || c->jumps)) return c->kind;
    const bool touched = fabs(e->fired[f] - e->here.t) <= 4 * events_ulp(e->here.t) && !moves(e, f);
    return own || touched || touching(e, f) ? e->side[f] : leaves(e, f, c, acted);
}

/* What `touched` tells of a function in this instant. */
enum {
    TOUCHED = 1, /* its touch has happened */
    CAME = 2,    /* it has come to 0 in the step that leads here */
    SEEN = 4     /* it has passed 0 before the eyes of a rule that leaves the motion as it is */
};

/* Sets `touched` before any rule has acted. A candidate that was followed a rounding ago, or that was no event because
 * of its direction, may be the passage of this very instant: then an action of another rule may still send the function
 * back. */
static void see_arrivals(events *e)
{
    for (size_t f = 0; f < e->rules.functions; f++)
        e->touched[f] = e->zero[f] && e->side[f] && !e->stands[f] ? CAME : 0;
    for (size_t k = 0; k < e->candidates; k++) {
        const candidate *c = &e->candidate[k];
        if (c->kind == CANDIDATE_TIME || !c->kind || c->jumps || !e->zero[c->of] || !(c->idle ? c->gone : c->followed))
            continue;
        const rule *r = &e->rules.rule[e->rule_of[c->of]];
        const double near = 4 * events_ulp(e->here.t);
        const bool around = e->way * (e->here_at - c->low) >= -near && e->way * (c->high - e->here_at) >= -near;
        if (r->kind != RULE_ROOT || r->assigns || e->side[c->of] != (int)c->kind) continue;
        if (!(c->idle ? around : fabs(c->at - e->here_at) <= near)) continue;
        if (c->idle)
            e->side[c->of] = (int8_t)-c->kind, e->touched[c->of] |= CAME;
        else
            e->touched[c->of] |= SEEN;
    }
}

/* Moves on to the limit of a rule's events if they accumulate, after an event has acted. */
static motus_status approach(events *e, size_t k, size_t i, motus_error *err)
{
    motus_status status = MOTUS_OK;
    if (events_accumulate(e, k, i, e->here.t)) {
        status = events_unbounded(e, err);
        events_to_limit(e);
    }
    events_after(e, k, i);
    return status;
}

/* Lets a rule answer to a turn that has led its function f, of instance i, to 0. */
static motus_status ask_arrived(events *e, size_t k, size_t i, size_t f, bool *acted, bool *again, motus_error *err)
{
    const rule *r = &e->rules.rule[k];
    const int to = e->arrives[f] - 2;
    e->arrives[f] = 0;
    e->fired[f] = e->here.t;
    e->touched[f] = to == CANDIDATE_TOUCHES ? TOUCHED : 0;
    if (to) e->side[f] = (int8_t)to;
    if (r->direction && r->direction != to) return MOTUS_OK;
    *again |= r->assigns;
    return happen(e, k, i, to == CANDIDATE_TOUCHES, acted, err);
}

static motus_status ask_root(events *e, size_t k, size_t i, const candidate *c, bool *acted, bool *again,
                             motus_error *err)
{
    const rule *r = &e->rules.rule[k];
    const size_t f = r->first + i;
    const bool here = c->kind != CANDIDATE_TIME && c->of == f;
    if (e->zero[f] && e->arrives[f]) return ask_arrived(e, k, i, f, acted, again, err);
    if (!e->zero[f] || (e->fired[f] == e->here.t && !*acted)) return MOTUS_OK;
    const bool told = e->fired[f] == e->here.t;
    if (e->touched[f] & TOUCHED && !moves(e, f)) return MOTUS_OK;
    const int to = leaves(e, f, c, *acted);
    if (e->touched[f] & SEEN && *acted) {
        if (to) e->side[f] = (int8_t)to;
        e->fired[f] = e->here.t;
        return MOTUS_OK;
    }
    candidate *touch = told || here ? NULL : touching(e, f);
    if (touch || (here && !told && c->kind == CANDIDATE_TOUCHES)) {
        e->fired[f] = e->here.t;
        e->touched[f] |= TOUCHED;
        if (touch) touch->gone = true;
        if (r->direction) return MOTUS_OK;
        *again |= r->assigns;
        return happen(e, k, i, true, acted, err);
    }
    /* the action of another rule has sent it back to the side from which it came */
    if (*acted && !told && !r->assigns && !r->internal && e->touched[f] & CAME && (to == 0 || to == e->side[f])) {
        e->touched[f] = TOUCHED | SEEN;
        e->fired[f] = e->here.t;
        return r->direction ? MOTUS_OK : happen(e, k, i, true, acted, err);
    }
    /* a function that has been 0 since the start leaves 0 in this instant only by an action */
    if (to == 0 || (e->side[f] ? to == e->side[f] : !here && !*acted)) return MOTUS_OK;
    if (!r->assigns) e->touched[f] |= SEEN;
    if (r->direction && r->direction != to) {
        e->side[f] = (int8_t)to;
        return MOTUS_OK;
    }
    const bool was = *acted;
    bool assigned = false;
    e->fired[f] = e->here.t;
    const motus_status status = happen(e, k, i, false, &assigned, err);
    *acted = was || assigned;
    if (status || !assigned) {
        e->side[f] = (int8_t)to;
        return status;
    }
    *again = true;
    const int now = e->zero[f] ? heads(e, f) : sign_of(e->here.g[f]);
    if (e->side[f] == 0) e->side[f] = (int8_t)-to;
    if (now == to) e->side[f] = (int8_t)to;
    return r->internal ? status : approach(e, k, i, err);
}

/* Tells whether a switch of the force has yet to turn in this instant; how functions go on is known only after that. */
static bool awaits_switch(const events *e, const candidate *c)
{
    if (!e->rules.settle) return false;
    const double near = 4 * events_ulp(e->here.t);
    for (size_t k = 0; k <= e->candidates; k++) {
        const candidate *one = k < e->candidates ? &e->candidate[k] : c;
        if (one->kind != CANDIDATE_FALLS || (one != c && one->gone) || !e->zero[one->of]) continue;
        if (!e->rules.rule[e->rule_of[one->of]].internal || fabs(e->fired[one->of] - e->here.t) <= near) continue;
        if (one == c || is_here(e, one)) return true;
    }
    return false;
}

static motus_status ask_condition(events *e, size_t k, size_t i, const candidate *c, bool *acted, bool *again,
                                  motus_error *err)
{
    const rule *r = &e->rules.rule[k];
    uint8_t *held = &e->held[e->instances[k] + i];
    int8_t *sign = e->sign;
    bool any = false, passes = false;
    for (size_t l = 0; l < r->leaves; l++) {
        const size_t f = r->first + l * r->instances + i;
        sign[f] = (int8_t)(e->zero[f] ? 0 : !*acted && jumps_here(e, f) ? e->side[f] : sign_of(e->here.g[f]));
        any |= e->zero[f];
    }
    const bool now = rules_hold(r, i, sign);
    for (size_t l = 0; l < r->leaves; l++) {
        const size_t f = r->first + l * r->instances + i;
        if (e->zero[f]) {
            const bool own = c->kind != CANDIDATE_TIME && c->of == f, other = touching(e, f) != NULL;
            if (!e->awaits) sign[f] = (int8_t)goes_on(e, f, c, *acted);
            if (other || (own && c->kind == CANDIDATE_TOUCHES && !c->jumps)) e->fired[f] = e->here.t;
            passes |= own || about(e, f, false);
        }
        if (sign[f]) e->side[f] = sign[f];
    }
    double *happened = &e->happened[e->instances[k] + i];
    const bool before = fabs(*happened - e->here.t) <= 4 * events_ulp(e->here.t);
    /* the condition becomes true in this instant or right after it, also if it is false in the instant alone */
    const bool after = any ? rules_hold(r, i, sign) : now;
    uint8_t *steady = &e->steady[e->instances[k] + i];
    const bool happens = *held ? *steady && passes && !now && after && !before : (now && !before) || after;
    if (happens) *steady = 0;
    if (*held && now) *happened = e->here.t; /* it was true before, and is true in this instant */
    *held = after;
    if (!happens) return MOTUS_OK;
    bool assigned = false;
    *happened = e->here.t;
    const motus_status status = happen(e, k, i, false, &assigned, err);
    *acted |= assigned;
    *again |= assigned;
    return assigned && !status ? approach(e, k, i, err) : status;
}

static motus_status ask(events *e, size_t k, const candidate *c, bool *acted, bool *again, motus_error *err)
{
    const rule *r = &e->rules.rule[k];
    motus_status status = MOTUS_OK;
    if (r->kind == RULE_CLOCK && !e->ticked[k] && fabs(events_tick(e, k) - e->here.t) <= 4 * events_ulp(e->here.t)) {
        e->ticked[k] = 1;
        e->ticks[k]++;
        *again |= r->assigns;
        return happen(e, k, 0, false, acted, err);
    }
    for (size_t i = 0; !status && i < r->instances; i++) {
        if (r->kind == RULE_ROOT) status = ask_root(e, k, i, c, acted, again, err);
        if (r->kind == RULE_CONDITION) status = ask_condition(e, k, i, c, acted, again, err);
    }
    if (r->kind == RULE_ACCUMULATES && e->has_limit && e->limit.rule == r->of && !e->limit_told) {
        events_limit_is_told(e);
        *again = true;
        status = happen(e, k, r->instances > e->limit.instance ? e->limit.instance : 0, false, acted, err);
    }
    return status;
}

/* Takes the sides from the values at `here`: a function that an action has moved over 0 has no event. */
void events_stand(events *e)
{
    for (size_t f = 0; f < e->rules.functions; f++) {
        const bool condition = e->rules.rule[e->rule_of[f]].kind == RULE_CONDITION;
        const bool lets_go = e->stands[f] && e->level[f];
        e->stands[f] = e->zero[f];
        e->open[f] = 0;
        e->heads[f] = (int8_t)(e->zero[f] ? heads(e, f) : 0);
        if (!e->zero[f]) e->side[f] = (int8_t)sign_of(e->here.g[f]);
        if ((condition || lets_go) && e->zero[f] && !e->heads[f])
            e->side[f] = 0; /* it is known when the function leaves 0 */
        if (e->rules.rule[e->rule_of[f]].internal) e->side[f] = 1;
    }
}

/* Tells whether the rule of a candidate may end the step here. */
static bool ends_step(const events *e, const candidate *c)
{
    return e->rules.rule[c->kind == CANDIDATE_TIME ? c->of : e->rule_of[c->of]].assigns;
}

/* Marks as 0 the functions that have a touch in this instant, if their error bounds allow it. */
static motus_status touch_too(events *e, motus_error *err)
{
    motus_status status = MOTUS_OK;
    for (size_t k = 0; k < e->candidates && !status; k++) {
        const candidate *c = &e->candidate[k];
        if (c->kind == CANDIDATE_TIME || e->zero[c->of] || !touching(e, c->of)) continue;
        double bound;
        status = events_error_of(e, c->of, e->here_at, &bound, err);
        e->zero[c->of] = !status && fabs(e->here.g[c->of]) <= bound;
    }
    return status;
}

/* Tells whether a function is 0 at `here` or beyond 0: then it has passed 0 in this instant, and its own candidate
 * comes a rounding later. */
static bool is_passed(const events *e, size_t f)
{
    return is_zero(e, f) || (e->side[f] && sign_of(e->here.g[f]) == -e->side[f] && !jumps_here(e, f));
}

/* Tells whether a function has stood at 0 in the whole step, but for the error of the step. */
static bool rests(const events *e, size_t f) { return e->stands[f] && e->open[f]; }

/* ---- few of many rules ---- */

/* An instance of a rule with a function that may be 0 in this instant. */
typedef struct asked {
    size_t rule, instance;
} asked;
enum { ASKED_MOST = 64 };

/* Tells whether, by dense output, a candidate may be in this instant. */
static bool may_be_here(const events *e, const candidate *c)
{
    const double margin = events_margin(e);
    if (fabs(c->at - e->here_at) <= margin) return true;
    const bool settled = c->located || (c->sure && !c->near && !c->sampled);
    return !settled && e->way * (e->here_at - c->low) >= -margin && e->way * (c->high - e->here_at) >= -margin;
}

static bool any_ticks(const events *e)
{
    const double near = 4 * events_ulp(e->here.t);
    for (size_t k = 0; e->clocks && k < e->rules.count; k++)
        if (e->rules.rule[k].kind == RULE_CLOCK && fabs(events_tick(e, k) - e->here.t) <= near) return true;
    return false;
}

/* Inserts an instance into a list, which is in the order of the text. False: the list is full. */
static bool insert(asked *list, size_t *count, asked one)
{
    size_t k = *count;
    while (k > 0 &&
           (list[k - 1].rule > one.rule || (list[k - 1].rule == one.rule && list[k - 1].instance > one.instance)))
        k--;
    if (k > 0 && list[k - 1].rule == one.rule && list[k - 1].instance == one.instance) return true;
    if (*count == ASKED_MOST) return false;
    memmove(list + k + 1, list + k, (*count - k) * sizeof *list);
    list[k] = one;
    ++*count;
    return true;
}

/* Lists the instances of rules that may happen in this instant, if they only record and keep: then no other rule need
 * be asked. False: every rule must be asked. */
static bool asks_few(const events *e, const candidate *c, asked *list, size_t *count)
{
    size_t first, end;
    *count = 0;
    if (!e->rules.alone || e->lingers || c->kind == CANDIDATE_TIME || (e->has_limit && !e->limit_told) || any_ticks(e))
        return false;
    events_about(e, e->here_at, events_margin(e), &first, &end);
    for (size_t k = first; k < end; k++) {
        const candidate *other = &e->candidate[k];
        if (other->kind == CANDIDATE_TIME || (other->gone && !other->followed) || !may_be_here(e, other)) continue;
        const size_t number = e->rule_of[other->of];
        const rule *r = &e->rules.rule[number];
        if (r->assigns || r->internal || r->stop) return false;
        if (!insert(list, count, (asked){number, (other->of - r->first) % r->instances})) return false;
    }
    return true;
}

/* Evaluates the functions of one instance at `here`. */
static motus_status look_at(events *e, const asked *one, motus_error *err)
{
    const rule *r = &e->rules.rule[one->rule];
    motus_status status = MOTUS_OK;
    for (size_t l = 0; l < r->leaves && !status; l++) {
        const size_t f = r->first + l * r->instances + one->instance;
        status = events_value_of(e, f, &e->here, err);
        if (!status) status = events_judge_of(e, f, &e->here, err);
        e->zero[f] = is_passed(e, f);
        e->touched[f] = e->arrives[f] = 0;
    }
    e->steady[e->instances[one->rule] + one->instance] = e->held[e->instances[one->rule] + one->instance];
    return status;
}

/* Evaluates all functions at `here`. */
static motus_status look_at_all(events *e, motus_error *err)
{
    motus_status status = MOTUS_OK;
    if (e->rules.alone) {
        status = events_values(e, &e->here, err);
        if (!status) status = events_judge(e, &e->here, err);
    }
    for (size_t f = 0; f < e->rules.functions; f++) e->zero[f] = is_passed(e, f) || rests(e, f);
    return status;
}

/* Marks as 0 the functions of this candidate and of all candidates that have been located here. */
static void mark_located(events *e, const candidate *c)
{
    size_t first, end;
    events_about(e, e->here_at, events_margin(e), &first, &end);
    if (c->kind != CANDIDATE_TIME && !(c->jumps && c->kind)) e->zero[c->of] = 1;
    for (size_t k = first; k < end; k++) {
        const candidate *other = &e->candidate[k];
        const bool nothing = other->gone && !other->followed;
        if (other->kind == CANDIDATE_TIME || !other->located || nothing || (other->jumps && other->kind)) continue;
        if (is_here(e, other)) e->zero[other->of] = 1;
    }
}

static motus_status fire_few(events *e, const candidate *c, const asked *list, size_t count, motus_error *err)
{
    bool acted = false, again = false;
    motus_status status = MOTUS_OK;
    for (size_t k = 0; k < count && !status; k++) status = look_at(e, &list[k], err);
    if (status) return status;
    mark_located(e, c);
    events_overlay(e, e->here.x);
    e->awaits = false;
    e->partial = true;
    for (size_t k = 0; k < count && !status; k++) {
        const bool root = e->rules.rule[list[k].rule].kind == RULE_ROOT;
        status = (root ? ask_root : ask_condition)(e, list[k].rule, list[k].instance, c, &acted, &again, err);
    }
    return status;
}

motus_status events_complete(events *e, motus_error *err)
{
    if (!e->partial) return MOTUS_OK;
    const motus_status status = look_at_all(e, err);
    for (size_t f = 0; f < e->rules.functions; f++) e->zero[f] |= e->fired[f] == e->here.t;
    e->partial = false;
    return status;
}

motus_status events_fire(events *e, const candidate *c, bool *assigned, motus_error *err)
{
    asked list[ASKED_MOST];
    size_t count;
    if (asks_few(e, c, list, &count)) return fire_few(e, c, list, count, err);
    bool again = true;
    e->partial = false;
    motus_status status = look_at_all(e, err);
    if (status) return status;
    mark_located(e, c);
    for (size_t f = 0; f < e->rules.functions; f++) e->level[f] |= rests(e, f);
    if (ends_step(e, c)) {
        status = touch_too(e, err);
        if (status) return status;
    }
    memset(e->ticked, 0, e->rules.count);
    see_arrivals(e);
    memset(e->arrives, 0, e->rules.functions);
    events_overlay(e, e->here.x);
    const size_t last = e->rules.count - 1;
    memcpy(e->steady, e->held, e->instances[last] + e->rules.rule[last].instances);
    bool waits = awaits_switch(e, c);
    while (again && !status) {
        again = false;
        e->awaits = waits && awaits_switch(e, c);
        for (size_t k = 0; k < e->rules.count && !status; k++) status = ask(e, k, c, assigned, &again, err);
        if (e->awaits && !again) waits = false, again = true; /* the switch does not turn */
    }
    if (*assigned && !status) events_stand(e);
    memset(e->level, 0, e->rules.functions);
    return status;
}
