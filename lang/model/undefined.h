/* Where a force is undefined at a state: the first operation that makes no number of numbers. */
#ifndef LANG_MODEL_UNDEFINED_H
#define LANG_MODEL_UNDEFINED_H

#include "lang/model/model.h"

enum { UNDEFINED_TEXT = 160 };

typedef struct undefined_term {
    char term[UNDEFINED_TEXT], divisor[UNDEFINED_TEXT]; /* of a quotient by 0; else the second is empty */
    bool infinite, both;                                /* both: 0/0 */
    bool has_limit; /* on all ways to the state the term goes to this value, to all digits of a double: */
    double limit;
} undefined_term;

/* In the acceleration of number `which` of v, at a state that stays as it is. False: there is none in a formula of a
 * single cell, or no memory. */
bool undefined_find(model *, size_t which, double t, const double *x, const double *v, undefined_term *);

#endif
