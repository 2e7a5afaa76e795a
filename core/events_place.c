/* Places roots by true steps that end on them. See events_parts.h. */
#include "core/events_parts.h"

#include <math.h>

enum { TURNS = 100 };

/* Exchanges the instant `here` and the best one so far. */
static void exchange_best(events *e)
{
    const instant here = e->here;
    e->here = e->best, e->best = here;
}

/* Finds the time of a crossing, by Newton's method between `low` and `high`, until rounding hides on which side of 0
 * the function is; `here` is the state there. */
static motus_status crossing(events *e, candidate *c, motus_error *err)
{
    const size_t f = c->of;
    instant *at = &e->here;
    double low = c->low, high = c->high, h = c->at, best = INFINITY, found = h;
    for (int turn = 0; turn < TURNS; turn++) {
        motus_status status = events_at_of(e, f, h, at, err);
        if (!status) status = events_rate_of(e, f, at, err);
        const double g = at->g[f], rate = at->rate[f];
        const bool better = turn == 0 || fabs(g) < best;
        if (!status && !better) status = events_bound_of(e, f, at, err);
        if (status) return status;
        const bool ends = g == 0 || (!better && best <= at->bound[f] && fabs(g) >= best);
        if (better) best = fmin(best, fabs(g)), found = h, exchange_best(e);
        if (ends) break;
        if ((g > 0) == (c->kind > 0))
            high = h;
        else
            low = h;
        double next = h - g / rate;
        /* a vanishing slope leads out of the interval, and after some turns halving is faster */
        if (!(e->way * (next - low) > 0 && e->way * (high - next) > 0) || turn > 12) next = low + (high - low) / 2;
        if (next == h || next == low || next == high) break;
        h = next;
    }
    c->at = found;
    c->located = true;
    exchange_best(e); /* `here` is the best instant again */
    return events_bound_of(e, f, at, err);
}

/* Finds the sign of a function a time h after `left`, by a true step. */
static motus_status sign_at(events *e, double h, size_t f, int *sign, motus_error *err)
{
    const motus_status status = events_at_of(e, f, h, &e->here, err);
    const double g = e->here.g[f];
    *sign = (g > 0) - (g < 0);
    return status;
}

/* Finds the time between low and high where the rate is 0, by the secant method kept between them. *beyond: the step
 * ends before that time. */
static motus_status extremum(events *e, candidate *c, bool *beyond, motus_error *err)
{
    const size_t f = c->of;
    instant *at = &e->here;
    double low = c->low, high = c->high, at_low = NAN, at_high = NAN, h = c->at;
    *beyond = false;
    for (int turn = 0; turn < TURNS; turn++) {
        c->at = h;
        motus_status status = events_at(e, h, at, err);
        if (!status) status = events_judge(e, at, err);
        if (status) return status;
        const double rate = at->rate[f];
        if (rate == 0) break;
        /* the extremum is a minimum above 0 or a maximum below it */
        const bool before = (rate * e->way > 0) != (c->kind > 0);
        if (before)
            low = h, at_low = rate;
        else
            high = h, at_high = rate;
        *beyond = isnan(at_high) && c->high == e->span;
        double next = isnan(at_low) || isnan(at_high) ? h + (before ? 0.25 * (high - h) : 0.25 * (low - h))
                                                      : high - at_high * (high - low) / (at_high - at_low);
        /* halving is faster where the extremum is flat */
        if (turn % 3 == 2 || turn > 12 || !(e->way * (next - low) > 0 && e->way * (high - next) > 0))
            next = low + (high - low) / 2;
        if (next == h || next == low || next == high || fabs(high - low) <= events_ulp(at->t)) break;
        h = next;
    }
    return MOTUS_OK;
}

/* Returns a bound on the rounding of a function at `here`: the state there has the rounding of the larger numbers at
 * the ends of the step too. */
static double carried(const events *e, size_t f)
{
    return fmax(e->here.bound[f], fmax(e->left.bound[f], e->right.bound[f]));
}

/* Tells whether a function is 0 at `here`, but for its rounding and that of the time. */
static bool vanishes(const events *e, size_t f)
{
    return fabs(e->here.g[f]) <= 4 * (carried(e, f) + fabs(e->here.rate[f]) * events_ulp(e->here.t));
}

/* Finds the sign of a function at one end of the step; 0: rounding hides it there. */
static motus_status sign_at_end(events *e, instant *end, size_t f, int *sign, motus_error *err)
{
    const motus_status status = events_judge(e, end, err);
    const double g = end->g[f];
    *sign = fabs(g) <= end->bound[f] ? 0 : (g > 0) - (g < 0);
    return status;
}

/* Corrects candidate k where true steps find the function on the side c->kind at both `low` and `high`, since dense
 * output of low order may err by the distance of a root. If the function is on the other side at the start of the step,
 * before its first root, or at the end, after its last one, it passes 0 in between. */
