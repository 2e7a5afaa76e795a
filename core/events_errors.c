/* Error bounds of functions, from those of the state, and of the times at which functions pass or touch 0. See
 * events_parts.h. */
#include "core/events_parts.h"

#include <math.h>

bool events_far(const events *e, const instant *at, size_t f)
{
    const double g = fabs(at->g[f]), ends = fmax(fabs(e->left.g[f]), fabs(e->right.g[f]));
    return !isfinite(g) || (e->marked && g > ends && g > 4 * fmax(e->left.bound[f], e->right.bound[f]));
}

bool events_clear(const events *e, size_t f)
{
    return fabs(e->left.g[f]) > 2 * e->left.bound[f] && fabs(e->right.g[f]) > 2 * e->right.bound[f];
}

/* Writes into e->width an error bound of every number of the state at `here`, a time h after `left`, of two terms:
 * - rounding: the errors of all steps so far add up as a random walk. The error counts from the latest root of the
 *   function on, so a number counts with its largest size since then.
 * - with `halves`, the error of the step that leads here: twice the difference from two half steps. */
static void bound_state(events *e, size_t f, double h, bool halves)
{
    const size_t nx = e->problem.nx, nv = e->problem.nv, moving = nx - e->problem.modes;
    const double jogged = e->jog ? 3 : 1; /* the numbers of a companion were also moved by a unit */
    const double units = 8 * jogged * (1 + sqrt((double)e->taken)) * 0x1p-53;
    const double since = e->stands[f] ? fabs(h) : fabs((e->left.t - e->fired[f]) + h); /* NaN: it has not been 0 */
    const instant *here = &e->here, *from = &e->left;
    instant *to = &e->next;
    events_copy(e, to, here);
    if (halves && from->t + h / 2 != from->t && from->t + h / 2 != from->t + h) {
        double t, lost;
        motus_status failed = events_probe(e, from->t, from->lost, from->x, from->v, h / 2, &t, &lost, NULL);
        if (!failed) failed = stepper_sync(e->probe, to->x, to->v, NULL, NULL);
        if (!failed) failed = events_probe(e, t, lost, to->x, to->v, h / 2, &to->t, &to->lost, NULL);
        if (!failed) failed = stepper_sync(e->probe, to->x, to->v, NULL, NULL);
        if (failed) events_copy(e, to, here); /* steps too short for error control do not tell this error */
    }
    for (size_t k = 0; k < nx; k++) {
        const double fast = k < moving ? fmax(fabs(from->v[k]), fabs(here->v[k])) : 0;
        const double size = fmin(e->most[k], fmax(fabs(from->x[k]), fabs(here->x[k])) + fast * since);
        e->width[k] = k < moving ? 2 * fabs(to->x[k] - here->x[k]) + units * size : 0;
    }
    for (size_t k = 0; k < nv; k++) {
        const double fast = h != 0 ? fabs((here->v[k] - from->v[k]) / h) : NAN;
        const double size = fmin(e->most[nx + k], fmax(fabs(from->v[k]), fabs(here->v[k])) + fast * since);
        e->width[nx + k] = 2 * fabs(to->v[k] - here->v[k]) + units * size;
    }
}

/* Raises *most to the change of a function at `here`, or of its rate, when numbers of the state change by their error
 * bounds, up and down. bit < 0: number `one` alone changes. bit = 0: all change, with one sign. bit > 0: all change,
 * number k with the sign in bit bit - 1 of k. */
