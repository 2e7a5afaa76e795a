/* Shared by the families with a tableau: the places of the constants of s stages in `unit`, and the sums over stages.
 *
 * a (s × s, row by row) and b belong to h; aa = A² and bb = bA, for positions formed from accelerations [HNW93, II.14],
 * to h².
 */
enum { TABLEAU_COUPLED_MAX = 8 }; /* stages of collocation */
static inline int tableau_a(const work *w, int i) { return i * FACT(w, stages); }
static inline int tableau_b(const work *w) { return FACT(w, stages) * FACT(w, stages); }
static inline int tableau_aa(const work *w, int i) { return tableau_b(w) + (1 + i) * FACT(w, stages); }
static inline int tableau_bb(const work *w) { return 2 * tableau_b(w) + FACT(w, stages); }
/* of coupled stages: the values of Lagrange's polynomials at stage i of the next step, without a factor h; after
 * DENSITY_REACH, where there is one */
static inline int tableau_ahead(const work *w, int i)
{
    return tableau_bb(w) + (1 + i) * FACT(w, stages) + ROW(w, density);
}
/* the coefficient of Legendre's polynomial k in the polynomial through the stages; without a factor h */
static inline int tableau_series(const work *w, int k)
{
    return tableau_ahead(w, 0) + tableau_b(w) + k * FACT(w, stages);
}
/* what rounding has left of b, or of bb: the end of the step takes both parts, since what is lost there would be lost
 * alike in every step; without a factor h */
static inline int tableau_rest(const work *w, bool x)
{
    return tableau_series(w, 0) + tableau_b(w) + x * FACT(w, stages);
}
/* what rounding has left of c; without a factor h */
static inline int tableau_low_c(const work *w) { return tableau_rest(w, false) + 2 * FACT(w, stages); }
/* what a change of stage i does to the others, where they are kept on a polynomial; without a factor h */
static inline int tableau_spread(const work *w, int i) { return tableau_low_c(w) + (1 + i) * FACT(w, stages); }
/* Tells whether the stages take c in both parts, and multiply the sums by h, not the constants: 14 and more orders
 * reach rounding at usual steps, and a stage that is off by the same part of h v in every step would make the energy
 * drift. */
static inline bool tableau_exact(const work *w) { return FACT(w, stages) > 6 && FACT(w, kept) > 0; }

/* Σ c[j] y[j][k] over `count` stages, c the scaled constants from number `from` on. */
static inline real tableau_sum(const work *w, int from, const real *restrict y, size_t k, int count)
{
    real sum = w->scaled[from] * y[k];
    for (int j = 1; j < count; j++) sum = FMA(w->scaled[from + j], y[(size_t)j * w->stride + k], sum);
    return sum;
}

/* Σ c[j] y[j][k], c the constants themselves without those that are 0 in the row, added to `sum` where there is one.
 * The step multiplies the whole sum: h/6 would be rounded alike in every step, and the motion run too fast or too
 * slow. */
static inline real tableau_weigh(const work *w, int from, const real *restrict y, size_t k, int count, bool more,
                                 real sum)
{
    EACH_STAGE(j, count) {
        if (!LIVE(w, from + j)) continue;
        const real term = y[(size_t)j * w->stride + k];
        const coef c = FACT(w, unit)[from + j];
        sum = more ? FMA(c, term, sum) : c * term;
        more = true;
    }
    return sum;
}

/* Tells whether some of `count` constants is not 0. */
static inline bool tableau_any(const work *w, int from, int count)
{
    bool any = false;
    EACH_STAGE(j, count) any = any || LIVE(w, from + j);
    return any;
}

/* Coupled stages: position and velocity of stage i from the accelerations of all. */
static inline void tableau_place(work *w, int i)
{
    const real *restrict x = w->x, *restrict v = w->v, *restrict K = w->ks;
    const int s = FACT(w, stages), aa = tableau_aa(w, i);
    const clock h = w->h, ch = w->c[i] * h;
    if (tableau_exact(w)) {
        const coef c = FACT(w, c)[i], low = FACT(w, unit)[tableau_low_c(w) + i];
        EACH(k) {
            const real sum = tableau_weigh(w, aa, K, k, s, false, (real){0});
            w->xs[k] = FMA(h, FMA(c, v[k], FMA(low, v[k], h * sum)), x[k]);
        }
        return;
    }
    EACH(k) w->xs[k] = x[k] + FMA(ch, v[k], tableau_sum(w, aa, K, k, s));
}

static inline void tableau_speed(work *w, int i)
{
    const real *restrict v = w->v, *restrict K = w->ks;
    const int s = FACT(w, stages), a = tableau_a(w, i);
    const clock h = w->h;
    if (tableau_exact(w))
        EACHV(k) w->vs[k] = FMA(h, tableau_weigh(w, a, K, k, s, false, (real){0}), v[k]);
    else
        EACHV(k) w->vs[k] = v[k] + tableau_sum(w, a, K, k, s);
}

/* The mean of the accelerations by the weights of v or of x, unrounded as they are. */
static inline real tableau_mean(const work *w, bool x, size_t k)
{
    const int s = FACT(w, stages), whole = x ? tableau_bb(w) : tableau_b(w);
    const real none = {0}, rest = tableau_weigh(w, tableau_rest(w, x), w->ks, k, s, false, none);
    return tableau_weigh(w, whole, w->ks, k, s, true, rest);
}

/* What the step adds to x[k] and to v[k]; of a compensated row with the error words. */
static inline real tableau_dx(const work *w, size_t k)
{
    const clock h = w->h;
    const real v = w->v[k];
    if (ROW(w, compensated)) return FMA(h, v + FMA(h, tableau_mean(w, true, k), w->ev[k]), w->ex[k]);
    return FMA(h, v, tableau_sum(w, tableau_bb(w), w->ks, k, FACT(w, stages)));
}

