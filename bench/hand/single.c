/* ONE TRAJECTORY of every model in models/: the loop that a physicist writes, compiled with -O2 and nothing more.
 *
 * Verlet's method, d += h² a, x += d, where the force does not depend on the velocity, and else the classical
 * Runge-Kutta method, with the formulas as they stand in the model. Nothing is known of the machine, and nothing is
 * tested.
 */
#include "bench/hand/hand.h"

#include <math.h>
#include <string.h>

#define FORCE(name) static inline void name(double t, const double *x, const double *v, double *a)
#define STATIONARY (void)t, (void)v

/* The loops, with the force inlined by name. Returns x[0]. */
#define VERLET(name, force, N, ...)                       \
    double hand_##name(double h, int64_t steps)           \
    {                                                     \
        static const double start[2 * (N)] = __VA_ARGS__; \
        double x[N], d[N], a[N];                          \
        memcpy(x, start, sizeof x);                       \
        force(0, x, start + (N), a);                      \
        for (int k = 0; k < (N); k++) {                   \
            d[k] = h * start[(N) + k] + h * h / 2 * a[k]; \
            x[k] += d[k];                                 \
        }                                                 \
        for (int64_t n = 1; n < steps; n++) {             \
            force((double)n *h, x, d, a);                 \
            for (int k = 0; k < (N); k++) {               \
                d[k] += h * h * a[k];                     \
                x[k] += d[k];                             \
            }                                             \
        }                                                 \
        return x[0];                                      \
    }
#define RK4(name, force, N, ...)                                                 \
    double hand_##name(double h, int64_t steps)                                  \
    {                                                                            \
        static const double start[2 * (N)] = __VA_ARGS__;                        \
        double x[N], v[N], X[N], V[3][N], K[4][N];                               \
        memcpy(x, start, sizeof x);                                              \
        memcpy(v, start + (N), sizeof v);                                        \
        for (int64_t n = 0; n < steps; n++) {                                    \
            const double t = (double)n * h;                                      \
            force(t, x, v, K[0]);                                                \
            for (int k = 0; k < (N); k++) {                                      \
                X[k] = x[k] + h / 2 * v[k];                                      \
                V[0][k] = v[k] + h / 2 * K[0][k];                                \
            }                                                                    \
            force(t + h / 2, X, V[0], K[1]);                                     \
            for (int k = 0; k < (N); k++) {                                      \
                X[k] = x[k] + h / 2 * V[0][k];                                   \
                V[1][k] = v[k] + h / 2 * K[1][k];                                \
            }                                                                    \
            force(t + h / 2, X, V[1], K[2]);                                     \
            for (int k = 0; k < (N); k++) {                                      \
                X[k] = x[k] + h * V[1][k];                                       \
                V[2][k] = v[k] + h * K[2][k];                                    \
            }                                                                    \
            force(t + h, X, V[2], K[3]);                                         \
            for (int k = 0; k < (N); k++) {                                      \
                x[k] += h / 6 * (v[k] + 2 * V[0][k] + 2 * V[1][k] + V[2][k]);    \
                v[k] += h / 6 * (K[0][k] + 2 * K[1][k] + 2 * K[2][k] + K[3][k]); \
            }                                                                    \
        }                                                                        \
        return x[0];                                                             \
    }

/* ---- forces of the positions ---- */

FORCE(kepler)
{
    const double mu = 1, r = sqrt(x[0] * x[0] + x[1] * x[1]), r3 = r * r * r;
    STATIONARY;
    a[0] = -mu * x[0] / r3;
    a[1] = -mu * x[1] / r3;
}
VERLET(kepler, kepler, 2, {0.4, 0, 0, 2})

FORCE(comet)
{
    const double mu = 4 * 3.14159265358979324 * 3.14159265358979324, r = sqrt(x[0] * x[0] + x[1] * x[1]),
                 r3 = r * r * r;
    STATIONARY;
    a[0] = -mu * x[0] / r3;
    a[1] = -mu * x[1] / r3;
}
VERLET(comet, comet, 2, {-35.079478, 0, 0, -0.19270788})

FORCE(cubic_driven)
{
    (void)v;
    a[0] = -x[0] + x[0] * x[0] * x[0] + 0.1 * cos(t);
}
VERLET(driven_oscillator, cubic_driven, 1, {0, 0})

FORCE(henon_heiles)
{
    STATIONARY;
    a[0] = -x[0] - 2 * x[0] * x[1];
    a[1] = -x[1] - x[0] * x[0] + x[1] * x[1];
}
VERLET(henon_heiles, henon_heiles, 2, {0, -0.25, 0.42, 0})

FORCE(pendulum)
{
    STATIONARY;
    a[0] = -sin(x[0]);
}
VERLET(pendulum, pendulum, 1, {2, 0})

