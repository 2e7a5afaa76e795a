/* A BRANCH: a step that begins where a step of another workspace has begun, and takes over what that has computed
 * there, to the bits of its own evaluation. Only for rows that can be watched.
 */
/* from: the other workspace, whose last step has begun at the present state, with this acceleration. */
static inline void advance_branch(work *w, const work *from, const real *a)
{
    if (FACT(w, expands)) {
        taylor_take(w, from);
        return;
    }
    EACHV(k) w->a[k] = a[k];
    control_known(w, EVERY);
}
