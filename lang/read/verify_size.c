/* What both checks of a model's claims need: tapes, the force, its rounding, the size of the motion. See verify.h. */
#include "lang/read/verify.h"

#include <math.h>
#include <string.h>

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
