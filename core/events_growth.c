/* Actions that follow one another ever faster because the motion grows, or whose intervals shrink with a power of their
 * number. See events_parts.h.
 *
 * After 1, 2, 4, 8, … actions a mark keeps the time and the largest size of every number. Actions whose intervals
 * shrink by a constant factor reach their limit, within the rounding of the time, after a few hundred (events_table.c).
 * The marks then tell whether a number has grown by a constant factor too: it has no limit, and the motion ends there.
 * Intervals that shrink with a power of the number of actions never become so short. The times of the marks are then a
 * sequence whose differences fall by a nearly constant factor, and Aitken's formula, applied twice, tells its limit.
 */
#include "core/events_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define BEFORE 0.99 /* of the way so far, at which a run may end */

static double *most_at(const events *e, int mark)
{
    return e->growth_most + (size_t)(mark % GROWTH_MARKS) * (e->problem.nx + e->problem.nv);
}

static double time_at(const events *e, int mark) { return e->growth_t[mark % GROWTH_MARKS]; }

/* Tells whether number k is a mode that neither the force nor a rule reads; it has no part in what happens. */
static bool is_kept(const events *e, size_t k)
{
    for (size_t j = 0; j < e->rules.kept_count; j++)
        if (e->rules.kept[j] == k) return true;
    return false;
}

static void name_of(const events *e, size_t number, char out[MOTUS_NAME_MAX])
{
    const problem *p = &e->problem;
    const bool in_v = number >= p->nx;
    snprintf(out, MOTUS_NAME_MAX, "the state");
    if (p->name) p->name(p->ctx, in_v, in_v ? number - p->nx : number, out, MOTUS_NAME_MAX);
}

static void name_of_rule(const events *e, size_t rule, size_t instance, char out[MOTUS_NAME_MAX])
{
    out[0] = 0;
    if (e->rules.name) e->rules.name(e->rules.ctx, rule, instance, out, MOTUS_NAME_MAX);
    if (!out[0]) snprintf(out, MOTUS_NAME_MAX, "%s", e->rules.rule[rule].name);
}

/* Returns the status and the message of actions without end. number: the number that grows; SIZE_MAX: none does. The
 * limit belongs to the run's own motion, so the tolerance and the rounding of every action count as its error. */
static motus_status without_end(const events *e, const events_limit *at, size_t number, motus_error *err)
{
    const bool adapts = row_adaptive(&e->method);
    const double missed = adapts ? fmax(e->method.relative, e->method.absolute) * fabs(at->t - e->start) : 0;
    const double error = 2 * at->error + missed + (4 + (double)e->acted) * events_ulp(at->t);
    const double gone = e->here.t - e->start;
    char text[DECIMAL_MAX];
    const double end = decimal_near(e->start + BEFORE * gone, (1 - BEFORE) / 2 * fabs(gone), text);
    char of[MOTUS_NAME_MAX], grows[MOTUS_NAME_MAX], now[DECIMAL_MAX];
    const motus_status status = number == SIZE_MAX ? MOTUS_EVENTS : MOTUS_DIVERGED;
    const int places = (int)fmax(0, fmin(15, ceil(-log10(error))));
    name_of_rule(e, at->rule, at->instance, of);
    decimal_time(e->here.t, e->until - e->start, now);
    if (number == SIZE_MAX) {
        fail(err, status, "%s happens ever faster, %lld times until t = %s, and without end as t nears %.*f ± %.0e", of,
             (long long)e->count[at->rule], now, places, at->t, error);
    } else {
        name_of(e, number, grows);
        fail(err, status,
             "%s happens ever faster, %lld times until t = %s, and %s grows without bound as t nears %.*f ± %.0e", of,
             (long long)e->count[at->rule], now, grows, places, at->t, error);
    }
    hint(err, "end the run before, `until = %s` of the definition", text);
    if (!err) return status;
    err->time = e->here.t;
    err->cause = number == SIZE_MAX ? MOTUS_CAUSE_EVENTS : MOTUS_CAUSE_SINGULAR;
    err->verified = e->way * (e->here.t - end) >= 0;
    snprintf(err->attempt, sizeof err->attempt, "until = %.24s", text);
    snprintf(err->variable, sizeof err->variable, "%s", number == SIZE_MAX ? of : grows);
    if (number == SIZE_MAX) return status;
    err->singular = at->t;
    err->singular_error = error;
    return status;
}

/* Returns the rate, per action, at which the logarithm of a number's size grows. */
static double rate_of(double before, double after, double actions) { return log(after / before) / actions; }

