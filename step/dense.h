/* DENSE OUTPUT: the state at a time within the last step. Every family names its interpolant; this one serves any of
 * them.
 *
 * Hermite's polynomial through position, velocity and acceleration at both ends of the step, of degree 5, with its
 * derivative as the velocity; for a first-order variable, of which value and rate are known, of degree 3. Local
 * errors h⁶, h⁵ and h⁴ [HNW93, II.6].
 */
/* k: the length of the step; u: the part of it that has passed. */
static void dense_hermite(const work *w, const dense_end end[2], clock t, real *x, real *v)
{
    const clock k = end[1].t - end[0].t, u = (t - end[0].t) / k;
    for (size_t i = 0; i < w->nx; i++) {
        const real d = end[1].x[i] - end[0].x[i], p = k * end[0].v[i], q = k * end[1].v[i], a = k * k * end[0].a[i],
                   b = k * k * end[1].a[i];
        const real c2 = a / 2, r0 = d - p - c2, r1 = q - p - a, r2 = b - a;
        const real c3 = 10 * r0 - 4 * r1 + r2 / 2, c4 = -15 * r0 + 7 * r1 - r2, c5 = 6 * r0 - 3 * r1 + r2 / 2;
        x[i] = end[0].x[i] + u * (p + u * (c2 + u * (c3 + u * (c4 + u * c5))));
        v[i] = (p + u * (2 * c2 + u * (3 * c3 + u * (4 * c4 + u * 5 * c5)))) / k;
    }
    for (size_t i = w->nx; i < w->nv; i++) {
        const real d = end[1].v[i] - end[0].v[i], p = k * end[0].a[i], q = k * end[1].a[i];
        v[i] = end[0].v[i] + u * (p + u * (3 * d - 2 * p - q + u * (p + q - 2 * d)));
    }
}
