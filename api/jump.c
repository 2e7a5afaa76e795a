/* See jump.h.
 *
 * The difference of order 7 of the force, over eight points on both sides, takes away what is smooth, up to the 7th
 * power of their distance; what remains of |way|^p goes with the power p. Invariant: the power is read off the shortest
 * distances at which the difference is no rounding, and only where it is the same at three of them.
 */
#include "api/jump.h"

#include <math.h>

enum {
    SHORTEST = -24,
    AT_LEAST = -3,
    LONGEST = 5,
    POINTS = 8,
    BETWEEN = 5
};                    /* of distances, in powers of 2 of a step */
#define WEIGHTS 128.0 /* their sum */
#define CLEAR 1e3     /* times the rounding of a force, or OFF times that of a time, are no rounding */
#define OFF 4.0
#define MIDDLE 3.3 /* not 3.5: the difference of what is even, as |way|, would vanish */
#define APART 16.0 /* times that, distances are at least */
#define MOST 6.4   /* a power above this is that of what is smooth */
#define ALIKE 0.02 /* powers this near to one another are the same */
#define WHOLE 0.02

/* NaN: the force cannot be evaluated. Below 0: no more than rounding, of the force or of the time. */
static double difference(jump_force *force, void *ctx, size_t n, double w, double rounding, double *room)
{
    static const double weight[POINTS] = {1, -7, 21, -35, 35, -21, 7, -1};
    double *sum = room, *a = sum + n, *last = a + n, size = 0, rise = 0, most = 0;
    for (size_t k = 0; k < n; k++) sum[k] = 0;
    for (int i = 0; i < POINTS; i++) {
        if (!force(ctx, (i - MIDDLE) * w, a)) return NAN;
        for (size_t k = 0; k < n; k++) {
            if (!isfinite(a[k])) return NAN;
            sum[k] += weight[i] * a[k];
            size = fmax(size, fabs(a[k]));
            if (i > 0) rise = fmax(rise, fabs(a[k] - last[k]));
            last[k] = a[k];
        }
    }
    for (size_t k = 0; k < n; k++) most = fmax(most, fabs(sum[k]));
    return most > WEIGHTS * (CLEAR * 0x1p-52 * size + OFF * rounding / w * rise) ? most : -1;
}

/* The power between distances w and far w; NaN where a difference is none. */
static double power_of(double at, double further, double far)
{
    return at > 0 && further > 0 ? log(further / at) / log(far) : NAN;
}

/* Whether the difference follows the power between w and 2 w, too. */
static bool follows(jump_force *force, void *ctx, size_t n, double w, double rounding, double *room, double power)
{
    const double at = difference(force, ctx, n, w, rounding, room);
    for (int i = 1; i < BETWEEN; i++) {
        const double far = 1 + (double)i / BETWEEN, is = difference(force, ctx, n, far * w, rounding, room);
        if (!(fabs(power_of(at, is, far) - power) <= ALIKE / log(far))) return false;
    }
    return true;
}

double jump_power(jump_force *force, void *ctx, size_t n, double h, double rounding, double *room)
{
    double before = -1, power = NAN;
    for (int k = SHORTEST; k <= LONGEST; k++) {
        const double w = ldexp(fabs(h), k);
        if (k < AT_LEAST && w < WEIGHTS * OFF * APART * rounding) continue;
        const double now = difference(force, ctx, n, w, rounding, room), last = power;
        if (isnan(now)) return NAN;
        power = power_of(before, now, 2);
        before = now;
        if (!(fabs(power - last) <= ALIKE) || !follows(force, ctx, n, w / 2, rounding, room, power)) continue;
        if (power > MOST) return NAN;
        return fabs(power - round(power)) < WHOLE ? round(power) + 0.0 : power;
    }
    return NAN;
}
