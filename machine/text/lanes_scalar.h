/* The definitions that work.h expects, for lanes: `real` is a vector with one trajectory in each lane. The includer
 * defines `reals`, MANY_FUSED, GROUPS and OWN_CLOCK: 1 where every lane has its own time and step, 0 where all share
 * them.
 */
#define clock motus_clock
#define real reals
#if OWN_CLOCK
typedef reals clock;
#else
typedef double clock;
#endif
typedef int64_t whole;
#define FMA(a, b, c) MANY_FUSED(a, b, c)
#define FINITE(x) ((x) - (x) == 0)
#define EPSILON DBL_EPSILON
#define SQRT_EPSILON 0x1p-26
#define SMALLEST 1e-300
#if WIDTH > 1
#define ABS(x) ((real)((OF_LANES(bits))(x) & ((OF_LANES(bits)){0} + 0x7fffffffffffffffu)))
typedef OF_LANES(mask) mask;
#define ALWAYS ((mask){0} == 0)
#define PICK(where, a, b) CHOOSE(where, a, b)
#define SOME(where) OF_LANES(any)(where)
typedef OF_LANES(bits) clock_bits;
#define PATTERN_OF(x) ((clock_bits)(x))
#define CLOCK_OF(b) ((real)(b))
#else
typedef uint64_t clock_bits;
#define PATTERN_OF(x) motus_as_bits(x)
#define CLOCK_OF(b) motus_as_real(b)
#define ABS(x) fabs(x)
typedef bool mask;
#define ALWAYS true
#define PICK(where, a, b) ((where) ? (a) : (b))
#define SOME(where) (where)
#endif
#if OWN_CLOCK
typedef mask clock_mask;
typedef real ticks;
#define EVERY ALWAYS
#define CHOOSE_WHERE(where, a, b) PICK(where, a, b)
#define NONE(where) (!SOME(where))
#define FIRST(w) (!ROW(w, adaptive) && (w)->host->begins)
#endif
#if WIDTH == 8 && defined __AVX512F__ /* one instruction, which takes b where one of them is NaN */
#ifdef __clang__
#define LARGER(a, b) __builtin_ia32_maxpd512(a, b, 4)
#else
#define LARGER(a, b) __builtin_ia32_maxpd512_mask(a, b, b, (unsigned char)-1, 4)
#endif
#elif WIDTH == 4 && defined __AVX__
#define LARGER(a, b) __builtin_ia32_maxpd256(a, b)
#else
#define LARGER(a, b) PICK((a) > (b), a, b)
#endif
#define STOP(w, where, status) solve_stop(w, where)
#define SPOIL(w, y) solve_spoil(w, y)
#define BLAME(w, where, k) ((void)0)
#define EACH(k) for (size_t k = 0; k < FACT(w, nx); k++)
#define EACHV(k) for (size_t k = 0; k < FACT(w, nv); k++)
#define TRACE(w, i) ((void)(w), (void)(i))
