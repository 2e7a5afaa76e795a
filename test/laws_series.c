/* LAWS OF SERIES: a step of the Taylor row is made of the coefficients up to its order, and of no more. Slopes of runs
 * and of dense output are in laws_order.c and laws_dense.c, over the problems of this file; series_test.c proves the
 * recurrences one by one.
 */
#include "core/rows.h"
#include "test/laws.h"
#include "test/series_quad.h"

#include <math.h>
#include <stdio.h>

#define POLE_AT Q(2.5)

/* A force as a list of operations: name, operation, operands; of LOAD and CONST a number. */
typedef struct line {
    operation op;
    int a, b, c;
    quad number; /* LOAD: the place in x, then v */
} line;

/* clang-format off */
#define EVERY_LINES(X)                                                                                               \
    X(none, CONST, none, none, none, 0) X(quarter, CONST, none, none, none, 0.25)                                    \
    X(half, CONST, none, none, none, 0.5) X(two, CONST, none, none, none, 2) X(five, CONST, none, none, none, 5)     \
    X(twelve, CONST, none, none, none, 12) X(inverse, CONST, none, none, none, -1.5)                                 \
    X(power, CONST, none, none, none, 0.75) X(x, LOAD, none, none, none, 0) X(y, LOAD, none, none, none, 1)          \
    X(u, LOAD, none, none, none, 2) X(w, LOAD, none, none, none, 3) X(s, LOAD, none, none, none, 4)                  \
    X(t, TIME, none, none, none, 0)                                                                                  \
    X(left, NEG, x, none, none, 0) X(down, NEG, y, none, none, 0) X(yy, MUL, y, y, none, 0)                          \
    X(rr, FMA, x, x, yy, 0) X(base, ADD, rr, two, none, 0) X(later, ADD, y, t, none, 0)                              \
    X(p, MUL, quarter, x, none, 0) X(q, MUL, quarter, y, none, 0) X(r, MUL, u, half, none, 0)                        \
    X(attraction, POW, base, inverse, none, 0) X(dent, POW, base, power, none, 0)                                    \
    X(sine, SIN, later, none, none, 0) X(cosine, COS, later, none, none, 0) X(tangent, TAN, q, none, none, 0)        \
    X(arcsine, ASIN, p, none, none, 0) X(arccosine, ACOS, q, none, none, 0) X(arctangent, ATAN, r, none, none, 0)    \
    X(angle, ATAN2, x, base, none, 0) X(sh, SINH, p, none, none, 0) X(ch, COSH, q, none, none, 0)                    \
    X(th, TANH, p, none, none, 0) X(e, EXP, q, none, none, 0) X(l, LOG, base, none, none, 0)                         \
    X(root, SQRT, base, none, none, 0) X(third, CBRT, base, none, none, 0) X(length, HYPOT, u, two, none, 0)         \
    X(bell, ERF, s, none, none, 0) X(ratio, DIV, w, base, none, 0) X(far, SUB, x, five, none, 0)                     \
    X(distance, ABS, far, none, none, 0) X(least, MIN, y, five, none, 0) X(most, MAX, down, far, none, 0)            \
    X(beyond, ADD, twelve, x, none, 0) X(rest, MOD, beyond, five, none, 0) X(before, GT, five, x, none, 0)           \
    X(choice, SELECT, before, ratio, none, 0) X(turn, FMS, x, w, s, 0) X(back, FNMA, y, u, s, 0)                     \
    X(f1, ADD, sine, tangent, none, 0) X(f2, ADD, f1, arcsine, none, 0) X(f3, ADD, f2, angle, none, 0)               \
    X(f4, ADD, f3, sh, none, 0) X(f5, ADD, f4, e, none, 0) X(f6, ADD, f5, root, none, 0)                             \
    X(f7, ADD, f6, bell, none, 0) X(f8, ADD, f7, turn, none, 0) X(f9, SUB, f8, distance, none, 0)                    \
    X(f, ADD, f9, attraction, none, 0)                                                                               \
    X(g1, ADD, cosine, arccosine, none, 0) X(g2, ADD, g1, arctangent, none, 0) X(g3, SUB, g2, ch, none, 0)           \
    X(g4, ADD, g3, th, none, 0) X(g5, ADD, g4, l, none, 0) X(g6, SUB, g5, third, none, 0)                            \
    X(g7, SUB, g6, length, none, 0) X(g8, ADD, g7, choice, none, 0) X(g9, ADD, g8, back, none, 0)                    \
    X(g10, ADD, g9, least, none, 0) X(g11, SUB, g10, most, none, 0) X(g, SUB, g11, dent, none, 0)                    \
    X(h1, SUB, rest, two, none, 0) X(h, SUB, h1, s, none, 0)                                                         \
    X(right, FMA, quarter, f, left, 0) X(up, FMA, quarter, g, down, 0) X(along, MUL, half, h, none, 0)
