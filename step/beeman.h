/* BEEMAN: x[n+1] = x + h v + h²/6 (4 a[n] - a[n-1]), v[n+1] = v + h/6 (2 a[n+1] + 5 a[n] - a[n-1]), a[-1] = a[0]
 * [Beeman76].
 *
 * Invariant: between steps `v` lacks the term h/3 a[n+1] until that acceleration is needed for the positions.
 */
static int beeman_observe(work *w) { return accel_now(w, w->x, w->vs, w->a); }

static int beeman_step(work *w)
{
    int bad = work_reuse(w) ? STEP_OK : beeman_observe(w);
    if (bad) return bad;
    real *restrict x = w->x, *restrict v = w->v, *restrict a = w->a, *restrict old = w->old;
    const clock h = w->h, third = h / 3, sixth = h / 6, hh_sixth = w->hh / 6;
    if (FIRST(w))
        EACHV(k) old[k] = a[k];
    else
        EACHV(k) ADVANCE(v[k], third, a[k]);
    EACH(k) x[k] += FMA(h, v[k], hh_sixth * FMA(4, a[k], -old[k]));
    EACHV(k) ADVANCE(v[k], sixth, FMA(5, a[k], -old[k]));
    if (SMALL) {
        EACHV(k) old[k] = a[k];
    } else {
        w->a = old;
        w->old = a;
    }
    TRACE(w, 0);
    return STEP_OK;
}
#define beeman_accept step_is_final

static int beeman_sync(work *w, real *x, real *v)
{
    const clock third = w->h / 3;
    EACH(k) x[k] = w->x[k];
    if (FIRST(w))
        EACHV(k) v[k] = w->v[k];
    else
        EACHV(k) v[k] = FMA(third, w->a[k], w->v[k]);
    return STEP_OK;
}

static int beeman_carry(const work *w, real *list[CARRY_MAX])
{
    const int count = work_carry_main(w, list);
    list[count] = w->old;
    return count + 1;
}
#define beeman_between lift_between
#define beeman_extend lift_extend
#define beeman_swing swing_unknown
#define beeman_dense lift_dense

static inline void beeman_place(work *w, placing *p)
{
    w->old = work_array(p, 1);
    w->vs = work_array(p, 1);
}

#ifdef ROWS
static void beeman_plan(work *w, const double argument[2], coef *unit, coef *c)
{
    (void)argument, (void)unit;
    w->stages = 1;
    w->waits = true;
    if (c) c[0] = 0;
}
#endif

#ifdef TRACING
#define beeman_room verlet_room
static void beeman_trace(work *w, int i)
{
    if (i < 0) return;
    /* The array of the acceleration is free for the next one. */
    tell(w,
         (trace_event){
             .kind = MOTUS_TRACE_STEP, .stage = 1, .time = time_now(w), .coefficient = 1, .x = w->x, .before_a = w->a});
}
#endif
