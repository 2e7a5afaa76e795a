/* Memory of one model: blocks that double in size, each filled from the front.
 *
 * Invariant: everything between a block's `used` and its `size` is still zero, as take() gave it.
 */
#include "lang/base/arena.h"

#include <string.h>

typedef struct arena_block {
    struct arena_block *next;
    size_t used, size; /* bytes after this header */
    bool alone;        /* it holds a single piece */
} arena_block;

enum {
    FIRST_BLOCK = 16 << 10,
    LARGEST_BLOCK = 1 << 20,
    SMALLEST_ALONE = 16 << 10, /* bytes from which a piece gets a block of its own */
    LINE = 64,                 /* bytes of a cache line */
    ARRAY = 512                /* bytes from which a piece begins at a cache line; objects are smaller, and packed */
};

void arena_init(arena *a, const motus_allocator *allocator)
{
    *a = (arena){0};
    if (allocator) a->allocator = *allocator;
}

void arena_release(arena *a)
{
    for (arena_block *b = a->blocks, *next; b; b = next) {
        next = b->next;
        give(&a->allocator, b);
    }
    a->blocks = NULL;
    a->failed = false;
}

/* The hooks promise only malloc's alignment, so the address is rounded up, not the offset. */
static char *carve(arena_block *b, size_t bytes, size_t align)
{
    char *start = (char *)(b + 1);
    uintptr_t at = (uintptr_t)(start + b->used);
    size_t gap = (size_t)(-at & (align - 1));
    if (gap > b->size - b->used || bytes > b->size - b->used - gap) return NULL;
    char *p = start + b->used + gap;
    b->used += gap + bytes;
    return p;
}

static void *none(arena *a, size_t bytes)
{
    a->failed = true;
    if (bytes > ARENA_SPARE) return NULL;
    memset(a->spare, 0, sizeof a->spare);
    return a->spare;
}

void *arena_take(arena *a, size_t bytes)
{
    size_t align = bytes >= ARRAY ? LINE : bytes % 16 == 0 ? 16 : bytes % 8 == 0 ? 8 : bytes % 4 == 0 ? 4 : 1;
    if (a->blocks && !a->blocks->alone && bytes < SMALLEST_ALONE) {
        char *p = carve(a->blocks, bytes, align);
        if (p) return p;
    }
    if (bytes > SIZE_MAX / 4) return none(a, bytes);
    size_t size = a->blocks ? a->blocks->size * 2 : FIRST_BLOCK;
    if (size > LARGEST_BLOCK) size = LARGEST_BLOCK;
    /* a large piece gets a block of its own, so that it can be given back; the open block stays open */
    bool alone = bytes >= SMALLEST_ALONE || bytes > size / 2;
    if (alone) size = bytes + LINE;
    arena_block *b = take(&a->allocator, 1, sizeof *b + size);
    if (!b) return none(a, bytes);
    b->size = size;
    b->alone = alone;
    if (alone && a->blocks) {
        b->next = a->blocks->next;
        a->blocks->next = b;
    } else {
        b->next = a->blocks;
        a->blocks = b;
    }
    return carve(b, bytes, align);
}

void *arena_room(arena *a, size_t bytes)
{
    void *p = arena_take(a, bytes);
    return p == a->spare ? NULL : p; /* the next failed request would overwrite the spare */
}

void *arena_grow(arena *a, void *old, size_t old_bytes, size_t new_bytes)
{
    void *p = arena_room(a, new_bytes);
    if (p && old_bytes) memcpy(p, old, old_bytes < new_bytes ? old_bytes : new_bytes);
    return p;
}

/* Returns the link to the block that a piece has to itself; NULL: the piece shares its block. */
static arena_block **alone(arena *a, const void *piece)
{
    for (arena_block **link = &a->blocks; *link; link = &(*link)->next) {
        const char *start = (const char *)(*link + 1);
        if ((const char *)piece >= start && (const char *)piece < start + (*link)->size)
            return (*link)->alone ? link : NULL;
    }
    return NULL;
}

void arena_drop(arena *a, const void *piece, size_t bytes)
{
    arena_block **link = piece && bytes >= SMALLEST_ALONE ? alone(a, piece) : NULL;
    if (!link) return;
    arena_block *done = *link;
    *link = done->next;
    give(&a->allocator, done);
}

void *arena_replace(arena *a, void *old, size_t old_bytes, size_t new_bytes)
{
    void *p = arena_grow(a, old, old_bytes, new_bytes);
    if (p) arena_drop(a, old, old_bytes);
    return p;
}

bool arena_more(arena *a, void *list, size_t count, uint32_t *room, size_t size)
{
    if (count < *room) return true;
    const uint32_t wider = *room + *room / 2 + 16;
    void *old;
    memcpy(&old, list, sizeof old);
    void *more = arena_replace(a, old, count * size, wider * size);
    if (!more) return false;
    memcpy(list, &more, sizeof more);
    *room = wider;
    return true;
}

char *arena_text(arena *a, const char *text, size_t length)
{
    char *p = length < SIZE_MAX ? arena_take(a, length + 1) : NULL;
    if (!p) return a->failed = true, NULL;
    if (p == a->spare) return p; /* the empty text */
    memcpy(p, text, length);
    p[length] = 0;
    return p;
}
