/* The text of a compiled model that joins the generated acceleration to the texts of step/; compiled_run.h or lanes.h
 * comes last.
 *
 * Before it stand what is known of the row and of the problem (ROW_…, FACT_…, DRIVEN, MOMENTS, TERMS), work.h, host.h
 * with their vocabulary, the functions and operations that the model uses, `compiled_force`, and `compiled_boundary`
 * where the boundary is driven.
 *
 * Invariant: TERMS values of time alone are computed at all moments of the next steps at once, in lanes, and wait in
 * w->table. They are the values that one evaluation would compute.
 */
#define BOUNDARY(host, t, x, v, a) \
    compiled_boundary(host->pool, host->q, host->u, host->bound, host->own, t, (const clock *)0, x, v, a, (real *)0)
#if WINDOWED /* pass.h: of all outer indices, and of those that are the workspace's turn */
static void pass_all(const compiled_host *, clock t, const clock *T, real *x, real *v, real *a);
static void pass_force(work *, clock t, const clock *T, real *x, real *v, real *a);
#define FORCE(host, t, T, x, v, a) pass_all(host, t, T, x, v, a)
#define FORCE_OF(w, t, T, x, v, a) pass_force(w, t, T, x, v, a)
#else
#define FORCE(host, t, T, x, v, a) \
    compiled_force(host->pool, host->q, host->u, host->bound, host->own, t, T, x, v, a, (real *)0)
#define FORCE_OF(w, t, T, x, v, a) FORCE(w->host, t, T, x, v, a)
#endif

/* The values of time alone, now; T is room for them. */
static inline const clock *compiled_terms(const compiled_host *host, clock t, clock *T)
{
#if TERMS
    reals many[TERMS];
    compiled_force_terms(host->pool, host->q, host->u, MANY(t), many);
    for (int k = 0; k < TERMS; k++) T[k] = LANE_OF(many[k], 0);
#else
    (void)host, (void)t;
#endif
    return T;
}

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
    return STEP_OK;
}

static inline int accel(work *w, clock t, real *x, real *v, real *a)
{
    clock T[TERMS + 1];
    return accel_with(w, t, compiled_terms(w->host, t, T), x, v, a);
}

#if TERMS
static inline const clock *compiled_table(const work *w, int moment)
{
    return w->table + ((w->n - w->first) * MOMENTS + moment) * TERMS;
}

/* Within a step there always is a table. */
static inline int compiled_accel_in(work *w, int i, real *x, real *v, real *a)
{
    return accel_with(w, time_in(w, FACT(w, c)[i]), compiled_table(w, fact_moment[i]), x, v, a);
}

static inline int compiled_accel_now(work *w, real *x, real *v, real *a)
{
    if (fact_at[0] != 0) return accel(w, time_now(w), x, v, a);
    return accel_with(w, time_now(w), compiled_table(w, 0), x, v, a);
}

/* The table of LANES_OF_TIME steps from number `n` on. It is given time and step alone, so that a workspace may stay
 * in registers. */
static inline void compiled_fill_some(const compiled_host *host, clock t0, clock h, clock *restrict table, whole n)
{
    const work clockwork = {.t0 = t0, .h = h}, *w = &clockwork;
    reals step;
    for (int l = 0; l < LANES_OF_TIME; l++) LANE_OF(step, l) = l;
    step += (clock)n;
    for (int m = 0; m < MOMENTS; m++) {
        reals many[TERMS];
        compiled_force_terms(host->pool, host->q, host->u, TIME_FIXED(w, step, fact_at[m]), many);
        for (int k = 0; k < TERMS; k++)
            for (int l = 0; l < LANES_OF_TIME; l++) table[(l * MOMENTS + m) * TERMS + k] = LANE_OF(many[k], l);
    }
}

/* Of `count` steps, and as many more as fill a vector. */
__attribute__((noinline)) static void compiled_fill(const compiled_host *host, clock t0, clock h, clock *restrict table,
                                                    whole n, whole count)
{
    for (whole k = 0; k < count; k += LANES_OF_TIME)
        compiled_fill_some(host, t0, h, table + k * MOMENTS * TERMS, n + k);
}
#endif

/* Who asks for the exact motion asks the library. */
#define exact_at(w, t, x, v) STEP_OK

/* Lanes have a text of their own: solve.h. */
#ifndef GROUPS
/* One equation in v alone: its diagonal, where it is constant, is fetched once. */
#define ONE_SLOPE (FACT(w, solves) == 1 && !FACT(w, solves_x))
static inline int solve_factor(work *w, truth *where, int s, const clock *ax, const clock *av, clock t, real *x,
                               real *v)
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
