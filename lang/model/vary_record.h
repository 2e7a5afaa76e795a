/* The log of a model: what is computed from parameters while the model is read, and which constants decide a size, an
 * index or a setting. */
#ifndef LANG_MODEL_VARY_RECORD_H
#define LANG_MODEL_VARY_RECORD_H

#include "lang/model/model.h"

/* Outputs that were evaluated into the pool, as SPACE_OUT arrays over it. A number in a scalar slot has no entry in the
 * log, because every line of the text may be one: see vary_line. */
typedef struct vary_entry {
    output *outputs;
    int parts;
    size_t base, hull; /* its places: parts × hull of them, from `base` on */
    const uint8_t *map;
    uint8_t rank;              /* cells with map > rank keep their value; map NULL: none does */
    const struct table *table; /* it is a table (table.h), and has no outputs; or NULL */
} vary_entry;

/* Logs an evaluation, if it depends on parameters. target: its subscripts and loops; `array` keeps 1 + the number of
 * the first SPACE_OUT array of this shape. False: no memory. */
bool vary_record(model *, const output *target, const node *values, int parts, size_t base, int dims,
                 const int64_t first[], const int64_t last[], size_t hull, const uint8_t *map, uint8_t rank,
                 uint16_t *array);
bool vary_record_scalar(model *, node, uint32_t slot);
bool vary_record_table(model *, const struct table *);
/* Returns the entry of a line, made in the model's arena if it has none. NULL: no memory. */
const vary_entry *vary_record_entry(model *, const struct vary_line *);
/* Logs that a node decides `what` (see evaluate_number). */
void vary_freeze(model *, node, const char *what);

#endif
