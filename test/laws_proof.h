/* What the proofs of order share: the coefficients of a row, the tableau that they make, the trees of the theory.
 *
 * Invariant: a scheme is a method for x'' = a(x, x', t) in Nyström form [HNW93, II.14], in units of the step:
 *
 *     X[i] = x + c[i] h v + h² Σ a[i][j] K[j],   V[i] = v + h Σ av[i][j] K[j],   K[i] = a(X[i], V[i], t + c[i] h),
 *     x₁ = x + end h v + h² Σ b[i] K[i],          v₁ = v + h Σ bv[i] K[i].
 */
#ifndef TEST_LAWS_PROOF_H
#define TEST_LAWS_PROOF_H

#include "test/laws.h"

enum { SCHEME_STAGES_MAX = 37, COEFFICIENTS_MAX = 340 };
typedef struct scheme {
    int stages;
    bool places; /* of a method for s' = f(s): positions have weights of their own, which are to be judged too */
    quad part;   /* the part of the step to which b and bv lead; 0: all of it */
    quad end, c[SCHEME_STAGES_MAX], a[SCHEME_STAGES_MAX][SCHEME_STAGES_MAX], b[SCHEME_STAGES_MAX];
    quad av[SCHEME_STAGES_MAX][SCHEME_STAGES_MAX], bv[SCHEME_STAGES_MAX];
} scheme;

/* The trees of the order conditions: rooted trees for s' = f(s) [HNW93, II.2], special Nyström trees for x'' = a(x,
 * t), and Nyström trees for x'' = a(x, x', t) [HNW93, II.14]. TREES_WORDS: instead of trees the words of compositions
 * of symmetric steps, whose sizes are the scheme's bv (laws_words.c). */
typedef enum trees_kind { TREES_ROOTED, TREES_SPECIAL, TREES_NYSTROM, TREES_WORDS, TREES_KINDS } trees_kind;

/* The coefficients of a row, and by how much each may differ from the value its author meant: half a unit in its last
 * printed place, 0 if it is exact. The count is 0 for rows without coefficients: the two-step methods, newmark,
 * exact. */
typedef struct coefficients {
    int count;
    quad value[COEFFICIENTS_MAX], unit[COEFFICIENTS_MAX];
} coefficients;
coefficients coefficients_of(method);
quad coefficients_unit(method); /* the largest of these units */
/* The tableau of the row with other values of its coefficients. */
void coefficients_scheme(method, const quad *value, scheme *);
trees_kind coefficients_trees(method);
/* Makes the embedded method of an adaptive row by its first or second estimate; returns its order, 0: there is
 * none. */
int coefficients_embedded(method, int which, scheme *);
/* Of a row with continuous weights: the largest unit of their coefficients. */
quad coefficients_dense_unit(method);
/* The tableau of such a row, the further stages included, with the weights at the fraction `part`; false: it has none.
 */
bool quad_continuous_of(method, quad part, scheme *);
/* b'(0), or b'(1), of each stage, and the sum of the sizes of their terms. */
bool quad_slopes_of(method, bool end, quad *slope, quad *size);
bool coefficients_nystrom(method); /* the row gives a and b of the positions themselves */
bool coefficients_compose(method); /* the row is a composition of leapfrog steps */

enum { TREES_ORDER_MAX = 13, TREES_CONDITIONS_MAX = 4096 };
/* Condition k holds where left = right; it belongs to the order `order`. */
typedef struct condition {
    int order;
    quad left, right;
} condition;
int trees_count(trees_kind, int order); /* of exactly this order; 0: not generated */
int trees_conditions(trees_kind, const scheme *, int order, condition *);
int words_count(int order);
int words_conditions(const scheme *, int order, condition *);
/* A bound on the roundings, each of half QUAD_EPSILON, in one condition of this order, those of its coefficients
 * included. */
quad trees_roundings(const scheme *, int order);

/* Checks that a tableau, whose numbers are exact up to rounding, has this order and no higher one. */
void proof_of_scheme(const char *name, trees_kind, const scheme *, int order);
/* The same, of numbers whose printed digits may violate a condition by `slack`. */
void proof_of_digits(const char *name, trees_kind, const scheme *, int order, quad slack);

/* The same of collocation, without trees; `twice`: of a polynomial of the acceleration, which is integrated twice. */
void proof_of_collocation(const char *name, const scheme *, bool twice, int order);

void laws_of_proof(void);
void laws_of_steps(void);

#endif
