/* asin, acos, atan, atan2.
 *
 *     asin s = s + s^3 P(s^2)        within 9.9e-19 s on |s| <= 1/2; beyond, asin a = pi/2 - 2 asin(sqrt((1 - a)/2))
 *     atan t = t + t^3 Q(t^2)        within 1.3e-18 t on |t| <= sqrt(2) - 1; beyond, atan q = pi/4 + atan((q - 1)/(q
 *                                    + 1))
 *
 * Invariant: the roots and quotients that the reductions make are carried as pairs, and so are the multiples of pi/4
 * that come back.
 */
#define PI_HI 0x1.921fb54442d18p+1
#define PI_LO 0x1.1a62633145c07p-53

typedef struct NAME(arc) {
    reals s, s_lo, correction;
    mask steep;
} NAME(arc);
#define arc NAME(arc)

/* s + s_lo + correction is asin a, or asin(sqrt((1 - a)/2)) where a > 1/2; 0 <= a, and above 1 there is no root:
 * NaN. */
INLINE arc NAME(arc_of)(reals a)
{
    arc y;
    y.steep = a > REAL(0.5);
    reals rest = FUSED(a, REAL(-0.5), REAL(0.5));
    reals z = SELECT(y.steep, rest, a * a), z2 = z * z, z4 = z2 * z2, z8 = z4 * z4;
    reals root = SQRT(rest);
    /* A root of 0 has no error; the addend is too small to change any other root. */
    reals root_lo = FUSED(-root, root, rest) / FUSED(root, REAL(2.0), REAL(0x1p-1000));
    y.s = SELECT(y.steep, root, a);
    y.s_lo = SELECT(y.steep, root_lo, REAL(0.0));
    reals upper = POLY5(z, z2, z4, 0x1.6178650f68b4ep-7, 0x1.e27f6641a4925p-9, 0x1.64a4dd069d748p-6,
                        -0x1.596cfbf2b2fdap-6, 0x1.0bb7b2f0e90d6p-5);
    reals series =
        FUSED(z8, upper,
              POLY8(z, z2, z4, 0x1.5555555555578p-3, 0x1.333333332df3bp-4, 0x1.6db6db72289dap-5, 0x1.f1c71a8cef866p-6,
                    0x1.6e8bdfbb0af7fp-6, 0x1.1c49e16d4636ep-6, 0x1.ca20eab934aa9p-7, 0x1.757aa0d824bfdp-7));
    y.correction = FUSED(y.s * z, series, y.s_lo);
    return y;
}

INLINE reals NAME(asin)(reals x)
{
    arc y = NAME(arc_of)(ABSOLUTE(x));
    pair steep = NAME(sum_ordered)(REAL(PI_HI / 2), y.s * REAL(-2.0));
    steep.lo += FUSED(y.correction, REAL(-2.0), REAL(PI_LO / 2));
    reals value = SELECT(y.steep, steep.hi, y.s) + SELECT(y.steep, steep.lo, y.correction);
    return SIGNED(value, SIGN_OF(x));
}

/* Below 1/2 in size pi/2 - asin x; else 2 asin(root), or pi less that. */
INLINE reals NAME(acos)(reals x)
{
    arc y = NAME(arc_of)(ABSOLUTE(x));
    mask behind = x<REAL(-0.5), ahead = x> REAL(0.5);
    reals times = SELECT(ahead, REAL(2.0), SELECT(behind, REAL(-2.0), REAL(-1.0)));
    reals s = SELECT(y.steep, y.s, x) * times;
    reals from = SELECT(behind, REAL(PI_HI), SELECT(ahead, REAL(0.0), REAL(PI_HI / 2)));
    reals from_lo = SELECT(behind, REAL(PI_LO), SELECT(ahead, REAL(0.0), REAL(PI_LO / 2)));
    reals correction = SELECT(y.steep, y.correction, SIGNED(y.correction, SIGN_OF(x)));
    pair sum = NAME(sum_ordered)(from, s);
    return sum.hi + (sum.lo + FUSED(correction, times, from_lo));
}

