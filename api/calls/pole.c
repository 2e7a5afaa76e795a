/* See pole.h.
 *
 * Interval arithmetic excludes poles from parts of the way, which is halved until the parts left are short: places
 * where a divisor may be 0. The force need not be infinite there (sin(x)/x), or may have an integral (1/sqrt(|x|)). So
 * the power of the time with which it grows is found, from its changes near the place. Invariant: a pole of any
 * strength is found, if near it, beyond the rounding of times and states, the force changes by more than its own
 * rounding.
 */
#include "api/calls/pole.h"

#include <math.h>

enum { DEPTH = 44, LOOKS = 5000, PLACES = 64, SHORTEST = -34, LONGEST = -12, SCALES = 10, SAME = 3, BETWEEN = 5 };
#define CLEAR 1e3    /* times the rounding of the force: smaller changes do not count */
#define FAR 0x1p9    /* least distance, in roundings of a time or a state */
#define ALIKE 0.02   /* powers this near to one another are equal */
#define INVERSE 0.95 /* from this power of 1/time on, a force counts as one without an integral */

typedef struct search {
    const pole_way *way;
    int looks, places; /* how many are left */
} search;

/* Number k of x on the way, as a polynomial of the fraction z of the time: x + first z + second z² + third z³. */
typedef struct cubic {
    double first, second, third;
} cubic;

static cubic cubic_of(const pole_way *w, size_t k)
{
    const double way = w->end_x[k] - w->x[k], from = w->h * w->v[k], to = w->h * w->end_v[k];
    if (w->straight) return (cubic){way, 0, 0};
    return (cubic){from, 3 * way - 2 * from - to, from + to - 2 * way};
}

static void point(const pole_way *w, double z, double *x, double *v)
{
    const problem *p = &w->system->problem;
    for (size_t k = 0; k < p->nv; k++) {
        v[k] = w->v[k] + z * (w->end_v[k] - w->v[k]);
        if (k >= p->nx) continue;
        const cubic c = cubic_of(w, k);
        x[k] = w->x[k] + z * (c.first + z * (c.second + z * c.third));
        if (!w->straight) v[k] = (c.first + z * (2 * c.second + z * 3 * c.third)) / w->h;
    }
}

static interval between(double a, double b, double bend) { return (interval){fmin(a, b) - bend, fmax(a, b) + bend}; }

/* Returns whether interval arithmetic excludes a pole between two fractions of the way. */
static bool excluded(const pole_way *w, double low, double high)
{
    motus_system *s = w->system;
    const problem *p = &s->problem;
    double *x = w->room, *v = x + p->nv, *end_x = v + p->nv, *end_v = end_x + p->nv;
    interval *box_x = w->box, *box_v = box_x + p->nx;
    const double part = (high - low) * (high - low) / 8;
    point(w, low, x, v);
    point(w, high, end_x, end_v);
    for (size_t k = 0; k < p->nv; k++) {
        const cubic c = k < p->nx ? cubic_of(w, k) : (cubic){0, 0, 0};
        if (k < p->nx) box_x[k] = between(x[k], end_x[k], part * (2 * fabs(c.second) + 6 * fabs(c.third)));
        box_v[k] = between(v[k], end_v[k], w->straight ? 0 : part * 6 * fabs(c.third / w->h));
    }
    const interval t = between(w->t + low * w->h, w->t + high * w->h, 0);
    return !resolution_pole(s->poles, t, box_x, box_v, s->model->pool);
}

/* Computes the force at a fraction of the way. False: there is none. */
static bool force(const pole_way *w, double z, double *a)
{
    const problem *p = &w->system->problem;
    double *x = w->room, *v = x + p->nv;
    point(w, z, x, v);
    for (size_t k = 0; k < p->nv; k++) a[k] = 0;
    return p->accel(p->ctx, w->t + z * w->h, x, v, a) == 0;
}

/* Returns how much the force changes between the fractions z + d and z + 2 d. NaN: there is none, or only rounding. */
static double change(const pole_way *w, double z, double d)
{
    const problem *p = &w->system->problem;
    double *near = w->room + 2 * p->nv, *far = near + p->nv, most = 0, size = 0;
    if (!force(w, z + d, near) || !force(w, z + 2 * d, far)) return NAN;
    for (size_t k = 0; k < p->nv; k++) {
        if (!isfinite(near[k]) || !isfinite(far[k])) return NAN;
        most = fmax(most, fabs(near[k] - far[k]));
        size = fmax(size, fmax(fabs(near[k]), fabs(far[k])));
    }
    return most > CLEAR * 0x1p-52 * size ? most : NAN;
}

/* Returns the shortest distance from a place that is well above rounding, as a power of 2, in units of the way. */
static int shortest(const pole_way *w, double z)
{
    const problem *p = &w->system->problem;
    double *x = w->room, *v = x + p->nv, rounding = w->h != 0 ? fabs(w->t / w->h) : 0;
    point(w, z, x, v);
    for (size_t k = 0; k < p->nx; k++) {
        const double late = fabs(x[k] / (w->end_x[k] - w->x[k]));
        if (late > rounding && late <= 1 / (FAR * 0x1p-40)) rounding = late;
    }
    return (int)fmax(SHORTEST, fmin(LONGEST, ceil(log2(FAR * 0x1p-52 * rounding))));
}

/* Returns whether the change follows the power between d and 2 d as well. Changes by rounding do not. */
static bool follows(const pole_way *w, double z, double d, double power)
{
    const double at = change(w, z, d);
    for (int i = 1; i < BETWEEN; i++) {
        const double far = 1 + (double)i / BETWEEN;
        if (!(fabs(log(at / change(w, z, far * d)) - power * log(far)) <= ALIKE)) return false;
    }
    return true;
}

/* Returns whether the force grows towards a place from one side as 1/time, or faster, by the power at the shortest
 * distances at which it changes by more than rounding. */
static bool grows(const pole_way *w, double z, double side)
{
    double before = NAN, power = NAN;
    int same = 0;
    const int first = shortest(w, z);
    for (int k = first; k < first + SCALES; k++) {
        const double now = change(w, z, side * ldexp(1, k)), last = power;
        power = log2(before / now);
        before = now;
        same = fabs(power - last) <= ALIKE ? same + 1 : 0;
        if (same >= SAME - 1 && follows(w, z, side * ldexp(1, k - 1), power)) return power >= INVERSE;
    }
    return false;
}

static bool found(search *s, double low, double high, int depth)
{
    if (s->looks-- <= 0 || s->places <= 0 || excluded(s->way, low, high)) return false;
    const double middle = low + (high - low) / 2;
    if (depth == 0) s->places--; /* else a divisor that stays at 0 would make every part of the way a place */
    if (depth == 0) return grows(s->way, middle, 1) || grows(s->way, middle, -1);
    return found(s, low, middle, depth - 1) || found(s, middle, high, depth - 1);
}

bool pole_on(const pole_way *w) { return found(&(search){w, LOOKS, PLACES}, 0, 1, DEPTH); }
