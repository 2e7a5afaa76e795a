/* Proofs about the force of a model, from its formulas: that it is a gradient, and that a velocity term does no work.
 *
 * The parameters have the numbers in the pool. Invariant: what is neither proved nor refuted may be true or false.
 */
#ifndef LANG_MODEL_FIELD_H
#define LANG_MODEL_FIELD_H

#include "lang/model/model.h"

typedef struct field_proof {
    bool holds, refuted; /* if both are false, it is not known */
    bool jumps;          /* of da/dx: the force may jump where a quotient or an angle does, as y/|y| at 0 */
    /* Of da/dx: the potential has one value everywhere. Round a singularity, the potential of a force with a symmetric
     * derivative may gain something at each turn, as the angle does. */
    bool single;
} field_proof;

/* Proves that M da/dx is symmetric, with the masses M of all numbers of v (NULL: 1), or (in_v) that da/dv is
 * antisymmetric. False: no memory. */
bool field_prove(model *, bool in_v, const double *masses, field_proof *);
/* Proves that a quantity is constant along every motion. False: no memory. */
bool field_conserves(model *, const model_definition *, bool *proved);
/* Returns whether the force may jump where a position passes some value; its derivatives do not show that. */
bool field_jumps(model *);

#endif
