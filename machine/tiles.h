/* The memory layout of a model of neighbours, by which a compiled model computes large systems in tiles, by several
 * threads.
 *
 * Invariant: the numbers of an outer index are contiguous in each part; parts are in the order of the state's arrays.
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
