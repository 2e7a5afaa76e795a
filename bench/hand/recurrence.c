/* One trajectory of the oscillator: the loop as one writes it down, and how fast its recursion can be at all.
 *
 * Invariant: a step cannot begin before the step before has ended, so the longest chain of operations from x[n] to
 * x[n+1] is a bound that no width and no core count moves. Each loop below is one such chain; nothing else in it
 * takes as long.
 */
#include "bench/hand/hand.h"

#include <math.h>
#include <time.h>

double hand_plain_loop(double F, double h, int64_t steps)
{
    double x = 0, d = h * h / 2 * F; /* from rest at the origin */
    x += d;
    for (int64_t n = 1; n < steps; n++) {
        double a = -x + x * x * x + F * cos((double)n * h);
        d += h * h * a;
        x += d;
    }
    return x;
}

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

enum { CALLS = 2000000, TRIES = 7 };

/* The best of some tries of a chain of `expression`, in ns. What comes out goes where the compiler does not see it
 * end. */
#define LATENCY(expression)                         \
    double best = INFINITY;                         \
    for (int try = 0; try < TRIES; try++) {         \
        double start = seconds();                   \
        for (int i = 0; i < CALLS; i++) expression; \
        double took = seconds() - start;            \
        if (took < best) best = took;               \
    }                                               \
    *kept += x;                                     \
    return best / CALLS * 1e9

static double multiply(double x, double c, volatile double *kept) { LATENCY(x = x * c); }
static double fused(double x, double c, volatile double *kept) { LATENCY(x = fma(x, c, c)); }
static double add(double x, double c, volatile double *kept) { LATENCY(x = x + c); }

/* Verlet's step as motus takes it: d += h² (F c + (x² x - x)); x += d. One product, three fused operations, one sum. */
static double step(double x, double c, volatile double *kept)
{
    double d = 0, hh = 1e-6, F = 0.1;
    LATENCY((d = fma(hh, fma(F, c, fma(x * x, x, -x)), d), x += d));
}

latencies hand_latencies(void)
{
    /* not known to the compiler; no product may shrink to a subnormal */
    volatile double x = 0.5, c = 0.75, one = 1, kept = 0;
    return (latencies){multiply(x, one, &kept), fused(x, c, &kept), add(x, c, &kept), step(x, c, &kept)};
}
