/* DENSE OUTPUT OF RUNGE-KUTTA ROWS by weights of the stages that are polynomials: v(θ) = v + h Σ b[j](θ) K[j], with
 * b(0) = 0 and b(1) = b, where further stages may stand after those of the step [HNW93, II.6].
 *
 * The row gives b' by its coefficients in Legendre's polynomials, whose sizes are those of b' itself; the first are b.
 * Positions take the integrals of b(θ) besides, B(θ), which keeps x' = v and gains an order, and what these miss of the
 * step's own bb in a cubic that does not change the slopes at the ends: B[j](θ) + (3 θ² - 2 θ³) (bb - B(1))[j].
 *
 * Columns: the stages, the acceleration at the end of the step (where it is not the last stage), the further stages.
 */
static inline int continuous_first(const work *w) { return w->stages + !w->closing; }
static inline int continuous_columns(const work *w) { return continuous_first(w) + w->row->tableau.dense.more; }
/* The row's coefficients of further stage i. */
static inline const coef *continuous_row(const work *w, int i)
{
    return w->row->tableau.dense.a + i * continuous_first(w) + i * (i - 1) / 2;
}

/* Constants: the series; what positions miss; for the positions of the further stages, a A. */
static inline int continuous_missing(const work *w) { return w->row->tableau.dense.terms * continuous_columns(w); }
static inline int continuous_aa(const work *w, int i)
{
    return continuous_missing(w) + (1 + i) * continuous_columns(w);
}

/* Entry j of row i of all stages, the end of the step being row w->stages. */
static coef continuous_entry(const work *w, int i, int j)
{
    const int s = w->stages, first = continuous_first(w);
    if (i < s) return j < s ? w->unit[tableau_a(w, i) + j] : 0;
    if (i < first) return j < s ? w->unit[tableau_b(w) + j] : 0;
    return j < i ? continuous_row(w, i - first)[j] : 0;
}

/* The arrays: positions and velocities of a further stage, the further stages, then the sums of the series, which every
 * time within a step needs, and that of what positions miss. */
static inline int continuous_sums(const work *w)
{
    const int more = w->row->tableau.dense.more;
    return more ? more + 2 : 0;
}

static dense_room continuous_between(const work *w, coef *unit)
{
    const int more = w->row->tableau.dense.more, n = continuous_columns(w), first = continuous_first(w),
              terms = w->row->tableau.dense.terms, b = tableau_b(w), bb = tableau_bb(w);
    const dense_room room = {.arrays = continuous_sums(w) + terms + 1, .constants = (size_t)continuous_aa(w, more)};
    for (int j = 0; j < n && unit; j++) {
        coef *series = unit + j;
        series[0] = j < w->stages ? w->unit[b + j] : 0;
        for (int k = 1; k < terms; k++) series[k * n] = w->row->tableau.dense.series[(k - 1) * n + j];
        /* ∫ (1 - θ) P[k](θ) is 1/2 and -1/6 for k = 0 and 1, and 0 beyond */
        unit[continuous_missing(w) + j] = (j < w->stages ? w->unit[bb + j] : 0) - series[0] / 2 + series[n] / 6;
        for (int i = 0; i < more; i++) {
            pair sum = pair_of(0);
            for (int l = 0; l < first + i; l++)
                sum = pair_sum(sum, pair_exact_product(continuous_row(w, i)[l], continuous_entry(w, l, j)));
            unit[continuous_aa(w, i) + j] = sum.high;
        }
    }
    return room;
}

/* The first stage may have become that of the next step: it is the acceleration at the start of this one. */
static const real *continuous_column(const work *w, const dense_step *d, int j)
{
    if (j == 0) return d->end[0].a;
    if (j < w->stages) return w->ks + (size_t)j * w->stride;
    return j < continuous_first(w) ? d->end[1].a : d->more + (size_t)(2 + j - continuous_first(w)) * w->stride;
}

/* Σ c[j] K[j] of entry k. */
static real continuous_sum(const work *w, const dense_step *d, const coef *c, int count, size_t k)
{
    real sum = {0};
    for (int j = 0; j < count; j++)
        if (c[j] != 0) sum = FMA(c[j], continuous_column(w, d, j)[k], sum);
    return sum;
}

