/* The text of a compiled model that defines accel and the solver's functions (work.h) by the generated acceleration;
 * compiled_run.h or lanes.h comes last.
 *
 * Before it stand the constants of the row and of the problem (ROW_…, FACT_…, DRIVEN, MOMENTS, TERMS), work.h and
 * host.h with what they need, the functions and operations that the model uses, `compiled_force`, and
 * `compiled_boundary` where the boundary is driven.
 *
 * Invariant: the TERMS values that depend on time alone are computed for all moments of the next steps at once, in
 * lanes, and stored in w->table, with the bits that one evaluation gives.
 */
#define BOUNDARY(host, t, x, v, a) \
    compiled_boundary(host->pool, host->q, host->u, host->bound, host->own, t, (const clock *)0, x, v, a, (real *)0)
#if WINDOWED /* pass.h: over all outer indices, and over those of w->window */
static void pass_all(const compiled_host *, clock t, const clock *T, real *x, real *v, real *a);
static void pass_force(work *, clock t, const clock *T, real *x, real *v, real *a);
#define FORCE(host, t, T, x, v, a) pass_all(host, t, T, x, v, a)
#define FORCE_OF(w, t, T, x, v, a) pass_force(w, t, T, x, v, a)
#else
#define FORCE(host, t, T, x, v, a) \
    compiled_force(host->pool, host->q, host->u, host->bound, host->own, t, T, x, v, a, (real *)0)
#define FORCE_OF(w, t, T, x, v, a) FORCE(w->host, t, T, x, v, a)
#endif

#if TERMS
/* Is compiled once, for all callers but the loop over steps. */
__attribute__((noinline)) static void compiled_terms_apart(const compiled_host *host, const reals *t, reals *many)
{
    compiled_force_terms(host->pool, host->q, host->u, *t, many);
}
#endif

/* Returns the values that depend on time alone, at t; T is room for them. */
static inline const clock *compiled_terms(const compiled_host *host, clock t, clock *T)
{
#if TERMS
    const reals all = MANY(t);
    reals many[TERMS];
    compiled_terms_apart(host, &all, many);
    for (int k = 0; k < TERMS; k++) T[k] = LANE_OF(many[k], 0);
#else
    (void)host, (void)t;
#endif
    return T;
}

/* Sets the accelerations of modes to 0, since no formula does: `a` would keep what earlier steps have left there. */
static inline void modes_rest(const work *w, real *a)
{
    for (size_t k = FACT(w, nx) - MODES; k < FACT(w, nx); k++) a[k] = (real){0};
}

#if FORCED
__attribute__((noinline)) static void compiled_evaluate(const compiled_host *host, clock t, real *x, real *v, real *a)
{
    clock T[TERMS + 1];
#if DRIVEN
    BOUNDARY(host, t, x, v, a);
#endif
    FORCE(host, t, compiled_terms(host, t, T), x, v, a);
}

static inline int accel_with(work *w, clock t, const clock *T, real *x, real *v, real *a)
{
    w->evaluations++;
#if DRIVEN
    BOUNDARY(w->host, t, x, v, a);
#endif
    FORCE_OF(w, t, T, x, v, a);
    modes_rest(w, a);
    return STEP_OK;
}

static inline int accel(work *w, clock t, real *x, real *v, real *a)
{
    clock T[TERMS + 1];
    return accel_with(w, t, compiled_terms(w->host, t, T), x, v, a);
}
#else /* Taylor series need the force only for the size of the first step, and the library has it */
static inline int accel(work *w, clock t, real *x, real *v, real *a) { return w->host->accel(w, t, x, v, a); }
#endif

#if TERMS
static inline const clock *compiled_table(const work *w, int moment)
{
    return w->table + ((w->n - w->first) * MOMENTS + moment) * TERMS;
}

/* Within a step w->table is never NULL. */
static inline int compiled_accel_in(work *w, int i, real *x, real *v, real *a)
{
    return accel_with(w, time_in(w, FACT(w, c)[i]), compiled_table(w, fact_moment[i]), x, v, a);
}

