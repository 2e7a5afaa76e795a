/* A STEP: a candidate, which is then accepted or refused.
 *
 * A refused candidate changes nothing but the size of the next one. Rows of fixed steps always accept; in a compiled
 * model that is known at compile time, and costs nothing.
 */
#ifndef ADVANCE_STEP
#define ADVANCE_STEP static inline /* compiled models with families of cells make it a function that is called */
#endif
ADVANCE_STEP int advance_step(work *w)
{
    int bad = STEP_OK;
    if (ROW(w, adaptive)) {
        bad = ROW(w, density) ? density_begin(w) : control_first(w);
        if (bad) return bad;
        if (!ROW(w, sizes)) work_scale(w, control_size(w));
        TRACE(w, TRACE_CANDIDATE);
    }
    bad = family_step(w);
    if (bad) return bad;
    if (!ROW(w, adaptive)) {
        time_tick(w, EVERY);
        return STEP_OK;
    }
    TRACE(w, TRACE_JUDGED);
    const clock_mask good = ROW(w, density)                   ? density_judge(w)
                            : ROW(w, sizes) || ROW(w, orders) ? control_judge_own(w)
                                                              : control_judge(w);
    family_accept(w, good);
    time_tick(w, good);
    STOP(w, w->stalled, STEP_STALLED);
    return STEP_OK;
}
