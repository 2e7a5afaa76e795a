/* The check of invariants: the derivative along the motion, dI/dt + v dI/dx + a dI/dv, is zero where the motion goes.
 * See verify.h.
 *
 * It is evaluated at the start and at states of two short runs of Runge-Kutta, one with half the step of the other. An
 * invariant of this one motion need not be conserved by its neighbours; so where the two runs differ, the rate may as
 * well, and by many times more. Invariant: only a rate that neither rounding nor the error of the runs explains is
 * refused.
 */
#include "lang/read/verify.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    STEPS = 24,      /* at most, of the run with whole steps */
    KINKED_LEAST = 3 /* of a formula with kinks, as many rates must differ: a state may lie on one */
};
#define STEP 0.1     /* of the reciprocal of the fastest rate */
#define APART 16     /* times the difference of the runs, the rate may be off */
#define WORK_MAX 4e6 /* operations */

/* Tapes ----------------------------------------------------------------------------------------------------------- */

static node seed_motion(graph *g, node leaf, void *shift)
{
    return graph_at(g, leaf)->op == OP_TIME ? graph_const(g, 1) : graph_seed_direction(g, leaf, shift);
}

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
    graph_shift shift = {m->block_size, m->block_size};
    output *to = arena_room(m->arena, (count + 1) * sizeof *to);
    for (size_t k = 0; to && k < count; k++) {
        to[k] = from[k];
        to[k].value = graph_derivative(m->graph, from[k].value, seed_motion, &shift);
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

bool verify_invariant_make(model *m)
{
    verify *c = m->verify;
    c->rate = arena_room(m->arena, (m->definition_count + 1) * sizeof *c->rate);
    c->rate_rounding = arena_room(m->arena, (m->definition_count + 1) * sizeof *c->rate);
    if (!c->rate || !c->rate_rounding) return false;
    memset(c->rate, 0, m->definition_count * sizeof *c->rate);
    memset(c->rate_rounding, 0, m->definition_count * sizeof *c->rate);
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
        if (!c->rate_rounding[i]) return false;
        if (d->numbers > c->numbers) c->numbers = d->numbers;
    }
    return true;
}

/* The two runs ----------------------------------------------------------------------------------------------------- */

typedef struct runs {
    model *model;
    double t, h;
    double *x[2], *v[2]; /* with whole steps, with half steps */
    double *a[2], *of_a; /* the accelerations, and the rounding of the second */
    double *stage_x, *stage_v, *sum_x, *sum_v;
    double *rate[2], *of_rate; /* of one invariant */
    double *apart;             /* definition_count: the largest difference of the runs' rates so far */
    uint32_t *off;             /* definition_count: how many rates were not zero */
} runs;

static void accelerate(const runs *r, double t, double *x, double *v, double *a)
{
    const model *m = r->model;
    verify_force(m, t, x, v, a);
    double *base[SPACES] = {[SPACE_X] = x, [SPACE_V] = v, [SPACE_A] = a};
    if (m->verify->boundary_second) tape_run(m->verify->boundary_second, t, base);
}

/* A step of the classical Runge-Kutta method. */
static void step(const runs *r, double t, double h, double *x, double *v)
{
    static const double node_of[4] = {0, 0.5, 0.5, 1}, weight[4] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
    const model *m = r->model;
    memcpy(r->stage_x, x, m->nx * sizeof *x);
    memcpy(r->stage_v, v, m->nv * sizeof *v);
    for (size_t k = 0; k < m->nv; k++) r->sum_x[k] = r->sum_v[k] = 0;
    for (int s = 0; s < 4; s++) {
        double *a = r->a[0];
        accelerate(r, t + node_of[s] * h, r->stage_x, r->stage_v, a);
        const double next = s < 3 ? node_of[s + 1] * h : 0;
        for (size_t k = 0; k < m->nv; k++) {
            const double velocity = r->stage_v[k];
            r->sum_v[k] += weight[s] * a[k];
            r->stage_v[k] = v[k] + next * a[k];
            if (k >= m->nx) continue;
            r->sum_x[k] += weight[s] * velocity;
            r->stage_x[k] = x[k] + next * velocity;
        }
    }
    for (size_t k = 0; k < m->nv; k++) v[k] += h * r->sum_v[k];
    for (size_t k = 0; k < m->nx; k++) x[k] += h * r->sum_x[k];
}

/* The accelerations at both runs' states, and the rounding of the second. */
static void accelerate_both(const runs *r)
{
    const model *m = r->model;
    for (int k = 0; k < 2; k++) accelerate(r, r->t, r->x[k], r->v[k], r->a[k]);
    double *x = r->x[1], *v = r->v[1], *none = r->stage_x;
    memset(r->of_a, 0, m->nv * sizeof *r->of_a);
    memset(none, 0, m->nv * sizeof *none);
    double *base[SPACES] = {[SPACE_X] = x, [SPACE_V] = v, [SPACE_A] = r->of_a, [SPACE_DX] = none, [SPACE_DV] = none};
    tape_run(m->verify->force_rounding, r->t, base);
}

/* The rates of an invariant at both runs' states, and the rounding of the second. */
static void rates(const runs *r, uint32_t i)
{
    const verify *c = r->model->verify;
    for (int k = 0; k < 2; k++) {
        double *base[SPACES] = {[SPACE_X] = r->x[k],
                                [SPACE_V] = r->v[k],
                                [SPACE_A] = r->a[k],
                                [SPACE_DV] = r->of_a,
                                [SPACE_OUT] = r->rate[k]};
        tape_run(c->rate[i], r->t, base);
        if (k == 0) continue;
        base[SPACE_OUT] = r->of_rate;
        tape_run(c->rate_rounding[i], r->t, base);
    }
}

