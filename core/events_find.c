/* What may happen in a step: the roots of all functions on its dense output, and the ticks of clocks. See
 * events_parts.h. */
#include "core/events_parts.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

/* ROOTS_ROOM: most roots of one function in one part of a step. Where a polynomial of degree PART_DEGREE does not
 * resolve a function, the part is halved, at most PARTS_DEEP times. */
enum { ROOTS_ROOM = 128, PART_DEGREE = 64, PARTS_DEEP = 12 };

/* A part of the step, or all of it, in which a polynomial is to fit a function. */
typedef struct part {
    double from, to;
    int depth;
} part;

static double time_at(const events *e, double tau) { return tau >= 1 ? e->span : tau * e->span; }

/* Makes room for the values at degree + 1 points, and after them for the arguments. False: no memory. */
static bool room_for(events *e, int degree)
{
    if (degree + 1 <= e->samples_room) return true;
    const size_t room = (size_t)degree + 1;
    double *more = take(&e->allocator, room * e->rules.functions * (1 + e->rules.arguments), sizeof *more);
    if (!more) return false;
    give(&e->allocator, e->samples);
    e->samples = more;
    e->arguments = more + room * e->rules.functions;
    e->samples_room = degree + 1;
    return true;
}

static void sample_arguments(events *e, const instant *at, int k)
{
    const size_t each = e->rules.arguments * e->rules.functions;
    if (each) e->rules.arguments_at(e->rules.ctx, at->t, at->x, at->v, e->arguments + (size_t)k * each);
}

static motus_status sample(events *e, stepper *s, int degree, motus_error *err)
{
    const size_t n = e->rules.functions;
    if (!room_for(e, degree)) return events_no_memory(err);
    memcpy(e->samples, e->left.g, n * sizeof *e->samples);
    memcpy(e->samples + (size_t)degree * n, e->right.g, n * sizeof *e->samples);
    sample_arguments(e, &e->left, 0);
    sample_arguments(e, &e->right, degree);
    instant *at = &e->next;
    motus_status status = MOTUS_OK;
    for (int k = 1; k < degree && !status; k++) {
        at->t = events_place_in(e, time_at(e, roots_point(k, degree)));
        status = stepper_sample(s, at->t, at->x, at->v, err);
        if (!status) status = events_values(e, at, err);
        memcpy(e->samples + (size_t)k * n, at->g, n * sizeof *at->g);
        sample_arguments(e, at, k);
    }
    return status;
}

/* Evaluates one function at the points of a part of the step. */
static motus_status sample_part(events *e, stepper *s, size_t f, const part *p, double *values, motus_error *err)
{
    instant *at = &e->next;
    motus_status status = MOTUS_OK;
    for (int k = 0; k <= PART_DEGREE && !status; k++) {
        const double tau = p->from + roots_point(k, PART_DEGREE) * (p->to - p->from);
        if (tau <= 0 || tau >= 1) {
            values[k] = tau <= 0 ? e->left.g[f] : e->right.g[f];
            continue;
        }
        at->t = events_place_in(e, time_at(e, tau));
        status = stepper_sample(s, at->t, at->x, at->v, err);
        if (!status) status = events_value_of(e, f, at, err);
        values[k] = at->g[f];
    }
    return status;
}

typedef struct search {
    const part *part;
    const double *coefficients;
    int degree;
    double slack;
} search;

static double place_of(const events *e, const search *of, double tau)
{
    return time_at(e, of->part->from + tau * (of->part->to - of->part->from));
}

/* Returns the largest size of the polynomial between two roots, and tells where it is, if that is at most the slack;
 * else any size above the slack. */
static double depth_between(const search *of, const roots_root *a, const roots_root *b, double *at)
{
    enum { POINTS = 16 };
    double most = 0;
    *at = a->tau + (b->tau - a->tau) / 2;
    const double middle = fabs(events_polynomial(of->coefficients, of->degree, *at));
    if (middle > of->slack) return middle;
    for (int k = 1; k < POINTS; k++) {
        const double tau = a->tau + (b->tau - a->tau) * k / POINTS;
        const double size = fabs(events_polynomial(of->coefficients, of->degree, tau));
        if (size > most) most = size, *at = tau;
    }
    return most;
}

/* Returns the number of the root that makes a pair with root k: they are so near that true steps must decide whether
 * there are two, one or none. Returns k if there is no such root. *at: the extremum between them. */
