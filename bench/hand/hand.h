/* THE HAND-WRITTEN COUNTERPARTS: what somebody who knows the machine would write for one problem and one method, and
 * for nothing else.
 *
 * Invariant: a counterpart that says "our bits" performs the operations of motus in motus' order, and is compared
 * with it, byte for byte, before it is timed. A "free" one may do what it likes, as long as its answer is as good.
 */
#ifndef BENCH_HAND_H
#define BENCH_HAND_H

#include <stddef.h>
#include <stdint.h>

const char *hand_lanes(void); /* "AVX2": what the files of this folder were built for */

/* cos(n h) and cos(n h + h/2), n = 0 … steps, by motus' own cosine. */
void hand_cosines(double step, int64_t steps, double *whole, double *half);

/* ENSEMBLES. x'' = -x + x³ + F cos t, one F per trajectory, all of them from (x0, v0) at t = 0; x and v receive the
 * final states. */
typedef struct oscillators {
    size_t count;
    const double *F;
    double x0, v0, step;
    int64_t steps;              /* even */
    const double *whole, *half; /* hand_cosines */
    double *x, *v;
} oscillators;
typedef enum hand_kind {
    HAND_VERLET,
    HAND_VELOCITY_VERLET,
    HAND_RK4, /* our bits */
    HAND_FREE_LEAPFROG,
    HAND_FREE_RK4, /* the fewest operations, with no more round-off */
    /* fewer still, with the round-off of the literal recursion */
    HAND_FREE_POSITION,
    HAND_FIRST_RK4, /* rk4 of the system of first order */
    HAND_KINDS
} hand_kind;
/* Tries how many registers to work on at a time, and keeps the best for hand_oscillators. */
void hand_oscillators_choose(hand_kind, const oscillators *);
const char *hand_oscillators_chosen(hand_kind); /* "12 registers, 1 in step" */
void hand_oscillators(hand_kind, const oscillators *);

/* theta'' = -sin(theta) by velocity Verlet, from rest at theta0[k], with the compiler's vector mathematics (libmvec,
 * 4 ulp). Returns 0 where there is none. */
int hand_pendulums(size_t count, const double *theta0, double step, int64_t steps, double *x, double *v);

/* ONE TRAJECTORY of the oscillator by Verlet's summed recursion, as one writes it down. Returns x. */
double hand_plain_loop(double F, double step, int64_t steps);
/* The same for every model: the loop of a physicist, by verlet or rk4; the last one's model is NULL. Returns x[0]. */
typedef struct hand_single {
    const char *model, *method;
    double step;
    double (*run)(double step, int64_t steps);
} hand_single;
extern const hand_single hand_singles[];
/* The longest chain of the recursion alone, the drive taken as known: ns per step, and what its operations take one
 * by one. */
typedef struct latencies {
    double multiply, fused, add, chain;
} latencies;
latencies hand_latencies(void);

/* A BILLIARD, models/billiard.motus, by steps of h to `until`: time and place of its hits, at most `most`. Returns how
 * many there were. */
int64_t hand_billiard(double h, double until, int64_t most, double (*hits)[3]);

/* THE CHAIN of models/chain.motus: N cells, x[0] = x[N+1] = 0, by leapfrog: `steps` times v += kick a, x += step v.
 * The kick is h, and half of it at the very start. x, v and a have N + 2 numbers and begin 8 bytes before a line of
 * the cache; a is for the plain loops. */
typedef struct chain {
    size_t N;
    double beta, step;
    double *x, *v, *a;
} chain;
/* two loops: forces, then kick and drift */
void hand_chain_plain(const chain *, int64_t steps, double kick);
/* one pass a step; our bits */
void hand_chain_fused(const chain *, int64_t steps, double kick);
/* `levels` steps (at most 64) in one pass over memory, in tiles of `tile` cells: our bits; and the same with a
 * spring's force computed once. */
void hand_chain_skewed(const chain *, int64_t steps, int levels, size_t tile, double kick);
void hand_chain_skewed_free(const chain *, int64_t steps, int levels, size_t tile, double kick);
/* our bits */
void hand_chain_threads(const chain *, int64_t steps, int levels, size_t tile, double kick, int threads);
/* what memory takes to read and write the state */
void hand_stream(double *x, double *v, size_t count, double factor);

/* GRAVITY of bench/gravity.motus: accelerations of N equal masses; x, a: 3 N numbers, component by component. */
/* our bits: root and division, both rounded */
void hand_gravity(size_t N, double G, const double *x, double *a);
void hand_gravity_approximate(size_t N, double G, const double *x, double *a); /* 1/root by table and Newton: 1e-14 */
void hand_gravity_half(size_t N, double G, const double *x, double *a);        /* rounded, and each pair once */

#endif
