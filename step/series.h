/* TAYLOR SERIES, the recurrences: coefficient n of an operation's result, from the operands' coefficients 0 … n and the
 * result's own 0 … n-1. lang/base/operations.def says which operation has which.
 *
 * Before this text stands step/reciprocals.h, and the includer defines real, coef, FMA, PICK and SOME (work.h), and
 * SERIES_OF(f), a function of step/functions/ over reals.
 *
 * Memory: r holds the result's `length` numbers: its coefficients 0 … length-2 and, last, the number that the
 * recurrence keeps, the reciprocal of a coefficient 0. The helper series that some recurrences need follow, `length`
 * numbers each. Recurrences that keep something compute coefficient 0 too; of the others it is the operation's value.
 *
 * `in`: the inner sums of the recurrence, in the order of operations.def, where they have been taken before; or NULL.
 *
 * Invariant: the order of the terms is part of a recurrence, so its bits are the same on every machine. A sum of
 * products f[j] g[n - j] is taken by ascending max(j, n - j): the inner terms in two chains, which are then added, and
 * the outer ones, where the newest coefficients are, last: the inner sums of the next order need not wait for them.
 * The coefficients of a quotient by a coefficient 0 that is 0 are taken as 0, which is their limit where the operand is
 * 0 throughout.
 */
#ifndef SERIES_FUNCTION
#define SERIES_FUNCTION static inline
#endif
#ifndef SERIES_SELDOM /* what is called once a step, or not at all where inner sums are given */
#define SERIES_SELDOM SERIES_FUNCTION
#endif

/* An operand: its coefficients, and the number of the last one that may differ from 0: 0 of a constant, 1 of time.
 * Those after it are not stored. */
enum { SERIES_ALL = 1 << 20 };
typedef struct series {
    const real *at;
    int last;
} series;
#define SERIES(at, last) ((series){at, last})

#define SERIES_NUMBER(c) ((real){0} + (c))
#define SERIES_WHERE(x, value) PICK((x) != 0, value, SERIES_NUMBER(0.0))
#define SERIES_ITSELF SERIES(r, SERIES_ALL)
#define SERIES_HELPER(k) (r + (k) * (size_t)length) /* 1, 2 … */
#define SERIES_FROM(helper) SERIES(helper, SERIES_ALL)
#define SERIES_KEPT r[length - 1]
#define SERIES_NONE ((const real *)0)
#define SERIES_GIVEN(k) (in ? in + (k) : SERIES_NONE)

SERIES_FUNCTION real series_at(const series a, const int n) { return n <= a.last ? a.at[n] : SERIES_NUMBER(0.0); }

/* Sums of products --------------------------------------------------------------------------------------------------*/

/* The sum over j = low … n - high of f[j] g[n - j], where one of the two ends before n. */
SERIES_FUNCTION real series_few(const series f, const series g, const int n, const int low, const int high)
{
    const int from = n - g.last > low ? n - g.last : low, to = f.last < n - high ? f.last : n - high;
    real s = SERIES_NUMBER(0.0);
    if (f.last < n)
        for (int j = to; j >= from; j--) s = FMA(f.at[j], g.at[n - j], s);
    else
        for (int j = from; j <= to; j++) s = FMA(f.at[j], g.at[n - j], s);
    return s;
}

/* The inner sum: its terms j = 2 … n - 2, none where f or g ends before n. Each chain begins with half the middle
 * term, so those of a square are the same. */
SERIES_SELDOM real series_inner(const series f, const series g, const int n)
{
    const int half = n / 2;
    real p = SERIES_NUMBER(0.0), q;
    if (n < 4 || f.last < n || g.last < n) return p;
    if (n % 2 == 0) p = 0.5 * f.at[half] * g.at[half];
    q = p;
    if (f.at == g.at) {
        for (int m = (n - 1) / 2; m >= 2; m--) p = FMA(f.at[m], f.at[n - m], p);
        return p + p;
    }
    for (int m = (n - 1) / 2; m >= 2; m--) {
        p = FMA(f.at[m], g.at[n - m], p);
        q = FMA(f.at[n - m], g.at[m], q);
    }
    return p + q;
}

