/* Linear systems of implicit methods: derivatives by colours, the band matrix of all stages, and its solution.
 *
 * Invariant: a matrix that is known to be constant is computed once; a factorisation is reused only for the matrix of
 * which it was made.
 */
#include "core/solver.h"

#include <float.h>
#include <math.h>
#include <string.h>

struct solver {
    const problem *problem;
    const solver_band *band;
    motus_allocator allocator;
    size_t n, stride, lower, upper; /* n: stages × nv; lower, upper: bandwidths of the matrix of all stages */
    int stages;
    bool use_x, use_v, constant;
    bool derived, factored;
    sparse x, v; /* da/dx, da/dv */
    uint32_t *place, *pivot;
    double *matrix, *b;                         /* matrix: band storage, or one diagonal */
    double *direction, *image, *base, *shifted; /* scratch: nv each; the last two for difference quotients only */
    double *ax, *av;                            /* of the factorisation at hand: stages × stages each */
};

const solver_band *solver_best_band(void)
{
#if defined __x86_64__ && !defined ONE_COPY && !defined ONE_ISA
    __builtin_cpu_init();
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512dq"))
        return &solver_band_avx512;
    return avx2 ? &solver_band_avx2 : &solver_band_base;
#else
    return &solver_band_base;
#endif
}

void solver_forget(solver *s) { s->derived = s->factored = false; }

static bool diagonal(const solver *s) { return s->lower + s->upper == 0; }

void solver_destroy(solver *s)
{
    if (!s) return;
    const motus_allocator allocator = s->allocator;
    solver_release(&s->x, &allocator);
    solver_release(&s->v, &allocator);
    give(&allocator, s->place);
    give(&allocator, s->pivot);
    give(&allocator, s->matrix);
    give(&allocator, s->b);
    give(&allocator, s->direction);
    give(&allocator, s->base);
    give(&allocator, s->ax);
    give(&allocator, s);
}

static motus_status too_wide(double bytes, motus_error *err)
{
    char text[DECIMAL_MAX];
    fail(err, MOTUS_LIMIT,
         "the implicit equations couple so many numbers that their matrix would take %s MiB; the bound is %d MiB",
         decimal(ceil(bytes / (1 << 20)), text), SOLVER_BAND_BYTES_MAX >> 20);
    hint(
        err,
        "an explicit method needs no matrix: velocity-verlet or blanes-moan4 for forces without velocity, rk4 for any");
    return MOTUS_LIMIT;
}

static motus_status no_memory(motus_error *err)
{
    return fail(err, MOTUS_MEMORY, "out of memory for the matrix of the implicit equations");
}

/* Finds the patterns, the order of the unknowns and the bandwidths. Refuses a matrix that is too large before it takes
 * memory for it. */
static motus_status structure(solver *s, motus_error *err)
{
    const problem *p = s->problem;
    const motus_allocator *allocator = &s->allocator;
    const double nv = (double)p->nv, stages = s->stages;
    if (!p->pattern && nv * stages * nv * stages * 3 * 8 > SOLVER_BAND_BYTES_MAX)
        return too_wide(nv * stages * nv * stages * 24, err);
    if (nv * stages > (double)UINT32_MAX) return too_wide(nv * stages * 8, err);
    bool broken = false;
    if ((s->use_x && !solver_pattern(p, false, &s->x, allocator, &broken)) ||
        (s->use_v && !solver_pattern(p, true, &s->v, allocator, &broken)))
        return broken ? fail(err, MOTUS_ARGUMENT, "the pattern of the derivative names an entry outside of it")
                      : no_memory(err);
    if (p->prepare && ((s->use_x && !p->prepare(p->ctx, false)) || (s->use_v && !p->prepare(p->ctx, true))))
        return no_memory(err);
    s->place = take(allocator, p->nv, sizeof *s->place);
    if (!s->place || !solver_order(p->nv, s->use_x ? &s->x : NULL, s->use_v ? &s->v : NULL, s->place, &s->lower,
                                   &s->upper, allocator))
        return no_memory(err);
    s->n = p->nv * (size_t)s->stages;
    s->lower = s->lower * (size_t)s->stages + (size_t)s->stages - 1; /* stages of one unknown are neighbours */
    s->upper = s->upper * (size_t)s->stages + (size_t)s->stages - 1;
    const double bytes = (double)s->n * (2 * (double)s->lower + (double)s->upper + 1) * sizeof(double);
    return bytes > SOLVER_BAND_BYTES_MAX ? too_wide(bytes, err) : MOTUS_OK;
}

