/* What follows when parameters or initial values change after a model has been read: everything that was computed from them, again.
 *
 * While a model is read, resolve.c and start.c tell what they compute from parameters (vary_record) and which numbers of the model's structure
 * or settings they take (vary_frozen). A `vary` then knows, for places of the pool that are to change, what has to be computed anew and in which
 * order; the bits are those of reading the model with these values.
 */
#ifndef LANG_VARY_H
#define LANG_VARY_H

#include "lang/lower.h"

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

typedef struct vary vary;
typedef struct vary_active { const vary_entry *entry; program *program; struct tape *tape; } vary_active;

/* For `count` places of the pool. Settings that are given by the caller (`step`, `until`) may depend on them. */
motus_status vary_create(model *, const size_t *places, size_t count, bool own_step, bool own_until, vary **, motus_error *);
/* What a change of `count` places from `first` on decides besides numbers: *what is "a size or an index", "step", "until" … (the first in the
 * order in which the model was read), or NULL: nothing.
 * Leaves no trace in the model. False: no memory. */
bool vary_decides(const model *, size_t first, size_t count, const motus_allocator *, const char **what);
/* From now on numbers [first, first + count) of the pool are what they are set to (yes), or again what the model's lines
 * make of them: all numbers of a parameter, of a state's x(0) or x'(0), boundary cells included. A vary made before heeds
 * it too. False: no memory. */
bool vary_override(model *, size_t first, size_t count, bool yes);
/* values[k] to places[k], and all that follows: the pool, x0 and v0. False: no memory. */
bool vary_apply(vary *, const double *values);
/* For a machine that does the same for many trajectories at once: what to compute, and what differs (one byte for each place of the pool). */
const vary_active *vary_entries(const vary *, uint32_t *count);
const uint8_t *vary_affected(const vary *);

#endif
