/* EXTRAPOLATION: one step, taken in n[1], n[2], … parts by a symmetric rule of order 2, whose errors are series in the
 * square of a part's length; so they can be led to parts of no length [HNW93, II.9]. Line j of the scheme has
 *
 *     T[j][1] by n[j] parts,   T[j][i+1] = T[j][i] + (T[j][i] - T[j-1][i])/((n[j]/n[j-i])² - 1).
 *
 * T[j][j] has order 2 j. Its distance from T[j][j-1] estimates the error of that, which is of order 2 j - 2. The n[j]
 * are as 1 : 2 : 3 : …, the fewest evaluations.
 *
 * A step aims at a line. It ends there, or at the line before or after it, where the error is allowed first; at any
 * line in a first step, and in one that is cut short. A line's error tells how long a step could end there; of the
 * lines known then, the next step aims at that with the fewest evaluations a unit of time. A step is refused as soon as
 * its error is so large that no line up to the one after the aim can be expected to end it. A tolerance that allows
 * every error leaves the line at which the step ends to w->before, or to the row's card.
 *
 * A family of this kind has a rule: it leaves the sums of accelerations that lead to x and to v at the end of the step
 * in w->ks, beginning with the second array, v first. What is extrapolated are these sums over their number, q and p:
 * x₁ = x + h v + h² p, v₁ = v + h q. The scheme amplifies roundings some ten times, but those of p and q alone.
 *
 * Invariant: w->before is the line at which the next step aims, 0 at first; w->span that of the last step; next_x and
 * delta hold p and q of the last candidate, for dense output.
 */
enum { EXTRAPOLATION_LINES = 9, EXTRAPOLATION_AIM = EXTRAPOLATION_LINES - 1 };
enum { EXTRAPOLATION_V = 1, EXTRAPOLATION_X = 2 }; /* the arrays of w->ks that have a rule's sums */

/* Line j takes each · j parts, and each · j - spared evaluations, besides that at the start of the step. */
typedef struct extrapolation_rule {
    int each, spared;
} extrapolation_rule;

static inline int extrapolation_work(const extrapolation_rule *r, int j)
{
    return 1 + r->each * j * (j + 1) / 2 - r->spared * j;
}

/* The search for the line that ends the step. size, work: log2 of the next step that a line allows, over the present
 * one, and of the evaluations in the time of the present one. */
typedef struct extrapolation {
    mask open;
    clock_mask soon, free; /* any line may end the step; any error is allowed */
    clock aim;
    clock estimate, fall; /* of the error, by the line before; over that of the line before it */
    clock size[EXTRAPOLATION_LINES + 1], work[EXTRAPOLATION_LINES + 1];
} extrapolation;

/* The line at which a first step aims: six of ten digits of the tolerance [HNW93, II.9]. */
static inline clock extrapolation_guess(const work *w)
{
    const clock none = {0}, least = none + EPSILON,
                part = CHOOSE_WHERE(w->relative > 0, w->relative + none, w->absolute + none),
                lines = FMA(-0.18, control_log2(LARGER(part, least)), none + 1.5);
    clock aim = none + 2;
    for (int j = 3; j <= EXTRAPOLATION_AIM; j++) aim = CHOOSE_WHERE(lines >= j, none + j, aim);
    return aim;
}

static inline int extrapolation_begin(work *w, extrapolation *e)
{
    const int bad = control_begin(w);
    const clock none = {0};
    const clock_mask first = w->before == 0, ends = w->ends;
    e->open = ALWAYS;
    e->estimate = e->fall = none;
    e->free = w->relative + w->absolute > 1e200;
    e->soon = (first | ends) & NOT(e->free);
    e->aim =
        CHOOSE_WHERE(first, CHOOSE_WHERE(e->free, none + (FACT(w, order) + 2) / 2, extrapolation_guess(w)), w->before);
    for (int j = 0; j <= EXTRAPOLATION_LINES; j++) e->size[j] = e->work[j] = none;
    return bad;
}

/* Line j of the scheme in place of line j - 1, for one kind of sums: `now` has T[j][1] over `per`, and becomes T[j][j],
 * `off` its distance from T[j][j-1]; line: arrays, T[j][i] in array i - 1. */
