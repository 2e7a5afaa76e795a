/* A WATCH over steps: it is shown the ends of each and bounds on the accelerations within it, and ends the steps where
 * something may have happened. Only for rows that adapt their steps, and whose state is complete after each (WATCHES).
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
    EACH(k) to->from_x[k] = w->x[k];
    EACHV(k) to->from_v[k] = w->v[k];
    /* the last stage takes the place of the first */
    const bool first = !FACT(w, expands) && control_last_is_first(w);
    EACHV(k) to->most[k] = first ? ABS(w->a[k]) : (real){0};
    to->known = !first || w->fresh;
    to->shown = false;
    to->t = w->t, to->lost = w->lost, to->n = w->n;
}

/* Tells whether the steps end here. */
static inline bool watch_ends(work *w)
{
    watch *to = w->watch;
    if (w->n == to->n) return false; /* the candidate was refused */
    EACH(k) to->to_x[k] = w->x[k];
    EACHV(k) to->to_v[k] = w->v[k];
    EACH(k) to->largest_x[k] = LARGER(ABS(to->from_x[k]), to->largest_x[k]);
    EACHV(k) to->largest_v[k] = LARGER(ABS(to->from_v[k]), to->largest_v[k]);
    to->to_t = w->t, to->to_lost = w->lost;
    const bool bounded = to->known && family_swing(w, to->most);
    if (bounded && WATCH_IDLE(w)) return to->met = false;
    to->shown = bounded;
    return to->met = !bounded || !to->quiet(to);
}