static motus_status refuse(model *m, const model_definition *d, size_t k, double rate, double t)
{
    char number[64] = "", time[DECIMAL_MAX];
    if (d->numbers > 1) snprintf(number, sizeof number, " (number %zu of %zu)", k + 1, d->numbers);
    source_complain(&m->source, MOTUS_ARGUMENT, d->statement->at,
                    "%s%s is no invariant: along the motion it changes at the rate %.6g at t = %s", d->name, number,
                    rate, decimal_time(t, m->until - m->start, time));
    source_hint(&m->source,
                "correct it or the equations; without the word invariant it is a quantity, which may change");
    return MOTUS_ARGUMENT;
}

static bool kinked(const model *m, const model_definition *d)
{
    bool kinks = !m->traits.smooth;
    for (size_t k = 0; k < d->output_count; k++) kinks |= graph_kink(m->graph, d->outputs[k].value) != 0;
    return kinks;
}

static motus_status judge(runs *r, uint32_t i, bool at_start)
{
    model *m = r->model;
    const model_definition *d = &m->definitions[i];
    const bool kinks = kinked(m, d);
    if (kinks && at_start) return MOTUS_OK;
    rates(r, i);
    for (size_t k = 0; k < d->numbers; k++) r->apart[i] = fmax(r->apart[i], fabs(r->rate[0][k] - r->rate[1][k]));
    for (size_t k = 0; k < d->numbers; k++) {
        const double rate = r->rate[1][k], allowed = EXACT_ROUNDING * r->of_rate[k] + APART * r->apart[i];
        if (!isfinite(rate) || !(fabs(rate) > allowed)) continue;
        if (++r->off[i] >= (kinks ? KINKED_LEAST : 1)) return refuse(m, d, k, rate, r->t);
        break;
    }
    return MOTUS_OK;
}

static motus_status judge_all(runs *r, bool at_start)
{
    motus_status status = MOTUS_OK;
    accelerate_both(r);
    for (uint32_t i = 0; i < r->model->definition_count && status == MOTUS_OK; i++)
        if (r->model->verify->rate[i]) status = judge(r, i, at_start);
    return status;
}

static bool finite_states(const runs *r)
{
    double sum = 0;
    for (int k = 0; k < 2; k++) {
        for (size_t i = 0; i < r->model->nx; i++) sum += 0 * r->x[k][i];
        for (size_t i = 0; i < r->model->nv; i++) sum += 0 * r->v[k][i];
    }
    return sum == 0;
}

static motus_status go(runs *r)
{
    const model *m = r->model;
    const double way = isfinite(m->until) ? m->until - m->start : 1;
    for (int k = 0; k < 2; k++) {
        memcpy(r->x[k], m->x0, m->nx * sizeof(double));
        memcpy(r->v[k], m->v0, m->nv * sizeof(double));
    }
    const double rate = verify_fastest(m, m->start, r->x[0], r->v[0], r->stage_x); /* stage_x … sum_x: 3 nv */
    const double work = fmax(m->terms, (double)m->nv) * (1 + (double)m->verify->nodes) * 20;
    const int steps = work * STEPS <= WORK_MAX ? STEPS : (int)(WORK_MAX / work);
    const double most = way / STEPS, least = rate > 0 ? STEP / rate : STEP * fabs(most);
    r->h = copysign(fmin(fabs(most), least), way);
    motus_status status = judge_all(r, true);
    for (int n = 0; n < steps && status == MOTUS_OK; n++) {
        step(r, r->t, r->h, r->x[0], r->v[0]);
        step(r, r->t, r->h / 2, r->x[1], r->v[1]);
        step(r, r->t + r->h / 2, r->h / 2, r->x[1], r->v[1]);
        r->t = m->start + (n + 1) * r->h;
        if (!finite_states(r)) break;
        status = judge_all(r, false);
    }
    return status;
}

motus_status verify_invariants(model *m)
{
    const verify *c = m->verify;
    if (!c->numbers) return MOTUS_OK;
    tape *const boundary[] = {c->boundary_second};
    if (!verify_bind(m, boundary, 1) || !verify_bind(m, c->rate, m->definition_count) ||
        !verify_bind(m, c->rate_rounding, m->definition_count))
        return MOTUS_MEMORY;
    const size_t n = m->nv + 1, definitions = m->definition_count;
    double *room = take(&m->arena->allocator, 11 * n + 3 * c->numbers + definitions, sizeof *room);
    uint32_t *off = take(&m->arena->allocator, definitions + 1, sizeof *off);
    motus_status status = room && off ? MOTUS_OK : MOTUS_MEMORY;
    if (status == MOTUS_OK) {
        runs r = {.model = m, .t = m->start, .off = off};
        double *at = room, **arrays[] = {&r.x[0], &r.x[1],    &r.v[0],    &r.v[1],  &r.a[0], &r.a[1],
                                         &r.of_a, &r.stage_x, &r.stage_v, &r.sum_x, &r.sum_v};
        for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) *arrays[k] = at, at += n;
        r.rate[0] = at, r.rate[1] = at + c->numbers, r.of_rate = at + 2 * c->numbers, r.apart = at + 3 * c->numbers;
        status = go(&r);
    }
    give(&m->arena->allocator, room);
    give(&m->arena->allocator, off);
    return status;
}
