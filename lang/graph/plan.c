/* See plan.h.
 *
 * Invariant: in the order of rank, then key, each item of a region comes after the items that it needs. Sums over one
 * range and of one rank share a loop, because neither can need the other.
 */
#include "lang/graph/plan.h"
#include "lang/graph/graph_walk.h"

#include <string.h>

enum { MANY = 1 << 14 };

void *plan_room(plan *p, void *at, uint32_t count, uint32_t *capacity, size_t size)
{
    if (count < *capacity || p->failed) return at;
    const uint32_t more =
        *capacity < MANY ? *capacity : *capacity / 4; /* the old list and the new one exist together */
    const uint32_t wanted = *capacity ? *capacity + more : 32;
    void *grown = wanted > *capacity ? take_more(p->hooks, at, count, wanted, size) : NULL;
    if (!grown) {
        p->failed = true;
        return at;
    }
    *capacity = wanted;
    return grown;
}

void *plan_reserve(plan *p, size_t wanted, uint32_t *capacity, size_t size)
{
    void *room = wanted && wanted < NONE && !p->failed ? take(p->hooks, wanted, size) : NULL;
    if (room)
        *capacity = (uint32_t)wanted;
    else if (wanted)
        p->failed = true;
    return room;
}

void *plan_kept(const plan *p, arena *a, void *rows, size_t count, size_t size)
{
    void *copy = arena_room(a, (count + !count) * size);
    if (copy && count) memcpy(copy, rows, count * size);
    give(p->hooks, rows);
    return copy;
}

#define DROP(p, part) (give((p)->hooks, part), (part) = NULL)

void plan_release_items(plan *p)
{
    DROP(p, p->items.at);
    DROP(p, p->sums.at);
    DROP(p, p->order);
    DROP(p, p->table);
}

void plan_release(plan *p)
{
    plan_release_items(p);
    DROP(p, p->regions.at);
    DROP(p, p->stack.at);
    DROP(p, p->rank);
    DROP(p, p->next_output);
}

/* Regions ---------------------------------------------------------------------------------------------------------- */

uint32_t plan_home(const plan *p, unsigned deps, uint32_t region)
{
    const plan_region *r = &p->regions.at[region];
    while (r->level >= 0 && !(deps >> r->level & 1)) {
        region = r->parent;
        r = &p->regions.at[region];
    }
    if (r->level >= 0) return region;
    return deps & (DEP_TIME | DEP_STATE | DEP_D) ? AT_RUN : AT_BIND;
}

static uint32_t new_region(plan *p, uint32_t parent, int level)
{
    if (!ROOM(p, p->regions)) return NONE;
    uint32_t k = p->regions.count++;
    p->regions.at[k] = (plan_region){.parent = parent,
                                     .first_child = NONE,
                                     .next = NONE,
                                     .level = (int8_t)level,
                                     .wide_at = NONE,
                                     .outputs = NONE,
                                     .sums = NONE};
    if (parent != NONE) {
        uint32_t *link = &p->regions.at[parent].first_child;
        while (*link != NONE) link = &p->regions.at[*link].next;
        *link = k;
    }
    return k;
}

/* Returns the innermost region of the family loops of an output; outputs with equal loops share them. */
static uint32_t nest_of(plan *p, const output *o)
{
    uint32_t parent = AT_RUN;
    for (int d = 0; d < o->loops; d++) {
        bool innermost = d == o->loops - 1;
        uint32_t k = p->regions.at[parent].first_child;
        while (k != NONE && !(graph_same_range(&p->regions.at[k].range, &o->loop[d]) && !p->regions.at[k].sum &&
                              p->regions.at[k].innermost == innermost))
            k = p->regions.at[k].next;
        if (k == NONE) {
            k = new_region(p, parent, d);
            if (k == NONE) return NONE;
            p->regions.at[k].range = o->loop[d];
            p->regions.at[k].innermost = innermost;
        }
        parent = k;
    }
    return parent;
}

/* Returns the loop that totals a sum computed in region `home`. */
static uint32_t loop_of(plan *p, const graph_node *n, uint32_t rank, uint32_t home)
{
    range r = p->g->ranges[n->c];
    uint32_t k = p->regions.at[home].first_child;
    while (k != NONE && !(p->regions.at[k].sum && p->regions.at[k].level == n->level && p->regions.at[k].rank == rank &&
                          graph_same_range(&p->regions.at[k].range, &r)))
        k = p->regions.at[k].next;
    if (k != NONE) return k;
    k = new_region(p, home, n->level);
    if (k == NONE) return NONE;
    p->regions.at[k].range = r;
    p->regions.at[k].rank = rank;
    p->regions.at[k].sum = true;
    p->regions.at[home].holds_sums = true;
    /* A loop whose index is in the bounds takes one value at a time, since the bounds would differ between lanes. */
    for (uint32_t up = home; p->regions.at[up].level >= 0; up = p->regions.at[up].parent)
        if (p->regions.at[up].level == r.first.level || p->regions.at[up].level == r.last.level)
            p->regions.at[up].serial = true;
    return k;
}

