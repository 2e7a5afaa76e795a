/* IMPLICIT: stages K[i] = a(X[i], V[i], t + c[i] h), X[i] = x + c[i] h v + h² Σ aa[i][j] K[j], V[i] = v + h Σ a[i][j]
 * K[j]: collocation at the Gauss nodes, and Newmark's method, whose one implicit stage is the end of the step [HLW06,
 * II.1; Newmark59].
 *
 * Collocation begins each step with the polynomial of the step before, extrapolated, and inserts the stages into their
 * equation; where that contracts slowly, Newton's method takes over. For an affine equation, whose matrix is factored
 * once, and for a single stage, the iteration is Newton's from the start. It is simplified: one matrix a step,
 * evaluated in the middle of the stages, and evaluated again where the iteration does not contract.
 *
 * Invariant: the unknowns are the stages' accelerations, so the round-off of the solution reaches the state multiplied
 * by h; the iteration ends when they no longer change. What a step begins with is carried from the step before.
 */
/* Factors the matrix at the mean of the unknown stages, by Taylor's formula with the present acceleration of the
 * first. */
static inline int implicit_matrix(work *w, mask *where)
{
    const int first = FACT(w, known), all = FACT(w, stages), s = all - first;
    clock *ax = w->matrix, *av = ax + s * s;
    coef c = 0;
    for (int i = 0; i < s; i++) {
        c += w->c[first + i] / s;
        for (int j = 0; j < s; j++) {
            ax[i * s + j] = w->scaled[tableau_aa(w, first + i) + first + j];
            av[i * s + j] = w->scaled[tableau_a(w, first + i) + first + j];
        }
    }
    const clock ch = c * w->h;
    const real *K = w->ks + (size_t)first * w->stride;
    EACH(k) w->xs[k] = FMA(ch, FMA(ch / 2, K[k], w->v[k]), w->x[k]);
    EACHV(k) w->vs[k] = FMA(ch, K[k], w->v[k]);
    return solve_factor(w, where, s, ax, av, time_now(w) + ch, w->xs, w->vs);
}

/* The iteration, from one turn to the next. The parts of a step stand alone, so that lanes may take the turns of many
 * trajectories side by side. */
typedef struct implicit_iteration {
    mask open;        /* the equation is not solved yet */
    mask newton;      /* by Newton's method */
    mask contracts;   /* of insertion: judge_doubts */
    real before;      /* judge_corrections's */
    real renewed;     /* matrices that were evaluated anew */
    int turns, begun; /* begun: the turn with which Newton's method began */
} implicit_iteration;

/* w->a: the acceleration at the start of the step. */
static inline int implicit_start(work *w)
{
    EACH(k) w->xs[k] = w->x[k];
    EACHV(k) w->vs[k] = w->v[k];
    return accel_now(w, w->xs, w->vs, w->a);
}

static inline int implicit_begin(work *w, implicit_iteration *it)
{
    const bool newton = !FACT(w, kept) || FACT(w, affine);
    *it = (implicit_iteration){
        .open = ALWAYS, .newton = newton ? ALWAYS : NEVER, .contracts = NEVER, .before = (real){0} - 1};
    if (ROW(w, adaptive)) {
        const int bad = control_begin(w);
        if (bad) return bad;
        tableau_predict(w, 0);
    } else if (!FACT(w, kept) || FIRST(w)) {
        /* newmark's last stage is the next step's first */
        int bad = !FACT(w, known) || FIRST(w) ? implicit_start(w) : STEP_OK;
        if (bad) return bad;
        for (int i = 0; i < FACT(w, stages); i++)
            EACHV(k) w->ks[(size_t)i * w->stride + k] = w->a[k];
    } else {
        tableau_extrapolate(w, 0);
    }
    mask regular = ALWAYS; /* an equation whose matrix is not will be lost in the first turn */
    return newton ? implicit_matrix(w, &regular) : STEP_OK;
}

/* open: in this iteration, or in any of those whose turns are taken beside it */
static inline bool implicit_more(const implicit_iteration *it, mask open)
{
    return it->turns < JUDGE_TURNS_MAX && SOME(open);
}

