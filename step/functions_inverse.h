/* asin, acos, atan, atan2.
 *
 *     asin s = s + s^3 P(s^2)        within 9.9e-19 s on |s| <= 1/2; beyond, asin a = pi/2 - 2 asin(sqrt((1 - a)/2))
 *     atan t = t + t^3 Q(t^2)        within 1.3e-18 t on |t| <= sqrt(2) - 1; beyond, atan q = pi/4 + atan((q - 1)/(q + 1))
 *
 * Invariant: the roots and quotients that the reductions make are carried as pairs, and so are the multiples of pi/4 that come back.
 */
#define PI_HI 0x1.921fb54442d18p+1
#define PI_LO 0x1.1a62633145c07p-53

typedef struct NAME(arc) { real s, s_lo, correction; mask steep; } NAME(arc);
#define arc NAME(arc)

/* s + s_lo + correction is asin a, or asin(sqrt((1 - a)/2)) where a > 1/2; 0 <= a, and above 1 there is no root: NaN. */
INLINE arc NAME(arc_of)(real a)
{
    arc y;
    y.steep = a > REAL(0.5);
    real rest = FMA(a, REAL(-0.5), REAL(0.5));
    real z = SELECT(y.steep, rest, a * a), z2 = z * z, z4 = z2 * z2, z8 = z4 * z4;
    real root = SQRT(rest);
    /* A root of 0 has no error; the addend is too small to be seen beside any other. */
    real root_lo = FMA(-root, root, rest) / FMA(root, REAL(2.0), REAL(0x1p-1000));
    y.s = SELECT(y.steep, root, a);
    y.s_lo = SELECT(y.steep, root_lo, REAL(0.0));
    real upper = POLY5(z, z2, z4, 0x1.6178650f68b4ep-7, 0x1.e27f6641a4925p-9, 0x1.64a4dd069d748p-6, -0x1.596cfbf2b2fdap-6,
                       0x1.0bb7b2f0e90d6p-5);
    real series = FMA(z8, upper, POLY8(z, z2, z4, 0x1.5555555555578p-3, 0x1.333333332df3bp-4, 0x1.6db6db72289dap-5,
                      0x1.f1c71a8cef866p-6, 0x1.6e8bdfbb0af7fp-6, 0x1.1c49e16d4636ep-6, 0x1.ca20eab934aa9p-7, 0x1.757aa0d824bfdp-7));
    y.correction = FMA(y.s * z, series, y.s_lo);
    return y;
}

INLINE real NAME(asin)(real x)
{
    arc y = NAME(arc_of)(ABSOLUTE(x));
    pair steep = NAME(sum_ordered)(REAL(PI_HI / 2), y.s * REAL(-2.0));
    steep.lo += FMA(y.correction, REAL(-2.0), REAL(PI_LO / 2));
    real value = SELECT(y.steep, steep.hi, y.s) + SELECT(y.steep, steep.lo, y.correction);
    return SIGNED(value, SIGN_OF(x));
}

/* Below 1/2 in size pi/2 - asin x; else 2 asin(root), or pi less that. */
INLINE real NAME(acos)(real x)
{
    arc y = NAME(arc_of)(ABSOLUTE(x));
    mask behind = x < REAL(-0.5), ahead = x > REAL(0.5);
    real times = SELECT(ahead, REAL(2.0), SELECT(behind, REAL(-2.0), REAL(-1.0)));
    real s = SELECT(y.steep, y.s, x) * times;
    real from = SELECT(behind, REAL(PI_HI), SELECT(ahead, REAL(0.0), REAL(PI_HI / 2)));
    real from_lo = SELECT(behind, REAL(PI_LO), SELECT(ahead, REAL(0.0), REAL(PI_LO / 2)));
    real correction = SELECT(y.steep, y.correction, SIGNED(y.correction, SIGN_OF(x)));
    pair sum = NAME(sum_ordered)(from, s);
    return sum.hi + (sum.lo + FMA(correction, times, from_lo));
}

