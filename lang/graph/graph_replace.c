/* Puts other nodes in place of loads, indices and sums within a node.
 *
 * Invariant: a node that contains none of these stays what it is. Only nested sums recurse, at most MAX_LEVELS deep.
 */
#include "lang/graph/graph_walk.h"
#include "lang/base/operation.h"

typedef struct replacing {
    unsigned deps;
    graph_substitute with;
    void *ctx;
} replacing;

static node replaced(graph *g, node root, int level, const replacing *how);

/* Replaces within a sum, which is empty where its condition has become false. */
static node replaced_sum(graph *g, graph_node n, const replacing *how)
{
    const node body = replaced(g, n.a, n.level + 1, how), condition = n.b ? replaced(g, n.b, n.level + 1, how) : 0;
    if (g->arena->failed || g->too_large || (n.b && !condition)) return 0;
    const range r = g->ranges[n.c];
    return graph_sum(g, n.level, &r, condition, body);
}

static node replaced(graph *g, node root, int level, const replacing *how)
{
    graph_walk w;
    if (!(g->nodes[root].deps & how->deps)) return root;
    if (!graph_order(g, &root, 1, how->deps, false, &w)) return 0;
    node *as = graph_walk_room(g, &w, sizeof *as);
    /* Leaves first: `with` may walk the graph itself, which overwrites `place`. */
    for (uint32_t k = 0; as && k < w.count; k++) {
        const graph_node n = g->nodes[w.nodes[k]];
        const bool asked = n.op == OP_LOAD || n.op == OP_INDEX || n.op == OP_SUM;
        as[k] = asked ? how->with(g, w.nodes[k], level, how->ctx) : w.nodes[k];
        if (n.op == OP_SUM && as[k] == w.nodes[k]) as[k] = replaced_sum(g, n, how);
    }
    graph_order_again(g, &w);
    for (uint32_t k = 0; as && k < w.count && !g->arena->failed && !g->too_large; k++) {
        const graph_node n = g->nodes[w.nodes[k]];
        node operand[3];
        bool same;
        if (n.op == OP_SUM || !graph_operands_as(g, &w, &n, as, operand, &same) || same) continue;
        as[k] = graph_op(g, (operation)n.op, operand[0], operand[1], operand[2]);
    }
    return graph_walk_end(g, &w, as);
}

node graph_replace(graph *g, node root, unsigned deps, int level, graph_substitute with, void *ctx)
{
    return replaced(g, root, level, &(replacing){deps, with, ctx});
}
