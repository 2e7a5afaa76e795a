/* The chain of Fermi, Pasta, Ulam and Tsingou by leapfrog, v += kick a(x), x += h v, in place.
 *
 * Why the skewed ones are fast. A state of a million cells is 16 MB, so a plain step waits for memory, or for the
 * last cache at best. But a cell's next value needs its neighbours only: a tile that fits the first cache can be
 * taken several steps ahead, if each step ends WIDTH cells further left than the one before (those cells' right
 * neighbours are not there yet) and remembers the old values at its own right edge, which the next tile needs as left
 * neighbours and which are overwritten by then. The state passes memory once per `levels` steps. Threads take turns
 * of `levels` steps and follow each other along the chain.
 *
 * Invariant: every cell sees the same operations in the same order as in the plain loops, which are those of motus:
 * the same bits, but for the free form.
 */
#include "bench/hand/hand.h"
#include "bench/hand/lanes.h"

#include <sched.h>
#include <stdatomic.h>

enum { LEVELS_MAX = 64, SLABS_MAX = 4096 };

/* x[i+1] - 2 x[i] + x[i-1] + beta ((x[i+1]-x[i])³ - (x[i]-x[i-1])³), in motus' normal form. */
static inline double force(double l, double x, double r, double beta)
{
    double right = r - x, left = x - l;
    return fma(beta, fma(-(left * left), left, right * right * right), fma(-2, x, r) + l);
}

INLINE vec vec_force(vec l, vec x, vec r, vec beta)
{
    vec right = r - x, left = x - l;
    return vec_fma(beta, vec_fnma(left * left, left, right * right * right), vec_fnma(vec_all(2), x, r) + l);
}

void hand_chain_plain(const chain *c, int64_t steps, double kick)
{
    double *restrict x = c->x, *restrict v = c->v, *restrict a = c->a, beta = c->beta, h = c->step;
    for (; steps > 0; steps--) {
        for (size_t i = 1; i <= c->N; i++) a[i] = force(x[i - 1], x[i], x[i + 1], beta);
        for (size_t i = 1; i <= c->N; i++) {
            v[i] = fma(kick, a[i], v[i]);
            x[i] = fma(h, v[i], x[i]);
        }
    }
}

/* One step of the cells [from, to), `left` holding the old value of cell from - 1 in its last lane; so it does
 * afterwards for `to`. Both neighbours are read from memory, a cell off the grid of registers; therefore new values
 * are stored one turn late, when the next register has read its left neighbours. Shuffles in their place would wait
 * for the units that multiply. */
INLINE vec pass(const chain *c, size_t from, size_t to, double kick, vec left)
{
    double *x = c->x, *v = c->v;
    vec beta = vec_all(c->beta), k = vec_all(kick), h = vec_all(c->step);
    size_t i = from;
    if (i + WIDTH <= to) {
        vec here = vec_load(x + i), l = vec_before(left, here), r, next;
        for (;;) {
            r = vec_load(x + i + 1);
            KEEP(here);
            KEEP(l);
            KEEP(r); /* one load each, however often they are used */
            vec speed = vec_fma(k, vec_force(l, here, r, beta), vec_load(v + i));
            vec_store(v + i, speed);
            next = vec_fma(h, speed, here);
            left = here;
            i += WIDTH;
            if (i + WIDTH > to) break;
            here = vec_load(x + i);
            l = vec_load(x + i - 1);
            vec_store(x + i - WIDTH, next);
        }
        vec_store(x + i - WIDTH, next);
    }
    double l[WIDTH];
    vec_store(l, left);
    for (; i < to; i++) {
        double here = x[i];
        v[i] = fma(kick, force(l[WIDTH - 1], here, x[i + 1], c->beta), v[i]);
        x[i] = fma(c->step, v[i], here);
        l[WIDTH - 1] = here;
    }
    return vec_load(l);
}

