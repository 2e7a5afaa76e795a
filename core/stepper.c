/* The life of a stepper: its plan, its memory, the choice of instruction set, the change of machine. See stepper.h.
 *
 * core/stepper_body.c, compiled once per instruction set, does the arithmetic. The fastest body that this processor can
 * run is chosen when a stepper is made, which changes no bit.
 */
#include "core/stepper_parts.h"

#include <string.h>

/* CHECK_ALWAYS: a state of at most this many numbers is checked after every step. LINE: bytes of a cache line, to which
 * arrays are aligned. */
enum { CHECK_ALWAYS = 4096, LINE = 64 };
enum { SERIES_MOST = 1 << 27 }; /* numbers of a model's Taylor series: a gigabyte */

const stepper_body *stepper_best_body(void)
{
#if defined ONE_COPY /* where size counts more than speed: the body of traced steps serves for all */
    return &trace_body;
#elif defined __x86_64__ && !defined ONE_ISA
    __builtin_cpu_init();
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512dq"))
        return &stepper_body_avx512;
    return avx2 ? &stepper_body_avx2 : &stepper_body_base;
#else
    return &stepper_body_base;
#endif
}

void stepper_use_body(stepper *s, const stepper_body *body) { s->body = body; }

/* Life ------------------------------------------------------------------------------------------------------------ */

bool stepper_refuses(const chosen *c) { return row_adaptive(c) && !row_reversible_steps(c); }

bool stepper_fixed(const problem *p, const work *plan)
{
    return plan->affine || (!plan->solves_x && p->traits.linear_v && p->traits.constant_jv);
}

static motus_status prepare_solver(stepper *s, motus_error *err)
{
    const work *w = &s->work;
    if (!w->solves) return MOTUS_OK;
    return solver_create(&s->problem, w->solves, w->solves_x, s->problem.traits.velocity, stepper_fixed(&s->problem, w),
                         w->stride, &s->allocator, &s->library.solver, err);
}

work stepper_plan(const problem *p, const chosen *method, coef *memory)
{
    work plan = {.row = method->row, .nx = p->nx, .nv = p->nv};
    plan.velocity = p->traits.velocity;
    plan.linear = p->traits.linear_v;
    plan.quadrature = p->traits.quadrature;
    plan.constant = p->traits.constant;
    plan.affine = p->traits.affine && !p->traits.time;
    plan.relative = method->relative;
    plan.absolute = method->absolute;
    plan.least = method->least;
    plan.most = method->most;
    plan.variable = p->variables;
    plan.variables = p->variable_count;
    plan.between = method->row->card.dense_order;
    plan.threads = method->threads > 1 ? method->threads : 1;
    plan.stride = (p->nv + 7) & ~(size_t)7;
    if (plan.stride == 0) plan.stride = 8;
    plan.check = p->nx + p->nv <= CHECK_ALWAYS;
    stepper_best_body()->plan(&plan, method->argument, memory);
    if (plan.expands && p->series) plan.series = p->series_numbers(p->ctx, plan.expands + 1);
    return plan;
}

double stepper_tolerance_most(const chosen *c)
{
    enum { ROOM = 1024 }; /* more than the constants of any splitting */
    const problem one = {.nx = 1, .nv = 1};
    coef memory[ROOM];
    if (!c->row->density) return INFINITY;
    const work sizes = stepper_plan(&one, c, NULL);
    if (work_plan_size(&sizes) > ROOM) return INFINITY;
    const work plan = stepper_plan(&one, c, memory);
    double most = 1.05; /* more than 1, because the control computes powers roughly, for the longest steps */
    for (int i = 0; i <= plan.order; i++) most *= DENSITY_MOST / DENSITY_REACH(&plan);
    return most;
}

size_t stepper_arrays(work plan) { return stepper_best_body()->place(&plan, NULL); }

size_t stepper_carried(work plan)
{
    double *list[CARRY_MAX];
    return (size_t)stepper_best_body()->carry(&plan, list);
}

