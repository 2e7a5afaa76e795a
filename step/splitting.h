/* SPLITTING: every method of kicks v += b h a(x, t) and drifts x += c h v, once [HLW06, II.5].
 *
 * Invariant: a row that begins and ends with a kick keeps its closing kick waiting: `v` lacks it until the next step, which merges it
 * with its opening kick (the same acceleration), and splitting_sync forms it on the side. So looking changes no bit.
 */

/* Operators: a machine may bring its own, fused or tiled. */
#ifndef KICK
#define KICK splitting_kick
#define DRIFT splitting_drift
#define KICK_DRIFT splitting_kick_drift

static inline void splitting_kick(work *w, clock b)
{
    real *restrict v = w->v, *restrict ev = w->ev;
    const real *restrict a = w->a;
    if (ROW(w, compensated)) EACHV(k) ADVANCE_EXACTLY(v[k], ev[k], b, a[k]);
    else EACHV(k) ADVANCE(v[k], b, a[k]);
}

static inline void splitting_drift(work *w, clock c)
{
    real *restrict x = w->x, *restrict ex = w->ex;
    const real *restrict v = w->v;
    if (ROW(w, compensated)) EACH(k) ADVANCE_EXACTLY(x[k], ex[k], c, v[k]);
    else EACH(k) ADVANCE(x[k], c, v[k]);
}

/* Both in one pass over memory; companions (k >= nx) have no position to move. */
static inline void splitting_kick_drift(work *w, clock b, clock c)
{
    real *restrict x = w->x, *restrict v = w->v;
    const real *restrict a = w->a;
    if (ROW(w, compensated) || FACT(w, nv) > FACT(w, nx)) {
        splitting_kick(w, b);
        splitting_drift(w, c);
        return;
    }
    EACH(k) {
        ADVANCE(v[k], b, a[k]);
        ADVANCE(x[k], c, v[k]);
    }
}
#endif

/* v += b a(x, (v + v')/2, t), v' the velocity after the kick: for a = E + v × B this is Boris' method, whose rotation is the Cayley form
 * of exp(h B×), written as the one linear system that it solves [Boris70; Qin13]. */
static int splitting_turn(work *w, clock b, clock t)
{
    int bad = increment(w, b, 1, w->v, t);
    if (bad) return bad;
    EACHV(k) w->v[k] += w->delta[k];
    return STEP_OK;
}

/* A machine may have its own PASS(w, i, b, c), acceleration, kick b and drift c of stage i in one pass over memory; PASSED(w, i): it made the drift
 * of stage i, the first of this step, too. */
#ifndef PASS
#define PASSED(w, i) false
#endif

static int splitting_step(work *w)
{
    EACH_STAGE(i, FACT(w, merged) ? FACT(w, stages) - 1 : FACT(w, stages)) {
        int bad = STEP_OK;
        if (!(FACT(w, kicks) >> i & 1)) {
            if (!PASSED(w, i)) DRIFT(w, w->drift[i]);
        } else if (ROW(w, gyroscopic)) {
            bad = splitting_turn(w, w->kick[i], time_in(w, FACT(w, c)[i]));
            DRIFT(w, w->drift[i]);
        } else {
            bool known = i == 0 && work_reuse(w);
            clock b = i == 0 && FACT(w, merged) && w->n > 0 ? w->joint : w->kick[i];
#ifdef PASS
            if (!known && (FACT(w, drifts) >> i & 1)) {
                PASS(w, i, b, w->drift[i]);
                TRACE(w, i);
                continue;
            }
#endif
            if (!known) bad = accel_in(w, i, w->x, w->v, w->a);
            if (bad) return bad;
            if (!(FACT(w, drifts) >> i & 1)) KICK(w, b);
            else KICK_DRIFT(w, b, w->drift[i]);
        }
        if (bad) return bad;
        TRACE(w, i);
    }
    return STEP_OK;
}

/* The acceleration that the next step begins with; known beforehand to work_reuse. */
static int splitting_look(work *w) { return accel_now(w, w->x, w->v, w->a); }

static void splitting_sync(const work *w, real *v)
{
    bool waiting = FACT(w, merged) && w->n > 0;
    if (waiting && ROW(w, compensated)) EACHV(k) v[k] = w->v[k] + FMA(w->closing, w->a[k], w->ev[k]);
    else if (waiting) EACHV(k) v[k] = FMA(w->closing, w->a[k], w->v[k]);
    else EACHV(k) v[k] = w->v[k];
}
