/* Steps that are taken many at a time, because bounds on a box around the motion prove that nothing happens in them.
 * See events_parts.h. */
#include "core/events_parts.h"

#include <math.h>
#include <string.h>

#include "core/scalar.h"
#include "step/box.h"

/* Raises `most` to the sizes of numbers, in every step: by a comparison, which costs less than a call of fmax. */
static void raise_to(double *most, const double *numbers, size_t count)
{
    for (size_t k = 0; k < count; k++)
        if (fabs(numbers[k]) > most[k]) most[k] = fabs(numbers[k]);
}

void events_extend(events *e, const double *x, const double *v)
{
    raise_to(e->most, x, e->problem.nx);
    raise_to(e->most + e->problem.nx, v, e->problem.nv);
}

/* Computes the box of a step, widened by the error of the motion, with its middle in `next`, and in `before` a lower
 * bound on the size of every function in it. */
static void look_at_box(events *e, const stepper_shown *step)
{
    const size_t nx = e->problem.nx, nv = e->problem.nv;
    const box to = {e->next.x, e->next.v, e->width, e->width + nx};
    box_of(&to, nx, nv, step->span, step->from_x, step->from_v, step->to_x, step->to_v, step->most);
    events_widen(e); /* so that extrema which the exact motion may lead beyond 0 are found */
    e->rules.least(e->rules.ctx, to.x, to.v, to.dx, to.dv, e->before);
}

bool events_box(events *e, stepper *s)
{
    const instant *from = &e->left, *to = &e->right;
    double *most = e->next.a;
    if (e->boxed) return true;
    if (!e->rules.least || e->problem.refresh || !stepper_swing(s, most)) return false;
    look_at_box(e, &(stepper_shown){e->span, from->t, to->t, from->x, from->v, to->x, to->v, most});
    return true;
}

/* Tells whether a function, by its values at the ends, passes 0 in the direction that its rule does not ask for. */
static bool turns_away(const events *e, size_t f)
{
    const rule *r = &e->rules.rule[e->rule_of[f]];
    const double before = r->direction * e->left.g[f], after = r->direction * e->right.g[f];
    return r->kind == RULE_ROOT && !r->internal && before > 0 && after < 0;
}

/* Tells whether nothing happens in a step although its box does not exclude roots of the marked functions: each passes
 * 0 once, in the direction that its rule does not ask for. Sides change when the watch ends, since a step may be shown
 * twice. */
static bool passes_idly(events *e, const stepper_shown *step)
{
    const size_t n = e->rules.functions, nx = e->problem.nx, nv = e->problem.nv;
    instant *from = &e->left, *to = &e->right;
    from->t = step->from_t, to->t = step->to_t;
    memcpy(from->x, step->from_x, nx * sizeof *from->x), memcpy(from->v, step->from_v, nv * sizeof *from->v);
    memcpy(to->x, step->to_x, nx * sizeof *to->x), memcpy(to->v, step->to_v, nv * sizeof *to->v);
    if (events_value_ends(e, NULL)) return false;
    for (size_t f = 0; f < n; f++)
        if (e->look[f] && !turns_away(e, f)) return false;
    e->boxed = false;
    e->rules.least_rates(e->rules.ctx, e->next.x, e->next.v, e->width, e->width + nx, e->before);
    if (events_bounds(e, from, NULL) || events_bounds(e, to, NULL)) return false;
    for (size_t f = 0; f < n; f++) {
        if (!e->look[f]) continue;
        const bool known = e->passed[f] || e->side[f] == (from->g[f] > 0 ? 1 : -1);
        if (!known || !(e->before[f] > 0) || !events_clear(e, f)) return false;
    }
    for (size_t f = 0; f < n; f++) e->passed[f] |= e->look[f];
    return true;
}

static bool quiet(void *ctx, const stepper_shown *step)
{
    events *e = ctx;
    bool any = false;
    look_at_box(e, step);
    e->boxed = true;
    e->left.valued = e->right.valued = false;
    for (size_t f = 0; f < e->rules.functions; f++) {
        e->look[f] = !(e->before[f] > 0);
        any |= e->look[f];
    }
    return !any || passes_idly(e, step);
}

