/* The table of nodes: makes leaves and sums, and shares every node that exists already. */
#include "lang/graph/graph_walk.h"

#include <math.h>
#include <string.h>

enum { FIRST_NODES = 64, MANY_NODES = 1 << 15, FIRST_REFERENCES = 16 };

graph *graph_create(arena *a)
{
    graph *g = arena_take(a, sizeof *g);
    graph_node *nodes = arena_take(a, FIRST_NODES * sizeof *nodes);
    uint32_t *place = arena_take(a, FIRST_NODES * sizeof *place);
    node *table = arena_take(a, 2 * FIRST_NODES * sizeof *table);
    if (a->failed) return NULL;
    *g = (graph){.arena = a,
                 .nodes = nodes,
                 .place = place,
                 .capacity = FIRST_NODES,
                 .table = table,
                 .table_size = 2 * FIRST_NODES};
    g->count = 1; /* node 0: zeroed memory is OP_CONST, value +0; in the table 0 means free */
    return g;
}

const graph_node *graph_at(const graph *g, node n) { return &g->nodes[n]; }

unsigned graph_deps(const graph *g, node n) { return g->nodes[n].deps; }

/* Sharing ---------------------------------------------------------------------------------------------------------- */

static uint64_t mix(uint64_t h, uint64_t x)
{
    h = (h ^ x) * 0x9E3779B97F4A7C15u;
    return h ^ h >> 29;
}

static uint64_t bits_of(double x)
{
    uint64_t u;
    memcpy(&u, &x, sizeof u);
    return u;
}

static uint64_t hash_subscript(uint64_t h, const subscript *s)
{
    h = mix(h, (uint64_t)(uint8_t)s->level << 32 | (uint32_t)s->literal);
    return mix(h, (uint64_t)(uint16_t)s->slot << 16 | (uint16_t)s->modulus);
}

bool graph_same_subscript(const subscript *s, const subscript *t)
{
    return s->level == t->level && s->slot == t->slot && s->modulus == t->modulus && s->literal == t->literal;
}

bool graph_same_range(const range *a, const range *b)
{
    return graph_same_subscript(&a->first, &b->first) && graph_same_subscript(&a->last, &b->last);
}

bool graph_same_reference(const reference *a, const reference *b)
{
    bool same = a->array == b->array && a->dims == b->dims;
    for (int d = 0; same && d < a->dims; d++) same = graph_same_subscript(&a->at[d], &b->at[d]);
    return same;
}

/* Hashes a node. LOAD and SUM hold the number of a reference or range, and are equal where these are. */
static uint64_t hash_node(const graph_node *n, const reference *ref, const range *r)
{
    uint64_t h = mix(n->op, n->level);
    if (ref) {
        h = mix(h, (uint64_t)ref->array << 8 | ref->dims);
        for (int d = 0; d < ref->dims; d++) h = hash_subscript(h, &ref->at[d]);
        return h;
    }
    if (n->op == OP_CONST) return mix(h, bits_of(n->value));
    h = mix(h, (uint64_t)n->a << 32 | n->b);
    return r ? hash_subscript(hash_subscript(h, &r->first), &r->last) : mix(h, n->c);
}

static bool same_node(const graph *g, const graph_node *n, const graph_node *m, const reference *ref, const range *r)
{
    if (n->op != m->op || n->level != m->level) return false;
    if (ref) return graph_same_reference(&g->references[m->a], ref);
    if (n->op == OP_CONST) return bits_of(n->value) == bits_of(m->value);
    if (n->a != m->a || n->b != m->b) return false;
    if (r) return graph_same_range(r, &g->ranges[m->c]);
    return n->c == m->c;
}

static void fill_table(const graph *g)
{
    for (uint32_t k = 1; k < g->count; k++) {
        const graph_node *n = &g->nodes[k];
        uint64_t h =
            hash_node(n, n->op == OP_LOAD ? &g->references[n->a] : NULL, n->op == OP_SUM ? &g->ranges[n->c] : NULL);
        while (g->table[h & (g->table_size - 1)]) h++;
        g->table[h & (g->table_size - 1)] = k;
    }
}

void graph_cut(graph *g, uint32_t count)
{
    g->count = count;
    memset(g->table, 0, g->table_size * sizeof *g->table);
    fill_table(g);
}