static size_t pair_of(const search *of, const roots_root *root, size_t count, size_t k, double *at)
{
    const roots_root *a = &root[k];
    size_t j = k + 1;
    while (j < count && root[j].kind == ROOTS_NEAR) j++;
    if (j == count || a->open || root[j].open || (int)a->kind * (int)root[j].kind != -1) return k;
    return depth_between(of, a, &root[j], at) <= of->slack ? j : k;
}

/* Tells whether the function ends the step within its error of 0, on either side, and so slowly that only the next step
 * decides whether it touches 0. */
static motus_status lingers(events *e, size_t f, const search *of, const roots_root *last, bool *does, motus_error *err)
{
    const roots_root end = {.tau = 1};
    double at, bound = 0;
    *does = false;
    if (of->part->to < 1 || fabs(e->right.rate[f] * e->span) > 8 * of->slack) return MOTUS_OK;
    if (last && depth_between(of, last, &end, &at) > of->slack) return MOTUS_OK;
    if (fabs(e->right.g[f]) > of->slack || e->rules.rule[e->rule_of[f]].internal) return MOTUS_OK;
    events_copy(e, &e->here, &e->right);
    motus_status status = events_judge(e, &e->here, err);
    if (!status) status = events_error_of(e, f, 0, &bound, err);
    *does = !status && fabs(e->right.g[f]) <= bound;
    return status;
}

/* Leaves a function that lingers near 0 at the end of the step to the next step. At the end of the leg there is none:
 * the function touches 0 there if its slope is 0 but for its error. */
static motus_status leave_open(events *e, size_t f, motus_error *err)
{
    double slope;
    if (e->right.t != e->until) {
        e->open[f] = 1;
        return MOTUS_OK;
    }
    events_copy(e, &e->here, &e->right);
    motus_status status = events_judge(e, &e->here, err);
    if (!status) status = events_slope_error_of(e, f, 0, &slope, err);
    if (status || fabs(e->here.rate[f]) > slope) return status;
    const candidate c = {
        .of = f, .at = e->span, .low = e->span, .high = e->span, .kind = CANDIDATE_TOUCHES, .located = true};
    return events_add(e, c) ? MOTUS_OK : events_no_memory(err);
}

static candidate candidate_of(const events *e, size_t f, const search *of, const roots_root *r, double low, double high)
{
    return (candidate){.of = f,
                       .at = place_of(e, of, r->tau),
                       .low = place_of(e, of, low),
                       .high = place_of(e, of, high),
                       .near = r->kind == ROOTS_NEAR || r->kind == ROOTS_TOUCH,
                       .kind = r->kind == ROOTS_RISING    ? CANDIDATE_RISES
                               : r->kind == ROOTS_FALLING ? CANDIDATE_FALLS
                                                          : (candidate_kind)r->side};
}

/* Adds the candidates of one function, from its roots. */
static motus_status add_roots(events *e, size_t f, const search *of, const roots_root *root, const roots_found *found,
                              motus_error *err)
{
    const rule *rule = &e->rules.rule[e->rule_of[f]];
    for (size_t k = 0; k < found->count; k++) {
        const double before = k ? root[k - 1].to : 0;
        roots_root one = root[k];
        double extremum;
        const size_t other = pair_of(of, root, found->count, k, &extremum);
        if (other > k) one.tau = extremum, one.to = root[other].to, one.kind = ROOTS_TOUCH;
        k = other;
        const double after = k + 1 < found->count ? root[k + 1].from : 1;
        const double low = before + (one.from - before) / 2, high = one.to + (after - one.to) / 2;
        candidate c = candidate_of(e, f, of, &one, low, high);
        bool open = false;
        if (one.open && (of->part->to < 1 || e->right.t != e->until)) {
            /* the next part or step finds it again, and tells which way it goes on, unless this step ends beyond it */
            const double end = of->part->to < 1 ? 0 : e->right.g[f];
            const int sign = (end > 0) - (end < 0);
            const bool away = fabs(end) > e->right.bound[f] && e->way * e->right.rate[f] * end > 0;
            if (sign != -one.side && !(sign == one.side && away && c.near)) open = true;
            if (sign == -one.side && fabs(end) <= e->right.bound[f]) open = true;
            c.near = sign == one.side, c.kind = (candidate_kind)sign, c.high = e->span;
        }
        if (open) {
            e->open[f] = 1;
            continue;
        }
        motus_status status = MOTUS_OK;
        if (k + 1 == found->count && !c.near) status = lingers(e, f, of, &one, &open, err);
        if (!status && open) status = leave_open(e, f, err);
        if (status) return status;
        if (open) continue;
        c.sure = !c.near && (one.from <= 0 || fabs(events_polynomial(of->coefficients, of->degree, low)) > of->slack) &&
                 (one.to >= 1 || fabs(events_polynomial(of->coefficients, of->degree, high)) > of->slack);
        /* passing in the direction that the rule does not ask for is not an event, and needs no true steps */
        c.idle = c.sure && rule->kind == RULE_ROOT && rule->direction == -c.kind;
        if (!events_add(e, c)) return events_no_memory(err);
    }
    bool open = false;
    const motus_status status = found->count || found->last == 0 ? MOTUS_OK : lingers(e, f, of, NULL, &open, err);
    return status || !open ? status : leave_open(e, f, err);
}