/* clang-format on */
#define NAME(name, ...) EVERY_##name,
enum { EVERY_LINES(NAME) EVERY_COUNT };
#define LINE(name, op, a, b, c, number) {OP_##op, EVERY_##a, EVERY_##b, EVERY_##c, number},
static const line every[EVERY_COUNT] = {EVERY_LINES(LINE)};
static const int every_ends[] = {EVERY_right, EVERY_up, EVERY_along};

static void every_accel(quad t, const quad *x, const quad *v, quad *a)
{
    quad value[EVERY_COUNT];
    for (int i = 0; i < EVERY_COUNT; i++) {
        const line *l = &every[i];
        const int place = (int)l->number;
        value[i] = l->op == OP_CONST  ? l->number
                   : l->op == OP_TIME ? t
                   : l->op == OP_LOAD ? (place < 2 ? x[place] : v[place - 2])
                                      : series_quad_value(l->op, value[l->a], value[l->b], value[l->c]);
    }
    for (int k = 0; k < 3; k++) a[k] = value[every_ends[k]];
}

static void every_series(int length, int n, quad t, const quad *x, const quad *v, quad *a, quad *kept)
{
    series_quad value[EVERY_COUNT];
    for (int i = 0; i < EVERY_COUNT; i++) {
        const line *l = &every[i];
        const int place = (int)l->number;
        quad *r = kept + i * SERIES_QUAD_HELPERS * length;
        value[i] = (series_quad){r, SERIES_QUAD_ALL};
        if (l->op == OP_LOAD) {
            value[i].at = place < 2 ? x + place * length : v + (place - 2) * length;
        } else if (l->op == OP_CONST || l->op == OP_TIME) {
            value[i].last = l->op == OP_TIME;
            if (n <= 1) r[n] = n ? 1 : l->op == OP_TIME ? t : l->number;
        } else {
            if (!series_quad_moves(l->op)) value[i].last = 0;
            if (n <= value[i].last) r[n] = series_quad_next(l->op, r, length, value[l->a], value[l->b], value[l->c], n);
        }
    }
    for (int k = 0; k < 3; k++) a[k] = n <= value[every_ends[k]].last ? value[every_ends[k]].at[n] : 0;
}

static void pole_accel(quad t, const quad *x, const quad *v, quad *a)
{
    (void)t, (void)v;
    a[0] = 6 * x[0] * x[0];
    a[1] = x[0];
}

static void pole_series(int length, int n, quad t, const quad *x, const quad *v, quad *a, quad *kept)
{
    (void)t, (void)v;
    const series_quad position = {x, SERIES_QUAD_ALL};
    a[0] = 6 * series_quad_next(OP_MUL, kept, length, position, position, position, n);
    a[1] = x[n];
}

const quad_problem quad_expanded[EXPANDED] = {
    [EVERYTHING] = {"every operation", 2, 3, .velocity = true, .time = true, .x = {Q(0.12), Q(-0.25)},
                    .v = {Q(0.42), Q(0.1), Q(0.3)}, .accel = every_accel, .series = every_series,
                    .keeps = EVERY_COUNT * SERIES_QUAD_HELPERS},
    [POLE] = {"a double pole", 1, 2, .x = {Q(0.16)}, .v = {Q(0.128), Q(0.4)}, .accel = pole_accel,
              .series = pole_series, .keeps = 1},
};

static void census(void)
{
    int missing = 0, count = 0;
    for (operation op = 0; op < OPERATIONS; op++) {
        int i = 0;
        while (i < EVERY_COUNT && every[i].op != op) i++;
        count += series_quad_moves(op);
        missing += series_quad_moves(op) && i == EVERY_COUNT;
    }
    judge(count > 0 && missing == 0, "series", "every recurrence is in a force", "%d operations, %d missing", count,
          missing);
}

static quad_state start_of(const quad_problem *p)
{
    quad_state s = {0};
    for (size_t k = 0; k < p->nx; k++) s.x[k] = p->x[k];
    for (size_t k = 0; k < p->nv; k++) s.v[k] = p->v[k];
    return s;
}

/* One step of h from the start. */
static quad_state step_of(method m, int order, const quad_problem *p, quad h)
{
    quad_state s = start_of(p);
    if (quad_expand(m, order, p, 0, h, 1, &s).bad) s.x[0] = NAN;
    return s;
}

static quad largest(const quad_problem *p, const quad_state *s)
{
    const quad_state none = {0};
    return quad_distance(p, s, &none);
}

/* Of POLE the sums of the first `order` powers of x, and of one fewer of v and s, after a step of h. */
static quad_state sums(int order, quad h)
{
    const quad part = h / POLE_AT;
    quad_state s = {0};
    for (int n = order; n >= 0; n--) {
        s.x[0] = s.x[0] * part + (n + 1);
        if (n < order) s.v[0] = s.v[0] * part + (n + 1) * (n + 2), s.v[1] = s.v[1] * part + 1;
    }
    s.x[0] /= POLE_AT * POLE_AT, s.v[0] /= POLE_AT * POLE_AT * POLE_AT, s.v[1] /= POLE_AT;
    return s;
}

