/* THE FORCES of the comparison of accuracy, as one writes them by hand for speed: each pair of bodies once, roots
 * shared, constants known to the compiler.
 *
 * A text for several precisions: the includer defines NUMBER and ROOT(x), SINE(x), COSINE(x), and FORCE(name), the name
 * of a function. Constants are doubles, since that is what every library is given; products of them are rounded as a
 * model's are.
 */
#define FORCE_BEGIN(name) static inline void FORCE(name)(const NUMBER *x, const NUMBER *v, NUMBER t, NUMBER *a)

FORCE_BEGIN(kepler)
{
    (void)v, (void)t;
    const NUMBER rr = x[0] * x[0] + x[1] * x[1], k = 1 / (rr * ROOT(rr));
    a[0] = -(k * x[0]);
    a[1] = -(k * x[1]);
}

FORCE_BEGIN(arenstorf)
{
    (void)t;
    const double mu = 0.012277471, nu = 1 - mu;
    const NUMBER yy = x[1] * x[1], p = x[0] + mu, q = x[0] - nu, d1 = p * p + yy, d2 = q * q + yy,
                 k1 = nu / (d1 * ROOT(d1)), k2 = mu / (d2 * ROOT(d2));
    a[0] = x[0] + 2 * v[1] - k1 * p - k2 * q;
    a[1] = x[1] - 2 * v[0] - k1 * x[1] - k2 * x[1];
}

FORCE_BEGIN(henon)
{
    (void)v, (void)t;
    a[0] = -x[0] - 2 * x[0] * x[1];
    a[1] = -x[1] - x[0] * x[0] + x[1] * x[1];
}

/* x and y of seven stars */
FORCE_BEGIN(pleiades)
{
    (void)v, (void)t;
    for (int i = 0; i < 14; i++) a[i] = 0;
    for (int i = 0; i < 7; i++)
        for (int j = i + 1; j < 7; j++) {
            const NUMBER dx = x[2 * j] - x[2 * i], dy = x[2 * j + 1] - x[2 * i + 1], rr = dx * dx + dy * dy,
                         k = 1 / (rr * ROOT(rr)), ki = (j + 1) * k, kj = (i + 1) * k;
            a[2 * i] += ki * dx, a[2 * i + 1] += ki * dy;
            a[2 * j] -= kj * dx, a[2 * j + 1] -= kj * dy;
        }
}

/* x, y, z of the Sun, of Jupiter, Saturn, Uranus, Neptune and Pluto */
FORCE_BEGIN(solar)
{
    (void)v, (void)t;
    static const double G = 2.95912208286e-4, m[6] = {1.00000597682,      0.000954786104043,  0.000285583733151,
                                                      0.0000437273164546, 0.0000517759138449, 1 / 1.3e8};
    for (int i = 0; i < 18; i++) a[i] = 0;
    for (int i = 0; i < 6; i++)
        for (int j = i + 1; j < 6; j++) {
            const NUMBER dx = x[3 * j] - x[3 * i], dy = x[3 * j + 1] - x[3 * i + 1], dz = x[3 * j + 2] - x[3 * i + 2],
                         rr = dx * dx + dy * dy + dz * dz, k = 1 / (rr * ROOT(rr)), ki = (G * m[j]) * k,
                         kj = (G * m[i]) * k;
            a[3 * i] += ki * dx, a[3 * i + 1] += ki * dy, a[3 * i + 2] += ki * dz;
            a[3 * j] -= kj * dx, a[3 * j + 1] -= kj * dy, a[3 * j + 2] -= kj * dz;
        }
}
#undef FORCE_BEGIN
