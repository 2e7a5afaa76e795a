/* STEP DOUBLING over the explicit midpoint rule: a step of h beside two of h/2; their distance, over 2² - 1, is the
 * error of the two. A family that test/family.sh adds, to see that it runs on every machine. */
static int doubling_midpoint(work *w, coef from, coef to, const real *x, const real *v, real *X, real *V)
{
    real *restrict xs = w->xs, *restrict vs = w->vs, *restrict K = w->ks;
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

static int doubling_step(work *w)
{
    real *x1 = w->xs + w->stride, *v1 = w->vs + w->stride, *x2 = w->xs + 2 * w->stride, *v2 = w->vs + 2 * w->stride;
    real *half_x = w->xs + 3 * w->stride, *half_v = w->vs + 3 * w->stride, most = {0};
    int bad = doubling_midpoint(w, 0, 1, w->x, w->v, x1, v1);
    if (!bad) bad = doubling_midpoint(w, 0, 0.5, w->x, w->v, half_x, half_v);
    if (!bad) bad = doubling_midpoint(w, 0.5, 1, half_x, half_v, x2, v2);
    if (bad) return bad;
    EACH(k) most = CHOOSE_WHERE(ABS(x2[k] - x1[k]) <= most, most, ABS(x2[k] - x1[k]));
    EACHV(k) most = CHOOSE_WHERE(ABS(v2[k] - v1[k]) <= most, most, ABS(v2[k] - v1[k]));
    w->error = most / (3 * w->relative);
    return STEP_OK;
}

static void doubling_accept(work *w, clock_mask good)
{
    EACH(k) w->x[k] = CHOOSE_WHERE(good, w->xs[2 * w->stride + k], w->x[k]);
    EACHV(k) w->v[k] = CHOOSE_WHERE(good, w->vs[2 * w->stride + k], w->v[k]);
}
#define doubling_observe state_is_complete
#define doubling_sync work_sync_main
#define doubling_carry work_carry_main
#define doubling_between lift_between
#define doubling_extend lift_extend
#define doubling_dense lift_dense
#define doubling_swing swing_unknown
static inline void doubling_place(work *w, placing *p)
{
    w->xs = work_array(p, 4), w->vs = work_array(p, 4), w->ks = work_array(p, 1);
}

#ifdef ROWS
static void doubling_plan(work *w, const double argument[2], coef *unit, coef *c)
{
    (void)argument, (void)unit;
    w->stages = 1, w->order = 2;
    if (c) c[0] = 0;
}
#endif
#ifdef TRACING
static trace_room doubling_room(const work *w) { return (void)w, (trace_room){0}; }
static void doubling_trace(work *w, int i) { (void)w, (void)i; }
#endif
