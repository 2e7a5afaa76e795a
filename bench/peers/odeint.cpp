/* Boost's odeint at its best: its own steppers over blocks of trajectories as one state, the system function written for the block, so
 * that the compiler makes vector code of every loop and the cosine is computed once per block and call. Without the blocks, one
 * trajectory at a time, it takes ten times as long. */
#include "bench/peers/peers.h"

#ifdef BENCH_ODEINT
#include <boost/numeric/odeint/algebra/array_algebra.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <boost/numeric/odeint/stepper/velocity_verlet.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace odeint = boost::numeric::odeint;

template <std::size_t B> static void verlet(const double *amplitudes, double h, int64_t steps, double *out)
{
    typedef std::array<double, B> state;
    state x{}, v{}, F;
    std::copy(amplitudes, amplitudes + B, F.begin());       /* at hand, and known to be nobody else's */
    odeint::velocity_verlet<state, state, double, state, double, double, odeint::array_algebra> stepper;
    auto system = [&](const state &q, const state &, state &a, double t) {
        double c = std::cos(t);
        for (std::size_t i = 0; i < B; i++) a[i] = -q[i] + q[i] * q[i] * q[i] + F[i] * c;
    };
    auto both = std::make_pair(std::ref(x), std::ref(v));
    for (int64_t n = 0; n < steps; n++) stepper.do_step(system, both, (double)n * h, h);
    std::copy(x.begin(), x.end(), out);
}

template <std::size_t B> static void rk4(const double *amplitudes, double h, int64_t steps, double *out)
{
    typedef std::array<double, 2 * B> state;                /* positions, then velocities */
    state s{};
    std::array<double, B> F;
    std::copy(amplitudes, amplitudes + B, F.begin());
    odeint::runge_kutta4<state, double, state, double, odeint::array_algebra> stepper;
    auto system = [&](const state &q, state &d, double t) {
        double c = std::cos(t);
        for (std::size_t i = 0; i < B; i++) {
            d[i] = q[B + i];
            d[B + i] = -q[i] + q[i] * q[i] * q[i] + F[i] * c;
        }
    };
    for (int64_t n = 0; n < steps; n++) stepper.do_step(system, s, (double)n * h, h);
    std::copy(s.begin(), s.begin() + B, out);
}

template <std::size_t B> static void blocks(int order4, std::size_t count, const double *F, double h, int64_t steps, double *x)
{
    for (std::size_t at = 0; at < count; at += B) {
        std::size_t from = std::min(at, count - B);
        if (order4) rk4<B>(F + from, h, steps, x + from);
        else verlet<B>(F + from, h, steps, x + from);
    }
}

int peer_odeint(int order4, int block, size_t count, const double *F, double h, int64_t steps, double *x)
{
    if (count < (size_t)block) return 0;
    if (block == 64) blocks<64>(order4, count, F, h, steps, x);
    else if (block == 128) blocks<128>(order4, count, F, h, steps, x);
    else blocks<256>(order4, count, F, h, steps, x);
    return 1;
}

int peer_odeint_chain(size_t N, double beta, double h, int64_t steps, double *x, double *v)
{
    typedef std::vector<double> state;
    state q(x, x + N + 2), p(v, v + N + 2);
    odeint::velocity_verlet<state> stepper;
    auto system = [&](const state &y, const state &, state &a, double) {
        for (size_t i = 1; i <= N; i++) {
            double r = y[i + 1] - y[i], l = y[i] - y[i - 1];
            a[i] = r - l + beta * (r * r * r - l * l * l);
        }
    };
    auto both = std::make_pair(std::ref(q), std::ref(p));
    for (int64_t n = 0; n < steps; n++) stepper.do_step(system, both, (double)n * h, h);
    std::copy(q.begin(), q.end(), x);
    std::copy(p.begin(), p.end(), v);
    return 1;
}
#else
int peer_odeint(int, int, size_t, const double *, double, int64_t, double *) { return 0; }
int peer_odeint_chain(size_t, double, double, int64_t, double *, double *) { return 0; }
#endif