/* Corrects a function that leaves 0 with a slope of 0 and comes back within the step by dense output, which may be mere
 * error: if a true step in between has the other sign, it leaves to the other side. */
static motus_status judge_return(events *e, size_t f, const search *of, roots_root *root, roots_found *found,
                                 motus_error *err)
{
    if (!found->after || !found->count || e->heads[f] || root[0].open) return MOTUS_OK;
    motus_status status = events_at(e, place_of(e, of, root[0].tau / 2), &e->here, err);
    if (!status) status = events_judge(e, &e->here, err);
    if (status || e->here.g[f] * found->after > e->here.bound[f]) return status;
    const bool passes = root[0].kind == ROOTS_RISING || root[0].kind == ROOTS_FALLING;
    if (!passes) return MOTUS_OK;
    found->after = -found->after;
    found->count--;
    memmove(root, root + 1, found->count * sizeof *root);
    return MOTUS_OK;
}

/* Adds a candidate if a function that stood at 0 at the start of the step has left it to the other side. False: no
 * memory. */
static bool leave(events *e, size_t f, const search *of, const roots_found *found)
{
    const double start = place_of(e, of, 0);
    const int after = found->after, side = e->side[f], heads = e->heads[f];
    e->heads[f] = 0;
    e->hidden |= heads && after != heads;
    if (!after) return true; /* it stays there */
    if (side && after != side)
        return events_add(
            e, (candidate){
                   .of = f, .at = start, .low = start, .high = start, .kind = (candidate_kind)after, .located = true});
    if (side) return true;
    const rule *r = &e->rules.rule[e->rule_of[f]];
    const bool internal = r->internal;
    /* a function that is smooth on the step leaves 0 at once or never */
    const bool at_once = found->leaves < 0x1p-20 || (e->rules.settle && r->smooth && of->part->from <= 0);
    /* the start is not an event, nor is the end of a rest that may have been mere error */
    const bool quiet = e->first || (e->open[f] && r->kind == RULE_ROOT);
    if (quiet && of->part->from <= 0 && found->leaves < 1 && !internal) {
        e->side[f] = (int8_t)after;
        return true;
    }
    const double t = at_once ? start : place_of(e, of, found->leaves);
    return events_add(
        e, (candidate){.of = f, .at = t, .low = t, .high = t, .kind = (candidate_kind)after, .located = true});
}

/* Returns a function's largest size at the points, and tells its largest slope between two of them. Where the function
 * stands at 0, sizes count from its first value, which is 0 but for rounding. */
static double size_of(const double *value, size_t stride, int degree, bool stands, double *steepest)
{
    const double first = stands ? value[0] : 0;
    double largest = fabs(value[0] - first);
    *steepest = 0;
    for (int k = 1; k <= degree; k++) {
        const double now = value[(size_t)k * stride], before = value[(size_t)(k - 1) * stride];
        largest = fmax(largest, fabs(now - first));
        *steepest = fmax(*steepest, fabs(now - before) / (roots_point(k, degree) - roots_point(k - 1, degree)));
    }
    return largest;
}

/* Evaluates rates and bounds at both ends of the step, unless that has been done. */
static motus_status judge_ends(events *e, motus_error *err)
{
    if (e->marked) return MOTUS_OK;
    motus_status status = events_judge(e, &e->left, err);
    if (!status) status = events_judge(e, &e->right, err);
    e->marked = !status;
    return status;
}

/* Returns a bound on the rounding of a function in the step: the larger bound of both ends. Near a pole that bound
 * would exceed all values elsewhere, so there the smaller one counts. */
