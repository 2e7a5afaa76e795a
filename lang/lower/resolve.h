/* The values of parameters and of the start. All functions return false after a complaint or without memory. */
#ifndef LANG_LOWER_RESOLVE_H
#define LANG_LOWER_RESOLVE_H

#include "lang/model/model.h"

/* Computes a parameter into the pool; of a quantity with an index, only its range. */
bool resolve_definition(model *, model_definition *);
/* Finds the start from every x(c), which must agree, and from `from`. */
bool resolve_start_time(model *);
/* Evaluates an expression that must be constant and finite, and logs what it decides. what: its name in messages, which
 * must outlive the model. */
bool resolve_constant(model *, const tree *, const char *what, double *out);
/* Evaluates an expression that must be constant and finite, logs nothing, and returns its node, too. */
bool resolve_varying(model *, const tree *, const char *what, node *, double *out);

#endif
