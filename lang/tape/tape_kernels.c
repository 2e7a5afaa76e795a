/* A loop over lanes for every operation and every mix of block and scalar operands, compiled for several instruction
 * sets (tape_isa.h).
 *
 * Invariant: lane k of the result depends on lane k of the operands alone, by the row's value. So the bits depend
 * neither on the number of lanes nor on the instruction set, and the result may lie where an operand lies.
 */
#include "lang/tape/tape_isa.h"

#include <string.h>

/* The elementary functions in vector registers, where the instruction set has them. */
#if defined(__AVX512F__) && defined(__AVX512DQ__)
#define WIDTH 8
#define LANES 8
#elif defined(__AVX2__) && defined(__FMA__)
#define WIDTH 4
#define LANES 4
#endif
#ifdef WIDTH
#include "step/functions/lanes.h"
#include "lang/base/functions.h"
#endif

#if defined(__clang__)
#define INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#pragma clang diagnostic ignored "-Wpass-failed" /* functions without lanes stay scalar */
#elif defined(__GNUC__)
#define INDEPENDENT _Pragma("GCC ivdep")
#else
#define INDEPENDENT
#endif

#ifdef __GNUC__
#define UNUSED __attribute__((unused)) /* where the version in lanes is used */
#else
#define UNUSED
#endif

/* A scalar operand is read before the loop: the compiler cannot know that the result does not lie there. */
#define KERNEL(id, mask, value)                                                                               \
    UNUSED static void id##_##mask(double *r, const double *pa, const double *pb, const double *pc, size_t n) \
    {                                                                                                         \
        const double sa = *pa, sb = *pb, sc = *pc;                                                            \
        INDEPENDENT                                                                                           \
        for (size_t k = 0; k < n; k++) {                                                                      \
            const double a = (mask)&1 ? pa[k] : sa, b = (mask)&2 ? pb[k] : sb, c = (mask)&4 ? pc[k] : sc;     \
            (void)a, (void)b, (void)c;                                                                        \
            r[k] = value;                                                                                     \
        }                                                                                                     \
    }

#define LEAF(...)
#define UNARY(id, spelling, degree, nature, value, derivative, keeps, sums, recurrence) KERNEL(id, 1, value)
#define BINARY(id, spelling, degree, nature, value, derivative, keeps, sums, recurrence) \
    KERNEL(id, 1, value) KERNEL(id, 2, value) KERNEL(id, 3, value)
#define FUNCTION(id, arity, spelling, degree, nature, value, derivative, keeps, sums, recurrence) \
    FUNCTION_##arity(id, CALLED(id, value))
#define FUNCTION_1(id, value) KERNEL(id, 1, value)
#define FUNCTION_2(id, value) KERNEL(id, 1, value) KERNEL(id, 2, value) KERNEL(id, 3, value)
#define TERNARY(id, spelling, degree, nature, value, derivative, keeps, sums, recurrence) \
    KERNEL(id, 1, value)                                                                  \
    KERNEL(id, 2, value)                                                                  \
    KERNEL(id, 3, value) KERNEL(id, 4, value) KERNEL(id, 5, value) KERNEL(id, 6, value) KERNEL(id, 7, value)
#include "lang/base/operations.def"

#ifdef WIDTH
/* The kernels in vector registers; lanes that fill no vector are computed one by one. */
#define VECTOR_(n) motus_reals_x##n
#define VECTOR(n) VECTOR_(n)
typedef VECTOR(WIDTH) vector;
static inline vector vector_at(const double *p, int lanes)
{
    vector v = {0};
    if (lanes)
        memcpy(&v, p, sizeof v);
    else
        v = *p - v;
    return v;
}
#define LANED_(f, n) motus_##f##_x##n
#define LANED(f, n) LANED_(f, n)
#define LANED_KERNEL(id, mask, many, one)                                                                              \
    static void id##_lanes_##mask(double *r, const double *pa, const double *pb, const double *pc, size_t n)           \
    {                                                                                                                  \
        const double sa = *pa, sb = *pb;                                                                               \
        size_t k = 0;                                                                                                  \
        (void)pc, (void)sa, (void)sb;                                                                                  \
        for (; k + WIDTH <= n; k += WIDTH) {                                                                           \
            vector a = vector_at((mask)&1 ? pa + k : &sa, (mask)&1), b = vector_at((mask)&2 ? pb + k : &sb, (mask)&2); \
            (void)b;                                                                                                   \
            vector v = many;                                                                                           \
            memcpy(r + k, &v, sizeof v);                                                                               \
        }                                                                                                              \
        for (; k < n; k++) {                                                                                           \
            const double a = (mask)&1 ? pa[k] : sa, b = (mask)&2 ? pb[k] : sb;                                         \
            (void)b;                                                                                                   \
            r[k] = one;                                                                                                \
        }                                                                                                              \
    }