/* The sum over j = low … n - high of f[j] g[n - j]; low is 0 or 1, high 0, 1 or 2, n at least 1. inner: what
 * series_inner would be, or NULL. */
SERIES_FUNCTION real series_sum(const series f, const series g, const int n, const int low, const int high,
                                const real *inner)
{
    if (f.last < n || g.last < n) return series_few(f, g, n, low, high);
    real s = inner ? *inner : series_inner(f, g, n);
    if (n > 2) s = FMA(f.at[1], g.at[n - 1], s);
    if (n > 1 && high < 2) s = FMA(f.at[n - 1], g.at[1], s);
    if (!high) s = FMA(f.at[n], g.at[0], s);
    return low ? s : FMA(f.at[0], g.at[n], s);
}

/* The sum over j = low … n - low of f[j] f[n - j]; low is 0 or 1. */
SERIES_FUNCTION real series_square(const series f, const int n, const int low, const real *inner)
{
    if (f.last < n) return series_few(f, f, n, low, low);
    real s = inner ? *inner : series_inner(f, f, n);
    if (n > 1) s = FMA(n > 2 ? 2.0 * f.at[1] : f.at[1], f.at[n - 1], s);
    return low ? s : FMA(2.0 * f.at[0], f.at[n], s);
}

/* k times coefficient k of a, where it is stored. */
SERIES_FUNCTION series series_rates(real *rate, const series a, const int n)
{
    if (n <= a.last) rate[n] = (double)n * a.at[n];
    return SERIES(rate, a.last);
}

/* The coefficient of the integral of f a', which is n times too large; f known below n. */
SERIES_FUNCTION real series_along(const series f, const series rates, const int n, const real *inner)
{
    return series_sum(f, rates, n, 0, 1, inner) * RECIPROCAL(n);
}

/* Arithmetic --------------------------------------------------------------------------------------------------------*/

SERIES_FUNCTION real series_product(const series a, const series b, const int n, const real *in)
{
    if (a.last == 0) return a.at[0] * series_at(b, n);
    if (b.last == 0) return series_at(a, n) * b.at[0];
    return a.at == b.at ? series_square(a, n, 0, in) : series_sum(a, b, n, 0, 0, in);
}

SERIES_FUNCTION real series_quotient(real *r, const int length, const series a, const series b, const int n,
                                     const real *in)
{
    if (n == 0) {
        SERIES_KEPT = 1.0 / b.at[0];
        return a.at[0] / b.at[0];
    }
    const real top = series_at(a, n);
    return (b.last == 0 ? top : top - series_sum(SERIES_ITSELF, b, n, 0, 1, in)) * SERIES_KEPT;
}

/* Powers and roots --------------------------------------------------------------------------------------------------*/

/* Coefficient n of the root r of a series whose coefficient n is top. */
SERIES_FUNCTION real series_root(const real *r, const int length, const real top, const int n, const real *inner)
{
    return (top - series_square(SERIES_ITSELF, n, 1, inner)) * SERIES_KEPT;
}

SERIES_FUNCTION real series_sqrt(real *r, const int length, const series a, const int n, const real *in)
{
    if (n > 0) return series_root(r, length, series_at(a, n), n, in);
    const real root = SERIES_OF(sqrt)(a.at[0]);
    SERIES_KEPT = SERIES_WHERE(root, 0.5 / root);
    return root;
}

SERIES_FUNCTION real series_hypot(real *r, const int length, const series a, const series b, const int n,
                                  const real *in)
{
    if (n > 0)
        return series_root(r, length,
                           series_product(a, a, n, SERIES_GIVEN(0)) + series_product(b, b, n, SERIES_GIVEN(1)), n,
                           SERIES_GIVEN(2));
    const real root = SERIES_OF(hypot)(a.at[0], b.at[0]);
    SERIES_KEPT = SERIES_WHERE(root, 0.5 / root);
    return root;
}

/* r = a^c for a constant c: n a_0 r_n is the sum over j < n of (c (n - j) - j) a_{n-j} r_j, which is c n times the sum
 * of a_{n-j} r_j less c + 1 times that of a_{n-j} j r_j. r_0 = `start`. The terms of r_{n-1} and a_n come last, with
 * factors that are known before. */
