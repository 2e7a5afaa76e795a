/* pow: log(x) to 2^-65 and y times it, as pairs, then exp.
 *
 * With s = (m - 1)/(m + 1) as in log, s itself a pair, 2 artanh(s) = 2 s + s^3 (2/3 + s^2 L(s^2)) within 2.3e-20 s,
 * 2/3 a pair. Invariant: |y log x| <= 745 where the result is finite, so the error of the logarithm costs at most
 * 2^-55 of the result. Special cases are those of C's annex F.
 */
INLINE pair NAME(log_pair)(reals x)
{
    binary y = NAME(binary_of)(x);
    reals f = y.m - REAL(1.0);
    pair d = NAME(sum_ordered)(REAL(1.0), y.m);
    reals r = REAL(1.0) / d.hi;
    reals s = f * r;
    reals s_lo = FUSED(-s, d.lo, FUSED(-s, d.hi, f)) * r;
    pair z = NAME(product)(s, s);
    z.lo = FUSED(s + s, s_lo, z.lo);
    reals z2 = z.hi * z.hi, z4 = z2 * z2;
    reals series = POLY7(z.hi, z2, z4, 0x1.9999999999b3p-2, 0x1.2492492457d7cp-2, 0x1.c71c722d62627p-3,
                         0x1.745ce9e5071cdp-3, 0x1.3b1eebb364de1p-3, 0x1.0f7ff256f6352p-3, 0x1.0e4255660b319p-3);
    pair c = NAME(sum_ordered)(REAL(0x1.5555555555555p-1), z.hi * series);
    c.lo += REAL(0x1.5555555555555p-55);
    pair p = NAME(product)(z.hi, c.hi);
    p.lo = FUSED(z.lo, c.hi, FUSED(z.hi, c.lo, p.lo));
    pair v = NAME(product)(s, p.hi);
    v.lo = FUSED(s_lo, p.hi, FUSED(s, p.lo, v.lo));
    pair u = NAME(sum_ordered)(s + s, v.hi);
    u.lo += s_lo + s_lo + v.lo;
    pair w = NAME(sum_ordered)(y.k * LN2_TOP, u.hi);
    return NAME(sum_ordered)(w.hi, w.lo + FUSED(y.k, LN2_REST, u.lo));
}

INLINE reals NAME(pow)(reals x, reals y)
{
    reals a = ABSOLUTE(x), b = ABSOLUTE(y);
    pair ln = NAME(log_pair)(a);
    ln.hi = SELECT(a == REAL(0.0), -INFINITE, SELECT(a < INFINITE, ln.hi, a));
    pair e = NAME(product)(y, ln.hi);
    e.lo = FUSED(y, ln.lo, e.lo);
    octave o = NAME(octave_of)(e.hi);
    o.r = NAME(sum_ordered)(o.r.hi, o.r.lo + e.lo);
    reals r = NAME(exp_bounded)(NAME(exp_octave)(o), e.hi);
    r = SELECT((y == REAL(0.0)) | (a == REAL(1.0)), REAL(1.0), r);

    /* b + 2^52 is an integer; below 2^52 it is b + 2^52 itself only if b is one. From 2^53 on all numbers are even. */
    reals h = b * REAL(0.5);
    mask whole = (b >= REAL(0x1p52)) | ((b + REAL(0x1p52)) - REAL(0x1p52) == b);
    mask odd = whole & (b < REAL(0x1p53)) & ((h + REAL(0x1p52)) - REAL(0x1p52) != h);
    mask negative = AS_BITS(x) >= SIGN_BIT;
    r = SELECT(negative & odd, -r, r);
    mask fraction = b < SELECT(whole, REAL(0.0), REAL(0x1p52));
    r = SELECT(fraction & (x < REAL(0.0)) & (a < INFINITE), NOT_A_NUMBER, r);
    r = SELECT((x != x) | (y != y), x + y, r);
    return SELECT((y == REAL(0.0)) | (x == REAL(1.0)), REAL(1.0), r);
}
