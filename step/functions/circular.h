/* sin, cos, tan of all doubles.
 *
 * |x| = q pi/2 + r, |r| <= pi/4, r a pair. Up to 2^22 by three parts of pi/2 [CodyWaite80]; the first two steps are
 * exact: the first because the fused product has all its bits, the second because it leaves a sum, and the second
 * part is so short that q times it is a double. What remains is wrong by 2^-117 at most, where r is not below 2^-60.
 * Beyond, by the bits of 2/pi that matter [PayneHanek83], lane by lane. Then
 *
 *     sin r = r + r^3 S(r^2)                within 3.5e-18 r
 *     cos r = 1 - r^2/2 + r^4 C(r^2)        within 4.8e-20
 *
 * minimax among polynomials with double coefficients on |r| <= 0.7854. Invariant: a lane's reduction depends on that
 * lane alone.
 */
/* The bits of 2/pi, behind 64 zeros. */
CONSTANT uint64_t NAME(two_over_pi)[21] = {
    0x0000000000000000, 0xa2f9836e4e441529, 0xfc2757d1f534ddc0, 0xdb6295993c439041, 0xfe5163abdebbc561,
    0xb7246e3a424dd2e0, 0x06492eea09d1921c, 0xfe1deb1cb129a73e, 0xe88235f52ebb4484, 0xe99c7026b45f7e41,
    0x3991d639835339f4, 0x9c845f8bbdf9283b, 0x1ff897ffde05980f, 0xef2f118b5a0a6d1f, 0x6d367ecf27cb09b7,
    0x4f463f669e5fea2d, 0x7527bac7ebe5f17b, 0x3d0739f78a5292ea, 0x6bfb5fb11f8d5d08, 0x56033046fc7b6bab,
    0xf0cfbc209af4361d,
};

/* The upper 64 bits of a b, from halves: not every machine has that product. */
COLD uint64_t NAME(upper)(uint64_t a, uint64_t b)
{
    uint64_t a1 = a >> 32, a0 = a & 0xffffffff, b1 = b >> 32, b0 = b & 0xffffffff;
    uint64_t low = a0 * b0, mid = a1 * b0 + (low >> 32), cross = a0 * b1 + (mid & 0xffffffff);
    return a1 * b1 + (mid >> 32) + (cross >> 32);
}

/* The quadrant of x >= 2^22, given by its bits, and r = hi + lo. x = m 2^e with m an integer, so the bits of 2/pi
 * whose weight times 2^e is a multiple of 4 turn full circles; the 192 after them, times m, are x 2/pi modulo 4 to
 * 2^-137. No double of this range is nearer than 2^-62 to a multiple of pi/2. */
COLD uint64_t NAME(reduce_huge)(uint64_t x, double *hi, double *lo)
{
    uint64_t m = (x & 0x000fffffffffffff) | 0x0010000000000000;
    int first = (int)(x >> 52) - 1075 + 62, word = first >> 6, shift = first & 63;
    if (x >= 0x7ff0000000000000) {
        *hi = *lo = (double)NAN;
        return 0;
    }
    uint64_t w[3], f[6];
    for (int i = 0; i < 3; i++) {
        uint64_t w0 = NAME(two_over_pi)[word + i], w1 = NAME(two_over_pi)[word + i + 1];
        w[i] = shift ? w0 << shift | w1 >> (64 - shift) : w0;
    }
    uint64_t f2 = m * w[2], f1 = NAME(upper)(m, w[2]), middle = m * w[1];
    f1 += middle;
    uint64_t f0 = NAME(upper)(m, w[1]) + (f1 < middle) + m * w[0];

    /* f0 f1 f2 is the turn in units of 2^-190: two bits of quadrant, then the fraction, which is taken to the nearest
     * quadrant. */
    uint64_t quadrant = f0 >> 62, negative = f0 >> 61 & 1;
    f0 = f0 << 2 | f1 >> 62, f1 = f1 << 2 | f2 >> 62, f2 = f2 << 2;
    if (negative) {
        quadrant++;
        f0 = ~f0, f1 = ~f1, f2 = ~f2 + 1;
        f1 += f2 == 0;
        f0 += f1 == 0 && f2 == 0;
    }
    f[0] = f0 >> 32, f[1] = f0 & 0xffffffff, f[2] = f1 >> 32, f[3] = f1 & 0xffffffff, f[4] = f2 >> 32,
    f[5] = f2 & 0xffffffff;

    double h = 0, l = 0, weight = 1;
    for (int i = 0; i < 6; i++) {
        weight *= 0x1p-32;
        double part = (double)f[i] * weight, sum = h + part;
        l += part - (sum - h);
        h = sum;
    }
    double p = h * 0x1.921fb54442d18p+0;
    double p_lo = fma(h, 0x1.921fb54442d18p+0, -p) + (h * 0x1.1a62633145c07p-54 + l * 0x1.921fb54442d18p+0);
    *hi = negative ? -p : p;
    *lo = negative ? -p_lo : p_lo;
    return quadrant;
}

