/* The acceleration of a model whose outer indices can be divided: over a window, or over all of them by several
 * threads; and the pass of a model of neighbours, which computes acceleration, kick and drift in one sweep over memory.
 *
 * Invariant: the operations on a number, and their order, are those of splitting.h.
 */
/* Not inlined, so that their loops have all registers, and whether they make a pass is a compile-time constant. */
#define PASS_WINDOW(...)                                                                                             \
    compiled_force(host->pool, host->q, host->u, host->bound, host->own, t, T, x, v, a, (real *)0, at->from, at->to, \
                   &(window_put){__VA_ARGS__})

__attribute__((noinline, flatten)) static void pass_keep(const compiled_host *host, clock t, const clock *T, real *x,
                                                         real *v, real *a, const window *at)
{
    PASS_WINDOW(.pass = false);
}

/* Computes all accelerations, those of fixed cells too, since a pass may have used the array for its other copy of
 * x. */
static void pass_all(const compiled_host *host, clock t, const clock *T, real *x, real *v, real *a)
{
    const tiling *in = host->tiling;
    for (size_t i = 0; i < in->fixed_count; i++)
        for (size_t k = in->fixed[2 * i]; k < in->fixed[2 * i + 1]; k++) a[k] = 0;
    pass_keep(host, t, T, x, v, a, &(window){.from = -WINDOW_ALL, .to = WINDOW_ALL});
}

#if LOCAL
/* Puts the acceleration of the fixed cells in the window, which is 0. */
__attribute__((noinline)) static void pass_fixed(const work *w, real *x, real *v, real *a, const window_put *move)
{
    const tiling *in = w->host->tiling;
    if (w->window.from <= in->first && w->window.to > in->last) { /* the window has all of them */
        for (size_t i = 0; i < in->fixed_count; i++)
            for (size_t k = in->fixed[2 * i]; k < in->fixed[2 * i + 1]; k++) PUT(k, 0);
        return;
    }
    for (int p = 0; p < in->parts; p++) {
        const size_t begin = window_place(&in->part[p], w->window.from), end = window_place(&in->part[p], w->window.to);
        size_t low = 0, high = in->fixed_count; /* the first range that ends after `begin` */
        while (low < high) {
            const size_t middle = (low + high) / 2;
            if (in->fixed[2 * middle + 1] <= begin)
                low = middle + 1;
            else
                high = middle;
        }
        for (; low < in->fixed_count && in->fixed[2 * low] < end; low++)
            for (size_t k = in->fixed[2 * low]; k < in->fixed[2 * low + 1]; k++)
                if (k >= begin && k < end) PUT(k, 0);
    }
}

__attribute__((noinline)) static void pass_force(work *w, clock t, const clock *T, real *x, real *v, real *a)
{
    window_move(w, w->host->tiling->around);
    pass_fixed(w, x, v, a, &(window_put){.pass = false});
    pass_keep(w->host, t, T, x, v, a, &w->window);
    window_move(w, w->host->tiling->around);
}

#if !FIRST_ORDER
#define PASS_MOVE(name, twice, ends)                                                                                   \
    __attribute__((noinline, flatten)) static void name(const compiled_host *host, clock t, const clock *T, real *x,   \
                                                        real *v, real *a, const window *at, const window_put *how)     \
    {                                                                                                                  \
        PASS_WINDOW(true, twice, ends, how->opens, how->b, how->c, how->next, how->way, how->way_low, how->x, how->ex, \
                    how->ev, how->low);                                                                                \
    }
PASS_MOVE(pass_move, false, false)
PASS_MOVE(pass_move_twice, true, ROW(w, compensated))
PASS_MOVE(pass_move_end, false, true)

