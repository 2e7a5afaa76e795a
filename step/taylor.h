/* TAYLOR SERIES of the second-order equation: the coefficients of x and v at the present state, by the recurrences of
 * series.h, and a step as long as they allow [JZ05].
 *
 * One series gives both: x[n+2] = a[n]/((n+1)(n+2)), v[n+1] = a[n]/(n+1), where a[n], coefficient n of the
 * acceleration, needs x and v to order n alone. A first-order variable is a velocity without a position. The includer
 * supplies
 *     series_order(w, n, t)    coefficient n of the acceleration to w->a, from those below; the series begin at t
 * and memory of w->series numbers for what the recurrences keep, at w->ks.
 *
 * Step: of each of the last WINDOW coefficients of each variable the radius on which it is as large as the motion, and
 * of that the fraction on which the first term left out is what a step may lose. The smallest is taken, because whole
 * residue classes of orders may vanish: x'' = -x³ from x = 0 has every fourth alone. The rule knows nothing of what the
 * series do not show: of kinks, of orders beyond the last. So the acceleration at the end of the step is compared with
 * its series. Where they differ the step is refused, halved, and taken again by the same series. Where they agree it is
 * coefficient 0 of the next step. A jump of the acceleration is refused until the step is a few roundings of the time.
 *
 * Invariant: xs, vs and r hold the series of x, v and a of the last step, coefficient 0 of x and v excepted, until the
 * next step begins; they are its dense output. |w->next| is a bound on the next candidate, GROWTH times the time scale
 * of the motion as the last step saw it.
 */
enum { TAYLOR_WINDOW = 8, TAYLOR_GROWTH = 4 };
#define TAYLOR_SAFETY 0.9
enum { TAYLOR_NOTHING, TAYLOR_BEGUN, TAYLOR_WHOLE }; /* w->expanded: of the present state order 0 is known, or all */
#define TAYLOR_LENGTH(w) (FACT(w, expands) + 1)
#define TAYLOR_OF(series, k) ((series) + (k) * (size_t)length)
#ifndef SERIES_PLACED /* 0: they are placed already */
#define SERIES_PLACED 1
#endif
#define TAYLOR_ZERO ((real){0})

/* A compiled model has one copy of the recurrences (TAYLOR_APART), and hands them a part of its workspace: then this
 * need not be in memory. */
#ifndef TAYLOR_APART
#define TAYLOR_APART static inline
#endif
#ifndef TAYLOR_PART
#define TAYLOR_PART(w) work *const part = (w)
#endif

/* Coefficients from `from` to `to` of the acceleration, and of those below `kept` what follows for the series. Order
 * `from` - 1 is in w->a. */
TAYLOR_APART void taylor_orders(work *w, const int from, const int to, const int kept, const clock t)
{
    const int length = TAYLOR_LENGTH(w);
    real *restrict xs = w->xs, *restrict vs = w->vs, *restrict as = w->r;
    const real *restrict a = w->a;
    for (int n = 0; n <= to; n++) {
        if (n >= from) series_order(w, n, t);
        if (n >= kept) continue;
        const coef first = RECIPROCAL(n + 1), second = first * RECIPROCAL(n + 2);
        EACHV(k) TAYLOR_OF(as, k)[n] = a[k], TAYLOR_OF(vs, k)[n + 1] = first * a[k];
        EACH(k) TAYLOR_OF(xs, k)[n + 2] = second * a[k];
    }
}

/* The series at the present state. Driven boundary cells come from series_order. */
static inline void taylor_expand(work *w)
{
    const int length = TAYLOR_LENGTH(w), last = FACT(w, expands);
    real *restrict xs = w->xs, *restrict vs = w->vs;
    EACH(k) TAYLOR_OF(xs, k)[0] = w->x[k];
    EACHV(k) TAYLOR_OF(vs, k)[0] = w->v[k];
    if (w->expanded == TAYLOR_WHOLE) return;
    EACH(k) TAYLOR_OF(xs, k)[1] = w->v[k];
    TAYLOR_PART(w);
    taylor_orders(part, w->expanded == TAYLOR_NOTHING ? 0 : 1, last - 2, last - 1, time_now(w));
    EACH(k) w->x[k] = TAYLOR_OF(xs, k)[0];
    EACHV(k) w->v[k] = TAYLOR_OF(vs, k)[0];
}

/* Terms `from` … `last` of a series, or their sizes, divided by h^from. Those after the first are taken in four chains,
 * by h^4, which wait a quarter as long for one another; the first is added last, so that the sum is rounded once at its
 * size. */
