/* See look.h.
 *
 * Over a step that leads from v to v', or a part of one, the integral of the force along the dense output has to be v'
 * - v; what is missing is the error that the part makes in the velocity. Gauss's rule takes the integral, at abscissae
 * that the method does not have. Interval arithmetic over all states of a part says whether some operation may do more
 * than points can show; such a part is halved, so that no peak and no window is too narrow to be seen. Sizes are added
 * up over the parts, because a force that pushes and then pulls shifts a motion, but leaves its velocity as it was.
 * Once the sum is too large, the look ends, and the step is to end there as well, so that it pays for the first of many
 * peaks only. If not all peaks can be searched for, there are no bars.
 *
 * Where a switch may stand at 0, the force has more than one value. In a run with located switches, what has happened
 * has to be a mean of what the force does along ways beside the motion, on each of which a switch has one side, even if
 * it is written several times [Filippov88]. Other runs step across switches, and parts with one are not judged, however
 * short they become.
 */
#include "api/error/look.h"

#include "api/error/convex.h"
#include "api/system/vector.h"

#include <math.h>
#include <string.h>

enum {
    POINTS = 8,   /* even */
    PARTS = 4096, /* most parts of a step */
    FINE = 8,     /* halvings after which a part is left in which a switch may change its side */
    HELD = 2,     /* halvings after which ways beside the motion are taken */
    DEEP = 4,     /* halvings after which they are taken where other operations change too, as u/|u| */
    IDLE = 4,     /* ways in succession that may bring no gain */
    VAIN = 32     /* steps before the next try to look ahead, after one that failed */
};
#define NEAR 0x1p-16    /* how far a way is beside the motion, in units of how far the part may lead */
#define SLACK 0x1p-8    /* of the accelerations: the error of dense output */
#define BOUNDS 12.0     /* evaluations that bounds over a step cost */
#define SUSPICIOUS 10.0 /* times what a step may lose */
#define PROBE_SEES 4.0  /* a probe has to see this many times less than what is missing */
#define ULP 0x1p-52

/* Gauss's abscissae in (0, 1) beyond the middle, less 1/2, and their weights [DLMF, table 3.5.2]. */
static const double abscissa[POINTS / 2] = {0.0917173212478248849, 0.2627662049581645044, 0.3983332387068134038,
                                            0.4801449282487681160};
static const double part_of[POINTS / 2] = {0.1813418916891809915, 0.1568533229389436437, 0.1111905172266872352,
                                           0.0506142681451885293};

bool look_see(stepper *s, double t, state *to)
{
    to->t = t;
    return stepper_sample(s, t, to->x, to->v, NULL) == MOTUS_OK;
}

static interval about(double middle, double half) { return (interval){middle - half, middle + half}; }

/* Finds the box of the motion in a part of a step. Returns its times. */
static interval surround(witness *w, const state *from, const state *to)
{
    const problem *const p = &w->typed->problem;
    const double h = fabs(to->t - from->t);
    for (size_t k = 0; k < p->nv; k++) {
        const size_t at = look_place(w, k);
        const double around = w->strict ? SUSPICIOUS * w->rounded[at] : 0;
        w->in_v[k] = about(from->v[at] + (to->v[at] - from->v[at]) / 2, h / 2 * w->most[at] + around);
    }
    for (size_t k = 0; k < p->nx; k++) {
        const double way = to->x[k] - from->x[k], around = w->strict ? SUSPICIOUS * w->rounded_x[k] : 0;
        w->in_x[k] = about(from->x[k] + way / 2, fabs(way) / 2 + h * h / 8 * w->most[k] + around);
    }
    return (interval){fmin(from->t, to->t), fmax(from->t, to->t)};
}

static bool passes(witness *w, resolution *bends, interval t, interval *x, interval *v)
{
    w->spent += BOUNDS;
    return resolution_fits(bends, t, x, v, w->typed->model->pool);
}

static bool inside(const interval *part, const interval *whole, size_t count)
{
    for (size_t k = 0; k < count; k++)
        if (!(part[k].low >= whole[k].low && part[k].high <= whole[k].high)) return false;
    return true;
}

/* Extends an interval over the next steps: to the side to which it moves, and somewhat to both. */
static interval extend(interval now, double way, double steps)
{
    const double most = (now.high - now.low) * steps / 4, far = way * steps;
    return (interval){now.low + fmin(far, 0) - most, now.high + fmax(far, 0) + most};
}