static dense_series continuous_series(const work *w, const dense_step *d)
{
    dense_series of = {
        .terms = w->row->tableau.dense.terms, .columns = continuous_columns(w), .series = d->unit, .h = w->h};
    for (int j = 0; j < of.columns; j++) of.column[j] = continuous_column(w, d, j);
    return of;
}

/* The sums that every time within the step needs. */
static void continuous_add(const work *w, const dense_step *d)
{
    const dense_series of = continuous_series(w, d);
    real *sums = d->more + (size_t)continuous_sums(w) * w->stride, *missing = sums + (size_t)of.terms * w->stride;
    for (int k = 0; k < of.terms; k++)
        for (size_t i = 0; i < w->nv; i++) sums[(size_t)k * w->stride + i] = dense_sum(&of, k, i);
    for (size_t i = 0; i < w->nx; i++)
        missing[i] = continuous_sum(w, d, d->unit + continuous_missing(w), of.columns, i);
}

static int continuous_extend(work *w, const dense_step *d)
{
    const int more = w->row->tableau.dense.more, first = continuous_first(w);
    const clock h = w->h, hh = h * h;
    const dense_end *at = &d->end[0];
    const whole evaluations = w->evaluations;
    real *X = d->more, *V = d->more + w->stride;
    int bad = STEP_OK;
    for (int i = 0; i < more && !bad; i++) {
        const clock ch = w->row->tableau.dense.c[i] * h;
        const coef *a = continuous_row(w, i), *aa = d->unit + continuous_aa(w, i);
        for (size_t k = 0; k < w->nx; k++)
            X[k] = FMA(hh, continuous_sum(w, d, aa, first + i, k), FMA(ch, at->v[k], at->x[k]));
        for (size_t k = 0; k < w->nv; k++) V[k] = FMA(h, continuous_sum(w, d, a, first + i, k), at->v[k]);
        bad = accel(w, at->t + ch, X, V, d->more + (size_t)(2 + i) * w->stride);
    }
    w->evaluations = evaluations;
    if (!bad) continuous_add(w, d);
    return bad;
}

static void continuous_state(const work *w, const dense_step *d, clock t, real *x, real *v)
{
    const clock u = (t - d->end[0].t) / (d->end[1].t - d->end[0].t), cubic = (3 - 2 * u) * u * u * w->h * w->h;
    dense_series of = {.terms = w->row->tableau.dense.terms, .h = w->h};
    of.sums = d->more + (size_t)continuous_sums(w) * w->stride;
    const real *missing = of.sums + (size_t)of.terms * w->stride;
    dense_integrate(w, &of, d->end, t, x, v);
    for (size_t k = 0; k < w->nx; k++) x[k] = FMA(cubic, missing[k], x[k]);
}

/* How far the ends are apart, by the stages: the ends are rounded, and a velocity would take their rounding over h. */
static void continuous_apart(const work *w, const dense_step *d)
{
    real *dx = lift_array(w, d, LIFT_APART), *dv = lift_array(w, d, LIFT_APART + 1);
    const int s = w->stages;
    for (size_t k = 0; k < w->nx; k++) dx[k] = w->h * w->h * continuous_sum(w, d, w->unit + tableau_bb(w), s, k);
    for (size_t k = 0; k < w->nv; k++) dv[k] = w->h * continuous_sum(w, d, w->unit + tableau_b(w), s, k);
}

/* Rows without such weights have their polynomial lifted. */
static inline bool continuous_has(const work *w) { return w->row->tableau.dense.terms > 0; }
static dense_room runge_kutta_between(const work *w, coef *unit)
{
    return continuous_has(w) ? continuous_between(w, unit) : lift_between(w, unit);
}
static int runge_kutta_extend(work *w, const dense_step *d)
{
    if (continuous_has(w)) return continuous_extend(w, d);
    if (!ROW(w, adaptive)) return lift_extend(w, d);
    continuous_apart(w, d);
    return lift_rise(w, d);
}
static int runge_kutta_dense(work *w, const dense_step *d, clock t, real *x, real *v)
{
    if (!continuous_has(w)) return lift_dense(w, d, t, x, v);
    continuous_state(w, d, t, x, v);
    return STEP_OK;
}
