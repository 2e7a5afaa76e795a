/* RUNGE-KUTTA, explicit: X[i] = x + h Σ a[i][j] V[j], V[i] = v + h Σ a[i][j] K[j], K[i] = a(X[i], V[i], t + c[i] h) [HNW93, II.1].
 *
 * Invariant: sums of increments are formed first, the smallest numbers among themselves, and added to the state once.
 */
#define ALL_TERMS (~0u)
static inline real runge_kutta_sum(const clock *c, unsigned terms, const real *restrict y, size_t stride, size_t k, int count)
{
    real sum = {0};
    bool first = true;
    EACH_STAGE(j, count) {
        if (!(terms >> j & 1)) continue;
        real term = y[(size_t)j * stride + k];
        if (first) sum = c[j] * term;
        else sum = FMA(c[j], term, sum);
        first = false;
    }
    return sum;
}

static int runge_kutta_step(work *w)
{
    size_t stride = w->stride;
    real *restrict x = w->x, *restrict v = w->v, *restrict ex = w->ex, *restrict ev = w->ev;
    real *restrict X = w->xs, *restrict V = w->vs, *restrict A = w->ks;
    EACH_STAGE(i, FACT(w, stages)) {
        real *Vi = V + (size_t)i * stride;
        if (i == 0) {
            EACH(k) X[k] = x[k];
            EACHV(k) Vi[k] = v[k];
        } else {
            EACH(k) X[k] = x[k] + runge_kutta_sum(w->ha[i], FACT(w, terms)[i], V, stride, k, i);
            EACHV(k) Vi[k] = v[k] + runge_kutta_sum(w->ha[i], FACT(w, terms)[i], A, stride, k, i);
        }
        int bad = accel_in(w, i, X, Vi, A + (size_t)i * stride);
        if (bad) return bad;
        TRACE(w, i);
    }
    if (ROW(w, compensated)) {
        EACH(k) ADVANCE_EXACTLY(x[k], ex[k], 1, runge_kutta_sum(w->hb, FACT(w, weights), V, stride, k, FACT(w, stages)));
        EACHV(k) ADVANCE_EXACTLY(v[k], ev[k], 1, runge_kutta_sum(w->hb, FACT(w, weights), A, stride, k, FACT(w, stages)));
    } else {
        EACH(k) x[k] += runge_kutta_sum(w->hb, FACT(w, weights), V, stride, k, FACT(w, stages));
        EACHV(k) v[k] += runge_kutta_sum(w->hb, FACT(w, weights), A, stride, k, FACT(w, stages));
    }
    return STEP_OK;
}
