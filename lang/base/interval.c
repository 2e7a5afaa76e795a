/* See interval.h. */
#include "lang/base/interval.h"

#include <math.h>

enum { ENTRIES_MOST = 4096 }; /* entries of a table that are looked at for one bound */

static double less(double a, double b) { return a < b ? a : b; }
static double more(double a, double b) { return a > b ? a : b; }

interval interval_hull(interval a, interval b) { return (interval){less(a.low, b.low), more(a.high, b.high)}; }
static interval truth(bool may, bool must) { return (interval){must, may || must}; }

static bool single(interval a) { return a.low == a.high; }
static bool meet(interval a, interval b) { return a.low <= b.high && b.low <= a.high; }

static double times(double a, double b) { return a == 0 || b == 0 ? 0 : a * b; } /* 0 times infinity is 0 */

static interval product(interval a, interval b)
{
    if (a.low >= 0 && b.low >= 0) return (interval){times(a.low, b.low), times(a.high, b.high)};
    const double p = times(a.low, b.low), q = times(a.low, b.high), r = times(a.high, b.low), s = times(a.high, b.high);
    return (interval){less(less(p, q), less(r, s)), more(more(p, q), more(r, s))};
}

interval interval_magnitude(interval a)
{
    if (a.low >= 0) return a;
    if (a.high <= 0) return (interval){-a.high, -a.low};
    return (interval){0, fmax(-a.low, a.high)};
}

static interval even(operation op, interval a)
{
    const interval m = interval_magnitude(a);
    return (interval){operation_value(op, m.low, 0, 0), operation_value(op, m.high, 0, 0)};
}

/* Returns whether a contains at + k period for an integer k. */
static bool passes(interval a, double at, double period)
{
    return floor((a.high - at) / period) > floor((a.low - at) / period) || a.low == at;
}

static const double half_turn = 3.14159265358979323846;

static interval wave(interval a, double top) /* 1 at top + 2πk, -1 between */
{
    if (!(a.high - a.low < 2 * half_turn)) return (interval){-1, 1};
    const double p = operation_value(OP_COS, a.low - top, 0, 0), q = operation_value(OP_COS, a.high - top, 0, 0);
    interval r = {fmin(p, q), fmax(p, q)};
    if (passes(a, top, 2 * half_turn)) r.high = 1;
    if (passes(a, top + half_turn, 2 * half_turn)) r.low = -1;
    return r;
}

static const interval anything = {-INFINITY, INFINITY};

static interval falling(operation op, interval a)
{
    return (interval){operation_value(op, a.high, 0, 0), operation_value(op, a.low, 0, 0)};
}

static interval rising(operation op, interval a)
{
    return (interval){operation_value(op, a.low, 0, 0), operation_value(op, a.high, 0, 0)};
}

static interval corners(operation op, interval a, interval b)
{
    interval r = {INFINITY, -INFINITY};
    for (int k = 0; k < 4; k++) {
        const double y = operation_value(op, k & 1 ? a.high : a.low, k & 2 ? b.high : b.low, 0);
        if (isnan(y)) return anything;
        r = interval_hull(r, (interval){y, y});
    }
    return r;
}

/* Bounds a power. 0 has powers with a positive exponent, a negative base those with an integer. */
static interval power(interval a, interval b)
{
    const bool whole = single(b) && b.low == floor(b.low), even = whole && b.low == 2 * floor(b.low / 2);
    const bool pole = a.low <= 0 && a.high >= 0 && !(b.low > 0);
    if (pole || (a.low < 0 && !whole)) return anything;
    return corners(OP_POW, even ? interval_magnitude(a) : a, b);
}

/* Bounds the entries of a table whose numbers are in `at`. */
static interval entries(interval at, double table)
{
    interval r = {INFINITY, -INFINITY};
    if (!(at.low >= 0 && at.high - at.low < ENTRIES_MOST)) return anything;
    for (double k = ceil(at.low); k <= at.high; k++) {
        const double y = operation_value(OP_ENTRY, k, table, 0);
        if (isnan(y)) return anything;
        r = interval_hull(r, (interval){y, y});
    }
    return r.low <= r.high ? r : anything;
}

interval interval_value(operation op, interval a, interval b, interval c, bool same)
{
    switch (op) {
    case OP_NEG: return (interval){-a.high, -a.low};
    case OP_ADD: return (interval){a.low + b.low, a.high + b.high};
    case OP_SUB: return (interval){a.low - b.high, a.high - b.low};
    case OP_MUL: return same ? product(interval_magnitude(a), interval_magnitude(a)) : product(a, b);
    case OP_DIV: return b.low > 0 || b.high < 0 ? product(a, (interval){1 / b.high, 1 / b.low}) : anything;
    case OP_LT:
    case OP_LE: return truth(a.low <= b.high, a.high < b.low);
    case OP_GT:
    case OP_GE: return truth(a.high >= b.low, a.low > b.high);
    case OP_EQ: return truth(meet(a, b), single(a) && single(b) && meet(a, b));
    case OP_NE: return truth(!(single(a) && single(b) && meet(a, b)), !meet(a, b));
    case OP_AND: return truth(a.high != 0 && b.high != 0, a.low != 0 && b.low != 0);
    case OP_OR: return truth(a.high != 0 || b.high != 0, a.low != 0 || b.low != 0);
    case OP_NOT: return truth(a.low == 0, a.high == 0);
    case OP_SELECT: return a.low > 0 || a.high < 0 ? b : a.low == 0 && a.high == 0 ? c : interval_hull(b, c);
    case OP_SIN: return wave(a, half_turn / 2);
    case OP_COS: return wave(a, 0);
    case OP_TAN: return a.high - a.low >= half_turn || passes(a, half_turn / 2, half_turn) ? anything : rising(op, a);
    case OP_LOG: return a.low > 0 ? rising(op, a) : anything;
    case OP_SQRT: return a.low >= 0 ? rising(op, a) : anything;
    case OP_POW: return power(a, b);
    case OP_HYPOT: return corners(op, interval_magnitude(a), interval_magnitude(b));
    case OP_ATAN2: return b.low > 0 ? corners(op, a, b) : (interval){-half_turn, half_turn};
    case OP_MIN:
    case OP_MAX: return corners(op, a, b);
    case OP_FIND: {
        const double low = operation_value(op, a.low, b.low, 0), high = operation_value(op, a.high, b.low, 0);
        return isnan(low) || isnan(high) ? anything : (interval){low, high};
    }
    case OP_ENTRY: return entries(a, b.low);
    case OP_MOD: {
        const interval q = interval_value(OP_DIV, a, b, c, false);
        return floor(q.low) == floor(q.high) ? interval_value(OP_SUB, a, product(b, rising(OP_FLOOR, q)), c, false)
                                             : interval_hull((interval){0, 0}, b);
    }
    default:
        return operation_is(op, RISES)     ? rising(op, a)
               : operation_is(op, SINKS)   ? falling(op, a)
               : operation_is(op, IS_EVEN) ? even(op, a)
                                           : anything;
    }
}