motus_status stepper_create(const machine *m, const chosen *method, double t0, double h, const double *x,
                            const double *v, const motus_allocator *allocator, stepper **out, motus_error *err)
{
    const problem *p = m->problem;
    motus_status status = row_admits(method, &p->traits, err);
    if (status) return status;
    const work sizes = stepper_plan(p, method, NULL);
    if (sizes.expands > SERIES_ORDER_MOST) {
        fail(err, MOTUS_LIMIT, "Taylor series to order %d", sizes.expands);
        hint(err, "at most %d", SERIES_ORDER_MOST);
        return MOTUS_LIMIT;
    }
    if (sizes.expands && !sizes.series) return fail(err, MOTUS_MEMORY, "out of memory for the Taylor series");
    if (sizes.series > SERIES_MOST) {
        fail(err, MOTUS_LIMIT, "the Taylor series of this model take %.1f GB", 8e-9 * (double)sizes.series);
        hint(err, "every pair of bodies has series of its own: take fewer bodies, or another method");
        return MOTUS_LIMIT;
    }
    const size_t arrays = stepper_arrays(sizes), carried = stepper_carried(sizes) * p->nv + STEPPER_CLOCKS;
    const size_t head = (sizeof(stepper) + LINE - 1) / LINE * LINE, plan = work_plan_size(&sizes);
    const size_t twice = p->nx + p->nv <= CHECK_ALWAYS ? 2 : 1; /* how many snapshots are kept */
    if (sizes.stride > (SIZE_MAX - head - LINE) / sizeof(double) / (arrays + 2 * CARRY_MAX + 3) - plan)
        return fail(err, MOTUS_MEMORY, "out of memory for the state");
    char *block = take(
        allocator, head + LINE + (arrays * sizes.stride + twice * carried + plan + p->nx + p->nv) * sizeof(double), 1);
    if (!block) return fail(err, MOTUS_MEMORY, "out of memory for the state");
    stepper *s = (stepper *)(void *)block;
    double *memory = (double *)(void *)(block + head + (LINE - (uintptr_t)(block + head) % LINE) % LINE);
    s->problem = *p;
    if (allocator) s->allocator = *allocator;
    s->method = *method;
    s->body = m->body ? m->body : stepper_best_body();
    s->arrays = memory;
    s->array_count = arrays * sizes.stride;
    s->snapshot = memory + s->array_count;
    s->earlier = twice > 1 ? s->snapshot + carried : NULL;
    s->origin = s->snapshot + twice * carried;
    s->work = stepper_plan(p, method, s->origin + p->nx + p->nv);
    s->library.problem = &s->problem;
    if (!p->variables) {
        s->all[1] = p->nv;
        s->work.variable = s->all;
        s->work.variables = 1;
    }
    s->work.services = &s->library;
    s->work.host = m->host;
    s->work.check = s->work.check && !m->host;
    s->body->place(&s->work, memory);
    status = stepper_start(s, t0, h, x, v, err);
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
    solver_destroy(s->library.solver);
    give(&allocator, s->ends);
    give(&allocator, s->inside);
    give(&allocator, s->watched);
    give(&allocator, s);
}

/* Moves the mark of dense output, because it may be that of the next step. */
static void move_ends(stepper *from, stepper *to)
{
    to->ends = from->ends;
    from->ends = NULL;
    to->left = from->left;
    to->right = from->right;
    to->left_t = from->left_t;
    to->left_lost = from->left_lost;
    to->left_steps = from->left_steps;
}

motus_status stepper_move(stepper **s, const machine *m, motus_error *err)
{
    stepper *from = *s, *to = NULL;
    const size_t nx = from->work.nx, nv = from->work.nv;
    double *x = take(&from->allocator, nx + nv + stepper_carry(from), sizeof *x), *carry = x + nx + nv;
    if (!x) return fail(err, MOTUS_MEMORY, "out of memory for the state");
    motus_status status = stepper_sync(from, x, x + nx, NULL, err);
    if (!status)
        status = stepper_create(m, &from->method, from->main_t0, from->leg_h, x, x + nx, &from->allocator, &to, err);
    if (!status) status = stepper_load(to, stepper_save(from, carry), carry, err);
    give(&from->allocator, x);
    if (status) {
        stepper_destroy(to);
        return status;
    }
    move_ends(from, to);
    to->work.h = from->work.h;
    to->pace_n = from->pace_n, to->pace_t = from->pace_t;
    to->judge = from->judge, to->judge_ctx = from->judge_ctx;
    to->inspector = from->inspector, to->inspector_ctx = from->inspector_ctx, to->rest = from->rest;
    to->at = from->at, to->earlier_at = from->earlier_at;
    to->origin_known = stepper_origin(from, to->origin, to->origin + nx);
    memcpy(to->snapshot, from->snapshot, stepper_carry(from) * sizeof *to->snapshot);
    if (from->earlier) memcpy(to->earlier, from->earlier, stepper_carry(from) * sizeof *to->earlier);
    *s = to;
    stepper_destroy(from);
    return MOTUS_OK;
}
