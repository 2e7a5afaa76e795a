/* The functions of events with their rates and bounds at an instant, and true steps to an instant. See events_parts.h.
 */
#include "core/events_parts.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

double events_ulp(double t)
{
    const double size = fabs(t);
    double above;
    uint64_t bits;
    memcpy(&bits, &size, sizeof bits);
    bits++; /* of the next larger number */
    memcpy(&above, &bits, sizeof above);
    return above - size;
}

motus_status events_refuse(const events *e, const char *which, double t, int answer, motus_error *err)
{
    char text[DECIMAL_MAX];
    fail(err, MOTUS_CALLBACK, "the %s callback reported a failure at t = %s", which,
         decimal_time(t, e->until - e->start, text));
    if (err) err->time = t, err->returned = answer;
    return MOTUS_CALLBACK;
}

motus_status events_values(events *e, instant *at, motus_error *err)
{
    at->valued = true;
    if (e->rules.functions == 0) return MOTUS_OK;
    const int answer = e->rules.values(e->rules.ctx, at->t, at->x, at->v, at->g);
    return answer ? events_refuse(e, "event_functions", at->t, answer, err) : MOTUS_OK;
}

motus_status events_value_ends(events *e, motus_error *err)
{
    motus_status status = e->left.valued ? MOTUS_OK : events_values(e, &e->left, err);
    if (!status && !e->right.valued) status = events_values(e, &e->right, err);
    return status;
}

/* Evaluates the functions a time h after an instant whose acceleration is known, at the state that Taylor's formula
 * gives. */
static motus_status values_after(events *e, const instant *at, double h, instant *to, motus_error *err)
{
    const problem *p = &e->problem;
    to->t = at->t + h;
    for (size_t k = 0; k < p->nv; k++) {
        if (k < p->nx) to->x[k] = at->x[k] + h * (at->v[k] + h / 2 * at->a[k]);
        to->v[k] = at->v[k] + h * at->a[k];
    }
    return events_values(e, to, err);
}

/* Estimates the bounds that are not finite, because no formula is known or its slope is infinite: by the change of the
 * function when every number changes by its rounding. */
static motus_status estimate_bounds(events *e, instant *at, motus_error *err)
{
    instant *to = &e->next;
    bool any = false;
    for (size_t k = 0; k < e->rules.functions; k++) any |= isfinite(at->g[k]) && !isfinite(at->bound[k]);
    if (!any) return MOTUS_OK;
    for (int sign = -1; sign <= 1; sign += 2) {
        to->t = at->t + events_ulp(at->t);
        for (size_t k = 0; k < e->problem.nx; k++) to->x[k] = at->x[k] + (k % 2 ? sign : 1) * events_ulp(at->x[k]);
        for (size_t k = 0; k < e->problem.nv; k++) to->v[k] = at->v[k] + (k % 2 ? sign : 1) * events_ulp(at->v[k]);
        const motus_status status = events_values(e, to, err);
        if (status) return status;
        for (size_t k = 0; k < e->rules.functions; k++) {
            if (sign < 0) to->bound[k] = 0;
            const double change = fabs(to->g[k] - at->g[k]);
            if (isfinite(change)) to->bound[k] = fmax(to->bound[k], 2 * change);
        }
    }
    for (size_t k = 0; k < e->rules.functions; k++)
        if (isfinite(at->g[k]) && !isfinite(at->bound[k])) at->bound[k] = fmax(to->bound[k], 2 * events_ulp(at->g[k]));
    return MOTUS_OK;
}

motus_status events_bounds(events *e, instant *at, motus_error *err)
{
    if (e->rules.rounding)
        e->rules.rounding(e->rules.ctx, at->t, at->x, at->v, at->bound);
    else
        for (size_t k = 0; k < e->rules.functions; k++) at->bound[k] = INFINITY;
    return estimate_bounds(e, at, err);
}

