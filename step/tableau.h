/* Shared by the families with a tableau: the places of the constants of s stages in `unit` and `scaled`, and the sums
 * over stages.
 *
 * a (s × s, row by row) and b are multiplied by h; aa = A² and bb = bA, for positions formed from accelerations [HNW93,
 * II.14], by h².
 */
enum { TABLEAU_COUPLED_MAX = 8 }; /* stages of collocation */
static inline int tableau_a(const work *w, int i) { return i * FACT(w, stages); }
static inline int tableau_b(const work *w) { return FACT(w, stages) * FACT(w, stages); }
static inline int tableau_aa(const work *w, int i) { return tableau_b(w) + (1 + i) * FACT(w, stages); }
static inline int tableau_bb(const work *w) { return 2 * tableau_b(w) + FACT(w, stages); }
/* of coupled stages: the values of Lagrange's polynomials at stage i of the next step, without a factor h */
static inline int tableau_ahead(const work *w, int i) { return tableau_bb(w) + (1 + i) * FACT(w, stages); }
/* the coefficient of Legendre's polynomial k in the polynomial through the stages; without a factor h */
static inline int tableau_series(const work *w, int k)
{
    return tableau_ahead(w, 0) + tableau_b(w) + k * FACT(w, stages);
}
/* what a change of stage i does to the others, where they are kept on a polynomial; without a factor h */
static inline int tableau_spread(const work *w, int i)
{
    return tableau_series(w, 0) + tableau_b(w) + i * FACT(w, stages);
}

/* Σ c[j] y[j][k] over `count` stages, c the constants from number `from` on; where `sparse`, without those that are 0
 * in the row. */
static inline real tableau_sum(const work *w, int from, bool sparse, const real *restrict y, size_t k, int count)
{
    real sum = {0};
    bool first = true;
    EACH_STAGE(j, count) {
        if (sparse && !LIVE(w, from + j)) continue;
        real term = y[(size_t)j * w->stride + k];
        if (first)
            sum = w->scaled[from + j] * term;
        else
            sum = FMA(w->scaled[from + j], term, sum);
        first = false;
    }
    return sum;
}

/* Coupled stages: position and velocity of stage i from the accelerations of all. */
static inline void tableau_place(work *w, int i)
{
    const real *restrict x = w->x, *restrict v = w->v, *restrict K = w->ks;
    const int s = FACT(w, stages), aa = tableau_aa(w, i);
    const clock ch = w->c[i] * w->h;
    EACH(k) w->xs[k] = x[k] + FMA(ch, v[k], tableau_sum(w, aa, false, K, k, s));
}

static inline void tableau_speed(work *w, int i)
{
    const real *restrict v = w->v, *restrict K = w->ks;
    const int s = FACT(w, stages), a = tableau_a(w, i);
    EACHV(k) w->vs[k] = v[k] + tableau_sum(w, a, false, K, k, s);
}

/* The end of the step. */
static inline void tableau_finish(work *w)
{
    real *restrict x = w->x, *restrict v = w->v, *restrict ex = w->ex, *restrict ev = w->ev;
    const real *restrict K = w->ks;
    const clock h = w->h;
    const int s = FACT(w, stages), b = tableau_b(w), bb = tableau_bb(w);
    if (ROW(w, compensated)) {
        EACH(k) ADVANCE_COMPENSATED(x[k], ex[k], 1, FMA(h, v[k], tableau_sum(w, bb, false, K, k, s)));
        EACHV(k) ADVANCE_COMPENSATED(v[k], ev[k], 1, tableau_sum(w, b, false, K, k, s));
    } else {
        EACH(k) x[k] += FMA(h, v[k], tableau_sum(w, bb, false, K, k, s));
        EACHV(k) v[k] += tableau_sum(w, b, false, K, k, s);
    }
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

#ifdef ROWS
static void tableau_sizes(work *w, int stages)
{
    w->stages = stages;
    w->linears = w->squares = stages * stages + stages;
}

/* Reads a, below the diagonal alone, and b, and forms aa and bb. */
static void tableau_fill(work *w, const coef *given_a, const coef *given_b, coef *unit)
{
    const int s = w->stages;
    coef *a = unit, *b = unit + tableau_b(w), *aa = unit + tableau_aa(w, 0), *bb = unit + tableau_bb(w);
    for (int i = 0; i < s; i++) {
        b[i] = given_b[i];
        bb[i] = 0;
        for (int j = 0; j < s; j++) {
            a[i * s + j] = j < i ? given_a[i * (i - 1) / 2 + j] : 0;
            aa[i * s + j] = 0;
        }
    }
    for (int i = 0; i < s; i++)
        for (int j = 0; j < s; j++)
            for (int l = 0; l < s; l++) {
                aa[i * s + j] += a[i * s + l] * a[l * s + j];
                if (i == 0) bb[j] += b[l] * a[l * s + j];
            }
}
#endif

#ifdef TRACING
static void tableau_tell(const work *w, int i, const real *X, const real *V, const real *A)
{
    const coef *unit = w->unit;
    tell(w, (trace_event){.kind = MOTUS_EVENT_STAGE,
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
    tell(w, (trace_event){.kind = MOTUS_EVENT_SOLVE, .time = time_now(w)});
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