motus_status solver_create(const problem *p, int stages, bool use_x, bool use_v, bool constant, size_t stride,
                           const motus_allocator *allocator, solver **out, motus_error *err)
{
    solver *s = take(allocator, 1, sizeof *s);
    if (!s) return no_memory(err);
    *s = (solver){.problem = p,
                  .band = solver_best_band(),
                  .stages = stages,
                  .use_x = use_x,
                  .use_v = use_v,
                  .constant = constant,
                  .stride = stride};
    if (allocator) s->allocator = *allocator;
    motus_status status = structure(s, err);
    if (!status) {
        const size_t height = diagonal(s) ? 1 : 2 * s->lower + s->upper + 1, nv = p->nv;
        bool ok =
            (!use_x || solver_colour(nv, &s->x, &s->allocator)) && (!use_v || solver_colour(nv, &s->v, &s->allocator));
        s->matrix = take(&s->allocator, s->n * height, sizeof *s->matrix);
        s->pivot = take(&s->allocator, s->n, sizeof *s->pivot);
        s->b = take(&s->allocator, s->n, sizeof *s->b);
        s->direction = take(&s->allocator, nv, 2 * sizeof *s->direction);
        if (s->direction) s->image = s->direction + nv;
        if (!p->jvp) {
            s->base = take(&s->allocator, nv, 2 * sizeof *s->base);
            if (s->base) s->shifted = s->base + nv;
        }
        const size_t coupled = (size_t)stages * (size_t)stages;
        s->ax = take(&s->allocator, 2 * coupled, sizeof *s->ax);
        if (s->ax) s->av = s->ax + coupled;
        ok = ok && s->matrix && s->pivot && s->b && s->direction && s->ax && (p->jvp || s->base);
        if (!ok) status = no_memory(err);
    }
    if (status) {
        solver_destroy(s);
        return status;
    }
    *out = s;
    return MOTUS_OK;
}

/* Derivatives ------------------------------------------------------------------------------------------------------ */

/* Computes the columns of one colour by the problem's own derivative: they share no row, so one product with J has them
 * all. */
static int direct(solver *s, bool in_v, const sparse *m, size_t colour, double t, double *x, double *v)
{
    const problem *p = s->problem;
    for (size_t i = m->colour_start[colour]; i < m->colour_start[colour + 1]; i++)
        s->direction[m->colour_column[i]] = 1;
    int bad = p->jvp(p->ctx, t, x, v, in_v ? NULL : s->direction, in_v ? s->direction : NULL, s->image);
    for (size_t i = m->colour_start[colour]; i < m->colour_start[colour + 1]; i++)
        s->direction[m->colour_column[i]] = 0;
    if (bad) return 1;
    for (size_t i = m->colour_start[colour]; i < m->colour_start[colour + 1]; i++) {
        const size_t c = m->colour_column[i];
        for (size_t e = m->start[c]; e < m->start[c + 1]; e++) m->value[e] = s->image[m->row[e]];
    }
    return 0;
}

double solver_shift(double y, double size, bool linear)
{
    return (linear ? 1 : sqrt(DBL_EPSILON)) * ldexp(1, ilogb(fabs(y) + size));
}

/* Computes the columns of one colour by a difference quotient. */
static int quotient(solver *s, bool in_v, const sparse *m, size_t colour, double t, double *x, double *v, double size)
{
    const problem *p = s->problem;
    const bool linear = in_v ? p->traits.linear_v : p->traits.affine;
    const double *y = in_v ? v : x;
    memcpy(s->shifted, y, (in_v ? p->nv : p->nx) * sizeof *y);
    for (size_t i = m->colour_start[colour]; i < m->colour_start[colour + 1]; i++) {
        const size_t c = m->colour_column[i];
        s->shifted[c] = y[c] + solver_shift(y[c], size, linear);
        s->direction[c] = s->shifted[c] - y[c];
    }
    int bad = p->accel(p->ctx, t, in_v ? x : s->shifted, in_v ? s->shifted : v, s->image);
    for (size_t i = m->colour_start[colour]; !bad && i < m->colour_start[colour + 1]; i++) {
        const size_t c = m->colour_column[i];
        for (size_t e = m->start[c]; e < m->start[c + 1]; e++)
            m->value[e] = (s->image[m->row[e]] - s->base[m->row[e]]) / s->direction[c];
    }
    for (size_t i = m->colour_start[colour]; i < m->colour_start[colour + 1]; i++)
        s->direction[m->colour_column[i]] = 0;
    return bad ? 1 : 0;
}

