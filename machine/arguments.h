/* The arguments of the operations in the functions of rules that are no polynomials. Where each of these operations is
 * regular over all values that its arguments take in a step, no feature of the function is narrow beside points that
 * resolve the arguments (core/rules.h).
 */
#ifndef MACHINE_ARGUMENTS_H
#define MACHINE_ARGUMENTS_H

#include "lang/model/model.h"
#include "lang/tape/tape.h"

typedef struct arguments arguments;

/* Of all leaves of the model's rules, numbered in their order. Lives in the model's arena. False: no memory. */
bool arguments_create(model *, arguments **);
bool arguments_bind(arguments *, const binding *); /* as tape_bind */
/* How many a function has, at most RULE_ARGUMENTS_MOST. */
size_t arguments_most(const arguments *);
/* Argument k of function f at a state is out[k * functions + f]. */
void arguments_run(const arguments *, size_t functions, double t, double *x, double *v, double *out);
/* Whether all operations of a leaf are regular while its arguments go from low[k] to high[k]. */
bool arguments_regular(const arguments *, size_t leaf, const double *low, const double *high);

#endif
