/* One trajectory of a problem: memory, the choice of instruction set, errors in words, the way back to the last good step.
 *
 * core/stepper_body.c, compiled once per instruction set, does the arithmetic (its first lines say with which flags); here the fastest
 * one that this processor has is chosen when a stepper is made. It cannot change the bits.
 *
 * Invariant: after a failure the stepper stands at the last step whose state was finite. Every SNAPSHOT steps the carried numbers are
 * kept (of large systems, where that costs more beside a step, every SNAPSHOT_LARGE); a failure goes back to them and takes the good steps once more,
 * which is exact, since steps are deterministic.
 */
#include "core/stepper.h"
#include "core/stepper_body.h"
#include "core/trace_body.h"

#include <stdio.h>
#include <string.h>

enum { SNAPSHOT = 16, SNAPSHOT_LARGE = 256, CHECK_ALWAYS = 4096, LINE = 64 };      /* LINE: bytes of a cache line, to which arrays are aligned */

struct stepper {
    problem problem;
    stepper_host machine;
    motus_allocator allocator;
    chosen method;
    work work;
    const stepper_body *body;
    double *snapshot;
    int64_t snapshot_step, snapshot_evaluations, snapshot_iterations;       /* step: -1 where there is none */
};

const stepper_body *stepper_best_body(void)
{
#if defined ONE_COPY            /* where size counts more: the one that could tell, too */
    return &trace_body;
#elif defined __x86_64__
    __builtin_cpu_init();
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq"))
        return &stepper_body_avx512;
    return avx2 ? &stepper_body_avx2 : &stepper_body_base;
#else
    return &stepper_body_base;
#endif
}

void stepper_use_body(stepper *s, const stepper_body *body) { s->body = body; }

/* Errors ---------------------------------------------------------------------------------------------------------- */

static const char *name_of(const stepper *s, bool in_v, size_t k, char out[MOTUS_NAME_MAX])
{
    out[0] = 0;
    if (s->problem.name) s->problem.name(s->problem.ctx, in_v, k, out, MOTUS_NAME_MAX);
    if (!out[0]) snprintf(out, MOTUS_NAME_MAX, "%s[%zu]", in_v ? "v" : "x", k);
    return out;
}

static motus_status report(const stepper *s, int bad, double t, motus_error *err)
{
    const work *w = &s->work;
    char time[DECIMAL_MAX], name[MOTUS_NAME_MAX], step[DECIMAL_MAX];
    decimal(t, time);
    decimal(w->h, step);
    name_of(s, w->in_v, w->which, name);
    motus_status status = MOTUS_CALLBACK;
    if (bad == STEP_DIVERGED) {
        status = fail(err, MOTUS_DIVERGED, "the motion left the finite numbers at t = %s: %s is no longer finite", time, name);
        hint(err, "with %s and step %s; try a smaller step, or look for a division by zero on the way", s->method.name, step);
    } else if (bad == STEP_SOLVE) {
        status = fail(err, MOTUS_SOLVE, "%s could not solve its implicit equation at t = %s: %s does not settle", s->method.name, time, name);
        hint(err, "the step is %s; a smaller one brings the solution nearer to the starting guess", step);
    } else {
        const bool here = s->problem.returned && *s->problem.returned > 0;
        fail(err, MOTUS_CALLBACK,
             here ? "by its callback, the acceleration cannot be evaluated at t = %s"
                  : "the acceleration callback reported a failure at t = %s",
             time);
        if (here) hint(err, "the run is at its last good step; a smaller step may lead around the place");
    }
    if (!err) return status;
    err->time = t;
    err->returned = bad == STEP_CALLBACK && s->problem.returned ? *s->problem.returned : 0;
    if (bad != STEP_CALLBACK) snprintf(err->variable, sizeof err->variable, "%s", name);
    return status;
}

/* Life ------------------------------------------------------------------------------------------------------------ */

