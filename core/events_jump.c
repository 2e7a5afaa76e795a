/* Functions that jump or have a kink, in the smallest parts of a step: their samples bracket each change of sign, and
 * bisection by true steps tells whether it is a root. See events_parts.h.
 *
 * A function that jumps over 0 has no root there: it changes its side. A function that comes to 0 and stays there has
 * no root until it leaves 0. Invariant: two samples bracket the place of a `sampled` candidate.
 */
#include "core/events_parts.h"

#include <math.h>

/* ---- what samples tell ---- */

static int sign_of(double g, double bound) { return fabs(g) <= bound ? 0 : g > 0 ? 1 : -1; }

/* Finds the first change of sign from sample `from` on: *before is the last sample with the old sign, *at the first
 * with the new one, *to. A single 0 is a value on the way; from two zeros in a row on the function stays at 0, *to = 0.
 * False: the sign does not change. */
static bool next_change(const events_cell *c, int sign, int from, int *before, int *at, int *to)
{
    for (int k = from; k < c->count; k++) {
        const int s = sign_of(c->value[k], c->bound);
        if (s == sign) continue;
        int end = k;
        while (!s && end < c->count && !sign_of(c->value[end], c->bound)) end++;
        if (!s && end == c->count && c->count - k == 1) return false; /* the next part decides */
        const bool stays = !s && (end == c->count || end - k > 1);
        *before = k ? k - 1 : 0;
        *at = s || stays ? k : end;
        *to = stays ? 0 : sign_of(c->value[*at], c->bound);
        if (*to != sign) return true;
        k = *at;
    }
    return false;
}

/* Returns how far the function goes from sample k to the next one. */
static double change_after(const events_cell *c, int k)
{
    return k >= 0 && k + 1 < c->count ? fabs(c->value[k + 1] - c->value[k]) : 0;
}

/* Tells whether a function that keeps its sign may touch 0 between samples: its smallest value, sample *at, is at most
 * twice its change to a neighbour. */
static bool may_touch(const events_cell *c, int *at)
{
    *at = 0;
    for (int k = 1; k < c->count; k++)
        if (fabs(c->value[k]) < fabs(c->value[*at])) *at = k;
    return fabs(c->value[*at]) <= 2 * fmax(change_after(c, *at - 1), change_after(c, *at));
}

/* Makes a candidate between two samples or, where both are one, between the beginning of the cell and that sample. */
static candidate between(const events_cell *c, int low, int high)
{
    const double from = low < high ? c->time[low] : c->from, to = c->time[high];
    return (candidate){.of = c->of, .at = from + (to - from) / 2, .low = from, .high = to, .sampled = true};
}

motus_status events_sampled(events *e, const events_cell *c, int *sign, bool *told, motus_error *err)
{
    int low, high, to, k, next_low, next_high, next_to;
    const bool changes = next_change(c, *sign, 0, &low, &high, &to);
    *told = true;
    if (!changes) {
        if (*sign == 0 || !may_touch(c, &k)) return MOTUS_OK;
        if (!c->last && k + 1 == c->count && c->value[k] == 0) { /* the next part decides */
            e->open[c->of] = 1;
            return MOTUS_OK;
        }
        candidate touch = between(c, k ? k - 1 : 0, k + 1 < c->count ? k + 1 : k);
        touch.near = true;
        touch.kind = (candidate_kind)*sign;
        return events_add(e, touch) ? MOTUS_OK : events_no_memory(err);
    }
    *told = !next_change(c, to, high, &next_low, &next_high, &next_to);
    if (!*told) return MOTUS_OK;
    if (*sign == 0 && e->heads[c->of]) { /* it leaves 0 to the other side, and comes back before the first sample */
        e->hidden |= to != e->heads[c->of];
        e->heads[c->of] = 0;
    }
    candidate one = between(c, low, high);
    one.kind = (candidate_kind)to;
    one.leaves = *sign == 0;
    *sign = to;
    if (!to) e->stands[c->of] = 1, e->side[c->of] = 0;
    return events_add(e, one) ? MOTUS_OK : events_no_memory(err);
}

/* ---- what true steps tell ---- */

/* One end of the interval in which a function changes. */
typedef struct end {
    double at, g; /* time since `left`, and the function there */
    bool zero;    /* it is 0 but for rounding */
} end;

/* Evaluates the function after a true step of size h, in `here`. */
static motus_status look(events *e, size_t f, double h, end *to, motus_error *err)
{
    motus_status status = events_at(e, h, &e->here, err);
    if (!status) status = events_judge(e, &e->here, err);
    to->at = h;
    to->g = e->here.g[f];
    to->zero = isfinite(to->g) && !events_far(e, &e->here, f) &&
               fabs(to->g) <= 4 * (e->here.bound[f] + fabs(e->here.rate[f]) * events_ulp(e->here.t));
    return status;
}

/* Tells whether the function has changed at this end already; where it is undefined it has not. */
static bool changed(const candidate *c, const end *at)
{
    if (c->leaves) return !at->zero;
    if (c->kind == CANDIDATE_TOUCHES) return at->zero;
    return c->kind > 0 ? at->g > 0 : at->g < 0;
}

