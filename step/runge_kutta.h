/* RUNGE-KUTTA, explicit, in second-order form: X[i] = x + c[i] h v + h² Σ aa[i][j] K[j], V[i] = v + h Σ a[i][j] K[j],
 * K[i] = a(X[i], V[i], t + c[i] h), with aa = A² and bb = bA of a method for s' = f(s) [HNW93, II.14], or with the
 * tables of a Nyström method. Where the force is free of v, no velocity is formed at a stage.
 *
 * A row of fixed step moves the state by the increments dx and dv. An adaptive row makes a candidate of them: it
 * estimates their error by weights that sum to zero, and moves the state when the candidate is accepted. Where the
 * estimate needs the acceleration at the candidate (`ending`), that is the next step's first stage.
 *
 * Invariant: the sums over stages, of small numbers, are formed first; h multiplies them, and the state takes them
 * once.
 */
/* 1 - Σ b and 1/2 - Σ bb, of the rounded numbers: without them time would run too fast or too slow by as much. */
static inline int runge_kutta_residual(const work *w) { return tableau_bb(w) + FACT(w, stages); }
/* of adaptive rows: the weights of the errors */
static inline int runge_kutta_error(const work *w) { return runge_kutta_residual(w) + 2; }
static inline int runge_kutta_error_x(const work *w) { return runge_kutta_error(w) + FACT(w, stages) + 1; }
static inline int runge_kutta_second(const work *w) { return runge_kutta_error_x(w) + FACT(w, stages) + 1; }
static inline int runge_kutta_second_x(const work *w) { return runge_kutta_second(w) + FACT(w, stages) + 1; }

/* The velocity at stage i. */
static inline void runge_kutta_velocity(const work *w, int i, real *restrict V)
{
    const real *restrict v = w->v, *restrict K = w->ks;
    const clock h = w->h;
    const int a = tableau_a(w, i);
    EACHV(k) V[k] = FMA(h, tableau_weigh(w, a, K, k, i, false, (real){0}), v[k]);
}

/* What the step adds to x[k] and to v[k]; of a compensated row with the error words, and the residuals. */
static inline real runge_kutta_dx(const work *w, size_t k)
{
    const clock h = w->h, hh = w->hh;
    const int s = FACT(w, stages), bb = tableau_bb(w);
    const real *K = w->ks, v = w->v[k];
    if (ROW(w, compensated)) {
        const coef residual = FACT(w, unit)[runge_kutta_residual(w) + 1];
        const real sum = tableau_weigh(w, bb, K, k, s, true, residual * K[k]);
        return FMA(h, v, FMA(h, w->ev[k], FMA(hh, sum, w->ex[k])));
    }
    return tableau_any(w, bb, s) ? FMA(h, v, hh * tableau_weigh(w, bb, K, k, s, false, (real){0})) : h * v;
}

static inline real runge_kutta_dv(const work *w, size_t k)
{
    const clock h = w->h;
    const int s = FACT(w, stages), b = tableau_b(w);
    const real *K = w->ks;
    if (ROW(w, compensated)) {
        const coef residual = FACT(w, unit)[runge_kutta_residual(w)];
        return FMA(h, tableau_weigh(w, b, K, k, s, true, residual * K[k]), w->ev[k]);
    }
    return h * tableau_weigh(w, b, K, k, s, false, (real){0});
}

static inline bool runge_kutta_closes(const work *w, int i) { return FACT(w, closing) && i == FACT(w, stages) - 1; }

/* The acceleration at stage i; a closing stage is at the positions to which the candidate leads, to the last bit. */
static inline int runge_kutta_stage(work *w, int i)
{
    const real *restrict x = w->x, *restrict v = w->v, *restrict K = w->ks;
    real *restrict X = w->xs, *Ki = w->ks + (size_t)i * w->stride;
    const clock ch = FACT(w, c)[i] * w->h, hh = w->hh;
    const int aa = tableau_aa(w, i);
    if (runge_kutta_closes(w, i)) {
        EACH(k) w->dx[k] = runge_kutta_dx(w, k);
        EACH(k) X[k] = x[k] + w->dx[k];
        return accel(w, time_in(w, 1), X, w->vs, Ki);
    }
    if (tableau_any(w, aa, i))
        EACH(k) X[k] = FMA(hh, tableau_weigh(w, aa, K, k, i, false, (real){0}), FMA(ch, v[k], x[k]));
    else
        EACH(k) X[k] = FMA(ch, v[k], x[k]);
    if (FACT(w, velocity)) runge_kutta_velocity(w, i, w->vs);
    return accel_in(w, i, X, w->vs, Ki);
}