static motus_status check_start(stepper *s, double t0, double h, const double *x, const double *v, motus_error *err)
{
    char name[MOTUS_NAME_MAX];
    if (!isfinite(t0) || !isfinite(h) || h == 0 || t0 + h == t0) {
        fail(err, MOTUS_ARGUMENT, "the step must be a finite number that moves time on");
        hint(err, "choose a step that is not too small beside the time itself");
        return MOTUS_ARGUMENT;
    }
    for (size_t k = 0; k < s->problem.nx; k++)
        if (!isfinite(x[k])) return fail(err, MOTUS_ARGUMENT, "the initial value of %s is not a finite number", name_of(s, false, k, name));
    for (size_t k = 0; k < s->problem.nv; k++)
        if (!isfinite(v[k])) return fail(err, MOTUS_ARGUMENT, "the initial value of %s is not a finite number", name_of(s, true, k, name));
    return MOTUS_OK;
}

/* The exact line describes one motion; a run that starts elsewhere is not it. */
static motus_status check_exact(stepper *s, motus_error *err)
{
    work *w = &s->work;
    const problem *p = &s->problem;
    if (s->method.row->family != EXACT || p->traits.constant) return MOTUS_OK;
    if (!p->exact) return fail(err, MOTUS_METHOD, "exact does not admit this model: its exact motion is not known");
    double *x = take(&s->allocator, p->nx + p->nv, sizeof *x), size = 0, miss = 0;
    if (!x) return fail(err, MOTUS_MEMORY, "out of memory");
    memcpy(x, w->x, p->nx * sizeof *x);
    memcpy(x + p->nx, w->v, p->nv * sizeof *x);
    int bad = p->exact(p->ctx, w->t0, x, x + p->nx);
    for (size_t k = 0; k < p->nx + p->nv; k++) {
        const double start = k < p->nx ? w->x[k] : w->v[k - p->nx];
        size = fmax(size, fabs(start));
        const double off = fabs(x[k] - start);
        if (!(off <= miss)) miss = off;
    }
    give(&s->allocator, x);
    if (bad) return report(s, STEP_CALLBACK, w->t0, err);
    if (miss <= 1e-9 * (1 + size)) return MOTUS_OK;
    fail(err, MOTUS_METHOD, "exact does not admit this start: the exact motion is elsewhere at that time");
    hint(err, "start on it, or choose another method");
    return MOTUS_METHOD;
}

static motus_status prepare_solver(stepper *s, motus_error *err)
{
    const row *row = s->method.row;
    const traits *traits = &s->problem.traits;
    work *w = &s->work;
    bool use_x = false, use_v = traits->velocity;
    int stages = 1;
    if (row->family == IMPLICIT) {
        stages = w->stages - w->known;
        for (int i = w->known; i < w->stages; i++)
            for (int j = w->known; j < w->stages; j++) use_x = use_x || w->hha[i][j] != 0;
    } else if (!row->gyroscopic && !(row->family == TWO_STEP && row->two_step != BEEMAN && traits->velocity)) {
        return MOTUS_OK;
    }
    const bool fixed = traits->affine && !traits->time;
    return solver_create(&s->problem, stages, use_x, use_v, fixed || (!use_x && traits->linear_v && traits->constant_jv), w->stride,
                         &s->allocator, &s->machine.solver, err);
}

work stepper_plan(const problem *p, const chosen *method, double t0, double h)
{
    work plan = {.row = method->row, .nx = p->nx, .nv = p->nv, .t0 = t0, .h = h};
    plan.velocity = p->traits.velocity;
    plan.linear = p->traits.linear_v;
    plan.constant = p->traits.constant;
    plan.threads = method->threads > 1 ? method->threads : 1;
    plan.stride = (p->nv + 7) & ~(size_t)7;
    if (plan.stride == 0) plan.stride = 8;
    work_plan(&plan, method->argument);
    return plan;
}

size_t stepper_arrays(work plan) { return work_place(&plan, NULL); }

