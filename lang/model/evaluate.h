/* Evaluation while a model is read: constants to numbers, outputs to their places. */
#ifndef LANG_MODEL_EVALUATE_H
#define LANG_MODEL_EVALUATE_H

#include "lang/model/model.h"

/* All of these: false after a complaint, or where there is no memory. */
bool evaluate_outputs(model *, const output *, size_t count, double t, double *const base[SPACES]);
/* The components of a statement into the pool: arrays over [first, last], one after the other from `base` on, each with `hull` places. */
bool evaluate_into_pool(model *, const output *target, const node *values, int parts, size_t base, const int64_t first[], const int64_t last[], size_t hull);
bool evaluate_nodes(model *, const node *, int count, double *out);        /* constants */
/* A number that decides something besides numbers; complains where the node is not constant. what: "step", "the start", …, or NULL for a
 * size or an index; the text must outlive the model. */
bool evaluate_number(model *, node, span at, const char *what, double *value);
/* A size or an index: the int slot in which it lies, or -1. */
int evaluate_int(model *, node, span at, int64_t *value);

#endif
