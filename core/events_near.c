/* Extrema of functions near 0: they may lie beyond 0 for the exact motion and not for the run, or the reverse. They are
 * kept for the files that know the errors of the motion. See events_parts.h. */
#include "core/events_parts.h"

#include <math.h>
#include <string.h>

enum { TURNS = 40, EXTREMA_MOST = 1 << 12, MARGIN = 16 };
enum { OF, TIME, KIND, STATE }; /* the numbers of an extremum: function, time, kind, and from STATE on x and v */

void events_forget_extrema(events *e)
{
    e->extrema = 0;
    for (size_t k = 0; k < e->rules.count; k++) e->unkept[k] = NAN;
}

bool events_near(events *e, const double *off)
{
    const size_t all = e->problem.nx + e->problem.nv;
    if (!e->off) e->off = take(&e->allocator, all + 1, sizeof *e->off);
    for (size_t k = 0; k < all && e->off; k++) e->off[k] = MARGIN * off[k];
    events_forget_extrema(e);
    return e->off;
}

double events_off(const events *e, size_t k) { return e->off ? e->off[k] / MARGIN : 0; }

void events_widen(events *e)
{
    for (size_t k = 0; k < e->problem.nx + e->problem.nv; k++) e->width[k] += events_off(e, k);
}

size_t events_extrema(const events *e) { return e->extrema; }

double events_unkept(const events *e, size_t rule) { return e->unkept[rule]; }

size_t events_extremum(const events *e, size_t k, events_near_kind *kind, double *t, const double **x, const double **v)
{
    const double *const from = e->extremum + k * (STATE + e->problem.nx + e->problem.nv);
    *kind = (events_near_kind)from[KIND];
    *t = from[TIME];
    *x = from + STATE;
    *v = *x + e->problem.nx;
    return (size_t)from[OF];
}

void events_cut_extrema(events *e, double end)
{
    const size_t each = STATE + e->problem.nx + e->problem.nv, all = e->extrema;
    e->extrema = 0;
    for (size_t k = 0; k < all; k++) {
        double *const from = e->extremum + k * each;
        if (e->way * (from[TIME] - end) > 0) continue;
        memmove(e->extremum + e->extrema++ * each, from, each * sizeof *from);
    }
}

static motus_status keep(events *e, size_t f, events_near_kind kind, const instant *at, motus_error *err)
{
    const size_t nx = e->problem.nx, nv = e->problem.nv, each = STATE + nx + nv;
    void *list = e->extremum;
    if (e->extrema >= EXTREMA_MOST) {
        double *const since = &e->unkept[e->rule_of[f]];
        if (!(e->way * (at->t - *since) >= 0)) *since = at->t;
        return MOTUS_OK;
    }
    if (!events_grow(&e->allocator, &list, e->extrema, &e->extremum_room, 1, each * sizeof *e->extremum))
        return events_no_memory(err);
    e->extremum = list;
    double *const to = e->extremum + e->extrema++ * each;
    to[OF] = (double)f, to[TIME] = at->t, to[KIND] = kind;
    memcpy(to + STATE, at->x, nx * sizeof *to);
    memcpy(to + STATE + nx, at->v, nv * sizeof *to);
    return MOTUS_OK;
}

/* Keeps the state at time h of the step if the errors of the motion may hide the sign of function f there. */
static motus_status keep_at(events *e, stepper *s, size_t f, events_near_kind kind, double h, motus_error *err)
{
    instant *at = &e->next;
    at->t = events_place_in(e, h);
    const motus_status status = stepper_sample(s, at->t, at->x, at->v, err);
    if (status) return status;
    e->rules.least(e->rules.ctx, at->x, at->v, e->off, e->off + e->problem.nx, at->rate);
    return at->rate[f] > 0 ? status : keep(e, f, kind, at, err);
}

static bool notes(const events *e) { return e->off && e->rules.least && !e->problem.refresh; }

motus_status events_note_rest(events *e, motus_error *err)
{
    const instant *at = &e->here;
    double *const least = e->next.rate;
    motus_status status = MOTUS_OK;
    if (!notes(e)) return status;
    e->rules.least(e->rules.ctx, at->x, at->v, e->off, e->off + e->problem.nx, least);
    for (size_t f = 0; f < e->rules.functions && !status; f++) {
        if (e->rules.rule[e->rule_of[f]].internal) continue;
        const bool rests = e->arrives[f] || (e->zero[f] && e->side[f] && at->rate[f] == 0);
        if (rests)
            status = keep(e, f, EVENTS_NEAR_REST, at, err);
        else if (!e->zero[f] && at->rate[f] == 0 && !(least[f] > 0))
            status = keep(e, f, EVENTS_NEAR_EXTREMUM, at, err);
    }
    return status;
}

/* Evaluates by Clenshaw's formula. */
double events_polynomial(const double *c, int degree, double tau)
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

/* Writes the coefficients of half the slope d/dtau of a polynomial: coefficients belong to 2 tau - 1. */
static void derive(const double *c, int degree, double *slope)
{
    slope[degree] = 0;
    for (int k = degree; k > 0; k--) slope[k - 1] = 2 * k * c[k] + (k < degree ? slope[k + 1] : 0);
    slope[0] /= 2;
}

/* Returns where the slope changes its sign between `low`, where it has the sign `sign`, and `high`. */
static double level_between(const double *slope, int degree, double low, double high, int sign)
{
    for (int turn = 0; turn < TURNS; turn++) {
        const double middle = low + (high - low) / 2;
        *(sign * events_polynomial(slope, degree, middle) > 0 ? &low : &high) = middle;
    }
    return low + (high - low) / 2;
}

motus_status events_note_extrema(events *e, stepper *s, size_t f, const events_piece *p, motus_error *err)
{
    motus_status status = MOTUS_OK;
    if (!notes(e) || e->rules.rule[e->rule_of[f]].internal) return status;
    double slope[ROOTS_DEGREE_MOST + 1], before = 0;
    int points = ROOTS_DEGREE_LEAST, sign = 0;
    const double hidden = (double)p->degree * p->degree * p->noise; /* by Markov's inequality */
    while (points < 2 * p->degree && points < ROOTS_DEGREE_MOST) points *= 2;
    derive(p->c, p->degree, slope);
    for (int k = 0; k <= points && !status; k++) {
        const double tau = roots_point(k, points), way = events_polynomial(slope, p->degree, tau);
        const int now = (way > hidden) - (way < -hidden);
        if (now == 0) continue;
        if (now == -sign) {
            const double at = level_between(slope, p->degree, before, tau, sign);
            status = keep_at(e, s, f, EVENTS_NEAR_EXTREMUM, (p->from + at * (p->to - p->from)) * e->span, err);
        }
        sign = now, before = tau;
    }
    /* with methods of order 1 an extremum may lie between two steps, each of which is a straight line */
    return status || p->to < 1 ? status : keep_at(e, s, f, EVENTS_NEAR_END, e->span, err);
}