/* Items ------------------------------------------------------------------------------------------------------------ */

static uint32_t slot_of(const plan *p, node n, uint32_t region)
{
    uint64_t h = ((uint64_t)region << 32 | n) * 0x9E3779B97F4A7C15u;
    uint32_t k = (uint32_t)(h >> 32) & (p->table_size - 1);
    while (p->table[k]) {
        const plan_item *i = &p->items.at[p->table[k] - 1];
        if (i->n == n && i->region == region) break;
        k = (k + 1) & (p->table_size - 1);
    }
    return k;
}

uint32_t plan_find(const plan *p, node n, uint32_t home)
{
    uint32_t k = p->table[slot_of(p, n, home)];
    return k ? k - 1 : NONE;
}

static bool grow_table(plan *p)
{
    uint32_t *old = p->table, old_size = p->table_size, size = old_size ? old_size * 2 : 64;
    uint32_t *table = take(p->hooks, size, sizeof *table);
    if (!table) return p->failed = true, false;
    p->table = table;
    p->table_size = size;
    for (uint32_t k = 0; k < old_size; k++)
        if (old[k]) table[slot_of(p, p->items.at[old[k] - 1].n, p->items.at[old[k] - 1].region)] = old[k];
    give(p->hooks, old);
    return true;
}

static uint32_t new_item(plan *p, node n, uint32_t region)
{
    if (!ROOM(p, p->items)) return NONE;
    uint32_t k = p->items.count++;
    p->items.at[k] = (plan_item){.n = n, .region = region, .outputs = NONE, .reg = NONE, .sum = NONE};
    return k;
}

/* Appends the record of a SUM, or of the update of the total of the SUM `updates`. */
static plan_sum *new_sum(plan *p, uint32_t item, uint32_t updates)
{
    if (!ROOM(p, p->sums)) return NULL;
    plan_item *i = &p->items.at[item];
    i->sum = p->sums.count++;
    p->sums.at[i->sum] =
        (plan_sum){.updates = updates, .inside = NONE, .next = NONE, .total = NONE, .key = i->n, .rank = p->rank[i->n]};
    return &p->sums.at[i->sum];
}

static void need(plan *p, node n, uint32_t region)
{
    for (int half = 0; half < 2; half++) {
        if (!ROOM(p, p->stack)) return;
        p->stack.at[p->stack.count++] = half ? region : n;
    }
}

/* Enters what a SUM needs inside its loop: the term, the condition, and the item that adds the term to the total. */
static void enter_sum(plan *p, uint32_t item)
{
    graph_node n = p->g->nodes[p->items.at[item].n];
    uint32_t inside = loop_of(p, &n, p->rank[p->items.at[item].n], p->items.at[item].region);
    plan_sum *s = inside == NONE ? NULL : new_sum(p, item, NONE);
    if (!s) return;
    s->inside = inside;
    s->next = p->regions.at[inside].sums;
    const uint32_t update = new_item(p, n.a, inside);
    plan_sum *u = update == NONE ? NULL : new_sum(p, update, item);
    if (!u) return;
    p->regions.at[inside].sums = item;
    if (n.b) {
        u->key = n.a > n.b ? n.a : n.b;
        u->rank = p->rank[n.a] > p->rank[n.b] ? p->rank[n.a] : p->rank[n.b];
        need(p, n.b, inside);
    }
    graph_node how = p->g->nodes[n.a];
    need(p, how.b, inside);
    if (how.op != OP_ADD) need(p, how.a, inside);
}

static void gather(plan *p)
{
    while (p->stack.count && !p->failed) {
        uint32_t region = p->stack.at[p->stack.count - 1];
        node n = p->stack.at[p->stack.count - 2];
        p->stack.count -= 2;
        uint32_t home = plan_home(p, p->g->nodes[n].deps, region);
        if (p->items.count + p->items.count / 4 >= p->table_size && !grow_table(p)) return;
        uint32_t slot = slot_of(p, n, home);
        if (p->table[slot]) continue;
        uint32_t item = new_item(p, n, home);
        if (item == NONE) return;
        p->table[slot] = item + 1;
        if (p->g->nodes[n].op == OP_SUM) {
            enter_sum(p, item);
        } else {
            node operand[3];
            int arity = graph_operands(&p->g->nodes[n], operand);
            for (int k = 0; k < arity; k++) need(p, operand[k], home);
        }
    }
}