#define LANED_1(id, f) LANED_KERNEL(id, 1, LANED(f, WIDTH)(a), motus_##f(a))
#define LANED_2(id, f)                                          \
    LANED_KERNEL(id, 1, LANED(f, WIDTH)(a, b), motus_##f(a, b)) \
    LANED_KERNEL(id, 2, LANED(f, WIDTH)(a, b), motus_##f(a, b)) \
    LANED_KERNEL(id, 3, LANED(f, WIDTH)(a, b), motus_##f(a, b))
LANED_1(SIN, sin)
LANED_1(COS, cos)
LANED_1(TAN, tan)
LANED_1(ASIN, asin)
LANED_1(ACOS, acos)
LANED_1(ATAN, atan)
LANED_1(SINH, sinh)
LANED_1(COSH, cosh)
LANED_1(TANH, tanh)
LANED_1(EXP, exp)
LANED_1(LOG, log)
LANED_1(CBRT, cbrt)
LANED_1(ERF, erf)
LANED_2(ATAN2, atan2)
LANED_2(HYPOT, hypot)
LANED_2(POW, pow)

/* The kernel of a row: the one in lanes where HAS_… makes a second argument of it. */
#define HAS_SIN_1 ~, SIN_lanes_1
#define HAS_COS_1 ~, COS_lanes_1
#define HAS_TAN_1 ~, TAN_lanes_1
#define HAS_ASIN_1 ~, ASIN_lanes_1
#define HAS_ACOS_1 ~, ACOS_lanes_1
#define HAS_ATAN_1 ~, ATAN_lanes_1
#define HAS_SINH_1 ~, SINH_lanes_1
#define HAS_COSH_1 ~, COSH_lanes_1
#define HAS_TANH_1 ~, TANH_lanes_1
#define HAS_EXP_1 ~, EXP_lanes_1
#define HAS_LOG_1 ~, LOG_lanes_1
#define HAS_CBRT_1 ~, CBRT_lanes_1
#define HAS_ERF_1 ~, ERF_lanes_1
#define HAS_ATAN2_1 ~, ATAN2_lanes_1
#define HAS_ATAN2_2 ~, ATAN2_lanes_2
#define HAS_ATAN2_3 ~, ATAN2_lanes_3
#define HAS_HYPOT_1 ~, HYPOT_lanes_1
#define HAS_HYPOT_2 ~, HYPOT_lanes_2
#define HAS_HYPOT_3 ~, HYPOT_lanes_3
#define HAS_POW_1 ~, POW_lanes_1
#define HAS_POW_2 ~, POW_lanes_2
#define HAS_POW_3 ~, POW_lanes_3
#endif
#define SECOND(a, b, ...) b
#define BEST_(...) SECOND(__VA_ARGS__, ~)
#define BEST(id, mask) BEST_(HAS_##id##_##mask, id##_##mask)

#define LEAF(...)
#define UNARY(id, ...) [OP_##id * 8 + 1] = BEST(id, 1),
#define BINARY(id, ...) \
    [OP_##id * 8 + 1] = BEST(id, 1), [OP_##id * 8 + 2] = BEST(id, 2), [OP_##id * 8 + 3] = BEST(id, 3),
#define TERNARY(id, ...)                                                                                            \
    [OP_##id * 8 + 1] = id##_1, [OP_##id * 8 + 2] = id##_2, [OP_##id * 8 + 3] = id##_3, [OP_##id * 8 + 4] = id##_4, \
                   [OP_##id * 8 + 5] = id##_5, [OP_##id * 8 + 6] = id##_6, [OP_##id * 8 + 7] = id##_7,
block_kernel *const OF_ISA(tape_kernels_)[OPERATIONS * 8] = {
#include "lang/base/operations.def"
};
