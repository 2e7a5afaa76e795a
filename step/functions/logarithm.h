/* log, and the reduction that the power shares with it.
 *
 * x = 2^k m with sqrt(1/2) <= m < sqrt(2), f = m - 1, s = f/(2 + f); then
 *
 *     log(1 + f) = 2 artanh(s) = f - f^2/2 + s (f^2/2 + s^2 L(s^2)),    2 artanh(s) = 2 s + s^3 L(s^2) within 2.5e-18 s
 *
 * on |s| <= 0.1716. Invariant: f and f^2/2 are carried exactly, so that what is rounded more than once is below 0.06
 * of the result.
 */
#define LN2_TOP REAL(0x1.62e42fefa3800p-1) /* 42 bits: k times it is exact */
#define LN2_REST REAL(0x1.ef35793c76730p-45)

typedef struct NAME(binary) {
    reals k, m;
} NAME(binary);
#define binary NAME(binary)

/* x > 0 and finite; anything else gives some finite m. The exponent is read after moving sqrt(1/2) to a power of
 * two. */
INLINE binary NAME(binary_of)(reals x)
{
    binary y;
    mask tiny = x < REAL(0x1p-1022);
    bits b = AS_BITS(SELECT(tiny, x * REAL(0x1p54), x)) + BITS(0x3ff0000000000000 - 0x3fe6a09e667f3bcd);
    y.k = AS_REAL((b >> 52) | BITS(0x4330000000000000)) - SELECT(tiny, REAL(0x1p52 + 1023 + 54), REAL(0x1p52 + 1023));
    y.m = AS_REAL((b & BITS(0x000fffffffffffff)) + BITS(0x3fe6a09e667f3bcd));
    return y;
}

INLINE reals NAME(log)(reals x)
{
    binary y = NAME(binary_of)(x);
    reals f = y.m - REAL(1.0), s = f / (REAL(2.0) + f);
    reals z = s * s, z2 = z * z, z4 = z2 * z2;
    reals series = POLY7(z, z2, z4, 0x1.5555555555592p-1, 0x1.999999997ff27p-2, 0x1.24924941e048ep-2,
                         0x1.c71c521541e61p-3, 0x1.74663cba5511dp-3, 0x1.39a1edf78e4b1p-3, 0x1.2f0386506aeb4p-3);
    reals h = REAL(0.5) * f;
    pair square = NAME(product)(h, f);
    pair u = NAME(sum_ordered)(f, -square.hi);
    pair w = NAME(sum_ordered)(y.k * LN2_TOP, u.hi);
    reals small = FUSED(y.k, LN2_REST, s * FUSED(z, series, square.hi)) + (u.lo - square.lo);
    reals r = w.hi + (w.lo + small);
    r = SELECT(x < INFINITE, r, x); /* and NaN */
    r = SELECT(x > REAL(0.0), r, SELECT(x == REAL(0.0), -INFINITE, x + NOT_A_NUMBER));
    return r;
}
