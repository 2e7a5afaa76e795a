/* THE LOOP over steps, and the test whether the state is still finite.
 *
 * Invariant: n counts the finished steps.
 */
/* Tells whether the main line is finite; in as few operations as possible where the system is small. */
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

/* Returns STEP_DIVERGED if the main line holds an infinity or a NaN; w->which, w->in_v say where. */
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

/* Tells whether every step is tested. */
#ifndef CHECKS
#define CHECKS(w) ((w)->check)
#endif

/* Takes `steps` more steps, or fewer up to w->until where time is carried; stops in the middle of a step that fails.
 * advance_check then finds the number that is not finite. */
static int advance_run(work *w, whole steps)
{
    for (const whole end = w->n + steps; w->n < end;) {
        if (FACT(w, carried) && w->t == w->until) break;
        if (WATCHES(w)) watch_begin(w);
        int bad = advance_step(w);
        if (bad) return bad;
        if (CHECKS(w) && !advance_finite(w)) return STEP_DIVERGED;
        if (WATCHES(w) && watch_ends(w)) break;
    }
    return STEP_OK;
}