#define TAYLOR_TERM(n) (sizes ? ABS(c[n]) : c[n])
static inline real taylor_sum_of(const bool sizes, const real *c, const int from, const int last, const clock h)
{
    const clock hh = h * h, h4 = hh * hh;
    real s[4] = {TAYLOR_ZERO, TAYLOR_ZERO, TAYLOR_ZERO, TAYLOR_ZERO};
    const int whole = from + 1 + (last - from) / 4 * 4;
    for (int n = whole, k = 0; n <= last; n++, k++) s[k] = TAYLOR_TERM(n);
    for (int n = whole - 4; n > from; n -= 4) {
        s[0] = FMA(s[0], h4, TAYLOR_TERM(n));
        s[1] = FMA(s[1], h4, TAYLOR_TERM(n + 1));
        s[2] = FMA(s[2], h4, TAYLOR_TERM(n + 2));
        s[3] = FMA(s[3], h4, TAYLOR_TERM(n + 3));
    }
    return FMA(FMA(FMA(s[3], h, s[2]), hh, FMA(s[1], h, s[0])), h, TAYLOR_TERM(from));
}
#undef TAYLOR_TERM

static inline real taylor_sum(const real *c, const int from, const int last, const clock h)
{
    return taylor_sum_of(false, c, from, last, h);
}

/* The step ---------------------------------------------------------------------------------------------------------*/

/* Returns `size`, or how far the first three terms of a series lead in so long a time, if that is larger. */
static inline real taylor_reach(const real *c, real size, const clock time)
{
    size = LARGER(ABS(c[0]), size);
    size = LARGER(time * ABS(c[1]), size);
    return LARGER(time * time * ABS(c[2]), size);
}

/* log2(x) of a positive normal number to 0.05, along the line between two powers of 2: the n-th part of it tells a
 * step. */
static inline real taylor_log2(const real x)
{
    const clock_bits high = PATTERN_OF(x) >> 32;
    return (CLOCK_OF(high | 0x4330000000000000u) - 0x1p52) * 0x1p-20 - (1023 - 0.043);
}

/* The step by one coefficient of a variable of this size, as -log2: it makes the term n c h^n as large as the part of
 * the size that a step may lose, by the radius that the coefficient shows. The larger of it and `most`. */
static inline real taylor_term(const real c, const real per_reach, const int n, const real lost, const real most)
{
    const real here = taylor_log2((coef)n * per_reach * c) * RECIPROCAL(n) - lost;
    return PICK((c > 0) & (per_reach < INFINITY), LARGER(here, most), most);
}

/* log2 of the part that a step may lose of a variable of this size, over the order. The last coefficients tell those
 * left out but roughly: a tenth of the tolerance. */
static inline real taylor_lost(const work *w, const real reach)
{
    const real part = 0.1 * LARGER(FMA(w->relative, reach, w->absolute + (real){0}) / reach, (real){0} + EPSILON);
    return control_log2(part) / (coef)FACT(w, expands);
}

/* The step that the series of all variables allow; infinite where they have ended. */
static inline clock taylor_size(const work *w, const clock time)
{
    const int length = TAYLOR_LENGTH(w), last = FACT(w, expands),
              window = last < 2 * TAYLOR_WINDOW ? last / 2 : TAYLOR_WINDOW;
    real most = TAYLOR_ZERO - INFINITY;
    EACH_VARIABLE(g)
    {
        const size_t from = VARIABLE(w, g), to = VARIABLE(w, g + 1);
        const bool moves = from < FACT(w, nx); /* it has a position */
        const real *const series = moves ? w->xs : w->vs;
        real reach = TAYLOR_ZERO;
        for (size_t k = from; k < to; k++) reach = taylor_reach(TAYLOR_OF(series, k), reach, time);
        const real lost = taylor_lost(w, reach), per_reach = 1 / reach;
        for (int n = last - window + moves; n < last + moves; n++) {
            real c = TAYLOR_ZERO;
            for (size_t k = from; k < to; k++) c = LARGER(ABS(TAYLOR_OF(series, k)[n]), c);
            most = taylor_term(c, per_reach, n, lost, most);
        }
    }
    const clock size = TAYLOR_SAFETY * control_exp2(-CHOOSE_WHERE(ABS(most) < 900, most, CLOCK(900)));
    return CHOOSE_WHERE(most > -900, size, CLOCK(INFINITY));
}

