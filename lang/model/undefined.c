/* See undefined.h. All nodes of a formula are evaluated, at the state and on both sides of it. */
#include "lang/model/undefined.h"

#include "base/memory.h"
#include "lang/graph/graph_place.h"
#include "lang/graph/graph_walk.h"
#include "lang/model/evaluate.h"

#include <math.h>
#include <string.h>

enum { NODES_MOST = 4096 };
#define BESIDE 0x1p-20 /* as far on either side the term is looked at */
#define AGREE 1e-4     /* so near the values there are to one another where it has a limit */

/* The values of nodes at a state, every number of which is moved by this. */
static bool values(model *m, const node *nodes, size_t count, double t, const double *x, const double *v, double by,
                   double *room, double *out)
{
    double *const to_x = room, *const to_v = room + m->nx + 1;
    const uint32_t arrays = m->array_count;
    uint16_t first;
    output *o = model_take_arrays(m, (int)count, &first) ? take(&m->arena->allocator, count, sizeof *o) : NULL;
    for (size_t k = 0; k < m->nx; k++) to_x[k] = x[k] + by * fmax(1, fabs(x[k]));
    for (size_t k = 0; k < m->nv; k++) to_v[k] = v[k] + by * fmax(1, fabs(v[k]));
    for (size_t k = 0; o && k < count; k++) {
        graph_shape(m->arena, &m->arrays[first + k], SPACE_OUT, k, 0, NULL, NULL);
        o[k] = (output){.value = nodes[k], .to = {.array = (uint16_t)(first + k)}};
    }
    double *base[SPACES] = {[SPACE_X] = to_x, [SPACE_V] = to_v, [SPACE_OUT] = out};
    const bool known = o && evaluate_outputs(m, o, count, t, base);
    m->array_count = arrays; /* only this call needs them */
    give(&m->arena->allocator, o);
    return known;
}

/* The first node that is no number, although its operands are. */
static size_t first_undefined(const graph *g, const graph_walk *w, const double *value)
{
    for (size_t k = 0; k < w->count; k++) {
        node of[3];
        const graph_node *n = graph_at(g, w->nodes[k]);
        bool numbers = !isfinite(value[k]);
        for (int i = graph_operands(n, of) - 1; i >= 0 && numbers; i--) numbers = isfinite(value[g->place[of[i]]]);
        if (numbers) return k;
    }
    return SIZE_MAX;
}

static void describe(model *m, const graph_walk *w, size_t at, const double *value, const double *before,
                     const double *after, undefined_term *out)
{
    const graph_node *n = graph_at(m->graph, w->nodes[at]);
    const bool divides = n->op == OP_DIV && value[m->graph->place[n->b]] == 0;
    model_print(m, w->nodes[at], out->term, sizeof out->term);
    if (divides) model_print(m, n->b, out->divisor, sizeof out->divisor);
    out->both = divides && value[m->graph->place[n->a]] == 0;
    const double middle = (before[at] + after[at]) / 2;
    out->has_limit = out->both && fabs(before[at] - after[at]) <= AGREE * fmax(1, fabs(middle));
    out->limit = fabs(middle) < AGREE ? 0 : middle;
}

/* Whether all nodes can be evaluated by themselves. */
static bool single(const graph *g, const graph_walk *w)
{
    bool all = w->count <= NODES_MOST;
    for (size_t k = 0; k < w->count && all; k++)
        all = !(graph_deps(g, w->nodes[k]) & (DEP_LEVELS | DEP_D)) && graph_at(g, w->nodes[k])->op != OP_SUM;
    return all;
}

static const output *formula_of(const model *m, size_t which)
{
    for (size_t k = 0; k < m->accel_count; k++) {
        const output *o = &m->accel[k];
        if (o->loops == 0 && graph_element(m->arrays, &o->to, NULL, m->ints) == which) return o;
    }
    return NULL;
}

bool undefined_find(model *m, size_t which, double t, const double *x, const double *v, undefined_term *out)
{
    const output *o = formula_of(m, which);
    graph_walk w;
    *out = (undefined_term){.has_limit = false};
    if (!o || !graph_order(m->graph, &o->value, 1, 0, false, &w)) return false;
    const size_t count = w.count;
    double *const room = take(&m->arena->allocator, 3 * count + m->nx + m->nv + 2, sizeof *room);
    double *const value = room, *const before = room + count, *const after = before + count, *const to = after + count;
    bool found = room && single(m->graph, &w) && values(m, w.nodes, count, t, x, v, 0, to, value) &&
                 values(m, w.nodes, count, t, x, v, -BESIDE, to, before) &&
                 values(m, w.nodes, count, t, x, v, BESIDE, to, after);
    if (found) {
        graph_order_again(m->graph, &w);
        const size_t at = first_undefined(m->graph, &w, value);
        found = at != SIZE_MAX;
        if (found) describe(m, &w, at, value, before, after, out);
    }
    give(&m->arena->allocator, room);
    give(&m->arena->allocator, w.nodes);
    return found;
}
