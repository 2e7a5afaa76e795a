/* How a run chooses its steps. See control.h.
 *
 * Invariant: a number that would change nothing is refused: a step where the method adapts its steps, a tolerance where
 * it does not. What the model says of its own method is left aside where the caller names another one.
 */
#include "api/request/control.h"

#include "core/stepper.h"

#include <math.h>
#include <string.h>

#define RELATIVE_LEAST 1e-15 /* a few roundings */

control_wish control_wish_of_run(const motus_run_def *d)
{
    return (control_wish){d->method != NULL, d->step,          d->tolerance, d->shortest_step,
                          d->longest_step,   d->absolute != 0, d->most_steps};
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

motus_status control_admits(const char *what, double value, bool absolute, motus_error *err)
{
    if (!(value > 0) || !isfinite(value))
        return fail(err, MOTUS_ARGUMENT, "%s is a positive number, not %g", what, value);
    if (absolute || (value >= RELATIVE_LEAST && value < 1)) return MOTUS_OK;
    fail(err, MOTUS_ARGUMENT, "the relative %s %g %s", strchr(what, ' ') + 1, value,
         value < 1 ? "is below the rounding of the numbers" : "allows errors as large as the motion");
    hint(err, "give one from %g to 0.1", RELATIVE_LEAST);
    return MOTUS_ARGUMENT;
}

/* Of steps that follow the time scale of the motion the tolerance is a part of it. */
static motus_status refuse_absolute(const chosen *c, motus_error *err)
{
    fail(err, MOTUS_ARGUMENT, "the tolerance of %s is relative: its steps follow the time scale of the motion",
         c->name);
    hint(err, "leave out `absolute`, or choose dop853, whose steps follow from errors");
    return MOTUS_ARGUMENT;
}

static motus_status check_limits(const control_wish *w, motus_error *err)
{
    const bool sound = w->shortest >= 0 && !isinf(w->shortest);
    if (!sound || !(w->longest >= 0)) {
        fail(err, MOTUS_ARGUMENT, "the %s step is %g, and a limit of the steps is a positive number",
             sound ? "longest" : "shortest", sound ? w->longest : w->shortest);
        hint(err, "0 is for none: `%s_step = 0` of the definition", sound ? "longest" : "shortest");
        return MOTUS_ARGUMENT;
    }
    if (w->count < 0) {
        fail(err, MOTUS_ARGUMENT, "the most steps are %lld, and a limit of their number is positive",
             (long long)w->count);
        hint(err, "0 is for none: `most_steps = 0` of the definition");
        return MOTUS_ARGUMENT;
    }
    if (w->longest == 0 || w->shortest <= w->longest) return MOTUS_OK;
    return fail(err, MOTUS_ARGUMENT, "the shortest step, %g, is longer than the longest, %g", w->shortest, w->longest);
}

motus_status control_choose(const motus_system *s, const control_wish *w, chosen *c, motus_error *err)
{
    motus_settings set = motus_default_settings();
    motus_settings_of(s, &set);
    const bool limits = w->shortest != 0 || w->longest != 0 || w->count != 0;
    if (!row_adaptive(c)) {
        if (!isnan(w->tolerance)) return refuse_tolerance(c, "a tolerance is given", err);
        if (limits) return refuse_tolerance(c, "limits of the steps are given", err);
        if (!w->named && !isnan(set.tolerance)) return refuse_tolerance(c, "the model sets a tolerance", err);
        return MOTUS_OK;
    }
    if (!isnan(w->step)) return refuse_step(c, "the definition gives", err);
    if (!w->named && !isnan(set.step)) return refuse_step(c, "the model sets", err);
    const bool own = isnan(w->tolerance) && !isnan(set.tolerance);
    const double tolerance = own ? set.tolerance : isnan(w->tolerance) ? ROW_TOLERANCE : w->tolerance;
    const bool absolute = own ? set.absolute : w->absolute;
    if (absolute && row_reversible_steps(c)) return refuse_absolute(c, err);
    motus_status status = control_admits("a tolerance", tolerance, absolute, err);
    if (status == MOTUS_OK) status = check_limits(w, err);
    if (status != MOTUS_OK) return status;
    c->relative = absolute ? 0 : fmin(tolerance, stepper_tolerance_most(c));
    c->absolute = absolute ? tolerance : 0;
    c->least = w->shortest;
    c->most = w->longest > 0 ? w->longest : INFINITY;
    c->count = w->count;
    return MOTUS_OK;
}
