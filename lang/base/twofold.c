/* See twofold.h.
 *
 * Sums and products keep what rounding takes from them, exactly or as a bound [Dekker71, Knuth69], so every formula
 * that is made of them bounds its own error; a series adds the bound of its remainder. A function starts from its value
 * in doubles, and adds a short series of the small rest.
 */
#include "lang/base/twofold.h"

#include "lang/base/interval.h"

#include <math.h>

static const twofold half_turn = {0x1.921fb54442d18p1, 0x1.1a62633145c07p-53, 0x1p-106};
static const twofold log_2 = {0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56, 0x1p-109};

static twofold nothing(double value) { return (twofold){value, 0, INFINITY}; }

static double size_of(twofold a) { return fabs(a.high) + fabs(a.low) + a.error; } /* no number in a is larger */

/* Returns a + b in double, and in *rest what rounding takes from it. */
static double two_sum(double a, double b, double *rest)
{
    const double s = a + b, of_b = s - a;
    *rest = (a - (s - of_b)) + (b - of_b);
    return s;
}

static double two_product(double a, double b, double *rest)
{
    const double p = a * b;
    *rest = fma(a, b, -p);
    return p;
}

static twofold more(twofold a, double error) { return (twofold){a.high, a.low, a.error + error}; }
static twofold negative(twofold a) { return (twofold){-a.high, -a.low, a.error}; }
/* Multiplies by a power of 2. */
static twofold scaled(twofold a, double power) { return (twofold){a.high * power, a.low * power, a.error * power}; }

static twofold plus(twofold a, twofold b)
{
    double rest, rest_low, left, none;
    const double high = two_sum(a.high, b.high, &rest), low = two_sum(a.low, b.low, &rest_low);
    const double both = two_sum(rest, low, &left);
    twofold s = {.error = a.error + b.error + fabs(rest_low) + fabs(left)};
    s.high = two_sum(high, both, &s.low);
    none = s.high + s.low;
    return isfinite(none) ? s : nothing(none);
}

static twofold minus(twofold a, twofold b) { return plus(a, negative(b)); }

static twofold times(twofold a, twofold b)
{
    double rest, rest_a, rest_b, left, left_low;
    const double high = two_product(a.high, b.high, &rest);
    const double low_a = two_product(a.low, b.high, &rest_a), low_b = two_product(a.high, b.low, &rest_b);
    const double low = two_sum(low_a, low_b, &left_low), both = two_sum(rest, low, &left);
    const bool tiny = a.high != 0 && b.high != 0 && !(fabs(high) > 0x1p-900); /* the rest may underflow */
    twofold p = {.error = size_of(a) * b.error + (fabs(b.high) + fabs(b.low)) * a.error + fabs(a.low * b.low) +
                          fabs(rest_a) + fabs(rest_b) + fabs(left_low) + fabs(left) + (tiny ? 0x1p-1060 : 0)};
    p.high = two_sum(high, both, &p.low);
    return isfinite(p.high) && isfinite(p.low) && !isnan(p.error) ? p : nothing(high);
}

static twofold square(twofold a) { return times(a, a); }

/* Divides: from the quotient q of doubles, q + (a - q b)/b, twice. */
static twofold over(twofold a, twofold b)
{
    const double least = fabs(b.high) - fabs(b.low) - b.error;
    if (a.high == 0 && a.low == 0 && a.error == 0 && least > 0) return twofold_of(0);
    if (!(least > 0)) return nothing(a.high / b.high);
    const twofold of = {a.high, a.low, 0}, by = {b.high, b.low, 0};
    twofold q = twofold_of(a.high / b.high);
    twofold left = minus(of, times(q, by));
    q = plus(q, twofold_of(left.high / b.high));
    left = minus(of, times(q, by));
    q.error = (size_of(left) + a.error + (fabs(q.high) + fabs(q.low)) * b.error) / least;
    return isfinite(q.high) && !isnan(q.error) ? q : nothing(a.high / b.high);
}

