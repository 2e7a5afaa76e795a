/* The memory of one model: taken in pieces, released at once.
 *
 * arena_take is for a small object, arena_room for an array, arena_grow for a larger copy of an array, arena_replace
 * for a larger copy in its place, and arena_text for a copy of a text.
 *
 * Invariant: arena_take of up to ARENA_SPARE bytes never returns NULL. When memory has run out it sets `failed` and
 * returns the spare block, so callers may write before they check; code that loops or recurses checks `failed` first.
 * All other requests that cannot be met return NULL and set `failed`. (There is no longjmp because WebAssembly has
 * none.)
 */
#ifndef LANG_BASE_ARENA_H
#define LANG_BASE_ARENA_H

#include "core/system.h"

enum { ARENA_SPARE = 512 };

typedef struct arena {
    motus_allocator allocator;
    struct arena_block *blocks;
    bool failed;
    _Alignas(max_align_t) char spare[ARENA_SPARE]; /* a block from the hooks is aligned no more strictly */
} arena;

void arena_init(arena *, const motus_allocator *);
/* Returns zeroed memory; requests of 512 bytes and more are 64-byte aligned. */
void *arena_take(arena *, size_t bytes);
void *arena_room(arena *, size_t bytes); /* zeroed; NULL when there is no memory, however small the request */
void *arena_grow(arena *, void *old, size_t old_bytes, size_t new_bytes); /* a copy in a larger piece */
/* Copies a piece into a larger one, and gives the old memory back to the hooks if it had a block of its own: nothing
 * may point into it any more. */
void *arena_replace(arena *, void *old, size_t old_bytes, size_t new_bytes);
/* Makes room for one more element of a list, *(T **)list, into which nothing may point. False: there is no memory. */
bool arena_more(arena *, void *list, size_t count, uint32_t *room, size_t size);
void arena_drop(arena *, const void *piece, size_t bytes);  /* gives back a block of its own */
char *arena_text(arena *, const char *text, size_t length); /* a copy that ends with 0 */
void arena_release(arena *);

#endif
