/* See request.h.
 *
 * Invariant: a number that would change nothing is refused: a step where the method adapts its steps, a tolerance where
 * it does not. What the model says of its own method is left aside where the caller names another one, or wants an
 * accuracy that the model does not set; its step alone serves where a method has none.
 */
#include "api/request/request.h"

#include "api/system/system.h"
#include "core/stepper.h"

#include <math.h>
#include <string.h>

#define RELATIVE_LEAST 1e-15 /* a few roundings */

static said who(double callers, double models, bool aside)
{
    return !isnan(callers) ? SAID_CALLER : isnan(models) ? SAID_NOBODY : aside ? SAID_ASIDE : SAID_MODEL;
}

/* Adds to what the caller says, which the request has, what the model says. chooses: where nobody names a method nor a
 * step, the library chooses it, also where nobody asks for an accuracy. */
static void add_model(request *q, const motus_system *s, bool chooses)
{
    motus_settings set = motus_default_settings();
    motus_settings_of(s, &set);
    const bool asks = !isnan(q->accuracy), aside = q->method || (asks && isnan(set.accuracy));
    const bool error = asks || !isnan(q->tolerance) || !isnan(q->step); /* displaces the accuracy of the model */
    q->accuracy_said = who(q->accuracy, set.accuracy, aside || error);
    if (q->accuracy_said == SAID_MODEL) q->accuracy = set.accuracy, q->absolute = set.absolute;
    q->tolerance_said = who(q->tolerance, set.tolerance, aside || !isnan(q->accuracy));
    if (q->tolerance_said == SAID_MODEL) q->tolerance = set.tolerance, q->absolute = set.absolute;
    q->step_said = who(q->step, set.step, aside);
    if (isnan(q->step)) q->step = set.step;
    q->until_said = who(q->until, set.until, false);
    if (isnan(q->until)) q->until = set.until;
    if (isnan(q->start)) q->start = s->start;
    q->method_said = q->method ? SAID_CALLER : set.method && !aside ? SAID_MODEL : SAID_DEFAULT;
    if (q->method_said == SAID_MODEL) q->method = set.method;
    if (!isnan(q->accuracy)) chooses = true;
    if (!q->method) q->method = chooses && !request_asks(q->step_said) ? SYSTEM_AUTO : "verlet";
    q->automatic = system_auto(q->method);
}

request request_of_run(const motus_system *s, const motus_run_def *d)
{
    request q = {.method = d->method,
                 .step = d->step,
                 .tolerance = d->tolerance,
                 .accuracy = d->accuracy,
                 .absolute = d->absolute != 0,
                 .start = d->start,
                 .until = d->until,
                 .shortest = d->shortest_step,
                 .longest = d->longest_step,
                 .most_steps = d->most_steps};
    add_model(&q, s, true);
    return q;
}

request request_of_ensemble(const motus_system *s, const motus_ensemble_def *d)
{
    request q = {.method = d->method,
                 .step = d->step,
                 .tolerance = d->tolerance,
                 .accuracy = d->accuracy,
                 .absolute = d->absolute != 0,
                 .start = NAN,
                 .until = d->until,
                 .shortest = d->shortest_step,
                 .longest = d->longest_step,
                 .most_steps = d->most_steps};
    add_model(&q, s, false);
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
    if (q->tolerance_said == SAID_CALLER) return refuse_tolerance(&q->chosen, "a tolerance is given", err);
    if (limits) return refuse_tolerance(&q->chosen, "limits of the steps are given", err);
    if (q->tolerance_said == SAID_MODEL) return refuse_tolerance(&q->chosen, "the model sets a tolerance", err);
    return MOTUS_OK;
}

motus_status request_choose(motus_system *s, request *q, motus_error *err)
{
    chosen *const c = &q->chosen;
    motus_status status = request_row(s, q->method, c, &q->card, err);
    if (status != MOTUS_OK) return status;
    if (!row_adaptive(c)) return choose_fixed(q, err);
    if (q->step_said == SAID_CALLER) return refuse_step(c, "the definition gives", err);
    if (q->step_said == SAID_MODEL) return refuse_step(c, "the model sets", err);
    const double tolerance = isnan(q->tolerance) ? ROW_TOLERANCE : q->tolerance;
    if (q->absolute && row_reversible_steps(c)) return refuse_absolute(c, err);
    status = request_admits("a tolerance", tolerance, q->absolute, err);
    if (status == MOTUS_OK) status = check_limits(q, err);
    if (status != MOTUS_OK) return status;
    c->relative = q->absolute ? 0 : fmin(tolerance, stepper_tolerance_most(c));
    c->absolute = q->absolute ? tolerance : 0;
    c->least = q->shortest;
    c->most = q->longest > 0 ? q->longest : INFINITY;
    c->count = q->most_steps;
    return MOTUS_OK;
}
