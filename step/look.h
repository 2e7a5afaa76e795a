/* THE LOOK at a trajectory from the side: its state at the present time, whatever form the method carries it in.
 *
 * Invariant: advance_sync leaves the main line as it was; what it had to evaluate is kept and counted when the method comes to use it.
 */

/* What the present state needs before it can be looked at; fills a (and delta, or next). */
static int advance_look(work *w)
{
    bool waits = ROW(w, family) == TWO_STEP || (ROW(w, family) == SPLITTING && w->merged);
    if (!waits || w->fresh) return STEP_OK;
    whole evaluations = w->evaluations, iterations = w->iterations;
    int bad = ROW(w, family) == SPLITTING ? splitting_look(w)
            : ROW(w, two_step) == VERLET ? verlet_look(w)
            : ROW(w, two_step) == BEEMAN ? beeman_look(w) : literal_look(w);
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
    if (!FACT(w, constant)) return exact_at(w, t, x, v);
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
    clock t = time_of(w, w->n);
    int bad = advance_look(w);
    if (bad) return bad;
    if (ROW(w, family) == EXACT) {
        if ((bad = advance_exact(w, x, v))) return bad;
    } else {
        EACH(k) x[k] = w->x[k];
        if (ROW(w, family) == SPLITTING) splitting_sync(w, v);
        else if (ROW(w, family) != TWO_STEP) EACHV(k) v[k] = w->v[k];
        else if (ROW(w, two_step) == VERLET) verlet_sync(w, v);
        else if (ROW(w, two_step) == BEEMAN) beeman_sync(w, v);
        else literal_sync(w, v);
    }
    refresh_at(w, t, x, v);
    if (!a) return STEP_OK;
    if (w->fresh && !FACT(w, velocity)) {
        EACHV(k) a[k] = w->a[k];
        return STEP_OK;
    }
    whole evaluations = w->evaluations;
    bad = accel(w, t, x, v, a);
    w->evaluations = evaluations;
    return bad;
}
