/* Evaluation while a model is read: constants become numbers, and outputs fill arrays. */
#ifndef LANG_MODEL_EVALUATE_H
#define LANG_MODEL_EVALUATE_H

#include "lang/model/model.h"

/* Evaluates outputs. It and the functions below return false after a complaint or without memory. */
bool evaluate_outputs(model *, const output *, size_t count, double t, double *const base[SPACES]);
/* Evaluates the components of a statement into the pool: into arrays over [first, last] of `hull` places each, which
 * lie side by side from `base` on. */
bool evaluate_into_pool(model *, const output *target, const node *values, int parts, size_t base,
                        const int64_t first[], const int64_t last[], size_t hull);
/* Returns the node for a sum in a shadow. If the sum is constant and has not too many terms, its exact value is
 * known. */
node evaluate_sum(model *, node);
/* Puts into a scalar slot what the shadow's constant `value` is. */
void evaluate_held(model *, node value, uint32_t slot);
/* Puts into the pool what the shadow's constants of a line are; the arrays of its components begin at `first`. */
void evaluate_held_cells(model *, const output *target, const node *values, int parts, uint16_t first);
bool evaluate_nodes(model *, const node *, int count, double *out); /* evaluates constants */
/* Evaluates a constant. Complains where the node is not constant. */
bool evaluate_constant(model *, node, const span *at, double *value);
/* Evaluates a constant that decides more than numbers, and logs that (vary_record.h). what: "step", "the start", …, or
 * NULL for a size or an index; the text must outlive the model. */
bool evaluate_number(model *, node, const span *at, const char *what, double *value);
/* Evaluates a size or an index, and returns its int slot, or -1. */
int evaluate_int(model *, node, const span *at, int64_t *value);

#endif
