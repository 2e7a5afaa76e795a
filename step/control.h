/* THE STEP SIZE of adaptive rows: the size of the next candidate, and whether a candidate is accepted.
 *
 * A candidate with an error of at most 1 is accepted. The next size follows from this error and that of the step
 * before, as if the error went with the power order + 1 of the size, by a predictive controller [Gustafsson94]: what
 * the motion has changed from the step before to this one, in sizes and in errors, it is expected to change once more.
 * At equal error that takes up to a fifth less evaluations than a proportional and integral one [Gustafsson91], and
 * half as many steps are refused. A row that iterates has the latter: slow turns add to its errors, and do not follow
 * that power. Logarithms are rough, since a size that is one percent off is as good. After a refusal no step grows at
 * once.
 *
 * PATTERN_OF and CLOCK_OF read the 64 bits of a number.
 *
 * Invariant: no step passes w->until, and the one that reaches it ends there exactly; where two steps would reach it,
 * both are halves of the way, so that no tiny step is left over.
 */
/* 0: a compiled model, which takes neither a first step nor a Runge-Kutta step whose first evaluation is not known from
 * the step before, but gives up there; else its text would have the force twice more. */
#ifndef BEGINS
#define BEGINS 1
#endif

/* log2(x) of a positive normal number to 0.001, and 2^y, |y| < 1000, to 0.1 %. */
static inline clock control_log2(clock x)
{
    const clock_bits b = PATTERN_OF(x);
    const clock m = CLOCK_OF((b & 0x000fffffffffffffu) | 0x3ff0000000000000u);
    const clock whole = CLOCK_OF((b >> 52) | 0x4330000000000000u) - (0x1p52 + 1023);
    return whole + (m * (m * (m * 0.158249 - 1.051875) + 3.047884) - 2.153620);
}

static inline clock control_exp2(clock y)
{
    /* rounded to a whole number in the bits of a double, also where clock has more */
    const clock shifted = CLOCK_OF(PATTERN_OF(y + 0x1.8p52)), r = y - (shifted - 0x1.8p52);
    return CLOCK_OF((PATTERN_OF(shifted) + 1023) << 52) * (1 + r * (0.693147 + r * (0.240227 + r * 0.0555)));
}

/* Tells whether a step ends with the evaluation with which the next one begins. */
static inline bool control_last_is_first(const work *w) { return FACT(w, ending) || FACT(w, closing); }

/* The acceleration at the start of the step, in w->a. Where it was the last stage of the step before, it has been
 * counted there, and the driven boundary cells are written here as evaluating it here would have done. */
static inline int control_begin(work *w)
{
    if (work_reuse(w)) {
        refresh_at(w, time_now(w), w->x, w->v);
        return STEP_OK;
    }
    if (!BEGINS && !ROW(w, density) && control_last_is_first(w)) return STEP_STALLED;
    const whole before = w->evaluations;
    const int bad = accel_now(w, w->x, w->v, w->a);
    if (control_last_is_first(w) && !NONE(w->n > 0)) w->evaluations = before;
    return bad;
}

/* After a candidate w->a holds the acceleration of the next step's start, where `known`. */
static inline void control_known(work *w, clock_mask known)
{
    w->fresh = NONE(NOT(known));
    w->owed_evaluations = w->owed_iterations = 0;
}

/* The size of the first step: a hundredth of the time in which positions or velocities would change by their own size.
 * Refusals correct it. */
static inline int control_first(work *w)
{
    const clock_mask first = w->next == 0;
    if (NONE(first)) return STEP_OK;
    if (!BEGINS) return STEP_STALLED;
    const int bad = control_begin(w);
    if (bad) return bad;
    control_known(w, EVERY);
    const clock way = (w->until - w->t) - w->lost;
    clock h = ABS(way) / 100;
    EACH_VARIABLE(g)
    {
        real x = {0}, v = {0}, a = {0};
        for (size_t k = VARIABLE(w, g); k < VARIABLE(w, g + 1); k++) {
            if (k < FACT(w, nx)) x = LARGER(ABS(w->x[k]), x);
            v = LARGER(ABS(w->v[k]), v);
            a = LARGER(ABS(w->a[k]), a);
        }
        const clock by_v = x / (100 * v), by_a = v / (100 * a);
        h = CHOOSE_WHERE((by_v > 0) & (by_v < h), by_v, h);
        h = CHOOSE_WHERE((by_a > 0) & (by_a < h), by_a, h);
    }
    h = CHOOSE_WHERE(h < w->least, CLOCK(w->least), h);
    h = CHOOSE_WHERE(h < w->most, h, w->most);
    h = CHOOSE_WHERE(h < 1e300, h, CLOCK(1)); /* neither an end nor a size is known */
    w->next = CHOOSE_WHERE(first, CHOOSE_WHERE(way < 0, -h, h), w->next);
    return STEP_OK;
}

static inline clock control_size(work *w)
{
    const clock left = (w->until - w->t) - w->lost, most = CHOOSE_WHERE(w->next < 0, -w->most, w->most),
                size = CHOOSE_WHERE(ABS(w->next) <= w->most, w->next, most);
    w->ends = ABS(size) >= ABS(left);
    return CHOOSE_WHERE(w->ends, left, CHOOSE_WHERE(2 * ABS(size) > ABS(left), left / 2, size));
}