/* Evaluates the accelerations, if rates read them. */
static motus_status accelerate(const events *e, instant *at, motus_error *err)
{
    const problem *p = &e->problem;
    if (e->rules.rates && e->rules.rates_without_a) return MOTUS_OK;
    memset(at->a, 0, p->nv * sizeof *at->a);
    return p->accel(p->ctx, at->t, at->x, at->v, at->a)
               ? events_refuse(e, "acceleration", at->t, p->returned ? *p->returned : 0, err)
               : MOTUS_OK;
}

motus_status events_rates(events *e, instant *at, motus_error *err)
{
    if (e->rules.functions == 0) return MOTUS_OK;
    motus_status status = accelerate(e, at, err);
    if (status) return status;
    if (e->rules.rates) {
        const int answer = e->rules.rates(e->rules.ctx, at->t, at->x, at->v, at->a, at->rate);
        return answer ? events_refuse(e, "event_functions", at->t, answer, err) : MOTUS_OK;
    }
    /* central differences; `best` is free, since `crossing`, which alone needs it, asks for the rates at `here` */
    const double h = e->way * fmax(0x1p-16 * fabs(e->span), 64 * events_ulp(at->t));
    instant *to = at == &e->next ? &e->best : &e->next;
    status = values_after(e, at, -h, to, err);
    if (!status) memcpy(at->rate, to->g, e->rules.functions * sizeof *at->rate);
    if (!status) status = values_after(e, at, h, to, err);
    for (size_t k = 0; k < e->rules.functions && !status; k++) at->rate[k] = (to->g[k] - at->rate[k]) / (2 * h);
    return status;
}

motus_status events_judge(events *e, instant *at, motus_error *err)
{
    const motus_status status = events_rates(e, at, err);
    return status || e->rules.functions == 0 ? status : events_bounds(e, at, err);
}

static double alone(const events *e, rule_number what, size_t f, const instant *at)
{
    return e->rules.alone(e->rules.ctx, what, f, at->t, at->x, at->v, at->a);
}

motus_status events_value_of(events *e, size_t f, instant *at, motus_error *err)
{
    if (!e->rules.alone) return events_values(e, at, err);
    at->valued = false;
    at->g[f] = alone(e, RULE_VALUE, f, at);
    return MOTUS_OK;
}

motus_status events_rate_of(events *e, size_t f, instant *at, motus_error *err)
{
    if (!e->rules.alone) return events_rates(e, at, err);
    const motus_status status = accelerate(e, at, err);
    if (!status) at->rate[f] = alone(e, RULE_RATE, f, at);
    return status;
}

motus_status events_bound_of(events *e, size_t f, instant *at, motus_error *err)
{
    if (!e->rules.alone) return events_bounds(e, at, err);
    at->bound[f] = alone(e, RULE_ROUNDING, f, at);
    if (isfinite(at->bound[f]) || !isfinite(at->g[f])) return MOTUS_OK;
    const motus_status status = events_values(e, at, err);
    return status ? status : events_bounds(e, at, err);
}

motus_status events_judge_of(events *e, size_t f, instant *at, motus_error *err)
{
    const motus_status status = events_rate_of(e, f, at, err);
    return status ? status : events_bound_of(e, f, at, err);
}

int events_direction(const events *e, const instant *at, size_t f)
{
    const double rate = e->way * at->rate[f], change = rate * fabs(e->span);
    return fabs(change) > 4 * at->bound[f] && !(at == &e->here && e->level[f]) ? (rate > 0) - (rate < 0) : 0;
}

void events_copy(const events *e, instant *to, const instant *from)
{
    to->t = from->t;
    to->lost = from->lost;
    to->valued = from->valued;
    memcpy(to->x, from->x, e->problem.nx * sizeof *to->x);
    memcpy(to->v, from->v, e->problem.nv * sizeof *to->v);
    if (e->rules.functions) memcpy(to->g, from->g, e->rules.functions * sizeof *to->g);
}

enum { PARTS = 2, PARTS_ULPS = 1 << 12, HALVINGS_MOST = 100 };

