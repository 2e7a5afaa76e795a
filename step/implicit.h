/* IMPLICIT: stages K[i] = a(X[i], V[i], t + c[i] h), X[i] = x + c[i] h v + h² Σ aa[i][j] K[j], V[i] = v + h Σ a[i][j] K[j]: collocation at the
 * Gauss nodes, and Newmark, whose one implicit stage is the end of the step [HLW06, II.1; Newmark59].
 *
 * Invariant: the unknowns are the stages' accelerations, so round-off in solving reaches the state multiplied by h; they are iterated
 * until they stand still. Simplified Newton: one matrix a step, taken in the middle of the stages, renewed where it does not contract.
 */
static void implicit_stage(work *w, int i)
{
    real *restrict X = w->xs, *restrict V = w->vs;
    const real *restrict x = w->x, *restrict v = w->v, *restrict A = w->ks;
    clock ch = w->c[i] * w->h;
    EACH(k) X[k] = x[k] + FMA(ch, v[k], runge_kutta_sum(w->hha[i], ALL_TERMS, A, w->stride, k, FACT(w, stages)));
    EACHV(k) V[k] = v[k] + runge_kutta_sum(w->ha[i], ALL_TERMS, A, w->stride, k, FACT(w, stages));
}

/* The matrix at the mean of the unknown stages, as far as they are known: by Taylor's formula before the first iteration. */
static int implicit_matrix(work *w)
{
    int first = FACT(w, known), s = FACT(w, stages) - first;
    clock ax[STAGES_MAX * STAGES_MAX], av[STAGES_MAX * STAGES_MAX], c = 0;
    for (int i = 0; i < s; i++) {
        c += w->c[first + i] / s;
        for (int j = 0; j < s; j++) {
            ax[i * s + j] = w->hha[first + i][first + j];
            av[i * s + j] = w->ha[first + i][first + j];
        }
    }
    clock ch = c * w->h;
    const real *K = w->ks + (size_t)first * w->stride;
    EACH(k) w->xs[k] = FMA(ch, FMA(ch / 2, K[k], w->v[k]), w->x[k]);
    EACHV(k) w->vs[k] = FMA(ch, K[k], w->v[k]);
    return solve_factor(w, s, ax, av, time_of(w, w->n) + ch, w->xs, w->vs);
}

static int implicit_iterate(work *w)
{
    enum { PATIENCE = 8, RENEWALS = 6 };
    int first = FACT(w, known), s = FACT(w, stages) - first, renewed = 0, bad = implicit_matrix(w);
    size_t stride = w->stride;
    real *K = w->ks + (size_t)first * stride;
    clock before = -1;
    for (int m = 0; m < NEWTON_MAX && !bad; m++) {
        for (int i = 0; i < s; i++) {
            real *r = w->r + (size_t)i * stride;
            implicit_stage(w, first + i);
            bad = accel_in(w, first + i, w->xs, w->vs, r);
            if (bad) return bad;
            EACHV(k) r[k] -= K[(size_t)i * stride + k];
        }
        solve_back(w, w->r);
        w->iterations++;
        for (int i = 0; i < s; i++) EACHV(k) K[(size_t)i * stride + k] += w->r[(size_t)i * stride + k];
        int judged = newton_judge(w, w->r, K, s, w->v, w->per_h, &before);
        if (judged == NEWTON_LOST) return m == 0 ? STEP_DIVERGED : STEP_SOLVE;
        if (judged == NEWTON_DONE || w->direct) return STEP_OK;
        bool slow = judged == NEWTON_STUCK || m % PATIENCE == PATIENCE - 1;
        if (slow && renewed++ < RENEWALS) bad = implicit_matrix(w);
        else if (judged == NEWTON_STUCK) return STEP_SOLVE;
    }
    return bad ? bad : STEP_SOLVE;
}

static int implicit_step(work *w)
{
    real *restrict x = w->x, *restrict v = w->v, *restrict ex = w->ex, *restrict ev = w->ev;
    const real *restrict A = w->ks;
    size_t stride = w->stride;
    clock h = w->h;
    int s = FACT(w, stages);
    if (!FACT(w, known) || w->n == 0) {              /* newmark's last stage is the next step's first */
        EACH(k) w->xs[k] = x[k];
        EACHV(k) w->vs[k] = v[k];
        int bad = accel_now(w, w->xs, w->vs, w->a);
        if (bad) return bad;
    }
    for (int i = 0; i < s; i++) EACHV(k) w->ks[(size_t)i * stride + k] = w->a[k];
    int bad = implicit_iterate(w);
    if (bad) return bad;
    TRACE(w, s - 1);
    if (ROW(w, compensated)) {
        EACH(k) ADVANCE_EXACTLY(x[k], ex[k], 1, FMA(h, v[k], runge_kutta_sum(w->hhb, ALL_TERMS, A, stride, k, s)));
        EACHV(k) ADVANCE_EXACTLY(v[k], ev[k], 1, runge_kutta_sum(w->hb, ALL_TERMS, A, stride, k, s));
    } else {
        EACH(k) x[k] += FMA(h, v[k], runge_kutta_sum(w->hhb, ALL_TERMS, A, stride, k, s));
        EACHV(k) v[k] += runge_kutta_sum(w->hb, ALL_TERMS, A, stride, k, s);
    }
    if (FACT(w, known)) EACHV(k) w->a[k] = A[(size_t)(s - 1) * stride + k];
    return STEP_OK;
}
