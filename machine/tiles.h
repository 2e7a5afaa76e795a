/* The memory layout of a model of neighbours. With it a compiled model computes large systems in tiles, on several
 * threads.
 *
 * Invariant: in each part (machine/text/tiling.h) the numbers of an outer index are contiguous; parts are in the order
 * of the state's arrays.
 */
#ifndef MACHINE_TILES_H
#define MACHINE_TILES_H

#include "lang/emit/emit_local.h"
#include "lang/model/model.h"

#include <stdint.h>

typedef int64_t whole;
#include "machine/text/tiling.h"

/* Makes the tiling of a model, in its arena; every state of the model must have an index. NULL: no memory. */
const tiling *tiles_create(const model *, const locality *);

#endif
