/* RUNGE-KUTTA, explicit: X[i] = x + h Σ a[i][j] V[j], V[i] = v + h Σ a[i][j] K[j], K[i] = a(X[i], V[i], t + c[i] h)
 * [HNW93, II.1].
 *
 * Invariant: the sum over stages, of small numbers, is formed first and added to the state once.
 */
static int runge_kutta_step(work *w)
{
    const size_t stride = w->stride;
    const int s = FACT(w, stages), b = tableau_b(w);
    real *restrict x = w->x, *restrict v = w->v, *restrict ex = w->ex, *restrict ev = w->ev;
    real *restrict X = w->xs, *restrict V = w->vs, *restrict K = w->ks;
    EACH_STAGE(i, s) {
        const int a = tableau_a(w, i);
        real *Vi = V + (size_t)i * stride, *Ki = K + (size_t)i * stride;
        if (i == 0) {
            EACH(k) X[k] = x[k];
            EACHV(k) Vi[k] = v[k];
        } else {
            EACH(k) X[k] = x[k] + tableau_sum(w, a, true, V, k, i);
            EACHV(k) Vi[k] = v[k] + tableau_sum(w, a, true, K, k, i);
        }
        int bad = accel_in(w, i, X, Vi, Ki);
        if (bad) return bad;
        TRACE(w, i);
    }
    if (ROW(w, compensated)) {
        EACH(k) ADVANCE_COMPENSATED(x[k], ex[k], 1, tableau_sum(w, b, true, V, k, s));
        EACHV(k) ADVANCE_COMPENSATED(v[k], ev[k], 1, tableau_sum(w, b, true, K, k, s));
    } else {
        EACH(k) x[k] += tableau_sum(w, b, true, V, k, s);
        EACHV(k) v[k] += tableau_sum(w, b, true, K, k, s);
    }
    return STEP_OK;
}
#define runge_kutta_accept step_is_final
#define runge_kutta_observe state_is_complete
#define runge_kutta_sync work_sync_main
#define runge_kutta_carry work_carry_main
#define runge_kutta_dense dense_hermite

static inline void runge_kutta_place(work *w, placing *p)
{
    w->xs = work_array(p, 1);
    w->vs = work_array(p, FACT(w, stages));
    w->ks = work_array(p, FACT(w, stages));
}

#ifdef ROWS
static void runge_kutta_plan(work *w, const double argument[2], coef *unit, coef *c)
{
    const row *m = w->row;
    (void)argument;
    tableau_sizes(w, m->tableau.stages);
    if (!unit) return;
    for (int i = 0; i < w->stages; i++) c[i] = m->tableau.c[i];
    tableau_fill(w, m->tableau.a, m->tableau.b, unit);
}
#endif

#ifdef TRACING
#define runge_kutta_room tableau_room
static void runge_kutta_trace(work *w, int i)
{
    if (i < 0) return;
    const size_t stage = (size_t)i * w->stride;
    tableau_tell(w, i, w->xs, w->vs + stage, w->ks + stage);
}
#endif
