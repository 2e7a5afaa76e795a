/* OBSERVING a trajectory: its state at the present time, whatever form the method carries it in.
 *
 * Invariant: observing leaves the main line as it was; what had to be evaluated is kept, and counted when the method
 * comes to use it.
 */

/* Evaluates what the present state needs before it can be read: fills a (and delta, or next_x). */
static int advance_observe(work *w)
{
    if (!FACT(w, waits) || w->fresh) return STEP_OK;
    const whole evaluations = w->evaluations, iterations = w->iterations;
    int bad = family_observe(w);
    w->owed_evaluations = w->evaluations - evaluations;
    w->owed_iterations = w->iterations - iterations;
    w->evaluations = evaluations;
    w->iterations = iterations;
    w->fresh = !bad;
    return bad;
}

/* The state at the present time; a may be NULL. */
static int advance_sync(work *w, real *x, real *v, real *a)
{
    const clock t = time_now(w);
    int bad = advance_observe(w);
    if (!bad) bad = family_sync(w, x, v);
    if (bad) return bad;
    refresh_at(w, t, x, v);
    if (!a) return STEP_OK;
    if (w->fresh && !FACT(w, velocity)) {
        EACHV(k) a[k] = w->a[k];
        return STEP_OK;
    }
    const whole evaluations = w->evaluations;
    bad = accel(w, t, x, v, a);
    w->evaluations = evaluations;
    return bad;
}
