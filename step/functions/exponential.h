/* exp, and the reduction and the two series that the power and the hyperbolic functions share with it.
 *
 * x = k ln 2 + r with |r| <= ln 2/2 [CodyWaite80]; exp(r) = cosh(r) + sinh(r), whose polynomials, even and odd, are
 *
 *     cosh r = 1 + r^2/2 + r^4 C(r^2)    within 8.6e-22
 *     sinh r = r + r^3 S(r^2)            within 2.8e-19 r
 *
 * on |r| <= 0.3466, minimax among polynomials with double coefficients. Invariant: what is added to 1 + r is below
 * 0.07, so that its roundings are hundredths of the result's.
 */
#define LN2_HI REAL(0x1.62e42fefa39efp-1)
#define LN2_LO REAL(0x1.abc9e3b39803fp-56)
#define SERIES_COSH(z, z2, z4)                                                                                  \
    POLY5(z, z2, z4, 0x1.5555555555558p-5, 0x1.6c16c16c1500cp-10, 0x1.a01a01ad764ccp-16, 0x1.27e4cc298b5dcp-22, \
          0x1.1f8bafc6410a9p-29)
#define SERIES_SINH(z, z2, z4)                                                                                 \
    POLY5(z, z2, z4, 0x1.5555555555559p-3, 0x1.111111110f653p-7, 0x1.a01a01b0042acp-13, 0x1.71ddf80ebfe42p-19, \
          0x1.af5f2aef9d7e7p-26)

typedef struct NAME(octave) {
    reals shifted;
    pair r;
} NAME(octave);
#define octave NAME(octave)

/* For |x| < 2000. x - k ln 2 is exact in its first step, because the fused product has all bits and the difference is
 * below 1. */
INLINE octave NAME(octave_of)(reals x)
{
    octave o;
    o.shifted = FUSED(x, REAL(0x1.71547652b82fep+0), SHIFTER);
    reals k = o.shifted - SHIFTER;
    reals r = FUSED(-k, LN2_HI, x);
    o.r.hi = FUSED(-k, LN2_LO, r);
    o.r.lo = FUSED(-k, LN2_LO, r - o.r.hi);
    return o;
}

/* exp(r) 2^k */
INLINE reals NAME(exp_octave)(octave o)
{
    reals r = o.r.hi, z = r * r, z2 = z * z, z4 = z2 * z2;
    reals half = FUSED(r, FUSED(r, SERIES_COSH(z, z2, z4), SERIES_SINH(z, z2, z4)), REAL(0.5));
    pair one = NAME(sum_ordered)(REAL(1.0), r);
    reals small = FUSED(z, half, FUSED(o.r.lo, r, o.r.lo));
    return NAME(scale)(one.hi + (one.lo + small), o.shifted);
}

/* Beyond 710 the result overflows and below -746 it is nearer to 0 than to any other number; there `value` may be
 * anything. */
INLINE reals NAME(exp_bounded)(reals value, reals x)
{
    return SELECT(x > REAL(710.0), INFINITE, SELECT(x < REAL(-746.0), REAL(0.0), value));
}

INLINE reals NAME(exp)(reals x) { return NAME(exp_bounded)(NAME(exp_octave)(NAME(octave_of)(x)), x); }