motus_status events_probe(events *e, double from, double lost, const double *x, const double *v, double h, double *t,
                          double *rest, motus_error *err)
{
    const double end = from + (lost + h), over = (end - from) - h; /* over: the rounding of `end`, and `lost` */
    const bool adaptive = row_adaptive(&e->method);
    /* a companion that took the one step of the run to an event would have its error */
    const int parts = e->jog && !adaptive && fabs(h) > PARTS_ULPS * events_ulp(end) ? PARTS : 1;
    const stepper_limit limit = adaptive ? (stepper_limit){INT64_MAX, end} : (stepper_limit){parts, NAN};
    const double step = h / parts;
    motus_status status = MOTUS_OK;
    *t = end;
    *rest = lost - over;
    if (!e->probe) {
        chosen method = e->method;
        if (row_reversible_steps(&method)) method.relative = HUGE_VAL; /* one step leads to `end`, whatever its size */
        status = stepper_create(&e->machine, &method, from, step, x, v, &e->allocator, &e->probe, err);
    }
    if (!status) status = stepper_branch(e->probe, e->along, from, over, step, x, v, err);
    return status ? status : stepper_advance(e->probe, limit, NULL, err);
}

/* Writes the state a time h after `left`, by a true step. *ends: it is an end of the step, whose values are known. */
static motus_status state_at(events *e, double h, instant *to, bool *ends, motus_error *err)
{
    const instant *from = &e->left;
    /* h is too short for a step; near t = 0 times can be far shorter than any that a step shows */
    const bool still = from->t + h == from->t || (from->t == 0 && fabs(h) < 0x1p-100 * fabs(e->span));
    *ends = still || h == e->span;
    if (*ends) {
        events_copy(e, to, still ? from : &e->right);
        return MOTUS_OK;
    }
    motus_status status = events_probe(e, from->t, from->lost, from->x, from->v, h, &to->t, &to->lost, err);
    return status ? status : stepper_sync(e->probe, to->x, to->v, NULL, err);
}

motus_status events_at(events *e, double h, instant *to, motus_error *err)
{
    bool ends;
    const motus_status status = state_at(e, h, to, &ends, err);
    return status || ends ? status : events_values(e, to, err);
}

motus_status events_at_of(events *e, size_t f, double h, instant *to, motus_error *err)
{
    bool ends;
    const motus_status status = state_at(e, h, to, &ends, err);
    return status || ends ? status : events_value_of(e, f, to, err);
}

double events_place_in(const events *e, double h)
{
    const double t = e->left.t + (e->left.lost + h);
    if (e->way * (t - e->left.t) < 0) return e->left.t;
    return e->way * (e->right.t - t) < 0 ? e->right.t : t;
}

motus_status events_has_values(events *e, const instant *at, motus_error *err)
{
    motus_status status = MOTUS_OK;
    for (size_t f = 0; e->rules.undefined && f < e->rules.functions && !status; f++)
        if (isnan(at->g[f])) status = e->rules.undefined(e->rules.ctx, f, at->t, at->t, at->x, at->v, err);
    return status;
}

motus_status events_keeps_values(events *e, motus_error *err)
{
    motus_status status = MOTUS_OK;
    for (size_t f = 0; e->rules.undefined && e->right.valued && f < e->rules.functions && !status; f++) {
        if (!isnan(e->right.g[f]) || isnan(e->left.g[f])) continue;
        double low = 0, high = e->span;
        events_copy(e, &e->next, &e->right);
        for (int k = 0; k < HALVINGS_MOST && !status && fabs(high - low) > 2 * events_ulp(e->right.t); k++) {
            const double h = low + (high - low) / 2;
            status = events_at_of(e, f, h, &e->next, err);
            *(isnan(e->next.g[f]) ? &high : &low) = h;
        }
        if (!status) status = events_at_of(e, f, high, &e->next, err);
        const instant *at = &e->next;
        const double last = events_place_in(e, low);
        if (!status) status = e->rules.undefined(e->rules.ctx, f, last, at->t, at->x, at->v, err);
    }
    return status;
}