/* Corrects K by r, in the lanes of Newton's method by the solution of its equation, and judges the corrections. */
static inline judge_verdict implicit_correct(work *w, implicit_iteration *it, real *K, int s)
{
    judge_verdict all = {NEVER, NEVER, NEVER};
    for (int way = 0; way < 2; way++) {
        const mask mine = way ? it->newton : NOT(it->newton);
        if (!SOME(it->open & mine)) continue;
        if (way) solve_back(w, w->r);
        for (int i = 0; i < s; i++)
            judge_correct(w, it->open & mine, K + (size_t)i * w->stride, w->r + (size_t)i * w->stride);
        real before = it->before;
        const judge_verdict now = judge_corrections(w, w->r, K, s, w->v, w->per_h, &before);
        it->before = PICK(mine, before, it->before);
        all.done = all.done | (mine & now.done);
        all.stuck = all.stuck | (mine & now.stuck);
        all.lost = all.lost | (mine & now.lost);
    }
    return all;
}

/* Newton's method takes over in the lanes `slow`; what is lost there begins again. */
static inline int implicit_hand_over(work *w, implicit_iteration *it, mask slow, mask lost)
{
    if (SOME(slow & lost)) {
        int bad = ROW(w, adaptive) ? STEP_OK : implicit_start(w);
        if (bad) return bad;
        for (int i = 0; i < FACT(w, stages); i++)
            EACHV(k) {
                real *K = w->ks + (size_t)i * w->stride + k;
                *K = PICK(slow & lost, w->a[k], *K);
            }
    }
    it->newton = it->newton | slow;
    it->before = PICK(slow, (real){0} - 1, it->before);
    it->begun = it->turns;
    mask good = slow;
    int bad = implicit_matrix(w, &good);
    it->open = it->open & (good == slow);
    return bad;
}

static inline int implicit_turn(work *w, implicit_iteration *it)
{
    enum { PATIENCE = 8, RENEWALS = 6, INSERTIONS = 10 };
    const int first = FACT(w, known), s = FACT(w, stages) - first, turn = it->turns++;
    const size_t stride = w->stride;
    real *K = w->ks + (size_t)first * stride;
    for (int i = 0; i < s; i++) {
        real *r = w->r + (size_t)i * stride;
        tableau_place(w, first + i);
        if (FACT(w, velocity)) tableau_speed(w, first + i);
        int bad = accel_in(w, first + i, w->xs, w->vs, r);
        if (bad) return bad;
        EACHV(k) r[k] -= K[(size_t)i * stride + k];
    }
    const real last = it->before;
    judge_verdict now = implicit_correct(w, it, K, s);
    w->iterations++;
    now.done = now.done & (it->newton | NOT(judge_doubts(it->before, last, turn, &it->contracts)));
    /* one that shrinks less than to a quarter needs more turns than Newton's method costs */
    const mask weak = (last >= 0) & (4 * it->before > last) & (it->before > 64 * SQRT_EPSILON),
               slow = it->open & NOT(it->newton) & NOT(now.done) &
                      (now.lost | weak | (turn >= INSERTIONS ? ALWAYS : NEVER));
    STOP(w, it->open & it->newton & now.lost, turn == it->begun ? STEP_DIVERGED : STEP_SOLVE);
    it->open = FACT(w, direct) ? NEVER : it->open & NOT(now.done | (it->newton & now.lost));
    if (!SOME(it->open)) return STEP_OK;
    const mask stuck = it->open & it->newton & now.stuck,
               late = turn % PATIENCE == PATIENCE - 1 ? it->open & it->newton : stuck;
    if (SOME(late)) {
        const mask renew = late & (it->renewed < RENEWALS);
        mask good = renew;
        it->renewed = PICK(late, it->renewed + 1, it->renewed);
        STOP(w, stuck & NOT(renew), STEP_SOLVE);
        int bad = SOME(renew) ? implicit_matrix(w, &good) : STEP_OK;
        if (bad) return bad;
        it->open = it->open & NOT(stuck & NOT(renew)) & (good == renew);
    }
    return SOME(slow) ? implicit_hand_over(w, it, slow, now.lost) : STEP_OK;
}

static inline int implicit_end(work *w, const implicit_iteration *it)
{
    const int s = FACT(w, stages);
    if (it->turns == JUDGE_TURNS_MAX) STOP(w, it->open, STEP_SOLVE);
    for (int i = 0; i < s; i++) SPOIL(w, w->ks + (size_t)i * w->stride);
    TRACE(w, s - 1);
    tableau_finish(w);
    if (FACT(w, known))
        EACHV(k) w->a[k] = w->ks[(size_t)(s - 1) * w->stride + k];
    return STEP_OK;
}