static double bound_of_ends(const events *e, size_t f, double largest)
{
    const double left = e->left.bound[f], right = e->right.bound[f], most = fmax(left, right),
                 least = fmin(left, right);
    const bool certain = fabs(left < right ? e->left.g[f] : e->right.g[f]) > least;
    return certain && 4 * most >= largest && 0x1p20 * least < most ? least : most;
}

/* Velocities of dense output are differences of positions, divided by the length of the step, which is a difference of
 * times: rounding of either counts with a weight of at most DENSE_WEIGHT / 2 (the largest of all methods is 2.2). */
enum { DENSE_WEIGHT = 8 };

/* Bounds the rounding of function f on dense output. */
static motus_status judge_dense(events *e, size_t f, double largest, double *bound, motus_error *err)
{
    const size_t nx = e->problem.nx;
    motus_status status = judge_ends(e, err);
    if (status) return status;
    const double ends = bound_of_ends(e, f, largest);
    instant *at = &e->here;
    events_copy(e, at, ends < e->left.bound[f] ? &e->right : &e->left);
    for (size_t k = 0; k < nx; k++) {
        const double far = fmax(fabs(e->left.x[k]), fabs(e->right.x[k]));
        const double lost = far + fabs(e->left.v[k] * e->right.t);
        at->v[k] += copysign(DENSE_WEIGHT * lost / fabs(e->span), at->v[k]);
    }
    status = events_bounds(e, at, err);
    *bound = fmax(at->bound[f], ends);
    return status;
}

/* Returns MOTUS_EVENTS, with the name of the function's rule and the time in the error. */
static motus_status of_function(const events *e, size_t f, double at, motus_error *err)
{
    if (!err) return MOTUS_EVENTS;
    err->time = at;
    snprintf(err->variable, sizeof err->variable, "%s", e->rules.rule[e->rule_of[f]].name);
    return MOTUS_EVENTS;
}

static motus_status too_fast(const events *e, size_t f, double from, motus_error *err)
{
    char t[DECIMAL_MAX];
    const rule *r = &e->rules.rule[e->rule_of[f]];
    const double at = e->left.t + time_at(e, from);
    fail(err, MOTUS_EVENTS, "the function of %s changes so fast near t = %s that its roots cannot be told apart%s%s",
         r->name, decimal_time(at, e->until - e->start, t), r->jump ? ": it jumps with " : "", r->jump ? r->jump : "");
    if (r->jump)
        hint(err, "keep the value in a mode, which events change: with n = 0, `when x = n + 1 rising: n = n + 1`");
    else
        hint(err, "a function of an event is 0 at times that are apart");
    return of_function(e, f, at, err);
}

/* Tells whether a function changes as much within the rounding of the time as in the whole step, so that its values do
 * not show what it does in between. It must do so at two of three times, since a pole may be near one of them. */
static motus_status hides_itself(events *e, stepper *s, size_t f, double largest, double bound, bool *hides,
                                 motus_error *err)
{
    const double ulp = events_ulp(e->right.t);
    instant *at = &e->here;
    motus_status status = MOTUS_OK;
    *hides = false;
    if (!(fabs(e->span) > 1024 * ulp && 64 * bound >= largest) || e->rules.rule[e->rule_of[f]].internal)
        return MOTUS_OK;
    at->t = events_place_in(e, e->span / 2);
    status = stepper_sample(s, at->t, at->x, at->v, err);
    if (!status) status = events_values(e, at, err);
    if (!status) status = events_judge(e, at, err);
    const double rate[] = {e->left.rate[f], at->rate[f], e->right.rate[f]};
    int fast = 0;
    for (int k = 0; k < 3; k++) fast += isfinite(rate[k]) && 256 * fabs(rate[k]) * ulp > fmax(largest, bound);
    *hides = fast > 1;
    return status;
}

/* Adds a candidate for the jump of a function that begins a part far beyond 0, on the other side. False: no memory. */
static bool begins_beyond(events *e, size_t f, double value, double from, int *sign)
{
    const int now = value > 0 ? 1 : -1;
    if (now == *sign || e->rules.rule[e->rule_of[f]].internal) return true;
    *sign = now;
    return events_add(
        e, (candidate){.of = f, .at = time_at(e, from), .kind = (candidate_kind)now, .located = true, .jumps = true});
}

/* Raises the noise of a function that was near 0 at the end of the step before to its error bound since the start. */
static motus_status widen_noise(events *e, size_t f, double *noise, motus_error *err)
{
    double error = 0;
    events_copy(e, &e->here, &e->left);
    motus_status status = events_judge(e, &e->here, err);
    if (!status) status = events_error_of(e, f, 0, &error, err);
    *noise = fmax(*noise, error);
    return status;
}

