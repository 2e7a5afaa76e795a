/* DENSE OUTPUT: the state at a time within the last step. Every family names its interpolant; this one serves any of
 * them.
 *
 * Hermite's polynomial through position, velocity and acceleration at both ends of the step, of degree 5, with its
 * derivative as the velocity; for a first-order variable, of which value and rate are known, of degree 3. Local
 * errors h⁶, h⁵ and h⁴ [HNW93, II.6].
 *
 * Collocation has its own: the polynomial through the accelerations of the s stages, integrated once and twice, with
 * local errors h^(s+2) in x and h^(s+1) in v; where that is less than Hermite's, Hermite's serves.
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

/* The polynomial is a sum of Legendre's P[k], whose integrals, once and twice, are differences of their neighbours:
 * collocation.h. */
static void dense_collocation(const work *w, const dense_end end[2], clock t, real *x, real *v)
{
    const int s = w->stages;
    const clock h = end[1].t - end[0].t, y = 2 * ((t - end[0].t) / h) - 1;
    clock p[TABLEAU_COUPLED_MAX + 2] = {1, y}, once[TABLEAU_COUPLED_MAX + 1] = {(1 + y) / 2},
                                  twice[TABLEAU_COUPLED_MAX] = {0};
    for (int k = 1; k <= s; k++) p[k + 1] = ((2 * k + 1) * y * p[k] - k * p[k - 1]) / (k + 1);
    for (int k = 1; k <= s; k++) once[k] = (p[k + 1] - p[k - 1]) / (4 * k + 2);
    twice[0] = (once[1] + once[0]) / 2;
    for (int k = 1; k < s; k++) twice[k] = (once[k + 1] - once[k - 1]) / (4 * k + 2);
    for (size_t i = 0; i < w->nv; i++) {
        real speed = {0}, place = {0};
        for (int k = 0; k < s; k++) {
            const coef *series = w->unit + tableau_series(w, k);
            real sum = {0};
            for (int j = 0; j < s; j++) sum = FMA(series[j], w->ks[(size_t)j * w->stride + i], sum);
            speed = FMA(once[k], sum, speed);
            place = FMA(twice[k], sum, place);
        }
        v[i] = FMA(h, speed, end[0].v[i]);
        if (i < w->nx) x[i] = FMA(h, FMA(h, place, once[0] * end[0].v[i]), end[0].x[i]);
    }
}

static void dense_stages(const work *w, const dense_end end[2], clock t, real *x, real *v)
{
    if (w->kept > 4)
        dense_collocation(w, end, t, x, v);
    else
        dense_hermite(w, end, t, x, v);
}
