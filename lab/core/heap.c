/* malloc, calloc, realloc and free, instead of the C library's, which are ten times as large.
 *
 * The memory of the module from the end of its data on is a chain of blocks without gaps. Free blocks are also in
 * lists, one for each power of 2 of their size, so that a search is short. Invariant: no two neighbours are free, a
 * block begins 8 bytes below a multiple of 16, and the chain ends with a block in use that has no size.
 */
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

typedef struct block {
    uint32_t size;              /* a multiple of 16, and 1 more where it is in use; what follows it is the next block */
    uint32_t below;             /* the size of the block that ends here; 0: this is the first */
    struct block *next, **from; /* where it is free: in its list, and what points to it */
} block;

enum { UNIT = 16, HEAD = 8, PAGE = 65536, LISTS = 28 };

extern char __heap_base; /* the linker's */
static block *lists[LISTS];
static block *chain_end;

static block *after(block *b) { return (block *)((char *)b + (b->size & ~1U)); }
static int list_of(uint32_t size) { return 27 - __builtin_clz(size); }

static void insert(block *b)
{
    block **list = &lists[list_of(b->size)];
    after(b)->below = b->size;
    b->from = list;
    b->next = *list;
    if (b->next) b->next->from = &b->next;
    *list = b;
}

static void withdraw(block *b)
{
    *b->from = b->next;
    if (b->next) b->next->from = b->from;
}

/* A block that is free, and in no list yet, with its free neighbours. */
static void release(block *b)
{
    block *above = after(b), *below = (block *)((char *)b - b->below);
    if (!(above->size & 1)) {
        withdraw(above);
        b->size += above->size;
    }
    if (b->below && !(below->size & 1)) {
        withdraw(below);
        below->size += b->size;
        b = below;
    }
    insert(b);
}

/* Makes the chain longer, by `size` at least. */
static bool extend(uint32_t size)
{
    if (!chain_end) {
        chain_end = (block *)((((uintptr_t)&__heap_base + HEAD + UNIT - 1) & ~(uintptr_t)(UNIT - 1)) - HEAD);
        chain_end->below = 0;
    }
    const uintptr_t end = (uintptr_t)chain_end + size + HEAD, room = __builtin_wasm_memory_size(0) * (uintptr_t)PAGE;
    if (end > room && __builtin_wasm_memory_grow(0, (end - room + PAGE - 1) / PAGE) == SIZE_MAX) return false;
    block *b = chain_end;
    chain_end = (block *)(__builtin_wasm_memory_size(0) * (uintptr_t)PAGE - HEAD);
    chain_end->size = 1;
    b->size = (uint32_t)((char *)chain_end - (char *)b);
    release(b);
    return true;
}

static block *find(uint32_t size)
{
    for (int k = list_of(size); k < LISTS; k++)
        for (block *b = lists[k]; b; b = b->next)
            if (b->size >= size) return b;
    return NULL;
}

/* Under a name of its own, so that the compiler does not make a call of calloc from malloc and memset in calloc. */
static void *reserve(size_t bytes)
{
    if (bytes > INT32_MAX) return NULL;
    const uint32_t size = ((uint32_t)bytes + HEAD + UNIT - 1) & ~(uint32_t)(UNIT - 1);
    block *b = find(size);
    if (!b) b = extend(size) ? find(size) : NULL;
    if (!b) return NULL;
    withdraw(b);
    if (b->size > size) {
        block *rest = (block *)((char *)b + size);
        rest->size = b->size - size;
        rest->below = size;
        b->size = size;
        insert(rest);
    }
    b->size |= 1;
    return (char *)b + HEAD;
}

void *malloc(size_t bytes) { return reserve(bytes); }

void free(void *at)
{
    if (!at) return;
    block *b = (block *)((char *)at - HEAD);
    b->size &= ~1U;
    release(b);
}

void *calloc(size_t count, size_t bytes)
{
    if (bytes && count > SIZE_MAX / bytes) return NULL;
    void *at = reserve(count * bytes);
    return at ? memset(at, 0, count * bytes) : NULL;
}

void *realloc(void *old, size_t bytes)
{
    void *at = malloc(bytes);
    if (!at || !old) return at;
    const size_t had = (((block *)((char *)old - HEAD))->size & ~1U) - HEAD;
    memcpy(at, old, had < bytes ? had : bytes);
    free(old);
    return at;
}
