/* See least.h. */
#include "machine/least.h"

#include <math.h>

/* Returns how far a leaf may be from its value at the centre. */
static node half_width(graph *g, node leaf, void *of)
{
    const model *m = of;
    graph_shift shift = {(uint16_t)(3 * m->block_size), (uint16_t)(3 * m->block_size)};
    return graph_seed_direction(g, leaf, &shift);
}

/* Bounds the distance of a value from that at the centre; the factor 1.001 leaves room for rounding. */
node least_radius(model *m, node value)
{
    graph *g = m->graph;
    if (graph_deps(g, value) & (DEP_TIME | DEP_A)) return graph_const(g, INFINITY);
    return graph_op(g, OP_MUL, graph_radius(g, value, half_width, m), graph_const(g, 1.001), 0);
}

static bool known(const model *m, node value) { return !(graph_deps(m->graph, value) & (DEP_TIME | DEP_A)); }

node least_size(model *m, node value)
{
    graph *g = m->graph;
    if (!known(m, value)) return graph_const(g, -1);
    return graph_op(g, OP_SUB, graph_op(g, OP_ABS, value, 0, 0), least_radius(m, value), 0);
}

output *least_sizes(model *m, size_t *count)
{
    *count = 0;
    for (uint32_t i = 0; i < m->rule_count; i++) *count += m->rules[i].leaves;
    output *out = arena_room(m->arena, (*count + 1) * sizeof *out), *to = out;
    for (uint32_t i = 0; i < m->rule_count && out; i++)
        for (size_t k = 0; k < m->rules[i].leaves; k++, to++) {
            *to = m->rules[i].leaf[k];
            to->value = least_size(m, to->value);
        }
    return out;
}

bool least_bounded(const model *m)
{
    bool all = m->rule_functions > 0 && !m->located;
    for (uint32_t i = 0; i < m->rule_count; i++)
        for (size_t k = 0; k < m->rules[i].leaves; k++) all &= known(m, m->rules[i].leaf[k].value);
    return all;
}

node least_rate(model *m, node value, node rate)
{
    return graph_jump(m->graph, value) ? graph_const(m->graph, -1) : least_size(m, rate);
}
