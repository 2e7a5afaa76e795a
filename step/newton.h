/* NEWTON'S METHOD for the implicit kick, to round-off: judge.h. */

/* w->delta solves delta = g a(x, s (u + delta/2), t), at the time of stage `stage`, or of the present step:
 * NEWTON_NOW. Where a is linear in v that is one evaluation and one linear system, (I - (g s/2) da/dv) delta = g
 * a(x, s u, t); else Newton's method with that matrix at every iterate. */
enum { NEWTON_NOW = -1 };
static inline int newton_increment(work *w, clock g, clock s, const real *u, int stage)
{
    real *restrict delta = w->delta, *restrict r = w->r, *restrict V = w->vs;
    const clock none = {0}, slope = g * s / 2, t = stage == NEWTON_NOW ? time_now(w) : time_in(w, FACT(w, c)[stage]);
    real before = (real){0} - 1;
    mask open = ALWAYS;
    EACHV(k) delta[k] = (real){0};
    for (int i = 0; i < JUDGE_TURNS_MAX && SOME(open); i++) {
        EACHV(k) V[k] = s * FMA(0.5, delta[k], u[k]);
        int bad = stage == NEWTON_NOW ? accel_now(w, w->x, V, w->a) : accel_in(w, stage, w->x, V, w->a);
        if (bad) return bad;
        EACHV(k) r[k] = FMA(g, w->a[k], -delta[k]);
        bad = solve_factor(w, &open, 1, &none, &slope, t, w->x, V);
        if (bad) return bad;
        solve_back(w, r);
        if (FACT(w, linear)) {
            EACHV(k) delta[k] += r[k];
            return STEP_OK;
        }
        judge_correct(w, open, delta, r);
        w->iterations++;
        const judge_verdict now = judge_corrections(w, r, delta, 1, u, CLOCK(1), &before);
        STOP(w, open & now.lost, i == 0 ? STEP_DIVERGED : STEP_SOLVE);
        open = open & NOT(now.lost | now.done); /* far from the solution a full step may well grow once or twice */
    }
    STOP(w, open, STEP_SOLVE);
    SPOIL(w, delta);
    return STEP_OK;
}
