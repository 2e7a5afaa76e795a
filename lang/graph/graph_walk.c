/* Reads a graph: what a node reaches, its degree in the state, its kinks, the places that it loads.
 *
 * Invariant: only nested sums recurse, at most MAX_LEVELS deep, so no expression needs much C stack. Nothing here makes
 * nodes.
 */
#include "lang/graph/graph_walk.h"
#include "lang/base/operation.h"

#include <math.h>

int graph_operands(const graph_node *n, node out[3])
{
    out[0] = n->a, out[1] = n->b, out[2] = n->c;
    if (n->op == OP_SUM) return n->b ? 2 : 1;
    return operation_at(n->op)->arity;
}

static bool push(graph *g, graph_walk *w, node n)
{
    if (w->count == w->capacity) {
        uint32_t capacity = w->capacity ? w->capacity * 2 : 64;
        node *nodes = take_more(&g->arena->allocator, w->nodes, w->count, capacity, sizeof *nodes);
        if (!nodes) return g->arena->failed = true, false;
        w->nodes = nodes;
        w->capacity = capacity;
    }
    w->nodes[w->count++] = n;
    return true;
}

bool graph_order(graph *g, const node *roots, size_t count, unsigned deps, bool into_sums, graph_walk *w)
{
    /* `place` needs no clearing: a node is reached if the list has it at its place. A node is expanded once, so the
     * stack has fewer than three entries a node. */
    graph_walk stack = {0};
    *w = (graph_walk){0};
    bool ok = true;
    for (size_t r = 0; ok && r < count; r++) {
        ok = push(g, &stack, roots[r]);
        while (ok && stack.count) {
            node n = stack.nodes[stack.count - 1], operand[3];
            if (graph_reached(g, w, n)) {
                stack.count--;
                continue;
            }
            const graph_node *m = &g->nodes[n];
            int k = m->op == OP_SUM && !into_sums ? 0 : graph_operands(m, operand);
            uint32_t before = stack.count;
            while (ok && k-- > 0)
                if (!graph_reached(g, w, operand[k]) && (!deps || g->nodes[operand[k]].deps & deps))
                    ok = push(g, &stack, operand[k]);
            if (ok && stack.count == before) {
                stack.count--;
                g->place[n] = w->count;
                ok = push(g, w, n);
            }
        }
    }
    give(&g->arena->allocator, stack.nodes);
    if (!ok) {
        give(&g->arena->allocator, w->nodes);
        *w = (graph_walk){0};
    }
    return ok;
}

void graph_order_again(graph *g, const graph_walk *w)
{
    for (uint32_t k = 0; k < w->count; k++) g->place[w->nodes[k]] = k;
}

void *graph_walk_room(graph *g, const graph_walk *w, size_t size)
{
    void *room = take(&g->arena->allocator, w->count, size);
    if (!room) g->arena->failed = true;
    return room;
}

node graph_walk_end(graph *g, const graph_walk *w, node *image)
{
    const node last = image && w->count ? image[w->count - 1] : 0;
    give(&g->arena->allocator, image);
    give(&g->arena->allocator, w->nodes);
    return g->arena->failed || g->too_large ? 0 : last;
}

/* Degree ----------------------------------------------------------------------------------------------------------- */

static int at_most_2(int degree) { return degree > 2 ? 2 : degree; }

static int larger(int a, int b) { return a > b ? a : b; }

