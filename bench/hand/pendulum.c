/* Pendulums by velocity Verlet with the vector functions of the compiler's own C library (libmvec): what gcc makes of
 * a loop over sin with -ffast-math and -fopenmp-simd, without the loop: the calls are written out, so no flag need
 * relax anything else.
 *
 * Invariant: lanes do not meet. A call takes every vector register, so the block lives in the first cache and the
 * loop is as good as its sine: BLOCK is only as large as lets one call's latency hide behind the next.
 */
#include "bench/hand/hand.h"
#include "bench/hand/lanes.h"

#ifdef BENCH_LIBMVEC
#if defined(__AVX512F__) && defined(__AVX512DQ__)
#define VECTOR_SIN _ZGVeN8v_sin
#elif defined(__AVX2__) && defined(__FMA__)
#define VECTOR_SIN _ZGVdN4v_sin
#else
#define VECTOR_SIN _ZGVbN2v_sin
#endif
vec VECTOR_SIN(vec);

enum { BLOCK = 8 };

int hand_pendulums(size_t count, const double *theta0, double step, int64_t steps, double *x_out, double *v_out)
{
    vec h = vec_all(step), half = vec_all(0.5 * step);
    for (size_t at = 0; at < count; at += (size_t)BLOCK * WIDTH) {
        if (at + (size_t)BLOCK * WIDTH > count) at = count - (size_t)BLOCK * WIDTH;
        vec x[BLOCK], v[BLOCK];
        for (int u = 0; u < BLOCK; u++) {
            x[u] = vec_load(theta0 + at + (size_t)u * WIDTH);
            v[u] = half * VECTOR_SIN(x[u]); /* half a kick back: then every step is the same */
        }
        for (int64_t n = 0; n < steps; n++)
            for (int u = 0; u < BLOCK; u++) {
                v[u] = vec_fnma(h, VECTOR_SIN(x[u]), v[u]);
                x[u] = vec_fma(h, v[u], x[u]);
            }
        for (int u = 0; u < BLOCK; u++) {
            vec_store(x_out + at + (size_t)u * WIDTH, x[u]);
            vec_store(v_out + at + (size_t)u * WIDTH, vec_fnma(half, VECTOR_SIN(x[u]), v[u]));
        }
    }
    return 1;
}
#else
int hand_pendulums(size_t count, const double *theta0, double step, int64_t steps, double *x, double *v)
{
    (void)count, (void)theta0, (void)step, (void)steps, (void)x, (void)v;
    return 0;
}
#endif