typedef struct NAME(angle) {
    pair r;
    bits quadrant;
} NAME(angle);
#define angle NAME(angle)

/* a >= 0. */
INLINE angle NAME(angle_of)(reals a)
{
    angle y;
    reals shifted = FUSED(a, REAL(0x1.45f306dc9c883p-1), SHIFTER);
    reals k = shifted - SHIFTER;
    reals r = FUSED(-k, REAL(0x1.921fb54442d18p+0), a);
    y.r.hi = FUSED(-k, REAL(0x1.1a62633p-54), r);
    y.r.lo = FUSED(-k, REAL(0x1.45c06e0e68948p-86), FUSED(-k, REAL(0x1.1a62633p-54), r - y.r.hi));
    y.quadrant = AS_BITS(shifted);
    mask huge = a >= REAL(0x1p22);
    if (ANY(huge)) {
        angle z = y;
        reals x = a;
        for (int i = 0; i < LANES; i++) {
            double lane = LANE(x, i), hi, lo;
            if (!(lane >= 0x1p22)) continue;
            union {
                double x;
                uint64_t b;
            } u = {lane};
            LANE(z.quadrant, i) = NAME(reduce_huge)(u.b, &hi, &lo);
            LANE(z.r.hi, i) = hi;
            LANE(z.r.lo, i) = lo;
        }
        y = z;
    }
    return y;
}

typedef struct NAME(circle) {
    pair sin, cos;
} NAME(circle);
#define circle NAME(circle)

INLINE circle NAME(circle_of)(pair r)
{
    circle y;
    pair z = NAME(product)(r.hi, r.hi), cube = NAME(product)(r.hi, z.hi);
    reals z2 = z.hi * z.hi, z4 = z2 * z2;
    reals s = POLY5(z.hi, z2, z4, 0x1.111111110f8a7p-7, -0x1.a01a019c1644ep-13, 0x1.71de357b44dc3p-19,
                    -0x1.ae5e68c0108fcp-26, 0x1.5d93ae1920918p-33);
    reals c = POLY6(z.hi, z2, z4, 0x1.555555555554cp-5, -0x1.6c16c16c15223p-10, 0x1.a01a019cbff92p-16,
                    -0x1.27e4f813368bdp-22, 0x1.1ee9f1b0a7553p-29, -0x1.8fb163896ae2bp-37);
    y.cos.hi = FUSED(z.hi, REAL(-0.5), REAL(1.0));
    y.cos.lo = FUSED(z.hi, REAL(-0.5), REAL(1.0) - y.cos.hi);
    y.cos.lo = FUSED(z2, c, FUSED(-r.hi, r.lo, FUSED(z.lo, REAL(-0.5), y.cos.lo)));
    /* The leading term, near -r^3/6, is kept apart from the others, together with the rounding errors of r^3, because
     * only these matter. */
    cube.lo = FUSED(r.hi, z.lo, cube.lo);
    y.sin.hi = r.hi;
    y.sin.lo = FUSED(cube.hi * z.hi, s, FUSED(cube.lo, REAL(-0x1.5555555555549p-3), r.lo * y.cos.hi));
    y.sin.lo = FUSED(cube.hi, REAL(-0x1.5555555555549p-3), y.sin.lo);
    return y;
}

/* The sine of r + (quadrant) pi/2, negated where `sign` has its top bit. */
INLINE reals NAME(sin_angle)(pair r, bits quadrant, bits sign)
{
    circle y = NAME(circle_of)(r);
    mask even = (quadrant & BITS(1)) == BITS(0);
    reals value = SELECT(even, y.sin.hi, y.cos.hi) + SELECT(even, y.sin.lo, y.cos.lo);
    return SIGNED(value, ((quadrant << 62) ^ sign) & SIGN_BIT);
}

INLINE reals NAME(sin)(reals x)
{
    angle y = NAME(angle_of)(ABSOLUTE(x));
    return NAME(sin_angle)(y.r, y.quadrant, AS_BITS(x));
}

INLINE reals NAME(cos)(reals x)
{
    angle y = NAME(angle_of)(ABSOLUTE(x));
    return NAME(sin_angle)(y.r, y.quadrant + BITS(1), BITS(0));
}

INLINE reals NAME(tan)(reals x)
{
    angle y = NAME(angle_of)(ABSOLUTE(x));
    circle c = NAME(circle_of)(y.r);
    mask odd = (y.quadrant & BITS(1)) != BITS(0);
    pair a, b;
    a.hi = SELECT(odd, c.cos.hi, c.sin.hi), a.lo = SELECT(odd, c.cos.lo, c.sin.lo);
    b.hi = SELECT(odd, c.sin.hi, c.cos.hi), b.lo = SELECT(odd, c.sin.lo, c.cos.lo);
    return SIGNED(NAME(quotient)(a, b), (y.quadrant << 63) ^ SIGN_OF(x));
}
