/* GAUSS-RADAU: the polynomial of degree 7 through the accelerations at Radau's eight left nodes, whose integrals are
 * the velocity and the position along the step; of order 15, that of the quadrature [Everhart85, RS15].
 *
 * A turn takes the stages in their order. Each changes the polynomial so that it passes through the new acceleration
 * and through those before it, so that a turn gains several orders. The first polynomial is that of the step before,
 * extrapolated.
 *
 * Invariant: the first stage is the state, hence explicit; the iteration ends when no acceleration changes any more.
 */
static inline int radau_first(work *w)
{
    const int s = FACT(w, stages);
    const size_t stride = w->stride;
    EACH(k) w->xs[k] = w->x[k];
    EACHV(k) w->vs[k] = w->v[k];
    int bad = accel_in(w, 0, w->xs, w->vs, w->a);
    if (bad) return bad;
    if (!FIRST(w)) tableau_extrapolate(w, 1);
    for (int i = 0; i < (FIRST(w) ? s : 1); i++)
        EACHV(k) w->ks[(size_t)i * stride + k] = w->a[k];
    return STEP_OK;
}

/* Stage i, in the lanes that are open; r: by how much its acceleration changes. */
static inline int radau_stage(work *w, int i, mask open, real *restrict r)
{
    const int s = FACT(w, stages);
    const size_t stride = w->stride;
    const coef *spread = w->unit + tableau_spread(w, i);
    real *restrict K = w->ks + (size_t)i * stride;
    tableau_place(w, i);
    if (FACT(w, velocity)) tableau_speed(w, i);
    int bad = accel_in(w, i, w->xs, w->vs, w->a);
    if (bad) return bad;
    EACHV(k) {
        r[k] = w->a[k] - K[k];
        K[k] = PICK(open, w->a[k], K[k]);
        for (int j = i + 1; j < s; j++) {
            real *later = w->ks + (size_t)j * stride + k;
            *later = PICK(open, FMA(spread[j], r[k], *later), *later);
        }
    }
    return STEP_OK;
}

static int radau_step(work *w)
{
    const int s = FACT(w, stages);
    const size_t stride = w->stride;
    real before = (real){0} - 1;
    mask open = ALWAYS, contracts = NEVER;
    int bad = radau_first(w);
    for (int turn = 0; !bad && turn < JUDGE_TURNS_MAX && SOME(open); turn++) {
        for (int i = 1; i < s && !bad; i++) bad = radau_stage(w, i, open, w->r + (size_t)i * stride);
        if (bad) break;
        w->iterations++;
        const real last = before;
        judge_verdict now = judge_corrections(w, w->r + stride, w->ks + stride, s - 1, w->v, w->per_h, &before);
        now.done = now.done & NOT(judge_doubts(before, last, turn, &contracts));
        STOP(w, open & now.lost, turn == 0 ? STEP_DIVERGED : STEP_SOLVE);
        STOP(w, open & now.stuck, STEP_SOLVE);
        open = open & NOT(now.lost | now.done | now.stuck);
    }
    if (bad) return bad;
    STOP(w, open, STEP_SOLVE);
    for (int i = 0; i < s; i++) SPOIL(w, w->ks + (size_t)i * stride);
    TRACE(w, s - 1);
    tableau_finish(w);
    return STEP_OK;
}
#define radau_accept step_is_final
#define radau_observe state_is_complete
#define radau_sync work_sync_main
#define radau_between dense_stages_between
#define radau_extend dense_stages_extend
#define radau_dense dense_stages
#define radau_carry tableau_carry
#define radau_place tableau_arrays

#ifdef ROWS
static void radau_plan(work *w, const double argument[2], coef *unit, coef *c)
{
    (void)argument;
    tableau_sizes(w, w->row->tableau.stages);
    w->kept = w->stages;
    w->iterates = true;
    w->plains = (3 * w->stages + 2) * w->stages; /* the same, and tableau_spread */
    if (!unit) return;
    collocation nodes;
    collocation_make(&nodes, w->stages, true);
    for (int i = 0; i < w->stages; i++) c[i] = collocation_abscissa(&nodes, i);
    collocation_fill(w, &nodes, true, unit);
    collocation_ahead(&nodes, unit + tableau_ahead(w, 0));
    collocation_series(&nodes, unit + tableau_series(w, 0));
    collocation_spread(&nodes, unit + tableau_spread(w, 0));
}
#endif

#ifdef TRACING
#define radau_room tableau_room
static void radau_trace(work *w, int i)
{
    if (i >= 0) tableau_tell_solved(w);
}
#endif