/* atan(n/d) for 0 <= n <= d, d > 0 and far from overflow and underflow. */
INLINE pair NAME(atan_ratio)(real n, real d)
{
    mask shift = n > d * REAL(0x1.a827999fcef32p-2);
    pair less = NAME(sum_ordered)(-d, n), more = NAME(sum_ordered)(d, n);
    real a = SELECT(shift, less.hi, n), a_lo = SELECT(shift, less.lo, REAL(0.0));
    real b = SELECT(shift, more.hi, d), b_lo = SELECT(shift, more.lo, REAL(0.0));
    real r = REAL(1.0) / b;
    real t = a * r;
    real t_lo = (FMA(-t, b, a) + FMA(-t, b_lo, a_lo)) * r;
    real z = t * t, z2 = z * z, z4 = z2 * z2, z8 = z4 * z4;
    real upper = POLY3(z, z2, -0x1.9cdbbdb74ec1fp-5, 0x1.37ec879e1846ap-5, -0x1.259c51662d45p-6);
    real series = FMA(z8, upper, POLY8(z, z2, z4, -0x1.555555555553dp-2, 0x1.99999999958b8p-3, -0x1.24924922b0348p-3,
                      0x1.c71c70e75c419p-4, -0x1.745cf905068d2p-4, 0x1.3b111c10952c2p-4, -0x1.10ebdabd91dabp-4, 0x1.df1147b6816dp-5));
    pair sum = NAME(sum_ordered)(SELECT(shift, REAL(PI_HI / 4), REAL(0.0)), t);
    sum.lo += FMA(t * z, series, FMA(-z, t_lo, t_lo)) + SELECT(shift, REAL(PI_LO / 4), REAL(0.0));
    return sum;
}

INLINE real NAME(atan)(real x)
{
    real a = ABSOLUTE(x);
    mask steep = a > REAL(1.0);
    /* Beyond 2^60 the angle does not change any more, and 1/a is far from underflow; a NaN stays in the numerator. */
    real cut = SELECT(a > REAL(0x1p60), REAL(0x1p60), a);
    pair y = NAME(atan_ratio)(SELECT(steep, REAL(1.0), a), SELECT(steep, cut, REAL(1.0)));
    pair sum = NAME(sum_ordered)(SELECT(steep, REAL(PI_HI / 2), REAL(0.0)), SELECT(steep, -y.hi, y.hi));
    real lo = SELECT(steep, REAL(PI_LO / 2) - y.lo, y.lo);
    return SIGNED(sum.hi + (sum.lo + lo), SIGN_OF(x));
}

INLINE real NAME(atan2)(real y, real x)
{
    real a = ABSOLUTE(y), b = ABSOLUTE(x);
    mask steep = a > b, behind = AS_BITS(x) >= SIGN_BIT;
    real n = SELECT(steep, b, a), d = SELECT(steep, a, b);
    /* Infinite: the ratio is 1 or 0. Zero: it is 0. Else d is brought between 2^-900 and 2^900. */
    n = SELECT(d == INFINITE, SELECT(n == INFINITE, REAL(1.0), REAL(0.0)), n);
    d = SELECT((d == INFINITE) | (d == REAL(0.0)), REAL(1.0), d);
    real factor = SELECT(d > REAL(0x1p900), REAL(0x1p-200), SELECT(d < REAL(0x1p-800), REAL(0x1p200), REAL(1.0)));
    pair r = NAME(atan_ratio)(n * factor, d * factor);
    bits turn = AS_BITS(SELECT(steep, REAL(-0.0), REAL(0.0))) ^ AS_BITS(SELECT(behind, REAL(-0.0), REAL(0.0)));
    real from = SELECT(steep, REAL(PI_HI / 2), SELECT(behind, REAL(PI_HI), REAL(0.0)));
    real from_lo = SELECT(steep, REAL(PI_LO / 2), SELECT(behind, REAL(PI_LO), REAL(0.0)));
    pair sum = NAME(sum_ordered)(from, SIGNED(r.hi, turn));
    real value = sum.hi + (sum.lo + (from_lo + SIGNED(r.lo, turn)));
    return SELECT((x != x) | (y != y), x + y, SIGNED(value, SIGN_OF(y)));
}