/* Adds a near candidate for a function that was near 0 where the part begins and went back; true steps decide whether
 * it touches 0. False: no memory. */
static bool went_back(events *e, size_t f, const search *of, int side)
{
    const double before = of->part->from - (of->part->to - of->part->from);
    const candidate c = {.of = f,
                         .at = place_of(e, of, 0),
                         .low = before > 0 ? time_at(e, before) : 0,
                         .high = place_of(e, of, 1),
                         .near = true,
                         .kind = (candidate_kind)side};
    return events_add(e, c);
}

/* Tells whether a function that stands at 0 stays there in a part of the step, as far as rounding shows: its values and
 * its movement by its slope are within `hidden`. */
static bool stays(const events *e, size_t f, const part *p, double largest, double hidden)
{
    const double way = fabs(e->left.rate[f] * e->span * (p->to - p->from));
    return largest <= hidden && (!e->heads[f] || way <= hidden);
}

/* Tells whether a function that stands at 0 without a slope moves in the whole step by no more than the error of the
 * step, so that the exact motion may keep it at 0. Then it is `open` too. */
static motus_status stays_by_error(events *e, size_t f, const part *p, double largest, double hidden, bool *does,
                                   motus_error *err)
{
    enum { BITS = 40 }; /* a larger movement is no error of a step */
    *does = false;
    if (e->heads[f] || p->from > 0 || p->to < 1 || !(largest <= ldexp(hidden, BITS))) return MOTUS_OK;
    if (e->rules.rule[e->rule_of[f]].internal) return MOTUS_OK;
    const motus_status status = events_step_keeps(e, f, does, err);
    e->open[f] |= *does;
    return status;
}

/* Adds the candidates of a part of the step, from the values of a function at its points. *sign is first the function's
 * sign before the part, 0 where it stands at 0, and afterwards its sign at the end. *rough: no polynomial fits the
 * values. */
static motus_status search_part(events *e, stepper *s, size_t f, const part *p, const double *value, size_t stride,
                                int degree, int *sign, bool *rough, motus_error *err)
{
    double coefficients[ROOTS_DEGREE_MOST + 1], steepest;
    if (*sign == 0 && !e->stands[f]) /* it has not been defined before */
        *sign = e->side[f] = (int8_t)((value[0] > 0) - (value[0] < 0));
    const bool stands = *sign == 0;
    *rough = false;
    const double largest = size_of(value, stride, degree, stands, &steepest);
    if (!stands && largest == 0) { /* it has come to 0, since all values are 0 */
        const double start = time_at(e, p->from);
        *sign = e->side[f] = 0, e->stands[f] = 1, e->open[f] = 0;
        const candidate c = {.of = f, .at = start, .kind = CANDIDATE_TOUCHES, .located = true, .jumps = true};
        return events_add(e, c) ? MOTUS_OK : events_no_memory(err);
    }
    /* Bounds on rounding are computed only where an event may be near; most steps need none. The times of the points
     * are rounded too, which matters in steps that are short beside the time. */
    const double moved = steepest * events_ulp(e->right.t) / fabs(e->span * (p->to - p->from));
    double rounding = largest * 0x1p-44 + moved, hidden = 0;
    if (stands) {
        bool by_error = false;
        motus_status judged = judge_dense(e, f, largest, &hidden, err);
        const bool by_rounding = !judged && stays(e, f, p, largest, hidden);
        if (!judged && !by_rounding) judged = stays_by_error(e, f, p, largest, hidden, &by_error, err);
        if (judged || by_rounding || by_error) return judged;
    }
    roots_fitted fitted;
    roots_fit_status fit;
    for (bool judged = false;; judged = true) {
        fit = roots_fit(value, stride, degree, rounding, coefficients, &fitted);
        if (fit == ROOTS_FIT_NOT_FINITE) { /* there is no root where it is undefined; shorter parts show the rest */
            for (int k = 0; k <= degree; k++) *rough |= isfinite(value[(size_t)k * stride]);
            return MOTUS_OK;
        }
        const double beyond = fit == ROOTS_FIT_ROUGH ? fitted.unseen : 0;
        if (fit != ROOTS_FIT_ROUGH) {
            const events_piece piece = {p->from, p->to, fitted.noise, coefficients, fitted.degree};
            const motus_status noted = events_note_extrema(e, s, f, &piece, err);
            if (noted) return noted;
        }
        if (!stands && !e->open[f] &&
            roots_none(coefficients, fitted.degree, EVENTS_SLACK * largest + fitted.noise + beyond))
            return begins_beyond(e, f, value[0], p->from, sign) ? MOTUS_OK : events_no_memory(err);
        if (fit != ROOTS_FIT_ROUGH || judged) break;
        /* the function may be a small difference of large numbers, and have their rounding */
        const motus_status status = stands ? MOTUS_OK : judge_dense(e, f, largest, &hidden, err);
        if (status) return status;
        rounding += hidden;
    }
    *rough = fit == ROOTS_FIT_ROUGH;
    if (*rough) return MOTUS_OK;
    bool hides;
    motus_status status = judge_ends(e, err);
    if (status) return status;
    const double bound = fmax(hidden, bound_of_ends(e, f, largest));
    status = hides_itself(e, s, f, largest, bound, &hides, err);
    if (status || hides) return status ? status : too_fast(e, f, p->from, err);
    double noise = bound + moved + fmax(0, fitted.noise - rounding);
    if (e->open[f] && p->from <= 0 && !stands) status = widen_noise(e, f, &noise, err);
    if (status) return status;
    const search of = {p, coefficients, fitted.degree, fmax(EVENTS_SLACK * largest, 2 * noise)};
    roots_root root[ROOTS_ROOM];
    roots_found found;
    *rough = roots_find(coefficients, fitted.degree, *sign, noise, of.slack, root, ROOTS_ROOM, &found) == ROOTS_CUT;
    if (*rough) return MOTUS_OK;
    if (stands) status = judge_return(e, f, &of, root, &found, err);
    if (status) return status;
    if (stands && !leave(e, f, &of, &found)) return events_no_memory(err);
    const bool open = e->open[f] && *sign && !(found.count && root[0].from <= 0);
    e->open[f] = 0;
    if (open && !went_back(e, f, &of, *sign)) return events_no_memory(err);
    if (found.last) *sign = found.last;
    return add_roots(e, f, &of, root, &found, err);
}