static twofold root(twofold a)
{
    const double least = a.high - fabs(a.low) - a.error;
    if (a.high == 0 && a.low == 0 && a.error == 0) return a;
    if (!(least > 0)) { /* 0 is within a, or near it */
        const double most = sqrt(size_of(a));
        return a.high + a.error >= 0 && isfinite(most) ? (twofold){most / 2, 0, most / 2 + twofold_unit(most)}
                                                       : nothing(NAN);
    }
    const twofold of = {a.high, a.low, 0};
    twofold r = twofold_of(sqrt(a.high));
    twofold left = minus(of, square(r));
    r = plus(r, twofold_of(left.high / (2 * r.high)));
    left = minus(of, square(r));
    r.error = (size_of(left) + a.error) / sqrt(least);
    return r;
}

/* Returns log(1 + d) = d - d^2/2 + d^3/3 … of a small d; the remainder is below d^4. */
static twofold log_near_1(twofold d)
{
    const double size = size_of(d);
    if (!(size < 0.5)) return nothing(d.high);
    const twofold d2 = square(d), d3 = times(d2, d);
    return more(plus(minus(d, scaled(d2, 0.5)), over(d3, twofold_of(3))), size * size * size * size);
}

/* Returns e^x = 2^k e^r, where e^r - 1 is a series of r/2^PARTS, doubled PARTS times. */
static twofold exponential(twofold x)
{
    enum { PARTS = 8, TERMS = 13 };
    if (!(size_of(x) < 700)) return nothing(operation_value(OP_EXP, x.high, 0, 0));
    const double k = nearbyint(x.high / log_2.high);
    const twofold r = scaled(minus(x, times(twofold_of(k), log_2)), 1.0 / (1 << PARTS));
    twofold part = twofold_of(0);
    for (int n = TERMS; n > 0; n--) part = times(over(r, twofold_of(n)), plus(twofold_of(1), part));
    const double size = size_of(r);
    part = more(part, pow(size, TERMS + 1)); /* the remainder is far less, by (TERMS + 1)! */
    for (int n = 0; n < PARTS; n++) part = plus(scaled(part, 2), square(part));
    return scaled(plus(twofold_of(1), part), ldexp(1, (int)k));
}

static twofold logarithm(twofold x)
{
    if (!(x.high - fabs(x.low) - x.error > 0)) return nothing(operation_value(OP_LOG, x.high, 0, 0));
    if (x.high == 1 && x.low == 0 && x.error == 0) return twofold_of(0);
    const twofold near = twofold_of(operation_value(OP_LOG, x.high, 0, 0));
    return plus(near, log_near_1(minus(times(x, exponential(negative(near))), twofold_of(1))));
}

/* Returns the series of sin (from = 1) or cos (from = 0) of |x| <= 0.8. */
static twofold wave(twofold x, int from)
{
    enum { LAST = 28 };
    const twofold x2 = negative(square(x));
    twofold sum = twofold_of(1);
    for (int n = LAST + from; n > from; n -= 2)
        sum = plus(twofold_of(1), times(over(x2, twofold_of((double)n * (n - 1))), sum));
    sum = more(sum, 0x1p-108 * fmin(1, fabs(x.high)));
    return from ? times(x, sum) : sum;
}

/* Returns sin (quarter 0) or cos (quarter 1). */
static twofold turned(twofold x, int quarter)
{
    if (!(size_of(x) < 0x1p40)) return nothing(NAN);
    if (x.high == 0 && x.low == 0 && x.error == 0) return twofold_of(quarter);
    const double n = nearbyint(x.high / (half_turn.high / 2));
    const twofold r = minus(x, times(twofold_of(n), scaled(half_turn, 0.5)));
    const int at = (int)((int64_t)n & 3) + quarter;
    if (!(size_of(r) < 0.9)) return (twofold){0, 0, 1}; /* the error of x is as large as that */
    const twofold w = wave(r, !(at & 1));
    return at & 2 ? negative(w) : w;
}

