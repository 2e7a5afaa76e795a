/* What a compiled model is told about its own shape, so that large systems can be taken in tiles, by several threads.
 *
 * Invariant: the numbers of an outer index lie together, part by part, in the order of the state's arrays. */
#ifndef MACHINE_TILES_H
#define MACHINE_TILES_H

#include "lang/emit/emit_local.h"
#include "lang/model/model.h"

#include <stdint.h>

typedef int64_t whole;
#include "machine/text/tiling.h"

/* In the model's arena; NULL where there is no memory. Every state must have an index. */
const tiling *tiles_create(const model *, const locality *);

#endif
