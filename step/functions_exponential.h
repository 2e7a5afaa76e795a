/* exp, and the reduction and the two series that the power and the hyperbolic functions share with it.
 *
 * x = k ln 2 + r with |r| <= ln 2/2 [CodyWaite80]; exp(r) = cosh(r) + sinh(r), whose polynomials, even and odd, are
 *
 *     cosh r = 1 + r^2/2 + r^4 C(r^2)    within 8.6e-22
 *     sinh r = r + r^3 S(r^2)            within 2.8e-19 r
 *
 * on |r| <= 0.3466, minimax among polynomials with double coefficients. Invariant: what is added to 1 + r is below 0.07, so that its
 * roundings are hundredths of the result's.
 */
#define LN2_HI REAL(0x1.62e42fefa39efp-1)
#define LN2_LO REAL(0x1.abc9e3b39803fp-56)
#define SERIES_COSH(z, z2, z4) \
    POLY5(z, z2, z4, 0x1.5555555555558p-5, 0x1.6c16c16c1500cp-10, 0x1.a01a01ad764ccp-16, 0x1.27e4cc298b5dcp-22, 0x1.1f8bafc6410a9p-29)
#define SERIES_SINH(z, z2, z4) \
    POLY5(z, z2, z4, 0x1.5555555555559p-3, 0x1.111111110f653p-7, 0x1.a01a01b0042acp-13, 0x1.71ddf80ebfe42p-19, 0x1.af5f2aef9d7e7p-26)

typedef struct NAME(octave) { real shifted; pair r; } NAME(octave);
#define octave NAME(octave)

/* |x| < 2000. x - k ln 2 is exact in its first step, because the fused product has all bits and the difference is below 1. */
INLINE octave NAME(octave_of)(real x)
{
    octave o;
    o.shifted = FMA(x, REAL(0x1.71547652b82fep+0), SHIFTER);
    real k = o.shifted - SHIFTER;
    real r = FMA(-k, LN2_HI, x);
    o.r.hi = FMA(-k, LN2_LO, r);
    o.r.lo = FMA(-k, LN2_LO, r - o.r.hi);
    return o;
}

/* exp(r) 2^k */
INLINE real NAME(exp_octave)(octave o)
{
    real r = o.r.hi, z = r * r, z2 = z * z, z4 = z2 * z2;
    real half = FMA(z, SERIES_COSH(z, z2, z4), FMA(r, SERIES_SINH(z, z2, z4), REAL(0.5)));
    pair one = NAME(sum_ordered)(REAL(1.0), r);
    real small = FMA(z, half, FMA(o.r.lo, r, o.r.lo));
    return NAME(scale)(one.hi + (one.lo + small), o.shifted);
}

/* exp(710) overflows and exp(-746) is nearer to 0 than to any other number, by the operations below, not by decree. */
#define EXP_RANGE(x) SELECT((x) > REAL(710.0), REAL(710.0), SELECT((x) < REAL(-746.0), REAL(-746.0), x))

INLINE real NAME(exp)(real x)
{
    return NAME(exp_octave)(NAME(octave_of)(EXP_RANGE(x)));
}