static motus_status widen(events *e, size_t k, motus_error *err)
{
    candidate *c = &e->candidate[k];
    const int side = c->kind;
    bool first = true, last = true;
    int left = 0, right = 0;
    for (size_t j = 0; j < e->candidates; j++) {
        const candidate *other = &e->candidate[j];
        if (j == k || other->kind == CANDIDATE_TIME || other->of != c->of) continue;
        first &= e->way * (other->low - c->low) > 0;
        last &= e->way * (other->low - c->low) < 0;
    }
    motus_status status = first ? sign_at_end(e, &e->left, c->of, &left, err) : MOTUS_OK;
    if (!status && last) status = sign_at_end(e, &e->right, c->of, &right, err);
    const bool before = left == -side, after = right == -side;
    if (status || (!before && !after)) return status;
    candidate one = *c, two = *c;
    one.near = two.near = false;
    one.low = 0, one.high = c->low, one.kind = (candidate_kind)side;
    two.low = c->high, two.high = e->span, two.kind = (candidate_kind)-side;
    one.at = one.low + (one.high - one.low) / 2;
    two.at = two.low + (two.high - two.low) / 2;
    *c = before ? one : two;
    return before && after && !events_add(e, two) ? events_no_memory(err) : MOTUS_OK;
}

motus_status events_lingered(events *e, const candidate *c, bool *same, motus_error *err)
{
    const double since = (e->fired[c->of] - e->left.t) - e->left.lost,
                 h = e->way * since > 0 ? since + (c->at - since) / 2 : 0;
    double bound;
    *same = false;
    if (!(fabs(c->at - since) <= fabs(e->span))) return MOTUS_OK;
    motus_status status = events_at(e, h, &e->here, err);
    if (!status) status = events_judge(e, &e->here, err);
    if (!status) status = events_error_of(e, c->of, h, &bound, err);
    *same = !status && fabs(e->here.g[c->of]) <= bound;
    return status;
}

motus_status events_locate(events *e, size_t k, motus_error *err)
{
    candidate *c = &e->candidate[k];
    motus_status status = MOTUS_OK;
    if (c->sampled && !c->located) return events_locate_sampled(e, k, err);
    if (c->located || c->kind == CANDIDATE_TIME) {
        const bool ticks = c->kind == CANDIDATE_TIME;
        c->located = true;
        status = ticks ? events_at(e, c->at, &e->here, err) : events_at_of(e, c->of, c->at, &e->here, err);
        if (status) return status;
        return ticks ? events_judge(e, &e->here, err) : events_judge_of(e, c->of, &e->here, err);
    }
    const size_t f = c->of;
    const double guess = c->at;
    if (!c->sure) {
        int low, high;
        status = sign_at(e, c->low, f, &low, err);
        if (!status) status = sign_at(e, c->high, f, &high, err);
        if (status) return status;
        /* The true values show a crossing, or the extremum decides. A function that the step before left undecided may
         * be beyond 0 at the start of this step by its error so far. */
        const bool lingers = c->near && c->low == 0 && low == -(int)c->kind;
        if (low && low == -high && !lingers) {
            c->near = false;
            c->kind = (candidate_kind)high;
        } else if (low && low == high && c->low == 0 && e->side[f] == -low) {
            /* the step before has left to this one a crossing from which the function was, by its error, beyond 0 */
            c->near = false;
            c->kind = (candidate_kind)low;
            c->at = 0;
        } else if (low && low == high) {
            c->near = true;
            c->kind = (candidate_kind)low;
            status = widen(e, k, err);
            if (status) return status;
            c = &e->candidate[k];
        }
    }
    if (c->near) {
        const int side = c->kind;
        bool beyond;
        status = extremum(e, c, &beyond, err);
        if (status) return status;
        const double g = e->here.g[f], at = c->at;
        double bound;
        status = events_error_of(e, f, at, &bound, err);
        if (status) return status;
        double slope = 0; /* an error bound of the slope at the end of the step */
        if (fabs(g) <= bound && beyond) status = events_slope_error_of(e, f, at, &slope, err);
        if (status) return status;
        if (fabs(g) <= bound && beyond && fabs(e->here.rate[f]) > slope) {
            c->gone = true; /* the next step decides */
        } else if (fabs(g) <= bound) {
            c->near = false;
            c->kind = CANDIDATE_TOUCHES;
            c->located = true;
        } else if ((g > 0) == (side > 0)) {
            c->gone = true;
        } else {
            status = events_split(e, k, at, err);
            if (status) return status;
            c = &e->candidate[k];
        }
    }
    if (!c->located && !c->gone) status = crossing(e, c, err);
    /* dense output erred by more than EVENTS_SLACK allows: true steps decide */
    if (!status && c->sure && !vanishes(e, f)) {
        c->sure = c->located = e->in_order = false;
        c->at = guess;
        return events_locate(e, k, err);
    }
    e->shift = fmax(e->shift, fabs(c->at - guess));
    return status;
}
