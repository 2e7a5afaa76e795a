/* Shared by the families with a tableau: the places of the constants of s stages in `unit`, and the sums over stages.
 *
 * a (s × s, row by row) and b belong to h; aa = A² and bb = bA, for positions formed from accelerations [HNW93, II.14],
 * to h².
 */
static inline int tableau_a(const work *w, int i) { return i * FACT(w, stages); }
static inline int tableau_b(const work *w) { return FACT(w, stages) * FACT(w, stages); }
static inline int tableau_aa(const work *w, int i) { return tableau_b(w) + (1 + i) * FACT(w, stages); }
static inline int tableau_bb(const work *w) { return 2 * tableau_b(w) + FACT(w, stages); }

/* Σ c[j] y[j][k] over `count` stages, c the scaled constants from number `from` on. */
static inline real tableau_sum(const work *w, int from, const real *restrict y, size_t k, int count)
{
    real sum = w->scaled[from] * y[k];
    for (int j = 1; j < count; j++) sum = FMA(w->scaled[from + j], y[(size_t)j * w->stride + k], sum);
    return sum;
}

/* The same of the constants themselves, without those that are 0 in the row, added to `sum` where there is one. The
 * step multiplies the whole sum: h/6 would be rounded alike in every step, and the motion run too fast or too slow. */
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

/* Whether some of `count` constants is not 0. */
static inline bool tableau_any(const work *w, int from, int count)
{
    bool any = false;
    EACH_STAGE(j, count) any = any || LIVE(w, from + j);
    return any;
}

#ifdef ROWS
static void tableau_sizes(work *w, int stages)
{
    w->stages = stages;
    w->linears = w->squares = stages * stages + stages;
}

/* hi + lo += a b, unevaluated: the rounding errors of product and sum go to lo. */
static void tableau_add(coef *hi, coef *lo, coef a, coef b)
{
    const coef p = a * b, error = FMA(a, b, -p), s = *hi + p, part = s - *hi;
    *lo += ((*hi - (s - part)) + (p - part)) + error;
    *hi = s;
}

/* Row r of s numbers times the s × s matrix a; every entry is rounded once. */
static void tableau_times(int s, const coef *r, const coef *a, coef *out)
{
    for (int j = 0; j < s; j++) {
        coef hi = 0, lo = 0;
        for (int l = 0; l < s; l++) tableau_add(&hi, &lo, r[l], a[l * s + j]);
        out[j] = hi + lo;
    }
}

/* Reads a and b, and forms aa and bb. */
static void tableau_fill(work *w, const coef *given_a, const coef *given_b, coef *unit)
{
    const int s = w->stages;
    coef *a = unit, *b = unit + tableau_b(w);
    for (int i = 0; i < s * s; i++) a[i] = given_a[i];
    for (int i = 0; i < s; i++) b[i] = given_b[i];
    for (int i = 0; i < s; i++) tableau_times(s, a + tableau_a(w, i), a, unit + tableau_aa(w, i));
    tableau_times(s, b, a, unit + tableau_bb(w));
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

static trace_room tableau_room(const work *w)
{
    const size_t s = (size_t)w->stages;
    return (trace_room){.events = s + 1, .x = s, .v = 2 * s, .rows = 2 * s * s};
}
#endif
