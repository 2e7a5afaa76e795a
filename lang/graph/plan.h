/* Where each value of a program is computed: the plan that lang/tape/ and lang/emit/ follow.
 *
 * Regions form a tree. Region 0 runs once, when parameters are bound; its child, region 1, runs at every evaluation;
 * each region below is the inside of a loop, over an index of a family or of a sum. A value is computed in the
 * outermost region on the path to its use in which all the indices that it depends on are bound.
 */
#ifndef LANG_GRAPH_PLAN_H
#define LANG_GRAPH_PLAN_H

#include "lang/graph/graph.h"

enum { AT_BIND = 0, AT_RUN = 1 };
#define NONE UINT32_MAX /* no region, no item, no output */
#define LIST(T)                   \
    struct {                      \
        T *at;                    \
        uint32_t count, capacity; \
    }

typedef struct plan_region {
    uint32_t parent, first_child, next; /* `first_child`, `next`: loops inside, in the order in which they were met */
    int8_t level;                       /* -1: it is no loop */
    bool sum, serial, holds_sums, innermost;
    bool wide;        /* its index runs along lanes */
    uint32_t wide_at; /* the wide region on the path to here, itself included, or NONE */
    range range;
    uint32_t rank;
    uint32_t items, item_count; /* places in plan.order */
    uint32_t outputs;           /* the outputs whose value is computed further out */
    uint32_t sums;              /* the items of region `parent` that this loop totals */
    uint32_t begin, end;        /* for tape_code.c: its instructions LOOP and NEXT */
} plan_region;

/* Every operation has one, so it is small. */
typedef struct plan_item {
    node n;
    uint32_t region;
    uint32_t outputs; /* the outputs written as soon as the item is known */
    uint32_t reg;     /* for lang/tape/ and lang/emit/; NONE for a SUM until its loop is written */
    uint32_t sum;     /* its place in plan.sums if it is a SUM or updates the total of one, else NONE */
} plan_item;

typedef struct plan_sum {
    uint32_t updates; /* the item of the SUM whose total this one updates; NONE: this is a SUM */
    uint32_t inside;  /* SUM: the region of its loop */
    uint32_t next;    /* SUM: the next item of a SUM in the same loop */
    uint32_t total;   /* SUM: for lang/tape/ */
    uint32_t key;     /* the order within a rank: the node; an update's key is above those of the items that it needs */
    uint32_t rank;    /* how many sums must be finished, one after the other, before it */
} plan_sum;

typedef struct plan {
    const motus_allocator *hooks;
    graph *g;
    const program *program;
    bool blocks, failed;
    LIST(plan_region) regions;
    LIST(plan_item) items;
    LIST(plan_sum) sums;
    LIST(uint32_t) stack; /* pairs: node, region */
    uint32_t *order;      /* items by region, rank, key */
    uint32_t *rank;       /* by node */
    uint32_t *next_output;
    uint32_t *table;
    uint32_t table_size; /* by a hash of region and node: item + 1 */
} plan;

/* Makes room for one more element of a list; sets plan.failed where there is no memory. */
#define ROOM(p, list)                                                                        \
    ((list).at = plan_room(p, (list).at, (list).count, &(list).capacity, sizeof *(list).at), \
     (list).count < (list).capacity)
void *plan_room(plan *, void *at, uint32_t count, uint32_t *capacity, size_t size);
/* Makes room for a number of elements in an empty list, where that number is nearly known. */
#define RESERVE(p, list, wanted) ((list).at = plan_reserve(p, wanted, &(list).capacity, sizeof *(list).at))
void *plan_reserve(plan *, size_t wanted, uint32_t *capacity, size_t size);

/* Copies a list of which no more elements follow to an arena, and gives the list back. */
#define KEPT(p, a, list) plan_kept(p, a, (list).at, (list).count, sizeof *(list).at)
void *plan_kept(const plan *, arena *, void *rows, size_t count, size_t size);

bool plan_create(plan *, arena *, const program *, bool blocks);
void plan_release(plan *);
void plan_release_items(plan *); /* gives back everything but the regions, once all is written */
/* Returns the region that computes something with these dependences when `region` needs it. */
uint32_t plan_home(const plan *, unsigned deps, uint32_t region);
uint32_t plan_find(const plan *, node, uint32_t home); /* an item, or NONE */
bool plan_is_block(const plan *, node, uint32_t home);

/* The loop of an item that is a SUM, and the SUM whose total an item updates, or NONE. */
static inline uint32_t plan_inside(const plan *p, const plan_item *i)
{
    return i->sum == NONE ? NONE : p->sums.at[i->sum].inside;
}
static inline uint32_t plan_updates(const plan *p, const plan_item *i)
{
    return i->sum == NONE ? NONE : p->sums.at[i->sum].updates;
}

#endif
