/* Cells: halves, values, slopes, solutions of p = level. */
#include "core/roots_cell.h"

#include "core/roots.h"

#include <math.h>

double roots_cell_tau(const roots_cell *cell, double x) { return cell->at + cell->half * (1 + x); }

double roots_cell_value(const roots_cell *cell, double x, double *slope)
{
    const double twice = 2 * x;
    double b1 = 0, b2 = 0, d1 = 0, d2 = 0;
    for (int k = cell->degree; k > 0; k--) {
        const double d = twice * d1 + (2 * b1 - d2), b = twice * b1 + (cell->c[k] - b2);
        d2 = d1, d1 = d;
        b2 = b1, b1 = b;
    }
    *slope = x * d1 + (b1 - d2);
    return x * b1 + (cell->c[0] - b2);
}

double roots_cell_rest(const roots_cell *cell)
{
    double sum = 0;
    for (int k = cell->degree; k > 0; k--) sum += fabs(cell->c[k]);
    return sum;
}

void roots_cell_slope(const roots_cell *cell, roots_cell *slope)
{
    const int degree = cell->degree;
    slope->at = cell->at;
    slope->half = cell->half;
    slope->degree = degree > 0 ? degree - 1 : 0;
    slope->c[0] = 0;
    for (int k = degree; k > 0; k--) slope->c[k - 1] = 2 * k * cell->c[k] + (k + 1 < degree ? slope->c[k + 1] : 0);
    slope->c[0] /= 2;
}

/* Solves by Newton's method within a bracket, which is halved where a step leaves it or does not halve |p - level|. */
double roots_cell_solve(const roots_cell *cell, double x0, double p0, double x1, double p1, double level)
{
    double f0 = p0 - level, f1 = p1 - level;
    if (f0 == 0) return x0;
    if (f1 == 0) return x1;
    if ((f0 < 0) == (f1 < 0)) return fabs(f0) < fabs(f1) ? x0 : x1;
    double x = x0 + (x1 - x0) * (f0 / (f0 - f1)), before = INFINITY;
    for (int i = 0; i < 128 && x > x0 && x < x1; i++) {
        double slope, f = roots_cell_value(cell, x, &slope) - level;
        if (f == 0) break;
        if ((f < 0) == (f0 < 0))
            x0 = x;
        else
            x1 = x;
        double next = x - f / slope;
        if (!(next > x0 && next < x1)) {
            /* a step below the last place ends at the bracket */
            if (fabs(next - x) <= 0x1p-53) break;
            next = x0 + (x1 - x0) / 2;
        } else if (fabs(f) > before / 2)
            next = x0 + (x1 - x0) / 2;
        else if (fabs(next - x) <= 0x1p-53)
            return next;
        before = fabs(f);
        x = next;
    }
    return x < x0 ? x0 : x > x1 ? x1 : x;
}

/* T_(j+1)(y) = 2 y T_j(y) - T_(j-1)(y) with 2 y = x + 1, and x T_k = (T_(k-1) + T_(k+1)) / 2. */
void roots_cell_halving(int degree, roots_halving *h)
{
    for (int j = 0; j <= degree; j++)
        for (int k = 0; k <= j; k++) {
            if (j < 2) {
                h->row[k][j] = j == 0 ? 1 : 0.5;
                continue;
            }
            double sum = k < j ? h->row[k][j - 1] : 0;
            if (k > 0) sum += (k == 1 ? 1 : 0.5) * h->row[k - 1][j - 1];
            if (k + 1 < j) sum += 0.5 * h->row[k + 1][j - 1];
            if (k < j - 1) sum -= h->row[k][j - 2];
            h->row[k][j] = sum;
        }
}

/* Drops the last coefficients, those that no slope can tell from 0. */
static void trim(roots_cell *cell)
{
    const double least = 0x1p-64 * fabs(cell->c[1]);
    while (cell->degree > 1 && fabs(cell->c[cell->degree]) <= least) cell->degree--;
}

/* T_j((x - 1) / 2) = (-1)^j T_j((1 - x) / 2), so coefficient k of the left half has the terms of the right half, with
 * the other sign where j - k is odd. */