double events_tick(const events *e, size_t k)
{
    return e->start + e->way * (double)(e->ticks[k] + 1) * e->rules.rule[k].period;
}

double events_next_time(const events *e)
{
    double next = e->rules.next ? e->rules.next(e->rules.ctx, e->way, e->left.t, e->left.x) : e->way * INFINITY;
    for (size_t k = 0; k < e->rules.count; k++) {
        const double tick = e->rules.rule[k].kind == RULE_CLOCK ? events_tick(e, k) : next;
        if (e->way * (next - tick) > 0) next = tick;
    }
    return next;
}

bool events_idle(events *e, const stepper_shown *step)
{
    const double left = e->way * (events_next_time(e) - step->to_t);
    return left > 8 * events_ulp(step->to_t) && quiet(e, step);
}

/* Tells whether bounds may prove of the next step that nothing but ticks of clocks happens in it. */
static bool boundable(const events *e)
{
    if (e->first || e->broken || !e->rules.least) return false;
    for (size_t f = 0; f < e->rules.functions; f++)
        if (e->stands[f] || e->open[f]) return false;
    return true;
}

bool events_watchable(const events *e, const stepper *s)
{
    return isinf(events_next_time(e)) && stepper_can_watch(s) && boundable(e);
}
bool events_bounded(const events *e, const stepper *s) { return stepper_bounded(s) && boundable(e); }

/* Sets the sides of functions that have passed 0 in watched steps, before the last one. */
static motus_status turn_sides(events *e, motus_error *err)
{
    motus_status status = MOTUS_OK;
    for (size_t f = 0; f < e->rules.functions && !status; f++) {
        if (!e->passed[f]) continue;
        if (!e->left.valued) status = events_values(e, &e->left, err);
        e->side[f] = e->left.g[f] > 0 ? 1 : -1;
    }
    return status;
}

motus_status events_led(events *e, stepper *s, int64_t steps, const double *largest, motus_error *err)
{
    instant *at = &e->left;
    const size_t nx = e->problem.nx;
    at->t = stepper_time(s), at->lost = stepper_lost(s);
    at->valued = e->right.valued = e->boxed = false;
    motus_status status = stepper_sync(s, at->x, at->v, NULL, err);
    if (!status) status = turn_sides(e, err);
    memset(e->passed, 0, e->rules.functions);
    events_extend(e, largest, largest + nx);
    e->steps += steps;
    e->taken += steps;
    events_may_look(e, steps);
    return status;
}

motus_status events_shift(events *e, stepper *s, motus_error *err)
{
    instant *const at = &e->left;
    at->valued = e->right.valued = e->boxed = false;
    const motus_status status = stepper_sync(s, at->x, at->v, NULL, err);
    if (!status) events_extend(e, at->x, at->v);
    return status;
}

enum { PAUSE_MOST = 31 };

motus_status events_watch(events *e, stepper *s, stepper_limit limit, stepper_stop *why, motus_error *err)
{
    stepper_left left;
    instant *at = &e->left;
    memset(e->passed, 0, e->rules.functions);
    const stepper_watcher watcher = {.quiet = quiet,
                                     .ctx = e,
                                     .largest = e->most,
                                     .middle = e->next.x,
                                     .width = e->width,
                                     .least = e->before,
                                     .functions = e->rules.functions};
    const motus_status status = stepper_watch(s, limit, &watcher, &left, why, err);
    if (!left.x) return status;
    e->steps += left.steps;
    e->taken += left.steps;
    events_may_look(e, left.steps);
    events_extend(e, left.x, left.v); /* a step that is not shown may have begun there */
    /* where bounds prove nothing, as for functions of the time, they are asked less and less often */
    e->last_pause = left.steps > 0 ? 0 : e->last_pause < PAUSE_MOST ? 2 * e->last_pause + 1 : PAUSE_MOST;
    e->pause = e->last_pause;
    e->boxed &= left.shown;
    at->valued &= left.shown;
    e->right.valued &= left.shown;
    at->t = left.t, at->lost = left.lost;
    memcpy(at->x, left.x, e->problem.nx * sizeof *at->x);
    memcpy(at->v, left.v, e->problem.nv * sizeof *at->v);
    const motus_status turned = turn_sides(e, status ? NULL : err);
    return status ? status : turned;
}