/* Takes stage i from the positions `from`; the new positions go to `to`. */
static inline void pass_sweep(work *w, int i, real *from, real *to, const window_put *move)
{
    const clock t = time_in(w, FACT(w, c)[i]);
    clock room[TERMS + 1];
#if TERMS
    const clock *T = w->table ? compiled_table(w, fact_moment[i]) : compiled_terms(w->host, t, room);
#else
    const clock *T = room;
#endif
    w->evaluations++;
    window_move(w, w->host->tiling->pass);
    pass_fixed(w, from, w->v, to, move);
    if (move->twice)
        pass_move_twice(w->host, t, T, from, w->v, to, &w->window, move);
    else if (move->ends)
        pass_move_end(w->host, t, T, from, w->v, to, &w->window, move);
    else
        pass_move(w->host, t, T, from, w->v, to, &w->window, move);
}

/* v += b a, x += c v; then the opening drift of the next step, where there is one and that step is in the same tile. */
#define PASS(w, i, b, c) pass_run(w, i, b, c)
__attribute__((noinline)) static void pass_run(work *w, int i, clock b, clock c)
{
    const bool twice = DRIFTS_FIRST && w->window.more && i == FACT(w, stages) - 1;
    real *x = w->x, *next = w->a;
    pass_sweep(
        w, i, x, next,
        &(window_put){
            .pass = true, .twice = twice, .b = b, .c = c, .next = DRIFTS_FIRST ? w->scaled[FACT(w, stages)] : 0});
    w->moved += twice ? 2 : 1;
    w->x = next;
    w->a = x;
}

/* Takes stage i of a compensated row, from the positions `at`, and the end of the step. The row has at least two passes
 * in a step, so x, which neighbours read in the first, may change in the last. */
#define PASS_APART(w, i, b, c, at, way, way_low, opens, ends) pass_apart(w, i, b, c, at, way, way_low, opens, ends)
__attribute__((noinline)) static void pass_apart(work *w, int i, clock b, clock c, real *at, clock way, clock way_low,
                                                 bool opens, bool ends)
{
    const bool twice = DRIFTS_FIRST && w->window.more && ends;
    real *next = at == w->x ? w->xs : w->a;
    pass_sweep(w, i, at, next,
               &(window_put){.pass = true,
                             .twice = twice,
                             .ends = ends,
                             .opens = opens,
                             .b = b,
                             .c = c,
                             .next = DRIFTS_FIRST ? w->scaled[FACT(w, stages)] : 0,
                             .way = way,
                             .way_low = way_low,
                             .x = w->x,
                             .ex = w->ex,
                             .ev = w->ev,
                             .low = w->low});
    w->moved += ends ? 2 + twice : 1;
    if (next == w->a) w->a = at, w->xs = next;
}
#endif

#else

typedef struct pass_job {
    const compiled_host *host;
    clock t;
    const clock *T;
    real *x, *v, *a;
    size_t tasks;
} pass_job;

static void pass_task(void *ctx, size_t k, int thread)
{
    (void)thread;
    const pass_job *job = ctx;
    const tiling *in = job->host->tiling;
    const whole cells = in->last - in->first + 1, tasks = (whole)job->tasks, i = (whole)k;
    window part = {.from = i == 0 ? -WINDOW_ALL : in->first + cells * i / tasks,
                   .to = i == tasks - 1 ? WINDOW_ALL : in->first + cells * (i + 1) / tasks};
    pass_keep(job->host, job->t, job->T, job->x, job->v, job->a, &part);
}

/* tasks for each thread, to balance the load; the fewest cells of a task */
enum { PASS_TASKS = 8, PASS_CELLS_MIN = 16 };

__attribute__((noinline)) static void pass_force(work *w, clock t, const clock *T, real *x, real *v, real *a)
{
    const compiled_host *host = w->host;
    const whole most = (host->tiling->last - host->tiling->first + 1) / PASS_CELLS_MIN;
    if (w->threads == 1 || most < 2) {
        pass_all(host, t, T, x, v, a);
        return;
    }
    pass_job job = {host, t, T, x, v, a, (size_t)window_sooner(w->threads * PASS_TASKS, most)};
    host->parallel(host->thread_pool, w->threads, job.tasks, pass_task, &job);
}
#endif
