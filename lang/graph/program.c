/* The normal form: which additions are fused with a multiplication, and how a sum runs. It defines the bits.
 *
 * Fusing. Uses are counted over the whole program: one for every operand that is this node, one for every output. A
 * product p*q is MUL(p, q), or NEG of it; it can be fused if it (and the NEG) is used once.
 *     ADD(x, y)   y a product: FMA(p, q, x); y a negated one: FNMA(p, q, x) = x - p q;
 *                 else x a product: FMA(p, q, y); x a negated one: FNMA(p, q, y)
 *     SUB(x, y)   y a product: FNMA(p, q, x); y a negated one: FMA(p, q, x);
 *                 else x a product: FMS(p, q, y); x a negated one: FMS(-p, q, y)
 * The right operand is tried first, because sums run from left to right with their running total on the left.
 *
 * Sums. SUM's total starts at +0, and a term updates it as ADD(total, term) does, fused by the same rule: the term is
 * used once by its SUM. Terms are taken in the order of the index. A term whose condition is false leaves the total
 * as it is. Up to 16 terms in the range, masked ones included: one total, left to right. More: 8 totals, term m
 * (counted from the range's first) goes to total m mod 8, and the result is ((p0+p1)+(p2+p3))+((p4+p5)+(p6+p7)). An
 * empty range is +0. A machine may divide the loop as it likes.
 */
#include "lang/graph/graph_walk.h"

typedef struct product {
    node p, q;
    bool found, negated;
} product;

typedef struct forming {
    graph *from, *to;
    graph_walk w;
    uint32_t *uses;
    node *image;    /* by place */
    bool *absorbed; /* it is used only inside a fused operation */
} forming;

static uint32_t at(const forming *f, node n) { return f->from->place[n]; }

static product product_of(const forming *f, node n)
{
    const graph_node *m = &f->from->nodes[n];
    bool negated = m->op == OP_NEG;
    if (f->uses[at(f, n)] != 1) return (product){0};
    if (negated) {
        n = m->a;
        m = &f->from->nodes[n];
        if (m->op != OP_MUL || f->uses[at(f, n)] != 1) return (product){0};
    }
    return (product){m->a, m->b, m->op == OP_MUL, negated};
}

static void absorb(forming *f, node n)
{
    f->absorbed[at(f, n)] = true;
    if (f->from->nodes[n].op == OP_NEG) f->absorbed[at(f, f->from->nodes[n].a)] = true;
}

static void choose(forming *f)
{
    for (uint32_t k = 0; k < f->w.count; k++) {
        const graph_node *n = &f->from->nodes[f->w.nodes[k]];
        const bool adds = n->op == OP_ADD || n->op == OP_SUB;
        if (adds && product_of(f, n->b).found)
            absorb(f, n->b);
        else if ((adds || n->op == OP_SUM) && product_of(f, n->a).found)
            absorb(f, n->a);
    }
}

static node image(const forming *f, node n) { return f->image[at(f, n)]; }

/* Returns c + p q or c - p q, fused. */
static node fused(forming *f, product m, bool subtract, node c)
{
    return graph_op(f->to, m.negated != subtract ? OP_FNMA : OP_FMA, image(f, m.p), image(f, m.q), c);
}

static node form_sum(forming *f, const graph_node *n)
{
    graph *g = f->to;
    node total = graph_running_total(g, n->level);
    product m = product_of(f, n->a);
    node update = m.found ? fused(f, m, false, total) : graph_op(g, OP_ADD, total, image(f, n->a), 0);
    return graph_sum(g, n->level, &f->from->ranges[n->c], n->b ? image(f, n->b) : 0, update);
}

static node form(forming *f, node old)
{
    const graph_node *n = &f->from->nodes[old];
    graph *g = f->to;
    node leaf;
    if (graph_copy_leaf(f->from, n, g, &leaf)) return leaf;
    switch (n->op) {
    case OP_SUM: return form_sum(f, n);
    case OP_ADD:
    case OP_SUB: {
        bool subtract = n->op == OP_SUB;
        product right = product_of(f, n->b);
        if (right.found) return fused(f, right, subtract, image(f, n->a));
        product left = product_of(f, n->a);
        if (left.found && !subtract) return fused(f, left, false, image(f, n->b));
        if (left.found) {
            node p = image(f, left.p);
            if (left.negated) p = graph_op(g, OP_NEG, p, 0, 0);
            return graph_op(g, OP_FMS, p, image(f, left.q), image(f, n->b));
        }
        break;
    }
    default: break;
    }
    node operand[3] = {0, 0, 0};
    for (int k = graph_operands(n, operand); k-- > 0;) operand[k] = image(f, operand[k]);
    return graph_op(g, n->op, operand[0], operand[1], operand[2]);
}

static void count_uses(forming *f, const node *roots, size_t count)
{
    for (size_t r = 0; r < count; r++) f->uses[at(f, roots[r])]++;
    for (uint32_t k = 0; k < f->w.count; k++) {
        node operand[3];
        for (int j = graph_operands(&f->from->nodes[f->w.nodes[k]], operand); j-- > 0;) f->uses[at(f, operand[j])]++;
    }
}

static bool run(forming *f, const node *roots, output *outputs, size_t count)
{
    const motus_allocator *hooks = &f->from->arena->allocator;
    if (!graph_order(f->from, roots, count, 0, true, &f->w)) return false;
    f->uses = take(hooks, f->w.count, sizeof *f->uses);
    f->image = take(hooks, f->w.count, sizeof *f->image);
    f->absorbed = take(hooks, f->w.count, sizeof *f->absorbed);
    if (f->uses && f->image && f->absorbed) {
        count_uses(f, roots, count);
        choose(f);
        uint32_t formed = 1;
        for (uint32_t k = 0; k < f->w.count; k++) formed += !f->absorbed[k];
        (void)graph_reserve(f->to, formed + formed / 8); /* sums and negated factors need more nodes */
        for (uint32_t k = 0; k < f->w.count; k++)
            if (!f->absorbed[k]) f->image[k] = form(f, f->w.nodes[k]);
        for (size_t r = 0; r < count; r++) outputs[r].value = image(f, roots[r]);
        graph_complete(f->to);
    } else {
        f->from->arena->failed = true;
    }
    give(hooks, f->absorbed);
    give(hooks, f->image);
    give(hooks, f->uses);
    give(hooks, f->w.nodes);
    return !f->from->arena->failed && !f->to->too_large;
}

program *program_create_in(arena *a, graph *g, const output *outputs, size_t count)
{
    if (count > SIZE_MAX / sizeof(output)) return g->arena->failed = true, NULL;
    program *p = arena_take(a, sizeof *p);
    output *copy = arena_room(a, (count + !count) * sizeof *copy);
    forming f = {.from = g, .to = graph_create(a)};
    node *roots = take(&g->arena->allocator, count, sizeof *roots);
    if (!roots || a->failed) g->arena->failed = true;
    bool ok = !g->arena->failed && !g->too_large;
    if (ok) {
        f.to->arrays = g->arrays;
        for (size_t r = 0; r < count; r++) {
            copy[r] = outputs[r];
            roots[r] = outputs[r].value;
        }
        ok = run(&f, roots, copy, count);
        if (a->failed) g->arena->failed = true;
    }
    give(&g->arena->allocator, roots);
    if (!ok || g->arena->failed) return NULL;
    *p = (program){f.to, copy, count};
    return p;
}

program *program_create(graph *g, const output *outputs, size_t count)
{
    return program_create_in(g->arena, g, outputs, count);
}
