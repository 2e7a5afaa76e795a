/* Switches of the force that turn ever faster. See events_parts.h.
 *
 * A cycle is the time between two turns of a switch to one side. Where a motion comes to rest by ever shorter swings,
 * as under -2 sign(x) - sign(x'), cycles shorten by a nearly constant factor. Whatever the factor, their lengths then
 * lie on a straight line over the time, and this line tells when they reach 0. Lengths that fall ever more slowly, as
 * under -sign(x) - x'/2, never reach 0, but there is no end of their number either.
 *
 * Only the SWARMS switches that turned last are kept; those that turn ever faster are always among them.
 */
#include "core/events_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Switches accumulate when the time left to the limit is below SHORT_PART of the longest cycle: the motion left is then
 * below its rounding, since positions fall with the square of times. Or when the time left is below SHORT_ULPS units in
 * the last place of the time. */
#define SHORT_PART 0x1p-26
enum { SHORT_ULPS = 512, LOST_ULPS = 16, TRUSTED = 4, MANY = 1000 };

void events_swarm_forget(events *e)
{
    for (int k = 0; k < SWARMS; k++) e->swarm[k].count = 0;
}

static double *state_of(const events *e, const swarm *s, int parity)
{
    return e->swarm_state + (size_t)(2 * (s - e->swarm) + parity) * (e->problem.nx + e->problem.nv);
}

/* Returns the slot of a function's switch; a new one takes the slot that is free or has not turned for longest. */
static swarm *swarm_of(events *e, size_t f)
{
    swarm *oldest = e->swarm;
    for (swarm *s = e->swarm; s < e->swarm + SWARMS; s++) {
        if (s->count && s->function == f) return s;
        if (!s->count || (oldest->count && e->way * (oldest->t[0] - s->t[0]) > 0)) oldest = s;
    }
    *oldest = (swarm){.function = f};
    return oldest;
}

/* Returns how fast the lengths of cycles fell between two marks. */
static double fall(const swarm_mark *from, const swarm_mark *to)
{
    return (from->cycle - to->cycle) / fabs(to->t - from->t);
}

static motus_status endless(const events *e, const swarm *s, const char *how, motus_error *err)
{
    char t[DECIMAL_MAX], name[MOTUS_NAME_MAX] = "";
    const size_t k = e->rule_of[s->function];
    const double now = e->here.t;
    if (e->rules.name) e->rules.name(e->rules.ctx, k, s->function - e->rules.rule[k].first, name, sizeof name);
    fail(err, MOTUS_EVENTS, "the force jumps where %s ever more often: %s at t = %s, %.2g apart", name, how,
         decimal_time(now, e->until - e->start, t), s->cycle / 2);
    hint(err, "end the run before, or let the force be smooth there, as tanh(s/0.01) is in place of sign(s)");
    if (!err) return MOTUS_EVENTS;
    err->time = now;
    snprintf(err->variable, sizeof err->variable, "%s", name);
    return MOTUS_EVENTS;
}

/* Moves the motion by a time `left`, to where this switch and those that turn as fast accumulate. */
static motus_status gather(events *e, swarm *s, double left, motus_error *err)
{
    const size_t nx = e->problem.nx, nv = e->problem.nv, moving = nx - e->problem.modes;
    const double part = left / s->cycle, limit = e->here.t + e->way * left;
    const double *before = state_of(e, s, s->parity);
    size_t functions[SWARMS], count = 0;
    for (swarm *o = e->swarm; o < e->swarm + SWARMS; o++) {
        const bool with = o->count && o->shorter >= 2 && fabs(e->here.t - o->t[0]) <= 2 * s->cycle &&
                          o->cycle <= 4 * s->cycle && s->cycle <= 4 * o->cycle;
        if (with) functions[count++] = o->function, o->count = 0;
    }
    e->here.t = e->way * (limit - e->until) > 0 ? e->until : limit;
    e->here.lost = 0;
    for (size_t k = 0; k < moving; k++) e->here.x[k] += part * (e->here.x[k] - before[k]);
    for (size_t k = 0; k < nv; k++) e->here.v[k] += part * (e->here.v[k] - before[nx + k]);
    return e->rules.gather(e->rules.ctx, functions, count, e->way, e->here.t, e->here.x, e->here.v, err);
}

/* Decides, when the lengths have halved since the last mark, whether they reach 0 shortly, and gathers the switches. */
static motus_status judge(events *e, swarm *s, motus_error *err)
{
    const double ulp = events_ulp(e->here.t);
    const swarm_mark now = {e->here.t, s->cycle};
    const double before = fall(&s->mark[0], &s->mark[1]), after = fall(&s->mark[1], &now), left = s->cycle / after;
    const double unsure = 0.02 + 8 * ulp / (s->mark[1].cycle - now.cycle);
    s->slows = after < 0.75 * before;
    const bool nears = left <= fmax(SHORT_PART * s->longest, SHORT_ULPS * ulp);
    if (nears && fabs(after - before) <= unsure * before && e->rules.gather && s->shorter >= TRUSTED)
        return gather(e, s, left, err);
    return MOTUS_OK;
}

static void set_mark(swarm *s, double t)
{
    if (s->marks == 2) s->mark[0] = s->mark[1], s->marks = 1;
    s->mark[s->marks++] = (swarm_mark){t, s->cycle};
}

/* Tells whether cycles shorten ever more slowly, and more are left before the end than can be taken. */
static bool multiplies(const events *e, const swarm *s)
{
    const double more = fabs(e->until - e->here.t) / s->cycle;
    return s->shorter >= MANY && s->slows && more > 1e5;
}

motus_status events_swarm(events *e, size_t function, motus_error *err)
{
    swarm *s = swarm_of(e, function);
    const double t = e->here.t;
    const size_t nx = e->problem.nx, nv = e->problem.nv;
    motus_status status = MOTUS_OK;
    e->pace = INFINITY;
    if (s->count >= 2) {
        const double cycle = fabs(t - s->t[1]);
        const bool shorter = s->count > 2 && cycle < s->cycle;
        s->shorter = shorter ? s->shorter + 1 : 0;
        s->cycle = cycle;
        if (s->shorter >= TRUSTED) e->pace = 2 * cycle;
        if (!shorter) s->longest = cycle, s->marks = 0, s->slows = false;
        s->parity = !s->parity;
        if (s->marks == 2 && cycle <= s->mark[1].cycle / 2) status = judge(e, s, err);
        if (status) return status;
        if (s->shorter >= TRUSTED && cycle > 0 && cycle <= LOST_ULPS * events_ulp(t) && s->count)
            return endless(e, s, "they cannot be told apart", err);
        if (s->count && multiplies(e, s)) return endless(e, s, "there is no end of them", err);
        if (s->count && (s->marks == 0 || cycle <= s->mark[s->marks - 1].cycle / 2)) set_mark(s, t);
    } else {
        s->parity = s->count;
    }
    double *state = state_of(e, s, s->parity);
    memcpy(state, e->here.x, nx * sizeof *state);
    memcpy(state + nx, e->here.v, nv * sizeof *state);
    s->t[1] = s->t[0], s->t[0] = t;
    if (s->count < 3) s->count++;
    return MOTUS_OK;
}
