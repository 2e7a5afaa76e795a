/* Evaluation while a model is read: of constants to numbers, of outputs into arrays. */
#ifndef LANG_MODEL_EVALUATE_H
#define LANG_MODEL_EVALUATE_H

#include "lang/model/model.h"

/* All return false after a complaint or without memory. */
bool evaluate_outputs(model *, const output *, size_t count, double t, double *const base[SPACES]);
/* Evaluates the components of a statement into the pool: arrays over [first, last] of `hull` places each, one after the
 * other from `base` on. */
bool evaluate_into_pool(model *, const output *target, const node *values, int parts, size_t base,
                        const int64_t first[], const int64_t last[], size_t hull);
/* Of a text that is nudged: a sum of constants, of which is known what its decimals say, unless it has too many terms;
 * another sum is returned as it is. */
node evaluate_sum(model *, node);
/* The same: what a scalar slot holds of a constant. */
void evaluate_held(model *, node value, uint32_t slot);
/* The same of components that a line has, and their arrays, from `first` on, over the pool. */
void evaluate_held_cells(model *, const output *target, const node *values, int parts, uint16_t first);
bool evaluate_nodes(model *, const node *, int count, double *out); /* constants */
/* Evaluates a constant. It complains where the node is not constant. */
bool evaluate_constant(model *, node, const span *at, double *value);
/* The same of one that decides more than numbers, and logs that (vary_record.h).
 * what: "step", "the start", …, or NULL for a size or an index; the text must outlive the model. */
bool evaluate_number(model *, node, const span *at, const char *what, double *value);
/* Evaluates a size or an index; returns its int slot, or -1. */
int evaluate_int(model *, node, const span *at, int64_t *value);

#endif
