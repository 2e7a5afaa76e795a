/* Linear systems of lanes. Every lane has its own matrix, which is factored and solved by the operations of
 * core/solver.c and solver_band.c, in their order.
 *
 * Included after definitions that are written for the model and the row: SOLVE_N unknowns, SOLVE_LOWER and SOLVE_UPPER
 * diagonals, SOLVE_CONSTANT; the type `solving`; solve_derive (the entries of the derivatives), solve_fill (the matrix,
 * column by column; or its diagonal, if it has no other entries), solve_take and solve_give (from the stages' order to
 * that of the unknowns, and back), solve_multiply, solve_turns. Invariant: each lane has its own pivots and skips its
 * own operations, by selecting among results; entries outside the band are 0 and stay so. A lane whose matrix is
 * singular is marked in host->lost by a NaN; one in which a gyroscopic row meets a velocity term that does work, by an
 * infinity. What is constant is factored once in a call.
 */
#define SOLVE_DIAGONAL (SOLVE_LOWER + SOLVE_UPPER == 0)
#define SOLVE_MATRIX (SOLVE_DIAGONAL ? SOLVE_N : SOLVE_N * SOLVE_N)
#define SOLVE_SIZE ((sizeof(solving) + 63) / 64 * 64)
const size_t motus_lanes_solving = SOLVE_SIZE;

static inline void solve_begin(compiled_host *host, const lanes_job *job, size_t group, bool factored)
{
    host->solving = (solving *)(void *)(job->solving + group * SOLVE_SIZE);
    host->factored = factored;
    if (!factored) host->solving->lossy = false;
}

/* Matrices that change with the state are local variables of a loop over steps, from SOLVE_NEAR to SOLVE_FAR: so the
 * compiler keeps them in registers, and knows that writing them changes no parameter. */
#if SOLVE_CONSTANT
#define SOLVE_NEAR(host, z, lost)
#define SOLVE_FAR(job, group, lost)
#else
#define SOLVE_NEAR(host, z, lost_) \
    solving z;                     \
    real lost_ = MANY(0.0);        \
    z.lossy = false;               \
    host.solving = &z;             \
    host.lost = &lost_;
#define SOLVE_FAR(job, group, lost_) job->lost[group] = lost_;
#endif
static inline clock *solve_coefficients(const compiled_host *host) { return host->solving->a; }

/* Marks the lanes `where`; mostly there are none. */
static inline void solve_lose(const compiled_host *host, mask where)
{
    if (!SOME(where)) return;
    *host->lost = PICK(where, MANY((double)NAN), *host->lost);
    host->solving->lossy = true;
}
static inline void solve_stop(work *w, mask where) { solve_lose(w->host, where); }
static inline void solve_spoil(work *w, real *y)
{
    const real lost = *w->host->lost;
    if (w->host->solving->lossy)
        EACHV(k) y[k] = PICK(lost == 0, y[k], lost);
}

#define SOLVE_LAST(j, reach) ((j) + (reach) < SOLVE_N - 1 ? (j) + (reach) : SOLVE_N - 1)
#if SOLVE_DIAGONAL
static inline mask solve_lu(real *restrict m, real *restrict pivot)
{
    mask regular = ALWAYS;
    (void)pivot;
    for (int k = 0; k < SOLVE_N; k++) regular = regular & (m[k] != 0);
    return regular;
}
static inline void solve_lu_back(const real *restrict m, const real *restrict pivot, real *restrict b)
{
    (void)pivot;
    for (int k = 0; k < SOLVE_N; k++) b[k] /= m[k];
}
#else
/* Exchanges row j and the row that each lane has picked. */
static inline void solve_swap(real *restrict m, real best, int j)
{
    for (int i = 1; i <= SOLVE_LAST(j, SOLVE_LOWER) - j; i++) {
        const mask here = best == i;
        for (int c = j; c <= SOLVE_LAST(j, SOLVE_LOWER + SOLVE_UPPER); c++) {
            real *at = m + c * SOLVE_N + j;
            const real keep = at[0];
            at[0] = PICK(here, at[i], keep);
            at[i] = PICK(here, keep, at[i]);
        }
    }
}

