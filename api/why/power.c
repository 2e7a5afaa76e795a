/* See evidence.h.
 *
 * Three samples determine the instant and the power. Each is about SPREAD times nearer than the one before, so that the
 * logarithms differ. Triples nearer to the instant are freer of what else moves y, and less free of rounding; the one
 * whose neighbours agree with it best is taken. The changes from one triple to the next decay as a geometric series,
 * whose sum is the error; they decay slowly where a logarithm stands beside the power.
 */
#include "api/why/evidence.h"

#include <math.h>

#define SPREAD 4.0
#define CLEAR 1e4       /* least distance, in roundings of the time */
#define AGREE 0.05      /* largest difference of neighbouring powers, relative to 1 + the power */
#define LEAST 0.05      /* least power: slower growth cannot be told from none */
#define FALL_MOST 0.995 /* largest ratio of two changes; a larger one cannot be told from 1 */

enum { HALVINGS = 64, TRIPLES = 3 /* neighbours, SPREAD apart, that agree */ };

typedef struct fit {
    const double *t, *y;
    double end; /* a first guess of the instant */
} fit;

/* Finds the last sample that is at least SPREAD times as far from the end as sample i; SIZE_MAX: none is. */
static size_t farther(const fit *f, size_t i)
{
    const double least = SPREAD * (f->end - f->t[i]);
    while (i-- > 0)
        if (f->end - f->t[i] >= least) return i;
    return (size_t)-1;
}

/* Finds instant and power by the samples i, j, k, from near to far. False: y does not grow faster and faster. */
static bool solve(const fit *f, size_t i, size_t j, size_t k, power *out)
{
    const double near = log(f->y[i] / f->y[j]), far = log(f->y[j] / f->y[k]), first = f->t[j] - f->t[k],
                 second = f->t[i] - f->t[j];
    if (!(near > 0) || !(far > 0) || !(far * second < near * first)) return false;
    double low = log(second) - 100, high = log(second) + 100; /* log of the distance from sample i */
    for (int n = 0; n < HALVINGS; n++) {
        const double middle = (low + high) / 2, d = exp(middle);
        const double ratio = log1p(first / (d + second)) / log1p(second / d);
        *(ratio < far / near ? &low : &high) = middle;
    }
    const double d = exp((low + high) / 2);
    out->at = f->t[i] + d;
    out->exponent = near / log1p(second / d);
    return isfinite(out->at) && isfinite(out->exponent);
}

/* Solves sample i's triple, and those of samples ever farther away. Returns how many agree with it. */
static int agreement(const fit *f, size_t i, power *out)
{
    power at[TRIPLES + 1];
    int count = 0;
    for (; count <= TRIPLES && i != (size_t)-1; count++, i = farther(f, i)) {
        const size_t j = farther(f, i), k = j == (size_t)-1 ? j : farther(f, j);
        if (k == (size_t)-1 || !solve(f, i, j, k, &at[count])) break;
        if (count && fabs(at[count].exponent - at[0].exponent) > AGREE * (1 + at[0].exponent)) break;
    }
    if (count <= TRIPLES) return count;
    const double change = fabs(at[0].exponent - at[1].exponent), before = fabs(at[1].exponent - at[2].exponent),
                 fall = fmin(FALL_MOST, before > 0 ? change / before : 0), rest = 2 * fmax(change, before) / (1 - fall);
    *out = at[0];
    out->exponent_error = rest;
    out->at_error = 2 * fabs(at[0].at - at[1].at) / (1 - fall);
    return count;
}

bool power_fit(const double *t, const double *y, size_t count, double rounding, power *out)
{
    bool found = false;
    if (count < 3) return false;
    fit f = {t, y, t[count - 1] + (t[count - 1] - t[count - 2])};
    for (size_t i = count; i-- > 0;) {
        power one;
        if (f.end - t[i] < CLEAR * rounding || agreement(&f, i, &one) <= TRIPLES) continue;
        if (one.exponent < LEAST || (found && one.exponent_error >= out->exponent_error)) continue;
        *out = one;
        found = true;
    }
    return found;
}