static inline int compiled_accel_now(work *w, real *x, real *v, real *a)
{
    if (fact_at[0] != 0) return accel(w, time_now(w), x, v, a);
    return accel_with(w, time_now(w), compiled_table(w, 0), x, v, a);
}

/* Fills the table of LANES_OF_TIME steps from step n on. It takes t0 and h instead of a workspace, so that the
 * workspace can stay in registers. */
static inline void compiled_fill_some(const compiled_host *host, clock t0, clock h, clock *restrict table, whole n,
                                      bool apart)
{
    const work clockwork = {.t0 = t0, .h = h}, *w = &clockwork;
    reals step;
    for (int l = 0; l < LANES_OF_TIME; l++) LANE_OF(step, l) = l;
    step += (clock)n;
    for (int m = 0; m < MOMENTS; m++) {
        reals many[TERMS];
        const reals t = TIME_FIXED(w, step, fact_at[m]);
        if (apart)
            compiled_terms_apart(host, &t, many);
        else
            compiled_force_terms(host->pool, host->q, host->u, t, many);
        for (int k = 0; k < TERMS; k++)
            for (int l = 0; l < LANES_OF_TIME; l++) table[(l * MOMENTS + m) * TERMS + k] = LANE_OF(many[k], l);
    }
}

/* Fills the table of `count` steps, rounded up to whole vectors. */
__attribute__((noinline)) static void compiled_fill(const compiled_host *host, clock t0, clock h, clock *restrict table,
                                                    whole n, whole count)
{
    for (whole k = 0; k < count; k += LANES_OF_TIME)
        compiled_fill_some(host, t0, h, table + k * MOMENTS * TERMS, n + k, true);
}
#endif

#if FACT_expands
#ifndef GROUPS
#if SMALL
#define TAYLOR_APART __attribute__((noinline, flatten)) static
/* Copies what the orders use of the workspace, so that the workspace itself can stay in registers. */
#define TAYLOR_PART(w)                                                                                    \
    work part_of_it, *const part = &part_of_it;                                                           \
    part->host = (w)->host, part->xs = (w)->xs, part->vs = (w)->vs, part->r = (w)->r, part->ks = (w)->ks, \
    part->a = (w)->a
#else
#define TAYLOR_APART __attribute__((noinline)) static
#endif
#endif
static inline void series_order(work *w, int n, clock t)
{
    const compiled_host *host = w->host;
    real *kept = w->ks;
#if DRIVEN
    kept =
        compiled_boundary_series(host->pool, host->q, host->u, host->bound, host->own, n, t, w->xs, w->vs, kept, w->a);
#endif
    compiled_series(host->pool, host->q, host->u, host->bound, host->own, n, t, w->xs, w->vs, kept, w->a);
    modes_rest(w, w->a);
}
#endif

#if DRIVEN
#define refresh_at(w, t, x, v) BOUNDARY((w)->host, t, x, v, (real *)0)
#else
#define refresh_at(w, t, x, v) ((void)0)
#endif

/* The library computes the exact motion. */
#define exact_at(w, t, x, v) STEP_OK

/* Lanes have a text of their own: solve.h. */
#ifndef GROUPS
/* For one equation in v alone the constant diagonal, where there is one, is fetched once. */
#define ONE_SLOPE (FACT(w, solves) == 1 && !FACT(w, solves_x))
static inline int solve_factor(work *w, mask *where, int s, const clock *ax, const clock *av, clock t, real *x, real *v)
{
    const compiled_host *host = w->host;
    if (!ONE_SLOPE) return host->factor(w, where, s, ax, av, t, x, v);
    if (w->diagonal && w->slope == *av) return STEP_OK;
    int bad = host->factor(w, where, s, ax, av, t, x, v);
    w->diagonal = bad ? NULL : host->diagonal(w);
    w->slope = *av;
    return bad;
}
static inline void solve_back(work *w, real *r)
{
    if (ONE_SLOPE && w->diagonal)
        EACHV(k) r[k] /= w->diagonal[k];
    else
        w->host->back(w, r);
}
static inline void solve_apply(work *w, clock c, const real *y, real *out) { w->host->apply(w, c, y, out); }
#endif
