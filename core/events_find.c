/* What may happen in a step: the roots of all functions on its dense output, and the ticks of clocks. See
 * events_parts.h. */
#include "core/events_parts.h"

#include <math.h>
#include <string.h>

enum { ROOTS_ROOM = 64 }; /* of one function in one step; more are found piece by piece */

/* Dense output errs by far less than this part of a function's largest value on the step; where a function comes nearer
 * to 0, or a root lies where it hardly leaves 0, true steps tell what happens. It costs time alone. */
#define SLACK 0x1p-13

bool events_add(events *e, candidate c)
{
    if (e->candidates == e->candidate_room) {
        const size_t room = e->candidate_room ? 2 * e->candidate_room : 16;
        candidate *more = take(&e->allocator, room, sizeof *more);
        if (!more) return false;
        if (e->candidates) memcpy(more, e->candidate, e->candidates * sizeof *more);
        give(&e->allocator, e->candidate);
        e->candidate = more;
        e->candidate_room = room;
    }
    e->candidate[e->candidates++] = c;
    return true;
}

static double time_at(const events *e, double tau) { return tau >= 1 ? e->span : tau * e->span; }

/* Room for the values at degree + 1 points. */
static bool room_for(events *e, int degree)
{
    if (degree + 1 <= e->samples_room) return true;
    const size_t room = (size_t)degree + 1;
    double *more = take(&e->allocator, room * e->rules.functions, sizeof *more);
    if (!more) return false;
    give(&e->allocator, e->samples);
    e->samples = more;
    e->samples_room = degree + 1;
    return true;
}

static motus_status sample(events *e, stepper *s, int degree, motus_error *err)
{
    const size_t n = e->rules.functions;
    if (!room_for(e, degree)) return fail(err, MOTUS_MEMORY, "no memory for the events of a step");
    memcpy(e->samples, e->left.g, n * sizeof *e->samples);
    memcpy(e->samples + (size_t)degree * n, e->right.g, n * sizeof *e->samples);
    instant *at = &e->next;
    motus_status status = MOTUS_OK;
    for (int k = 1; k < degree && !status; k++) {
        at->t = e->left.t + (e->left.lost + time_at(e, roots_point(k, degree)));
        status = stepper_sample(s, at->t, at->x, at->v, err);
        if (!status) status = events_values(e, at, err);
        memcpy(e->samples + (size_t)k * n, at->g, n * sizeof *at->g);
    }
    return status;
}

/* p(tau), by Clenshaw's formula. */
static double polynomial(const double *c, int degree, double tau)
{
    const double z = 2 * tau - 1;
    double one = 0, two = 0;
    for (int k = degree; k > 0; k--) {
        const double sum = c[k] + (2 * z * one - two);
        two = one;
        one = sum;
    }
    return c[0] + (z * one - two);
}

typedef struct search {
    const double *coefficients;
    int degree;
    double noise, slack;
} search;

/* The candidates of one function, from its roots. */
static bool add_roots(events *e, size_t f, const search *of, const roots_root *root, const roots_found *found)
{
    const rule *rule = &e->rules.rule[e->rule_of[f]];
    for (size_t k = 0; k < found->count; k++) {
        const roots_root *r = &root[k];
        const double before = k ? root[k - 1].to : 0, after = k + 1 < found->count ? root[k + 1].from : 1;
        const double low = before + (r->from - before) / 2, high = r->to + (after - r->to) / 2;
        candidate c = {.of = f,
                       .at = time_at(e, r->tau),
                       .low = time_at(e, low),
                       .high = time_at(e, high),
                       .near = r->kind == ROOTS_NEAR || r->kind == ROOTS_TOUCH,
                       .kind = r->kind == ROOTS_RISING    ? CANDIDATE_RISES
                               : r->kind == ROOTS_FALLING ? CANDIDATE_FALLS
                                                          : (candidate_kind)r->side};
        if (r->open && e->right.t != e->until) { /* the next step tells it again, and which way it goes on */
            e->open[f] = 1;
            continue;
        }
        c.sure = !c.near && (r->from <= 0 || fabs(polynomial(of->coefficients, of->degree, low)) > of->slack) &&
                 (r->to >= 1 || fabs(polynomial(of->coefficients, of->degree, high)) > of->slack);
        /* that it passes the other way is no event, and needs no true steps */
        c.idle = c.sure && rule->kind == RULE_ROOT && rule->direction == -c.kind;
        if (!events_add(e, c)) return false;
    }
    return true;
}

/* A function that stood at 0 at the start of the step has left it: whether that is an event. */
static bool leave(events *e, size_t f, const roots_found *found)
{
    const int after = found->after, side = e->side[f], heads = e->heads[f];
    e->heads[f] = 0;
    e->hidden |= heads && after != heads;
    if (!after) return true; /* it stays there */
    if (side && after != side)
        return events_add(e, (candidate){.of = f, .at = 0, .kind = (candidate_kind)after, .located = true});
    if (side) return true;
    if (e->first && found->leaves < 1) { /* the start is no event */
        e->side[f] = (int8_t)after;
        return true;
    }
    const double t = found->leaves < 0x1p-20 ? 0 : time_at(e, found->leaves);
    return events_add(
        e, (candidate){.of = f, .at = t, .low = t, .high = t, .kind = (candidate_kind)after, .located = true});
}

