/* The operations of a model, applied to polynomials in atoms, and derivatives. */
#include "lang/model/algebra.h"

#include <math.h>

enum { DEPTH_MAX = 100 };

static bool number(const algebra *A, poly given, double *value)
{
    const algebra_poly p = A->polys[given];
    if (p.count > 1 || (p.count == 1 && p.terms[0].of != 0)) return false;
    *value = p.count ? p.terms[0].factor : 0;
    return true;
}

/* Returns the first factor of a polynomial, or 0. */
static double first(const algebra *A, poly p) { return p ? A->polys[p].terms[0].factor : 0; }

static poly negative(algebra *A, poly p) { return algebra_add(A, 0, -1, p); }

/* Returns p/c. */
static poly scaled(algebra *A, poly p, double c) { return algebra_add(A, 0, 1 / c, p); }

/* Applies a function that is odd (parity -1), even (1), or neither (0). */
static poly function(algebra *A, operation op, poly a, int parity, double low)
{
    const double c = first(A, a);
    if (A->lost) return algebra_lose(A);
    if (parity && c < 0) {
        const poly p = function(A, op, negative(A, a), 0, low);
        return parity < 0 ? negative(A, p) : p;
    }
    return algebra_of_atom(A, algebra_atom_of(A, op, a, 0), 1, 1, low);
}

/* Returns 1 where p > 0, else 0. */
static poly step(algebra *A, poly p)
{
    double value;
    if (A->lost) return algebra_lose(A);
    if (number(A, p, &value)) return algebra_number(A, value > 0);
    if (A->polys[p].low > 0) return algebra_number(A, 1);
    const double c = first(A, p);
    const poly up = algebra_of_atom(A, algebra_atom_of(A, OP_GT, scaled(A, p, c), 0), 1, 1, 0);
    return c > 0 ? up : algebra_add(A, algebra_number(A, 1), -1, up);
}

/* Returns whether a == b: almost nowhere, unless a and b are one polynomial. */
static poly equal(algebra *A, poly a, poly b)
{
    poly apart = algebra_add(A, a, -1, b);
    return algebra_number(A, algebra_zero(A, &apart));
}

static poly magnitude(algebra *A, poly p)
{
    if (A->lost) return algebra_lose(A);
    if (A->polys[p].low >= 0) return p;
    const double c = first(A, p);
    const poly one = algebra_of_atom(A, algebra_atom_of(A, OP_ABS, scaled(A, p, c), 0), 1, 1, 0);
    return algebra_times(A, algebra_number(A, fabs(c)), one);
}

static poly complement(algebra *A, poly p) { return algebra_add(A, algebra_number(A, 1), -1, p); }

static poly power(algebra *A, poly a, poly b)
{
    double e;
    if (number(A, b, &e)) return algebra_raise(A, a, e);
    return function(A, OP_EXP, algebra_times(A, b, algebra_apply(A, OP_LOG, a, 0)), 0, 0);
}

poly algebra_apply(algebra *A, operation op, poly a, poly b)
{
    double x = 0, y = 0;
    if (A->lost) return algebra_lose(A);
    if (op != OP_ADD && op != OP_MUL && number(A, a, &x) && number(A, b, &y)) {
        const double value = operation_value(op, x, y, 0);
        return isfinite(value) ? algebra_number(A, value) : algebra_lose(A);
    }
    switch (op) {
    case OP_NEG: return negative(A, a);
    case OP_ADD: return algebra_add(A, a, 1, b);
    case OP_SUB: return algebra_add(A, a, -1, b);
    case OP_MUL: return algebra_times(A, a, b);
    case OP_DIV: return algebra_times(A, a, algebra_raise(A, b, -1));
    case OP_POW: return power(A, a, b);
    case OP_SQRT: return algebra_raise(A, a, 0.5);
    case OP_HYPOT: return algebra_raise(A, algebra_add(A, algebra_times(A, a, a), 1, algebra_times(A, b, b)), 0.5);
    case OP_LT: return step(A, algebra_add(A, b, -1, a));
    case OP_GT: return step(A, algebra_add(A, a, -1, b));
    case OP_LE: return complement(A, step(A, algebra_add(A, a, -1, b)));
    case OP_GE: return complement(A, step(A, algebra_add(A, b, -1, a)));
    case OP_EQ: return equal(A, a, b);
    case OP_NE: return complement(A, equal(A, a, b));
    case OP_AND: return algebra_times(A, a, b);
    case OP_OR: return algebra_add(A, algebra_add(A, a, 1, b), -1, algebra_times(A, a, b));
    case OP_NOT: return complement(A, a);
    case OP_ABS: return magnitude(A, a);
    case OP_SIGN: return algebra_add(A, algebra_number(A, -1), 2, step(A, a));
    case OP_MIN:
    case OP_MAX: {
        const poly apart = magnitude(A, algebra_add(A, a, -1, b));
        return scaled(A, algebra_add(A, algebra_add(A, a, 1, b), op == OP_MAX ? 1 : -1, apart), 2);
    }
    case OP_MOD: {
        const poly turns = function(A, OP_FLOOR, algebra_apply(A, OP_DIV, a, b), 0, -INFINITY);
        return algebra_add(A, a, -1, algebra_times(A, b, turns));
    }
    case OP_ACOS:
        return algebra_add(A, algebra_number(A, 1.5707963267948966), -1, function(A, OP_ASIN, a, -1, -INFINITY));
    case OP_ATAN2: return algebra_of_atom(A, algebra_atom_of(A, op, a, b), 1, 1, -INFINITY);
    case OP_SIN:
    case OP_TAN:
    case OP_ASIN:
    case OP_ATAN:
    case OP_SINH:
    case OP_TANH:
    case OP_ERF:
    case OP_CBRT: return function(A, op, a, -1, -INFINITY);
    case OP_COS: return function(A, op, a, 1, -INFINITY);
    case OP_COSH: return function(A, op, a, 1, 1);
    case OP_EXP: return function(A, op, a, 0, 0);
    case OP_LOG:
    case OP_FLOOR: return function(A, op, a, 0, -INFINITY);
    default: return algebra_lose(A);
    }
}

