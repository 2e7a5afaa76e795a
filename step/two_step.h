/* TWO-STEP: Störmer's recurrence x[n+1] - 2 x[n] + x[n-1] = h² a [HLW03], in summed form, as it stands, and Beeman's form.
 *
 * Invariant: velocities are formed at the time of the positions, v[n] = (x[n+1] - x[n-1])/2h, whatever the force depends on.
 * Companions ride along as velocities without a position: d/h is their value half a step later.
 */

/* Verlet, summed. At n = 0 `v` is the velocity, after that d = x[n] - x[n-1], so nothing is lost to round-off at small steps:
 * d += h² a; x += d. The start is Taylor's, d = h v + h²/2 a. A force that depends on v is taken at the central difference
 * (d + delta/2)/h, delta being the increment of d that it causes. */
static int verlet_look(work *w)
{
    if (w->n == 0 || !FACT(w, velocity)) return accel_now(w, w->x, w->n == 0 ? w->v : w->vs, w->a);
    return increment(w, w->hh, w->per_h, w->v, time_of(w, w->n));
}

static int verlet_step(work *w)
{
    real *restrict x = w->x, *restrict d = w->v;
    const real *restrict a = w->a;
    clock hh = w->hh;
    bool known = work_reuse(w);
#ifdef PASS                                    /* as in splitting.h: d += h² a, x += 1 d */
    if (!known && w->n > 0) {
        PASS(w, 0, hh, 1);
        TRACE(w, 0);
        return STEP_OK;
    }
#endif
    if (!known) {
        int bad = verlet_look(w);
        if (bad) return bad;
    }
    if (w->n == 0) EACHV(k) d[k] = FMA(w->half_hh, a[k], w->h * d[k]);
    else if (FACT(w, velocity)) EACHV(k) d[k] += w->delta[k];
    else if (FACT(w, nv) > FACT(w, nx)) EACHV(k) ADVANCE(d[k], hh, a[k]);
    else {                                     /* the common case in one pass over memory */
        EACH(k) {
            ADVANCE(d[k], hh, a[k]);
            x[k] += d[k];
        }
        TRACE(w, 0);
        return STEP_OK;
    }
    EACH(k) x[k] += d[k];
    TRACE(w, 0);
    return STEP_OK;
}

static void verlet_sync(const work *w, real *v)
{
    const real *d = w->v;
    if (w->n == 0) EACHV(k) v[k] = d[k];
    else if (FACT(w, velocity)) EACHV(k) v[k] = FMA((clock)0.5, w->delta[k], d[k]) * w->per_h;
    else EACHV(k) v[k] = FMA(w->half_hh, w->a[k], d[k]) * w->per_h;
}

/* Verlet, literally: x[n+1] = 2 x[n] - x[n-1] + h² a with plain products and sums, and where a = g + j v its quotient form
 * x[n+1] = (2 x[n] - (1 + h j/2) x[n-1] + h² g)/(1 - h j/2). Companions are carried as integrals that start at 0. */
static int literal_look(work *w)
{
    real *restrict next = w->next;
    const real *x = w->x, *old = w->old;
    clock t = time_of(w, w->n), h = w->h, hh = w->hh;
    const clock none = 0, slope = h / 2;
    int bad = STEP_OK;
    if (w->n == 0) {
        bad = accel_now(w, w->x, w->v, w->a);
        if (!bad) EACHV(k) next[k] = x[k] + h * w->v[k] + w->half_hh * w->a[k];
    } else if (!FACT(w, velocity)) {
        bad = accel_now(w, w->x, w->vs, w->a);
        if (!bad) EACHV(k) next[k] = 2 * x[k] - old[k] + hh * w->a[k];
    } else if (FACT(w, linear)) {
        EACHV(k) w->vs[k] = (real){0};
        bad = accel_now(w, w->x, w->vs, w->a);
        if (!bad) bad = solve_factor(w, 1, &none, &slope, t, w->x, w->vs);
        if (bad) return bad;
        solve_apply(w, slope, old, w->r);
        EACHV(k) next[k] = 2 * x[k] - w->r[k] + hh * w->a[k];
        solve_back(w, next);
    } else {
        EACHV(k) next[k] = x[k] - old[k];
        bad = increment(w, hh, w->per_h, next, t);
        if (!bad) EACHV(k) next[k] = 2 * x[k] - old[k] + w->delta[k];
    }
    return bad;
}

static int literal_step(work *w)
{
    if (!work_reuse(w)) {
        int bad = literal_look(w);
        if (bad) return bad;
    }
    if (SMALL) {
        EACHV(k) w->old[k] = w->x[k];
        EACHV(k) w->x[k] = w->next[k];
    } else {
        real *gone = w->old;
        w->old = w->x;
        w->x = w->next;
        w->next = gone;
    }
    TRACE(w, 0);
    return STEP_OK;
}

static void literal_sync(const work *w, real *v)
{
    if (w->n == 0) EACHV(k) v[k] = w->v[k];
    else EACHV(k) v[k] = (w->next[k] - w->old[k]) / (2 * w->h);
}

/* Beeman: x[n+1] = x + h v + h²/6 (4 a[n] - a[n-1]), v[n+1] = v + h/6 (2 a[n+1] + 5 a[n] - a[n-1]), a[-1] = a[0] [Beeman76]. `v` waits for
 * the term h/3 a[n+1] until that acceleration is needed for the positions. */
static int beeman_look(work *w) { return accel_now(w, w->x, w->vs, w->a); }

static int beeman_step(work *w)
{
    real *restrict x = w->x, *restrict v = w->v, *restrict a = w->a, *restrict old = w->old;
    clock h = w->h, third = h / 3, sixth = h / 6, hh_sixth = w->hh / 6;
    if (!work_reuse(w)) {
        int bad = beeman_look(w);
        if (bad) return bad;
    }
    if (w->n == 0) EACHV(k) old[k] = a[k];
    else EACHV(k) ADVANCE(v[k], third, a[k]);
    EACH(k) x[k] += FMA(h, v[k], hh_sixth * FMA((clock)4, a[k], -old[k]));
    EACHV(k) ADVANCE(v[k], sixth, FMA((clock)5, a[k], -old[k]));
    if (SMALL) {
        EACHV(k) old[k] = a[k];
    } else {
        w->a = old;
        w->old = a;
    }
    TRACE(w, 0);
    return STEP_OK;
}

static void beeman_sync(const work *w, real *v)
{
    clock third = w->h / 3;
    if (w->n == 0) EACHV(k) v[k] = w->v[k];
    else EACHV(k) v[k] = FMA(third, w->a[k], w->v[k]);
}
