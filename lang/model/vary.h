/* Changes of parameters and initial values after a model has been read: everything computed from them is computed
 * again.
 *
 * The log (vary_record.h) lists what was computed from parameters, in its order. From it a `vary` finds what must be
 * computed again when places of the pool change. The bits are those of reading the model with the new values.
 */
#ifndef LANG_MODEL_VARY_H
#define LANG_MODEL_VARY_H

#include "lang/model/vary_record.h"

typedef struct vary vary;
typedef struct vary_active {
    const vary_entry *entry;
    program *program;
    struct tape *tape;
} vary_active;

/* Makes a vary for `count` places of the pool. Refuses places that decide more than numbers, but for the step and the
 * end if the caller has its own. */
motus_status vary_create(model *, const size_t *places, size_t count, bool own_step, bool own_until, vary **,
                         motus_error *);
/* Finds what a change of `count` places from `first` on decides besides numbers: *what is "a size or an index", "step",
 * "until" … (the first in the text), or NULL. The model is not changed. False: no memory. */
bool vary_decides(const model *, size_t first, size_t count, const motus_allocator *, const char **what);
/* Returns a byte for each place of the pool, in the model's arena: whether its number follows from those of the array.
 * NULL: no memory. */
uint8_t *vary_follows(model *, const array *);
/* Makes a byte for each place of the pool, which the caller gives back: whether it is marked in `affected` (or NULL),
 * was overridden, or follows from such a place. False: no memory. */
bool vary_changed(const model *, const uint8_t *affected, const motus_allocator *, uint8_t **);
/* Marks numbers [first, first + count) of the pool as set (yes), so that no line computes them, or as computed by lines
 * again: all numbers of a parameter or of a state's x(0) or x'(0), with boundary cells. It applies to varies made
 * before, too. False: no memory. */
bool vary_override(model *, size_t first, size_t count, bool yes);
/* Writes values[k] to places[k], and computes the numbers that depend on them: the pool, x0 and v0. False: no
 * memory. */
bool vary_apply(vary *, const double *values);
/* For a machine that varies many trajectories at once: the entries to compute, and a byte for each place of the pool:
 * whether it differs. */
const vary_active *vary_entries(const vary *, uint32_t *count);
const uint8_t *vary_affected(const vary *);

#endif
