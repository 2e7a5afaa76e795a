/* Changes of parameters and initial values after a model has been read: everything that was computed from them is
 * computed again.
 *
 * The log (vary_record.h) says what was computed from parameters, in the order in which it was computed. From it a
 * `vary` finds, for the places of the pool that are to change, what has to be computed again; the bits are those of
 * reading the model with the new values.
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

/* For `count` places of the pool. It refuses places that decide more than numbers, but for the step and the end where
 * the caller has its own. */
motus_status vary_create(model *, const size_t *places, size_t count, bool own_step, bool own_until, vary **,
                         motus_error *);
/* What a change of `count` places from `first` on decides besides numbers: *what is "a size or an index", "step",
 * "until" … (the first that was read), or NULL for nothing. The model is not changed. False: no memory. */
bool vary_decides(const model *, size_t first, size_t count, const motus_allocator *, const char **what);
/* From now on numbers [first, first + count) of the pool are what they are set to (yes), or again what the model's
 * lines make of them: all numbers of a parameter, of a state's x(0) or x'(0), boundary cells included. A vary made
 * before heeds it too. False: no memory. */
bool vary_override(model *, size_t first, size_t count, bool yes);
/* Writes values[k] to places[k] and computes all that follows from them: the pool, x0 and v0. False: no memory. */
bool vary_apply(vary *, const double *values);
/* For a machine that does this for many trajectories at once: what to compute, and which places of the pool differ (a
 * byte for each place). */
const vary_active *vary_entries(const vary *, uint32_t *count);
const uint8_t *vary_affected(const vary *);

#endif
