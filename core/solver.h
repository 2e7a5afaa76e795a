/* Linear systems of implicit methods: (I - ax ⊗ da/dx - av ⊗ da/dv) z = r, by the sparsity pattern of the problem.
 *
 * Pattern -> order of the unknowns (the given one if its band is narrow, else reverse Cuthill-McKee) -> colours of
 * columns -> one directional derivative for each colour -> band matrix, LU with partial pivoting. Diagonal systems are
 * solved by divisions, so a million damped masses cost O(N).
 */
#ifndef CORE_SOLVER_H
#define CORE_SOLVER_H

#include "core/system.h"

enum { SOLVER_BAND_BYTES_MAX = 256 << 20 }; /* a larger band matrix is refused: MOTUS_LIMIT */

typedef struct solver solver;

/* Creates a solver for the equations of `stages` stages at once. use_x, use_v: which derivatives occur. constant: the
 * derivatives never change. stride: from one stage to the next in r. */
motus_status solver_create(const problem *, int stages, bool use_x, bool use_v, bool constant, size_t stride,
                           const motus_allocator *, solver **, motus_error *);
void solver_destroy(solver *);
/* Forgets derivatives and factors, because the parameters have changed or another motion begins. */
void solver_forget(solver *);
/* Returns the shift of y for a difference quotient, where numbers have the size `size`. A linear dependence has no
 * truncation error, so its shift is as large as the numbers. */
double solver_shift(double y, double size, bool linear);
/* Computes the derivatives and factors the matrix. Returns 0, or 1 where the callback failed, or 2 where the matrix is
 * singular. Adds the evaluations that difference quotients cost to *evaluations. */
int solver_factor(solver *, const double *ax, const double *av, double t, double *x, double *v, int64_t *evaluations);
/* Returns the factored matrix, by which solver_back divides, if it is diagonal and constant; else NULL. */
const double *solver_diagonal(const solver *);
void solver_back(solver *, double *r);                                     /* r becomes the solution z */
void solver_apply(const solver *, double c, const double *y, double *out); /* out = (I + c da/dv) y */

/* A sparse matrix by columns: column c has the rows row[start[c]] … row[start[c+1]-1], ascending. */
typedef struct sparse {
    size_t columns, *start;
    uint32_t *row;
    double *value;
    uint32_t *colour_column; /* columns, colour by colour */
    size_t *colour_start;    /* colour k is at [colour_start[k], colour_start[k+1]) of colour_column */
    size_t colours;
} sparse;

/* solver_order.c. Reads the sparsity pattern of a problem. False: no memory or, with *broken, an entry lies outside the
 * matrix. */
bool solver_pattern(const problem *, bool in_v, sparse *, const motus_allocator *, bool *broken);
/* Chooses the order of the unknowns for the union of both patterns: unknown k comes at place[k]. Tells the bandwidths
 * in this order. False: no memory. */
bool solver_order(size_t n, const sparse *x, const sparse *v, uint32_t *place, size_t *lower, size_t *upper,
                  const motus_allocator *);
bool solver_colour(size_t rows, sparse *, const motus_allocator *);
void solver_release(sparse *, const motus_allocator *);

/* solver_band.c. Entry (i, j) is at matrix[j * (2 lower + upper + 1) + lower + upper + i - j]. */
typedef struct solver_band {
    /* false: singular */
    bool (*factor)(size_t n, size_t lower, size_t upper, double *matrix, uint32_t *pivot);
    void (*back)(size_t n, size_t lower, size_t upper, const double *matrix, const uint32_t *pivot, double *b);
} solver_band;
extern const solver_band solver_band_base;
#if defined __x86_64__
extern const solver_band solver_band_avx2, solver_band_avx512;
#endif
const solver_band *solver_best_band(void); /* the fastest for this processor */

#endif
