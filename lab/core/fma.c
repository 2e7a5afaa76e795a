/* fma where there is no such instruction: a b + c with one rounding, by an error-free product and sum [Dekker71; Knuth69].
 *
 * A run in the page spends most of its time here, and the C library's way takes twice as long. The linker's --wrap puts this before it: what cannot
 * be decided here (near ties, parts that could overflow or lose bits below the smallest number) is left to the library, so the values are its own.
 */
#include <stdint.h>
#include <string.h>

double __real_fma(double, double, double);
double __wrap_fma(double, double, double);

static inline uint64_t exponent(double x)
{
    uint64_t u;
    memcpy(&u, &x, sizeof u);
    return u >> 52 & 0x7ff;
}

/* x rounded to 26 bits [Dekker71, Veltkamp's split]. */
static inline double head(double x)
{
    const double c = 0x8000001p0 * x;
    return c - (c - x);
}

double __wrap_fma(double a, double b, double c)
{
    /* All parts are finite, and the product's error is a number: neither below the smallest nor rounded. */
    const uint64_t ea = exponent(a), eb = exponent(b), ec = exponent(c);
    if (ea - 300 > 1400 || eb - 300 > 1400 || ea + eb - 1200 > 1700 || ec > 2000)
        return __real_fma(a, b, c);
    const double a1 = head(a), a2 = a - a1, b1 = head(b), b2 = b - b1;
    const double p = a * b, e = ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2;
    const double s = p + c, d = s - p, t = (p - (s - d)) + (c - d), tail = t + e;
    /* p = a b - e and s = p + c - t exactly; tail is t + e with one rounding. Where neither end of its doubt changes the sum, that is the value. */
    const double doubt = 0x1p-51 * tail, low = s + (tail - doubt), high = s + (tail + doubt);
    return low == high ? low : __real_fma(a, b, c);
}
