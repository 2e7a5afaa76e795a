/* What both checks of a model's claims need: the force, its rounding, the size of the motion. See verify.h. */
#include "lang/read/verify.h"

#include "lang/graph/graph_walk.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Tapes ----------------------------------------------------------------------------------------------------------- */

tape *verify_tape(model *m, const output *outputs, size_t count)
{
    return source_failed(&m->source) || !outputs ? NULL : tape_of(m->arena, m->graph, outputs, count);
}

bool verify_bind(const model *m, tape *const tapes[], size_t count)
{
    const binding b = {m->arrays, m->ints, m->pool};
    for (size_t k = 0; k < count; k++)
        if (tapes[k] && !tape_bind(tapes[k], &b)) return false;
    return true;
}

node verify_leaf(graph *g, node leaf, void *ctx)
{
    const model *m = ctx;
    const graph_node *n = graph_at(g, leaf);
    if (n->op == OP_TIME) return 0;
    if (n->op == OP_LOAD && g->arrays[g->references[n->a].array].space != SPACE_POOL) {
        graph_shift shift = {(uint16_t)(3 * m->block_size), (uint16_t)(3 * m->block_size)};
        return graph_seed_direction(g, leaf, &shift);
    }
    return graph_op(g, OP_ABS, leaf, 0, 0);
}

output *verify_rounding(model *m, const output *from, size_t count, graph_seed leaf)
{
    output *to = arena_room(m->arena, (count + 1) * sizeof *to);
    for (size_t k = 0; to && k < count; k++) {
        to[k] = from[k];
        to[k].value = graph_rounding(m->graph, from[k].value, leaf, m);
    }
    return to;
}

/* How many nodes the formulas have. */
static uint32_t size_of(model *m, const output *outputs, size_t count)
{
    uint32_t nodes = 0;
    for (size_t k = 0; k < count && nodes <= VERIFY_NODES_MAX; k++) {
        graph_walk w;
        if (!graph_order(m->graph, &outputs[k].value, 1, 0, true, &w)) return 0;
        nodes += w.count;
        give(&m->arena->allocator, w.nodes);
    }
    return nodes;
}

static bool make_tapes(model *m)
{
    verify *c = m->verify = arena_take(m->arena, sizeof *c);
    c->nodes = size_of(m, m->accel, m->accel_count) + size_of(m, m->exact, m->exact_count);
    for (uint32_t i = 0; i < m->definition_count; i++)
        if (m->definitions[i].kind == DEFINED_INVARIANT)
            c->nodes += size_of(m, m->definitions[i].outputs, m->definitions[i].output_count);
    c->bounded = c->nodes <= VERIFY_NODES_MAX;
    c->boundary = m->boundary_count ? verify_tape(m, m->boundary, m->boundary_count) : NULL;
    c->force = verify_tape(m, m->accel, m->accel_count);
    if (c->bounded)
        c->force_rounding = verify_tape(m, verify_rounding(m, m->accel, m->accel_count, verify_leaf), m->accel_count);
    if (m->exact_given && !verify_exact_make(m)) return false;
    return verify_invariant_make(m) && !source_failed(&m->source);
}

/* Other code counts the operations of a model, so the graph keeps none of the formulas of the checks. */
static bool make(model *m)
{
    const uint32_t nodes = m->graph->count;
    const bool made = make_tapes(m);
    if (!m->graph->too_large) graph_cut(m->graph, nodes);
    return made;
}

static bool claims(const model *m)
{
    bool any = m->exact_given;
    for (uint32_t i = 0; i < m->definition_count; i++) any |= m->definitions[i].kind == DEFINED_INVARIANT;
    return any;
}

motus_status verify_claims(model *m)
{
    if (!claims(m)) return MOTUS_OK;
    if (!m->verify && !make(m)) return MOTUS_MEMORY;
    const verify *c = m->verify;
    tape *const tapes[] = {c->boundary, c->force, c->force_rounding};
    if (!verify_bind(m, tapes, sizeof tapes / sizeof *tapes)) return MOTUS_MEMORY;
    if (m->source.nudged) return MOTUS_OK; /* its claims are those of the text that was not nudged */
    const motus_status status = m->exact_given ? verify_exact(m) : MOTUS_OK;
    return status == MOTUS_OK ? verify_invariants(m) : status;
}

motus_status verify_again(model *m, motus_error *err)
{
    if (!m->verify) return MOTUS_OK;
    m->source.error = err;
    const motus_status status = verify_claims(m);
    m->source.error = NULL;
    m->source.failed = false; /* the text has no error: the numbers contradict its claims */
    return status == MOTUS_MEMORY ? fail(err, MOTUS_MEMORY, "no memory to check the model's claims") : status;
}

/* Sizes ----------------------------------------------------------------------------------------------------------- */

void verify_force(const model *m, double t, double *x, double *v, double *a)
{
    double *base[SPACES] = {[SPACE_X] = x, [SPACE_V] = v, [SPACE_A] = a};
    if (m->verify->boundary) tape_run(m->verify->boundary, t, base);
    memset(a, 0, m->nv * sizeof *a);
    tape_run(m->verify->force, t, base);
}

/* The largest rounding of the force where the errors of all places, or of all velocities, are these. */
static double largest(const model *m, double t, double *x, double *v, double of_x, double of_v, double *room)
{
    double *dx = room, *dv = dx + m->nv, *error = dv + m->nv, most = 0;
    for (size_t k = 0; k < m->nv; k++) dx[k] = of_x, dv[k] = of_v, error[k] = 0;
    double *base[SPACES] = {[SPACE_X] = x, [SPACE_V] = v, [SPACE_A] = error, [SPACE_DX] = dx, [SPACE_DV] = dv};
    tape_run(m->verify->force_rounding, t, base);
    for (size_t k = 0; k < m->nv; k++) most = fmax(most, error[k]);
    return most;
}

double verify_fastest(const model *m, double t, double *x, double *v, double *room)
{
    if (!m->verify->force_rounding) return 0;
    const double none = largest(m, t, x, v, 0, 0, room), by_x = largest(m, t, x, v, 1, 0, room) - none,
                 by_v = largest(m, t, x, v, 0, 1, room) - none;
    const double rate = fmax(by_v > 0 ? by_v : 0, by_x > 0 ? sqrt(by_x) : 0);
    return isfinite(rate) ? rate : 0;
}

void verify_size(const model *m, double rate, const double *x, const double *v, double *size_x, double *size_v)
{
    for (uint32_t i = 0; i < m->state_count + m->mode_count; i++) {
        const model_state *s = &m->states[i];
        const size_t count = s->hull * (size_t)(s->components ? s->components : 1);
        double of_x = 0, of_v = 0;
        for (size_t k = s->base; k < s->base + count; k++) {
            if (s->order == 2) of_x = fmax(of_x, fabs(x[k]));
            of_v = fmax(of_v, fabs(v[k]));
        }
        const double place = rate > 0 ? fmax(of_x, of_v / rate) : of_x, velocity = fmax(of_v, rate * of_x);
        for (size_t k = s->base; k < s->base + count; k++) {
            if (s->order == 2) size_x[k] = place;
            size_v[k] = velocity;
        }
    }
}

void verify_digits(double a, double b, char of_a[VERIFY_DIGITS], char of_b[VERIFY_DIGITS])
{
    for (int digits = 6; digits <= 17; digits++) {
        error_text(of_a, "%.*g", digits, a);
        error_text(of_b, "%.*g", digits, b);
        if (strcmp(of_a, of_b) != 0) return;
    }
}