int graph_degree(graph *g, node root, unsigned deps)
{
    if (!(g->nodes[root].deps & deps)) return 0;
    graph_walk w;
    if (!graph_order(g, &root, 1, deps, true, &w)) return 2;
    uint8_t *degree = graph_walk_room(g, &w, 1);
    int result = 2;
    for (uint32_t k = 0; degree && k < w.count; k++) {
        const graph_node *n = &g->nodes[w.nodes[k]];
        node operand[3];
        int d[3] = {0, 0, 0};
        for (int j = graph_operands(n, operand); j-- > 0;)
            d[j] = graph_reached(g, &w, operand[j]) ? degree[g->place[operand[j]]] : 0;
        switch ((degree_rule)operation_at(n->op)->degree) {
        case DEGREE_LEAF: result = (n->deps & deps) != 0; break;
        case DEGREE_SUM: result = d[1] ? 2 : d[0]; break;
        case DEGREE_LINEAR: result = larger(d[0], d[1]); break;
        case DEGREE_PRODUCT: result = at_most_2(d[0] + d[1]); break;
        case DEGREE_QUOTIENT: result = d[1] ? 2 : d[0]; break;
        case DEGREE_FUSED: result = larger(at_most_2(d[0] + d[1]), d[2]); break;
        case DEGREE_CHOICE: result = d[0] ? 2 : larger(d[1], d[2]); break;
        case DEGREE_CURVED: result = d[0] || d[1] || d[2] ? 2 : 0; break;
        }
        degree[k] = (uint8_t)result;
    }
    give(&g->arena->allocator, degree);
    give(&g->arena->allocator, w.nodes);
    return result;
}

/* Kinks ------------------------------------------------------------------------------------------------------------ */

static bool kinks(operation op) { return operation_is(op, BENDS); }
static bool jumps(operation op) { return operation_is(op, JUMPS); }
static bool sharp(operation op) { return operation_at(op)->nature & (HAS_POLE | STEEP_AT_0 | STEEP_AT_ENDS); }

/* Finds the first moving node of a kind. A node of parameters, modes and indices alone does not count, since its value
 * stays on one side. */
static node first_moving(graph *g, node root, bool (*is)(operation))
{
    const unsigned moving = DEP_TIME | (DEP_STATE & ~DEP_MODE) | DEP_D;
    graph_walk w;
    node found = 0;
    if (!graph_order(g, &root, 1, moving, true, &w)) return 0;
    for (uint32_t k = 0; !found && k < w.count; k++) {
        const graph_node *n = &g->nodes[w.nodes[k]];
        unsigned deps = n->op == OP_SELECT ? g->nodes[n->a].deps : n->op == OP_DIV ? g->nodes[n->b].deps : n->deps;
        if (is((operation)n->op) && deps & moving) found = w.nodes[k];
        graph_directed direction;
        if (graph_direction(g, w.nodes[k], &direction)) found = w.nodes[k];
    }
    give(&g->arena->allocator, w.nodes);
    return found;
}

node graph_kink(graph *g, node root) { return first_moving(g, root, kinks); }
node graph_jump(graph *g, node root) { return first_moving(g, root, jumps); }
node graph_sharp(graph *g, node root) { return first_moving(g, root, sharp); }

bool graph_flat(graph *g, node root)
{
    const unsigned moving = DEP_TIME | (DEP_STATE & ~DEP_MODE) | DEP_D;
    graph_walk w;
    if (!(g->nodes[root].deps & moving)) return true;
    uint8_t *flat = NULL;
    bool result = false;
    if (graph_order(g, &root, 1, moving, true, &w)) flat = take(&g->arena->allocator, w.count, 1);
    if (!flat) g->arena->failed = true;
    for (uint32_t k = 0; flat && k < w.count; k++) {
        const graph_node *n = &g->nodes[w.nodes[k]];
        node operand[3];
        const int count = graph_operands(n, operand);
        result = count > 0;
        for (int j = n->op == OP_SELECT ? 1 : 0; j < count; j++)
            result &= !graph_reached(g, &w, operand[j]) || flat[g->place[operand[j]]];
        result |= operation_is((operation)n->op, IS_FLAT);
        flat[k] = result;
    }
    give(&g->arena->allocator, flat);
    give(&g->arena->allocator, w.nodes);
    return result;
}

static bool has_domain(const graph *g, const graph_node *n)
{
    if (n->op == OP_POW) return g->nodes[n->b].op != OP_CONST || g->nodes[n->b].value != floor(g->nodes[n->b].value);
    return operation_is(n->op, HAS_DOMAIN);
}

