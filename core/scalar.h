/* What the texts of step/ need for one trajectory, real = double. Include <float.h>, <math.h>, <stddef.h> and
 * <stdint.h> before. */
#define clock motus_clock /* the C library has a function of that name */
#define real double
typedef double clock;
typedef int64_t whole;
#define FMA(a, b, c) fma((a), (b), (c))
#define ABS(x) fabs(x)
/* An infinity or a NaN minus itself is NaN. Compilers vectorise this, but not isfinite. */
#define FINITE(x) ((x) - (x) == 0)
#define EPSILON DBL_EPSILON
#define SQRT_EPSILON 0x1p-26
#define SMALLEST 1e-300
typedef uint64_t clock_bits;
typedef union clock_pattern {
    double number;
    uint64_t bits;
} clock_pattern;
#define PATTERN_OF(x) (((const clock_pattern){.number = (x)}).bits)
#define CLOCK_OF(b) (((const clock_pattern){.bits = (b)}).number)
#define EACH(k) for (size_t k = 0; k < FACT(w, nx); k++)
#define EACHV(k) for (size_t k = 0; k < FACT(w, nv); k++)
#define TRACE(w, i) ((void)(w), (void)(i))
