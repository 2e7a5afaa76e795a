/* Windows: the same texts over a range of a model's outer indices instead of all.
 *
 * EACH and EACHV run over the numbers in w->window. compiled_force does too; its text uses
 *     from, to            the window
 *     PUT(k, value)       stores or applies the acceleration of number k
 *     window_later, window_sooner    the greater and the smaller of two indices
 *
 * Windows of neighbouring steps may overlap in memory, and tiles give the same bits nevertheless: an acceleration reads
 * at most `reach` indices away, and window_move moves a window so far that it reads nothing that a later step has
 * written, and writes nothing that an earlier step still has to read. tiled.h says which windows there are.
 */
static inline whole window_later(whole a, whole b) { return a > b ? a : b; }
static inline whole window_sooner(whole a, whole b) { return a < b ? a : b; }

static inline size_t window_place(const tiling_part *p, whole index)
{
    const whole i = index - p->first;
    return p->base + (i < 0 ? 0 : (size_t)i < p->cells ? (size_t)i : p->cells) * p->stride;
}

#if LOCAL
#define WINDOW(k, count)                                                                       \
    for (const tiling_part *p_ = w->host->tiling->part, *end_ = p_ + (count); p_ < end_; p_++) \
        for (size_t k = window_place(p_, w->window.from), to_ = window_place(p_, w->window.to); k < to_; k++)
#undef EACH
#undef EACHV
#define EACH(k) WINDOW(k, w->host->tiling->positions)
#define EACHV(k) WINDOW(k, w->host->tiling->parts)
#endif

#define WINDOW_ALL ((whole)1 << 61)

static inline void window_meet(window *at)
{
    at->from = window_later(at->strip[0], at->block[0]);
    at->to = window_sooner(at->strip[1], at->block[1]);
}

static inline void window_move(work *w, whole by)
{
    window *at = &w->window;
    for (int i = 0; i < 2; i++) {
        at->strip[i] -= by;
        at->block[i] += at->slope[i] * by;
    }
    window_meet(at);
}

static inline void window_open(work *w)
{
    w->window = (window){.strip = {-WINDOW_ALL, WINDOW_ALL}, .block = {-WINDOW_ALL, WINDOW_ALL}};
    window_meet(&w->window);
}

/* What PUT does: stores the acceleration or, in a pass, kicks and drifts at once. Neighbours still need the old
 * position, so a pass writes the new one to another copy of the positions, in the array of the accelerations. `twice`:
 * the opening drift `next` of the next step follows. With a compensated row, x has the positions at the start of the
 * step, and the pass has its first kick (`opens`) or its end; way: all drifts of the step up to this one. */
typedef struct window_put {
    bool pass, twice, ends, opens;
    clock b, c, next, way, way_low;
    real *x, *ex, *ev, *low;
} window_put;

#define PUT(k, value) window_keep(move, x, v, a, (size_t)(k), (value))
#define PUTS(k, value) window_keep_many(move, x, v, a, (size_t)(k), (value))
