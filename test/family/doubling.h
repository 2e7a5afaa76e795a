/* STEP DOUBLING over the explicit midpoint rule: a step of h beside two of h/2; their distance, over 2² - 1, is the
 * error of the two. A family that test/additions.sh adds, to see that it runs on every machine. Its dense output is its
 * own: a cubic for each half, so that the ends of a step tell nothing of what is between them. What it reads of the
 * step, the state in the middle and the bends, are its "stages". */
static int doubling_midpoint(work *w, coef from, coef to, const real *x, const real *v, real *X, real *V)
{
    real *restrict xs = w->xs, *restrict vs = w->vs, *restrict K = w->ks + 3 * w->stride;
    const clock h = (to - from) * w->h;
    EACH(k) X[k] = x[k];
    EACHV(k) V[k] = v[k];
    int bad = accel(w, time_in(w, from), X, V, K);
    if (bad) return bad;
    EACH(k) xs[k] = FMA(h / 2, v[k], x[k]);
    EACHV(k) vs[k] = FMA(h / 2, K[k], v[k]);
    bad = accel(w, time_in(w, (from + to) / 2), xs, vs, K);
    EACH(k) X[k] = FMA(h, vs[k], x[k]);
    EACHV(k) V[k] = FMA(h, K[k], v[k]);
    return bad;
}

/* The acceleration of a half's cubic at its ends; of a first-order variable the slope of a line. */
static real doubling_bends(const work *w, size_t k, const real *x0, const real *v0, const real *x1, const real *v1,
                           bool at_end)
{
    const clock half = w->h / 2;
    if (k >= FACT(w, nx)) return (v1[k] - v0[k]) / half;
    const real way = 6 * (x1[k] - x0[k]) / half;
    return at_end ? (2 * v0[k] + 4 * v1[k] - way) / half : (way - 4 * v0[k] - 2 * v1[k]) / half;
}

static int doubling_step(work *w)
{
    real *x1 = w->xs + w->stride, *v1 = w->vs + w->stride, *x2 = w->xs + 2 * w->stride, *v2 = w->vs + 2 * w->stride;
    real *half_x = w->ks, *half_v = w->ks + w->stride, *bends = w->ks + 2 * w->stride, most = {0};
    int bad = doubling_midpoint(w, 0, 1, w->x, w->v, x1, v1);
    if (!bad) bad = doubling_midpoint(w, 0, 0.5, w->x, w->v, half_x, half_v);
    if (!bad) bad = doubling_midpoint(w, 0.5, 1, half_x, half_v, x2, v2);
    if (bad) return bad;
    EACHV(k) {
        bends[k] = (real){0};
        for (int end = 0; end < 2; end++) {
            bends[k] = LARGER(ABS(doubling_bends(w, k, w->x, w->v, half_x, half_v, end)), bends[k]);
            bends[k] = LARGER(ABS(doubling_bends(w, k, half_x, half_v, x2, v2, end)), bends[k]);
        }
    }
    if (!ROW(w, adaptive)) {
        EACH(k) w->x[k] = x2[k];
        EACHV(k) w->v[k] = v2[k];
        return STEP_OK;
    }
    EACH(k) most = CHOOSE_WHERE(ABS(x2[k] - x1[k]) <= most, most, ABS(x2[k] - x1[k]));
    EACHV(k) most = CHOOSE_WHERE(ABS(v2[k] - v1[k]) <= most, most, ABS(v2[k] - v1[k]));
    w->error = most / (3 * w->relative);
    return STEP_OK;
}

static void doubling_accept(work *w, clock_mask good)
{
    if (!ROW(w, adaptive)) return;
    EACH(k) w->x[k] = CHOOSE_WHERE(good, w->xs[2 * w->stride + k], w->x[k]);
    EACHV(k) w->v[k] = CHOOSE_WHERE(good, w->vs[2 * w->stride + k], w->v[k]);
}
#define doubling_observe state_is_complete
#define doubling_sync work_sync_main
#define doubling_carry work_carry_main
#define doubling_between dense_without
#define doubling_extend dense_as_it_is
static inline int doubling_dense(work *w, const dense_step *d, clock t, real *x, real *v)
{
    const real *half_x = w->ks, *half_v = w->ks + w->stride;
    const clock half = (d->end[1].t - d->end[0].t) / 2, u = (t - d->end[0].t) / half;
    const clock_mask first = u < 1;
    const clock s = CHOOSE_WHERE(first, u, u - 1);
    for (size_t k = 0; k < w->nv; k++) {
        const real p = CHOOSE_WHERE(first, d->end[0].v[k], half_v[k]),
                   q = CHOOSE_WHERE(first, half_v[k], d->end[1].v[k]);
        v[k] = p + s * (q - p);
        if (k >= w->nx) continue;
        const real from = CHOOSE_WHERE(first, d->end[0].x[k], half_x[k]),
                   way = CHOOSE_WHERE(first, half_x[k], d->end[1].x[k]) - from, c = 3 * way - half * (2 * p + q),
                   e = half * (p + q) - 2 * way;
        x[k] = from + s * (half * p + s * (c + s * e));
        v[k] = p + s * (2 * c + s * 3 * e) / half;
    }
    return STEP_OK;
}
static inline bool doubling_swing(const work *w, real *most)
{
    const real *bends = w->ks + 2 * w->stride;
    EACHV(k) most[k] = LARGER(bends[k], most[k]);
    return true;
}
static inline void doubling_place(work *w, placing *p)
{
    w->xs = work_array(p, 3), w->vs = work_array(p, 3), w->ks = work_array(p, 4);
}

#ifdef ROWS
static void doubling_plan(work *w, const double argument[2], coef *unit, coef *c)
{
    (void)argument, (void)unit;
    w->stages = 3, w->order = 2;
    for (int i = 0; c && i < 3; i++) c[i] = (coef)i / 2;
}
#endif
#ifdef TRACING
static trace_room doubling_room(const work *w) { return (void)w, (trace_room){0}; }
static void doubling_trace(work *w, int i) { (void)w, (void)i; }
#endif
