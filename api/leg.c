/* The legs of a run: motus_run_set_state begins one at another state, motus_run_statistics counts over all of them. */
#include "api/bars.h"
#include "api/goal.h"
#include "api/locate.h"
#include "api/run_events.h"

#include <math.h>
#include <string.h>

motus_status motus_run_statistics(const motus_run *r, motus_statistics *out)
{
    if (!r || !out || motus_struct_check(MOTUS_DEF_STATISTICS, out, NULL) != MOTUS_OK) return MOTUS_ARGUMENT;
    motus_statistics ours = motus_default_statistics();
    ours.legs = r->legs;
    ours.method = r->chosen.name;
    ours.machine = r->machine.name;
    ours.compiled_from = r->compiled_from;
    ours.steps = r->before + motus_run_steps(r);
    ours.refused = stepper_refused(r->stepper);
    ours.evaluations = stepper_evaluations(r->stepper);
    ours.iterations = stepper_iterations(r->stepper);
    ours.first_step = r->first_step;
    ours.last_step = ours.steps > 0 ? fabs(stepper_last_step(r->stepper)) : NAN;
    ours.absolute = r->chosen.absolute > 0;
    if (row_adaptive(&r->chosen)) ours.tolerance = ours.absolute ? r->chosen.absolute : r->chosen.relative;
    goal_statistics(r, &ours);
    stepper_sizes(r->stepper, &ours.shortest_step, &ours.longest_step);
    locate_statistics(r, &ours);
    run_events_statistics(r, &ours);
    motus_struct_write(MOTUS_DEF_STATISTICS, &ours, out);
    return MOTUS_OK;
}

/* Writes the state that the leg begins with to mid_x and mid_v, in the inside order. */
static motus_status compose(motus_run *r, double t, const double *x, const double *v, motus_error *err)
{
    const problem *p = &r->system->problem;
    motus_status status = run_sync(r, false, err);
    if (status != MOTUS_OK) return status;
    memcpy(r->mid_x, r->x, p->nx * sizeof(double));
    memcpy(r->mid_v, r->v, p->nv * sizeof(double));
    system_inside(r->system, x, v, r->mid_x, r->mid_v);
    if (p->refresh) p->refresh(p->ctx, t, r->mid_x, r->mid_v);
    return MOTUS_OK;
}

static motus_status set_state(motus_run *r, double t, const double *x, const double *v, motus_error *err)
{
    timing leg;
    const int64_t steps = motus_run_steps(r);
    const double step = row_adaptive(&r->chosen) ? NAN : fabs(r->timing.h);
    motus_status status = run_timing(r->system, &r->chosen, step, r->timing.until, t, &leg, err);
    if (status == MOTUS_OK) status = compose(r, t, x, v, err);
    if (status == MOTUS_OK) status = stepper_start(r->stepper, leg.t0, leg.h, r->mid_x, r->mid_v, err);
    if (status != MOTUS_OK) return status;
    r->before += steps;
    run_leg(r, &leg);
    bars_leg(r);
    status = r->locate ? locate_begin(r, err) : MOTUS_OK;
    if (status == MOTUS_OK) status = run_events_begin(r, err);
    if (status != MOTUS_OK) return status;
    return run_moved(r, err);
}

motus_status motus_run_set_state(motus_run *r, double t, const double *x, const double *v, motus_error *err)
{
    if (!motus_error_sound(err)) return MOTUS_ARGUMENT;
    if (!r) return fail(err, MOTUS_ARGUMENT, "motus_run_set_state needs a run");
    if (r->observing) return run_refuse_move(err);
    if (isnan(t)) t = stepper_time(r->stepper);
    modes m = modes_enter();
    const motus_status status = set_state(r, t, x, v, err);
    modes_leave(m);
    return status;
}