node graph_domain(graph *g, node root)
{
    graph_walk w;
    node found = 0;
    if (!graph_order(g, &root, 1, DEP_MODE, true, &w)) return 0;
    for (uint32_t k = 0; !found && k < w.count; k++)
        if (has_domain(g, &g->nodes[w.nodes[k]]) && g->nodes[w.nodes[k]].deps & DEP_MODE) found = w.nodes[k];
    give(&g->arena->allocator, w.nodes);
    return found;
}

static bool steep(const graph *g, const graph_node *n)
{
    const graph_node *const power = &g->nodes[n->b];
    return operation_is(n->op, STEEP_AT_0) ||
           (n->op == OP_POW && power->op == OP_CONST && power->value > 0 && power->value < 1);
}

size_t graph_steep(graph *g, node root, size_t most, node *of)
{
    const unsigned moving = DEP_TIME | (DEP_STATE & ~DEP_MODE);
    graph_walk w;
    size_t count = 0;
    if (!graph_order(g, &root, 1, moving, false, &w)) return 0;
    for (uint32_t k = 0; count < most && k < w.count; k++) {
        const graph_node *n = &g->nodes[w.nodes[k]];
        if (!steep(g, n)) continue;
        node u = n->a;
        while (g->nodes[u].op == OP_ABS || g->nodes[u].op == OP_NEG) u = g->nodes[u].a;
        bool known = !(g->nodes[u].deps & moving);
        for (size_t i = 0; i < count; i++) known |= of[i] == u;
        if (!known) of[count++] = u;
    }
    give(&g->arena->allocator, w.nodes);
    return count;
}

/* Loads ------------------------------------------------------------------------------------------------------------ */

typedef struct visit_loads {
    graph *g;
    space space;
    unsigned deps;
    void (*visit)(void *ctx, const reference *, const range *sums, int first_level, int inside);
    void *ctx;
} visit_loads;

typedef struct nest {
    range range[MAX_LEVELS];
    int first, inside;
} nest;

static void loads_below(const visit_loads *v, const node *roots, size_t count, const nest *around)
{
    graph *g = v->g;
    graph_walk w;
    if (!graph_order(g, roots, count, v->deps, false, &w)) return;
    for (uint32_t k = 0; k < w.count; k++) {
        const graph_node *n = &g->nodes[w.nodes[k]];
        if (n->op == OP_LOAD && g->arrays[g->references[n->a].array].space == v->space) {
            reference ref = g->references[n->a];
            v->visit(v->ctx, &ref, around->range, around->first, around->inside);
        } else if (n->op == OP_SUM && n->deps & v->deps) {
            /* the body of a sum at level l cannot use levels above l other than its own */
            nest inner = *around;
            if (!inner.inside || n->level < inner.first) {
                inner.first = n->level;
                inner.inside = 0;
            }
            while (inner.inside < n->level - inner.first)
                inner.range[inner.inside++] = (range){{-1, -1, -1, 0}, {-1, -1, -1, -1}};
            inner.range[n->level - inner.first] = g->ranges[n->c];
            inner.inside = n->level - inner.first + 1;
            node inside[2] = {n->a, n->b};
            loads_below(v, inside, n->b ? 2 : 1, &inner);
        }
    }
    give(&g->arena->allocator, w.nodes);
}

void graph_loads(graph *g, node root, space s,
                 void (*visit)(void *ctx, const reference *, const range *sums, int first_level, int inside), void *ctx)
{
    static const uint16_t of_space[SPACES] = {
        [SPACE_X] = DEP_X | DEP_MODE, [SPACE_V] = DEP_V,        [SPACE_A] = DEP_A,  [SPACE_DX] = DEP_D,
        [SPACE_DV] = DEP_D,           [SPACE_POOL] = DEP_PARAM, [SPACE_OUT] = DEP_A};
    visit_loads v = {g, s, of_space[s], visit, ctx};
    loads_below(&v, &root, 1, &(nest){.first = MAX_LEVELS});
}
