/* The log of what a model computes from parameters, and of the numbers that its structure and settings take; vary.h follows changes by it. */
#ifndef LANG_MODEL_VARY_RECORD_H
#define LANG_MODEL_VARY_RECORD_H

#include "lang/model/model.h"

struct vary_entry {                  /* outputs that were computed into the pool, as SPACE_OUT arrays over the pool */
    output *outputs;
    int parts;
    size_t base, hull;               /* the places: parts × hull from base on */
    const uint8_t *map; uint8_t rank;        /* cells whose map is above the rank belong to another line; NULL: none do */
};

/* False: no memory. `array` caches 1 + the number of the first SPACE_OUT array of this shape; target: subscripts and loops. */
bool vary_record(model *, const output *target, const node *values, int parts, size_t base, int dims, const int64_t first[], const int64_t last[], size_t hull,
                 const uint8_t *map, uint8_t rank, uint16_t *array);
bool vary_record_scalar(model *, node, uint32_t slot);
void vary_freeze(model *, node, const char *what);

#endif
