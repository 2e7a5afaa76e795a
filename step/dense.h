/* DENSE OUTPUT: the state at a time within the last step. Every family names its interpolant; those that have none of
 * their own take the one of lift.h. Here are the polynomials that several share.
 *
 * Hermite's polynomial through position, velocity and acceleration at both ends of the step, of degree 5, with its
 * derivative as the velocity; for a first-order variable, of which value and rate are known, of degree 3. Where the
 * ends are exact its errors are h⁶, h⁵ and h⁴ [HNW93, II.6].
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

/* A polynomial of the acceleration, integrated once for v and twice for x: Σ P[k] Σ series[k][j] K[j], where P[k] are
 * Legendre's polynomials on the step, whose integrals are differences of their neighbours: collocation.h. */
enum { DENSE_TERMS_MAX = 10, DENSE_COLUMNS_MAX = 32 };
typedef struct dense_series {
    int terms, columns;
    const coef *series;                    /* row by row, `columns` numbers each */
    const real *column[DENSE_COLUMNS_MAX]; /* the K[j] */
    const real *sums; /* Σ series[k][j] K[j] of every k, an array each, where they have been computed; else NULL */
    clock h;
} dense_series;

/* Sum k of number i. */
static inline real dense_sum(const dense_series *of, int k, size_t i)
{
    const coef *series = of->series + (size_t)k * (size_t)of->columns;
    real sum = {0};
    for (int j = 0; j < of->columns; j++)
        if (series[j] != 0) sum = FMA(series[j], of->column[j][i], sum);
    return sum;
}

static void dense_integrate(const work *w, const dense_series *of, const dense_end *end, clock t, real *x, real *v)
{
    const int s = of->terms;
    const clock h = of->h, y = 2 * ((t - end[0].t) / (end[1].t - end[0].t)) - 1;
    clock p[DENSE_TERMS_MAX + 2] = {1, y}, once[DENSE_TERMS_MAX + 1] = {(1 + y) / 2}, twice[DENSE_TERMS_MAX] = {0};
    for (int k = 1; k <= s; k++) p[k + 1] = ((2 * k + 1) * y * p[k] - k * p[k - 1]) / (k + 1);
    for (int k = 1; k <= s; k++) once[k] = (p[k + 1] - p[k - 1]) / (4 * k + 2);
    twice[0] = (once[1] + once[0]) / 2;
    for (int k = 1; k < s; k++) twice[k] = (once[k + 1] - once[k - 1]) / (4 * k + 2);
    for (size_t i = 0; i < w->nv; i++) {
        real speed = {0}, place = {0};
        for (int k = 0; k < s; k++) {
            const real sum = of->sums ? of->sums[(size_t)k * w->stride + i] : dense_sum(of, k, i);
            speed = FMA(once[k], sum, speed);
            place = FMA(twice[k], sum, place);
        }
        v[i] = FMA(h, speed, end[0].v[i]);
        if (i < w->nx) x[i] = FMA(h, FMA(h, place, once[0] * end[0].v[i]), end[0].x[i]);
    }
}

/* Collocation has its own polynomial, through the accelerations of its s stages, with errors h^(s+2) in x and h^(s+1)
 * in v. */
static void dense_collocation(const work *w, const dense_step *d, clock t, real *x, real *v)
{
    dense_series of = {.terms = w->stages, .columns = w->stages, .series = w->unit + tableau_series(w, 0)};
    for (int j = 0; j < w->stages; j++) of.column[j] = w->ks + (size_t)j * w->stride;
    of.h = d->end[1].t - d->end[0].t;
    dense_integrate(w, &of, d->end, t, x, v);
}