motus_status events_unbounded(const events *e, motus_error *err)
{
    const size_t nx = e->problem.nx, all = nx + e->problem.nv;
    int last = e->growths - 1;
    if (last >= 1 && 2 * e->acted < 3 * ((int64_t)1 << last)) last--;
    if (last < 1 || e->growths - last > 2) return MOTUS_OK;
    const double since = (double)(e->acted - ((int64_t)1 << last)), between = ldexp(1, last - 1), t = e->here.t;
    const double left = fmax(fabs(e->limit.t - t), events_ulp(t)),
                 shrunk = log(fabs(e->limit.t - time_at(e, last)) / left);
    const double *const one = most_at(e, last - 1), *const two = most_at(e, last);
    size_t which = SIZE_MAX;
    double fastest = 0;
    for (size_t k = 0; k < all; k++) {
        if (!(one[k] > 0) || (k < nx && is_kept(e, k))) continue;
        const double before = rate_of(one[k], two[k], between), now = rate_of(two[k], e->most[k], since);
        /* a power of the number of actions, such as a counter, grows at most at half the rate before */
        if (!(now >= 0.75 * before) || !(now * since >= shrunk / 16)) continue;
        if (now > fastest) fastest = now, which = k;
    }
    return which == SIZE_MAX ? MOTUS_OK : without_end(e, &e->limit, which, err);
}

/* Returns the limit of a sequence by its latest three numbers; NaN where its differences do not fall. */
static double aitken(double a, double b, double c)
{
    const double one = c - b, two = b - a;
    return fabs(one) < fabs(two) ? c + one * one / (two - one) : NAN;
}

/* Returns the limit of the times at the marks, or NaN; tells its error, and the factor by which differences fall. */
static double limit_of_marks(const events *e, double *error, double *factor)
{
    double once[GROWTH_MARKS], t[GROWTH_MARKS], ratio[GROWTH_MARKS];
    const int n = GROWTH_MARKS;
    for (int k = 0; k < n; k++) t[k] = time_at(e, e->growths - n + k);
    for (int k = 2; k < n; k++)
        once[k] = aitken(t[k - 2], t[k - 1], t[k]), ratio[k] = (t[k] - t[k - 1]) / (t[k - 1] - t[k - 2]);
    const double twice = aitken(once[n - 3], once[n - 2], once[n - 1]),
                 before = aitken(once[n - 4], once[n - 3], once[n - 2]);
    const double end = aitken(ratio[n - 3], ratio[n - 2], ratio[n - 1]);
    *factor = fmax(ratio[n - 1], isnan(end) ? ratio[n - 1] + fabs(ratio[n - 1] - ratio[n - 2]) : end);
    *error = fabs(twice - before);
    return twice;
}

/* Returns the number that has grown by the largest factor since the mark before, if it grew by at least 1.1 from mark
 * to mark, three times; SIZE_MAX: none. A logarithm of the number of actions grows by less. */
static size_t grown(const events *e)
{
    enum { LAST = 3 };
    const size_t nx = e->problem.nx, all = nx + e->problem.nv;
    size_t which = SIZE_MAX;
    double largest = 1.1;
    for (size_t k = 0; k < all; k++) {
        bool grows = !(k < nx && is_kept(e, k));
        double factor = 0;
        for (int j = 0; j < LAST && grows; j++) {
            const double before = most_at(e, e->growths - 2 - j)[k], now = most_at(e, e->growths - 1 - j)[k] / before;
            if (j == 0) factor = now;
            grows = before > 0 && now >= 1.1;
        }
        if (grows && factor > 1.001 * largest) largest = factor, which = k;
    }
    return which;
}

/* Judges the marks. The time left must be far above the rounding of times. Where no number grows, the actions
 * themselves reach the limit (events_table.c), unless they are too many. */
static motus_status judge(const events *e, size_t rule, size_t instance, motus_error *err)
{
    enum { ULPS = 1 << 16, ACTIONS = 1 << 24 };
    double error, factor;
    events_limit at = {.rule = rule, .instance = instance};
    at.t = limit_of_marks(e, &error, &factor);
    at.error = error;
    const double t = e->here.t, left = e->way * (at.t - t), ulp = events_ulp(t);
    /* intervals that fall as 1/n, or a little faster, end nowhere; their factor goes to 1 */
    if (!(factor > 0 && factor < 0.88) || !(left > ULPS * ulp) || !(error <= 0.01 * left)) return MOTUS_OK;
    if (!(e->way * (e->until - at.t) > 8 * error)) return MOTUS_OK;
    const size_t number = grown(e);
    const double more = pow(left / (512 * ulp), log(2) / -log(factor));
    if (number == SIZE_MAX && (double)e->acted * more < ACTIONS) return MOTUS_OK;
    return without_end(e, &at, number, err);
}

motus_status events_growth(events *e, size_t rule, size_t instance, motus_error *err)
{
    enum { TRUSTED = 12 };
    if (e->acted & (e->acted - 1)) return MOTUS_OK;
    e->growth_t[e->growths % GROWTH_MARKS] = e->here.t;
    memcpy(most_at(e, e->growths), e->most, (e->problem.nx + e->problem.nv) * sizeof *e->most);
    e->growths++;
    return e->growths > TRUSTED ? judge(e, rule, instance, err) : MOTUS_OK;
}