static int derive(solver *s, bool in_v, const sparse *m, double t, double *x, double *v, int64_t *evaluations)
{
    const problem *p = s->problem;
    double size = 0;
    for (size_t k = 0; !p->jvp && k < m->columns; k++) size = fmax(size, fabs((in_v ? v : x)[k]));
    if (size == 0 || !isfinite(size)) size = 1;
    for (size_t colour = 0; colour < m->colours; colour++) {
        int bad = p->jvp ? direct(s, in_v, m, colour, t, x, v) : quotient(s, in_v, m, colour, t, x, v, size);
        if (bad) return bad;
        if (!p->jvp) ++*evaluations;
    }
    return 0;
}

/* The matrix ------------------------------------------------------------------------------------------------------- */

static void add(solver *s, const sparse *m, const double *a)
{
    const size_t height = 2 * s->lower + s->upper + 1, middle = s->lower + s->upper, stages = (size_t)s->stages;
    for (size_t c = 0; c < m->columns; c++)
        for (size_t e = m->start[c]; e < m->start[c + 1]; e++) {
            const size_t row = s->place[m->row[e]] * stages, column = s->place[c] * stages;
            if (diagonal(s)) {
                s->matrix[row] -= a[0] * m->value[e];
                continue;
            }
            for (size_t i = 0; i < stages; i++)
                for (size_t j = 0; j < stages; j++)
                    s->matrix[(column + j) * height + middle + row + i - column - j] -= a[i * stages + j] * m->value[e];
        }
}

static bool assemble(solver *s, const double *ax, const double *av)
{
    const size_t height = diagonal(s) ? 1 : 2 * s->lower + s->upper + 1, middle = diagonal(s) ? 0 : s->lower + s->upper;
    memset(s->matrix, 0, s->n * height * sizeof *s->matrix);
    for (size_t k = 0; k < s->n; k++) s->matrix[k * height + middle] = 1;
    if (s->use_x) add(s, &s->x, ax);
    if (s->use_v) add(s, &s->v, av);
    if (!diagonal(s)) return s->band->factor(s->n, s->lower, s->upper, s->matrix, s->pivot);
    bool regular = true;
    for (size_t k = 0; k < s->n; k++) regular = regular && s->matrix[k] != 0;
    return regular;
}

int solver_factor(solver *s, const double *ax, const double *av, double t, double *x, double *v, int64_t *evaluations)
{
    const size_t bytes = (size_t)s->stages * (size_t)s->stages * sizeof *ax;
    if (s->constant && s->factored && !memcmp(s->ax, ax, bytes) && !memcmp(s->av, av, bytes)) return 0;
    s->factored = false;
    if (!s->constant || !s->derived) {
        const problem *p = s->problem;
        if (p->refresh) p->refresh(p->ctx, t, x, v);
        if (!p->jvp && (s->use_x || s->use_v)) {
            ++*evaluations;
            if (p->accel(p->ctx, t, x, v, s->base)) return 1;
        }
        if (s->use_x && derive(s, false, &s->x, t, x, v, evaluations)) return 1;
        if (s->use_v && derive(s, true, &s->v, t, x, v, evaluations)) return 1;
        s->derived = true;
    }
    if (!assemble(s, ax, av)) return 2;
    memcpy(s->ax, ax, bytes);
    memcpy(s->av, av, bytes);
    s->factored = true;
    return 0;
}

const double *solver_diagonal(const solver *s) { return s->constant && s->factored && diagonal(s) ? s->matrix : NULL; }

void solver_back(solver *s, double *r)
{
    const size_t stages = (size_t)s->stages, nv = s->problem->nv;
    if (diagonal(s)) {
        for (size_t k = 0; k < nv; k++) r[k] /= s->matrix[k];
        return;
    }
    for (size_t k = 0; k < nv; k++)
        for (size_t i = 0; i < stages; i++) s->b[s->place[k] * stages + i] = r[i * s->stride + k];
    s->band->back(s->n, s->lower, s->upper, s->matrix, s->pivot, s->b);
    for (size_t k = 0; k < nv; k++)
        for (size_t i = 0; i < stages; i++) r[i * s->stride + k] = s->b[s->place[k] * stages + i];
}

void solver_apply(const solver *s, double c, const double *y, double *out)
{
    const sparse *m = &s->v;
    memcpy(out, y, s->problem->nv * sizeof *out);
    if (!s->use_v) return;
    /* the diagonal first: (1 + c j) y is one product, as in the formula */
    for (size_t k = 0; k < m->columns; k++)
        for (size_t e = m->start[k]; e < m->start[k + 1]; e++)
            if (m->row[e] == k) out[k] = (1 + c * m->value[e]) * y[k];
    for (size_t k = 0; k < m->columns; k++)
        for (size_t e = m->start[k]; e < m->start[k + 1]; e++)
            if (m->row[e] != k) out[m->row[e]] += c * m->value[e] * y[k];
}
