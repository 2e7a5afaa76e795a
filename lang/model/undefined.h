/* Where a force is undefined at a state: the first operation whose operands are numbers and whose value is none. */
#ifndef LANG_MODEL_UNDEFINED_H
#define LANG_MODEL_UNDEFINED_H

#include "lang/model/model.h"

enum { UNDEFINED_TEXT = 160 };

typedef struct undefined_term {
    char term[UNDEFINED_TEXT], divisor[UNDEFINED_TEXT]; /* `divisor` is that of a quotient by 0, or empty */
    bool infinite, both;                                /* both: the term is 0/0 */
    bool has_limit; /* on all ways to the state the term goes to `limit`, in all digits of a double */
    double limit;
    /* a sentence, if the term is an entry that a list or a table does not have; holds: its end values could hold */
    char outside[UNDEFINED_TEXT];
    bool holds;
    double time; /* the end of a table of the time; else NaN */
} undefined_term;

/* Finds the term in the acceleration of number `which` of v, at a state. False: no formula of a single cell has one, or
 * no memory. */
bool undefined_find(model *, size_t which, double t, const double *x, const double *v, undefined_term *);

#endif