FORCE(falling)
{
    STATIONARY, (void)x;
    a[0] = 0;
    a[1] = -9.81;
}
VERLET(projectile, falling, 2, {0, 0, 1, 4.5})
VERLET(thrown_ball, falling, 2, {0, 1.7, 6, 10})

FORCE(resonance)
{
    (void)v;
    a[0] = -x[0] + 0.02 * cos(t);
}
VERLET(resonance, resonance, 1, {0, 0})

FORCE(spring)
{
    const double k = 1, m = 1;
    STATIONARY;
    a[0] = -k * x[0] / m;
}
VERLET(spring, spring, 1, {1, 0})

enum { CELLS = 32, CHAIN = CELLS + 2 };
FORCE(springs)
{
    const double beta = 0.7;
    STATIONARY;
    a[0] = a[CHAIN - 1] = 0;
    for (int i = 1; i <= CELLS; i++) {
        const double right = x[i + 1] - x[i], left = x[i] - x[i - 1];
        a[i] = right - left + beta * (right * right * right - left * left * left);
    }
}
VERLET(chain, springs, CHAIN, {0, 0.1, 0.2, 0.3, 0.4, 0.3, 0.2, 0.1})

/* Gravity among N bodies in D dimensions; masses[j] has G in it. */
static inline void gravity(int N, int D, const double *masses, const double *x, double *a)
{
    for (int i = 0; i < N; i++) {
        double sum[3] = {0, 0, 0};
        for (int j = 0; j < N; j++) {
            if (j == i) continue;
            double d[3] = {0, 0, 0}, rr = 0;
            for (int k = 0; k < D; k++) {
                d[k] = x[j * D + k] - x[i * D + k];
                rr += d[k] * d[k];
            }
            const double r = sqrt(rr), w = masses[j] / (r * r * r);
            for (int k = 0; k < D; k++) sum[k] += w * d[k];
        }
        for (int k = 0; k < D; k++) a[i * D + k] = sum[k];
    }
}

FORCE(planets)
{
    static const double m[] = {2.95912208286e-4 * 1.00000597682,      2.95912208286e-4 * 0.000954786104043,
                               2.95912208286e-4 * 0.000285583733151,  2.95912208286e-4 * 0.0000437273164546,
                               2.95912208286e-4 * 0.0000517759138449, 2.95912208286e-4 / 1.3e8};
    STATIONARY;
    gravity(6, 3, m, x, a);
}
VERLET(outer_solar_system, planets, 18,
       {0,           0,          0,           -3.5023653, -3.8169847, -1.5507963,  9.0755314,   -3.0458353,
        -1.6483708,  8.3101420,  -16.2901086, -7.2521278, 11.4707666, -25.7294829, -10.8169456, -15.5387357,
        -25.2225594, -3.1902382, 0,           0,          0,          0.00565429,  -0.00412490, -0.00190589,
        0.00168318,  0.00483525, 0.00192462,  0.00354178, 0.00137102, 0.00055029,  0.00288930,  0.00114527,
        0.00039677,  0.00276725, -0.00170702, -0.00136504})

FORCE(three_bodies)
{
    static const double m[] = {1, 1, 1};
    STATIONARY;
    gravity(3, 2, m, x, a);
}
VERLET(three_body_figure_eight, three_bodies, 6,
       {0.97000436, -0.24308753, -0.97000436, 0.24308753, 0, 0, 0.466203685, 0.43236573, 0.466203685, 0.43236573,
        -0.93240737, -0.86473146})

/* ---- forces of the velocities too ---- */

FORCE(arenstorf)
{
    const double mu = 0.012277471, nu = 1 - mu, e = x[0] + mu, m = x[0] - nu, d1 = sqrt(e * e + x[1] * x[1]),
                 d2 = sqrt(m * m + x[1] * x[1]), p = d1 * d1 * d1, q = d2 * d2 * d2;
    (void)t;
    a[0] = x[0] + 2 * v[1] - nu * e / p - mu * m / q;
    a[1] = x[1] - 2 * v[0] - nu * x[1] / p - mu * x[1] / q;
}
RK4(arenstorf, arenstorf, 2, {0.994, 0, 0, -2.00158510637908252})

FORCE(charged)
{
    (void)t, (void)x;
    a[0] = 0.5 + 2 * v[1];
    a[1] = -2 * v[0];
    a[2] = 0;
}
RK4(charged_particle, charged, 3, {0, 0, 0, 1, 0, 0.25})

FORCE(crossed)
{
    const double s = -0.175882;
    (void)t, (void)x;
    a[0] = s * v[1];
    a[1] = s * (1 - v[0]);
}
RK4(crossed_fields, crossed, 2, {0, 0, -1.5, 0})

FORCE(damped_cubic)
{
    (void)t;
    a[0] = -v[0] - x[0] * x[0] * x[0];
}
RK4(damped_cubic, damped_cubic, 1, {10, 0})

