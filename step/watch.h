/* A WATCH over steps: it is shown the ends of each and bounds on the accelerations within it, and ends the steps where
 * something may have happened. Only of rows that adapt their steps, and whose state is complete after each (WATCHES).
 */
#ifndef WATCHES
#define WATCHES(w) ((w)->watch != NULL)
#endif

static inline void watch_begin(work *w)
{
    watch *to = w->watch;
    EACH(k) to->from_x[k] = w->x[k];
    EACHV(k) to->from_v[k] = w->v[k];
    /* its first stage makes room for the next one's */
    const bool first = !FACT(w, expands) && control_last_is_first(w);
    EACHV(k) to->most[k] = first ? ABS(w->a[k]) : (real){0};
    to->known = !first || w->fresh;
    to->shown = false;
    to->t = w->t, to->lost = w->lost, to->n = w->n;
}

/* Whether the steps end here. */
static inline bool watch_ends(work *w)
{
    watch *to = w->watch;
    if (w->n == to->n) return false; /* the candidate was refused */
    EACH(k) to->to_x[k] = w->x[k];
    EACHV(k) to->to_v[k] = w->v[k];
    to->to_t = w->t, to->to_lost = w->lost;
    to->shown = to->known && family_swing(w, to->most);
    return to->met = !to->shown || !to->quiet(to);
}
