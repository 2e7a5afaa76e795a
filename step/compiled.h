/* The last text of a compiled model: what joins the generated acceleration and the texts above it to the library's stepper.
 *
 * Before it stand what is known of the row and of the problem (ROW_…, FACT_…, DRIVEN), row.h, scalar.h, work.h, host.h, the functions and
 * operations that the model uses, `compiled_force`, and `compiled_boundary` where the boundary is driven.
 */
static inline const compiled_host *host_of(const work *w) { return **(const compiled_host *const *const *)w->user; }

static inline int accel(work *w, clock t, real *x, real *v, real *a)
{
    const compiled_host *host = host_of(w);
    w->evaluations++;
#if DRIVEN
    compiled_boundary(host->pool, host->q, host->u, t, x, v, a);
#endif
    compiled_force(host->pool, host->q, host->u, t, x, v, a);
    return STEP_OK;
}

static inline int solve_factor(work *w, int s, const clock *ax, const clock *av, clock t, real *x, real *v)
{
    return host_of(w)->factor(w, s, ax, av, t, x, v);
}
static inline void solve_back(work *w, real *r) { host_of(w)->back(w, r); }
static inline void solve_apply(work *w, clock c, const real *y, real *out) { host_of(w)->apply(w, c, y, out); }
