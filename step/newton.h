/* NEWTON'S METHOD for implicit kicks and implicit stages, and the implicit kick itself.
 *
 * Invariant: an equation is solved to round-off or reported. The iteration ends when the next correction would be lost beside the numbers that it
 * goes to, or when the corrections no longer shrink at a size that rounding alone explains.
 */
enum { NEWTON_GO_ON, NEWTON_DONE, NEWTON_STUCK, NEWTON_LOST, NEWTON_MAX = 100 };

/* Judges the correction r of `value` (`count` vectors each), an increment to `unit` times `base`. *before: the last judgement; start
 * with a negative number. */
static int newton_judge(work *w, const real *r, const real *value, int count, const real *base, clock unit, clock *before)
{
    real largest = 0, worst = 0;
    w->in_v = true;
    for (int i = 0; i < count; i++) {
        const real *value_i = value + (size_t)i * w->stride, *r_i = r + (size_t)i * w->stride;
        EACHV(k) {
            real size = ABS(value_i[k]) + ABS(unit * base[k]);
            if (size > largest) largest = size;
            if (FINITE(r_i[k])) continue;
            w->which = k;
            return NEWTON_LOST;
        }
    }
    for (int i = 0; i < count; i++) {
        const real *value_i = value + (size_t)i * w->stride, *r_i = r + (size_t)i * w->stride;
        EACHV(k) {
            if (r_i[k] == 0) continue;
            real share = ABS(r_i[k]) / (ABS(value_i[k]) + ABS(unit * base[k]) + SQRT_EPSILON * largest);
            if (share > worst) worst = share, w->which = k;
        }
    }
    clock last = *before;
    *before = worst;
    if (worst == 0) return NEWTON_DONE;
    if (last < 0) return NEWTON_GO_ON;
    if (worst < last && worst * (worst / last) < EPSILON / 64) return NEWTON_DONE;     /* so small would the next one be */
    if (worst < last) return NEWTON_GO_ON;
    return worst < SQRT_EPSILON ? NEWTON_DONE : NEWTON_STUCK;
}

/* w->delta solves delta = g a(x, s (u + delta/2), t). Where a is linear in v that is one evaluation and one linear system,
 * (I - (g s/2) da/dv) delta = g a(x, s u, t); else Newton's method with that matrix at every iterate. */
static int newton_increment(work *w, clock g, clock s, const real *u, clock t)
{
    real *restrict delta = w->delta, *restrict r = w->r, *restrict V = w->vs;
    const clock none = 0, slope = g * s / 2;
    clock before = -1;
    EACHV(k) delta[k] = 0;
    for (int i = 0; i < NEWTON_MAX; i++) {
        EACHV(k) V[k] = s * FMA((clock)0.5, delta[k], u[k]);
        int bad = accel(w, t, w->x, V, w->a);
        if (bad) return bad;
        EACHV(k) r[k] = FMA(g, w->a[k], -delta[k]);
        bad = solve_factor(w, 1, &none, &slope, t, w->x, V);
        if (bad) return bad;
        solve_back(w, r);
        EACHV(k) delta[k] += r[k];
        if (FACT(w, linear)) return STEP_OK;
        w->iterations++;
        switch (newton_judge(w, r, delta, 1, u, 1, &before)) {
        case NEWTON_DONE: return STEP_OK;
        case NEWTON_LOST: return i == 0 ? STEP_DIVERGED : STEP_SOLVE;
        default: break;                        /* far from the solution a full step may well grow once or twice */
        }
    }
    return STEP_SOLVE;
}
