/* Memory of one model: taken in pieces, released at once.
 *
 * arena_take: a small object; arena_room: an array; arena_grow: a larger copy of one; arena_replace: a larger
 * copy in its place; arena_text: a copy of a text.
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
/* zeroed; 64-byte aligned for requests of 512 bytes and more */
void *arena_take(arena *, size_t bytes);
void *arena_room(arena *, size_t bytes); /* the same; NULL when there is no memory, also for small requests */
void *arena_grow(arena *, void *old, size_t old_bytes, size_t new_bytes); /* a copy in larger room */
/* The same; the memory of the old piece goes back to the hooks where it is large enough to have had a block of its own:
 * nothing may point into it any more. */
void *arena_replace(arena *, void *old, size_t old_bytes, size_t new_bytes);
void arena_drop(arena *, const void *piece, size_t bytes);  /* gives its memory back, if it is as large as that */
char *arena_text(arena *, const char *text, size_t length); /* a copy that ends with 0 */
void arena_release(arena *);

#endif