void roots_cell_halve(const roots_halving *h, roots_cell *cell, roots_cell *left)
{
    const int degree = cell->degree;
    for (int k = 0; k <= degree; k++) {
        const double *row = h->row[k];
        double even = 0, odd = 0;
        for (int j = degree - (degree - k) % 2; j >= k; j -= 2) even += row[j] * cell->c[j];
        for (int j = degree - (degree - k + 1) % 2; j > k; j -= 2) odd += row[j] * cell->c[j];
        left->c[k] = even - odd;
        cell->c[k] = even + odd;
    }
    left->at = cell->at;
    left->half = cell->half /= 2;
    left->degree = degree;
    cell->at += 2 * cell->half;
    trim(left);
    trim(cell);
}

typedef struct wide {
    double hi, lo;
} wide;

static wide wide_sum(double a, double b)
{
    double s = a + b, t = s - a;
    return (wide){s, (a - (s - t)) + (b - t)};
}

/* Splits a number into two of at most 26 bits each, whose products are exact [Dekker71]. */
static wide split(double a)
{
    const double big = 0x8000001p0 * a, high = big - (big - a);
    return (wide){high, a - high};
}

enum { CUTS = ROOTS_CELL_DEGREE + 1 };

/* Evaluates by Clenshaw's recurrence in pairs of doubles, since its rounding grows with n^2 near the ends. All points
 * go side by side, because each alone waits for its own operations. x = 2 tau - 1. */
static void wide_values(const double *c, int degree, const wide x[CUTS], double values[CUTS])
{
    double factor[CUTS], low[CUTS], upper[CUTS], lower[CUTS]; /* x or 2 x, its rest, its halves */
    double b1[CUTS] = {0}, b1_low[CUTS] = {0}, b2[CUTS] = {0}, b2_low[CUTS] = {0};
    for (int k = degree; k >= 0; k--) {
        for (int i = 0; i < CUTS && (k == degree || k == 0); i++) {
            factor[i] = k > 0 ? 2 * x[i].hi : x[i].hi, low[i] = k > 0 ? 2 * x[i].lo : x[i].lo;
            const wide halves = split(factor[i]);
            upper[i] = halves.hi, lower[i] = halves.lo;
        }
        for (int i = 0; i < CUTS; i++) {
            const double product = factor[i] * b1[i];
            const wide b = split(b1[i]);
            const double off = ((upper[i] * b.hi - product) + (upper[i] * b.lo + lower[i] * b.hi)) + lower[i] * b.lo;
            const double lost = off + (factor[i] * b1_low[i] + low[i] * b1[i]);
            const wide s = wide_sum(product, -b2[i]), t = wide_sum(s.hi, c[k]);
            const wide next = wide_sum(t.hi, (s.lo + t.lo) + (lost - b2_low[i]));
            b2[i] = b1[i], b2_low[i] = b1_low[i];
            b1[i] = next.hi, b1_low[i] = next.lo;
        }
    }
    for (int i = 0; i < CUTS; i++) values[i] = b1[i] + b1_low[i];
}

double roots_cell_cut(const double *coefficients, int degree, double at, double half, roots_cell *cell)
{
    double values[CUTS], tail = 0;
    wide x[CUTS];
    for (int k = 0; k < CUTS; k++) {
        const wide tau = wide_sum(at, 2 * half * roots_point(k, ROOTS_CELL_DEGREE));
        x[k] = wide_sum(2 * tau.hi, -1);
        x[k] = wide_sum(x[k].hi, x[k].lo + 2 * tau.lo);
    }
    wide_values(coefficients, degree, x, values);
    cell->at = at;
    cell->half = half;
    cell->degree = ROOTS_CELL_DEGREE;
    roots_transform(values, ROOTS_CELL_DEGREE, cell->c);
    for (int k = ROOTS_CELL_DEGREE - 3; k <= ROOTS_CELL_DEGREE; k++)
        if (fabs(cell->c[k]) > tail) tail = fabs(cell->c[k]);
    return tail;
}
