/* THE LOOP: steps one after the other, and whether the numbers are still finite.
 *
 * Invariant: n counts the steps that were finished.
 */
/* Whether the main line is finite; of a small system in as few operations as possible. */
static inline bool advance_finite(const work *w)
{
    const real *restrict x = w->x, *restrict v = w->v;
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
static inline int advance_check(work *w)
{
    const real *restrict x = w->x, *restrict v = w->v;
    if (advance_finite(w)) return STEP_OK;
    w->in_v = false;
    EACH(k)
        if (!FINITE(x[k])) {
            w->which = k;
            return STEP_DIVERGED;
        }
    w->in_v = true;
    EACHV(k)
        if (!FINITE(v[k])) {
            w->which = k;
            break;
        }
    return STEP_DIVERGED;
}

/* `steps` more, or up to w->until where time is carried; stops in the middle of a step that fails. Where a number is
 * no longer finite, advance_check says afterwards. */
static int advance_run(work *w, whole steps)
{
    for (const whole end = w->n + steps; w->n < end;) {
        if (FACT(w, carried) && w->t == w->until) break;
        int bad = advance_step(w);
        if (bad) return bad;
        if (w->check && !advance_finite(w)) return STEP_DIVERGED;
    }
    return STEP_OK;
}