/* Tells in which lanes the matrix is regular. */
static inline mask solve_lu(real *restrict m, real *restrict pivot)
{
    mask regular = ALWAYS;
    WRITTEN_OUT for (int j = 0; j < SOLVE_N; j++)
    {
        real *column = m + j * SOLVE_N + j, largest = ABS(column[0]), best = MANY(0.0);
        const int below = SOLVE_LAST(j, SOLVE_LOWER) - j;
        WRITTEN_OUT for (int i = 1; i <= below; i++)
        {
            const mask more = ABS(column[i]) > largest;
            largest = PICK(more, ABS(column[i]), largest);
            best = PICK(more, (double)i, best);
        }
        pivot[j] = best;
        regular = regular & (largest != 0) & FINITE(largest);
        if (SOME(best != 0)) solve_swap(m, best, j);
        const real inverse = 1.0 / column[0];
        WRITTEN_OUT for (int i = 1; i <= below; i++) column[i] *= inverse;
        for (int c = j + 1; c <= SOLVE_LAST(j, SOLVE_LOWER + SOLVE_UPPER); c++) {
            real *at = m + c * SOLVE_N + j;
            const real factor = -at[0];
            const mask skipped = factor == 0;
            WRITTEN_OUT for (int i = 1; i <= below; i++) at[i] = PICK(skipped, at[i], FMA(factor, column[i], at[i]));
        }
    }
    return regular;
}

static inline void solve_lu_back(const real *restrict m, const real *restrict pivot, real *restrict b)
{
    WRITTEN_OUT for (int j = 0; j < SOLVE_N; j++)
    {
        const real *column = m + j * SOLVE_N + j, best = pivot[j];
        const int below = SOLVE_LAST(j, SOLVE_LOWER) - j;
        if (SOME(best != 0))
            for (int i = 1; i <= below; i++) {
                const mask here = best == i;
                const real keep = b[j];
                b[j] = PICK(here, b[j + i], keep);
                b[j + i] = PICK(here, keep, b[j + i]);
            }
        WRITTEN_OUT for (int i = 1; i <= below; i++) b[j + i] = FMA(-b[j], column[i], b[j + i]);
    }
    WRITTEN_OUT for (int j = SOLVE_N - 1; j >= 0; j--)
    {
        const real *column = m + j * SOLVE_N + j;
        const int above = j < SOLVE_LOWER + SOLVE_UPPER ? j : SOLVE_LOWER + SOLVE_UPPER;
        b[j] /= column[0];
        WRITTEN_OUT for (int i = 1; i <= above; i++) b[j - i] = FMA(-b[j], *(column - i), b[j - i]);
    }
}
#endif

/* Factors for the lanes `where`, and takes the singular ones out of `where`: their matrix becomes NaN, and so does what
 * they solve. */
static inline void solve_renew(const compiled_host *host, solving *z, mask *where, const clock *ax, const clock *av,
                               clock t, real *x, real *v)
{
    real m[SOLVE_MATRIX], pivot[SOLVE_N];
    solve_derive(host, t, x, v, z);
    solve_fill(z, ax, av, m);
    const mask regular = solve_lu(m, pivot), singular = *where & NOT(regular);
    solve_lose(host, singular);
    if (SOME(singular))
        for (int k = 0; k < SOLVE_MATRIX; k++) m[k] = PICK(singular, MANY((double)NAN), m[k]);
    if (!SOME(NOT(*where))) {
        for (int k = 0; k < SOLVE_MATRIX; k++) z->matrix[k] = m[k];
        for (int k = 0; k < SOLVE_N && !SOLVE_DIAGONAL; k++) z->pivot[k] = pivot[k];
    } else {
        for (int k = 0; k < SOLVE_MATRIX; k++) z->matrix[k] = PICK(*where, m[k], z->matrix[k]);
        for (int k = 0; k < SOLVE_N && !SOLVE_DIAGONAL; k++) z->pivot[k] = PICK(*where, pivot[k], z->pivot[k]);
    }
    *where = *where & regular;
}

/* A constant matrix does not depend on the state, so the state can stay in registers. */
__attribute__((noinline, cold, unused)) static void solve_once(const compiled_host *host, const clock *ax,
                                                               const clock *av, clock t)
{
    real none[FACT_nv];
    mask all = ALWAYS;
    for (int k = 0; k < FACT_nv; k++) none[k] = MANY(0.0);
    solve_renew(host, host->solving, &all, ax, av, t, none, none);
    *host->lost = PICK(solve_turns(host->solving), *host->lost, MANY((double)INFINITY));
    host->solving->lossy = SOME(*host->lost != 0);
}

static inline int solve_factor(work *w, mask *where, int s, const clock *ax, const clock *av, clock t, real *x, real *v)
{
    const compiled_host *host = w->host;
    (void)s;
    if (!SOLVE_CONSTANT)
        solve_renew(host, host->solving, where, ax, av, t, x, v);
    else if (!host->factored)
        solve_once(host, ax, av, t);
    return STEP_OK;
}

static inline void solve_back(work *w, real *r)
{
    const solving *z = w->host->solving;
    real b[SOLVE_N];
    solve_take(r, w->stride, b);
    solve_lu_back(z->matrix, z->pivot, b);
    solve_give(r, w->stride, b);
}

static inline void solve_apply(work *w, clock c, const real *y, real *out)
{
    solve_multiply(w->host->solving, c, y, out);
}
