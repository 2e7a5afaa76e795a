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
    bool (*product)(void *ctx, const double *u, double *out); /* computes out = J u. False: it cannot */
    void *ctx;
} rate_map;

/* Returns number k of a fixed, even scatter over (-1, -1/2) and (1/2, 1). */
double rate_scatter(size_t k);
/* Returns the largest |eigenvalue|, by power iteration: 0 where it is negligible, NaN where it cannot be computed. u
 * and next: room for n numbers each. */
double rate_fastest(const rate_map *, double *u, double *next);

enum { RATE_MOTION_MAX = 6 };
/* Finds the eigenvalues re[k] + i im[k] of J on the space of u, J u, J² u …, which are those that take part in the
 * motion u: all of them where that space has at most RATE_MOTION_MAX dimensions, else approximations to the outer ones
 * (Arnoldi's method). noise: the relative rounding of a product; eigenvalues below it are 0. basis: room for
 * (RATE_MOTION_MAX + 1) n numbers, of which the first n are u. Returns how many; 0: u is 0, or a product cannot be
 * computed. */
int rate_motion(const rate_map *, double noise, double *basis, double re[RATE_MOTION_MAX], double im[RATE_MOTION_MAX]);

#endif
