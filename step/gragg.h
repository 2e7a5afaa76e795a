/* EXTRAPOLATED MIDPOINT RULE, for any force [HNW93, II.9]: over an even number of parts of length l, after one step of
 * Euler's method,
 *
 *     X[m+1] = X[m-1] + 2 l V[m],   V[m+1] = V[m-1] + 2 l a(X[m], V[m]).
 *
 * The sums s and u are those of accelerations in it: V[m] = v + l s[m], X[m] = x + m l v + l² u[m].
 */
static const extrapolation_rule gragg_rule = {.each = 2, .spared = 1};

static inline int gragg_parts(work *w, int n)
{
    real *restrict K = w->ks, *s[2], *u[2];
    const clock l = w->h / n, square = l * l;
    for (int side = 0; side < 2; side++) { /* of m even, and odd; the last is even */
        s[side] = w->ks + (size_t)(EXTRAPOLATION_V + 2 * side) * w->stride;
        u[side] = w->ks + (size_t)(EXTRAPOLATION_X + 2 * side) * w->stride;
    }
    EACHV(k) s[0][k] = (real){0}, s[1][k] = w->a[k];
    EACH(k) u[0][k] = u[1][k] = (real){0};
    for (int m = 1; m < n; m++) {
        const coef c = (coef)m / n;
        const clock way = c * w->h;
        real *restrict here = s[m % 2], *restrict next = s[(m + 1) % 2], *restrict from = u[m % 2],
                       *restrict to = u[(m + 1) % 2];
        EACH(k) w->xs[k] = w->x[k] + FMA(way, w->v[k], square * from[k]);
        if (FACT(w, velocity))
            EACHV(k) w->vs[k] = FMA(l, here[k], w->v[k]);
        const int bad = accel(w, time_in(w, c), w->xs, w->vs, K);
        if (bad) return bad;
        EACH(k) to[k] = FMA(2.0, here[k], to[k]);
        EACHV(k) next[k] = FMA(2.0, K[k], next[k]);
    }
    return STEP_OK;
}

static int gragg_step(work *w)
{
    extrapolation e;
    int bad = extrapolation_begin(w, &e);
    for (int j = 1; !bad && SOME(e.open); j++) {
        bad = gragg_parts(w, gragg_rule.each * j);
        if (!bad) extrapolation_judge(w, &e, &gragg_rule, j);
    }
    return bad;
}
#define gragg_accept extrapolation_accept
#define gragg_observe state_is_complete
#define gragg_sync work_sync_main
#define gragg_carry work_carry_main
#define gragg_between lift_between
#define gragg_extend lift_extend_kept
#define gragg_swing swing_unknown
#define gragg_dense lift_dense
static inline void gragg_place(work *w, placing *p) { extrapolation_place(w, p, 4); }

#ifdef ROWS
#define gragg_plan extrapolation_plan
#endif

#ifdef TRACING
static trace_room gragg_room(const work *w) { return (void)w, (trace_room){0}; }
static void gragg_trace(work *w, int i) { (void)w, (void)i; }
#endif
