/* A piece of a polynomial: sum c_k T_k(x) on the cell x in [-1, 1], that is tau = at + half (1 + x).
 *
 * Invariant: coefficient k of a half depends on the coefficients k and above of the whole alone, so slopes keep their
 * relative precision however small cells become.
 */
#ifndef CORE_ROOTS_CELL_H
#define CORE_ROOTS_CELL_H

enum { ROOTS_CELL_DEGREE = 32 };

typedef struct roots_cell {
    double at, half;
    int degree;
    double c[ROOTS_CELL_DEGREE + 1];
} roots_cell;

/* Row k, column j: the coefficient of T_k(x) in T_j((x + 1) / 2), for 0 <= k <= j <= degree. */
typedef struct roots_halving {
    double row[ROOTS_CELL_DEGREE + 1][ROOTS_CELL_DEGREE + 1];
} roots_halving;

double roots_cell_tau(const roots_cell *, double x);
/* Returns p at x; *slope becomes dp/dx. */
double roots_cell_value(const roots_cell *, double x, double *slope);
/* Returns the sum of |c_k| over k >= 1. */
double roots_cell_rest(const roots_cell *);
void roots_cell_slope(const roots_cell *, roots_cell *slope);
/* Returns the x between x0 and x1 where p = level, or the nearer end if p - level does not change its sign. p0, p1: p
 * at x0, x1. */
double roots_cell_solve(const roots_cell *, double x0, double p0, double x1, double p1, double level);

/* Computes the rows, exactly in doubles up to degree 26, and beyond with an error of at most 2^-50. */
void roots_cell_halving(int degree, roots_halving *);
/* Halves a cell: writes its left half, and makes it its right half. */
void roots_cell_halve(const roots_halving *, roots_cell *cell, roots_cell *left);
/* Makes the cell [at, at + 2 half] of a polynomial of degree up to ROOTS_DEGREE_MOST, by interpolation in Chebyshev
 * points. Returns the size of the last coefficients: unless it is small, the cell is too long. */
double roots_cell_cut(const double *coefficients, int degree, double at, double half, roots_cell *);

/* Transforms values at Chebyshev points into coefficients, for roots_fit. Overwrites the values. */
void roots_transform(double *values, int degree, double *coefficients);

#endif
