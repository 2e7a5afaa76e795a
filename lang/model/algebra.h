/* Polynomials in atoms, to prove that an expression of a model is zero at every state.
 *
 * An atom is a place of the state, the time, or a function of polynomials; a monomial is a product of powers of atoms,
 * and equal monomials are shared. algebra_read makes a polynomial of every node for one cell of a family, with sums
 * written out and parameters replaced by their numbers. A factor counts as 0 where it is below ALGEBRA_ROUNDING of the
 * terms that it is the sum of, so 3·0.1 x - 0.3 x is 0. A switch is written by steps: if(u > 0, p, q) is p step(u) + q
 * (1 - step(u)), whose derivative has δ(u), so a jump of a force counts as much as its slope.
 *
 * Invariant: a polynomial shown to be zero is zero at every state where it is defined, up to rounding of the model's
 * numbers. Where that takes too much work or is not understood, `lost` is set, and nothing is shown.
 */
#ifndef LANG_MODEL_ALGEBRA_H
#define LANG_MODEL_ALGEBRA_H

#include "lang/model/model.h"

#define ALGEBRA_ROUNDING 0x1p-40

typedef struct poly_term {
    uint32_t of;         /* a monomial; 0: the empty product */
    double factor, size; /* size: the sum of the absolute values that the factor is the sum of */
} poly_term;

typedef uint32_t poly; /* the number of a polynomial; 0: zero */

typedef struct algebra_poly {
    const poly_term *terms; /* by rising monomials */
    uint32_t count;
    double low; /* it is nowhere below this; -INFINITY: that is not known */
} algebra_poly;

typedef struct algebra_power {
    uint32_t atom;
    double exponent;
} algebra_power;

typedef struct algebra_monomial {
    uint32_t first, count, next; /* its `powers`, by rising atoms */
} algebra_monomial;

/* LOAD: number `at` of a space. TIME. POW: the base a of powers that are not written out. GT: step(a), 0 below 0 and 1
 * above. EQ: δ(a). NE: the sum of δ(a - n) over all integers n. Others: the function of a, or of a and b. */
typedef struct algebra_atom {
    uint8_t op, space;
    size_t at;
    poly a, b;
    uint32_t next;
    uint8_t apart; /* for algebra_jump.c, POW: 1: a has zeros at single places at most; 2: it has more; 0: not known */
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
    poly_term *line; /* a list that is being made */
    uint32_t line_count, line_room;
    long work; /* how many terms and nodes may still be made */
    bool lost;
} algebra;

/* Begins an algebra, which algebra_end releases in any case. False: no memory. */
bool algebra_begin(algebra *, const model *, long work);
void algebra_end(algebra *);

poly algebra_number(algebra *, double);
uint32_t algebra_place(algebra *, space, size_t at); /* the atom of a place */
/* Returns p + factor q. */
poly algebra_add(algebra *, poly p, double factor, poly q);
poly algebra_times(algebra *, poly p, poly q);
poly algebra_without(algebra *, poly p, poly_term); /* p less one of its terms */
poly algebra_raise(algebra *, poly base, double exponent);
/* Applies an operation of the graph that is no leaf, sum or choice. */
poly algebra_apply(algebra *, operation, poly a, poly b);
/* Returns the derivative by a place. */
poly algebra_slope(algebra *, poly, uint32_t atom);
/* Brings a polynomial to its normal form, but for a factor. True: it is zero. */
bool algebra_zero(algebra *, poly *);
/* Returns whether a normal form is certainly not zero: it has at most one function, of places alone, which is no
 * quotient of polynomials. */
bool algebra_differs(const algebra *, poly);

/* algebra_read.c: returns the value of an output at these indices. */
poly algebra_read(algebra *, node, const int64_t *index);

/* algebra_jump.c: returns whether a monomial may jump, apart from its steps, as places of the space move. cell: by
 * place; 0: it does not move. */
bool algebra_jump(algebra *, uint32_t of, space, const uint32_t *cell);

/* For algebra_apply.c. */
uint32_t algebra_atom_of(algebra *, operation, poly a, poly b);
poly algebra_of_atom(algebra *, uint32_t atom, double exponent, double factor, double low);
poly algebra_lose(algebra *);
/* Returns a monomial with another exponent of one of its atoms; 0: without the atom. */
uint32_t algebra_with_exponent(algebra *, uint32_t of, uint32_t atom, double exponent);
/* Add the terms of a product to the list that is being made, and return the polynomial of the list from `first` on,
 * which leaves the list. */
void algebra_note_product(algebra *, const poly_term *, poly);
poly algebra_gather(algebra *, uint32_t first, double low);

#endif
