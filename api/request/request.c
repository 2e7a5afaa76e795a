/* See request.h.
 *
 * Invariant: a number that would change nothing is refused: a step where the method adapts its steps, a tolerance where
 * it does not. What the model says of its own method is ignored where the caller names another one, or wants an
 * accuracy that the model does not set; its step alone serves where a method has none.
 */
#include "api/request/request.h"

#include "api/system/system.h"
#include "core/stepper.h"

#include <math.h>
#include <string.h>

#define RELATIVE_LEAST 1e-15 /* a few roundings */
#define ACCURACY 1e-9        /* where "auto" chooses the method, and nobody gives an error */

/* What the members that both definitions have ask for. */
#define ASKED(d)                                                                                    \
    {                                                                                               \
        .set = {.size = sizeof(motus_settings),                                                     \
                .method = (d)->method,                                                              \
                .step = (d)->step,                                                                  \
                .from = NAN,                                                                        \
                .until = (d)->until,                                                                \
                .tolerance = (d)->tolerance,                                                        \
                .accuracy = (d)->accuracy,                                                          \
                .absolute = (d)->absolute != 0},                                                    \
        .shortest = (d)->shortest_step, .longest = (d)->longest_step, .most_steps = (d)->most_steps \
    }

/* Takes a number of the model where the caller gives none. Returns who says it; `aside`: the model's does not count. */
static motus_said merge(double *callers, double models, bool aside)
{
    if (!isnan(*callers)) return MOTUS_SAID_CALLER;
    if (isnan(models)) return MOTUS_SAID_NOBODY;
    if (aside) return MOTUS_SAID_ASIDE;
    *callers = models;
    return MOTUS_SAID_MODEL;
}

/* Adds to what the caller says, which the settings have, what the model says. chooses: where nobody names a method nor
 * a step, the library chooses it, also where nobody asks for an accuracy. */
static void add_model(motus_settings *q, const motus_system *s, bool chooses)
{
    const motus_settings set = system_settings(s);
    const bool asks = !isnan(q->accuracy), aside = q->method || (asks && isnan(set.accuracy));
    const bool error = asks || !isnan(q->tolerance) || !isnan(q->step); /* displaces the accuracy of the model */
    q->accuracy_said = merge(&q->accuracy, set.accuracy, aside || error);
    q->tolerance_said = merge(&q->tolerance, set.tolerance, aside || !isnan(q->accuracy));
    if (q->accuracy_said == MOTUS_SAID_MODEL || q->tolerance_said == MOTUS_SAID_MODEL) q->absolute = set.absolute;
    q->step_said = merge(&q->step, set.step, aside);
    if (isnan(q->step)) q->step = set.step;
    q->until_said = merge(&q->until, set.until, false);
    q->from_said = merge(&q->from, set.from, false);
    q->method_said = q->method ? MOTUS_SAID_CALLER : set.method && !aside ? MOTUS_SAID_MODEL : MOTUS_SAID_DEFAULT;
    if (q->method_said == MOTUS_SAID_MODEL) q->method = set.method;
    if (!isnan(q->accuracy)) chooses = true;
    if (!q->method) q->method = chooses && !request_asks(q->step_said) ? SYSTEM_AUTO : "verlet";
    q->automatic = system_auto(q->method);
    q->every_time = set.every_time, q->every_steps = set.every_steps;
}

request request_of_run(const motus_system *s, const motus_run_def *d)
{
    request q = ASKED(d);
    q.set.from = d->start;
    add_model(&q.set, s, true);
    if (q.set.automatic && isnan(q.set.accuracy) && isnan(q.set.tolerance))
        q.set.accuracy = ACCURACY, q.set.accuracy_said = MOTUS_SAID_DEFAULT;
    return q;
}

request request_of_ensemble(const motus_system *s, const motus_ensemble_def *d)
{
    request q = ASKED(d);
    q.ensemble = true;
    for (size_t k = 0; k < d->vary_count; k++) q.ends |= d->vary[k] && !strcmp(d->vary[k], "until");
    add_model(&q.set, s, false);
    if (q.ends && q.set.until_said == MOTUS_SAID_MODEL) q.set.until_said = MOTUS_SAID_ASIDE;
    if (!isnan(q.set.accuracy) && q.set.automatic && q.set.method_said != MOTUS_SAID_CALLER)
        q.set.method = "dop853", q.set.method_said = MOTUS_SAID_DEFAULT, q.set.automatic = 0;
    return q;
}

static motus_status refuse_step(const chosen *c, const char *whose, motus_error *err)
{
    fail(err, MOTUS_ARGUMENT, "%s a step, and %s chooses its steps by a tolerance", whose, c->name);
    hint(err, "give `tolerance = 1e-9` of the definition in its place");
    return MOTUS_ARGUMENT;
}

static motus_status refuse_tolerance(const chosen *c, const char *what, motus_error *err)
{
    fail(err, MOTUS_ARGUMENT, "%s, and the steps of %s have one size", what, c->name);
    hint(err, "choose an adaptive method, dopri5 or dop853, or give `step = 0.01` of the definition instead");
    return MOTUS_ARGUMENT;
}

