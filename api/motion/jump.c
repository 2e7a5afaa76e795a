/* See jump.h.
 *
 * The difference of order 7 of the force, over eight points on both sides, takes away what is smooth, up to the 7th
 * power of their distance; what remains of |way|^p goes with the power p. Near 7 the difference of order 9 tells the
 * two apart. Invariant: the power is read off the shortest distances at which the difference is no rounding, and only
 * where it is the same at three of them.
 */
#include "api/motion/jump.h"

#include <math.h>

enum { SHORTEST = -24, AT_LEAST = -3, LONGEST = 5, BETWEEN = 5 }; /* of distances, in powers of 2 of a step */
#define CLEAR 1e2 /* times the rounding of a force, or OFF times that of a time, are no rounding */
#define OFF 4.0
#define BESIDE 0.2 /* of the middle: the difference of what is even, as |way|, would vanish there */
#define APART 16.0 /* times that, distances are at least */
#define LOW 6.4    /* a power above this may be that of what is smooth, */
#define MOST 6.95  /* above this it is, */
#define STEEP 7.2  /* and above this already at two distances */
#define ALIKE 0.02 /* powers this near to one another are the same */
#define CLOSE 0.1  /* as the powers by both differences are of what is not smooth */
#define WHOLE 0.02

typedef struct weights {
    int points;
    double sum; /* of the sizes in `of` */
    double of[10];
} weights;

static const weights order_7 = {8, 128, {1, -7, 21, -35, 35, -21, 7, -1}};
static const weights order_9 = {10, 512, {1, -9, 36, -84, 126, -126, 84, -36, 9, -1}};

typedef struct place {
    jump_force *force;
    void *ctx;
    size_t n;
    double rounding, *room;
} place;

/* Returns the difference of the force. NaN: it cannot be evaluated. Below 0: only rounding, of force or time. */
static double difference(const place *p, const weights *by, double w)
{
    double *sum = p->room, *a = sum + p->n, *last = a + p->n, size = 0, rise = 0, most = 0;
    for (size_t k = 0; k < p->n; k++) sum[k] = 0;
    for (int i = 0; i < by->points; i++) {
        if (!p->force(p->ctx, (i - (by->points - 1) / 2.0 + BESIDE) * w, a)) return NAN;
        for (size_t k = 0; k < p->n; k++) {
            if (!isfinite(a[k])) return NAN;
            sum[k] += by->of[i] * a[k];
            size = fmax(size, fabs(a[k]));
            if (i > 0) rise = fmax(rise, fabs(a[k] - last[k]));
            last[k] = a[k];
        }
    }
    for (size_t k = 0; k < p->n; k++) most = fmax(most, fabs(sum[k]));
    return most > by->sum * (CLEAR * 0x1p-52 * size + OFF * p->rounding / w * rise) ? most : -1;
}

/* Returns the power between distances w and far w. NaN: a difference is only rounding. */
static double power_of(double at, double further, double far)
{
    return at > 0 && further > 0 ? log(further / at) / log(far) : NAN;
}

/* Returns whether the difference follows the power between w and 2 w, too. */
static bool follows(const place *p, const weights *by, double w, double power)
{
    const double at = difference(p, by, w);
    for (int i = 1; i < BETWEEN; i++) {
        const double far = 1 + (double)i / BETWEEN, is = difference(p, by, far * w);
        if (!(fabs(power_of(at, is, far) - power) <= ALIKE / log(far))) return false;
    }
    return true;
}

/* Returns the power of a difference. NaN: there is none, or the force is smooth. */
static double read_power(const place *p, const weights *by, double h)
{
    double before = -1, power = NAN;
    for (int k = SHORTEST; k <= LONGEST; k++) {
        const double w = ldexp(fabs(h), k);
        if (k < AT_LEAST && w < by->sum * OFF * APART * p->rounding) continue;
        const double now = difference(p, by, w), last = power;
        if (isnan(now)) return NAN;
        power = power_of(before, now, 2);
        before = now;
        if (power > STEEP) return NAN;
        if (fabs(power - last) <= ALIKE && follows(p, by, w / 2, power)) return power;
    }
    return NAN;
}

double jump_power(jump_force *force, void *ctx, size_t n, double h, double rounding, double *room)
{
    const place p = {force, ctx, n, rounding, room};
    const double power = read_power(&p, &order_7, h);
    if (!(power <= MOST) || (power > LOW && !(fabs(read_power(&p, &order_9, h) - power) < CLOSE))) return NAN;
    return fabs(power - round(power)) < WHOLE ? round(power) + 0.0 : power;
}