bool graph_reserve(graph *g, uint32_t capacity)
{
    if (capacity > GRAPH_NODES_MAX) capacity = GRAPH_NODES_MAX;
    if (capacity <= g->capacity) return true;
    uint32_t size = g->table_size;
    while (size < capacity + capacity / 4) size *= 2;
    graph_node *nodes = arena_replace(g->arena, g->nodes, g->capacity * sizeof *nodes, capacity * sizeof *nodes);
    if (!nodes) return false;
    g->nodes = nodes;
    uint32_t *place = arena_replace(g->arena, g->place, g->capacity * sizeof *place, capacity * sizeof *place);
    if (!place) return false;
    g->place = place;
    if (g->typed) {
        graph_typed *typed = arena_replace(g->arena, g->typed, g->capacity * sizeof *typed, capacity * sizeof *typed);
        if (!typed) return false;
        g->typed = typed;
    }
    g->capacity = capacity;
    if (size == g->table_size) return true;
    arena_drop(g->arena, g->table, g->table_size * sizeof *g->table);
    g->table = arena_room(g->arena, size * sizeof *g->table);
    if (!g->table) return false;
    g->table_size = size;
    fill_table(g);
    return true;
}

void graph_complete(graph *g)
{
    arena_drop(g->arena, g->table, g->table_size * sizeof *g->table);
    g->table = NULL;
    g->table_size = 0;
}

/* Grows a large graph only by an eighth, because the old copy and the new one exist together. */
static bool grow_nodes(graph *g)
{
    if (g->count >= GRAPH_NODES_MAX) return g->too_large = true, false;
    return graph_reserve(g, g->capacity + g->capacity / (g->capacity < MANY_NODES ? 2 : 8));
}

/* Grows a table of references or ranges. Its capacity is a power of two, so the count tells when to grow. */
static void *grow_rows(graph *g, void *rows, uint32_t count, size_t size)
{
    if (count && (count < FIRST_REFERENCES || (count & (count - 1)))) return rows;
    return arena_replace(g->arena, rows, count * size, (count ? 2 * (size_t)count : FIRST_REFERENCES) * size);
}

static bool same_number(double a, double b) { return a == b && signbit(a) == signbit(b); }

/* Returns whether what is known of a constant equals `typed`; NULL: nothing but its number. */
static bool same_typed(const graph *g, node n, const graph_typed *typed)
{
    if (!g->typed || g->nodes[n].op != OP_CONST) return true;
    const graph_typed *const t = &g->typed[n];
    if (!typed || !t->known) return !typed && !t->known;
    return same_number(t->plain, typed->plain) && t->is.high == typed->is.high && t->is.low == typed->is.low &&
           t->is.error == typed->is.error;
}

/* Returns the node with these members. typed: what is known of a constant; NULL: nothing but its number. */
static node share_typed(graph *g, graph_node n, const reference *ref, const range *r, const graph_typed *typed)
{
    if (g->arena->failed || g->too_large) return 0;
    uint64_t h = hash_node(&n, ref, r);
    for (node k; (k = g->table[h & (g->table_size - 1)]) != 0; h++)
        if (same_node(g, &n, &g->nodes[k], ref, r) && same_typed(g, k, typed)) return k;
    if (ref) {
        reference *rows = grow_rows(g, g->references, g->reference_count, sizeof *rows);
        if (!rows) return 0;
        g->references = rows;
        n.a = g->reference_count;
        rows[g->reference_count++] = *ref;
    }
    if (r) {
        range *rows = grow_rows(g, g->ranges, g->range_count, sizeof *rows);
        if (!rows) return 0;
        g->ranges = rows;
        n.c = g->range_count;
        rows[g->range_count++] = *r;
    }
    if (g->count == g->capacity) {
        if (!grow_nodes(g)) return 0;
        h = hash_node(&n, ref, r);
        while (g->table[h & (g->table_size - 1)]) h++;
    }
    g->nodes[g->count] = n;
    if (g->typed) g->typed[g->count] = typed ? *typed : (graph_typed){.known = false};
    g->table[h & (g->table_size - 1)] = g->count;
    return g->count++;
}

static node share(graph *g, graph_node n, const reference *ref, const range *r)
{
    return share_typed(g, n, ref, r, NULL);
}

node graph_share(graph *g, graph_node n) { return share(g, n, NULL, NULL); }

/* Leaves ----------------------------------------------------------------------------------------------------------- */

node graph_const(graph *g, double value)
{
    return bits_of(value) ? share(g, (graph_node){.op = OP_CONST, .value = value}, NULL, NULL) : 0;
}

