/* One register of doubles, as the machine at hand has them: AVX-512, AVX2 with fma, or the compiler's vectors of two.
 *
 * Invariant: + - * / of `vec` are the compiler's, one instruction each; the rest is named here, and each is one
 * instruction too (without hardware fma it is a loop of the C library's, which is right and slow). Nothing is
 * contracted: the flags of bench/ forbid it.
 */
#ifndef BENCH_HAND_LANES_H
#define BENCH_HAND_LANES_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#define INLINE static inline __attribute__((always_inline, unused))
/* Loops over the registers of a block must vanish: an array of registers that is still indexed at run time lives in
 * memory. */
#define UNROLL _Pragma("GCC unroll 64")

#if defined(__AVX512F__) && defined(__AVX512DQ__)
#include <immintrin.h>
typedef __m512d vec;
enum { WIDTH = 8 };
#define LANES_NAME "AVX-512"
#define KEEP(x) __asm__("" : "+v"(x)) /* x is in a register here, and what it came from is forgotten */
INLINE vec vec_all(double x) { return _mm512_set1_pd(x); }
INLINE vec vec_load(const double *p) { return _mm512_loadu_pd(p); }
INLINE void vec_store(double *p, vec x) { _mm512_storeu_pd(p, x); }
INLINE vec vec_fma(vec a, vec b, vec c) { return _mm512_fmadd_pd(a, b, c); }   /* a b + c */
INLINE vec vec_fms(vec a, vec b, vec c) { return _mm512_fmsub_pd(a, b, c); }   /* a b - c */
INLINE vec vec_fnma(vec a, vec b, vec c) { return _mm512_fnmadd_pd(a, b, c); } /* c - a b */
INLINE vec vec_sqrt(vec a) { return _mm512_sqrt_pd(a); }
/* (last of a, all but the last of b): the neighbours to the left of b, where a stands before b. */
INLINE vec vec_before(vec a, vec b) { return (vec)_mm512_alignr_epi64((__m512i)b, (__m512i)a, 7); }
/* x where the lane's number is not k (any k: outside 0 … WIDTH-1 all lanes keep), else 0 */
INLINE vec vec_without(vec x, int64_t k)
{
    return _mm512_maskz_mov_pd((__mmask8)(k >= 0 && k < 8 ? 0xff ^ 1 << k : 0xff), x);
}
/* 1/sqrt(x) to a few ulp: 14 bits by table, doubled twice. */
INLINE vec vec_rsqrt(vec x)
{
    vec y = _mm512_rsqrt14_pd(x), half = vec_all(0.5) * x, c = vec_all(1.5);
    y = y * vec_fnma(half * y, y, c);
    return y * vec_fnma(half * y, y, c);
}
#elif defined(__AVX2__) && defined(__FMA__)
#include <immintrin.h>
typedef __m256d vec;
enum { WIDTH = 4 };
#define LANES_NAME "AVX2"
#define KEEP(x) __asm__("" : "+x"(x))
INLINE vec vec_all(double x) { return _mm256_set1_pd(x); }
INLINE vec vec_load(const double *p) { return _mm256_loadu_pd(p); }
INLINE void vec_store(double *p, vec x) { _mm256_storeu_pd(p, x); }
INLINE vec vec_fma(vec a, vec b, vec c) { return _mm256_fmadd_pd(a, b, c); }
INLINE vec vec_fms(vec a, vec b, vec c) { return _mm256_fmsub_pd(a, b, c); }
INLINE vec vec_fnma(vec a, vec b, vec c) { return _mm256_fnmadd_pd(a, b, c); }
INLINE vec vec_sqrt(vec a) { return _mm256_sqrt_pd(a); }
INLINE vec vec_before(vec a, vec b) { return _mm256_shuffle_pd(_mm256_permute2f128_pd(a, b, 0x21), b, 0x5); }
INLINE vec vec_without(vec x, int64_t k)
{
    __m256i lane = _mm256_set_epi64x(3, 2, 1, 0);
    return (vec)_mm256_andnot_si256(_mm256_cmpeq_epi64(lane, _mm256_set1_epi64x(k)), (__m256i)x);
}
/* The table is of single precision and 12 bits: doubled twice, 1 part in 1e13. x must lie in the range of a float. */
INLINE vec vec_rsqrt(vec x)
{
    vec y = _mm256_cvtps_pd(_mm_rsqrt_ps(_mm256_cvtpd_ps(x))), half = vec_all(0.5) * x, c = vec_all(1.5);
    y = y * vec_fnma(half * y, y, c);
    return y * vec_fnma(half * y, y, c);
}
#else
typedef double vec __attribute__((vector_size(16)));
enum { WIDTH = 2 };
#define LANES_NAME "vectors of 2"
#define KEEP(x) ((void)(x))
INLINE vec vec_all(double x) { return (vec){x, x}; }
INLINE vec vec_load(const double *p)
{
    vec x;
    memcpy(&x, p, sizeof x);
    return x;
}
INLINE void vec_store(double *p, vec x) { memcpy(p, &x, sizeof x); }
INLINE vec vec_fma(vec a, vec b, vec c) { return (vec){fma(a[0], b[0], c[0]), fma(a[1], b[1], c[1])}; }
INLINE vec vec_fms(vec a, vec b, vec c) { return vec_fma(a, b, -c); }
INLINE vec vec_fnma(vec a, vec b, vec c) { return vec_fma(-a, b, c); }
INLINE vec vec_sqrt(vec a) { return (vec){sqrt(a[0]), sqrt(a[1])}; }
INLINE vec vec_before(vec a, vec b) { return (vec){a[1], b[0]}; }
INLINE vec vec_without(vec x, int64_t k) { return (vec){k == 0 ? 0 : x[0], k == 1 ? 0 : x[1]}; }
INLINE vec vec_rsqrt(vec x) { return vec_all(1) / vec_sqrt(x); }
#endif

#endif