/* log2 of an error, between bounds. */
static inline clock control_level(clock error)
{
    const clock least = LARGER(error, CLOCK(0x1p-60));
    return control_log2(CHOOSE_WHERE(least < 0x1p60, least, CLOCK(0x1p60)));
}

/* Exponents of the two errors in the next size where nothing is predicted, and the part of the size that is taken, as a
 * power of 2: 3/4. */
#define CONTROL_NOW 0.7
#define CONTROL_BEFORE 0.4
#define CONTROL_SAFETY (-0.415)

/* The next size over the present one: at most 5, and 1 after a refusal; at least 1/5, of a refused step 1/10, and 1/4
 * where the error is not a number. */
static inline clock control_factor(const work *w, clock_mask good, clock level)
{
    const coef per = (coef)1 / (FACT(w, order) + 1);
    clock after = (CONTROL_BEFORE * w->before - CONTROL_NOW * level) * per + CONTROL_SAFETY;
    if (!FACT(w, iterates)) {
        const clock_mask first = w->span == 0;
        const clock trend = control_log2(ABS(w->h) / (ABS(w->span) + SMALLEST)), worse = level - w->before;
        after = CHOOSE_WHERE(first, CLOCK(0), trend - worse * per) - level * per + CONTROL_SAFETY;
    }
    after = CHOOSE_WHERE(after < w->rise, after, w->rise);
    clock again = CONTROL_SAFETY - level * per;
    again = CHOOSE_WHERE(w->error == w->error, again, CLOCK(-2.0));
    const clock power = CHOOSE_WHERE(good, LARGER(after, CLOCK(-2.3)), LARGER(again, CLOCK(-3.3)));
    return control_exp2(power);
}

/* Notes the shortest and the longest step; the step to the end does not count. */
static inline void control_count(work *w, clock_mask good)
{
    const clock size = ABS(w->h);
    const clock_mask whole_step = good & NOT(w->ends);
    w->shortest = CHOOSE_WHERE(whole_step & ((w->shortest == 0) | (size < w->shortest)), size, w->shortest);
    w->longest = CHOOSE_WHERE(whole_step & (size > w->longest), size, w->longest);
}

/* The candidate is judged, and the next one will be w->next long. */
static inline void control_settle(work *w, clock_mask good)
{
    control_count(w, good);
    w->stalled = (w->t + w->next == w->t) | (ABS(w->next) < w->least);
    if (BLURS(w)) w->stalled = w->stalled | NOT(good); /* every candidate has a blur of its own */
    w->refused = CHOOSE_WHERE(good, w->refused, w->refused + 1);
}

/* Tells whether the candidate is accepted. The clock has no time between the start of a step of a few roundings and its
 * end, so the force at its stages is off by what it changes in one rounding of the time; where the motion comes from
 * rest at 0, that is a large part of its size. The last such step before an end, which no shorter ones replace, may err
 * by that part of the size which one rounding of the time is of the step. */
static inline clock_mask control_good(const work *w)
{
    const clock h = ABS(w->h), t = ABS(w->t);
    const clock_mask short_end = w->ends & (h <= 0x1p-32 * t);
    const clock off = w->error * w->relative;
    return (w->error <= 1) | (short_end & (off > 0) & (off * h <= 0x1p-50 * t));
}

/* Judges a candidate of a row that finds its own sizes; w->after is the next one. */
static inline clock_mask control_judge_own(work *w)
{
    const clock_mask good = control_good(w);
    w->next = w->after;
    control_settle(w, good);
    return good;
}

/* An error that is not a number is refused like one that is too large. */
static inline clock_mask control_judge(work *w)
{
    const clock_mask good = control_good(w);
    const clock level = control_level(w->error);
    const clock next = w->h * control_factor(w, good, level);
    /* a step that was cut short tells nothing about the next one */
    w->next = CHOOSE_WHERE(good & w->ends, w->next,
                           CHOOSE_WHERE(ABS(next) <= w->most, next, CHOOSE_WHERE(next < 0, -w->most, w->most)));
    w->before = CHOOSE_WHERE(good, level, w->before);
    if (!FACT(w, iterates)) w->span = CHOOSE_WHERE(good, w->h, w->span);
    w->rise = CHOOSE_WHERE(good, CLOCK(CONTROL_RISE), CLOCK(0.0));
    control_settle(w, good);
    return good;
}

/* Candidates that are refused whatever their error; and a share of the error, of at most 1, that the others have at
 * least, so that the next step is not longer. */
static inline void control_spoil(work *w, clock_mask where, clock share)
{
    const clock least = CHOOSE_WHERE(share < 1, share, CLOCK(1));
    w->error = CHOOSE_WHERE(where, CLOCK(NAN), CHOOSE_WHERE(w->error < least, least, w->error));
}

/* Two estimates of the same error, of a higher and a lower order, as one [HNW93, II.10]. */
static inline clock control_joint(clock high, clock low)
{
    const clock ratio = low / high, square = 1 + 0.01 * (ratio * ratio), root = control_exp2(control_log2(square) / 2);
    return CHOOSE_WHERE(high == 0, high, high / root) + (low - low);
}