/* Returns whether nothing hides in a whole step, with the box in_x, in_v and the times t. What fits over a box fits
 * over every part of it, so one look at where many short steps may lead serves them all. */
static bool clear(witness *w, const state *from, const state *to, interval t)
{
    const problem *const p = &w->typed->problem;
    if (inside(&t, &w->clear, 1) && inside(w->in_x, w->clear_x, p->nx) && inside(w->in_v, w->clear_v, p->nv))
        return true;
    if (w->vain > 0) return w->vain--, passes(w, w->bends, t, w->in_x, w->in_v);
    for (size_t k = 0; k < p->nx; k++) w->clear_x[k] = extend(w->in_x[k], to->x[k] - from->x[k], w->ahead);
    for (size_t k = 0; k < p->nv; k++)
        w->clear_v[k] = extend(w->in_v[k], to->v[look_place(w, k)] - from->v[look_place(w, k)], w->ahead);
    w->clear = extend(t, to->t - from->t, w->ahead);
    if (passes(w, w->bends, w->clear, w->clear_x, w->clear_v)) return w->ahead = fmin(2 * w->ahead, AHEAD), true;
    w->clear = (interval){1, -1};
    w->ahead /= 4;
    if (w->ahead < 2) w->ahead = AHEAD / 16, w->vain = VAIN;
    return passes(w, w->bends, t, w->in_x, w->in_v);
}

bool look_fits(witness *w, resolution *bends, const state *from, const state *to)
{
    const interval t = bends ? surround(w, from, to) : (interval){0, 0};
    const bool whole = bends == w->bends && from == &w->at[FROM] && to == &w->at[TO] && !w->strict;
    return !bends || (whole ? clear(w, from, to, t) : passes(w, bends, t, w->in_x, w->in_v));
}

double look_turn(uint32_t way, size_t k)
{
    uint64_t state = ((uint64_t)way - 1) * 0x9e3779b97f4a7c15u + ((uint64_t)k + 1) * 0xd1b54a32d192ed03u;
    return vector_random(&state);
}

double look_lost(const witness *w, size_t k, double x, double h)
{
    return fmax(fmax(w->method.relative, ROUNDING) * fabs(x), h * w->allowed[k]);
}

/* Moves a state of the motion to a way beside it, farther than rounding and than what a step may lose. */
static void step_aside(const witness *w, double *x, double *v, double h, uint32_t way)
{
    const problem *const p = &w->typed->problem;
    h = fabs(h);
    for (size_t k = 0; k < p->nx; k++) {
        const double lost = fmax(look_lost(w, k, x[k], h), w->rounded_x[k]);
        const double far = NEAR * h * (fabs(v[k]) + h * w->scale[k]) + SUSPICIOUS * lost;
        x[k] += far * look_turn(way, p->nv + k);
    }
    for (size_t k = 0; k < p->nv; k++)
        v[k] += (NEAR * h * w->scale[k] + SUSPICIOUS * w->allowed[look_place(w, k)]) * look_turn(way, k);
}

/* Counts a part. most: the most that is missing from it, in units of what is allowed. */
static void count_part(witness *w, const state *from, double h, double most)
{
    if (most > w->worst && !(w->worst > FIRST)) w->start = from->t, w->length = h;
    w->worst = fmax(w->worst, most);
    w->parts++;
}

/* Integrates the force over a part, and finds the largest accelerations in it. way 0: along the motion; others lie
 * beside it, each on one side from the beginning to the end of the part. */
static bool integrate(witness *w, stepper *s, const state *from, double h, uint32_t way, double *sum)
{
    const problem *const p = &w->typed->problem;
    state *const point = &w->at[POINT];
    for (size_t k = 0; k < p->nv; k++) sum[k] = 0;
    for (int i = 0; i < POINTS; i++) {
        const double c = i & 1 ? abscissa[i / 2] : -abscissa[i / 2];
        if (!look_see(s, from->t + h * (0.5 + c), point)) return false;
        for (size_t k = 0; k < p->nv; k++) w->v[k] = point->v[look_place(w, k)];
        if (way) step_aside(w, point->x, w->v, h, way);
        if (p->accel(p->ctx, point->t, point->x, w->v, w->a)) return false;
        for (size_t k = 0; k < p->nv; k++) {
            sum[k] += part_of[i / 2] * h * w->a[k];
            w->scale[k] = fmax(w->scale[k], fabs(w->a[k]));
        }
    }
    w->spent += POINTS;
    return true;
}

