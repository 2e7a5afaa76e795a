/* erf.
 *
 *     erf x = c x + x^3 E(x^2)                within 7.6e-18 x on |x| <= 1, c = 2/sqrt(pi) as a pair
 *     erf x = 1 - exp(-W(x - 1))              within 1.1e-17 on 1 <= x <= 5.93, W approximating -log erfc with the
 *                                             weight erfc
 *
 * and from 5.93 on it is 1. Invariant: what is rounded more than once is below a third of the result.
 */
INLINE reals NAME(erf)(reals x)
{
    reals a = ABSOLUTE(x);
    mask outer = a > REAL(1.0);

    pair square = NAME(product)(a, a);
    reals z = square.hi, z2 = z * z, z4 = z2 * z2, z8 = z4 * z4;
    reals upper = POLY2(z, 0x1.d7d49a98d80f5p-27, -0x1.adbf53d27c7a3p-31);
    reals series =
        FUSED(z8, upper,
              POLY8(z, z2, z4, 0x1.ce2f21a04154bp-4, -0x1.b82ce312161c6p-6, 0x1.565bccfc499f5p-8, -0x1.c02db0aa60fap-11,
                    0x1.f9a2c4048502p-14, -0x1.f4cad3944ebd5p-17, 0x1.b984b0ff5b517p-20, -0x1.5c235915699bfp-23));
    series = FUSED(z, series, REAL(-0x1.812746b0379cep-2));
    pair c = NAME(product)(a, REAL(0x1.20dd750429b6dp+0));
    pair cube = NAME(product)(a, z);
    cube.lo = FUSED(a, square.lo, cube.lo);
    reals inner_lo = FUSED(cube.hi, series, FUSED(cube.lo, series, FUSED(a, REAL(0x1.1ae3a914fed80p-56), c.lo)));

    reals w = SELECT(a > REAL(6.0), REAL(6.0), a) - REAL(1.0), w2 = w * w, w4 = w2 * w2, w8 = w4 * w4;
    /* The constant comes last: so the sum is rounded at full weight once. */
    reals w_low =
        POLY8(w, w2, w4, 0x1.51c9b0006c222p1, 0x1.afabc11a2abe3p-1, 0x1.5477f099f3fe3p-5, -0x1.48c9d387f1932p-7,
              0x1.033f5ac0832bfp-9, -0x1.f1b070ab5be18p-13, -0x1.b92af2a7c2fa3p-16, 0x1.c84d9d5c237c3p-16);
    reals w_high =
        POLY8(w, w2, w4, -0x1.447798dcc0bb6p-17, 0x1.1df4bf86d91cap-19, -0x1.b5c23da3f031cp-23, -0x1.f680799302337p-25,
              0x1.205b6ebd9b8b2p-25, -0x1.2644ca38133bp-27, 0x1.6cb8f3c7c627bp-30, -0x1.081fe3a478e04p-33);
    w_high = FUSED(w8, REAL(0x1.58dab484d4894p-38), w_high);
    reals log_rest = FUSED(w, FUSED(w8, w_high, w_low), REAL(0x1.d97fbf27aa2a1p0));
    reals rest = NAME(exp_octave)(NAME(octave_of)(-log_rest));

    reals value = SELECT(outer, REAL(1.0), c.hi) + SELECT(outer, -rest, inner_lo);
    return SIGNED(value, SIGN_OF(x));
}
