/* Sums over pairs: a[i] = G Σ (r[j] - r[i]) / |r[j] - r[i]|³ for N bodies of equal mass.
 *
 * Why they are fast, and what bounds them. A pair takes some fifteen operations, a root and a division; the divider
 * alone takes as long as all the rest, so there is one division a pair, 1/(r² root), and everything else hides behind
 * it. The approximate form has no divider at all. The halved form computes each pair once, and pays with a pass over
 * the partners' accelerations.
 *
 * Invariant: the first form adds in eight partial sums, j modulo 8, and then in a fixed tree, as motus does: the same
 * bits.
 */
#include "bench/hand/hand.h"
#include "bench/hand/lanes.h"

enum { PARTIALS = 8, PARTS = PARTIALS / WIDTH };

/* The terms of PARTIALS bodies from j on for body i at (x, y, z), itself left out. */
#define TERMS(INVERSE_CUBE, SKIP)                                                                        \
    UNROLL for (int p = 0; p < PARTS; p++)                                                               \
    {                                                                                                    \
        size_t at = j + (size_t)p * WIDTH;                                                               \
        vec dx = vec_load(r + at) - x, dy = vec_load(r + N + at) - y, dz = vec_load(r + 2 * N + at) - z; \
        vec rr = vec_fma(dz, dz, vec_fma(dy, dy, dx * dx)), w;                                           \
        INVERSE_CUBE;                                                                                    \
        if (SKIP) w = vec_without(w, (int64_t)i - (int64_t)at);                                          \
        sx[p] = vec_fma(dx, w, sx[p]);                                                                   \
        sy[p] = vec_fma(dy, w, sy[p]);                                                                   \
        sz[p] = vec_fma(dz, w, sz[p]);                                                                   \
    }
#define ROUNDED w = vec_all(1) / (rr * vec_sqrt(rr))
#define APPROXIMATE               \
    do {                          \
        vec root = vec_rsqrt(rr); \
        w = root * root * root;   \
    } while (0)

/* The rest of the bodies, one by one, and the tree. */
static double finish(size_t N, const double *r, size_t i, size_t j, const double *d, const vec *s, double G)
{
    double sum[PARTIALS];
    for (int p = 0; p < PARTS; p++) vec_store(sum + p * WIDTH, s[p]);
    for (; j < N; j++) {
        double dx = r[j] - r[i], dy = r[N + j] - r[N + i], dz = r[2 * N + j] - r[2 * N + i];
        double rr = fma(dz, dz, fma(dy, dy, dx * dx));
        if (j != i) sum[j % PARTIALS] = fma(d[j] - d[i], 1 / (rr * sqrt(rr)), sum[j % PARTIALS]);
    }
    return G * (((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7])));
}

#define SUM_OF_ALL(name, INVERSE_CUBE)                                                                                \
    void name(size_t N, double G, const double *restrict r, double *restrict a)                                       \
    {                                                                                                                 \
        size_t whole = N / PARTIALS * PARTIALS;                                                                       \
        for (size_t i = 0; i < N; i++) {                                                                              \
            vec x = vec_all(r[i]), y = vec_all(r[N + i]), z = vec_all(r[2 * N + i]), sx[PARTS], sy[PARTS], sz[PARTS]; \
            size_t j = 0, own = i / PARTIALS * PARTIALS;                                                              \
            UNROLL for (int p = 0; p < PARTS; p++) sx[p] = sy[p] = sz[p] = vec_all(0);                                \
            for (; j < own; j += PARTIALS) TERMS(INVERSE_CUBE, 0)                                                     \
            if (j < whole) { TERMS(INVERSE_CUBE, 1) j += PARTIALS; }                                                  \
            for (; j < whole; j += PARTIALS) TERMS(INVERSE_CUBE, 0)                                                   \
            a[i] = finish(N, r, i, j, r, sx, G);                                                                      \
            a[N + i] = finish(N, r, i, j, r + N, sy, G);                                                              \
            a[2 * N + i] = finish(N, r, i, j, r + 2 * N, sz, G);                                                      \
        }                                                                                                             \
    }
SUM_OF_ALL(hand_gravity, ROUNDED)
SUM_OF_ALL(hand_gravity_approximate, APPROXIMATE)

void hand_gravity_half(size_t N, double G, const double *restrict r, double *restrict a)
{
    memset(a, 0, 3 * N * sizeof *a);
    for (size_t i = 0; i < N; i++) {
        vec x = vec_all(r[i]), y = vec_all(r[N + i]), z = vec_all(r[2 * N + i]), sx = vec_all(0), sy = sx, sz = sx;
        size_t j = i + 1;
        for (; j + WIDTH <= N; j += WIDTH) {
            vec dx = vec_load(r + j) - x, dy = vec_load(r + N + j) - y, dz = vec_load(r + 2 * N + j) - z;
            vec rr = vec_fma(dz, dz, vec_fma(dy, dy, dx * dx)), w;
            ROUNDED;
            sx = vec_fma(dx, w, sx);
            sy = vec_fma(dy, w, sy);
            sz = vec_fma(dz, w, sz);
            vec_store(a + j, vec_fnma(dx, w, vec_load(a + j)));
            vec_store(a + N + j, vec_fnma(dy, w, vec_load(a + N + j)));
            vec_store(a + 2 * N + j, vec_fnma(dz, w, vec_load(a + 2 * N + j)));
        }
        for (; j < N; j++) {
            double dx = r[j] - r[i], dy = r[N + j] - r[N + i], dz = r[2 * N + j] - r[2 * N + i];
            double rr = fma(dz, dz, fma(dy, dy, dx * dx)), w = 1 / (rr * sqrt(rr)), d[3] = {dx, dy, dz};
            for (int k = 0; k < 3; k++) {
                a[(size_t)k * N + i] = fma(d[k], w, a[(size_t)k * N + i]);
                a[(size_t)k * N + j] = fma(-d[k], w, a[(size_t)k * N + j]);
            }
        }
        vec sum[3] = {sx, sy, sz};
        for (int k = 0; k < 3; k++)
            for (int l = 0; l < WIDTH; l++) a[(size_t)k * N + i] += sum[k][l];
        for (int k = 0; k < 3; k++) a[(size_t)k * N + i] *= G; /* nothing is added to body i any more */
    }
}
