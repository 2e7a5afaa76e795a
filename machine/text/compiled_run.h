/* The last text of a compiled model of one trajectory: the functions that the library's stepper calls.
 *
 * Invariant: motus_run copies the library's workspace, advances the copy and copies it back. Where the system is SMALL
 * it copies the arrays too, so that the compiler can keep them in registers, and tests at the end whether the copy is
 * finite, since a number that is not finite stays so. In a small system the library's own loop takes, to equal bits,
 * the steps whose text would take the compiler as long as all the rest: the first step of a leg, the steps that fill no
 * vector of times, and the steps in which something fails, from the workspace as it was.
 */
/* Tells whether the steps end here, because something may have happened in the last one. */
static inline bool compiled_met(const work *w) { return WATCHES(w) && w->watch->met; }

#if TERMS
/* Takes LANES_OF_TIME steps at a time and first computes the table of the steps after them, which the processor
 * overlaps with the latency of the present steps. SMALL: `steps` is a multiple of that. */
static inline int compiled_steps(work *w, whole steps)
{
    enum { HALF = LANES_OF_TIME * MOMENTS * TERMS };
    const compiled_host *host = w->host;
    clock table[2 * HALF];
    int bad = STEP_OK;
    w->table = table;
    compiled_fill(host, w->t0, w->h, table, w->n, LANES_OF_TIME);
    while (!bad && steps > 0 && !compiled_met(w)) {
        const whole some = SMALL || steps > LANES_OF_TIME ? LANES_OF_TIME : steps;
        w->first = w->n;
        compiled_fill_some(host, w->t0, w->h, table + HALF, w->n + LANES_OF_TIME, false);
        bad = advance_run(w, some);
        for (int k = 0; k < HALF; k++) table[k] = table[HALF + k];
        steps -= some;
    }
    w->table = NULL;
    return bad;
}
#else
#define compiled_steps advance_run
#endif

/* Returns what is known of the series at the present state: all or nothing, since the library's loop keeps order 0
 * elsewhere. */
static inline int compiled_expanded(const work *w)
{
#if FACT_expands
    return w->expanded == TAYLOR_WHOLE ? TAYLOR_WHOLE : TAYLOR_NOTHING;
#else
    return (void)w, 0;
#endif
}

#if SMALL
/* Takes steps with a copy of the workspace. It is flat, so that the copy can stay in registers and the plan's numbers
 * are constants. False: something failed, and nothing has changed. */
__attribute__((flatten)) static bool compiled_small(work *given, whole steps)
{
    enum { STRIDE = (NUMBERS + 7) / 8 * 8 }; /* as the library's solver expects it */
    work local = *given, *w = &local;
    real room[ARRAYS * STRIDE];
    clock scaled[CONSTANTS + 1];
    w->diagonal = NULL;
    w->stride = STRIDE;
    w->moved = 0;
    w->fresh &= ROW_adaptive;
    WRITTEN_OUT for (int i = 0; i < CONSTANTS; i++) scaled[i] = given->scaled[i];
    w->scaled = scaled;
    w->ex = w->ev = w->old = w->next_x = w->delta = w->r = w->xs = w->vs = w->ks = w->dx = w->dv = NULL;
    w->low = w->us = NULL;
    work_place(w, room);
#if FACT_expands /* they stay where they are, for dense output */
    w->xs = given->xs, w->vs = given->vs, w->r = given->r, w->ks = given->ks;
    w->expanded = compiled_expanded(given);
    given->expanded = 0;
#endif
    work_move(w, given, NUMBERS);
    if (compiled_steps(w, steps) || !advance_finite(w)) return false;
    work_move(given, w, NUMBERS);
    given->n = w->n, given->evaluations = w->evaluations, given->iterations = w->iterations, given->fresh = false;
#if FACT_carried
    given->t = w->t, given->lost = w->lost, given->refused = w->refused, given->ends = w->ends;
    given->next = w->next, given->before = w->before, given->rise = w->rise, given->stalled = w->stalled;
    given->shortest = w->shortest, given->longest = w->longest, given->span = w->span;
    given->fresh = w->fresh;
    given->owed_evaluations = w->owed_evaluations, given->owed_iterations = w->owed_iterations;
    work_scale(given, w->h);
#endif
    return true;
}

/* Tells whether the library takes the next step: the first of a leg and, where steps adapt, one that begins with the
 * last evaluation of the step before while that is not known. */
static inline bool compiled_begins(const work *w)
{
    if (!ROW_adaptive) return w->n == 0;
    return w->next == 0 || (!ROW_density && control_last_is_first(w) && !w->fresh);
}

int motus_run(work *given, whole steps)
{
    const compiled_host *host = given->host;
    if (!FITS(host->u) || (given->watch && !WATCHES(given))) return host->run(given, steps);
    if (compiled_begins(given) && steps > 0) {
        const int bad = host->run(given, 1);
        if (bad || compiled_met(given)) return bad;
        steps--;
    }
#if TERMS
    const whole some = steps - steps % LANES_OF_TIME;
#else
    const whole some = steps;
#endif
    if (some > 0 && compiled_small(given, some)) {
        if (compiled_met(given)) return STEP_OK;
        steps -= some;
    }
    return steps > 0 ? host->run(given, steps) : STEP_OK;
}
#else
int motus_run(work *given, whole steps)
{
    if (!FITS(given->host->u) || (given->watch && !WATCHES(given))) return given->host->run(given, steps);
    work local = *given, *w = &local;
    int bad = STEP_OK;
    w->diagonal = NULL;
    w->expanded = compiled_expanded(given);
#if LOCAL
    window_open(w);
    if (!w->check && !WATCHES(w))
        tiled_run(w, steps);
    else
#endif
        bad = compiled_steps(w, steps);
    w->expanded = 0;
    *given = local;
    return bad;
}
#endif

#if FORCED
void motus_accel(const compiled_host *host, clock t, real *x, real *v, real *a) { compiled_evaluate(host, t, x, v, a); }
#endif

/* Tells whether the numbers in this text are those of the model; if not, the library's own loop takes the steps. */
int motus_fits(const double *u) { return (void)u, FITS(u); }

void motus_bind(const double *pool, const int64_t *q, double *u)
{
#if FORCED
    compiled_force_bind(pool, q, u);
#endif
#if DRIVEN
    compiled_boundary_bind(pool, q, u);
#endif
#if FACT_expands
    compiled_series_bind(pool, q, u);
#if DRIVEN
    compiled_boundary_series_bind(pool, q, u);
#endif
#endif
#ifdef BOUNDS
    compiled_least_bind(pool, q, u);
#endif
#if RULES
    compiled_values_bind(pool, q, u);
    compiled_rates_bind(pool, q, u);
    compiled_rounding_bind(pool, q, u);
    compiled_least_rates_bind(pool, q, u);
#endif
}

#if RULES /* number: that of ruled.h */
void motus_rules(const compiled_host *host, int number, clock t, real *x, real *v, real *a, const real *dx,
                 const real *dv, real *out)
{
#define GIVEN host->pool, host->q, host->u, host->bound, host->own, t, (const clock *)0, x, v, a, out
    switch (number) {
    case 0: compiled_values(GIVEN); break;
    case 1: compiled_rates(GIVEN); break;
    case 2: compiled_rounding(GIVEN); break;
    case 3: compiled_least(GIVEN, dx, dv); break;
    default: compiled_least_rates(GIVEN, dx, dv);
    }
}
#endif
