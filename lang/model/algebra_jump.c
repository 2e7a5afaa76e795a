/* Whether a term may jump where its formula shows no step, as y/|y| and tanh(1/y) do at y = 0, and atan2 on its cut.
 *
 * Where the divisor of a quotient of analytic functions is 0, the quotient has a pole or a limit, but no jump. A
 * formula that is continuous but not analytic, as |y|, has no jump either. A product of both may have one; so may a
 * function of a formula with a pole. There is no jump where the divisor is 0 only at points, lines or other places of
 * codimension 2 or more, as |r| is: the force is continuous on all ways round them.
 *
 * Invariant: a term of which no jump is reported jumps across no hypersurface but those of its steps.
 */
#include "lang/model/algebra.h"

#include <math.h>

enum { DEPTH_MAX = 100, PLACES_MAX = 16 };

typedef struct reader {
    algebra *algebra;
    const uint32_t *cell; /* by place; 0: it has no equation */
    space space;
} reader;

typedef struct form {
    bool moves; /* it reads a place that moves */
    bool pole;  /* it may grow without bound at a hypersurface */
    bool rough; /* it may not be analytic at a hypersurface */
} form;

static form form_of(const reader *r, poly p, int depth);

static form both(form a, form b) { return (form){a.moves || b.moves, a.pole || b.pole, a.rough || b.rough}; }

/* Finds the places that a polynomial reads outside functions, at most PLACES_MAX. */
static int places_of(const reader *r, poly p, uint32_t places[PLACES_MAX])
{
    const algebra *A = r->algebra;
    int count = 0;
    for (uint32_t k = 0; k < A->polys[p].count; k++) {
        const algebra_monomial m = A->monomials[A->polys[p].terms[k].of];
        for (uint32_t i = 0; i < m.count; i++) {
            const uint32_t atom = A->powers[m.first + i].atom;
            const algebra_atom *a = &A->atoms[atom];
            if (a->op != OP_LOAD || a->space != r->space || !r->cell[a->at]) continue;
            int j = 0;
            while (j < count && places[j] != atom) j++;
            if (j == count) places[count++] = atom;
            if (count == PLACES_MAX) return count;
        }
    }
    return count;
}

/* Returns whether the second derivatives by two places form a matrix that is positive definite everywhere. */
static bool convex(algebra *A, poly by_a, poly by_b, uint32_t a, uint32_t b)
{
    const poly aa = algebra_slope(A, by_a, a), bb = algebra_slope(A, by_b, b), ab = algebra_slope(A, by_a, b);
    if (!(A->polys[aa].low > 0 && A->polys[bb].low > 0)) return false;
    const poly direct = algebra_times(A, aa, bb);
    return A->polys[ab ? algebra_add(A, direct, -1, algebra_times(A, ab, ab)) : direct].low > 0;
}

/* Returns whether a polynomial has no zero but at places of codimension 2 or more. One that is never negative and
 * strictly convex in two places has at most one zero for all values of the others. */
static bool apart(const reader *r, poly p)
{
    algebra *A = r->algebra;
    uint32_t places[PLACES_MAX];
    if (!(A->polys[p].low >= 0)) return false;
    if (A->polys[p].low > 0) return true;
    const int count = places_of(r, p, places);
    for (int i = 0; i < count; i++)
        for (int k = i + 1; k < count && !A->lost; k++)
            if (convex(A, algebra_slope(A, p, places[i]), algebra_slope(A, p, places[k]), places[i], places[k]))
                return !A->lost;
    return false;
}

static bool apart_base(const reader *r, uint32_t atom)
{
    algebra *A = r->algebra;
    if (!A->atoms[atom].apart) {
        const uint8_t answer = apart(r, A->atoms[atom].a) ? 1 : 2;
        A->atoms[atom].apart = answer;
    }
    return A->atoms[atom].apart == 1;
}

/* Returns the form of the function that an atom is, apart from its power. */
static form form_of_function(const reader *r, const algebra_atom *a, int depth)
{
    const form first = form_of(r, a->a, depth + 1), second = form_of(r, a->b, depth + 1);
    form f = both(first, second);
    if (!f.moves || a->op == OP_POW) return f;
    f.rough |= f.pole;
    switch ((operation)a->op) {
    case OP_EXP:
    case OP_SIN:
    case OP_COS:
    case OP_ATAN:
    case OP_SINH:
    case OP_COSH:
    case OP_TANH:
    case OP_ERF: break;
    case OP_TAN: f.pole = true; break;
    case OP_ATAN2:
        if (!(r->algebra->polys[a->b].low > 0)) f.pole = f.rough = true;
        break;
    case OP_LOG:
        if (!apart(r, a->a)) f.pole = f.rough = true;
        break;
    case OP_ABS:
    case OP_CBRT: f.rough |= !apart(r, a->a); break;
    default: f.rough = true; break;
    }
    return f;
}

static form form_of_power(const reader *r, algebra_power p, int depth)
{
    const algebra_atom a = r->algebra->atoms[p.atom];
    const bool root = p.exponent != floor(p.exponent);
    if (a.op == OP_TIME) return (form){false, false, false};
    if (a.op == OP_LOAD) {
        const bool moves = a.space == r->space && r->cell[a.at];
        return (form){moves, moves && p.exponent < 0, moves && root};
    }
    form f = form_of_function(r, &a, depth);
    if (!f.moves || a.op == OP_EXP || a.op == OP_COSH || (a.op == OP_POW && apart_base(r, p.atom))) return f;
    f.pole |= p.exponent < 0;
    f.rough |= root;
    return f;
}

static form form_of_term(const reader *r, uint32_t of, int depth)
{
    const algebra_monomial m = r->algebra->monomials[of];
    form all = {false, false, false};
    for (uint32_t k = 0; k < m.count; k++) all = both(all, form_of_power(r, r->algebra->powers[m.first + k], depth));
    return all;
}

static form form_of(const reader *r, poly p, int depth)
{
    form all = {false, false, false};
    if (depth > DEPTH_MAX) return (form){true, true, true};
    for (uint32_t k = 0; k < r->algebra->polys[p].count; k++)
        all = both(all, form_of_term(r, r->algebra->polys[p].terms[k].of, depth));
    return all;
}

bool algebra_jump(algebra *A, uint32_t of, space s, const uint32_t *cell)
{
    const reader r = {A, cell, s};
    const form f = form_of_term(&r, of, 0);
    return f.pole && f.rough;
}
