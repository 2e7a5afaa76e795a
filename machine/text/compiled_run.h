/* The last text of a compiled model of one trajectory: the functions that the library's stepper calls.
 *
 * Invariant: motus_run copies the library's workspace, advances the copy and copies it back. Where the system is SMALL
 * it copies the arrays too, so that the compiler can keep them in registers, and tests only after every SPAN steps
 * whether the copy is finite, since a number that is not finite stays so. Where that test or a step fails, the
 * library's own loop takes these steps again, from the workspace as it was.
 */
#if TERMS
/* Takes LANES_OF_TIME steps at a time and first computes the table of the steps after them, which the processor
 * overlaps with the latency of the present steps. */
static inline int compiled_steps(work *w, whole steps)
{
    enum { HALF = LANES_OF_TIME * MOMENTS * TERMS };
    const compiled_host *host = w->host;
    clock table[2 * HALF];
    int bad = STEP_OK;
    w->table = table;
    compiled_fill(host, w->t0, w->h, table, w->n, LANES_OF_TIME);
    while (!bad && steps > 0) {
        const whole some = steps < LANES_OF_TIME ? steps : LANES_OF_TIME;
        w->first = w->n;
        compiled_fill_some(host, w->t0, w->h, table + HALF, w->n + LANES_OF_TIME);
        bad = some == LANES_OF_TIME ? advance_run(w, LANES_OF_TIME) : advance_run(w, some);
        for (int k = 0; k < HALF; k++) table[k] = table[HALF + k];
        steps -= some;
    }
    w->table = NULL;
    return bad;
}
#else
#define compiled_steps advance_run
#endif

/* inlined, so that the workspace can stay in registers and the plan's numbers are constants */
#if SMALL
__attribute__((flatten))
#endif
int motus_run(work *given, whole steps)
{
    enum { SPAN = 1024, STRIDE = (NUMBERS + 7) / 8 * 8 }; /* as the library's solver expects it */
    for (whole some; steps > 0; steps -= some) {
        work local = *given, *w = &local;
        w->diagonal = NULL;
#if SMALL
        some = steps < SPAN ? steps : SPAN;
        real room[ARRAYS * STRIDE];
        clock scaled[CONSTANTS + 1];
        w->check = false;
        w->stride = STRIDE;
        w->moved = 0;
        WRITTEN_OUT for (int i = 0; i < CONSTANTS; i++) scaled[i] = given->scaled[i];
        w->scaled = scaled;
        w->ex = w->ev = w->old = w->next_x = w->delta = w->r = w->xs = w->vs = w->ks = NULL;
        work_place(w, room);
        work_move(w, given, NUMBERS);
        if (compiled_steps(w, some) || !advance_finite(w)) return given->host->run(given, some);
        work_move(given, w, NUMBERS);
        given->n = w->n, given->evaluations = w->evaluations, given->iterations = w->iterations,
        given->fresh = w->fresh;
#if FACT_carried
        given->t = w->t, given->lost = w->lost, given->next = w->next, given->refused = w->refused,
        given->stalled = w->stalled;
        work_scale(given, w->h);
#endif
#else
        some = steps;
        int bad = STEP_OK;
#if LOCAL
        window_open(w);
        if (!w->check)
            tiled_run(w, steps);
        else
#endif
            bad = compiled_steps(w, steps);
        *given = local;
        if (bad) return bad;
#endif
    }
    return STEP_OK;
}

void motus_accel(const compiled_host *host, clock t, real *x, real *v, real *a) { compiled_evaluate(host, t, x, v, a); }

void motus_bind(const double *pool, const int64_t *q, double *u)
{
    compiled_force_bind(pool, q, u);
#if DRIVEN
    compiled_boundary_bind(pool, q, u);
#endif
}
