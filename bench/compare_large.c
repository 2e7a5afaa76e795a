/* One large system: the chain of a million cells, and gravity among a thousand bodies. */
#include "bench/bench.h"
#include "bench/hand/hand.h"
#include "bench/peers/peers.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    CELLS = 1000000,
    CHECKED = 1003,
    CHAIN_STEPS = 32,
    CHAIN_ROUNDS = 9,
    BODIES = 1000,
    GRAVITY_STEPS = 8,
    GRAVITY_ROUNDS = 9,
    ALWAYS = 1000000
};
static const double CHAIN_STEP = 0.1, BETA = 0.7, GRAVITY_STEP = 0.001, GRAVITY = 0.001;

/* ---- the chain ---- */

typedef struct chain_job {
    ours *ours;
    chain chain;
    int levels, threads;
    size_t tile;
    double *x, *v;
} chain_job;

static chain chain_create(size_t N)
{
    chain c = {.N = N, .beta = BETA, .step = CHAIN_STEP};
    double **arrays[] = {&c.x, &c.v, &c.a};
    for (int k = 0; k < 3; k++) {
        void *memory;
        if (posix_memalign(&memory, 64, (N + 16) * sizeof(double))) abort();
        memset(memory, 0, (N + 16) * sizeof(double));
        *arrays[k] = (double *)memory + 7;
    }
    return c;
}

static void chain_free(chain *c) { free(c->x - 7), free(c->v - 7), free(c->a - 7); }

static ours *chain_ours(size_t N, const char *machine, int threads)
{
    char set[32];
    snprintf(set, sizeof set, "N=%zu", N);
    const char *const sets[] = {set, NULL};
    return ours_open("models/chain.motus", sets, "velocity-verlet", CHAIN_STEP, ALWAYS, machine, threads);
}

#define PER_CELL(call)    \
    chain_job *j = p;     \
    double start = now(); \
    call;                 \
    return (now() - start) / (double)j->chain.N / CHAIN_STEPS

static double by_chain_ours(void *p)
{
    chain_job *j = p;
    return j->ours ? ours_step(j->ours, CHAIN_STEPS) / CELLS / CHAIN_STEPS : NAN;
}
static double by_plain(void *p) { PER_CELL(hand_chain_plain(&j->chain, CHAIN_STEPS, CHAIN_STEP)); }
static double by_fused(void *p) { PER_CELL(hand_chain_fused(&j->chain, CHAIN_STEPS, CHAIN_STEP)); }
static double by_skewed(void *p)
{
    PER_CELL(hand_chain_skewed(&j->chain, CHAIN_STEPS, j->levels, j->tile, CHAIN_STEP));
}
static double by_skewed_free(void *p)
{
    PER_CELL(hand_chain_skewed_free(&j->chain, CHAIN_STEPS, j->levels, j->tile, CHAIN_STEP));
}
/* Turns of half the steps at most, so that there is work for two. */
static double by_threads(void *p)
{
    PER_CELL(hand_chain_threads(&j->chain, CHAIN_STEPS, j->levels < CHAIN_STEPS / 4 ? j->levels : CHAIN_STEPS / 4,
                                j->tile, CHAIN_STEP, j->threads));
}
static double by_stream(void *p)
{
    PER_CELL(for (int n = 0; n < CHAIN_STEPS; n++) hand_stream(j->chain.x + 1, j->chain.v + 1, CELLS, 1));
}
static double by_chain_odeint(void *p)
{
    chain_job *j = p;
    double start = now();
    if (!peer_odeint_chain(CELLS, BETA, CHAIN_STEP, CHAIN_STEPS, j->x, j->v)) return NAN;
    return (now() - start) / CELLS / CHAIN_STEPS;
}

