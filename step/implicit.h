/* IMPLICIT: stages K[i] = a(X[i], V[i], t + c[i] h), X[i] = x + c[i] h v + h² Σ aa[i][j] K[j], V[i] = v + h Σ a[i][j]
 * K[j]: collocation at the Gauss nodes, and Newmark's method, whose one implicit stage is the end of the step [HLW06,
 * II.1; Newmark59].
 *
 * Invariant: the unknowns are the stages' accelerations, so the round-off of the solution reaches the state
 * multiplied by h; the iteration ends when they no longer change. Simplified Newton: one matrix a step, evaluated in
 * the middle of the stages, and evaluated again where the iteration does not contract.
 */
static inline void implicit_stage(work *w, int i)
{
    real *restrict X = w->xs, *restrict V = w->vs;
    const real *restrict x = w->x, *restrict v = w->v, *restrict K = w->ks;
    const int s = FACT(w, stages), a = tableau_a(w, i), aa = tableau_aa(w, i);
    const clock ch = w->c[i] * w->h;
    EACH(k) X[k] = x[k] + FMA(ch, v[k], tableau_sum(w, aa, K, k, s));
    EACHV(k) V[k] = v[k] + tableau_sum(w, a, K, k, s);
}

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
    mask open;    /* the equation is not solved yet */
    real before;  /* newton_judge's */
    real renewed; /* matrices that were evaluated anew */
    int turns;
} implicit_iteration;

/* The first guess of all stages is the acceleration at the start. */
static inline int implicit_begin(work *w, implicit_iteration *it)
{
    const size_t stride = w->stride;
    *it = (implicit_iteration){.open = ALWAYS, .before = (real){0} - 1};
    if (!FACT(w, known) || FIRST(w)) { /* newmark's last stage is the next step's first */
        EACH(k) w->xs[k] = w->x[k];
        EACHV(k) w->vs[k] = w->v[k];
        int bad = accel_now(w, w->xs, w->vs, w->a);
        if (bad) return bad;
    }
    for (int i = 0; i < FACT(w, stages); i++)
        EACHV(k) w->ks[(size_t)i * stride + k] = w->a[k];
    mask regular = ALWAYS; /* an equation whose matrix is not will be lost in the first turn */
    return implicit_matrix(w, &regular);
}

static inline bool implicit_goes_on(const implicit_iteration *it) { return it->turns < NEWTON_MAX && SOME(it->open); }

static inline int implicit_turn(work *w, implicit_iteration *it)
{
    enum { PATIENCE = 8, RENEWALS = 6 };
    const int first = FACT(w, known), s = FACT(w, stages) - first, turn = it->turns++;
    const size_t stride = w->stride;
    real *K = w->ks + (size_t)first * stride;
    for (int i = 0; i < s; i++) {
        real *r = w->r + (size_t)i * stride;
        implicit_stage(w, first + i);
        int bad = accel_in(w, first + i, w->xs, w->vs, r);
        if (bad) return bad;
        EACHV(k) r[k] -= K[(size_t)i * stride + k];
    }
    solve_back(w, w->r);
    w->iterations++;
    for (int i = 0; i < s; i++) newton_correct(w, it->open, K + (size_t)i * stride, w->r + (size_t)i * stride);
    const newton_verdict now = newton_judge(w, w->r, K, s, w->v, w->per_h, &it->before);
    STOP(w, it->open & now.lost, turn == 0 ? STEP_DIVERGED : STEP_SOLVE);
    it->open = FACT(w, direct) ? NEVER : it->open & NOT(now.lost | now.done);
    if (!SOME(it->open)) return STEP_OK;
    const mask stuck = it->open & now.stuck, slow = turn % PATIENCE == PATIENCE - 1 ? it->open : stuck;
    if (!SOME(slow)) return STEP_OK;
    const mask renew = slow & (it->renewed < RENEWALS);
    mask good = renew;
    it->renewed = PICK(slow, it->renewed + 1, it->renewed);
    STOP(w, stuck & NOT(renew), STEP_SOLVE);
    int bad = SOME(renew) ? implicit_matrix(w, &good) : STEP_OK;
    it->open = it->open & NOT(stuck & NOT(renew)) & (good == renew);
    return bad;
}

static inline int implicit_end(work *w, const implicit_iteration *it)
{
    real *restrict x = w->x, *restrict v = w->v, *restrict ex = w->ex, *restrict ev = w->ev;
    const real *restrict K = w->ks;
    const size_t stride = w->stride;
    const clock h = w->h;
    const int s = FACT(w, stages), b = tableau_b(w), bb = tableau_bb(w);
    if (it->turns == NEWTON_MAX) STOP(w, it->open, STEP_SOLVE);
    for (int i = 0; i < s; i++) SPOIL(w, w->ks + (size_t)i * stride);
    TRACE(w, s - 1);
    if (ROW(w, compensated)) {
        EACH(k) ADVANCE_COMPENSATED(x[k], ex[k], 1, FMA(h, v[k], tableau_sum(w, bb, K, k, s)));
        EACHV(k) ADVANCE_COMPENSATED(v[k], ev[k], 1, tableau_sum(w, b, K, k, s));
    } else {
        EACH(k) x[k] += FMA(h, v[k], tableau_sum(w, bb, K, k, s));
        EACHV(k) v[k] += tableau_sum(w, b, K, k, s);
    }
    if (FACT(w, known))
        EACHV(k) w->a[k] = K[(size_t)(s - 1) * stride + k];
    return STEP_OK;
}

static int implicit_step(work *w)
{
    implicit_iteration it;
    int bad = implicit_begin(w, &it);
    while (!bad && implicit_goes_on(&it)) bad = implicit_turn(w, &it);
    return bad ? bad : implicit_end(w, &it);
}
#define implicit_accept step_is_final
#define implicit_observe state_is_complete
#define implicit_sync work_sync_main
#define implicit_dense dense_hermite

static int implicit_carry(const work *w, real *list[CARRY_MAX])
{
    int count = work_carry_main(w, list);
    if (FACT(w, known)) list[count++] = w->a;
    return count;
}

static inline void implicit_place(work *w, placing *p)
{
    w->xs = work_array(p, 1);
    w->vs = work_array(p, 1);
    w->ks = work_array(p, FACT(w, stages));
    w->r = work_array(p, FACT(w, stages));
}

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

static void implicit_plan(work *w, const double argument[2], coef *unit, coef *c)
{
    const row *m = w->row;
    tableau_sizes(w, m->newmark ? 2 : m->tableau.stages);
    w->known = m->newmark;
    w->solves = w->stages - w->known;
    w->solves_x = !m->newmark || argument[0] != 0;
    w->direct = !w->solves_x && (!w->velocity || w->linear);
    if (!unit) return;
    if (m->newmark) {
        implicit_newmark(w, (coef)argument[0], (coef)argument[1], unit, c);
        return;
    }
    for (int i = 0; i < w->stages; i++) c[i] = m->tableau.c[i];
    tableau_fill(w, m->tableau.a, m->tableau.b, unit);
}
#endif

#ifdef TRACING
#define implicit_room tableau_room
static void implicit_trace(work *w, int i)
{
    if (i < 0) return;
    tell(w, (trace_event){.kind = MOTUS_EVENT_SOLVE, .time = time_now(w)});
    for (int j = 0; j < w->stages; j++) {
        implicit_stage(w, j);
        tableau_tell(w, j, w->xs, w->vs, w->ks + (size_t)j * w->stride);
    }
}
#endif
