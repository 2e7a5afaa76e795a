/* THE LOOP: steps by family, time, the finite numbers, and the look at a trajectory from the side.
 *
 * Invariant: the loop owns time, t0 + n h, never summed. advance_sync leaves the main line as it was; what it had to evaluate
 * is kept and counted when the method comes to use it.
 */
static inline int advance_step(work *w)
{
    switch (w->row->family) {
    case SPLITTING: return splitting_step(w);
    case RUNGE_KUTTA: return runge_kutta_step(w);
    case TWO_STEP:
        return w->row->two_step == VERLET ? verlet_step(w) : w->row->two_step == BEEMAN ? beeman_step(w) : literal_step(w);
    case IMPLICIT: return implicit_step(w);
    default: return STEP_OK;                   /* EXACT: nothing is carried from step to step */
    }
}

/* Whether the main line is finite; of a small system in as few operations as may be. */
static inline bool advance_finite(const work *w)
{
    const real *restrict x = w->x, *restrict v = w->row->two_step == VERLET_LITERAL ? w->x : w->v;
    if (SMALL) {
        real none = 0;
        EACH(k) none += x[k] - x[k];
        EACHV(k) none += v[k] - v[k];
        return none == 0;
    }
    int bad = 0;
    EACH(k) bad |= !FINITE(x[k]);
    EACHV(k) bad |= !FINITE(v[k]);
    return !bad;
}

/* STEP_DIVERGED where the main line holds an infinity or a NaN; w->which, w->in_v say where. */
static int advance_check(work *w)
{
    const real *restrict x = w->x, *restrict v = w->row->two_step == VERLET_LITERAL ? w->x : w->v;
    if (advance_finite(w)) return STEP_OK;
    w->in_v = false;
    EACH(k) if (!FINITE(x[k])) {
        w->which = k;
        return STEP_DIVERGED;
    }
    w->in_v = true;
    EACHV(k) if (!FINITE(v[k])) {
        w->which = k;
        break;
    }
    return STEP_DIVERGED;
}

/* `steps` more; stops in the middle of a step that fails. n counts the steps that were finished. */
static int advance_run(work *w, whole steps)
{
    for (; steps > 0; steps--) {
        KNOWN(w);
        int bad = advance_step(w);
        KNOWN(w);
        if (bad) return bad;
        w->n++;
        if (w->check && !advance_finite(w)) return advance_check(w);
    }
    return STEP_OK;
}

/* What the present state needs before it can be looked at; fills a (and delta, or next). */
static int advance_look(work *w)
{
    const row *m = w->row;
    bool waits = m->family == TWO_STEP || (m->family == SPLITTING && w->merged);
    if (!waits || w->fresh) return STEP_OK;
    whole evaluations = w->evaluations, iterations = w->iterations;
    int bad = m->family == SPLITTING ? splitting_look(w)
            : m->two_step == VERLET ? verlet_look(w)
            : m->two_step == BEEMAN ? beeman_look(w) : literal_look(w);
    w->owed_evaluations = w->evaluations - evaluations;
    w->owed_iterations = w->iterations - iterations;
    w->evaluations = evaluations;
    w->iterations = iterations;
    w->fresh = !bad;
    return bad;
}

/* The exact motion: where the acceleration is constant, by the formula of free fall from the start; else the model's own. */
static int advance_exact(work *w, real *x, real *v)
{
    clock t = time_of(w, w->n), tau = (clock)w->n * w->h;
    if (!w->constant) return exact_at(w, t, x, v);
    whole evaluations = w->evaluations;
    int bad = accel(w, w->t0, w->x, w->v, w->a);
    w->evaluations = evaluations;
    if (bad) return bad;
    EACH(k) x[k] = FMA(tau, FMA(tau / 2, w->a[k], w->v[k]), w->x[k]);
    EACHV(k) v[k] = FMA(tau, w->a[k], w->v[k]);
    return STEP_OK;
}

/* The state at the present time; a may be NULL. */
static int advance_sync(work *w, real *x, real *v, real *a)
{
    const row *m = w->row;
    clock t = time_of(w, w->n);
    int bad = advance_look(w);
    if (bad) return bad;
    if (m->family == EXACT) {
        if ((bad = advance_exact(w, x, v))) return bad;
    } else {
        EACH(k) x[k] = w->x[k];
        if (m->family == SPLITTING) splitting_sync(w, v);
        else if (m->family != TWO_STEP) EACHV(k) v[k] = w->v[k];
        else if (m->two_step == VERLET) verlet_sync(w, v);
        else if (m->two_step == BEEMAN) beeman_sync(w, v);
        else literal_sync(w, v);
    }
    refresh_at(w, t, x, v);
    if (!a) return STEP_OK;
    if (w->fresh && !w->velocity) {
        EACHV(k) a[k] = w->a[k];
        return STEP_OK;
    }
    whole evaluations = w->evaluations;
    bad = accel(w, t, x, v, a);
    w->evaluations = evaluations;
    return bad;
}
