/* The texts with real = double: one trajectory. The includer has <float.h>, <math.h>, <stddef.h> and <stdint.h>. */
#define clock motus_clock /* the C library has a function of that name */
#define real double
typedef double clock;
typedef int64_t whole;
#define FMA(a, b, c) fma((a), (b), (c))
#define ABS(x) fabs(x)
/* an infinity or a NaN minus itself is NaN; unlike isfinite, this can be vectorised */
#define FINITE(x) ((x) - (x) == 0)
#define EPSILON DBL_EPSILON
#define SQRT_EPSILON 0x1p-26
#define SMALLEST 1e-300
typedef uint64_t clock_bits;
static inline uint64_t bits_of_clock(double x)
{
    const union {
        double x;
        uint64_t b;
    } u = {x};
    return u.b;
}
static inline double clock_of_bits(uint64_t b)
{
    const union {
        uint64_t b;
        double x;
    } u = {b};
    return u.x;
}
#define PATTERN_OF(x) bits_of_clock(x)
#define CLOCK_OF(b) clock_of_bits(b)
#define EACH(k) for (size_t k = 0; k < FACT(w, nx); k++)
#define EACHV(k) for (size_t k = 0; k < FACT(w, nv); k++)
#define TRACE(w, i) ((void)(w), (void)(i))
