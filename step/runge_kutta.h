/* RUNGE-KUTTA, explicit: X[i] = x + h Σ a[i][j] V[j], V[i] = v + h Σ a[i][j] K[j], K[i] = a(X[i], V[i], t + c[i] h) [HNW93, II.1].
 *
 * Invariant: sums of increments are formed first, the smallest numbers among themselves, and added to the state once.
 */
static inline real runge_kutta_sum(const clock *c, const real *restrict y, size_t stride, size_t k, int terms)
{
    real sum = c[0] * y[k];
    for (int j = 1; j < terms; j++) sum = FMA(c[j], y[(size_t)j * stride + k], sum);
    return sum;
}

static int runge_kutta_step(work *w)
{
    size_t stride = w->stride;
    real *restrict x = w->x, *restrict v = w->v, *restrict ex = w->ex, *restrict ev = w->ev;
    real *restrict X = w->xs, *restrict V = w->vs, *restrict A = w->ks;
    for (int i = 0; i < w->stages; i++) {
        real *Vi = V + (size_t)i * stride;
        if (i == 0) {
            EACH(k) X[k] = x[k];
            EACHV(k) Vi[k] = v[k];
        } else {
            EACH(k) X[k] = x[k] + runge_kutta_sum(w->ha[i], V, stride, k, i);
            EACHV(k) Vi[k] = v[k] + runge_kutta_sum(w->ha[i], A, stride, k, i);
        }
        int bad = accel(w, time_in(w, w->c[i]), X, Vi, A + (size_t)i * stride);
        if (bad) return bad;
        TRACE(w, i);
    }
    if (ROW(w, compensated)) {
        EACH(k) ADVANCE_EXACTLY(x[k], ex[k], 1, runge_kutta_sum(w->hb, V, stride, k, w->stages));
        EACHV(k) ADVANCE_EXACTLY(v[k], ev[k], 1, runge_kutta_sum(w->hb, A, stride, k, w->stages));
    } else {
        EACH(k) x[k] += runge_kutta_sum(w->hb, V, stride, k, w->stages);
        EACHV(k) v[k] += runge_kutta_sum(w->hb, A, stride, k, w->stages);
    }
    return STEP_OK;
}
