/* Reads the nodes of a model as polynomials in atoms. */
#include "lang/model/algebra.h"

#include "lang/graph/graph_place.h"
#include "lang/graph/graph_walk.h"

#include <math.h>
#include <string.h>

static poly leaf(algebra *A, const graph_node *n, const int64_t *index)
{
    const model *m = A->model;
    switch ((operation)n->op) {
    case OP_CONST: return isfinite(n->value) ? algebra_number(A, n->value) : algebra_lose(A);
    case OP_INDEX: return algebra_number(A, (double)index[n->level]);
    case OP_PARAM: return algebra_number(A, m->pool[n->a]);
    case OP_TIME: return algebra_of_atom(A, algebra_place(A, SPACE_OUT, 0), 1, 1, -INFINITY);
    case OP_LOAD: break;
    default: return algebra_lose(A);
    }
    const reference *r = &m->graph->references[n->a];
    const space s = m->arrays[r->array].space;
    const size_t at = graph_element(m->arrays, r, index, m->ints);
    if (s == SPACE_POOL) return algebra_number(A, m->pool[at]);
    if (s != SPACE_X && s != SPACE_V) return algebra_lose(A);
    return algebra_of_atom(A, algebra_place(A, s, at), 1, 1, -INFINITY);
}

/* Returns a condition as a polynomial that is 0 or 1. */
static poly condition(algebra *A, const graph_node *n, poly p)
{
    const algebra_poly of = A->polys[p];
    if (of.count == 0 || (of.count == 1 && of.terms[0].of == 0)) return algebra_number(A, of.count > 0);
    return operation_is((operation)n->op, DECIDES) ? p : algebra_lose(A);
}

static poly total(algebra *A, const graph_node *n, const int64_t *around)
{
    const model *m = A->model;
    const range r = m->graph->ranges[n->c];
    int64_t index[MAX_LEVELS];
    memcpy(index, around, sizeof index);
    poly sum = algebra_number(A, 0);
    const int64_t first = graph_subscript(&r.first, index, m->ints), last = graph_subscript(&r.last, index, m->ints);
    for (int64_t k = first; k <= last && !A->lost; k++) {
        index[n->level] = k;
        poly p = 0;
        if (n->b) {
            p = condition(A, &m->graph->nodes[n->b], algebra_read(A, n->b, index));
            if (p == 0) continue; /* the term need not be defined here */
        }
        const poly body = algebra_read(A, n->a, index);
        sum = algebra_add(A, sum, 1, n->b ? algebra_times(A, p, body) : body);
    }
    return sum;
}

static poly choice(algebra *A, const graph_node *c, poly a, poly b, poly otherwise)
{
    const poly p = condition(A, c, a);
    const poly apart = algebra_times(A, p, algebra_add(A, b, -1, otherwise));
    return algebra_add(A, otherwise, 1, apart);
}

poly algebra_read(algebra *A, node root, const int64_t *index)
{
    graph *g = A->model->graph;
    graph_walk w;
    const motus_allocator *hooks = &A->arena.allocator;
    if (A->lost || !graph_order(g, &root, 1, 0, false, &w)) return algebra_lose(A);
    poly *of = take(hooks, w.count, sizeof *of), result = 0;
    if (!of) A->arena.failed = A->lost = true;
    A->work -= w.count;
    for (uint32_t k = 0; k < w.count && !A->lost; k++) {
        const graph_node n = g->nodes[w.nodes[k]];
        node operand[3] = {0, 0, 0};
        poly p[3] = {0, 0, 0};
        if (n.op == OP_SUM) {
            of[k] = total(A, &n, index);
            graph_order_again(g, &w);
            continue;
        }
        const int arity = graph_operands(&n, operand);
        for (int j = 0; j < arity; j++) p[j] = of[g->place[operand[j]]];
        if (arity == 0)
            of[k] = leaf(A, &n, index);
        else if (n.op == OP_SELECT)
            of[k] = choice(A, &g->nodes[n.a], p[0], p[1], p[2]);
        else if (n.op == OP_AND || n.op == OP_OR || n.op == OP_NOT)
            of[k] = algebra_apply(A, (operation)n.op, condition(A, &g->nodes[n.a], p[0]),
                                  arity > 1 ? condition(A, &g->nodes[n.b], p[1]) : p[1]);
        else
            of[k] = algebra_apply(A, (operation)n.op, p[0], p[1]);
    }
    if (of && !A->lost) result = of[w.count - 1];
    give(hooks, of);
    give(hooks, w.nodes);
    return A->lost ? algebra_lose(A) : result;
}