static void choose_tile(chain_job *j)
{
    static const int levels[] = {8, 16, 32};
    static const size_t tiles[] = {256, 512, 1024, 2048};
    double least = INFINITY;
    int best_levels = 16;
    size_t best_tile = 512;
    for (int k = 0; k < 24; k++) {
        j->levels = levels[k % 3], j->tile = tiles[k / 3 % 4];
        double took = by_skewed(j);
        if (took < least) least = took, best_levels = j->levels, best_tile = j->tile;
    }
    j->levels = best_levels, j->tile = best_tile;
}

/* A short chain by ours, and by the hand-written tiles on two threads, to the same bits. */
static bool same_chain(void)
{
    ours *o = chain_ours(CHECKED, "interpreter", 1);
    chain c = chain_create(CHECKED);
    double *x = calloc(CHECKED, sizeof *x), *v = calloc(CHECKED, sizeof *v);
    bool same = false;
    if (o && x && v && ours_state(o, x, v)) {
        memcpy(c.x + 1, x, CHECKED * sizeof *x);
        memcpy(c.v + 1, v, CHECKED * sizeof *v);
        hand_chain_fused(&c, 1, CHAIN_STEP / 2);
        hand_chain_threads(&c, CHAIN_STEPS - 1, 7, 100, CHAIN_STEP, 2);
        chain closing = c;
        closing.step = 0;
        hand_chain_fused(&closing, 1, CHAIN_STEP / 2);
        same = !isnan(ours_step(o, CHAIN_STEPS)) && ours_state(o, x, v) && !memcmp(c.x + 1, x, CHECKED * sizeof *x) &&
               !memcmp(c.v + 1, v, CHECKED * sizeof *v);
    }
    ours_close(o);
    chain_free(&c);
    free(x), free(v);
    return same;
}

static void compare_chain(void)
{
    report_section("A chain of 1e6 cells by velocity-verlet", "per cell and step");
    chain_job one = {.ours = chain_ours(CELLS, "compiled", 1), .chain = chain_create(CELLS)}, two = one;
    one.x = calloc(CELLS + 2, sizeof *one.x);
    one.v = calloc(CELLS + 2, sizeof *one.v);
    two.ours = chain_ours(CELLS, "compiled", 2);
    two.threads = 2;
    for (size_t i = 1; i <= CELLS; i++) one.chain.x[i] = sin(3.14159265358979 * (double)i / (CELLS + 1));
    choose_tile(&one);
    two.levels = one.levels, two.tile = one.tile;
    side sides[] = {SIDE(by_chain_ours, &one),
                    SIDE(by_plain, &one),
                    SIDE(by_fused, &one),
                    SIDE(by_skewed, &one),
                    SIDE(by_skewed_free, &one),
                    SIDE(by_stream, &one),
                    SIDE_ROUNDS(by_chain_odeint, &one, 3),
                    SIDE(by_chain_ours, &two),
                    SIDE(by_threads, &two)};
    measure(sides, 9, CHAIN_ROUNDS);
    const side *best = median(&sides[2]) < median(&sides[3]) ? &sides[2] : &sides[3];
    report_bits("the hand-written bits are ours", true, same_chain());
    report_at_most("by hand, the best with our bits, one core", &sides[0], best, 1.2, "ns");
    report_at_most("by hand, the best with our bits, two cores", &sides[7], &sides[8], 1.2, "ns");
    report_beside("by hand, tiled, a spring's force once", &sides[0], &sides[4], "ns");
    report_beside("by hand, tiled", &sides[0], &sides[3], "ns");
    report_beside("by hand, one pass a step", &sides[0], &sides[2], "ns");
    report_beside("by hand, two plain loops", &sides[0], &sides[1], "ns");
    report_beside("odeint", &sides[0], &sides[6], "ns");
    report_beside("to read and write the state, and nothing else", &sides[0], &sides[5], "ns");
    report_note("tiles of %zu cells, %d steps at a time", one.tile, one.levels);
    ours_close(one.ours), ours_close(two.ours);
    chain_free(&one.chain);
    free(one.x), free(one.v);
}

/* ---- gravity ---- */

typedef void accelerations(size_t N, double G, const double *x, double *a);
typedef struct gravity_job {
    ours *ours;
    accelerations *accelerate;
    double x[3 * BODIES], v[3 * BODIES], a[3 * BODIES];
} gravity_job;

