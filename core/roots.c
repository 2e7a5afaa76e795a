/* All roots on one step: cells are halved until a bound on p, p' or p'' says how p goes there.
 *
 * Invariant: the cells on the stack and what has been scanned cover [0, 1] without gaps; a cell is halved only where
 * neither its sign nor its slope nor its curvature is certain and it is not noise. Each half has at most about half the
 * variation, so the depth is bounded.
 */
#include "core/roots.h"
#include "core/roots_cell.h"
#include "core/roots_scan.h"

#include <math.h>
#include <string.h>

enum { DEPTH = 72 };
#define SHORTEST 0x1p-60 /* half of a cell that is not halved */
#define CUT 0x1p-51      /* last coefficients of a cell that is long enough, relative to sum |c_k| */

typedef struct finder {
    const double *c; /* scaled, and with the root at 0 divided out where g stands there */
    int degree;
    double size; /* sum |c_k| */
    bool stands;
    roots_scan scan;
    roots_halving halving;
    bool halves; /* halving is known */
    roots_cell stack[DEPTH];
    int depth;
} finder;

/* Bounds the error of values of cells. Term j of a coefficient of a half meets j + 1 roundings, which the matrices
 * enlarge. All levels together add up to 12, 18, 29 times sum (j + 1) |c_j| for degrees 8, 16, 32: the sum over levels
 * of the largest norm of products of the matrices. The values of a cell add one level. */
static double rounding(const double *c, int degree)
{
    const int local = degree < ROOTS_CELL_DEGREE ? degree : ROOTS_CELL_DEGREE;
    const double growth = local <= 8 ? 15 : local <= 16 ? 22 : 34;
    double sum = 0;
    for (int k = 1; k <= degree; k++) sum += ((k < local ? k : local) + 1) * fabs(c[k]);
    const double cut = degree > local ? 4 * CUT * (sum + fabs(c[0])) : 0;
    return 0x1p-53 * (2 * fabs(c[0]) + growth * sum) + cut;
}

/* Returns p at x = 1 or -1. */
static double end_sum(const double *c, int degree, int end)
{
    double even = 0, odd = 0;
    for (int k = degree - degree % 2; k >= 0; k -= 2) even += c[k];
    for (int k = degree - 1 + degree % 2; k > 0; k -= 2) odd += c[k];
    return even + end * odd;
}

static double end_value(const roots_cell *cell, int end) { return end_sum(cell->c, cell->degree, end); }

/* Returns dp/dtau at x = 1 or -1; T_k' is k^2 at 1. */
static double end_slope(const double *c, int degree, int end)
{
    double sum = 0;
    for (int k = degree; k > 0; k--) sum += 2.0 * k * k * (k % 2 ? c[k] : end * c[k]);
    return sum;
}

/* Makes p(0) = 0 in the first cell of a step that stands, with the relative precision of the other coefficients. */
static void stand(roots_cell *cell)
{
    cell->c[0] = 0;
    cell->c[0] = -end_value(cell, -1);
}

/* Scans the first cell of a step that stands if p leaves 0 monotonically in it or is noise. False: halve the cell. */
static bool told_first(finder *f, const roots_cell *cell, bool *room)
{
    roots_cell slope;
    roots_cell_slope(cell, &slope);
    const double steep = f->scan.steep * cell->half, rest = roots_cell_rest(&slope), mean = fabs(slope.c[0]);
    if (mean - rest > steep) {
        (void)roots_scan_start(&f->scan, 0, slope.c[0] / cell->half, 0);
        f->scan.tau = roots_cell_tau(cell, 1);
        f->scan.value = end_value(cell, 1);
        f->scan.way = f->scan.side;
        f->scan.top = f->scan.value, f->scan.top_tau = f->scan.tau;
        return true;
    }
    const bool noise = mean + rest <= 2 * steep && fabs(cell->c[0]) + roots_cell_rest(cell) <= 2 * f->scan.noise;
    if (!noise && cell->half > SHORTEST) return false;
    *room =
        roots_scan_start(&f->scan, 0, 0, 0) && roots_scan_piece(&f->scan, cell, -1, 1, end_value(cell, 1), 0, false);
    return true;
}

/* Scans a cell in which p' has one sign, or p'' has and p' changes its sign at most once. False: neither is certain. */
static bool told_by_slope(finder *f, const roots_cell *cell, bool *room)
{
    roots_cell slope, bend;
    roots_cell_slope(cell, &slope);
    const double mean = fabs(slope.c[0]), rest = roots_cell_rest(&slope), end = end_value(cell, 1);
    if (mean > rest) {
        const double least = mean - rest > mean / 4 ? mean - rest : 0;
        *room = roots_scan_piece(&f->scan, cell, -1, 1, end, least, false);
        return true;
    }
    roots_cell_slope(&slope, &bend);
    if (fabs(bend.c[0]) <= roots_cell_rest(&bend)) return false;
    const double s0 = end_value(&slope, -1), s1 = end_value(&slope, 1);
    if ((s0 < 0) != (s1 < 0)) {
        double ignored;
        const double x = roots_cell_solve(&slope, -1, s0, 1, s1, 0), p = roots_cell_value(cell, x, &ignored);
        *room = roots_scan_piece(&f->scan, cell, -1, x, p, 0, true) &&
                roots_scan_piece(&f->scan, cell, x, 1, end, 0, false);
    } else
        *room = roots_scan_piece(&f->scan, cell, -1, 1, end, 0, false);
    return true;
}

