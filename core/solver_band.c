/* Band matrices: LU with partial pivoting, column by column.
 *
 * Invariant: pivoting moves rows by at most `lower` places, so U needs `lower` diagonals more than the matrix; callers
 * leave them zero. The file is compiled once for each instruction set, as core/stepper_body.c is; all of them give
 * equal bits.
 */
#include "core/solver.h"

#include <math.h>

#ifndef ISA
#error "compile with -DISA=base, avx2 or avx512"
#endif
#define PASTE(a, b) a##b
#define NAMED(isa) PASTE(solver_band_, isa)

static bool band_factor(size_t n, size_t lower, size_t upper, double *matrix, uint32_t *pivot)
{
    const size_t height = 2 * lower + upper + 1, middle = lower + upper;
    size_t reach = 0; /* last column that the rows pivoted so far reach into */
    for (size_t j = 0; j < n; j++) {
        double *column = matrix + j * height + middle; /* column[i - j] */
        size_t below = n - 1 - j < lower ? n - 1 - j : lower, best = 0;
        for (size_t i = 1; i <= below; i++)
            if (fabs(column[i]) > fabs(column[best])) best = i;
        pivot[j] = (uint32_t)(j + best);
        if (column[best] == 0 || !isfinite(column[best])) return false;
        size_t end = j + best + upper < n - 1 ? j + best + upper : n - 1;
        if (end > reach) reach = end;
        if (best)
            for (size_t c = j; c <= reach; c++) {
                double *at = matrix + c * height + middle + j - c, keep = at[0];
                at[0] = at[best];
                at[best] = keep;
            }
        const double inverse = 1 / column[0];
        for (size_t i = 1; i <= below; i++) column[i] *= inverse;
        for (size_t c = j + 1; c <= reach; c++) {
            double *at = matrix + c * height + middle + j - c;
            const double factor = -at[0];
            if (factor == 0) continue;
            for (size_t i = 1; i <= below; i++) at[i] = fma(factor, column[i], at[i]);
        }
    }
    return true;
}

static void band_back(size_t n, size_t lower, size_t upper, const double *matrix, const uint32_t *pivot, double *b)
{
    const size_t height = 2 * lower + upper + 1, middle = lower + upper;
    for (size_t j = 0; j < n; j++) {
        const double *column = matrix + j * height + middle;
        const size_t below = n - 1 - j < lower ? n - 1 - j : lower, p = pivot[j];
        const double value = b[p];
        b[p] = b[j];
        b[j] = value;
        for (size_t i = 1; i <= below; i++) b[j + i] = fma(-value, column[i], b[j + i]);
    }
    for (size_t j = n; j-- > 0;) {
        const double *column = matrix + j * height + middle;
        const size_t above = j < middle ? j : middle;
        const double value = b[j] / column[0];
        b[j] = value;
        for (size_t i = 1; i <= above; i++) b[j - i] = fma(-value, *(column - i), b[j - i]);
    }
}

const solver_band NAMED(ISA) = {band_factor, band_back};
