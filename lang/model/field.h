/* Proofs about the force of a model, from its formulas: that it is a gradient, and that a velocity term does no work.
 *
 * The numbers of the model are those of its pool. Invariant: what is neither proved nor refuted may hold or not.
 */
#ifndef LANG_MODEL_FIELD_H
#define LANG_MODEL_FIELD_H

#include "lang/model/model.h"

typedef struct field_proof {
    bool holds, refuted; /* neither: not known */
    bool jumps;          /* with da/dx: the force may jump where a quotient or an angle does, as y/|y| at 0 */
    /* With da/dx: the potential has one value everywhere. Round a singularity of a force whose derivative is symmetric,
     * a potential may gain something at each turn, as the angle does. */
    bool single;
} field_proof;

/* Of M da/dx that it is symmetric, with the masses M of all numbers of v (NULL: 1); or of da/dv (in_v) that it is
 * antisymmetric. False: no memory. */
bool field_prove(model *, bool in_v, const double *masses, field_proof *);
/* Whether the quantity is proved to be constant along every motion. False: no memory. */
bool field_conserves(model *, const model_definition *, bool *proved);
/* Whether the force may jump where a place passes some value, which its derivatives do not show. */
bool field_jumps(model *);

#endif
