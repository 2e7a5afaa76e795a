/* See system.h.
 *
 * The rate of an invariant along the motion (lang/read/verify_invariant.c) is evaluated at the start and at states of
 * two short runs, one with half the step of the other. An invariant of this one motion need not be conserved by its
 * neighbours; so where the two runs differ, the rate may as well, and by many times more. What the algebra does not
 * prove (lang/model/field.h) is followed to the end of the run, in short steps where the force or an invariant has a
 * pulse or a switch (verify_resolution). Invariant: only a rate or a jump that neither rounding nor the error of the
 * runs explains is refused.
 */
#include "api/system/system.h"

#include "core/stepper.h"
#include "lang/model/field.h"
#include "lang/read/verify.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    STEPS = 24,       /* most first steps of the run with whole steps; the whole way has at least as many */
    FAR_STEPS = 4000, /* most further steps, for what the algebra does not prove */
    FINER = 3,        /* halvings of all further steps, while these take at most 1/SPARE of FAR_STEPS */
    SPARE = 8,
    DEPTH = 20,      /* most halvings of a step that resolves too little */
    KINKED_LEAST = 3 /* this many rates of a formula with kinks must not be 0: one state may lie on a kink */
};
#define METHOD "rk4"
#define STEP 0.1     /* as a part of the reciprocal of the fastest rate */
#define APART 16     /* the rate may be off by this many times the difference of the runs */
#define FADE 0.25    /* of the known difference after each step: near a kink each run meets it at its own time */
#define JUMP 1e-4    /* of the sizes of an invariant's terms: a larger change over a few steps is a jump */
#define WORK_MAX 4e6 /* operations */

typedef struct runs {
    model *model;
    stepper *stepper; /* takes the steps of both runs, in turn */
    double t, h;
    double last;                 /* the last step */
    double scale;                /* the time in which the motion changes */
    double lag;                  /* in the further steps: how late the runs may be at a kink */
    double jumps_from, jumps_to; /* steps between these times cannot be resolved */
    double most_x, most_v;
    bool far;                    /* in the further steps: what is proved is judged no more */
    double *x[2], *v[2];         /* with whole steps, with half steps */
    double *a[2], *of_a;         /* the accelerations, and the rounding of the second */
    double *room;                /* 3 nv numbers */
    double *old_x[2], *old_v[2]; /* before the last step */
    interval *in_x, *in_v;       /* where the last step of the second run went */
    double *rate[2], *of_rate;   /* of one invariant */
    double *before;              /* of all invariants: their values */
    double *off_time; /* definition_count: for how long rates were not zero; in the further steps, since the last rate
                       * that was zero */
    double *size;     /* definition_count: the largest of the sizes of their terms so far */
    double *apart;    /* definition_count: the largest difference of the runs' rates so far */
    uint32_t *off;    /* definition_count: how many rates were not zero */
} runs;

static void accelerate(const runs *r, double *x, double *v, double *a)
{
    const model *m = r->model;
    verify_force(m, r->t, x, v, a);
    double *base[SPACES] = {[SPACE_X] = x, [SPACE_V] = v, [SPACE_A] = a};
    if (m->verify->boundary_second) tape_run(m->verify->boundary_second, r->t, base);
}

/* Takes steps of a run from r->t. MOTUS_MEMORY, or another status: they lead to no finite state, and (x, v) is as
 * before. */
static motus_status step(const runs *r, double h, int64_t steps, double *x, double *v)
{
    motus_status status = stepper_start(r->stepper, r->t, h, x, v, NULL);
    if (status == MOTUS_OK) status = stepper_advance(r->stepper, (stepper_limit){steps, NAN}, NULL, NULL);
    return status == MOTUS_OK ? stepper_sync(r->stepper, x, v, NULL, NULL) : status;
}

/* Computes the accelerations at both runs' states, and the rounding of the second. */
static void accelerate_both(const runs *r)
{
    const model *m = r->model;
    for (int k = 0; k < 2; k++) accelerate(r, r->x[k], r->v[k], r->a[k]);
    double *x = r->x[1], *v = r->v[1], *none = r->room;
    memset(r->of_a, 0, m->nv * sizeof *r->of_a);
    memset(none, 0, m->nv * sizeof *none);
    double *base[SPACES] = {[SPACE_X] = x, [SPACE_V] = v, [SPACE_A] = r->of_a, [SPACE_DX] = none, [SPACE_DV] = none};
    tape_run(m->verify->force_rounding, r->t, base);
}