static int implicit_step(work *w)
{
    implicit_iteration it;
    int bad = implicit_begin(w, &it);
    while (!bad && implicit_more(&it, it.open)) bad = implicit_turn(w, &it);
    return bad ? bad : implicit_end(w, &it);
}
static inline void implicit_accept(work *w, clock_mask good)
{
    if (ROW(w, adaptive)) w->span = CHOOSE_WHERE(good, w->h, -w->h);
}
#define implicit_observe state_is_complete
#define implicit_sync work_sync_main
#define implicit_between dense_stages_between
#define implicit_extend dense_stages_extend
#define implicit_swing swing_unknown
#define implicit_dense dense_stages
#define implicit_carry tableau_carry
#define implicit_place tableau_arrays

#ifdef ROWS
/* Newmark: x + h v + h² ((1/2 - β) K0 + β K1), v + h ((1 - γ) K0 + γ K1); the second stage is the end of the step. */
static void implicit_newmark(work *w, coef beta, coef gamma, coef *unit, coef *c)
{
    const coef rates[] = {1 - gamma, gamma}, squares[] = {(coef)0.5 - beta, beta};
    for (int i = 0; i < w->linears + w->squares; i++) unit[i] = 0;
    for (int j = 0; j < 2; j++) {
        unit[tableau_a(w, 1) + j] = unit[tableau_b(w) + j] = rates[j];
        unit[tableau_aa(w, 1) + j] = unit[tableau_bb(w) + j] = squares[j];
    }
    c[0] = 0;
    c[1] = 1;
}

/* By a step on a circular orbit that is short enough for insertion, and long enough for an error above rounding. */
static coef implicit_reach(const work *w, const coef *unit, const coef *c)
{
    enum { TURNS = 50 };
    const int s = w->stages;
    const coef h = K(0.5);
    coef K[TABLEAU_COUPLED_MAX + 1][2] = {{0}}, x[2] = {1, 0}, v[2] = {0, 1};
    for (int turn = 0; turn < TURNS; turn++)
        for (int i = 0; i <= s; i++) { /* the last is the end of the step */
            const coef *aa = unit + (i < s ? tableau_aa(w, i) : tableau_bb(w));
            coef at[2] = {1, i < s ? c[i] * h : h};
            for (int j = 0; j < s; j++)
                for (int n = 0; n < 2; n++) at[n] += h * h * aa[j] * K[j][n];
            const coef pull = density_pull(at);
            for (int n = 0; n < 2; n++) K[i][n] = -pull * at[n], x[n] = at[n];
        }
    for (int j = 0; j < s; j++)
        for (int n = 0; n < 2; n++) v[n] += h * unit[tableau_b(w) + j] * K[j][n];
    return density_reach(w, x, v, h, K(0.87758256189037271611628158260382965199165),
                         K(0.47942553860420300027328793521557138808180));
}

static void implicit_plan(work *w, const double argument[2], coef *unit, coef *c)
{
    const row *m = w->row;
    tableau_sizes(w, m->newmark ? 2 : m->tableau.stages);
    w->known = m->newmark;
    w->kept = w->stages > 1 && !m->newmark ? w->stages : 0;
    w->plains = (2 * w->kept + 3) * w->kept + m->density; /* tableau_ahead, _series, _rest, _low_c; DENSITY_REACH */
    w->opening = m->density;
    if (m->density) w->order = m->card.order;
    w->iterates = true;
    w->solves = w->stages - w->known;
    w->solves_x = !m->newmark || argument[0] != 0;
    w->direct = !w->solves_x && (!w->velocity || w->linear);
    if (!unit) return;
    if (m->newmark) {
        implicit_newmark(w, (coef)argument[0], (coef)argument[1], unit, c);
        return;
    }
    collocation nodes;
    collocation_make(&nodes, w->stages, false);
    for (int i = 0; i < w->stages; i++) c[i] = collocation_abscissa(&nodes, i).high;
    collocation_fill(w, &nodes, false, unit);
    if (!w->kept) return;
    collocation_ahead(&nodes, unit + tableau_ahead(w, 0));
    collocation_series(&nodes, unit + tableau_series(w, 0));
    if (m->density) unit[w->linears + w->squares] = implicit_reach(w, unit, c);
}
#endif

#ifdef TRACING
#define implicit_room tableau_room
static void implicit_trace(work *w, int i)
{
    if (i < 0) return;
    tableau_tell_solved(w);
}
#endif