/* The acceleration at the candidate, which is a stage of the estimate. */
static inline int runge_kutta_end(work *w)
{
    real *X = w->xs, *V = w->vs;
    EACH(k) X[k] = w->x[k] + w->dx[k];
    EACHV(k) V[k] = w->v[k] + w->dv[k];
    return accel(w, time_in(w, 1), X, V, w->ks + (size_t)FACT(w, stages) * w->stride);
}

/* The error by the weights from number `of` on (of_x: those of the positions), in units of what is allowed. */
static inline clock runge_kutta_measure(work *w, int of, int of_x)
{
    real *restrict off_x = w->xs, *restrict off_v = w->vs;
    const real *restrict K = w->ks;
    const clock h = w->h, hh = w->hh;
    const int s = FACT(w, stages) + FACT(w, ending);
    EACH(k) off_x[k] = hh * tableau_weigh(w, of_x, K, k, s, false, (real){0});
    EACHV(k) off_v[k] = h * tableau_weigh(w, of, K, k, s, false, (real){0});
    return control_norm(w, off_x, off_v);
}

static inline int runge_kutta_candidate(work *w)
{
    if (!FACT(w, closing))
        EACH(k) w->dx[k] = runge_kutta_dx(w, k);
    EACHV(k) w->dv[k] = runge_kutta_dv(w, k);
    int bad = FACT(w, ending) ? runge_kutta_end(w) : STEP_OK;
    if (bad) return bad;
    w->error = runge_kutta_measure(w, runge_kutta_error(w), runge_kutta_error_x(w));
    if (FACT(w, second)) /* [HNW93, II.10]: an estimate of order 5 beside one of order 3 */
        w->error = control_joint(w->error, runge_kutta_measure(w, runge_kutta_second(w), runge_kutta_second_x(w)));
    return STEP_OK;
}

static int runge_kutta_step(work *w)
{
    int bad = ROW(w, adaptive) ? control_begin(w) : accel_in(w, 0, w->x, w->v, w->ks);
    if (bad) return bad;
    TRACE(w, 0);
    EACH_STAGE(i, FACT(w, stages)) {
        if (i == 0) continue;
        bad = runge_kutta_stage(w, i);
        if (bad) return bad;
        TRACE(w, i);
    }
    if (ROW(w, adaptive)) return runge_kutta_candidate(w);
    real *restrict x = w->x, *restrict v = w->v, *restrict ex = w->ex, *restrict ev = w->ev;
    EACH(k) MOVE_WHERE(EVERY, ROW(w, compensated), x[k], ex[k], runge_kutta_dx(w, k));
    EACHV(k) MOVE_WHERE(EVERY, ROW(w, compensated), v[k], ev[k], runge_kutta_dv(w, k));
    return STEP_OK;
}

static inline void runge_kutta_accept(work *w, clock_mask good)
{
    if (!ROW(w, adaptive)) return;
    real *restrict x = w->x, *restrict v = w->v, *restrict ex = w->ex, *restrict ev = w->ev;
    EACH(k) MOVE_WHERE(good, ROW(w, compensated), x[k], ex[k], w->dx[k]);
    EACHV(k) MOVE_WHERE(good, ROW(w, compensated), v[k], ev[k], w->dv[k]);
    const bool known = control_last_is_first(w);
    const real *end = w->ks + (size_t)(FACT(w, stages) - FACT(w, closing)) * w->stride;
    if (known)
        EACHV(k) w->a[k] = CHOOSE_WHERE(good, end[k], w->a[k]);
    control_known(w, known ? EVERY : NOT(good));
}
#define runge_kutta_observe state_is_complete
#define runge_kutta_sync work_sync_main
#define runge_kutta_carry work_carry_main
#define runge_kutta_swing swing_of_stages

static inline void runge_kutta_place(work *w, placing *p)
{
    w->xs = work_array(p, 1);
    w->vs = work_array(p, 1);
    w->ks = work_array(p, FACT(w, stages) + FACT(w, ending));
    if (!ROW(w, adaptive)) return;
    w->a = w->ks; /* the first stage is the acceleration of the state */
    w->dx = work_array(p, 1);
    w->dv = work_array(p, 1);
}

#ifdef ROWS
/* Number j of the row r of s numbers times the s × s matrix a, and `more`; rounded once. */
static coef runge_kutta_product(int s, const coef *r, const coef *a, int j, pair more)
{
    for (int l = 0; l < s; l++) more = pair_sum(more, pair_exact_product(r[l], a[l * s + j]));
    return more.high;
}

