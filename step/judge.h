/* THE JUDGE of an iteration: when it has solved its equation, and when it never will.
 *
 * Invariant: an equation is solved to round-off or reported. The iteration ends when the next correction would be lost
 * beside the numbers that it goes to, or when the corrections no longer shrink at a size that rounding alone explains.
 * Lanes whose equation is solved keep their values while the others go on, so each makes the iterations that it would
 * make alone.
 */
enum { JUDGE_TURNS_MAX = 100 };

/* The verdict on a correction; where no member holds, the iteration goes on. */
typedef struct judge_verdict {
    mask done, stuck, lost;
} judge_verdict;

/* Judges the correction r of `value` (`count` vectors each), which will be added to `unit` times `base`. *before: the
 * size of the previous correction; start with a negative number. */
static inline judge_verdict judge_corrections(work *w, const real *r, const real *value, int count, const real *base,
                                              clock unit, real *before)
{
    real largest = {0}, worst = {0};
    mask lost = NEVER;
    w->in_v = true;
    for (int i = 0; i < count; i++) {
        const real *value_i = value + (size_t)i * w->stride, *r_i = r + (size_t)i * w->stride;
        EACHV(k) {
            const real size = ABS(value_i[k]) + ABS(unit * base[k]);
            const mask bad = NOT(FINITE(r_i[k]));
            largest = LARGER(size, largest);
            BLAME(w, bad & NOT(lost), k);
            lost = lost | bad;
        }
    }
    for (int i = 0; i < count; i++) {
        const real *value_i = value + (size_t)i * w->stride, *r_i = r + (size_t)i * w->stride;
        EACHV(k) { /* 0/0 is no larger than anything */
            const real share = ABS(r_i[k]) / (ABS(value_i[k]) + ABS(unit * base[k]) + SQRT_EPSILON * largest);
            BLAME(w, (share > worst) & NOT(lost), k);
            worst = LARGER(share, worst);
        }
    }
    const real last = *before;
    judge_verdict verdict = {.lost = lost, .done = NOT(lost) & (worst == 0), .stuck = NEVER};
    *before = worst;
    const mask second = last >= 0; /* the first correction has none before it to be compared with */
    if (!SOME(second)) return verdict;
    const mask shrinks = worst < last;
    /* Some ten roundings of the largest number are as many SQRT_EPSILON of the smallest that is judged. */
    const mask small =
        (shrinks & (worst * (worst / last) < EPSILON / 64)) | (NOT(shrinks) & (worst < 64 * SQRT_EPSILON));
    verdict.done = NOT(lost) & ((worst == 0) | (second & small));
    verdict.stuck = NOT(lost) & NOT(verdict.done) & second & NOT(shrinks);
    return verdict;
}

/* Tells whether small corrections, `worst` after `last`, may be the beginning of a divergence, and not rounding, in an
 * iteration that may not contract at all. That is known once they have shrunk to a quarter, or stayed small for
 * long. */
static inline mask judge_doubts(real worst, real last, int turn, mask *contracts)
{
    enum { LONG = 12 };
    const mask doubt = (last >= 0) & NOT(worst < last) & NOT(*contracts) & (worst > 4 * EPSILON);
    *contracts = *contracts | ((last >= 0) & (4 * worst <= last));
    return turn < LONG ? doubt : NEVER;
}

/* y += r where the equation is open. In the common case it is open in all lanes, and no lane needs a choice. */
static inline void judge_correct(const work *w, mask open, real *restrict y, const real *restrict r)
{
    if (!SOME(NOT(open)))
        EACHV(k) y[k] += r[k];
    else
        EACHV(k) y[k] = PICK(open, y[k] + r[k], y[k]);
}