/* The largest value of a function at the points, and its largest slope between two of them; where it stands at 0, which
 * its first value is but for rounding, from that value on. */
static double size_of(const events *e, size_t f, int degree, double *steepest)
{
    const size_t n = e->rules.functions;
    const double *at = e->samples + f, first = e->stands[f] ? at[0] : 0;
    double largest = fabs(at[0] - first);
    *steepest = 0;
    for (int k = 1; k <= degree; k++) {
        const double value = at[(size_t)k * n], before = at[(size_t)(k - 1) * n];
        largest = fmax(largest, fabs(value - first));
        *steepest = fmax(*steepest, fabs(value - before) / (roots_point(k, degree) - roots_point(k - 1, degree)));
    }
    return largest;
}

static motus_status find_of(events *e, stepper *s, size_t f, int *degree, motus_error *err)
{
    double coefficients[ROOTS_DEGREE_MOST + 1];
    const size_t n = e->rules.functions;
    if (isnan(e->left.g[f]) && isnan(e->right.g[f])) return MOTUS_OK; /* a cell without a rule */
    for (;;) {
        roots_fitted fitted;
        double steepest;
        const double largest = size_of(e, f, *degree, &steepest);
        /* The bounds on rounding are computed only where an event was near; most steps need none. The times of the
         * points are rounded, too, which counts in steps that are short beside the time. */
        const double ulp = events_ulp(e->right.t), h = fabs(e->span);
        const double rounding = largest * 0x1p-44 + steepest * ulp / h;
        const roots_fit_status fit = roots_fit(e->samples + f, n, *degree, rounding, coefficients, &fitted);
        if (fit == ROOTS_FIT_NOT_FINITE) return MOTUS_OK;
        if (fit == ROOTS_FIT_ROUGH && *degree < ROOTS_DEGREE_MOST &&
            !roots_none(coefficients, fitted.degree, SLACK * largest + fitted.noise + fitted.unseen)) {
            *degree *= 2;
            const motus_status status = sample(e, s, *degree, err);
            if (status) return status;
            continue;
        }
        if (!e->stands[f] && !e->open[f] && roots_none(coefficients, fitted.degree, SLACK * largest + fitted.noise))
            return MOTUS_OK;
        motus_status status = MOTUS_OK;
        if (!e->marked) { /* the bounds at both ends, once a step */
            status = events_judge(e, &e->left, err);
            if (!status) status = events_judge(e, &e->right, err);
            if (status) return status;
            e->marked = true;
        }
        const double noise = fmax(e->left.bound[f], e->right.bound[f]) + steepest * ulp / h + (fitted.noise - rounding);
        const search of = {coefficients, fitted.degree, noise, fmax(SLACK * largest, 2 * noise)};
        roots_root root[ROOTS_ROOM];
        roots_found found;
        roots_find(coefficients, fitted.degree, e->stands[f] ? 0 : e->side[f], noise, of.slack, root, ROOTS_ROOM,
                   &found);
        if (e->stands[f] && !leave(e, f, &found)) return fail(err, MOTUS_MEMORY, "no memory for the events of a step");
        e->stands[f] = e->stands[f] && !found.after;
        const bool open = e->open[f] && !(found.count && root[0].from <= 0); /* it went back: a touch at the start */
        e->open[f] = 0;
        if (open && !events_add(e, (candidate){.of = f, .kind = CANDIDATE_TOUCHES, .located = true}))
            return fail(err, MOTUS_MEMORY, "no memory for the events of a step");
        if (!add_roots(e, f, &of, root, &found)) return fail(err, MOTUS_MEMORY, "no memory for the events of a step");
        return MOTUS_OK;
    }
}

double events_tick(const events *e, size_t k)
{
    return e->start + e->way * (double)(e->ticks[k] + 1) * e->rules.rule[k].period;
}

static bool add_ticks(events *e)
{
    for (size_t k = 0; k < e->rules.count; k++) {
        const rule *r = &e->rules.rule[k];
        if (r->kind != RULE_CLOCK) continue;
        double at = (events_tick(e, k) - e->left.t) - e->left.lost;
        if (fabs(at - e->span) <= 4 * events_ulp(e->right.t)) at = e->span;
        if (e->way * at < 0 || e->way * (e->span - at) < 0) continue;
        if (!events_add(e, (candidate){.kind = CANDIDATE_TIME, .of = k, .at = at, .low = at, .high = at})) return false;
    }
    return true;
}

motus_status events_find(events *e, stepper *s, motus_error *err)
{
    int degree = ROOTS_DEGREE_LEAST;
    const size_t flags = 4 * e->rules.functions;
    e->candidates = 0;
    e->hidden = false;
    memcpy(e->was, e->side, flags);
    e->shift = 0;
    e->marked = false;
    motus_status status = e->rules.functions ? sample(e, s, degree, err) : MOTUS_OK;
    for (size_t f = 0; f < e->rules.functions && !status; f++) status = find_of(e, s, f, &degree, err);
    if (e->hidden) memcpy(e->side, e->was, flags);
    if (!status && !add_ticks(e)) status = fail(err, MOTUS_MEMORY, "no memory for the events of a step");
    return status;
}
