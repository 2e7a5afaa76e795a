/* Linear systems of implicit methods: (I - ax ⊗ da/dx - av ⊗ da/dv) z = r, by the sparsity pattern of the problem.
 *
 * Pattern -> order of the unknowns (the given one if its band is narrow, else reverse Cuthill-McKee) -> colours of
 * columns -> one directional derivative for each colour -> band matrix, LU with partial pivoting. Diagonal systems are
 * solved by divisions, so a million damped masses cost O(N).
 */
#ifndef CORE_SOLVER_H
#define CORE_SOLVER_H

#include "core/system.h"

enum { SOLVER_BAND_BYTES_MAX = 256 << 20 }; /* refused beyond: MOTUS_LIMIT */

typedef struct solver solver;

/* For `stages` equations at once; use_x, use_v: which derivatives occur. constant: they never change. stride: of the
 * stages in r. */
motus_status solver_create(const problem *, int stages, bool use_x, bool use_v, bool constant, size_t stride,
                           const motus_allocator *, solver **, motus_error *);
void solver_destroy(solver *);
/* Forgets derivatives and factors, because the parameters have changed or another motion begins. */
void solver_forget(solver *);
/* The shift of y for a difference quotient, where the numbers are as large as `size`. A linear dependence has no
 * truncation error, so there the shift is as large as the numbers. */
double solver_shift(double y, double size, bool linear);
/* 0; 1: the callback failed; 2: singular. *evaluations grows by what difference quotients cost. */
int solver_factor(solver *, const double *ax, const double *av, double t, double *x, double *v, int64_t *evaluations);
/* The matrix that was factored last, where it is diagonal and constant; else NULL. solver_back divides by it. */
const double *solver_diagonal(const solver *);
void solver_back(solver *, double *r);
void solver_apply(const solver *, double c, const double *y, double *out); /* out = (I + c da/dv) y */

/* The parts, each in a file of its own. Columns of a sparse matrix: rows row[start[c]] … row[start[c+1]-1] of column c,
 * ascending. */
typedef struct sparse {
    size_t columns, *start;
    uint32_t *row;
    double *value;
    uint32_t *colour_column; /* columns, colour by colour; */
    size_t *colour_start;    /*   colour k: [colour_start[k], colour_start[k+1]) */
    size_t colours;
} sparse;

/* solver_order.c. false: no memory, or (*broken) an entry outside the matrix. */
bool solver_pattern(const problem *, bool in_v, sparse *, const motus_allocator *, bool *broken);
/* place[k]: where unknown k comes in the order chosen for the union of both; lower, upper: the bandwidths there. */
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
const solver_band *solver_best_band(void); /* the fastest one here */

#endif
