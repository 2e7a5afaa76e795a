/* Extrema near 0 of functions, which the exact motion may lead beyond 0 where the run does not, or the reverse. They
 * are kept for those who know the errors of the motion. See events_parts.h. */
#include "core/events_parts.h"

#include <math.h>
#include <string.h>

enum { PARTS = 16, TURNS = 40, EXTREMA_MOST = 1 << 12, MARGIN = 16 };
#define END 0x1p-10 /* so near to the ends of a part the way of a polynomial there is looked at */

void events_near(events *e, const double *off)
{
    const size_t all = e->problem.nx + e->problem.nv;
    if (!e->off) e->off = take(&e->allocator, all + 1, sizeof *e->off);
    for (size_t k = 0; k < all && e->off; k++) e->off[k] = MARGIN * off[k];
    e->extrema = 0;
}

void events_widen(events *e)
{
    for (size_t k = 0; e->off && k < e->problem.nx + e->problem.nv; k++) e->width[k] += e->off[k] / MARGIN;
}

size_t events_extrema(const events *e) { return e->extrema; }

size_t events_extremum(const events *e, size_t k, double *t, const double **x, const double **v)
{
    const double *const from = e->extremum + k * (2 + e->problem.nx + e->problem.nv);
    *t = from[1];
    *x = from + 2;
    *v = *x + e->problem.nx;
    return (size_t)from[0];
}

/* Keeps the state at a time of the step, where rounded errors of the motion may hide the sign of function f. */
static motus_status keep(events *e, stepper *s, size_t f, double h, motus_error *err)
{
    const size_t nx = e->problem.nx, nv = e->problem.nv, each = 2 + nx + nv;
    instant *at = &e->next;
    void *list = e->extremum;
    at->t = events_place_in(e, h);
    const motus_status status = stepper_sample(s, at->t, at->x, at->v, err);
    if (status || e->extrema == EXTREMA_MOST) return status;
    e->rules.least(e->rules.ctx, at->x, at->v, e->off, e->off + nx, at->rate);
    if (at->rate[f] > 0) return status;
    if (!events_grow(&e->allocator, &list, e->extrema, &e->extremum_room, 1, each * sizeof *e->extremum))
        return events_no_memory(err);
    e->extremum = list;
    double *const to = e->extremum + e->extrema++ * each;
    to[0] = (double)f, to[1] = at->t;
    memcpy(to + 2, at->x, nx * sizeof *to);
    memcpy(to + 2 + nx, at->v, nv * sizeof *to);
    return status;
}

/* The place of the extremum between two, by thirds. */
static double extremum_between(const double *c, int degree, double low, double high, bool largest)
{
    for (int turn = 0; turn < TURNS; turn++) {
        const double one = low + (high - low) / 3, two = high - (high - low) / 3;
        const bool rises = events_polynomial(c, degree, one) < events_polynomial(c, degree, two);
        *(rises == largest ? &low : &high) = rises == largest ? one : two;
    }
    return low + (high - low) / 2;
}

motus_status events_note_extrema(events *e, stepper *s, size_t f, double from, double to, const double *c, int degree,
                                 motus_error *err)
{
    motus_status status = MOTUS_OK;
    if (!e->off || !e->rules.least || e->problem.refresh || e->rules.rule[e->rule_of[f]].internal) return status;
    double place[PARTS + 3], value[PARTS + 3];
    for (int k = 0; k < PARTS + 3; k++) {
        place[k] = k == 0 ? 0 : k == 1 ? END : k == PARTS + 1 ? 1 - END : k == PARTS + 2 ? 1 : (k - 1.0) / PARTS;
        value[k] = events_polynomial(c, degree, place[k]);
    }
    for (int k = 1; k < PARTS + 2 && !status; k++) {
        const bool largest = value[k] > value[k - 1] && value[k] >= value[k + 1],
                   least = value[k] < value[k - 1] && value[k] <= value[k + 1];
        if (!largest && !least) continue;
        const double tau = extremum_between(c, degree, place[k - 1], place[k + 1], largest);
        status = keep(e, s, f, (from + tau * (to - from)) * e->span, err);
    }
    /* of methods of order 1 an extremum may lie between two steps, on a straight line in both */
    return status || to < 1 ? status : keep(e, s, f, e->span, err);
}