SERIES_FUNCTION real series_power(real *r, const int length, const series a, const real c, const real start,
                                  const int n, const real *in)
{
    real *const dr = SERIES_HELPER(1);
    if (n == 0) {
        SERIES_KEPT = SERIES_WHERE(a.at[0], 1.0 / a.at[0]);
        return start;
    }
    const real part = SERIES_KEPT * RECIPROCAL(n);
    real next = SERIES_NUMBER(0.0), plain, rates;
    if (n > 1) {
        plain = series_sum(SERIES_ITSELF, a, n, 1, 2, SERIES_GIVEN(0));
        rates = series_sum(SERIES_FROM(dr), a, n, 1, 2, SERIES_GIVEN(1));
        next = FMA((double)n * c, plain, -((c + 1.0) * rates)) * part;
        next = FMA(r[n - 1], (c - (double)(n - 1)) * (series_at(a, 1) * part), next);
    }
    if (n <= a.last) next = FMA(a.at[n], c * (r[0] * SERIES_KEPT), next);
    dr[n] = (double)n * next;
    return next;
}

/* a^c. The power of an inverse cube, which is in every force of attraction, is three quick operations. */
SERIES_FUNCTION real series_pow(real *r, const int length, const series a, const series c, const int n, const real *in)
{
    real start = SERIES_NUMBER(0.0);
    if (n == 0) {
        const real inverse_cube = 1.0 / (a.at[0] * SERIES_OF(sqrt)(a.at[0]));
        start = inverse_cube;
        if (SOME(c.at[0] != -1.5)) start = PICK(c.at[0] == -1.5, inverse_cube, SERIES_OF(pow)(a.at[0], c.at[0]));
    }
    return series_power(r, length, a, c.at[0], start, n, in);
}

SERIES_FUNCTION real series_cbrt(real *r, const int length, const series a, const int n, const real *in)
{
    const real start = n == 0 ? SERIES_OF(cbrt)(a.at[0]) : SERIES_NUMBER(0.0);
    return series_power(r, length, a, SERIES_NUMBER(RECIPROCAL(3)), start, n, in);
}

/* Exponentials and angles -------------------------------------------------------------------------------------------*/

SERIES_FUNCTION real series_exp(real *r, const int length, const series a, const int n, const real *in)
{
    if (n == 0) return SERIES_OF(exp)(a.at[0]);
    return series_along(SERIES_ITSELF, series_rates(SERIES_HELPER(1), a, n), n, in);
}

/* a r' = a' */
SERIES_FUNCTION real series_log(real *r, const int length, const series a, const int n, const real *in)
{
    real *const dr = SERIES_HELPER(1);
    if (n == 0) {
        SERIES_KEPT = 1.0 / a.at[0];
        return SERIES_OF(log)(a.at[0]);
    }
    const real known = series_sum(SERIES_FROM(dr), a, n, 1, 1, in) * RECIPROCAL(n);
    const real next = (series_at(a, n) - known) * SERIES_KEPT;
    dr[n] = (double)n * next;
    return next;
}

/* A function of coefficient 0, and to `other` the one whose series is a helper. */
#define SERIES_BOTH(f, g)                                          \
    SERIES_SELDOM real series_##f##_##g(real *other, const real a) \
    {                                                              \
        *other = SERIES_OF(g)(a);                                  \
        return SERIES_OF(f)(a);                                    \
    }
SERIES_BOTH(sin, cos)
SERIES_BOTH(cos, sin)
SERIES_BOTH(sinh, cosh)
SERIES_BOTH(cosh, sinh)

/* sin a, with cos a as the first helper; and the other way round. */
SERIES_FUNCTION real series_sin(real *r, const int length, const series a, const int n, const real *in)
{
    real *const cosine = SERIES_HELPER(1);
    if (n == 0) return series_sin_cos(cosine, a.at[0]);
    const series rates = series_rates(SERIES_HELPER(2), a, n);
    const real next = series_along(SERIES_FROM(cosine), rates, n, SERIES_GIVEN(0));
    cosine[n] = -series_along(SERIES_ITSELF, rates, n, SERIES_GIVEN(1));
    return next;
}