/* atan(n/d) for 0 <= n <= d, d > 0 and far from overflow and underflow. */
INLINE pair NAME(atan_ratio)(reals n, reals d)
{
    mask shift = n > d * REAL(0x1.a827999fcef32p-2);
    pair less = NAME(sum_ordered)(-d, n), more = NAME(sum_ordered)(d, n);
    reals a = SELECT(shift, less.hi, n), a_lo = SELECT(shift, less.lo, REAL(0.0));
    reals b = SELECT(shift, more.hi, d), b_lo = SELECT(shift, more.lo, REAL(0.0));
    reals r = REAL(1.0) / b;
    reals t = a * r;
    reals t_lo = (FUSED(-t, b, a) + FUSED(-t, b_lo, a_lo)) * r;
    reals z = t * t, z2 = z * z, z4 = z2 * z2, z8 = z4 * z4;
    reals upper = POLY3(z, z2, -0x1.9cdbbdb74ec1fp-5, 0x1.37ec879e1846ap-5, -0x1.259c51662d45p-6);
    reals series =
        FUSED(z8, upper,
              POLY8(z, z2, z4, -0x1.555555555553dp-2, 0x1.99999999958b8p-3, -0x1.24924922b0348p-3, 0x1.c71c70e75c419p-4,
                    -0x1.745cf905068d2p-4, 0x1.3b111c10952c2p-4, -0x1.10ebdabd91dabp-4, 0x1.df1147b6816dp-5));
    pair sum = NAME(sum_ordered)(SELECT(shift, REAL(PI_HI / 4), REAL(0.0)), t);
    sum.lo += FUSED(t * z, series, FUSED(-z, t_lo, t_lo)) + SELECT(shift, REAL(PI_LO / 4), REAL(0.0));
    return sum;
}

INLINE reals NAME(atan)(reals x)
{
    reals a = ABSOLUTE(x);
    mask steep = a > REAL(1.0);
    /* Beyond 2^60 the angle does not change any more, and 1/a is far from underflow; a NaN stays in the numerator. */
    reals cut = SELECT(a > REAL(0x1p60), REAL(0x1p60), a);
    pair y = NAME(atan_ratio)(SELECT(steep, REAL(1.0), a), SELECT(steep, cut, REAL(1.0)));
    pair sum = NAME(sum_ordered)(SELECT(steep, REAL(PI_HI / 2), REAL(0.0)), SELECT(steep, -y.hi, y.hi));
    reals lo = SELECT(steep, REAL(PI_LO / 2) - y.lo, y.lo);
    return SIGNED(sum.hi + (sum.lo + lo), SIGN_OF(x));
}

INLINE reals NAME(atan2)(reals y, reals x)
{
    reals a = ABSOLUTE(y), b = ABSOLUTE(x);
    mask steep = a > b, behind = AS_BITS(x) >= SIGN_BIT;
    reals n = SELECT(steep, b, a), d = SELECT(steep, a, b);
    /* Infinite: the ratio is 1 or 0. Zero: it is 0. Else d is scaled to between 2^-900 and 2^900, where n is subnormal
     * only if the quotient is negligible. */
    n = SELECT(d == INFINITE, SELECT(n == INFINITE, REAL(1.0), REAL(0.0)), n);
    d = SELECT((d == INFINITE) | (d == REAL(0.0)), REAL(1.0), d);
    reals factor = SELECT(d > REAL(0x1p600), REAL(0x1p-200), REAL(0x1p200));
    pair r = NAME(atan_ratio)(n * factor, d * factor);
    bits turn = AS_BITS(SELECT(steep, REAL(-0.0), REAL(0.0))) ^ AS_BITS(SELECT(behind, REAL(-0.0), REAL(0.0)));
    reals from = SELECT(steep, REAL(PI_HI / 2), SELECT(behind, REAL(PI_HI), REAL(0.0)));
    reals from_lo = SELECT(steep, REAL(PI_LO / 2), SELECT(behind, REAL(PI_LO), REAL(0.0)));
    pair sum = NAME(sum_ordered)(from, SIGNED(r.hi, turn));
    reals value = sum.hi + (sum.lo + (from_lo + SIGNED(r.lo, turn)));
    return SELECT((x != x) | (y != y), x + y, SIGNED(value, SIGN_OF(y)));
}
