/* Boost's odeint with error control at its best: arrays of a known length as states, the force inlined, the constants
 * known. */
#include "bench/peers/peers.h"
#include "bench/problems.h"

#ifdef BENCH_ODEINT
#include <boost/numeric/odeint/algebra/array_algebra.hpp>
#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace odeint = boost::numeric::odeint;

#define NUMBER double
#define ROOT std::sqrt
#define FORCE(name) force_##name
#include "bench/forces.h"

template <std::size_t N, class Force>
static void adaptive(std::array<double, 2 * N> &y, double until, double first, double tolerance, Force force)
{
    typedef std::array<double, 2 * N> state;
    auto system = [&](const state &s, state &d, double t) {
        for (std::size_t k = 0; k < N; k++) d[k] = s[N + k];
        force(s.data(), s.data() + N, t, d.data() + N);
    };
    typedef odeint::runge_kutta_fehlberg78<state, double, state, double, odeint::array_algebra> stepper;
    odeint::integrate_adaptive(odeint::make_controlled<stepper>(tolerance, tolerance), system, y, 0.0, until, first);
}

template <std::size_t N, class Force> static void solve(const problem &p, double tolerance, double *out, Force force)
{
    std::array<double, 2 * N> y;
    std::copy(p.start, p.start + 2 * N, y.begin());
    adaptive<N>(y, p.until, p.until * 1e-6, tolerance, force);
    std::copy(y.begin(), y.end(), out);
}

int peer_odeint_adaptive(int which, double tolerance, double *state)
{
#define PROBLEM(name, positions, end, ...)                                                                    \
    if (which == PROBLEM_##name) {                                                                            \
        solve<positions>(problems[which], tolerance, state,                                                   \
                         [](const double *x, const double *v, double t, double *a) { force_##name(x, v, t, a); }); \
        return 1;                                                                                             \
    }
#include "bench/problems.def"
    return 0;
}

int peer_odeint_pendulums(size_t count, const double *F, const double *theta, double tolerance, double *x, double *v)
{
    for (size_t k = 0; k < count; k++) {
        std::array<double, 2> y = {theta[k], 0};
        const double strength = F[k];
        adaptive<1>(y, 20.0, 0.01, tolerance, [strength](const double *q, const double *p, double t, double *a) {
            a[0] = -0.1 * p[0] - std::sin(q[0]) + strength * std::cos(2 * t / 3);
        });
        x[k] = y[0], v[k] = y[1];
    }
    return 1;
}
#else
int peer_odeint_adaptive(int, double, double *) { return 0; }
int peer_odeint_pendulums(size_t, const double *, const double *, double, double *, double *) { return 0; }
#endif