static motus_status too_many(const events *e, size_t f, motus_error *err)
{
    char t[DECIMAL_MAX];
    fail(err, MOTUS_EVENTS, "the function of %s is 0 more than %d times in the step at t = %s",
         e->rules.rule[e->rule_of[f]].name, EVENTS_IN_STEP, decimal_time(e->left.t, e->until - e->start, t));
    hint(err, "a motion that leaves the finite numbers may pass ever more events: end the run before");
    return of_function(e, f, e->left.t, err);
}

/* Adds the candidates of a part that is too short to be divided, from its samples. */
static motus_status search_cell(events *e, size_t f, const part *p, const double *value, int *sign, motus_error *err)
{
    double time[PART_DEGREE + 1], finite[PART_DEGREE + 1];
    bool told, internal = e->rules.rule[e->rule_of[f]].internal;
    motus_status status = judge_ends(e, err);
    if (status) return status;
    double largest = 0;
    events_cell cell = {.of = f,
                        .time = time,
                        .value = finite,
                        .from = time_at(e, p->from),
                        .last = p->to >= 1 && e->right.t == e->until};
    for (int k = 0; k <= PART_DEGREE; k++) {
        if (!isfinite(value[k])) continue;
        time[cell.count] = time_at(e, p->from + roots_point(k, PART_DEGREE) * (p->to - p->from));
        finite[cell.count++] = value[k];
        largest = fmax(largest, fabs(value[k]));
    }
    cell.bound = bound_of_ends(e, f, largest);
    const bool whole = cell.count > PART_DEGREE;
    if (internal && whole) return too_fast(e, f, p->from, err);
    if (internal || !cell.count) return MOTUS_OK;
    status = events_sampled(e, &cell, sign, &told, err);
    return !status && !told && whole ? too_fast(e, f, p->from, err) : status;
}

