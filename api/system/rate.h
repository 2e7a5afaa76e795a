/* The rates of a linear motion u' = J u, from products of J with vectors.
 *
 * Invariant: no result depends on a random seed.
 */
#ifndef API_SYSTEM_RATE_H
#define API_SYSTEM_RATE_H

#include <stdbool.h>
#include <stddef.h>

typedef struct rate_map {
    size_t n;
    bool (*product)(void *ctx, const double *u, double *out); /* out = J u; false: it cannot be computed */
    void *ctx;
} rate_map;

/* Number k of a fixed, even scatter over (-1, -1/2) and (1/2, 1). */
double rate_scatter(size_t k);
/* The largest |eigenvalue|, by power iteration; u and next: room for n numbers each. 0 where it is negligible, NaN
 * where it cannot be computed. */
double rate_fastest(const rate_map *, double *u, double *next);

enum { RATE_MOTION_MAX = 6 };
/* The eigenvalues re[k] + i im[k] that take part in the motion u: those of J on the space of u, J u, J² u …, all of
 * them where that has at most RATE_MOTION_MAX dimensions, else approximations to the outer ones (Arnoldi's method).
 * noise: of a product, relative to its size; eigenvalues that are noise are 0. basis: room for (RATE_MOTION_MAX + 1) n
 * numbers, of which the first n are u. Returns how many; 0: u is 0, or a product cannot be computed. */
int rate_motion(const rate_map *, double noise, double *basis, double re[RATE_MOTION_MAX], double im[RATE_MOTION_MAX]);

#endif
