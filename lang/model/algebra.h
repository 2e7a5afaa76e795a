/* Polynomials in atoms, to prove that an expression of a model is zero whatever the state.
 *
 * An atom is a place of the state, the time, or a function of polynomials; monomials are products of powers of atoms,
 * and equal ones are the same. What reads a model makes a polynomial of every node for one cell of a family, with sums
 * written out and with the numbers of the pool in place of parameters. A factor counts as 0 where it is below
 * ALGEBRA_ROUNDING of what it was added up from, so that 3·0.1 x - 0.3 x is 0. Switches are taken almost everywhere:
 * if(u > 0, p, q) is p step(u) + q (1 - step(u)), whose derivative has δ(u), so that a jump of a force is no more
 * forgotten than its slope.
 *
 * Invariant: what is shown to be zero is zero at every state where it is defined, up to rounding of the model's
 * numbers. What takes too much work, or is not understood, is `lost`: then nothing is shown.
 */
#ifndef LANG_MODEL_ALGEBRA_H
#define LANG_MODEL_ALGEBRA_H

#include "lang/model/model.h"

#define ALGEBRA_ROUNDING 0x1p-40

typedef struct poly_term {
    uint32_t of;         /* a monomial; 0: the empty product */
    double factor, size; /* size: the sum of |what the factor was added up from| */
} poly_term;

typedef uint32_t poly; /* the number of a polynomial; 0: zero */

typedef struct algebra_poly {
    const poly_term *terms; /* by rising monomials */
    uint32_t count;
    double low; /* nowhere below this; -INFINITY: not known */
} algebra_poly;

typedef struct algebra_power {
    uint32_t atom;
    double exponent;
} algebra_power;

typedef struct algebra_monomial {
    uint32_t first, count, next; /* of `powers`, by rising atoms */
} algebra_monomial;

/* LOAD: the number `at` of a space. TIME. POW: the base a, of powers that are not written out. GT: step(a), 0 below 0
 * and 1 above. EQ: δ(a). NE: the sum of δ(a - n) over all integers n. Others: the function of a, or of a and b. */
typedef struct algebra_atom {
    uint8_t op, space;
    size_t at;
    poly a, b;
    uint32_t next;
    uint8_t apart; /* algebra_jump.c, of POW: 1: the base is zero nowhere, or at lone places; 2: not so; 0: not asked */
    uint32_t sloped; /* the atom by which `slope` is the derivative; 0: none is known */
    poly slope;
} algebra_atom;

enum { ALGEBRA_HEADS = 1 << 10 };

typedef struct algebra {
    arena arena;
    const model *model;
    algebra_poly *polys;
    algebra_atom *atoms; /* from 1 on */
    algebra_monomial *monomials;
    algebra_power *powers;
    uint32_t poly_count, poly_room, atom_count, atom_room, monomial_count, monomial_room, power_count, power_room;
    uint32_t atom_heads[ALGEBRA_HEADS], monomial_heads[ALGEBRA_HEADS];
    poly_term *line; /* room for a list that is being made */
    uint32_t line_count, line_room;
    long work; /* terms and nodes that may still be made */
    bool lost;
} algebra;

/* False: no memory. Release in any case. */
bool algebra_begin(algebra *, const model *, long work);
void algebra_end(algebra *);

poly algebra_number(algebra *, double);
uint32_t algebra_place(algebra *, space, size_t at); /* its atom */
/* p + factor q */
poly algebra_add(algebra *, poly p, double factor, poly q);
poly algebra_times(algebra *, poly p, poly q);
poly algebra_without(algebra *, poly p, poly_term); /* p less one of its terms */
poly algebra_raise(algebra *, poly base, double exponent);
/* An operation of the graph, but for leaves, sums and choices. */
poly algebra_apply(algebra *, operation, poly a, poly b);
/* The derivative by a place. */
poly algebra_slope(algebra *, poly, uint32_t atom);
/* Brings the polynomial to its normal form, but for a factor; true: it is zero. */
bool algebra_zero(algebra *, poly *);
/* Whether a normal form is certainly not zero: it has no more than one function, of places alone, which is no
 * quotient of polynomials. */
bool algebra_differs(const algebra *, poly);

/* algebra_read.c: the value of an output at these indices. */
poly algebra_read(algebra *, node, const int64_t *index);

/* algebra_jump.c: whether a monomial may jump as places of the space change, but for its steps. cell: by place, 0: it
 * does not move. */
bool algebra_jump(algebra *, uint32_t of, space, const uint32_t *cell);

/* algebra.c, for algebra_apply.c. */
uint32_t algebra_atom_of(algebra *, operation, poly a, poly b);
poly algebra_of_atom(algebra *, uint32_t atom, double exponent, double factor, double low);
poly algebra_lose(algebra *);
/* The monomial without one of its atoms, whose exponent is then given another value; 0: it is left out. */
uint32_t algebra_with_exponent(algebra *, uint32_t of, uint32_t atom, double exponent);
/* Adds the terms of a product to the list that is being made; and the polynomial of the list from `first` on. */
void algebra_note_product(algebra *, const poly_term *, poly);
poly algebra_gather(algebra *, uint32_t first, double low);

#endif