/* Computes the rates of an invariant at both runs' states, and the rounding of the second. */
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
                    "%s%s is no invariant: along the motion it changes at the rate %.6g at %s = %s", d->name, number,
                    rate, m->time, decimal_time(t, m->until - m->start, time));
    source_hint(&m->source,
                "correct it or the equations; without the word invariant it is a quantity, which may change");
    return MOTUS_ARGUMENT;
}

enum { WHEN_MAX = 2 * DECIMAL_MAX + 2 * MOTUS_NAME_MAX + 32 };

/* Writes when something happens that lies between two times: the digits that both share, else both. */
static char *between_times(const char *name, double from, double to, char out[WHEN_MAX])
{
    enum { MOST = 6, LEAST = 3 };
    char a[DECIMAL_MAX], b[DECIMAL_MAX];
    for (int digits = MOST; digits >= LEAST; digits--) {
        snprintf(a, sizeof a, "%.*g", digits, from);
        snprintf(b, sizeof b, "%.*g", digits, to);
        if (!strcmp(a, b)) return snprintf(out, WHEN_MAX, "at %s = %s", name, a), out;
    }
    snprintf(out, WHEN_MAX, "between %s = %.*g and %s = %.*g", name, MOST, from, name, MOST, to);
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
                    between_times(m->time, r->jumps_from - late, r->jumps_to + late, at));
    source_hint(&m->source,
                "correct it or the equations; without the word invariant it is a quantity, which may change");
    return MOTUS_ARGUMENT;
}

