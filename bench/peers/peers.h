/* THE PEERS: the libraries somebody would pick instead, used as their manuals say, for x'' = -x + x³ + F cos t from
 * rest at 0.
 *
 * Invariant: each writes x at the end of every trajectory, so that its work can be checked; a library that is not
 * installed leaves 0.
 */
#ifndef BENCH_PEERS_H
#define BENCH_PEERS_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Each for all trajectories, `steps` steps of size `step`. They return 1, or 0 where the library is missing or
 * failed. */
/* block: 64, 128, 256 */
int peer_odeint(int rk4, int block, size_t count, const double *F, double step, int64_t steps, double *x);
/* models/chain.motus */
int peer_odeint_chain(size_t N, double beta, double step, int64_t steps, double *x, double *v);
int peer_gsl(size_t count, const double *F, double step, int64_t steps, double *x);
int peer_sundials(size_t count, const double *F, double step, int64_t steps, double *x);

/* ACCURACY: problem `which` of bench/problems.h to its end, by tolerance, relative and absolute; the state there. */
int peer_odeint_adaptive(int which, double tolerance, double *state);                   /* Runge-Kutta-Fehlberg 7(8) */
int peer_gsl_adaptive(const char *stepper, int which, double tolerance, double *state); /* "rk8pd", "msadams" */
int peer_sundials_adaptive(const char *solver, int which, double tolerance, double *state); /* "erk", "adams" */
/* Driven pendulums, theta'' = -0.1 theta' - sin theta + F cos(2 t/3), from rest at theta[k] to t = 20. */
int peer_odeint_pendulums(size_t count, const double *F, const double *theta, double tolerance, double *x, double *v);

/* SECTIONS: Henon and Heiles' motion from (0, y, vx, vy) to `until`, start after start; where each passes x = 0 rising,
 * `most` places (t, y, y') each, and how many there were. solver: "adams" with functional iteration, or "bdf" with
 * Newton's. evaluations: of the force, all of them. */
int peer_sundials_sections(const char *solver, double tolerance, size_t count, const double *y, const double *vx,
                           const double *vy, double until, int most, double *points, int *found, int64_t *evaluations);

#ifdef __cplusplus
}
#endif

#endif
