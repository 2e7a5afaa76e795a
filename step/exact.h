/* EXACT: the exact motion: by the formula of free fall from the start where the acceleration is constant, else by the
 * model's own exact line.
 *
 * Invariant: only the number of steps leads from a step to the next.
 */
static int exact_step(work *w) { return (void)w, STEP_OK; }
#define exact_accept step_is_final
#define exact_observe state_is_complete

/* At the time t, which is tau after the start. */
static int exact_state(work *w, clock t, clock tau, real *x, real *v)
{
    if (!FACT(w, constant)) return exact_at(w, t, x, v);
    const whole evaluations = w->evaluations;
    int bad = accel(w, w->t0, w->x, w->v, w->a);
    w->evaluations = evaluations;
    if (bad) return bad;
    EACH(k) x[k] = FMA(tau, FMA(tau / 2, w->a[k], w->v[k]), w->x[k]);
    EACHV(k) v[k] = FMA(tau, w->a[k], w->v[k]);
    return STEP_OK;
}
static int exact_sync(work *w, real *x, real *v) { return exact_state(w, time_now(w), (clock)w->n * w->h, x, v); }

#define exact_between dense_without
#define exact_extend dense_as_it_is
#define exact_swing swing_unknown
static inline int exact_dense(work *w, const dense_step *d, clock t, real *x, real *v)
{
    (void)d;
    return exact_state(w, t, t - w->t0, x, v);
}

static int exact_carry(const work *w, real *list[CARRY_MAX]) { return (void)w, (void)list, 0; }
static inline void exact_place(work *w, placing *p) { (void)w, (void)p; }

#ifdef ROWS
static void exact_plan(work *w, const double argument[2], coef *unit, coef *c)
{
    (void)w, (void)argument, (void)unit, (void)c;
}
#endif

#ifdef TRACING
static trace_room exact_room(const work *w) { return (void)w, (trace_room){0}; }
static void exact_trace(work *w, int i) { (void)w, (void)i; }
#endif
