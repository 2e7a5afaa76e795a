/* Where within a step an argument leaves its side. See locate_parts.h. */
#include "api/motion/locate_parts.h"

#include <math.h>

/* Finds fractions of a step at which a gap may be below 0 although it is not at the ends: where the tangents at both
 * ends meet, if that is near 0 or below (a convex gap lies above its tangents; |r| - d lies near their meeting point),
 * and where the cubic through both ends is least. Returns how many, 0 to 2. */
static int dips(double g0, double s0, double g1, double s1, double at[2])
{
    int count = 0;
    if (!(s0 < 0 && s1 > 0)) return 0;
    const double meet = (g1 - s1 - g0) / (s0 - s1);
    if (!(meet > 0 && meet < 1 && g0 + s0 * meet < 0.25 * fmin(g0, g1))) return 0;
    at[count++] = meet;
    /* g(z) = g0 + s0 z + b z² + c z³ */
    const double c = 2 * (g0 - g1) + s0 + s1, b = 3 * (g1 - g0) - 2 * s0 - s1, z = -s0 / (b + sqrt(b * b - 3 * c * s0));
    if (z > 0 && z < 1) at[count++] = z;
    return count;
}

/* Finds the first part of the step after which an argument has left its side, to which it comes back; `found` is the
 * state there. Writes the fraction of the step; 1: no argument does so. */
motus_status locate_dip(motus_run *r, double h, double *fraction, motus_error *err)
{
    locate *l = r->locate;
    *fraction = 1;
    held_rates(l->held, l->from.t, l->from.x, l->from.v, l->from.a, l->rate[0]);
    held_rates(l->held, l->to.t, l->to.x, l->to.v, l->to.a, l->rate[1]);
    for (size_t k = 0; k < l->count; k++) {
        const operation op = held_operation(l->held, k);
        const double s0 = h * switches_gap_rate(op, l->side[k], l->from.u[k], l->rate[0][k]),
                     s1 = h * switches_gap_rate(op, l->side[k], l->to.u[k], l->rate[1][k]);
        double z[2];
        for (int i = dips(locate_gap(l, k, &l->from), s0, locate_gap(l, k, &l->to), s1, z); i-- > 0;) {
            if (!(z[i] < *fraction) || l->from.t + z[i] * h == l->from.t) continue;
            motus_status status = locate_try(r, &l->from, z[i] * h, &l->beyond, err);
            if (status == MOTUS_MEMORY) return status;
            if (status != MOTUS_OK || !(locate_gap(l, k, &l->beyond) < 0)) continue;
            *fraction = z[i];
            locate_swap(&l->beyond, &l->found);
        }
    }
    return MOTUS_OK;
}

/* Shortens the step of size *h from `from` until it ends just beyond the first root, at `to`. failed: the whole step
 * failed, and `to` is not known. Uses Illinois' method on the least gap, with bisections now and then. *failed
 * afterwards: steps beyond the root fail; `to` is then the last state before it. */
motus_status locate_root(motus_run *r, double *h, bool *failed, motus_error *err)
{
    locate *l = r->locate;
    const place *from = &l->from;
    const double whole = *h;
    for (size_t k = 0; k < l->count; k++) {
        l->size[k] = fmax(fabs(locate_gap(l, k, from)), *failed ? 0 : fabs(locate_gap(l, k, &l->to)));
        if (!(l->size[k] > 0)) l->size[k] = 1;
    }
    double low = 0, high = 1, at_low = fmax(locate_least_gap(l, from, l->size), 0);
    double at_high = *failed ? NAN : locate_least_gap(l, &l->to, l->size);
    int moved = 0; /* which end moved last: an end that stays twice has its value halved */
    for (int turn = 0; turn < LOCATE_HALVINGS_MAX && high - low > 0x1p-51 * high && high > 0x1p-50; turn++) {
        if (fabs((high - low) * whole) <= 0x1p-54 * fabs(from->t)) break;
        double z = high - at_high * (high - low) / (at_high - at_low);
        if (*failed || turn % 4 == 3 || !(z > low && z < high)) z = 0.5 * (low + high);
        if (from->t + z * whole == from->t) {
            low = z;
            continue;
        }
        const motus_status status = locate_try(r, from, z * whole, &l->beyond, err);
        if (status == MOTUS_MEMORY) return status;
        const double g = status == MOTUS_OK ? locate_least_gap(l, &l->beyond, l->size) : NAN;
        if (g >= 0) {
            low = z;
            at_low = g;
            if (moved < 0) at_high /= 2;
            moved = -1;
            continue;
        }
        high = z;
        *failed = status != MOTUS_OK;
        at_high = g;
        if (moved > 0) at_low /= 2;
        moved = 1;
        if (!*failed) locate_swap(&l->to, &l->beyond);
    }
    *h = (*failed ? low : high) * whole;
    if (!*failed) return MOTUS_OK;
    if (from->t + *h != from->t) return locate_try(r, from, *h, &l->to, err);
    locate_copy(&l->to, from, &l->problem, l->count);
    return MOTUS_OK;
}
