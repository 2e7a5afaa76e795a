/* Where a formula is undefined at a state: the first operation whose operands are numbers and whose value is none. */
#ifndef LANG_MODEL_UNDEFINED_H
#define LANG_MODEL_UNDEFINED_H

#include "lang/model/model.h"

enum { UNDEFINED_TEXT = 160 };

typedef struct undefined_term {
    char term[UNDEFINED_TEXT], divisor[UNDEFINED_TEXT]; /* `divisor` is that of a quotient by 0, or empty */
    char says[2 * UNDEFINED_TEXT + 64];                 /* a sentence: "x/y is 0/0 there, since y is 0" */
    bool infinite, both;                                /* both: the term is 0/0 */
    bool has_limit; /* on all ways to the state the term goes to `limit`, in all digits of a double */
    double limit;
    /* another, if the term is an entry that a list or a table does not have; holds: the function whose end values could
     * hold, or NULL */
    char outside[UNDEFINED_TEXT];
    const char *holds;
    char points[UNDEFINED_TEXT]; /* the ends of a table whose argument does not move: "0 to 5"; else empty */
    double time;                 /* the end of a table of the time; else NaN */
} undefined_term;

/* Finds the term in the output that becomes element `which` of its space, as number `which` of v for the accelerations,
 * at a state. False: no formula without sums has one, or no memory. */
bool undefined_find(model *, const output *, size_t outputs, size_t which, double t, const double *x, const double *v,
                    undefined_term *);
/* Finds it in a cell of an output, with the indices of its loops. */
bool undefined_of(model *, const output *, const int64_t *index, double t, const double *x, const double *v,
                  undefined_term *);
/* Returns where a run may end that last had a value at `last`: there, or shortly before, where the rounding of its last
 * step decides. */
double undefined_until(const undefined_term *, double last, double start);
/* Hints at what helps where a term is outside: from the start, or after `until`. */
void undefined_hint(const undefined_term *, double until, bool start, motus_error *);

#endif