static inline void extrapolation_line(const work *w, int j, size_t count, clock per, real *restrict now,
                                      real *restrict off, real *line)
{
    for (size_t k = 0; k < count; k++) now[k] = now[k] / per, off[k] = (real){0};
    for (int i = 1; i <= j; i++) {
        real *restrict at = line + (size_t)(i - 1) * w->stride;
        const int m = j - i;
        const coef part = (coef)(m * m) / (coef)(j * j - m * m);
        for (size_t k = 0; k < count && i < j; k++) {
            const real step = part * (now[k] - at[k]);
            at[k] = now[k];
            off[k] = step;
            now[k] += step;
        }
        for (size_t k = 0; k < count && i == j; k++) at[k] = now[k];
    }
}

/* The candidate by line j, where none is found yet, and the error of the line. */
static inline clock extrapolation_candidate(work *w, const extrapolation *e, int j, int parts)
{
    real *restrict q = w->ks + EXTRAPOLATION_V * w->stride, *restrict p = w->ks + EXTRAPOLATION_X * w->stride;
    const clock h = w->h, hh = w->hh, none = {0};
    extrapolation_line(w, j, FACT(w, nv), none + parts, q, w->vs, w->r);
    extrapolation_line(w, j, FACT(w, nx), none + parts * parts, p, w->xs, w->r + EXTRAPOLATION_LINES * w->stride);
    EACH(k) {
        w->next_x[k] = PICK(e->open, p[k], w->next_x[k]);
        w->dx[k] = FMA(h, w->v[k], FMA(h, w->ev[k], FMA(hh, w->next_x[k], w->ex[k])));
        w->xs[k] *= hh;
    }
    EACHV(k) {
        w->delta[k] = PICK(e->open, q[k], w->delta[k]);
        w->dv[k] = FMA(h, w->delta[k], w->ev[k]);
        w->vs[k] *= h;
    }
    return j > 1 ? control_norm(w, w->xs, w->vs) : none;
}

/* The error of T[j][j] where the estimates fall so slowly from line to line that it is larger than the estimate of line
 * j: it is (n[j+1]/n[1])² times the estimate of the next line. That is expected to fall as the slower of the last two
 * did. An estimate below 1 may be rounding, and is taken for 1 in this. How they fall is not known at line 2. The
 * eighth of the error is allowed, because falls differ. */
static inline clock extrapolation_error(extrapolation *e, int j, clock estimate)
{
    const clock one = CLOCK(1), next = one * ((j + 1) * (j + 1)), fall = estimate / LARGER(e->estimate, one);
    const clock slower = j > 3 ? LARGER(fall, e->fall) : fall;
    e->fall = fall;
    return 8 * estimate * (j > 2 ? LARGER(slower * next, one) : next);
}

/* Tells whether no line up to that after the aim can be expected to end the step, by the error of line j: errors fall
 * from line to line j by (n[j]/n[1])² [HNW93, II.9], and do not grow. */
static inline clock_mask extrapolation_hopeless(const extrapolation *e, int j, clock estimate, clock error)
{
    const clock none = {0}, next = none + (j + 1) * (j + 1), both = next * ((j + 2) * (j + 2)),
                fall = CHOOSE_WHERE(e->aim > j, both, next), bound = CHOOSE_WHERE(e->aim < j, none + 1, fall);
    const clock_mask near = e->aim <= j + 1, grows = j > 2 ? (estimate > 4 * e->estimate) & (error > 1) : NOT(EVERY),
                     last = j == EXTRAPOLATION_LINES ? EVERY : NOT(EVERY);
    return (near & (error > bound)) | grows | last | NOT(FINITE(error));
}

/* What line j tells of the next step: as long as 0.65 of the allowed error wants, less 6 %, but not much longer or
 * shorter than the present one [HNW93, II.9]. */
static inline void extrapolation_note(const work *w, extrapolation *e, const extrapolation_rule *r, int j, clock error)
{
    const coef per = (coef)1 / (2 * j - 1), reach = 5.64 * per; /* log2(50) of it */
    const clock none = {0}, rise = none + reach, fall = none - (2 + reach),
                size = FMA(-per, control_level(error) + 0.62, none - 0.09),
                most = control_log2(LARGER(w->most, none + SMALLEST) / ABS(w->h));
    const clock upper = CHOOSE_WHERE(most < rise, most, rise);
    e->size[j] = LARGER(CHOOSE_WHERE(size < upper, size, upper), fall);
    e->work[j] = control_log2(none + extrapolation_work(r, j)) - e->size[j];
}

/* The line at which the next candidate aims, and log2 of its size over the present one: of line j, at which this one
 * ended, and the two before it that with the least work; but the line after it where work still falls from line to
 * line. again: the candidate before was refused. */
