/* The callback machine: the acceleration is the user's C function.
 *
 * Invariant: where a callback returns a value other than 0, `returned` of the calling holds it, for the error. A
 * callback that is said not to read the velocity gets NaN in its place, so that it cannot read it unnoticed; where it
 * does, the evaluation fails with `returned` 0.
 */
#include "machine/machine.h"

#include <stdio.h>

static int keep_returned(calling *c, int returned)
{
    if (returned) c->returned = returned;
    return returned;
}

static int call(calling *c, double t, const double *x, const double *v, double *a)
{
    const motus_callback_def *def = c->def;
    if (c->count || !def->acceleration)
        return keep_returned(c, def->block(def->context, c->first, c->count ? c->count : 1, t, x, v, a));
    return keep_returned(c, def->acceleration(def->context, t, x, v, a));
}

static bool finite_numbers(const double *a, size_t count)
{
    double none = 0;
    for (size_t k = 0; k < count; k++) none += a[k] - a[k];
    return none == 0;
}

static int accel(void *ctx, double t, double *x, double *v, double *a)
{
    calling *c = ctx;
    const motus_callback_def *def = c->def;
    if (!c->unread) return call(c, t, x, v, a);
    const size_t count = (def->positions + def->first_order) * (c->count ? c->count : 1);
    const int bad = call(c, t, x, c->unread, a);
    if (bad || finite_numbers(a, count)) return bad;
    if (call(c, t, x, v, a) || !finite_numbers(a, count)) return 0; /* NaN for another reason */
    c->returned = 0;
    return -1;
}

static int jvp(void *ctx, double t, double *x, double *v, const double *dx, const double *dv, double *da)
{
    calling *c = ctx;
    return keep_returned(c, c->def->derivative(c->def->context, t, x, v, dx ? dx : c->zeros, dv ? dv : c->zeros, da));
}

static int exact(void *ctx, double t, double *x, double *v)
{
    calling *c = ctx;
    return keep_returned(c, c->def->exact(c->def->context, t, x, v));
}

/* Writes the user's name, or x or s, with a number from 1 where there are several. */
static void name(void *ctx, bool in_v, size_t k, char *out, size_t size)
{
    const motus_callback_def *def = ((const calling *)ctx)->def;
    const bool first_order = k >= def->positions;
    const size_t number = first_order ? k - def->positions : k, all = first_order ? def->first_order : def->positions;
    const char *prime = in_v && !first_order ? "'" : "";
    if (def->names)
        snprintf(out, size, "%s%s", def->names[k], prime);
    else if (all == 1)
        snprintf(out, size, "%s%s", first_order ? "s" : "x", prime);
    else
        snprintf(out, size, "%s[%zu]%s", first_order ? "s" : "x", number + 1, prime);
}

motus_status callback_problem(calling *c, problem *p, motus_error *err)
{
    const motus_callback_def *def = c->def;
    if (!def->acceleration && !def->block)
        return fail(err, MOTUS_ARGUMENT, "the definition has no acceleration callback");
    if (def->positions + def->first_order == 0)
        return fail(err, MOTUS_ARGUMENT, "the definition has neither positions nor first-order variables");
    if (def->positions > MODEL_NUMBERS_MAX || def->first_order > MODEL_NUMBERS_MAX)
        return fail(err, MOTUS_LIMIT, "at most %d positions and first-order variables fit", MODEL_NUMBERS_MAX);
    if ((def->positions && !def->x) || !def->v)
        return fail(err, MOTUS_ARGUMENT, "the definition has no initial values");
    *p = (problem){.ctx = c,
                   .nx = def->positions,
                   .nv = def->positions + def->first_order,
                   .accel = accel,
                   .jvp = def->derivative ? jvp : NULL,
                   .exact = def->exact ? exact : NULL,
                   .name = name,
                   .returned = &c->returned};
    p->traits = (traits){.velocity = def->depends_on_velocity,
                         .time = def->depends_on_time,
                         .linear_v = def->linear_in_velocity || !def->depends_on_velocity,
                         .smooth = true,
                         .has_exact = def->exact != NULL,
                         .first_order = def->first_order > 0};
    return MOTUS_OK;
}

problem callback_block(calling *c, const problem *one)
{
    problem p = *one;
    p.ctx = c;
    p.returned = &c->returned;
    p.nx *= c->count;
    p.nv *= c->count;
    p.jvp = NULL; /* the user's derivative serves one trajectory only */
    return p;
}