FORCE(damped_spring)
{
    const double gamma = 0.1, omega0 = 2, F = 0, omega = 1.5;
    a[0] = -2 * gamma * v[0] - omega0 * omega0 * x[0] + F * cos(omega * t);
}
RK4(damped_spring, damped_spring, 1, {1, 0})

FORCE(double_pendulum)
{
    const double m1 = 1, m2 = 1, l1 = 1, l2 = 1, g = 9.81, s = sin(x[0] - x[1]), c = cos(x[0] - x[1]), M = m1 + m2,
                 q = m1 + m2 * s * s, s1 = sin(x[0]), s2 = sin(x[1]);
    (void)t;
    a[0] = (-m2 * s * (l2 * v[1] * v[1] + l1 * v[0] * v[0] * c) - g * (M * s1 - m2 * s2 * c)) / (l1 * q);
    a[1] = (s * (M * l1 * v[0] * v[0] + m2 * l2 * v[1] * v[1] * c) - M * g * (s2 - s1 * c)) / (l2 * q);
}
RK4(double_pendulum, double_pendulum, 2, {2, 1, 0, 0})

FORCE(duffing) { a[0] = -0.3 * v[0] + x[0] - x[0] * x[0] * x[0] + 0.5 * cos(1.2 * t); }
RK4(duffing, duffing, 1, {1, 0})

FORCE(penning)
{
    const double wc = 10, wz = 2;
    (void)t;
    a[0] = wz * wz * x[0] / 2 + wc * v[1];
    a[1] = wz * wz * x[1] / 2 - wc * v[0];
    a[2] = -wz * wz * x[2];
}
RK4(penning_trap, penning, 3, {1, 0, 0.5, 0, 1, 0})

FORCE(drag)
{
    const double k = 0.001 / 0.1, speed = sqrt(v[0] * v[0] + v[1] * v[1]);
    (void)t, (void)x;
    a[0] = -k * speed * v[0];
    a[1] = -9.81 - k * speed * v[1];
}
RK4(projectile_drag, drag, 2, {0, 0, 30, 40})

FORCE(air)
{
    const double k = 0.0078 / 0.45, speed = sqrt(v[0] * v[0] + v[1] * v[1]);
    (void)t, (void)x;
    a[0] = -k * speed * v[0];
    a[1] = -9.81 - k * speed * v[1];
}
RK4(thrown_ball_air, air, 2, {0, 1.7, 6, 10})

FORCE(ueda) { a[0] = -0.05 * v[0] - x[0] * x[0] * x[0] + 7.5 * cos(t); }
RK4(ueda, ueda, 1, {3, 4})

/* The second number is first order: it is a velocity without a position. */
FORCE(van_der_pol)
{
    const double f = 5 * (1 - x[0] * x[0]) * v[0];
    (void)t;
    a[0] = f - x[0];
    a[1] = f * v[0];
}
RK4(van_der_pol, van_der_pol, 2, {2, 0, 0, 0})

const hand_single hand_singles[] = {
    {"arenstorf", "rk4", 1e-4, hand_arenstorf},
    {"chain", "verlet", 0.1, hand_chain},
    {"charged-particle", "rk4", 0.01, hand_charged_particle},
    {"comet", "verlet", 1e-4, hand_comet},
    {"crossed-fields", "rk4", 0.05, hand_crossed_fields},
    {"damped-cubic", "rk4", 1e-3, hand_damped_cubic},
    {"damped-spring", "rk4", 1e-3, hand_damped_spring},
    {"double-pendulum", "rk4", 1e-3, hand_double_pendulum},
    {"driven-oscillator", "verlet", 1e-3, hand_driven_oscillator},
    {"duffing", "rk4", 1e-3, hand_duffing},
    {"henon-heiles", "verlet", 1e-3, hand_henon_heiles},
    {"kepler", "verlet", 1e-3, hand_kepler},
    {"outer-solar-system", "verlet", 1, hand_outer_solar_system},
    {"pendulum", "verlet", 1e-3, hand_pendulum},
    {"penning-trap", "rk4", 1e-3, hand_penning_trap},
    {"projectile", "verlet", 1e-3, hand_projectile},
    {"projectile-drag", "rk4", 1e-4, hand_projectile_drag},
    {"resonance", "verlet", 1e-3, hand_resonance},
    {"spring", "verlet", 1e-3, hand_spring},
    {"three-body-figure-eight", "verlet", 1e-3, hand_three_body_figure_eight},
    {"thrown-ball", "verlet", 1e-3, hand_thrown_ball},
    {"thrown-ball-air", "rk4", 1e-4, hand_thrown_ball_air},
    {"ueda", "rk4", 1e-3, hand_ueda},
    {"van-der-pol", "rk4", 1e-3, hand_van_der_pol},
    {NULL, NULL, 0, NULL},
};