motus_status request_admits(const char *what, double value, bool absolute, motus_error *err)
{
    if (!(value > 0) || !isfinite(value))
        return fail(err, MOTUS_ARGUMENT, "%s is a positive number, not %g", what, value);
    if (absolute || (value >= RELATIVE_LEAST && value < 1)) return MOTUS_OK;
    fail(err, MOTUS_ARGUMENT, "the relative %s %g %s", strchr(what, ' ') + 1, value,
         value < 1 ? "is below the rounding of the numbers" : "allows errors as large as the motion");
    hint(err, "give one from %g to 0.1", RELATIVE_LEAST);
    return MOTUS_ARGUMENT;
}

/* Refuses an absolute tolerance where steps follow the time scale of the motion, of which the tolerance is a part. */
static motus_status refuse_absolute(const chosen *c, motus_error *err)
{
    fail(err, MOTUS_ARGUMENT, "the tolerance of %s is relative: its steps follow the time scale of the motion",
         c->name);
    hint(err, "leave out `absolute`, or choose dop853, whose steps follow from errors");
    return MOTUS_ARGUMENT;
}

static motus_status check_limits(const request *q, motus_error *err)
{
    const bool sound = q->shortest >= 0 && !isinf(q->shortest);
    if (!sound || !(q->longest >= 0)) {
        fail(err, MOTUS_ARGUMENT, "the %s step is %g, and a limit of the steps is a positive number",
             sound ? "longest" : "shortest", sound ? q->longest : q->shortest);
        hint(err, "0 is for none: `%s_step = 0` of the definition", sound ? "longest" : "shortest");
        return MOTUS_ARGUMENT;
    }
    if (q->most_steps < 0) {
        fail(err, MOTUS_ARGUMENT, "the most steps are %lld, and a limit of their number is positive",
             (long long)q->most_steps);
        hint(err, "0 is for none: `most_steps = 0` of the definition");
        return MOTUS_ARGUMENT;
    }
    if (q->longest == 0 || q->shortest <= q->longest) return MOTUS_OK;
    return fail(err, MOTUS_ARGUMENT, "the shortest step, %g, is longer than the longest, %g", q->shortest, q->longest);
}

motus_status request_row(motus_system *s, const char *name, chosen *chosen, const motus_method **card, motus_error *err)
{
    if (system_auto(name)) {
        fail(err, MOTUS_METHOD, "auto chooses the method of a run, by its equation, its end and its accuracy");
        hint(err, "name a method here: dop853 suits every force, verlet conserves energy");
        return MOTUS_METHOD;
    }
    motus_status status = row_choose(name, chosen, card, err);
    if (status != MOTUS_OK) return status;
    /* also where Boris is not chosen: it may be the method that the refusal names */
    const bool may_need = (*card)->forces != MOTUS_FORCES_XVT || row_gyroscopic(chosen);
    if (may_need && !symmetry_gyroscopic(s)) return fail(err, MOTUS_MEMORY, "no memory to examine the velocity term");
    return row_admits(chosen, &s->problem.traits, err);
}

static motus_status choose_fixed(const request *q, motus_error *err)
{
    const bool limits = q->shortest != 0 || q->longest != 0 || q->most_steps != 0;
    if (q->set.tolerance_said == MOTUS_SAID_CALLER) return refuse_tolerance(&q->chosen, "a tolerance is given", err);
    if (limits) return refuse_tolerance(&q->chosen, "limits of the steps are given", err);
    if (q->set.tolerance_said == MOTUS_SAID_MODEL)
        return refuse_tolerance(&q->chosen, "the model sets a tolerance", err);
    return MOTUS_OK;
}

motus_status request_choose(motus_system *s, request *q, motus_error *err)
{
    chosen *const c = &q->chosen;
    motus_status status = request_row(s, q->set.method, c, &q->card, err);
    if (status != MOTUS_OK) return status;
    if (!row_adaptive(c)) return choose_fixed(q, err);
    if (q->set.step_said == MOTUS_SAID_CALLER) return refuse_step(c, "the definition gives", err);
    if (q->set.step_said == MOTUS_SAID_MODEL) return refuse_step(c, "the model sets", err);
    const double tolerance = isnan(q->set.tolerance) ? ROW_TOLERANCE : q->set.tolerance;
    if (q->set.absolute && row_reversible_steps(c)) return refuse_absolute(c, err);
    status = request_admits("a tolerance", tolerance, q->set.absolute, err);
    if (status == MOTUS_OK) status = check_limits(q, err);
    if (status != MOTUS_OK) return status;
    c->relative = q->set.absolute ? 0 : fmin(tolerance, stepper_tolerance_most(c));
    c->absolute = q->set.absolute ? tolerance : 0;
    c->least = q->shortest;
    c->most = q->longest > 0 ? q->longest : INFINITY;
    c->count = q->most_steps;
    return MOTUS_OK;
}
