/* The elementary functions of vectors of LANES doubles by those of LANES_PART: include lanes.h and the texts with LANES
 * = LANES_PART first, then this file with both defined.
 *
 * Invariant: lane k is lane k modulo LANES_PART of a part. This is the fast way for vectors wider than a register: the
 * function of a part stays in registers, and the texts compiled over the wide vector would not.
 */
#define WIDE_JOIN_(f, n) motus_##f##_x##n
#define WIDE_JOIN(f, n) WIDE_JOIN_(f, n)
#define WIDE WIDE_JOIN(reals, LANES)
#define WIDE_PART WIDE_JOIN(part, LANES)
#define WIDE_EACH for (int i = 0; i < LANES / LANES_PART; i++)
#define WIDE_UNARY(f)                                                             \
    static inline __attribute__((always_inline)) WIDE WIDE_JOIN(f, LANES)(WIDE x) \
    {                                                                             \
        const WIDE_PART *a = (const WIDE_PART *)&x;                               \
        WIDE r;                                                                   \
        WIDE_EACH((WIDE_PART *)&r)[i] = WIDE_JOIN(f, LANES_PART)(a[i]);           \
        return r;                                                                 \
    }
#define WIDE_BINARY(f)                                                                    \
    static inline __attribute__((always_inline)) WIDE WIDE_JOIN(f, LANES)(WIDE x, WIDE y) \
    {                                                                                     \
        const WIDE_PART *a = (const WIDE_PART *)&x, *b = (const WIDE_PART *)&y;           \
        WIDE r;                                                                           \
        WIDE_EACH((WIDE_PART *)&r)[i] = WIDE_JOIN(f, LANES_PART)(a[i], b[i]);             \
        return r;                                                                         \
    }

typedef double WIDE __attribute__((vector_size(8 * LANES)));
typedef WIDE_JOIN(reals, LANES_PART) WIDE_PART __attribute__((may_alias));

WIDE_UNARY(sin)
WIDE_UNARY(cos)
WIDE_UNARY(tan)
WIDE_UNARY(asin)
WIDE_UNARY(acos)
WIDE_UNARY(atan)
WIDE_BINARY(atan2)
WIDE_UNARY(sinh)
WIDE_UNARY(cosh)
WIDE_UNARY(tanh) WIDE_UNARY(exp) WIDE_UNARY(log) WIDE_BINARY(pow) WIDE_UNARY(cbrt) WIDE_BINARY(hypot) WIDE_UNARY(erf)

#undef WIDE_JOIN_
#undef WIDE_JOIN
#undef WIDE
#undef WIDE_PART
#undef WIDE_EACH
#undef WIDE_UNARY
#undef WIDE_BINARY
#undef LANES
#undef LANES_PART