/* Where the state would be after the step, as coefficient 0 of xs and vs; the increments over h in next_x and delta. */
static inline void taylor_candidate(work *w)
{
    const int length = TAYLOR_LENGTH(w), last = FACT(w, expands);
    const clock h = w->h;
    EACH(k) {
        real *x = TAYLOR_OF(w->xs, k);
        w->next_x[k] = taylor_sum(x, 1, last, h);
        x[0] = w->x[k] + FMA(h, w->next_x[k], w->ex[k]);
    }
    EACHV(k) {
        real *v = TAYLOR_OF(w->vs, k);
        w->delta[k] = taylor_sum(v, 1, last - 1, h);
        v[0] = w->v[k] + FMA(h, w->delta[k], w->ev[k]);
    }
}

/* How large a velocity is in the step, by its ends, its rate, and where there is a position the way. */
static inline real taylor_speed(const work *w, const size_t k, const clock free, const real least)
{
    const int length = TAYLOR_LENGTH(w);
    const real end = LARGER(ABS(TAYLOR_OF(w->vs, k)[0]), least), rate = ABS(w->h) * ABS(TAYLOR_OF(w->r, k)[0]);
    const real speed = LARGER(ABS(w->v[k]), LARGER(rate, end));
    return k < FACT(w, nx) ? LARGER(ABS(w->x[k]) / free, speed) : speed;
}

/* The difference between the acceleration at the end of the step and its series, over the step, in units of what is
 * allowed of the velocity: 100 times what a step may lose, since the series of the acceleration ends two orders before.
 * The largest of all variables. free: the step that the series allow. */
static inline real taylor_error(const work *w, const clock free)
{
    const int length = TAYLOR_LENGTH(w), last = FACT(w, expands);
    real error = TAYLOR_ZERO;
    EACH_VARIABLE(g)
    {
        real speed = TAYLOR_ZERO, apart = TAYLOR_ZERO, none = TAYLOR_ZERO;
        for (size_t k = VARIABLE(w, g); k < VARIABLE(w, g + 1); k++) {
            const real off = w->h * (w->a[k] - taylor_sum(TAYLOR_OF(w->r, k), 0, last - 2, w->h));
            apart = LARGER(ABS(off), apart);
            none += off - off; /* not a number, where it is not finite */
            speed = taylor_speed(w, k, free, speed);
        }
        const real least = EPSILON * speed + norm_blur(w, VARIABLE(w, g), VARIABLE(w, g + 1)),
                   allowed = 10 * LARGER(FMA(w->relative, speed, w->absolute + TAYLOR_ZERO), least);
        const real share = PICK(apart == 0, TAYLOR_ZERO, apart / allowed) + none;
        error = PICK(share <= error, error, share);
    }
    return error;
}

static int taylor_step(work *w)
{
    const clock bound = CHOOSE_WHERE(ABS(w->next) < w->most, ABS(w->next), w->most),
                forward = CHOOSE_WHERE(w->until < w->t, CLOCK(-1), CLOCK(1));
    taylor_expand(w);
    const clock free = taylor_size(w, bound / TAYLOR_GROWTH);
    w->next = forward * CHOOSE_WHERE(free < bound, free, bound);
    w->after = forward * TAYLOR_GROWTH * CHOOSE_WHERE(FINITE(free), free, bound);
    work_scale(w, control_size(w));
    taylor_candidate(w);
    TAYLOR_PART(w);
    taylor_orders(part, 0, 0, 0, CHOOSE_WHERE(w->ends, w->until, time_in(w, 1)));
    w->error = taylor_error(w, free);
    w->error = CHOOSE_WHERE(FINITE(w->error) & (ABS(w->h) <= 4 * EPSILON * ABS(w->t)), CLOCK(0), w->error);
    w->after = CHOOSE_WHERE(w->error <= 1, w->after, w->h / 2);
    /* a step that is shorter than the least is refused, and leaves its size, which ends the run */
    const clock_mask shorter = free < w->least;
    w->error = CHOOSE_WHERE(shorter, CLOCK(NAN), w->error);
    w->after = CHOOSE_WHERE(shorter, forward * free, w->after);
    w->fresh = false; /* a is coefficient 0, by equations that are written in another way */
    return STEP_OK;
}