/* Finds the weights: 1 over how far off each velocity may be in a part before only another force can explain it. */
static void find_weights(witness *w, double h)
{
    for (size_t k = 0; k < w->typed->problem.nv; k++) {
        const size_t at = look_place(w, k);
        w->weight[k] = 1 / (SLACK * fabs(h) * w->scale[k] + SUSPICIOUS * (w->probes ? w->rounded : w->allowed)[at]);
    }
}

/* Notes that too much is missing from a part: `room`. */
static void note_beside(witness *w)
{
    double most = 0;
    w->beside = true;
    for (size_t k = 0; k < w->typed->problem.nv; k++) {
        const double off = fabs(w->room[k]) * w->weight[k];
        if (off > most) most = off, w->number = k;
    }
}

bool look_follow(witness *w, stepper *s, const state *from, const state *to, uint32_t way, double *less)
{
    if (!integrate(w, s, from, to->t - from->t, way, less)) return false;
    for (size_t k = 0; k < w->typed->problem.nv; k++)
        less[k] = w->driven[k] ? 0 : less[k] - (to->v[look_place(w, k)] - from->v[look_place(w, k)]);
    return true;
}

/* Where the method has no bounds, they are twice the force's largest values at points between. */
bool look_bound(witness *w, stepper *s)
{
    const double h = stepper_time(s) - w->at[FROM].t;
    if (stepper_swing(s, w->most)) return true;
    memset(w->scale, 0, w->nv * sizeof *w->scale);
    memset(w->most, 0, w->nv * sizeof *w->most);
    if (!integrate(w, s, &w->at[FROM], h, 0, w->room)) return false;
    for (size_t k = 0; k < w->typed->problem.nv; k++) w->most[look_place(w, k)] = 2 * w->scale[k];
    return true;
}

/* Adds up what is missing from a part. */
static bool hold(witness *w, stepper *s, const state *from, const state *to)
{
    const double h = to->t - from->t;
    double most = 0, off = 0;
    for (size_t k = 0; k < w->typed->problem.nv; k++) w->scale[k] = w->most[look_place(w, k)];
    if (!look_follow(w, s, from, to, 0, w->room)) return false;
    find_weights(w, h);
    for (size_t k = 0; k < w->typed->problem.nv; k++) {
        const double missing = fabs(w->room[k]);
        w->missing[look_place(w, k)] += missing;
        w->lack[look_place(w, k)] += w->room[k];
        most = fmax(most, missing / w->allowed[look_place(w, k)]);
        off = fmax(off, missing * w->weight[k]);
    }
    if (w->strict && off > 1) note_beside(w);
    count_part(w, from, h, most);
    return true;
}

/* Finds, of WAYS ways, the one that leads farthest from `room` towards the origin. */
static bool nearest(witness *w, stepper *s, const state *from, const state *to, uint32_t *way, double *best)
{
    const size_t n = w->typed->problem.nv;
    double least = INFINITY, *const one = w->other_way;
    for (const uint32_t end = *way + WAYS; *way < end; (*way)++) {
        if (!look_follow(w, s, from, to, *way, one)) return false;
        const double along = convex_product(w->room, one, w->weight, n);
        if (along < least) least = along, memcpy(best, one, n * sizeof *best);
    }
    return true;
}

/* Adds up what is missing from a part where a switch may stand at 0: what no mean of the ways beside it explains. */
static bool hold_beside(witness *w, stepper *s, const state *from, const state *to)
{
    const size_t n = w->typed->problem.nv;
    const double h = to->t - from->t;
    uint32_t way = 0, count = 0;
    for (size_t k = 0; k < n; k++) w->scale[k] = w->most[look_place(w, k)];
    for (; way < WAYS; way++, count++)
        if (!look_follow(w, s, from, to, way, w->ways + way * n)) return false;
    find_weights(w, h);
    double off = convex_distance(w->ways, count, n, w->weight, 1, w->share, w->room);
    for (int idle = 0; off > 1 && count < WAYS + MORE && idle < IDLE;) {
        const double least = off;
        if (!nearest(w, s, from, to, &way, w->ways + count * n)) return false;
        off = convex_distance(w->ways, ++count, n, w->weight, 1, w->share, w->room);
        idle = off < (1 - SLACK) * least ? 0 : idle + 1;
    }
    const bool is = off > 1;
    for (size_t k = 0; is && k < n; k++) w->missing[look_place(w, k)] += fabs(w->room[k]);
    if (is) note_beside(w);
    count_part(w, from, h, is ? SUSPICIOUS * off : 0);
    return true;
}

