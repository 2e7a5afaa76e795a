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

#ifdef __cplusplus
}
#endif

#endif