/* The same with each spring's force d + beta d³ computed once, for both its ends; `left` holds forces. */
INLINE vec pass_free(const chain *c, size_t from, size_t to, double kick, vec left)
{
    double *restrict x = c->x, *restrict v = c->v;
    vec beta = vec_all(c->beta), k = vec_all(kick), h = vec_all(c->step);
    size_t i = from;
    for (; i + WIDTH <= to; i += WIDTH) {
        vec here = vec_load(x + i), d = vec_load(x + i + 1) - here, spring = vec_fma(d * d, beta * d, d);
        vec speed = vec_fma(k, spring - vec_before(left, spring), vec_load(v + i));
        vec_store(v + i, speed);
        vec_store(x + i, vec_fma(h, speed, here));
        left = spring;
    }
    double l[WIDTH];
    vec_store(l, left);
    for (; i < to; i++) {
        double d = x[i + 1] - x[i], spring = fma(d * d, c->beta * d, d);
        v[i] = fma(kick, spring - l[WIDTH - 1], v[i]);
        x[i] = fma(c->step, v[i], x[i]);
        l[WIDTH - 1] = spring;
    }
    return vec_load(l);
}

static vec spring_of_the_wall(const chain *c)
{
    double d = c->x[1] - c->x[0];
    return vec_all(fma(d * d, c->beta * d, d));
}

void hand_chain_fused(const chain *c, int64_t steps, double kick)
{
    for (; steps > 0; steps--) pass(c, 1, c->N + 1, kick, vec_all(c->x[0]));
}

/* `levels` steps over the whole chain, tile by tile. `ready` (or NULL) tells how far the steps before have come,
 * `done` (or NULL) is told how far these have. */
INLINE void slab(const chain *c, int levels, size_t tile, double kick, int free, _Atomic size_t *ready,
                 _Atomic size_t *done)
{
    size_t end = c->N + 1, at[LEVELS_MAX];
    vec left[LEVELS_MAX];
    for (int k = 0; k < levels; k++) at[k] = 1, left[k] = vec_all(c->x[0]);
    for (size_t stop = 1 + tile;; stop += tile) {
        size_t need = stop < end ? stop + WIDTH : end;
        if (need > end) need = end;
        for (int spins = 0; ready && atomic_load_explicit(ready, memory_order_acquire) < need; spins++)
            if (spins > 1000) sched_yield();
        for (int k = 0; k < levels; k++) {
            size_t back = (size_t)k * WIDTH, to = stop >= end ? end : stop > at[k] + back ? stop - back : at[k];
            if (free && at[k] == 1) left[k] = spring_of_the_wall(c);
            left[k] = free ? pass_free(c, at[k], to, kick, left[k]) : pass(c, at[k], to, kick, left[k]);
            at[k] = to;
        }
        if (done) atomic_store_explicit(done, at[levels - 1], memory_order_release);
        if (stop >= end) return;
    }
}

void hand_chain_skewed(const chain *c, int64_t steps, int levels, size_t tile, double kick)
{
    for (; steps > 0; steps -= levels) slab(c, steps < levels ? (int)steps : levels, tile, kick, 0, NULL, NULL);
}

void hand_chain_skewed_free(const chain *c, int64_t steps, int levels, size_t tile, double kick)
{
    for (; steps > 0; steps -= levels) slab(c, steps < levels ? (int)steps : levels, tile, kick, 1, NULL, NULL);
}

void hand_chain_threads(const chain *c, int64_t steps, int levels, size_t tile, double kick, int threads)
{
    static _Atomic size_t done[SLABS_MAX];
    int slabs = (int)((steps + levels - 1) / levels);
    if (slabs > SLABS_MAX) return;
    for (int s = 0; s < slabs; s++) atomic_store(&done[s], 0);
#pragma omp parallel for schedule(static, 1) num_threads(threads)
    for (int s = 0; s < slabs; s++) {
        int64_t rest = steps - (int64_t)s * levels;
        slab(c, rest < levels ? (int)rest : levels, tile, kick, 0, s ? &done[s - 1] : NULL, &done[s]);
    }
}

void hand_stream(double *restrict x, double *restrict v, size_t count, double factor)
{
    vec f = vec_all(factor);
    for (size_t i = 0; i + WIDTH <= count; i += WIDTH) {
        vec_store(x + i, vec_load(x + i) * f);
        vec_store(v + i, vec_load(v + i) * f);
    }
}