/* Returns whether more than their errors is missing from n positions or velocities y. */
static bool beyond_errors(const double *missing, const double *y, size_t n, double errors)
{
    return vector_largest(missing, n) > fmax(errors, ROUNDING * vector_largest(y, n));
}

bool look_beyond_velocities(const witness *w, const double *missing, double times)
{
    return beyond_errors(missing, w->at[TO].v, w->nv, times * fmax(w->differences->most[1], w->differences->most[2]));
}

bool look_beyond_places(const witness *w, const double *missing, double times)
{
    return beyond_errors(missing, w->at[TO].x, w->nx, times * w->differences->most[0]);
}

bool look_suspects(witness *w)
{
    double most = 0;
    for (size_t k = 0; k < w->nv; k++) most = fmax(most, w->missing[k] / w->allowed[k]);
    const double least = vector_largest(w->missing, w->nv) / (PROBE_SEES * SUSPICIOUS);
    w->sees = most > SUSPICIOUS ? INFINITY : least;
    w->far = most > SUSPICIOUS * REFUSED;
    return most > SUSPICIOUS || (!w->probes && look_beyond_velocities(w, w->missing, BARS));
}

bool look_stirs(const witness *w, size_t k)
{
    return w->speed[k] <= NOTHING && w->missing[k] > NOTHING && isfinite(w->missing[k]);
}

/* Returns whether the look may end because too much is missing. It may not while something is missing from a number at
 * rest: that becomes the number's size. */
static bool shows_enough(witness *w)
{
    bool any = false;
    for (size_t k = 0; k < w->nv && !any; k++) any = look_stirs(w, k);
    return !any && look_suspects(w) && w->far;
}

/* Holds a part in which no switch stands at 0. It counts if it lies before every switch, or the whole step counts. */
static bool hold_before(witness *w, stepper *s, const state *from, const state *to)
{
    if (!isnan(w->past) && !w->whole) return w->parts++, true;
    w->counted = true;
    if (!hold(w, s, from, to)) return false;
    if (vector_largest(w->missing, w->nv) <= ULP * vector_largest(to->v, w->nv)) w->clean = to->t;
    w->ended = w->first_only && (from != &w->at[FROM] || to != &w->at[TO]) && shows_enough(w);
    if (w->ended) w->behind_first = to->t;
    return true;
}

/* Notes that a switch may stand at 0 in a part that begins at t. */
static void cross(witness *w, double t)
{
    w->crosses = true;
    if (w->counted && isnan(w->past)) w->past = t;
}

bool look_at(witness *w, stepper *s, const state *from, const state *to, int depth)
{
    if (w->ended) return true;
    state *const middle = &w->at[MIDDLE + depth];
    const bool spent = w->parts >= PARTS || w->spent > w->most_spent, last = depth == DEPTH || spent;
    const bool known = depth == 0 && !w->strict; /* the whole step did not fit before */
    if (!w->covered && !known && look_fits(w, w->bends, from, to)) return hold_before(w, s, from, to);
    const bool sided = (w->located || (w->steady && w->kinked)) && depth >= (w->steady || w->strict ? HELD : FINE),
               deep = w->strict && (depth >= DEEP || last);
    if (sided && (deep || look_fits(w, w->smooth, from, to))) {
        cross(w, from->t);
        return w->strict ? hold_beside(w, s, from, to) : (w->parts++, true);
    }
    if (last && w->kinked) return cross(w, from->t), w->parts++, true;
    w->exhausted |= spent;
    if (last) return hold_before(w, s, from, to);
    return look_see(s, from->t + (to->t - from->t) / 2, middle) && look_at(w, s, from, middle, depth + 1) &&
           look_at(w, s, middle, to, depth + 1);
}
