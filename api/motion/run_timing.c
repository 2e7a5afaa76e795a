/* From when to when a run goes and in which steps, and what messages say of its times. See run.h. */
#include "api/motion/run.h"

#include <math.h>

#define STEPS_MAX 1e15 /* from the start to `until`: eleven days at a nanosecond a step */

motus_status run_timing(const chosen *chosen, double step, double until, double start, timing *out, motus_error *err)
{
    const bool adaptive = row_adaptive(chosen);
    const double h = adaptive ? 1 : step; /* adaptive: its sign is the direction */
    *out = (timing){.until = until, .t0 = start};
    if (isnan(h)) {
        fail(err, MOTUS_ARGUMENT, "no step is given");
        hint(err, "give `step = 0.01` of the definition; motus_suggest finds one");
        return MOTUS_ARGUMENT;
    }
    if (!isfinite(h) || !(h > 0)) return fail(err, MOTUS_ARGUMENT, "the step is a positive number, not %g", h);
    if (isnan(out->until)) {
        fail(err, MOTUS_ARGUMENT, "no end is given");
        hint(err, "give `until = 10` of the definition; motus_suggest finds one");
        return MOTUS_ARGUMENT;
    }
    if (!isfinite(out->until) || !isfinite(out->t0))
        return fail(err, MOTUS_ARGUMENT, "start and end are finite numbers, not %g and %g", out->t0, out->until);
    if (adaptive) {
        out->h = copysign(fmax(1, fabs(out->t0)), out->until - out->t0);
        out->whole = INT64_MAX;
        return MOTUS_OK;
    }
    double q = fabs(out->until - out->t0) / h;
    if (q > STEPS_MAX) {
        fail(err, MOTUS_LIMIT, "from %g to %g in steps of %g are %.3g steps; at most %.0e are taken", out->t0,
             out->until, h, q, STEPS_MAX);
        hint(err, "take a larger step or an earlier end");
        return MOTUS_LIMIT;
    }
    char t[DECIMAL_MAX];
    out->h = out->until < out->t0 ? -h : h;
    if (q > 0 && out->t0 + out->h == out->t0)
        return fail(err, MOTUS_ARGUMENT, "the step %g is lost beside the time %s", h, decimal(out->t0, t));
    const stepper_way way = stepper_way_of(out->t0, out->h, out->until);
    out->whole = way.whole;
    out->last = way.last;
    out->total = way.whole + (way.last != 0);
    if (out->whole > 0 && out->last != 0 && row_uniform(chosen)) {
        fail(err, MOTUS_METHOD, "%s takes equal steps only, and the last one would be %g", chosen->name,
             fabs(out->last));
        hint(err, "choose a step that divides %g, or method verlet", fabs(out->until - out->t0));
        return MOTUS_METHOD;
    }
    return MOTUS_OK;
}

bool run_starts_late(const timing *t)
{
    enum { FAR = 64 };
    return fabs(t->t0) > FAR * fabs(t->until - t->t0);
}

char *run_time_text(const motus_run *r, double t, char out[DECIMAL_MAX])
{
    return decimal_time(t, r->timing.until - r->timing.t0, out);
}

/* ---- what a run refuses ---- */

motus_status run_refuse_move(motus_error *err)
{
    fail(err, MOTUS_ARGUMENT, "an observer cannot step, restore or set its run");
    hint(err, "return a value other than 0, and change the run after the call that stepped it");
    return MOTUS_ARGUMENT;
}

motus_status run_refuse(const motus_run *r, const char *what, motus_error *err)
{
    return r->locate ? fail(err, MOTUS_UNAVAILABLE, "a run that locates switches cannot be %s", what) : MOTUS_OK;
}

motus_status run_refuse_beyond(const motus_run *r, double t, motus_error *err)
{
    char a[DECIMAL_MAX], b[DECIMAL_MAX];
    return fail(err, MOTUS_STATE, "the restart state is at t = %s, beyond the end of this run, %s", decimal(t, a),
                decimal(r->timing.until, b));
}
