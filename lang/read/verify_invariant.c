/* The check of invariants: the derivative along the motion, dI/dt + v dI/dx + a dI/dv, is zero where the motion goes.
 * See verify.h.
 *
 * It is evaluated at the start and at states of two short runs of Runge-Kutta, one with half the step of the other. An
 * invariant of this one motion need not be conserved by its neighbours; so where the two runs differ, the rate may as
 * well, and by many times more. What the algebra does not prove (lang/model/field.h) is followed to the end of the run,
 * in short steps where the force or an invariant has a pulse or a switch (verify_resolution). Invariant: only a rate or
 * a jump that neither rounding nor the error of the runs explains is refused.
 */
#include "lang/read/verify.h"

#include "lang/model/field.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    STEPS = 24,       /* at most, of the run with whole steps, and in the length of the run at least */
    FAR_STEPS = 4000, /* beyond them, of what the algebra does not prove */
    FINER = 3, /* halvings of all steps beyond the first ones, where that takes no more than a SPAREth of FAR_STEPS */
    SPARE = 8,
    DEPTH = 20,      /* halvings of a step that resolves too little */
    KINKED_LEAST = 3 /* of a formula with kinks, as many rates must differ: a state may lie on one */
};
#define STEP 0.1     /* of the reciprocal of the fastest rate */
#define APART 16     /* times the difference of the runs, the rate may be off */
#define FADE 0.25    /* by each step: near a kink the runs differ for a while, since each meets it at its time */
#define JUMP 1e-4    /* of the sizes of an invariant's terms: so much changes over no two steps */
#define WORK_MAX 4e6 /* operations */

/* Tapes ----------------------------------------------------------------------------------------------------------- */

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
    return (c->proved = arena_room(m->arena, m->definition_count + 1)) != NULL;
}

static bool kinked(const model *m, const model_definition *d)
{
    bool kinks = false;
    for (size_t k = 0; k < d->output_count; k++) kinks |= graph_kink(m->graph, d->outputs[k].value) != 0;
    return kinks;
}

/* Whether its value may jump: by a switch, or as an angle does on its cut. */
static bool has_jumps(const model *m, const model_definition *d)
{
    bool any = kinked(m, d);
    for (size_t k = 0; k < d->output_count && !any; k++) any = graph_jump(m->graph, d->outputs[k].value) != 0;
    return any;
}

static bool make_values(model *m, uint32_t i)
{
    const model_definition *d = &m->definitions[i];
    verify *c = m->verify;
    if (!has_jumps(m, d)) return true;
    c->value[i] = verify_tape(m, d->outputs, d->output_count);
    c->value_rounding[i] =
        verify_tape(m, verify_rounding(m, d->outputs, d->output_count, leaf_of_rate), d->output_count);
    return c->value[i] && c->value_rounding[i];
}

/* What a run must resolve: boundary cells, the force, and all invariants that are checked. */
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
    return verify_resolution(m, lists, counts, n, true, &m->verify->along, &sums);
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

/* The two runs ----------------------------------------------------------------------------------------------------- */

typedef struct runs {
    model *model;
    double t, h;
    double last;                 /* the last step */
    double scale;                /* of the time in which the motion changes */
    double lag;                  /* beyond the first steps: how late the runs may be at a kink */
    double jumps_from, jumps_to; /* steps between these times cannot be resolved */
    double most_x, most_v;
    bool far;            /* beyond the first steps: what is proved is judged no more */
    double *x[2], *v[2]; /* with whole steps, with half steps */
    double *a[2], *of_a; /* the accelerations, and the rounding of the second */
    double *stage_x, *stage_v, *sum_x, *sum_v;
    double *old_x[2], *old_v[2]; /* before the last step */
    interval *in_x, *in_v;       /* where the last step of the second run went */
    double *rate[2], *of_rate;   /* of one invariant */
    double *before;              /* of all invariants: their values */
    double *off_time; /* definition_count: for how long; beyond the first steps, since the last rate that was zero */
    double *size;     /* definition_count: the largest of the sizes of their terms so far */
    double *apart;    /* definition_count: the largest difference of the runs' rates so far */
    uint32_t *off;    /* definition_count: how many rates were not zero */
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
    source_complain(&m->source, MOTUS_ARGUMENT, &d->statement->at,
                    "%s%s is no invariant: along the motion it changes at the rate %.6g at t = %s", d->name, number,
                    rate, decimal_time(t, m->until - m->start, time));
    source_hint(&m->source,
                "correct it or the equations; without the word invariant it is a quantity, which may change");
    return MOTUS_ARGUMENT;
}

enum { WHEN_MAX = 2 * DECIMAL_MAX + 32 };

