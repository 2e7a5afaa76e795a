/* Memory by the user's hooks (motus_allocator; NULL or without functions: malloc and free).
 *
 * take gets one block, give returns it. What lives as long as a model is taken from its arena, which gets such blocks:
 * arena_take, arena_room, arena_grow (lang/base/arena.h). The program, the page and the tests have no hooks, and use
 * malloc and free.
 */
#ifndef BASE_MEMORY_H
#define BASE_MEMORY_H

#include "motus.h"

/* Takes count × bytes, zeroed. NULL: there is no memory, or the product is too large. */
void *take(const motus_allocator *, size_t count, size_t bytes);
/* Takes a larger block for a list of `used` elements, copies them, and gives the old block back. NULL: there is no
 * memory; the old block stays. */
void *take_more(const motus_allocator *, void *old, size_t used, size_t count, size_t bytes);
void give(const motus_allocator *, void *);

#endif
