/* The names of core.h for vectors of LANES doubles, as GCC and clang have them; functions end in _x and the width:
 * motus_sin_x4. It includes no header of the compiler's, because reading <immintrin.h> takes longer than compiling a
 * model.
 *
 * Invariant: an operation on a wide vector is the same operation on each lane. Where LANES is a register of the
 * machine, each is one instruction; wider vectors are made of such registers, and without them the loops below serve.
 */
#define LANES_JOIN_(a, b) a##b
#define LANES_JOIN(a, b) LANES_JOIN_(a, b)
#define NAME(f) LANES_JOIN(motus_##f##_x, LANES)

typedef double NAME(reals) __attribute__((vector_size(8 * LANES)));
typedef uint64_t NAME(bits) __attribute__((vector_size(8 * LANES)));
typedef int64_t NAME(mask) __attribute__((vector_size(8 * LANES)));
#define reals NAME(reals)
#define bits NAME(bits)
#define mask NAME(mask)

#define LANE(x, k) (x)[k]
#define REAL(c) ((c) - (reals){0}) /* c - 0 is c, even where that is -0 */
#define BITS(c) ((uint64_t)(c) | (bits){0})
#define AS_BITS(x) ((bits)(x))
#define AS_REAL(b) ((reals)(b))
#define FUSED(a, b, c) NAME(fused)(a, b, c)
#define SQRT(x) NAME(root)(x)
#define SELECT(m, a, b) NAME(select)(m, a, b)
#define ANY(m) NAME(any)(m)
#define INLINE static inline __attribute__((always_inline))
#define COLD __attribute__((noinline, cold, unused)) static
#define CONSTANT static const

/* Of LANES_PART doubles each: the registers that a vector of LANES is made of. */
#if defined(__AVX512F__) && defined(__AVX512DQ__) && LANES % 8 == 0
#define LANES_PART 8
/* 4: the present rounding */
#define LANES_FUSED(a, b, c) __builtin_ia32_vfmaddpd512_mask(a, b, c, (unsigned char)-1, 4)
#ifdef __clang__
#define LANES_SQRT(a) __builtin_ia32_sqrtpd512(a, 4)
#else
#define LANES_SQRT(a) __builtin_ia32_sqrtpd512_mask(a, a, (unsigned char)-1, 4)
#endif
#define LANES_SELECT(m, a, b) ((NAME(part))(((NAME(word))(a) & (NAME(word))(m)) | ((NAME(word))(b) & ~(NAME(word))(m))))
#define LANES_ANY(m) (__builtin_ia32_cvtq2mask512((NAME(word))(m)) != 0)
#elif defined(__AVX2__) && defined(__FMA__) && LANES % 4 == 0
#define LANES_PART 4
#define LANES_FUSED __builtin_ia32_vfmaddpd256
#define LANES_SQRT __builtin_ia32_sqrtpd256
#define LANES_SELECT(m, a, b) __builtin_ia32_blendvpd256(b, a, m)
#define LANES_ANY(m) (__builtin_ia32_movmskpd256(m) != 0)
#elif defined(__AVX2__) && defined(__FMA__) && LANES % 2 == 0
#define LANES_PART 2
#define LANES_FUSED __builtin_ia32_vfmaddpd
#define LANES_SQRT __builtin_ia32_sqrtpd
#define LANES_SELECT(m, a, b) __builtin_ia32_blendvpd(b, a, m)
#define LANES_ANY(m) (__builtin_ia32_movmskpd(m) != 0)
#endif

#ifdef LANES_PART
typedef double NAME(part) __attribute__((vector_size(8 * LANES_PART)));
typedef long long NAME(word) __attribute__((vector_size(8 * LANES_PART)));
typedef union NAME(parts) {
    reals whole;
    NAME(part) part[LANES / LANES_PART];
} NAME(parts);
#define EACH_PART for (int i = 0; i < LANES / LANES_PART; i++)

INLINE reals NAME(fused)(reals a, reals b, reals c)
{
    NAME(parts) x = {a}, y = {b}, z = {c};
    EACH_PART x.part[i] = LANES_FUSED(x.part[i], y.part[i], z.part[i]);
    return x.whole;
}

INLINE reals NAME(root)(reals a)
{
    NAME(parts) x = {a};
    EACH_PART x.part[i] = LANES_SQRT(x.part[i]);
    return x.whole;
}

INLINE reals NAME(select)(mask m, reals a, reals b)
{
    NAME(parts) x = {a}, y = {b}, z = {(reals)m};
    EACH_PART x.part[i] = LANES_SELECT(z.part[i], x.part[i], y.part[i]);
    return x.whole;
}

INLINE int NAME(any)(mask m)
{
    NAME(parts) x = {(reals)m};
    int found = 0;
    EACH_PART found |= LANES_ANY(x.part[i]);
    return found;
}
#else
INLINE reals NAME(fused)(reals a, reals b, reals c)
{
    reals r;
    for (int i = 0; i < LANES; i++) r[i] = fma(a[i], b[i], c[i]);
    return r;
}

INLINE reals NAME(root)(reals a)
{
    reals r;
    for (int i = 0; i < LANES; i++) r[i] = sqrt(a[i]);
    return r;
}

INLINE reals NAME(select)(mask m, reals a, reals b) { return (reals)(((bits)a & (bits)m) | ((bits)b & ~(bits)m)); }

INLINE int NAME(any)(mask m)
{
    int64_t found = 0;
    for (int i = 0; i < LANES; i++) found |= m[i];
    return found != 0;
}
#endif

#undef EACH_PART
#undef LANES_PART
#undef LANES_FUSED
#undef LANES_SQRT
#undef LANES_SELECT
#undef LANES_ANY