/* When something happens that lies between two times: the digits that are the same in both, else both. */
static char *between_times(double from, double to, char out[WHEN_MAX])
{
    enum { MOST = 6, LEAST = 3 };
    char a[DECIMAL_MAX], b[DECIMAL_MAX];
    for (int digits = MOST; digits >= LEAST; digits--) {
        snprintf(a, sizeof a, "%.*g", digits, from);
        snprintf(b, sizeof b, "%.*g", digits, to);
        if (!strcmp(a, b)) return snprintf(out, WHEN_MAX, "at t = %s", a), out;
    }
    snprintf(out, WHEN_MAX, "between t = %.*g and t = %.*g", MOST, from, MOST, to);
    return out;
}

static motus_status refuse_jump(const runs *r, const model_definition *d, size_t k, double from, double to)
{
    model *m = r->model;
    char number[64] = "", at[WHEN_MAX], a[VERIFY_DIGITS], b[VERIFY_DIGITS];
    const double late = r->h < 0 ? -r->lag : r->lag;
    if (d->numbers > 1) snprintf(number, sizeof number, " (number %zu of %zu)", k + 1, d->numbers);
    verify_digits(from, to, a, b);
    source_complain(&m->source, MOTUS_ARGUMENT, &d->statement->at,
                    "%s%s is no invariant: along the motion it jumps from %s to %s %s", d->name, number, a, b,
                    between_times(r->jumps_from - late, r->jumps_to + late, at));
    source_hint(&m->source,
                "correct it or the equations; without the word invariant it is a quantity, which may change");
    return MOTUS_ARGUMENT;
}

static motus_status judge(runs *r, uint32_t i, bool at_start)
{
    model *m = r->model;
    const model_definition *d = &m->definitions[i];
    const bool kinks = !m->traits.smooth || kinked(m, d);
    if (kinks && at_start) return MOTUS_OK;
    rates(r, i);
    if (kinks && r->far) r->apart[i] *= FADE;
    for (size_t k = 0; k < d->numbers; k++) r->apart[i] = fmax(r->apart[i], fabs(r->rate[0][k] - r->rate[1][k]));
    for (size_t k = 0; k < d->numbers; k++) {
        const double rate = r->rate[1][k], allowed = EXACT_ROUNDING * r->of_rate[k] + APART * r->apart[i];
        if (!isfinite(rate) || !(fabs(rate) > allowed)) continue;
        r->off_time[i] += fabs(r->last);
        if (++r->off[i] >= (kinks ? KINKED_LEAST : 1) && !(kinks && r->far && r->off_time[i] <= r->lag))
            return refuse(m, d, k, rate, r->t);
        return MOTUS_OK;
    }
    if (r->far && r->last == r->h) r->off[i] = 0, r->off_time[i] = 0;
    return MOTUS_OK;
}

