/* cbrt and hypot; sqrt is the machine's.
 *
 * Invariant: the last step adds a residual that was computed exactly, so the result is within a few hundredths of the
 * correct rounding.
 */

/* x = 2^(3q) b, 1 <= b < 8. p ~ b^(-1/3) from a polynomial within 5.8e-6 on [1, 2); one step of third order leaves
 * 1e-15, and b p^2 is then corrected by its own cube. */
INLINE reals NAME(cbrt)(reals x)
{
    reals a = ABSOLUTE(x);
    mask tiny = a < REAL(0x1p-1022);
    bits raw = AS_BITS(SELECT(tiny, a * REAL(0x1p54), a));
    reals m = AS_REAL((raw & BITS(0x000fffffffffffff)) | BITS(0x3ff0000000000000));
    reals e =
        AS_REAL((raw >> 52) | BITS(0x4330000000000000)) - SELECT(tiny, REAL(0x1p52 + 1023 + 54), REAL(0x1p52 + 1023));
    reals shifted = FUSED(e - REAL(1.0), REAL(0x1.5555555555555p-2), SHIFTER);
    reals rest = FUSED(REAL(-3.0), shifted - SHIFTER, e);
    mask one = rest == REAL(1.0), two = rest == REAL(2.0);
    reals b = m * SELECT(two, REAL(4.0), SELECT(one, REAL(2.0), REAL(1.0)));
    reals m2 = m * m, m4 = m2 * m2;
    reals p = POLY6(m, m2, m4, 0x1.c7f365be15349p0, -0x1.90e741ffcf72fp0, 0x1.3e68b9b8bfdc6p0, -0x1.321c5eba9152bp-1,
                    0x1.3fa269c3ea89dp-3, -0x1.16d6f1447909fp-6);
    p = p * SELECT(two, REAL(0x1.428a2f98d728bp-1), SELECT(one, REAL(0x1.965fea53d6e3dp-1), REAL(1.0)));
    reals off = FUSED(-(b * p), p * p, REAL(1.0));
    p = FUSED(p * off, FUSED(off, REAL(0x1.c71c71c71c71cp-3), REAL(0x1.5555555555555p-2)), p);
    reals p2 = p * p, y = b * p2;
    pair square = NAME(product)(y, y), cube = NAME(product)(square.hi, y);
    reals residual = (b - cube.hi) - FUSED(square.lo, y, cube.lo);
    y = FUSED(residual, p2 * REAL(0x1.5555555555555p-2), y);
    reals value = AS_REAL(AS_BITS(y) + (AS_BITS(shifted) << 52));
    value = SIGNED(value, SIGN_OF(x));
    return SELECT((a > REAL(0.0)) & (a < INFINITE), value, x + x);
}

INLINE reals NAME(hypot)(reals x, reals y)
{
    reals p = ABSOLUTE(x), q = ABSOLUTE(y);
    mask swap = p < q;
    reals a = SELECT(swap, q, p), b = SELECT(swap, p, q);
    mask large = a > REAL(0x1p500), small = a < REAL(0x1p-450);
    reals factor = SELECT(large, REAL(0x1p-600), SELECT(small, REAL(0x1p600), REAL(1.0)));
    reals back = SELECT(large, REAL(0x1p600), SELECT(small, REAL(0x1p-600), REAL(1.0)));
    pair aa = NAME(product)(a * factor, a * factor), bb = NAME(product)(b * factor, b * factor);
    pair sum = NAME(sum_ordered)(aa.hi, bb.hi);
    reals r = SQRT(sum.hi);
    reals residual = FUSED(-r, r, sum.hi) + (sum.lo + (aa.lo + bb.lo));
    r = (r + residual / FUSED(r, REAL(2.0), REAL(0x1p-1000))) * back;
    r = SELECT((x != x) | (y != y), x + y, r);
    return SELECT((p == INFINITE) | (q == INFINITE), INFINITE, r);
}
