/* EXTRAPOLATED STÖRMER RULE, for forces that are free of v [HNW93, II.14]. In parts of length l the sums
 *
 *     e += a,   u += e;   X = x + m l v + l² u,   from e = u = a₀/2,
 *
 * lead from part to part; the velocity at the end takes half of the last acceleration. It is the leapfrog's map, as
 * velocity Verlet writes it, with what the linear motion adds kept apart, so that sums are of small numbers.
 */
static const extrapolation_rule stormer_rule = {.each = 1, .spared = 0};

static inline int stormer_parts(work *w, int n)
{
    real *restrict K = w->ks, *restrict e = w->ks + EXTRAPOLATION_V * w->stride,
                   *restrict u = w->ks + EXTRAPOLATION_X * w->stride;
    const clock l = w->h / n, square = l * l;
    EACHV(k) e[k] = 0.5 * w->a[k];
    EACH(k) u[k] = e[k];
    for (int m = 1; m <= n; m++) {
        const coef c = (coef)m / n;
        const clock way = c * w->h;
        EACH(k) w->xs[k] = w->x[k] + FMA(way, w->v[k], square * u[k]);
        const int bad = accel(w, time_in(w, c), w->xs, w->vs, K);
        if (bad) return bad;
        const coef part = m < n ? 1 : 0.5;
        EACHV(k) e[k] = FMA(part, K[k], e[k]);
        EACH(k) u[k] = m < n ? u[k] + e[k] : u[k];
    }
    return STEP_OK;
}

static int stormer_step(work *w)
{
    extrapolation e;
    int bad = extrapolation_begin(w, &e);
    for (int j = 1; !bad && SOME(e.open); j++) {
        bad = stormer_parts(w, stormer_rule.each * j);
        if (!bad) extrapolation_judge(w, &e, &stormer_rule, j);
    }
    return bad;
}
#define stormer_accept extrapolation_accept
#define stormer_observe state_is_complete
#define stormer_sync work_sync_main
#define stormer_carry work_carry_main
#define stormer_between lift_between
#define stormer_extend lift_extend_kept
#define stormer_swing swing_unknown
#define stormer_dense lift_dense
static inline void stormer_place(work *w, placing *p) { extrapolation_place(w, p, 2); }

#ifdef ROWS
#define stormer_plan extrapolation_plan
#endif

#ifdef TRACING
static trace_room stormer_room(const work *w) { return (void)w, (trace_room){0}; }
static void stormer_trace(work *w, int i) { (void)w, (void)i; }
#endif