static motus_status judge_all(runs *r, bool at_start)
{
    motus_status status = MOTUS_OK;
    accelerate_both(r);
    for (uint32_t i = 0; i < r->model->definition_count && status == MOTUS_OK; i++)
        if (r->model->verify->rate[i] && !(r->far && r->model->verify->proved[i])) status = judge(r, i, at_start);
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

static void step_both(const runs *r, double h)
{
    const model *m = r->model;
    for (int k = 0; k < 2; k++) {
        memcpy(r->old_x[k], r->x[k], m->nx * sizeof(double));
        memcpy(r->old_v[k], r->v[k], m->nv * sizeof(double));
    }
    step(r, r->t, h, r->x[0], r->v[0]);
    step(r, r->t, h / 2, r->x[1], r->v[1]);
    step(r, r->t + h / 2, h / 2, r->x[1], r->v[1]);
}

static void step_back(const runs *r)
{
    for (int k = 0; k < 2; k++) {
        memcpy(r->x[k], r->old_x[k], r->model->nx * sizeof(double));
        memcpy(r->v[k], r->old_v[k], r->model->nv * sizeof(double));
    }
}

/* Between two numbers, and a quarter as far beyond. */
static interval between(double a, double b)
{
    const double more = 0.25 * fabs(a - b);
    return (interval){fmin(a, b) - more, fmax(a, b) + more};
}

/* Whether the last step, which began at r->t, resolves the force and the invariants. */
static bool resolved(const runs *r, double h)
{
    const model *m = r->model;
    if (!m->verify->along) return true;
    for (size_t k = 0; k < m->nx; k++) r->in_x[k] = between(r->old_x[1][k], r->x[1][k]);
    for (size_t k = 0; k < m->nv; k++) r->in_v[k] = between(r->old_v[1][k], r->v[1][k]);
    const interval t = {fmin(r->t, r->t + h), fmax(r->t, r->t + h)};
    return resolution_fits(m->verify->along, t, r->in_x, r->in_v, m->pool);
}

/* An invariant that has changed by a part of its terms over steps in which the motion cannot change it jumps. That it
 * jumps and comes back as soon as the runs may be late shows nothing: of this motion alone two terms may jump at once,
 * and here do so one by one. */
static motus_status judge_jump(runs *r, uint32_t i, const double *before)
{
    model *m = r->model;
    const verify *c = m->verify;
    const model_definition *d = &m->definitions[i];
    double *base[SPACES] = {[SPACE_X] = r->x[1], [SPACE_V] = r->v[1], [SPACE_OUT] = r->rate[1]};
    tape_run(c->value[i], r->t, base);
    for (size_t k = 0; k < d->numbers; k++)
        if (fabs(r->rate[1][k] - before[k]) > JUMP * fmax(r->size[i], fabs(r->rate[1][k])))
            return refuse_jump(r, d, k, before[k], r->rate[1][k]);
    return MOTUS_OK;
}

static bool may_jump(const model *m, uint32_t i) { return m->verify->value[i] && !m->verify->proved[i]; }

static motus_status judge_jumps(runs *r)
{
    const model *m = r->model;
    motus_status status = MOTUS_OK;
    const double *before = r->before;
    for (uint32_t i = 0; i < m->definition_count && status == MOTUS_OK; i++) {
        if (may_jump(m, i)) status = judge_jump(r, i, before);
        before += m->definitions[i].numbers;
    }
    return status;
}

static void note_sizes(const runs *r)
{
    const model *m = r->model;
    for (uint32_t i = 0; i < m->definition_count; i++) {
        double *base[SPACES] = {[SPACE_X] = r->x[1], [SPACE_V] = r->v[1], [SPACE_OUT] = r->of_rate};
        if (!may_jump(m, i)) continue;
        tape_run(m->verify->value_rounding[i], r->t, base);
        for (size_t k = 0; k < m->definitions[i].numbers; k++) r->size[i] = fmax(r->size[i], r->of_rate[k]);
    }
}

/* The invariants before the last step, which began at r->t. */
static void note_before(const runs *r)
{
    const model *m = r->model;
    double *before = r->before;
    for (uint32_t i = 0; i < m->definition_count; i++) {
        double *base[SPACES] = {[SPACE_X] = r->old_x[1], [SPACE_V] = r->old_v[1], [SPACE_OUT] = before};
        if (may_jump(m, i)) tape_run(m->verify->value[i], r->t, base);
        before += m->definitions[i].numbers;
    }
}

/* How far the runs are apart, as a part of the largest motion so far. */
static double apart(runs *r)
{
    const model *m = r->model;
    double x = 0, v = 0;
    for (size_t k = 0; k < m->nx; k++) {
        x = fmax(x, fabs(r->x[0][k] - r->x[1][k]));
        r->most_x = fmax(r->most_x, fabs(r->x[1][k]));
    }
    for (size_t k = 0; k < m->nv; k++) {
        v = fmax(v, fabs(r->v[0][k] - r->v[1][k]));
        r->most_v = fmax(r->most_v, fabs(r->v[1][k]));
    }
    return (r->most_x > 0 ? x / r->most_x : 0) + (r->most_v > 0 ? v / r->most_v : 0);
}

/* Along the whole run, in steps which are shorter where they do not resolve what they go over; and so far beyond it as
 * a jump before its end takes to be judged. */
static motus_status go_far(runs *r, double way, int steps)
{
    const model *m = r->model;
    const double whole = r->h;
    motus_status status = MOTUS_OK;
    double h = r->h;
    int depth = 0;
    bool noted = false;
    for (int n = 0; n < steps && status == MOTUS_OK; n++) {
        const double left = way - (r->t - m->start);
        const bool ended = !(fabs(r->t - m->start) < fabs(way));
        if (ended && (!noted || r->t == r->jumps_to)) break;
        const double now = !ended && fabs(left) < fabs(h) ? left : h;
        step_both(r, now);
        const bool short_enough = finite_states(r) && resolved(r, now);
        if (!short_enough && depth < DEPTH) {
            step_back(r);
            h = now / 2, depth++;
            continue;
        }
        if (!finite_states(r) || (!short_enough && ended)) break;
        if (!short_enough && !noted) note_before(r), noted = true, r->jumps_from = r->t;
        r->t += now;
        r->last = now;
        if (!short_enough) r->jumps_to = r->t;
        r->lag = fmax(r->lag, APART * r->scale * apart(r));
        note_sizes(r);
        const bool over = depth == 0 || fabs(r->t - r->jumps_to) > r->lag;
        if (noted && short_enough && over) status = judge_jumps(r), noted = false;
        if (status == MOTUS_OK && !ended) status = judge_all(r, false);
        if (depth > 0 && short_enough) h *= 2, depth--;
        if (depth == 0) h = whole;
    }
    return status;
}

static void start(runs *r)
{
    const model *m = r->model;
    r->t = m->start;
    for (int k = 0; k < 2; k++) {
        memcpy(r->x[k], m->x0, m->nx * sizeof(double));
        memcpy(r->v[k], m->v0, m->nv * sizeof(double));
    }
}

static motus_status go(runs *r)
{
    const model *m = r->model;
    const double way = isfinite(m->until) ? m->until - m->start : 1;
    start(r);
    const double rate = verify_fastest(m, m->start, r->x[0], r->v[0], r->stage_x); /* stage_x … sum_x: 3 nv */
    const double work = fmax(m->terms, (double)m->nv) * (1 + (double)m->verify->nodes) * 20;
    const int steps = work * STEPS <= WORK_MAX ? STEPS : (int)(WORK_MAX / work);
    const double most = way / STEPS, least = rate > 0 ? STEP / rate : STEP * fabs(most);
    r->h = copysign(fmin(fabs(most), least), way);
    r->scale = fabs(r->h / STEP);
    motus_status status = judge_all(r, true);
    note_sizes(r);
    for (int n = 0; n < steps && status == MOTUS_OK; n++) {
        step_both(r, r->h);
        r->t = m->start + (n + 1) * r->h;
        if (!finite_states(r)) return MOTUS_OK;
        note_sizes(r);
        status = judge_all(r, false);
    }
    bool proved = true;
    for (uint32_t i = 0; i < m->definition_count; i++) proved &= !m->verify->rate[i] || m->verify->proved[i];
    if (status != MOTUS_OK || proved) return status;
    const int far = (int)fmin(FAR_STEPS, WORK_MAX / work);
    start(r);
    r->far = true;
    for (int k = 0; k < FINER && fabs(way / r->h) * SPARE < far; k++) r->h /= 2;
    return go_far(r, way, far);
}

/* By the algebra: what is proved is judged along the first steps alone, in which the rate counts to rounding. */
static bool prove(model *m)
{
    for (uint32_t i = 0; i < m->definition_count; i++)
        if (m->verify->rate[i] && !field_conserves(m, &m->definitions[i], &m->verify->proved[i])) return false;
    return true;
}

motus_status verify_invariants(model *m)
{
    const verify *c = m->verify;
    if (!c->numbers) return MOTUS_OK;
    tape *const boundary[] = {c->boundary_second};
    if (!verify_bind(m, boundary, 1) || !verify_bind(m, c->rate, m->definition_count) ||
        !verify_bind(m, c->rate_rounding, m->definition_count))
        return MOTUS_MEMORY;
    if (!verify_bind(m, c->value, m->definition_count) || !verify_bind(m, c->value_rounding, m->definition_count) ||
        !prove(m))
        return MOTUS_MEMORY;
    const size_t n = m->nv + 1, definitions = m->definition_count;
    size_t all = 0;
    for (uint32_t i = 0; i < m->definition_count; i++) all += m->definitions[i].numbers;
    double *room = take(&m->arena->allocator, 15 * n + 3 * c->numbers + 3 * definitions + all, sizeof *room);
    uint32_t *off = take(&m->arena->allocator, definitions + 1, sizeof *off);
    interval *in = take(&m->arena->allocator, 2 * n, sizeof *in);
    motus_status status = room && off && in ? MOTUS_OK : MOTUS_MEMORY;
    if (status == MOTUS_OK) {
        runs r = {.model = m, .t = m->start, .off = off, .in_x = in, .in_v = in + n};
        double *at = room, **arrays[] = {&r.x[0],  &r.x[1],     &r.v[0],     &r.v[1],     &r.a[0],
                                         &r.a[1],  &r.of_a,     &r.stage_x,  &r.stage_v,  &r.sum_x,
                                         &r.sum_v, &r.old_x[0], &r.old_x[1], &r.old_v[0], &r.old_v[1]};
        for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) *arrays[k] = at, at += n;
        r.rate[0] = at, r.rate[1] = at + c->numbers, r.of_rate = at + 2 * c->numbers, r.apart = at + 3 * c->numbers;
        r.size = r.apart + definitions;
        r.off_time = r.size + definitions;
        r.before = r.off_time + definitions;
        status = go(&r);
    }
    give(&m->arena->allocator, room);
    give(&m->arena->allocator, off);
    give(&m->arena->allocator, in);
    return status;
}