motus_status stepper_create(const problem *p, const chosen *method, double t0, double h, const double *x, const double *v,
                            const motus_allocator *allocator, stepper **out, motus_error *err)
{
    motus_status status = row_admits(method, &p->traits, err);
    if (status) return status;
    work plan = stepper_plan(p, method, t0, h);
    plan.check = p->nx + p->nv <= CHECK_ALWAYS;
    double *list[CARRY_MAX];
    const size_t arrays = work_place(&plan, NULL), carried = (size_t)work_carry(&plan, list) * p->nv;
    const size_t head = (sizeof(stepper) + LINE - 1) / LINE * LINE;
    if (plan.stride > (SIZE_MAX - head - LINE) / sizeof(double) / (arrays + CARRY_MAX))
        return fail(err, MOTUS_MEMORY, "out of memory for the state");
    char *block = take(allocator, head + LINE + (arrays * plan.stride + carried) * sizeof(double), 1);
    if (!block) return fail(err, MOTUS_MEMORY, "out of memory for the state");
    stepper *s = (stepper *)(void *)block;
    double *memory = (double *)(void *)(block + head + (LINE - (uintptr_t)(block + head) % LINE) % LINE);
    s->problem = *p;
    if (allocator) s->allocator = *allocator;
    s->method = *method;
    s->body = stepper_best_body();
    s->work = plan;
    s->machine.problem = &s->problem;
    s->work.user = &s->machine;
    s->snapshot_step = -1;
    work_place(&s->work, memory);
    s->snapshot = memory + arrays * plan.stride;
    status = check_start(s, t0, h, x, v, err);
    if (!status) {
        memcpy(s->work.x, x, p->nx * sizeof *x);
        memcpy(s->work.v, v, p->nv * sizeof *v);
        status = check_exact(s, err);
    }
    if (!status) status = prepare_solver(s, err);
    if (status) {
        stepper_destroy(s);
        return status;
    }
    *out = s;
    return MOTUS_OK;
}

void stepper_destroy(stepper *s)
{
    if (!s) return;
    const motus_allocator allocator = s->allocator;
    solver_destroy(s->machine.solver);
    give(&allocator, s);
}

/* Carry ----------------------------------------------------------------------------------------------------------- */

double stepper_time(const stepper *s) { return time_of(&s->work, s->work.n); }
int64_t stepper_steps(const stepper *s) { return s->work.n; }
int64_t stepper_evaluations(const stepper *s) { return s->work.evaluations; }
int64_t stepper_iterations(const stepper *s) { return s->work.iterations; }

size_t stepper_carry(const stepper *s)
{
    double *list[CARRY_MAX];
    return (size_t)work_carry(&s->work, list) * s->work.nv;
}

void stepper_save(const stepper *s, double *carry)
{
    double *list[CARRY_MAX];
    const size_t nv = s->work.nv;
    const int count = work_carry(&s->work, list);
    for (int i = 0; i < count; i++) memcpy(carry + (size_t)i * nv, list[i], nv * sizeof *carry);
}

static void load(stepper *s, int64_t step, int64_t evaluations, int64_t iterations, const double *carry)
{
    work *w = &s->work;
    w->n = step;                       /* first: what is carried depends on it */
    w->evaluations = evaluations;
    w->iterations = iterations;
    w->fresh = false;
    double *list[CARRY_MAX];
    const int count = work_carry(w, list);
    for (int i = 0; i < count; i++) memcpy(list[i], carry + (size_t)i * w->nv, w->nv * sizeof *carry);
}

motus_status stepper_load(stepper *s, int64_t step, int64_t evaluations, int64_t iterations, const double *carry, motus_error *err)
{
    if (step < 0 || evaluations < 0 || iterations < 0) return fail(err, MOTUS_STATE, "the restart state has a negative counter");
    const size_t count = stepper_carry(s);
    for (size_t k = 0; k < count; k++)
        if (!isfinite(carry[k])) return fail(err, MOTUS_STATE, "number %zu of the restart state is not finite", k + 1);
    load(s, step, evaluations, iterations, carry);
    s->snapshot_step = -1;
    return MOTUS_OK;
}

