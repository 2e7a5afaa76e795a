/* THE ELEMENTARY FUNCTIONS, their foundation: the names that an includer supplies, and arithmetic on unevaluated sums.
 *
 * The texts of step/functions/ are written once, and compiled over doubles, over vectors of any width, and over every
 * type for which an includer defines these names. An includer includes <math.h> and <stdint.h>; then lanes.h, or
 * definitions of its own, or for plain doubles none; then this file, the texts that it needs, in this order, and end.h,
 * after which other definitions may follow:
 *
 *     core.h  plain.h  exponential.h  logarithm.h  power.h  hyperbolic.h  circular.h  inverse.h  root.h  error.h
 *     table.h  end.h
 *
 *     reals, bits         doubles and unsigned 64-bit integers, one of each per lane
 *     mask                what a comparison of reals or of bits gives; & and | combine masks
 *     LANES, LANE(x, k)   how many lanes, and lane k of a variable
 *     NAME(f)             the name of f for this type; for plain doubles motus_##f
 *     REAL(c), BITS(c)    a constant in every lane
 *     AS_BITS, AS_REAL    the same 64 bits, read the other way
 *     FUSED(a, b, c)      a b + c, rounded once
 *     SQRT(x)             rounded correctly
 *     SELECT(m, a, b)     a where m holds, else b; both are reals
 *     ANY(m)              whether m holds in some lane
 *     INLINE, COLD        what stands before a function of lanes, and before a rare one of scalars
 *     CONSTANT            what stands before a table
 *
 * Invariant: every lane is computed by the same sequence of operations, each rounded to nearest in double precision
 * and none contracted, reordered or left to a library; so the bits depend on the argument alone: not on the width,
 * the compiler, its flags or the machine. (Of NaN only that it is one.) There is no branch on data but one, around
 * the reduction of huge angles, which changes no lane that does not need it.
 */
#ifndef NAME
#define reals double
#define bits uint64_t
#define mask int
#define LANES 1
#define LANE(x, k) (x)
#define NAME(f) motus_##f
#define REAL(c) (c)
#define BITS(c) ((uint64_t)(c))
#define FUSED(a, b, c) fma(a, b, c)
#define SQRT(x) sqrt(x)
#define SELECT(m, a, b) ((m) ? (a) : (b))
#define ANY(m) (m)
#define INLINE static inline
#define CONSTANT static const
#define AS_BITS(x) NAME(as_bits)(x)
#define AS_REAL(b) NAME(as_real)(b)
/* One double has its own operations for this, with the same bits: as an integer it would move to other registers and
 * back, which takes as long as two products, and what comes next would wait for it. */
#define ABSOLUTE(x) fabs(x)
#define SIGNED(x, s) ((x)*copysign(1.0, AS_REAL(s)))
#ifdef __GNUC__
#define COLD __attribute__((noinline, cold, unused)) static
#else
#define COLD static inline
#endif
static inline uint64_t motus_as_bits(double x)
{
    union {
        double x;
        uint64_t b;
    } u = {x};
    return u.b;
}
static inline double motus_as_real(uint64_t b)
{
    union {
        uint64_t b;
        double x;
    } u = {b};
    return u.x;
}
#endif

#define SIGN_BIT BITS(0x8000000000000000)
#define INFINITE REAL((double)INFINITY)
#define NOT_A_NUMBER REAL((double)NAN)
#define SIGN_OF(x) (AS_BITS(x) & SIGN_BIT)
#ifndef ABSOLUTE
#define ABSOLUTE(x) AS_REAL(AS_BITS(x) & ~SIGN_BIT)
#define SIGNED(x, s) AS_REAL(AS_BITS(x) ^ (s)) /* x, negated where s is the sign bit */
#endif

/* Adding 1.5 2^52 rounds to an integer, to even at halves, and leaves that integer in the low bits, modulo 2^51. */
#define SHIFTER REAL(0x1.8p52)

/* Polynomials from the constant up, by Estrin's tree: half the depth of Horner's for one or two powers more. x2 =
 * x^2, x4 = x2^2. */
#define POLY2(x, a, b) FUSED(x, REAL(b), REAL(a))
#define POLY3(x, x2, a, b, c) FUSED(x2, REAL(c), POLY2(x, a, b))
#define POLY4(x, x2, a, b, c, d) FUSED(x2, POLY2(x, c, d), POLY2(x, a, b))
#define POLY5(x, x2, x4, a, b, c, d, e) FUSED(x4, REAL(e), POLY4(x, x2, a, b, c, d))
#define POLY6(x, x2, x4, a, b, c, d, e, f) FUSED(x4, POLY2(x, e, f), POLY4(x, x2, a, b, c, d))
#define POLY7(x, x2, x4, a, b, c, d, e, f, g) FUSED(x4, POLY3(x, x2, e, f, g), POLY4(x, x2, a, b, c, d))
#define POLY8(x, x2, x4, a, b, c, d, e, f, g, h) FUSED(x4, POLY4(x, x2, e, f, g, h), POLY4(x, x2, a, b, c, d))

/* hi + lo, unevaluated, |lo| small beside |hi|. */
typedef struct NAME(pair) {
    reals hi, lo;
} NAME(pair);
#define pair NAME(pair)

/* a + b exactly, where a = 0 or no exponent of b is above a's. [Dekker71] */
INLINE pair NAME(sum_ordered)(reals a, reals b)
{
    pair s;
    s.hi = a + b;
    s.lo = (a - s.hi) + b;
    return s;
}

/* a - b exactly, whatever their sizes. [Knuth69] */
INLINE pair NAME(difference)(reals a, reals b)
{
    pair s;
    s.hi = a - b;
    reals minus_b = s.hi - a;
    s.lo = (a - (s.hi - minus_b)) - (b + minus_b);
    return s;
}

/* a b exactly, unless it underflows. */
INLINE pair NAME(product)(reals a, reals b)
{
    pair p;
    p.hi = a * b;
    p.lo = FUSED(a, b, -p.hi);
    return p;
}

/* The quotient of two pairs to a rounding and a few hundredths, by one division. */
INLINE reals NAME(quotient)(pair a, pair b)
{
    a = NAME(sum_ordered)(a.hi, a.lo);
    b = NAME(sum_ordered)(b.hi, b.lo);
    reals r = REAL(1.0) / b.hi;
    reals q = a.hi * r;
    reals rest = FUSED(-q, b.hi, a.hi) + FUSED(-q, b.lo, a.lo);
    return FUSED(rest, r, q);
}

/* x 2^k, rounded once: `shifted` is SHIFTER + k, |k| < 2045. Two factors, because neither 2^1024 nor the subnormals
 * are one. */
INLINE reals NAME(scale)(reals x, reals shifted)
{
    reals k = shifted - SHIFTER;
    bits half = AS_BITS(FUSED(k, REAL(0.5), SHIFTER));
    bits rest = AS_BITS(shifted) - half;
    return x * AS_REAL((half + BITS(1023)) << 52) * AS_REAL((rest + BITS(1023)) << 52);
}