node graph_typed_const(graph *g, double value, const graph_typed *typed)
{
    return share_typed(g, (graph_node){.op = OP_CONST, .value = value}, NULL, NULL, typed);
}

node graph_time(graph *g) { return share(g, (graph_node){.op = OP_TIME, .deps = DEP_TIME}, NULL, NULL); }

node graph_param(graph *g, uint32_t pool_slot)
{
    return share(g, (graph_node){.op = OP_PARAM, .deps = DEP_PARAM, .a = pool_slot}, NULL, NULL);
}

node graph_index(graph *g, int level)
{
    return share(g, (graph_node){.op = OP_INDEX, .level = (uint8_t)level, .deps = (uint16_t)(1 << level)}, NULL, NULL);
}

node graph_running_total(graph *g, int level)
{
    return share(g, (graph_node){.op = OP_TOTAL, .level = (uint8_t)level, .deps = (uint16_t)(1 << level)}, NULL, NULL);
}

static unsigned subscript_deps(const subscript *s)
{
    return (s->level >= 0 ? 1u << s->level : 0) | (s->slot >= 0 || s->modulus >= 0 ? (unsigned)DEP_PARAM : 0);
}

node graph_load(graph *g, const reference *of)
{
    const reference copy = *of, *ref = &copy; /* the references of the graph may move */
    static const uint16_t of_space[SPACES] = {
        [SPACE_X] = DEP_X,  [SPACE_V] = DEP_V,        [SPACE_A] = DEP_A,  [SPACE_DX] = DEP_D,
        [SPACE_DV] = DEP_D, [SPACE_POOL] = DEP_PARAM, [SPACE_OUT] = DEP_A};
    unsigned deps = g->arrays[ref->array].mode ? DEP_MODE : of_space[g->arrays[ref->array].space];
    for (int d = 0; d < ref->dims; d++) deps |= subscript_deps(&ref->at[d]);
    return share(g, (graph_node){.op = OP_LOAD, .deps = (uint16_t)deps}, ref, NULL);
}

node graph_table(graph *g, uint16_t array)
{
    return share(g, (graph_node){.op = OP_TABLE, .deps = DEP_PARAM, .a = array}, NULL, NULL);
}

bool graph_copy_leaf(const graph *from, const graph_node *n, graph *to, node *out)
{
    switch (n->op) {
    case OP_CONST: return *out = graph_const(to, n->value), true;
    case OP_TIME: return *out = graph_time(to), true;
    case OP_PARAM: return *out = graph_param(to, n->a), true;
    case OP_INDEX: return *out = graph_index(to, n->level), true;
    case OP_LOAD: return *out = graph_load(to, &from->references[n->a]), true;
    case OP_TABLE: return *out = graph_table(to, (uint16_t)n->a), true;
    default: return false;
    }
}

node graph_sum(graph *g, int level, const range *r, node condition, node body)
{
    unsigned deps = g->nodes[body].deps | g->nodes[condition].deps;
    if (g->simplify && graph_is_const(g, body, 0)) return 0;
    deps &= ~(1u << level);
    deps |= subscript_deps(&r->first) | subscript_deps(&r->last);
    graph_node n = {.op = OP_SUM, .level = (uint8_t)level, .deps = (uint16_t)deps, .a = body, .b = condition};
    const range copy = *r; /* the ranges of the graph may move */
    return share(g, n, NULL, &copy);
}

size_t graph_shape(arena *of, array *a, space space, size_t base, int dims, const int64_t first[], const int64_t last[])
{
    size_t count = 1;
    extent *over = dims ? arena_take(of, sizeof *over) : NULL;
    *a = (array){.space = (uint8_t)space, .dims = (uint8_t)dims, .base = base, .over = over};
    for (int d = dims - 1; d >= 0; d--) {
        over->first[d] = first[d];
        over->last[d] = last[d];
        over->stride[d] = (int64_t)count;
        count *= (size_t)(last[d] - first[d] + 1);
    }
    return count;
}

bool graph_marked(const array *a, const uint8_t *marks)
{
    size_t last = a->base;
    for (int d = 0; d < a->dims; d++) last += (size_t)((a->over->last[d] - a->over->first[d]) * a->over->stride[d]);
    for (size_t k = a->base; k <= last; k++)
        if (marks[k]) return true;
    return false;
}