/* Motion ---------------------------------------------------------------------------------------------------------- */

static void go_back(stepper *s)
{
    load(s, s->snapshot_step, s->snapshot_evaluations, s->snapshot_iterations, s->snapshot);
}

/* Number of finished steps that led to a finite state: all, or all but the last one. */
static int64_t good_steps(stepper *s, int bad)
{
    return s->work.n - (bad == STEP_DIVERGED && s->body->check(&s->work));
}

/* From a failure after the snapshot to the last good step; says what the failure was. */
static motus_status recover(stepper *s, int bad, motus_error *err)
{
    work *w = &s->work;
    double t = time_of(w, w->n);
    int64_t good = good_steps(s, bad);
    if (!w->check) {                   /* infinities may be some steps old, and may be what made the last step fail */
        const size_t which = w->which;
        const bool in_v = w->in_v;
        const int64_t end = w->n;
        w->check = true;
        go_back(s);
        if (s->body->run(w, end - w->n) == STEP_DIVERGED) {
            bad = STEP_DIVERGED;
            t = time_of(w, w->n);
            good = good_steps(s, bad);
        } else {
            w->which = which;
            w->in_v = in_v;
        }
        w->check = false;
    }
    const motus_status status = report(s, bad, t, err);
    go_back(s);
    if (s->body->run(w, good - w->n)) go_back(s);
    s->snapshot_step = -1;
    return status;
}

/* How many steps may follow before the next snapshot, which is made first if its time has come. */
static int64_t room_of(stepper *s)
{
    const work *w = &s->work;
    const int64_t apart = w->check ? SNAPSHOT : SNAPSHOT_LARGE;
    if (s->snapshot_step < 0 || w->n - s->snapshot_step >= apart) {
        stepper_save(s, s->snapshot);
        s->snapshot_step = w->n;
        s->snapshot_evaluations = w->evaluations;
        s->snapshot_iterations = w->iterations;
    }
    return apart - (w->n - s->snapshot_step);
}

static motus_status take_steps(stepper *s, const stepper_body *body, int64_t steps, motus_error *err)
{
    work *w = &s->work;
    w->finite = false;
    int bad = body->run(w, steps);
    s->machine.tracing = NULL;          /* what recovery takes once more, it takes in silence */
    if (!bad && !w->check && !w->finite) bad = body->check(w);
    return bad ? recover(s, bad, err) : MOTUS_OK;
}

motus_status stepper_advance(stepper *s, int64_t steps, motus_error *err)
{
    motus_status status = MOTUS_OK;
    while (steps > 0 && !status) {
        const int64_t room = room_of(s), chunk = steps < room ? steps : room;
        status = take_steps(s, s->body, chunk, err);
        steps -= chunk;
    }
    return status;
}

/* The body that tells is lent for this one step. */
motus_status stepper_trace(stepper *s, const tracer *to, motus_error *err)
{
    const tracing tracing = {.to = to, .unit = stepper_plan(&s->problem, &s->method, 0, 1), .iterations = s->work.iterations};
    room_of(s);
    s->machine.tracing = &tracing;
    trace_begin(&s->work);
    return take_steps(s, &trace_body, 1, err);
}

motus_status stepper_sync(stepper *s, double *x, double *v, double *a, motus_error *err)
{
    work *w = &s->work;
    const int bad = s->body->sync(w, x, v, a);
    if (bad) return report(s, bad, stepper_time(s), err);
    for (size_t k = 0; k < w->nx + w->nv; k++) {
        const bool in_v = k >= w->nx;
        const size_t at = in_v ? k - w->nx : k;
        if (isfinite(in_v ? v[at] : x[at])) continue;
        w->in_v = in_v;
        w->which = at;
        return report(s, STEP_DIVERGED, stepper_time(s), err);
    }
    return MOTUS_OK;
}
