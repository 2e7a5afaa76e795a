/* Memory by the user's hooks.
 *
 * Invariant: a block is zeroed. A product of count and size that does not fit a size_t is refused like a block for
 * which there is no memory.
 */
#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

void *take(const motus_allocator *allocator, size_t count, size_t bytes)
{
    if (bytes && count > SIZE_MAX / bytes) return NULL;
    size_t all = count * bytes;
    if (!all) all = 1;
    /* Fresh pages of calloc come zeroed without being touched. */
    if (!allocator || !allocator->allocate) return calloc(1, all);
    void *block = allocator->allocate(allocator->context, all);
    if (block) memset(block, 0, all);
    return block;
}

void *take_more(const motus_allocator *allocator, void *old, size_t used, size_t count, size_t bytes)
{
    void *block = take(allocator, count, bytes);
    if (!block) return NULL;
    if (used) memcpy(block, old, used * bytes);
    give(allocator, old);
    return block;
}

void give(const motus_allocator *allocator, void *block)
{
    if (!block) return;
    if (!allocator || !allocator->allocate)
        free(block);
    else if (allocator->release)
        allocator->release(allocator->context, block);
}
