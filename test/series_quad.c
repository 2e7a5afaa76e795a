/* The elementary functions and the recurrences of Taylor series in 113 bits; see series_quad.h. The functions are power
 * series of an eighth of the argument, whose sums are then doubled; inverse functions are the double nearest to them,
 * improved once with an error of third order. Arguments are of the size of 1.
 */
#include "test/series_quad.h"

#include <math.h>
#include <string.h>
#include "lang/base/functions.h"

static quad none_here(void) { return 0; }
static quad magnitude(quad x) { return x < 0 ? -x : x; }

/* The sum of terms from number `first` on, each `square` over two more factors times the term before. */
static quad terms(quad term, int first, quad square)
{
    quad sum = term;
    for (int k = first + 1; magnitude(term) > QUAD_EPSILON / 16 * magnitude(sum); k += 2)
        sum += term = term * square / (k * (k + 1));
    return sum;
}

typedef struct pair {
    quad s, c;
} pair;

/* sine and cosine (sign -1), or hyperbolic (1) */
static pair circle(quad x, int sign)
{
    const quad u = x / 8, square = sign * u * u;
    pair p = {terms(u, 1, square), terms(1, 0, square)};
    for (int k = 0; k < 3; k++) p = (pair){2 * p.s * p.c, 1 + 2 * sign * p.s * p.s};
    return p;
}

static quad quad_sin(quad x) { return circle(x, -1).s; }
static quad quad_cos(quad x) { return circle(x, -1).c; }
static quad quad_sinh(quad x) { return circle(x, 1).s; }
static quad quad_cosh(quad x) { return circle(x, 1).c; }
static quad quad_tan(quad x)
{
    const pair p = circle(x, -1);
    return p.s / p.c;
}
static quad quad_tanh(quad x)
{
    const pair p = circle(x, 1);
    return p.s / p.c;
}
static quad quad_exp(quad x)
{
    const pair p = circle(x < 0 ? -x : x, 1);
    return x < 0 ? 1 / (p.c + p.s) : p.c + p.s;
}
static quad quad_log(quad x)
{
    const quad y = (quad)log((double)x), e = quad_exp(y);
    return y + 2 * (x - e) / (x + e);
}
static quad quad_asin(quad x)
{
    const quad y = (quad)asin((double)x);
    const pair p = circle(y, -1);
    const quad d = (x - p.s) / p.c;
    return y + d + d * d * p.s / (2 * p.c);
}
static quad quad_acos(quad x)
{
    const quad y = (quad)acos((double)x);
    const pair p = circle(y, -1);
    const quad d = (p.c - x) / p.s;
    return y + d - d * d * p.c / (2 * p.s);
}
static quad quad_atan2(quad x, quad y)
{
    const quad angle = (quad)atan2((double)x, (double)y);
    const pair p = circle(angle, -1);
    return angle + (x * p.c - y * p.s) / (y * p.c + x * p.s);
}
static quad quad_atan(quad x) { return quad_atan2(x, 1); }
static quad quad_sqrt(quad x)
{
    const quad r = (quad)sqrt((double)x), square = r * r;
    return x == 0 ? r : r * (square + 3 * x) / (3 * square + x);
}
static quad quad_hypot(quad x, quad y) { return quad_sqrt(x * x + y * y); }
static quad quad_cbrt(quad x)
{
    const quad r = (quad)cbrt((double)x), cube = r * r * r;
    return x == 0 ? r : r * (cube + 2 * x) / (2 * cube + x);
}
static quad quad_pow(quad x, quad y) { return x > 0 ? quad_exp(y * quad_log(x)) : (quad)pow((double)x, (double)y); }
/* 2/sqrt(pi) with the digits that its recurrence has, so that both are the same function. */
static quad quad_erf(quad x)
{
    quad term = x, sum = x;
    for (int k = 1; magnitude(term) > QUAD_EPSILON / 16 * magnitude(sum); k++) {
        term *= -x * x / k;
        sum += term / (2 * k + 1);
    }
    return 1.1283791670955126 * sum;
}
static quad quad_find(quad x, quad table) { return (quad)operation_value(OP_FIND, (double)x, (double)table, 0); }
static quad quad_entry(quad k, quad table) { return (quad)operation_value(OP_ENTRY, (double)k, (double)table, 0); }
static quad quad_floor(quad x) { return (quad)floor((double)x); }
static quad quad_sign(quad x) { return (x > 0) - (x < 0); }
static quad quad_abs(quad x) { return magnitude(x); }
static quad quad_min(quad x, quad y) { return x < y ? x : y; }
static quad quad_max(quad x, quad y) { return x > y ? x : y; }
static quad quad_mod(quad x, quad y) { return x - y * quad_floor(x / y); }

#define NO_SERIES none_here()
#define PICK(where, a, b) ((where) ? (a) : (b))
#define SOME(where) (where)
#define real quad
#define coef quad
#define FMA(a, b, c) ((a) * (b) + (c))
#define SERIES_OF(f) quad_##f
#include "step/reciprocals.h"
#include "step/series.h"
#undef FMA

_Static_assert((int)SERIES_QUAD_ALL == (int)SERIES_ALL, "a series without end");

#define OP(id, arity, spelling, degree, nature, value, derivative, keeps, sums, recurrence)                       \
    static quad next_##id(quad *r, const int length, const series a, const series b, const series c, const int n) \
    {                                                                                                             \
        const quad *const in = SERIES_NONE;                                                                       \
        (void)in, (void)r, (void)length, (void)a, (void)b, (void)c, (void)n;                                      \
        return recurrence;                                                                                        \
    }
#define LEAF(...)
#include "lang/base/operations.def"
#undef OP

static const struct {
    const char *recurrence;
    quad (*next)(quad *r, int length, series a, series b, series c, int n);
} rows[OPERATIONS] = {
#define OP(id, arity, spelling, degree, nature, value, derivative, keeps, sums, recurrence) \
    [OP_##id] = {#recurrence, next_##id},
#define LEAF(...)
#include "lang/base/operations.def"
#undef OP
};

/* clang-format off */
#define OP(id, arity, spelling, degree, nature, value, derivative, keeps, sums, recurrence) case OP_##id: return value;
#define LEAF(...)
/* clang-format on */
quad series_quad_value(operation op, quad a, quad b, quad c)
{
    (void)a, (void)b, (void)c;
    switch (op) {
#define OF(f) quad_##f
#define FUSE(a, b, c) ((a) * (b) + (c))
#define WHEN(condition, a, b) ((condition) ? (a) : (b))
#include "lang/base/operations.def"
    default: return 0;
    }
}
#undef OP

const char *series_quad_text(operation op) { return rows[op].recurrence; }
bool series_quad_moves(operation op) { return rows[op].next && strcmp(rows[op].recurrence, "none_here()") != 0; }

quad series_quad_next(operation op, quad *r, int length, series_quad a, series_quad b, series_quad c, int n)
{
    if (n == 0 && operation_at(op)->keeps == 0) return series_quad_value(op, a.at[0], b.at[0], c.at[0]);
    return rows[op].next(r, length, SERIES(a.at, a.last), SERIES(b.at, b.last), SERIES(c.at, c.last), n);
}
