/* The functions of the language that are one operation of the machine, or a few; the others are in functions_*.h. Every machine
 * evaluates a model through both.
 *
 * Invariant: f(NaN) is NaN for all of them but for the cases where C's pow and hypot say otherwise, and no result depends on the
 * sign of a zero that the mathematics does not have. What is called here by name is exact or rounded correctly in every C library.
 */
#ifndef STEP_ELEMENTARY_H
#define STEP_ELEMENTARY_H

static inline double motus_sqrt(double x) { return sqrt(x); }
static inline double motus_abs(double x) { return fabs(x); }
static inline double motus_floor(double x) { return floor(x); }

/* min and max pass a NaN on, whichever side it is on (C's fmin hides it, and with it a divergence); -0 counts as below +0, so that
 * the operands may be exchanged without changing a bit. */
static inline double motus_min(double x, double y)
{
    if (x < y) return x;
    if (y < x) return y;
    if (x == y) return signbit(x) ? x : y;
    return x + y;
}

static inline double motus_max(double x, double y)
{
    if (x > y) return x;
    if (y > x) return y;
    if (x == y) return signbit(x) ? y : x;
    return x + y;
}

/* The mathematical mod, x - y floor(x/y): its sign is the divisor's, mod(-1, 3) = 2. mod(x, 0) is NaN. The remainder itself is
 * exact; only the shift by y may round, so that mod of a tiny negative x can be y itself. */
static inline double motus_mod(double x, double y)
{
    double r = fmod(x, y);
    if (r == 0) return copysign(0.0, y);
    return (r < 0) != (y < 0) ? r + y : r;
}

/* -1, 0 or 1; sign(0) = 0 = sign(-0). */
static inline double motus_sign(double x)
{
    return x > 0 ? 1.0 : x < 0 ? -1.0 : x == 0 ? 0.0 : x;
}

#endif
