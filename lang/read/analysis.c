/* The traits that follow from the form of the equations: what they depend on, whether velocity enters linearly, whether
 * the exact motion is known. api/system/symmetry.c finds those that need a proof or samples (gradient, gyroscopic). */
#include "lang/read/read_steps.h"

/* Seeds the derivative along a direction of v; da/dv is constant if the result depends on the direction alone. */
static node seed_velocity(graph *g, node leaf, void *shift)
{
    const graph_node *n = graph_at(g, leaf);
    if (n->op != OP_LOAD || g->arrays[g->references[n->a].array].space != SPACE_V) return 0;
    return graph_seed_direction(g, leaf, shift);
}

typedef struct reading {
    const model *model;
    bool first_order;
} reading;

static void see_load(void *ctx, const reference *ref, const range *sums, int first_level, int inside)
{
    reading *r = ctx;
    (void)sums, (void)first_level, (void)inside;
    const model_state *s = model_state_of(r->model, ref->array);
    r->first_order |= !s || s->order == 1;
}

/* Returns whether v enters only the right sides of first-order variables, and nothing reads these. */
static bool only_follow(model *m)
{
    reading r = {.model = m};
    for (size_t i = 0; i < m->accel_count && !r.first_order; i++) {
        const output *o = &m->accel[i];
        if (!(graph_deps(m->graph, o->value) & DEP_V)) continue;
        const model_state *s = model_state_of(m, o->to.array);
        if (!s || s->order == 2) return false;
        graph_loads(m->graph, o->value, SPACE_V, see_load, &r);
    }
    return !r.first_order;
}

void analysis_traits(model *m)
{
    graph *g = m->graph;
    traits *t = &m->traits;
    *t = (traits){.linear_v = true,
                  .constant_jv = true,
                  .affine = true,
                  .constant = true,
                  .smooth = true,
                  .series = true,
                  .first_order = m->nv > m->nx,
                  .time = m->driven};
    graph_shift shift = {(uint16_t)(3 * m->block_size), (uint16_t)(3 * m->block_size)};
    for (size_t i = 0; i < m->accel_count; i++) {
        node n = m->accel[i].value;
        unsigned deps = graph_deps(g, n);
        t->velocity |= (deps & DEP_V) != 0;
        t->time |= (deps & DEP_TIME) != 0;
        t->constant &= !(deps & (DEP_STATE | DEP_TIME));
        t->linear_v &= graph_degree(g, n, DEP_V) <= 1;
        t->affine &= graph_degree(g, n, DEP_V | DEP_X | DEP_MODE) <= 1;
        t->smooth &= !graph_kink(g, n);
        if (deps & DEP_V)
            t->constant_jv &= !(graph_deps(g, graph_derivative(g, n, seed_velocity, &shift)) & (DEP_STATE | DEP_TIME));
    }
    t->constant &= !m->driven;
    t->constant_jv &= t->linear_v;
    t->quadrature = t->velocity && t->first_order && only_follow(m);
}

/* Recognises a constant acceleration a: the exact motion is x = x(0) + x'(0) τ + a τ²/2 with τ = t - start, so no exact
 * line is needed. */
static bool recognise_constant(model *m)
{
    graph *g = m->graph;
    m->exact = arena_room(m->arena, 2 * m->accel_count * sizeof *m->exact);
    if (!m->exact) return false;
    node tau = graph_op(g, OP_SUB, graph_time(g), graph_const(g, m->start), 0);
    for (size_t i = 0; i < m->accel_count; i++) {
        output o = m->accel[i];
        const uint16_t number = (uint16_t)(o.to.array - m->block[BLOCK_A]);
        const model_state *s = model_state_of(m, o.to.array);
        reference at = o.to;
        at.array = (uint16_t)(s->start_array[0] + number - s->array);
        node x0 = graph_load(g, &at);
        at.array = (uint16_t)(s->start_array[1] + number - s->array);
        node v0 = graph_load(g, &at), a = o.value;
        node drift = graph_op(g, OP_MUL, v0, tau, 0), gain = graph_op(g, OP_MUL, a, tau, 0);
        node half = graph_op(g, OP_DIV, graph_op(g, OP_MUL, gain, tau, 0), graph_const(g, 2), 0);
        o.value = graph_op(g, OP_ADD, graph_op(g, OP_ADD, x0, drift, 0), half, 0);
        o.to.array = (uint16_t)(m->block[BLOCK_X] + number);
        m->exact[m->exact_count++] = o;
        o.value = graph_op(g, OP_ADD, v0, gain, 0);
        o.to.array = (uint16_t)(m->block[BLOCK_V] + number);
        m->exact[m->exact_count++] = o;
    }
    m->exact_recognised = true;
    return !source_failed(&m->source);
}

/* Returns whether an event assigns, so that the exact motion ends there. */
static bool interrupted(const model *m)
{
    for (uint32_t i = 0; i < m->rule_count; i++)
        if (m->rules[i].assigns) return true;
    return false;
}

void analysis_all(model *m)
{
    analysis_traits(m);
    if (m->exact_given)
        m->traits.has_exact = true;
    else if (m->traits.constant && !interrupted(m) && m->nx == m->nv && m->boundary_count == 0)
        m->traits.has_exact = recognise_constant(m);
}