/* Returns the angle of (x, y): that of doubles, and the small angle that is missing. */
static twofold angle(twofold y, twofold x)
{
    const double near = operation_value(OP_ATAN2, y.high, x.high, 0);
    if (y.high == 0 && y.low == 0 && y.error == 0 && x.high > 0) return twofold_of(near);
    const twofold s = turned(twofold_of(near), 0), c = turned(twofold_of(near), 1);
    const twofold d = over(minus(times(y, c), times(x, s)), plus(times(x, c), times(y, s)));
    const double size = size_of(d);
    if (!(size < 0.5) || (x.high < 0 && y.error > 0 && fabs(y.high) <= y.error)) return nothing(near);
    const twofold d2 = square(d), third = over(twofold_of(1), twofold_of(3)),
                  fifth = over(twofold_of(1), twofold_of(5));
    const twofold series = minus(twofold_of(1), times(d2, minus(third, times(d2, fifth))));
    return more(plus(twofold_of(near), times(d, series)), pow(size, 7));
}

/* Returns sqrt(1 - x^2). */
static twofold beside(twofold x) { return root(times(minus(twofold_of(1), x), plus(twofold_of(1), x))); }

static twofold hyperbolic_sine(twofold x)
{
    enum { LAST = 25 };
    if (size_of(x) < 0.5) {
        twofold sum = twofold_of(1);
        for (int n = LAST; n > 1; n -= 2)
            sum = plus(twofold_of(1), times(over(square(x), twofold_of((double)n * (n - 1))), sum));
        return more(times(x, sum), 0x1p-108 * fabs(x.high));
    }
    const twofold e = exponential(x);
    return scaled(minus(e, over(twofold_of(1), e)), 0.5);
}

static twofold hyperbolic_cosine(twofold x)
{
    const twofold e = exponential(x);
    return scaled(plus(e, over(twofold_of(1), e)), 0.5);
}

static twofold hyperbolic_tangent(twofold x)
{
    if (fabs(x.high) - x.error > 50) return (twofold){copysign(1, x.high), 0, 0x1p-140};
    return over(hyperbolic_sine(x), hyperbolic_cosine(x));
}

/* Returns y (1 + d)^(1/3), where y is the root in doubles and 1 + d = x/y^3. */
static twofold cube_root(twofold x)
{
    const double y = operation_value(OP_CBRT, x.high, 0, 0);
    if (!(fabs(x.high) > fabs(x.low) + x.error)) return (twofold){0, 0, cbrt(size_of(x)) + twofold_unit(y)};
    const twofold near = twofold_of(y), d = minus(over(x, times(near, square(near))), twofold_of(1)), d2 = square(d);
    const double size = size_of(d);
    if (!(size < 0.5)) return nothing(y);
    const twofold sum = plus(minus(over(d, twofold_of(3)), over(d2, twofold_of(9))),
                             over(times(twofold_of(5), times(d, d2)), twofold_of(81)));
    return times(near, plus(twofold_of(1), more(sum, size * size * size * size)));
}

static twofold power(twofold x, twofold y)
{
    enum { PRODUCTS = 1024 };
    if (y.low != 0 || y.error != 0 || y.high != floor(y.high) || fabs(y.high) > PRODUCTS)
        return exponential(times(y, logarithm(x)));
    twofold p = twofold_of(1);
    for (int n = (int)fabs(y.high); n > 0; n /= 2, x = square(x))
        if (n % 2) p = times(p, x);
    return y.high < 0 ? over(twofold_of(1), p) : p;
}

/* Returns floor(x); a number nearer to a whole number than decimals can be is that number. */
static twofold whole(twofold x)
{
    const double near = nearbyint(x.high) + nearbyint(x.low), off = fabs((x.high - near) + x.low) + x.error;
    if (off <= TWOFOLD_KNOWN * fmax(1, fabs(near))) return twofold_of(near);
    const twofold from = plus(x, twofold_of(-near));
    const double low = floor(from.high - x.error), high = floor(from.high + fabs(from.low) + x.error);
    return plus(twofold_of(near), (twofold){low == high ? low : (low + high) / 2, 0, (high - low) / 2});
}

/* Returns -1, 0 or 1 as a is less than b, equal to it or greater. */
static twofold compared(twofold a, twofold b)
{
    const twofold d = minus(a, b);
    if (size_of(d) <= TWOFOLD_KNOWN * fmax(size_of(a), size_of(b))) return twofold_of(0);
    if (fabs(d.high) > fabs(d.low) + d.error) return twofold_of(d.high > 0 ? 1 : -1);
    return (twofold){0, 0, 1};
}