static inline void taylor_accept(work *w, clock_mask good)
{
    const int length = TAYLOR_LENGTH(w);
    const clock h = w->h;
    w->expanded = NONE(good) ? TAYLOR_WHOLE : NONE(NOT(good)) ? TAYLOR_BEGUN : TAYLOR_NOTHING;
    w->evaluations += NONE(good) ? 1 : FACT(w, expands) - 1; /* orders that were computed */
    if (NONE(good)) return; /* so that of one trajectory the next step need not wait for the verdict */
#define TAYLOR_MOVE(y, e, increment, end)            \
    do {                                             \
        real to = (y), rest = (e);                   \
        ADVANCE_COMPENSATED(to, rest, h, increment); \
        (y) = CHOOSE_WHERE(good, end, y);            \
        (e) = CHOOSE_WHERE(good, rest, e);           \
    } while (0)
    EACH(k) TAYLOR_MOVE(w->x[k], w->ex[k], w->next_x[k], TAYLOR_OF(w->xs, k)[0]);
    EACHV(k) TAYLOR_MOVE(w->v[k], w->ev[k], w->delta[k], TAYLOR_OF(w->vs, k)[0]);
#undef TAYLOR_MOVE
}

/* The series themselves. */
#define taylor_between dense_without
#define taylor_extend dense_as_it_is
static inline int taylor_dense(work *w, const dense_step *d, clock t, real *x, real *v)
{
    const int length = TAYLOR_LENGTH(w), last = FACT(w, expands);
    const clock h = t - d->end[0].t;
    EACH(k) x[k] = FMA(h, taylor_sum(TAYLOR_OF(w->xs, k), 1, last, h), d->end[0].x[k]);
    EACHV(k) v[k] = FMA(h, taylor_sum(TAYLOR_OF(w->vs, k), 1, last - 1, h), d->end[0].v[k]);
    return STEP_OK;
}

/* The sum of the sizes of all terms of the acceleration's series, its value at the start among them. */
static inline bool taylor_swing(const work *w, real *most)
{
    const int length = TAYLOR_LENGTH(w), last = FACT(w, expands);
    EACHV(k) most[k] = LARGER(taylor_sum_of(true, TAYLOR_OF(w->r, k), 0, last - 2, ABS(w->h)), most[k]);
    return true;
}

/* The series at the present state are those with which the last step of another workspace began. */
static inline void taylor_take(work *w, const work *from)
{
    const size_t length = (size_t)TAYLOR_LENGTH(w), xs = length * FACT(w, nx), vs = length * FACT(w, nv);
    for (size_t k = 0; k < xs; k++) w->xs[k] = from->xs[k];
    for (size_t k = 0; k < vs; k++) w->vs[k] = from->vs[k], w->r[k] = from->r[k];
    w->expanded = TAYLOR_WHOLE;
}

#define taylor_observe state_is_complete
#define taylor_sync work_sync_main
#define taylor_carry work_carry_main

static inline void taylor_place(work *w, placing *p)
{
    const int length = TAYLOR_LENGTH(w);
    w->next_x = work_array(p, 1), w->delta = work_array(p, 1);
    if (!SERIES_PLACED) return;
    w->xs = work_array(p, length), w->vs = work_array(p, length), w->r = work_array(p, length);
    w->ks = work_array(p, (int)((FACT(w, series) + FACT(w, nv) - 1) / FACT(w, nv)));
}

#ifdef ROWS
_Static_assert(sizeof reciprocals / sizeof *reciprocals > SERIES_ORDER_MOST + 1, "every order has its reciprocal");

/* Work goes with the square of the order, and the step with tolerance^(1/order): least at 1 - log(tolerance)/2
 * [JZ05, 3.2.1]. Sums of few terms wait for one another as long as sums of some more, which favours a fifth more; where
 * there are few numbers, what a step costs besides its sums favours a third: orders 24 and 26 for steps that lose
 * 1e-16. It is 24 where a step is given and any error allowed. */
static int taylor_order(const coef tolerance, const bool few)
{
    if (!FINITE(tolerance)) return 24;
    const coef order = 2 - (few ? (coef)0.47 : (coef)0.416) * control_log2(tolerance);
    return order < 6 ? 6 : order > 26 ? 26 : (int)order;
}

static void taylor_plan(work *w, const double argument[2], coef *unit, coef *c)
{
    (void)argument, (void)unit;
    const clock tolerance = w->relative > 0 ? w->relative : w->absolute;
    w->expands = w->row->series ? w->row->series : taylor_order((coef)(0.1 * tolerance), w->nv <= 4);
    w->order = w->expands;
    w->stages = 1;
    if (c) c[0] = 0;
}
#endif

#ifdef TRACING
static trace_room taylor_room(const work *w) { return (void)w, (trace_room){0}; }
static void taylor_trace(work *w, int i) { (void)w, (void)i; }
#endif
