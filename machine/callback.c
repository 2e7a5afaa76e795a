/* The callback machine: the acceleration is the user's C function. */
#include "machine/machine.h"

#include <stdio.h>
#include <string.h>

static int accel(void *ctx, double t, double *x, double *v, double *a)
{
    const calling *c = ctx;
    const motus_callback_def *def = c->def;
    if (c->count || !def->acceleration)
        return def->block(def->context, c->first, c->count ? c->count : 1, t, x, v, a);
    return def->acceleration(def->context, t, x, v, a);
}

static int jvp(void *ctx, double t, double *x, double *v, const double *dx, const double *dv, double *da)
{
    const calling *c = ctx;
    return c->def->derivative(c->def->context, t, x, v, dx ? dx : c->zeros, dv ? dv : c->zeros, da);
}

static int exact(void *ctx, double t, double *x, double *v)
{
    const motus_callback_def *def = ((const calling *)ctx)->def;
    return def->exact(def->context, t, x, v);
}

static void name(void *ctx, bool in_v, size_t k, char *out, size_t size)
{
    const motus_callback_def *def = ((const calling *)ctx)->def;
    if (!in_v)
        snprintf(out, size, "x[%zu]", k);
    else if (k < def->positions)
        snprintf(out, size, "x[%zu]'", k);
    else
        snprintf(out, size, "s[%zu]", k - def->positions);
}

motus_status callback_problem(const calling *c, problem *p, motus_error *err)
{
    const motus_callback_def *def = c->def;
    if (!def->acceleration && !def->block)
        return fail(err, MOTUS_ARGUMENT, "the definition has no acceleration callback");
    if (def->positions + def->companions == 0)
        return fail(err, MOTUS_ARGUMENT, "the definition has neither positions nor companions");
    if (def->positions > MODEL_NUMBERS_MAX || def->companions > MODEL_NUMBERS_MAX)
        return fail(err, MOTUS_LIMIT, "at most %d positions and companions fit", MODEL_NUMBERS_MAX);
    if ((def->positions && !def->x) || !def->v)
        return fail(err, MOTUS_ARGUMENT, "the definition has no initial values");
    *p = (problem){.ctx = (void *)c, .nx = def->positions, .nv = def->positions + def->companions, .accel = accel,
                   .jvp = def->derivative ? jvp : NULL, .exact = def->exact ? exact : NULL, .name = name};
    p->traits = (traits){.velocity = def->depends_on_velocity, .time = def->depends_on_time, .linear_v = def->linear_in_velocity || !def->depends_on_velocity,
                         .smooth = true, .has_exact = def->exact != NULL, .companions = def->companions > 0};
    return MOTUS_OK;
}

problem callback_block(const calling *c, const problem *one)
{
    problem p = *one;
    p.ctx = (void *)c;
    p.nx *= c->count;
    p.nv *= c->count;
    p.jvp = NULL;                    /* a derivative that the user wrote knows of one trajectory only */
    return p;
}
