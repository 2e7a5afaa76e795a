/* sinh, cosh, tanh: no case for small and none for large arguments.
 *
 * With |x| = k ln 2 + r and u = 2^(-2k), by the addition theorems,
 *
 *     sinh |x| = 2^(k-1) (cosh r (1 - u) + sinh r (1 + u)),    cosh x = 2^(k-1) (cosh r (1 + u) + sinh r (1 - u)),
 *
 * where k = 0 leaves sinh r and cosh r themselves. Invariant: each of the four factors is a pair, so the only
 * rounding of full weight is the last sum. The series are those of exp.
 */
typedef struct NAME(hyperbola) {
    pair even, odd, plus, minus;
    reals shifted;
} NAME(hyperbola);
#define hyperbola NAME(hyperbola)

/* 0 <= x < 2000 */
INLINE hyperbola NAME(hyperbola_of)(reals x)
{
    hyperbola y;
    octave o = NAME(octave_of)(x);
    reals r = o.r.hi;
    pair z = NAME(product)(r, r);
    reals z2 = z.hi * z.hi, z4 = z2 * z2;
    y.even = NAME(sum_ordered)(REAL(1.0), REAL(0.5) * z.hi);
    y.odd.hi = r;
    y.odd.lo = FUSED(r * z.hi, SERIES_SINH(z.hi, z2, z4), o.r.lo * y.even.hi);
    y.even.lo += FUSED(z2, SERIES_COSH(z.hi, z2, z4), FUSED(r, o.r.lo, REAL(0.5) * z.lo));
    /* From k = 32 on u is below the rounding. */
    bits twice = (AS_BITS(o.shifted) & BITS(0xffff)) << 1;
    reals u = SELECT(x > REAL(22.0), REAL(0.0), AS_REAL((BITS(1023) - twice) << 52));
    y.plus = NAME(sum_ordered)(REAL(1.0), u);
    y.minus = NAME(sum_ordered)(REAL(1.0), -u);
    y.shifted = o.shifted;
    return y;
}

/* cosh r times p plus sinh r times q; the first is 0 or the larger. */
INLINE pair NAME(hyperbola_mix)(hyperbola y, pair p, pair q)
{
    pair a = NAME(product)(y.even.hi, p.hi), b = NAME(product)(y.odd.hi, q.hi);
    pair s = NAME(sum_ordered)(a.hi, b.hi);
    reals tails = FUSED(y.even.hi, p.lo, y.odd.hi * q.lo) + FUSED(y.even.lo, p.hi, y.odd.lo * q.hi);
    s.lo += (a.lo + b.lo) + tails;
    return s;
}

#define SINH_RANGE(a) SELECT((a) > REAL(712.0), REAL(712.0), a)

INLINE reals NAME(sinh)(reals x)
{
    reals a = ABSOLUTE(x);
    hyperbola y = NAME(hyperbola_of)(SINH_RANGE(a));
    pair s = NAME(hyperbola_mix)(y, y.minus, y.plus);
    return SIGNED(NAME(scale)((s.hi + s.lo) * REAL(0.5), y.shifted), SIGN_OF(x));
}

INLINE reals NAME(cosh)(reals x)
{
    reals a = ABSOLUTE(x);
    hyperbola y = NAME(hyperbola_of)(SINH_RANGE(a));
    pair s = NAME(hyperbola_mix)(y, y.plus, y.minus);
    return NAME(scale)((s.hi + s.lo) * REAL(0.5), y.shifted);
}

/* From 19.1 on the result is 1, to a rounding; the range is cut so that it comes out so. */
INLINE reals NAME(tanh)(reals x)
{
    reals a = ABSOLUTE(x);
    hyperbola y = NAME(hyperbola_of)(SELECT(a > REAL(22.0), REAL(22.0), a));
    pair s = NAME(hyperbola_mix)(y, y.minus, y.plus), c = NAME(hyperbola_mix)(y, y.plus, y.minus);
    return SIGNED(NAME(quotient)(s, c), SIGN_OF(x));
}