/* Returns what a comparison answers, from the sign of a difference. */
static twofold answer(twofold sign, bool less, bool equal, bool greater)
{
    if (sign.error > 0) return less && equal && greater ? twofold_of(1) : (twofold){0.5, 0, 0.5};
    return twofold_of(sign.high < 0 ? less : sign.high > 0 ? greater : equal);
}

/* Returns a, with an error that covers b. */
static twofold either(twofold a, twofold b) { return more(a, size_of(minus(a, b)) + b.error); }

/* Returns the larger, or (wanted false) the smaller one; its error is no larger than those of the operands. */
static twofold larger(twofold a, twofold b, bool wanted)
{
    const twofold d = minus(a, b);
    twofold r = (d.high > 0) == wanted ? a : b;
    r.error = fmax(a.error, b.error);
    return r;
}

static twofold computed(operation op, twofold a, twofold b, twofold c)
{
    switch (op) {
    case OP_NEG: return negative(a);
    case OP_ADD: return plus(a, b);
    case OP_SUB: return minus(a, b);
    case OP_MUL: return times(a, b);
    case OP_DIV: return over(a, b);
    case OP_LT: return answer(compared(a, b), true, false, false);
    case OP_LE: return answer(compared(a, b), true, true, false);
    case OP_GT: return answer(compared(a, b), false, false, true);
    case OP_GE: return answer(compared(a, b), false, true, true);
    case OP_EQ: return answer(compared(a, b), false, true, false);
    case OP_NE: return answer(compared(a, b), true, false, true);
    case OP_NOT: return answer(compared(a, twofold_of(0)), false, true, false);
    case OP_AND: return computed(OP_MUL, computed(OP_NE, a, twofold_of(0), c), computed(OP_NE, b, twofold_of(0), c), c);
    case OP_OR:
        return computed(OP_NOT, computed(OP_AND, computed(OP_NOT, a, b, c), computed(OP_NOT, b, b, c), c), b, c);
    case OP_SELECT: return a.error > 0 ? either(b, c) : a.high != 0 ? b : c;
    case OP_POW: return power(a, b);
    case OP_SIN: return turned(a, 0);
    case OP_COS: return turned(a, 1);
    case OP_TAN: return over(turned(a, 0), turned(a, 1));
    case OP_ASIN: return angle(a, beside(a));
    case OP_ACOS: return angle(beside(a), a);
    case OP_ATAN: return angle(a, twofold_of(1));
    case OP_ATAN2: return angle(a, b);
    case OP_SINH: return hyperbolic_sine(a);
    case OP_COSH: return hyperbolic_cosine(a);
    case OP_TANH: return hyperbolic_tangent(a);
    case OP_EXP: return exponential(a);
    case OP_LOG: return logarithm(a);
    case OP_SQRT: return root(a);
    case OP_CBRT: return cube_root(a);
    case OP_HYPOT: return root(plus(square(a), square(b)));
    case OP_ABS: return a.high < 0 ? negative(a) : a;
    case OP_MIN: return larger(a, b, false);
    case OP_MAX: return larger(a, b, true);
    case OP_FLOOR: return whole(a);
    case OP_MOD: return minus(a, times(b, whole(over(a, b))));
    case OP_SIGN: return compared(a, twofold_of(0));
    default: return nothing(NAN);
    }
}

static interval around(twofold a)
{
    const double far = fabs(a.low) + a.error + (a.low != 0 || a.error > 0 ? twofold_unit(a.high) : 0);
    return (interval){a.high - far, a.high + far};
}

/* Where the formulas have no finite value, interval arithmetic gives the bounds. */
twofold twofold_value(operation op, twofold a, twofold b, twofold c)
{
    enum { ROUNDED = 2 }; /* units in the last place: no function of ours is further off */
    const twofold r = computed(op, a, b, c);
    if (isfinite(r.high) && isfinite(r.low) && isfinite(r.error)) return r;
    const interval bounds = interval_value(op, around(a), around(b), around(c), false);
    const double low = bounds.low - ROUNDED * twofold_unit(bounds.low);
    const double high = bounds.high + ROUNDED * twofold_unit(bounds.high);
    return isfinite(low) && isfinite(high) && low <= high ? (twofold){low / 2 + high / 2, 0, high / 2 - low / 2}
                                                          : nothing(r.high);
}
