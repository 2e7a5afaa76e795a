/* Quantities that --record adds to a model: what its events keep, count(bounce), time(bounce, last), at(bounce, 3, x').
 * Each has a name that the model's text does not contain, and is told by what was asked for.
 */
#ifndef CLI_MODEL_DEFINED_H
#define CLI_MODEL_DEFINED_H

#include "base/error.h"

typedef struct defined {
    char **line; /* "recorded1 = count(bounce)" */
    size_t count;
} defined;

/* Those of a list of --record, NULL: none. Call defined_free() also after a failure. */
motus_status defined_find(defined *, const char *list, const char *text, motus_error *);
void defined_free(defined *);
/* The name of the quantity for an item, of `length` bytes in *length; NULL: it is none. */
const char *defined_name(const defined *, const char *item, size_t *length);
/* What was asked for, where `column` is such a quantity or a component of it; *rest: what follows the name in it. */
const char *defined_label(const defined *, const char *column, const char **rest);

#endif