/* Searches the parts of the step in order, and halves a part while it does not resolve the function. */
static motus_status find_in_parts(events *e, stepper *s, size_t f, int *sign, motus_error *err)
{
    const size_t before = e->candidates; /* those of other functions */
    part waiting[PARTS_DEEP + 2] = {{0.5, 1, 1}, {0, 0.5, 1}};
    double value[PART_DEGREE + 1];
    motus_status status = MOTUS_OK;
    for (int count = 2; count > 0 && !status;) {
        const part now = waiting[--count];
        const double middle = now.from + (now.to - now.from) / 2;
        bool rough;
        status = sample_part(e, s, f, &now, value, err);
        if (!status) status = search_part(e, s, f, &now, value, 1, PART_DEGREE, sign, &rough, err);
        if (!status && e->candidates - before > EVENTS_IN_STEP) return too_many(e, f, err);
        if (status || !rough) continue;
        if (now.depth == PARTS_DEEP) {
            status = search_cell(e, f, &now, value, sign, err);
            continue;
        }
        waiting[count++] = (part){middle, now.to, now.depth + 1};
        waiting[count++] = (part){now.from, middle, now.depth + 1};
    }
    return status;
}

static motus_status find_by_points(events *e, stepper *s, size_t f, int *degree, motus_error *err)
{
    const part all = {0, 1, 0};
    const size_t n = e->rules.functions;
    int sign = e->stands[f] ? 0 : e->side[f];
    bool rough;
    if (isnan(e->left.g[f]) && isnan(e->right.g[f])) return MOTUS_OK; /* a cell without a rule */
    motus_status status = search_part(e, s, f, &all, e->samples + f, n, *degree, &sign, &rough, err);
    const bool defined = isfinite(e->left.g[f]) && isfinite(e->right.g[f]);
    while (!status && rough && *degree < PART_DEGREE && defined) {
        *degree *= 2;
        status = sample(e, s, *degree, err);
        if (!status) status = search_part(e, s, f, &all, e->samples + f, n, *degree, &sign, &rough, err);
    }
    if (!status && rough && e->rules.rule[e->rule_of[f]].internal && e->shorter > 0) { /* repeat the step, shorter */
        e->shorter--;
        e->hidden = true;
        return MOTUS_OK;
    }
    e->in_parts = rough;
    if (!status && rough) status = find_in_parts(e, s, f, &sign, err);
    e->stands[f] = e->stands[f] && !sign;
    return status;
}

/* Finds the candidates of a function by the points of dense output, and by bounds those that the points miss. */
static motus_status find_of(events *e, stepper *s, size_t f, int *degree, motus_error *err)
{
    const size_t first = e->candidates;
    motus_error theirs = {.size = sizeof theirs, .time = NAN};
    bool more = false;
    const motus_status points = find_by_points(e, s, f, degree, &theirs);
    motus_status status = points && points != MOTUS_EVENTS ? points : MOTUS_OK;
    if (!status && !e->hidden) status = events_narrow(e, s, f, first, *degree, points != MOTUS_OK, &more, &theirs);
    if (!status && !more) status = points;
    if (status && err) *err = theirs;
    return status;
}

bool events_next_tick(const events *e, size_t k, candidate *c)
{
    double at = (events_tick(e, k) - e->left.t) - e->left.lost;
    if (fabs(at - e->span) <= 4 * events_ulp(e->right.t)) at = e->span;
    *c = (candidate){.kind = CANDIDATE_TIME, .of = k, .at = at, .low = at, .high = at};
    return e->way * at >= 0 && e->way * (e->span - at) >= 0;
}

static bool add_ticks(events *e)
{
    candidate c;
    for (size_t k = 0; k < e->rules.count; k++)
        if (e->rules.rule[k].kind == RULE_CLOCK && events_next_tick(e, k, &c) && !events_add(e, c)) return false;
    return true;
}

/* Returns the root in [0, h] of the cubic with these values, of opposite signs, and slopes at the ends. */
static double cubic_root(double h, double g0, double r0, double g1, double r1)
{
    const double p = h * r0, q = h * r1, d = g1 - g0, c2 = 3 * d - 2 * p - q, c3 = p + q - 2 * d;
    double low = 0, high = 1, u = g0 / (g0 - g1);
    for (int turn = 0; turn < 8; turn++) {
        const double g = g0 + u * (p + u * (c2 + u * c3)), slope = p + u * (2 * c2 + u * 3 * c3);
        if ((g > 0) == (g0 > 0))
            low = u;
        else
            high = u;
        const double next = u - g / slope;
        u = next > low && next < high ? next : low + (high - low) / 2;
    }
    return u * h;
}

/* Adds the root of a function that is monotone on the step, if its signs at the ends differ. False: the signs do not
 * tell whether there is one. */