static inline real tableau_dv(const work *w, size_t k)
{
    if (ROW(w, compensated)) return FMA(w->h, tableau_mean(w, false, k), w->ev[k]);
    return tableau_sum(w, tableau_b(w), w->ks, k, FACT(w, stages));
}

/* The end of the step. */
static inline void tableau_finish(work *w)
{
    real *restrict x = w->x, *restrict v = w->v, *restrict ex = w->ex, *restrict ev = w->ev;
    EACH(k) MOVE_WHERE(EVERY, ROW(w, compensated), x[k], ex[k], tableau_dx(w, k));
    EACHV(k) MOVE_WHERE(EVERY, ROW(w, compensated), v[k], ev[k], tableau_dv(w, k));
}

/* The polynomial through the stages of the step before, at those of this one from `first` on. */
static inline void tableau_extrapolate(work *w, int first)
{
    const int s = FACT(w, stages);
    const size_t stride = w->stride;
    const coef *ahead = w->unit + tableau_ahead(w, 0);
    EACHV(k) {
        real next[TABLEAU_COUPLED_MAX];
        for (int i = first; i < s; i++) {
            next[i] = ahead[i * s] * w->ks[k];
            for (int j = 1; j < s; j++) next[i] = FMA(ahead[i * s + j], w->ks[(size_t)j * stride + k], next[i]);
        }
        for (int i = first; i < s; i++) w->ks[(size_t)i * stride + k] = next[i];
    }
}

/* Extrapolates where steps differ: by the polynomial of the stages that the row carries, moved so that it passes
 * through the acceleration of the state; or by that acceleration alone, where there is no polynomial yet, or a step
 * TABLEAU_REACH times as long would leave it far behind. w->span: of the step of those stages, or of a refused one with
 * its sign changed. */
enum { TABLEAU_REACH = 8 };
static inline void tableau_predict(work *w, int first)
{
    const int s = FACT(w, stages);
    const size_t stride = w->stride;
    const clock h = CHOOSE_WHERE(w->h < 0, -w->h, w->h), span = CHOOSE_WHERE(w->span < 0, -w->span, w->span);
    const clock_mask past = (w->span > 0) == (w->h > 0), near = h <= TABLEAU_REACH * span;
    const clock ratio = h / (span + SMALLEST), start = CHOOSE_WHERE(past, CLOCK(1), CLOCK(-1));
    clock ahead[TABLEAU_COUPLED_MAX][TABLEAU_COUPLED_MAX];
    for (int i = first; i < s; i++) {
        clock p[TABLEAU_COUPLED_MAX + 1] = {CLOCK(1), start + 2 * (FACT(w, c)[i] * ratio)}, sign = start;
        for (int k = 1; k < s; k++) {
            p[k + 1] = ((2 * k + 1) * p[1] * p[k] - k * p[k - 1]) / (k + 1);
            ahead[i][k] = CHOOSE_WHERE(near, p[k] - sign, CLOCK(0));
            sign = sign * start;
        }
    }
    EACHV(k) {
        real *K = w->ks + k, next[TABLEAU_COUPLED_MAX];
        for (int i = 0; i < s; i++) next[i] = w->a[k];
        for (int m = 1; m < s; m++) {
            const real c = tableau_weigh(w, tableau_series(w, m), w->ks, k, s, false, (real){0});
            for (int i = first; i < s; i++) next[i] = FMA(ahead[i][m], c, next[i]);
        }
        for (int i = 0; i < s; i++) K[(size_t)i * stride] = next[i];
    }
}

static int tableau_carry(const work *w, real *list[CARRY_MAX])
{
    int count = work_carry_main(w, list);
    if (FACT(w, known)) list[count++] = w->a;
    for (int i = 0; i < FACT(w, kept); i++) list[count++] = w->ks ? w->ks + (size_t)i * w->stride : w->ks;
    return count;
}

static inline void tableau_arrays(work *w, placing *p)
{
    w->xs = work_array(p, 1);
    w->vs = work_array(p, 1);
    work_density(w, p);
    w->ks = work_array(p, FACT(w, stages));
    w->r = work_array(p, FACT(w, stages));
}

#ifdef ROWS
static void tableau_sizes(work *w, int stages)
{
    w->stages = stages;
    w->linears = w->squares = stages * stages + stages;
}
#endif

#ifdef TRACING
static void tableau_tell(const work *w, int i, const real *X, const real *V, const real *A)
{
    const coef *unit = w->unit;
    tell(w, (trace_event){.kind = MOTUS_TRACE_STAGE,
                          .stage = i + 1,
                          .time = time_in(w, w->c[i]),
                          .coefficient = w->c[i],
                          .weight = unit[tableau_b(w) + i],
                          .weight_x = unit[tableau_bb(w) + i],
                          .row = unit + tableau_a(w, i),
                          .row_x = unit + tableau_aa(w, i),
                          .x = X,
                          .v = V,
                          .a = A});
}

/* Coupled stages, when their equation is solved. */
static void tableau_tell_solved(work *w)
{
    tell(w, (trace_event){.kind = MOTUS_TRACE_SOLVE, .time = time_now(w)});
    for (int j = 0; j < w->stages; j++) {
        tableau_place(w, j);
        tableau_speed(w, j);
        tableau_tell(w, j, w->xs, w->vs, w->ks + (size_t)j * w->stride);
    }
}

static trace_room tableau_room(const work *w)
{
    const size_t s = (size_t)w->stages;
    return (trace_room){.events = s + 1, .x = s, .v = 2 * s, .rows = 2 * s * s};
}
#endif