/* Widens the interval, since samples have the error of dense output, until the function changes in it by true steps, at
 * most to the ends of the step. *found false: it does not change. */
static motus_status enclose(events *e, const candidate *c, end *low, end *high, bool *found, motus_error *err)
{
    enum { TIMES = 24 };
    double wide = e->way * fmax(fabs(c->high - c->low), 0x1p-46 * fabs(e->span)); /* so TIMES lead through the step */
    motus_status status = look(e, c->of, c->low, low, err);
    if (!status) status = look(e, c->of, c->high, high, err);
    for (int k = 0; k < TIMES && !status && changed(c, low) && low->at != 0; k++, wide *= 4)
        status = look(e, c->of, e->way * (low->at - wide) > 0 ? low->at - wide : 0, low, err);
    for (int k = 0; k < TIMES && !status && !changed(c, high) && high->at != e->span; k++, wide *= 4)
        status = look(e, c->of, e->way * (e->span - high->at - wide) > 0 ? high->at + wide : e->span, high, err);
    *found = !changed(c, low) && changed(c, high);
    return status;
}

/* Bisects the interval down to the rounding of the time. */
static motus_status halve(events *e, const candidate *c, end *low, end *high, motus_error *err)
{
    motus_status status = MOTUS_OK;
    while (!status && fabs(high->at - low->at) > events_ulp(e->left.t + high->at) / 2) {
        end middle;
        const double h = low->at + (high->at - low->at) / 2;
        if (h == low->at || h == high->at) break;
        status = look(e, c->of, h, &middle, err);
        *(changed(c, &middle) ? high : low) = middle;
    }
    return status;
}

/* Tells whether bisection has at least halved the value at an end, as at a root, but not at a jump or a pole. */
static bool nearer(const end *before, const end *now) { return fabs(now->g) <= fabs(before->g) / 2 || now->g == 0; }

/* Locates a change of sign, and tells whether it is a root or a jump. */
static motus_status place_change(events *e, candidate *c, motus_error *err)
{
    end low, high;
    bool found;
    motus_status status = enclose(e, c, &low, &high, &found, err);
    const end first = low, last = high;
    if (!status && found) status = halve(e, c, &low, &high, err);
    if (status) return status;
    c->located = true;
    if (!found && changed(c, &low)) { /* it has changed where the step begins */
        c->jumps = !(c->kind && low.zero);
        c->at = low.at;
        return look(e, c->of, c->at, &low, err);
    }
    c->gone = !found;
    const bool wide = fabs(last.at - first.at) > 64 * events_ulp(e->left.t + last.at);
    const bool low_is = low.zero && (!wide || nearer(c->leaves ? &last : &first, c->leaves ? &high : &low)),
               high_is = high.zero && (!wide || nearer(&last, &high));
    const bool root = c->kind && (low_is || high_is);
    c->jumps = !root;
    c->at = root && low_is && (!high_is || fabs(low.g) <= fabs(high.g)) ? low.at : high.at;
    end here;
    return look(e, c->of, c->at, &here, err);
}

/* Locates an extremum near 0, and tells whether it touches 0. At a kink bisection goes by the sign of the rate; where
 * the rate keeps its sign the function jumps, and bisection goes to the larger change. */
static motus_status place_touch(events *e, size_t k, motus_error *err)
{
    candidate *c = &e->candidate[k];
    const size_t f = c->of;
    end low, high, middle;
    motus_status status = look(e, f, c->low, &low, err);
    const bool falls = e->way * e->here.rate[f] * c->kind < 0; /* towards 0 */
    if (!status) status = look(e, f, c->high, &high, err);
    const bool rises = e->way * e->here.rate[f] * c->kind > 0;
    const bool kink = falls && rises;
    while (!status && fabs(high.at - low.at) > events_ulp(e->left.t + high.at) / 2) {
        const double h = low.at + (high.at - low.at) / 2;
        if (h == low.at || h == high.at) break;
        status = look(e, f, h, &middle, err);
        const bool before =
            kink ? e->way * e->here.rate[f] * c->kind < 0 : fabs(middle.g - low.g) < fabs(middle.g - high.g);
        *(before ? &low : &high) = middle;
    }
    if (status) return status;
    c->located = true;
    c->at = fabs(low.g) <= fabs(high.g) ? low.at : high.at;
    status = look(e, f, c->at, &middle, err);
    if (status) return status;
    if (kink && !middle.zero && (middle.g > 0) != (c->kind > 0)) return events_split(e, k, c->at, err);
    c->gone = !middle.zero;
    c->near = false;
    c->kind = CANDIDATE_TOUCHES;
    return MOTUS_OK;
}

motus_status events_locate_sampled(events *e, size_t k, motus_error *err)
{
    const double guess = e->candidate[k].at;
    motus_status status = MOTUS_OK;
    if (e->candidate[k].near) status = place_touch(e, k, err);
    candidate *c = &e->candidate[k];
    if (!status && !c->located) status = place_change(e, c, err);
    e->shift = fmax(e->shift, fabs(c->at - guess));
    return status;
}
