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

/* A scalar operand is read before the loop: the compiler cannot know that the result does not lie there. */
#define KERNEL(id, mask, value)                                                                           \
    static void id##_##mask(double *r, const double *pa, const double *pb, const double *pc, size_t n)    \
    {                                                                                                     \
        const double sa = *pa, sb = *pb, sc = *pc;                                                        \
        INDEPENDENT                                                                                       \
        for (size_t k = 0; k < n; k++) {                                                                  \
            const double a = (mask)&1 ? pa[k] : sa, b = (mask)&2 ? pb[k] : sb, c = (mask)&4 ? pc[k] : sc; \
            (void)a, (void)b, (void)c;                                                                    \
            r[k] = value;                                                                                 \
        }                                                                                                 \
    }

#define LEAF(...)
#define UNARY(id, spelling, degree, nature, value, derivative, keeps, sums, recurrence) KERNEL(id, 1, value)
#define BINARY(id, spelling, degree, nature, value, derivative, keeps, sums, recurrence) \
    KERNEL(id, 1, value) KERNEL(id, 2, value) KERNEL(id, 3, value)
#define FUNCTION(id, arity, name, texts, value) FUNCTION_##arity(id, CALLED(id, value))
#define FUNCTION_1(id, value) KERNEL(id, 1, value)
#define FUNCTION_2(id, value) KERNEL(id, 1, value) KERNEL(id, 2, value) KERNEL(id, 3, value)
#define TERNARY(id, spelling, degree, nature, value, derivative, keeps, sums, recurrence) \
    KERNEL(id, 1, value)                                                                  \
    KERNEL(id, 2, value)                                                                  \
    KERNEL(id, 3, value) KERNEL(id, 4, value) KERNEL(id, 5, value) KERNEL(id, 6, value) KERNEL(id, 7, value)
#include "lang/base/operations.def"

#ifdef WIDTH
/* The functions whose values are calls, in vector registers; lanes that fill no vector are computed one by one. */
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
#define LANED_KERNEL(id, mask, value)                                                                                  \
    static void id##_lanes_##mask(double *r, const double *pa, const double *pb, const double *pc, size_t n)           \
    {                                                                                                                  \
        const double sa = *pa, sb = *pb;                                                                               \
        size_t k = 0;                                                                                                  \
        for (; k + WIDTH <= n; k += WIDTH) {                                                                           \
            vector a = vector_at((mask)&1 ? pa + k : &sa, (mask)&1), b = vector_at((mask)&2 ? pb + k : &sb, (mask)&2); \
            (void)b;                                                                                                   \
            const vector v = value;                                                                                    \
            memcpy(r + k, &v, sizeof v);                                                                               \
        }                                                                                                              \
        if (k < n) id##_##mask(r + k, (mask)&1 ? pa + k : &sa, (mask)&2 ? pb + k : &sb, pc, n - k);                    \
    }
#define OF(f) LANED(f, WIDTH)
#define OP(...)
#define FUNCTION(id, arity, name, texts, value) LANED_##arity(id, value)
#define LANED_1(id, value) LANED_KERNEL(id, 1, value)
#define LANED_2(id, value) LANED_KERNEL(id, 1, value) LANED_KERNEL(id, 2, value) LANED_KERNEL(id, 3, value)
#include "lang/base/operations.def"
#undef OP
#define FUNCTION(id, arity, ...) KERNELS_##arity(id, id##_lanes)
#else
#define FUNCTION(id, arity, ...) KERNELS_##arity(id, id)
#endif

#define KERNELS_1(id, name) [OP_##id * 8 + 1] = name##_1,
#define KERNELS_2(id, name) [OP_##id * 8 + 1] = name##_1, [OP_##id * 8 + 2] = name##_2, [OP_##id * 8 + 3] = name##_3,
#define LEAF(...)
#define UNARY(id, ...) KERNELS_1(id, id)
#define BINARY(id, ...) KERNELS_2(id, id)
#define TERNARY(id, ...)                                                                                            \
    [OP_##id * 8 + 1] = id##_1, [OP_##id * 8 + 2] = id##_2, [OP_##id * 8 + 3] = id##_3, [OP_##id * 8 + 4] = id##_4, \
                   [OP_##id * 8 + 5] = id##_5, [OP_##id * 8 + 6] = id##_6, [OP_##id * 8 + 7] = id##_7,
block_kernel *const OF_ISA(tape_kernels_)[OPERATIONS * 8] = {
#include "lang/base/operations.def"
};