static bool place_output(plan *p, uint32_t k)
{
    const output *o = &p->program->outputs[k];
    uint32_t region = nest_of(p, o);
    if (region == NONE) return false;
    need(p, o->value, region);
    gather(p);
    if (p->failed) return false;
    uint32_t home = plan_home(p, p->g->nodes[o->value].deps, region);
    uint32_t *list =
        home == region ? &p->items.at[plan_find(p, o->value, home)].outputs : &p->regions.at[region].outputs;
    p->next_output[k] = *list;
    *list = k;
    return true;
}

/* Order ------------------------------------------------------------------------------------------------------------ */

static bool before(const plan *p, uint32_t i, uint32_t j)
{
    const plan_item *a = &p->items.at[i], *b = &p->items.at[j];
    if (a->region != b->region) return a->region < b->region;
    const plan_sum own_a = {.rank = p->rank[a->n], .key = a->n, .inside = NONE, .updates = NONE},
                   own_b = {.rank = p->rank[b->n], .key = b->n, .inside = NONE, .updates = NONE},
                   *s = a->sum == NONE ? &own_a : &p->sums.at[a->sum],
                   *t = b->sum == NONE ? &own_b : &p->sums.at[b->sum];
    if (s->rank != t->rank) return s->rank < t->rank;
    bool sum_a = s->inside != NONE, sum_b = t->inside != NONE;
    if (sum_a != sum_b) return sum_a;
    if (s->key != t->key) return s->key < t->key;
    if ((s->updates != NONE) != (t->updates != NONE)) return s->updates == NONE;
    return i < j;
}

static void sift(const plan *p, uint32_t *v, uint32_t root, uint32_t count)
{
    for (uint32_t child; (child = 2 * root + 1) < count; root = child) {
        if (child + 1 < count && before(p, v[child], v[child + 1])) child++;
        if (!before(p, v[root], v[child])) return;
        uint32_t swap = v[root];
        v[root] = v[child];
        v[child] = swap;
    }
}

/* Sorts items by a heap sort, because the C library's qsort may take memory without the hooks. */
static bool sort_items(plan *p)
{
    uint32_t count = p->items.count, *v = p->order = take(p->hooks, count, sizeof *v);
    if (!v) return p->failed = true, false;
    for (uint32_t k = 0; k < count; k++) v[k] = k;
    for (uint32_t k = count / 2; k-- > 0;) sift(p, v, k, count);
    for (uint32_t k = count; k-- > 1;) {
        uint32_t swap = v[0];
        v[0] = v[k];
        v[k] = swap;
        sift(p, v, 0, k);
    }
    for (uint32_t k = 0; k < count; k++) {
        plan_region *r = &p->regions.at[p->items.at[v[k]].region];
        if (!r->item_count++) r->items = k;
    }
    return true;
}

static bool rank_nodes(plan *p)
{
    p->rank = take(p->hooks, p->g->count, sizeof *p->rank);
    for (uint32_t n = 0; p->rank && n < p->g->count; n++) {
        node operand[3];
        uint32_t rank = 0;
        for (int k = graph_operands(&p->g->nodes[n], operand); k-- > 0;)
            if (p->rank[operand[k]] > rank) rank = p->rank[operand[k]];
        p->rank[n] = rank + (p->g->nodes[n].op == OP_SUM);
    }
    return p->rank != NULL;
}

/* Chooses where lanes run: along the innermost family index or, where none does, along the innermost sum. */
static void choose_lanes(plan *p)
{
    for (uint32_t k = AT_RUN + 1; k < p->regions.count; k++) {
        plan_region *r = &p->regions.at[k];
        r->wide_at = p->regions.at[r->parent].wide_at;
        r->wide = p->blocks && !r->serial && r->wide_at == NONE && (r->sum ? !r->holds_sums : r->innermost);
        if (r->wide) r->wide_at = k;
    }
}

bool plan_is_block(const plan *p, node n, uint32_t home)
{
    uint32_t wide = p->regions.at[home].wide_at;
    return wide != NONE && p->g->nodes[n].deps >> p->regions.at[wide].level & 1;
}

bool plan_create(plan *p, arena *a, const program *program, bool blocks)
{
    *p = (plan){.hooks = &a->allocator, .g = program->graph, .program = program, .blocks = blocks};
    p->next_output = take(p->hooks, program->count, sizeof *p->next_output);
    bool ok = p->next_output && rank_nodes(p) && new_region(p, NONE, -1) != NONE && new_region(p, AT_BIND, -1) != NONE;
    RESERVE(p, p->items, p->g->count); /* without loops, each node is computed in one place */
    for (size_t k = 0; ok && k < program->count; k++) ok = place_output(p, (uint32_t)k);
    DROP(p, p->stack.at);
    ok = ok && !p->failed && sort_items(p);
    DROP(p, p->rank);
    if (ok)
        choose_lanes(p);
    else
        a->failed = true;
    return ok;
}
