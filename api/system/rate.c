/* See rate.h. */
#include "api/system/rate.h"

#include <math.h>
#include <string.h>

#define ITERATIONS 32     /* even: the square of an oscillator's Jacobian is -ω² */
#define FORGET 8          /* first iterations, which are not averaged: the fastest direction does not yet dominate */
#define NUMBERS_MAX 20000 /* larger states take fewer iterations, since each costs too much */
#define LEAST 1e-9
#define CLOSED 1e-10 /* part of a product, below which a new direction is rounding */
#define ROUNDS 500   /* most iterations for all roots together; some 20 suffice where roots are simple */

double rate_scatter(size_t k)
{
    double u = fmod(0.6180339887498949 * (double)(k + 1), 1);
    return u < 0.5 ? -0.5 - u : u;
}

double rate_fastest(const rate_map *j, double *u, double *next)
{
    const size_t n = j->n;
    for (size_t k = 0; k < n; k++) u[k] = rate_scatter(k);
    int iterations = n > NUMBERS_MAX ? FORGET + 4 : ITERATIONS;
    double growth = 0, rate = 0;
    for (int i = 0; i < iterations; i++) {
        double size = 0;
        if (!j->product(j->ctx, u, next)) return NAN;
        for (size_t k = 0; k < n; k++) size = fmax(size, fabs(next[k]));
        if (!(size > 0)) return 0; /* J u = 0: the force is constant */
        if (i >= FORGET) {
            growth += log(size);
            rate = exp(growth / (i + 1 - FORGET));
        }
        for (size_t k = 0; k < n; k++) u[k] = next[k] / size;
    }
    return rate < LEAST ? 0 : rate;
}

/* ---- the rates of one motion ---- */

typedef double hessenberg[RATE_MOTION_MAX + 1][RATE_MOTION_MAX];
typedef double polynomial[RATE_MOTION_MAX + 1]; /* by rising powers */

static double normalise(double *u, size_t n)
{
    double most = 0, sum = 0;
    for (size_t k = 0; k < n; k++) most = fmax(most, fabs(u[k]));
    if (!(most > 0) || !isfinite(most)) return 0;
    for (size_t k = 0; k < n; k++) sum += (u[k] / most) * (u[k] / most);
    const double norm = most * sqrt(sum);
    for (size_t k = 0; k < n; k++) u[k] /= norm;
    return norm;
}

/* Projects J on the space of u, J u, …, in an orthonormal basis. Returns its dimension, or 0. */
static int project(const rate_map *j, double *basis, hessenberg h)
{
    const size_t n = j->n;
    if (normalise(basis, n) == 0) return 0;
    for (int m = 0; m < RATE_MOTION_MAX; m++) {
        double *next = basis + (size_t)(m + 1) * n, size = 0;
        if (!j->product(j->ctx, basis + (size_t)m * n, next)) return 0;
        for (size_t k = 0; k < n; k++) size = fmax(size, fabs(next[k]));
        if (!isfinite(size)) return 0;
        for (int twice = 0; twice < 2; twice++) /* one pass leaves rounding of the size of what it takes off */
            for (int i = 0; i <= m; i++) {
                const double *b = basis + (size_t)i * n;
                double part = 0;
                for (size_t k = 0; k < n; k++) part += b[k] * next[k];
                for (size_t k = 0; k < n; k++) next[k] -= part * b[k];
                h[i][m] += part;
            }
        h[m + 1][m] = normalise(next, n);
        if (h[m + 1][m] <= CLOSED * size || (size_t)m + 1 == n) return m + 1;
    }
    return RATE_MOTION_MAX;
}

/* Finds the characteristic polynomial, row by row [the recurrence of Hyman's method]. */
static void characteristic(hessenberg h, int m, double scale, polynomial out)
{
    polynomial p[RATE_MOTION_MAX + 1] = {{1}};
    for (int k = 1; k <= m; k++) {
        for (int d = 0; d <= k; d++) p[k][d] = (d > 0 ? p[k - 1][d - 1] : 0) - (h[k - 1][k - 1] / scale) * p[k - 1][d];
        double below = 1;
        for (int i = k - 2; i >= 0; i--) {
            below *= h[i + 1][i] / scale;
            for (int d = 0; d <= i; d++) p[k][d] -= (h[i][k - 1] / scale) * below * p[i][d];
        }
    }
    memcpy(out, p[m], sizeof(polynomial));
}

typedef struct complex_number {
    double re, im;
} complex_number;

static complex_number times(complex_number a, complex_number b)
{
    return (complex_number){a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

static complex_number over(complex_number a, complex_number b)
{
    const double d = b.re * b.re + b.im * b.im;
    return (complex_number){(a.re * b.re + a.im * b.im) / d, (a.im * b.re - a.re * b.im) / d};
}

static double size(complex_number a) { return sqrt(a.re * a.re + a.im * a.im); }

/* Finds all roots at once: each moves by p(z) over the product of its distances to the others [Weierstrass's
 * iteration]. */
static void roots(const double *p, int m, complex_number *z)
{
    z[0] = (complex_number){0.4, 0.9};
    for (int k = 1; k < m; k++) z[k] = times(z[k - 1], z[0]);
    double moved = 1;
    for (int round = 0; round < ROUNDS && moved > 1e-15; round++) {
        moved = 0;
        for (int k = 0; k < m; k++) {
            complex_number value = {1, 0}, apart = {1, 0};
            for (int d = m - 1; d >= 0; d--) {
                value = times(value, z[k]);
                value.re += p[d];
            }
            for (int i = 0; i < m; i++)
                if (i != k) apart = times(apart, (complex_number){z[k].re - z[i].re, z[k].im - z[i].im});
            if (apart.re == 0 && apart.im == 0) continue;
            const complex_number by = over(value, apart);
            z[k].re -= by.re;
            z[k].im -= by.im;
            moved = fmax(moved, size(by) / fmax(size(z[k]), 1e-12));
        }
    }
}

int rate_motion(const rate_map *j, double noise, double *basis, double re[RATE_MOTION_MAX], double im[RATE_MOTION_MAX])
{
    hessenberg h = {{0}};
    const int m = project(j, basis, h);
    double scale = 0;
    for (int i = 0; i < m; i++)
        for (int k = 0; k < m; k++) scale = fmax(scale, fabs(h[i][k]));
    for (int k = 0; k < m; k++) re[k] = im[k] = 0;
    if (!(scale > 0)) return m;
    polynomial p;
    complex_number z[RATE_MOTION_MAX];
    characteristic(h, m, scale, p);
    int zeros = 0; /* taken out exactly, since of roots that coincide only a part of the digits is found */
    while (zeros < m && fabs(p[zeros]) <= noise) zeros++;
    roots(p + zeros, m - zeros, z);
    for (int k = 0; k < m - zeros; k++) {
        re[k] = scale * z[k].re;
        im[k] = scale * z[k].im;
    }
    return m;
}
