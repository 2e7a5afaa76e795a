/* The arguments of the operations, in functions of rules, that are not polynomials. Where each operation is regular
 * over all values that its arguments take in a step, no feature of the function is narrow beside points that resolve
 * the arguments (core/rules.h). */
#ifndef MACHINE_ARGUMENTS_H
#define MACHINE_ARGUMENTS_H

#include "lang/model/model.h"
#include "lang/tape/tape.h"

typedef struct arguments arguments;

/* Finds the arguments of all leaves of the model's rules, in the model's arena. False: no memory. */
bool arguments_create(model *, arguments **);
bool arguments_bind(arguments *, const binding *); /* binds its tapes, as tape_bind does */
/* Returns the largest number of arguments of a function, at most RULE_ARGUMENTS_MOST. */
size_t arguments_most(const arguments *);
/* Writes argument k of function f at a state to out[k * functions + f]. */
void arguments_run(const arguments *, size_t functions, double t, double *x, double *v, double *out);
/* Tells whether all operations of a leaf are regular while argument k goes from low[k] to high[k]. */
bool arguments_regular(const arguments *, size_t leaf, const double *low, const double *high);

#endif