static motus_status raise_by_change(events *e, size_t f, bool rate, int bit, size_t one, double *most, motus_error *err)
{
    const size_t nx = e->problem.nx, all = nx + e->problem.nv;
    instant *to = &e->next;
    for (int sign = -1; sign <= 1; sign += 2) {
        events_copy(e, to, &e->here);
        for (size_t k = bit < 0 ? one : 0; k < all && (bit >= 0 || k == one); k++)
            *(k < nx ? &to->x[k] : &to->v[k - nx]) += (bit > 0 && (k >> (bit - 1) & 1) ? -sign : sign) * e->width[k];
        const motus_status status = rate ? events_rate_of(e, f, to, err) : events_value_of(e, f, to, err);
        if (status) return status;
        const double by = rate ? fabs(to->rate[f] - e->here.rate[f]) : fabs(to->g[f] - e->here.g[f]);
        if (isfinite(by)) *most = fmax(*most, by);
    }
    return MOTUS_OK;
}

/* Bounds the error of a function, or of its rate, by those of the state: by the sum of the changes by each number or,
 * where numbers are too many for that, by twice the largest change by some patterns of signs. */
static motus_status error_by_state(events *e, size_t f, bool rate, double h, bool halves, double *bound,
                                   motus_error *err)
{
    enum { FEW = 32 };
    const size_t all = e->problem.nx + e->problem.nv;
    motus_status status = MOTUS_OK;
    *bound = 0;
    bound_state(e, f, h, halves);
    for (size_t k = 0; k < all && all <= FEW && !status; k++) {
        double by = 0;
        if (e->width[k] > 0) status = raise_by_change(e, f, rate, -1, k, &by, err);
        *bound += by;
    }
    for (int bit = 0; all > FEW && !status && (bit == 0 || all >> (bit - 1)); bit++) {
        double by = 0;
        status = raise_by_change(e, f, rate, bit, 0, &by, err);
        *bound = fmax(*bound, 2 * by);
    }
    return status;
}

motus_status events_error_of(events *e, size_t f, double h, double *bound, motus_error *err)
{
    const motus_status status = error_by_state(e, f, false, h, row_adaptive(&e->method), bound, err);
    *bound += e->here.bound[f] + fabs(e->here.rate[f]) * events_ulp(e->here.t);
    return status;
}

motus_status events_step_keeps(events *e, size_t f, bool *does, motus_error *err)
{
    double bound;
    *does = false;
    events_copy(e, &e->here, &e->right);
    motus_status status = events_judge(e, &e->here, err);
    if (!status) status = error_by_state(e, f, false, e->span, true, &bound, err);
    if (status || !(fabs(e->right.g[f] - e->left.g[f]) <= bound)) return status;
    status = events_at_of(e, f, e->span / 2, &e->here, err); /* by a true step: dense output errs more */
    *does = !status && fabs(e->here.g[f] - e->left.g[f]) <= bound;
    return status;
}

motus_status events_slope_error_of(events *e, size_t f, double h, double *bound, motus_error *err)
{
    const motus_status status = error_by_state(e, f, true, h, row_adaptive(&e->method), bound, err);
    if (e->marked) *bound += 0x1p-52 * fmax(fabs(e->left.rate[f]), fabs(e->right.rate[f]));
    return status;
}

/* Evaluates the function or its rate after a true step of size h, in `next`. */
static motus_status look(events *e, size_t f, bool rate, double h, double *value, motus_error *err)
{
    motus_status status = events_at_of(e, f, h, &e->next, err);
    if (!status && rate) status = events_rate_of(e, f, &e->next, err);
    *value = rate ? e->next.rate[f] : e->next.g[f];
    return status;
}

/* Returns the distance from time h, found by doubling, at which the function or its rate exceeds a bound on both sides.
 * A side on which the step ends earlier counts only if the bound hides the whole step. A true step that fails, as one
 * too short for error control does, counts as within the bound. */
static double reach(events *e, size_t f, bool rate, double h, double bound)
{
    enum { STEPS_MOST = 1024 };
    const double span = fabs(e->span);
    bool hidden = true;
    double d = events_ulp(e->here.t);
    for (; hidden && d < STEPS_MOST * span; d *= 2) {
        const bool beyond = d >= span;
        hidden = false;
        for (int side = -1; side <= 1; side += 2) {
            const double at = h + side * d;
            double value;
            if (!beyond && (e->way * at < 0 || e->way * (e->span - at) < 0)) continue;
            const bool failed = look(e, f, rate, at, &value, NULL) != MOTUS_OK;
            hidden |= failed ? !beyond : !(fabs(value) > bound);
        }
    }
    return d;
}

