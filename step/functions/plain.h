/* The functions of the language that take one operation of the processor, or a few.
 *
 * Invariant: f(NaN) is NaN, and the sign of a zero changes at most the sign of a zero. fmod is exact, so it is the
 * same in every C library; all else here consists of operations that are rounded correctly.
 */
INLINE reals NAME(sqrt)(reals x) { return SQRT(x); }
INLINE reals NAME(abs)(reals x) { return ABSOLUTE(x); }

/* To the nearest integer by the shift to 2^52, where there are no fractions, then down where that went up. */
INLINE reals NAME(floor)(reals x)
{
    reals whole = SIGNED((ABSOLUTE(x) + REAL(0x1p52)) - REAL(0x1p52), SIGN_OF(x));
    return SELECT(ABSOLUTE(x) < REAL(0x1p52), SELECT(whole > x, whole - REAL(1.0), whole), x);
}

/* min and max pass a NaN on, whichever side it is on (C's fmin hides it, and with it a divergence); -0 counts as
 * below +0, so that the operands may be exchanged without changing a bit. */
INLINE reals NAME(min)(reals x, reals y)
{
    return SELECT(x < y, x, SELECT(y < x, y, SELECT(x == y, AS_REAL(AS_BITS(x) | AS_BITS(y)), x + y)));
}

INLINE reals NAME(max)(reals x, reals y)
{
    return SELECT(x > y, x, SELECT(y > x, y, SELECT(x == y, AS_REAL(AS_BITS(x) & AS_BITS(y)), x + y)));
}

/* -1, 0 or 1; sign(0) = 0 = sign(-0). */
INLINE reals NAME(sign)(reals x)
{
    return SELECT(x > REAL(0.0), REAL(1.0), SELECT(x < REAL(0.0), REAL(-1.0), SELECT(x == REAL(0.0), REAL(0.0), x)));
}

/* The mathematical mod, x - y floor(x/y): its sign is the divisor's, mod(-1, 3) = 2. mod(x, 0) is NaN. The remainder
 * itself is exact; only the shift by y may round, so that mod of a tiny negative x can be y itself. */
COLD double NAME(mod_of_one)(double x, double y)
{
    double r = fmod(x, y);
    if (r == 0) return copysign(0.0, y);
    return (r < 0) != (y < 0) ? r + y : r;
}

INLINE reals NAME(mod)(reals x, reals y)
{
    reals r = x;
    for (int i = 0; i < LANES; i++) LANE(r, i) = NAME(mod_of_one)(LANE(x, i), LANE(y, i));
    return r;
}