static ours *gravity_ours(const char *machine)
{
    return ours_open("bench/gravity.motus", NULL, "velocity-verlet", GRAVITY_STEP, ALWAYS, machine, 1);
}

/* Ours come body by body; the hand-written sums want component by component, as the compiled machine keeps them. */
static void by_component(const double *from, double *to)
{
    for (size_t i = 0; i < BODIES; i++)
        for (size_t k = 0; k < 3; k++) to[k * BODIES + i] = from[3 * i + k];
}

static void gravity_steps(gravity_job *j, int steps, double kick)
{
    for (int n = 0; n < steps; n++, kick = GRAVITY_STEP) {
        j->accelerate(BODIES, GRAVITY, j->x, j->a);
        for (size_t i = 0; i < 3 * BODIES; i++) {
            j->v[i] = fma(kick, j->a[i], j->v[i]);
            j->x[i] = fma(GRAVITY_STEP, j->v[i], j->x[i]);
        }
    }
}

static double by_gravity_ours(void *p)
{
    gravity_job *j = p;
    return j->ours ? ours_step(j->ours, GRAVITY_STEPS) / GRAVITY_STEPS / BODIES / BODIES : NAN;
}

static double by_gravity_hand(void *p)
{
    gravity_job *j = p;
    double start = now();
    gravity_steps(j, GRAVITY_STEPS, GRAVITY_STEP);
    return (now() - start) / GRAVITY_STEPS / BODIES / BODIES;
}

/* Velocities too, which alone show the last bits of so small a force. */
static bool same_gravity(gravity_job *j, ours *o)
{
    static double x[3 * BODIES], v[3 * BODIES], mine[3 * BODIES];
    if (!o) return false;
    gravity_steps(j, GRAVITY_STEPS, GRAVITY_STEP / 2);
    if (isnan(ours_step(o, GRAVITY_STEPS)) || !ours_state(o, x, v)) return false;
    by_component(x, mine);
    if (memcmp(mine, j->x, sizeof mine)) return false;
    j->accelerate(BODIES, GRAVITY, j->x, j->a);
    by_component(v, mine);
    for (size_t i = 0; i < 3 * BODIES; i++) {
        double synchronous = fma(GRAVITY_STEP / 2, j->a[i], j->v[i]);
        if (memcmp(&synchronous, &mine[i], sizeof synchronous)) return false;
    }
    return true;
}

static void compare_gravity(void)
{
    static accelerations *const forms[] = {hand_gravity, hand_gravity_approximate, hand_gravity_half};
    static gravity_job jobs[4];
    double x[3 * BODIES] = {0};
    report_section("Gravity among 1000 bodies by velocity-verlet", "per pair (ordered) and step");
    ours *start = gravity_ours("interpreter");
    if (start) ours_state(start, x, NULL);
    jobs[0].ours = gravity_ours("compiled");
    for (int k = 0; k < 3; k++) {
        jobs[k + 1].accelerate = forms[k];
        by_component(x, jobs[k + 1].x);
    }
    bool same = same_gravity(&jobs[1], start);
    side sides[] = {SIDE(by_gravity_ours, &jobs[0]), SIDE(by_gravity_hand, &jobs[1]), SIDE(by_gravity_hand, &jobs[2]),
                    SIDE(by_gravity_hand, &jobs[3])};
    measure(sides, 4, GRAVITY_ROUNDS);
    report_bits("the hand-written bits are ours", true, same);
    report_at_most("by hand, root and division rounded, our bits", &sides[0], &sides[1], 1.2, "ns");
    report_beside("by hand, root approximate", &sides[0], &sides[2], "ns");
    report_at_most("by hand, rounded, each pair once", &sides[0], &sides[3], 1.2, "ns");
    ours_close(start), ours_close(jobs[0].ours);
}

void compare_large(void)
{
    compare_chain();
    compare_gravity();
}
