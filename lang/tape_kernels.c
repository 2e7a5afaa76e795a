/* One loop over lanes for every operation and every mix of block and scalar operands; compiled for several instruction sets, see tape_isa.h.
 *
 * Invariant: lane k of the result depends on lane k of the operands alone, by the row's value; so the bits do not depend on the number of
 * lanes, nor on the instruction set, and the result may lie where an operand lies.
 */
#include "lang/tape_isa.h"

#if defined(__clang__)
#define INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#pragma clang diagnostic ignored "-Wpass-failed"     /* the C library's functions stay scalar: that is known */
#elif defined(__GNUC__)
#define INDEPENDENT _Pragma("GCC ivdep")
#else
#define INDEPENDENT
#endif

/* A scalar operand is read once: the compiler cannot know that the result does not lie there. */
#define KERNEL(id, mask, value)                                                                                       \
    static void id##_##mask(double *r, const double *pa, const double *pb, const double *pc, size_t n)                \
    {                                                                                                                 \
        const double sa = *pa, sb = *pb, sc = *pc;                                                                    \
        INDEPENDENT                                                                                                   \
        for (size_t k = 0; k < n; k++) {                                                                              \
            const double a = (mask) & 1 ? pa[k] : sa, b = (mask) & 2 ? pb[k] : sb, c = (mask) & 4 ? pc[k] : sc;       \
            (void)a, (void)b, (void)c;                                                                                \
            r[k] = value;                                                                                             \
        }                                                                                                             \
    }

#define LEAF(...)
#define UNARY(id, spelling, degree, smooth, value, derivative) KERNEL(id, 1, value)
#define BINARY(id, spelling, degree, smooth, value, derivative) KERNEL(id, 1, value) KERNEL(id, 2, value) KERNEL(id, 3, value)
#define TERNARY(id, spelling, degree, smooth, value, derivative)                                                      \
    KERNEL(id, 1, value) KERNEL(id, 2, value) KERNEL(id, 3, value) KERNEL(id, 4, value) KERNEL(id, 5, value)          \
    KERNEL(id, 6, value) KERNEL(id, 7, value)
#include "lang/operations.def"

#define LEAF(...)
#define UNARY(id, ...) [OP_##id * 8 + 1] = id##_1,
#define BINARY(id, ...) [OP_##id * 8 + 1] = id##_1, [OP_##id * 8 + 2] = id##_2, [OP_##id * 8 + 3] = id##_3,
#define TERNARY(id, ...)                                                                                              \
    [OP_##id * 8 + 1] = id##_1, [OP_##id * 8 + 2] = id##_2, [OP_##id * 8 + 3] = id##_3, [OP_##id * 8 + 4] = id##_4,   \
    [OP_##id * 8 + 5] = id##_5, [OP_##id * 8 + 6] = id##_6, [OP_##id * 8 + 7] = id##_7,
block_kernel *const OF_ISA(tape_kernels_)[OPERATIONS * 8] = {
#include "lang/operations.def"
};