static inline void extrapolation_choose(const extrapolation *e, const extrapolation_rule *r, int j, clock_mask good,
                                        clock_mask again, clock *aim, clock *size)
{
    const int top = j < EXTRAPOLATION_AIM ? j : EXTRAPOLATION_AIM;
    const clock none = {0};
    clock best = none + top, longest = e->size[top], least = e->work[top];
    for (int i = top - 1; i >= 2 && i >= j - 2; i--) {
        const clock_mask less = e->work[i] < least;
        best = CHOOSE_WHERE(less, none + i, best);
        longest = CHOOSE_WHERE(less, e->size[i], longest);
        least = CHOOSE_WHERE(less, e->work[i], least);
    }
    if (j < EXTRAPOLATION_AIM) { /* less than 0.9 of the work at the line before */
        const clock_mask falls = j > 2 ? e->work[j] < e->work[j - 1] - 0.152 : EVERY,
                         rises = good & NOT(again) & (best == none + j) & (e->aim >= none + j) & falls;
        const clock more =
            control_log2(none + extrapolation_work(r, j + 1)) - control_log2(none + extrapolation_work(r, j));
        best = CHOOSE_WHERE(rises, none + (j + 1), best);
        longest = CHOOSE_WHERE(rises, longest + more, longest);
    }
    const clock_mask held = NOT(good) | again;
    const clock bound = CHOOSE_WHERE(good, none, none - 0.5);
    *aim = CHOOSE_WHERE(held & (best > e->aim), e->aim, best);
    *size = CHOOSE_WHERE(held & (longest > bound), bound, longest);
}

/* Judges line j, from the sums that the rule has left: the step ends with it if its error is allowed, or if the step is
 * refused. A step that was cut short tells nothing about the next one. */
static inline void extrapolation_judge(work *w, extrapolation *e, const extrapolation_rule *r, int j)
{
    const clock none = {0}, estimate = extrapolation_candidate(w, e, j, r->each * j);
    if (j == 1) return;
    const clock error = extrapolation_error(e, j, estimate);
    const clock_mask good = error <= 1, hopeless = extrapolation_hopeless(e, j, estimate, error);
    extrapolation_note(w, e, r, j, error);
    e->estimate = estimate;
    const clock_mask due = e->aim <= none + (j + 1), at_aim = j == EXTRAPOLATION_LINES ? EVERY : e->aim == none + j,
                     found = (good & (due | e->soon)) | (NOT(good) & hopeless),
                     now = e->open & ((e->free & at_aim) | (NOT(e->free) & found));
    clock aim, size;
    extrapolation_choose(e, r, j, good, w->rise == 0, &aim, &size);
    const clock_mask kept = good & w->ends, finite = FINITE(error);
    const clock next = w->h * control_exp2(CHOOSE_WHERE(finite, size, none - 2)),
                most = CHOOSE_WHERE(w->h < 0, none - w->most, none + w->most),
                after = CHOOSE_WHERE(ABS(next) <= w->most, next, most);
    w->after = CHOOSE_WHERE(now, CHOOSE_WHERE(kept, w->next, after), w->after);
    w->before = CHOOSE_WHERE(now & NOT(kept | e->free), CHOOSE_WHERE(finite, aim, e->aim), w->before);
    w->span = CHOOSE_WHERE(now & good, none + j, w->span);
    w->rise = CHOOSE_WHERE(now, CHOOSE_WHERE(good, none + CONTROL_RISE, none), w->rise);
    w->error = CHOOSE_WHERE(now, error, w->error);
    e->open = e->open & NOT(now);
}

/* sums: arrays of the rule's sums. */
static inline void extrapolation_place(work *w, placing *p, int sums)
{
    w->xs = work_array(p, 1), w->vs = work_array(p, 1);
    w->dx = work_array(p, 1), w->dv = work_array(p, 1);
    w->next_x = work_array(p, 1), w->delta = work_array(p, 1);
    w->ks = work_array(p, 1 + sums);
    w->r = work_array(p, 2 * EXTRAPOLATION_LINES);
}

static inline void extrapolation_accept(work *w, clock_mask good)
{
    EACH(k) MOVE_WHERE(good, true, w->x[k], w->ex[k], w->dx[k]);
    EACHV(k) MOVE_WHERE(good, true, w->v[k], w->ev[k], w->dv[k]);
    control_known(w, NOT(good));
}

#ifdef ROWS
/* order: of the estimate at the row's line. */
static void extrapolation_plan(work *w, const double argument[2], coef *unit, coef *c)
{
    (void)argument, (void)unit;
    w->stages = 1;
    w->order = 2 * w->row->lines - 2;
    if (c) c[0] = 0;
}
#endif
