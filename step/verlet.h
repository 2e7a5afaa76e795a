/* VERLET: Störmer's recurrence x[n+1] - 2 x[n] + x[n-1] = h² a [HLW03], in summed form: d += h² a; x += d, with d =
 * x[n] - x[n-1], so that nothing is lost to round-off at small steps. The start is Taylor's, d = h v + h²/2 a.
 *
 * Invariant: velocities are formed at the time of the positions, v[n] = (x[n+1] - x[n-1])/2h, whatever the force
 * depends on. A force that depends on v is evaluated at that central difference, (d + delta/2)/h, where delta is the
 * implicit kick, the change of d by this force. First-order variables are velocities without a position: d/h is their
 * value half a step later.
 */
static int verlet_observe(work *w)
{
    if (FIRST(w)) return accel_now(w, w->x, w->v, w->a);
    if (!FACT(w, velocity)) return accel_now(w, w->x, w->vs, w->a);
    return newton_increment(w, w->hh, w->per_h, w->x, w->v, NEWTON_NOW);
}

static int verlet_step(work *w)
{
    real *restrict x = w->x, *restrict d = w->v;
    const real *restrict a = w->a;
    const clock hh = w->hh;
    const bool known = work_reuse(w);
#ifdef PASS /* as in operators.h: d += h² a, x += d */
    if (!known && !FIRST(w)) {
        PASS(w, 0, hh, 1);
        TRACE(w, 0);
        w->moved = 0;
        return STEP_OK;
    }
#endif
    int bad = known ? STEP_OK : verlet_observe(w);
    if (bad) return bad;
    if (!FIRST(w) && !FACT(w, velocity) && FACT(w, nv) == FACT(w, nx)) {
        EACH(k) { /* the common case in one pass over memory */
            ADVANCE(d[k], hh, a[k]);
            x[k] += d[k];
        }
    } else {
        if (FIRST(w))
            EACHV(k) d[k] = FMA(w->half_hh, a[k], w->h * d[k]);
        else if (FACT(w, velocity))
            EACHV(k) d[k] += w->delta[k];
        else
            EACHV(k) ADVANCE(d[k], hh, a[k]);
        EACH(k) x[k] += d[k];
    }
    TRACE(w, 0);
    return STEP_OK;
}
#define verlet_accept step_is_final

static int verlet_sync(work *w, real *x, real *v)
{
    const real *d = w->v;
    EACH(k) x[k] = w->x[k];
    if (FIRST(w))
        EACHV(k) v[k] = d[k];
    else if (FACT(w, velocity))
        EACHV(k) v[k] = FMA(0.5, w->delta[k], d[k]) * w->per_h;
    else
        EACHV(k) v[k] = FMA(w->half_hh, w->a[k], d[k]) * w->per_h;
    return STEP_OK;
}

#define verlet_carry work_carry_main
#define verlet_between lift_between
#define verlet_extend lift_extend
#define verlet_swing swing_unknown
#define verlet_dense lift_dense

static inline void verlet_place(work *w, placing *p)
{
    w->vs = work_array(p, 1);
    if (!FACT(w, solves)) return;
    w->delta = work_array(p, 1);
    w->r = work_array(p, 1);
}

#ifdef ROWS
static void verlet_plan(work *w, const double argument[2], coef *unit, coef *c)
{
    (void)argument, (void)unit;
    w->stages = 1;
    w->solves = w->velocity;
    w->waits = true;
    if (c) c[0] = 0;
}
#endif

#ifdef TRACING
static trace_room verlet_room(const work *w) { return (void)w, (trace_room){.events = 1, .x = 2, .v = 2}; }

/* The step as an event: to->v has its velocity, to->x the positions of one step earlier. */
static void verlet_tell(work *w, const tracer *to)
{
    tell(w, (trace_event){.kind = FIRST(w) ? MOTUS_TRACE_TAYLOR : MOTUS_TRACE_STEP,
                          .stage = 1,
                          .time = time_now(w),
                          .coefficient = 1,
                          .x = w->x,
                          .v = to->v,
                          .before_x = FIRST(w) ? NULL : to->x});
}

/* Stage -1: before the step, which overwrites the positions of one step earlier. */
static void verlet_trace(work *w, int i)
{
    const tracer *to = tracer_of(w);
    if (i < 0) {
        EACH(k) to->x[k] = w->x[k] - w->v[k];
        return;
    }
    EACHV(k) to->v[k] = w->v[k] * w->per_h;
    verlet_tell(w, to);
}
#endif