static bool monotone(events *e, size_t f, motus_status *status, motus_error *err)
{
    const double from = e->left.g[f], to = e->right.g[f];
    const int sign = (from > 0) - (from < 0), after = (to > 0) - (to < 0);
    const rule *r = &e->rules.rule[e->rule_of[f]];
    const bool idle = r->kind == RULE_ROOT && r->direction == -after;
    if (!sign || !after || sign != e->side[f]) return false;
    if (sign == after) return true;
    *status = judge_ends(e, err);
    if (*status || !events_clear(e, f)) return false;
    /* the time of an idle candidate matters only for its order among others */
    const candidate c = {.of = f,
                         .at = idle ? e->span * (from / (from - to))
                                    : cubic_root(e->span, from, e->left.rate[f], to, e->right.rate[f]),
                         .low = 0,
                         .high = e->span,
                         .kind = (candidate_kind)after,
                         .sure = true,
                         .guessed = !idle,
                         .idle = idle};
    if (!events_add(e, c)) *status = events_no_memory(err);
    return true;
}

/* Tells whether a function that stands at 0 leaves it to the side on which it goes on, and stays there: it is monotone
 * on the step, and ends it far beyond what rounding hides. */
static bool leaves_alone(events *e, size_t f, motus_status *status, motus_error *err)
{
    enum { FAR = 1 << 10, LONG = 1 << 20 };
    const double way = e->right.g[f] - e->left.g[f];
    const int after = (way > 0) - (way < 0);
    double hidden;
    if (!after || e->side[f] != after || (e->heads[f] && e->heads[f] != after)) return false;
    if (e->off || e->rules.rule[e->rule_of[f]].internal || !(e->right.g[f] * after > 0)) return false;
    if (!(fabs(e->span) > LONG * events_ulp(e->right.t))) return false;
    *status = judge_dense(e, f, fabs(way), &hidden, err);
    if (*status || !(fabs(way) > FAR * hidden)) return false;
    e->stands[f] = 0, e->heads[f] = 0;
    return true;
}

/* Marks the functions for which dense output must be searched; most steps need none. */
static motus_status choose(events *e, stepper *s, bool *any, motus_error *err)
{
    const size_t n = e->rules.functions;
    double *out = e->before;
    const bool known = events_box(e, s), once = row_adaptive(&e->method); /* else dense output says where it passes 0 */
    bool rates = false;
    motus_status status = MOTUS_OK;
    e->boxed = false;
    *any = false;
    for (size_t f = 0; f < n; f++) {
        const bool free = known && !e->stands[f] && !e->open[f];
        e->look[f] = !(free && out[f] > 0);
        rates |= known && !e->open[f] && (e->stands[f] ? e->side[f] : once && e->look[f]);
        *any |= e->look[f];
    }
    if (!*any) return MOTUS_OK;
    status = events_value_ends(e, err);
    if (!rates || status) return status;
    e->rules.least_rates(e->rules.ctx, e->next.x, e->next.v, e->width, e->width + e->problem.nx, out);
    *any = false;
    for (size_t f = 0; f < n && !status; f++) {
        const bool moves = e->look[f] && !e->open[f] && out[f] > 0;
        if (moves && e->stands[f])
            e->look[f] = !leaves_alone(e, f, &status, err);
        else if (moves && once)
            e->look[f] = !monotone(e, f, &status, err);
        *any |= e->look[f];
    }
    return status;
}

static bool lingers_any(const events *e)
{
    const size_t n = e->rules.functions;
    uint8_t any = 0;
    for (size_t f = n; f < 3 * n; f++) any |= e->was[f];
    for (size_t f = 0; f < n; f++) any |= e->stands[f] | e->open[f];
    return any;
}

motus_status events_find(events *e, stepper *s, motus_error *err)
{
    int degree = ROOTS_DEGREE_LEAST;
    const size_t flags = 4 * e->rules.functions;
    e->candidates = 0;
    e->in_order = false;
    e->hidden = false;
    memcpy(e->was, e->side, flags);
    e->shift = 0;
    e->marked = false;
    bool any;
    motus_status status = choose(e, s, &any, err);
    if (any && !status) status = sample(e, s, degree, err);
    for (size_t f = 0; any && f < e->rules.functions && !status; f++)
        if (e->look[f]) status = find_of(e, s, f, &degree, err);
    if (e->hidden) memcpy(e->side, e->was, flags);
    if (!status && !add_ticks(e)) status = events_no_memory(err);
    if (!status) status = events_order(e, s, err);
    e->lingers = lingers_any(e);
    return status || !e->candidates ? status : events_value_ends(e, err);
}
