/* fma where there is no such instruction: a b + c with one rounding, by an error-free product and sum [Dekker71; Knuth69].
 *
 * A run in the page spends most of its time here, and the C library's way takes twice as long. The linker's --wrap puts this before it: what cannot
 * be decided here (ties, parts that overflow or lose bits below the smallest number) is left to the library, so the values are its own.
 */
#include <math.h>

double __real_fma(double, double, double);
double __wrap_fma(double, double, double);

/* x rounded to 26 bits [Dekker71, Veltkamp's split]. */
static inline double head(double x)
{
    const double c = 0x8000001p0 * x;
    return c - (c - x);
}

double __wrap_fma(double a, double b, double c)
{
    const double p = a * b, a1 = head(a), a2 = a - a1, b1 = head(b), b2 = b - b1;
    const double e = ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2;
    const double s = p + c, d = s - p, t = (p - (s - d)) + (c - d), tail = t + e;
    /* a b = p + e and p + c = s + t exactly; tail is t + e with one rounding. Where neither end of its doubt changes the sum, that is the value.
     * What overflows on the way makes a NaN of it, and NaN is equal to nothing. A product's error that is below the smallest number is none. */
    const double value = s + tail, doubt = 0x1p-51 * tail;
    if (fabs(p) > 0x1p-900 && s + (tail - doubt) == value && s + (tail + doubt) == value) return value;
    /* A product without an error: one rounding is all there is. */
    if (a == 0 || b == 0 || (fabs(p) > 0x1p-900 && e == 0)) return s;
    return __real_fma(a, b, c);
}
