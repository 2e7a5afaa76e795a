/* GAUSS-RADAU: the polynomial of degree 7 through the accelerations at Radau's eight left nodes, whose integrals are
 * the velocity and the position along the step; of order 15, that of the quadrature [Everhart85, RS15].
 *
 * A turn takes the stages in their order. Each changes the polynomial so that it passes through the new acceleration
 * and through those before it, so that a turn gains several orders. The first polynomial is that of the step before,
 * extrapolated; of a refused candidate, its own, in the part that the shorter one takes.
 *
 * An adaptive row estimates the error by how fast the coefficients of the polynomial fall. Of a smooth force those of
 * Legendre's polynomials fall geometrically, and quadrature at eight left nodes loses number 15 and those after it. So
 * the error of the velocity is h A r¹⁵, where A is the largest acceleration of the variable and r the larger of the
 * sixth root of coefficient 6 and the seventh of coefficient 7, over A. Of an oscillation one of the two may vanish,
 * but not both.
 *
 * Invariant: the first stage is the state, hence explicit; the iteration ends when no acceleration changes any more. An
 * adaptive row refuses a candidate whose iteration contracts slowly, and keeps the acceleration of the state for all
 * its stages.
 */
static inline int radau_first(work *w)
{
    const int s = FACT(w, stages);
    const size_t stride = w->stride;
    int bad;
    if (ROW(w, adaptive)) {
        bad = control_begin(w);
        if (!bad) tableau_predict(w, 1);
        return bad;
    }
    EACH(k) w->xs[k] = w->x[k];
    EACHV(k) w->vs[k] = w->v[k];
    bad = accel_in(w, 0, w->xs, w->vs, w->a);
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
    const coef *spread = FACT(w, unit) + tableau_spread(w, i);
    real *restrict K = w->ks + (size_t)i * stride;
    tableau_place(w, i);
    if (FACT(w, velocity)) tableau_speed(w, i);
    int bad = accel_in(w, i, w->xs, w->vs, r);
    if (bad) return bad;
    EACHV(k) {
        const real a = r[k];
        r[k] = a - K[k];
        K[k] = PICK(open, a, K[k]);
        for (int j = i + 1; j < s; j++) {
            real *later = w->ks + (size_t)j * stride + k;
            *later = PICK(open, FMA(spread[j], r[k], *later), *later);
        }
    }
    return STEP_OK;
}

/* The candidate's error, in units of what is allowed. */
static inline clock radau_error(work *w)
{
    const int s = FACT(w, stages);
    const coef least = EPSILON;
    real *restrict off_x = w->xs, *restrict off_v = w->vs;
    EACH_VARIABLE(g)
    {
        const size_t from = VARIABLE(w, g), to = VARIABLE(w, g + 1);
        real size = {0}, before = {0}, last = {0};
        for (size_t k = from; k < to; k++) {
            for (int i = 0; i < s; i++) size = LARGER(ABS(w->ks[(size_t)i * w->stride + k]), size);
            before = LARGER(ABS(tableau_weigh(w, tableau_series(w, s - 2), w->ks, k, s, false, (real){0})), before);
            last = LARGER(ABS(tableau_weigh(w, tableau_series(w, s - 1), w->ks, k, s, false, (real){0})), last);
        }
        const real per = 1 / (size + SMALLEST), none = {0};
        const real slow = control_log2(LARGER(before * per, none + least)) / (coef)(s - 2),
                   slower = control_log2(LARGER(last * per, none + least)) / (coef)(s - 1),
                   off = w->h * size * control_exp2((coef)(2 * s - 1) * LARGER(slow, slower));
        for (size_t k = from; k < to; k++) off_v[k] = off;
        for (size_t k = from; k < to && k < FACT(w, nx); k++) off_x[k] = w->h * off;
    }
    return control_norm(w, off_x, off_v);
}

/* The turns. In an adaptive row `before` is in units of rounding; slowest: the largest factor by which the corrections
 * shrank from turn to turn, while the equation was open. */
typedef struct radau_turns {
    real before, slowest;
    mask contracts; /* judge_doubts */
} radau_turns;

static inline judge_verdict radau_judge(work *w, radau_turns *it, int turn)
{
    const int s = FACT(w, stages);
    const real last = it->before, *r = w->r + w->stride, *K = w->ks + w->stride;
    judge_verdict now = judge_corrections(w, r, K, s - 1, w->v, w->per_h, &it->before);
    now.done = now.done & NOT(judge_doubts(it->before, last, turn, &it->contracts));
    return now;
}

/* For an adaptive row it is enough that the corrections that would follow are small beside what is allowed, or beside
 * the rounding of the accelerations. Corrections that no longer shrink are rounding, or the step is so long that the
 * iteration contracts slowly. */