static bool told(finder *f, const roots_cell *cell, bool *room)
{
    if (f->stands && cell->at == 0) return told_first(f, cell, room);
    const double rest = roots_cell_rest(cell), noise = roots_scan_noise(&f->scan, cell->at), mean = fabs(cell->c[0]);
    const double far = f->scan.slack > f->scan.noise ? f->scan.slack : f->scan.noise;
    if (mean - rest <= far) {
        if (told_by_slope(f, cell, room)) return true;
        if (mean + rest > noise && rest > noise / 16 && cell->half > SHORTEST) return false;
    }
    *room = roots_scan_piece(&f->scan, cell, -1, 1, end_value(cell, 1), 0, false);
    return true;
}

/* Gives the cell on the stack's top coefficients of local degree, if it has only its place, as with a high degree.
 * False: the cell is too long for that. */
static bool expanded(finder *f, roots_cell *cell)
{
    if (cell->degree >= 0) return true;
    const double tail = roots_cell_cut(f->c, f->degree, cell->at, cell->half, cell);
    return tail <= CUT * f->size || cell->half < 0x1p-20;
}

static void halve(finder *f, bool known)
{
    roots_cell *cell = &f->stack[f->depth - 1], *left = &f->stack[f->depth++];
    if (known) {
        if (!f->halves) roots_cell_halving(cell->degree, &f->halving);
        f->halves = true;
        roots_cell_halve(&f->halving, cell, left);
        return;
    }
    left->at = cell->at;
    left->half = cell->half /= 2;
    cell->at += 2 * cell->half;
    cell->degree = left->degree = -1;
}

static bool scan_all(finder *f)
{
    for (int cells = 0; f->depth > 0; cells++) {
        roots_cell *cell = &f->stack[f->depth - 1];
        bool room = true, known = expanded(f, cell);
        if (known && f->stands && cell->at == 0) stand(cell);
        if (cells == ROOTS_CELLS_MOST || f->depth == DEPTH) {
            f->scan.found->reach = f->scan.inside ? f->scan.from : cell->at;
            return false;
        }
        if (known && told(f, cell, &room))
            f->depth--;
        else
            halve(f, known);
        if (!room) return false;
    }
    return true;
}

/* Scales coefficients whose sums or products could overflow or underflow by a power of two, 2^-exponent. */
static int scale(const double *coefficients, int degree, double *c)
{
    int exponent = 0;
    double largest = 0;
    for (int k = 0; k <= degree; k++) largest = fabs(coefficients[k]) > largest ? fabs(coefficients[k]) : largest;
    if (largest > 0x1p900 || largest < 0x1p-900) frexp(largest, &exponent);
    for (int k = 0; k <= degree; k++) c[k] = exponent ? ldexp(coefficients[k], -exponent) : coefficients[k];
    return exponent;
}

/* Prepares the search from scaled coefficients: divides out the root at 0 where g stands there. noise: of c, without
 * the rounding of the search. */
static void prepare(finder *f, double *c, int degree, int before, double noise, double *start)
{
    while (degree > 0 && c[degree] == 0) degree--;
    *start = end_sum(c, degree, -1);
    f->stands = before == 0;
    if (f->stands) {
        noise += fabs(*start);
        if (degree == 0) c[++degree] = 0;
        c[0] -= *start / 2;
        c[1] += *start / 2;
    }
    f->c = c;
    f->degree = degree;
    f->size = 0;
    for (int k = 0; k <= degree; k++) f->size += fabs(c[k]);

    const double square = (double)degree * degree, all = noise + rounding(c, degree);
    f->scan.found->noise = all;
    f->scan.noise = f->stands ? 2 * all : all;
    f->scan.steep = f->stands ? (2 * square + 1) * all : INFINITY;
    f->scan.doubt = (2 * square + 1) * all;

    roots_cell *whole = f->stack;
    f->depth = 1;
    f->halves = false;
    whole->at = 0;
    whole->half = 0.5;
    whole->degree = degree <= ROOTS_CELL_DEGREE ? degree : -1;
    if (whole->degree >= 0) memcpy(whole->c, c, (size_t)(degree + 1) * sizeof *c);
}

static bool sound(const double *c, int degree, double noise, double slack)
{
    if (degree < 0 || degree > ROOTS_DEGREE_MOST) return false;
    for (int k = 0; k <= degree; k++)
        if (!isfinite(c[k])) return false;
    return noise >= 0 && !isnan(slack);
}

roots_status roots_find(const double *coefficients, int degree, int before, double noise, double slack, roots_root *out,
                        size_t most, roots_found *found)
{
    *found = (roots_found){.reach = 1, .leaves = 1};
    if (!sound(coefficients, degree, noise, slack)) return ROOTS_NOT_FINITE;
    finder f;
    double c[ROOTS_DEGREE_MOST + 1], start;
    const int exponent = scale(coefficients, degree, c);
    f.scan.out = out;
    f.scan.most = most;
    f.scan.found = found;
    f.scan.slack = ldexp(slack, -exponent);
    prepare(&f, c, degree, before, ldexp(noise, -exponent), &start);

    bool room = true;
    if (before) room = roots_scan_start(&f.scan, before, end_slope(c, f.degree, -1), start);
    room = room && scan_all(&f) && roots_scan_end(&f.scan, end_slope(c, f.degree, 1));
    for (size_t i = 0; i < found->count; i++) out[i].value = ldexp(out[i].value, exponent);
    found->noise = ldexp(found->noise, exponent);
    return room ? ROOTS_COMPLETE : ROOTS_CUT;
}