static motus_status judge(runs *r, uint32_t i, bool at_start)
{
    model *m = r->model;
    const model_definition *d = &m->definitions[i];
    const bool kinks = !m->traits.smooth || m->verify->kinks[i];
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

/* Takes a step of size h of one run, and two half steps of the other. */
static motus_status step_both(const runs *r, double h)
{
    const model *m = r->model;
    for (int k = 0; k < 2; k++) {
        memcpy(r->old_x[k], r->x[k], m->nx * sizeof(double));
        memcpy(r->old_v[k], r->v[k], m->nv * sizeof(double));
    }
    const motus_status status = step(r, h, 1, r->x[0], r->v[0]);
    return status == MOTUS_OK ? step(r, h / 2, 2, r->x[1], r->v[1]) : status;
}

static void step_back(const runs *r)
{
    for (int k = 0; k < 2; k++) {
        memcpy(r->x[k], r->old_x[k], r->model->nx * sizeof(double));
        memcpy(r->v[k], r->old_v[k], r->model->nv * sizeof(double));
    }
}

/* Returns the interval between two numbers, widened by a quarter of its length on both sides. */
static interval between(double a, double b)
{
    const double more = 0.25 * fabs(a - b);
    return (interval){fmin(a, b) - more, fmax(a, b) + more};
}

/* Tells whether the last step, which began at r->t, resolves the force and the invariants. */
static bool resolved(const runs *r, double h)
{
    const model *m = r->model;
    if (!m->verify->along) return true;
    for (size_t k = 0; k < m->nx; k++) r->in_x[k] = between(r->old_x[1][k], r->x[1][k]);
    for (size_t k = 0; k < m->nv; k++) r->in_v[k] = between(r->old_v[1][k], r->v[1][k]);
    const interval t = {fmin(r->t, r->t + h), fmax(r->t, r->t + h)};
    return resolution_fits(m->verify->along, t, r->in_x, r->in_v, m->pool);
}

/* Refuses an invariant that jumps: it has changed by a part of its terms over steps in which the motion cannot change
 * it. A jump that goes back within the time by which the runs may be late shows nothing: two terms that jump at once in
 * the exact motion may do so one after the other in a run. */
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

/* Notes the invariants before the last step, which began at r->t. */
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

/* Returns how far the runs are apart, as a part of the largest motion so far. */
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

/* Judges along the whole run, with shorter steps where others do not resolve force and invariants, and so far beyond it
 * as it takes to judge a jump before its end. */
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
        const motus_status stepped = step_both(r, now);
        if (stepped == MOTUS_MEMORY) return stepped;
        const bool taken = stepped == MOTUS_OK, short_enough = taken && resolved(r, now);
        if (!short_enough && depth < DEPTH) {
            step_back(r);
            h = now / 2, depth++;
            continue;
        }
        if (!taken || (!short_enough && ended)) break;
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
    const double rate = verify_fastest(m, m->start, r->x[0], r->v[0], r->room);
    const double work = fmax(m->terms, (double)m->nv) * (1 + (double)m->verify->nodes) * 20;
    const int steps = work * STEPS <= WORK_MAX ? STEPS : (int)(WORK_MAX / work);
    const double most = way / STEPS, least = rate > 0 ? STEP / rate : STEP * fabs(most);
    r->h = copysign(fmin(fabs(most), least), way);
    r->scale = fabs(r->h / STEP);
    motus_status status = judge_all(r, true);
    note_sizes(r);
    for (int n = 0; n < steps && status == MOTUS_OK; n++) {
        status = step_both(r, r->h);
        if (status != MOTUS_OK) return status == MOTUS_MEMORY ? status : MOTUS_OK;
        r->t = m->start + (n + 1) * r->h;
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

/* Notes what the algebra proves; that is judged only along the first steps, in which the rate is exact to rounding. */
static bool prove(model *m)
{
    for (uint32_t i = 0; i < m->definition_count; i++)
        if (m->verify->rate[i] && !field_conserves(m, &m->definitions[i], &m->verify->proved[i])) return false;
    return true;
}

static motus_status check(motus_system *s, motus_error *err)
{
    model *m = s->model;
    const verify *c = m->verify;
    tape *const boundary[] = {c->boundary_second};
    tape **const lists[] = {c->rate, c->rate_rounding, c->value, c->value_rounding};
    bool ready = verify_bind(m, boundary, 1);
    for (size_t k = 0; k < sizeof lists / sizeof *lists; k++) ready &= verify_bind(m, lists[k], m->definition_count);
    if (!ready || !prove(m)) return MOTUS_MEMORY;
    const size_t n = m->nv + 1, definitions = m->definition_count;
    size_t all = 0;
    for (uint32_t i = 0; i < m->definition_count; i++) all += m->definitions[i].numbers;
    double *room = take(&s->allocator, 14 * n + 3 * c->numbers + 3 * definitions + all, sizeof *room);
    uint32_t *off = take(&s->allocator, definitions + 1, sizeof *off);
    interval *in = take(&s->allocator, 2 * n, sizeof *in);
    const bool roomy = room && off && in;
    runs r = {.model = m, .t = m->start, .off = off, .in_x = in, .in_v = roomy ? in + n : NULL};
    chosen row;
    motus_status status = roomy ? row_choose(METHOD, &row, NULL, err) : MOTUS_MEMORY;
    if (status == MOTUS_OK)
        status = stepper_create(&s->machine, &row, m->start, 1, m->x0, m->v0, &s->allocator, &r.stepper, err);
    if (status == MOTUS_OK) {
        double *at = room, **arrays[] = {&r.x[0], &r.x[1], &r.v[0],     &r.v[1],     &r.a[0],     &r.a[1],
                                         &r.of_a, &r.room, &r.old_x[0], &r.old_x[1], &r.old_v[0], &r.old_v[1]};
        for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++)
            *arrays[k] = at, at += arrays[k] == &r.room ? 3 * n : n;
        r.rate[0] = at, r.rate[1] = at + c->numbers, r.of_rate = at + 2 * c->numbers, r.apart = at + 3 * c->numbers;
        r.size = r.apart + definitions;
        r.off_time = r.size + definitions;
        r.before = r.off_time + definitions;
        status = go(&r);
    }
    stepper_destroy(r.stepper);
    give(&s->allocator, room);
    give(&s->allocator, off);
    give(&s->allocator, in);
    return status;
}

motus_status invariants_check(motus_system *s, motus_error *err)
{
    model *m = s->model;
    /* a nudged text and a located system have the invariants of the text that was checked */
    if (!m->verify || !m->verify->numbers || m->source.nudged || m->side_count) return MOTUS_OK;
    m->source.error = err;
    const motus_status status = check(s, err);
    m->source.error = NULL;
    m->source.failed = false; /* the text can be read: its numbers contradict its claims */
    return status == MOTUS_MEMORY ? fail(err, MOTUS_MEMORY, "no memory to check the model's claims") : status;
}
