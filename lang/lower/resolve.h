/* Definitions and settings to numbers. All return false after a complaint, or where there is no memory. */
#ifndef LANG_LOWER_RESOLVE_H
#define LANG_LOWER_RESOLVE_H

#include "lang/model/model.h"

/* A parameter's values into the pool; of a quantity with an index, the range. */
bool resolve_definition(model *, model_definition *);
bool resolve_start_time(model *);
/* A constant and finite expression; what: its name in messages, which must outlive the model. */
bool resolve_constant(model *, const tree *, const char *what, double *out);

#endif