/* A step of an order is the sum up to it, to rounding, and far from that of the next order. All terms are positive.
 * Coefficient n is a sum of products of those before it, so that its roundings are at most n (n + 8)/2; the sum adds
 * one for each power. */
static void partial_sums(method m)
{
    const quad h = POLE_AT / 4;
    int exact = 0, apart = 0, count = 0;
    for (int order = 4; order <= SERIES_ORDER_MOST; order++, count++) {
        const quad_state is = step_of(m, order, &quad_expanded[POLE], h), due = sums(order, h),
                         next = sums(order + 1, h);
        const quad bound = (order * (order + 8) / 2 + order + 8) * QUAD_EPSILON / 2;
        exact += quad_abs(is.x[0] / due.x[0] - 1) <= bound && quad_abs(is.v[0] / due.v[0] - 1) <= bound &&
                 quad_abs(is.v[1] / due.v[1] - 1) <= bound;
        apart += next.x[0] / due.x[0] - 1 > 2 * bound && next.v[0] / due.v[0] - 1 > 2 * bound &&
                 next.v[1] / due.v[1] - 1 > 2 * bound;
    }
    judge(exact == count && apart == count, row_card(m)->name, "a step is the sum of its order",
          "%d of %d orders, %d told from the next", exact, count, apart);
}

/* The error of one step against the motion in closed form, whose terms have one sign. The margin is the change of the
 * slope from one halving to the next, as in laws_order.c. */
static void local_slope(method m, int order)
{
    const quad_problem *p = &quad_expanded[POLE];
    double last = NAN, margin = 0, before = NAN, log = NAN;
    bool close = false;
    for (quad h = POLE_AT / 4;; h /= 2) {
        const quad part = h / POLE_AT, left = POLE_AT - h;
        const quad_state is = step_of(m, order + 1, p, h), /* velocities end one power before positions */
            due = {.x = {1 / (left * left)}, .v = {2 / (left * left * left), 1 / left}};
        const quad error = quad_distance(p, &is, &due);
        /* roundings of the step and of the motion, as above, of which a hundredth part changes no slope */
        if (!(error > 100 * (order + 8) * (order + 8) * QUAD_EPSILON * largest(p, &due)) || part < Q(1e-3)) break;
        const double now = log - quad_log2(error);
        log = quad_log2(error);
        before = last, last = now;
        margin = fmin(0.5, 1.5 * fabs(last - before) + 0.02);
        close = fabs(last - (order + 1)) <= margin;
    }
    char name[64];
    snprintf(name, sizeof name, "%s, order %d", row_card(m)->name, order);
    judge(close, name, "error of a step", "observed %.3f, due %d + 1, margin %.3f", last, order, margin);
}

/* A step of the highest order reaches the motion, which the extrapolated midpoint rule knows, to rounding, which
 * is less than the powers above 30. In each piece the rule rounds the state twice in each of its 18
 * substeps at most, and its extrapolation multiplies that by the sum of the sizes of its weights. What the step leaves
 * out is smaller than its last terms. */
static void reaches(method m)
{
    enum { PIECES = 12, COLUMNS = 9 };
    const quad_problem *p = &quad_expanded[EVERYTHING];
    const quad h = Q(0.375);
    quad weights = 0;
    for (int j = 1; j <= COLUMNS; j++) {
        quad weight = 1;
        for (int i = 1; i <= COLUMNS; i++)
            if (i != j) weight *= (quad)(j * j) / (j * j - i * i);
        weights += quad_abs(weight);
    }
    quad_state due = start_of(p), is = step_of(m, SERIES_ORDER_MOST, p, h),
               shorter = step_of(m, SERIES_ORDER_MOST - 4, p, h), order30 = step_of(m, 30, p, h);
    quad_reference_in(p, PIECES, 0, h, &due);
    const quad size = largest(p, &due),
               bound = PIECES * weights * 2 * 2 * COLUMNS * QUAD_EPSILON / 2 * size + quad_distance(p, &is, &shorter);
    const quad off = quad_distance(p, &is, &due), terms = quad_distance(p, &is, &order30);
    judge(off <= bound && bound < terms, row_card(m)->name, "reaches the motion on every operation",
          "off by %.1e, bound %.1e, powers above 30 are %.1e", (double)off, (double)bound, (double)terms);
}

void laws_of_series(void)
{
    census();
    for (method m = 0; m < row_count(); m++) {
        if (!methods_table[m].expands) continue;
        partial_sums(m);
        reaches(m);
        for (int order = 4; order <= 30; order++) local_slope(m, order);
    }
}
