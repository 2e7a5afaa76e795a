/* TILES: trapezoidal tiling of a model of neighbours, several steps in one sweep over memory, by several threads.
 *
 * The outer indices are cut into blocks. In the plane of index and time a block is first advanced over the trapezoid
 * that needs no value of its neighbours: its inner ends move inwards with every pass. Then the seams between blocks,
 * triangles that widen by as much, are computed. Blocks do not depend on each other, nor do seams, so threads may take
 * them in any order. Within a block the trapezoid is cut into strips that lean to lower indices. A strip takes all
 * steps before the next strip begins, so its numbers stay in the cache; the test whether they are finite at the end
 * happens there too.
 *
 * Invariant: every number goes through the operations of the untiled loop in their order, with the same operands. What
 * a step changes besides the numbers (the step count, which copy of x is current) is the same for every tile; it is
 * taken from one of them.
 */
enum {
    /* bytes that a strip of one step touches, and all its steps */
    TILED_STRIP = 24 << 10,
    TILED_REACH = 192 << 10,
    TILED_LINE = 8,   /* numbers in a cache line */
    TILED_BLOCKS = 4, /* for each thread, to balance the load */
    /* in a sweep; what depends on time alone is computed for all of them beforehand */
    TILED_STEPS = TERMS * MOMENTS <= 128 ? 64 : 4
};

typedef struct tiled_job {
    const work *begin;
    work end;
    whole steps, strip, block;
    int blocks;
    bool last, diverged; /* last: this is the last sweep; diverged: a number is not finite at its end */
} tiled_job;

__attribute__((noinline)) static void tiled_steps(tiled_job *job, work *w)
{
    for (whole s = 0; s < job->steps; s++) {
        w->window.more = s + 1 < job->steps;
        (void)advance_step(w); /* nothing here can fail: no solver, no callback */
    }
    if (job->last && !advance_finite(w)) __atomic_store_n(&job->diverged, true, __ATOMIC_RELAXED);
}

static whole tiled_border(const tiled_job *job, int k) { return job->begin->host->tiling->first + k * job->block; }

static void tiled_block(void *ctx, size_t block, int thread)
{
    (void)thread;
    tiled_job *job = ctx;
    const int k = (int)block;
    const bool lowest = k == 0, highest = k == job->blocks - 1;
    const whole low = tiled_border(job, k),
                high = highest ? job->begin->host->tiling->last + 1 : tiled_border(job, k + 1);
    bool last = false;
    for (whole from = low; !last; from += job->strip) {
        last = from + job->strip >= high;
        work local = *job->begin, *w = &local;
        w->window = (window){.strip = {from == low ? -WINDOW_ALL : from, last ? WINDOW_ALL : from + job->strip},
                             .block = {lowest ? -WINDOW_ALL : low, highest ? WINDOW_ALL : high},
                             .slope = {lowest ? 0 : 1, highest ? 0 : -1}};
        window_meet(&w->window);
        tiled_steps(job, w);
        if (lowest && last) job->end = local;
    }
}

static void tiled_seam(void *ctx, size_t k, int thread)
{
    (void)thread;
    tiled_job *job = ctx;
    const whole border = tiled_border(job, (int)k + 1);
    work local = *job->begin, *w = &local;
    w->window = (window){.strip = {-WINDOW_ALL, WINDOW_ALL}, .block = {border, border}, .slope = {-1, 1}};
    window_meet(&w->window);
    tiled_steps(job, w);
}

static inline void tiled_run(work *w, whole steps)
{
    const compiled_host *host = w->host;
    const tiling *in = host->tiling;
    const whole cells = in->last - in->first + 1, row = (whole)(in->numbers * ARRAYS * sizeof(real));
    /* how far a window moves in one step, at most */
    const whole way = (w->stages > 1 ? w->stages : 1) * window_later(in->pass, 2 * in->around);
    tiled_job job = {.begin = w, .strip = TILED_STRIP / row, .blocks = 1};
    if (job.strip >= TILED_LINE) job.strip -= job.strip % TILED_LINE;
    if (job.strip < 1) job.strip = 1;
    whole most = way > 0 ? (TILED_REACH / row - job.strip) / way : TILED_STEPS;
    most = window_later(1, window_sooner(most, TILED_STEPS));
#if TERMS
    clock table[(TILED_STEPS + 2 * LANES_OF_TIME) * MOMENTS * TERMS];
    w->table = table;
#endif
    while (steps > 0) {
        job.steps = window_sooner(most, steps);
        job.last = job.steps == steps;
        if (w->threads > 1)
            job.blocks = (int)window_later(
                1, window_sooner(w->threads * TILED_BLOCKS, cells / (4 * way * job.steps + TILED_LINE)));
        job.block = cells / job.blocks;
        if (job.block >= TILED_LINE) job.block -= job.block % TILED_LINE;
#if TERMS
        w->first = w->n;
        compiled_fill(host, w->t0, w->h, table, w->n, job.steps + 1);
#endif
        host->parallel(host->thread_pool, w->threads, (size_t)job.blocks, tiled_block, &job);
        host->parallel(host->thread_pool, w->threads, (size_t)job.blocks - 1, tiled_seam, &job);
        *w = job.end;
        window_open(w);
        steps -= job.steps;
    }
    w->table = NULL;
    w->finite = !job.diverged;
}
