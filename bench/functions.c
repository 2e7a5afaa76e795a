/* How long the elementary functions take: nanoseconds per value of the scalar text and of vectors of 4, 8 and 16
 * doubles, beside the C library's scalar functions and its vectors (libmvec, 4 ulp), where there are any.
 *
 * Every figure is the best of several rounds over arguments that stay in the first cache; "latency" is one call
 * waiting for the last. Build with -O3 -march=native -ffp-contract=off -fno-math-errno and, on x86-64 with glibc
 * 2.35, -DHAVE_LIBMVEC and -lmvec before -lm.
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <time.h>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi" /* nothing here crosses an object */
#endif

#include "lang/base/functions.h"
#define LANES 4
#include "step/functions/lanes.h"
#include "lang/base/functions.h"
#ifdef __AVX512F__
#define LANES 8
#include "step/functions/lanes.h"
#include "lang/base/functions.h"
#define REGISTER 8
#else
#define LANES 8
#define LANES_PART 4
#include "step/functions/wide.h"
#define REGISTER 4
#endif
#define LANES 16
#define LANES_PART REGISTER
#include "step/functions/wide.h"

enum { COUNT = 1024, ROUNDS = 40, REPEATS = 25 };

/* name, arguments, from, to, second from, to */
#define EACH_FUNCTION(X)          \
    X(sin, 1, -10, 10, 0, 0)      \
    X(cos, 1, -10, 10, 0, 0)      \
    X(tan, 1, -10, 10, 0, 0)      \
    X(exp, 1, -20, 20, 0, 0)      \
    X(log, 1, 0.01, 100, 0, 0)    \
    X(pow, 2, 0.01, 100, -10, 10) \
    X(sinh, 1, -5, 5, 0, 0)       \
    X(cosh, 1, -5, 5, 0, 0)       \
    X(tanh, 1, -5, 5, 0, 0)       \
    X(asin, 1, -1, 1, 0, 0)       \
    X(acos, 1, -1, 1, 0, 0)       \
    X(atan, 1, -5, 5, 0, 0)       \
    X(atan2, 2, -5, 5, -5, 5) X(cbrt, 1, -100, 100, 0, 0) X(hypot, 2, -5, 5, -5, 5) X(erf, 1, -3, 3, 0, 0)

typedef void sweep(double *r, const double *x, const double *y);

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double measure(sweep *f, const double *x, const double *y)
{
    static _Alignas(64) double r[COUNT];
    double best = 1e9;
    for (int round = 0; round < ROUNDS; round++) {
        double start = seconds();
        for (int i = 0; i < REPEATS; i++) f(r, x, y);
        double took = seconds() - start;
        if (took < best) best = took;
    }
    return best / REPEATS / COUNT * 1e9;
}

#define CALL_1(f, x, y) f(x)
#define CALL_2(f, x, y) f(x, y)
#define KEPT __attribute__((noinline)) static

/* The sum with a vanishing part of the last result makes one call wait for another. */
#define SCALARS(name, n, ...)                                                                                \
    KEPT void our_##name(double *r, const double *x, const double *y)                                        \
    {                                                                                                        \
        (void)y;                                                                                             \
        for (int i = 0; i < COUNT; i++) r[i] = CALL_##n(motus_##name, x[i], y[i]);                           \
    }                                                                                                        \
    KEPT void our_latency_##name(double *r, const double *x, const double *y)                                \
    {                                                                                                        \
        double last = 0;                                                                                     \
        (void)y;                                                                                             \
        for (int i = 0; i < COUNT; i++) r[i] = last = CALL_##n(motus_##name, x[i] + 0x1p-1000 * last, y[i]); \
    }                                                                                                        \
    KEPT void libm_##name(double *r, const double *x, const double *y)                                       \
    {                                                                                                        \
        (void)y;                                                                                             \
        for (int i = 0; i < COUNT; i++) r[i] = CALL_##n(name, x[i], y[i]);                                   \
    }                                                                                                        \
    KEPT void libm_latency_##name(double *r, const double *x, const double *y)                               \
    {                                                                                                        \
        double last = 0;                                                                                     \
        (void)y;                                                                                             \
        for (int i = 0; i < COUNT; i++) r[i] = last = CALL_##n(name, x[i] + 0x1p-1000 * last, y[i]);         \
    }
EACH_FUNCTION(SCALARS)