static poly slope(algebra *A, poly p, uint32_t by, int depth);

/* Returns f'(a) a', the derivative of an atom that is a function f of a. */
static poly slope_of_atom(algebra *A, uint32_t k, uint32_t by, int depth)
{
    const algebra_atom f = A->atoms[k];
    const poly one = algebra_number(A, 1);
    if (k == by) return one;
    if (f.op == OP_LOAD || f.op == OP_TIME) return 0;
    if (f.sloped == by) return f.slope;
    const poly da = slope(A, f.a, by, depth + 1), db = slope(A, f.b, by, depth + 1);
    poly rate = 0;
    if (da || db) {
        const poly self = algebra_of_atom(A, k, 1, 1, -INFINITY), square = algebra_times(A, f.a, f.a);
        switch ((operation)f.op) {
        case OP_POW: rate = one; break; /* that of the base */
        case OP_EXP: rate = self; break;
        case OP_SIN: rate = algebra_apply(A, OP_COS, f.a, 0); break;
        case OP_COS: rate = algebra_add(A, 0, -1, algebra_apply(A, OP_SIN, f.a, 0)); break;
        case OP_TAN: rate = algebra_add(A, one, 1, algebra_times(A, self, self)); break;
        case OP_ASIN: rate = algebra_raise(A, algebra_add(A, one, -1, square), -0.5); break;
        case OP_ATAN: rate = algebra_raise(A, algebra_add(A, one, 1, square), -1); break;
        case OP_SINH: rate = algebra_apply(A, OP_COSH, f.a, 0); break;
        case OP_COSH: rate = algebra_apply(A, OP_SINH, f.a, 0); break;
        case OP_TANH: rate = algebra_add(A, one, -1, algebra_times(A, self, self)); break;
        case OP_LOG: rate = algebra_raise(A, f.a, -1); break;
        case OP_CBRT: rate = algebra_times(A, algebra_number(A, 1.0 / 3), algebra_raise(A, self, -2)); break;
        case OP_ERF:
            rate = algebra_apply(A, OP_EXP, algebra_add(A, 0, -1, square), 0);
            rate = algebra_times(A, algebra_number(A, 1.1283791670955126), rate);
            break;
        case OP_ABS: rate = algebra_apply(A, OP_SIGN, f.a, 0); break;
        case OP_GT: rate = algebra_of_atom(A, algebra_atom_of(A, OP_EQ, f.a, 0), 1, 1, 0); break;
        case OP_FLOOR: rate = algebra_of_atom(A, algebra_atom_of(A, OP_NE, f.a, 0), 1, 1, 0); break;
        case OP_ATAN2: {
            const poly below = algebra_add(A, square, 1, algebra_times(A, f.b, f.b));
            rate = algebra_add(A, algebra_times(A, f.b, da), -1, algebra_times(A, f.a, db));
            rate = algebra_times(A, rate, algebra_raise(A, below, -1));
            break;
        }
        default: rate = algebra_lose(A); break;
        }
        if (f.op != OP_ATAN2) rate = algebra_times(A, rate, da);
    }
    A->atoms[k].sloped = by;
    A->atoms[k].slope = rate;
    return rate;
}

static poly slope(algebra *A, poly p, uint32_t by, int depth)
{
    if (depth > DEPTH_MAX) return algebra_lose(A);
    const uint32_t first = A->line_count;
    const algebra_poly of = A->polys[p];
    for (uint32_t k = 0; k < of.count && !A->lost; k++) {
        const poly_term t = of.terms[k];
        const algebra_monomial m = A->monomials[t.of];
        for (uint32_t i = 0; i < m.count && !A->lost; i++) {
            const algebra_power power = A->powers[m.first + i];
            const poly of_atom = slope_of_atom(A, power.atom, by, depth);
            if (of_atom == 0) continue;
            const poly_term rest = {algebra_with_exponent(A, t.of, power.atom, power.exponent - 1),
                                    t.factor * power.exponent, t.size * fabs(power.exponent)};
            algebra_note_product(A, &rest, of_atom);
        }
    }
    return algebra_gather(A, first, -INFINITY);
}

poly algebra_slope(algebra *A, poly p, uint32_t by) { return slope(A, p, by, 0); }