/* Tells whether a root is simple: the slope hardly changes over the times at which the error bound of the function
 * hides the root. */
static bool is_simple(events *e, size_t f, double h, double bound)
{
    const double rate = e->here.rate[f], far = 4 * (bound / fabs(rate) + events_ulp(e->here.t));
    if (!(far < fabs(e->span) / 2)) return false;
    for (int side = -1; side <= 1; side += 2) {
        const double at = h + side * far;
        double there;
        if (e->way * at < 0 || e->way * (e->span - at) < 0) continue;
        if (look(e, f, true, at, &there, NULL) || !(fabs(there - rate) <= fabs(rate) / 2)) return false;
    }
    return true;
}

/* Tells whether a function may be flat at its root: its slope there is far below that at an end of the step, or with
 * fixed steps, which may be short beside the flat part, changes within the step. */
static bool may_be_flat(const events *e, size_t f)
{
    enum { FAR_BELOW = 32, CHANGES = 64 };
    const double rate = e->here.rate[f], left = e->left.rate[f], right = e->right.rate[f];
    const double change = fmax(fabs(left - rate), fabs(right - rate));
    return FAR_BELOW * fabs(rate) < fmax(fabs(left), fabs(right)) ||
           (!row_adaptive(&e->method) && fabs(rate) < CHANGES * change);
}

/* Limits *doubt for a touch at a kink. There the slope jumps when the state changes by its error, which does not tell
 * where the kink is; but the touch is no farther off than the function's own error bound hides it. */
static motus_status doubt_at_kink(events *e, size_t f, double h, double *doubt, motus_error *err)
{
    double bound;
    const motus_status status = events_error_of(e, f, h, &bound, err);
    if (!status) *doubt = fmin(*doubt, reach(e, f, false, h, bound + 2 * fabs(e->here.g[f])));
    return status;
}

#define COARSE 4

motus_status events_doubt(events *e, size_t f, double h, bool touches, double *doubt, motus_error *err)
{
    double bound;
    *doubt = 0;
    if (!e->marked || !(e->doubted || e->jog)) return MOTUS_OK;
    if (!touches && !may_be_flat(e, f)) { /* rounding of the state, where it is coarser than that of the time */
        const double rounded = e->here.bound[f] / fabs(e->here.rate[f]);
        if (isfinite(rounded)) e->blurred = fmin(rounded, fabs(e->span));
        if (e->blurred > COARSE * events_ulp(e->here.t)) *doubt = e->blurred;
        return MOTUS_OK;
    }
    if (!e->doubted) return MOTUS_OK;
    const motus_status status =
        touches ? events_slope_error_of(e, f, h, &bound, err) : events_error_of(e, f, h, &bound, err);
    if (status) return status;
    /* a jump beside the root changes the function when the state changes; this is not an error of the root */
    if (e->rules.rule[e->rule_of[f]].jump) {
        const double steepest = fmax(fabs(e->left.rate[f]), fabs(e->right.rate[f]));
        bound = fmin(bound, 4 * fmax(e->left.bound[f], e->right.bound[f]) + 0x1p-44 * steepest * fabs(e->span));
    }
    if (!touches) bound += 2 * fabs(e->here.g[f]); /* it is not quite 0 at the located time */
    const bool simple = !touches && is_simple(e, f, h, bound);
    *doubt = simple ? bound / fabs(e->here.rate[f]) : reach(e, f, touches, h, bound);
    return touches && !e->rules.rule[e->rule_of[f]].smooth ? doubt_at_kink(e, f, h, doubt, err) : MOTUS_OK;
}
