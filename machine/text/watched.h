/* After every step the watched loop tests whether the lower bounds on |g| of all functions g of the model's rules are
 * positive on the box of the step; only where one is not does it call `quiet` of core/events_watch.c. `compiled_least`
 * gives the interpreter's bits, so that `quiet` would give the same answer.
 */
static inline bool compiled_idle(const work *w)
{
    const compiled_host *host = w->host;
    const watch *of = w->watch;
#if SMALL && BOUNDS
    const size_t functions = BOUNDS;
    real x[NUMBERS], v[NUMBERS], dx[NUMBERS], dv[NUMBERS], least[BOUNDS];
    const box in = {x, v, dx, dv};
#else /* their number depends on sizes */
    const size_t functions = of->functions;
    real *const least = of->least;
    const box in = {of->middle, of->middle + FACT(w, nx), of->width, of->width + FACT(w, nx)};
#endif
    box_of(&in, FACT(w, nx), FACT(w, nv), ROW(w, adaptive) ? watch_span(of) : w->h, of->from_x, of->from_v, of->to_x,
           of->to_v, of->most);
    for (size_t f = 0; f < functions; f++) least[f] = INFINITY; /* of cells without a rule */
    compiled_least(host->pool, host->q, host->u, host->bound, (real *)0, CLOCK(0), (const clock *)0, in.x, in.v,
                   (real *)0, least, in.dx, in.dv);
    bool idle = true;
    for (size_t f = 0; f < functions; f++) idle &= least[f] > 0;
    return idle;
}
#define WATCH_IDLE(w) compiled_idle(w)