SERIES_FUNCTION real series_cos(real *r, const int length, const series a, const int n, const real *in)
{
    real *const sine = SERIES_HELPER(1);
    if (n == 0) return series_cos_sin(sine, a.at[0]);
    const series rates = series_rates(SERIES_HELPER(2), a, n);
    const real next = -series_along(SERIES_FROM(sine), rates, n, SERIES_GIVEN(0));
    sine[n] = series_along(SERIES_ITSELF, rates, n, SERIES_GIVEN(1));
    return next;
}

SERIES_FUNCTION real series_sinh(real *r, const int length, const series a, const int n, const real *in)
{
    real *const other = SERIES_HELPER(1);
    if (n == 0) return series_sinh_cosh(other, a.at[0]);
    const series rates = series_rates(SERIES_HELPER(2), a, n);
    const real next = series_along(SERIES_FROM(other), rates, n, SERIES_GIVEN(0));
    other[n] = series_along(SERIES_ITSELF, rates, n, SERIES_GIVEN(1));
    return next;
}

SERIES_FUNCTION real series_cosh(real *r, const int length, const series a, const int n, const real *in)
{
    real *const other = SERIES_HELPER(1);
    if (n == 0) return series_cosh_sinh(other, a.at[0]);
    const series rates = series_rates(SERIES_HELPER(2), a, n);
    const real next = series_along(SERIES_FROM(other), rates, n, SERIES_GIVEN(0));
    other[n] = series_along(SERIES_ITSELF, rates, n, SERIES_GIVEN(1));
    return next;
}

/* r' = w a' with w = 1 + r^2, of the hyperbolic tangent 1 - r^2: sign is 1 or -1. r_0 = `start`. */
SERIES_FUNCTION real series_slope(real *r, const int length, const series a, const double sign, const real start,
                                  const int n, const real *in)
{
    real *const w = SERIES_HELPER(1);
    if (n == 0) {
        w[0] = FMA(sign * start, start, SERIES_NUMBER(1.0));
        return start;
    }
    r[n] = series_along(SERIES_FROM(w), series_rates(SERIES_HELPER(2), a, n), n, SERIES_GIVEN(0));
    w[n] = sign * series_square(SERIES_ITSELF, n, 0, SERIES_GIVEN(1));
    return r[n];
}

SERIES_FUNCTION real series_tan(real *r, const int length, const series a, const int n, const real *in)
{
    return series_slope(r, length, a, 1.0, n == 0 ? SERIES_OF(tan)(a.at[0]) : SERIES_NUMBER(0.0), n, in);
}

SERIES_FUNCTION real series_tanh(real *r, const int length, const series a, const int n, const real *in)
{
    return series_slope(r, length, a, -1.0, n == 0 ? SERIES_OF(tanh)(a.at[0]) : SERIES_NUMBER(0.0), n, in);
}

/* w r' = top', w the first helper. */
SERIES_FUNCTION real series_inverse(real *r, const int length, const real top, const int n, const real *inner)
{
    const real *const w = SERIES_HELPER(1);
    real *const dr = SERIES_HELPER(2);
    const real known = series_sum(SERIES_FROM(dr), SERIES_FROM(w), n, 1, 1, inner) * RECIPROCAL(n);
    const real next = (top - known) * SERIES_KEPT;
    dr[n] = (double)n * next;
    return next;
}

/* w = sqrt(1 - a^2); sign 1 of asin, -1 of acos. */
SERIES_FUNCTION real series_arc(real *r, const int length, const series a, const double sign, const real start,
                                const int n, const real *in)
{
    real *const w = SERIES_HELPER(1);
    if (n == 0) {
        w[0] = SERIES_OF(sqrt)((1.0 - a.at[0]) * (1.0 + a.at[0]));
        SERIES_KEPT = SERIES_WHERE(w[0], 1.0 / w[0]);
        return start;
    }
    w[n] = (-series_product(a, a, n, SERIES_GIVEN(0)) - series_square(SERIES_FROM(w), n, 1, SERIES_GIVEN(1))) *
           (0.5 * SERIES_KEPT);
    return series_inverse(r, length, sign * series_at(a, n), n, SERIES_GIVEN(2));
}