static inline judge_verdict radau_judge_adaptive(const work *w, radau_turns *it, mask open)
{
    const norm_correction found = control_corrections(w, w->r + w->stride, w->ks + w->stride, FACT(w, stages) - 1);
    const real zero = {0}, last = it->before, now = zero + found.roundings, factor = now / (last + SMALLEST);
    const mask second = last >= 0, near = (64 * found.share * factor < 1) | (64 * found.change * factor < EPSILON),
               small = (now == 0) | (second & (factor < 1) & near), rounding = now <= 8,
               weak = open & second & NOT(small) & NOT(rounding);
    judge_verdict v = {.lost = NOT(FINITE(now))};
    v.done = NOT(v.lost) & (small | (second & (2 * factor > 1) & rounding));
    v.stuck = NOT(v.lost) & weak & (2 * factor > 1);
    it->slowest = PICK(weak, LARGER(factor, it->slowest), it->slowest);
    it->before = now;
    return v;
}

/* What the step would add, and its error; unsolved: the lanes whose iteration did not end. Steps at which the
 * corrections shrink by less than a third, roughly with the power 1 of the step, or 2, are not made longer. */
static inline void radau_candidate(work *w, mask unsolved, real slowest)
{
    if (SOME(unsolved))
        for (int i = 1; i < FACT(w, stages); i++)
            EACHV(k) {
                real *K = w->ks + (size_t)i * w->stride + k;
                *K = PICK(unsolved, w->ks[k], *K);
            }
    EACH(k) w->dx[k] = tableau_dx(w, k);
    EACHV(k) w->dv[k] = tableau_dv(w, k);
    w->error = radau_error(w);
    real slow = 3 * slowest;
    for (int i = 0; i < (FACT(w, velocity) ? 4 : 3); i++) slow *= slow;
    control_spoil(w, unsolved, slow);
}

static int radau_step(work *w)
{
    const int s = FACT(w, stages);
    const size_t stride = w->stride;
    radau_turns it = {.before = (real){0} - 1, .contracts = NEVER};
    mask open = ALWAYS, unsolved = NEVER;
    int bad = radau_first(w);
    for (int turn = 0; !bad && turn < JUDGE_TURNS_MAX && SOME(open); turn++) {
        for (int i = 1; i < s && !bad; i++) bad = radau_stage(w, i, open, w->r + (size_t)i * stride);
        if (bad) break;
        w->iterations++;
        const judge_verdict now = ROW(w, adaptive) ? radau_judge_adaptive(w, &it, open) : radau_judge(w, &it, turn);
        if (!ROW(w, adaptive)) {
            STOP(w, open & now.lost, turn == 0 ? STEP_DIVERGED : STEP_SOLVE);
            STOP(w, open & now.stuck, STEP_SOLVE);
        }
        unsolved = unsolved | (open & (now.lost | now.stuck));
        open = open & NOT(now.lost | now.done | now.stuck);
    }
    if (bad) return bad;
    if (!ROW(w, adaptive)) STOP(w, open, STEP_SOLVE);
    for (int i = 0; i < s; i++) SPOIL(w, w->ks + (size_t)i * stride);
    TRACE(w, s - 1);
    if (ROW(w, adaptive))
        radau_candidate(w, unsolved | open, it.slowest);
    else
        tableau_finish(w);
    return STEP_OK;
}

static inline void radau_accept(work *w, clock_mask good)
{
    if (!ROW(w, adaptive)) return;
    EACH(k) MOVE_WHERE(good, ROW(w, compensated), w->x[k], w->ex[k], w->dx[k]);
    EACHV(k) MOVE_WHERE(good, ROW(w, compensated), w->v[k], w->ev[k], w->dv[k]);
    w->span = CHOOSE_WHERE(good, w->h, -w->h);
    control_known(w, NOT(good));
}
#define radau_observe state_is_complete
#define radau_sync work_sync_main
#define radau_between dense_stages_between
#define radau_extend dense_stages_extend
#define radau_dense dense_stages
#define radau_swing swing_of_stages
#define radau_carry tableau_carry

static inline void radau_place(work *w, placing *p)
{
    tableau_arrays(w, p);
    if (ROW(w, adaptive)) w->dx = work_array(p, 1), w->dv = work_array(p, 1);
}

#ifdef ROWS
static void radau_plan(work *w, const double argument[2], coef *unit, coef *c)
{
    (void)argument;
    tableau_sizes(w, w->row->tableau.stages);
    w->kept = w->stages;
    w->iterates = true;
    w->order = 2 * w->stages - 1;
    w->plains = (3 * w->stages + 3) * w->stages; /* as in implicit.h, and tableau_spread */
    if (!unit) return;
    collocation nodes;
    collocation_make(&nodes, w->stages, true);
    for (int i = 0; i < w->stages; i++) c[i] = collocation_abscissa(&nodes, i).high;
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
