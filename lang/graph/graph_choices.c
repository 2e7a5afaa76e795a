/* Choices among the sides of one surface, written as choices between its two sides.
 *
 * Where u > w, u < w and u = w have a value each, the last one is that of an instant, or of a motion that is held at u
 * = w; what holds the motion there lies between the values of both sides, whatever the model says [Filippov88].
 */
#include "lang/base/operation.h"
#include "lang/graph/graph_walk.h"

/* A surface where two operands are equal; a comparison is true where `above` is the larger one. */
typedef struct surface {
    node above, below;
} surface;

static bool surface_of(const graph *g, node condition, surface *s)
{
    const graph_node *const n = &g->nodes[condition];
    const bool greater = n->op == OP_GT || n->op == OP_GE, less = n->op == OP_LT || n->op == OP_LE;
    *s = greater ? (surface){n->a, n->b} : (surface){n->b, n->a};
    return greater || less;
}

static bool is_on(const surface *s, node a, node b)
{
    return (s->above == a && s->below == b) || (s->above == b && s->below == a);
}

/* Returns whether u = w is the surface of a sign. */
static bool is_sign_of(const graph *g, const graph_node *n, node u, node w)
{
    const graph_node *const a = &g->nodes[n->a], *const to = &g->nodes[w];
    const bool nothing = to->op == OP_CONST && to->value == 0;
    return n->op == OP_SIGN && ((nothing && n->a == u) || (a->op == OP_SUB && is_on(&(surface){a->a, a->b}, u, w)));
}

/* Returns whether a value has a factor that the side of the surface u = w chooses. */
static bool chosen_by(const graph *g, node value, node u, node w)
{
    const graph_node *const n = &g->nodes[value];
    surface s;
    switch (n->op) {
    case OP_NEG:
    case OP_DIV: return chosen_by(g, n->a, u, w);
    case OP_MUL: return chosen_by(g, n->a, u, w) || chosen_by(g, n->b, u, w);
    case OP_SIGN: return is_sign_of(g, n, u, w);
    case OP_SELECT: return surface_of(g, n->a, &s) && is_on(&s, u, w);
    default: return false;
    }
}

static node choose(graph *g, node condition, node then, node otherwise)
{
    const graph_node c = g->nodes[condition], other = g->nodes[otherwise];
    surface one, two;
    if (c.op == OP_NOT) return choose(g, c.a, otherwise, then);
    if (c.op == OP_EQ && chosen_by(g, otherwise, c.a, c.b)) return otherwise;
    if (c.op == OP_NE && chosen_by(g, then, c.a, c.b)) return then;
    if (other.op == OP_SELECT && surface_of(g, condition, &one) && surface_of(g, other.a, &two) &&
        is_on(&one, two.above, two.below))
        otherwise = one.above == two.above ? other.c : other.b;
    return graph_op(g, OP_SELECT, condition, then, otherwise);
}

static node of_sum(graph *g, graph_node n)
{
    const node body = graph_choices(g, n.a), condition = n.b ? graph_choices(g, n.b) : 0;
    if (g->arena->failed || g->too_large || (n.b && !condition)) return 0;
    const range r = g->ranges[n.c];
    return graph_sum(g, n.level, &r, condition, body);
}

node graph_choices(graph *g, node root)
{
    const unsigned moving = DEP_TIME | DEP_STATE;
    graph_walk w;
    if (!(g->nodes[root].deps & moving) || !graph_order(g, &root, 1, moving, false, &w)) return root;
    node *as = graph_walk_room(g, &w, sizeof *as);
    for (uint32_t k = 0; as && k < w.count; k++) {
        as[k] = w.nodes[k];
        if (g->nodes[w.nodes[k]].op == OP_SUM) as[k] = of_sum(g, g->nodes[w.nodes[k]]);
    }
    graph_order_again(g, &w);
    for (uint32_t k = 0; as && k < w.count && !g->arena->failed && !g->too_large; k++) {
        const graph_node n = g->nodes[w.nodes[k]];
        node operand[3];
        bool same;
        if (n.op == OP_SUM || !graph_operands_as(g, &w, &n, as, operand, &same)) continue;
        if (n.op == OP_SELECT)
            as[k] = choose(g, operand[0], operand[1], operand[2]);
        else if (!same)
            as[k] = graph_op(g, (operation)n.op, operand[0], operand[1], operand[2]);
    }
    const node result = as && w.count ? as[w.count - 1] : root;
    give(&g->arena->allocator, as);
    give(&g->arena->allocator, w.nodes);
    return g->arena->failed || g->too_large ? root : result;
}
