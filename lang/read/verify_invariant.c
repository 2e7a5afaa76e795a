/* The formulas by which api/system/invariants.c checks invariants: their derivatives along the motion,
 * dI/dt + v dI/dx + a dI/dv, and the rounding of these. See verify.h.
 */
#include "lang/read/verify.h"

#include <math.h>

/* The state is known; an acceleration has the error of its formula, in SPACE_DV. */
static node leaf_of_rate(graph *g, node leaf, void *ctx)
{
    const model *m = ctx;
    const graph_node *n = graph_at(g, leaf);
    if (n->op == OP_TIME) return 0;
    if (n->op != OP_LOAD) return graph_op(g, OP_ABS, leaf, 0, 0);
    reference ref = g->references[n->a];
    const space s = g->arrays[ref.array].space;
    if (s == SPACE_X || s == SPACE_V) return 0;
    if (s == SPACE_POOL) return graph_op(g, OP_ABS, leaf, 0, 0);
    ref.array = (uint16_t)(ref.array - m->block[BLOCK_A] + m->block[BLOCK_DV]);
    return graph_load(g, &ref);
}

static output *along_motion(model *m, const output *from, size_t count)
{
    output *to = arena_room(m->arena, (count + 1) * sizeof *to);
    for (size_t k = 0; to && k < count; k++) {
        to[k] = from[k];
        to[k].value = graph_derivative(m->graph, from[k].value, model_seed_motion, m);
    }
    return to;
}

/* The velocities of boundary cells along the motion, into their accelerations. */
static bool make_boundary(model *m)
{
    output *of = arena_room(m->arena, (m->boundary_count + 1) * sizeof *of);
    size_t count = 0;
    for (size_t i = 0; of && i < m->boundary_count; i++)
        if (m->arrays[m->boundary[i].to.array].space == SPACE_V) {
            of[count] = m->boundary[i];
            of[count].to.array = (uint16_t)(of[count].to.array - m->block[BLOCK_V] + m->block[BLOCK_A]);
            count++;
        }
    of = of ? along_motion(m, of, count) : NULL;
    m->verify->boundary_second = of && count ? verify_tape(m, of, count) : NULL;
    return of != NULL;
}

static bool make_lists(model *m)
{
    verify *c = m->verify;
    tape ***const lists[] = {&c->rate, &c->rate_rounding, &c->value, &c->value_rounding};
    for (size_t k = 0; k < sizeof lists / sizeof *lists; k++) {
        *lists[k] = arena_room(m->arena, (m->definition_count + 1) * sizeof **lists[k]);
        if (!*lists[k]) return false;
    }
    c->proved = arena_room(m->arena, m->definition_count + 1);
    c->kinks = arena_room(m->arena, m->definition_count + 1);
    return c->proved && c->kinks;
}

static bool make_values(model *m, uint32_t i)
{
    const model_definition *d = &m->definitions[i];
    verify *c = m->verify;
    bool jumps = false; /* its value may jump: by a switch, or as an angle does on its cut */
    for (size_t k = 0; k < d->output_count; k++) {
        c->kinks[i] |= graph_kink(m->graph, d->outputs[k].value) != 0;
        jumps |= graph_jump(m->graph, d->outputs[k].value) != 0;
    }
    if (!c->kinks[i] && !jumps) return true;
    c->value[i] = verify_tape(m, d->outputs, d->output_count);
    c->value_rounding[i] =
        verify_tape(m, verify_rounding(m, d->outputs, d->output_count, leaf_of_rate), d->output_count);
    return c->value[i] && c->value_rounding[i];
}

/* Finds what a run must resolve: boundary cells, the force, and all invariants that are checked. */
static bool make_resolution(model *m)
{
    const size_t room = m->definition_count + 2;
    const output **lists = arena_room(m->arena, room * sizeof *lists);
    size_t *counts = arena_room(m->arena, room * sizeof *counts), n = 2;
    bool sums;
    if (!lists || !counts) return false;
    lists[0] = m->boundary, counts[0] = m->boundary_count;
    lists[1] = m->accel, counts[1] = m->accel_count;
    for (uint32_t i = 0; i < m->definition_count; i++)
        if (m->verify->rate[i]) lists[n] = m->definitions[i].outputs, counts[n++] = m->definitions[i].output_count;
    return verify_resolution(m, lists, counts, n, VERIFY_SWITCHES, &m->verify->along, &sums);
}

bool verify_invariant_make(model *m)
{
    verify *c = m->verify;
    if (!make_lists(m)) return false;
    if (!c->bounded || fmax(m->terms, (double)m->nv) > VERIFY_TERMS_MAX) return true;
    if (!make_boundary(m)) return false;
    for (uint32_t i = 0; i < m->definition_count; i++) {
        const model_definition *d = &m->definitions[i];
        unsigned deps = 0;
        for (size_t k = 0; k < d->output_count; k++) deps |= graph_deps(m->graph, d->outputs[k].value);
        /* the rate of an acceleration is not known */
        if (d->kind != DEFINED_INVARIANT || deps & DEP_A || d->numbers > VERIFY_TERMS_MAX) continue;
        output *rate = along_motion(m, d->outputs, d->output_count);
        c->rate[i] = verify_tape(m, rate, d->output_count);
        if (!c->rate[i]) return false;
        c->rate_rounding[i] = verify_tape(m, verify_rounding(m, rate, d->output_count, leaf_of_rate), d->output_count);
        if (!c->rate_rounding[i] || !make_values(m, i)) return false;
        if (d->numbers > c->numbers) c->numbers = d->numbers;
    }
    return !c->numbers || make_resolution(m);
}