/* error: weights of the velocities; error_x of the positions, which follow from a where the row does not give them. */
static void runge_kutta_weights(const work *w, const coef *error, const coef *error_x, coef *unit, int at, int at_x)
{
    const int s = w->stages, all = s + w->ending;
    const coef *a = unit, *b = unit + tableau_b(w);
    coef *e = unit + at, *ee = unit + at_x;
    for (int i = 0; i < all; i++) e[i] = error[i];
    if (error_x) {
        for (int i = 0; i < all; i++) ee[i] = error_x[i];
        return;
    }
    /* the stage at the candidate has the weights b of the step itself */
    for (int j = 0; j < s; j++)
        ee[j] = runge_kutta_product(s, e, a, j, w->ending ? pair_exact_product(e[s], b[j]) : pair_of(0));
}

/* whole - Σ c */
static coef runge_kutta_missing(pair whole, const coef *c, int count)
{
    for (int i = 0; i < count; i++) whole = pair_sum(whole, pair_of(-c[i]));
    return whole.high;
}

/* Gives what is missing to the smallest weight of a stage: large weights that cancel are rounded by more than the
 * stage may be off, and what they lack would be lost alike in every step. */
static void runge_kutta_complete(pair whole, coef *c, int count)
{
    int least = -1;
    for (int j = 0; j < count; j++)
        if (c[j] != 0 && (least < 0 || ABS(c[j]) < ABS(c[least]))) least = j;
    if (least >= 0) c[least] += runge_kutta_missing(whole, c, count);
}

static void runge_kutta_plan(work *w, const double argument[2], coef *unit, coef *c)
{
    const row *m = w->row;
    (void)argument;
    const int s = w->stages = m->tableau.stages;
    w->ending = m->tableau.ending;
    w->closing = m->tableau.closing;
    w->second = m->tableau.second != NULL;
    w->order = m->tableau.order;
    w->plains = m->adaptive ? runge_kutta_second_x(w) + s + 1 : runge_kutta_error(w);
    if (!unit) return;
    coef *b = unit + tableau_b(w), *bb = unit + tableau_bb(w);
    for (int i = 0; i < w->plains; i++) unit[i] = 0;
    for (int i = 0; i < s; i++) {
        c[i] = m->tableau.c[i];
        b[i] = m->tableau.b[i];
        for (int j = 0; j < i && m->tableau.a; j++) unit[tableau_a(w, i) + j] = m->tableau.a[i * (i - 1) / 2 + j];
        for (int j = 0; j < i && m->tableau.aa; j++) unit[tableau_aa(w, i) + j] = m->tableau.aa[i * (i - 1) / 2 + j];
        if (m->tableau.bb) bb[i] = m->tableau.bb[i];
    }
    for (int i = 1; i < s; i++) {
        if (m->tableau.a) runge_kutta_complete(pair_of(c[i]), unit + tableau_a(w, i), i);
        if (m->tableau.aa) runge_kutta_complete(pair_exact_product(c[i], c[i] / 2), unit + tableau_aa(w, i), i);
    }
    for (int j = 0; j < s; j++) {
        for (int i = 0; i < s && !m->tableau.aa; i++)
            unit[tableau_aa(w, i) + j] = runge_kutta_product(s, unit + tableau_a(w, i), unit, j, pair_of(0));
        if (!m->tableau.bb) bb[j] = runge_kutta_product(s, b, unit, j, pair_of(0));
    }
    unit[runge_kutta_residual(w)] = runge_kutta_missing(pair_of(1), b, s);
    unit[runge_kutta_residual(w) + 1] = runge_kutta_missing(pair_of(K(0.5)), bb, s);
    if (!m->adaptive) return;
    runge_kutta_weights(w, m->tableau.error, m->tableau.error_x, unit, runge_kutta_error(w), runge_kutta_error_x(w));
    if (m->tableau.second)
        runge_kutta_weights(w, m->tableau.second, NULL, unit, runge_kutta_second(w), runge_kutta_second_x(w));
}
#endif

#ifdef TRACING
#define runge_kutta_room tableau_room
static void runge_kutta_trace(work *w, int i)
{
    if (i < 0) return;
    real *V = w->vs;
    if (i == 0)
        EACHV(k) V[k] = w->v[k];
    else
        runge_kutta_velocity(w, i, V);
    tableau_tell(w, i, i ? w->xs : w->x, V, w->ks + (size_t)i * w->stride);
}
#endif
