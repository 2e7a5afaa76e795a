/* The last text of a compiled model: what joins the generated acceleration and the texts above it to the library's stepper.
 *
 * Before it stand row.h, scalar.h, work.h, host.h, elementary.h, the operations of the graph, `compiled_force` (and `compiled_boundary` where the
 * boundary is driven, DRIVEN 1), NX and NV (0: known at run time only), and THE_ROW, an initialiser of the row's family and flags.
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
static inline int exact_at(work *w, clock t, real *x, real *v) { return host_of(w)->exact(host_of(w)->ctx, t, x, v) ? STEP_CALLBACK : STEP_OK; }
static inline void refresh_at(work *w, clock t, real *x, real *v)
{
    if (host_of(w)->refresh) host_of(w)->refresh(host_of(w)->ctx, t, x, v);
}

/* The workspace in locals and the row a constant: what the row does not use is folded away. */
#define WITH_THE_ROW(work_, call)        \
    work local = *(work_), *w = &local;  \
    w->row = &the_row;                   \
    if (NX) w->nx = NX;                  \
    if (NV) w->nv = NV;                  \
    int bad = (call);                    \
    w->row = (work_)->row;               \
    *(work_) = local;                    \
    return bad
