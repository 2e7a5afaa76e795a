/* Traits of the equations that follow from their form: what they depend on, whether velocity enters linearly, whether
 * the exact motion is known; and the check of an exact line. Traits that need sampled states (gradient, gyroscopic) are
 * found elsewhere, by evaluation. */
#include "lang/read/read_steps.h"

#include "lang/tape/tape.h"

#include <math.h>
#include <string.h>

/* Differentiates along a direction of v; da/dv is constant where the result depends on the direction alone. */
static node seed_velocity(graph *g, node leaf, void *shift)
{
    const graph_node *n = graph_at(g, leaf);
    if (n->op != OP_LOAD || g->arrays[g->references[n->a].array].space != SPACE_V) return 0;
    return graph_seed_direction(g, leaf, shift);
}

static const model_state *state_of(const model *m, block block, uint16_t array)
{
    const uint16_t number = (uint16_t)(array - m->block[block]);
    for (uint32_t k = 0; k < m->state_count; k++) {
        const model_state *s = &m->states[k];
        if (number >= s->array && number < s->array + (s->components ? s->components : 1)) return s;
    }
    return NULL;
}

typedef struct reading {
    const model *model;
    bool first_order;
} reading;

static void see_load(void *ctx, const reference *ref, const range *sums, int first_level, int inside)
{
    reading *r = ctx;
    (void)sums, (void)first_level, (void)inside;
    const model_state *s = state_of(r->model, BLOCK_V, ref->array);
    r->first_order |= !s || s->order == 1;
}

/* Whether v enters the right sides of first-order variables alone, and nothing reads these. */
static bool only_follow(model *m)
{
    reading r = {.model = m};
    for (size_t i = 0; i < m->accel_count && !r.first_order; i++) {
        const output *o = &m->accel[i];
        if (!(graph_deps(m->graph, o->value) & DEP_V)) continue;
        const model_state *s = state_of(m, BLOCK_A, o->to.array);
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
                  .first_order = m->nv > m->nx,
                  .time = m->driven};
    graph_shift shift = {(uint16_t)(3 * m->block_size), (uint16_t)(3 * m->block_size)};
    for (size_t i = 0; i < m->accel_count; i++) {
        node n = m->accel[i].value;
        unsigned deps = graph_deps(g, n);
        t->velocity |= (deps & DEP_V) != 0;
        t->time |= (deps & DEP_TIME) != 0;
        t->constant &= !(deps & (DEP_V | DEP_X | DEP_TIME));
        t->linear_v &= graph_degree(g, n, DEP_V) <= 1;
        t->affine &= graph_degree(g, n, DEP_V | DEP_X) <= 1;
        t->smooth &= !graph_kink(g, n);
        if (deps & DEP_V)
            t->constant_jv &=
                !(graph_deps(g, graph_derivative(g, n, seed_velocity, &shift)) & (DEP_V | DEP_X | DEP_TIME));
    }
    t->constant &= !m->driven;
    t->constant_jv &= t->linear_v;
    t->quadrature = t->velocity && t->first_order && only_follow(m);
}

/* Under a constant acceleration a the exact motion is x = x(0) + x'(0) τ + a τ²/2 with τ = t - start, so no exact line
 * is needed. */
