/* See evidence.h. */
#include "api/why/evidence.h"

#include "api/system/vector.h"

#include <math.h>
#include <string.h>

static int accel(void *ctx, double t, double *x, double *v, double *a)
{
    const trial *p = ctx;
    return p->own->accel(p->own->ctx, p->from + t, x, v, a);
}

static int jvp(void *ctx, double t, double *x, double *v, const double *dx, const double *dv, double *da)
{
    const trial *p = ctx;
    return p->own->jvp(p->own->ctx, p->from + t, x, v, dx, dv, da);
}

static bool prepare(void *ctx, bool in_v)
{
    const trial *p = ctx;
    return p->own->prepare(p->own->ctx, in_v);
}

static void pattern(void *ctx, bool in_v, void (*emit)(void *arg, size_t row, size_t column), void *arg)
{
    const trial *p = ctx;
    p->own->pattern(p->own->ctx, in_v, emit, arg);
}

static size_t series_numbers(void *ctx, int length)
{
    const trial *p = ctx;
    return p->own->series_numbers(p->own->ctx, length);
}

static void series(void *ctx, int length, int n, double t, double *x, double *v, double *a, double *kept)
{
    const trial *p = ctx;
    p->own->series(p->own->ctx, length, n, p->from + t, x, v, a, kept);
}

static void refresh(void *ctx, double t, double *x, double *v)
{
    const trial *p = ctx;
    p->own->refresh(p->own->ctx, p->from + t, x, v);
}

bool trial_begin(trial *p, const problem *own, const motus_allocator *memory, const chosen *row, double t, double h,
                 const double *x, const double *v, int64_t steps)
{
    *p = (trial){.own = own, .problem = *own, .from = t, .steps = steps};
    p->problem.ctx = p;
    p->problem.accel = accel;
    p->problem.jvp = own->jvp ? jvp : NULL;
    p->problem.prepare = own->prepare ? prepare : NULL;
    p->problem.pattern = own->pattern ? pattern : NULL;
    p->problem.series_numbers = own->series ? series_numbers : NULL;
    p->problem.series = own->series ? series : NULL;
    p->problem.refresh = own->refresh ? refresh : NULL;
    p->problem.exact = NULL;
    p->problem.exact_rounding = NULL;
    p->problem.name = NULL;
    const machine m = {.name = "interpreter", .problem = &p->problem};
    return stepper_create(&m, row, 0, h, x, v, memory, &p->stepper, NULL) == MOTUS_OK;
}

void trial_end(trial *p)
{
    stepper_destroy(p->stepper);
    p->stepper = NULL;
}

motus_status trial_step(trial *p, double until, bool *arrived)
{
    stepper_stop why;
    if (p->steps-- <= 0) return MOTUS_STEPS;
    const motus_status status = stepper_advance(p->stepper, (stepper_limit){1, until}, &why, NULL);
    *arrived = why == STOP_UNTIL;
    return status;
}

/* Returns the largest number of the state. NaN: it cannot be observed between two steps. */
static double size_of(trial *p, double *x, double *v)
{
    if (stepper_sync(p->stepper, x, v, NULL, NULL) != MOTUS_OK) return NAN;
    return fmax(vector_largest(x, p->own->nx), vector_largest(v, p->own->nv));
}

trial_course trial_run(const problem *own, const motus_allocator *memory, const chosen *row, double t, double h,
                       const double *x, const double *v, int64_t steps, double until, double *end)
{
    trial p;
    trial_course out = {.status = MOTUS_MEMORY};
    double *room = take(memory, own->nx + own->nv, sizeof *room);
    bool arrived = false;
    if (room && trial_begin(&p, own, memory, row, t, h, x, v, steps)) {
        do {
            out.status = trial_step(&p, until, &arrived);
            const double size = out.status == MOTUS_OK ? size_of(&p, room, room + own->nx) : 0;
            out.largest = size <= out.largest ? out.largest : size;
        } while (out.status == MOTUS_OK && !arrived);
        if (end) memcpy(end, room, (own->nx + own->nv) * sizeof *end);
        out.gone = fabs(stepper_time(p.stepper));
        out.steps = stepper_steps(p.stepper);
        trial_end(&p);
    }
    give(memory, room);
    return out;
}
