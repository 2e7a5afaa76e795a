/* fma where there is no such instruction: a b + c with one rounding, by an error-free product and sum [Dekker71;
 * Knuth69].
 *
 * A run in the page spends most of its time here, and the C library's way takes twice as long. The linker's --wrap
 * puts this before it: what cannot be decided here (near ties, parts that overflow or could lose bits below the
 * smallest number) is left to the library, so the values are its own.
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
    /* From here up no part of the product's error is below the smallest number. A product by zero is exact. */
    const double p = a * b;
    if (!(fabs(p) > 0x1p-900)) return a == 0 || b == 0 ? p + c : __real_fma(a, b, c);
    const double a1 = head(a), a2 = a - a1, b1 = head(b), b2 = b - b1,
                 e = ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2;
    const double s = p + c, d = s - p, t = (p - (s - d)) + (c - d), tail = t + e, doubt = 0x1p-51 * tail;
    /* a b = p + e and p + c = s + t exactly; tail is t + e with one rounding. Where neither end of its doubt changes
     * the sum, that is the value. What overflows on the way makes a NaN here, which equals nothing. A product without
     * an error leaves one rounding, that of s. */
    if (s + (tail - doubt) == s + (tail + doubt)) return s + tail;
    return e == 0 ? s : __real_fma(a, b, c);
}