#define VECTORS(name, n, width)                                                           \
    KEPT void our_##name##_x##width(double *r, const double *x, const double *y)          \
    {                                                                                     \
        (void)y;                                                                          \
        for (int i = 0; i < COUNT; i += width)                                            \
            *(motus_reals_x##width *)(r + i) =                                            \
                CALL_##n(motus_##name##_x##width, *(const motus_reals_x##width *)(x + i), \
                         *(const motus_reals_x##width *)(y + i));                         \
    }
#define ALL_VECTORS(name, n, ...) VECTORS(name, n, 4) VECTORS(name, n, 8) VECTORS(name, n, 16)
EACH_FUNCTION(ALL_VECTORS)

#if defined(HAVE_LIBMVEC) && defined(__AVX512F__)
#define LIBMVEC_1(name) extern __m512d _ZGVeN8v_##name(__m512d);
#define LIBMVEC_2(name) extern __m512d _ZGVeN8vv_##name(__m512d, __m512d);
#define LIBMVEC_VECTOR __m512d
#define LIBMVEC_NAME_1(name) _ZGVeN8v_##name
#define LIBMVEC_NAME_2(name) _ZGVeN8vv_##name
#elif defined(HAVE_LIBMVEC) && defined(__AVX2__)
#define LIBMVEC_1(name) extern __m256d _ZGVdN4v_##name(__m256d);
#define LIBMVEC_2(name) extern __m256d _ZGVdN4vv_##name(__m256d, __m256d);
#define LIBMVEC_VECTOR __m256d
#define LIBMVEC_NAME_1(name) _ZGVdN4v_##name
#define LIBMVEC_NAME_2(name) _ZGVdN4vv_##name
#endif

#ifdef LIBMVEC_VECTOR
#define LIBMVEC_SWEEP(name, n, ...)                                                                                   \
    LIBMVEC_##n(name) KEPT void libmvec_##name(double *r, const double *x, const double *y)                           \
    {                                                                                                                 \
        (void)y;                                                                                                      \
        for (size_t i = 0; i < COUNT; i += sizeof(LIBMVEC_VECTOR) / 8)                                                \
            *(LIBMVEC_VECTOR *)(r + i) =                                                                              \
                CALL_##n(LIBMVEC_NAME_##n(name), *(const LIBMVEC_VECTOR *)(x + i), *(const LIBMVEC_VECTOR *)(y + i)); \
    }
EACH_FUNCTION(LIBMVEC_SWEEP)
#endif

typedef struct row {
    const char *name;
    double from, to, second_from, second_to;
    sweep *latency, *scalar, *x4, *x8, *x16, *libm_latency, *libm, *libmvec;
} row;

#ifdef LIBMVEC_VECTOR
#define LIBMVEC_OF(name) libmvec_##name
#else
#define LIBMVEC_OF(name) NULL
#endif

int main(void)
{
    static const row rows[] = {
#define ROW(name, n, a, b, c, d) \
    {#name,                      \
     a,                          \
     b,                          \
     c,                          \
     d,                          \
     our_latency_##name,         \
     our_##name,                 \
     our_##name##_x4,            \
     our_##name##_x8,            \
     our_##name##_x16,           \
     libm_latency_##name,        \
     libm_##name,                \
     LIBMVEC_OF(name)},
        EACH_FUNCTION(ROW)};
    static _Alignas(64) double x[COUNT], y[COUNT];
    printf("ns per value\n%-6s %9s %8s %8s %8s %8s %14s %8s %8s\n", "", "latency", "scalar", "4 lanes", "8 lanes",
           "16 lanes", "libm: latency", "scalar", "libmvec");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const row *r = &rows[i];
        uint64_t state = 1;
        for (int k = 0; k < COUNT; k++) {
            state = state * 6364136223846793005u + 1442695040888963407u;
            x[k] = r->from + (r->to - r->from) * (double)(state >> 11) * 0x1p-53;
            state = state * 6364136223846793005u + 1442695040888963407u;
            y[k] = r->second_from + (r->second_to - r->second_from) * (double)(state >> 11) * 0x1p-53;
        }
        printf("%-6s %9.2f %8.2f %8.2f %8.2f %8.2f %14.2f %8.2f", r->name, measure(r->latency, x, y),
               measure(r->scalar, x, y), measure(r->x4, x, y), measure(r->x8, x, y), measure(r->x16, x, y),
               measure(r->libm_latency, x, y), measure(r->libm, x, y));
        if (r->libmvec) printf(" %8.2f", measure(r->libmvec, x, y));
        printf("\n");
    }
    return 0;
}
