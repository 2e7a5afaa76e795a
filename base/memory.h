/* Memory by the user's hooks (motus_allocator; NULL or without functions: malloc and free).
 *
 * The words of the house: take and give are one block and its return, by the hooks. An arena (lang/arena.h) takes
 * such blocks and hands out pieces of them that live as long as the model. The program and the tests, which have no
 * hooks, say malloc and free.
 */
#ifndef BASE_MEMORY_H
#define BASE_MEMORY_H

#include "motus.h"

/* count × bytes, zeroed; NULL when there is none or the product is too large. */
void *take(const motus_allocator *, size_t count, size_t bytes);
/* A larger block for a list of `used` elements, which are copied; the old one is given back. NULL when there is
 * none: the old one stands. */
void *take_more(const motus_allocator *, void *old, size_t used, size_t count, size_t bytes);
void give(const motus_allocator *, void *);

#endif