SERIES_FUNCTION real series_asin(real *r, const int length, const series a, const int n, const real *in)
{
    return series_arc(r, length, a, 1.0, n == 0 ? SERIES_OF(asin)(a.at[0]) : SERIES_NUMBER(0.0), n, in);
}

SERIES_FUNCTION real series_acos(real *r, const int length, const series a, const int n, const real *in)
{
    return series_arc(r, length, a, -1.0, n == 0 ? SERIES_OF(acos)(a.at[0]) : SERIES_NUMBER(0.0), n, in);
}

SERIES_FUNCTION real series_atan(real *r, const int length, const series a, const int n, const real *in)
{
    real *const w = SERIES_HELPER(1);
    if (n == 0) {
        w[0] = FMA(a.at[0], a.at[0], SERIES_NUMBER(1.0));
        SERIES_KEPT = 1.0 / w[0];
        return SERIES_OF(atan)(a.at[0]);
    }
    w[n] = series_product(a, a, n, SERIES_GIVEN(0));
    return series_inverse(r, length, series_at(a, n), n, SERIES_GIVEN(1));
}

/* (a^2 + b^2) r' = a' b - b' a */
SERIES_FUNCTION real series_atan2(real *r, const int length, const series a, const series b, const int n,
                                  const real *in)
{
    real *const w = SERIES_HELPER(1);
    if (n == 0) {
        w[0] = FMA(a.at[0], a.at[0], b.at[0] * b.at[0]);
        SERIES_KEPT = SERIES_WHERE(w[0], 1.0 / w[0]);
        return SERIES_OF(atan2)(a.at[0], b.at[0]);
    }
    const series da = series_rates(SERIES_HELPER(3), a, n), db = series_rates(SERIES_HELPER(4), b, n);
    w[n] = series_product(a, a, n, SERIES_GIVEN(0)) + series_product(b, b, n, SERIES_GIVEN(1));
    const real turned =
        (series_sum(da, b, n, 1, 0, SERIES_GIVEN(2)) - series_sum(db, a, n, 1, 0, SERIES_GIVEN(3))) * RECIPROCAL(n);
    return series_inverse(r, length, turned, n, SERIES_GIVEN(4));
}

/* r' = (2/sqrt pi) e a' with e = exp(-a^2) */
SERIES_FUNCTION real series_erf(real *r, const int length, const series a, const int n, const real *in)
{
    real *const e = SERIES_HELPER(1), *const rates = SERIES_HELPER(2);
    if (n == 0) {
        e[0] = SERIES_OF(exp)(-(a.at[0] * a.at[0]));
        return SERIES_OF(erf)(a.at[0]);
    }
    const int last = a.last < SERIES_ALL ? 2 * a.last : SERIES_ALL;
    if (n <= last) rates[n] = -(double)n * series_product(a, a, n, SERIES_GIVEN(0));
    const real next =
        1.1283791670955126 * series_along(SERIES_FROM(e), series_rates(SERIES_HELPER(3), a, n), n, SERIES_GIVEN(1));
    e[n] = series_along(SERIES_FROM(e), SERIES(rates, last), n, SERIES_GIVEN(2));
    return next;
}

/* Choices: coefficient 0 decides ------------------------------------------------------------------------------------*/

SERIES_FUNCTION real series_abs(const series a, const int n)
{
    const real next = series_at(a, n);
    return PICK(a.at[0] > 0, next, PICK(a.at[0] < 0, -next, SERIES_NUMBER(0.0)));
}

SERIES_FUNCTION real series_min(const series a, const series b, const int n)
{
    return PICK(a.at[0] <= b.at[0], series_at(a, n), series_at(b, n));
}

SERIES_FUNCTION real series_max(const series a, const series b, const int n)
{
    return PICK(a.at[0] >= b.at[0], series_at(a, n), series_at(b, n));
}

SERIES_FUNCTION real series_mod(const series a, const series b, const int n)
{
    return FMA(-SERIES_OF(floor)(a.at[0] / b.at[0]), series_at(b, n), series_at(a, n));
}

SERIES_FUNCTION real series_if(const series condition, const series a, const series b, const int n)
{
    return PICK(condition.at[0] != 0, series_at(a, n), series_at(b, n));
}
