/* NEWTON'S METHOD for implicit kicks and implicit stages, and the implicit kick itself.
 *
 * Invariant: an equation is solved to round-off or reported. The iteration ends when the next correction would be
 * lost beside the numbers that it goes to, or when the corrections no longer shrink at a size that rounding alone
 * explains. Of lanes, those whose equation is solved keep their values while the others go on, so each makes the
 * iterations that it would make alone.
 */
enum { NEWTON_MAX = 100 };

/* The verdict on a correction; where no member holds, the iteration goes on. */
typedef struct newton_verdict {
    mask done, stuck, lost;
} newton_verdict;

/* Judges the correction r of `value` (`count` vectors each), which will be added to `unit` times `base`. *before: the
 * size of the previous correction; start with a negative number. */
static inline newton_verdict newton_judge(work *w, const real *r, const real *value, int count, const real *base,
                                          clock unit, real *before)
{
    real largest = {0}, worst = {0};
    mask lost = NEVER;
    w->in_v = true;
    for (int i = 0; i < count; i++) {
        const real *value_i = value + (size_t)i * w->stride, *r_i = r + (size_t)i * w->stride;
        EACHV(k) {
            const real size = ABS(value_i[k]) + ABS(unit * base[k]);
            const mask bad = NOT(FINITE(r_i[k]));
            largest = LARGER(size, largest);
            BLAME(w, bad & NOT(lost), k);
            lost = lost | bad;
        }
    }
    for (int i = 0; i < count; i++) {
        const real *value_i = value + (size_t)i * w->stride, *r_i = r + (size_t)i * w->stride;
        EACHV(k) { /* 0/0 is no larger than anything */
            const real share = ABS(r_i[k]) / (ABS(value_i[k]) + ABS(unit * base[k]) + SQRT_EPSILON * largest);
            BLAME(w, (share > worst) & NOT(lost), k);
            worst = LARGER(share, worst);
        }
    }
    const real last = *before;
    newton_verdict verdict = {.lost = lost, .done = NOT(lost) & (worst == 0), .stuck = NEVER};
    *before = worst;
    const mask second = last >= 0; /* the first correction has none before it to be compared with */
    if (!SOME(second)) return verdict;
    const mask shrinks = worst < last;
    const mask small = (shrinks & (worst * (worst / last) < EPSILON / 64)) | (NOT(shrinks) & (worst < SQRT_EPSILON));
    verdict.done = NOT(lost) & ((worst == 0) | (second & small));
    verdict.stuck = NOT(lost) & NOT(verdict.done) & second & NOT(shrinks);
    return verdict;
}

/* y += r where the equation is open. In the common case it is open in all lanes, and no lane needs a choice. */
static inline void newton_correct(const work *w, mask open, real *restrict y, const real *restrict r)
{
    if (!SOME(NOT(open)))
        EACHV(k) y[k] += r[k];
    else
        EACHV(k) y[k] = PICK(open, y[k] + r[k], y[k]);
}

/* w->delta solves delta = g a(x, s (u + delta/2), t), at the time of stage `stage`, or of the present step:
 * NEWTON_NOW. Where a is linear in v that is one evaluation and one linear system, (I - (g s/2) da/dv) delta = g
 * a(x, s u, t); else Newton's method with that matrix at every iterate. */
enum { NEWTON_NOW = -1 };
static inline int newton_increment(work *w, clock g, clock s, real *x, const real *u, int stage)
{
    real *restrict delta = w->delta, *restrict r = w->r, *restrict V = w->vs;
    const clock none = {0}, slope = g * s / 2, t = stage == NEWTON_NOW ? time_now(w) : time_in(w, FACT(w, c)[stage]);
    real before = (real){0} - 1;
    mask open = ALWAYS;
    EACHV(k) delta[k] = (real){0};
    for (int i = 0; i < NEWTON_MAX && SOME(open); i++) {
        EACHV(k) V[k] = s * FMA(0.5, delta[k], u[k]);
        int bad = stage == NEWTON_NOW ? accel_now(w, x, V, w->a) : accel_in(w, stage, x, V, w->a);
        if (bad) return bad;
        EACHV(k) r[k] = FMA(g, w->a[k], -delta[k]);
        bad = solve_factor(w, &open, 1, &none, &slope, t, x, V);
        if (bad) return bad;
        solve_back(w, r);
        if (FACT(w, linear)) {
            EACHV(k) delta[k] += r[k];
            return STEP_OK;
        }
        newton_correct(w, open, delta, r);
        w->iterations++;
        const newton_verdict now = newton_judge(w, r, delta, 1, u, CLOCK(1), &before);
        STOP(w, open & now.lost, i == 0 ? STEP_DIVERGED : STEP_SOLVE);
        open = open & NOT(now.lost | now.done); /* far from the solution a full step may well grow once or twice */
    }
    STOP(w, open, STEP_SOLVE);
    SPOIL(w, delta);
    return STEP_OK;
}