static bool recognise_constant(model *m)
{
    graph *g = m->graph;
    m->exact = arena_room(m->arena, 2 * m->accel_count * sizeof *m->exact);
    if (!m->exact) return false;
    node tau = graph_op(g, OP_SUB, graph_time(g), graph_const(g, m->start), 0);
    for (size_t i = 0; i < m->accel_count; i++) {
        output o = m->accel[i];
        const uint16_t number = (uint16_t)(o.to.array - m->block[BLOCK_A]);
        const model_state *s = state_of(m, BLOCK_A, o.to.array);
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

/* ---- the check of exact lines [13] ---- */

enum { SAMPLES = 16 };
/* Two ways to compute the same number differ by a few hundred ulps of rounding at most; a wrong formula differs in the
 * first digits. */
#define SAME 1e-8

static const statement *exact_line(const model *m)
{
    for (uint32_t i = 0; i < m->statements.count; i++)
        if (m->statements.item[i].kind == STATEMENT_EXACT) return &m->statements.item[i];
    return NULL;
}

/* Finds the first place where two arrays of the state's numbers differ. */
static bool differs(const model *m, const double *a, const double *b, size_t n, bool in_v, const double *scale,
                    char *name, size_t size, size_t *where)
{
    for (size_t k = 0; k < n; k++) {
        if (fabs(a[k] - b[k]) <= SAME * scale[k]) continue;
        *where = k;
        model_name(m, in_v, k, name, size);
        return true;
    }
    return false;
}

/* What the check computes: the motion, the boundary where there is one, the motion's acceleration, the force. */
struct exact_check {
    tape *motion, *boundary, *second, *force;
    double *work;
};

static tape *tape_of(model *m, const output *outputs, size_t count)
{
    program *p = source_failed(&m->source) ? NULL : program_create(m->graph, outputs, count);
    return p && !source_failed(&m->source) ? tape_create(m->arena, p) : NULL;
}

static bool make_check(model *m)
{
    graph *g = m->graph;
    struct exact_check *c = arena_take(m->arena, sizeof *c);
    output *second = arena_room(m->arena, (m->exact_count + 1) * sizeof *second);
    if (!second || m->arena->failed) return false;
    size_t count = 0;
    for (size_t i = 0; i < m->exact_count; i++)
        if (m->arrays[m->exact[i].to.array].space == SPACE_V) {
            output o = m->exact[i];
            o.value = graph_derivative(g, o.value, graph_seed_time, NULL);
            o.to.array = (uint16_t)(o.to.array - m->block[BLOCK_V] + m->block[BLOCK_A]);
            second[count++] = o;
        }
    c->work = arena_room(m->arena, 5 * (m->nv + 1) * sizeof *c->work);
    c->motion = tape_of(m, m->exact, m->exact_count);
    c->boundary = m->boundary_count ? tape_of(m, m->boundary, m->boundary_count) : NULL;
    c->second = tape_of(m, second, count);
    c->force = tape_of(m, m->accel, m->accel_count);
    m->check = c;
    return !source_failed(&m->source);
}

static bool bind_check(const model *m)
{
    tape *const tapes[] = {m->check->motion, m->check->boundary, m->check->second, m->check->force};
    const binding b = {m->arrays, m->ints, m->pool};
    for (size_t k = 0; k < sizeof tapes / sizeof *tapes; k++)
        if (tapes[k] && !tape_bind(tapes[k], &b)) return false;
    return true;
}

static bool verify_exact(model *m)
{
    const size_t n = m->nv + 1;
    if (!m->check && !make_check(m)) return false;
    if (!bind_check(m)) return false;
    const struct exact_check *c = m->check;
    double *x = c->work, *v = x + n, *a = v + n, *e = a + n, *scale = e + n;
    const statement *line = exact_line(m);
    double span_ = isfinite(m->until) ? m->until - m->start : 1;
    char name[MOTUS_NAME_MAX + 64];
    size_t where;
    for (int k = 0; k <= SAMPLES; k++) {
        double t = m->start + span_ * k / SAMPLES;
        memcpy(x, m->x0, m->nx * sizeof *x);
        memcpy(v, m->v0, m->nv * sizeof *v);
        memset(a, 0, n * sizeof *a);
        memset(e, 0, n * sizeof *e);
        double *motion[SPACES] = {[SPACE_X] = x, [SPACE_V] = v}, *truth[SPACES] = {[SPACE_A] = e},
               *force[SPACES] = {[SPACE_X] = x, [SPACE_V] = v, [SPACE_A] = a};
        tape_run(c->motion, t, motion);
        if (k == 0) {
            double big = 0;
            for (size_t i = 0; i < m->nx; i++) big = fmax(big, fmax(fabs(m->x0[i]), fabs(x[i])));
            for (size_t i = 0; i < n; i++) scale[i] = big;
            bool off = differs(m, x, m->x0, m->nx, false, scale, name, sizeof name, &where);
            double is = off ? x[where] : 0, due = off ? m->x0[where] : 0;
            if (!off) {
                for (size_t i = 0; i < m->nv; i++) big = fmax(big, fmax(fabs(m->v0[i]), fabs(v[i])));
                for (size_t i = 0; i < n; i++) scale[i] = big;
                off = differs(m, v, m->v0, m->nv, true, scale, name, sizeof name, &where);
                is = off ? v[where] : 0;
                due = off ? m->v0[where] : 0;
            }
            if (off) {
                source_complain(&m->source, MOTUS_ARGUMENT, line->at,
                                "the exact motion does not meet the initial value: %s is %.6g at the start, not %.6g",
                                name, is, due);
                return false;
            }
        }
        if (c->boundary) tape_run(c->boundary, t, motion);
        tape_run(c->second, t, truth);
        tape_run(c->force, t, force);
        double big = 0;
        for (size_t i = 0; i < m->nv; i++) big = fmax(big, fabs(a[i]) + fabs(e[i]) + 1e-8 * fabs(v[i]));
        for (size_t i = 0; i < n; i++) scale[i] = big;
        if (differs(m, e, a, m->nv, true, scale, name, sizeof name, &where)) {
            size_t end = strlen(name);
            source_complain(
                &m->source, MOTUS_ARGUMENT, line->at,
                "the exact motion does not obey the equation: at t = %.6g %s is %.6g, but the force gives %.6g", t,
                end && name[end - 1] == '\'' ? strcat(name, "'") : name, e[where], a[where]);
            source_hint(&m->source, "correct the exact line, or leave it out");
            return false;
        }
    }
    return true;
}

motus_status analysis_exact(model *m, motus_error *err)
{
    if (!m->check) return MOTUS_OK;
    m->source.error = err;
    const bool good = verify_exact(m);
    const motus_status status = good ? MOTUS_OK : m->source.failed ? m->source.status : MOTUS_MEMORY;
    m->source.error = NULL;
    m->source.failed = false; /* the text has no error: the numbers contradict its exact line */
    return status;
}

void analysis_all(model *m)
{
    analysis_traits(m);
    if (m->exact_given) {
        m->traits.has_exact = verify_exact(m);
    } else if (m->traits.constant && m->nx == m->nv && m->boundary_count == 0) {
        m->traits.has_exact = recognise_constant(m);
    }
}
