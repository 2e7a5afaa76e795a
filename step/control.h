/* THE STEP SIZE of adaptive rows: the size of the next candidate, and whether a candidate is accepted.
 *
 * Invariant: no step passes w->until, and the one that reaches it ends there exactly. Sizes are halved and doubled,
 * so they are exact; the order of the error estimate says when twice the size would do.
 */
static inline clock control_size(work *w)
{
    const clock left = (w->until - w->t) - w->lost;
    w->ends = ABS(w->next) >= ABS(left);
    return CHOOSE_WHERE(w->ends, left, w->next);
}

/* Of rows that find their own sizes. */
static inline clock_mask control_judge_own(work *w)
{
    const clock_mask good = w->error <= 1;
    w->next = CHOOSE_WHERE(good, w->after, w->h / 2);
    w->stalled = w->t + w->next == w->t;
    w->refused += NONE(good);
    return good;
}

/* An error that is not a number is refused like one that is too large. */
static inline clock_mask control_judge(work *w)
{
    const clock_mask good = w->error <= 1, ample = w->error * (2 << (FACT(w, order) + 1)) <= 1;
    const clock kept = CHOOSE_WHERE(good, w->next, w->h / 2);
    w->next = CHOOSE_WHERE(ample, 2 * kept, kept);
    w->stalled = w->t + w->next == w->t;
    w->refused += NONE(good);
    return good;
}
