/* VERLET, LITERALLY: x[n+1] = 2 x[n] - x[n-1] + h² a with plain products and sums; and where a = g + j v its quotient
 * form x[n+1] = (2 x[n] - (1 + h j/2) x[n-1] + h² g)/(1 - h j/2) [Verlet67].
 *
 * Invariant: as in verlet.h, v[n] = (x[n+1] - x[n-1])/2h. First-order variables are carried as integrals that start
 * at 0.
 */
static int literal_observe(work *w)
{
    real *restrict next = w->next_x;
    const real *x = w->x, *old = w->old;
    const clock t = time_now(w), h = w->h, hh = w->hh, none = {0}, slope = h / 2;
    mask all = ALWAYS;
    int bad = STEP_OK;
    if (FIRST(w)) {
        bad = accel_now(w, w->x, w->v, w->a);
        if (!bad)
            EACHV(k) next[k] = x[k] + h * w->v[k] + w->half_hh * w->a[k];
    } else if (!FACT(w, velocity)) {
        bad = accel_now(w, w->x, w->vs, w->a);
        if (!bad)
            EACHV(k) next[k] = 2 * x[k] - old[k] + hh * w->a[k];
    } else if (FACT(w, linear)) {
        EACHV(k) w->vs[k] = (real){0};
        bad = accel_now(w, w->x, w->vs, w->a);
        if (!bad) bad = solve_factor(w, &all, 1, &none, &slope, t, w->x, w->vs);
        if (bad) return bad;
        solve_apply(w, slope, old, w->r);
        EACHV(k) next[k] = 2 * x[k] - w->r[k] + hh * w->a[k];
        solve_back(w, next);
    } else {
        EACHV(k) next[k] = x[k] - old[k];
        bad = newton_increment(w, hh, w->per_h, w->x, next, NEWTON_NOW);
        if (!bad)
            EACHV(k) next[k] = 2 * x[k] - old[k] + w->delta[k];
    }
    return bad;
}

static int literal_step(work *w)
{
    int bad = work_reuse(w) ? STEP_OK : literal_observe(w);
    if (bad) return bad;
    if (SMALL) {
        EACHV(k) w->old[k] = w->x[k];
        EACHV(k) w->x[k] = w->next_x[k];
    } else {
        real *gone = w->old;
        w->old = w->x;
        w->x = w->next_x;
        w->next_x = gone;
    }
    TRACE(w, 0);
    return STEP_OK;
}
#define literal_accept step_is_final

static int literal_sync(work *w, real *x, real *v)
{
    EACH(k) x[k] = w->x[k];
    if (FIRST(w))
        EACHV(k) v[k] = w->v[k];
    else
        EACHV(k) v[k] = (w->next_x[k] - w->old[k]) / (2 * w->h);
    return STEP_OK;
}

static int literal_carry(const work *w, real *list[CARRY_MAX])
{
    const int count = work_carry_main(w, list);
    if (!FIRST(w)) list[1] = w->old;
    return count;
}
#define literal_between lift_between
#define literal_extend lift_extend
#define literal_swing swing_unknown
#define literal_dense lift_dense

static inline void literal_place(work *w, placing *p)
{
    w->old = work_array(p, 1);
    w->vs = work_array(p, 1);
    w->next_x = work_array(p, 1);
    if (!FACT(w, solves)) return;
    w->delta = work_array(p, 1);
    w->r = work_array(p, 1);
}

#ifdef ROWS
static void literal_plan(work *w, const double argument[2], coef *unit, coef *c) { verlet_plan(w, argument, unit, c); }
#endif

#ifdef TRACING
#define literal_room verlet_room
static void literal_trace(work *w, int i)
{
    const tracer *to = tracer_of(w);
    if (i < 0) {
        EACH(k) to->x[k] = w->old[k];
        return;
    }
    EACHV(k) to->v[k] = (w->x[k] - w->old[k]) * w->per_h;
    verlet_tell(w, to);
}
#endif
