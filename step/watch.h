/* A WATCH over steps: it is shown the ends of each and bounds on the accelerations within it, and ends the steps where
 * something may have happened (WATCHES). The state of rows that adapt their steps must be complete after each; that of
 * fixed steps is observed, and the two ends bound what lies between.
 */
#ifndef WATCHES
#define WATCHES(w) ((w)->watch != NULL)
#endif
/* Tells whether the includer itself knows of the last step that nothing has happened in it; else `quiet` is asked. */
#ifndef WATCH_IDLE
#define WATCH_IDLE(w) false
#endif

static inline void watch_begin(work *w)
{
    watch *to = w->watch;
    if (ROW(w, adaptive)) {
        EACH(k) to->from_x[k] = w->x[k];
        EACHV(k) to->from_v[k] = w->v[k];
        /* the last stage takes the place of the first */
        const bool first = !FACT(w, expands) && control_last_is_first(w);
        EACHV(k) to->most[k] = first ? ABS(w->a[k]) : (real){0};
        to->known = !first || w->fresh;
    } else if (to->known && to->n == w->n - 1) {
        EACH(k) to->from_x[k] = to->to_x[k];
        EACHV(k) to->from_v[k] = to->to_v[k];
        EACHV(k) to->from_a[k] = to->to_a[k];
    } else {
        to->known = advance_sync(w, to->from_x, to->from_v, to->from_a) == STEP_OK;
    }
    to->shown = false;
    to->t = time_now(w), to->lost = w->lost, to->n = w->n;
}

/* Bounds the accelerations within the step. False: no bound is known. */
static inline bool watch_bounds(work *w)
{
    watch *to = w->watch;
    if (ROW(w, adaptive)) return to->known && family_swing(w, to->most);
    to->known = to->known && advance_sync(w, to->to_x, to->to_v, to->to_a) == STEP_OK;
    if (!to->known) return false;
    swing_of_ends(FACT(w, nx), FACT(w, nv), w->h, to->from_x, to->from_v, to->from_a, to->to_x, to->to_v, to->to_a,
                  to->most);
    return true;
}

/* Tells whether the steps end here. */
static inline bool watch_ends(work *w)
{
    watch *to = w->watch;
    if (w->n == to->n) return false; /* the candidate was refused */
    if (ROW(w, adaptive)) {
        EACH(k) to->to_x[k] = w->x[k];
        EACHV(k) to->to_v[k] = w->v[k];
    }
    EACH(k) to->largest_x[k] = LARGER(ABS(to->from_x[k]), to->largest_x[k]);
    EACHV(k) to->largest_v[k] = LARGER(ABS(to->from_v[k]), to->largest_v[k]);
    to->to_t = time_now(w), to->to_lost = w->lost;
    const bool bounded = watch_bounds(w);
    if (bounded && WATCH_IDLE(w)) return to->met = false;
    to->shown = bounded;
    return to->met = !bounded || !to->quiet(to);
}
